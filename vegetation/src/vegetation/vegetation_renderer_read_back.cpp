// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Reading plants back: the growth stages' own seedlings, captured by transform feedback.
#include <algorithm>
#include <tuple>

#include "vegetation/vegetation_renderer_stages.h"

namespace sward {

namespace {

constexpr GLint k_species_location = 0;

/// As read_back.vert.glsl captures it.
struct CapturedPlant {
  uint32_t record, rank;
  glm::vec3 root;
  float height, width, stiffness, azimuth;
  float score, fade;
  uint32_t unused;
};
static_assert(sizeof(CapturedPlant) == 48);

TriangleId id_of(const TriangleRecord& record) {
  return {uint64_t(record.id_high) << 32 | record.id_low};
}

Plant to_plant(const CapturedPlant& captured, int species, const View& view, const Seeding& seeding, bool on_mesh) {
  const TriangleRecord& record = seeding.records[captured.record];
  Plant plant;
  plant.triangle = id_of(record);
  if (on_mesh) plant.axis = shared::triangle_normal(record.to_left, record.to_right);
  plant.rank = captured.rank;
  plant.species = uint32_t(species);
  plant.position = view.eye + glm::dvec3(captured.root);
  plant.height = captured.height;
  plant.width = captured.width;
  plant.stiffness = captured.stiffness;
  plant.azimuth = captured.azimuth;
  plant.score = captured.score;
  plant.fade = captured.fade;
  return plant;
}

struct FoundPlant {
  CapturedPlant captured;
  int species;
};

}  // namespace

Expected<ReadBackStage> ReadBackStage::create(const Layer& layer, const gl::ShaderLibrary& shaders,
                                              const gl::Bindings& bindings) {
  auto program = shaders.build({.name = "read_back",
                                .vertex = "read_back.vert.glsl",
                                .tess_control = {},
                                .tess_evaluation = {},
                                .geometry = {},
                                .fragment = {},
                                .defines = layer_defines(layer, bindings),
                                .feedback_varyings = {}});
  if (!program) return tl::unexpected(program.error());
  ReadBackStage stage;
  stage.program_ = std::move(*program);
  stage.vertex_array_ = make_cluster_array();
  stage.feedback_ = gl::create_feedback();
  stage.framebuffer_ = make_empty_framebuffer();
  stage.cluster_size_ = layer.cluster_size;
  stage.on_mesh_ = layer.on_mesh;
  return stage;
}

std::vector<Plant> ReadBackStage::run(const StageInputs& inputs, const ClassificationStage& classified,
                                      std::span<const uint32_t> fertile, const View& view, const Seeding& seeding,
                                      GLuint restore_framebuffer) {
  const gl::Bindings& units = inputs.bindings;
  const StageBindings bound(units, inputs.frame.buffer(), inputs.species,
                            {{units.base_map_raw, inputs.placement.map()},
                             {units.triangles, inputs.triangles.records()},
                             {units.surface, inputs.triangles.surface()},
                             {units.exclusions, inputs.triangles.exclusions()},
                             {units.placement, inputs.placement.masks()}},
                            inputs.triangles.clipmap());
  const DisturbedBindings disturbed(units, inputs.ground.disturbed());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_.id());
  glEnable(GL_RASTERIZER_DISCARD);
  glUseProgram(program_.id());
  glBindVertexArray(vertex_array_.id());
  glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, feedback_.id());

  std::vector<FoundPlant> found;
  for (size_t i = 0; i < fertile.size(); ++i) {
    if (fertile[i] == 0) continue;
    const StreamPlace& place = classified.places()[i];
    const FeedbackPass& pass = classified.pass(place.pass);
    std::vector<CapturedPlant> captured(size_t(fertile[i]) * size_t(cluster_size_));
    const gl::Buffer buffer = make_buffer(captured.size() * sizeof(CapturedPlant), nullptr, 0);
    glTransformFeedbackBufferBase(feedback_.id(), 0, buffer.id());
    glProgramUniform1i(program_.id(), k_species_location, place.species);
    set_stream(vertex_array_, pass.stream(place.stream));
    glBeginTransformFeedback(GL_POINTS);
    glDrawTransformFeedbackStreamInstanced(GL_POINTS, pass.id(), GLuint(place.stream), cluster_size_);
    glEndTransformFeedback();
    glGetNamedBufferSubData(buffer.id(), 0, GLsizeiptr(captured.size() * sizeof(CapturedPlant)), captured.data());
    glTransformFeedbackBufferBase(feedback_.id(), 0, 0);
    for (const CapturedPlant& each : captured)
      if (each.fade > 0) found.push_back({each, place.species});
  }
  set_stream(vertex_array_, 0);
  glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, 0);
  glBindVertexArray(0);
  glUseProgram(0);
  glDisable(GL_RASTERIZER_DISCARD);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, restore_framebuffer);

  // Records stand in the order of the bins.
  const auto key = [](const FoundPlant& f) { return std::tuple(f.captured.record, f.captured.rank); };
  std::sort(found.begin(), found.end(), [&](const FoundPlant& a, const FoundPlant& b) { return key(a) < key(b); });
  std::vector<Plant> plants;
  plants.reserve(found.size());
  for (const FoundPlant& each : found) plants.push_back(to_plant(each.captured, each.species, view, seeding, on_mesh_));
  return plants;
}

}  // namespace sward
