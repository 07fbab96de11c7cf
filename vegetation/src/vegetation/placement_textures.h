// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// The images that a layer's placement rules read.
#include <sward/gl/handles.h>
#include <sward/vegetation/species.h>

#include "vegetation/layer_params.h"

namespace sward {

class PlacementTextures {
 public:
  /// Uploads the layer's masks and distribution map. Fails where the device cannot hold them.
  static Expected<PlacementTextures> create(const Layer& layer);
  /// Before each classification: `map` is what the lookup reads, `base_map_raw` is read where the layer has no
  /// distribution map.
  void follow(const Layer& layer, const MapGeometry& map, GLuint base_map_raw);

  /// RGBA32UI buffer texture; see mask_share in shaders/common_ground_color.glsl.
  GLuint masks() const { return masks_.id(); }
  /// RGBA8, level 0: what classification reads.
  GLuint map() const { return distribution_ ? distribution_.id() : base_map_raw_; }
  size_t gpu_bytes() const { return gl::storage_bytes(buffer_) + gl::storage_bytes(distribution_); }

 private:
  gl::Buffer buffer_;
  gl::Texture masks_, distribution_;
  GLuint base_map_raw_ = 0;
  glm::ivec2 texels_{0};
  glm::dvec2 size_{0};
};

}  // namespace sward
