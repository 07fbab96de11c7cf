// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// Several contexts, views and threads; what is drawn beside a scene; what is left when it is gone.

#include "osg_support.h"

#include <osg/AlphaFunc>
#include <osg/BlendFunc>
#include <osg/BufferIndexBinding>
#include <osg/Depth>
#include <osg/Geometry>
#include <osg/Program>
#include <osg/ShapeDrawable>
#include <osg/Texture2D>

namespace osg_test {
namespace {

// Two cameras, each with a context of its own, that look at one scene from places of their own.
class TwoViews {
 public:
  explicit TwoViews(osgViewer::ViewerBase::ThreadingModel threading, osg::Node* scene, bool shared = false) {
    viewer_.setThreadingModel(threading);
    for (int i = 0; i < 2; ++i) {
      contexts[i] = make_context(shared && i == 1 ? contexts[0].get() : nullptr);
      osg::ref_ptr<osgViewer::View> view(new osgViewer::View);
      set_up(*view->getCamera(), contexts[i].get(), captures[i].get());
      const double x = 40.0 * i;
      const osg::Vec3d eye(x, 0, ground_height(*scene, x, 0) + 3);
      view->getCamera()->setViewMatrixAsLookAt(eye, eye + osg::Vec3d(0, 0.3, -1), {0, 1, 0});
      view->setSceneData(scene);
      viewer_.addView(view.get());
      views[i] = view;
    }
    viewer_.realize();
  }

  void draw(int frames, double time_s = 0) {
    for (int i = 0; i < frames; ++i) {
      viewer_.advance(time_s);
      viewer_.updateTraversal();
      viewer_.renderingTraversals();
    }
    // Threads hand their pictures over behind the main thread's back.
    viewer_.stopThreading();
  }

  void close_second() {
    viewer_.removeView(views[1].get());
    views[1]->getCamera()->setGraphicsContext(nullptr);
    views[1] = nullptr;
    contexts[1]->close();
    contexts[1] = nullptr;
  }

  osg::ref_ptr<osg::GraphicsContext> contexts[2];
  osg::ref_ptr<Capture> captures[2]{new Capture, new Capture};
  osg::ref_ptr<osgViewer::View> views[2];
  osgViewer::CompositeViewer viewer_;
};

constexpr double k_rough = 4;  // Bare ground from 3 m above is below 1.

TEST(OsgContexts, ClosingOneWindowKeepsTheOtherGoing) {
  using Threading = osgViewer::ViewerBase;
  for (const auto model : {Threading::DrawThreadPerContext, Threading::CullDrawThreadPerContext}) {
    const osg::ref_ptr<osg::Node> node = read_scene("small");
    ASSERT_TRUE(node.valid());
    TwoViews two(model, node.get());
    ASSERT_TRUE(two.contexts[0].valid() && two.contexts[1].valid());
    two.draw(3);
    for (const auto& capture : two.captures) {
      EXPECT_GT(roughness(*capture), k_rough) << "plants; threading model " << model;
      EXPECT_TRUE(capture->errors.empty());
    }
    const auto before = two.captures[0]->bytes();
    EXPECT_NE(difference(two.captures[1]->bytes(), before), "") << "each view is its own";
    two.close_second();
    two.viewer_.startThreading();
    two.draw(2);
    EXPECT_EQ(difference(two.captures[0]->bytes(), before), "") << "threading model " << model;
    EXPECT_TRUE(two.captures[0]->errors.empty());
  }
}

// Contexts that share buffers and textures have one contextID, and vertex arrays of their own nevertheless.
TEST(OsgContexts, SharingContextsHaveTheirOwnRenderers) {
  const osg::ref_ptr<osg::Node> node = read_scene("small");
  ASSERT_TRUE(node.valid());
  TwoViews two(osgViewer::ViewerBase::SingleThreaded, node.get(), true);
  ASSERT_EQ(two.contexts[0]->getState()->getContextID(), two.contexts[1]->getState()->getContextID());
  two.draw(2);
  for (const auto& capture : two.captures) {
    EXPECT_GT(roughness(*capture), k_rough);
    EXPECT_TRUE(capture->errors.empty());
  }
  const auto before = two.captures[0]->bytes();
  two.close_second();
  two.draw(2);
  EXPECT_EQ(difference(two.captures[0]->bytes(), before), "");
  EXPECT_TRUE(two.captures[0]->errors.empty());
}

// A quad that fills the picture half a metre ahead of the eye: what is behind it cannot be seen.
osg::ref_ptr<osg::Geometry> make_quad(const osg::Matrixd& world_from_eye, float left, float right) {
  const osg::ref_ptr<osg::Vec3Array> points(new osg::Vec3Array);
  const osg::ref_ptr<osg::Vec3Array> normals(new osg::Vec3Array(osg::Array::BIND_OVERALL));
  const osg::ref_ptr<osg::Vec2Array> places(new osg::Vec2Array);
  for (const osg::Vec2 corner : {osg::Vec2(left, -1), osg::Vec2(right, -1), osg::Vec2(right, 1), osg::Vec2(left, 1)}) {
    points->push_back(osg::Vec3d(corner.x() * 0.5, corner.y() * 0.5, -0.5) * world_from_eye);
    places->push_back(corner);
  }
  normals->push_back(osg::Matrixd::transform3x3(osg::Vec3d(0, 0.6, 0.8), world_from_eye));
  osg::ref_ptr<osg::Geometry> quad(new osg::Geometry);
  quad->setVertexArray(points.get());
  quad->setNormalArray(normals.get());
  quad->setTexCoordArray(0, places.get());
  quad->setTexCoordArray(3, places.get());
  quad->addPrimitiveSet(new osg::DrawArrays(GL_QUADS, 0, 4));
  return quad;
}

osg::ref_ptr<osg::Texture2D> make_texture(unsigned char base) {
  const osg::ref_ptr<osg::Image> image(new osg::Image);
  image->allocateImage(8, 8, 1, GL_RGBA, GL_UNSIGNED_BYTE);
  for (int i = 0; i < 256; ++i) image->data()[i] = static_cast<unsigned char>(base + i * 37 % 128);
  return new osg::Texture2D(image.get());
}

constexpr const char* k_vertex = R"(#version 150 compatibility
out vec2 place;
void main() { place = gl_MultiTexCoord0.xy; gl_Position = ftransform(); })";
constexpr const char* k_fragment = R"(#version 150 compatibility
uniform sampler2D picture; uniform float gain;
layout(std140) uniform Tint { vec4 tint; };
in vec2 place;
void main() { gl_FragColor = vec4(texture(picture, place).rgb * gain + tint.rgb, 1.0); })";

// Lit and textured by fixed functions; a program with a texture and a uniform buffer; a blended one over lines.
osg::ref_ptr<osg::Group> make_models(const osg::Matrixd& world_from_eye) {
  const osg::ref_ptr<osg::Geometry> lit = make_quad(world_from_eye, -1.5f, -0.3f);
  lit->getOrCreateStateSet()->setTextureAttributeAndModes(0, make_texture(60));
  lit->getOrCreateStateSet()->setTextureAttributeAndModes(3, make_texture(120));
  lit->getOrCreateStateSet()->setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::GREATER, 0.02f));

  const osg::ref_ptr<osg::Geometry> shaded = make_quad(world_from_eye, -0.3f, 0.5f);
  shaded->setUseDisplayList(false);
  shaded->setUseVertexBufferObjects(true);
  shaded->setUseVertexArrayObject(true);
  osg::StateSet& set = *shaded->getOrCreateStateSet();
  const osg::ref_ptr<osg::Program> program(new osg::Program);
  program->addShader(new osg::Shader(osg::Shader::VERTEX, k_vertex));
  program->addShader(new osg::Shader(osg::Shader::FRAGMENT, k_fragment));
  program->addBindUniformBlock("Tint", 0);
  set.setAttributeAndModes(program.get());
  set.setTextureAttributeAndModes(1, make_texture(20));
  set.addUniform(new osg::Uniform("picture", 1));
  set.addUniform(new osg::Uniform("gain", 0.7f));
  const osg::ref_ptr<osg::FloatArray> tint(new osg::FloatArray);
  for (const float value : {0.1f, 0.0f, 0.2f, 0.0f}) tint->push_back(value);
  tint->setBufferObject(new osg::UniformBufferObject);
  set.setAttributeAndModes(new osg::UniformBufferBinding(0, tint.get(), 0, 16));

  const osg::ref_ptr<osg::Geometry> under = make_quad(world_from_eye, 0.5f, 1.5f);
  under->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
  const osg::ref_ptr<osg::Geometry> over = make_quad(world_from_eye, 0.6f, 1.4f);
  over->getOrCreateStateSet()->setAttributeAndModes(new osg::BlendFunc(GL_ONE, GL_ONE));
  over->getOrCreateStateSet()->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
  over->getOrCreateStateSet()->setTextureAttributeAndModes(0, make_texture(10));
  over->getOrCreateStateSet()->setRenderBinDetails(1, "RenderBin");

  osg::ref_ptr<osg::Group> models(new osg::Group);
  for (const auto& each : {lit, shaded, under, over}) models->addChild(each);
  return models;
}

class Beside : public Offscreen {
 protected:
  void SetUp() override {
    Offscreen::SetUp();
    node_ = read_scene("small");
    ASSERT_TRUE(node_.valid());
    stand(*node_, 0, 0);
    viewer_.getCamera()->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    models_ = make_models(osg::Matrixd::inverse(viewer_.getCamera()->getViewMatrix()));
    root_->addChild(models_);
  }
  std::vector<unsigned char> picture(int frames = 2) {
    draw(root_.get(), frames);
    EXPECT_TRUE(capture_->errors.empty());
    return capture_->bytes();
  }

  osg::ref_ptr<osg::Node> node_;
  osg::ref_ptr<osg::Group> models_, root_{new osg::Group};
};

// Models that hide all of sward look the same beside it as alone, byte for byte, whether they are drawn before or after
// it: nothing of the viewer's state is lost. And when it is gone nothing of it is left.
TEST_F(Beside, ModelsLookTheSameWithAndWithoutTheScene) {
  const auto alone = picture();
  ASSERT_EQ(background_pixels(*capture_), 0) << "models must fill the picture";
  root_->addChild(node_);
  for (const int bin : {-5, 5}) {
    node_->getOrCreateStateSet()->setRenderBinDetails(bin, "RenderBin");
    for (int frame = 0; frame < 3; ++frame)
      EXPECT_EQ(difference(picture(1), alone), "") << "bin " << bin << " frame " << frame;
  }
  root_->removeChild(node_);
  EXPECT_EQ(difference(picture(), alone), "");
}

// The other way round: what nodes above say does not reach sward, even when they insist.
TEST_F(Beside, TheSceneLooksTheSameBelowHostileState) {
  root_->removeChild(models_);
  root_->addChild(node_);
  const auto alone = picture(3);
  ASSERT_GT(roughness(*capture_), 1);
  constexpr unsigned insist = osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE;
  osg::StateSet& hostile = *root_->getOrCreateStateSet();
  hostile.setMode(GL_CULL_FACE, insist);
  hostile.setAttributeAndModes(new osg::BlendFunc(GL_ONE, GL_ONE), insist);
  hostile.setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::LESS, 0.1f), insist);
  hostile.setAttributeAndModes(new osg::Depth(osg::Depth::ALWAYS, 0.5, 1, false), insist);
  hostile.setTextureAttributeAndModes(0, make_texture(60), insist);
  EXPECT_EQ(difference(picture(2), alone), "");
}

// Depth is one: a sphere on the ground hides what is behind it and is hidden by blades before it.
TEST_F(Offscreen, ModelsStandInTheGrass) {
  const osg::ref_ptr<osg::Node> node = read_scene("small");
  ASSERT_TRUE(node.valid());
  stand(*node, 0, 0, 0.3);
  const osg::Vec3d foot(0, 5, ground_height(*node, 0, 5));
  const osg::ref_ptr<osg::ShapeDrawable> ball(new osg::ShapeDrawable(new osg::Sphere(foot, 1)));
  ball->setColor({1, 0, 0, 1});
  ball->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
  const osg::ref_ptr<osg::Group> root(new osg::Group);
  root->addChild(ball);
  draw(root.get(), 1);
  const auto red = [&] {
    int count = 0;
    for (int y = 0; y < k_height; ++y)
      for (int x = 0; x < k_width; ++x) {
        const unsigned char* pixel = capture_->pixel(x, y);
        count += pixel[0] == 255 && pixel[1] == 0 && pixel[2] == 0 ? 1 : 0;
      }
    return count;
  };
  const int alone = red();
  root->addChild(node);
  draw(root.get(), 3);
  // Its lower half is in the ground.
  EXPECT_LT(red(), alone * 3 / 4);
  EXPECT_GT(red(), alone / 5);
}

}  // namespace
}  // namespace osg_test
