// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// All the state of a GL 4.5 context that can be asked for: poison, capture, compare.
#include <gtest/gtest.h>

#include <sward/gl/handles.h>
#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace sward::test {

/// Values by name.
using GlState = std::map<std::string, std::vector<double>>;

namespace gl_state {

struct Named {
  const char* name;
  GLenum parameter;
  int count = 1;
};

inline constexpr Named k_integers[] = {
    {"program", GL_CURRENT_PROGRAM},
    {"program pipeline", GL_PROGRAM_PIPELINE_BINDING},
    {"vertex array", GL_VERTEX_ARRAY_BINDING},
    {"draw framebuffer", GL_DRAW_FRAMEBUFFER_BINDING},
    {"read framebuffer", GL_READ_FRAMEBUFFER_BINDING},
    {"renderbuffer", GL_RENDERBUFFER_BINDING},
    {"transform feedback", GL_TRANSFORM_FEEDBACK_BINDING},
    {"array buffer", GL_ARRAY_BUFFER_BINDING},
    {"uniform buffer", GL_UNIFORM_BUFFER_BINDING},
    {"storage buffer", GL_SHADER_STORAGE_BUFFER_BINDING},
    {"atomic buffer", GL_ATOMIC_COUNTER_BUFFER_BINDING},
    {"indirect buffer", GL_DRAW_INDIRECT_BUFFER_BINDING},
    {"dispatch buffer", GL_DISPATCH_INDIRECT_BUFFER_BINDING},
    {"query buffer", GL_QUERY_BUFFER_BINDING},
    {"copy read buffer", GL_COPY_READ_BUFFER_BINDING},
    {"copy write buffer", GL_COPY_WRITE_BUFFER_BINDING},
    {"pack buffer", GL_PIXEL_PACK_BUFFER_BINDING},
    {"unpack buffer", GL_PIXEL_UNPACK_BUFFER_BINDING},
    {"texture buffer", GL_TEXTURE_BUFFER_BINDING},
    {"active texture", GL_ACTIVE_TEXTURE},
    {"patch vertices", GL_PATCH_VERTICES},
    {"restart index", GL_PRIMITIVE_RESTART_INDEX},
    {"provoking vertex", GL_PROVOKING_VERTEX},
    {"clip origin", GL_CLIP_ORIGIN},
    {"clip depth", GL_CLIP_DEPTH_MODE},
    {"depth function", GL_DEPTH_FUNC},
    {"depth mask", GL_DEPTH_WRITEMASK},
    {"stencil function", GL_STENCIL_FUNC},
    {"stencil reference", GL_STENCIL_REF},
    {"stencil value mask", GL_STENCIL_VALUE_MASK},
    {"stencil write mask", GL_STENCIL_WRITEMASK},
    {"stencil fail", GL_STENCIL_FAIL},
    {"stencil depth fail", GL_STENCIL_PASS_DEPTH_FAIL},
    {"stencil pass", GL_STENCIL_PASS_DEPTH_PASS},
    {"back stencil function", GL_STENCIL_BACK_FUNC},
    {"back stencil write mask", GL_STENCIL_BACK_WRITEMASK},
    {"clear stencil", GL_STENCIL_CLEAR_VALUE},
    {"cull face", GL_CULL_FACE_MODE},
    {"front face", GL_FRONT_FACE},
    {"polygon mode", GL_POLYGON_MODE},
    {"logic operation", GL_LOGIC_OP_MODE},
    {"clamp read color", GL_CLAMP_READ_COLOR},
    {"point sprite origin", GL_POINT_SPRITE_COORD_ORIGIN},
    {"line smooth hint", GL_LINE_SMOOTH_HINT},
    {"polygon smooth hint", GL_POLYGON_SMOOTH_HINT},
    {"derivative hint", GL_FRAGMENT_SHADER_DERIVATIVE_HINT},
    {"compression hint", GL_TEXTURE_COMPRESSION_HINT},
    {"debug groups", GL_DEBUG_GROUP_STACK_DEPTH},
};

/// As glPixelStorei takes them.
inline constexpr Named k_pixel_store[] = {
    {"unpack alignment", GL_UNPACK_ALIGNMENT},       {"unpack row length", GL_UNPACK_ROW_LENGTH},
    {"unpack image height", GL_UNPACK_IMAGE_HEIGHT}, {"unpack skip pixels", GL_UNPACK_SKIP_PIXELS},
    {"unpack skip rows", GL_UNPACK_SKIP_ROWS},       {"unpack skip images", GL_UNPACK_SKIP_IMAGES},
    {"unpack swap bytes", GL_UNPACK_SWAP_BYTES},     {"unpack least bit first", GL_UNPACK_LSB_FIRST},
    {"pack alignment", GL_PACK_ALIGNMENT},           {"pack row length", GL_PACK_ROW_LENGTH},
    {"pack image height", GL_PACK_IMAGE_HEIGHT},     {"pack skip pixels", GL_PACK_SKIP_PIXELS},
    {"pack skip rows", GL_PACK_SKIP_ROWS},           {"pack skip images", GL_PACK_SKIP_IMAGES},
    {"pack swap bytes", GL_PACK_SWAP_BYTES},         {"pack least bit first", GL_PACK_LSB_FIRST},
};
inline constexpr GLint k_poisoned_store[] = {8, 7, 5, 3, 2, 4, 1, 1};
inline constexpr GLint k_default_store[] = {4, 0, 0, 0, 0, 0, 0, 0};

inline constexpr Named k_numbers[] = {
    {"clear color", GL_COLOR_CLEAR_VALUE, 4},
    {"clear depth", GL_DEPTH_CLEAR_VALUE},
    {"blend color", GL_BLEND_COLOR, 4},
    {"line width", GL_LINE_WIDTH},
    {"point size", GL_POINT_SIZE},
    {"point fade", GL_POINT_FADE_THRESHOLD_SIZE},
    {"polygon offset factor", GL_POLYGON_OFFSET_FACTOR},
    {"polygon offset units", GL_POLYGON_OFFSET_UNITS},
    {"sample coverage", GL_SAMPLE_COVERAGE_VALUE},
    {"inverted coverage", GL_SAMPLE_COVERAGE_INVERT},
    {"sample shading share", GL_MIN_SAMPLE_SHADING_VALUE},
    {"outer levels", GL_PATCH_DEFAULT_OUTER_LEVEL, 4},
    {"inner levels", GL_PATCH_DEFAULT_INNER_LEVEL, 2},
};

inline constexpr Named k_capabilities[] = {
    {"depth test", GL_DEPTH_TEST},
    {"stencil test", GL_STENCIL_TEST},
    {"culling", GL_CULL_FACE},
    {"rasterizer discard", GL_RASTERIZER_DISCARD},
    {"alpha to coverage", GL_SAMPLE_ALPHA_TO_COVERAGE},
    {"alpha to one", GL_SAMPLE_ALPHA_TO_ONE},
    {"sample coverage test", GL_SAMPLE_COVERAGE},
    {"sample mask", GL_SAMPLE_MASK},
    {"sample shading", GL_SAMPLE_SHADING},
    {"multisample", GL_MULTISAMPLE},
    {"primitive restart", GL_PRIMITIVE_RESTART},
    {"fixed primitive restart", GL_PRIMITIVE_RESTART_FIXED_INDEX},
    {"framebuffer sRGB", GL_FRAMEBUFFER_SRGB},
    {"depth clamp", GL_DEPTH_CLAMP},
    {"polygon offset fill", GL_POLYGON_OFFSET_FILL},
    {"polygon offset line", GL_POLYGON_OFFSET_LINE},
    {"polygon offset point", GL_POLYGON_OFFSET_POINT},
    {"polygon smooth", GL_POLYGON_SMOOTH},
    {"line smooth", GL_LINE_SMOOTH},
    {"logic operations", GL_COLOR_LOGIC_OP},
    {"dither", GL_DITHER},
    {"program point size", GL_PROGRAM_POINT_SIZE},
    {"seamless cube maps", GL_TEXTURE_CUBE_MAP_SEAMLESS},
    {"debug output", GL_DEBUG_OUTPUT},
    {"synchronous debug output", GL_DEBUG_OUTPUT_SYNCHRONOUS},
};

inline constexpr Named k_texture_targets[] = {
    {"texture 1D ", GL_TEXTURE_BINDING_1D},
    {"texture 2D ", GL_TEXTURE_BINDING_2D},
    {"texture 3D ", GL_TEXTURE_BINDING_3D},
    {"texture cube ", GL_TEXTURE_BINDING_CUBE_MAP},
    {"texture 1D array ", GL_TEXTURE_BINDING_1D_ARRAY},
    {"texture 2D array ", GL_TEXTURE_BINDING_2D_ARRAY},
    {"texture cube array ", GL_TEXTURE_BINDING_CUBE_MAP_ARRAY},
    {"texture rectangle ", GL_TEXTURE_BINDING_RECTANGLE},
    {"texture buffer ", GL_TEXTURE_BINDING_BUFFER},
    {"texture multisample ", GL_TEXTURE_BINDING_2D_MULTISAMPLE},
    {"sampler ", GL_SAMPLER_BINDING},
};

inline GLint limit(GLenum name, GLint most) {
  GLint value = 0;
  glGetIntegerv(name, &value);
  return std::min(value, most);
}

/// Far more of each kind than sward uses; a hundred units would only take time.
inline GLint units() {
  return limit(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS, 48);
}
inline GLint uniform_buffers() {
  return limit(GL_MAX_UNIFORM_BUFFER_BINDINGS, 36);
}
inline GLint storage_buffers() {
  return limit(GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS, 16);
}
inline GLint image_units() {
  return limit(GL_MAX_IMAGE_UNITS, 8);
}
inline GLint draw_buffers() {
  return limit(GL_MAX_DRAW_BUFFERS, 8);
}
inline GLint viewports() {
  return limit(GL_MAX_VIEWPORTS, 16);
}
inline GLint clip_distances() {
  return limit(GL_MAX_CLIP_DISTANCES, 8);
}

inline void capture_indexed(GlState& state, const char* name, GLenum parameter, GLint count) {
  for (GLint i = 0; i < count; ++i) {
    GLint64 value = 0;
    glGetInteger64i_v(parameter, GLuint(i), &value);
    state[name + std::to_string(i)] = {double(value)};
  }
}

inline void capture_draw_buffers(GlState& state) {
  for (GLuint i = 0; i < GLuint(draw_buffers()); ++i) {
    const std::string number = std::to_string(i);
    GLint mask[4] = {};
    glGetIntegeri_v(GL_COLOR_WRITEMASK, i, mask);
    state["color mask " + number].assign(mask, mask + 4);
    state["blend " + number] = {double(glIsEnabledi(GL_BLEND, i))};
  }
  capture_indexed(state, "blend source ", GL_BLEND_SRC_RGB, draw_buffers());
  capture_indexed(state, "blend destination ", GL_BLEND_DST_RGB, draw_buffers());
  capture_indexed(state, "blend equation ", GL_BLEND_EQUATION_RGB, draw_buffers());
}

inline void capture_viewports(GlState& state) {
  for (GLuint i = 0; i < GLuint(viewports()); ++i) {
    const std::string number = std::to_string(i);
    GLfloat view[4] = {};
    GLint scissor[4] = {};
    GLdouble range[2] = {};
    glGetFloati_v(GL_VIEWPORT, i, view);
    glGetIntegeri_v(GL_SCISSOR_BOX, i, scissor);
    glGetDoublei_v(GL_DEPTH_RANGE, i, range);
    state["viewport " + number].assign(view, view + 4);
    state["scissor box " + number].assign(scissor, scissor + 4);
    state["depth range " + number].assign(range, range + 2);
    state["scissor test " + number] = {double(glIsEnabledi(GL_SCISSOR_TEST, i))};
  }
}

}  // namespace gl_state

inline GlState capture_state() {
  using namespace gl_state;
  GlState state;
  const auto integer = [&](const Named& named) {
    GLint values[16] = {};
    glGetIntegerv(named.parameter, values);
    state[named.name].assign(values, values + named.count);
  };
  for (const Named& named : k_integers) integer(named);
  for (const Named& named : k_pixel_store) integer(named);
  for (const Named& named : k_numbers) {
    GLfloat values[16] = {};
    glGetFloatv(named.parameter, values);
    state[named.name].assign(values, values + named.count);
  }
  for (const Named& named : k_capabilities) state[named.name] = {double(glIsEnabled(named.parameter))};
  for (GLint i = 0; i < clip_distances(); ++i)
    state["clip distance " + std::to_string(i)] = {double(glIsEnabled(GLenum(GL_CLIP_DISTANCE0 + i)))};
  for (const Named& named : k_texture_targets) capture_indexed(state, named.name, named.parameter, units());
  capture_indexed(state, "uniform buffer ", GL_UNIFORM_BUFFER_BINDING, uniform_buffers());
  capture_indexed(state, "uniform buffer start ", GL_UNIFORM_BUFFER_START, uniform_buffers());
  capture_indexed(state, "storage buffer ", GL_SHADER_STORAGE_BUFFER_BINDING, storage_buffers());
  capture_indexed(state, "image ", GL_IMAGE_BINDING_NAME, image_units());
  capture_indexed(state, "sample mask word ", GL_SAMPLE_MASK_VALUE, 1);
  capture_indexed(state, "feedback buffer ", GL_TRANSFORM_FEEDBACK_BUFFER_BINDING, 4);
  capture_draw_buffers(state);
  capture_viewports(state);
  return state;
}

/// How much of the state PoisonedState makes unusual.
enum class Poison {
  /// All that capture_state() sees.
  everything,
  /// What docs/integrate.md calls indifferent: pictures must be the same.
  indifferent,
};

/// Unusual state while it lives, the defaults afterwards.
class PoisonedState {
 public:
  explicit PoisonedState(Poison poison = Poison::indifferent) : all_(poison == Poison::everything) {
    make_objects();
    glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, feedback_.id());
    bind_all(buffer_.id(), sampler_);
    bind_textures();
    if (all_) glBindProgramPipeline(pipeline_);
    glUseProgram(program_.id());
    glBindVertexArray(vertex_array_.id());
    glBindRenderbuffer(GL_RENDERBUFFER, renderbuffer_);
    glActiveTexture(GL_TEXTURE5);
    store(gl_state::k_poisoned_store);
    glPatchParameteri(GL_PATCH_VERTICES, 5);
    const GLfloat levels[] = {3, 4, 5, 6};
    glPatchParameterfv(GL_PATCH_DEFAULT_OUTER_LEVEL, levels);
    glPatchParameterfv(GL_PATCH_DEFAULT_INNER_LEVEL, levels);
    glPrimitiveRestartIndex(1);
    glEnable(GL_PRIMITIVE_RESTART_FIXED_INDEX);
    glClearColor(0.25f, 0.5f, 0.75f, 0.125f);
    glClearDepth(0.375);
    glClearStencil(3);
    glBlendColor(0.1f, 0.2f, 0.3f, 0.4f);
    glPointSize(3);
    glPointParameterf(GL_POINT_FADE_THRESHOLD_SIZE, 2);
    glEnable(GL_PROGRAM_POINT_SIZE);
    glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    glClampColor(GL_CLAMP_READ_COLOR, GL_TRUE);
    glHint(GL_LINE_SMOOTH_HINT, GL_NICEST);
    glHint(GL_TEXTURE_COMPRESSION_HINT, GL_NICEST);
    if (all_) choose_for_the_host();
  }
  ~PoisonedState() {
    if (all_) choose_defaults();
    glDisable(GL_PRIMITIVE_RESTART_FIXED_INDEX);
    glPrimitiveRestartIndex(0);
    glDisable(GL_PROGRAM_POINT_SIZE);
    glDisable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    glClampColor(GL_CLAMP_READ_COLOR, GL_FIXED_ONLY);
    glHint(GL_LINE_SMOOTH_HINT, GL_DONT_CARE);
    glHint(GL_TEXTURE_COMPRESSION_HINT, GL_DONT_CARE);
    glBlendColor(0, 0, 0, 0);
    glPointSize(1);
    glPointParameterf(GL_POINT_FADE_THRESHOLD_SIZE, 1);
    glClearColor(0, 0, 0, 0);
    glClearDepth(1);
    glClearStencil(0);
    const GLfloat levels[] = {1, 1, 1, 1};
    glPatchParameterfv(GL_PATCH_DEFAULT_OUTER_LEVEL, levels);
    glPatchParameterfv(GL_PATCH_DEFAULT_INNER_LEVEL, levels);
    glPatchParameteri(GL_PATCH_VERTICES, 3);
    store(gl_state::k_default_store);
    bind_all(0, 0);
    glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, 0);
    for (GLint i = 0; i < gl_state::units(); ++i) glBindTextureUnit(GLuint(i), 0);
    for (GLint i = 0; i < gl_state::image_units(); ++i)
      glBindImageTexture(GLuint(i), 0, 0, GL_FALSE, 0, GL_READ_ONLY, GL_R8);
    glActiveTexture(GL_TEXTURE0);
    glBindVertexArray(0);
    glBindRenderbuffer(GL_RENDERBUFFER, 0);
    glUseProgram(0);
    glBindProgramPipeline(0);
    glDeleteSamplers(1, &sampler_);
    glDeleteRenderbuffers(1, &renderbuffer_);
    glDeleteProgramPipelines(1, &pipeline_);
  }
  PoisonedState(const PoisonedState&) = delete;
  PoisonedState& operator=(const PoisonedState&) = delete;

 private:
  static constexpr GLenum k_targets[] = {GL_TEXTURE_1D,
                                         GL_TEXTURE_2D,
                                         GL_TEXTURE_3D,
                                         GL_TEXTURE_CUBE_MAP,
                                         GL_TEXTURE_1D_ARRAY,
                                         GL_TEXTURE_2D_ARRAY,
                                         GL_TEXTURE_CUBE_MAP_ARRAY,
                                         GL_TEXTURE_RECTANGLE};

  void make_objects() {
    buffer_ = gl::create_buffer();
    glNamedBufferStorage(buffer_.id(), 4096, nullptr, GL_DYNAMIC_STORAGE_BIT);
    vertex_array_ = gl::create_vertex_array();
    feedback_ = gl::create_feedback();
    for (const GLenum target : k_targets) {
      const gl::Texture& texture = textures_.emplace_back(gl::create_texture(target));
      const bool flat = target == GL_TEXTURE_2D || target == GL_TEXTURE_CUBE_MAP || target == GL_TEXTURE_1D_ARRAY ||
                        target == GL_TEXTURE_RECTANGLE;
      if (target == GL_TEXTURE_1D) glTextureStorage1D(texture.id(), 1, GL_RGBA8, 1);
      if (flat) glTextureStorage2D(texture.id(), 1, GL_RGBA8, 1, 1);
      if (!flat && target != GL_TEXTURE_1D)
        glTextureStorage3D(texture.id(), 1, GL_RGBA8, 1, 1, target == GL_TEXTURE_CUBE_MAP_ARRAY ? 6 : 1);
    }
    gl::Texture& texels = textures_.emplace_back(gl::create_texture(GL_TEXTURE_BUFFER));
    glTextureBuffer(texels.id(), GL_RGBA8, buffer_.id());
    gl::Texture& samples = textures_.emplace_back(gl::create_texture(GL_TEXTURE_2D_MULTISAMPLE));
    glTextureStorage2DMultisample(samples.id(), 1, GL_RGBA8, 1, 1, GL_TRUE);
    glCreateSamplers(1, &sampler_);
    // A sampler that would show: no mip levels, another wrap, the nearest texel, compared.
    glSamplerParameteri(sampler_, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glSamplerParameteri(sampler_, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glSamplerParameteri(sampler_, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
    glSamplerParameteri(sampler_, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
    glCreateRenderbuffers(1, &renderbuffer_);
    glCreateProgramPipelines(1, &pipeline_);
    make_program();
  }
  void make_program() {
    program_ = gl::Program(glCreateProgram());
    const GLuint shader = glCreateShader(GL_VERTEX_SHADER);
    const char* const text = "#version 450 core\nvoid main() { gl_Position = vec4(0.0); }\n";
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    glAttachShader(program_.id(), shader);
    glLinkProgram(program_.id());
    glDeleteShader(shader);
  }
  /// Buffers and samplers everywhere.
  void bind_all(GLuint buffer, GLuint sampler) {
    constexpr GLenum k_buffers[] = {GL_ARRAY_BUFFER,      GL_UNIFORM_BUFFER,           GL_SHADER_STORAGE_BUFFER,
                                    GL_COPY_READ_BUFFER,  GL_COPY_WRITE_BUFFER,        GL_TEXTURE_BUFFER,
                                    GL_PIXEL_PACK_BUFFER, GL_PIXEL_UNPACK_BUFFER,      GL_DRAW_INDIRECT_BUFFER,
                                    GL_QUERY_BUFFER,      GL_DISPATCH_INDIRECT_BUFFER, GL_ATOMIC_COUNTER_BUFFER};
    for (GLint i = 0; i < gl_state::uniform_buffers(); ++i) glBindBufferBase(GL_UNIFORM_BUFFER, GLuint(i), buffer);
    for (GLint i = 0; i < gl_state::storage_buffers(); ++i)
      glBindBufferBase(GL_SHADER_STORAGE_BUFFER, GLuint(i), buffer);
    for (GLuint i = 0; i < 4; ++i) glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, i, buffer);
    for (GLint i = 0; i < gl_state::units(); ++i) glBindSampler(GLuint(i), sampler);
    for (const GLenum target : k_buffers) glBindBuffer(target, buffer);
  }
  /// One of each kind on every unit.
  void bind_textures() {
    for (GLint i = 0; i < gl_state::units(); ++i)
      for (const gl::Texture& texture : textures_) glBindTextureUnit(GLuint(i), texture.id());
    for (GLint i = 0; i < gl_state::image_units(); ++i)
      glBindImageTexture(GLuint(i), textures_[1].id(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA8);
  }
  static void store(const GLint (&values)[8]) {
    for (size_t i = 0; i < std::size(gl_state::k_pixel_store); ++i)
      glPixelStorei(gl_state::k_pixel_store[i].parameter, values[i % 8]);
  }

  static constexpr GLenum k_host_choices[] = {GL_STENCIL_TEST,
                                              GL_CULL_FACE,
                                              GL_SAMPLE_ALPHA_TO_COVERAGE,
                                              GL_SAMPLE_ALPHA_TO_ONE,
                                              GL_SAMPLE_COVERAGE,
                                              GL_SAMPLE_MASK,
                                              GL_SAMPLE_SHADING,
                                              GL_PRIMITIVE_RESTART,
                                              GL_FRAMEBUFFER_SRGB,
                                              GL_DEPTH_CLAMP,
                                              GL_POLYGON_OFFSET_FILL,
                                              GL_POLYGON_OFFSET_LINE,
                                              GL_POLYGON_OFFSET_POINT,
                                              GL_POLYGON_SMOOTH,
                                              GL_LINE_SMOOTH,
                                              GL_COLOR_LOGIC_OP,
                                              GL_BLEND,
                                              GL_SCISSOR_TEST,
                                              GL_CLIP_DISTANCE3};

  /// Unusual values of what is the host's to choose for a draw.
  void choose_for_the_host() {
    for (const GLenum capability : k_host_choices) glEnable(capability);
    glDisable(GL_MULTISAMPLE);
    glDisable(GL_DITHER);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_FALSE);
    glColorMask(GL_TRUE, GL_FALSE, GL_TRUE, GL_FALSE);
    glStencilFunc(GL_NOTEQUAL, 3, 0x55);
    glStencilOp(GL_INVERT, GL_INCR, GL_DECR);
    glStencilMask(0xAA);
    glBlendFunc(GL_ONE_MINUS_DST_COLOR, GL_SRC_ALPHA);
    glBlendEquation(GL_FUNC_REVERSE_SUBTRACT);
    glLogicOp(GL_XOR);
    glProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
    glCullFace(GL_FRONT);
    glFrontFace(GL_CW);
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    glPolygonOffset(2, 3);
    glSampleCoverage(0.5f, GL_TRUE);
    glSampleMaski(0, 0x5);
    glMinSampleShading(0.5f);
    glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
    for (GLuint i = 0; i < GLuint(gl_state::viewports()); ++i) {
      glViewportIndexedf(i, 1.0f + float(i), 2, 13, 11);
      glScissorIndexed(i, 2, 1 + GLint(i), 7, 9);
      glDepthRangeIndexed(i, 0.25, 0.75);
    }
  }
  void choose_defaults() {
    for (const GLenum capability : k_host_choices) glDisable(capability);
    glEnable(GL_MULTISAMPLE);
    glEnable(GL_DITHER);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glStencilFunc(GL_ALWAYS, 0, ~0u);
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    glStencilMask(~0u);
    glBlendFunc(GL_ONE, GL_ZERO);
    glBlendEquation(GL_FUNC_ADD);
    glLogicOp(GL_COPY);
    glProvokingVertex(GL_LAST_VERTEX_CONVENTION);
    glCullFace(GL_BACK);
    glFrontFace(GL_CCW);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glPolygonOffset(0, 0);
    glSampleCoverage(1, GL_FALSE);
    glSampleMaski(0, ~0u);
    glMinSampleShading(0);
    glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    for (GLuint i = 0; i < GLuint(gl_state::viewports()); ++i) {
      glViewportIndexedf(i, 0, 0, 1, 1);
      glScissorIndexed(i, 0, 0, 1, 1);
      glDepthRangeIndexed(i, 0, 1);
    }
  }

  bool all_;
  gl::Program program_;
  gl::Buffer buffer_;
  std::vector<gl::Texture> textures_;
  gl::VertexArray vertex_array_;
  gl::Feedback feedback_;
  GLuint sampler_ = 0, renderbuffer_ = 0, pipeline_ = 0;
};

/// Adds to `left` that a texture unit is left empty, of every kind of texture and of its sampler.
inline void add_empty_unit(GlState& left, GLuint unit) {
  for (const gl_state::Named& target : gl_state::k_texture_targets) left[target.name + std::to_string(unit)] = {0};
}

/// Likewise a uniform buffer's index.
inline void add_empty_uniforms(GlState& left, GLuint index) {
  left["uniform buffer " + std::to_string(index)] = {0};
}

/// Asserts that between the two captures exactly the names in `left` may differ, and that each of those has the value
/// that the entry point promises.
inline void expect_only_changed(const GlState& before, const GlState& after, const GlState& left) {
  for (const auto& [name, value] : after) {
    const auto promised = left.find(name);
    EXPECT_EQ(value, promised != left.end() ? promised->second : before.at(name)) << name;
  }
  for (const auto& [name, value] : left) EXPECT_TRUE(after.contains(name)) << "no such state: " << name;
}

}  // namespace sward::test
