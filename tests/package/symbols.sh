#!/usr/bin/env bash
# Copyright (c) 2026 the sward authors
# SPDX-License-Identifier: MIT
#
#   symbols.sh FOLDER_OF_LISTS LIBRARY...            compares what shared libraries export with the checked-in lists
#   symbols.sh --update FOLDER_OF_LISTS LIBRARY...   writes the lists
# An entry of a list is a function or table that hosts' programs may refer to. A line that goes is a break of the binary
# interface: the version and CHANGELOG.md must say so. Lists are those of g++ on 64-bit Linux.
set -euo pipefail

update=no
if [ "${1:-}" = --update ]; then update=yes; shift; fi
[ $# -ge 2 ] || { echo "usage: symbols.sh [--update] FOLDER_OF_LISTS LIBRARY..." >&2; exit 2; }
lists=$1; shift

# Strong symbols and tables of virtual functions; weak ones are copies of inline functions that every program has.
exported() { nm -D --defined-only "$1" | awk '$2 ~ /^[TDBRV]$/ { print $3 }' | c++filt | LC_ALL=C sort -u; }

status=0
for library in "$@"; do
  name=$(basename "$library"); name=${name#libsward-}; list=$lists/${name%%.so*}.txt
  if [ $update = yes ]; then exported "$library" > "$list"; continue; fi
  [ -s "$list" ] || { echo "there is no list $list; write it: symbols.sh --update $lists $library" >&2; exit 1; }
  if strangers=$(exported "$library" | grep -v 'sward::'); then
    printf '%s exports what is not in namespace sward:\n%s\n' "$library" "$strangers" >&2; status=1
  fi
  if ! diff -u --label "$list" "$list" --label "$library" <(exported "$library") >&2; then
    printf '%s exports other symbols than before. If that is meant: tests/package/symbols.sh --update %s %s\n' \
      "$library" "$lists" "$library" >&2
    status=1
  fi
done
exit $status
