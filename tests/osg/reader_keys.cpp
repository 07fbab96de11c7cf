// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// A plugin for tests of stock osgviewer: `osgviewer scene.sward s3_c6.keys` presses s in the fourth frame and c in the
// seventh, as a user would (frames count from 0). No display tools are needed.

#include <cctype>
#include <map>
#include <osg/Group>
#include <osgDB/FileNameUtils>
#include <osgDB/Registry>
#include <osgGA/EventVisitor>
#include <osgViewer/View>
#include <sstream>
#include <string>

namespace {

class PressKeys : public osg::NodeCallback {
 public:
  explicit PressKeys(const std::string& text) {
    std::istringstream words(text);
    for (std::string word; std::getline(words, word, '_');) keys_.emplace(std::stoul(word.substr(1)), word[0]);
  }

  void operator()(osg::Node* node, osg::NodeVisitor* visitor) override {
    osgGA::EventVisitor* events = visitor->asEventVisitor();
    auto* view = events != nullptr ? dynamic_cast<osgViewer::View*>(events->getActionAdapter()) : nullptr;
    while (view != nullptr && !keys_.empty() && keys_.begin()->first <= visitor->getFrameStamp()->getFrameNumber()) {
      view->getEventQueue()->keyPress(keys_.begin()->second);
      view->getEventQueue()->keyRelease(keys_.begin()->second);
      keys_.erase(keys_.begin());
    }
    traverse(node, visitor);
  }

 private:
  std::multimap<unsigned long, int> keys_;
};

class ReaderWriterKeys : public osgDB::ReaderWriter {
 public:
  ReaderWriterKeys() { supportsExtension("keys", "keys that are pressed in frames"); }
  const char* className() const override { return "key presser"; }
  ReadResult readNode(const std::string& name, const osgDB::Options*) const override {
    if (!acceptsExtension(osgDB::getFileExtension(name))) return ReadResult::FILE_NOT_HANDLED;
    osg::ref_ptr<osg::Group> group(new osg::Group);
    group->addEventCallback(new PressKeys(osgDB::getStrippedName(name)));
    return group.get();
  }
};

REGISTER_OSGPLUGIN(keys, ReaderWriterKeys)

}  // namespace
