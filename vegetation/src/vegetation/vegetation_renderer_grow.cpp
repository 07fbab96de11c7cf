// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth: every stream drawn by its kind's own tessellation, geometry and fragment programs.
#include <sward/vegetation/blade_shape.h>
#include <algorithm>

#include "gl/bind.h"
#include "vegetation/plant_mesh.h"
#include "vegetation/vegetation_renderer_stages.h"
#include "vegetation/wind_bindings.h"

namespace sward {

namespace {

constexpr GLint k_species_location = 0;
constexpr GLint k_heights_location = 2;  // of programs in wind

/// A program that draws a kind of plant. A kind may have several rows, drawn in this order; a further kind is a further
/// row.
struct KindProgram {
  PlantKind kind;
  const char *name, *vertex, *tess_control, *tess_evaluation, *geometry, *fragment;
  /// The file of functions that its strips ask (nullptr: for kinds made of shoots the species names it, for others
  /// there is none), and the shoots of a plant.
  bool of_shoots = false;
  const char* functions = nullptr;
  int (*shoots)(const Species& species) = nullptr;
  /// Points that the tessellator makes of one line; nullptr: by segments.
  int (*points)(const Species& species) = nullptr;
  bool moves = true;  ///< In the wind.
};
constexpr std::array<KindProgram, 11> k_kinds{{
    {PlantKind::blade, "grass_blade", "grow.vert.glsl", "grass_blade.tesc.glsl", "grass_blade.tese.glsl",
     "grass_blade.geom.glsl", "grass_blade.frag.glsl", false, "kind_blade.glsl"},
    {PlantKind::tuft, "tuft", "shoot.vert.glsl", "shoot.tesc.glsl", "shoot.tese.glsl", "grass_blade.geom.glsl",
     "grass_blade.frag.glsl", true, "kind_tuft.glsl", [](const Species& s) { return s.tuft.blades.max; }},
    {PlantKind::flower, "flower_stem", "shoot.vert.glsl", "shoot.tesc.glsl", "shoot.tese.glsl", "grass_blade.geom.glsl",
     "grass_blade.frag.glsl", true, "kind_flower.glsl", [](const Species& s) { return 1 + s.flower.leaves; }},
    {PlantKind::flower, "flower_head", "grow.vert.glsl", "flower_head.tesc.glsl", "flower_head.tese.glsl",
     "flower_head.geom.glsl", "flower_head.frag.glsl", false, nullptr, nullptr,
     [](const Species& s) { return s.flower.petals + 1; }},
    {PlantKind::custom, "custom", "shoot.vert.glsl", "shoot.tesc.glsl", "shoot.tese.glsl", "grass_blade.geom.glsl",
     "grass_blade.frag.glsl", true, nullptr, [](const Species& s) { return s.custom.shoots; }},
    {PlantKind::gravel, "gravel", "grow.vert.glsl", "gravel.tesc.glsl", "gravel.tese.glsl", "gravel.geom.glsl",
     "gravel.frag.glsl", false, nullptr, nullptr, nullptr, false},
    {PlantKind::leaf, "leaf", "grow.vert.glsl", "leaf.tesc.glsl", "leaf.tese.glsl", "leaf.geom.glsl", "leaf.frag.glsl"},
    {PlantKind::fern, "fern", "grow.vert.glsl", "leaf.tesc.glsl", "leaf.tese.glsl", "leaf.geom.glsl", "fern.frag.glsl"},
    {PlantKind::litter, "litter", "grow.vert.glsl", "litter.tesc.glsl", "litter.tese.glsl", "litter.geom.glsl",
     "litter.frag.glsl", false, nullptr, nullptr, nullptr, false},
    {PlantKind::billboard, "billboard", "grow.vert.glsl", "billboard.tesc.glsl", "billboard.tese.glsl",
     "billboard.geom.glsl", "billboard.frag.glsl"},
    {PlantKind::mesh, "mesh_plant", "grow.vert.glsl", "mesh_plant.tesc.glsl", "mesh_plant.tese.glsl",
     "mesh_plant.geom.glsl", "mesh_plant.frag.glsl", false, nullptr, nullptr,
     [](const Species& s) { return face_count(s.mesh) / 8 + 2; }},
}};

/// The file of functions that a species' program is built with; empty for kinds that are not made of strips.
std::string functions_of(const KindProgram& kind, const Species& species) {
  if (kind.functions != nullptr) return kind.functions;
  return kind.of_shoots ? species.custom.functions : std::string();
}

Expected<gl::Program> build_program(const KindProgram& kind, const std::string& functions, bool wind,
                                    const Layer& layer, const gl::ShaderLibrary& shaders,
                                    const gl::Bindings& bindings) {
  gl::ShaderLibrary library = shaders;
  if (wind) library.add_source("plant_wind.glsl", "#include \"common_wind.glsl\"\n");
  if (!functions.empty()) library.add_source("plant_kind.glsl", "#include \"" + functions + "\"\n");
  std::vector<gl::Define> defines = layer_defines(layer, bindings, wind);
  // A host's functions may change colour within a segment, and petals do.
  const bool lit = kind.functions != nullptr;
  defines.push_back({"SWARD_LIT_AT_VERTICES", lit ? "1" : "0"});
  return library.build({.name = kind.name,
                        .vertex = kind.vertex,
                        .tess_control = kind.tess_control,
                        .tess_evaluation = kind.tess_evaluation,
                        .geometry = kind.geometry,
                        .fragment = kind.fragment,
                        .defines = std::move(defines),
                        .feedback_varyings = {}});
}

/// A buffer texture, so that no pixel-store state of the host meddles with it.
void attach_shapes(const std::vector<glm::vec4>& texels, gl::Buffer& buffer, gl::Texture& texture) {
  buffer = make_buffer(texels.size() * sizeof(glm::vec4), texels.data(), 0);
  texture = gl::create_texture(GL_TEXTURE_BUFFER);
  glTextureBuffer(texture.id(), GL_RGBA32F, buffer.id());
}

/// Patches of a cluster that hold all shoots of its plants.
int instances_of(const KindProgram& kind, const Layer& layer, const Species& species) {
  if (!kind.of_shoots) return 1;
  const int a_patch = shoots_per_patch(layer);
  return (kind.shoots(species) + a_patch - 1) / a_patch;
}

/// Mesa's software tessellator numbers the points of a draw with 16 bits: beyond that, lines are drawn again in place
/// of those that follow. The most clusters of a species whose points still have a number each; odd spacing adds up to
/// two segments, a line one point.
GLsizei part_of(const KindProgram& kind, const Layer& layer, const Species& species) {
  const int points = kind.points != nullptr ? kind.points(species) : std::max(species.max_segments, 5) + 3;
  const int lines = layer.cluster_size * (kind.of_shoots ? kind.shoots(species) : 1);
  return std::max(0xffff / (lines * points), 1);
}

}  // namespace

gl::VertexArray make_cluster_array() {
  gl::VertexArray array = gl::create_vertex_array();
  glEnableVertexArrayAttrib(array.id(), 0);
  glVertexArrayAttribIFormat(array.id(), 0, 4, GL_UNSIGNED_INT, 0);
  glVertexArrayAttribBinding(array.id(), 0, 0);
  return array;
}

void set_stream(const gl::VertexArray& array, GLuint buffer) {
  glVertexArrayVertexBuffer(array.id(), 0, buffer, 0, GLsizei(k_cluster_bytes));
}

Expected<GrowthStage> GrowthStage::create(const Layer& layer, const gl::ShaderLibrary& shaders,
                                          const gl::Bindings& bindings) {
  GrowthStage stage;
  stage.draws_in_parts_ = gl::software_renderer();
  for (const Species& species : layer.species) {
    auto added = stage.add_species(layer, species, shaders, bindings);
    auto settled = stage.settle(std::move(added), species, stage.passes_.back());
    if (!settled) return tl::unexpected(settled.error());
  }
  auto shapes = make_blade_shapes();
  if (!shapes) return tl::unexpected(shapes.error());
  attach_shapes(shapes->texels, stage.blade_shape_buffer_, stage.blade_shape_);
  stage.image_array_ = PlantImageArray::create(layer);
  for (const Species& species : layer.species) stage.images_.push_back(stage.image_array_.of(species));
  stage.vertex_array_ = make_cluster_array();
  return stage;
}

Expected<void> GrowthStage::add_species(const Layer& layer, const Species& species, const gl::ShaderLibrary& shaders,
                                        const gl::Bindings& bindings) {
  std::vector<Pass>& passes = passes_.emplace_back();
  for (const KindProgram& kind : k_kinds) {
    if (kind.kind != species.kind) continue;
    const std::string functions = functions_of(kind, species), name = kind.name + (" " + functions);
    const auto found =
        program_row(name, [&] { return build_program(kind, functions, false, layer, shaders, bindings); });
    if (!found) return fail("layer '" + layer.name + "': species '" + species.name + "': " + found.error().message);
    const size_t row = *found;
    passes.push_back({row, GLsizei(instances_of(kind, layer, species)), part_of(kind, layer, species),
                      glGetUniformLocation(programs_[row].id(), "sward_images"), add_mesh(species)});
  }
  return {};
}

// A host's kind is the host's text: the rest goes on without it. GL's debug log, where there is one, says so too.
Expected<void> GrowthStage::settle(Expected<void> built, const Species& species, std::vector<Pass>& passes) {
  if (built || species.kind != PlantKind::custom) return built;
  passes.clear();
  const std::string& message = faults_.emplace_back(built.error()).message;
  GLint longest = 0;
  glGetIntegerv(GL_MAX_DEBUG_MESSAGE_LENGTH, &longest);
  glDebugMessageInsert(GL_DEBUG_SOURCE_THIRD_PARTY, GL_DEBUG_TYPE_ERROR, 0, GL_DEBUG_SEVERITY_HIGH,
                       std::min(GLsizei(message.size()), longest - 1), message.c_str());
  return {};
}

Expected<size_t> GrowthStage::program_row(const std::string& name,
                                          const std::function<Expected<gl::Program>()>& build) {
  const size_t row = size_t(std::find(program_names_.begin(), program_names_.end(), name) - program_names_.begin());
  if (row < programs_.size()) return row;
  auto program = build();
  if (!program) return tl::unexpected(program.error());
  programs_.push_back(std::move(*program));
  program_names_.push_back(name);
  return row;
}

Expected<void> GrowthStage::build_wind_of(const Layer& layer, const Species& species, std::span<Pass> passes,
                                          const gl::ShaderLibrary& shaders, const gl::Bindings& bindings) {
  size_t pass = 0;
  for (const KindProgram& kind : k_kinds) {
    if (kind.kind != species.kind) continue;
    Pass& each = passes[pass++];
    each.blown = each.program;
    if (!kind.moves) continue;
    const std::string functions = functions_of(kind, species), name = kind.name + (" in wind " + functions);
    const auto row = program_row(name, [&] { return build_program(kind, functions, true, layer, shaders, bindings); });
    if (!row) return fail("layer '" + layer.name + "': species '" + species.name + "': " + row.error().message);
    each.blown = *row;
  }
  return {};
}

Expected<void> GrowthStage::build_wind(const Layer& layer, const gl::ShaderLibrary& shaders,
                                       const gl::Bindings& bindings) {
  if (wind_shape_.id() != 0) return {};
  for (size_t i = 0; i < layer.species.size(); ++i) {
    if (passes_[i].empty()) continue;
    auto built = build_wind_of(layer, layer.species[i], passes_[i], shaders, bindings);
    if (auto settled = settle(std::move(built), layer.species[i], passes_[i]); !settled) return settled;
  }
  const auto shapes = make_wind_shapes();
  if (!shapes) return tl::unexpected(shapes.error());
  heights_.clear();
  for (const Species& species : layer.species) heights_.emplace_back(species.height_m.min, species.height_m.max);
  attach_shapes(shapes->texels, wind_shape_buffer_, wind_shape_);
  return {};
}

GLuint GrowthStage::add_mesh(const Species& species) {
  if (species.kind != PlantKind::mesh) return 0;
  const std::vector<glm::vec4> texels = make_mesh_texels(species.mesh);
  gl::Buffer& buffer = mesh_buffers_.emplace_back(make_buffer(texels.size() * sizeof(glm::vec4), texels.data(), 0));
  gl::Texture& texture = meshes_.emplace_back(gl::create_texture(GL_TEXTURE_BUFFER));
  glTextureBuffer(texture.id(), GL_RGBA32F, buffer.id());
  return texture.id();
}

void GrowthStage::draw(const Pass& pass, const FeedbackPass& feedback, int stream, uint32_t fertile) const {
  if (!draws_in_parts_) {
    glDrawTransformFeedbackStreamInstanced(GL_PATCHES, feedback.id(), GLuint(stream), pass.instances);
    return;
  }
  for (GLsizei first = 0; first < GLsizei(fertile); first += pass.part)
    glDrawArraysInstanced(GL_PATCHES, first, std::min(pass.part, GLsizei(fertile) - first), pass.instances);
}

void GrowthStage::run(const StageInputs& inputs, const ClassificationStage& classified,
                      std::span<const uint32_t> fertile, const WindTextures* wind) {
  const gl::Bindings& units = inputs.bindings;
  const WindBindings blowing(units, wind);
  const StageBindings bound(units, inputs.frame.buffer(), inputs.species,
                            {{units.base_map, inputs.ground.base_map()},
                             {units.base_map_raw, inputs.placement.map()},
                             {units.triangles, inputs.triangles.records()},
                             {units.surface, inputs.triangles.surface()},
                             {units.exclusions, inputs.triangles.exclusions()},
                             {units.placement, inputs.placement.masks()},
                             {units.blade_shape, wind != nullptr ? wind_shape_.id() : blade_shape_.id()},
                             {units.plant_images, image_array_.texture()},
                             {units.plant_mesh, 0},
                             {units.detail, inputs.ground.detail()},
                             {units.detail_slope, inputs.ground.detail_slope()}},
                            inputs.triangles.clipmap());
  const DisturbedBindings disturbed(units, inputs.ground.disturbed());
  gl::bind_uniforms(units.materials, inputs.ground.materials());
  glPatchParameteri(GL_PATCH_VERTICES, 1);
  glBindVertexArray(vertex_array_.id());
  for (size_t i = 0; i < classified.places().size(); ++i) {
    const StreamPlace& place = classified.places()[i];
    const FeedbackPass& pass = classified.pass(place.pass);
    set_stream(vertex_array_, pass.stream(place.stream));
    for (const Pass& each : passes_[size_t(place.species)]) {
      const GLuint program = programs_[wind != nullptr ? each.blown : each.program].id();
      glUseProgram(program);
      if (each.mesh != 0) glBindTextureUnit(units.plant_mesh, each.mesh);
      glProgramUniform1i(program, k_species_location, place.species);
      if (each.images >= 0) glProgramUniform4fv(program, each.images, 1, &images_[size_t(place.species)].x);
      if (wind != nullptr && each.blown != each.program)
        glProgramUniform2fv(program, k_heights_location, 1, &heights_[size_t(place.species)].x);
      draw(each, pass, place.stream, draws_in_parts_ ? fertile[i] : 0);
    }
  }
  set_stream(vertex_array_, 0);
  gl::bind_uniforms(units.materials, 0);
  glBindVertexArray(0);
  glUseProgram(0);
}

size_t GrowthStage::gpu_bytes() const {
  size_t bytes =
      gl::storage_bytes(blade_shape_buffer_) + gl::storage_bytes(wind_shape_buffer_) + image_array_.gpu_bytes();
  for (const gl::Buffer& mesh : mesh_buffers_) bytes += gl::storage_bytes(mesh);
  return bytes;
}

}  // namespace sward
