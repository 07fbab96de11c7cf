// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

/// sward vegetation: grows plants on triangles. It does not know terrain engines, files, windows or contexts; it draws
/// into whatever framebuffer is bound.
#include <sward/api.h>
#include <sward/gl/frame.h>
#include <sward/gl/ground.h>
#include <sward/gl/shader_library.h>
#include <sward/terrain/error.h>
#include <sward/vegetation/plants.h>
#include <sward/vegetation/seeding.h>
#include <memory>
#include <optional>
#include <vector>

namespace sward::gl {
class Clipmap;
}

namespace sward {

class ClipmapSeeder;
class WindTextures;

struct VegetationStats {
  uint32_t clusters_submitted = 0;  ///< 0 where the GPU has seeded: ClipmapSeeder::stats() tells.
  uint32_t clusters_fertile = 0;    ///< Fed back. From the GPU's queries of an earlier frame unless waited for.
  uint64_t primitives = 0;          ///< Triangles rasterised, shadows included (same remark).
  /// Runs of growth's fragment shaders (same remark); none where the driver cannot count them
  /// (GL_ARB_pipeline_statistics_query).
  std::optional<uint64_t> fragments;
  bool overflow = false;  ///< A feedback buffer was too small: never, tests assert it.
};

/// Draws one layer. Owns its programs, feedback buffers and uniform buffers. GL thread.
class SWARD_API VegetationRenderer {
 public:
  /// Compiles classification and one growth program a plant kind in use. Fails on a layer that does not validate, on a
  /// shader's error (with the driver's log) and on a GL below 4.5. A species of a host's own kind whose functions do not
  /// build is left out instead, and named in faults(). Leaves all state as it was.
  static Expected<VegetationRenderer> create(const Layer& layer, const gl::ShaderLibrary& shaders,
                                             const gl::Bindings& bindings = {});
  /// The same for layers that are seeded on the GPU over a clipmap: plants stand on its drawn surface.
  static Expected<VegetationRenderer> create_for_clipmap(const Layer& layer, const gl::ShaderLibrary& shaders,
                                                         const gl::Bindings& bindings = {});
  VegetationRenderer(VegetationRenderer&&) noexcept;
  VegetationRenderer& operator=(VegetationRenderer&&) noexcept;
  ~VegetationRenderer();

  const Layer& layer() const;

  /// Species of hosts' own kinds (PlantKind::custom) that are not drawn, because their functions are missing or were
  /// refused by the driver: layer, species, file, line and the driver's words of each. All else is drawn. set_wind may
  /// add some. The same text goes to GL's debug log as from a third party (KHR_debug).
  const std::vector<Error>& faults() const;

  /// The time of the year from the next classify on (Layer::season; finite, asserted): colours, heights and densities
  /// of species with seasons. Nothing is seeded or built anew, plants keep ids and places. Between two seedings too.
  /// Binds nothing. Cost: a write of 11 KB.
  void set_season(float season);
  /// Gives a species (index in the layer) values of the host's own, for what follows no year: they take the place of
  /// its seasons. Fails, changing nothing, on values out of range. A reference colour that jumps swaps plants at once;
  /// ones that are to be exchanged smoothly stand in seasons.
  Expected<void> set_values(size_t species, const SeasonValues& values);

  /// What plants bend and sway in from the next draw on; null: still air, as at first, and nothing of this is paid for.
  /// `wind` must live until it is replaced; what is uploaded to it is seen at once. Its time is the frame's
  /// (gl::Frame::upload). The first wind builds the programs of plants that move; fails, changing nothing, on a
  /// shader's error, and leaves out hosts' kinds that only then do not build (faults()). Plants' ids, places and sizes, and what read_back() gives, do not change. Binds nothing.
  Expected<void> set_wind(const WindTextures* wind);

  /// One upload of a frame's seeding and surface, for the view that they were made for; grows buffers when a frame
  /// needs more than any before. Fails, keeping nothing of the frame, when the device's buffer textures cannot hold it
  /// (GL_MAX_TEXTURE_BUFFER_SIZE; records take 6 texels, surface nodes 1) and when the view is not valid. Binds nothing.
  /// The arguments may go away afterwards.
  Expected<void> upload(const Seeding& seeding, const FixedTriangles& triangles, const View& view);

  /// What takes the other upload()'s place in a renderer for clipmaps: nothing is copied, records and draws stay in the
  /// seeder's buffers. Both must live, and neither seed nor follow another view, until the frame is drawn. classify()
  /// then also binds the seeder's draws as GL_DRAW_INDIRECT_BUFFER and leaves 0 there; draw() and read_back() also bind
  /// uniform buffer bindings.clipmap and texture bindings.clipmap_heights (without sampler) and leave 0. Binds nothing.
  void upload(const ClipmapSeeder& seeder, const gl::Clipmap& clipmap, const View& view);

  /// Classifies the uploaded clusters into one feedback stream a species, by passes of four. Call after upload, before
  /// draw, once a frame. Binds: program, vertex array, transform feedback, draw framebuffer (its own, 1 x 1), uniform
  /// buffers frame and species, texture units base_map_raw, triangles, surface, exclusions, placement; enables
  /// GL_RASTERIZER_DISCARD. Leaves: program 0, vertex array 0, feedback 0, those units (their samplers too) and
  /// bindings 0, discard disabled, and `restore_framebuffer` bound for drawing. The host must have no query of
  /// feedback, generated primitives or fragment shader runs active, here and in draw, no transform feedback and no
  /// conditional rendering. Asserts that something was uploaded.
  void classify(const gl::Frame& frame, const gl::GroundTextures& ground, GLuint restore_framebuffer);

  /// Grows and draws every species, shadows included. Binds: programs, vertex array, uniform buffers frame and species,
  /// texture units base_map, base_map_raw, triangles, surface, exclusions, placement, blade_shape, plant_images,
  /// plant_mesh, detail, detail_slope, disturbance_map and the uniform buffers materials and disturbance (what has
  /// touched the ground: GroundTextures::set_disturbed()); sets GL_PATCH_VERTICES 1. With a wind (set_wind) also the
  /// uniform buffer wind and units wind_maps, wind_grid, wind_painted. Leaves: program 0,
  /// vertex array 0, those units (their samplers too) and bindings 0, patch vertices 1. The host chooses depth test,
  /// depth mask, culling (must be off), blending (must be off), and leaves GL_PROVOKING_VERTEX at GL's own, the last.
  /// Where the driver is one that draws on the CPU, GL_QUERY_BUFFER is left 0 too. Thin plants cover some of a pixel's
  /// samples: the shaders write the mask (frame.samples() must be the target's), alpha is 1. Draws nothing before the
  /// first classify.
  void draw(const gl::Frame& frame, const gl::GroundTextures& ground);

  /// Results of the queries of the last classify and draw; `wait` blocks until they are there. Leaves GL_QUERY_BUFFER 0.
  VegetationStats stats(bool wait);

  /// Bytes of GPU memory that it holds (gl::storage_bytes). Asks GL: not for every frame. Leaves all state as it was.
  size_t gpu_bytes() const;

  /// The plants of the last classify as the GPU grows them, read back: for tests and `sward plants --gpu`. Slow. Needs
  /// the seeding that was uploaded, to name triangles; same binding contract as classify, and disturbance_map, the
  /// uniform buffer disturbance and GL_QUERY_BUFFER, left 0.
  Expected<std::vector<Plant>> read_back(const gl::Frame& frame, const gl::GroundTextures& ground, const View& view,
                                         const Seeding& seeding, GLuint restore_framebuffer);

 private:
  struct Impl;
  explicit VegetationRenderer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace sward
