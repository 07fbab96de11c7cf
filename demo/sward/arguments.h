// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/error.h>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace sward::tool {

/// "1,2.5,-3" as numbers; nan and inf are numbers here, ranges are checked where they matter. Fails unless there are
/// `least` to `most` of them.
Expected<std::vector<double>> parse_numbers(const std::string& text, size_t least, size_t most);

/// "1280x720". Any whole numbers; check_size says whether they make a picture.
Expected<glm::ivec2> parse_size(const std::string& text);
Expected<void> check_size(glm::ivec2 size);

/// "x,y,z,yaw,pitch" in metres and degrees; z may begin with + : metres above the ground.
struct CameraArgument {
  glm::dvec3 position{0};
  bool above_ground = false;
  double yaw_degrees = 0, pitch_degrees = 0;
};
Expected<CameraArgument> parse_camera(const std::string& text);

/// A count of samples, or "max" (0). Counts below 1 come out negative, for the command to refuse.
Expected<int> parse_samples(const std::string& text);

/// An option's form as CLI11 checks it: turns a parser into "" or the complaint.
template <class Parser>
auto as_check(Parser parser) {
  return [parser](const std::string& text) -> std::string {
    auto parsed = parser(text);
    return parsed ? std::string() : parsed.error().message;
  };
}

}  // namespace sward::tool
