// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of plants that are small meshes: a segment for each eight of its faces.
#include "common_object_line.glsl"

layout(isolines, equal_spacing) in;

void main() { hand_on(); }
