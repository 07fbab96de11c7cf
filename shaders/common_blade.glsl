// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The table of blades' curves. GLSL only.
#include "common_shared.glsl"

layout(binding = SWARD_BINDING_BLADE_SHAPE) uniform samplerBuffer sward_blade_shape;

vec4 blade_texel(int index) { return texelFetch(sward_blade_shape, index); }

#include "common_curve.glsl"
