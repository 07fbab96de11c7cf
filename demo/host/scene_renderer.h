// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/scene/scene.h>
#include <sward/terrain/roam_mesh.h>
#include <sward/terrain_gl/clipmap_renderer.h>
#include <sward/terrain_gl/terrain_renderer.h>
#include <sward/vegetation/clipmap_seeding.h>
#include <sward/vegetation/disturbance_textures.h>
#include <sward/vegetation/mesh_renderer.h>
#include <sward/vegetation/vegetation_renderer.h>
#include <sward/vegetation/wind.h>
#include <memory>
#include <optional>

#include "host/disturbance_replay.h"
#include "host/rolling_ball.h"
#include "host/scene_frame.h"
#include "host/scene_terrain.h"
#include "host/sky.h"

namespace sward::host {

/// Of a frame of a scene with terrain.source = "clipmap".
struct ClipmapFrameStats {
  gl::Clipmap::Upload upload;
  int rings = 0, finest = 0;  ///< How many there are; the finest one drawn.
  uint32_t blocks = 0;        ///< Drawn.
  bool settled = true;        ///< Nothing is left to be read.
};

struct SceneFrameStats {
  /// On a clipmap only `visible` counts: triangles of the drawn blocks.
  RoamStats roam;
  std::optional<ClipmapFrameStats> clipmap;  ///< Empty with terrain.source = "roam".
  std::optional<WorldStats> world;           ///< Empty where the ground is no world.
  float bound_px = 0;                        ///< 0 on a clipmap, which has none.
  uint32_t fixed_triangles = 0;
  VegetationStats vegetation;  ///< Sums over the layers.
  double cpu_stream_ms = 0;    ///< Worlds: following the view, taking squares over, slopes for shading.
  double cpu_roam_ms = 0;      ///< Update and upload of what changed, of the mesh or of the clipmap's rings.
  double cpu_seeding_ms = 0;   ///< Fixed-level triangles, seeding, upload.
  /// Of this frame when waited for, else of the newest frame whose times have arrived; empty where the driver cannot
  /// measure (software renderers) or nothing has arrived yet.
  /// On a clipmap seeding is the GPU's and counts with classification.
  std::optional<double> gpu_terrain_ms, gpu_classify_ms, gpu_grow_ms;
};

/// False on software renderers, whose timer queries mean nothing. GL thread.
bool gpu_can_time();

/// Everything that draws a scene, one frame after the other: the whole pipeline in one place. GL thread.
class SceneRenderer {
 public:
  /// `terrain` must outlive the renderer.
  static Expected<SceneRenderer> create(const Scene& scene, const SceneTerrain& terrain,
                                        const gl::ShaderLibrary& shaders, const gl::Bindings& bindings = {});
  /// The same on ground that another context, which shares its objects with this one, has uploaded by make_ground().
  static Expected<SceneRenderer> create(const Scene& scene, const SceneTerrain& terrain, gl::GroundTextures ground,
                                        const gl::ShaderLibrary& shaders, const gl::Bindings& bindings = {});
  /// The ground's textures, materials included.
  static Expected<gl::GroundTextures> make_ground(const Scene& scene, const SceneTerrain& terrain);
  /// Builds the programs that create() will build, keeping none: for its errors, and for the library's binaries.
  static Expected<void> try_programs(const Scene& scene, const SceneTerrain& terrain, const gl::ShaderLibrary& shaders,
                                     const gl::Bindings& bindings = {});
  SceneRenderer(SceneRenderer&&) noexcept;
  SceneRenderer& operator=(SceneRenderer&&) noexcept;
  ~SceneRenderer();

  /// A frame of which nothing is seen: streaming and the mesh alone.
  Expected<RoamStats> update(const View& view, double time_s);
  /// Draws sky, terrain and vegetation into `framebuffer`, which is bound with depth test on. Leaves no sward object
  /// bound.
  Expected<SceneFrameStats> draw(const View& view, const gl::Lighting& lighting, double time_s, GLuint framebuffer,
                                 int samples, bool wait_for_stats);
  /// Worlds: whether frames wait for the squares that they want. From the start they do not.
  void set_streaming(Streaming streaming);
  /// Without vegetation when false (the paper's figure 7 needs both).
  void set_vegetation(bool enabled);
  /// Whether plants are rasterised; when false their growth ends before it (the paper's figure 9).
  void set_rasterisation(bool enabled);
  /// Without the sky when false, for hosts that have their own.
  void set_sky(bool enabled);
  /// Arrows of the wind over the ground (WindOverlay) when true; the first time builds their program.
  Expected<void> set_wind_overlay(bool enabled);
  /// The scene's wind as of the last frame, for sources and movers of the host's; a scene without [wind] has one from
  /// the first call on, in dead air. Going back in time starts it anew, without what was added.
  Wind& wind();
  /// Replaces a layer's species and rules. On an error (the layer does not validate) nothing changes.
  Expected<void> set_layer(size_t index, const Layer& layer);
  /// The time of the year, 0..1, for all layers from the next frame on; the ground's is the lighting's.
  void set_season(float season);
  /// Balls to be drawn from the next frame on.
  Expected<void> set_balls(std::span<const RollingBall> balls);
  /// Ground on which nothing stands; the next frame follows changes.
  Exclusions& exclusions();
  /// What has touched the ground: the scene's own, replayed to each frame's time, and whatever the host adds between
  /// frames (`disturbance().press_capsule(...)`); the next frame shows it. Time passes with draw()'s.
  Disturbance& disturbance();

  /// On a clipmap it stays as it was made.
  RoamMesh& mesh();
  const std::vector<Layer>& layers() const;
  /// Plants of the last frame: from the CPU twin, or read back from the GPU. Plant::species counts on from layer to
  /// layer. On a clipmap the twin too starts from the triangles that the GPU seeded, read back.
  std::vector<Plant> plants_cpu(const View& view) const;
  Expected<std::vector<Plant>> plants_gpu(const View& view, GLuint framebuffer);

 private:
  struct Impl;
  explicit SceneRenderer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace sward::host
