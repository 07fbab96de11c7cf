// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/terrain/color_map.h>
#include <sward/terrain/fixed_triangles.h>
#include <sward/terrain/view.h>
#include <sward/vegetation/mesh_surface.h>
#include <sward/vegetation/placement.h>
#include <sward/vegetation/species.h>
#include <array>
#include <memory>

namespace sward {

/// A triangle as every stage after seeding sees it: six RGBA32 texels of a buffer texture. Everything that decides
/// what stands where is static (id, edges, texel position, limit); what moves with the eye is the apex and, for the
/// laws of the screen, the limit.
struct TriangleRecord {
  glm::vec3 apex{0};  ///< Relative to the eye, metres.
  uint32_t id_low = 0;
  glm::vec3 to_left{0};
  uint32_t id_high = 0;
  glm::vec3 to_right{0};
  uint32_t surface = 0;         ///< Root node in the surface buffer, 0: flat.
  glm::ivec2 texel{0};          ///< Base-map texel of the apex, integer part (floor) of (u width, v height) ...
  glm::vec2 texel_fraction{0};  ///< ... and the rest; offsets in metres are scaled by LayerParams::map. On meshes both
                                ///< hold colours instead (shaders/common_surface.glsl).
  float limit = 0;         ///< distance law: area * rho0, the seeds at full density; else: the triangle's seed count n.
  float slope = 0;         ///< Of the data, radians, where a species asks for it; static.
  float surface_z = 0;     ///< Add to SurfaceNode::z to get z relative to the eye.
  uint32_t submitted = 0;  ///< Seeds submitted for this triangle.
  glm::vec3 altitude{0};   ///< World z of the data at apex, left, right; static.
  uint32_t exclusions = 0;  ///< First texel of its run in Seeding::exclusions, 0: none.
};
static_assert(sizeof(TriangleRecord) == 96);

/// One instanced draw: `triangles` records from `first`, `clusters` instances each.
struct DensityBin {
  uint32_t first = 0, triangles = 0, clusters = 0;  ///< clusters: ceil(upper edge / cluster size), 0 if empty.
};

class ExclusionIndex;
class FertileGround;

/// Result of seeding a layer for one view: plain arrays, uploaded as they are.
struct Seeding {
  std::vector<TriangleRecord> records;  ///< By bin, largest count first; within a bin from near to far.
  std::array<DensityBin, k_density_bins>
      bins{};                    ///< In drawing order: largest count first; empty bins have 0 triangles.
  uint32_t clusters = 0;         ///< Clusters that the bins submit.
  float n_min = 0, n_max = 0;    ///< Smallest and largest count of this frame.
  double surface_z_origin = 0;   ///< FixedTriangles::surface_z(), for the CPU twin.
  std::vector<uint32_t> source;  ///< Index in FixedTriangles of each record.
  /// Excluded shapes near the triangles, a run of texels each (shaders/common_placement.glsl); the first is an end.
  std::vector<glm::vec4> exclusions;

  /// What seed() keeps a triangle while it counts: scratch, meaningless to others.
  struct Count {
    float limit = 0;
    uint32_t submitted = 0, bin = 0, exclusions = 0;
  };
  std::vector<Count> counts;
  /// Scratch too, and not copied with the rest.
  struct Scratch {
    std::shared_ptr<ExclusionIndex> index;
    std::shared_ptr<FertileGround> ground;
    std::vector<uint32_t> near_first;
    Scratch() = default;
    Scratch(const Scratch&) {}
    Scratch& operator=(const Scratch&) { return *this; }
    Scratch(Scratch&&) = default;
    Scratch& operator=(Scratch&&) = default;
  };
  Scratch scratch;
};

/// Seeds that a triangle is given by the layer's law, not rounded: it submits the next whole number. 0 beyond the
/// horizon (horizon_m times zoom). With A the static area, d the distance to its nearest point, d0 full_distance_m
/// times zoom:
///   distance     A density                       to d0, then A density (d0 / d)^falloff
///   screen_area  min(density S^falloff, ceiling) S the projected area; the ceiling behind the near plane
///   world_area   min(density W (-n . v) / (|v|^2 |v|), ceiling)  W, n: area and normal of the drawn triangle, v from
///                the eye to its centre; 0 where it faces away
/// These two are equations 1 and 2 in plain layers. In others |v| counts as 2 d0 at least, the cosine -n . v / |v| = c
/// as (c + sqrt(c^2 + 1/4)) / 2, and screen_area takes for S what the second law has, times the squared focal length:
/// the projected area in the picture's middle, which does not change when the head turns.
SWARD_API float seed_limit(const Layer& layer, const View& view, const FixedTriangle& triangle);

/// Upper edges of the 32 geometric bins between n_min (>= 1) and n_max (>= n_min), smallest first:
/// e_i = n_min (n_max/n_min)^((i+1)/32); the last is n_max itself.
SWARD_API std::array<float, k_density_bins> bin_edges(float n_min, float n_max);

/// Counts, bins and lays out. Clears `out` first; allocates only when a frame needs more than any before. Cost: linear
/// in the triangles. Triangles without seeds get no record, nor do those that `exclusions` cover; the others carry the
/// shapes near them. Layers of which needs_altitudes() is true want triangles that have them. Any thread, one `out` a
/// thread.
SWARD_API void seed(const Layer& layer, const View& view, const ColorMap& map, const FixedTriangles& triangles,
                    Seeding& out, const Exclusions* exclusions = nullptr);

/// The same for a layer on a mesh (Layer::on_mesh, asserted), whose `triangles` that mesh wrote. Excluded shapes are
/// places on the ground: they do not reach it.
SWARD_API void seed(const Layer& layer, const View& view, const MeshSurface& surface, const FixedTriangles& triangles,
                    Seeding& out);

}  // namespace sward
