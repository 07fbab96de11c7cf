// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/terrain/error.h>
#include <sward/terrain/lattice.h>
#include <cstdint>
#include <glm/glm.hpp>
#include <unordered_map>
#include <vector>

namespace sward {

namespace roam {
class Claims;
}

/// A place where an object stands: the triangle drawn there is refined until the drawn ground is within `tolerance_m`
/// of the finest surface (HeightField::height) at `xy`. What has a footprint is several points.
struct NamedPoint {
  uint64_t id = 0;            ///< Chosen by the host; no other point or line of the set has it.
  glm::dvec2 xy{0};           ///< World, metres; on the data, its border included.
  double tolerance_m = 0.05;  ///< >= 0; 0: the finest surface itself.
};

/// A line of sight whose answer on the drawn mesh must be that of TerrainQueries::line_of_sight().
struct NamedLine {
  uint64_t id = 0;            ///< Chosen by the host; no other point or line of the set has it.
  glm::dvec3 from{0}, to{0};  ///< World, metres. What lies beyond the data has no ground to refine.
};

/// Named points and lines of sight, for one mesh or for many over the same lattice (RoamMesh::set_priorities):
/// triangles that hold a point, and those whose wedgie a line crosses, get the artificial maximum as their priority
/// (Duchaineau et al. 1997, sections 6.3 and 6.4). Belongs to the host. One thread at a time, and not while a mesh that
/// it is set for updates; updates only read it, so those of several meshes may run at once.
///
/// What holds after an update in which RoamStats::unmet is 0, at once and also while other vertices move:
///   - where a point's ground is in sight, the drawn ground is within its tolerance of the finest surface;
///   - wherever the triangle under a piece of a line is in sight, that piece is free of the drawn ground exactly where
///     it is free of the finest surface, so a line whose ground is all in sight gets the same answer.
/// Out of sight nothing is refined. Over holes, where there is no ground, nothing holds. Vertices that are demanded do
/// not move to their places (RoamOptions::morph_s), they stand there; given up, they move like all others.
///
/// Cost of an update, beside that of the triangles themselves: for a point that moved, the triangles over it that the
/// old and the new place do not share (35 at most, few for a small step); for a line, the triangles that its wedgies
/// hold; nothing for what stays where it is. An edit of the surface asks all of them anew.
class SWARD_API HostPriorities {
 public:
  /// Of the meshes that it is to be set for: HeightField::lattice(), World::lattice(), Surface::lattice().
  explicit HostPriorities(const Lattice& lattice) : lattice_(lattice) {}
  // Meshes refer to it.
  HostPriorities(const HostPriorities&) = delete;
  HostPriorities& operator=(const HostPriorities&) = delete;

  /// Takes effect at each mesh's next update. Fails, changing nothing, when the id is in use, a number is not finite,
  /// the point lies outside of the data or its tolerance is negative.
  Expected<void> add(const NamedPoint& point);
  Expected<void> add(const NamedLine& line);
  /// Gives a point or a line of that id its new place. Fails, changing nothing, when there is none of that id and kind,
  /// and as add() does. Cost: a look-up.
  Expected<void> move(const NamedPoint& point);
  Expected<void> move(const NamedLine& line);
  /// Fails when there is no such point or line.
  Expected<void> remove(uint64_t id);
  void clear();

  bool contains(uint64_t id) const { return slots_by_id_.contains(id); }
  size_t size() const { return slots_by_id_.size(); }
  const Lattice& lattice() const { return lattice_; }

 private:
  friend class roam::Claims;
  static constexpr uint32_t k_no_slot = 0xffffffffu;
  enum class Kind : uint8_t { none, point, line };
  struct Place {
    Kind kind = Kind::none;
    glm::dvec2 from{0}, to{0};  // lattice units, x east, y south
    double from_z = 0, to_z = 0;
    double tolerance = 0;
    bool operator==(const Place&) const = default;
  };
  // In a list from the one that was changed last to the one that was changed first, so that a mesh finds what changed
  // since it last looked. Slots that are free stay in it.
  struct Slot {
    Place place;
    uint64_t revision = 0;  // of its last change
    uint32_t newer = k_no_slot, older = k_no_slot;
  };

  Expected<Place> place_of(const NamedPoint& point) const;
  Expected<Place> place_of(const NamedLine& line) const;
  Expected<void> add(uint64_t id, const Expected<Place>& place);
  Expected<void> move(uint64_t id, const Expected<Place>& place);
  void set(uint32_t slot, const Place& place);

  Lattice lattice_;
  std::vector<Slot> slots_;
  std::vector<uint32_t> free_;
  std::unordered_map<uint64_t, uint32_t> slots_by_id_;
  uint32_t newest_ = k_no_slot;
  uint64_t revision_ = 0;
};

}  // namespace sward
