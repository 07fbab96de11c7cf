// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What has touched the ground, on the GPU: the textures, the shader's lookup against its twin, what grows there.
#include <sward/vegetation/disturbance_textures.h>

#include <cmath>
#include <random>

#include "gl/twins.h"
#include "host/disturbance_replay.h"
#include "host/render_target.h"

namespace sward {
namespace {

using namespace test;

class DisturbanceGl : public GlTest {
 protected:
  static Disturbance make(const DisturbanceOptions& options = {}) {
    auto made = Disturbance::create(options);
    EXPECT_TRUE(made) << made.error().message;
    return std::move(*made);
  }
  static DisturbanceTextures textures() {
    auto made = DisturbanceTextures::create();
    EXPECT_TRUE(made) << made.error().message;
    return std::move(*made);
  }
};

constexpr int k_side = 256, k_layers = 9;

std::vector<float> texels_of(const DisturbanceTextures& textures) {
  std::vector<float> texels(size_t(k_side * k_side * k_layers) * 4);
  glGetTextureImage(textures.ground().map, 0, GL_RGBA, GL_FLOAT, GLsizei(texels.size() * sizeof(float)), texels.data());
  return texels;
}

/// A bit of everything around a place.
void disturb(Disturbance& d, glm::dvec2 at, uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> away(-40, 40);
  const auto place = [&] { return at + glm::dvec2(away(random), away(random)); };
  for (int i = 0; i < 12; ++i) {
    EXPECT_TRUE(d.press_capsule(place(), place(), 0.4, 1));
    EXPECT_TRUE(d.cut_capsule(place(), place(), 0.7, 0.08f));
    EXPECT_TRUE(d.explode(place(), 4));
    EXPECT_TRUE(d.wet_disc(place(), 3, 0.8f));
    EXPECT_TRUE(d.paint_disc(place(), 2, {0.9f, 0.2f, 0.1f}, 0.8f));
    EXPECT_TRUE(d.advance(7));
  }
}

/// Asks disturbed_here() at points relative to the eye, by transform feedback.
class Lookup {
 public:
  Lookup() {
    gl::ShaderLibrary library;
    library.add_source("lookup.vert.glsl",
                       "#include \"common_disturbance.glsl\"\n"
                       "layout(location = 0) in vec2 point;\n"
                       "layout(xfb_buffer = 0, xfb_stride = 48) out;\n"
                       "layout(xfb_offset = 0) out vec2 press;\n"
                       "layout(xfb_offset = 8) out vec3 rest;\n"
                       "layout(xfb_offset = 32) out vec4 paint;\n"
                       "void main() {\n"
                       "  Disturbed d = undisturbed();\n"
                       "  if (ground_is_disturbed()) d = disturbed_here(vec3(point, 0.0));\n"
                       "  press = d.press; rest = vec3(d.cut, d.burn, d.wet); paint = d.paint;\n"
                       "}\n");
    auto program = library.build({.name = "lookup",
                                  .vertex = "lookup.vert.glsl",
                                  .tess_control = {},
                                  .tess_evaluation = {},
                                  .geometry = {},
                                  .fragment = {},
                                  .defines = gl::binding_defines(bindings_),
                                  .feedback_varyings = {}});
    EXPECT_TRUE(program) << program.error().message;
    program_ = std::move(*program);
  }

  std::vector<Disturbed> at(const DisturbanceTextures& textures, const std::vector<glm::vec2>& points) {
    gl::VertexArray array = gl::create_vertex_array();
    gl::Buffer in = gl::create_buffer(), out = gl::create_buffer();
    glNamedBufferStorage(in.id(), GLsizeiptr(points.size() * sizeof(glm::vec2)), points.data(), 0);
    glNamedBufferStorage(out.id(), GLsizeiptr(points.size() * 48), nullptr, 0);
    glEnableVertexArrayAttrib(array.id(), 0);
    glVertexArrayAttribFormat(array.id(), 0, 2, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(array.id(), 0, 0);
    glVertexArrayVertexBuffer(array.id(), 0, in.id(), 0, sizeof(glm::vec2));
    auto target = host::RenderTarget::create({8, 8}, 1);
    target->begin();
    glUseProgram(program_.id());
    glBindVertexArray(array.id());
    glBindBufferBase(GL_UNIFORM_BUFFER, bindings_.disturbance, textures.ground().block);
    glBindTextureUnit(bindings_.disturbance_map, textures.ground().map);
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, out.id());
    glEnable(GL_RASTERIZER_DISCARD);
    glBeginTransformFeedback(GL_POINTS);
    glDrawArrays(GL_POINTS, 0, GLsizei(points.size()));
    glEndTransformFeedback();
    glDisable(GL_RASTERIZER_DISCARD);
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
    glBindVertexArray(0);
    glUseProgram(0);
    std::vector<float> floats(points.size() * 12);
    glGetNamedBufferSubData(out.id(), 0, GLsizeiptr(floats.size() * sizeof(float)), floats.data());
    std::vector<Disturbed> all(points.size());
    for (size_t i = 0; i < points.size(); ++i) {
      const float* f = &floats[i * 12];
      all[i] = {{f[0], f[1]}, f[2], f[3], f[4], {f[8], f[9], f[10], f[11]}};
    }
    return all;
  }

 private:
  gl::Bindings bindings_;
  gl::Program program_;
};

double difference(const Disturbed& a, const Disturbed& b) {
  double most = std::max({std::abs(a.cut - b.cut), std::abs(a.burn - b.burn), std::abs(a.wet - b.wet),
                          std::abs(a.press.x - b.press.x), std::abs(a.press.y - b.press.y)});
  for (int i = 0; i < 4; ++i) most = std::max(most, double(std::abs(a.paint[i] - b.paint[i])));
  return most;
}

TEST_F(DisturbanceGl, TheShaderFindsWhatItsTwinDoes) {
  Lookup lookup;
  for (const glm::dvec2& eye : {glm::dvec2(3.3, -8.1), glm::dvec2(1.0e7 + 0.7, -9.0e6), glm::dvec2(-31.999, 64)}) {
    Disturbance d = make();
    DisturbanceTextures t = textures();
    disturb(d, eye, 5);
    t.upload(d, eye);
    std::mt19937 random(9);
    std::vector<glm::vec2> points;
    for (const float reach : {16.0f, 64.0f, 260.0f})
      for (int i = 0; i < 3000; ++i)
        points.push_back(glm::vec2(float(random()) / 4294967296.0f - 0.5f, float(random()) / 4294967296.0f - 0.5f) *
                         (2 * reach));
    double worst = 0, sum = 0;
    const std::vector<Disturbed> gpu = lookup.at(t, points);
    for (size_t i = 0; i < points.size(); ++i) {
      const Disturbed cpu = d.at(eye + glm::dvec2(points[i]), eye);
      worst = std::max(worst, difference(gpu[i], cpu));
      sum += glm::length(cpu.press) + cpu.cut + cpu.burn + cpu.wet + cpu.paint.a;
    }
    // Filters weigh texels by 1/256 steps on some GPUs.
    EXPECT_LT(worst, 0.008);
    EXPECT_GT(sum, 300);
    std::printf("worst difference %.5f\n", worst);
  }
}

TEST_F(DisturbanceGl, UploadsByTilesEqualAFullRebuild) {
  Disturbance d = make();
  DisturbanceTextures moving = textures();
  disturb(d, {0, 0}, 3);
  size_t tiles = 0;
  for (int i = 0; i < 60; ++i) {
    const glm::dvec2 eye(i * 1.7 - 60, 20 * std::sin(i * 0.2));
    ASSERT_TRUE(d.press_capsule(eye, eye + glm::dvec2(1.2, 0.5), 0.2, 0.9f));
    if (i == 30) {
      ASSERT_TRUE(d.regrow({0, 0}, 30, 60));
    }
    ASSERT_TRUE(d.advance(1.5));
    const auto upload = moving.upload(d, eye);
    if (i > 0) tiles += upload.tiles;
    if (i % 20 != 19) continue;
    DisturbanceTextures fresh = textures();
    fresh.upload(d, eye);
    // As they are seen: moments may be whole half-lives apart.
    std::vector<float> a = texels_of(moving), b = texels_of(fresh);
    const double press = double(moving.block().state.y) / double(fresh.block().state.y);
    const double wet = double(moving.block().state.z) / double(fresh.block().state.z);
    size_t different = 0, filled = 0;
    for (size_t j = 0; j < a.size(); ++j) {
      const size_t layer = j / (size_t(k_side * k_side) * 4) % 3, channel = j % 4;
      const double scale = layer == 0 ? (channel < 2 ? press : channel == 2 ? wet : 1.0) : 1.0;
      different += double(a[j]) * scale != double(b[j]);
      filled += b[j] != 0;
    }
    EXPECT_EQ(different, 0u) << i;
    EXPECT_GT(filled, 5000u);
  }
  std::printf("%zu tiles written in 59 frames\n", tiles);
  EXPECT_LT(tiles, 59 * 768 / 8u);
}

TEST_F(DisturbanceGl, NothingIsWrittenWhereNothingChanges) {
  Disturbance d = make();
  DisturbanceTextures t = textures();
  t.upload(d, {0, 0});
  EXPECT_EQ(t.block().state.x, 0.0f);
  disturb(d, {0, 0}, 3);
  EXPECT_GT(t.upload(d, {0, 0}).tiles, 100u);
  EXPECT_GT(t.block().state.x, 0.0f);
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(d.advance(0.5));
    EXPECT_EQ(t.upload(d, {0.1 * i, 0}).tiles, 0u);
  }
  // A touch writes its tile and those above it.
  ASSERT_TRUE(d.press_disc({5.1, 5.1}, 0.3, 1));
  const auto touched = t.upload(d, {0, 0});
  EXPECT_GE(touched.tiles, 3u);
  EXPECT_LE(touched.tiles, 6u);
  d.clear();
  t.upload(d, {0, 0});
  EXPECT_EQ(t.block().state.x, 0.0f);
  for (const float texel : texels_of(t)) ASSERT_EQ(texel, 0.0f);
}

TEST_F(DisturbanceGl, LeavingAndReturningBringsBackTheSame) {
  DisturbanceOptions options;
  options.press_half_life_s = 1e6;
  options.wet_half_life_s = 1e6;
  Disturbance d = make(options);
  DisturbanceTextures t = textures();
  disturb(d, {100, 50}, 8);
  t.upload(d, {100, 50});
  const std::vector<float> before = texels_of(t);
  for (int i = 0; i < 40; ++i) {
    ASSERT_TRUE(d.advance(1));
    const glm::dvec2 eye(100 + 30.0 * (i < 20 ? i : 39 - i), 50);
    t.upload(d, eye);
    if (i != 1 && i != 4 && i != 19) continue;
    DisturbanceTextures fresh = textures();
    fresh.upload(d, eye);
    EXPECT_EQ(texels_of(fresh), texels_of(t)) << i;
  }
  EXPECT_EQ(before, texels_of(t));
}

TEST_F(DisturbanceGl, PlantsRiseSmoothlyWithNothingWritten) {
  DisturbanceOptions options;
  options.press_half_life_s = 10;
  Disturbance d = make(options);
  DisturbanceTextures t = textures();
  Lookup lookup;
  DisturbanceTouch touch;
  touch.press = 1;
  touch.way = {1, 0};
  ASSERT_TRUE(d.touch({{0, 0}, {0, 0}, 2, 0.3f}, touch));
  t.upload(d, {0, 0});
  double before = 1;
  for (int i = 0; i < 600; ++i) {
    ASSERT_TRUE(d.advance(0.1));
    t.upload(d, {0, 0});
    const double now = glm::length(lookup.at(t, {{0.3f, 0.1f}})[0].press);
    EXPECT_LE(now, before + 1e-6);
    EXPECT_LT(before - now, 0.0085) << i;  // 0.69 % a step, a little more by what is not seen
    const double truth = std::max(std::exp2(-0.01 * (i + 1)) - 0.02, 0.0) / 0.98;
    EXPECT_NEAR(now, truth, 0.004) << i;
    before = now;
  }
  EXPECT_EQ(before, 0.0);
}

TEST_F(DisturbanceGl, UploadLeavesAllState) {
  Disturbance d = make();
  disturb(d, {0, 0}, 3);
  const PoisonedState poison;
  const GlState before = capture_state();
  DisturbanceTextures t = textures();
  EXPECT_GT(t.upload(d, {0, 0}).tiles, 0u);
  expect_only_changed(before, capture_state(), {});
}

// ---- Plants.

Layer layer_of(PlantKind kind) {
  Layer layer = grass_and_soil();
  layer.species[0].kind = kind;
  layer.species[0].height_m = {0.3f, 0.5f};
  layer.species[0].lean = 0.2f;
  return layer;
}

const View k_view = eye_level_view({8.0, -15.0, 1.7}, {64, 48});

struct Compared {
  std::vector<Plant> before, after;
};

/// Plants without and with what `touch` does, GPU and twin compared.
template <class Touch>
Compared compare(Layer layer, Disturbance& d, DisturbanceTextures& t, Touch touch) {
  Patch patch(std::move(layer), plain_map(test::k_side, 8, k_green));
  patch.look(k_view);
  Compared result;
  result.before = expect_same_plants(patch, 500);
  touch(d);
  t.upload(d, glm::dvec2(k_view.eye));
  patch.set_disturbance(&d, t.ground());
  // Half floats; and where a cut only just touches a plant its height changes fast.
  result.after = expect_same_plants(patch, 500, 0.004f);
  EXPECT_EQ(result.before.size(), result.after.size());
  for (size_t i = 0; i < std::min(result.before.size(), result.after.size()); ++i) {
    const Plant &a = result.before[i], &b = result.after[i];
    EXPECT_TRUE(plant_key(a) == plant_key(b) && a.position == b.position && a.fade == b.fade && a.width == b.width);
  }
  return result;
}

double turn_between(double a, double b) {
  return std::abs(std::remainder(a - b, 2 * std::numbers::pi));
}

TEST_F(DisturbanceGl, PressedPlantsLieTheWayOfThePressAndKeepTheirPlace) {
  Disturbance d = make();
  DisturbanceTextures t = textures();
  DisturbanceTouch touch;
  touch.press = 1;
  touch.way = {0.6f, 0.8f};
  const auto all = compare(layer_of(PlantKind::blade), d, t, [&](Disturbance& it) {
    ASSERT_TRUE(it.touch({{0, -8}, {16, -8}, 1.5, 0.2f}, touch));
  });
  size_t pressed = 0;
  for (size_t i = 0; i < all.after.size(); ++i) {
    const Plant& p = all.after[i];
    EXPECT_EQ(p.height, all.before[i].height);
    if (std::abs(p.position.y + 8) < 1.0) {
      EXPECT_LT(turn_between(p.azimuth, std::atan2(0.8, 0.6)), 0.36);
      EXPECT_GE(p.stiffness, 0.88f);
      ++pressed;
    } else if (std::abs(p.position.y + 8) > 1.8) {
      EXPECT_EQ(p.azimuth, all.before[i].azimuth);
    }
  }
  EXPECT_GT(pressed, 100u);
}

TEST_F(DisturbanceGl, CutAndBurntPlantsAreShort) {
  Disturbance d = make();
  DisturbanceTextures t = textures();
  const auto all = compare(layer_of(PlantKind::tuft), d, t, [&](Disturbance& it) {
    ASSERT_TRUE(it.cut_capsule({0, -8}, {16, -8}, 1, 0.06f));
    ASSERT_TRUE(it.burn_disc({8, -12}, 1.5, 1));
  });
  size_t cut = 0, burnt = 0;
  for (size_t i = 0; i < all.after.size(); ++i) {
    const Plant& p = all.after[i];
    if (std::abs(p.position.y + 8) < 0.8) {
      EXPECT_NEAR(p.height, 0.06, 0.012);
      ++cut;
    } else if (glm::length(glm::dvec2(p.position) - glm::dvec2(8, -12)) < 0.8) {
      EXPECT_NEAR(p.height, 0.18 * double(all.before[i].height), 0.002);
      ++burnt;
    }
  }
  EXPECT_GT(cut, 50u);
  EXPECT_GT(burnt, 20u);
}

TEST_F(DisturbanceGl, TreesStandAndTheirResistanceCanBeSet) {
  for (const bool yielding : {false, true}) {
    Disturbance d = make();
    DisturbanceTextures t = textures();
    Layer layer = layer_of(PlantKind::billboard);
    if (yielding) layer.species[0].resistance = 0.0f;
    const auto all = compare(layer, d, t, [&](Disturbance& it) {
      ASSERT_TRUE(it.cut_capsule({0, -8}, {16, -8}, 2, 0.1f));
    });
    size_t shorter = 0;
    for (size_t i = 0; i < all.after.size(); ++i) shorter += all.after[i].height < all.before[i].height;
    EXPECT_EQ(shorter > 50, yielding);
    if (!yielding) {
      EXPECT_EQ(shorter, 0u);
    }
  }
}

/// Plants of a kind, looked at from above.
class FromAbove {
 public:
  explicit FromAbove(PlantKind kind) : patch_(layer(kind), plain_map(test::k_side, 8, k_green)) {}

  /// Mean colour of what is drawn; 0 where that is next to nothing.
  glm::dvec3 color(const gl::DisturbedGround& disturbed) {
    const glm::ivec2 size(48, 48);
    patch_.set_disturbance(nullptr, disturbed);
    auto target = host::RenderTarget::create(size, 1);
    EXPECT_TRUE(target);
    target->begin();
    patch_.look(View::look({8, -8, 6}, std::numbers::pi / 2, -0.5 * std::numbers::pi, 0.5, size, 0.05, 1000));
    patch_.classify(target->framebuffer());
    patch_.draw();
    const std::vector<uint8_t> rgb = target->read_rgb();
    glm::dvec3 sum(0);
    double lit = 0;
    for (size_t i = 0; i < rgb.size(); i += 3) {
      const glm::dvec3 c(rgb[i], rgb[i + 1], rgb[i + 2]);
      sum += c;
      lit += c != glm::dvec3(0);
    }
    return lit < 100 ? glm::dvec3(0) : sum / lit;
  }

 private:
  static Layer layer(PlantKind kind) {
    Layer layer = layer_of(kind);
    const bool shrubs = kind == PlantKind::billboard;
    layer.species[0].width_m = shrubs ? FloatRange{1, 1} : FloatRange{0.03f, 0.04f};
    layer.density = shrubs ? 2.0f : 40.0f;
    layer.shadows = false;
    return layer;
  }
  Patch patch_;
};

TEST_F(DisturbanceGl, BurntIsBlackWetIsDarkerPaintIsSeenOnEveryKind) {
  const glm::dvec2 eye(8, -8);
  Disturbance wet = make(), painted = make(), burnt = make();
  DisturbanceTextures tw = textures(), tp = textures(), tb = textures();
  ASSERT_TRUE(wet.wet_disc(eye, 10, 1));
  ASSERT_TRUE(painted.paint_disc(eye, 10, {1, 0, 0}, 1));
  ASSERT_TRUE(burnt.burn_disc(eye, 10, 1));
  tw.upload(wet, eye);
  tp.upload(painted, eye);
  tb.upload(burnt, eye);
  for (const PlantKind kind : {PlantKind::blade, PlantKind::tuft, PlantKind::leaf, PlantKind::billboard}) {
    FromAbove plants(kind);
    const glm::dvec3 dry = plants.color({});
    ASSERT_GT(dry.g, 10) << int(kind);
    EXPECT_LT(dry.r, 1.2 * dry.g) << int(kind);
    EXPECT_LT(plants.color(tw.ground()).g, 0.93 * dry.g) << int(kind);
    EXPECT_LT(plants.color(tb.ground()).g, 0.6 * dry.g) << int(kind);
    const glm::dvec3 red = plants.color(tp.ground());
    EXPECT_GT(red.r, 1.8 * red.g) << int(kind);
    EXPECT_EQ(plants.color({}), dry) << int(kind);
  }
}

// ---- A scene's own.

constexpr const char* k_track = R"(
[terrain]
generator = "meadow"
[disturbance]
press_half_life_s = 40
[[disturbance.walker]]
path = [[1, 0, 0], [11, 14, 3], [14, 14, 8]]
[[disturbance.walker]]
gait = "wheels"
track_m = 1.2
path = [[0, 0, 10], [20, 40, 10]]
[[disturbance.event]]
kind = "explosion"
time_s = 4.33
position_m = [30, 0]
[[disturbance.event]]
kind = "cut"
time_s = 2
position_m = [-5, -5]
to_m = [-5, 5]
)";

TEST_F(DisturbanceGl, ReplayIsTheSameAtEveryFrameRate) {
  const auto scene = parse_scene(k_track, "track.toml");
  ASSERT_TRUE(scene) << scene.error().message;
  auto one = host::DisturbanceReplay::create(*scene), slow = host::DisturbanceReplay::create(*scene),
       fast = host::DisturbanceReplay::create(*scene);
  ASSERT_TRUE(one && slow && fast);
  for (const double end : {12.0, 30.0, 12.0}) {  // back, too
    ASSERT_TRUE(one->advance_to(end));
    for (int i = 0; i <= int(end); ++i) ASSERT_TRUE(slow->advance_to(i));
    for (int i = 0; i <= int(end * 240); ++i) ASSERT_TRUE(fast->advance_to(i / 240.0));
    size_t pressed = 0;
    for (double y = -6; y < 12; y += 0.23) {
      for (double x = -6; x < 42; x += 0.23) {
        const Disturbed a = one->disturbance().at({x, y}), b = slow->disturbance().at({x, y}),
                        c = fast->disturbance().at({x, y});
        // A foot that is coming down may be one tick of 1/256 s older.
        EXPECT_LT(difference(a, b), 2e-3) << x << " " << y << " " << end;
        EXPECT_LT(difference(a, c), 2e-3) << x << " " << y << " " << end;
        pressed += glm::length(a.press) > 0.3f;
      }
    }
    EXPECT_GT(pressed, 100u);
    EXPECT_GT(one->disturbance().at({-5, 0}).cut, 0.7f);
    EXPECT_GT(one->disturbance().at({30, 0}).burn, 0.9f);
  }
}

}  // namespace
}  // namespace sward
