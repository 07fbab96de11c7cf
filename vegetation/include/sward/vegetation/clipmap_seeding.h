// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/gl/clipmap.h>
#include <sward/gl/shader_library.h>
#include <sward/vegetation/seeding.h>
#include <memory>

namespace sward {

/// What a frame's seeding on the GPU came to.
struct ClipmapSeedingStats {
  uint32_t fixed_triangles = 0;  ///< Candidates in sight and within the horizon that could feed a plant.
  uint32_t seeded = 0;           ///< Of these, such as submit seeds.
  uint32_t clusters = 0;         ///< That the bins submit.
};

/// Seeds a layer on a clipmap's drawn surface, on the GPU: the sketch for geometry clipmaps in section 4 of
/// D. Papavasiliou, "Real-Time Grass (and Other Procedural Objects) on Terrain" (2015). What cutting, culling and
/// seed() do on the CPU for other terrains: the same triangles with the same ids, and so the same plants; their heights
/// are the drawn surface's. Compute shaders instead of the sketch's vertex shader and feedback: a bin's place is known
/// only after all triangles have been counted, which feedback could not tell without a read-back, and records of one
/// bin have to lie together for one indirect draw.
///
/// What the GPU cannot know stays on the CPU and is read only where the window around the eye has moved on: static
/// area, place on the map, holes, excluded shapes. GL thread.
class SWARD_API ClipmapSeeder {
 public:
  /// `surface` must outlive it and be the clipmap's. Fails on a layer that does not validate, on a shader's error, on a
  /// GL below 4.5 and where the horizon holds more than four million triangles.
  static Expected<ClipmapSeeder> create(const Layer& layer, const Surface& surface, const ColorMap& map,
                                        const gl::ShaderLibrary& shaders, const gl::Bindings& bindings = {});
  ClipmapSeeder(ClipmapSeeder&&) noexcept;
  ClipmapSeeder& operator=(ClipmapSeeder&&) noexcept;
  ~ClipmapSeeder();

  const Layer& layer() const;

  /// Seeds for a view, which the clipmap has followed. Nothing is read back: records, bins and draws stay in buffers,
  /// which VegetationRenderer::upload(const ClipmapSeeder&, ...) takes. Fails, seeding nothing, where the view is not
  /// valid, the horizon holds too many triangles or the device's buffer textures too few records. `exclusions` as for
  /// seed().
  /// Binds: program, uniform buffers bindings.clipmap, bindings.seeding, texture bindings.clipmap_heights (without
  /// sampler), the five storage buffers bindings.seed_*.
  /// Leaves: program 0, those bindings and that sampler 0.
  /// Cost: five dispatches over all candidates within the horizon around the eye.
  Expected<void> seed(const View& view, const gl::Clipmap& clipmap, const Exclusions* exclusions = nullptr);

  /// As VegetationRenderer::set_season(), of the same layer: which ground can feed a species follows the references.
  void set_season(float season);

  /// Holes, heights or slopes of the surface have changed here (EditResult::changed, World::poll): the next seed() reads
  /// what is static there anew.
  void changed(const LatticeBox& box);

  /// Of the last seed(); `wait` blocks until they are there, else those of the newest frame that has arrived.
  ClipmapSeedingStats stats(bool wait);

  /// The last seed()'s triangles and records, as seed() would have made them: for tests, `sward plants` and the CPU
  /// twin. Seeding::source counts up; triangles carry the drawn surface below them. Slow.
  void read_back(const View& view, const gl::Clipmap& clipmap, FixedTriangles& triangles, Seeding& seeding) const;

  /// Bytes of GPU memory that it holds (gl::storage_bytes). Asks GL: not for every frame. Leaves all state as it was.
  size_t gpu_bytes() const;

  // For VegetationRenderer.
  GLuint records() const;        ///< RGBA32UI buffer texture.
  GLuint exclusions() const;     ///< RGBA32F buffer texture.
  GLuint draws() const;          ///< Buffer with 32 draw commands, one a bin, largest count first, ...
  size_t draws_offset() const;   ///< ... from this byte.
  size_t most_clusters() const;  ///< The draws never submit more.
  bool seeded() const;           ///< Whether the last seed() succeeded.

 private:
  struct Impl;
  explicit ClipmapSeeder(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace sward
