// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// What most of the demo's files include, compiled once for all of them. A convenience of the build: every file includes
// what it names.

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tl/expected.hpp>
#include <vector>
