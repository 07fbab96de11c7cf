#!/usr/bin/env bash
# Copyright (c) 2026 the sward authors
# SPDX-License-Identifier: MIT
#
#   run.sh ROOT [PACKAGES]
# Installs the Debian packages in PACKAGES (build/packages, where cmake/package.sh puts them) into ROOT, a bare Debian 12,
# builds demo/hello there by CMake and by pkg-config, and runs it without a display. The picture is build/hello.ppm.
# As root. ROOT comes from, for example:
#   debootstrap --variant=minbase bookworm ROOT
set -euo pipefail
here=$(realpath "$(dirname "${BASH_SOURCE[0]}")")
[ $# -ge 1 ] || { echo "usage: run.sh ROOT [PACKAGES]" >&2; exit 2; }
root=$(realpath "$1")
packages=$(realpath "${2:-$here/../../build/packages}")
[ -x "$root/usr/bin/apt-get" ] || { echo "run.sh: $root is no Debian: make it with debootstrap" >&2; exit 1; }

inside() { chroot "$root" env DEBIAN_FRONTEND=noninteractive "$@"; }
rm -rf "$root/packages"
mkdir "$root/packages"
cp "$packages"/*.deb "$here/installed.sh" "$root/packages/"
mount -t proc proc "$root/proc"
trap 'umount "$root/proc"' EXIT

inside apt-get update -q
# First what a program with sward needs to run: neither images, meshes nor windows come along.
inside sh -c 'apt-get install -q -y --no-install-recommends /packages/libsward[0-9]*.deb'
if inside dpkg-query -W -f='${Package}\n' | grep -E 'openimageio|openmesh|glfw'; then
  echo "run.sh: the shared libraries alone bring these packages" >&2
  exit 1
fi
inside sh -c 'apt-get install -q -y --no-install-recommends /packages/*.deb g++ cmake make pkg-config \
  libegl1 libgl1-mesa-dri'
inside env PICTURE=/packages/hello.ppm SIZE=960x540 ALL=1 bash /packages/installed.sh /usr
inside sward --version
inside sh -c 'cd /packages && LIBGL_ALWAYS_SOFTWARE=1 sward render /usr/share/sward/scenes/border.toml \
  --shaders /usr/share/sward/shaders --size 320x180 --samples 1 -o border.png'
cp "$root/packages/hello.ppm" "$here/../../build/hello.ppm"
echo "run.sh: the picture is build/hello.ppm"
