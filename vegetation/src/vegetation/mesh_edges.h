// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <span>

namespace sward {

struct EdgeCount {
  size_t open = 0;          ///< With one face.
  size_t non_manifold = 0;  ///< With more than two.
};

/// Counts the edges of faces, three corners each. Corners at the same place are the same; faces whose corners are all
/// one are no faces. Cost: a sort of the corners and of the edges.
EdgeCount count_edges(std::span<const glm::dvec3> corners);

}  // namespace sward
