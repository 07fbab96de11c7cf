// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// What OpenSceneGraph finds of the ground: intersections, homes of manipulators, near planes.

#include "osg_support.h"

#include <sward/terrain/queries.h>
#include <cmath>
#include <osg/MatrixTransform>
#include <osgGA/KeySwitchMatrixManipulator>
#include <osgGA/TerrainManipulator>
#include <osgGA/TrackballManipulator>
#include <osgUtil/LineSegmentIntersector>
#include <osgUtil/PolytopeIntersector>
#include <random>

#include "ground_ray.h"
#include "host/scene_maps.h"
#include "near_plane.h"

namespace osg_test {

using Segment = osgUtil::LineSegmentIntersector;

double ground_height(osg::Node& scene, double x, double y) {
  osg::ref_ptr<Segment> segment(new Segment(osg::Vec3d(x, y, 1e4), osg::Vec3d(x, y, -1e4)));
  osgUtil::IntersectionVisitor visitor(segment.get());
  scene.accept(visitor);
  return segment->containsIntersections() ? segment->getFirstIntersection().getWorldIntersectPoint().z() : NAN;
}

namespace {

std::unique_ptr<sward::host::SceneTerrain> load(const std::string& name) {
  auto scene = sward::load_scene(SWARD_OSG_TESTS "/" + name + ".toml");
  auto terrain = sward::host::load_terrain(scene.value(), true);
  return std::move(terrain.value());
}

class Ground : public testing::Test {
 protected:
  void SetUp() override {
    terrain_ = load("small");
    node_ = read_scene("small");
    ASSERT_TRUE(node_.valid());
  }
  double height(double x, double y) const { return terrain_->surface().height(glm::dvec2(x, y)); }

  std::unique_ptr<sward::host::SceneTerrain> terrain_;
  osg::ref_ptr<osg::Node> node_;
};

TEST_F(Ground, SegmentsMeetTheGroundItselfUnderTransforms) {
  for (const glm::dvec2 at : {glm::dvec2(0, 0), glm::dvec2(100.3, -77.7), glm::dvec2(-200, 250)})
    EXPECT_NEAR(ground_height(*node_, at.x, at.y), height(at.x, at.y), 1e-5);
  EXPECT_TRUE(std::isnan(ground_height(*node_, 300, 0))) << "no ground there";

  const osg::Matrixd moved = osg::Matrixd::rotate(0.7, 0, 0, 1) * osg::Matrixd::translate(3000, -500, 70);
  const osg::ref_ptr<osg::MatrixTransform> transform(new osg::MatrixTransform(moved));
  transform->addChild(node_);
  const osg::Vec3d there = osg::Vec3d(50, 60, 0) * moved;
  EXPECT_NEAR(ground_height(*transform, there.x(), there.y()), height(50, 60) + 70, 1e-5);
}

TEST_F(Ground, IntersectionsHaveNormalPathAndLimit) {
  // Nearly level, through hills: in and out several times.
  const osg::Vec3d from(-250, 40, 10), to(250, 40, 10.5);
  osg::ref_ptr<Segment> all(new Segment(from, to));
  osg::ref_ptr<Segment> nearest(new Segment(from, to));
  nearest->setIntersectionLimit(osgUtil::Intersector::LIMIT_NEAREST);
  // As osgSim's lines of sight do.
  const osg::ref_ptr<osgUtil::IntersectorGroup> group(new osgUtil::IntersectorGroup);
  group->addIntersector(all.get());
  group->addIntersector(nearest.get());
  osgUtil::IntersectionVisitor visitor(group.get());
  node_->accept(visitor);
  ASSERT_GE(all->getIntersections().size(), 2u);
  ASSERT_EQ(nearest->getIntersections().size(), 1u);
  EXPECT_EQ(nearest->getFirstIntersection().ratio, all->getFirstIntersection().ratio);
  for (const Segment::Intersection& hit : all->getIntersections()) {
    const osg::Vec3d point = hit.getWorldIntersectPoint();
    EXPECT_NEAR(point.z(), height(point.x(), point.y()), 1e-4);
    EXPECT_NEAR((point - (from + (to - from) * hit.ratio)).length(), 0, 1e-4);
    EXPECT_NEAR(hit.localIntersectionNormal.length(), 1, 1e-5);
    EXPECT_GT(hit.localIntersectionNormal.z(), 0.5);
    EXPECT_EQ(hit.drawable.get(), &drawable_of(*node_));
    EXPECT_EQ(hit.nodePath.back(), &drawable_of(*node_));
  }
}

TEST_F(Ground, OtherIntersectorsMeetItsGrid) {
  osg::Polytope column;
  column.add(osg::Plane(1, 0, 0, -9));
  column.add(osg::Plane(-1, 0, 0, 11));
  column.add(osg::Plane(0, 1, 0, -9));
  column.add(osg::Plane(0, -1, 0, 11));
  osg::ref_ptr<osgUtil::PolytopeIntersector> polytope(new osgUtil::PolytopeIntersector(column));
  osgUtil::IntersectionVisitor visitor(polytope.get());
  node_->accept(visitor);
  ASSERT_TRUE(polytope->containsIntersections());
  EXPECT_NEAR(polytope->getFirstIntersection().localIntersectionPoint.z(), height(10, 10), 0.5);
}

// Worlds are marched over; over a field both ways can be compared.
TEST_F(Ground, MarchingFindsWhatExactRaysFind) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> across(-300, 300), up(30, 60), down(-60, -30);
  int met = 0;
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 from(across(random), across(random), up(random)), to(across(random), across(random), down(random));
    const auto exact = sward::osg_host::meet_ground(*terrain_, from, to, true);
    const auto marched = sward::osg_host::march_over(terrain_->surface(), from, to, true);
    ASSERT_EQ(exact.size(), marched.size()) << i;
    if (exact.empty()) continue;
    ++met;
    EXPECT_NEAR(glm::distance(exact[0].point, marched[0].point), 0, 1e-3) << i;
    EXPECT_GT(glm::dot(exact[0].normal, marched[0].normal), 0.9) << i;
  }
  EXPECT_GT(met, 100);
}

// The viewer's event traversal tells manipulators; they see only what a stock viewer gives them.
osg::Vec3d eye_of(const osgViewer::Viewer& viewer) {
  return osg::Matrixd::inverse(viewer.getCamera()->getViewMatrix()).getTrans();
}

class Homes : public Offscreen {
 protected:
  void first_frame(osgGA::CameraManipulator* manipulator, osg::Node* scene) {
    viewer_.setSceneData(scene);
    viewer_.setCameraManipulator(manipulator);
    if (!viewer_.isRealized()) viewer_.realize();
    viewer_.advance();
    viewer_.eventTraversal();
    viewer_.updateTraversal();
  }
};

TEST_F(Homes, TheScenesCameraIsHome) {
  const osg::ref_ptr<osg::Node> node = read_scene("small");
  const osg::ref_ptr<osgGA::KeySwitchMatrixManipulator> keys(new osgGA::KeySwitchMatrixManipulator);
  keys->addMatrixManipulator('1', "Trackball", new osgGA::TrackballManipulator);
  keys->addMatrixManipulator('4', "Terrain", new osgGA::TerrainManipulator);
  first_frame(keys.get(), node.get());
  const osg::Vec3d eye = eye_of(viewer_);
  EXPECT_NEAR(eye.z(), ground_height(*node, eye.x(), eye.y()) + 1.7, 1e-3) << "scenes' default camera";
  // A terrain manipulator that takes over turns about the ground ahead.
  keys->selectMatrixManipulator(1);
  auto* terrain = dynamic_cast<osgGA::TerrainManipulator*>(keys->getCurrentMatrixManipulator());
  ASSERT_NE(terrain, nullptr);
  const osg::Vec3d center = terrain->getCenter();
  EXPECT_NEAR(center.z(), ground_height(*node, center.x(), center.y()), 1e-2);
  // Where the user has flown to stays, and home is there again at the key.
  keys->getCurrentMatrixManipulator()->setByMatrix(osg::Matrixd::translate(5, 6, 100));
  viewer_.advance();
  viewer_.eventTraversal();
  viewer_.updateTraversal();
  EXPECT_NEAR((eye_of(viewer_) - osg::Vec3d(5, 6, 100)).length(), 0, 1e-3);
  keys->getCurrentMatrixManipulator()->home(0.0);
  viewer_.updateTraversal();
  EXPECT_NEAR((eye_of(viewer_) - eye).length(), 0, 1e-2);
}

TEST_F(Homes, AHostsOwnHomeStays) {
  const osg::Vec3d eye(10, 20, 300);
  const osg::ref_ptr<osgGA::TrackballManipulator> own(new osgGA::TrackballManipulator);
  own->setHomePosition(eye, {10, 100, 0}, {0, 0, 1}, false);
  first_frame(own.get(), read_scene("small").get());
  EXPECT_NEAR((eye_of(viewer_) - eye).length(), 0, 1e-3);
  const osg::ref_ptr<osgGA::TrackballManipulator> plain(new osgGA::TrackballManipulator);
  first_frame(plain.get(), read_scene("small", "noHome").get());
  EXPECT_GT(eye_of(viewer_).length(), 500) << "OpenSceneGraph's own home is outside of the scene";
}

TEST(NearPlane, IsCloseAmongPlantsAndFarAbove) {
  const auto terrain = load("large");
  const sward::Surface& surface = terrain->surface();
  const double ground = surface.height(glm::dvec2(0, 0));
  const auto at = [&](double above) { return sward::osg_host::near_plane_m(surface, {0, 0, ground + above}, 0.6); };
  EXPECT_EQ(at(-1), 0.1);
  EXPECT_EQ(at(1.7), 0.1);
  EXPECT_NEAR(at(1000.6), 10, 1e-9);
  const double top = surface.height_range().y;
  EXPECT_NEAR(sward::osg_host::near_plane_m(surface, {1e6, 0, top + 100.6}, 0.6), 1, 1e-9) << "beyond the ground";
}

// Reads the projection that is drawn with, after OpenSceneGraph has clamped it.
struct Probe : osg::Drawable {
  Probe() {
    setUseDisplayList(false);
    setCullingActive(false);
  }
  void drawImplementation(osg::RenderInfo& info) const override {
    double left, right, bottom, top;
    info.getState()->getProjectionMatrix().getFrustum(left, right, bottom, top, near_m, far_m);
  }
  mutable double near_m = 0, far_m = 0;
};

TEST_F(Offscreen, NearPlaneIsSmallAtEyeLevelAndGrowsWithHeight) {
  const osg::ref_ptr<osg::Node> node = read_scene("large");
  ASSERT_TRUE(node.valid());
  const osg::ref_ptr<Probe> probe(new Probe);
  const osg::ref_ptr<osg::Group> root(new osg::Group);
  root->addChild(node);
  root->addChild(probe);
  using Settings = osg::CullSettings;
  for (const auto mode :
       {Settings::COMPUTE_NEAR_FAR_USING_PRIMITIVES, Settings::COMPUTE_NEAR_FAR_USING_BOUNDING_VOLUMES}) {
    viewer_.getCamera()->setComputeNearFarMode(mode);
    stand(*node, 0, -9000);
    draw(root.get(), 2);
    EXPECT_GT(probe->far_m, 18000);
    EXPECT_GT(probe->near_m, 0.09);
    EXPECT_LT(probe->near_m, 0.11);
  }
  // The picture's lowest row shows what is 2 m away.
  EXPECT_EQ(background_pixels(*capture_), 0);

  const osg::Vec3d high(0, 0, drawable_of(*node).getBoundingBox().zMin() + 1000);
  viewer_.getCamera()->setViewMatrixAsLookAt(high, high + osg::Vec3d(0, 1, -0.2), {0, 0, 1});
  draw(root.get(), 2);
  EXPECT_GT(probe->near_m, 5) << "high up depth has its precision back";
}

}  // namespace
}  // namespace osg_test
