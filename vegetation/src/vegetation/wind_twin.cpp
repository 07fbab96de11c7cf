// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The twin of shaders/common_wind.glsl: the same field, over lookups of its own.
#include "vegetation/wind_maps.h"
#include "vegetation/wind_state.h"

namespace sward {

namespace wind_shared {

using glm::abs;
using glm::clamp;
using glm::cos;
using glm::floor;
using glm::max;
using glm::min;
using glm::pow;
using glm::sqrt;

namespace {

class Twin {
 public:
  Twin(const WindState& state, const WindParams& params) : sward_wind(params), state_(state) {}

#define SWARD_FN
#include "common_wind_field.glsl"
#undef SWARD_FN

 private:
  vec2 wind_gust_map(vec2 uv) const {
    return sample_wind_map(0, uv);
  }
  vec2 wind_noise_map(vec2 uv) const {
    return sample_wind_map(1, uv) * 2.0f - 256.0f / 255.0f;
  }
  vec2 wind_grid_map(vec2 uv, int level) const {
    return (level == 0 ? state_.fine : state_.coarse).sample(uv);
  }

  // Bilinear, ending at the edge. Row 0 of the map is the northern edge and v = 0 the southern.
  vec2 wind_painted_map(vec2 uv) const {
    const PaintedWind& map = *state_.painted;
    const glm::ivec2 last(map.width - 1, map.height - 1);
    const vec2 q = clamp(uv * vec2(last + 1) - 0.5f, vec2(0), vec2(last));
    const glm::ivec2 low(q), high = glm::min(low + 1, last);
    const vec2 f = q - vec2(low);
    const auto texel = [&](int x, int y) { return map.factors[size_t(last.y - y) * size_t(map.width) + size_t(x)]; };
    return glm::mix(glm::mix(texel(low.x, low.y), texel(high.x, low.y), f.x),
                    glm::mix(texel(low.x, high.y), texel(high.x, high.y), f.x), f.y);
  }

  const WindParams& sward_wind;  // named as the shaders' block
  const WindState& state_;
};

}  // namespace

}  // namespace wind_shared

WindHere wind_here(const WindState& state, const wind_shared::WindParams& params, glm::vec2 point) {
  wind_shared::Twin twin(state, params);
  const wind_shared::WindHere here = twin.wind_at_place(point);
  return {here.velocity, here.ambient, here.gust};
}

}  // namespace sward
