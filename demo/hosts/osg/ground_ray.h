// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "host/scene_terrain.h"

namespace sward::osg_host {

struct GroundHit {
  double ratio = 0;            ///< Along the segment: 0 at its start, 1 at its end.
  glm::dvec3 point{0};         ///< World, metres.
  glm::dvec3 normal{0, 0, 1};  ///< Unit, upwards.
};

/// Where a segment (world, metres) meets the ground, nearest first; `first_only` stops at the first. Over a field the
/// answers are exact (TerrainQueries); over a world they are of the finest squares that are resident, and ground that
/// is met and left again within one sample's spacing is missed. Any thread. Cost: microseconds a hit; over a world some
/// 0.1 microseconds for each sample that is passed over.
std::vector<GroundHit> meet_ground(const host::SceneTerrain& terrain, glm::dvec3 from, glm::dvec3 to, bool first_only);

/// What meet_ground() does over worlds: heights of a surface, a sample's spacing apart.
std::vector<GroundHit> march_over(const Surface& surface, glm::dvec3 from, glm::dvec3 to, bool first_only);

}  // namespace sward::osg_host
