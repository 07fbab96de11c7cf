#!/usr/bin/env bash
# Copyright (c) 2026 the sward authors
# SPDX-License-Identifier: MIT
#
#   readme.sh README.md hello.cpp
# The README's lines of use are those that demo/hello/hello.cpp compiles: each block that the source marks, without its
# indentation, stands in the README.
set -euo pipefail
readme=$(cat "$1")
for mark in once "each frame"; do
  block=$(awk -v mark="// embedding: $mark" '
    index($0, mark) { inside = 1; indent = match($0, /[^ ]/) - 1; next }
    index($0, "// embedding: end") { inside = 0 }
    inside { print substr($0, indent + 1) }' "$2")
  [ -n "$block" ] || { echo "$2 has no lines marked \`embedding: $mark\`" >&2; exit 1; }
  if [[ "$readme" != *"$block"* ]]; then
    printf '%s does not have these lines of %s; copy them there:\n%s\n' "$1" "$2" "$block" >&2
    exit 1
  fi
done
