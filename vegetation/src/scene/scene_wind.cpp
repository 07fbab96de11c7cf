// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/scene/scene_wind.h>

#include <cmath>
#include <numbers>

namespace sward {

Expected<std::shared_ptr<const PaintedWind>> painted_wind(const SceneWind& wind, glm::dvec2 min, glm::dvec2 size_m) {
  if ((!wind.strength_file.empty() && !wind.strength) || (!wind.turn_file.empty() && !wind.turn))
    return fail(wind.where + ": the maps of the wind are not loaded; load them");
  const GrayMap* const strength = wind.strength.get();
  const GrayMap* const turn = wind.turn.get();
  const GrayMap* const any = strength != nullptr ? strength : turn;
  if (any == nullptr) return std::shared_ptr<const PaintedWind>();
  if (strength != nullptr && turn != nullptr && (strength->width != turn->width || strength->height != turn->height))
    return fail(wind.where + ": strength_map and turn_map differ in size; scale one to the other's");
  auto painted = std::make_shared<PaintedWind>();
  painted->width = any->width;
  painted->height = any->height;
  painted->min = min;
  painted->size_m = size_m;
  painted->factors.reserve(any->values.size());
  for (size_t i = 0; i < any->values.size(); ++i) {
    const float factor = strength != nullptr ? float(strength->values[i]) / 128.0f : 1.0f;
    const float left = turn != nullptr ? (float(turn->values[i]) - 128.0f) / 128.0f * std::numbers::pi_v<float> : 0.0f;
    painted->factors.emplace_back(factor * std::cos(left), factor * std::sin(left));
  }
  return std::shared_ptr<const PaintedWind>(std::move(painted));
}

}  // namespace sward
