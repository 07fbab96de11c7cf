// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include "sward_drawable.h"

#include <osg/Callback>
#include <osg/observer_ptr>
#include <osgGA/CameraManipulator>
#include <set>

namespace sward::osg_host {

/// Makes the scene's camera the home of the viewer's manipulators. OpenSceneGraph's own home is three radii of the
/// scene away: outside of the ground, too far for plants. Set as an event callback of a node above the drawable.
///
/// A manipulator is asked once, and only when it computes its home itself (osgGA's default; after
/// setHomePosition(eye, center, up) it does not). Where the view stands at the old home, it goes to the new one.
/// Event thread.
class SceneHome : public osg::NodeCallback {
 public:
  explicit SceneHome(const SwardDrawable& drawable) : drawable_(&drawable) {}
  void operator()(osg::Node* node, osg::NodeVisitor* visitor) override;

 private:
  void give(osgGA::CameraManipulator& manipulator, const osg::Matrixd& world_from_local);

  osg::observer_ptr<const SwardDrawable> drawable_;
  std::set<osg::observer_ptr<osgGA::CameraManipulator>> asked_;
};

}  // namespace sward::osg_host
