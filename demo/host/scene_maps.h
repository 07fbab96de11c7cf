// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/scene/scene.h>

namespace sward::host {

/// Loads the masks, distribution maps and plants' images and meshes that the scene's layers name, its wind's maps and
/// its ground's detail textures; details that are built in are made. Each file is read once. Fails naming the file, and
/// for images the scene's line.
Expected<void> load_maps(Scene& scene);

}  // namespace sward::host
