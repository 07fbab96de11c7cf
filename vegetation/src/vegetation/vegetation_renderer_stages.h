// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// The stages of a VegetationRenderer: classification sorts clusters into feedback streams, growth draws the streams,
// reading back captures them. Each owns its program, vertex array and what it feeds.
#include <sward/gl/frame.h>
#include <sward/gl/ground.h>
#include <sward/gl/shader_library.h>
#include <sward/vegetation/plants.h>
#include <sward/vegetation/vegetation_renderer.h>
#include <sward/vegetation/wind_textures.h>
#include <functional>

#include "vegetation/placement_textures.h"
#include "vegetation/plant_image_array.h"
#include "vegetation/vegetation_renderer_buffers.h"

namespace sward {

/// Where a growing species' clusters are fed back to.
struct StreamPlace {
  int species;  ///< Index in the layer.
  int pass, stream;
};

/// Species that grow, in the layer's order, four a pass.
std::vector<StreamPlace> place_species(const Layer& layer);

/// Shoots of each plant that a patch can grow, for kinds made of shoots.
int shoots_per_patch(const Layer& layer);

/// Defines of every program of a layer; `wind`: of those that grow plants which move.
std::vector<gl::Define> layer_defines(const Layer& layer, const gl::Bindings& bindings, bool wind = false);

/// Its species, and where each is fed back to. The layer's own parameters are the frame's: classify() writes them.
SpeciesBlock make_species_block(const Layer& layer);

/// What every stage reads in a frame.
struct StageInputs {
  const gl::Bindings& bindings;
  const gl::Frame& frame;
  const gl::GroundTextures& ground;
  const TriangleTextures& triangles;
  const PlacementTextures& placement;
  GLuint species;
};

/// Queries around one frame's stages. Results arrive frames later; nothing waits unless it is asked to.
class StageQueries {
 public:
  static StageQueries create(size_t streams);
  void begin_frame(uint32_t clusters_submitted);
  void begin_stream(const StreamPlace& place, size_t index);
  void end_stream(const StreamPlace& place);
  void begin_growth();
  void end_growth();
  bool ready() const;
  /// Blocks until the results are there.
  VegetationStats read() const;
  /// Clusters in each stream; blocks.
  std::vector<uint32_t> fertile() const;

 private:
  std::vector<gl::Query> written_, generated_;  ///< One a growing species.
  gl::Query primitives_;
  std::optional<gl::Query> fragments_;
  uint32_t clusters_submitted_ = 0;
  bool classified_ = false, drawn_ = false;
};

/// The draws of a classification: bins of the CPU's seeding, or, where `commands` is not 0, 32 commands in a buffer.
struct ClusterDraws {
  std::span<const DensityBin> bins;
  GLuint commands = 0;
  size_t offset = 0;
};

class ClassificationStage {
 public:
  static Expected<ClassificationStage> create(const Layer& layer, const gl::ShaderLibrary& shaders,
                                              const gl::Bindings& bindings);
  void reserve(size_t clusters);
  void run(const StageInputs& inputs, const ClusterDraws& draws, StageQueries& queries, GLuint restore_framebuffer);
  std::span<const StreamPlace> places() const { return places_; }
  const FeedbackPass& pass(int index) const { return passes_[size_t(index)]; }
  size_t gpu_bytes() const;

 private:
  void run_pass(int pass, const ClusterDraws& draws, StageQueries& queries);

  std::vector<StreamPlace> places_;
  std::vector<FeedbackPass> passes_;
  gl::Program program_;
  gl::VertexArray vertex_array_;
  gl::Framebuffer framebuffer_;
};

/// A vertex array whose one attribute is a fed-back cluster; set_stream chooses the buffer.
gl::VertexArray make_cluster_array();
void set_stream(const gl::VertexArray& array, GLuint buffer);

class GrowthStage {
 public:
  /// Fails where a program of sward's own does not build; a host's kind that does not is left out (faults()).
  static Expected<GrowthStage> create(const Layer& layer, const gl::ShaderLibrary& shaders,
                                      const gl::Bindings& bindings);
  /// Whether `run` needs the counts of clusters, which means waiting for classification.
  bool needs_counts() const { return draws_in_parts_; }
  /// `fertile`: clusters in each of the classification's streams; read only where needs_counts(). `wind`: null in still
  /// air, else after build_wind().
  void run(const StageInputs& inputs, const ClassificationStage& classified, std::span<const uint32_t> fertile,
           const WindTextures* wind);
  /// The programs and the table for plants that move, once; `layer`, `shaders` and `bindings` as created with.
  Expected<void> build_wind(const Layer& layer, const gl::ShaderLibrary& shaders, const gl::Bindings& bindings);
  const std::vector<Error>& faults() const { return faults_; }
  size_t gpu_bytes() const;

 private:
  /// A draw of a species' stream: a kind may take several.
  struct Pass {
    size_t program;
    GLsizei instances;  ///< Of each patch.
    GLsizei part;       ///< Most clusters in a draw, where draws go in parts.
    GLint images;       ///< Location of sward_images; -1: the program reads none.
    GLuint mesh = 0;    ///< Texture of its own mesh, 0: none.
    size_t blown = 0;   ///< Its program in wind, where that has been built; `program` where nothing of it moves.
  };
  Expected<void> add_species(const Layer& layer, const Species& species, const gl::ShaderLibrary& shaders,
                             const gl::Bindings& bindings);
  GLuint add_mesh(const Species& species);
  Expected<void> settle(Expected<void> built, const Species& species, std::vector<Pass>& passes);
  Expected<void> build_wind_of(const Layer& layer, const Species& species, std::span<Pass> passes,
                               const gl::ShaderLibrary& shaders, const gl::Bindings& bindings);
  Expected<size_t> program_row(const std::string& name, const std::function<Expected<gl::Program>()>& build);
  void draw(const Pass& pass, const FeedbackPass& feedback, int stream, uint32_t fertile) const;

  std::vector<gl::Program> programs_;
  std::vector<std::string> program_names_;  ///< What each was built of: species of the same share it.
  std::vector<std::vector<Pass>> passes_;   ///< By species; none of what is left out.
  std::vector<Error> faults_;
  std::vector<gl::Buffer> mesh_buffers_;
  std::vector<gl::Texture> meshes_;  ///< One a species of kind mesh.
  gl::Buffer blade_shape_buffer_;
  gl::Texture blade_shape_;
  gl::Buffer wind_shape_buffer_;
  gl::Texture wind_shape_;          ///< None until build_wind().
  std::vector<glm::vec2> heights_;  ///< By species: all year, metres.
  PlantImageArray image_array_;
  std::vector<glm::vec4> images_;  ///< By species: sward_images.
  gl::VertexArray vertex_array_;
  bool draws_in_parts_ = false;
};

class ReadBackStage {
 public:
  static Expected<ReadBackStage> create(const Layer& layer, const gl::ShaderLibrary& shaders,
                                        const gl::Bindings& bindings);
  /// `fertile`: clusters in each of the classification's streams.
  std::vector<Plant> run(const StageInputs& inputs, const ClassificationStage& classified,
                         std::span<const uint32_t> fertile, const View& view, const Seeding& seeding,
                         GLuint restore_framebuffer);

 private:
  gl::Program program_;
  gl::VertexArray vertex_array_;
  gl::Feedback feedback_;
  gl::Framebuffer framebuffer_;
  int cluster_size_ = 1;
  bool on_mesh_ = false;
};

/// For drawing without a picture: no attachments, 1 x 1.
gl::Framebuffer make_empty_framebuffer();

}  // namespace sward
