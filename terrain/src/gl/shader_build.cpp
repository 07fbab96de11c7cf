// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Compiling and linking, and turning the drivers' logs into messages that name files.
#include <sward/gl/shader_library.h>

#include <sward/gl/program_binaries.h>
#include <algorithm>
#include <array>

#include "gl/driver_log.h"

namespace sward::gl {

namespace {

struct ShaderTraits : SharedTraits {
  static void destroy(GLuint id) { glDeleteShader(id); }
};
using Shader = Handle<ShaderTraits>;

std::string shader_log(GLuint shader) {
  GLint length = 0;
  glGetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
  std::string log(size_t(std::max(length, 1)), '\0');
  GLsizei written = 0;
  glGetShaderInfoLog(shader, GLsizei(log.size()), &written, log.data());
  log.resize(size_t(written));
  return log;
}

std::string program_log(GLuint program) {
  GLint length = 0;
  glGetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
  std::string log(size_t(std::max(length, 1)), '\0');
  GLsizei written = 0;
  glGetProgramInfoLog(program, GLsizei(log.size()), &written, log.data());
  log.resize(size_t(written));
  return log;
}

void label(GLenum kind, GLuint id, std::string_view name) {
  // 256 is the least that GL_MAX_LABEL_LENGTH may be, the closing zero included.
  glObjectLabel(kind, id, GLsizei(std::min<size_t>(name.size(), 255)), name.data());
}

Shader compile_text(GLenum stage, const std::string& file, const std::string& text) {
  Shader shader(glCreateShader(stage));
  label(GL_SHADER, shader.id(), file);
  const char* const pointer = text.c_str();
  const GLint length = GLint(text.size());
  glShaderSource(shader.id(), 1, &pointer, &length);
  glCompileShader(shader.id());
  return shader;
}

Expected<Shader> compile(GLenum stage, const ProgramDesc& desc, const std::string& file, const ResolvedSource& source) {
  Shader shader = compile_text(stage, file, source.text);
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_TRUE) return shader;
  // Mesa counts expressions of every file as file 0: the log is taken from the same text without #line, where a line
  // number alone tells the place.
  const SourceMap map = make_source_map(source);
  const Shader plain = compile_text(stage, file, map.text);
  return fail("shader program '" + desc.name + "': " + file + " does not compile:\n" +
              name_places(shader_log(plain.id()), map));
}

struct Stage {
  GLenum kind;
  const std::string* file;
  ResolvedSource source;
};

// What a program is made from, as one text.
std::string text_of(const ProgramDesc& desc, const std::vector<Stage>& stages) {
  std::string text;
  for (const Stage& stage : stages) text += std::to_string(stage.kind) + "\n" + stage.source.text;
  for (const char* varying : desc.feedback_varyings) text += std::string(varying) + "\n";
  return text;
}

Expected<Program> link(const ProgramDesc& desc, const std::vector<Stage>& stages, bool retrievable) {
  Program program(glCreateProgram());
  label(GL_PROGRAM, program.id(), desc.name);
  std::vector<Shader> shaders;
  for (const Stage& stage : stages) {
    Expected<Shader> shader = compile(stage.kind, desc, *stage.file, stage.source);
    if (!shader) return tl::unexpected(shader.error());
    glAttachShader(program.id(), shader->id());
    shaders.push_back(std::move(*shader));
  }
  if (!desc.feedback_varyings.empty()) {
    glTransformFeedbackVaryings(program.id(), GLsizei(desc.feedback_varyings.size()), desc.feedback_varyings.data(),
                                GL_INTERLEAVED_ATTRIBS);
  }
  if (retrievable) glProgramParameteri(program.id(), GL_PROGRAM_BINARY_RETRIEVABLE_HINT, GL_TRUE);
  glLinkProgram(program.id());
  GLint linked = GL_FALSE;
  glGetProgramiv(program.id(), GL_LINK_STATUS, &linked);
  if (linked != GL_TRUE) {
    return fail("shader program '" + desc.name + "' does not link:\n" + program_log(program.id()));
  }
  for (const Shader& shader : shaders) glDetachShader(program.id(), shader.id());
  return program;
}

}  // namespace

Expected<Program> ShaderLibrary::build(const ProgramDesc& desc) const {
  if (Expected<void> context = require_context(); !context) return tl::unexpected(context.error());
  const std::array<std::pair<GLenum, const std::string*>, 6> files{{{GL_VERTEX_SHADER, &desc.vertex},
                                                                    {GL_TESS_CONTROL_SHADER, &desc.tess_control},
                                                                    {GL_TESS_EVALUATION_SHADER, &desc.tess_evaluation},
                                                                    {GL_GEOMETRY_SHADER, &desc.geometry},
                                                                    {GL_FRAGMENT_SHADER, &desc.fragment},
                                                                    {GL_COMPUTE_SHADER, &desc.compute}}};
  std::vector<Stage> stages;
  for (const auto& [kind, file] : files) {
    if (file->empty()) continue;
    Expected<ResolvedSource> source = resolve(*file, desc.defines);
    if (!source) return fail("shader program '" + desc.name + "': " + source.error().message);
    stages.push_back({kind, file, std::move(*source)});
  }
  if (binaries_ == nullptr) return link(desc, stages, false);
  const std::string text = text_of(desc, stages);
  if (Program known = binaries_->take(text); known.id() != 0) {
    label(GL_PROGRAM, known.id(), desc.name);
    return known;
  }
  Expected<Program> program = link(desc, stages, true);
  if (program) binaries_->store(text, *program);
  return program;
}

}  // namespace sward::gl
