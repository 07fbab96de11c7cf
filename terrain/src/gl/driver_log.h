// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/gl/shader_library.h>
#include <string>
#include <string_view>
#include <vector>

namespace sward::gl {

/// A resolved text without its #line directives (each is an empty line), and where each of its lines comes from.
struct SourceMap {
  std::string text;
  std::vector<std::string> places;  ///< "file:line" of lines 1, 2, ...; empty for lines that no file has.
};
SourceMap make_source_map(const ResolvedSource& source);

/// A driver's compile log of map.text with the places at the start of its lines replaced: "0:12(5): error: ..." (Mesa),
/// "0(12) : error C1: ..." (NVIDIA) and "ERROR: 0:12: ..." (others) begin with "file:line" then. Empty lines are
/// dropped, other lines stay.
std::string name_places(std::string_view log, const SourceMap& map);

}  // namespace sward::gl
