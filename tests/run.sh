#!/usr/bin/env bash
# Copyright (c) 2026 the sward authors
# SPDX-License-Identifier: MIT
#
# Installs what is missing (Debian 12; as root or through sudo), builds, and runs every test. Arguments go to ctest:
# `tests/run.sh -L unit` runs the tests of one label.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../cmake/setup.sh"

sward_install "${sward_packages[@]}" "${sward_test_packages[@]}"
sward_build
sward_say "running the tests"
cd "$sward_root"
# One test more than cores: some wait for files, windows and loads.
exec ctest --preset release -j $(($(nproc) + 1)) "$@"
