// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

/// sward terrain: the CPU half. It does not draw, own a window, a context or a main loop; only a World reads
/// files and has a thread, in the background.
///
/// HeightField (samples and relief) -> Bounds (error of every diamond) -> RoamMesh (mesh for a View)
///   -> visible_indices() for a renderer, fixed_level_triangles() for vegetation.
/// HostTerrain (heights of a host's own terrain, through a callback) -> fixed_level_triangles() alone.
/// World (squares loaded and dropped) takes the place of HeightField and Bounds where they do not fit into memory.
#include <sward/terrain/bounds.h>
#include <sward/terrain/color_map.h>
#include <sward/terrain/edits.h>
#include <sward/terrain/error.h>
#include <sward/terrain/fixed_triangles.h>
#include <sward/terrain/height_field.h>
#include <sward/terrain/host_priorities.h>
#include <sward/terrain/host_terrain.h>
#include <sward/terrain/many_views.h>
#include <sward/terrain/queries.h>
#include <sward/terrain/roam_mesh.h>
#include <sward/terrain/view.h>
#include <sward/terrain/world.h>
#include <sward/terrain/world_bake.h>
