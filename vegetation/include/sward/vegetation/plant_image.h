// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/terrain/error.h>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace sward {

/// A grey image on a plant: its detail or its cutout (Species::detail, Species::cutout). Columns run across the plant,
/// row 0 is its tip. Immutable, safe from several threads; several species and layers may share one.
class SWARD_API PlantImage {
 public:
  /// Copies width * height greys, by rows. Fails unless width and height are powers of two from 8 to 2048 and `greys`
  /// is of that size, saying what to do.
  static Expected<std::shared_ptr<const PlantImage>> create(int width, int height, std::span<const uint8_t> greys);

  int width() const { return width_; }
  int height() const { return height_; }
  std::span<const uint8_t> greys() const { return greys_; }

 private:
  PlantImage(int width, int height, std::span<const uint8_t> greys);

  int width_, height_;
  std::vector<uint8_t> greys_;
};

/// Details that are generated: "veins" along a blade beside its rib, "fibres" of straw and bark, "mottled" old leaves.
SWARD_API std::span<const std::string_view> built_in_details();

/// One of built_in_details(), 256 x 256, its mean half grey, seamless from tip to root; null for any other name. Any
/// thread. Cost: a millisecond the first time.
SWARD_API std::shared_ptr<const PlantImage> built_in_detail(std::string_view name);

}  // namespace sward
