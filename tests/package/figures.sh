#!/usr/bin/env bash
# Copyright (c) 2026 the sward authors
# SPDX-License-Identifier: MIT
#
#   figures.sh PREFIX HELLO_HEADLESS
# Makes the README's table of what embedding costs: sizes of the stripped shared libraries under PREFIX, and libraries and
# start of HELLO_HEADLESS, built against them (tests/package/installed.sh says how). Medians of three runs.
set -euo pipefail
prefix=$(realpath "$1")
hello=$(realpath "$2")
libraries=$(dirname "$(find "$prefix/lib" -name 'libsward-vegetation.so')")
export LD_LIBRARY_PATH=$libraries
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

total=0 sizes=""
for name in terrain gl terrain_gl vegetation; do
  strip -o "$work/$name.so" "$libraries/libsward-$name.so"
  bytes=$(stat -c %s "$work/$name.so")
  total=$((total + bytes))
  sizes+="${sizes:+, }$name $((bytes / 1024))"
done

# Seconds from the start of main() until all is created, and until the first frame is drawn: medians, "a / b".
median_start() {
  for _ in 1 2 3; do env "$@" "$hello" >> "$work/times"; done
  for field in 3 8; do cut -d' ' -f$field "$work/times" | sort -n | sed -n 2p; done | paste -sd/ | sed 's|/| / |'
  rm "$work/times"
}
export MESA_SHADER_CACHE_DIR=$work/cache
cold=$(median_start MESA_SHADER_CACHE_DISABLE=true)
"$hello" > /dev/null
warm=$(median_start MESA_SHADER_CACHE_DISABLE=false)

direct=$(readelf -d "$hello" | grep -c NEEDED)
all=$(ldd "$hello" | grep -c '=> /')
cat << END
| shared libraries, stripped | $((total / 1024)) KB ($sizes) |
| libraries that hello_headless names / all that are loaded for it, without the driver | $direct / $all |
| start until all is created / until the first frame is drawn, no cache of shaders | $cold s |
| the same with the driver's cache | $warm s |
END
