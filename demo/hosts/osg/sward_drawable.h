// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// Brings in epoxy's GL header, which must come before OpenSceneGraph's.
#include "renderer_pool.h"

#include <memory>
#include <mutex>
#include <osg/Array>
#include <osg/Drawable>

namespace osgUtil {
class Intersector;
class IntersectionVisitor;
}  // namespace osgUtil

namespace sward::osg_host {

struct DrawableOptions {
  bool sky = true;  ///< Draws sward's sky where nothing else is. False for hosts that have their own.
};

/// A scene that OpenSceneGraph draws: sky, terrain and plants, by one renderer for each graphics context and camera,
/// made at the first draw there (a second or more: programs are compiled). View, projection, viewport and framebuffer
/// are those that OpenSceneGraph draws with; time is the frame stamp's simulation time, in seconds. The node may stand
/// under transforms that move and turn, not scale. Depth must be ordinary (GL_LESS), not reversed.
///
/// Threads: drawing happens in the context's draw thread, everything else may happen in other threads at the same time
/// (all of OpenSceneGraph's threading models). Copies share the renderers.
///
/// GL state: what has to be off or on is in the drawable's StateSet; textures, buffers, programs and vertex arrays that
/// a draw has unbound are reported to osg::State, so that what is drawn next binds its own.
///
/// Errors are told through osg::notify, at WARN, each once; the picture goes on without what failed.
class SwardDrawable : public osg::Drawable {
 public:
  /// `terrain` is the scene's (host::load_terrain).
  SwardDrawable(Scene scene, std::shared_ptr<const host::SceneTerrain> terrain, const DrawableOptions& options = {});
  SwardDrawable(const SwardDrawable& other, const osg::CopyOp& copy);
  META_Object(sward, SwardDrawable)

      const Scene& scene() const {
    return pool_->scene();
  }
  const host::SceneTerrain& terrain() const { return *pool_->terrain(); }

  osg::BoundingBox computeBoundingBox() const override;
  void drawImplementation(osg::RenderInfo& info) const override;
  /// Gives up the renderers of a context, of all without one; OpenSceneGraph deletes their objects when the context is
  /// current next.
  void releaseGLObjects(osg::State* state = nullptr) const override;

  using osg::Drawable::accept;
  using osg::Drawable::supports;
  /// Line segments are intersected with the ground itself (meet_ground), by the visitor's own limits; plants are not.
  void accept(osg::NodeVisitor& visitor) override;
  bool supports(const osg::PrimitiveFunctor&) const override { return true; }
  /// The ground as a grid of at most 128 x 128 squares, for all that asks for triangles: other intersectors,
  /// statistics.
  void accept(osg::PrimitiveFunctor& functor) const override;

 protected:
  SwardDrawable() = default;
  ~SwardDrawable() override = default;

 private:
  struct Grid;
  void intersect(osgUtil::IntersectionVisitor& visitor, osgUtil::Intersector& intersector);
  const Grid& grid() const;

  std::shared_ptr<RendererPool> pool_;
  mutable std::once_flag grid_once_;
  mutable std::shared_ptr<const Grid> grid_;
};

}  // namespace sward::osg_host
