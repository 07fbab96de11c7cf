// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// What most tests include, compiled once for all of them. A convenience of the build: every test includes what it names.

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <memory>
#include <random>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <tl/expected.hpp>
#include <vector>
