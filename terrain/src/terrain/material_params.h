// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/ground_material.h>

#include "terrain/material_glsl.h"

namespace sward {

/// Period of places on the ground that shaders see, metres.
inline constexpr double k_ground_period_m = 1024;

/// A material as shaders see it; layers of the detail are the caller's to number.
material_glsl::MaterialParams make_material_params(const GroundMaterial& material, int layer, int cliff_layer);

}  // namespace sward
