// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What the stages of growth cost: the same blades by tessellation and geometry shaders, as the library grows them, and
// by a compute shader that expands them and a vertex shader that pulls them; in one colour, so that shading has no say.
// Needs a GPU that can time itself.
//   bench_growth [SCENE.toml]     default: the setting of the 2015 paper; its blades and no other kind
#include <sward/scene/scene.h>
#include <sward/terrain_gl/terrain_renderer.h>
#include <sward/vegetation/blade_shape.h>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <string>

#include "host/egl_context.h"
#include "host/flight.h"
#include "host/gpu_timer.h"
#include "host/render_target.h"
#include "host/scene_frame.h"
#include "vegetation/vegetation_renderer_stages.h"

namespace sward {
namespace {

constexpr int k_lists = 8;  // 1, 3, .. 15 segments and more
constexpr int k_repeats = 15;
constexpr glm::ivec2 k_size(1920, 1080);

template <class T>
T need(Expected<T> value) {
  if (value) return std::move(*value);
  std::fprintf(stderr, "bench_growth: %s\n", value.error().message.c_str());
  std::exit(1);
}
void need(Expected<void> done) {
  if (done) return;
  std::fprintf(stderr, "bench_growth: %s\n", done.error().message.c_str());
  std::exit(1);
}

std::string read_file(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

gl::ShaderLibrary library() {
  gl::ShaderLibrary shaders;
  shaders.add_source("plant_kind.glsl", "#include \"kind_blade.glsl\"\n");
  for (const char* name : {"expand.comp.glsl", "pull.vert.glsl", "flat_pull.frag.glsl", "flat_strip.frag.glsl"})
    shaders.add_source(name, read_file(std::filesystem::path(SWARD_BENCH_SHADERS) / name));
  return shaders;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// Segments of list i.
int segments_of(int list) {
  return 2 * list + 1;
}

/// Triangles of `blades` strips, the last segment one triangle.
std::vector<uint32_t> strip_indices(int segments, uint32_t blades) {
  std::vector<uint32_t> indices;
  indices.reserve(size_t(6 * segments - 3) * blades);
  for (uint32_t blade = 0; blade < blades; ++blade) {
    const uint32_t first = blade * uint32_t(2 * (segments + 1));
    for (int i = 0; i < segments; ++i) {
      const uint32_t at = first + uint32_t(2 * i);
      indices.insert(indices.end(), {at, at + 1, at + 2});
      if (i + 1 < segments) indices.insert(indices.end(), {at + 2, at + 1, at + 3});
    }
  }
  return indices;
}

struct DrawCommand {
  uint32_t count = 0, instances = 1, first_index = 0;
  int32_t base_vertex = 0;
  uint32_t base_instance = 0;
};

/// Everything of a frame up to the fed-back clusters.
struct Prepared {
  const Layer& layer;
  host::SceneFrame& cpu;
  gl::Frame& frame;
  gl::GroundTextures& ground;
  TerrainRenderer& terrain;
  ClassificationStage& classification;
  TriangleBuffers& triangles;
  PlacementTextures& placement;
  gl::Buffer species;
  gl::Buffer shapes;
  gl::Texture shape_texture;
  StageQueries queries;
  std::vector<uint32_t> fertile;
  TriangleTextures textures;

  StageInputs inputs(const gl::Bindings& bindings) const {
    return {bindings, frame, ground, textures, placement, species.id()};
  }
};

void prepare(Prepared& p, const Scene& scene, const host::SceneTerrain& terrain, const View& view, int samples,
             GLuint framebuffer) {
  static const gl::Bindings bindings;
  need(p.cpu.mesh().update(view, 0.0));
  p.terrain.upload(p.cpu.mesh());
  p.cpu.cut_triangles(view);
  p.cpu.seed_triangles(view, terrain.colors());
  const host::LayerFrame& layer = p.cpu.layers()[0];
  need(p.triangles.write(layer.seeding.records, layer.triangles.nodes(), layer.seeding.exclusions));
  p.textures = TriangleTextures(p.triangles);
  p.frame.upload(view, gl::Lighting::clear_day(scene.sun_azimuth, scene.sun_elevation), 0.0, samples);
  const MapGeometry map = classification_map(p.layer, {p.ground.map_size(), p.ground.texels()});
  p.placement.follow(p.layer, map, p.ground.base_map_raw());
  const shared::LayerParams params = make_layer_params(p.layer, view, map, 0.0f);
  glNamedBufferSubData(p.species.id(), 0, sizeof params, &params);
  p.classification.reserve(layer.seeding.clusters);
  p.queries.begin_frame(layer.seeding.clusters);
  p.classification.run(p.inputs(bindings), {.bins = layer.seeding.bins}, p.queries, framebuffer);
  p.fertile = p.queries.fertile();
}

struct Programs {
  gl::Program tessellated, expanded, counted, pulled;
};

Programs build(const Layer& layer, const gl::Bindings& bindings) {
  const gl::ShaderLibrary shaders = library();
  std::vector<gl::Define> defines = layer_defines(layer, bindings);
  defines.push_back({"SWARD_LISTS", std::to_string(k_lists)});
  std::vector<gl::Define> plain = defines, counted = defines;
  plain.push_back({"SWARD_COUNTED", "0"});
  counted.push_back({"SWARD_COUNTED", "1"});
  // As growth's own programs are; nothing of the light is read here.
  defines.push_back({"SWARD_LIT_AT_VERTICES", "1"});
  gl::ProgramDesc blades{.name = "tessellated",
                         .vertex = "grow.vert.glsl",
                         .tess_control = "grass_blade.tesc.glsl",
                         .tess_evaluation = "grass_blade.tese.glsl",
                         .geometry = "grass_blade.geom.glsl",
                         .fragment = "flat_strip.frag.glsl",
                         .defines = defines,
                         .feedback_varyings = {}};
  gl::ProgramDesc expand, count, pull;
  expand.name = "expand";
  expand.compute = "expand.comp.glsl";
  expand.defines = plain;
  count = expand;
  count.name = "count";
  count.defines = counted;
  pull.name = "pull";
  pull.vertex = "pull.vert.glsl";
  pull.fragment = "flat_pull.frag.glsl";
  pull.defines = defines;
  return {need(shaders.build(blades)), need(shaders.build(expand)), need(shaders.build(count)),
          need(shaders.build(pull))};
}

/// Lists of blades, their draws and the indices of their strips.
struct Lists {
  uint32_t size = 0;
  gl::Buffer blades, draws, counts;
  std::array<gl::Buffer, k_lists> indices;
  std::array<gl::VertexArray, k_lists> arrays;  // no attributes: the strips' indices alone

  void reserve(uint32_t needed, int longest) {
    if (needed <= size) return;
    size = needed + needed / 4;
    blades = make_buffer(size_t(k_lists) * size * 4 * sizeof(glm::vec4), nullptr, 0);
    draws = make_buffer(k_lists * sizeof(DrawCommand), nullptr, GL_DYNAMIC_STORAGE_BIT);
    counts = make_buffer(5 * sizeof(uint32_t), nullptr, GL_DYNAMIC_STORAGE_BIT);
    for (int list = 0; list < k_lists && segments_of(list) <= longest; ++list) {
      const std::vector<uint32_t> strip = strip_indices(segments_of(list), size);
      indices[size_t(list)] = make_buffer(strip.size() * sizeof(uint32_t), strip.data(), 0);
      arrays[size_t(list)] = gl::create_vertex_array();
      glVertexArrayElementBuffer(arrays[size_t(list)].id(), indices[size_t(list)].id());
    }
  }
};

class Ways {
 public:
  Ways(Prepared& prepared, const gl::Bindings& bindings)
      : p_(prepared), bindings_(bindings), programs_(build(prepared.layer, bindings)), array_(make_cluster_array()) {
    for (const Species& species : p_.layer.species) longest_ = std::max(longest_, species.max_segments | 1);
    uint32_t most = 0;
    for (const uint32_t clusters : p_.fertile) most = std::max(most, clusters);
    lists_.reserve(most * uint32_t(p_.layer.cluster_size) * 2, longest_);
  }

  void tessellate() {
    each_species([&](const StreamPlace& place, uint32_t) {
      const FeedbackPass& pass = p_.classification.pass(place.pass);
      glPatchParameteri(GL_PATCH_VERTICES, 1);
      glBindVertexArray(array_.id());
      set_stream(array_, pass.stream(place.stream));
      use(programs_.tessellated, place);
      glProgramUniform4f(programs_.tessellated.id(), 1, -1, 0, 0, -1);  // no images
      glDrawTransformFeedbackStream(GL_PATCHES, pass.id(), GLuint(place.stream));
    });
  }

  /// A list of one species at a time: expanded, then drawn. `parts`: 1 expands, 2 draws, 3 both.
  void expand(int parts, bool counted = false) {
    each_species([&](const StreamPlace& place, uint32_t clusters) {
      if (clusters == 0) return;
      lists_.reserve(clusters * uint32_t(p_.layer.cluster_size), longest_);
      if (parts & 1) run_expansion(place, clusters, counted);
      if (parts & 2) pull();
    });
  }

  std::array<uint32_t, 5> count() {
    const std::array<uint32_t, 5> zero{};
    glNamedBufferSubData(lists_.counts.id(), 0, sizeof zero, zero.data());
    expand(1, true);
    std::array<uint32_t, 5> counts{};
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(lists_.counts.id(), 0, sizeof counts, counts.data());
    return counts;
  }

 private:
  template <class Body>
  void each_species(Body&& body) {
    const StageInputs inputs = p_.inputs(bindings_);
    const StageBindings bound(bindings_, inputs.frame.buffer(), inputs.species,
                              {{bindings_.base_map, inputs.ground.base_map()},
                               {bindings_.base_map_raw, inputs.placement.map()},
                               {bindings_.triangles, inputs.triangles.records()},
                               {bindings_.surface, inputs.triangles.surface()},
                               {bindings_.exclusions, inputs.triangles.exclusions()},
                               {bindings_.placement, inputs.placement.masks()},
                               {bindings_.blade_shape, p_.shape_texture.id()}});
    for (size_t i = 0; i < p_.classification.places().size(); ++i) body(p_.classification.places()[i], p_.fertile[i]);
    glBindVertexArray(0);
    glUseProgram(0);
  }

  void use(const gl::Program& program, const StreamPlace& place) {
    glUseProgram(program.id());
    glProgramUniform1i(program.id(), 0, place.species);
  }

  void run_expansion(const StreamPlace& place, uint32_t clusters, bool counted) {
    std::array<DrawCommand, k_lists> none;
    glNamedBufferSubData(lists_.draws.id(), 0, sizeof none, none.data());
    const gl::Program& program = counted ? programs_.counted : programs_.expanded;
    use(program, place);
    glProgramUniform1ui(program.id(), 1, clusters);
    glProgramUniform1ui(program.id(), 2, lists_.size);
    const GLuint stream = p_.classification.pass(place.pass).stream(place.stream);
    const GLuint buffers[4] = {stream, lists_.draws.id(), lists_.blades.id(), lists_.counts.id()};
    glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, 0, 4, buffers);
    glDispatchCompute((clusters * GLuint(p_.layer.cluster_size) + 63) / 64, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
  }

  void pull() {
    // Without the species' index: this program has no such uniform, and its location may be a sampler's.
    glUseProgram(programs_.pulled.id());
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, lists_.draws.id());
    for (int list = 0; list < k_lists && segments_of(list) <= longest_; ++list) {
      glBindVertexArray(lists_.arrays[size_t(list)].id());
      for (int shadow = 0; shadow < (p_.layer.shadows ? 2 : 1); ++shadow) {
        glProgramUniform4i(programs_.pulled.id(), 1, segments_of(list), list * GLint(lists_.size), shadow, 0);
        glDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT,
                               reinterpret_cast<const void*>(size_t(list) * sizeof(DrawCommand)));
      }
    }
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
  }

  Prepared& p_;
  const gl::Bindings& bindings_;
  Programs programs_;
  gl::VertexArray array_;
  Lists lists_;
  int longest_ = 1;
};

struct Cost {
  double ms = 0, triangles = 0, fragments = 0;
};

/// One way, over terrain that has just been drawn; the median of several times.
Cost measure(host::RenderTarget& target, const std::function<void()>& before, bool rasterised,
             const std::function<void()>& way) {
  gl::Query triangles = gl::create_query(GL_PRIMITIVES_GENERATED), fragments = gl::name_query();
  Cost cost;
  std::vector<double> times;
  for (int i = 0; i < k_repeats; ++i) {
    target.begin();
    before();
    host::GpuTimer timer(true);
    if (!rasterised) glEnable(GL_RASTERIZER_DISCARD);
    if (i == 0) {
      glBeginQuery(GL_PRIMITIVES_GENERATED, triangles.id());
      glBeginQuery(GL_FRAGMENT_SHADER_INVOCATIONS_ARB, fragments.id());
      way();
      glEndQuery(GL_FRAGMENT_SHADER_INVOCATIONS_ARB);
      glEndQuery(GL_PRIMITIVES_GENERATED);
    } else {
      timer.begin();
      way();
      timer.end();
      times.push_back(timer.milliseconds(true).value_or(0.0));
    }
    glDisable(GL_RASTERIZER_DISCARD);
  }
  GLuint64 value = 0;
  glGetQueryObjectui64v(triangles.id(), GL_QUERY_RESULT, &value);
  cost.triangles = double(value);
  glGetQueryObjectui64v(fragments.id(), GL_QUERY_RESULT, &value);
  cost.fragments = double(value);
  cost.ms = median(std::move(times));
  return cost;
}

void print_counts(const std::vector<std::array<uint32_t, 5>>& counts, const std::vector<uint32_t>& submitted,
                  const std::vector<uint32_t>& fertile) {
  const auto middle = [&](size_t what) {
    std::vector<double> values;
    for (const auto& each : counts) values.push_back(each[what]);
    return median(std::move(values));
  };
  const auto of = [](const std::vector<uint32_t>& v) { return median(std::vector<double>(v.begin(), v.end())); };
  std::printf(
      "clusters submitted %.0f, fertile %.0f; their seeds %.0f: beyond the law's count %.0f, too small or out of "
      "sight %.0f, on other ground %.0f, grown %.0f\n",
      of(submitted), of(fertile), middle(0), middle(1), middle(2), middle(3), middle(4));
}

int run(const std::string& path) {
  auto context = need(host::EglContext::create(false));
  std::printf("%s\n", reinterpret_cast<const char*>(glGetString(GL_RENDERER)));
  if (gl::software_renderer()) {
    std::fprintf(stderr, "bench_growth: this driver cannot time the GPU\n");
    return 1;
  }
  Scene scene = need(load_scene(path));
  std::erase_if(scene.layers, [](const Layer& layer) {
    return std::any_of(layer.species.begin(), layer.species.end(),
                       [](const Species& s) { return s.kind != PlantKind::none && s.kind != PlantKind::blade; });
  });
  if (scene.layers.empty()) need(Expected<void>(fail(path + " has no layer of blades alone")));
  scene.layers.resize(1);
  const Layer& layer = scene.layers[0];
  const gl::Bindings bindings;
  const auto terrain = need(host::load_terrain(scene, true));
  RoamOptions roam;
  roam.max_triangles = scene.max_triangles;
  auto cpu = need(host::SceneFrame::create(scene.layers, *terrain, roam));
  auto frame = need(gl::Frame::create(bindings));
  auto ground = need(terrain->make_textures());
  const gl::ShaderLibrary shaders;
  auto terrain_renderer = need(TerrainRenderer::create(shaders, bindings));
  auto classification = need(ClassificationStage::create(layer, shaders, bindings));
  auto placement = need(PlacementTextures::create(layer));
  auto triangles = TriangleBuffers::create();
  const SpeciesBlock block = make_species_block(layer);
  const BladeShapes shapes = need(make_blade_shapes());
  Prepared prepared{layer,
                    cpu,
                    frame,
                    ground,
                    terrain_renderer,
                    classification,
                    triangles,
                    placement,
                    make_buffer(sizeof block, &block, GL_DYNAMIC_STORAGE_BIT),
                    make_buffer(shapes.texels.size() * sizeof(glm::vec4), shapes.texels.data(), 0),
                    gl::create_texture(GL_TEXTURE_BUFFER),
                    StageQueries::create(classification.places().size()),
                    {},
                    {}};
  glTextureBuffer(prepared.shape_texture.id(), GL_RGBA32F, prepared.shapes.id());

  host::FlightOptions options;
  options.fps = 1;
  options.viewport = k_size;
  options.far_plane = host::far_plane_m(terrain->surface());
  const auto path_frames = need(host::paper_flight(terrain->surface(), 20, options));
  std::vector<std::array<uint32_t, 5>> counts;
  std::vector<uint32_t> submitted, fertile;
  for (const int samples : {8, 1}) {
    if (samples > host::RenderTarget::max_samples()) continue;
    auto target = need(host::RenderTarget::create(k_size, samples));
    std::map<std::string, std::vector<Cost>> costs;
    for (size_t at = 11; at < path_frames.size(); ++at) {
      const View& view = path_frames[at].view;
      prepare(prepared, scene, *terrain, view, samples, target.framebuffer());
      Ways ways(prepared, bindings);
      const auto before = [&] { prepared.terrain.draw(view, frame, ground); };
      if (samples == 8) {
        counts.push_back(ways.count());
        submitted.push_back(cpu.layers()[0].seeding.clusters);
        uint32_t sum = 0;
        for (const uint32_t each : prepared.fertile) sum += each;
        fertile.push_back(sum);
      }
      costs["1 tessellated, drawn"].push_back(measure(target, before, true, [&] { ways.tessellate(); }));
      costs["2 tessellated, not rasterised"].push_back(measure(target, before, false, [&] { ways.tessellate(); }));
      costs["3 expanded and pulled, drawn"].push_back(measure(target, before, true, [&] { ways.expand(3); }));
      costs["4 expanded and pulled, not rasterised"].push_back(measure(target, before, false, [&] { ways.expand(3); }));
      costs["5 expanded alone"].push_back(measure(target, before, false, [&] { ways.expand(1); }));
    }
    for (const auto& [name, each] : costs) {
      std::vector<double> ms, drawn, runs;
      for (const Cost& cost : each) {
        ms.push_back(cost.ms);
        drawn.push_back(cost.triangles);
        runs.push_back(cost.fragments);
      }
      std::printf("%d samples  %-40s %7.3f ms  %9.0f triangles  %10.0f fragment runs\n", samples, name.c_str() + 2,
                  median(ms), median(drawn), median(runs));
    }
  }
  print_counts(counts, submitted, fertile);
  return 0;
}

}  // namespace
}  // namespace sward

int main(int argc, char** argv) {
  return sward::run(argc > 1 ? argv[1] : std::string(SWARD_BENCH_SCENES) + "/paper_2015.toml");
}
