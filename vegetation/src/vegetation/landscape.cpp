// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#include <sward/vegetation/landscape.h>

#include <utility>

namespace sward {

namespace {

/// A layer with what it keeps from frame to frame.
struct Cover {
  FixedLevelOptions cut;
  VegetationRenderer renderer;
  FixedTriangles triangles;
  Seeding seeding;
};

FixedLevelOptions cut_of(const Layer& layer, const HeightField& field) {
  FixedLevelOptions cut;
  cut.level = level_for_area(field, layer.triangle_area_m2);
  cut.canopy_m = canopy_height(layer);
  cut.spread_m = canopy_spread(layer);
  cut.altitudes = needs_altitudes(layer);
  return cut;
}

}  // namespace

/// Behind one pointer, for bounds refer to the field and the mesh to the bounds.
struct Landscape::Parts {
  Parts(HeightField of_field, ColorMap of_colors)
      : field(std::move(of_field)), colors(std::move(of_colors)), bounds(Bounds::create(field)) {
    if (!colors.bounds) colors.bounds = bound_colors(colors);
  }

  Expected<void> make(const LandscapeDesc& desc, const gl::ShaderLibrary& shaders);
  Expected<void> add(const Layer& layer, const gl::ShaderLibrary& shaders, const gl::Bindings& bindings);

  HeightField field;
  ColorMap colors;
  Bounds bounds;
  std::unique_ptr<RoamMesh> mesh;
  std::unique_ptr<gl::Frame> frame;
  std::unique_ptr<gl::GroundTextures> ground;
  std::unique_ptr<TerrainRenderer> terrain;
  std::vector<Cover> covers;
  const Exclusions* exclusions = nullptr;
  RoamStats stats;
};

namespace {

/// Puts what was made into its place, or hands on why there is nothing.
template <class T>
Expected<void> keep(std::unique_ptr<T>& place, Expected<T> made) {
  if (!made) return tl::unexpected(std::move(made.error()));
  place = std::make_unique<T>(std::move(*made));
  return {};
}

}  // namespace

Expected<void> Landscape::Parts::make(const LandscapeDesc& desc, const gl::ShaderLibrary& shaders) {
  if (auto kept = keep(mesh, RoamMesh::create(bounds, desc.mesh)); !kept) return kept;
  if (auto kept = keep(frame, gl::Frame::create(desc.bindings)); !kept) return kept;
  if (auto kept = keep(ground, gl::GroundTextures::create(field, colors)); !kept) return kept;
  if (auto set = ground->set_materials(desc.materials); !set) return set;
  if (auto kept = keep(terrain, TerrainRenderer::create(shaders, desc.bindings)); !kept) return kept;
  for (const Layer& layer : desc.layers) {
    if (auto added = add(layer, shaders, desc.bindings); !added) return added;
  }
  return {};
}

Expected<void> Landscape::Parts::add(const Layer& layer, const gl::ShaderLibrary& shaders,
                                     const gl::Bindings& bindings) {
  if (layer.on_mesh) {
    return fail("layer '" + layer.name + "': a landscape's layers grow on its height field; set on_mesh to false");
  }
  auto renderer = VegetationRenderer::create(layer, shaders, bindings);
  if (!renderer) return tl::unexpected(std::move(renderer.error()));
  covers.push_back({cut_of(layer, field), std::move(*renderer), {}, {}});
  return {};
}

Expected<Landscape> Landscape::create(LandscapeDesc desc, const gl::ShaderLibrary& shaders) {
  if (auto valid = desc.colors.validate(); !valid) return tl::unexpected(std::move(valid.error()));
  if (auto context = gl::require_context(); !context) return tl::unexpected(std::move(context.error()));
  auto parts = std::make_unique<Parts>(std::move(desc.field), std::move(desc.colors));
  if (auto made = parts->make(desc, shaders); !made) return tl::unexpected(std::move(made.error()));
  return Landscape(std::move(parts));
}

Landscape::Landscape(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Landscape::Landscape(Landscape&&) noexcept = default;
Landscape& Landscape::operator=(Landscape&&) noexcept = default;
Landscape::~Landscape() = default;

Expected<void> Landscape::draw(const View& view, const gl::Lighting& lighting, double time_s, int samples,
                               GLuint framebuffer) {
  Parts& p = *parts_;

  // The CPU's share: the mesh follows the view, its triangles near the eye are seeded.
  auto updated = p.mesh->update(view, time_s);
  if (!updated) return tl::unexpected(std::move(updated.error()));
  p.stats = *updated;
  for (Cover& cover : p.covers) {
    const Layer& layer = cover.renderer.layer();
    cover.cut.horizon_m = layer.horizon_m * float(view.zoom());
    p.mesh->fixed_level_triangles(cover.cut, cover.triangles);
    seed(layer, view, p.colors, cover.triangles, cover.seeding, p.exclusions);
  }

  // The GPU's share.
  p.frame->upload(view, lighting, time_s, samples);
  p.terrain->upload(*p.mesh);
  p.terrain->draw(view, *p.frame, *p.ground);
  for (Cover& cover : p.covers) {
    if (auto uploaded = cover.renderer.upload(cover.seeding, cover.triangles, view); !uploaded) return uploaded;
    cover.renderer.classify(*p.frame, *p.ground, framebuffer);
    cover.renderer.draw(*p.frame, *p.ground);
  }
  return {};
}

void Landscape::set_exclusions(const Exclusions* exclusions) {
  parts_->exclusions = exclusions;
}

Expected<EditResult> Landscape::edit(const Edit& edit) {
  auto result = sward::edit(parts_->field, parts_->bounds, edit);
  if (!result || result->samples == 0) return result;
  parts_->mesh->surface_changed(result->changed);
  parts_->ground->update_slopes(parts_->field, result->changed);
  return result;
}

const HeightField& Landscape::field() const {
  return parts_->field;
}
const Bounds& Landscape::bounds() const {
  return parts_->bounds;
}
const ColorMap& Landscape::colors() const {
  return parts_->colors;
}
RoamMesh& Landscape::mesh() {
  return *parts_->mesh;
}
gl::Frame& Landscape::frame() {
  return *parts_->frame;
}
gl::GroundTextures& Landscape::ground() {
  return *parts_->ground;
}
TerrainRenderer& Landscape::terrain() {
  return *parts_->terrain;
}
size_t Landscape::layer_count() const {
  return parts_->covers.size();
}
const RoamStats& Landscape::mesh_stats() const {
  return parts_->stats;
}

namespace {

template <class Covers>
auto& cover_at(Covers& covers, size_t layer) {
  SWARD_ASSERT(layer < covers.size(), "a layer's index must be below layer_count()");
  return covers[layer];
}

}  // namespace

VegetationRenderer& Landscape::vegetation(size_t layer) {
  return cover_at(parts_->covers, layer).renderer;
}
const FixedTriangles& Landscape::triangles(size_t layer) const {
  return cover_at(parts_->covers, layer).triangles;
}
const Seeding& Landscape::seeding(size_t layer) const {
  return cover_at(parts_->covers, layer).seeding;
}

}  // namespace sward
