// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// The static part of a triangle's record: the same whoever asks, for whatever view.
#include <sward/vegetation/seeding.h>

#include "vegetation/layer_params.h"

namespace sward {

class RecordMaker {
 public:
  RecordMaker(const Layer& layer, const ColorMap& map);
  /// Everything but apex, limit, surface_z, submitted and exclusions.
  TriangleRecord make(const FixedTriangles& triangles, size_t i) const;

 private:
  void locate_apex(glm::dvec3 apex, TriangleRecord& record) const;

  glm::dvec2 min_corner_, size_;
  glm::ivec2 texels_;
  bool slopes_;
};

}  // namespace sward
