#!/usr/bin/env bash
# Copyright (c) 2026 the sward authors
# SPDX-License-Identifier: MIT
#
#   temporary.sh BUILD
# Installs a build into a folder of its own and checks it there (installed.sh).
set -euo pipefail
prefix=$(mktemp -d)
trap 'rm -rf "$prefix"' EXIT
cmake --install "$1" --prefix "$prefix" > "$prefix/log" 2>&1 || { cat "$prefix/log" >&2; exit 1; }
"$(dirname "${BASH_SOURCE[0]}")/installed.sh" "$prefix"
