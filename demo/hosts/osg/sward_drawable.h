// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// epoxy's GL header, which this brings in, must come before OpenSceneGraph's.
#include "host/scene_renderer.h"

#include <map>
#include <memory>
#include <mutex>
#include <osg/Drawable>
#include <osg/NodeCallback>

namespace sward::osg_host {

/// A scene that OpenSceneGraph draws: terrain in memory, and for each graphics context what draws it there, made at
/// the first draw. View, projection and viewport come from OpenSceneGraph's state in every frame; the node may stand
/// under rigid transforms.
class SwardDrawable : public osg::Drawable {
 public:
  SwardDrawable(Scene scene, std::shared_ptr<const host::SceneTerrain> terrain);
  SwardDrawable(const SwardDrawable& other, const osg::CopyOp& copy);
  META_Object(sward, SwardDrawable)

      osg::BoundingBox computeBoundingBox() const override;
  void drawImplementation(osg::RenderInfo& info) const override;
  /// Deletes what a context holds; where it is not current, its own thread does so later.
  void releaseGLObjects(osg::State* state = nullptr) const override;

 protected:
  SwardDrawable();
  ~SwardDrawable() override;

 private:
  struct PerContext {
    std::unique_ptr<host::SceneRenderer> renderer;  // empty: creation failed, which was said once
  };
  host::SceneRenderer* renderer_for(unsigned context) const;
  void draw(osg::State& state, host::SceneRenderer& renderer, double time_s) const;

  Scene scene_;
  std::shared_ptr<const host::SceneTerrain> terrain_;
  mutable std::mutex mutex_;
  mutable std::map<unsigned, PerContext> contexts_;
};

/// Lets the near plane come close enough for grass: OpenSceneGraph derives it from the far plane otherwise.
class NearGround : public osg::NodeCallback {
 public:
  void operator()(osg::Node* node, osg::NodeVisitor* visitor) override;
};

}  // namespace sward::osg_host
