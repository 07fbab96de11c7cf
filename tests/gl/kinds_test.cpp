// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What growth draws of kinds other than blades: tufts, flowers, kinds of a host's own.
#include <sward/vegetation/blade_shape.h>
#include <sward/vegetation/wind_textures.h>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "gl/vegetation_fixture.h"
#include "host/render_target.h"
#include "vegetation/layer_params.h"
#include "vegetation/vegetation_renderer_stages.h"

namespace sward {
namespace {

using namespace test;

class Kinds : public GlTest {};

constexpr glm::ivec2 k_size{480, 360};

struct Picture {
  std::vector<uint8_t> rgb;
  glm::ivec3 at(int x, int y) const {
    const uint8_t* p = &rgb[size_t(y * k_size.x + x) * 3];
    return {p[0], p[1], p[2]};
  }
};

bool lit(glm::ivec3 color) {
  return color.x + color.y + color.z > 0;
}
bool red(glm::ivec3 color) {
  return color.x > 24 && color.x > 2 * color.y && color.x > 2 * color.z;
}
bool blue(glm::ivec3 color) {
  return color.z > 40 && color.z > 2 * color.x && color.z > 2 * color.y;
}

/// Plants alone on black.
Picture render(Patch& patch, const View& view) {
  auto target = host::RenderTarget::create(k_size, patch.samples);
  EXPECT_TRUE(target) << target.error().message;
  target->begin();
  patch.look(view);
  patch.classify(target->framebuffer());
  patch.draw();
  EXPECT_FALSE(patch.renderer().stats(true).overflow);
  return {target->read_rgb()};
}

glm::dvec2 pixel_of(const View& view, glm::dvec3 world) {
  const glm::dvec4 clip = view.clip_from_relative() * glm::dvec4(world - view.eye, 1.0);
  const glm::dvec2 ndc = glm::dvec2(clip) / clip.w;
  return {(ndc.x * 0.5 + 0.5) * k_size.x, (0.5 - ndc.y * 0.5) * k_size.y};
}

bool inside(glm::dvec2 pixel, double margin) {
  return pixel.x > margin && pixel.y > margin && pixel.x < k_size.x - margin && pixel.y < k_size.y - margin;
}

View from_above(double height) {
  return View::look({8.0, -8.0, height}, std::numbers::pi / 2, -0.5 * std::numbers::pi, 1.2, k_size, 0.05, 1000);
}

/// One species, few plants, full-grown, everything near.
Layer sparse(const Species& species, float density) {
  Layer layer;
  layer.species = {species};
  layer.density = density;
  layer.plain = true;
  layer.shadows = false;
  layer.full_distance_m = layer.horizon_m = layer.full_segments_m = 60;
  return layer;
}

/// Red heads on upright stems.
Species red_flower() {
  Species species = grass_of("flower", k_green);
  species.kind = PlantKind::flower;
  species.height_m = {0.6f, 0.9f};
  species.width_m = {0.01f, 0.01f};
  species.stiffness = {0.9f, 0.9f};
  species.lean = 0;
  species.flower.petal_colors = {{0.9f, 0.02f, 0.02f}};
  species.flower.centre_color = {0.9f, 0.02f, 0.02f};
  species.flower.head_m = {0.2f, 0.2f};
  species.flower.petals = 9;
  return species;
}

Species tuft(int least, int most) {
  Species species = grass_of("tuft", k_green);
  species.kind = PlantKind::tuft;
  species.tuft.blades = {least, most};
  return species;
}

/// A plant's own numbers beyond its traits, as the shaders draw them.
uint32_t state_of(const Layer& layer, const Plant& plant) {
  const shared::LayerParams params = make_layer_params(layer, from_above(10), {}, 0);
  const glm::uvec2 id(uint32_t(plant.triangle.bits), uint32_t(plant.triangle.bits >> 32));
  return shared::make_traits(make_species_params(layer)[plant.species], params, id, plant.rank, plant.score).state;
}

/// Where a plant's curve ends.
glm::dvec3 tip_of(const Plant& plant, const BladeShapes& shapes) {
  const float column = plant.stiffness * (k_blade_columns - 1);
  const size_t left = std::min(size_t(column), size_t(k_blade_columns - 2));
  const size_t row = size_t(k_blade_rows - 1) * k_blade_columns;
  const glm::dvec3 shape(glm::mix(shapes.texels[row + left], shapes.texels[row + left + 1], column - float(left)));
  const glm::dvec3 way(std::cos(plant.azimuth) * shape.x, std::sin(plant.azimuth) * shape.x, shape.y);
  return plant.position + double(plant.height) * way;
}

TEST_F(Kinds, HeadsStandAtTheEndsOfTheirStems) {
  const auto shapes = make_blade_shapes();
  ASSERT_TRUE(shapes) << shapes.error().message;
  // All heads petals, then all heads dots.
  for (const float diameter : {0.25f, 0.04f}) {
    Species species = red_flower();
    species.flower.head_m = {diameter, diameter};
    Patch patch(sparse(species, 0.5f), plain_map(k_side, 8, k_green));
    patch.level = 5;
    patch.samples = std::min(4, host::RenderTarget::max_samples());
    const View view = eye_level_view({8.0, -15.5, 1.6}, k_size, -12);
    const Picture picture = render(patch, view);
    std::vector<std::pair<glm::dvec2, double>> heads;  // pixel, largest reach in pixels
    size_t checked = 0, missing = 0;
    for (const Plant& plant : patch.plants_of_gpu()) {
      const glm::dvec3 tip = tip_of(plant, *shapes);
      if (tip.y - view.eye.y < 0.1) continue;
      const glm::dvec2 pixel = pixel_of(view, tip);
      const double distance = glm::length(tip - view.eye);
      // Off the picture's middle perspective stretches.
      const double reach = 0.75 * diameter * view.focal_px().y / distance;
      heads.emplace_back(pixel, reach + 2.5);
      if (!inside(pixel, 4) || distance < 2 || distance > 12) continue;
      bool found = false;
      for (int i = 0; i < 9; ++i) found = found || red(picture.at(int(pixel.x) + i % 3 - 1, int(pixel.y) + i / 3 - 1));
      missing += !found;
      ++checked;
    }
    EXPECT_GE(checked, 20u);
    // A stem of another may stand before a small head.
    EXPECT_LE(double(missing), 0.1 * double(checked)) << diameter;
    size_t astray = 0, all = 0;
    for (int y = 0; y < k_size.y; ++y) {
      for (int x = 0; x < k_size.x; ++x) {
        if (!red(picture.at(x, y))) continue;
        ++all;
        const glm::dvec2 pixel(x + 0.5, y + 0.5);
        astray += std::none_of(heads.begin(), heads.end(),
                               [&](const auto& head) { return glm::distance(head.first, pixel) < head.second; });
      }
    }
    EXPECT_GT(all, 100u);
    EXPECT_EQ(astray, 0u) << "of " << all;
  }
}

TEST_F(Kinds, EachFlowerHasTheColourOfItsOwnNumber) {
  Species species = red_flower();
  species.flower.petal_colors = {{0.9f, 0.02f, 0.02f}, {0.02f, 0.02f, 0.9f}};
  species.flower.petal_shares = {3, 1};
  species.flower.centre_share = 0;
  species.flower.head_m = {0.3f, 0.3f};
  const Layer layer = sparse(species, 1.0f);
  Patch patch(layer, plain_map(k_side, 8, k_green));
  const View view = from_above(14);
  const Picture picture = render(patch, view);
  const auto shapes = make_blade_shapes();
  ASSERT_TRUE(shapes) << shapes.error().message;
  const shared::SpeciesParams params = make_species_params(layer)[0];
  size_t seen[2] = {0, 0}, other = 0;
  for (const Plant& plant : patch.plants_of_gpu()) {
    const glm::dvec2 pixel = pixel_of(view, tip_of(plant, *shapes));
    if (!inside(pixel, 3)) continue;
    const int expected = shared::petal_choice(params, state_of(layer, plant));
    const glm::ivec3 color = picture.at(int(pixel.x), int(pixel.y));
    // Another head may stand before this one.
    if ((expected == 0 && red(color)) || (expected == 1 && blue(color))) {
      ++seen[expected];
    } else {
      ++other;
    }
  }
  const double all = double(seen[0] + seen[1]);
  EXPECT_GT(all, 150.0);
  EXPECT_LT(double(other), 0.1 * all);
  // 99.9 % of a binomial distribution.
  EXPECT_NEAR(double(seen[1]) / all, 0.25, 3.29 * std::sqrt(0.25 * 0.75 / all));
}

TEST_F(Kinds, TuftsHaveTheBladesOfTheirOwnNumber) {
  for (const int cluster : {1, 5, 8, 32}) {
    Species species = tuft(3, 9);
    species.max_segments = 1;
    Layer layer = sparse(species, 3);
    layer.cluster_size = cluster;
    Patch patch(layer, plain_map(k_side, 8, k_green));
    render(patch, from_above(14));
    size_t blades = 0, plants = 0;
    for (const Plant& plant : patch.plants_of_gpu()) {
      blades += size_t(shared::tuft_blades(make_species_params(layer)[0], state_of(layer, plant)));
      ++plants;
    }
    ASSERT_GT(plants, 300u);
    EXPECT_GT(blades, 5 * plants);
    // Of one segment a blade is one triangle.
    EXPECT_EQ(patch.renderer().stats(true).primitives, blades) << "clusters of " << cluster;
  }
}

TEST_F(Kinds, HeadsArePetalsNearAndDotsFar) {
  Species species = red_flower();
  species.max_segments = 1;
  for (const float diameter : {0.9f, 0.02f}) {
    species.flower.head_m = {diameter, diameter};
    Patch patch(sparse(species, 1), plain_map(k_side, 8, k_green));
    render(patch, from_above(14));
    const size_t plants = patch.plants_of_gpu().size();
    ASSERT_GT(plants, 100u);
    // Petals: two triangles of the centre, four quads; dots: a hexagon. A stem: a quad.
    const size_t head = diameter > 0.5f ? size_t(species.flower.petals) * 10 : 4;
    EXPECT_EQ(patch.renderer().stats(true).primitives, plants * (head + 2)) << diameter;
  }
}

TEST_F(Kinds, NothingIsDrawnBelowTheGround) {
  Species hanging = red_flower();
  hanging.stiffness = {0, 1};
  hanging.lean = 0.8f;
  hanging.flower.cup = -1;
  hanging.flower.leaves = 8;
  Species fallen = tuft(9, 9);
  fallen.stiffness = {0, 1};
  fallen.tuft.spread = 1.5f;
  for (const Species& species : {hanging, fallen}) {
    Patch patch(sparse(species, 4), plain_map(k_side, 8, k_green));
    // From the ground itself what is below it lies below the horizon, the picture's middle.
    const View view = View::look({8.0, -20.0, 0.0}, std::numbers::pi / 2, 0, 0.7, k_size, 0.05, 1000);
    const Picture picture = render(patch, view);
    size_t above = 0, below = 0;
    for (int y = 0; y < k_size.y; ++y)
      for (int x = 0; x < k_size.x; ++x) (y < k_size.y / 2 + 3 ? above : below) += lit(picture.at(x, y));
    EXPECT_GT(above, 2000u);
    EXPECT_EQ(below, 0u);
  }
}

double light_of(const Picture& picture) {
  double light = 0;
  for (const uint8_t channel : picture.rgb) {
    const double encoded = channel / 255.0;
    light += encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
  }
  return light;
}

struct Steadiness {
  double largest_step = 0;  ///< Between neighbours, as a share.
  double range = 1;         ///< Largest against least.
};

/// Light of a patch seen from rising heights, times what distance takes of it.
Steadiness light_by_height(Patch& patch, double low, double high, int steps) {
  std::vector<double> light;
  for (int i = 0; i <= steps; ++i) {
    const double height = low * std::pow(high / low, double(i) / steps);
    light.push_back(light_of(render(patch, from_above(height))) * height * height);
  }
  Steadiness result;
  for (size_t i = 1; i < light.size(); ++i)
    result.largest_step = std::max(result.largest_step, std::abs(light[i] / light[i - 1] - 1));
  const auto [least, most] = std::minmax_element(light.begin(), light.end());
  result.range = *most / *least;
  return result;
}

TEST_F(Kinds, HeadsKeepTheirAreaFromPetalsToDots) {
  // From 18 pixels to 2, between two pictures 6 % of height.
  Species species = red_flower();
  species.stiffness = {1, 1};
  species.height_m = {0.05f, 0.05f};
  species.flower.head_m = {0.9f, 0.9f};
  Layer layer = sparse(species, 0.4f);
  layer.full_distance_m = layer.horizon_m = 400;
  Patch patch(layer, plain_map(k_side, 8, k_green));
  patch.samples = std::min(4, host::RenderTarget::max_samples());
  const Steadiness steadiness = light_by_height(patch, 14, 130, 38);
  EXPECT_LT(steadiness.largest_step, 0.04);
  EXPECT_LT(steadiness.range, 1.25);
}

TEST_F(Kinds, TuftsKeepTheirAreaWithFewerBlades) {
  // From all blades to a third of them.
  Species species = tuft(6, 9);
  species.height_m = {0.4f, 0.6f};
  species.width_m = {0.1f, 0.1f};
  species.tuft.spread = 1.2f;
  species.max_segments = 1;
  Layer layer = sparse(species, 0.5f);
  layer.full_distance_m = layer.horizon_m = 1000;
  layer.full_segments_m = 14;
  Patch patch(layer, plain_map(k_side, 8, k_green));
  patch.samples = std::min(4, host::RenderTarget::max_samples());
  const Steadiness steadiness = light_by_height(patch, 14, 56, 25);
  EXPECT_LT(steadiness.largest_step, 0.06);
  EXPECT_LT(steadiness.range, 1.3);
}

// An independent compiler must accept what we hand to drivers.
TEST(KindShaders, AreStrictGlsl) {
  if (std::system("glslangValidator --version > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "glslangValidator is not installed";
  const std::string path = testing::TempDir() + "sward_kind.";
  for (const std::string functions : {"kind_tuft.glsl", "kind_flower.glsl"}) {
    gl::ShaderLibrary shaders;
    shaders.add_source("plant_kind.glsl", "#include \"" + functions + "\"\n");
    for (const std::string file :
         {"grow.vert.glsl", "grass_blade.tesc.glsl", "grass_blade.tese.glsl", "grass_blade.geom.glsl",
          "grass_blade.frag.glsl", "shoot.vert.glsl", "shoot.tesc.glsl", "shoot.tese.glsl", "flower_head.tesc.glsl",
          "flower_head.tese.glsl", "flower_head.geom.glsl", "flower_head.frag.glsl"}) {
      const std::string stage = file.substr(file.find('.') + 1, 4);
      std::vector<gl::Define> defines = layer_defines(Layer(), {});
      defines.push_back({"SWARD_LIT_AT_VERTICES", file.starts_with("grass_blade") ? "1" : "0"});
      const auto text = shaders.resolve(file, defines);
      ASSERT_TRUE(text) << text.error().message;
      std::ofstream(path + stage) << text->text;
      EXPECT_EQ(std::system(("glslangValidator " + path + stage).c_str()), 0) << file << " with " << functions;
      std::filesystem::remove(path + stage);
    }
  }
}

std::string cattail() {
  std::ifstream stream(std::string(SWARD_GOLDEN) + "/../../demo/kinds/cattail.glsl");
  return {std::istreambuf_iterator<char>(stream), {}};
}

Species cattail_species() {
  Species species = grass_of("cattail", k_green);
  species.kind = PlantKind::custom;
  species.custom.functions = "cattail.glsl";
  species.custom.shoots = 6;
  species.custom.parameters = {0.7f, 0.9f, 4.0f};
  species.max_segments = 1;
  return species;
}

TEST_F(Kinds, AHostsOwnKindIsGrown) {
  gl::ShaderLibrary shaders;
  shaders.add_source("cattail.glsl", cattail());
  Layer layer = sparse(cattail_species(), 2);
  layer.species.push_back(bare_of("soil", k_brown));
  Patch patch(layer, plain_map(k_side, 8, k_green), {}, shaders);
  render(patch, from_above(14));
  const size_t plants = patch.plants_of_gpu().size();
  ASSERT_GT(plants, 200u);
  // A stem that ends blunt, five pointed leaves.
  EXPECT_EQ(patch.renderer().stats(true).primitives, plants * (2 + 5));
}

TEST_F(Kinds, AKindThatDoesNotCompileIsNamedWithItsLineAndLeavesTheRestRunning) {
  gl::ShaderLibrary shaders;
  shaders.add_source("cattail.glsl", cattail());
  Patch patch(sparse(cattail_species(), 2), plain_map(k_side, 8, k_green), {}, shaders);
  ASSERT_NE(&patch.renderer(), nullptr);

  std::string text = cattail();
  const size_t at = text.find("leaf.albedo");
  ASSERT_NE(at, std::string::npos);
  const int line = 1 + int(std::count(text.begin(), text.begin() + long(at), '\n'));
  text.replace(at, 11, "leaf.no_such");
  shaders.add_source("cattail.glsl", text);
  const auto broken = VegetationRenderer::create(patch.layer(), shaders);
  ASSERT_TRUE(broken);
  ASSERT_EQ(broken->faults().size(), 1u);
  const std::string message = broken->faults()[0].message;
  EXPECT_NE(message.find("cattail.glsl:" + std::to_string(line)), std::string::npos) << message;
  EXPECT_NE(message.find("species 'cattail'"), std::string::npos) << message;
  EXPECT_NE(message.find("layer '" + patch.layer().name + "'"), std::string::npos) << message;
  const std::vector<std::string> log = take_messages();
  EXPECT_TRUE(std::any_of(log.begin(), log.end(), [&](const std::string& said) {
    return said.find("cattail.glsl:" + std::to_string(line)) != std::string::npos;
  })) << "GL's debug log";

  const auto missing = VegetationRenderer::create(patch.layer(), gl::ShaderLibrary());
  ASSERT_TRUE(missing);
  ASSERT_EQ(missing->faults().size(), 1u);
  EXPECT_NE(missing->faults()[0].message.find("no shader file 'cattail.glsl'"), std::string::npos);
  take_messages();

  render(patch, from_above(14));
  EXPECT_GT(patch.renderer().stats(true).primitives, 1000u);
}

TEST_F(Kinds, AFunctionThatIsMissingIsAnError) {
  gl::ShaderLibrary shaders;
  std::string text = cattail();
  const size_t at = text.find("vec2 kind_shoots");
  ASSERT_NE(at, std::string::npos);
  text.replace(at, 16, "vec2 kind_shoot_");
  shaders.add_source("cattail.glsl", text);
  const auto broken = VegetationRenderer::create(sparse(cattail_species(), 2), shaders);
  ASSERT_TRUE(broken);
  ASSERT_EQ(broken->faults().size(), 1u);
  EXPECT_NE(broken->faults()[0].message.find("kind_shoots"), std::string::npos) << broken->faults()[0].message;
  take_messages();
}

/// Grass and cattails, each on its half of the map.
Layer grass_and_cattails() {
  Layer layer = sparse(cattail_species(), 2);
  Species grass = grass_of("grass", k_brown);
  grass.max_segments = 1;
  layer.species.push_back(grass);
  return layer;
}

TEST_F(Kinds, WhatStandsBesideABrokenKindIsDrawnInStillAirAndInWind) {
  const ColorMap map = painted_map(8, [](int column, int) { return column < 4 ? k_green : k_brown; });
  gl::ShaderLibrary whole, broken;
  whole.add_source("cattail.glsl", cattail());
  broken.add_source("cattail.glsl", cattail() + "\nint no_such = nothing;\n");
  Patch sound(grass_and_cattails(), map, {}, whole), maimed(grass_and_cattails(), map, {}, broken);
  EXPECT_TRUE(sound.renderer().faults().empty());
  ASSERT_EQ(maimed.renderer().faults().size(), 1u);
  take_messages();
  auto wind = WindTextures::create();
  ASSERT_TRUE(wind);
  for (const WindTextures* air :
       {static_cast<const WindTextures*>(nullptr), static_cast<const WindTextures*>(&*wind)}) {
    ASSERT_TRUE(maimed.renderer().set_wind(air));
    ASSERT_TRUE(sound.renderer().set_wind(air));
    render(sound, from_above(14));
    render(maimed, from_above(14));
    const auto plants = sound.plants_of_gpu();
    const auto grass = std::count_if(plants.begin(), plants.end(), [](const Plant& p) { return p.species == 1; });
    ASSERT_GT(grass, 50);
    ASSERT_LT(grass, long(plants.size()) - 50);
    EXPECT_EQ(sound.renderer().stats(true).primitives, uint64_t(grass + 7 * (long(plants.size()) - grass)));
    EXPECT_EQ(maimed.renderer().stats(true).primitives, uint64_t(grass)) << "a triangle each";
    EXPECT_EQ(maimed.plants_of_gpu().size(), plants.size()) << "places stay theirs";
  }
}

}  // namespace
}  // namespace sward
