// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of plants that are small meshes: one line a plant, whose segments stand for eight triangles each.
#include "common_object_control.glsl"
#include "common_mesh_plant.glsl"

vec2 object_widening(float widen) { return vec2(sqrt(widen)); }

float object_parts(SpeciesParams species, float distance, float size_px) {
  return shown_faces(species.own_a.x, size_px) / k_faces_a_part;
}
