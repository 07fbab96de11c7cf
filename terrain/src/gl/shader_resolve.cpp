// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Text only: finding shader files and putting their includes in place. Needs no context.
#include <sward/gl/shader_library.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>

namespace sward::gl {

namespace {

std::string_view trim_left(std::string_view text) {
  const size_t start = text.find_first_not_of(" \t");
  return start == std::string_view::npos ? std::string_view{} : text.substr(start);
}

/// The words after `#name` when the line is that directive (blanks allowed around the #).
std::optional<std::string_view> directive(std::string_view line, std::string_view name) {
  line = trim_left(line);
  if (line.empty() || line.front() != '#') return std::nullopt;
  line = trim_left(line.substr(1));
  if (!line.starts_with(name)) return std::nullopt;
  line.remove_prefix(name.size());
  if (!line.empty() && (std::isalnum(static_cast<unsigned char>(line.front())) || line.front() == '_')) {
    return std::nullopt;
  }
  return trim_left(line);
}

/// The name between the quotes of an include; empty when there is none.
std::string_view quoted(std::string_view text) {
  if (text.empty() || text.front() != '"') return {};
  const size_t end = text.find('"', 1);
  return end == std::string_view::npos ? std::string_view{} : text.substr(1, end - 1);
}

std::string joined(const std::vector<std::string>& names, std::string_view separator) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : std::string(separator)) + name;
  return text;
}

std::string place(std::string_view file, int line) {
  return std::string(file) + ":" + std::to_string(line) + ": ";
}

}  // namespace

void ShaderLibrary::add_source(std::string name, std::string text) {
  const auto same = std::ranges::find(sources_, name, &std::pair<std::string, std::string>::first);
  if (same != sources_.end()) {
    same->second = std::move(text);
  } else {
    sources_.emplace_back(std::move(name), std::move(text));
  }
}

Expected<std::string> ShaderLibrary::find(std::string_view file) const {
  if (!override_directory_.empty()) {
    const std::filesystem::path path = std::filesystem::path(override_directory_) / file;
    std::error_code ignored;
    if (std::filesystem::is_regular_file(path, ignored)) {
      std::ifstream stream(path, std::ios::binary);
      std::string text{std::istreambuf_iterator<char>(stream), {}};
      if (!stream.bad() && stream.is_open()) return text;
      return fail("shader '" + path.string() + "' cannot be read");
    }
  }
  for (const auto& [name, text] : sources_) {
    if (name == file) return text;
  }
  for (const EmbeddedText& embedded : embedded_shaders()) {
    if (embedded.name == file) return std::string(embedded.text);
  }
  return fail("there is no shader file '" + std::string(file) + "'" +
              (override_directory_.empty() ? "" : " (searched in '" + override_directory_ + "' too)"));
}

struct ShaderLibrary::Resolution {
  ResolvedSource result;
  std::vector<std::string> open;  ///< Files being included now, outermost first.
};

Expected<void> ShaderLibrary::append(std::string_view file, std::string_view text, Resolution& resolution) const {
  const std::string number = std::to_string(resolution.result.files.size());
  resolution.result.files.emplace_back(file);
  resolution.open.emplace_back(file);
  resolution.result.text += "#line 1 " + number + "\n";

  int line_number = 0;
  for (std::string_view rest = text; !rest.empty();) {
    const size_t length = std::min(rest.find('\n'), rest.size());
    std::string_view line = rest.substr(0, length);
    rest.remove_prefix(std::min(length + 1, rest.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    ++line_number;
    if (directive(line, "version")) {
      return fail(place(file, line_number) + "a shader file has no #version; sward begins every stage with it");
    }
    if (const auto argument = directive(line, "include")) {
      if (Expected<void> included = include(*argument, line_number, resolution); !included) return included;
      resolution.result.text += "#line " + std::to_string(line_number + 1) + " " + number + "\n";
    } else {
      resolution.result.text.append(line).append("\n");
    }
  }
  resolution.open.pop_back();
  return {};
}

Expected<void> ShaderLibrary::include(std::string_view argument, int line, Resolution& resolution) const {
  const std::string here = place(resolution.open.back(), line);
  const std::string_view name = quoted(argument);
  if (name.empty()) return fail(here + "expected #include \"file\"");
  if (std::ranges::find(resolution.open, name) != resolution.open.end()) {
    return fail(here + "'" + std::string(name) + "' includes itself: " + joined(resolution.open, " -> ") + " -> " +
                std::string(name));
  }
  if (std::ranges::find(resolution.result.files, name) != resolution.result.files.end()) return {};
  const Expected<std::string> text = find(name);
  if (!text) return fail(here + text.error().message);
  return append(name, *text, resolution);
}

Expected<ResolvedSource> ShaderLibrary::resolve(std::string_view file, std::span<const Define> defines) const {
  const Expected<std::string> text = find(file);
  if (!text) return tl::unexpected(text.error());
  Resolution resolution;
  resolution.result.text = "#version 450 core\n";
  for (const Define& define : defines) resolution.result.text += "#define " + define.name + " " + define.value + "\n";
  if (Expected<void> appended = append(file, *text, resolution); !appended) return tl::unexpected(appended.error());
  return std::move(resolution.result);
}

}  // namespace sward::gl
