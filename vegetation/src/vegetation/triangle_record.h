// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// The static part of a triangle's record: the same whoever asks, for whatever view.
#include <sward/vegetation/mesh_surface.h>
#include <sward/vegetation/seeding.h>

#include "vegetation/layer_params.h"

namespace sward {

class RecordMaker {
 public:
  RecordMaker(const Layer& layer, const ColorMap& map);
  /// For pieces of a mesh, whose colours the records carry in place of texels.
  RecordMaker(const Layer& layer, const MeshSurface& surface);
  /// Everything but apex, limit, surface_z, submitted and exclusions.
  TriangleRecord make(const FixedTriangles& triangles, size_t i) const;

 private:
  void locate_apex(glm::dvec3 apex, TriangleRecord& record) const;

  const MeshSurface* surface_ = nullptr;
  glm::dvec2 min_corner_{0}, size_{1};
  glm::ivec2 texels_{1};
  bool slopes_;
};

}  // namespace sward
