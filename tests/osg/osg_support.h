// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// epoxy's GL header, which this brings in, must come before OpenSceneGraph's.
#include "sward_drawable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <osg/Group>
#include <osg/Image>
#include <osgDB/ReadFile>
#include <osgViewer/CompositeViewer>
#include <osgViewer/Viewer>
#include <string>
#include <vector>

namespace osg_test {

constexpr int k_width = 160, k_height = 120;
constexpr unsigned char k_background[3] = {255, 0, 255};

/// A scene of this folder, for osgDB.
inline std::string scene_file(const std::string& name) {
  return std::string(SWARD_OSG_TESTS "/") + name + ".toml.sward";
}

inline osg::ref_ptr<osg::Node> read_scene(const std::string& name, const std::string& options = "") {
  const osg::ref_ptr<osgDB::Options> reading(new osgDB::Options(options));
  return osgDB::readRefNodeFile(scene_file(name), reading.get());
}

/// What the reader has put into the group that it returns. It is of the plugin's code, which this program has, too.
inline osg::Drawable& drawable_of(osg::Node& node) {
  return *node.asGroup()->getChild(0)->asDrawable();
}

/// Copies the picture when the camera has drawn, and collects GL errors.
struct Capture : osg::Camera::DrawCallback {
  void operator()(osg::RenderInfo&) const override {
    for (GLenum error = glGetError(); error != GL_NO_ERROR; error = glGetError()) errors.push_back(error);
    image->readPixels(0, 0, k_width, k_height, GL_RGB, GL_UNSIGNED_BYTE);
  }
  const unsigned char* pixel(int x, int y) const { return image->data(unsigned(x), unsigned(y)); }
  std::vector<unsigned char> bytes() const { return {image->data(), image->data() + image->getTotalSizeInBytes()}; }

  osg::ref_ptr<osg::Image> image{new osg::Image};
  mutable std::vector<GLenum> errors;
};

/// Empty where two pictures are the same, byte for byte.
inline std::string difference(const std::vector<unsigned char>& a, const std::vector<unsigned char>& b) {
  if (a.size() != b.size()) return "sizes differ";
  size_t count = 0, first = 0;
  int most = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    if (a[i] == b[i]) continue;
    if (count++ == 0) first = i / 3;
    most = std::max(most, std::abs(int(a[i]) - int(b[i])));
  }
  if (count == 0) return {};
  return std::to_string(count) + " bytes differ, by " + std::to_string(most) + " at most, the first at x " +
         std::to_string(first % k_width) + ", y " + std::to_string(first / k_width);
}

/// How much neighbours on a row differ, on average: plants are rough, bare ground from above is not.
inline double roughness(const Capture& capture, int rows = k_height) {
  double sum = 0;
  for (int y = 0; y < rows; ++y)
    for (int x = 1; x < k_width; ++x) sum += std::abs(int(capture.pixel(x, y)[1]) - int(capture.pixel(x - 1, y)[1]));
  return sum / (rows * k_width);
}

inline int background_pixels(const Capture& capture) {
  int count = 0;
  for (int y = 0; y < k_height; ++y)
    for (int x = 0; x < k_width; ++x) count += std::equal(k_background, k_background + 3, capture.pixel(x, y)) ? 1 : 0;
  return count;
}

inline osg::ref_ptr<osg::GraphicsContext> make_context(osg::GraphicsContext* shared = nullptr, unsigned samples = 0) {
  osg::ref_ptr<osg::GraphicsContext::Traits> traits(new osg::GraphicsContext::Traits);
  traits->readDISPLAY();
  traits->width = k_width;
  traits->height = k_height;
  traits->pbuffer = true;
  traits->depth = 24;
  traits->sampleBuffers = samples > 0 ? 1 : 0;
  traits->samples = samples;
  traits->sharedContext = shared;
  return osg::GraphicsContext::createGraphicsContext(traits.get());
}

/// A camera that draws into a pbuffer of its own and hands each picture over.
inline void set_up(osg::Camera& camera, osg::GraphicsContext* context, Capture* capture) {
  camera.setGraphicsContext(context);
  camera.setViewport(0, 0, k_width, k_height);
  camera.setProjectionMatrixAsPerspective(50, double(k_width) / k_height, 0.1, 2000);
  camera.setClearColor({1, 0, 1, 1});
  camera.setFinalDrawCallback(capture);
  camera.setDrawBuffer(GL_FRONT);
  camera.setReadBuffer(GL_FRONT);
}

/// A viewer of one view without a manipulator, off screen.
class Offscreen : public testing::Test {
 protected:
  void SetUp() override {
    context_ = make_context();
    ASSERT_TRUE(context_.valid()) << "no GL context on this display";
    viewer_.setThreadingModel(osgViewer::Viewer::SingleThreaded);
    set_up(*viewer_.getCamera(), context_.get(), capture_.get());
  }

  void draw(osg::Node* scene, int frames, double time_s = 0) {
    if (viewer_.getSceneData() != scene) viewer_.setSceneData(scene);
    if (!viewer_.isRealized()) viewer_.realize();
    for (int i = 0; i < frames; ++i) {
      // The manipulator is not used: the matrix set by the test is the view.
      viewer_.advance(time_s);
      viewer_.updateTraversal();
      viewer_.renderingTraversals();
    }
  }

  /// From 1.6 m above the ground of `scene` at x, y, towards the north and down.
  void stand(osg::Node& scene, double x, double y, double down = 0.25);

  osg::ref_ptr<osg::GraphicsContext> context_;
  osg::ref_ptr<Capture> capture_{new Capture};
  osgViewer::Viewer viewer_;
};

/// Height of the ground under x, y, as any host would ask: by a vertical segment.
double ground_height(osg::Node& scene, double x, double y);

inline void Offscreen::stand(osg::Node& scene, double x, double y, double down) {
  const osg::Vec3d eye(x, y, ground_height(scene, x, y) + 1.6);
  viewer_.getCamera()->setViewMatrixAsLookAt(eye, eye + osg::Vec3d(0, 1, -down), {0, 0, 1});
}

}  // namespace osg_test
