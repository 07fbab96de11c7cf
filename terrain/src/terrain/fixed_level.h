// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/fixed_triangles.h>

#include "roam_tree.h"

namespace sward::roam {

/// Appends the triangles of options.level that a view sees, on the surface of the tree's leaves. `out` is clear.
void collect_fixed_level(const RoamTree& tree, const View& view, const FixedLevelOptions& options, FixedTriangles& out);

}  // namespace sward::roam
