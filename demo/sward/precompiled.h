// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// What most commands include, compiled once for all of them. A convenience of the build: every file includes what it
// names.

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "host/scene_renderer.h"
