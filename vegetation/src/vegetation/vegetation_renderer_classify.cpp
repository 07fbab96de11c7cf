// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Classification: instanced clusters in, a feedback stream a species out (Papavasiliou 2015, sections 3.2 and 3.5).
#include <sward/vegetation/blade_shape.h>
#include <algorithm>

#include "vegetation/vegetation_renderer_stages.h"

namespace sward {

namespace {

constexpr GLint k_first_growing_location = 0;

/// Clusters of a draw, about. An instanced draw goes over all of its triangles before it comes to the next cluster, so
/// that large ones would undo the order from near to far.
constexpr uint32_t k_clusters_a_draw = 1024;

void draw_bin(const DensityBin& bin) {
  const uint32_t step = std::max(k_clusters_a_draw / bin.clusters, 1u);
  for (uint32_t done = 0; done < bin.triangles; done += step)
    glDrawArraysInstanced(GL_POINTS, GLint(bin.first + done), GLsizei(std::min(step, bin.triangles - done)),
                          GLsizei(bin.clusters));
}

}  // namespace

std::vector<StreamPlace> place_species(const Layer& layer) {
  std::vector<StreamPlace> places;
  for (int species = 0; species < int(layer.species.size()); ++species) {
    if (layer.species[size_t(species)].kind == PlantKind::none) continue;
    const int ordinal = int(places.size());
    places.push_back({species, ordinal / k_streams, ordinal % k_streams});
  }
  return places;
}

SpeciesBlock make_species_block(const Layer& layer) {
  SpeciesBlock block;
  const std::vector<shared::SpeciesParams> params = make_species_params(layer);
  std::copy(params.begin(), params.end(), block.species.begin());
  for (const StreamPlace& place : place_species(layer))
    block.species[size_t(place.species)].kind.w = float(place.pass * k_streams + place.stream);
  return block;
}

int shoots_per_patch(const Layer& layer) {
  constexpr int k_most_lines = 64;  // of a patch, GL's own limit
  return std::min(k_most_lines / layer.cluster_size, k_most_shoots);
}

std::vector<gl::Define> layer_defines(const Layer& layer, const gl::Bindings& bindings, bool wind) {
  std::vector<gl::Define> defines = gl::binding_defines(bindings);
  defines.push_back({"SWARD_CLUSTER_SIZE", std::to_string(layer.cluster_size)});
  defines.push_back({"SWARD_BLADE_COLUMNS", std::to_string(k_blade_columns)});
  defines.push_back({"SWARD_BLADE_ROWS", std::to_string(k_blade_rows)});
  defines.push_back({"SWARD_MOST_SHOOTS", std::to_string(k_most_shoots)});
  defines.push_back({"SWARD_SHOOTS_PER_PATCH", std::to_string(shoots_per_patch(layer))});
  // The second invocation of the geometry shader is the shadow.
  defines.push_back({"SWARD_GROWTH_INVOCATIONS", layer.shadows && !layer.on_mesh ? "2" : "1"});
  defines.push_back({"SWARD_ON_MESH", layer.on_mesh ? "1" : "0"});
  defines.push_back({"SWARD_WIND", wind ? "1" : "0"});
  defines.push_back({"SWARD_WIND_LAYERS", std::to_string(k_wind_layers)});
  defines.push_back({"SWARD_CALM_LAYER", std::to_string(k_calm_layer)});
  return defines;
}

gl::Framebuffer make_empty_framebuffer() {
  gl::Framebuffer framebuffer = gl::create_framebuffer();
  glNamedFramebufferParameteri(framebuffer.id(), GL_FRAMEBUFFER_DEFAULT_WIDTH, 1);
  glNamedFramebufferParameteri(framebuffer.id(), GL_FRAMEBUFFER_DEFAULT_HEIGHT, 1);
  return framebuffer;
}

Expected<ClassificationStage> ClassificationStage::create(const Layer& layer, const gl::ShaderLibrary& shaders,
                                                          const gl::Bindings& bindings) {
  auto program = shaders.build({.name = "classify",
                                .vertex = "classify.vert.glsl",
                                .tess_control = {},
                                .tess_evaluation = {},
                                .geometry = "classify.geom.glsl",
                                .fragment = {},
                                .defines = layer_defines(layer, bindings),
                                .feedback_varyings = {}});
  if (!program) return tl::unexpected(program.error());
  ClassificationStage stage;
  stage.places_ = place_species(layer);
  stage.program_ = std::move(*program);
  stage.vertex_array_ = gl::create_vertex_array();
  stage.framebuffer_ = make_empty_framebuffer();
  for (int left = int(stage.places_.size()); left > 0; left -= k_streams)
    stage.passes_.push_back(FeedbackPass::create(std::min(left, k_streams)));
  return stage;
}

void ClassificationStage::reserve(size_t clusters) {
  for (FeedbackPass& pass : passes_) pass.reserve(clusters);
}

void ClassificationStage::run(const StageInputs& inputs, const ClusterDraws& draws, StageQueries& queries,
                              GLuint restore_framebuffer) {
  const gl::Bindings& units = inputs.bindings;
  const StageBindings bound(units, inputs.frame.buffer(), inputs.species,
                            {{units.base_map_raw, inputs.placement.map()},
                             {units.triangles, inputs.triangles.records()},
                             {units.surface, inputs.triangles.surface()},
                             {units.exclusions, inputs.triangles.exclusions()},
                             {units.placement, inputs.placement.masks()}});
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_.id());
  glEnable(GL_RASTERIZER_DISCARD);
  glUseProgram(program_.id());
  glBindVertexArray(vertex_array_.id());
  if (draws.commands != 0) glBindBuffer(GL_DRAW_INDIRECT_BUFFER, draws.commands);
  for (int pass = 0; pass < int(passes_.size()); ++pass) run_pass(pass, draws, queries);
  if (draws.commands != 0) glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
  glBindVertexArray(0);
  glUseProgram(0);
  glDisable(GL_RASTERIZER_DISCARD);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, restore_framebuffer);
}

void ClassificationStage::run_pass(int pass, const ClusterDraws& draws, StageQueries& queries) {
  const size_t first = size_t(pass) * k_streams;
  const size_t last = std::min(first + k_streams, places_.size());
  glProgramUniform1i(program_.id(), k_first_growing_location, GLint(first));
  glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, passes_[size_t(pass)].id());
  for (size_t i = first; i < last; ++i) queries.begin_stream(places_[i], i);
  glBeginTransformFeedback(GL_POINTS);
  if (draws.commands != 0)
    glMultiDrawArraysIndirect(GL_POINTS, reinterpret_cast<const void*>(draws.offset), k_density_bins, 0);
  for (const DensityBin& bin : draws.bins)
    if (bin.clusters > 0) draw_bin(bin);
  glEndTransformFeedback();
  for (size_t i = first; i < last; ++i) queries.end_stream(places_[i]);
  glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, 0);
}

size_t ClassificationStage::gpu_bytes() const {
  size_t bytes = 0;
  for (const FeedbackPass& pass : passes_) bytes += pass.gpu_bytes();
  return bytes;
}

}  // namespace sward
