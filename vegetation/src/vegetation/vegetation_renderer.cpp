// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/vegetation/vegetation_renderer.h>

#include <sward/vegetation/clipmap_seeding.h>
#include <cmath>
#include <cstddef>
#include <utility>

#include "terrain/usable_view.h"
#include "vegetation/vegetation_renderer_stages.h"

namespace sward {

namespace {

constexpr size_t k_query_frames = 3;

}  // namespace

struct VegetationRenderer::Impl {
  gl::HomeContext home;
  Layer layer;
  gl::ShaderLibrary shaders;
  const WindTextures* wind = nullptr;
  gl::Bindings bindings;
  ClassificationStage classification;
  GrowthStage growth;
  ReadBackStage read_back;
  TriangleBuffers buffers;
  TriangleTextures triangles;
  PlacementTextures placement;
  gl::Buffer species;
  std::array<StageQueries, k_query_frames> queries;
  size_t query_frame = 0;
  VegetationStats last_stats;

  View view;
  std::array<DensityBin, k_density_bins> bins{};
  GLuint draws = 0;  // of a seeding on the GPU, else 0
  size_t draws_offset = 0;
  uint32_t clusters = 0;
  bool on_clipmap = false;
  bool uploaded = false, classified = false, season_changed = false;

  /// The species as the season has them: what is drawn goes by what was classified.
  void write_season() {
    if (!std::exchange(season_changed, false)) return;
    const SpeciesBlock block = make_species_block(layer);
    glNamedBufferSubData(species.id(), GLintptr(offsetof(SpeciesBlock, species)), GLsizeiptr(sizeof block.species),
                         block.species.data());
  }

  ClusterDraws cluster_draws() const {
    if (draws != 0) return {{}, draws, draws_offset};
    return {bins};
  }

  StageInputs inputs(const gl::Frame& frame, const gl::GroundTextures& ground) const {
    return {bindings, frame, ground, triangles, placement, species.id()};
  }
};

VegetationRenderer::VegetationRenderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
VegetationRenderer::VegetationRenderer(VegetationRenderer&&) noexcept = default;
VegetationRenderer& VegetationRenderer::operator=(VegetationRenderer&&) noexcept = default;
VegetationRenderer::~VegetationRenderer() = default;

Expected<VegetationRenderer> VegetationRenderer::create(const Layer& layer, const gl::ShaderLibrary& shaders,
                                                        const gl::Bindings& bindings) {
  if (auto valid = validate(layer); !valid) return tl::unexpected(valid.error());
  if (auto loaded = require_maps(layer); !loaded) return tl::unexpected(loaded.error());
  if (auto context = gl::require_context(); !context) return tl::unexpected(context.error());
  auto classification = ClassificationStage::create(layer, shaders, bindings);
  if (!classification) return tl::unexpected(classification.error());
  auto growth = GrowthStage::create(layer, shaders, bindings);
  if (!growth) return tl::unexpected(growth.error());
  auto read_back = ReadBackStage::create(layer, shaders, bindings);
  if (!read_back) return tl::unexpected(read_back.error());
  auto placement = PlacementTextures::create(layer);
  if (!placement) return tl::unexpected(placement.error());
  const SpeciesBlock species = make_species_block(layer);
  const size_t streams = classification->places().size();
  return VegetationRenderer(std::make_unique<Impl>(
      Impl{.home = gl::HomeContext::of_current(),
           .layer = layer,
           .shaders = shaders,
           .bindings = bindings,
           .classification = std::move(*classification),
           .growth = std::move(*growth),
           .read_back = std::move(*read_back),
           .buffers = TriangleBuffers::create(),
           .triangles = {},
           .placement = std::move(*placement),
           .species = make_buffer(sizeof species, &species, GL_DYNAMIC_STORAGE_BIT),
           .queries = {StageQueries::create(streams), StageQueries::create(streams), StageQueries::create(streams)},
           .last_stats = {},
           .view = {}}));
}

Expected<VegetationRenderer> VegetationRenderer::create_for_clipmap(const Layer& layer,
                                                                    const gl::ShaderLibrary& shaders,
                                                                    const gl::Bindings& bindings) {
  gl::ShaderLibrary library = shaders;
  library.add_source("drawn_surface.glsl", "#include \"drawn_surface_clipmap.glsl\"\n");
  auto renderer = create(layer, library, bindings);
  if (renderer) renderer->impl_->on_clipmap = true;
  return renderer;
}

const Layer& VegetationRenderer::layer() const {
  return impl_->layer;
}

const std::vector<Error>& VegetationRenderer::faults() const {
  return impl_->growth.faults();
}

Expected<void> VegetationRenderer::upload(const Seeding& seeding, const FixedTriangles& triangles, const View& view) {
  Impl& self = *impl_;
  self.uploaded = false;
  self.classified = false;
  if (!self.home.here("VegetationRenderer::upload"))
    return fail("VegetationRenderer::upload: its OpenGL context is not current");
  if (auto valid = view.validate(); !valid) return valid;
  SWARD_ASSERT(!self.on_clipmap, "a renderer for clipmaps takes seedings of the GPU");
  if (self.on_clipmap) return fail("VegetationRenderer::upload: a renderer for clipmaps takes seedings of the GPU");
  if (auto written = self.buffers.write(seeding.records, triangles.nodes(), seeding.exclusions); !written)
    return written;
  self.triangles = TriangleTextures(self.buffers);
  self.classification.reserve(seeding.clusters);
  self.view = view;
  self.bins = seeding.bins;
  self.clusters = seeding.clusters;
  self.uploaded = true;
  return {};
}

void VegetationRenderer::upload(const ClipmapSeeder& seeder, const gl::Clipmap& clipmap, const View& view) {
  Impl& self = *impl_;
  if (!self.home.here("VegetationRenderer::upload") || !usable(view, "VegetationRenderer::upload")) return;
  SWARD_ASSERT(self.on_clipmap, "make a renderer for clipmaps with create_for_clipmap()");
  SWARD_ASSERT(seeder.seeded(), "seed before uploading");
  if (!self.on_clipmap || !seeder.seeded()) return;
  self.triangles = {seeder.records(), seeder.exclusions(), {clipmap.block(), clipmap.heights()}};
  self.classification.reserve(seeder.most_clusters());
  self.view = view;
  self.draws = seeder.draws();
  self.draws_offset = seeder.draws_offset();
  self.uploaded = true;
  self.classified = false;
}

void VegetationRenderer::classify(const gl::Frame& frame, const gl::GroundTextures& ground,
                                  GLuint restore_framebuffer) {
  Impl& self = *impl_;
  if (!self.home.here("VegetationRenderer::classify")) return;
  SWARD_ASSERT(self.uploaded, "upload a seeding before classifying");
  if (!self.uploaded) return;
  const MapGeometry map = classification_map(self.layer, {ground.map_size(), ground.texels()});
  self.placement.follow(self.layer, map, ground.base_map_raw());
  // The sun's azimuth reaches the shaders with the frame.
  const shared::LayerParams params = make_layer_params(self.layer, self.view, map, 0.0f);
  glNamedBufferSubData(self.species.id(), 0, sizeof params, &params);
  self.write_season();
  self.query_frame = (self.query_frame + 1) % k_query_frames;
  StageQueries& queries = self.queries[self.query_frame];
  queries.begin_frame(self.clusters);
  self.classification.run(self.inputs(frame, ground), self.cluster_draws(), queries, restore_framebuffer);
  self.classified = true;
}

void VegetationRenderer::draw(const gl::Frame& frame, const gl::GroundTextures& ground) {
  Impl& self = *impl_;
  if (!self.home.here("VegetationRenderer::draw") || !self.classified) return;
  StageQueries& queries = self.queries[self.query_frame];
  const std::vector<uint32_t> fertile = self.growth.needs_counts() ? queries.fertile() : std::vector<uint32_t>();
  queries.begin_growth();
  self.growth.run(self.inputs(frame, ground), self.classification, fertile, self.wind);
  queries.end_growth();
}

Expected<void> VegetationRenderer::set_wind(const WindTextures* wind) {
  Impl& self = *impl_;
  if (wind != nullptr) {
    if (!self.home.here("VegetationRenderer::set_wind"))
      return fail("VegetationRenderer::set_wind: its OpenGL context is not current");
    if (auto built = self.growth.build_wind(self.layer, self.shaders, self.bindings); !built) return built;
  }
  self.wind = wind;
  return {};
}

void VegetationRenderer::set_season(float season) {
  SWARD_ASSERT(std::isfinite(season), "a season is a finite number");
  Impl& self = *impl_;
  self.layer.season = season;
  self.season_changed = true;
}

Expected<void> VegetationRenderer::set_values(size_t species, const SeasonValues& values) {
  Impl& self = *impl_;
  if (species >= self.layer.species.size()) return fail("there is no species " + std::to_string(species));
  Layer changed = self.layer;
  changed.species[species].seasons = {{0.0f, values}};
  if (auto valid = validate(changed); !valid) return valid;
  self.layer = std::move(changed);
  set_season(self.layer.season);
  return {};
}

VegetationStats VegetationRenderer::stats(bool wait) {
  Impl& self = *impl_;
  if (!self.home.here("VegetationRenderer::stats")) return self.last_stats;
  for (size_t age = 0; age < k_query_frames; ++age) {
    const StageQueries& queries = self.queries[(self.query_frame + k_query_frames - age) % k_query_frames];
    if (!wait && !queries.ready()) continue;
    self.last_stats = queries.read();
    break;
  }
  return self.last_stats;
}

Expected<std::vector<Plant>> VegetationRenderer::read_back(const gl::Frame& frame, const gl::GroundTextures& ground,
                                                           const View& view, const Seeding& seeding,
                                                           GLuint restore_framebuffer) {
  Impl& self = *impl_;
  if (!self.home.here("VegetationRenderer::read_back"))
    return fail("VegetationRenderer::read_back: its OpenGL context is not current");
  if (!self.classified) return fail("no plants to read back: nothing was classified since the last upload");
  if (!self.on_clipmap && seeding.clusters != self.clusters)
    return fail("the plants to read back come from another seeding");
  const std::vector<uint32_t> fertile = self.queries[self.query_frame].fertile();
  return self.read_back.run(self.inputs(frame, ground), self.classification, fertile, view, seeding,
                            restore_framebuffer);
}

size_t VegetationRenderer::gpu_bytes() const {
  const Impl& self = *impl_;
  return self.classification.gpu_bytes() + self.growth.gpu_bytes() + self.buffers.gpu_bytes() +
         self.placement.gpu_bytes() + gl::storage_bytes(self.species);
}

}  // namespace sward
