// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/terrain/roam_mesh.h>

#include <atomic>

#include "fixed_level.h"
#include "roam_engine.h"

namespace sward {

namespace {

/// First revision of a mesh: meshes are 2^40 updates apart.
uint64_t first_revision() {
  static std::atomic<uint64_t> meshes{0};
  return (++meshes << 40) + 1;
}

}  // namespace

struct RoamMesh::Impl {
  std::unique_ptr<Surface> own_surface;  // of meshes over a field's bounds
  roam::RoamEngine engine;
  uint64_t revision = first_revision();
  roam::SurfaceHistory history;  // of the surface's static data
};

Expected<RoamMesh> RoamMesh::create(const Bounds& bounds, const RoamOptions& options) {
  auto surface = std::make_unique<FieldSurface>(bounds);
  Expected<RoamMesh> mesh = create(*surface, options);
  if (mesh) mesh->impl_->own_surface = std::move(surface);
  return mesh;
}

Expected<RoamMesh> RoamMesh::create(const Surface& surface, const RoamOptions& options) {
  auto impl = std::make_unique<Impl>(Impl{nullptr, roam::RoamEngine(surface, options), first_revision(), {}});
  if (auto checked = impl->engine.set_options(options); !checked) return tl::unexpected<Error>(checked.error());
  return RoamMesh(std::move(impl));
}

RoamMesh::RoamMesh(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RoamMesh::RoamMesh(RoamMesh&&) noexcept = default;
RoamMesh& RoamMesh::operator=(RoamMesh&&) noexcept = default;
RoamMesh::~RoamMesh() = default;

Expected<RoamStats> RoamMesh::update(const View& view, double time_s) {
  Expected<RoamStats> stats = impl_->engine.update(view, time_s);
  if (stats) ++impl_->revision;
  return stats;
}

void RoamMesh::surface_changed(const LatticeBox& box) {
  impl_->engine.surface_changed(box);
  impl_->history.changed(box);
}

void RoamMesh::residency_changed(const LatticeBox& box) {
  impl_->engine.residency_changed(box);
  // Slopes and holes are those of what is resident.
  impl_->history.changed(box);
}

float RoamMesh::morph_time() const {
  const roam::VertexPool& vertices = impl_->engine.tree().vertices;
  return float(vertices.now - vertices.time_origin);
}

Expected<RoamStats> RoamMesh::update(const View& view) {
  Expected<RoamStats> stats = impl_->engine.update(view);
  if (stats) ++impl_->revision;
  return stats;
}

uint64_t RoamMesh::revision() const {
  return impl_->revision;
}

Expected<void> RoamMesh::set_options(const RoamOptions& options) {
  return impl_->engine.set_options(options);
}

Expected<void> RoamMesh::set_priorities(const HostPriorities* priorities) {
  if (priorities && priorities->lattice() != impl_->engine.tree().lattice())
    return fail("these host priorities are for another lattice; make them with that of the mesh's surface");
  impl_->engine.set_priorities(priorities);
  return {};
}

const RoamOptions& RoamMesh::options() const {
  return impl_->engine.options();
}

float RoamMesh::bound_px() const {
  return impl_->engine.bound_px();
}

glm::dvec3 RoamMesh::origin() const {
  return impl_->engine.tree().vertices.origin;
}

std::span<const RoamVertex> RoamMesh::vertices() const {
  return impl_->engine.tree().vertices.gpu;
}

std::span<const uint32_t> RoamMesh::changed_vertices() const {
  return impl_->engine.tree().vertices.changed;
}

bool RoamMesh::all_vertices_changed() const {
  return impl_->engine.tree().vertices.all_changed;
}

std::span<const uint32_t> RoamMesh::visible_indices() const {
  return impl_->engine.draws().indices();
}

std::span<const uint32_t> RoamMesh::changed_triangles() const {
  return impl_->engine.draws().changed();
}

std::vector<uint32_t> RoamMesh::all_indices() const {
  const roam::RoamTree& tree = impl_->engine.tree();
  std::vector<uint32_t> indices;
  indices.reserve(3 * size_t(tree.leaf_count()));
  for (uint32_t node = 0; node < tree.size(); ++node) {
    if (!tree.is_leaf(node) || tree.nodes[node].cover == roam::Cover::padding) continue;
    const roam::Corners& c = tree.corner[node];
    indices.insert(indices.end(), {c.apex, c.left, c.right});
  }
  return indices;
}

glm::dvec3 RoamMesh::vertex_world(uint32_t slot) const {
  const roam::VertexPool& vertices = impl_->engine.tree().vertices;
  SWARD_ASSERT(slot < vertices.points.size(), "no such vertex slot");
  return vertices.drawn(slot);
}

void RoamMesh::fixed_level_triangles(const FixedLevelOptions& options, FixedTriangles& out) const {
  SWARD_ASSERT(options.level >= 0 && options.level <= k_max_level, "level must be in [0, k_max_level]");
  const auto& view = impl_->engine.view();
  if (!view) return out.clear();
  roam::collect_fixed_level(impl_->engine.tree(), *view, options, impl_->history.state(), out);
}

Expected<void> RoamMesh::validate() const {
  return impl_->engine.validate();
}

}  // namespace sward
