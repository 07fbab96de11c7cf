#!/usr/bin/env bash
# Copyright (c) 2026 the sward authors
# SPDX-License-Identifier: MIT
#
# Installs what is missing (Debian 12; as root or through sudo), builds, and shows the default scene: in a window where
# there is a display, otherwise as build/meadow.png. Further arguments go to `sward view` or `sward render`.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../cmake/setup.sh"

sward_install "${sward_packages[@]}"
sward_build sward
sward=$sward_root/build/release/demo/sward/sward

if [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]; then
  sward_say "opening a window"
  if "$sward" view --shaders "$sward_root/shaders" "$@"; then exit 0; fi
  sward_say "no window (see above); rendering a picture instead"
fi
picture=$sward_root/build/meadow.png
sward_say "rendering the default scene without a display"
"$sward" render "$@" -o "$picture"
sward_say "the picture is $picture"
