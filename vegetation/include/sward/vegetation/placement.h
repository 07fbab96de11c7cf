// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/terrain/error.h>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace sward {

/// A grey image over the whole of the base map, of a size of its own, row 0 in the north. As a mask: 0 forbids, 255
/// allows, between them a share of the plants stands. Lookups interpolate between texels, except that nothing at all
/// stands within a texel of 0. Immutable after filling; safe from several threads.
struct SWARD_API GrayMap {
  int width = 0, height = 0;    ///< 1..16384 each.
  std::vector<uint8_t> values;  ///< width * height, by rows.

  Expected<void> validate() const;
};

/// Ground on which nothing stands: a disc or a simple polygon (its edges cross nowhere), world x, y in metres.
struct SWARD_API ExclusionShape {
  std::string layer;                ///< Name of the layer that it is for; empty: all layers.
  glm::dvec2 centre{0};             ///< Of a disc.
  double radius_m = 0;              ///< > 0: a disc, which has no corners. At most 1e6.
  std::vector<glm::dvec2> corners;  ///< Of a polygon, 3..4096 in either direction, the last joins the first.

  static ExclusionShape disc(glm::dvec2 centre, double radius_m);
  static ExclusionShape polygon(std::vector<glm::dvec2> corners);
  /// Fails on numbers that are not finite, on both or neither of disc and polygon, on polygons that cross or touch
  /// themselves or have no area, naming what is wrong and where. Cost: n log n for usual polygons of n corners, the
  /// square of n at worst.
  Expected<void> validate() const;
  /// Whether a place lies inside. A polygon's western and southern edges belong to it.
  bool contains(glm::dvec2 place) const;
};

/// Names a shape in its Exclusions; never reused.
struct ExclusionId {
  uint32_t index = 0, generation = 0;
  bool operator==(const ExclusionId&) const = default;
};

/// The shapes of a host, to be given to seed(): roads, runways, houses. They may change between any two calls of it,
/// and what is seeded next follows; renderers need not know. One thread at a time while it changes; seeding on any
/// threads while it does not.
class SWARD_API Exclusions {
 public:
  /// Fails, keeping nothing, where the shape does not validate.
  Expected<ExclusionId> add(ExclusionShape shape);
  /// Fails, changing nothing, where the shape does not validate or none has the id.
  Expected<void> replace(ExclusionId id, ExclusionShape shape);
  /// Moves a shape by metres east and north. Fails where none has the id or the result would not be finite.
  Expected<void> move(ExclusionId id, glm::dvec2 by);
  /// False where none has the id.
  bool remove(ExclusionId id);
  /// Null where none has the id. Valid until the next change.
  const ExclusionShape* find(ExclusionId id) const;
  size_t size() const { return count_; }
  /// A number that every change changes, and that differs between objects; never 0.
  uint64_t version() const { return version_; }

  /// One of the shapes with its bounds.
  struct Entry {
    ExclusionShape shape;
    glm::dvec2 low{0}, high{0};
    uint32_t generation = 0;
    bool used = false;
  };
  /// All places that ever held a shape; `used` tells which do.
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  Entry* entry(ExclusionId id);
  void changed();

  std::vector<Entry> entries_;
  std::vector<uint32_t> free_;
  size_t count_ = 0;
  uint64_t version_ = 1;
};

}  // namespace sward
