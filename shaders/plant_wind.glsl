// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The wind that plants ask, tessellation control: none in programs for still air. Programs with SWARD_WIND 1 are built
// with this file replaced by one that includes common_wind.glsl.
