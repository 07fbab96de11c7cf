// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// Brings in epoxy's GL header, which must come before OpenSceneGraph's.
#include "osg_state.h"

#include <sward/gl/frame.h>
#include <sward/terrain/color_map.h>
#include <sward/terrain/host_terrain.h>
#include <sward/vegetation/species.h>
#include <atomic>
#include <memory>
#include <osg/Drawable>
#include <vector>

namespace sward::osg_host {

/// Plants on ground that something else draws; the ground's height is a callback's (HostTerrain). Compiles its programs
/// at the first draw. View, projection, viewport and framebuffer are those that OpenSceneGraph draws with, time is the
/// frame stamp's. The node may stand under transforms that move and turn, not scale. Draw it after the ground, which
/// then hides what is behind it before it is shaded; the viewer's near plane is to be as near as 0.1 m.
///
/// For one graphics context and one camera; another context is told about through osg::notify and not drawn to. Errors
/// are told there, at WARN, each frame they last.
class PlantsDrawable : public osg::Drawable {
 public:
  struct Content {
    std::shared_ptr<const HostTerrain> terrain;
    osg::BoundingBox box;  ///< Of the ground; plants are added.
    ColorMap colors;
    std::vector<Layer> layers;
    gl::Lighting lighting;
  };
  explicit PlantsDrawable(Content content);
  PlantsDrawable(const PlantsDrawable& other, const osg::CopyOp& copy);
  META_Object(sward, PlantsDrawable)

      /// Of the last draw, in triangles seeded.
      size_t seeded() const {
    return seeded_;
  }

  osg::BoundingBox computeBoundingBox() const override;
  void drawImplementation(osg::RenderInfo& info) const override;
  /// With the context current, as OpenSceneGraph calls it.
  void releaseGLObjects(osg::State* state = nullptr) const override;

 protected:
  PlantsDrawable();
  ~PlantsDrawable() override;

 private:
  struct Renderer;
  Expected<void> draw(osg::State& state) const;

  std::shared_ptr<const Content> content_;
  mutable std::unique_ptr<Renderer> renderer_;
  mutable std::atomic<size_t> seeded_{0};
};

}  // namespace sward::osg_host
