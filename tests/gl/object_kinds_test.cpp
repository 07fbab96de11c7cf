// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Kinds of plants other than blades: where stones, litter, leaves, shrubs and trees land on the screen.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <random>

#include "gl/vegetation_fixture.h"
#include "host/render_target.h"

namespace sward {
namespace {

using namespace test;

class Kinds : public GlTest {};

constexpr glm::ivec2 k_size{160, 120};
constexpr double k_degree = std::numbers::pi / 180;

struct Picture {
  std::vector<uint8_t> rgb;
  int light(int x, int y) const {
    const uint8_t* p = &rgb[size_t(y * k_size.x + x) * 3];
    return p[0] + p[1] + p[2];
  }
  template <class Visit>
  void each_lit(Visit visit) const {
    for (int y = 0; y < k_size.y; ++y)
      for (int x = 0; x < k_size.x; ++x)
        if (light(x, y) > 0) visit(x, y);
  }
  size_t lit() const {
    size_t count = 0;
    each_lit([&](int, int) { ++count; });
    return count;
  }
};

constexpr size_t k_all = ~size_t(0);

/// Ground of the patch, its first `most` triangles, whose height rises by `slope` a metre north; 0 at y = -8.
FixedTriangles sloping_ground(double slope, int level, const View& view, size_t most) {
  FixedTriangles level_one = level_ground(k_side, level, view.eye, 1000), ground;
  for (size_t i = 0; i < std::min(level_one.size(), most); ++i) {
    FixedTriangle t = level_one[i];
    t.apex.z = slope * (t.apex.y + 8);
    t.to_left.z = float(slope * t.to_left.y);
    t.to_right.z = float(slope * t.to_right.y);
    t.distance = 0.01f;
    ground.push_back(t);
  }
  return ground;
}

/// Plants alone on black.
Picture render(Patch& patch, const View& view, double slope = 0, size_t most = k_all) {
  auto target = host::RenderTarget::create(k_size, patch.samples);
  EXPECT_TRUE(target) << target.error().message;
  target->begin();
  patch.look(view, sloping_ground(slope, patch.level, view, most));
  patch.classify(target->framebuffer());
  patch.draw();
  EXPECT_FALSE(patch.renderer().stats(true).overflow);
  return {target->read_rgb()};
}

/// One species on green ground, everything full-grown and near, about `count` plants on 16 x 16 m.
Layer few_of(PlantKind kind, float count) {
  Layer layer;
  layer.species = {grass_of("plant", k_green)};
  layer.species[0].kind = kind;
  layer.species[0].lean = 0;
  layer.plain = true;
  layer.density = count / 256;
  layer.full_distance_m = 1000;
  layer.horizon_m = 1000;
  layer.full_segments_m = 1000;
  layer.shadows = false;
  return layer;
}

/// Large enough for pixels: 0.6 m wide, 0.3 m high.
Layer stones(float count) {
  Layer layer = few_of(PlantKind::gravel, count);
  layer.species[0].height_m = {0.3f, 0.3f};
  layer.species[0].width_m = {0.6f, 0.6f};
  return layer;
}

Layer dead_leaves(float count) {
  Layer layer = few_of(PlantKind::litter, count);
  layer.species[0].height_m = {0.12f, 0.12f};
  layer.species[0].width_m = {0.08f, 0.08f};
  layer.species[0].stiffness = {0, 0};
  return layer;
}

Layer trees(float count) {
  Layer layer = few_of(PlantKind::billboard, count);
  layer.species[0].height_m = {4, 4};
  layer.species[0].width_m = {2.4f, 2.4f};
  layer.species[0].max_segments = 32;
  layer.cluster_size = 1;
  return layer;
}

View from_above(double height) {
  return View::look({8.0, -8.0, height}, std::numbers::pi / 2, -0.5 * std::numbers::pi, 1.2, k_size, 0.05, 1000);
}

/// Along a contour line of sloping ground, close to a plant, so that its ground is an edge.
View along_contour(const Plant& plant, double distance, double fov) {
  return View::look(plant.position - glm::dvec3(distance, 0, 0), 0, 0, fov, k_size, 0.05, 1000);
}

/// Distances from the ground's plane of what is lit, in the plane across the view through a plant (m).
struct Reach {
  double low = 1e9, high = -1e9;
};

Reach reach_of(const Picture& picture, double distance, double fov, double slope, double half_width) {
  const double pixel = 2 * distance * std::tan(0.5 * fov) / k_size.y;
  const glm::dvec2 normal = glm::normalize(glm::dvec2(-slope, 1));
  Reach reach;
  picture.each_lit([&](int x, int y) {
    // Looking east, north is to the left.
    const glm::dvec2 at((0.5 * k_size.x - x - 0.5) * pixel, (0.5 * k_size.y - y - 0.5) * pixel);
    if (std::abs(at.x) > half_width) return;
    reach.low = std::min(reach.low, glm::dot(at, normal));
    reach.high = std::max(reach.high, glm::dot(at, normal));
  });
  return reach;
}

/// The plants of a layer on ground of this slope: where they stand.
std::vector<Plant> plants_on(Patch& patch, double slope) {
  const View view = from_above(14);
  render(patch, view, slope);
  return patch.plants_of_gpu();
}

/// One plant alone: half of the patch is one triangle, which has one seed.
Picture render_one(Patch& patch, const View& view) {
  patch.level = 0;
  return render(patch, view, 0, 1);
}

Plant only_plant(Patch& patch) {
  render_one(patch, from_above(14));
  const std::vector<Plant> plants = patch.plants_of_gpu();
  EXPECT_EQ(plants.size(), 1u);
  return plants.empty() ? Plant{} : plants.front();
}

/// The plant with most room around it.
Plant loneliest(const std::vector<Plant>& plants) {
  EXPECT_FALSE(plants.empty());
  Plant best{};
  double most = -1;
  for (const Plant& p : plants) {
    double nearest = 1e9;
    for (const Plant& q : plants)
      if (&p != &q) nearest = std::min(nearest, std::abs(p.position.y - q.position.y));
    if (nearest > most) {
      most = nearest;
      best = p;
    }
  }
  return best;
}

TEST_F(Kinds, StonesAreSunkByAThirdOnAnySlope) {
  for (const double slope : {0.0, 0.5}) {
    Patch patch(stones(6), plain_map(k_side, 8, k_green));
    patch.level = 3;
    const Plant plant = loneliest(plants_on(patch, slope));
    const double distance = 6, fov = 10 * k_degree;
    const Picture picture = render(patch, along_contour(plant, distance, fov), slope);
    const Reach reach = reach_of(picture, distance, fov, slope, 0.4);
    // Heights plus or minus a pixel and what nearer sides of the stone look larger by.
    EXPECT_NEAR(reach.low, -double(plant.height) / 3, 0.02) << slope;
    EXPECT_NEAR(reach.high, double(plant.height) * 2 / 3, 0.02) << slope;
  }
}

TEST_F(Kinds, LitterLiesWithinACentimetreOfTheGround) {
  for (const double slope : {0.0, 0.5}) {
    Patch patch(dead_leaves(12), plain_map(k_side, 8, k_green));
    patch.level = 3;
    const Plant plant = loneliest(plants_on(patch, slope));
    const double distance = 1.5, fov = 5 * k_degree, pixel = 2 * distance * std::tan(0.5 * fov) / k_size.y;
    const Picture picture = render(patch, along_contour(plant, distance, fov), slope);
    ASSERT_GT(picture.lit(), 10u);
    const Reach reach = reach_of(picture, distance, fov, slope, 0.15);
    EXPECT_GT(reach.low, -1.5 * pixel) << slope;
    EXPECT_LT(reach.high, 0.01 + 1.5 * pixel) << slope;
  }
}

TEST_F(Kinds, LeavesStayOutOfTheGroundOnSlopes) {
  for (const PlantKind kind : {PlantKind::leaf, PlantKind::fern}) {
    Layer layer = few_of(kind, 6);
    layer.species[0].height_m = {0.5f, 0.5f};
    layer.species[0].width_m = {0.1f, 0.1f};
    layer.species[0].stiffness = {0.25f, 0.25f};
    layer.species[0].lean = 0.8f;
    Patch patch(layer, plain_map(k_side, 8, k_green));
    patch.level = 3;
    const double slope = 0.8, distance = 5, fov = 14 * k_degree;
    const Plant plant = loneliest(plants_on(patch, slope));
    const Picture picture = render(patch, along_contour(plant, distance, fov), slope);
    ASSERT_GT(picture.lit(), 50u);
    const Reach reach = reach_of(picture, distance, fov, slope, 0.6);
    // Midribs lie on the ground at the lowest, their edges may dip by half a leaf's width.
    EXPECT_GT(reach.low, -0.06);
    EXPECT_GT(reach.high, 0.06);
  }
}

/// Light of one plant times squared distance: constant where what is drawn follows what would be seen.
std::vector<double> light_over_distance(Layer layer, double from, double to, double height_over_distance) {
  layer.species[0].max_segments = std::max(layer.species[0].max_segments, 12);
  layer.full_segments_m = float(from);
  Patch patch(layer, plain_map(k_side, 8, k_green));
  patch.samples = std::min(4, host::RenderTarget::max_samples());
  const Plant plant = only_plant(patch);
  std::vector<double> light;
  for (double distance = from; distance < to; distance *= 1.05) {
    double sum = 0;
    // Four places within a pixel.
    for (int turn = 0; turn < 4; ++turn) {
      const glm::dvec3 away(-distance, 0, distance * height_over_distance);
      const View view =
          View::look(plant.position + away, turn * 0.08 * k_degree,
                     -std::atan(height_over_distance) + turn * 0.05 * k_degree, 30 * k_degree, k_size, 0.05, 10000);
      const Picture picture = render_one(patch, view);
      picture.each_lit([&](int x, int y) { sum += picture.light(x, y); });
    }
    light.push_back(sum * distance * distance);
  }
  return light;
}

/// Largest relative step between the means of four neighbours and of the next four: single values scatter, as small
/// things meet few samples.
double largest_step(const std::vector<double>& values) {
  const auto mean = [&](size_t first) {
    return std::accumulate(values.begin() + long(first), values.begin() + long(first) + 4, 0.0) / 4;
  };
  double step = 0;
  for (size_t i = 0; i + 8 <= values.size(); ++i) {
    EXPECT_GT(mean(i), 0);
    step = std::max(step, std::abs(mean(i + 4) / mean(i) - 1));
  }
  return step;
}

TEST_F(Kinds, AreaOverDistanceHasNoJumps) {
  // Five per cent of distance a step.
  EXPECT_LT(largest_step(light_over_distance(stones(1), 4, 60, 0.3)), 0.1);
  EXPECT_LT(largest_step(light_over_distance(trees(1), 16, 160, 0.3)), 0.2);
}

struct Box {
  int left = k_size.x, right = -1, top = k_size.y, bottom = -1;
};

Box box_of(const Picture& picture) {
  Box box;
  picture.each_lit([&](int x, int y) {
    box = {std::min(box.left, x), std::max(box.right, x), std::min(box.top, y), std::max(box.bottom, y)};
  });
  return box;
}

TEST_F(Kinds, TreesStandUprightAndFaceTheEye) {
  Patch patch(trees(1), plain_map(k_side, 8, k_green));
  const Plant plant = only_plant(patch);
  const double distance = 14, fov = 30 * k_degree;
  const double pixel = 2 * distance * std::tan(0.5 * fov) / k_size.y;
  double least = 1e9, most = 0;
  for (int turn = 0; turn < 8; ++turn) {
    const double yaw = turn * 45 * k_degree;
    const glm::dvec3 way(std::cos(yaw), std::sin(yaw), 0);
    const View view =
        View::look(plant.position - distance * way + glm::dvec3(0, 0, 2), yaw, 0, fov, k_size, 0.05, 1000);
    const Picture picture = render_one(patch, view);
    const Box box = box_of(picture);
    EXPECT_NEAR((box.bottom - box.top) * pixel, double(plant.height), 0.25 * double(plant.height)) << turn;
    EXPECT_NEAR((box.right - box.left) * pixel, 2.4, 0.3 * 2.4) << turn;
    // The trunk's foot is below its middle and on the ground.
    const double foot = (0.5 * k_size.y - box.bottom) * pixel + 2;
    EXPECT_NEAR(foot, 0, 0.3) << turn;
    least = std::min(least, double(picture.lit()));
    most = std::max(most, double(picture.lit()));
  }
  EXPECT_LT(most / least, 1.35);
}

TEST_F(Kinds, TreesDoNotVanishFromAbove) {
  Patch patch(trees(1), plain_map(k_side, 8, k_green));
  const Plant plant = only_plant(patch);
  const View view = View::look(plant.position + glm::dvec3(0, 0, 16), std::numbers::pi / 2, -0.5 * std::numbers::pi,
                               30 * k_degree, k_size, 0.05, 1000);
  const double pixel = 2 * 14 * std::tan(15 * k_degree) / k_size.y;
  const double area = double(render_one(patch, view).lit()) * pixel * pixel;
  EXPECT_GT(area, 0.6 * std::numbers::pi * 1.2 * 1.2);
  EXPECT_LT(area, 1.7 * std::numbers::pi * 1.2 * 1.2);
}

TEST_F(Kinds, NothingPopsAsTheEyeGoesAroundATree) {
  Patch patch(trees(1), plain_map(k_side, 8, k_green));
  patch.samples = std::min(4, host::RenderTarget::max_samples());
  const Plant plant = only_plant(patch);
  Picture before;
  for (int turn = 0; turn < 24; ++turn) {
    // Half a degree a step, through the directions in which sides change places.
    const double yaw = (turn * 0.5 + (turn < 12 ? 40 : 170)) * k_degree;
    const glm::dvec3 way(std::cos(yaw), std::sin(yaw), 0);
    const View view =
        View::look(plant.position - 16.0 * way + glm::dvec3(0, 0, 2), yaw, 0, 30 * k_degree, k_size, 0.05, 1000);
    const Picture picture = render_one(patch, view);
    if (turn != 0 && turn != 12) {
      double change = 0, light = 0;
      for (int y = 0; y < k_size.y; ++y) {
        for (int x = 0; x < k_size.x; ++x) {
          change += std::abs(picture.light(x, y) - before.light(x, y));
          light += picture.light(x, y);
        }
      }
      EXPECT_LT(change / light, 0.2) << turn;
    }
    before = picture;
  }
}

TEST_F(Kinds, PlacesAndTraitsAreTheTwins) {
  for (const PlantKind kind :
       {PlantKind::gravel, PlantKind::leaf, PlantKind::fern, PlantKind::litter, PlantKind::billboard}) {
    Patch patch(few_of(kind, 200), plain_map(k_side, 8, k_green));
    const View view = from_above(14);
    patch.look(view);
    patch.classify();
    const std::vector<Plant> gpu = patch.plants_of_gpu(), cpu = patch.plants_of_cpu();
    ASSERT_EQ(gpu.size(), cpu.size());
    ASSERT_GT(gpu.size(), 100u);
    for (const Plant& a : gpu) {
      const auto b = std::find_if(cpu.begin(), cpu.end(), [&](const Plant& p) {
        return p.triangle.bits == a.triangle.bits && p.rank == a.rank;
      });
      ASSERT_NE(b, cpu.end());
      EXPECT_LT(glm::distance(a.position, b->position), 1e-3);
      EXPECT_NEAR(a.height, b->height, 1e-4 * double(b->height));
      EXPECT_NEAR(a.width, b->width, 1e-4 * double(b->width));
    }
  }
}

TEST_F(Kinds, EveryStoneIsDrawnHoweverManyPointsADrawHas) {
  // Stones have five sides at least, whatever `segments` says: more points than 16 bits can number, the same picture.
  Picture pictures[2];
  for (const int i : {0, 1}) {
    Layer layer = stones(12000);
    layer.species[0].max_segments = i == 0 ? 1 : 5;
    Patch patch(layer, plain_map(k_side, 8, k_green));
    pictures[i] = render(patch, from_above(14));
    ASSERT_GT(patch.plants_of_gpu().size(), 10000u);
  }
  EXPECT_EQ(pictures[0].rgb, pictures[1].rgb);
}

TEST_F(Kinds, ShadowsAreCastByEveryKind) {
  for (Layer layer : {stones(20), trees(3)}) {
    size_t primitives[2];
    for (const bool shadows : {false, true}) {
      layer.shadows = shadows;
      Patch patch(layer, plain_map(k_side, 8, k_green));
      patch.level = 3;
      patch.lighting.sun_elevation = 0.6f;
      render(patch, from_above(14));
      primitives[shadows] = patch.renderer().stats(true).primitives;
    }
    EXPECT_GT(primitives[1], primitives[0]);
  }
}

TEST_F(Kinds, ABrokenShaderOfAKindIsNamed) {
  for (const char* file : {"gravel.geom.glsl", "leaf.geom.glsl", "litter.frag.glsl", "billboard.tesc.glsl"}) {
    const std::string name(file);
    const PlantKind kind = name[0] == 'g'   ? PlantKind::gravel
                           : name[0] == 'b' ? PlantKind::billboard
                           : name[1] == 'e' ? PlantKind::leaf
                                            : PlantKind::litter;
    gl::ShaderLibrary shaders;
    shaders.add_source(name, "void main() { this does not compile; }\n");
    const auto renderer = VegetationRenderer::create(few_of(kind, 1), shaders);
    ASSERT_FALSE(renderer) << name;
    EXPECT_NE(renderer.error().message.find(name), std::string::npos) << renderer.error().message;
    take_messages();
  }
}

// An independent compiler must accept what we hand to drivers.
TEST(KindsShaders, AreStrictGlsl) {
  if (std::system("glslangValidator --version > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "glslangValidator is not installed";
  const gl::ShaderLibrary library;
  std::vector<gl::Define> defines = gl::binding_defines({});
  for (const char* name : {"SWARD_CLUSTER_SIZE", "SWARD_BLADE_COLUMNS", "SWARD_BLADE_ROWS"})
    defines.push_back({name, "8"});
  defines.push_back({"SWARD_GROWTH_INVOCATIONS", "2"});
  defines.push_back({"SWARD_ON_MESH", "0"});
  defines.push_back({"SWARD_WIND", "0"});
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  for (const std::string kind : {"gravel", "leaf", "fern", "litter", "billboard"}) {
    for (const std::string stage : {"tesc", "tese", "geom", "frag"}) {
      if (kind == "fern" && stage != "frag") continue;
      const auto source = library.resolve(kind + "." + stage + ".glsl", defines);
      ASSERT_TRUE(source) << source.error().message;
      const auto path = folder / ("sward_" + std::to_string(std::random_device{}()) + "." + stage);
      std::ofstream(path) << source->text;
      EXPECT_EQ(std::system(("glslangValidator " + path.string() + " > /dev/null").c_str()), 0) << kind << " " << stage;
      std::filesystem::remove(path);
    }
  }
}

TEST(KindsInput, RangesAreNamed) {
  const auto refused = [](auto change, const char* field) {
    Layer layer = few_of(PlantKind::billboard, 1);
    change(layer.species[0]);
    const auto valid = validate(layer);
    ASSERT_FALSE(valid) << field;
    EXPECT_NE(valid.error().message.find(field), std::string::npos) << valid.error().message;
    EXPECT_NE(valid.error().message.find("'plant'"), std::string::npos) << valid.error().message;
  };
  refused([](Species& s) { s.leaves = 0; }, "leaves");
  refused([](Species& s) { s.leaves = 9; }, "leaves");
  refused([](Species& s) { s.trunk_share = 0.95f; }, "trunk_share");
  refused([](Species& s) { s.taper = -0.1f; }, "taper");
  refused([](Species& s) { s.taper = std::nanf(""); }, "taper");
  refused([](Species& s) { s.kind = PlantKind(77); }, "kind");
}

}  // namespace
}  // namespace sward
