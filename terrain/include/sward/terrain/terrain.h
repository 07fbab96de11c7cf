// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

/// sward terrain: the CPU half. It does not draw, read files, own a window, a context, a thread or a main loop.
///
/// HeightField (samples and relief) -> Bounds (error of every diamond) -> RoamMesh (mesh for a View)
///   -> visible_indices() for a renderer, fixed_level_triangles() for vegetation.
#include <sward/terrain/bounds.h>
#include <sward/terrain/color_map.h>
#include <sward/terrain/edits.h>
#include <sward/terrain/error.h>
#include <sward/terrain/fixed_triangles.h>
#include <sward/terrain/height_field.h>
#include <sward/terrain/queries.h>
#include <sward/terrain/roam_mesh.h>
#include <sward/terrain/view.h>
