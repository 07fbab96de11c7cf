// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "gl/driver_log.h"

#include <algorithm>
#include <charconv>

namespace sward::gl {

namespace {

/// Cuts the first line off `text`.
std::string_view next_line(std::string_view& text) {
  const size_t length = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, length);
  text.remove_prefix(std::min(length + 1, text.size()));
  return line;
}

std::string name_place(std::string_view line, const SourceMap& map) {
  std::string_view rest = line;
  std::string prefix;
  for (const std::string_view word : {std::string_view("ERROR: "), std::string_view("WARNING: ")}) {
    if (!rest.starts_with(word)) continue;
    prefix = word;
    rest.remove_prefix(word.size());
  }
  unsigned file = 0;
  size_t number = 0;
  const char* const end = rest.data() + rest.size();
  const auto after_file = std::from_chars(rest.data(), end, file);
  if (after_file.ec != std::errc{} || after_file.ptr == end) return std::string(line);
  const char separator = *after_file.ptr;
  if (separator != ':' && separator != '(') return std::string(line);
  const auto after_line = std::from_chars(after_file.ptr + 1, end, number);
  if (after_line.ec != std::errc{} || number == 0 || number > map.places.size()) return std::string(line);
  rest.remove_prefix(size_t(after_line.ptr - rest.data()));
  if (separator == '(' && rest.starts_with(") :")) rest.remove_prefix(2);
  return prefix + map.places[number - 1] + std::string(rest);
}

}  // namespace

SourceMap make_source_map(const ResolvedSource& source) {
  constexpr std::string_view k_directive = "#line ";
  SourceMap map;
  int line_number = 0;
  size_t file = source.files.size();
  for (std::string_view rest = source.text; !rest.empty();) {
    const std::string_view line = next_line(rest);
    if (line.starts_with(k_directive)) {
      const char* const end = line.data() + line.size();
      const auto after = std::from_chars(line.data() + k_directive.size(), end, line_number);
      if (after.ptr != end) std::from_chars(after.ptr + 1, end, file);
      map.places.emplace_back();
    } else {
      const bool known = file < source.files.size();
      map.places.push_back(known ? source.files[file] + ":" + std::to_string(line_number++) : std::string());
      map.text += line;
    }
    map.text += '\n';
  }
  return map;
}

std::string name_places(std::string_view log, const SourceMap& map) {
  std::string result;
  while (!log.empty()) {
    const std::string_view line = next_line(log);
    if (!line.empty() && line.front() != '\0') result += (result.empty() ? "" : "\n") + name_place(line, map);
  }
  return result;
}

}  // namespace sward::gl
