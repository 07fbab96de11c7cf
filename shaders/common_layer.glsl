// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The layer and its species, as vegetation/src/vegetation/vegetation_renderer_buffers.h lays them out. GLSL only.
#include "common_shared.glsl"
#include "common_philox.glsl"
#include "common_seed.glsl"
#include "common_classify.glsl"
#include "common_placement.glsl"
#include "common_plant.glsl"
#include "common_surface.glsl"

layout(std140, binding = SWARD_BINDING_SPECIES) uniform SwardSpecies {
  LayerParams layer;
  SpeciesParams species[64];
} sward_layer;

int species_count() { return int(sward_layer.layer.reach.w); }
uint cluster_size() { return uint(sward_layer.layer.reach.y); }
