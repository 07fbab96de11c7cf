// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/terrain/bounds.h>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>

namespace sward {

/// Where an edit acts, world metres.
struct SWARD_API EditRegion {
  enum class Shape { disc, rectangle };
  Shape shape = Shape::disc;
  glm::dvec2 centre{0.0};
  /// Disc: x is the radius, y is not used. Rectangle along the axes: half its sides. > 0.
  glm::dvec2 half_size{10.0};
  /// Distance from the border inwards over which the effect rises smoothly from nothing to full. >= 0; 0: a hard edge.
  double soft_edge = 0;

  static EditRegion disc(glm::dvec2 centre, double radius, double soft_edge = 0) {
    return {Shape::disc, centre, glm::dvec2(radius), soft_edge};
  }
  static EditRegion rectangle(glm::dvec2 low, glm::dvec2 high, double soft_edge = 0) {
    return {Shape::rectangle, 0.5 * (low + high), 0.5 * (high - low), soft_edge};
  }
  /// Share of the effect at a place, 0 (outside) to 1.
  double weight(glm::dvec2 xy) const;
};

struct Edit {
  enum class Kind {
    raise,    ///< By `metres`.
    lower,    ///< By `metres`.
    flatten,  ///< To the world height `metres`.
    crater,   ///< A bowl `metres` deep within a rim; discs only. The crest stands at 0.75 of the radius.
  };
  Kind kind = Kind::raise;
  EditRegion region;
  double metres = 1;
  double rim_share = 0.2;  ///< Crater: height of the crest over the ground before, against the depth. >= 0.
};

struct EditResult {
  /// Covers every lattice point whose height or relief may have changed: for RoamMesh::surface_changed(). Bounds also
  /// changed around it: see Bounds::affected(). Empty when no sample changed.
  LatticeBox changed;
  int64_t samples = 0;  ///< Samples that changed.
  int64_t clamped = 0;  ///< 16-bit samples that should have gone below 0 or above 65535, and stay there.
};

/// Changes samples of the field in place and re-computes relief and bounds around them, so that both are, bit by bit,
/// those of the edited samples. `bounds` is the field's (asserted). Neither may be in use meanwhile, by queries or by
/// mesh updates; afterwards hand `changed` to every mesh (RoamMesh::surface_changed()), and to what was made from the
/// field's slopes (gl::GroundTextures::update_slopes()).
///
/// 16-bit fields stay 16-bit: heights are rounded to whole raw units and clamped to what the format holds, because a
/// conversion would double the memory and change heights that were not edited; `clamped` tells. Holes stay holes; what
/// they are filled with is edited like any sample, not filled anew. height_range() and relief_amplitude() are widened,
/// never narrowed.
///
/// Cost: some 100 ns a sample of the region and 100 us at least (diamonds of all coarser levels); beyond that it does
/// not depend on the field's size.
/// Fails, changing nothing, when the region or the numbers are not valid, when the region lies outside of the field,
/// and when heights would span more than 262144 m or not be finite. A region between samples changes none.
SWARD_API Expected<EditResult> edit(HeightField& field, Bounds& bounds, const Edit& edit);

/// New height in world metres of the sample at world `xy` whose height is `z`; blended in by the region's weight.
using HeightFunction = std::function<double(glm::dvec2 xy, double z)>;
SWARD_API Expected<EditResult> edit(HeightField& field, Bounds& bounds, const EditRegion& region,
                                    const HeightFunction& height);

}  // namespace sward
