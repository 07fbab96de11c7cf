// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The bintree of Papavasiliou (2015), section 3.1, over heights that are known only where they have been asked for:
// down to chunks it is culled as a slab between the least and the greatest height, chunks by the heights they have.
#include <sward/terrain/host_terrain.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "fixed_level.h"
#include "host_chunk.h"

namespace sward {

struct HostTerrain::Impl {
  HostHeight height;
  HostTerrainDesc desc;
  Lattice lattice;
  roam::SurfaceHistory history;
};

namespace roam {

namespace {

constexpr int k_raster_bits = 17;
constexpr double k_largest_root_m = 8192, k_largest_side_m = 8.0e6;
constexpr int k_most_roots = 1024;

class HostWalk final : public ChunkSource {
 public:
  HostWalk(const HostHeight& height, const HostTerrainDesc& desc, const Lattice& lattice, const View& view,
           const FixedLevelOptions& options)
      : ChunkSource(lattice, view, options),
        desc_(desc),
        heights_(height, lattice),
        middle_z_(0.5 * (desc.low.z + desc.high.z)),
        half_z_(0.5 * (desc.high.z - desc.low.z)) {}

  void run(int chunk_level, std::vector<ChunkVisit>& visits) const override {
    visits.clear();
    const glm::ivec2 first = square_at(glm::dvec2(-1, 1)), last = square_at(glm::dvec2(1, -1));
    for (int row = first.y; row <= last.y; ++row)
      for (int column = first.x; column <= last.x; ++column)
        for (int root = 0; root < 2; ++root) {
          const TriangleId id = TriangleId::root(root, {column, row});
          const TriangleCorners c = corners_of(id);
          const uint64_t number = 2 * (uint64_t(row) * uint64_t(lattice().root_squares.x) + uint64_t(column)) + root;
          visit({chunk_level, number, visits}, {id, slab_corner(c.apex), slab_corner(c.left), slab_corner(c.right)},
                k_all_halfspaces);
        }
  }

  bool refresh(ChunkVisit& visit, int depth, Chunk& chunk) const override {
    const bool stale = !chunk.has_static || chunk.altitude.empty() == options().altitudes;
    if (stale) {
      const HostChunkOptions with{desc_.foot_error_m, desc_.foot_splits, options().altitudes};
      build_host_chunk(heights_, with, visit, depth, chunk);
    }
    // From here on the chunk is as high as its own ground.
    for (DrawnCorner* c : {&visit.triangle.apex, &visit.triangle.left, &visit.triangle.right})
      *c = corner(c->lattice, {c->world.x, c->world.y, chunk.corner_z[0]});
    visit.bound = chunk.reach;
    return stale;
  }

  /// The host is called on the calling thread alone.
  bool refreshes_side_by_side() const override { return false; }

  ExactTriangle exact(const ChunkVisit& visit, int, const Chunk& chunk, unsigned index) const override {
    const glm::dvec3 apex = chunk.apex[index];
    const DrawnTriangle t{visit.triangle.id, corner({}, apex), corner({}, apex + glm::dvec3(chunk.to_left[index])),
                          corner({}, apex + glm::dvec3(chunk.to_right[index]))};
    unsigned active = visit.active;
    if (culled(t, double(chunk.bound[index]), active) || faces_away(t)) return {};
    return measure(t);
  }

 private:
  struct Run {
    int chunk_level;
    uint64_t root;
    std::vector<ChunkVisit>& visits;
  };

  DrawnCorner slab_corner(LatticePoint p) const { return corner(p, {lattice().world_xy(p), middle_z_}); }

  // The root square that holds the horizon's outermost place in a direction, or the nearest.
  glm::ivec2 square_at(glm::dvec2 direction) const {
    const glm::dvec2 xy = glm::dvec2(view().eye) + direction * double(options().horizon_m);
    const glm::dvec2 square = glm::floor(lattice().extended_from_world(xy) / double(k_root_side));
    return glm::ivec2(glm::clamp(square, glm::dvec2(0), glm::dvec2(lattice().root_squares - 1)));
  }

  void visit(const Run& run, const DrawnTriangle& t, unsigned active) const {
    if (culled(t, half_z_, active)) return;
    if (t.id.level() == run.chunk_level) {
      run.visits.push_back({t, k_none, active, 0, chunk_key(run.root, t.id)});
      return;
    }
    const DrawnCorner m = middle(t.left, t.right);
    for (int turn = 0; turn < 2; ++turn) visit(run, child(t, turn, m), active);
  }

  const HostTerrainDesc& desc_;
  mutable HostHeights heights_;
  double middle_z_, half_z_;
};

bool finite(glm::dvec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

Expected<void> check(const HostHeight& height, const HostTerrainDesc& desc) {
  if (!height) return fail("the host's terrain has no height function; give it one");
  const glm::dvec3 size = desc.high - desc.low;
  if (!finite(desc.low) || !finite(desc.high) || !(size.x > 0) || !(size.y > 0) || !(size.z >= 0))
    return fail(
        "the box of the host's terrain is empty or not finite; give its western, southern and eastern, northern "
        "corners with the least and greatest height");
  const double longest = std::max(size.x, size.y), shortest = std::min(size.x, size.y);
  if (longest > k_largest_side_m)
    return fail("the host's terrain is " + std::to_string(longest / 1000) + " km long, at most " +
                std::to_string(k_largest_side_m / 1000) + " are possible; give the part around the flight");
  if (longest > k_most_roots * shortest)
    return fail("the box of the host's terrain is more than " + std::to_string(k_most_roots) +
                " times as long as wide; make it wider, where the callback answers NaN");
  if (!(desc.foot_error_m > 0) || !std::isfinite(desc.foot_error_m) || desc.foot_splits < 0 || desc.foot_splits > 8)
    return fail("foot_error_m must be above 0 and foot_splits 0 to 8");
  return {};
}

// Root squares of nearly equal sides that fill the box.
Lattice lattice_over(const HostTerrainDesc& desc) {
  const glm::dvec2 size(desc.high - desc.low);
  const double side = std::min({k_largest_root_m, size.x, size.y});
  Lattice lattice;
  lattice.root_bits = k_raster_bits;
  lattice.root_squares = glm::clamp(glm::ivec2(glm::round(size / side)), 1, k_most_roots);
  lattice.columns = (lattice.root_squares.x << k_raster_bits) + 1;
  lattice.rows = (lattice.root_squares.y << k_raster_bits) + 1;
  lattice.spacing = size / glm::dvec2(lattice.columns - 1, lattice.rows - 1);
  lattice.origin = 0.5 * (desc.low + desc.high);
  lattice.max_level = k_max_level;
  return lattice;
}

}  // namespace

}  // namespace roam

Expected<HostTerrain> HostTerrain::create(HostHeight height, const HostTerrainDesc& desc) {
  if (auto valid = roam::check(height, desc); !valid) return tl::unexpected(valid.error());
  return HostTerrain(std::make_unique<Impl>(Impl{std::move(height), desc, roam::lattice_over(desc), {}}));
}

HostTerrain::HostTerrain(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
HostTerrain::HostTerrain(HostTerrain&&) noexcept = default;
HostTerrain& HostTerrain::operator=(HostTerrain&&) noexcept = default;
HostTerrain::~HostTerrain() = default;

const Lattice& HostTerrain::lattice() const {
  return impl_->lattice;
}

void HostTerrain::changed(glm::dvec2 low, glm::dvec2 high) {
  SWARD_ASSERT(roam::finite({low, 0}) && roam::finite({high, 0}) && low.x <= high.x && low.y <= high.y,
               "what has changed must be a finite rectangle");
  const Lattice& lattice = impl_->lattice;
  const glm::dvec2 last(lattice.last());
  const glm::dvec2 nw = lattice.extended_from_world({low.x, high.y}), se = lattice.extended_from_world({high.x, low.y});
  if (nw.x > last.x || nw.y > last.y || se.x < 0 || se.y < 0) return;
  impl_->history.changed({glm::ivec2(glm::clamp(glm::floor(nw), glm::dvec2(0), last)),
                          glm::ivec2(glm::clamp(glm::ceil(se), glm::dvec2(0), last))});
}

Expected<void> HostTerrain::fixed_level_triangles(const View& view, const FixedLevelOptions& options,
                                                  FixedTriangles& out) const {
  SWARD_ASSERT(options.level >= 0 && options.level <= k_max_level, "level must be in [0, k_max_level]");
  if (auto valid = view.validate(); !valid) return valid;
  const roam::HostWalk walk(impl_->height, impl_->desc, impl_->lattice, view, options);
  roam::collect_fixed_level(walk, impl_->history.state(), out);
  return {};
}

}  // namespace sward
