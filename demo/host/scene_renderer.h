// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <sward/scene/scene.h>
#include <sward/terrain/roam_mesh.h>
#include <sward/terrain_gl/terrain_renderer.h>
#include <sward/vegetation/vegetation_renderer.h>

#include "host/sky.h"

namespace sward::host {

/// A scene's terrain in memory: what needs no GL. Not movable once meshes refer to it, hence the pointer.
struct SceneTerrain {
  HeightField field;
  Bounds bounds;
  ColorMap colors;
};
/// Generates or loads what the scene names. `detail` false switches the relief below the data off.
Expected<std::unique_ptr<SceneTerrain>> load_terrain(const Scene& scene, bool detail, const Progress& progress = {});

/// Where the scene's camera stands (z above the ground resolved), looking along its yaw and pitch.
View scene_view(const Scene& scene, const SceneTerrain& terrain, glm::ivec2 viewport);

struct SceneFrameStats {
  RoamStats roam;
  float bound_px = 0;
  uint32_t fixed_triangles = 0;
  VegetationStats vegetation;
  double cpu_roam_ms = 0, cpu_seeding_ms = 0;
};

/// Everything that draws a scene, one frame after the other: the whole pipeline in one place. GL thread.
class SceneRenderer {
 public:
  /// `terrain` must outlive the renderer.
  static Expected<SceneRenderer> create(const Scene& scene, const SceneTerrain& terrain,
                                        const gl::ShaderLibrary& shaders, const gl::Bindings& bindings = {});
  SceneRenderer(SceneRenderer&&) noexcept;
  SceneRenderer& operator=(SceneRenderer&&) noexcept;
  ~SceneRenderer();

  /// Draws sky, terrain and vegetation into `framebuffer`, which is bound with depth test on. Leaves no sward object
  /// bound.
  Expected<SceneFrameStats> draw(const View& view, const gl::Lighting& lighting, double time_s, GLuint framebuffer,
                                 int samples, bool wait_for_stats);
  /// Without vegetation when false (the paper's figure 7 needs both).
  void set_vegetation(bool enabled);

  RoamMesh& mesh();
  /// Plants of the last frame: from the CPU twin, or read back from the GPU.
  std::vector<Plant> plants_cpu(const View& view) const;
  Expected<std::vector<Plant>> plants_gpu(const View& view, GLuint framebuffer);

 private:
  struct Impl;
  explicit SceneRenderer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace sward::host
