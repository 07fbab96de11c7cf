// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "scene_home.h"

#include <osg/Transform>
#include <osgGA/EventVisitor>
#include <osgGA/KeySwitchMatrixManipulator>
#include <osgViewer/View>

#include "ground_ray.h"

namespace sward::osg_host {

namespace {

constexpr double k_sight_m = 1000;  // How far ahead ground is looked for.
constexpr double k_open_m = 30;     // What turns the view turns about, where there is none.

struct Home {
  osg::Vec3d eye, center, up;
};

osg::Vec3d point(const glm::dvec3& p, const osg::Matrixd& matrix) {
  return osg::Vec3d(p.x, p.y, p.z) * matrix;
}

// The scene's camera; manipulators that turn about a centre turn about what it looks at.
Home home_of(const SwardDrawable& drawable, const osg::Matrixd& world_from_local) {
  const View view = host::scene_view(drawable.scene(), drawable.terrain(), {1, 1});
  const glm::dvec3 ahead = glm::transpose(view.eye_from_world) * glm::dvec3(0, 0, -1);
  const auto hits = meet_ground(drawable.terrain(), view.eye, view.eye + k_sight_m * ahead, true);
  const glm::dvec3 center = hits.empty() ? view.eye + k_open_m * ahead : hits.front().point;
  return {point(view.eye, world_from_local), point(center, world_from_local),
          osg::Matrixd::transform3x3(osg::Vec3d(0, 0, 1), world_from_local)};
}

bool stands_at_home(const osgGA::CameraManipulator& manipulator) {
  osg::Vec3d eye, center, up;
  manipulator.getHomePosition(eye, center, up);
  const osg::Matrixd home = osg::Matrixd::inverse(osg::Matrixd::lookAt(eye, center, up));
  const osg::Matrixd now = manipulator.getMatrix();
  const double tolerance = 1e-3 * (1 + (center - eye).length());
  return (home.getTrans() - now.getTrans()).length() < tolerance;
}

osgGA::CameraManipulator& current_of(osgGA::CameraManipulator& manipulator) {
  auto* keys = dynamic_cast<osgGA::KeySwitchMatrixManipulator*>(&manipulator);
  return keys != nullptr && keys->getCurrentMatrixManipulator() != nullptr ? *keys->getCurrentMatrixManipulator()
                                                                           : manipulator;
}

}  // namespace

void SceneHome::give(osgGA::CameraManipulator& manipulator, const osg::Matrixd& world_from_local) {
  osg::ref_ptr<const SwardDrawable> drawable;
  if (!manipulator.getAutoComputeHomePosition() || !drawable_.lock(drawable)) return;
  osgGA::CameraManipulator& current = current_of(manipulator);
  const bool go_there = stands_at_home(current);
  const Home home = home_of(*drawable, world_from_local);
  manipulator.setHomePosition(home.eye, home.center, home.up, false);
  if (go_there) current.home(0.0);
}

void SceneHome::operator()(osg::Node* node, osg::NodeVisitor* visitor) {
  osgGA::EventVisitor* events = visitor->asEventVisitor();
  auto* view = events != nullptr ? dynamic_cast<osgViewer::View*>(events->getActionAdapter()) : nullptr;
  osgGA::CameraManipulator* manipulator = view != nullptr ? view->getCameraManipulator() : nullptr;
  if (manipulator != nullptr && asked_.insert(manipulator).second)
    give(*manipulator, osg::computeLocalToWorld(visitor->getNodePath()));
  traverse(node, visitor);
}

}  // namespace sward::osg_host
