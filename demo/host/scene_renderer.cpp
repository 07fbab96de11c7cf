// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "host/scene_renderer.h"

#include <sward/vegetation/wind_textures.h>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <span>
#include <string_view>

#include "host/gpu_timer.h"
#include "host/scene_frame.h"
#include "host/scene_wind.h"
#include "host/stopwatch.h"
#include "host/wind_overlay.h"

namespace sward::host {

namespace {

// Tiles of slopes that a frame reads while squares come and go: some 2 ms at most.
constexpr size_t k_slope_tiles_a_frame = 4;

// What is compiled from shaders, so that a reload can build it aside.
struct Programs {
  std::optional<TerrainRenderer> terrain;  // one of the two
  std::optional<ClipmapRenderer> clipmap;
  Sky sky;
  std::vector<VegetationRenderer> vegetation;
  std::vector<MeshRenderer> meshes;    // bodies of the layers on meshes
  std::vector<ClipmapSeeder> seeders;  // of the layers, on a clipmap
};

// The library with the functions of the layers' own kinds, as their files are now. A name that is no file is left to
// the library.
Expected<gl::ShaderLibrary> with_kinds(gl::ShaderLibrary shaders, const std::vector<Layer>& layers,
                                       const std::string& directory) {
  for (const Layer& layer : layers) {
    for (const Species& species : layer.species) {
      if (species.kind != PlantKind::custom) continue;
      const std::filesystem::path path = std::filesystem::path(directory) / species.custom.functions;
      std::error_code ignored;
      if (!std::filesystem::is_regular_file(path, ignored)) continue;
      std::ifstream stream(path, std::ios::binary);
      std::string text{std::istreambuf_iterator<char>(stream), {}};
      if (!stream.is_open() || stream.bad()) return fail("functions \"" + path.string() + "\" cannot be read");
      shaders.add_source(species.custom.functions, std::move(text));
    }
  }
  return shaders;
}

// Without the layers.
Expected<Programs> build_ground(TerrainSource source, const gl::ShaderLibrary& shaders, const gl::Bindings& bindings) {
  auto sky = Sky::create(shaders, bindings);
  if (!sky) return tl::unexpected(sky.error());
  Programs programs{{}, {}, std::move(*sky), {}, {}, {}};
  if (source == TerrainSource::clipmap) {
    auto clipmap = ClipmapRenderer::create(shaders, bindings);
    if (!clipmap) return tl::unexpected(clipmap.error());
    programs.clipmap = std::move(*clipmap);
    return programs;
  }
  auto terrain = TerrainRenderer::create(shaders, bindings);
  if (!terrain) return tl::unexpected(terrain.error());
  programs.terrain = std::move(*terrain);
  return programs;
}

Expected<VegetationRenderer> build_vegetation(const Layer& layer, TerrainSource source,
                                              const gl::ShaderLibrary& shaders, const gl::Bindings& bindings) {
  return source == TerrainSource::clipmap ? VegetationRenderer::create_for_clipmap(layer, shaders, bindings)
                                          : VegetationRenderer::create(layer, shaders, bindings);
}

// What a layer on a mesh has besides, and one on a clipmap.
Expected<void> add_ground_of(const Layer& layer, TerrainSource source, const SceneTerrain& terrain,
                             const gl::ShaderLibrary& shaders, const gl::Bindings& bindings, Programs& programs) {
  if (const auto surface = terrain.mesh_of(layer.name)) {
    if (source == TerrainSource::clipmap)
      return fail("layer '" + layer.name +
                  "' covers a surface, which terrain source \"clipmap\" does not seed; choose \"roam\"");
    auto body = MeshRenderer::create(*surface, layer, shaders, bindings);
    if (!body) return tl::unexpected(body.error());
    programs.meshes.push_back(std::move(*body));
  }
  if (source != TerrainSource::clipmap) return {};
  auto seeder = ClipmapSeeder::create(layer, terrain.surface(), terrain.colors(), shaders, bindings);
  if (!seeder) return tl::unexpected(seeder.error());
  programs.seeders.push_back(std::move(*seeder));
  return {};
}

Expected<Programs> build_programs(const std::vector<Layer>& layers, TerrainSource source, const SceneTerrain& terrain,
                                  const gl::ShaderLibrary& shaders, const gl::Bindings& bindings) {
  auto programs = build_ground(source, shaders, bindings);
  if (!programs) return programs;
  for (const Layer& layer : layers) {
    auto vegetation = build_vegetation(layer, source, shaders, bindings);
    if (!vegetation) return tl::unexpected(vegetation.error());
    programs->vegetation.push_back(std::move(*vegetation));
    if (auto added = add_ground_of(layer, source, terrain, shaders, bindings, *programs); !added)
      return tl::unexpected(added.error());
  }
  return programs;
}

// Kinds of plants that are left out, from the layer's fault `first` on.
void tell_faults(const VegetationRenderer& layer, size_t first = 0) {
  for (const Error& fault : std::span(layer.faults()).subspan(first))
    std::fprintf(stderr, "sward: warning: %s; the species is left out\n", fault.message.c_str());
}

Expected<void> set_wind_of(Programs& programs, const WindTextures* wind) {
  for (VegetationRenderer& layer : programs.vegetation) {
    const size_t told = layer.faults().size();
    if (auto set = layer.set_wind(wind); !set) return set;
    tell_faults(layer, told);
  }
  return {};
}

// The wind, where the scene has one or the host has asked for it.
struct Air {
  std::optional<SceneWindReplay> wind;
  std::optional<WindTextures> textures;  // from when on the layers move in it
  std::optional<WindOverlay> arrows;
  bool arrows_on = false;
  double time_s = 0;  // of the last frame
  glm::dvec3 eye{0};

  Expected<void> follow(const View& view, double now_s) {
    time_s = now_s;
    eye = view.eye;
    if (!wind) return {};
    if (auto valid = view.validate(); !valid) return valid;
    if (auto followed = wind->follow(now_s, eye); !followed) return followed;
    textures->upload(wind->wind(), view.eye);
    return {};
  }
};

// Dead air, for scenes without [wind].
SceneWind dead_air() {
  SceneWind wind;
  wind.weather.ambient_m_s = 0;
  return wind;
}

}  // namespace

bool gpu_can_time() {
  return !gl::software_renderer();
}

struct SceneRenderer::Impl {
  const SceneTerrain& terrain;
  std::string directory;  // of the scene, for its kinds of plants
  gl::ShaderLibrary shaders;
  gl::Bindings bindings;
  std::vector<Layer> layers;
  gl::Frame frame;
  gl::GroundTextures ground;
  SceneFrame cpu;
  std::optional<gl::Clipmap> clipmap;  // with terrain.source = "clipmap"
  Programs programs;
  GpuTimer terrain_timer, classify_timer, grow_timer;
  bool vegetation_on = true, sky_on = true, rasterised = true;
  Streaming streaming = Streaming::live;
  float sun_azimuth = 0;  // of the last frame
  Air air{};
  std::vector<RollingBall> balls = {};
  std::optional<BallRenderer> ball_renderer = {};  // from the first ball on
  std::optional<DisturbanceReplay> replay = {};
  std::optional<DisturbanceTextures> disturbed = {};  // from the first touch on

  Expected<void> take_wind();
  Expected<void> blow(const View& view, double time_s);
  Expected<void> stream(const View& view, SceneFrameStats& stats);
  TerrainSource source() const { return clipmap ? TerrainSource::clipmap : TerrainSource::roam; }
  Expected<void> follow(const View& view, double time_s, SceneFrameStats& stats);
  Expected<void> disturb(const View& view, double time_s);
  void draw_terrain(const View& view, SceneFrameStats& stats);
  Expected<void> seed_on_cpu(const View& view, SceneFrameStats& stats);
  Expected<void> seed_on_gpu(const View& view);
  Expected<void> draw_vegetation(const View& view, GLuint framebuffer, SceneFrameStats& stats);
  void gather(bool wait, SceneFrameStats& stats);
};

// Layers move from the moment on that there is a wind.
Expected<void> SceneRenderer::Impl::take_wind() {
  if (!air.wind || air.textures) return {};
  auto made = WindTextures::create();
  if (!made) return tl::unexpected(made.error());
  air.textures = std::move(*made);
  auto set = set_wind_of(programs, &*air.textures);
  if (set) return {};
  // Those that have it already move with nothing again.
  (void)set_wind_of(programs, nullptr);
  air.textures.reset();
  return set;
}

Expected<void> SceneRenderer::Impl::blow(const View& view, double time_s) {
  if (auto taken = take_wind(); !taken) return taken;
  return air.follow(view, time_s);
}

Expected<void> SceneRenderer::Impl::stream(const View& view, SceneFrameStats& stats) {
  if (terrain.world() == nullptr) return {};
  if (auto valid = view.validate(); !valid) return valid;
  const auto begin = std::chrono::steady_clock::now();
  auto boxes = cpu.stream(view, streaming);
  if (!boxes) return tl::unexpected(boxes.error());
  for (const LatticeBox& box : *boxes) ground.slopes().changed(box);
  if (clipmap) {
    for (const LatticeBox& box : *boxes) {
      clipmap->changed(box);
      for (ClipmapSeeder& seeder : programs.seeders) seeder.changed(box);
    }
  }
  const size_t tiles = streaming == Streaming::wait ? std::numeric_limits<size_t>::max() : k_slope_tiles_a_frame;
  ground.slopes().follow(terrain.surface(), glm::dvec2(view.eye), tiles);
  stats.world = terrain.world()->stats();
  stats.cpu_stream_ms = ms_since(begin);
  return {};
}

// The terrain's own level of detail.
Expected<void> SceneRenderer::Impl::follow(const View& view, double time_s, SceneFrameStats& stats) {
  const auto begin = std::chrono::steady_clock::now();
  if (clipmap) {
    if (auto valid = view.validate(); !valid) return valid;
    // The first frame, and those that wait, are whole; a live one reads one ring's worth at most.
    const bool whole = streaming == Streaming::wait || clipmap->rings().finest() == clipmap->rings().rings();
    stats.clipmap.emplace();
    stats.clipmap->upload = clipmap->follow(view, whole ? std::numeric_limits<size_t>::max() : 0);
    stats.clipmap->rings = clipmap->rings().rings();
    stats.clipmap->finest = clipmap->rings().finest();
    stats.clipmap->settled = clipmap->rings().settled();
  } else {
    auto roam = cpu.mesh().update(view, time_s);
    if (!roam) return tl::unexpected(roam.error());
    stats.roam = *roam;
    programs.terrain->upload(cpu.mesh());
  }
  stats.cpu_roam_ms = ms_since(begin);
  return {};
}

// What has touched the ground by now; nothing is made before the first touch.
Expected<void> SceneRenderer::Impl::disturb(const View& view, double time_s) {
  if (glm::any(glm::greaterThan(glm::abs(glm::dvec2(view.eye)), glm::dvec2(Disturbance::k_most_place))))
    return fail("the eye is more than 1e9 m from the origin, where no ground remembers");
  if (auto replayed = replay->advance_to(time_s); !replayed) return replayed;
  if (replay->disturbance().revision() == 0) return {};
  if (!disturbed) {
    auto made = DisturbanceTextures::create();
    if (!made) return tl::unexpected(made.error());
    disturbed = std::move(*made);
    ground.set_disturbed(disturbed->ground());
  }
  disturbed->upload(replay->disturbance(), glm::dvec2(view.eye));
  return {};
}

void SceneRenderer::Impl::draw_terrain(const View& view, SceneFrameStats& stats) {
  if (!clipmap) return programs.terrain->draw(view, frame, ground);
  programs.clipmap->draw(view, *clipmap, frame, ground);
  stats.clipmap->blocks = programs.clipmap->blocks();
  stats.roam.visible = programs.clipmap->triangles();
}

Expected<void> SceneRenderer::Impl::seed_on_cpu(const View& view, SceneFrameStats& stats) {
  stats.fixed_triangles = cpu.cut_triangles(view);
  cpu.seed_triangles(view, terrain.colors());
  for (size_t i = 0; i < programs.vegetation.size(); ++i) {
    const auto& layer = cpu.layers()[i];
    if (auto fits = programs.vegetation[i].upload(layer.seeding, layer.triangles, view); !fits) return fits;
  }
  return {};
}

Expected<void> SceneRenderer::Impl::seed_on_gpu(const View& view) {
  for (size_t i = 0; i < programs.seeders.size(); ++i) {
    if (auto seeded = programs.seeders[i].seed(view, *clipmap, &cpu.exclusions()); !seeded) return seeded;
    programs.vegetation[i].upload(programs.seeders[i], *clipmap, view);
  }
  return {};
}

Expected<void> SceneRenderer::Impl::draw_vegetation(const View& view, GLuint framebuffer, SceneFrameStats& stats) {
  const auto begin = std::chrono::steady_clock::now();
  if (clipmap) {
    classify_timer.begin();
    if (auto seeded = seed_on_gpu(view); !seeded) return seeded;
  } else {
    if (auto seeded = seed_on_cpu(view, stats); !seeded) return seeded;
    classify_timer.begin();
  }
  stats.cpu_seeding_ms = ms_since(begin);

  for (VegetationRenderer& layer : programs.vegetation) layer.classify(frame, ground, framebuffer);
  classify_timer.end();
  if (!rasterised) glEnable(GL_RASTERIZER_DISCARD);
  grow_timer.begin();
  for (VegetationRenderer& layer : programs.vegetation) layer.draw(frame, ground);
  grow_timer.end();
  if (!rasterised) glDisable(GL_RASTERIZER_DISCARD);
  return {};
}

void SceneRenderer::Impl::gather(bool wait, SceneFrameStats& stats) {
  stats.gpu_terrain_ms = terrain_timer.milliseconds(wait);
  if (!vegetation_on) return;
  stats.gpu_classify_ms = classify_timer.milliseconds(wait);
  stats.gpu_grow_ms = grow_timer.milliseconds(wait);
  for (VegetationRenderer& layer : programs.vegetation) {
    const VegetationStats one = layer.stats(wait);
    stats.vegetation.clusters_submitted += one.clusters_submitted;
    stats.vegetation.clusters_fertile += one.clusters_fertile;
    stats.vegetation.primitives += one.primitives;
    if (one.fragments) stats.vegetation.fragments = stats.vegetation.fragments.value_or(0) + *one.fragments;
    stats.vegetation.overflow = stats.vegetation.overflow || one.overflow;
  }
  for (ClipmapSeeder& seeder : programs.seeders) {
    const ClipmapSeedingStats one = seeder.stats(wait);
    stats.fixed_triangles += one.fixed_triangles;
    stats.vegetation.clusters_submitted += one.clusters;
  }
}

SceneRenderer::SceneRenderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
SceneRenderer::SceneRenderer(SceneRenderer&&) noexcept = default;
SceneRenderer& SceneRenderer::operator=(SceneRenderer&&) noexcept = default;
SceneRenderer::~SceneRenderer() = default;

Expected<gl::GroundTextures> SceneRenderer::make_ground(const Scene& scene, const SceneTerrain& terrain) {
  auto ground = terrain.make_textures();
  if (!ground) return ground;
  const auto materials = ground_materials(scene);
  if (!materials) return tl::unexpected(materials.error());
  if (auto set = ground->set_materials(*materials); !set) return tl::unexpected(set.error());
  return ground;
}

Expected<void> SceneRenderer::try_programs(const Scene& scene, const SceneTerrain& terrain,
                                           const gl::ShaderLibrary& shaders, const gl::Bindings& bindings) {
  auto library = with_kinds(shaders, scene.layers, scene.directory);
  if (!library) return tl::unexpected(library.error());
  auto programs = build_programs(scene.layers, scene.source, terrain, *library, bindings);
  if (!programs) return tl::unexpected(programs.error());
  // A host may ask for a wind, arrows and balls at any time.
  const auto wind = WindTextures::create();
  if (!wind) return tl::unexpected(wind.error());
  if (auto set = set_wind_of(*programs, &*wind); !set) return set;
  // A kind that does not build is left out of what is there from the start, but nothing is exchanged for it.
  for (const VegetationRenderer& layer : programs->vegetation)
    if (!layer.faults().empty()) return tl::unexpected(layer.faults().front());
  if (auto arrows = WindOverlay::create(shaders, bindings); !arrows) return tl::unexpected(arrows.error());
  if (auto balls = BallRenderer::create(shaders, bindings); !balls) return tl::unexpected(balls.error());
  return {};
}

Expected<SceneRenderer> SceneRenderer::create(const Scene& scene, const SceneTerrain& terrain,
                                              const gl::ShaderLibrary& shaders, const gl::Bindings& bindings) {
  if (auto context = gl::require_context(); !context) return tl::unexpected(context.error());
  auto ground = make_ground(scene, terrain);
  if (!ground) return tl::unexpected(ground.error());
  return create(scene, terrain, std::move(*ground), shaders, bindings);
}

Expected<SceneRenderer> SceneRenderer::create(const Scene& scene, const SceneTerrain& terrain,
                                              gl::GroundTextures ground, const gl::ShaderLibrary& shaders,
                                              const gl::Bindings& bindings) {
  RoamOptions options;
  options.max_triangles = scene.max_triangles;
  options.target_px = scene.target_px;
  auto cpu = SceneFrame::create(scene.layers, terrain, options);
  if (!cpu) return tl::unexpected(cpu.error());
  if (auto excluded = cpu->exclude(scene.exclusions); !excluded) return tl::unexpected(excluded.error());
  auto frame = gl::Frame::create(bindings);
  if (!frame) return tl::unexpected(frame.error());
  auto library = with_kinds(shaders, scene.layers, scene.directory);
  if (!library) return tl::unexpected(library.error());
  auto programs = build_programs(scene.layers, scene.source, terrain, *library, bindings);
  if (!programs) return tl::unexpected(programs.error());
  std::optional<gl::Clipmap> clipmap;
  if (scene.source == TerrainSource::clipmap) {
    auto made = gl::Clipmap::create(terrain.surface());
    if (!made) return tl::unexpected(made.error());
    clipmap = std::move(*made);
  }
  std::optional<SceneWindReplay> wind;
  if (scene.wind) {
    auto made = SceneWindReplay::create(*scene.wind, terrain.colors().min_corner, terrain.colors().size);
    if (!made) return tl::unexpected(made.error());
    wind = std::move(*made);
  }
  auto replay = DisturbanceReplay::create(scene);
  if (!replay) return tl::unexpected(replay.error());
  const bool timed = gpu_can_time();
  auto impl = std::unique_ptr<Impl>(new Impl{terrain, scene.directory, std::move(*library), bindings, scene.layers,
                                             std::move(*frame), std::move(ground), std::move(*cpu), std::move(clipmap),
                                             std::move(*programs), GpuTimer(timed), GpuTimer(timed), GpuTimer(timed)});
  for (const VegetationRenderer& layer : impl->programs.vegetation) tell_faults(layer);
  impl->replay = std::move(*replay);
  impl->air.wind = std::move(wind);
  if (auto moved = impl->take_wind(); !moved) return tl::unexpected(moved.error());
  return SceneRenderer(std::move(impl));
}

Expected<SceneFrameStats> SceneRenderer::draw(const View& view, const gl::Lighting& lighting, double time_s,
                                              GLuint framebuffer, int samples, bool wait_for_stats) {
  Impl& self = *impl_;
  SceneFrameStats stats;
  if (auto streamed = self.stream(view, stats); !streamed) return tl::unexpected(streamed.error());
  if (auto followed = self.follow(view, time_s, stats); !followed) return tl::unexpected(followed.error());
  if (auto blown = self.blow(view, time_s); !blown) return tl::unexpected(blown.error());

  if (auto touched = self.disturb(view, time_s); !touched) return tl::unexpected(touched.error());
  self.sun_azimuth = lighting.sun_azimuth;
  self.frame.upload(view, lighting, time_s, samples);
  // Plants first: ground that they hide is not shaded.
  if (self.vegetation_on) {
    if (auto drawn = self.draw_vegetation(view, framebuffer, stats); !drawn) return tl::unexpected(drawn.error());
  }
  self.terrain_timer.begin();
  self.draw_terrain(view, stats);
  for (MeshRenderer& body : self.programs.meshes) body.draw(view, self.frame);
  self.terrain_timer.end();
  if (self.ball_renderer) self.ball_renderer->draw(self.frame, view, self.balls);
  if (self.sky_on) self.programs.sky.draw(self.frame);
  if (self.air.arrows_on && self.air.wind)
    self.air.arrows->draw(self.frame, view, self.air.wind->wind(), self.terrain.surface());
  self.gather(wait_for_stats, stats);
  if (!self.clipmap) stats.bound_px = self.cpu.mesh().bound_px();
  return stats;
}

Expected<RoamStats> SceneRenderer::update(const View& view, double time_s) {
  SceneFrameStats ignored;
  if (auto streamed = impl_->stream(view, ignored); !streamed) return tl::unexpected(streamed.error());
  if (impl_->clipmap) return RoamStats{};
  return impl_->cpu.mesh().update(view, time_s);
}

void SceneRenderer::set_streaming(Streaming streaming) {
  impl_->streaming = streaming;
}

void SceneRenderer::set_vegetation(bool enabled) {
  impl_->vegetation_on = enabled;
}

void SceneRenderer::set_rasterisation(bool enabled) {
  impl_->rasterised = enabled;
}

void SceneRenderer::set_sky(bool enabled) {
  impl_->sky_on = enabled;
}

Expected<void> SceneRenderer::set_wind_overlay(bool enabled) {
  if (enabled && !impl_->air.arrows) {
    auto arrows = WindOverlay::create(impl_->shaders, impl_->bindings);
    if (!arrows) return tl::unexpected(arrows.error());
    impl_->air.arrows = std::move(*arrows);
  }
  impl_->air.arrows_on = enabled;
  return {};
}

Expected<void> SceneRenderer::set_balls(std::span<const RollingBall> balls) {
  impl_->balls.assign(balls.begin(), balls.end());
  if (balls.empty() || impl_->ball_renderer) return {};
  auto made = BallRenderer::create(impl_->shaders, impl_->bindings);
  if (!made) return tl::unexpected(made.error());
  impl_->ball_renderer = std::move(*made);
  return {};
}

Wind& SceneRenderer::wind() {
  if (!impl_->air.wind) {
    auto made = SceneWindReplay::create(dead_air(), glm::dvec2(0), glm::dvec2(1));
    SWARD_ASSERT(made, "dead air is always possible");
    const auto followed = made->follow(impl_->air.time_s, impl_->air.eye);
    SWARD_ASSERT(followed, "the last frame was drawn from there");
    impl_->air.wind = std::move(*made);
  }
  return impl_->air.wind->wind();
}

Expected<void> SceneRenderer::set_layer(size_t index, const Layer& layer) {
  SWARD_ASSERT(index < impl_->layers.size(), "set_layer: no layer has this index");
  auto vegetation = build_vegetation(layer, impl_->source(), impl_->shaders, impl_->bindings);
  if (!vegetation) return tl::unexpected(vegetation.error());
  if (auto set = vegetation->set_wind(impl_->air.textures ? &*impl_->air.textures : nullptr); !set) return set;
  if (!vegetation->faults().empty()) return tl::unexpected(vegetation->faults().front());
  if (impl_->clipmap) {
    const SceneTerrain& terrain = impl_->terrain;
    auto seeder = ClipmapSeeder::create(layer, terrain.surface(), terrain.colors(), impl_->shaders, impl_->bindings);
    if (!seeder) return tl::unexpected(seeder.error());
    impl_->programs.seeders[index] = std::move(*seeder);
  }
  impl_->programs.vegetation[index] = std::move(*vegetation);
  impl_->cpu.set_layer(index, layer);
  impl_->layers[index] = layer;
  return {};
}

void SceneRenderer::set_season(float season) {
  for (VegetationRenderer& layer : impl_->programs.vegetation) layer.set_season(season);
  for (ClipmapSeeder& seeder : impl_->programs.seeders) seeder.set_season(season);
  for (Layer& layer : impl_->layers) layer.season = season;
  impl_->cpu.set_season(season);
}

Disturbance& SceneRenderer::disturbance() {
  return impl_->replay->disturbance();
}

Exclusions& SceneRenderer::exclusions() {
  return impl_->cpu.exclusions();
}

RoamMesh& SceneRenderer::mesh() {
  return impl_->cpu.mesh();
}

const std::vector<Layer>& SceneRenderer::layers() const {
  return impl_->layers;
}

std::vector<Plant> SceneRenderer::plants_cpu(const View& view) const {
  const Disturbance* disturbance = &impl_->replay->disturbance();
  if (!impl_->clipmap) return impl_->cpu.plants(view, impl_->terrain.colors(), impl_->sun_azimuth, disturbance);
  std::vector<Plant> all;
  for (size_t i = 0; i < impl_->programs.seeders.size(); ++i) {
    FixedTriangles triangles;
    Seeding seeding;
    impl_->programs.seeders[i].read_back(view, *impl_->clipmap, triangles, seeding);
    std::vector<Plant> grown = grow_plants(impl_->layers[i], view, impl_->terrain.colors(), triangles, seeding,
                                           impl_->sun_azimuth, disturbance);
    for (Plant& plant : grown) plant.species += impl_->cpu.layers()[i].first_species;
    all.insert(all.end(), grown.begin(), grown.end());
  }
  return all;
}

Expected<std::vector<Plant>> SceneRenderer::plants_gpu(const View& view, GLuint framebuffer) {
  std::vector<Plant> all;
  for (size_t i = 0; i < impl_->programs.vegetation.size(); ++i) {
    const LayerFrame& layer = impl_->cpu.layers()[i];
    Seeding seeded;
    FixedTriangles triangles;
    if (impl_->clipmap) impl_->programs.seeders[i].read_back(view, *impl_->clipmap, triangles, seeded);
    const Seeding& seeding = impl_->clipmap ? seeded : layer.seeding;
    auto grown = impl_->programs.vegetation[i].read_back(impl_->frame, impl_->ground, view, seeding, framebuffer);
    if (!grown) return tl::unexpected(grown.error());
    for (Plant& plant : *grown) plant.species += layer.first_species;
    all.insert(all.end(), grown->begin(), grown->end());
  }
  return all;
}

}  // namespace sward::host
