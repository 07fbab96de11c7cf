// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "scene/scene_values.h"

#include <algorithm>
#include <cstdio>

namespace sward::scene_file {

namespace {

std::string bound_text(double bound) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.10g", bound);
  return buffer;
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

/// As a colour picker shows it, hue in turns.
glm::vec3 hsv_of_rgb(double r, double g, double b) {
  const double value = std::max({r, g, b});
  const double chroma = value - std::min({r, g, b});
  if (chroma <= 0.0) return {0.0f, 0.0f, float(value)};
  double sextant = 0;
  if (value == r)
    sextant = (g - b) / chroma;
  else if (value == g)
    sextant = 2.0 + (b - r) / chroma;
  else
    sextant = 4.0 + (r - g) / chroma;
  const double turns = sextant / 6.0;
  return {float(turns < 0.0 ? turns + 1.0 : turns), float(chroma / value), float(value)};
}

}  // namespace

bool Interval::contains(double value) const {
  if (std::isnan(value) || (std::isinf(value) && !infinite)) return false;
  if (not_zero && value == 0.0) return false;
  return (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
}

std::string Interval::text() const {
  const bool has_low = std::isfinite(low), has_high = std::isfinite(high);
  if (has_low && has_high) {
    return std::string(" in ") + (low_open ? "(" : "[") + bound_text(low) + ", " + bound_text(high) +
           (high_open ? ")" : "]");
  }
  std::string words;
  if (has_low) words = (low_open ? " > " : " >= ") + bound_text(low);
  if (has_high) words = (high_open ? " < " : " <= ") + bound_text(high);
  if (not_zero) words += " other than 0";
  return infinite ? words + ", or inf" : words;
}

std::optional<double> as_number(const toml::node& node) {
  if (const auto* whole = node.as_integer()) return double(whole->get());
  if (const auto* real = node.as_floating_point()) return real->get();
  return std::nullopt;
}

std::optional<int64_t> as_whole_number(const toml::node& node, Interval range) {
  const auto* whole = node.as_integer();
  if (whole == nullptr || !range.contains(double(whole->get()))) return std::nullopt;
  return whole->get();
}

namespace {

std::optional<std::array<double, 3>> channels_of_hex(const toml::node& node) {
  const auto* text = node.as_string();
  if (text == nullptr || text->get().size() != 7 || text->get()[0] != '#') return std::nullopt;
  std::array<double, 3> channels;
  for (size_t i = 0; i < 3; ++i) {
    const int high = hex_digit(text->get()[1 + 2 * i]), low = hex_digit(text->get()[2 + 2 * i]);
    if (high < 0 || low < 0) return std::nullopt;
    channels[i] = (16 * high + low) / 255.0;
  }
  return channels;
}

}  // namespace

std::optional<glm::vec3> rgb_of_hex(const toml::node& node) {
  const auto channels = channels_of_hex(node);
  if (!channels) return std::nullopt;
  return glm::vec3((*channels)[0], (*channels)[1], (*channels)[2]);
}

std::optional<glm::vec3> hsv_of_hex(const toml::node& node) {
  const auto channels = channels_of_hex(node);
  if (!channels) return std::nullopt;
  return hsv_of_rgb((*channels)[0], (*channels)[1], (*channels)[2]);
}

}  // namespace sward::scene_file
