// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// A program of one's own with OpenSceneGraph and the plugin: a model stands on the ground of a scene, in its plants.
//
//   OSG_LIBRARY_PATH=<folder of osgdb_sward.so> hello_osg [SCENE.sward [MODEL [X Y]]]
//
// Nothing of sward is linked: the plugin is found when the scene is read.

#include <cstdio>
#include <cstdlib>
#include <osg/MatrixTransform>
#include <osg/ShapeDrawable>
#include <osgDB/ReadFile>
#include <osgUtil/IntersectionVisitor>
#include <osgUtil/LineSegmentIntersector>
#include <osgViewer/Viewer>
#include <osgViewer/ViewerEventHandlers>

namespace {

// The ground under x, y: a vertical segment meets it where OpenSceneGraph's visitors find any other geometry.
bool ground_under(osg::Node& scene, double x, double y, osg::Vec3d& point) {
  const osg::BoundingSphere bound = scene.getBound();
  const double top = bound.center().z() + bound.radius(), bottom = bound.center().z() - bound.radius();
  osg::ref_ptr<osgUtil::LineSegmentIntersector> segment(
      new osgUtil::LineSegmentIntersector(osg::Vec3d(x, y, top), osg::Vec3d(x, y, bottom)));
  osgUtil::IntersectionVisitor visitor(segment.get());
  scene.accept(visitor);
  if (!segment->containsIntersections()) return false;
  point = segment->getFirstIntersection().getWorldIntersectPoint();
  return true;
}

osg::ref_ptr<osg::Node> read_model(const char* file) {
  if (file != nullptr) return osgDB::readRefNodeFile(file);
  osg::ref_ptr<osg::ShapeDrawable> ball(new osg::ShapeDrawable(new osg::Sphere(osg::Vec3(0, 0, 0.5f), 0.5f)));
  ball->setColor({0.8f, 0.3f, 0.1f, 1});
  return ball;
}

}  // namespace

int main(int argc, char** argv) {
  // OpenSceneGraph has said what is wrong with a file that gives no node.
  osg::ref_ptr<osg::Node> scene = osgDB::readRefNodeFile(argc > 1 ? argv[1] : "meadow.sward");
  osg::ref_ptr<osg::Node> model = read_model(argc > 2 ? argv[2] : nullptr);
  if (!scene || !model) return 1;

  osg::Vec3d foot;
  if (!ground_under(*scene, argc > 4 ? std::atof(argv[3]) : 0, argc > 4 ? std::atof(argv[4]) : 0, foot)) {
    std::fprintf(stderr, "hello_osg: no ground there; give X and Y on the scene's terrain\n");
    return 1;
  }
  osg::ref_ptr<osg::MatrixTransform> place(new osg::MatrixTransform(osg::Matrix::translate(foot)));
  place->addChild(model);
  osg::ref_ptr<osg::Group> root(new osg::Group);
  root->addChild(scene);
  root->addChild(place);

  osgViewer::Viewer viewer;
  viewer.addEventHandler(new osgViewer::StatsHandler);
  viewer.addEventHandler(new osgViewer::ScreenCaptureHandler);
  viewer.setSceneData(root);
  return viewer.run();  // A trackball, whose home is the scene's camera; wind follows the viewer's time.
}
