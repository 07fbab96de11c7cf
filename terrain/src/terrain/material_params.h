// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/terrain/ground_material.h>

#include "terrain/material_glsl.h"

namespace sward {

/// Period of places on the ground that shaders see, metres.
inline constexpr double k_ground_period_m = 1024;

/// Layers of the array texture, on flat ground and on cliffs, at the finest and the coarser scales.
struct MaterialLayers {
  int flat = 0, cliff = 0, flat_broad = 0, cliff_broad = 0;
};

/// A material as shaders see it.
SWARD_API material_glsl::MaterialParams make_material_params(const GroundMaterial& material,
                                                             const MaterialLayers& layers);

}  // namespace sward
