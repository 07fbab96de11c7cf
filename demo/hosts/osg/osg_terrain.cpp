// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// sward's plants on a terrain that is not sward's: OpenSceneGraph's osgTerrain draws hills with their colours, sward
// draws plants on them, standing on the triangles that osgTerrain draws.
//
//   osg_terrain [-o PICTURE] [--camera X,Y,Z,YAW,PITCH] [--size WIDTHxHEIGHT] [--bare]
//
// Z is metres above the ground, angles are degrees, yaw 0 looks east and turns counter-clockwise. Without -o a window
// opens. --bare leaves the plants out. A display is needed (or xvfb-run).

#include "plants_drawable.h"

#include <sward/scene/scene.h>
#include <cmath>
#include <cstdio>
#include <osg/ArgumentParser>
#include <osg/LightSource>
#include <osgDB/WriteFile>
#include <osgGA/TerrainManipulator>
#include <osgTerrain/Terrain>
#include <osgViewer/Viewer>
#include <string>

#include "drawn_ground.h"

namespace {

using sward::osg_host::DrawnGround;
using sward::osg_host::PlantsDrawable;

constexpr unsigned k_samples = 129;  // of the height field, along a side
constexpr double k_spacing_m = 5;
constexpr int k_texels = 1024;  // of the colour layer
constexpr double k_side_m = (k_samples - 1) * k_spacing_m;
constexpr float k_sun_azimuth = 3.6f, k_sun_elevation = 0.6f;  // radians

double hill_height(double x, double y) {
  return 16 * std::sin(x * 0.013) * std::cos(y * 0.011) + 5 * std::sin(x * 0.031 + y * 0.023) +
         0.8 * std::sin(x * 0.13) * std::sin(y * 0.11);
}

// Meadow with dry places, and a path of bare soil.
osg::Vec4 ground_color(double x, double y) {
  const double path = std::abs(y - 14 * std::sin(x * 0.03) - 10);
  if (path < 1.6) return {0.41f, 0.33f, 0.24f, 1};
  const double dry = 0.5 + 0.5 * std::sin(x * 0.05 + 2 * std::sin(y * 0.04)) * std::sin(y * 0.07);
  const auto mix = [&](double green, double straw) { return float(green + (straw - green) * dry * dry * dry); };
  return {mix(0.36, 0.50), mix(0.43, 0.46), mix(0.22, 0.26), 1};
}

osg::ref_ptr<osgTerrain::Locator> make_locator() {
  osg::ref_ptr<osgTerrain::Locator> locator(new osgTerrain::Locator);
  locator->setCoordinateSystemType(osgTerrain::Locator::PROJECTED);
  locator->setTransformAsExtents(-k_side_m / 2, -k_side_m / 2, k_side_m / 2, k_side_m / 2);
  return locator;
}

osg::ref_ptr<osgTerrain::HeightFieldLayer> make_heights() {
  osg::ref_ptr<osg::HeightField> field(new osg::HeightField);
  field->allocate(k_samples, k_samples);
  for (unsigned row = 0; row < k_samples; ++row)
    for (unsigned column = 0; column < k_samples; ++column)
      field->setHeight(column, row,
                       float(hill_height(column * k_spacing_m - k_side_m / 2, row * k_spacing_m - k_side_m / 2)));
  return new osgTerrain::HeightFieldLayer(field);
}

osg::ref_ptr<osg::Image> paint_colors() {
  osg::ref_ptr<osg::Image> image(new osg::Image);
  image->allocateImage(k_texels, k_texels, 1, GL_RGB, GL_UNSIGNED_BYTE);
  const double texel = k_side_m / k_texels;
  for (unsigned row = 0; row < k_texels; ++row)
    for (unsigned column = 0; column < k_texels; ++column)
      image->setColor(ground_color((column + 0.5) * texel - k_side_m / 2, (row + 0.5) * texel - k_side_m / 2), column,
                      row);
  return image;
}

osg::ref_ptr<osgTerrain::Terrain> make_terrain(osg::Image* colors) {
  osg::ref_ptr<osgTerrain::TerrainTile> tile(new osgTerrain::TerrainTile);
  tile->setLocator(make_locator());
  tile->setElevationLayer(make_heights());
  tile->getElevationLayer()->setLocator(tile->getLocator());
  tile->setColorLayer(0, new osgTerrain::ImageLayer(colors));
  tile->getColorLayer(0)->setLocator(tile->getLocator());
  osg::ref_ptr<osgTerrain::Terrain> terrain(new osgTerrain::Terrain);
  terrain->setSampleRatio(1);
  terrain->addChild(tile);
  tile->init(tile->getDirtyMask(), true);
  return terrain;
}

// The same sun as the plants'.
osg::ref_ptr<osg::LightSource> make_sun() {
  osg::ref_ptr<osg::LightSource> source(new osg::LightSource);
  osg::Light& light = *source->getLight();
  const float level = std::cos(k_sun_elevation);
  light.setPosition({level * std::cos(k_sun_azimuth), level * std::sin(k_sun_azimuth), std::sin(k_sun_elevation), 0});
  light.setAmbient({0.42f, 0.43f, 0.47f, 1});
  light.setDiffuse({1.0f, 0.97f, 0.90f, 1});
  light.setSpecular({0, 0, 0, 1});
  return source;
}

// The grass of sward's built-in meadow on the ground that OpenSceneGraph draws.
sward::Expected<osg::ref_ptr<PlantsDrawable>> make_plants(std::shared_ptr<const DrawnGround> ground,
                                                          const osg::Image& colors) {
  PlantsDrawable::Content content;
  sward::HostTerrainDesc desc{ground->low(), ground->high()};
  auto terrain = sward::HostTerrain::create([ground](glm::dvec2 xy) { return ground->height(xy); }, desc);
  if (!terrain) return tl::unexpected(terrain.error());
  content.terrain = std::make_shared<const sward::HostTerrain>(std::move(*terrain));
  content.box = {osg::Vec3d(desc.low.x, desc.low.y, desc.low.z), osg::Vec3d(desc.high.x, desc.high.y, desc.high.z)};
  auto map = sward::osg_host::color_map_of(colors, glm::dvec2(desc.low), glm::dvec2(desc.high));
  if (!map) return tl::unexpected(map.error());
  content.colors = std::move(*map);
  auto meadow = sward::builtin_scene("meadow");
  if (!meadow) return tl::unexpected(meadow.error());
  content.layers = {meadow->layers.front()};
  content.lighting = sward::gl::Lighting::clear_day(k_sun_azimuth, k_sun_elevation);
  return osg::ref_ptr<PlantsDrawable>(new PlantsDrawable(std::move(content)));
}

struct Arguments {
  std::string picture;
  double x = 0, y = -6, above = 1.7, yaw = 75, pitch = -8;
  int width = 960, height = 540;
  bool bare = false;
};

bool read_arguments(int argc, char** argv, Arguments& to) {
  osg::ArgumentParser arguments(&argc, argv);
  std::string camera, size;
  while (arguments.read("-o", to.picture)) {
  }
  while (arguments.read("--camera", camera)) {
  }
  while (arguments.read("--size", size)) {
  }
  to.bare = arguments.read("--bare");
  const bool known = arguments.argc() == 1;
  const bool seen = camera.empty() || std::sscanf(camera.c_str(), "%lf,%lf,%lf,%lf,%lf", &to.x, &to.y, &to.above,
                                                  &to.yaw, &to.pitch) == 5;
  const bool sized =
      size.empty() || (std::sscanf(size.c_str(), "%dx%d", &to.width, &to.height) == 2 && to.width > 0 && to.height > 0);
  return known && seen && sized;
}

osg::ref_ptr<osg::GraphicsContext> make_context(const Arguments& arguments) {
  osg::ref_ptr<osg::GraphicsContext::Traits> traits(new osg::GraphicsContext::Traits);
  traits->readDISPLAY();
  traits->x = traits->y = 40;
  traits->width = arguments.width;
  traits->height = arguments.height;
  traits->pbuffer = !arguments.picture.empty();
  traits->windowDecoration = traits->doubleBuffer = !traits->pbuffer;
  traits->depth = 24;
  traits->samples = 4;
  return osg::GraphicsContext::createGraphicsContext(traits.get());
}

bool look(osgViewer::Viewer& viewer, const Arguments& arguments, const DrawnGround& ground) {
  const osg::Vec3d eye(arguments.x, arguments.y, ground.height({arguments.x, arguments.y}) + arguments.above);
  if (std::isnan(eye.z())) return false;
  const double yaw = osg::DegreesToRadians(arguments.yaw), pitch = osg::DegreesToRadians(arguments.pitch);
  const osg::Vec3d ahead(std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch), std::sin(pitch));
  const osg::Vec3d up(-std::cos(yaw) * std::sin(pitch), -std::sin(yaw) * std::sin(pitch), std::cos(pitch));
  viewer.getCamera()->setViewMatrixAsLookAt(eye, eye + ahead, up);
  viewer.setCameraManipulator(nullptr);
  if (!arguments.picture.empty()) return true;
  osg::ref_ptr<osgGA::TerrainManipulator> manipulator(new osgGA::TerrainManipulator);
  manipulator->setHomePosition(eye, eye + ahead * 20, {0, 0, 1});
  viewer.setCameraManipulator(manipulator);
  return true;
}

void set_up_camera(osgViewer::Viewer& viewer, osg::GraphicsContext* context, const Arguments& arguments) {
  osg::Camera& camera = *viewer.getCamera();
  camera.setGraphicsContext(context);
  camera.setViewport(0, 0, arguments.width, arguments.height);
  camera.setProjectionMatrixAsPerspective(50, double(arguments.width) / arguments.height, 0.1, 3000);
  camera.setComputeNearFarMode(osg::Camera::DO_NOT_COMPUTE_NEAR_FAR);  // blades before the eye are nearer than any box
  camera.setClearColor({0.72f, 0.80f, 0.90f, 1});
  viewer.setLightingMode(osg::View::NO_LIGHT);
  viewer.setThreadingModel(osgViewer::Viewer::SingleThreaded);
}

// One frame, read back when it is drawn.
struct Capture : osg::Camera::DrawCallback {
  explicit Capture(const Arguments& arguments) : width(arguments.width), height(arguments.height) {}
  void operator()(osg::RenderInfo&) const override { image->readPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE); }
  int width, height;
  osg::ref_ptr<osg::Image> image{new osg::Image};
};

int fail_with(const std::string& why, int code = 1) {
  std::fprintf(stderr, "osg_terrain: error: %s\n", why.c_str());
  return code;
}

int take_picture(osgViewer::Viewer& viewer, const Arguments& arguments) {
  osg::ref_ptr<Capture> capture(new Capture(arguments));
  viewer.getCamera()->setDrawBuffer(GL_FRONT);
  viewer.getCamera()->setReadBuffer(GL_FRONT);
  viewer.getCamera()->setFinalDrawCallback(capture);
  viewer.realize();
  viewer.frame();
  return osgDB::writeImageFile(*capture->image, arguments.picture) ? 0 : fail_with("no picture " + arguments.picture);
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  if (!read_arguments(argc, argv, arguments))
    return fail_with("usage: osg_terrain [-o PICTURE] [--camera X,Y,Z,YAW,PITCH] [--size WxH] [--bare]", 2);
  const osg::ref_ptr<osg::Image> colors = paint_colors();
  const osg::ref_ptr<osgTerrain::Terrain> terrain = make_terrain(colors);
  auto drawn = DrawnGround::create(*terrain);
  if (!drawn) return fail_with(drawn.error().message);
  const auto ground = std::make_shared<const DrawnGround>(std::move(*drawn));
  const auto plants = make_plants(ground, *colors);
  if (!plants) return fail_with(plants.error().message);

  osg::ref_ptr<osg::Group> root(new osg::Group);
  root->addChild(make_sun());
  root->addChild(terrain);
  if (!arguments.bare) root->addChild(*plants);
  const osg::ref_ptr<osg::GraphicsContext> context = make_context(arguments);
  if (!context) return fail_with("no OpenGL context can be made on this display");
  osgViewer::Viewer viewer;
  set_up_camera(viewer, context, arguments);
  if (!look(viewer, arguments, *ground)) return fail_with("the camera is not over the ground");
  viewer.setSceneData(root);
  return arguments.picture.empty() ? viewer.run() : take_picture(viewer, arguments);
}
