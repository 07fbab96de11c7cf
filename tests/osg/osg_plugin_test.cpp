// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// The OpenSceneGraph plugin in a viewer of its own, off screen: what it draws, and what it leaves of the viewer's GL
// state. Needs a display (run it under xvfb-run).

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <osg/GLObjects>
#include <osg/Geode>
#include <osg/ShapeDrawable>
#include <osgDB/ReadFile>
#include <osgViewer/Viewer>

namespace {

constexpr int k_width = 320, k_height = 240;
constexpr unsigned char k_background[3] = {255, 0, 255};

// Copies the picture when the camera has drawn, and collects GL errors.
struct Capture : osg::Camera::DrawCallback {
  void operator()(osg::RenderInfo&) const override {
    for (GLenum error = glGetError(); error != GL_NO_ERROR; error = glGetError()) errors.push_back(error);
    image->readPixels(0, 0, k_width, k_height, GL_RGB, GL_UNSIGNED_BYTE);
  }
  osg::ref_ptr<osg::Image> image{new osg::Image};
  mutable std::vector<GLenum> errors;
};

const std::string k_scene = SWARD_OSG_TEST_SCENE;

class OsgPlugin : public testing::Test {
 protected:
  void SetUp() override {
    osg::ref_ptr<osg::GraphicsContext::Traits> traits(new osg::GraphicsContext::Traits);
    traits->readDISPLAY();
    traits->width = k_width;
    traits->height = k_height;
    traits->pbuffer = true;
    traits->depth = 24;
    context_ = osg::GraphicsContext::createGraphicsContext(traits.get());
    ASSERT_TRUE(context_.valid()) << "no GL context on this display";
    viewer_.setThreadingModel(osgViewer::Viewer::SingleThreaded);
    osg::Camera& camera = *viewer_.getCamera();
    camera.setGraphicsContext(context_.get());
    camera.setViewport(0, 0, k_width, k_height);
    camera.setProjectionMatrixAsPerspective(50, double(k_width) / k_height, 0.1, 2000);
    camera.setClearColor({1, 0, 1, 1});
    camera.setFinalDrawCallback(capture_.get());
    camera.setDrawBuffer(GL_FRONT);
    camera.setReadBuffer(GL_FRONT);
  }

  void draw(osg::Node* scene, int frames) {
    viewer_.setSceneData(scene);
    viewer_.realize();
    for (int i = 0; i < frames; ++i) {
      // The manipulator is not used: the matrix set here is the view.
      viewer_.advance();
      viewer_.updateTraversal();
      viewer_.renderingTraversals();
    }
  }

  const unsigned char* pixel(int x, int y) const { return capture_->image->data(unsigned(x), unsigned(y)); }

  int background_pixels(int first_row, int last_row) const {
    int count = 0;
    for (int y = first_row; y < last_row; ++y)
      for (int x = 0; x < k_width; ++x) count += std::equal(k_background, k_background + 3, pixel(x, y)) ? 1 : 0;
    return count;
  }

  // Twenty metres above the ground at the middle, looking north and slightly down.
  void look(const osg::BoundingBox& box) {
    const osg::Vec3d eye(0, 0, box.zMax() + 5);
    viewer_.getCamera()->setViewMatrixAsLookAt(eye, eye + osg::Vec3d(0, 1, -0.4), {0, 0, 1});
  }

  osg::ref_ptr<osg::GraphicsContext> context_;
  osg::ref_ptr<Capture> capture_{new Capture};
  osgViewer::Viewer viewer_;
};

osg::BoundingBox box_of(const osg::Node& node) {
  return node.asGroup()->getChild(0)->asDrawable()->getBoundingBox();
}

TEST_F(OsgPlugin, DrawsTheSceneWithoutErrors) {
  const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(k_scene);
  ASSERT_TRUE(node.valid());
  const osg::BoundingBox box = box_of(*node);
  ASSERT_TRUE(box.valid());
  EXPECT_DOUBLE_EQ(box.xMin(), -256);
  EXPECT_DOUBLE_EQ(box.yMax(), 256);
  look(box);
  draw(node.get(), 2);
  EXPECT_TRUE(capture_->errors.empty()) << "first GL error: " << capture_->errors.front();
  EXPECT_EQ(background_pixels(0, k_height), 0) << "terrain and sky leave nothing of the background";
  // The ground ahead is meadow: green is its strongest colour, blue its weakest, on most of it.
  int meadow = 0;
  for (int x = 0; x < k_width; ++x)
    for (int y = 0; y < k_height / 4; ++y) meadow += pixel(x, y)[2] < pixel(x, y)[0] && pixel(x, y)[2] < pixel(x, y)[1];
  EXPECT_GT(meadow, k_width * k_height / 4 * 8 / 10);
}

// Grass changes the picture near the eye: the same place with and without it.
TEST_F(OsgPlugin, GrowsPlants) {
  const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(k_scene);
  ASSERT_TRUE(node.valid());
  const osg::BoundingBox box = box_of(*node);
  // Straight down from high above, then from where plants are within the horizon.
  const auto roughness = [&](double above_top) {
    const osg::Vec3d eye(0, 0, above_top);
    viewer_.getCamera()->setViewMatrixAsLookAt(eye, eye + osg::Vec3d(0, 0.2, -1), {0, 1, 0});
    draw(node.get(), 2);
    double sum = 0;
    for (int y = 0; y < k_height; ++y)
      for (int x = 1; x < k_width; ++x) sum += std::abs(int(pixel(x, y)[1]) - int(pixel(x - 1, y)[1]));
    return sum / (k_width * k_height);
  };
  const double bare = roughness(box.zMax() + 300);
  // The box reaches below the lowest ground by what the relief may take away, so the way up begins under it.
  double grown = 0;
  for (double above = 12; above <= 60 && grown <= bare * 2; above += 8)
    grown = std::max(grown, roughness(box.zMin() + above));
  EXPECT_GT(grown, bare * 2) << "blades within the horizon must break up the smooth ground";
}

// What the viewer draws itself looks the same beside a scene as alone: no state is left behind.
TEST_F(OsgPlugin, LeavesTheViewersStateAlone) {
  const osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(k_scene);
  ASSERT_TRUE(node.valid());
  const osg::BoundingBox box = box_of(*node);
  look(box);
  // A lit sphere five metres ahead, drawn before and after the scene.
  const osg::Vec3 ahead(0, 5 * 0.93f, float(box.zMax()) + 5 - 5 * 0.37f);
  osg::ref_ptr<osg::ShapeDrawable> sphere(new osg::ShapeDrawable(new osg::Sphere(ahead, 1)));
  sphere->setColor({0.9f, 0.2f, 0.1f, 1});
  osg::ref_ptr<osg::Group> alone(new osg::Group), beside(new osg::Group);
  alone->addChild(sphere);
  beside->addChild(sphere);
  beside->addChild(node);
  osg::ref_ptr<osg::Group> again(new osg::Group);
  again->addChild(sphere);
  beside->addChild(again);

  draw(alone.get(), 1);
  const unsigned char expected[3] = {pixel(160, 120)[0], pixel(160, 120)[1], pixel(160, 120)[2]};
  ASSERT_GT(expected[0], expected[1] + 50) << "the sphere is red and in the middle";
  for (int frame = 0; frame < 3; ++frame) {
    draw(beside.get(), 1);
    for (int channel = 0; channel < 3; ++channel)
      EXPECT_NEAR(pixel(160, 120)[channel], expected[channel], 1) << "frame " << frame;
  }
  EXPECT_TRUE(capture_->errors.empty());
}

TEST(OsgPluginReader, RefusesABrokenSceneWithoutCrashing) {
  const std::string path = testing::TempDir() + "sward_osg_broken.toml";
  std::ofstream(path) << "[terrain]\ngenerator = 7\n";
  EXPECT_FALSE(osgDB::readRefNodeFile(path + ".sward").valid());
}

}  // namespace
