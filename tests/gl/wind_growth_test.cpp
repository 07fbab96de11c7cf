// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What growth draws in the wind: the lines that leave the evaluation stages, caught by a geometry stage of the test's
// own, against the CPU twin, the ground and the wind.
#include <sward/vegetation/wind_textures.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "gl/vegetation_fixture.h"
#include "host/render_target.h"
#include "unit/sway_support.h"
#include "vegetation/vegetation_renderer_stages.h"

namespace sward {
namespace {

using namespace test;

constexpr glm::ivec2 k_size{160, 120};
constexpr GLuint k_caught_binding = 9;
constexpr size_t k_most_caught = 400000;

/// Stages that write what they get instead of drawing it: a segment's end, its plant's root, which shoot (heads: -1).
const char* const k_catching_lines = R"(
layout(lines, invocations = SWARD_GROWTH_INVOCATIONS) in;
layout(points, max_vertices = 1) out;
layout(location = 0) in vec4 line_point[];
layout(location = 5) in vec4 line_fade[];
layout(location = 6) in vec3 line_root[];
layout(std430, binding = 9) buffer Caught { uint count; uint unused[3]; vec4 rows[]; };
void main() {
  if (gl_InvocationID != 0) return;
  for (int i = 0; i < 2; ++i) {
    uint at = atomicAdd(count, 1u);
    if (2u * at + 1u >= uint(rows.length())) return;
    rows[2u * at] = line_point[i];
    rows[2u * at + 1u] = vec4(line_root[i], line_fade[i].w);
  }
  gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
  EmitVertex();
}
)";
const char* const k_catching_heads = R"(
layout(lines, invocations = SWARD_GROWTH_INVOCATIONS) in;
layout(points, max_vertices = 1) out;
layout(location = 0) in vec4 petal_place[];
layout(location = 6) in vec3 petal_root[];
layout(std430, binding = 9) buffer Caught { uint count; uint unused[3]; vec4 rows[]; };
void main() {
  if (gl_InvocationID != 0) return;
  uint at = atomicAdd(count, 1u);
  if (2u * at + 1u >= uint(rows.length())) return;
  rows[2u * at] = petal_place[0];
  rows[2u * at + 1u] = vec4(petal_root[0], -1.0);
  gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
  EmitVertex();
}
)";

struct Caught {
  glm::vec4 point, root;
};

gl::ShaderLibrary catching_library() {
  gl::ShaderLibrary shaders;
  shaders.add_source("grass_blade.geom.glsl", k_catching_lines);
  shaders.add_source("flower_head.geom.glsl", k_catching_heads);
  for (const char* fragment : {"grass_blade.frag.glsl", "flower_head.frag.glsl"})
    shaders.add_source(fragment, "layout(location = 0) out vec4 color;\nvoid main() { color = vec4(1.0); }\n");
  return shaders;
}

/// The lines of one plant's shoots, by arc length.
struct Line {
  glm::vec3 root;
  int shoot;
  std::vector<glm::vec4> points;
  float length() const {
    float sum = 0;
    for (size_t i = 1; i < points.size(); ++i) sum += glm::distance(glm::vec3(points[i - 1]), glm::vec3(points[i]));
    return sum;
  }
  glm::vec3 tip() const { return glm::vec3(points.back()) - root; }
};

std::vector<Line> sort_lines(const std::vector<Caught>& caught) {
  std::vector<Caught> sorted = caught;
  const auto key = [](const Caught& c) { return std::tuple(c.root.x, c.root.y, c.root.w, c.point.w); };
  std::sort(sorted.begin(), sorted.end(), [&](const Caught& a, const Caught& b) { return key(a) < key(b); });
  std::vector<Line> lines;
  for (const Caught& c : sorted) {
    if (lines.empty() || lines.back().root != glm::vec3(c.root) || lines.back().shoot != int(c.root.w))
      lines.push_back({glm::vec3(c.root), int(c.root.w), {}});
    if (lines.back().points.empty() || lines.back().points.back().w != c.point.w)
      lines.back().points.push_back(c.point);
  }
  return lines;
}

/// A patch whose lines are caught.
class CatchingPatch {
 public:
  explicit CatchingPatch(const Layer& layer)
      : patch_(layer, plain_map(k_side, 8, k_green), {}, catching_library()),
        target_(host::RenderTarget::create(k_size, 1).value()),
        textures_(WindTextures::create().value()) {
    const size_t bytes = 16 + k_most_caught * sizeof(Caught);
    buffer_ = make_buffer(bytes, nullptr, GL_DYNAMIC_STORAGE_BIT);
  }

  Patch& patch() { return patch_; }
  const Wind& wind() const { return wind_; }
  View view() const {
    return View::look({8.0, -8.0, 14.0}, std::numbers::pi / 2, -0.5 * std::numbers::pi, 1.2, k_size, 0.05, 1000);
  }

  /// Everything at a moment in a weather; `moving` false: without a wind at all.
  std::vector<Line> grow(const Weather& weather, double time_s, bool moving = true) {
    EXPECT_TRUE(wind_.set_weather(weather));
    EXPECT_TRUE(wind_.advance(std::max(time_s - wind_.time(), 0.0), view().eye));
    textures_.upload(wind_, view().eye);
    const auto set = patch_.renderer().set_wind(moving ? &textures_ : nullptr);
    EXPECT_TRUE(set) << set.error().message;
    patch_.time_s = time_s;
    target_.begin();
    patch_.look(view());
    patch_.classify(target_.framebuffer());
    const GLuint zero = 0;
    glNamedBufferSubData(buffer_.id(), 0, sizeof zero, &zero);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, k_caught_binding, buffer_.id());
    patch_.draw();
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, k_caught_binding, 0);
    return sort_lines(read());
  }

 private:
  std::vector<Caught> read() const {
    GLuint count = 0;
    glGetNamedBufferSubData(buffer_.id(), 0, sizeof count, &count);
    EXPECT_LT(count, k_most_caught);
    std::vector<Caught> caught(std::min(size_t(count), k_most_caught));
    if (!caught.empty())
      glGetNamedBufferSubData(buffer_.id(), 16, GLsizeiptr(caught.size() * sizeof(Caught)), caught.data());
    return caught;
  }

  Patch patch_;
  host::RenderTarget target_;
  Wind wind_;
  WindTextures textures_;
  gl::Buffer buffer_;
};

class WindGrowth : public GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    if (IsSkipped()) return;
    GLint blocks = 0;
    glGetIntegerv(GL_MAX_GEOMETRY_SHADER_STORAGE_BLOCKS, &blocks);
    if (blocks < 1) GTEST_SKIP() << "no storage blocks in geometry shaders here";
  }
};

/// Full-grown plants of one species, all near.
Layer stand(PlantKind kind, float density = 6) {
  Layer layer = grass_and_soil();
  layer.shadows = false;
  layer.plain = true;
  layer.density = density;
  layer.full_distance_m = layer.horizon_m = layer.full_segments_m = 50;
  layer.species[0].kind = kind;
  layer.species[0].max_segments = 7;
  layer.species[0].height_m = {0.4f, 0.9f};
  return layer;
}

/// A steady wind towards an azimuth.
Weather steady(float speed, float azimuth) {
  return {.speed_m_s = speed,
          .from_azimuth = azimuth + float(std::numbers::pi),
          .gustiness = 0,
          .ambient_m_s = 0,
          .turbulence = 0};
}

TEST_F(WindGrowth, LinesKeepTheirLengthAndStayAboveTheGround) {
  for (const PlantKind kind : {PlantKind::blade, PlantKind::tuft}) {
    for (const int segments : {1, 3, 7, 15}) {
      Layer layer = stand(kind);
      layer.species[0].max_segments = segments;
      layer.species[0].stiffness = {0.1f, 1.0f};
      CatchingPatch patch(layer);
      const std::vector<Line> calm = patch.grow(steady(0, 0), 1);
      ASSERT_GT(calm.size(), 500u);
      float worst = 0, lowest = 0;
      for (const float speed : {0.5f, 3.0f, 8.0f, 15.0f, 25.0f, 40.0f, 60.0f}) {
        Weather weather = steady(speed, 0.8f);
        weather.gustiness = 1;
        weather.turbulence = 0.5f;
        const std::vector<Line> blown = patch.grow(weather, 1);
        ASSERT_EQ(blown.size(), calm.size());
        for (size_t i = 0; i < calm.size(); ++i) {
          ASSERT_EQ(blown[i].root, calm[i].root);
          ASSERT_EQ(blown[i].points.size(), size_t(segments + 1));
          worst = std::max(worst, std::abs(blown[i].length() / calm[i].length() - 1));
          for (const glm::vec4& p : blown[i].points) lowest = std::min(lowest, p.z - blown[i].root.z);
        }
      }
      EXPECT_LT(worst, 0.01f) << int(kind) << ' ' << segments;
      EXPECT_GT(lowest, -0.01f) << int(kind) << ' ' << segments;
    }
  }
}

TEST_F(WindGrowth, BladesAreWhereTheTwinHasThem) {
  Layer layer = stand(PlantKind::blade);
  layer.species[0].height_m = {0.6f, 0.9f};  // near enough to move in full
  CatchingPatch catching(layer);
  const shared::SpeciesParams species = make_species_params(layer)[0];
  for (const float speed : {0.0f, 4.0f, 14.0f}) {
    Weather weather;
    weather.speed_m_s = speed;
    const double time = 37.25;
    const std::vector<Line> lines = catching.grow(weather, time);
    const shared::LayerParams params = make_layer_params(layer, catching.view(), {{16, 16}, {8, 8}}, 0);
    size_t compared = 0;
    float worst = 0;
    for (const Plant& plant : catching.patch().plants_of_gpu()) {
      const glm::vec3 root(plant.position - catching.view().eye);
      const auto line =
          std::find_if(lines.begin(), lines.end(), [&](const Line& l) { return glm::distance(l.root, root) < 1e-5f; });
      if (line == lines.end()) continue;
      const glm::uvec2 id(uint32_t(plant.triangle.bits), uint32_t(plant.triangle.bits >> 32));
      const shared::PlantTraits traits = shared::make_traits(species, params, id, plant.rank, plant.score);
      const shared::SwayTraits own = shared::sway_traits(
          species, {layer.species[0].height_m.min, layer.species[0].height_m.max}, id, plant.rank, traits.phase);
      const double angle = double(k_turn) * 11 * traits.phase;
      const WindHere here = catching.wind().at(plant.position + 0.35 * glm::dvec3(std::cos(angle), std::sin(angle), 0));
      const shared::PlantAir air =
          shared::plant_air(own, traits.height, traits.lean, here.velocity, here.ambient, here.gust, float(time), 1.0f);
      const DrawnBlade drawn =
          draw_blade({traits.stiffness, traits.azimuth, traits.lean, {0, 0, 1}, 7}, shared::swaying_wind(air, 0));
      worst = std::max(worst, glm::distance(traits.height * drawn.tip(), line->tip()));
      ++compared;
    }
    EXPECT_GT(compared, 500u);
    EXPECT_LT(worst, 0.01f) << speed;
  }
}

TEST_F(WindGrowth, TheMeanBendFollowsTheWind) {
  CatchingPatch patch(stand(PlantKind::blade, 20));
  for (const float azimuth : {0.3f, 2.0f, 4.4f}) {
    for (const float speed : {3.0f, 8.0f, 25.0f, 60.0f}) {
      glm::vec2 mean(0);
      for (const Line& line : patch.grow(steady(speed, azimuth), 5)) mean += glm::vec2(line.tip());
      const float off = std::remainder(std::atan2(mean.y, mean.x) - azimuth, k_turn);
      EXPECT_LT(std::abs(off) * 360 / k_turn, 5) << azimuth << ' ' << speed;
    }
  }
}

TEST_F(WindGrowth, TipsMoveSmoothlyInTime) {
  // Metres a frame of 1/60 s, of blades 40 to 90 cm high; after two days of it.
  CatchingPatch patch(stand(PlantKind::blade, 1));
  Weather weather;
  weather.speed_m_s = 12;
  std::vector<float> steps;
  std::vector<Line> before = patch.grow(weather, 172800);
  for (int frame = 1; frame <= 20; ++frame) {
    const std::vector<Line> now = patch.grow(weather, 172800 + frame / 60.0);
    ASSERT_EQ(now.size(), before.size());
    for (size_t i = 0; i < now.size(); ++i) steps.push_back(glm::distance(now[i].tip(), before[i].tip()));
    before = now;
  }
  std::sort(steps.begin(), steps.end());
  EXPECT_GT(steps[steps.size() / 2], 0.002f);
  EXPECT_LT(steps[steps.size() / 2], 0.02f);
  EXPECT_LT(steps[steps.size() * 99 / 100], 0.04f);
  EXPECT_LT(steps.back(), 0.08f);
}

TEST_F(WindGrowth, HeadsStayOnTheirStems) {
  Layer layer = stand(PlantKind::flower, 3);
  layer.species[0].stiffness = {0.6f, 1.0f};
  CatchingPatch patch(layer);
  for (const float speed : {0.0f, 6.0f, 20.0f}) {
    const std::vector<Line> lines = patch.grow(steady(speed, 1), 9.3);
    size_t heads = 0;
    float worst = 0;
    for (size_t i = 0; i < lines.size(); ++i) {
      if (lines[i].shoot != -1) continue;
      const auto stem = std::find_if(lines.begin(), lines.end(),
                                     [&](const Line& l) { return l.root == lines[i].root && l.shoot == 0; });
      ASSERT_NE(stem, lines.end());
      // A head near the ground is raised by what hangs from it.
      if (stem->tip().z < 0.1f) continue;
      worst = std::max(worst, glm::distance(stem->tip(), lines[i].tip()));
      ++heads;
    }
    EXPECT_GT(heads, 100u);
    EXPECT_LT(worst, 0.004f) << speed;
  }
}

/// A picture of a stand in a weather, at eye level.
class WindPicture {
 public:
  explicit WindPicture(const Layer& layer)
      : patch_(layer, plain_map(k_side, 8, k_green)), target_(host::RenderTarget::create(k_size, 1).value()) {}
  std::vector<uint8_t> still() { return draw(nullptr, 1); }
  std::vector<uint8_t> in(const Weather& weather, double time_s) {
    EXPECT_TRUE(wind_.set_weather(weather));
    EXPECT_TRUE(wind_.advance(0, k_view.eye));
    textures_.upload(wind_, k_view.eye);
    return draw(&textures_, time_s);
  }

 private:
  std::vector<uint8_t> draw(const WindTextures* wind, double time_s) {
    const auto set = patch_.renderer().set_wind(wind);
    EXPECT_TRUE(set) << set.error().message;
    patch_.time_s = time_s;
    target_.begin();
    patch_.look(k_view);
    patch_.classify(target_.framebuffer());
    patch_.draw();
    return target_.read_rgb();
  }

  inline static const View k_view = eye_level_view({8.0, -15.0, 1.7}, k_size);
  Patch patch_;
  host::RenderTarget target_;
  Wind wind_;
  WindTextures textures_ = WindTextures::create().value();
};

/// Share of pixels that differ by more than `least` codes.
double changed(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b, int least = 4) {
  size_t count = 0;
  for (size_t i = 0; i + 2 < a.size(); i += 3) {
    int most = 0;
    for (size_t c = 0; c < 3; ++c) most = std::max(most, std::abs(int(a[i + c]) - int(b[i + c])));
    count += most > least;
  }
  return double(count) / (double(a.size()) / 3);
}

std::shared_ptr<const TriangleMesh> spindle() {
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->positions = {{0.1, 0, 0}, {-0.1, 0.1, 0}, {-0.1, -0.1, 0}, {0, 0, 1}};
  mesh->indices = {0, 1, 3, 1, 2, 3, 2, 0, 3};
  mesh->colors.assign(4, glm::u8vec3(60, 120, 40));
  return mesh;
}

TEST_F(WindGrowth, EveryKindThatMovesDoesAndOthersDoNot) {
  for (const PlantKind kind : {PlantKind::blade, PlantKind::tuft, PlantKind::flower, PlantKind::leaf, PlantKind::fern,
                               PlantKind::billboard, PlantKind::mesh, PlantKind::gravel, PlantKind::litter}) {
    Layer layer = stand(kind, 2);
    layer.shadows = true;
    layer.species[0].width_m = {0.1f, 0.3f};
    if (kind == PlantKind::mesh) layer.species[0].mesh.mesh = spindle();
    WindPicture picture(layer);
    const std::vector<uint8_t> still = picture.still();
    const std::vector<uint8_t> calm = picture.in(steady(0, 0), 1);
    const std::vector<uint8_t> blown = picture.in(steady(15, 0), 1), later = picture.in(steady(15, 0), 1.3);
    const bool moves = kind != PlantKind::gravel && kind != PlantKind::litter;
    if (moves) {
      EXPECT_GT(changed(still, blown), 0.02) << int(kind);
      EXPECT_GT(changed(blown, later), 0.005) << int(kind);
    } else {
      EXPECT_EQ(still, blown) << int(kind);
    }
    // Calm air is still air, but for the last bits.
    EXPECT_LT(changed(still, calm), 0.006) << int(kind);
    // And without a wind again nothing is left of it.
    EXPECT_EQ(still, picture.still()) << int(kind);
  }
}

TEST_F(WindGrowth, LowPlantsAreAsInStillAir) {
  // Below a pixel high: nothing to see, and nothing is asked.
  Layer layer = stand(PlantKind::blade, 100);
  layer.species[0].height_m = {0.07f, 0.1f};
  CatchingPatch patch(layer);
  const std::vector<Line> still = patch.grow(steady(0, 0), 1), blown = patch.grow(steady(40, 0), 1);
  ASSERT_EQ(still.size(), blown.size());
  ASSERT_GT(still.size(), 100u);
  for (size_t i = 0; i < still.size(); ++i) EXPECT_EQ(still[i].tip(), blown[i].tip());
}

// An independent compiler must accept what we hand to drivers.
TEST(WindShaders, AreStrictGlsl) {
  if (std::system("glslangValidator --version > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "glslangValidator is not installed";
  gl::ShaderLibrary shaders;
  shaders.add_source("plant_wind.glsl", "#include \"common_wind.glsl\"\n");
  const std::string path = testing::TempDir() + "sward_wind.";
  for (const bool on_mesh : {false, true}) {
    Layer layer;
    layer.on_mesh = on_mesh;
    for (const std::string file :
         {"grass_blade.tesc.glsl", "grass_blade.tese.glsl", "shoot.tesc.glsl", "shoot.tese.glsl",
          "flower_head.tesc.glsl", "flower_head.tese.glsl", "flower_head.geom.glsl", "leaf.tesc.glsl", "leaf.tese.glsl",
          "leaf.geom.glsl", "billboard.tesc.glsl", "billboard.tese.glsl", "billboard.geom.glsl", "mesh_plant.tesc.glsl",
          "mesh_plant.tese.glsl", "mesh_plant.geom.glsl"}) {
      const std::string stage = file.substr(file.find('.') + 1, 4);
      const auto text = shaders.resolve(file, layer_defines(layer, {}, true));
      ASSERT_TRUE(text) << text.error().message;
      std::ofstream(path + stage) << text->text;
      EXPECT_EQ(std::system(("glslangValidator " + path + stage).c_str()), 0) << file;
      std::filesystem::remove(path + stage);
    }
  }
}

}  // namespace
}  // namespace sward
