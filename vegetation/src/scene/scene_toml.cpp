// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#define TOML_IMPLEMENTATION
#include "scene/scene_toml.h"
