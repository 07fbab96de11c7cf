// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// toml++ without exceptions and without its shared library: scene_toml.cpp holds the parser, so that only one source
// pays for compiling it.
#define TOML_EXCEPTIONS 0
#define TOML_HEADER_ONLY 0
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>
