// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/scene/scene.h>

namespace sward::host {

/// Loads the masks and distribution maps that the scene's layers name, and its ground's detail textures. Each file is read once. Fails naming the file.
Expected<void> load_maps(Scene& scene);

}  // namespace sward::host
