// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/vegetation/clipmap_seeding.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "gl/bind.h"
#include "vegetation/clipmap_seeder_buffers.h"
#include "vegetation/vegetation_renderer_buffers.h"

namespace sward {

namespace {

struct SeedPrograms {
  gl::Program count, edges, bins, layout, records;
};

Expected<SeedPrograms> build_programs(const gl::ShaderLibrary& shaders, const gl::Bindings& bindings) {
  SeedPrograms programs;
  const std::pair<const char*, gl::Program*> stages[] = {{"seed_count", &programs.count},
                                                         {"seed_edges", &programs.edges},
                                                         {"seed_bins", &programs.bins},
                                                         {"seed_layout", &programs.layout},
                                                         {"seed_records", &programs.records}};
  for (const auto& [name, program] : stages) {
    gl::ProgramDesc desc;
    desc.name = name;
    desc.compute = std::string(name) + ".comp.glsl";
    desc.defines = gl::binding_defines(bindings);
    auto built = shaders.build(desc);
    if (!built) return tl::unexpected(built.error());
    *program = std::move(*built);
  }
  return programs;
}

size_t most_records() {
  GLint texels = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &texels);
  return size_t(std::max(texels, 1)) * 16 / sizeof(TriangleRecord);
}

/// Splits of the drawn surface below a triangle, down to the rings' cells; 0 where there are none.
uint32_t add_surface(const ClipmapRings& rings, TriangleId id, const TriangleCorners& c, int ring_level,
                     FixedTriangles& out) {
  if (id.level() >= ring_level) return 0;
  const LatticePoint middle = c.left + (c.right - c.left) / 2;
  const double z = rings.height(rings.surface().lattice().world_xy(middle));
  SurfaceNode node;
  node.z = std::isfinite(z) ? float(z - out.surface_z()) : 0.0f;
  node.child[0] = add_surface(rings, id.child(0), {middle, c.apex, c.left}, ring_level, out);
  node.child[1] = add_surface(rings, id.child(1), {middle, c.right, c.apex}, ring_level, out);
  return out.add_node(node);
}

}  // namespace

struct ClipmapSeeder::Impl {
  gl::HomeContext home;
  Layer layer;
  const Surface* surface;
  gl::Bindings bindings;
  SeedPrograms programs;
  ClipmapTable table;
  gl::Buffer uniforms, frame, ground, counts, groups;
  size_t ground_bytes = 0, candidate_room = 0, record_limit = 0;
  TexelBuffer records, exclusions;
  SeedFrameReadBack back;
  bool seeded = false;

  Expected<void> follow(const View& view, const Exclusions* shapes);
  void write_ground();
  void bind(const gl::Clipmap& clipmap) const;
  void unbind() const;
  void dispatch() const;
};

Expected<void> ClipmapSeeder::Impl::follow(const View& view, const Exclusions* shapes) {
  if (auto followed = table.follow(view, shapes); !followed) return followed;
  const size_t candidates = table.candidates();
  if (candidates > record_limit)
    return fail("layer '" + layer.name + "': " + std::to_string(candidates) +
                " triangles within its horizon do not fit into a buffer texture of this device (" +
                std::to_string(record_limit) + "); raise its triangle area or lower its horizon");
  if (candidates > candidate_room) {
    candidate_room = candidates + candidates / 2;
    const size_t work_groups = (candidate_room + k_seed_group - 1) / k_seed_group;
    counts = make_buffer(candidate_room * 2 * sizeof(uint32_t), nullptr, 0);
    groups = make_buffer(work_groups * k_density_bins * sizeof(uint32_t), nullptr, 0);
  }
  records.fit(std::min(candidates, record_limit) * sizeof(TriangleRecord), GL_RGBA32UI);
  write_ground();
  const std::span<const glm::vec4> runs = table.exclusions();
  if (exclusions.fit(runs.size_bytes(), GL_RGBA32F) || table.exclusions_written())
    glNamedBufferSubData(exclusions.buffer.id(), 0, GLsizeiptr(runs.size_bytes()), runs.data());
  return {};
}

void ClipmapSeeder::Impl::write_ground() {
  const std::span<const SeedGround> all = table.ground();
  if (all.size_bytes() > ground_bytes) {
    ground_bytes = all.size_bytes();
    ground = make_buffer(ground_bytes, all.data(), GL_DYNAMIC_STORAGE_BIT);
    return;
  }
  for (const ClipmapTable::Run& run : table.written())
    glNamedBufferSubData(ground.id(), GLintptr(run.first * sizeof(SeedGround)),
                         GLsizeiptr(run.count * sizeof(SeedGround)), all.data() + run.first);
}

void ClipmapSeeder::Impl::bind(const gl::Clipmap& clipmap) const {
  gl::bind_uniforms(bindings.clipmap, clipmap.block());
  gl::bind_uniforms(bindings.seeding, uniforms.id());
  gl::bind_storage(bindings.seed_ground, ground.id());
  gl::bind_storage(bindings.seed_counts, counts.id());
  gl::bind_storage(bindings.seed_groups, groups.id());
  gl::bind_storage(bindings.seed_frame, frame.id());
  gl::bind_storage(bindings.seed_records, records.buffer.id());
  gl::bind_texture(bindings.clipmap_heights, clipmap.heights());
}

void ClipmapSeeder::Impl::unbind() const {
  glUseProgram(0);
  glBindTextureUnit(bindings.clipmap_heights, 0);
  for (const GLuint index :
       {bindings.seed_ground, bindings.seed_counts, bindings.seed_groups, bindings.seed_frame, bindings.seed_records})
    gl::bind_storage(index, 0);
  gl::bind_uniforms(bindings.seeding, 0);
  gl::bind_uniforms(bindings.clipmap, 0);
}

void ClipmapSeeder::Impl::dispatch() const {
  const auto work_groups = GLuint((table.candidates() + k_seed_group - 1) / k_seed_group);
  const auto run = [](const gl::Program& program, GLuint count) {
    glUseProgram(program.id());
    glDispatchCompute(count, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  };
  run(programs.count, work_groups);
  run(programs.edges, 1);
  run(programs.bins, work_groups);
  run(programs.layout, 1);
  run(programs.records, work_groups);
  glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

ClipmapSeeder::ClipmapSeeder(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ClipmapSeeder::ClipmapSeeder(ClipmapSeeder&&) noexcept = default;
ClipmapSeeder& ClipmapSeeder::operator=(ClipmapSeeder&&) noexcept = default;
ClipmapSeeder::~ClipmapSeeder() = default;

Expected<ClipmapSeeder> ClipmapSeeder::create(const Layer& layer, const Surface& surface, const ColorMap& map,
                                              const gl::ShaderLibrary& shaders, const gl::Bindings& bindings) {
  if (auto valid = validate(layer); !valid) return tl::unexpected(valid.error());
  if (auto loaded = require_maps(layer); !loaded) return tl::unexpected(loaded.error());
  if (auto context = gl::require_context(); !context) return tl::unexpected(context.error());
  auto programs = build_programs(shaders, bindings);
  if (!programs) return tl::unexpected(programs.error());
  auto impl =
      std::make_unique<Impl>(Impl{.home = gl::HomeContext::of_current(),
                                  .layer = layer,
                                  .surface = &surface,
                                  .bindings = bindings,
                                  .programs = std::move(*programs),
                                  .table = ClipmapTable(layer, surface, map),
                                  .uniforms = make_buffer(sizeof(SeedingUniforms), nullptr, GL_DYNAMIC_STORAGE_BIT),
                                  .frame = make_buffer(sizeof(SeedFrame), nullptr, GL_DYNAMIC_STORAGE_BIT),
                                  .ground = {},
                                  .counts = {},
                                  .groups = {},
                                  .record_limit = most_records(),
                                  .records = {},
                                  .exclusions = {},
                                  .back = SeedFrameReadBack::create()});
  return ClipmapSeeder(std::move(impl));
}

const Layer& ClipmapSeeder::layer() const {
  return impl_->layer;
}

Expected<void> ClipmapSeeder::seed(const View& view, const gl::Clipmap& clipmap, const Exclusions* exclusions) {
  Impl& self = *impl_;
  if (!self.home.here("ClipmapSeeder::seed")) return fail("ClipmapSeeder::seed: its OpenGL context is not current");
  if (auto valid = view.validate(); !valid) return valid;
  const bool same_surface = &clipmap.rings().surface() == self.surface;
  SWARD_ASSERT(same_surface, "the clipmap is another surface's");
  if (!same_surface) return fail("ClipmapSeeder::seed: the clipmap is another surface's");
  self.seeded = false;
  if (auto followed = self.follow(view, exclusions); !followed) return followed;
  const SeedingUniforms uniforms = make_seeding_uniforms(self.layer, view, self.surface->lattice(), self.table);
  glNamedBufferSubData(self.uniforms.id(), 0, sizeof uniforms, &uniforms);
  const SeedFrame empty;
  glNamedBufferSubData(self.frame.id(), 0, sizeof empty, &empty);
  self.bind(clipmap);
  self.dispatch();
  self.unbind();
  self.back.request(self.frame.id());
  self.seeded = true;
  return {};
}

void ClipmapSeeder::set_season(float season) {
  SWARD_ASSERT(std::isfinite(season), "a season is a finite number");
  impl_->table.set_season(season);
}

void ClipmapSeeder::changed(const LatticeBox& box) {
  impl_->table.changed(box);
}

ClipmapSeedingStats ClipmapSeeder::stats(bool wait) {
  if (!impl_->home.here("ClipmapSeeder::stats")) return {};
  const auto [n_min, n_max, seeded, visible, clusters, a, b, c] = impl_->back.newest(wait);
  return {visible, seeded, clusters};
}

void ClipmapSeeder::read_back(const View& view, const gl::Clipmap& clipmap, FixedTriangles& triangles,
                              Seeding& seeding) const {
  const Impl& self = *impl_;
  if (!self.home.here("ClipmapSeeder::read_back")) return;
  SWARD_ASSERT(self.seeded, "nothing was seeded that could be read back");
  if (!self.seeded) return;
  SeedFrame frame;
  glGetNamedBufferSubData(self.frame.id(), 0, sizeof frame, &frame);
  seeding.bins = {};
  for (size_t i = 0; i < seeding.bins.size(); ++i)
    seeding.bins[i] = {frame.commands[i].first, frame.commands[i].count, frame.commands[i].instance_count};
  seeding.clusters = frame.clusters;
  seeding.n_min = frame.n_max > 0 ? float(frame.n_min) : 0.0f;
  seeding.n_max = float(frame.n_max);
  seeding.records.resize(frame.seeded);
  seeding.source.resize(frame.seeded);
  const auto runs = self.table.exclusions();
  seeding.exclusions.assign(runs.begin(), runs.end());
  if (frame.seeded > 0)
    glGetNamedBufferSubData(self.records.buffer.id(), 0, GLsizeiptr(frame.seeded * sizeof(TriangleRecord)),
                            seeding.records.data());

  const ClipmapRings& rings = clipmap.rings();
  triangles.clear();
  triangles.set_surface_z(std::round(view.eye.z));
  seeding.surface_z_origin = triangles.surface_z();
  for (uint32_t i = 0; i < frame.seeded; ++i) {
    TriangleRecord& record = seeding.records[i];
    FixedTriangle t;
    t.id.bits = uint64_t(record.id_high) << 32 | record.id_low;
    const TriangleCorners corners = corners_of(t.id);
    t.apex = {rings.surface().lattice().world_xy(corners.apex), view.eye.z + double(record.apex.z)};
    t.to_left = record.to_left;
    t.to_right = record.to_right;
    t.altitude = record.altitude;
    const int ring_level = 2 * (k_root_bits - rings.shift(rings.finest()));
    t.surface = add_surface(rings, t.id, corners, ring_level, triangles);
    record.surface = t.surface;
    record.surface_z = float(triangles.surface_z() - view.eye.z);
    seeding.source[i] = i;
    triangles.push_back(t);
  }
}

GLuint ClipmapSeeder::records() const {
  return impl_->records.texture.id();
}
GLuint ClipmapSeeder::exclusions() const {
  return impl_->exclusions.texture.id();
}
GLuint ClipmapSeeder::draws() const {
  return impl_->frame.id();
}
size_t ClipmapSeeder::draws_offset() const {
  return offsetof(SeedFrame, commands);
}
size_t ClipmapSeeder::most_clusters() const {
  return impl_->table.most_clusters();
}
bool ClipmapSeeder::seeded() const {
  return impl_->seeded;
}

size_t ClipmapSeeder::gpu_bytes() const {
  const Impl& self = *impl_;
  size_t bytes = self.back.gpu_bytes();
  for (const gl::Buffer* buffer : {&self.uniforms, &self.frame, &self.ground, &self.counts, &self.groups,
                                   &self.records.buffer, &self.exclusions.buffer})
    bytes += gl::storage_bytes(*buffer);
  return bytes;
}

}  // namespace sward
