// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/color_map.h>
#include <sward/vegetation/species.h>
#include <memory>
#include <span>
#include <vector>

#include "vegetation/layer_params.h"

namespace sward {

/// Least and greatest of each component; a hue is in turns and may be unknown.
struct HsvRange {
  glm::vec3 least{0}, greatest{0};
  bool any_hue = true;
};

/// All colours, as rgb_to_hsv gives them, of encoded colours between two corners (0..1).
HsvRange hsv_range(glm::vec3 least, glm::vec3 greatest);

/// Whether species can grow on every colour of a range, some, or none: false only where no growing species can be among
/// the two best, whatever the place. `next`: by the references of the season's next step.
bool can_grow(std::span<const shared::SpeciesParams> species, const HsvRange& range, bool next);

/// Which tiles of a layer's classification map can feed any of its species (CONTRACT's coarse table). Tiles are judged
/// when they are first asked for. Without bounds of colours all can.
class FertileGround {
 public:
  /// Keeps what is known while the map's bounds and the species are the same as before.
  void follow(const Layer& layer, const ColorMap& map);
  /// Whether nothing can grow on a triangle, named by its corners in the world (x, y).
  bool barren(glm::dvec2 apex, glm::dvec2 left, glm::dvec2 right);

 private:
  enum class Verdict : uint8_t { unknown, fertile, barren };
  bool tile_is_barren(size_t tile);
  bool judge(size_t tile) const;

  std::shared_ptr<const ColorBounds> bounds_;
  glm::ivec2 texels_{0};
  glm::dvec2 corner_{0}, texels_per_m_{1};  ///< The map's north-western corner; east and south.
  std::vector<shared::SpeciesParams> species_;
  bool references_move_ = false;
  std::vector<Verdict> verdicts_;
};

}  // namespace sward
