// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// What the OpenSceneGraph plugin draws, off screen. Needs a display (run it under xvfb-run).

#include "osg_support.h"

#include <algorithm>
#include <fstream>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/ShapeDrawable>
#include <osg/Texture2D>

namespace osg_test {
namespace {

TEST_F(Offscreen, DrawsTheSceneWithoutErrors) {
  const osg::ref_ptr<osg::Node> node = read_scene("small");
  ASSERT_TRUE(node.valid());
  const osg::BoundingBox box = drawable_of(*node).getBoundingBox();
  ASSERT_TRUE(box.valid());
  EXPECT_DOUBLE_EQ(box.xMin(), -256);
  EXPECT_DOUBLE_EQ(box.yMax(), 256);
  stand(*node, 0, 0);
  draw(node.get(), 2);
  EXPECT_TRUE(capture_->errors.empty()) << "first GL error: " << capture_->errors.front();
  EXPECT_EQ(background_pixels(*capture_), 0) << "terrain and sky leave nothing of the background";
  // The ground ahead is meadow: green is its strongest colour, blue its weakest, on most of it.
  int meadow = 0;
  for (int x = 0; x < k_width; ++x)
    for (int y = 0; y < k_height / 4; ++y) {
      const unsigned char* pixel = capture_->pixel(x, y);
      meadow += pixel[2] < pixel[0] && pixel[2] < pixel[1] ? 1 : 0;
    }
  EXPECT_GT(meadow, k_width * k_height / 4 * 8 / 10);
}

// The sky is drawn where the ground is out of sight, too; without it nothing is.
TEST_F(Offscreen, DrawsTheSkyUnlessToldOtherwise) {
  for (const char* options : {"", "noSky"}) {
    const osg::ref_ptr<osg::Node> node = read_scene("small", options);
    ASSERT_TRUE(node.valid());
    const osg::Vec3d eye(0, 0, 200);
    viewer_.getCamera()->setViewMatrixAsLookAt(eye, eye + osg::Vec3d(0, 0, 1), {0, 1, 0});
    draw(node.get(), 1);
    EXPECT_EQ(background_pixels(*capture_), *options == 0 ? 0 : k_width * k_height) << options;
  }
}

// From above: plants are within the horizon or not.
void look_down(osgViewer::Viewer& viewer, osg::Node& node, double above) {
  const osg::Vec3d eye(0, 0, ground_height(node, 0, 0) + above);
  viewer.getCamera()->setViewMatrixAsLookAt(eye, eye + osg::Vec3d(0, 0.2, -1), {0, 1, 0});
}

// Grass breaks up the ground near the eye, on a target of one sample as stock viewers have (hashed alpha) and on four.
TEST_F(Offscreen, GrowsPlantsOnOneAndOnFourSamples) {
  const osg::ref_ptr<osg::Node> node = read_scene("small");
  ASSERT_TRUE(node.valid());
  look_down(viewer_, *node, 60);
  draw(node.get(), 2);
  const double bare = roughness(*capture_);
  look_down(viewer_, *node, 5);
  draw(node.get(), 2);
  const double hashed = roughness(*capture_);
  EXPECT_GT(hashed, bare * 4) << "blades must break up the smooth ground";
  EXPECT_TRUE(capture_->errors.empty());

  osgViewer::Viewer smooth;
  const osg::ref_ptr<osg::GraphicsContext> context = make_context(nullptr, 4);
  ASSERT_TRUE(context.valid());
  if (context->getTraits()->samples < 4) GTEST_SKIP() << "the display has no pbuffers of four samples";
  smooth.setThreadingModel(osgViewer::Viewer::SingleThreaded);
  set_up(*smooth.getCamera(), context.get(), capture_.get());
  smooth.setSceneData(node);
  look_down(smooth, *node, 5);
  smooth.realize();
  for (int i = 0; i < 2; ++i) {
    smooth.advance(0);
    smooth.updateTraversal();
    smooth.renderingTraversals();
  }
  EXPECT_GT(roughness(*capture_), bare * 4);
  EXPECT_NEAR(roughness(*capture_), hashed, 0.3 * hashed) << "as much grass as hashed alpha shows";
  EXPECT_TRUE(capture_->errors.empty());
}

// Shows a texture on all of the picture.
osg::ref_ptr<osg::Camera> make_screen(osg::Texture2D* texture) {
  osg::ref_ptr<osg::Camera> screen(new osg::Camera);
  screen->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
  screen->setProjectionMatrixAsOrtho(0, 1, 0, 1, -1, 1);
  screen->setRenderOrder(osg::Camera::POST_RENDER);
  screen->addChild(osg::createTexturedQuadGeometry({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
  screen->getOrCreateStateSet()->setTextureAttributeAndModes(0, texture);
  screen->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
  return screen;
}

// A camera that renders to a texture, through a framebuffer object of OpenSceneGraph's.
TEST_F(Offscreen, DrawsIntoFramebufferObjects) {
  const osg::ref_ptr<osg::Node> node = read_scene("small");
  ASSERT_TRUE(node.valid());
  look_down(viewer_, *node, 5);
  draw(node.get(), 2);
  const double direct = roughness(*capture_);
  const osg::ref_ptr<osg::Texture2D> texture(new osg::Texture2D);
  texture->setTextureSize(k_width, k_height);
  texture->setInternalFormat(GL_RGBA8);
  texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
  texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
  const osg::ref_ptr<osg::Camera> camera(new osg::Camera);
  camera->setRenderOrder(osg::Camera::PRE_RENDER);
  camera->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
  camera->setViewport(0, 0, k_width, k_height);
  camera->setClearColor({1, 0, 1, 1});
  camera->attach(osg::Camera::COLOR_BUFFER, texture.get());
  camera->addChild(node);
  const osg::ref_ptr<osg::Group> root(new osg::Group);
  root->addChild(camera);
  root->addChild(make_screen(texture.get()));
  draw(root.get(), 2);
  EXPECT_EQ(background_pixels(*capture_), 0);
  EXPECT_NEAR(roughness(*capture_), direct, 0.02 * direct);
  EXPECT_TRUE(capture_->errors.empty());
}

// Wind moves by the frame stamp's simulation time: the same time gives the same picture.
TEST_F(Offscreen, WindFollowsSimulationTime) {
  const osg::ref_ptr<osg::Node> node = read_scene("windy");
  ASSERT_TRUE(node.valid());
  stand(*node, 0, 0, 0.6);
  draw(node.get(), 2, 20);
  draw(node.get(), 1, 20);
  const auto first = capture_->bytes();
  draw(node.get(), 1, 20);
  EXPECT_EQ(difference(capture_->bytes(), first), "") << "time stands still";
  draw(node.get(), 1, 20.5);
  EXPECT_NE(difference(capture_->bytes(), first), "") << "half a second later";
}

// Keeps what OpenSceneGraph says.
struct Said : osg::NotifyHandler {
  void notify(osg::NotifySeverity, const char* message) override { text += message; }
  std::string text;
};

struct Listen {
  Listen() { osg::setNotifyHandler(said.get()); }
  ~Listen() { osg::setNotifyHandler(new osg::StandardNotifyHandler); }
  osg::ref_ptr<Said> said{new Said};
};

TEST(OsgReader, SaysWhatIsWrongWithAScene) {
  const std::string path = testing::TempDir() + "sward_osg_broken.toml";
  std::ofstream(path) << "[terrain]\ngenerator = 7\n";
  const Listen listen;
  EXPECT_FALSE(osgDB::readRefNodeFile(path + ".sward").valid());
  EXPECT_NE(listen.said->text.find("sward_osg_broken.toml:2"), std::string::npos) << listen.said->text;
  EXPECT_FALSE(osgDB::readRefNodeFile("no_such_scene.sward").valid());
  EXPECT_NE(listen.said->text.find("no_such_scene"), std::string::npos) << listen.said->text;
}

// What cannot be drawn is told once, and what stands beside it is drawn.
TEST_F(Offscreen, GoesOnWhenADrawFails) {
  const osg::ref_ptr<osg::Node> node = read_scene("small", "noSky");
  ASSERT_TRUE(node.valid());
  const osg::Vec3d eye(0, 0, 60);
  viewer_.getCamera()->setViewMatrixAsLookAt(eye, eye + osg::Vec3d(0, 1, -0.5), {0, 0, 1});
  const osg::ref_ptr<osg::MatrixTransform> twice(new osg::MatrixTransform(osg::Matrix::scale(2, 2, 2)));
  twice->addChild(node);
  const osg::ref_ptr<osg::Group> root(new osg::Group);
  root->addChild(twice);
  root->addChild(new osg::ShapeDrawable(new osg::Sphere(eye + osg::Vec3d(0, 5, -2.5), 1)));
  const Listen listen;
  draw(root.get(), 3);
  const std::string& text = listen.said->text;
  const size_t first = text.find("sward: error: ");
  ASSERT_NE(first, std::string::npos) << text;
  EXPECT_EQ(text.find("sward: error: ", first + 1), std::string::npos) << text;
  EXPECT_LT(background_pixels(*capture_), k_width * k_height) << "the sphere is there";
  EXPECT_TRUE(capture_->errors.empty());
}

}  // namespace
}  // namespace osg_test
