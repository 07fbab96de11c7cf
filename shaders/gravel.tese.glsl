// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of gravel: the angle around a stone.
#include "common_object_line.glsl"

// Parts slide in and out between their neighbours.
layout(isolines, fractional_odd_spacing) in;

void main() { hand_on(); }
