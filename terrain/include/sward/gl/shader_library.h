// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/gl/handles.h>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sward::gl {

/// Every file of shaders/, embedded at build time ("grass_blade.tese.glsl").
SWARD_API std::span<const EmbeddedText> embedded_shaders();

/// A stage's text with every `#include "name"` in place (each file once) and lines marked with `#line`; file numbers
/// are indices into `files`. Includes are textual: they must not stand inside of #if. A file that includes itself,
/// directly or through others, is an error. The one resolver for build and run time.
struct ResolvedSource {
  std::string text;
  std::vector<std::string> files;
};

struct Define {
  std::string name, value;
};

class ProgramBinaries;

/// One program: file names by stage (empty: absent) and variants as defines.
struct ProgramDesc {
  std::string name;  ///< For messages and the debug label.
  std::string vertex, tess_control, tess_evaluation, geometry, fragment;
  std::vector<Define> defines;
  /// Captured outputs when they are not laid out in the shader by xfb_buffer; normally empty.
  std::vector<const char*> feedback_varyings;
  std::string compute = {};  ///< Alone.
};

/// Where shader text comes from: files of an override directory first when one is set (for reloading), then further
/// sources that the host registered (its own plant kinds), then the embedded ones.
class SWARD_API ShaderLibrary {
 public:
  ShaderLibrary() = default;
  explicit ShaderLibrary(std::string override_directory) : override_directory_(std::move(override_directory)) {}
  /// A later source of the same name replaces the earlier one.
  void add_source(std::string name, std::string text);
  /// build() takes programs from these where they have them, and adds what it links.
  void set_binaries(std::shared_ptr<ProgramBinaries> binaries) { binaries_ = std::move(binaries); }
  /// Null: none.
  const std::shared_ptr<ProgramBinaries>& binaries() const { return binaries_; }

  /// `#version 450 core`, the defines, then the file. Any thread; needs no context. Errors name file and line.
  Expected<ResolvedSource> resolve(std::string_view file, std::span<const Define> defines) const;
  /// Compiles and links. On failure: an error with the stage's file and the driver's log, file numbers replaced by
  /// names. The program carries desc.name as its debug label. GL thread.
  Expected<Program> build(const ProgramDesc& desc) const;

 private:
  struct Resolution;
  Expected<std::string> find(std::string_view file) const;
  Expected<void> append(std::string_view file, std::string_view text, Resolution& resolution) const;
  Expected<void> include(std::string_view argument, int line, Resolution& resolution) const;
  std::string override_directory_;
  std::shared_ptr<ProgramBinaries> binaries_;
  std::vector<std::pair<std::string, std::string>> sources_;
};

}  // namespace sward::gl
