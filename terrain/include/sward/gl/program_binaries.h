// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/gl/handles.h>
#include <cstddef>
#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace sward::gl {

/// Linked programs as the driver stores them, by the text that they were made from. A thread with a context of its own
/// builds programs with a ShaderLibrary that has these; one with another context of the same driver then builds them
/// again in a fraction of the time. Drivers without a format for programs leave it empty: then programs are compiled.
/// Any thread, several at a time; take() and store() need a current context.
class SWARD_API ProgramBinaries {
 public:
  /// A program of this text, linked; id 0 when there is none or the driver does not take it any more.
  Program take(const std::string& text) const;
  /// Keeps what `program`, linked with GL_PROGRAM_BINARY_RETRIEVABLE_HINT, was linked to.
  void store(const std::string& text, const Program& program);

  struct Binary {
    GLenum format = 0;  ///< The driver's.
    std::vector<std::byte> bytes;
  };
  /// All of them, for a host that keeps them between runs; add() puts one back. Bytes that the driver refuses are as if
  /// they were not there.
  std::map<std::string, Binary> binaries() const;
  void add(const std::string& text, Binary binary);

  /// Programs that take() has made.
  size_t taken() const;

 private:
  mutable std::mutex mutex_;
  mutable size_t taken_ = 0;
  std::map<std::string, Binary> binaries_;
};

}  // namespace sward::gl
