// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/terrain/bounds.h>
#include <sward/terrain/fixed_triangles.h>
#include <sward/terrain/host_priorities.h>
#include <sward/terrain/surface.h>
#include <sward/terrain/view.h>
#include <memory>
#include <span>

namespace sward {

struct RoamOptions {
  /// Most triangles drawn in a frame, those of the root mesh included.
  uint32_t max_triangles = 20000;
  /// Stop refining when RoamMesh::bound_px() at rest is at most this many pixels. 0: spend the whole budget.
  float target_px = 0;
  /// An exchange (one merge for one split) is made only if it lowers the maximum by more than this share.
  float hysteresis = 0.01f;
  /// Most seconds an update may take; the mesh is valid after that and the next frame goes on. 0: no cap.
  double time_cap_s = 0;
  /// Seconds in which a new vertex moves to its place, and a vertex that is given up to the surface without it. 0: no
  /// morph. Decisions then keep a 24th of the budget for triangles that are still on their way out.
  float morph_s = 0.25f;
  /// The algorithm as published in 1997, for comparison: every priority in every frame, no morph.
  bool plain = false;
};

/// Counts of one update.
struct RoamStats {
  uint32_t visible = 0;  ///< Triangles drawn; never above the budget.
  uint32_t leaves = 0;   ///< All leaves, visible or not.
  uint32_t splits = 0;   ///< Diamonds split in this update.
  uint32_t merges = 0;
  uint32_t looked_at = 0;  ///< Nodes whose wedgie was projected anew.
  uint32_t moving = 0;     ///< Vertices between two heights.
  bool capped = false;     ///< Ended early: the time cap, or much that a loaded square set free. Later updates go on.
  /// Triangles in sight that a named point or line wants split (set_priorities()) and that are not: the budget is used
  /// up by what is named and what crosses the near plane, the time cap ended the update, or data are not resident.
  uint32_t unmet = 0;
};

/// A vertex as the GPU gets it, relative to RoamMesh::origin(). Slots are stable while the vertex lives.
/// Drawn at height mix(from_z, position.z, clamp((RoamMesh::morph_time() - start_s) * per_second, 0, 1)).
struct RoamVertex {
  glm::vec3 position{0};         ///< Metres, relative to origin().
  glm::vec2 relief_gradient{0};  ///< dz/dx, dz/dy of the relief alone, to be added to the slope map's.
  float from_z = 0;              ///< Height at which the vertex begins to move, relative to origin().
  float start_s = 0;             ///< When it begins, seconds on the clock of RoamMesh::morph_time().
  float per_second = 0;          ///< 1 / duration.
};

/// An incrementally optimal triangle bintree (Duchaineau et al. 1997): a split queue of leaves and a merge queue of
/// diamonds ordered by projected wedgie thickness in pixels. No cracks, ever; deterministic. One thread at a time.
class SWARD_API RoamMesh {
 public:
  /// `bounds` and its field must outlive the mesh. Fails when the budget is below the root mesh, naming both numbers.
  static Expected<RoamMesh> create(const Bounds& bounds, const RoamOptions& options);
  /// The same over any surface, which must outlive the mesh.
  static Expected<RoamMesh> create(const Surface& surface, const RoamOptions& options);
  RoamMesh(RoamMesh&&) noexcept;
  RoamMesh& operator=(RoamMesh&&) noexcept;
  ~RoamMesh();

  /// Adapts the mesh to a view. `time_s` is the host's clock in seconds: vertices move by it (RoamOptions::morph_s).
  /// When it was set back, what moves arrives at once. Fails, changing nothing, when the view or the time is not valid.
  Expected<RoamStats> update(const View& view, double time_s);
  /// The same without a clock: every vertex stands at its final height at once.
  Expected<RoamStats> update(const View& view);

  /// Heights or bounds have changed within the box (an edit): they are read again in the next update. Cost: that of the
  /// mesh there.
  void surface_changed(const LatticeBox& box);
  /// Only what can be split has changed within the box (a world has loaded or dropped a part): in the next update
  /// splits that are not allowed any more are undone, and leaves that could not be split are tried again. What is set
  /// free is split over several updates: an update then changes some per cent of the mesh, and more in each that
  /// follows until the mesh is what its view asks for. A count, not a clock: the same in every run.
  void residency_changed(const LatticeBox& box);

  /// From the next update on what `priorities` names is refined before everything else but what crosses the near plane,
  /// which is its equal: other triangles are given up for it, RoamOptions::max_triangles stays exact, and when it is
  /// not enough RoamStats::unmet counts what is missing. `priorities` must outlive the mesh or be taken away with null;
  /// it may be set for several meshes. Fails, changing nothing, when its lattice is another one.
  Expected<void> set_priorities(const HostPriorities* priorities);

  /// Changes the budget or the target; takes effect at the next update. Fails as create does.
  Expected<void> set_options(const RoamOptions& options);
  const RoamOptions& options() const;

  /// Proven bound of the projected error of what the last update draws, over its visible leaves, pixels: the distance
  /// from each triangle to the surface, which its wedgie bounds at either side, so between a half and all of the
  /// largest wedgie's thickness (Duchaineau et al. 1997, 6.2); for those whose corners move the distance to the surface
  /// that these have left as well. k_artificial_max when a wedgie crosses the near plane. Cost: about a microsecond a
  /// moving vertex.
  float bound_px() const;
  static constexpr float k_artificial_max = 1.0e9f;

  // What a renderer draws; spans are valid until the next call that is not const.

  /// Names the result of the last update: one more after every successful update (creation counts as one), and never
  /// the same number for two meshes of a process. A renderer sees by it whether it missed an update.
  uint64_t revision() const;
  /// World position that vertices are relative to. Changes (all vertices then count as changed) when the eye has gone
  /// more than a kilometre from it.
  glm::dvec3 origin() const;
  /// All vertex slots, dead ones included.
  std::span<const RoamVertex> vertices() const;
  /// Slots written since the last update began, unordered, without repeats.
  std::span<const uint32_t> changed_vertices() const;
  /// True when origin() changed: every slot was rewritten.
  bool all_vertices_changed() const;
  /// Seconds on the clock of RoamVertex::start_s at the last update.
  float morph_time() const;
  /// Visible leaves: three vertex slots each, counter-clockwise from above. A triangle keeps its place while it is
  /// visible; only when their number falls do the last ones move into the gaps.
  std::span<const uint32_t> visible_indices() const;
  /// Triangles (thirds of visible_indices()) written since the last update began, unordered, without repeats; some may
  /// lie beyond the end.
  std::span<const uint32_t> changed_triangles() const;
  /// All leaves that are not padding, in the same form; built on demand.
  std::vector<uint32_t> all_indices() const;
  /// World position of a vertex slot as drawn at the last update, double precision.
  glm::dvec3 vertex_world(uint32_t slot) const;

  /// Culled triangles of one level, on the surface of the last update, for that view. Clears `out` first.
  void fixed_level_triangles(const FixedLevelOptions& options, FixedTriangles& out) const;

  /// Checks the whole structure: neighbours symmetric, no T-junction, corners and vertices consistent, queue
  /// membership, flags, counts. O(leaves). Fails naming the first fault.
  Expected<void> validate() const;

 private:
  struct Impl;
  explicit RoamMesh(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace sward
