// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/terrain/error.h>
#include <sward/terrain/fixed_triangles.h>
#include <sward/terrain/lattice.h>
#include <sward/terrain/view.h>
#include <functional>
#include <memory>

namespace sward {

/// Height of a host's ground at world x, y (metres), metres, world. NaN or infinite: there is no ground.
///
/// Answers the same for the same place until HostTerrain::changed() tells otherwise, best what the host draws there:
/// plants stand on it. Must not throw.
using HostHeight = std::function<double(glm::dvec2 xy)>;

/// Where a host's ground lies, and how closely plants follow it.
struct HostTerrainDesc {
  glm::dvec3 low{0};   ///< Western, southern corner and least height, world, metres.
  glm::dvec3 high{0};  ///< Eastern, northern corner and greatest height. Ground outside of these heights is not lost,
                       ///< but may be culled while it is in sight.
  /// A layer's triangles are split where the ground is seen to leave their plane by more than this, metres, > 0.
  float foot_error_m = 0.02f;
  /// At most so many times, 0..8; every second one halves the distance between heights. 6 takes grass on triangles of
  /// 1.6 m2 to heights 0.22 m apart, trees on triangles of 1000 m2 to 5.6 m. 0: plants stand on the flat triangles.
  int foot_splits = 6;
};

/// A host's own terrain as a source of triangles to seed: heights through a callback, no mesh, nothing drawn.
///
/// The box is covered exactly by root squares of at most some 12 km, bisected as ROAM's are, so that ids, x and y of
/// the triangles of a level, and with them the plants, are functions of the box alone, heights of the callback's.
/// Three heights at its corners make a triangle, three between them and those below say whether and where it is split.
/// Triangles with a place among these that has no ground are left out: holes have edges as coarse as that. Areas and
/// slopes are the triangles' own.
class SWARD_API HostTerrain {
 public:
  /// Fails on a box that is empty, not finite, or more than 1024 times as long as wide, on sides beyond 8000 km, and on
  /// feet out of range.
  static Expected<HostTerrain> create(HostHeight height, const HostTerrainDesc& desc);
  HostTerrain(HostTerrain&&) noexcept;
  HostTerrain& operator=(HostTerrain&&) noexcept;
  ~HostTerrain();

  /// For level_for_area() and corners_of(). Its samples are nothing but a fine raster over the box.
  const Lattice& lattice() const;

  /// The host's ground is another within this rectangle (western, southern and eastern, northern corner, world, metres;
  /// finite, asserted): a tile was loaded, refined, edited. Its heights are asked for again when they are next in view.
  /// Not while another thread is in fixed_level_triangles().
  void changed(glm::dvec2 low, glm::dvec2 high);

  /// Triangles of options.level in [0, k_max_level] (asserted) that the view sees: by frustum, horizon and facing, as
  /// RoamMesh's. Replaces what `out` holds. Fails, leaving it alone, when the view is not valid.
  ///
  /// Heights are kept in `out`, in groups of up to 64 triangles, until these have been out of view for 60 calls: keep
  /// one `out` for each layer and view. The callback is called here alone, on the calling thread, for groups that come
  /// into view. Const: several threads may call, each with its own `out`, if the callback bears that. Cost: some 3
  /// microseconds a group in view, and some 200 heights a new one.
  Expected<void> fixed_level_triangles(const View& view, const FixedLevelOptions& options, FixedTriangles& out) const;

 private:
  struct Impl;
  explicit HostTerrain(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace sward
