# Copyright (c) 2026 the sward authors
# SPDX-License-Identifier: MIT
#
# Sourced by demo/run.sh and tests/run.sh: installs what is missing from Debian's packages and builds the release preset.

sward_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

# What the build needs.
sward_packages=(
  g++ cmake ninja-build pkg-config
  libglm-dev libglfw3-dev libopenimageio-dev libopenmesh-dev libepoxy-dev libegl-dev libgl1-mesa-dri libgtest-dev
  libbenchmark-dev libcli11-dev libtomlplusplus-dev libspdlog-dev nlohmann-json3-dev libexpected-dev libimgui-dev
)
# What only tests need: the OpenSceneGraph plugin and a display for it.
sward_test_packages=(libopenscenegraph-dev openscenegraph xvfb xauth)

sward_say() { printf 'sward: %s\n' "$*"; }
sward_die() { printf 'sward: error: %s\n' "$*" >&2; exit 1; }

# Installs those of the named packages that are missing; touches neither network nor root rights when none is.
sward_install() {
  command -v dpkg-query > /dev/null || sward_die "this is no Debian; install the likes of: $*"
  local missing=() package
  for package in "$@"; do
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2> /dev/null)" = installed ] || missing+=("$package")
  done
  if [ ${#missing[@]} -eq 0 ]; then
    sward_say "all packages are installed"
    return
  fi
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo > /dev/null || sward_die "run as root, or install first: ${missing[*]}"
    as_root=(sudo)
  fi
  sward_say "installing ${missing[*]}"
  "${as_root[@]}" apt-get update -q
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${missing[@]}"
}

# Compilers at work at once: one a core, but no more than one a gigabyte of memory.
sward_jobs() {
  local cores gigabytes
  cores=$(nproc)
  gigabytes=$(awk '/^MemTotal/ { print int($2 / 1048576) }' /proc/meminfo)
  [ "$gigabytes" -ge 1 ] || gigabytes=1
  echo $((cores < gigabytes ? cores : gigabytes))
}

# Configures and builds the release preset: everything, or the named targets.
sward_build() {
  local launcher=() targets=()
  if command -v ccache > /dev/null; then
    launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
    # Else ccache keeps nothing that is compiled with a precompiled header.
    export CCACHE_SLOPPINESS=${CCACHE_SLOPPINESS:-pch_defines,time_macros}
  fi
  if [ $# -gt 0 ]; then targets=(--target "$@"); fi
  sward_say "building preset release in $sward_root/build/release"
  (cd "$sward_root" && cmake --preset release --log-level=WARNING "${launcher[@]}" &&
    cmake --build --preset release -j "$(sward_jobs)" "${targets[@]}") || sward_die "the build failed"
}
