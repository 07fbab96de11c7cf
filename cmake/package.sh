#!/usr/bin/env bash
# Copyright (c) 2026 the sward authors
# SPDX-License-Identifier: MIT
#
# Makes the Debian packages sward, libsward<version> and libsward-dev for this machine in build/packages. Installs what
# is missing (Debian 12; as root or through sudo).
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

sward_install "${sward_packages[@]}" dpkg-dev file
launcher=()
if command -v ccache > /dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
build=$sward_root/build/package
sward_say "building in $build"
cmake -S "$sward_root" --preset package --log-level=WARNING "${launcher[@]}"
cmake --build "$build" -j "$(sward_jobs)"
sward_say "packing"
rm -rf "$sward_root/build/packages"
(cd "$build" && cpack -B "$sward_root/build/packages")
rm -rf "$sward_root/build/packages/_CPack_Packages"
ls "$sward_root/build/packages"
