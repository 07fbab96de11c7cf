// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// What most of the tool includes, compiled once for all of it. A convenience of the build: every file includes what it
// names. CLI11 is not in here: it has validators of its own in every file that sees it, which take seconds to compile.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "host/scene_renderer.h"
