// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "sward/arguments.h"

#include <charconv>
#include <string_view>

namespace sward::tool {

namespace {

template <class Number>
bool parse_whole(std::string_view text, Number& value) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (size_t at = text.find(separator); at != std::string_view::npos; at = text.find(separator)) {
    parts.push_back(text.substr(0, at));
    text.remove_prefix(at + 1);
  }
  parts.push_back(text);
  return parts;
}

constexpr int k_no_samples = -1;  // "0" asks for none, which is out of range; 0 stands for "max"

}  // namespace

Expected<std::vector<double>> parse_numbers(const std::string& text, size_t least, size_t most) {
  std::vector<double> numbers;
  for (const std::string_view part : split(text, ',')) {
    numbers.push_back(0);
    if (!parse_whole(part, numbers.back())) return fail("\"" + std::string(part) + "\" is not a number");
  }
  if (numbers.size() >= least && numbers.size() <= most) return numbers;
  const std::string wanted =
      least == most ? std::to_string(least) : std::to_string(least) + " to " + std::to_string(most);
  return fail("\"" + text + "\" has " + std::to_string(numbers.size()) + " numbers, expected " + wanted);
}

Expected<glm::ivec2> parse_size(const std::string& text) {
  const std::vector<std::string_view> parts = split(text, 'x');
  glm::ivec2 size(0);
  if (parts.size() != 2 || !parse_whole(parts[0], size.x) || !parse_whole(parts[1], size.y))
    return fail("\"" + text + "\" is no size; expected WIDTHxHEIGHT, as in 1280x720");
  return size;
}

Expected<void> check_size(glm::ivec2 size) {
  if (size.x >= 1 && size.y >= 1 && size.x <= 32768 && size.y <= 32768) return {};
  return fail("a picture of " + std::to_string(size.x) + "x" + std::to_string(size.y) +
              " pixels cannot be drawn; --size takes 1x1 to 32768x32768");
}

Expected<CameraArgument> parse_camera(const std::string& text) {
  auto numbers = parse_numbers(text, 5, 5);
  if (!numbers) return fail(numbers.error().message + " (x,y,z,yaw,pitch)");
  const std::vector<double>& n = *numbers;
  return CameraArgument{{n[0], n[1], n[2]}, split(text, ',')[2].starts_with('+'), n[3], n[4]};
}

Expected<int> parse_samples(const std::string& text) {
  int samples = 0;
  if (text == "max") return 0;
  if (!parse_whole(std::string_view(text), samples))
    return fail("\"" + text + "\" is no number of samples; expected 1 or more, or max");
  return samples == 0 ? k_no_samples : samples;
}

}  // namespace sward::tool
