// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The CPU twin of classification and growth: which plants stand where. Every decision is a function of the shared
// shader files; what is here is what GLSL does by instancing, texelFetch and tessellation.
//
// After D. Papavasiliou, "Real-Time Grass (and Other Procedural Objects) on Terrain" (2015), sections 2.2, 3.3, 3.4.
// Departure: the ground is asked again at each seed of a cluster, so that no plant stands where nothing may grow.

#include <sward/vegetation/plants.h>

#include "vegetation/layer_params.h"

namespace sward {

namespace {

using namespace shared;

/// One layer over one map, as the shaders' uniforms and textures have it.
struct Ground {
  const ColorMap& map;
  LayerParams layer;
  std::vector<SpeciesParams> species;
};

vec4 fetch(const Ground& ground, ivec2 texel) {
  const ivec2 at = clamp_texel(ground.layer, texel);
  return vec4(ground.map.texels[size_t(at.y) * size_t(ground.map.width) + size_t(at.x)]) / 255.0f;
}

vec4 ground_color(const Ground& ground, const MapSample& s) {
  return blend_texels(fetch(ground, s.texel), fetch(ground, s.texel + ivec2(1, 0)),
                      fetch(ground, s.texel + ivec2(0, 1)), fetch(ground, s.texel + ivec2(1, 1)), s.fraction);
}

/// The species chosen at a point for a given z; -1 where no plant may stand.
Choice choose_plant(const Ground& ground, const TriangleRecord& record, vec2 offset, float z) {
  Choice nothing{-1, 0.0f};
  const MapSample sample = locate_texel(ground.layer, record.texel, record.texel_fraction, offset);
  const vec4 color = ground_color(ground, sample);
  if (!ground_is_open(sample, color)) return nothing;
  const vec3 hsv = rgb_to_hsv(vec3(color));
  TopTwo best = no_species();
  for (size_t i = 0; i < ground.species.size(); ++i) {
    best = insert_score(best, int(i), species_score(ground.species[i], hsv));
  }
  const Choice choice = choose_species(best, z);
  if (choice.species < 0) return nothing;
  if (!plant_allowed(best, choice, ground.species[size_t(best.first)].kind,
                     ground.species[size_t(choice.species)].kind)) {
    return nothing;
  }
  return choice;
}

/// Descends the drawn surface below a triangle; `z_offset` is added to the nodes' heights.
float walk_surface(const FixedTriangles& triangles, uint32_t node, float z_offset, SurfaceWalk walk) {
  while (node != 0) {
    const SurfaceNode& split = triangles.nodes()[node];
    node = split.child[walk_turn(walk)];
    walk = walk_down(walk, split.z + z_offset);
  }
  return walk_height(walk);
}

/// Grows the seeds of one record.
class Grower {
 public:
  Grower(const Ground& ground, const FixedTriangles& triangles, const FixedTriangle& triangle,
         const TriangleRecord& record, std::vector<Plant>& plants)
      : ground_(ground),
        triangles_(triangles),
        triangle_(triangle),
        record_(record),
        id_(record.id_low, record.id_high),
        plants_(plants) {}

  void grow_cluster(uint32_t index, uint32_t cluster_size) {
    const Cluster cluster = make_cluster(id_, index);
    const Choice choice = choose_plant(ground_, record_, offset_of(cluster_centre(id_, index, cluster)), cluster.z);
    if (choice.species < 0) return;
    const uint32_t first = index * cluster_size;
    const uint32_t end = min(first + cluster_size, record_.submitted);
    for (uint32_t rank = first; rank < end; ++rank) grow_seed(cluster, choice, rank);
  }

 private:
  vec2 offset_of(vec2 point) const { return offset_from_apex(record_.to_left, record_.to_right, point); }

  /// Height of the drawn surface against the eye's, from the same numbers as the shaders have.
  float relative_height(vec2 point) const {
    const float apex = record_.apex.z;
    const SurfaceWalk walk = begin_walk(apex, apex + record_.to_left.z, apex + record_.to_right.z, point);
    return walk_surface(triangles_, record_.surface, record_.surface_z, walk);
  }

  void grow_seed(const Cluster& cluster, const Choice& choice, uint32_t rank) {
    const vec2 point = seed_point(id_, rank, cluster);
    const vec2 offset = offset_of(point);
    const float distance = seed_distance(record_.apex, offset, relative_height(point));
    const Presence presence = seed_presence(ground_.layer, record_.limit, id_, rank, distance);
    if (!(presence.fade > 0.0f)) return;
    if (choose_plant(ground_, record_, offset, cluster.z).species < 0) return;
    const PlantTraits traits =
        make_traits(ground_.species[size_t(choice.species)], ground_.layer, id_, rank, choice.score);
    Plant& plant = plants_.emplace_back();
    plant.triangle = triangle_.id;
    plant.rank = rank;
    plant.species = uint32_t(choice.species);
    plant.position = {triangle_.apex.x + double(offset.x), triangle_.apex.y + double(offset.y),
                      surface_height(triangles_, triangle_, point.x, point.y)};
    plant.height = traits.height;
    plant.width = traits.width;
    plant.stiffness = traits.stiffness;
    plant.azimuth = traits.azimuth;
    plant.score = choice.score;
    plant.fade = presence.fade;
  }

  const Ground& ground_;
  const FixedTriangles& triangles_;
  const FixedTriangle& triangle_;
  const TriangleRecord& record_;
  uvec2 id_;
  std::vector<Plant>& plants_;
};

}  // namespace

double surface_height(const FixedTriangles& triangles, const FixedTriangle& triangle, float a, float b) {
  const SurfaceWalk walk = begin_walk(0.0f, triangle.to_left.z, triangle.to_right.z, vec2(a, b));
  const float z_offset = float(triangles.surface_z() - triangle.apex.z);
  return triangle.apex.z + double(walk_surface(triangles, triangle.surface, z_offset, walk));
}

std::vector<Plant> grow_plants(const Layer& layer, const View& view, const ColorMap& map,
                               const FixedTriangles& triangles, const Seeding& seeding, float sun_azimuth) {
  const Ground ground{map, make_layer_params(layer, view, geometry_of(map), sun_azimuth), make_species_params(layer)};
  const uint32_t cluster_size = uint32_t(layer.cluster_size);
  std::vector<Plant> plants;
  for (const DensityBin& bin : seeding.bins) {
    for (uint32_t i = bin.first; i < bin.first + bin.triangles; ++i) {
      SWARD_ASSERT(seeding.source[i] < triangles.size(), "the seeding comes from other triangles");
      const TriangleRecord& record = seeding.records[i];
      const FixedTriangle triangle = triangles[seeding.source[i]];
      Grower grower(ground, triangles, triangle, record, plants);
      for (uint32_t cluster = 0; cluster < bin.clusters && cluster * cluster_size < record.submitted; ++cluster) {
        grower.grow_cluster(cluster, cluster_size);
      }
    }
  }
  return plants;
}

}  // namespace sward
