// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Calls that a host must not make: too early, without a context, in another one, after its end, in the wrong order,
// with views that are none. Each comes to an error value or an assertion with a message; where the assertion handler
// returns, the call does nothing.
#include <limits>
#include <thread>

#include "gl/contract_scene.h"
#include "gl/gl_fixture.h"
#include "host/render_target.h"

namespace sward {
namespace {

using namespace test;

/// Assertions' messages while it lives.
class CaughtAsserts {
 public:
  CaughtAsserts() {
    messages().clear();
    set_assert_handler([](const char*, const char* message, const char*, int) { messages().push_back(message); });
  }
  ~CaughtAsserts() { set_assert_handler(nullptr); }
  /// Hands over what came since the last time.
  static std::vector<std::string> take() { return std::exchange(messages(), {}); }

 private:
  static std::vector<std::string>& messages() {
    static std::vector<std::string> all;
    return all;
  }
};

/// One assertion that says both.
void expect_assert(const std::string& call, const std::string& why) {
  const std::vector<std::string> messages = CaughtAsserts::take();
  ASSERT_EQ(messages.size(), 1u) << call;
  EXPECT_TRUE(messages[0].starts_with(call)) << messages[0];
  EXPECT_NE(messages[0].find(why), std::string::npos) << messages[0];
}

/// Every call that needs the object's own context, or, the last ones, any that shares with it.
struct Objects {
  ContractWorld world;
  ContractScene scene{world};
  ContractClipmap clipmap{world};
  MeshRenderer body = made(MeshRenderer::create(world.body, world.layer, gl::ShaderLibrary()));
  WindTextures wind = made(WindTextures::create());
  DisturbanceTextures disturbed = made(DisturbanceTextures::create());
  FixedTriangles triangles;
  Seeding seeding;

  /// Calls all that must be refused with `own` (where another context is current) and, when not, the shared ones too.
  void expect_refused(const std::string& why, bool shared_too) {
    gl::Frame& frame = scene.frame;
    const View& view = scene.view;
    const auto refused = [&](const char* call, auto&& act) {
      act();
      expect_assert(call, why);
    };
    refused("TerrainRenderer::upload", [&] { scene.terrain.upload(scene.mesh); });
    refused("TerrainRenderer::draw", [&] { scene.terrain.draw(view, frame, scene.textures); });
    refused("ClipmapRenderer::draw", [&] { clipmap.terrain.draw(view, clipmap.clipmap, frame, scene.textures); });
    refused("MeshRenderer::draw", [&] { body.draw(view, frame); });
    refused("VegetationRenderer::upload",
            [&] { EXPECT_FALSE(scene.plants.upload(scene.seeding, scene.triangles, view)); });
    refused("VegetationRenderer::upload", [&] { clipmap.plants.upload(clipmap.seeder, clipmap.clipmap, view); });
    refused("VegetationRenderer::classify", [&] { scene.plants.classify(frame, scene.textures, 0); });
    refused("VegetationRenderer::draw", [&] { scene.plants.draw(frame, scene.textures); });
    refused("VegetationRenderer::stats", [&] { scene.plants.stats(true); });
    refused("VegetationRenderer::set_wind", [&] { EXPECT_FALSE(scene.plants.set_wind(&wind)); });
    refused("VegetationRenderer::read_back",
            [&] { EXPECT_FALSE(scene.plants.read_back(frame, scene.textures, view, scene.seeding, 0)); });
    refused("ClipmapSeeder::seed", [&] { EXPECT_FALSE(clipmap.seeder.seed(view, clipmap.clipmap)); });
    refused("ClipmapSeeder::stats", [&] { clipmap.seeder.stats(true); });
    refused("ClipmapSeeder::read_back", [&] { clipmap.seeder.read_back(view, clipmap.clipmap, triangles, seeding); });
    if (!shared_too) return;
    refused("Frame::upload", [&] { frame.upload(view, {}, 0, 1); });
    refused("Clipmap::follow", [&] { clipmap.clipmap.follow(view); });
    refused("SlopeMap::follow", [&] { scene.textures.slopes().follow(*world.ground.surface, {0, 0}, 1); });
    refused("SlopeMap::update", [&] { scene.textures.update_slopes(*world.ground.field, {{0, 0}, {64, 64}}); });
    refused("WindTextures::upload", [&] { wind.upload(world.wind, view.eye); });
    refused("DisturbanceTextures::upload", [&] { disturbed.upload(world.disturbance, {0, 0}); });
  }
};

class Misuse : public GlTest {
 protected:
  void TearDown() override {
    if (shared_context()) shared_context()->make_current();
    GlTest::TearDown();
  }
  CaughtAsserts asserts_;
};

// ---- Too early.

TEST(MisuseWithoutContext, CreationFailsEvenBeforeAnythingOfGlIsLoaded) {
  Expected<void> result;
  std::thread([&] { result = gl::require_context(); }).join();
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("no OpenGL context is current"), std::string::npos) << result.error().message;
}

TEST_F(Misuse, ObjectsThatCreateHasNotMadeAreRefused) {
  const ContractWorld world;
  const View view = world.look();
  gl::Frame().upload(view, {}, 0, 1);
  expect_assert("Frame::upload", "was not made by its create()");
  const gl::GroundTextures textures = made(gl::GroundTextures::create(*world.ground.field, world.map));
  TerrainRenderer().draw(view, gl::Frame(), textures);
  expect_assert("TerrainRenderer::draw", "was not made by its create()");
}

TEST_F(Misuse, CallsInTheWrongOrderAreRefused) {
  Objects o;
  const gl::Frame& frame = o.scene.frame;
  o.scene.terrain.draw(o.scene.view, frame, o.scene.textures);  // draws nothing
  o.scene.plants.draw(frame, o.scene.textures);                 // nothing either
  EXPECT_TRUE(CaughtAsserts::take().empty());
  o.scene.plants.classify(frame, o.scene.textures, 0);
  expect_assert("upload a seeding before classifying", "");
  const auto plants = o.scene.plants.read_back(frame, o.scene.textures, o.scene.view, o.scene.seeding, 0);
  ASSERT_FALSE(plants);
  EXPECT_NE(plants.error().message.find("nothing was classified"), std::string::npos);
  o.clipmap.seeder.read_back(o.scene.view, o.clipmap.clipmap, o.triangles, o.seeding);
  expect_assert("nothing was seeded", "");
  o.clipmap.plants.upload(o.clipmap.seeder, o.clipmap.clipmap, o.scene.view);
  expect_assert("seed before uploading", "");
  EXPECT_FALSE(o.clipmap.plants.upload(o.scene.seeding, o.scene.triangles, o.scene.view));
  expect_assert("a renderer for clipmaps", "");
  const ContractWorld other;
  gl::Clipmap foreign = made(gl::Clipmap::create(*other.ground.surface, {64}));
  EXPECT_FALSE(o.clipmap.seeder.seed(o.scene.view, foreign));
  expect_assert("the clipmap is another surface's", "");
}

// ---- Contexts.

TEST_F(Misuse, CallsOnAThreadWithoutAContextAreRefused) {
  Objects o;
  std::thread([&] { o.expect_refused("no OpenGL context is current on this thread", true); }).join();
}

TEST_F(Misuse, CallsInAnotherContextAreRefused) {
  Objects o;
  auto other = host::EglContext::create(true);
  ASSERT_TRUE(other) << other.error().message;
  const GlState before = capture_state();
  o.expect_refused("another OpenGL context is current", false);
  expect_only_changed(before, capture_state(), {});
  EXPECT_TRUE(other->take_messages().empty());
}

TEST_F(Misuse, ObjectsOutliveTheirContextAndDieWithoutACall) {
  auto context = host::EglContext::create(true);
  ASSERT_TRUE(context) << context.error().message;
  std::unique_ptr<Objects> objects = std::make_unique<Objects>();
  objects->clipmap.clipmap.follow(objects->scene.view);
  ASSERT_TRUE(objects->clipmap.seeder.seed(objects->scene.view, objects->clipmap.clipmap));  // a fence is on its way
  *context = std::move(*host::EglContext::create(false));  // the first one is destroyed
  context->release_current();
  objects->expect_refused("no OpenGL context is current on this thread", true);
  objects.reset();
  EXPECT_TRUE(CaughtAsserts::take().empty());
}

TEST_F(Misuse, DestructionDoesNotReachIntoAnotherContext) {
  ASSERT_TRUE(gl::require_context());  // as every creation asks first
  gl::VertexArray ours = gl::create_vertex_array();
  gl::Framebuffer framebuffer = gl::create_framebuffer();
  gl::Query query = gl::create_query(GL_SAMPLES_PASSED);
  gl::Feedback feedback = gl::create_feedback();
  auto other = host::EglContext::create(true);
  ASSERT_TRUE(other) << other.error().message;
  // The other context's objects of the same names.
  std::vector<gl::VertexArray> arrays;
  while (arrays.empty() || arrays.back().id() < ours.id()) arrays.push_back(gl::create_vertex_array());
  std::vector<gl::Framebuffer> framebuffers;
  while (framebuffers.empty() || framebuffers.back().id() < framebuffer.id())
    framebuffers.push_back(gl::create_framebuffer());
  const GLuint array_name = ours.id(), framebuffer_name = framebuffer.id();
  { const auto gone = std::move(ours); }
  { const auto gone = std::move(framebuffer); }
  { const auto gone = std::move(query); }
  { const auto gone = std::move(feedback); }
  EXPECT_TRUE(glIsVertexArray(array_name));
  EXPECT_TRUE(glIsFramebuffer(framebuffer_name));
  EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

// ---- Views.

struct BadView {
  const char* why;
  View view;
};

std::vector<BadView> bad_views(const View& good) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  std::vector<BadView> bad(8, {"", good});
  bad[0] = {"is empty", good}, bad[0].view.viewport = {0, 0};
  bad[1] = {"is empty", good}, bad[1].view.viewport = {-64, 64};
  bad[2] = {"eye position", good}, bad[2].view.eye.x = nan;
  bad[3] = {"eye position", good}, bad[3].view.eye.z = infinity;
  bad[4] = {"singular", good}, bad[4].view.clip_from_eye = glm::dmat4(0);
  bad[5] = {"projection has a number", good}, bad[5].view.clip_from_eye[2][2] = nan;
  bad[6] = {"not a rotation", good}, bad[6].view.eye_from_world = glm::dmat3(0);
  bad[7] = {"is empty", View::look(good.eye, 0, 0, 1, {0, 0}, 0.1, 100)};
  return bad;
}

template <class T>
void expect_error(const Expected<T>& result, const std::string& why) {
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find(why), std::string::npos) << result.error().message;
}

TEST_F(Misuse, ViewsThatAreNoneAreRefusedByEveryCall) {
  Objects o;
  auto target = made(host::RenderTarget::create(k_contract_size, 1));
  target.begin();
  o.scene.draw(target.framebuffer());
  const GlState before = capture_state();
  for (const BadView& bad : bad_views(o.scene.view)) {
    SCOPED_TRACE(bad.why);
    const View& view = bad.view;
    expect_error(View::from_matrices(view.eye, glm::dmat4(view.eye_from_world), view.clip_from_eye, view.viewport),
                 bad.why);
    expect_error(o.scene.mesh.update(view), bad.why);
    expect_error(o.scene.plants.upload(o.scene.seeding, o.scene.triangles, view), bad.why);
    expect_error(o.clipmap.seeder.seed(view, o.clipmap.clipmap), bad.why);
    o.scene.frame.upload(view, {}, 0, 1);
    expect_assert("Frame::upload", bad.why);
    o.scene.terrain.draw(view, o.scene.frame, o.scene.textures);
    expect_assert("TerrainRenderer::draw", bad.why);
    EXPECT_EQ(o.clipmap.clipmap.follow(view).points, 0u);
    expect_assert("Clipmap::follow", bad.why);
    o.clipmap.terrain.draw(view, o.clipmap.clipmap, o.scene.frame, o.scene.textures);
    expect_assert("ClipmapRenderer::draw", bad.why);
    o.body.draw(view, o.scene.frame);
    expect_assert("MeshRenderer::draw", bad.why);
    seed(o.world.layer, view, o.world.map, o.scene.triangles, o.seeding);
    expect_assert("seed", bad.why);
    EXPECT_TRUE(o.seeding.records.empty());
    o.world.body.fixed_level_triangles(view, 1.0f, {}, o.triangles);
    expect_assert("MeshSurface::fixed_level_triangles", bad.why);
    EXPECT_EQ(o.triangles.size(), 0u);
  }
  expect_only_changed(before, capture_state(), {});
}

TEST_F(Misuse, FramesNeedATimeAndSamples) {
  ContractWorld world;
  gl::Frame frame = made(gl::Frame::create());
  frame.upload(world.look(), {}, std::numeric_limits<double>::quiet_NaN(), 1);
  expect_assert("Frame::upload: the time", "finite");
  frame.upload(world.look(), {}, 0, 0);
  expect_assert("Frame::upload: a target", "at least one sample");
}

}  // namespace
}  // namespace sward
