// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Every public entry point that calls GL, in a context whose state is poisoned: what it leaves is what its comment
// says, and a picture drawn there is the picture drawn in a clean context.
#include <sward/gl/program_binaries.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <regex>
#include <set>

#include "gl/contract_scene.h"
#include "gl/gl_fixture.h"
#include "host/render_target.h"

namespace sward {
namespace {

using namespace test;

/// All objects, ready for any call.
struct Objects {
  ContractWorld world;
  ContractScene scene{world};
  ContractClipmap clipmap{world};
  WindTextures wind = made(WindTextures::create());
  DisturbanceTextures disturbed = made(DisturbanceTextures::create());
  MeshRenderer body = made(MeshRenderer::create(world.body, world.layer, gl::ShaderLibrary()));
  gl::SlopeMap slopes = made(gl::SlopeMap::create(*world.ground.surface));
  SlotBuffer slots{16};
  gl::ProgramBinaries binaries;
  gl::Program program = made(scene.shaders.build(mesh_body()));
  host::RenderTarget target = made(host::RenderTarget::create(k_contract_size, 1));
  Seeding seeding;
  FixedTriangles triangles;

  static gl::ProgramDesc mesh_body() {
    gl::ProgramDesc desc;
    desc.name = "mesh_body";
    desc.vertex = "mesh_body.vert.glsl";
    desc.fragment = "mesh_body.frag.glsl";
    desc.defines = gl::binding_defines({});
    return desc;
  }

  Objects() {
    // A whole frame of each, so that no call is the first.
    target.begin();
    scene.draw(target.framebuffer());
    clipmap.draw(scene.view, scene.frame, scene.textures, target.framebuffer());
  }
};

using Left = GlState (*)(const gl::Bindings&, GLuint framebuffer);

struct Entry {
  const char* name;  ///< As the header has it: class and function; functions outside of classes alone.
  std::function<void(Objects&)> call;
  Left left = nullptr;                        ///< Null: everything is as it was.
  std::function<void(Objects&)> before = {};  ///< In clean state.
};

GlState left_by(std::initializer_list<GLuint> uniforms, std::initializer_list<GLuint> units) {
  GlState left{{"program", {0}}, {"vertex array", {0}}};
  for (const GLuint index : uniforms) add_empty_uniforms(left, index);
  for (const GLuint unit : units) add_empty_unit(left, unit);
  return left;
}

GlState left_by_terrain(const gl::Bindings& b, GLuint) {
  return left_by({b.frame, b.materials, b.disturbance},
                 {b.base_map, b.slope_map, b.detail, b.detail_slope, b.disturbance_map});
}

GlState left_by_clipmap(const gl::Bindings& b, GLuint) {
  GlState left = left_by_terrain(b, 0);
  left.merge(left_by({b.clipmap}, {b.clipmap_heights, b.clipmap_relief}));
  return left;
}

GlState left_by_body(const gl::Bindings& b, GLuint) {
  return left_by({b.frame}, {});
}

GlState left_by_classify(const gl::Bindings& b, GLuint framebuffer) {
  GlState left = left_by({b.frame, b.species}, {b.base_map_raw, b.triangles, b.surface, b.exclusions, b.placement});
  left["transform feedback"] = {0};
  left["draw framebuffer"] = {double(framebuffer)};
  left["rasterizer discard"] = {0};
  // Of the transform feedback object, which is another one afterwards.
  for (int i = 0; i < 4; ++i) left["feedback buffer " + std::to_string(i)] = {0};
  return left;
}

GlState left_by_read_back(const gl::Bindings& b, GLuint framebuffer) {
  GlState left = left_by_classify(b, framebuffer);
  left.merge(left_by({b.disturbance}, {b.disturbance_map}));
  left["query buffer"] = {0};
  return left;
}

GlState left_by_plants(const gl::Bindings& b, GLuint) {
  GlState left = left_by({b.frame, b.species, b.materials, b.disturbance},
                         {b.base_map, b.base_map_raw, b.triangles, b.surface, b.exclusions, b.placement, b.blade_shape,
                          b.plant_images, b.plant_mesh, b.detail, b.detail_slope, b.disturbance_map});
  left["patch vertices"] = {1};
  // Where draws go in parts the counts of clusters are read.
  if (gl::software_renderer()) left["query buffer"] = {0};
  return left;
}

GlState left_by_windy_plants(const gl::Bindings& b, GLuint) {
  GlState left = left_by_plants(b, 0);
  left.merge(left_by({b.wind}, {b.wind_maps, b.wind_grid, b.wind_painted}));
  return left;
}

GlState left_by_clipmap_classify(const gl::Bindings& b, GLuint framebuffer) {
  GlState left = left_by_classify(b, framebuffer);
  left["indirect buffer"] = {0};
  return left;
}

GlState left_by_clipmap_plants(const gl::Bindings& b, GLuint) {
  GlState left = left_by_plants(b, 0);
  left.merge(left_by({b.clipmap}, {b.clipmap_heights}));
  return left;
}

GlState left_by_seeder(const gl::Bindings& b, GLuint) {
  GlState left{{"program", {0}}};
  for (const GLuint index : {b.clipmap, b.seeding}) add_empty_uniforms(left, index);
  for (const GLuint index : {b.seed_ground, b.seed_counts, b.seed_groups, b.seed_frame, b.seed_records})
    left["storage buffer " + std::to_string(index)] = {0};
  add_empty_unit(left, b.clipmap_heights);
  return left;
}

GlState left_by_queries(const gl::Bindings&, GLuint) {
  return {{"query buffer", {0}}};
}

template <class T>
void check(const Expected<T>& result) {
  ASSERT_TRUE(result) << result.error().message;
}

LatticeBox some_box() {
  return {{0, 0}, {4096, 4096}};
}

std::vector<Entry> gl_plumbing() {
  return {
      {"Frame::create", [](Objects&) { check(gl::Frame::create()); }},
      {"Frame::upload", [](Objects& o) { o.scene.frame.upload(o.scene.view, {}, 2, 1); }},
      {"GroundTextures::create",
       [](Objects& o) {
         check(gl::GroundTextures::create(*o.world.ground.field, o.world.map));
         check(gl::GroundTextures::create(*o.world.ground.surface, o.world.map));
         check(gl::GroundTextures::create(o.world.map));
       }},
      {"GroundTextures::update_slopes",
       [](Objects& o) { o.scene.textures.update_slopes(*o.world.ground.field, some_box()); }},
      {"GroundTextures::set_materials",
       [](Objects& o) { check(o.scene.textures.set_materials(default_ground_materials())); }},
      {"SlopeMap::create",
       [](Objects& o) {
         check(gl::SlopeMap::create(*o.world.ground.field));
         check(gl::SlopeMap::create(*o.world.ground.surface, {.whole_texels = 8, .window_texels = 512}));
       }},
      {"SlopeMap::create_level",
       [](Objects&) {
         check(gl::SlopeMap::create_level({-50, -40}, {100, 80}));
       }},
      {"SlopeMap::follow",
       [](Objects& o) {
         o.slopes.follow(*o.world.ground.surface, {0, 0}, 100);
       }},
      {"SlopeMap::update", [](Objects& o) { o.slopes.update(*o.world.ground.field, some_box()); }},
      {"Clipmap::create", [](Objects& o) { check(gl::Clipmap::create(*o.world.ground.surface, {64})); }},
      {"Clipmap::follow",
       [](Objects& o) {
         o.clipmap.clipmap.changed(some_box());
         EXPECT_GT(o.clipmap.clipmap.follow(o.scene.view).points, 0u);
       }},
      {"ShaderLibrary::build", [](Objects& o) { check(o.scene.shaders.build(Objects::mesh_body())); }},
      {"ProgramBinaries::store", [](Objects& o) { o.binaries.store("text", o.program); }},
      {"ProgramBinaries::take", [](Objects& o) { o.binaries.take("text"); }, nullptr,
       [](Objects& o) { o.binaries.store("text", o.program); }},
      {"create_buffer", [](Objects&) { gl::create_buffer(); }},
      {"create_texture", [](Objects&) { gl::create_texture(GL_TEXTURE_2D); }},
      {"create_vertex_array", [](Objects&) { gl::create_vertex_array(); }},
      {"create_query", [](Objects&) { gl::create_query(GL_SAMPLES_PASSED); }},
      {"name_query", [](Objects&) { gl::name_query(); }},
      {"create_feedback", [](Objects&) { gl::create_feedback(); }},
      {"create_framebuffer", [](Objects&) { gl::create_framebuffer(); }},
      {"DefaultUnpack", [](Objects&) { const gl::DefaultUnpack unpack; }},
      {"require_context", [](Objects&) { check(gl::require_context()); }},
      {"software_renderer", [](Objects&) { gl::software_renderer(); }},
      {"storage_bytes",
       [](Objects& o) {
         EXPECT_EQ(gl::storage_bytes(gl::create_buffer()), 0u);
         EXPECT_GT(o.scene.textures.gpu_bytes(), 1000u);
       }},
      {"current_context", [](Objects&) { EXPECT_NE(gl::current_context(), nullptr); }},
  };
}

std::vector<Entry> terrain_entries() {
  return {
      {"TerrainRenderer::create", [](Objects& o) { check(TerrainRenderer::create(o.scene.shaders)); }},
      {"TerrainRenderer::upload", [](Objects& o) { EXPECT_GT(o.scene.terrain.upload(o.scene.mesh), 0u); }, nullptr,
       [](Objects& o) {
         o.scene.look(view_over(o.world.ground, {9.0, -2.0}, 1.7, 60, -15, k_contract_size));
       }},
      {"TerrainRenderer::draw", [](Objects& o) { o.scene.terrain.draw(o.scene.view, o.scene.frame, o.scene.textures); },
       left_by_terrain},
      {"ClipmapRenderer::create", [](Objects& o) { check(ClipmapRenderer::create(o.scene.shaders)); }},
      {"ClipmapRenderer::draw",
       [](Objects& o) { o.clipmap.terrain.draw(o.scene.view, o.clipmap.clipmap, o.scene.frame, o.scene.textures); },
       left_by_clipmap},
      {"SlotBuffer::fit", [](Objects& o) { EXPECT_TRUE(o.slots.fit(100)); }},
      {"SlotBuffer::write_all", [](Objects& o) { o.slots.write_all(std::vector<std::byte>(160).data(), 10); }, nullptr,
       [](Objects& o) { o.slots.fit(100); }},
      {"SlotBuffer::write_slots",
       [](Objects& o) {
         const uint32_t changed[] = {2, 7};
         EXPECT_GT(o.slots.write_slots(std::vector<std::byte>(160).data(), 10, changed), 0u);
       },
       nullptr, [](Objects& o) { o.slots.fit(100); }},
  };
}

std::vector<Entry> plant_entries() {
  return {
      {"VegetationRenderer::create", [](Objects& o) { check(VegetationRenderer::create(o.world.layer, {})); }},
      {"VegetationRenderer::create_for_clipmap",
       [](Objects& o) { check(VegetationRenderer::create_for_clipmap(o.world.layer, {})); }},
      {"VegetationRenderer::set_season", [](Objects& o) { o.scene.plants.set_season(0.5f); }},
      {"VegetationRenderer::set_values", [](Objects& o) { check(o.scene.plants.set_values(0, {})); }},
      {"VegetationRenderer::set_wind", [](Objects& o) { check(o.scene.plants.set_wind(&o.wind)); }},
      {"VegetationRenderer::upload",
       [](Objects& o) {
         check(o.scene.plants.upload(o.scene.seeding, o.scene.triangles, o.scene.view));
         o.clipmap.plants.upload(o.clipmap.seeder, o.clipmap.clipmap, o.scene.view);
       }},
      {"VegetationRenderer::classify",
       [](Objects& o) { o.scene.plants.classify(o.scene.frame, o.scene.textures, o.target.framebuffer()); },
       left_by_classify},
      {"VegetationRenderer::classify",
       [](Objects& o) { o.clipmap.plants.classify(o.scene.frame, o.scene.textures, o.target.framebuffer()); },
       left_by_clipmap_classify},
      {"VegetationRenderer::draw", [](Objects& o) { o.scene.plants.draw(o.scene.frame, o.scene.textures); },
       left_by_plants},
      {"VegetationRenderer::draw", [](Objects& o) { o.scene.plants.draw(o.scene.frame, o.scene.textures); },
       left_by_windy_plants, [](Objects& o) { check(o.scene.plants.set_wind(&o.wind)); }},
      {"VegetationRenderer::draw", [](Objects& o) { o.clipmap.plants.draw(o.scene.frame, o.scene.textures); },
       left_by_clipmap_plants},
      {"VegetationRenderer::stats", [](Objects& o) { EXPECT_GT(o.scene.plants.stats(true).clusters_fertile, 0u); },
       left_by_queries},
      {"VegetationRenderer::read_back",
       [](Objects& o) {
         check(o.scene.plants.read_back(o.scene.frame, o.scene.textures, o.scene.view, o.scene.seeding,
                                        o.target.framebuffer()));
       },
       left_by_read_back},
      {"ClipmapSeeder::create",
       [](Objects& o) { check(ClipmapSeeder::create(o.world.layer, *o.world.ground.surface, o.world.map, {})); }},
      {"ClipmapSeeder::seed", [](Objects& o) { check(o.clipmap.seeder.seed(o.scene.view, o.clipmap.clipmap)); },
       left_by_seeder},
      {"ClipmapSeeder::stats", [](Objects& o) { EXPECT_GT(o.clipmap.seeder.stats(true).seeded, 0u); }},
      {"ClipmapSeeder::read_back",
       [](Objects& o) { o.clipmap.seeder.read_back(o.scene.view, o.clipmap.clipmap, o.triangles, o.seeding); }},
      {"MeshRenderer::create", [](Objects& o) { check(MeshRenderer::create(o.world.body, o.world.layer, {})); }},
      {"MeshRenderer::draw", [](Objects& o) { o.body.draw(o.scene.view, o.scene.frame); }, left_by_body},
      {"WindTextures::create", [](Objects&) { check(WindTextures::create()); }},
      {"WindTextures::upload", [](Objects& o) { EXPECT_GT(o.wind.upload(o.world.wind, o.scene.view.eye).bytes, 0u); }},
      {"DisturbanceTextures::create", [](Objects&) { check(DisturbanceTextures::create()); }},
      {"DisturbanceTextures::upload",
       [](Objects& o) {
         EXPECT_GT(o.disturbed.upload(o.world.disturbance, {0, 0}).tiles, 0u);
       }},
  };
}

/// gpu_bytes() of every class that has it.
std::vector<Entry> memory_entries() {
  return {
      {"Frame::gpu_bytes", [](Objects& o) { EXPECT_EQ(o.scene.frame.gpu_bytes(), sizeof(gl::FrameUniforms)); }},
      {"GroundTextures::gpu_bytes", [](Objects& o) { EXPECT_GT(o.scene.textures.gpu_bytes(), 0u); }},
      {"SlopeMap::gpu_bytes", [](Objects& o) { EXPECT_GT(o.slopes.gpu_bytes(), 65u * 65 * 4); }},
      {"Clipmap::gpu_bytes", [](Objects& o) { EXPECT_GT(o.clipmap.clipmap.gpu_bytes(), 64u * 64 * 8); }},
      {"SlotBuffer::gpu_bytes",
       [](Objects&) {
         SlotBuffer slots(16);
         slots.fit(5000);
         EXPECT_EQ(slots.gpu_bytes(), 5000u * 16);
       }},
      {"TerrainRenderer::gpu_bytes", [](Objects& o) { EXPECT_GT(o.scene.terrain.gpu_bytes(), 0u); }},
      {"ClipmapRenderer::gpu_bytes", [](Objects& o) { EXPECT_GT(o.clipmap.terrain.gpu_bytes(), 0u); }},
      {"VegetationRenderer::gpu_bytes", [](Objects& o) { EXPECT_GT(o.scene.plants.gpu_bytes(), 0u); }},
      {"ClipmapSeeder::gpu_bytes", [](Objects& o) { EXPECT_GT(o.clipmap.seeder.gpu_bytes(), 0u); }},
      {"MeshRenderer::gpu_bytes", [](Objects& o) { EXPECT_EQ(o.body.gpu_bytes(), 3u * 28); }},
      {"WindTextures::gpu_bytes", [](Objects& o) { EXPECT_GT(o.wind.gpu_bytes(), 500000u); }},
      {"DisturbanceTextures::gpu_bytes",
       [](Objects& o) { EXPECT_EQ(o.disturbed.gpu_bytes(), 256u * 256 * 9 * 8 + sizeof(gl::DisturbanceBlock)); }},
  };
}

std::vector<Entry> all_entries() {
  std::vector<Entry> all = gl_plumbing();
  for (const auto& more : {terrain_entries(), plant_entries(), memory_entries()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

class StateContract : public GlTest {};

TEST_F(StateContract, EntryPointsLeaveWhatTheirCommentsSay) {
  Objects objects;
  host::RenderTarget other = made(host::RenderTarget::create({8, 8}, 1));
  for (const Entry& entry : all_entries()) {
    SCOPED_TRACE(entry.name);
    if (entry.before) entry.before(objects);
    const PoisonedState poison(Poison::everything);
    glBindFramebuffer(GL_FRAMEBUFFER, other.framebuffer());
    const GlState before = capture_state();
    entry.call(objects);
    const GlState after = capture_state();
    const GLuint framebuffer = objects.target.framebuffer();
    expect_only_changed(before, after, entry.left != nullptr ? entry.left({}, framebuffer) : GlState());
    check(objects.scene.plants.set_wind(nullptr));
  }
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

TEST_F(StateContract, DestructionLeavesAllStateAsItWas) {
  auto objects = std::make_unique<Objects>();
  host::RenderTarget other = made(host::RenderTarget::create({8, 8}, 1));
  const PoisonedState poison(Poison::everything);
  glBindFramebuffer(GL_FRAMEBUFFER, other.framebuffer());
  const GlState before = capture_state();
  objects.reset();
  expect_only_changed(before, capture_state(), {});
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

/// Draws a frame of the whole scene and reads it.
template <class Draw>
std::vector<uint8_t> picture(Objects& o, Draw draw) {
  o.target.begin();
  draw();
  return o.target.read_rgb();
}

TEST_F(StateContract, IndifferentStateChangesNoPicture) {
  Objects o;
  check(o.scene.textures.set_materials(default_ground_materials()));
  check(o.scene.plants.set_wind(&o.wind));
  const auto mesh = [&] {
    o.wind.upload(o.world.wind, o.scene.view.eye);
    o.disturbed.upload(o.world.disturbance, glm::dvec2(o.scene.view.eye));
    o.scene.textures.set_disturbed(o.disturbed.ground());
    o.scene.draw(o.target.framebuffer());
    o.body.draw(o.scene.view, o.scene.frame);
  };
  const auto clipmap = [&] { o.clipmap.draw(o.scene.view, o.scene.frame, o.scene.textures, o.target.framebuffer()); };
  for (const std::function<void()>& draw : {std::function<void()>(mesh), std::function<void()>(clipmap)}) {
    const std::vector<uint8_t> clean = picture(o, draw);
    EXPECT_GT(std::ranges::count_if(clean, [](uint8_t c) { return c > 0; }), 1000);
    o.target.begin();
    {
      const PoisonedState poison;
      draw();
    }
    const std::vector<uint8_t> drawn = o.target.read_rgb();
    EXPECT_EQ(std::ranges::mismatch(drawn, clean).in1 - drawn.begin(), std::ptrdiff_t(clean.size()))
        << "first difference";
  }
}

TEST_F(StateContract, WhatIsCreatedInPoisonedStateDrawsTheSamePicture) {
  std::unique_ptr<Objects> clean = std::make_unique<Objects>(), poisoned;
  {
    const PoisonedState poison;
    poisoned = std::make_unique<Objects>();
  }
  std::vector<uint8_t> pictures[2];
  for (Objects* o : {clean.get(), poisoned.get()}) {
    {
      const std::unique_ptr<PoisonedState> poison(o == poisoned.get() ? new PoisonedState : nullptr);
      check(o->scene.textures.set_materials(default_ground_materials()));
      o->wind.upload(o->world.wind, o->scene.view.eye);
      o->disturbed.upload(o->world.disturbance, glm::dvec2(o->scene.view.eye));
    }
    check(o->scene.plants.set_wind(&o->wind));
    o->scene.textures.set_disturbed(o->disturbed.ground());
    pictures[o == poisoned.get()] = picture(*o, [&] {
      o->scene.draw(o->target.framebuffer());
      o->clipmap.draw(o->scene.view, o->scene.frame, o->scene.textures, o->target.framebuffer());
    });
  }
  EXPECT_EQ(pictures[0], pictures[1]);
}

// ---- No entry point without a row.

/// Public functions of these classes that call no GL. A new function stands here, or has a row above.
const std::set<std::string> k_without_gl = {
    "binding_defines", "make_clipmap_uniforms", "make_frame_uniforms", "embedded_shaders", "Clipmap::changed",
    "Clipmap::rings", "Clipmap::heights", "Clipmap::relief", "Clipmap::block", "Lighting::clear_day", "Frame::buffer",
    "Frame::bindings", "Frame::samples", "GroundTextures::set_disturbed", "GroundTextures::disturbed",
    "GroundTextures::materials", "GroundTextures::detail", "GroundTextures::detail_slope", "GroundTextures::base_map",
    "GroundTextures::base_map_raw", "GroundTextures::slopes", "GroundTextures::map_min", "GroundTextures::map_size",
    "GroundTextures::data_min", "GroundTextures::data_max", "GroundTextures::texels", "Handle::wrap", "Handle::id",
    "Handle::release", "HomeContext::of_current", "HomeContext::here", "HomeContext::shared_here",
    // Called by handles alone; DestructionLeavesAllStateAsItWas covers them.
    "BufferTraits::destroy", "TextureTraits::destroy", "VertexArrayTraits::destroy", "ProgramTraits::destroy",
    "QueryTraits::destroy", "FeedbackTraits::destroy", "FramebufferTraits::destroy", "ProgramBinaries::binaries",
    "ProgramBinaries::add", "ProgramBinaries::taken", "ShaderLibrary::add_source", "ShaderLibrary::set_binaries",
    "ShaderLibrary::binaries", "ShaderLibrary::resolve", "SlopeMap::changed", "SlopeMap::settled", "SlopeMap::texture",
    "SlopeMap::layers", "SlopeMap::layer_min", "SlopeMap::layer_size", "SlopeMap::repeats", "SlopeMap::reach",
    "SlopeMap::spacing", "ClipmapRenderer::triangles", "ClipmapRenderer::blocks", "SlotBuffer::id",
    "TerrainRenderer::triangles", "VegetationRenderer::layer", "VegetationRenderer::faults", "ClipmapSeeder::layer",
    "ClipmapSeeder::set_season", "ClipmapSeeder::changed", "ClipmapSeeder::records", "ClipmapSeeder::exclusions",
    "ClipmapSeeder::draws", "ClipmapSeeder::draws_offset", "ClipmapSeeder::most_clusters", "ClipmapSeeder::seeded",
    "WindTextures::block", "WindTextures::maps", "WindTextures::grid", "WindTextures::painted",
    "DisturbanceTextures::ground", "DisturbanceTextures::block"};

/// Functions that a header declares in public, as class::function; constructors, destructors and operators left out.
std::set<std::string> declared_functions(const std::filesystem::path& header) {
  static const std::regex k_class(R"(^(class|struct)\s+(?:[A-Z_]+\s+)?(\w+)[^;]*\{.*$)");
  static const std::regex k_function(R"((?:^|[\s*&>])(\w+)\()");
  std::set<std::string> found;
  std::ifstream file(header);
  std::string line, type;
  bool open = true;
  while (std::getline(file, line)) {
    const std::string code = line.substr(0, line.find("//"));
    std::smatch match;
    if (std::regex_match(code, match, k_class) && code.find("};") == code.npos) {
      type = match[2];
      open = match[1] == "struct";
    } else if (code.starts_with("};")) {
      type.clear();
      open = true;
    } else if (code.starts_with(" public:")) {
      open = true;
    } else if (code.starts_with(" private:")) {
      open = false;
    }
    // A declaration begins at its scope's own indentation.
    const size_t indent = code.find_first_not_of(' ');
    const bool begins =
        indent == (type.empty() ? 0u : 2u) && !code.starts_with("#") && code.find("operator") == code.npos;
    if (!open || !begins || code.find("static_assert") != code.npos || !std::regex_search(code, match, k_function))
      continue;
    const std::string name = match[1];
    if (name != type) found.insert(type.empty() ? name : type + "::" + name);
  }
  return found;
}

TEST(StateContractTable, HasARowForEveryPublicEntryPoint) {
  std::vector<std::filesystem::path> headers;
  for (const char* folder : {"terrain/include/sward/gl", "terrain/include/sward/terrain_gl"})
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(SWARD_SOURCE) / folder))
      headers.push_back(entry.path());
  for (const char* name :
       {"vegetation_renderer.h", "clipmap_seeding.h", "mesh_renderer.h", "wind_textures.h", "disturbance_textures.h"})
    headers.push_back(std::filesystem::path(SWARD_SOURCE) / "vegetation/include/sward/vegetation" / name);
  std::set<std::string> rows;
  for (const Entry& entry : all_entries()) rows.insert(entry.name);
  std::set<std::string> declared;
  for (const auto& header : headers) declared.merge(declared_functions(header));
  for (const std::string& name : declared)
    EXPECT_NE(rows.contains(name), k_without_gl.contains(name)) << name << " needs one place: a row, or k_without_gl";
  rows.erase("DefaultUnpack");  // its constructor
  for (const std::string& name : rows) EXPECT_TRUE(declared.contains(name)) << "no header declares " << name;
  EXPECT_GE(rows.size(), 50u);
}

}  // namespace
}  // namespace sward
