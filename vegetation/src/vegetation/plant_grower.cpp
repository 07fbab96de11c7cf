// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The CPU twin of classification and growth: which plants stand where. Every decision is a function of the shared
// shader files; what is here is what GLSL does by instancing, texelFetch and tessellation.
//
// After D. Papavasiliou, "Real-Time Grass (and Other Procedural Objects) on Terrain" (2015), sections 2.2, 3.3, 3.4.
// Departure: the ground is asked again at each seed of a cluster, so that no plant stands where nothing may grow.

#include "vegetation/plant_grower.h"

#include <cmath>

namespace sward {

namespace {

using namespace shared;

using Ground = PlantGround;

vec4 fetch(const Ground& ground, ivec2 texel) {
  const ivec2 at = clamp_texel(ground.layer, texel);
  return vec4(ground.map->texels[size_t(at.y) * size_t(ground.map->width) + size_t(at.x)]) / 255.0f;
}

/// A place on a triangle, as classification sees it.
struct Site {
  vec4 encoded;
  bool open;
  vec2 offset;
  float altitude;
};

Site site_at(const Ground& ground, const TriangleRecord& t, vec2 point) {
  Site site;
  site.offset = offset_from_apex(t.to_left, t.to_right, point);
  site.altitude = altitude_at(t.altitude, point);
  if (ground.map == nullptr) {
    site.encoded = vec4(surface_color(t.texel, t.texel_fraction, point), 1.0f);
    site.open = true;
    return site;
  }
  const MapSample s = locate_texel(ground.layer, t.texel, t.texel_fraction, site.offset);
  site.encoded = blend_texels(fetch(ground, s.texel), fetch(ground, s.texel + ivec2(1, 0)),
                              fetch(ground, s.texel + ivec2(0, 1)), fetch(ground, s.texel + ivec2(1, 1)), s.fraction);
  site.open = ground_is_open(s, site.encoded);
  return site;
}

float fetch_mask(const GrayMap& mask, ivec2 texel) {
  return float(mask.values[mask_texel(texel, ivec2(mask.width, mask.height))]);
}

float mask_share(const Ground& ground, const TriangleRecord& t, vec2 offset, float number) {
  if (number == 0.0f) return 1.0f;
  const GrayMap& mask = *ground.masks[size_t(number) - 1];
  const vec2 place =
      mask_place(vec2(ground.mask_headers[size_t(number) - 1]), ground.layer, t.texel, t.texel_fraction, offset);
  const vec2 corner = place - vec2(0.5f);
  const vec2 whole = floor(corner);
  const ivec2 nw(whole);
  return mask_factor(fetch_mask(mask, ivec2(floor(place))), fetch_mask(mask, nw), fetch_mask(mask, nw + ivec2(1, 0)),
                     fetch_mask(mask, nw + ivec2(0, 1)), fetch_mask(mask, nw + ivec2(1, 1)), corner - whole);
}

/// Factor on the heights of what stands here.
float height_share(const Ground& ground, const TriangleRecord& t, vec2 offset) {
  if (ground.layer.place.w == 0.0f) return 1.0f;
  const auto number = size_t(ground.layer.place.w) - 1;
  const GrayMap& map = *ground.masks[number];
  const vec4 header = ground.mask_headers[number];
  const TilePlace at = tile_place(mask_place(vec2(header), ground.layer, t.texel, t.texel_fraction, offset),
                                  ivec2(map.width, map.height));
  return height_factor(fetch_mask(map, at.low), fetch_mask(map, ivec2(at.high.x, at.low.y)),
                       fetch_mask(map, ivec2(at.low.x, at.high.y)), fetch_mask(map, at.high), at.fraction, header.z);
}

float species_share(const Ground& ground, const TriangleRecord& t, const Site& site, const SpeciesParams& species) {
  return terrain_factor(species.altitude, species.slope, site.altitude, t.slope) *
         mask_share(ground, t, site.offset, species.slope.w);
}

/// The species chosen at a place for a given z; -1 where no plant may stand.
Choice classify_site(const Ground& ground, const TriangleRecord& t, const Site& site, float z, bool next) {
  const Choice nothing{-1, 0.0f};
  if (!site.open) return nothing;
  const vec3 hsv = rgb_to_hsv(vec3(site.encoded));
  TopTwo best = no_species();
  for (size_t i = 0; i < ground.species.size(); ++i) {
    const SpeciesParams& species = ground.species[i];
    float score = score_against(species, vec3(next ? species.next : species.reference), hsv);
    if (score > 0.0f) score = score * species_share(ground, t, site, species);
    best = insert_score(best, int(i), score);
  }
  const Choice choice = choose_species(best, z);
  if (choice.species < 0) return nothing;
  if (!plant_allowed(best, choice, ground.species[size_t(best.first)].kind,
                     ground.species[size_t(choice.species)].kind)) {
    return nothing;
  }
  return choice;
}

/// What a cluster grows; a score below 0 marks one that turns from one species to another.
Choice choose_cluster(const Ground& ground, const TriangleRecord& t, vec2 centre, float z) {
  const Site site = site_at(ground, t, centre);
  const Choice now = classify_site(ground, t, site, z, false);
  if (ground.layer.place.z == 0.0f) return now;
  return blend_choice(ground.layer, now, classify_site(ground, t, site, z, true));
}

bool excluded(std::span<const vec4> texels, uint32_t run, vec2 offset) {
  if (run == 0) return false;
  for (size_t at = run; texels[at].w != k_shape_end; ++at) {
    const vec4 head = texels[at];
    if (head.w == k_shape_disc) {
      if (disc_covers(head, offset)) return true;
      continue;
    }
    bool inside = head.x != 0.0f;
    for (int edges = int(head.y); edges > 0; --edges)
      if (edge_crossed(texels[++at], offset)) inside = !inside;
    if (inside) return true;
  }
  return false;
}

/// Grows the seeds of one record.
class Grower {
 public:
  Grower(const Ground& ground, const FixedTriangles& triangles, const FixedTriangle& triangle,
         const TriangleRecord& record, SeedDistance measure, std::vector<Plant>& plants)
      : ground_(ground),
        triangles_(triangles),
        triangle_(triangle),
        record_(record),
        id_(record.id_low, record.id_high),
        measure_(measure),
        plants_(plants) {}

  void grow_cluster(uint32_t index, uint32_t cluster_size) {
    const Cluster cluster = make_cluster(id_, index);
    Choice choice = choose_cluster(ground_, record_, cluster_centre(id_, index, cluster), cluster.z);
    if (choice.species < 0) return;
    const bool turning = choice.score < 0.0f;
    choice.score = std::abs(choice.score);
    const uint32_t first = index * cluster_size;
    const uint32_t end = min(first + cluster_size, record_.submitted);
    for (uint32_t rank = first; rank < end; ++rank) grow_seed(cluster, choice, turning, rank);
  }

 private:
  /// Height of the drawn surface against the eye's, from the same numbers as the shaders have.
  float relative_height(vec2 point) const {
    const float apex = record_.apex.z;
    const SurfaceWalk walk = begin_walk(apex, apex + record_.to_left.z, apex + record_.to_right.z, point);
    return walk_surface(triangles_, record_.surface, record_.surface_z, walk);
  }

  /// Share of a seed that stands: its own ground has a say, in rules that are sharper than a cluster.
  float seed_share(const SpeciesParams& species, vec2 point, float z, bool turning, uint32_t rank) const {
    const Site site = site_at(ground_, record_, point);
    if (excluded(ground_.exclusions, record_.exclusions, site.offset) || !site.open) return 0.0f;
    const float share = species_share(ground_, record_, site, species) *
                        mask_share(ground_, record_, site.offset, ground_.layer.place.x);
    if (share < 1.0f && standing_number(random_pair(rank, id_)) >= share) return 0.0f;
    const bool now = classify_site(ground_, record_, site, z, false).species >= 0;
    if (ground_.layer.place.z == 0.0f) return now ? 1.0f : 0.0f;
    return season_presence(ground_.layer, now, classify_site(ground_, record_, site, z, true).species >= 0, turning);
  }

  /// What has touched the place makes of the plant.
  PlantTraits disturbed(const PlantTraits& traits, const SpeciesParams& species, glm::dvec2 place) const {
    const sward::Disturbed here = ground_.disturbance->at(place, ground_.eye.value_or(place));
    const shared::Disturbed d{here.press, here.cut, here.burn, here.wet, here.paint};
    const float yielding = yields(species);
    return disturb_traits(traits, d, yielding, share_left(traits, d, yielding));
  }

  void grow_seed(const Cluster& cluster, const Choice& choice, bool turning, uint32_t rank) {
    const SpeciesParams& species = ground_.species[size_t(choice.species)];
    const vec2 point = seed_point(id_, rank, cluster);
    const vec2 offset = offset_from_apex(record_.to_left, record_.to_right, point);
    const float distance =
        measure_ == SeedDistance::near ? 0.0f : seed_distance(record_.apex, offset, relative_height(point));
    const Presence presence = seed_presence(ground_.layer, record_.limit * species.next.w, id_, rank, distance);
    if (!(presence.fade > 0.0f)) return;
    const float share = seed_share(species, point, cluster.z, turning, rank);
    if (!(share > 0.0f)) return;
    PlantTraits traits = make_traits(species, ground_.layer, id_, rank, choice.score);
    traits.height *= height_share(ground_, record_, offset);
    Plant& plant = plants_.emplace_back();
    if (ground_.map == nullptr) {
      plant.axis = triangle_normal(record_.to_left, record_.to_right);
      traits = settle_traits(traits, plant.axis);
    }
    plant.triangle = triangle_.id;
    plant.rank = rank;
    plant.species = uint32_t(choice.species);
    plant.position = {triangle_.apex.x + double(offset.x), triangle_.apex.y + double(offset.y),
                      surface_height(triangles_, triangle_, point.x, point.y)};
    if (ground_.disturbance != nullptr) traits = disturbed(traits, species, glm::dvec2(plant.position));
    plant.height = traits.height;
    plant.width = traits.width;
    plant.stiffness = traits.stiffness;
    plant.azimuth = traits.azimuth;
    plant.score = choice.score;
    plant.fade = presence.fade * share;
  }

  const Ground& ground_;
  const FixedTriangles& triangles_;
  const FixedTriangle& triangle_;
  const TriangleRecord& record_;
  uvec2 id_;
  SeedDistance measure_;
  std::vector<Plant>& plants_;
};

}  // namespace

PlantGround make_mesh_ground(const Layer& layer, const View& view) {
  return {nullptr, make_layer_params(layer, view, {}, 0.0f), make_species_params(layer), {}, {}, {}};
}

PlantGround make_plant_ground(const Layer& layer, const View& view, const ColorMap& map, float sun_azimuth,
                              std::span<const glm::vec4> exclusions) {
  const MapGeometry geometry = classification_map(layer, geometry_of(map));
  PlantGround ground{layer.distribution ? layer.distribution.get() : &map,
                     make_layer_params(layer, view, geometry, sun_azimuth),
                     make_species_params(layer),
                     masks_of(layer),
                     {},
                     exclusions};
  for (size_t i = 0; i < ground.masks.size(); ++i) ground.mask_headers.push_back(mask_header(layer, i, geometry));
  return ground;
}

void grow_triangle(const PlantGround& ground, const FixedTriangles& triangles, size_t i, const TriangleRecord& record,
                   uint32_t clusters, SeedDistance distance, std::vector<Plant>& plants) {
  const FixedTriangle triangle = triangles[i];
  const auto cluster_size = uint32_t(ground.layer.reach.y);
  Grower grower(ground, triangles, triangle, record, distance, plants);
  for (uint32_t cluster = 0; cluster < clusters && cluster * cluster_size < record.submitted; ++cluster) {
    grower.grow_cluster(cluster, cluster_size);
  }
}

float walk_surface(const FixedTriangles& triangles, uint32_t node, float z_offset, shared::SurfaceWalk walk) {
  while (node != 0) {
    const SurfaceNode& split = triangles.nodes()[node];
    node = split.child[walk_turn(walk)];
    walk = walk_down(walk, split.z + z_offset);
  }
  return walk_height(walk);
}

}  // namespace sward
