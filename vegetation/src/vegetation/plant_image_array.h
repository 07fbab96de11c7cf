// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// The images on a layer's plants as one texture.
#include <sward/gl/handles.h>
#include <sward/vegetation/species.h>

namespace sward {

inline constexpr int k_plant_image_side = 256;

/// Levels of an image of k_plant_image_side, the whole one first, each half as large; the last is 1 x 1. Of a cutout
/// every level covers, above half grey, as much as the first, so that leaves do not thin out with distance.
std::vector<std::vector<uint8_t>> plant_image_levels(const PlantImage& image, bool cutout);

class PlantImageArray {
 public:
  /// Uploads the details and cutouts of the layer's species, each once.
  static PlantImageArray create(const Layer& layer);
  /// R8 array, k_plant_image_side a side, with mip levels; one empty image where the layer has none.
  GLuint texture() const { return texture_.id(); }
  size_t gpu_bytes() const { return gl::storage_bytes(texture_); }
  /// What common_plant_image.glsl reads of a species: number of its detail or -1, strength, repeats along the plant,
  /// number of its cutout or -1.
  glm::vec4 of(const Species& species) const;

 private:
  float number(const PlantImage* image, bool cutout) const;

  struct Entry {
    const PlantImage* image;
    bool cutout;
    bool operator==(const Entry&) const = default;
  };
  std::vector<Entry> entries_;
  gl::Texture texture_;
};

}  // namespace sward
