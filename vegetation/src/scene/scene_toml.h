// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// toml++ without exceptions and without its shared library: scene_toml.cpp holds the parser, so that only one source
// pays for compiling it.
#define TOML_EXCEPTIONS 0
#define TOML_HEADER_ONLY 0
#define TOML_ENABLE_FORMATTERS 0
#define TOML_MAX_NESTED_VALUES 16

// The parser of toml++ 3.3 asserts, before it checks them and reports an error, some things that damaged files do not
// hold. With NDEBUG it would hand the same to the optimiser as promises. So neither: its checks decide.
#define TOML_ASSERT(expression) static_assert(true)
#pragma push_macro("NDEBUG")
#undef NDEBUG
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")
