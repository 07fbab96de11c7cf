// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth: every stream drawn by its kind's own tessellation, geometry and fragment programs.
#include <sward/vegetation/blade_shape.h>
#include <algorithm>

#include "vegetation/vegetation_renderer_stages.h"

namespace sward {

namespace {

constexpr GLint k_species_location = 0;

/// How a kind of plant is grown: its shader files. A further kind is a further row.
struct KindProgram {
  PlantKind kind;
  const char *name, *vertex, *tess_control, *tess_evaluation, *geometry, *fragment;
};
constexpr std::array<KindProgram, 1> k_kinds{{
    {PlantKind::blade, "grass_blade", "grow.vert.glsl", "grass_blade.tesc.glsl", "grass_blade.tese.glsl",
     "grass_blade.geom.glsl", "grass_blade.frag.glsl"},
}};

size_t row_of(PlantKind kind) {
  const auto row = std::find_if(k_kinds.begin(), k_kinds.end(), [&](const KindProgram& k) { return k.kind == kind; });
  return size_t(row - k_kinds.begin());
}

/// A buffer texture, so that no pixel-store state of the host meddles with it.
void attach_shapes(const BladeShapes& shapes, gl::Buffer& buffer, gl::Texture& texture) {
  buffer = make_buffer(shapes.texels.size() * sizeof(glm::vec4), shapes.texels.data(), 0);
  texture = gl::create_texture(GL_TEXTURE_BUFFER);
  glTextureBuffer(texture.id(), GL_RGBA32F, buffer.id());
}

/// Mesa's software tessellator numbers the points of a draw with 16 bits: beyond that, lines are drawn again in place of
/// those that follow. The most clusters of a species whose points still have a number each; odd spacing adds up to two
/// segments, a line one point.
GLsizei part_of(const Layer& layer, const Species& species) {
  const int points = layer.cluster_size * (species.max_segments + 3);
  return std::max(0xffff / points, 1);
}

void draw_parts(GLsizei clusters, GLsizei part) {
  for (GLsizei first = 0; first < clusters; first += part)
    glDrawArrays(GL_PATCHES, first, std::min(part, clusters - first));
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
  stage.programs_.resize(k_kinds.size());
  for (const Species& species : layer.species) {
    const size_t row = row_of(species.kind);
    stage.program_of_.push_back(row);
    stage.part_.push_back(part_of(layer, species));
    if (species.kind == PlantKind::none || stage.programs_[row]) continue;
    const KindProgram& kind = k_kinds[row];
    auto program = shaders.build({.name = kind.name,
                                  .vertex = kind.vertex,
                                  .tess_control = kind.tess_control,
                                  .tess_evaluation = kind.tess_evaluation,
                                  .geometry = kind.geometry,
                                  .fragment = kind.fragment,
                                  .defines = layer_defines(layer, bindings),
                                  .feedback_varyings = {}});
    if (!program) return tl::unexpected(program.error());
    stage.programs_[row] = std::move(*program);
  }
  auto shapes = make_blade_shapes();
  if (!shapes) return tl::unexpected(shapes.error());
  attach_shapes(*shapes, stage.blade_shape_buffer_, stage.blade_shape_);
  stage.vertex_array_ = make_cluster_array();
  return stage;
}

void GrowthStage::run(const StageInputs& inputs, const ClassificationStage& classified,
                      std::span<const uint32_t> fertile) {
  const gl::Bindings& units = inputs.bindings;
  const StageBindings bound(units, inputs.frame.buffer(), inputs.species,
                            {{units.base_map, inputs.ground.base_map()},
                             {units.base_map_raw, inputs.placement.map()},
                             {units.triangles, inputs.triangles.records()},
                             {units.surface, inputs.triangles.surface()},
                             {units.exclusions, inputs.triangles.exclusions()},
                             {units.placement, inputs.placement.masks()},
                             {units.blade_shape, blade_shape_.id()}});
  glPatchParameteri(GL_PATCH_VERTICES, 1);
  glBindVertexArray(vertex_array_.id());
  for (size_t i = 0; i < classified.places().size(); ++i) {
    const StreamPlace& place = classified.places()[i];
    const FeedbackPass& pass = classified.pass(place.pass);
    const GLuint program = programs_[program_of_[size_t(place.species)]].id();
    glUseProgram(program);
    glProgramUniform1i(program, k_species_location, place.species);
    set_stream(vertex_array_, pass.stream(place.stream));
    if (draws_in_parts_) {
      draw_parts(GLsizei(fertile[i]), part_[size_t(place.species)]);
    } else {
      glDrawTransformFeedbackStream(GL_PATCHES, pass.id(), GLuint(place.stream));
    }
  }
  set_stream(vertex_array_, 0);
  glBindVertexArray(0);
  glUseProgram(0);
}

}  // namespace sward
