// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// Reads scenes for OpenSceneGraph: `osgviewer place.sward` reads the TOML file of that name, `osgviewer
// place.toml.sward` the file place.toml, and a built-in scene (`osgviewer meadow.sward`) needs no file.

#include "sward_drawable.h"

#include <osg/Group>
#include <osg/Notify>
#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/Registry>

#include "host/scene_maps.h"

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

}  // namespace

class ReaderWriterSward : public osgDB::ReaderWriter {
 public:
  ReaderWriterSward() { supportsExtension("sward", "sward scene: terrain and vegetation"); }
  const char* className() const override { return "sward scene reader"; }

  ReadResult readObject(const std::string& name, const osgDB::Options* options) const override {
    return readNode(name, options);
  }

  ReadResult readNode(const std::string& name, const osgDB::Options* options) const override {
    if (!acceptsExtension(osgDB::getLowerCaseFileExtension(name))) return ReadResult::FILE_NOT_HANDLED;
    auto scene = read_scene(name, options);
    if (!scene) return failed(scene.error());
    if (auto loaded = host::load_maps(*scene); !loaded) return failed(loaded.error());
    auto terrain = host::load_terrain(*scene, true);
    if (!terrain) return failed(terrain.error());
    osg::ref_ptr<osg::Group> group(new osg::Group);
    group->setName(scene->name);
    group->addChild(new SwardDrawable(std::move(*scene), std::move(*terrain)));
    group->addCullCallback(new NearGround);
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
