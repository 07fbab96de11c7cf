// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// Reads scenes for OpenSceneGraph: `osgviewer place.sward` reads the TOML file of that name, `osgviewer
// place.toml.sward` the file place.toml, and a built-in scene (`osgviewer meadow.sward`) needs no file. Options, as in
// `osgviewer -O "noSky noHome"`:
//   noSky   without sward's sky
//   noHome  leaves the home of the viewer's manipulators alone

#include "sward_drawable.h"

#include <osg/Group>
#include <osg/Notify>
#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/Registry>
#include <sstream>
#include <string_view>

#include "host/scene_maps.h"
#include "scene_home.h"

namespace sward::osg_host {

namespace {

Expected<Scene> read_scene(const std::string& name, const osgDB::Options* options) {
  const std::string bare = osgDB::getNameLessExtension(name);
  for (const std::string& candidate : {name, bare}) {
    const std::string found = osgDB::findDataFile(candidate, options);
    if (osgDB::fileType(found) == osgDB::REGULAR_FILE) return load_scene(found);
  }
  return builtin_scene(bare);
}

bool has_option(const osgDB::Options* options, std::string_view wanted) {
  std::istringstream words(options != nullptr ? options->getOptionString() : std::string());
  for (std::string word; words >> word;)
    if (word == wanted) return true;
  return false;
}

Expected<osg::ref_ptr<SwardDrawable>> read_drawable(const std::string& name, const osgDB::Options* options) {
  auto scene = read_scene(name, options);
  if (!scene) return tl::unexpected(scene.error());
  if (auto loaded = host::load_maps(*scene); !loaded) return tl::unexpected(loaded.error());
  auto terrain = host::load_terrain(*scene, true);
  if (!terrain) return tl::unexpected(terrain.error());
  for (const std::string& warning : (*terrain)->warnings()) OSG_WARN << "sward: warning: " << warning << std::endl;
  DrawableOptions drawing;
  drawing.sky = !has_option(options, "noSky");
  return osg::ref_ptr<SwardDrawable>(new SwardDrawable(std::move(*scene), std::move(*terrain), drawing));
}

}  // namespace

class ReaderWriterSward : public osgDB::ReaderWriter {
 public:
  ReaderWriterSward() {
    supportsExtension("sward", "sward scene: terrain and vegetation");
    supportsOption("noSky", "Leave out sward's sky");
    supportsOption("noHome", "Leave the home of the viewer's manipulators alone");
  }
  const char* className() const override { return "sward scene reader"; }

  ReadResult readObject(const std::string& name, const osgDB::Options* options) const override {
    return readNode(name, options);
  }

  ReadResult readNode(const std::string& name, const osgDB::Options* options) const override {
    if (!acceptsExtension(osgDB::getLowerCaseFileExtension(name))) return ReadResult::FILE_NOT_HANDLED;
    auto drawable = read_drawable(name, options);
    if (!drawable) return failed(drawable.error());
    osg::ref_ptr<osg::Group> group(new osg::Group);
    group->setName((*drawable)->scene().name);
    group->addChild(*drawable);
    if (!has_option(options, "noHome")) group->addEventCallback(new SceneHome(**drawable));
    return group.get();
  }

 private:
  static ReadResult failed(const Error& error) {
    OSG_WARN << "sward: error: " << error.message << std::endl;
    return ReadResult(error.message);
  }
};

REGISTER_OSGPLUGIN(sward, ReaderWriterSward)

}  // namespace sward::osg_host
