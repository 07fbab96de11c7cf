// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/gl/program_binaries.h>

#include <algorithm>

namespace sward::gl {

namespace {

/// Others would be an error of the GL, which is the host's to see.
bool driver_takes(GLenum format) {
  GLint count = 0;
  glGetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &count);
  std::vector<GLint> formats(size_t(std::max(count, 0)));
  if (!formats.empty()) glGetIntegerv(GL_PROGRAM_BINARY_FORMATS, formats.data());
  return std::ranges::find(formats, GLint(format)) != formats.end();
}

}  // namespace

Program ProgramBinaries::take(const std::string& text) const {
  Binary binary;
  {
    const std::lock_guard lock(mutex_);
    const auto found = binaries_.find(text);
    if (found == binaries_.end()) return Program();
    binary = found->second;
  }
  if (!driver_takes(binary.format)) return Program();
  Program program(glCreateProgram());
  glProgramBinary(program.id(), binary.format, binary.bytes.data(), GLsizei(binary.bytes.size()));
  GLint linked = GL_FALSE;
  glGetProgramiv(program.id(), GL_LINK_STATUS, &linked);
  if (linked != GL_TRUE) return Program();
  const std::lock_guard lock(mutex_);
  ++taken_;
  return program;
}

void ProgramBinaries::store(const std::string& text, const Program& program) {
  GLint formats = 0, length = 0;
  glGetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &formats);
  if (formats == 0) return;
  glGetProgramiv(program.id(), GL_PROGRAM_BINARY_LENGTH, &length);
  if (length <= 0) return;
  Binary binary;
  binary.bytes.resize(size_t(length));
  GLsizei written = 0;
  glGetProgramBinary(program.id(), length, &written, &binary.format, binary.bytes.data());
  if (written <= 0) return;
  binary.bytes.resize(size_t(written));
  add(text, std::move(binary));
}

std::map<std::string, ProgramBinaries::Binary> ProgramBinaries::binaries() const {
  const std::lock_guard lock(mutex_);
  return binaries_;
}

void ProgramBinaries::add(const std::string& text, Binary binary) {
  const std::lock_guard lock(mutex_);
  binaries_[text] = std::move(binary);
}

size_t ProgramBinaries::taken() const {
  const std::lock_guard lock(mutex_);
  return taken_;
}

}  // namespace sward::gl
