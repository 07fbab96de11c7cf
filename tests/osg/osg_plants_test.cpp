// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// Plants on ground that OpenSceneGraph draws: the ground's heights, its colours, the drawable.

#include "plants_drawable.h"

#include <cmath>
#include <functional>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/Notify>
#include <osgTerrain/Terrain>
#include <osgUtil/LineSegmentIntersector>
#include <random>

#include "drawn_ground.h"
#include "osg_support.h"

namespace osg_test {
namespace {

using sward::osg_host::color_map_of;
using sward::osg_host::DrawnGround;
using sward::osg_host::PlantsDrawable;

constexpr unsigned k_samples = 33;  // of the height field, along a side
constexpr double k_side_m = 64;

osg::ref_ptr<osg::Geometry> triangles(std::vector<osg::Vec3> corners) {
  osg::ref_ptr<osg::Geometry> geometry(new osg::Geometry);
  geometry->setVertexArray(new osg::Vec3Array(unsigned(corners.size()), corners.data()));
  geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, int(corners.size())));
  return geometry;
}

/// A square of 2 x 2 m, split from its south-west to its north-east corner, which alone is high.
osg::ref_ptr<osg::Geometry> folded_square() {
  return triangles({{0, 0, 0}, {2, 0, 0}, {2, 2, 2}, {0, 0, 0}, {2, 2, 2}, {0, 2, 0}});
}

osg::ref_ptr<osgTerrain::Terrain> terrain(const std::function<double(double, double)>& height) {
  osg::ref_ptr<osgTerrain::Locator> locator(new osgTerrain::Locator);
  locator->setCoordinateSystemType(osgTerrain::Locator::PROJECTED);
  locator->setTransformAsExtents(-k_side_m / 2, -k_side_m / 2, k_side_m / 2, k_side_m / 2);
  osg::ref_ptr<osg::HeightField> field(new osg::HeightField);
  field->allocate(k_samples, k_samples);
  const double spacing = k_side_m / (k_samples - 1);
  for (unsigned row = 0; row < k_samples; ++row)
    for (unsigned column = 0; column < k_samples; ++column)
      field->setHeight(column, row, float(height(column * spacing - k_side_m / 2, row * spacing - k_side_m / 2)));
  osg::ref_ptr<osgTerrain::TerrainTile> tile(new osgTerrain::TerrainTile);
  tile->setLocator(locator);
  tile->setElevationLayer(new osgTerrain::HeightFieldLayer(field));
  tile->getElevationLayer()->setLocator(locator);
  osg::ref_ptr<osgTerrain::Terrain> made(new osgTerrain::Terrain);
  made->setSampleRatio(1);
  made->addChild(tile);
  tile->init(tile->getDirtyMask(), true);
  return made;
}

double hills(double x, double y) {
  return 3 * std::sin(0.17 * x) * std::cos(0.13 * y) + 0.4 * std::sin(0.9 * x + y);
}

osg::ref_ptr<osg::Image> green() {
  osg::ref_ptr<osg::Image> image(new osg::Image);
  image->allocateImage(8, 8, 1, GL_RGB, GL_UNSIGNED_BYTE);
  for (unsigned row = 0; row < 8; ++row)
    for (unsigned column = 0; column < 8; ++column) image->setColor({0.30f, 0.42f, 0.20f, 1}, column, row);
  return image;
}

sward::Layer meadow() {
  sward::Layer layer;
  layer.horizon_m = 9;
  layer.density = 60;
  sward::Species grass;
  grass.reference_hsv = {92.0f / 360, 0.52f, 0.42f};
  grass.height_m = {0.4f, 0.6f};
  grass.width_m = {0.02f, 0.03f};
  layer.species = {grass};
  return layer;
}

osg::ref_ptr<PlantsDrawable> plants_on(osg::Node& node) {
  auto drawn = DrawnGround::create(node);
  EXPECT_TRUE(drawn);
  const auto ground = std::make_shared<const DrawnGround>(std::move(*drawn));
  auto host = sward::HostTerrain::create([ground](glm::dvec2 xy) { return ground->height(xy); },
                                         {ground->low(), ground->high()});
  EXPECT_TRUE(host);
  PlantsDrawable::Content content;
  content.terrain = std::make_shared<const sward::HostTerrain>(std::move(*host));
  const glm::dvec3 low = ground->low(), high = ground->high();
  content.box = {osg::Vec3d(low.x, low.y, low.z), osg::Vec3d(high.x, high.y, high.z)};
  content.colors = *color_map_of(*green(), glm::dvec2(low), glm::dvec2(high));
  content.layers = {meadow()};
  content.lighting = sward::gl::Lighting::clear_day(3.6f, 0.6f);
  return new PlantsDrawable(std::move(content));
}

/// What sward says through OpenSceneGraph.
struct Messages : osg::NotifyHandler {
  void notify(osg::NotifySeverity, const char* message) override { said += message; }
  std::string said;
};

// ---- Heights.

TEST(DrawnGround, IsTheTrianglesAsTheyAreSplit) {
  const auto ground = DrawnGround::create(*folded_square());
  ASSERT_TRUE(ground);
  EXPECT_NEAR(ground->height({1.5, 0.5}), 0.5, 1e-9);  // interpolation of the four corners would give 0.375
  EXPECT_NEAR(ground->height({0.5, 1.5}), 0.5, 1e-9);
  EXPECT_NEAR(ground->height({1, 1}), 1, 1e-6);
  EXPECT_EQ(ground->low(), glm::dvec3(0));
  EXPECT_EQ(ground->high(), glm::dvec3(2));
  for (const glm::dvec2 beside : {glm::dvec2(-0.1, 1), glm::dvec2(1, 2.1), glm::dvec2(1e9, -1e9)})
    EXPECT_TRUE(std::isnan(ground->height(beside)));
}

TEST(DrawnGround, TakesTheHighestOfSeveralAndNoWalls) {
  const osg::ref_ptr<osg::Group> group(new osg::Group);
  group->addChild(folded_square());
  group->addChild(triangles({{0, 0, 5}, {1, 0, 5}, {0, 1, 5}}));
  group->addChild(triangles({{0, 0, -9}, {2, 2, -9}, {2, 2, 90}}));  // upright
  const auto ground = DrawnGround::create(*group);
  ASSERT_TRUE(ground);
  EXPECT_NEAR(ground->height({0.2, 0.2}), 5, 1e-9);
  EXPECT_NEAR(ground->height({1.5, 0.5}), 0.5, 1e-9);
  EXPECT_EQ(ground->low().z, 0);
  EXPECT_EQ(ground->high().z, 5);
}

TEST(DrawnGround, FollowsTransforms) {
  const osg::ref_ptr<osg::MatrixTransform> moved(new osg::MatrixTransform(
      osg::Matrixd::rotate(osg::PI_2, osg::Vec3d(0, 0, 1)) * osg::Matrixd::translate(100, 200, 30)));
  moved->addChild(folded_square());
  const auto ground = DrawnGround::create(*moved);
  ASSERT_TRUE(ground);
  EXPECT_NEAR(ground->height({100 - 0.5, 200 + 1.5}), 30.5, 1e-5);  // what lay at 1.5, 0.5
}

TEST(DrawnGround, NeedsTriangles) {
  const auto ground = DrawnGround::create(*osg::ref_ptr<osg::Group>(new osg::Group));
  ASSERT_FALSE(ground);
  EXPECT_NE(ground.error().message.find("no triangles"), std::string::npos);
}

// OpenSceneGraph's own intersections are the reference.
TEST(DrawnGround, IsWhatOsgTerrainDraws) {
  const osg::ref_ptr<osgTerrain::Terrain> node = terrain(hills);
  const auto ground = DrawnGround::create(*node);
  ASSERT_TRUE(ground);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-k_side_m / 2, k_side_m / 2);
  for (int i = 0; i < 2000; ++i) {
    const double x = place(random), y = place(random);
    const osg::ref_ptr<osgUtil::LineSegmentIntersector> ray(
        new osgUtil::LineSegmentIntersector(osg::Vec3d(x, y, 1000), osg::Vec3d(x, y, -1000)));
    osgUtil::IntersectionVisitor visitor(ray.get());
    node->accept(visitor);
    ASSERT_TRUE(ray->containsIntersections()) << x << " " << y;
    EXPECT_NEAR(ground->height({x, y}), ray->getFirstIntersection().getWorldIntersectPoint().z(), 1e-3);
  }
}

// ---- Colours.

TEST(ColorMapOfImage, HasItsFirstRowInTheSouth) {
  const osg::ref_ptr<osg::Image> image(new osg::Image);
  image->allocateImage(2, 2, 1, GL_RGB, GL_UNSIGNED_BYTE);
  image->setColor({1, 0, 0, 1}, 0u, 0u);
  image->setColor({0, 1, 0, 1}, 1u, 0u);
  image->setColor({0, 0, 1, 1}, 0u, 1u);
  image->setColor({1, 1, 1, 1}, 1u, 1u);
  const auto map = color_map_of(*image, {10, 20}, {14, 26});
  ASSERT_TRUE(map);
  EXPECT_EQ(map->min_corner, glm::dvec2(10, 20));
  EXPECT_EQ(map->size, glm::dvec2(4, 6));
  ASSERT_EQ(map->texels.size(), 4u);
  EXPECT_EQ(glm::ivec3(map->texels[0]), glm::ivec3(0, 0, 255));  // north-west
  EXPECT_EQ(glm::ivec3(map->texels[2]), glm::ivec3(255, 0, 0));  // south-west
  EXPECT_EQ(glm::ivec3(map->texels[3]), glm::ivec3(0, 255, 0));
}

TEST(ColorMapOfImage, NeedsPixels) {
  EXPECT_FALSE(color_map_of(*osg::ref_ptr<osg::Image>(new osg::Image), {0, 0}, {1, 1}));
}

// ---- The drawable.

class Plants : public Offscreen {
 protected:
  void SetUp() override {
    Offscreen::SetUp();
    osg::setNotifyHandler(messages_);
    ground_ = terrain(hills);
    plants_ = plants_on(*ground_);
    scene_->addChild(ground_);
    scene_->addChild(plants_);
    look();
  }
  void TearDown() override {
    osg::setNotifyHandler(new osg::StandardNotifyHandler);
    EXPECT_EQ(capture_->errors, std::vector<GLenum>());
  }

  void look(const osg::Matrixd& way = osg::Matrixd::identity()) {
    const osg::Vec3d eye(3, -10, hills(3, -10) + 1.6);
    viewer_.getCamera()->setComputeNearFarMode(osg::Camera::DO_NOT_COMPUTE_NEAR_FAR);
    viewer_.getCamera()->setViewMatrix(osg::Matrixd::inverse(way) *
                                       osg::Matrixd::lookAt(eye, eye + osg::Vec3d(0, 1, -0.25), {0, 0, 1}));
  }

  osg::ref_ptr<Messages> messages_{new Messages};
  osg::ref_ptr<osg::Group> scene_{new osg::Group};
  osg::ref_ptr<osgTerrain::Terrain> ground_;
  osg::ref_ptr<PlantsDrawable> plants_;
};

TEST_F(Plants, StandBeforeTheGroundAndLeaveItAlone) {
  draw(ground_, 1);
  const std::vector<unsigned char> bare = capture_->bytes();
  const double smooth = roughness(*capture_, k_height / 2);
  draw(scene_, 1);
  EXPECT_GT(plants_->seeded(), 20u);
  EXPECT_GT(roughness(*capture_, k_height / 2), 4 + smooth);
  const std::vector<unsigned char> covered = capture_->bytes();
  draw(scene_, 1);
  EXPECT_EQ(difference(capture_->bytes(), covered), "");
  // What OpenSceneGraph draws after them is as it was.
  draw(ground_, 1);
  EXPECT_EQ(difference(capture_->bytes(), bare), "");
  EXPECT_EQ(messages_->said, "");
}

// Plants alone, on ground that is not drawn: roots and shadows lie on the surface, so the ground hides what is behind
// its hills and little else.
TEST_F(Plants, AreHiddenByTheGroundInFrontOfThem) {
  draw(plants_, 1);
  const int alone = k_width * k_height - background_pixels(*capture_);
  const std::vector<unsigned char> all = capture_->bytes();
  draw(ground_, 1);
  const std::vector<unsigned char> bare = capture_->bytes();
  draw(scene_, 1);
  const std::vector<unsigned char> both = capture_->bytes();
  int seen = 0;
  for (size_t i = 0; i < both.size(); i += 3)
    seen += !std::equal(&both[i], &both[i] + 3, &bare[i]) && std::equal(&both[i], &both[i] + 3, &all[i]) ? 1 : 0;
  ASSERT_GT(alone, k_width * k_height / 10);
  EXPECT_GT(seen, 0.85 * alone) << "of " << alone;
}

TEST_F(Plants, MoveAndTurnWithTheNodesAboveThem) {
  draw(scene_, 1);
  const std::vector<unsigned char> here = capture_->bytes();
  const osg::Matrixd way =
      osg::Matrixd::rotate(0.6, osg::Vec3d(0, 0, 1)) * osg::Matrixd::translate(4096, -1024, 128);
  const osg::ref_ptr<osg::MatrixTransform> moved(new osg::MatrixTransform(way));
  moved->addChild(scene_);
  look(way);
  draw(moved, 1);
  const std::vector<unsigned char> there = capture_->bytes();
  // Edges fall between other pixels' middles now and then, by the floats of OpenSceneGraph's matrices.
  size_t far = 0;
  for (size_t i = 0; i < here.size(); ++i) far += std::abs(int(here[i]) - int(there[i])) > 8 ? 1 : 0;
  EXPECT_LT(far, here.size() / 50);
  EXPECT_GT(roughness(*capture_, k_height / 2), 4);
}

TEST_F(Plants, ComeBackAfterTheirObjectsWereReleased) {
  draw(scene_, 1);
  const std::vector<unsigned char> before = capture_->bytes();
  ASSERT_TRUE(context_->makeCurrent());
  plants_->releaseGLObjects(context_->getState());
  context_->releaseContext();
  draw(scene_, 1);
  EXPECT_EQ(difference(capture_->bytes(), before), "");
}

TEST_F(Plants, AreForOneContext) {
  draw(scene_, 1);
  const std::vector<unsigned char> first = capture_->bytes();
  osgViewer::Viewer other;
  const osg::ref_ptr<osg::GraphicsContext> context = make_context();
  const osg::ref_ptr<Capture> capture(new Capture);
  other.setThreadingModel(osgViewer::Viewer::SingleThreaded);
  set_up(*other.getCamera(), context, capture);
  other.getCamera()->setViewMatrix(viewer_.getCamera()->getViewMatrix());
  other.setSceneData(scene_);
  other.realize();
  other.renderingTraversals();
  EXPECT_NE(messages_->said.find("another context"), std::string::npos) << messages_->said;
  EXPECT_EQ(capture->errors, std::vector<GLenum>());
  draw(scene_, 1);
  EXPECT_EQ(difference(capture_->bytes(), first), "");
}

}  // namespace
}  // namespace osg_test
