#!/usr/bin/env bash
# Copyright (c) 2026 the sward authors
# SPDX-License-Identifier: MIT
#
#   [PICTURE=FILE] [SIZE=960x540] [ALL=1] installed.sh PREFIX
# Checks what is installed under PREFIX as its users meet it: builds demo/hello by find_package and by pkg-config, with
# shared and with static libraries, in a folder of its own, starts all four, and draws with the first and the last (ALL:
# with all) without a display: the pictures are the same. PICTURE keeps it, SIZE is its size.
set -euo pipefail
prefix=$(realpath "$1")
export PKG_CONFIG_PATH=${PKG_CONFIG_PATH:-}
config=$(find "$prefix/lib" -name sward-config.cmake)
libraries=$(realpath "$(dirname "$config")/../..")
hello=$prefix/share/doc/sward/examples/hello
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
die() { printf 'installed.sh: %s\n' "$*" >&2; exit 1; }

# Dependencies: what draws terrain and vegetation needs libepoxy, and nothing of images, meshes or windows.
for name in terrain gl terrain_gl vegetation; do
  needed=$(readelf -d "$libraries/libsward-$name.so" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p')
  for entry in $needed; do
    case $entry in
      libsward-*|libepoxy.so.0|libstdc++.so.6|libm.so.6|libgcc_s.so.1|libc.so.6|ld-linux*) ;;
      *) die "libsward-$name.so needs $entry" ;;
    esac
    [ $name != terrain ] || [ $entry != libepoxy.so.0 ] || die "libsward-terrain.so needs OpenGL"
  done
done
for name in shaders scenes; do
  [ -d "$prefix/share/sward/$name" ] || die "there is no $prefix/share/sward/$name"
done

# A component that is not there is told of.
mkdir "$work/ask"
cat > "$work/ask/CMakeLists.txt" << 'END'
cmake_minimum_required(VERSION 3.25)
project(ask LANGUAGES CXX)
find_package(sward ${VERSION} CONFIG REQUIRED COMPONENTS vegetation ${COMPONENT})
END
ask() { cmake -S "$work/ask" -B "$work/ask/build" "-DCMAKE_PREFIX_PATH=$prefix" "$@" 2>&1; }
answer=$(ask -DCOMPONENT=teapots) && die "find_package accepts the component teapots"
[[ "$answer" == *"There is no component"*teapots* ]] || die "find_package says of an unknown component: $answer"
answer=$(ask -DCOMPONENT= -DVERSION=99.0) && die "find_package accepts version 99.0"
answer=$(ask -DCOMPONENT=terrain -DVERSION=) || die "find_package refuses what is installed: $answer"

# As CMake's users. The project is a copy, for an installed one may not be written to.
cat > "$work/both.cmake" << 'END'
cmake_minimum_required(VERSION 3.25)
project(both LANGUAGES CXX)
find_package(sward CONFIG REQUIRED COMPONENTS vegetation static)
add_executable(hello_static ${HELLO}/hello_headless.cpp)
target_link_libraries(hello_static PRIVATE sward::vegetation_static)
END
mkdir "$work/static"
mv "$work/both.cmake" "$work/static/CMakeLists.txt"
quietly() { "$@" > "$work/log" 2>&1 || { cat "$work/log" >&2; die "this failed: $*"; }; }
quietly cmake -S "$hello" -B "$work/cmake" "-DCMAKE_PREFIX_PATH=$prefix" -DSWARD_WINDOW=OFF
quietly cmake --build "$work/cmake"
quietly cmake -S "$work/static" -B "$work/cmake_static" "-DCMAKE_PREFIX_PATH=$prefix" "-DHELLO=$hello"
quietly cmake --build "$work/cmake_static"

# As everybody else.
export PKG_CONFIG_PATH=$libraries/pkgconfig:$PKG_CONFIG_PATH
flags=$(pkg-config --cflags --libs sward-vegetation)
quietly ${CXX:-c++} -std=c++20 "$hello/hello_headless.cpp" -o "$work/hello_pc" $flags
flags=$(pkg-config --static --cflags --libs sward-vegetation | sed 's/-l\(sward-[a-z_]*\)/-l:lib\1.a/g')
quietly ${CXX:-c++} -std=c++20 "$hello/hello_headless.cpp" -o "$work/hello_pc_static" $flags

export LD_LIBRARY_PATH=$libraries${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH} LIBGL_ALWAYS_SOFTWARE=1
for program in cmake/hello_headless cmake_static/hello_static hello_pc hello_pc_static; do
  linked=$(ldd "$work/$program" | grep -c libsward || true)
  case $program in
    *static) [ "$linked" = 0 ] || die "$program is not linked statically" ;;
    *) [ "$linked" = 4 ] || die "$program uses $linked shared libraries of sward's, not 4" ;;
  esac
  answer=$("$work/$program" --no-such-option 2>&1) && die "$program takes any option"
  [[ "$answer" == "hello: error: "* ]] || die "$program does not start: $answer"
done
drawing="cmake/hello_headless hello_pc_static"
[ -z "${ALL:-}" ] || drawing="$drawing cmake_static/hello_static hello_pc"
for program in $drawing; do
  "$work/$program" --size ${SIZE:-240x135} --picture "$work/picture.ppm" || die "$program does not run"
  if [ -e "$work/first.ppm" ]; then
    cmp "$work/first.ppm" "$work/picture.ppm" || die "$program draws another picture than the one before"
  fi
  mv "$work/picture.ppm" "$work/first.ppm"
done
# Neither blank nor sky alone: grass has thousands of colours.
colors=$(tail -c +16 "$work/first.ppm" | od -An -v -tx1 -w3 | sort -u | wc -l)
[ "$colors" -gt 1000 ] || die "the picture has $colors colours: nothing grows there"
if [ -n "${PICTURE:-}" ]; then cp "$work/first.ppm" "$PICTURE"; fi
echo "hello was built in four ways; the pictures are the same, of $colors colours"
