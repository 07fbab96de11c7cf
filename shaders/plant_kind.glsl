// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The kind that the stages shoot.*.glsl grow: a program is built with this file replaced by one that includes its
// kind's functions.
#include "kind_tuft.glsl"
