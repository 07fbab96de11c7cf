// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of shrubs and trees: a piece of the line is the trunk or one cluster of leaves.
#include "common_object_line.glsl"

// Pieces keep their numbers: a cluster of leaves is the same one at every distance.
layout(isolines, equal_spacing) in;

void main() { hand_on(); }
