// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// The difference of two pictures as a viewer sees it when they alternate: FLIP for low dynamic range (Andersson et al.,
// "FLIP: A Difference Evaluator for Alternating Images", 2020), at 67 pixels a degree.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <numbers>
#include <span>
#include <vector>

namespace flip {

constexpr float k_pixels_per_degree = 67;

using Plane = std::vector<float>;
using Kernel = std::vector<float>;  // odd size, its middle at 0

/// Along x, then along y; places beyond the border are the border's.
inline Plane convolve(const Plane& in, glm::ivec2 size, const Kernel& across, const Kernel& down) {
  Plane middle(in.size()), out(in.size());
  const int rx = int(across.size()) / 2, ry = int(down.size()) / 2;
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) {
      float sum = 0;
      for (int i = -rx; i <= rx; ++i)
        sum += across[size_t(i + rx)] * in[size_t(y) * size_t(size.x) + size_t(std::clamp(x + i, 0, size.x - 1))];
      middle[size_t(y) * size_t(size.x) + size_t(x)] = sum;
    }
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) {
      float sum = 0;
      for (int i = -ry; i <= ry; ++i)
        sum += down[size_t(i + ry)] * middle[size_t(std::clamp(y + i, 0, size.y - 1)) * size_t(size.x) + size_t(x)];
      out[size_t(y) * size_t(size.x) + size_t(x)] = sum;
    }
  return out;
}

inline Kernel gaussian(float sigma, int radius) {
  Kernel kernel;
  float sum = 0;
  for (int i = -radius; i <= radius; ++i) {
    kernel.push_back(std::exp(-0.5f * float(i * i) / (sigma * sigma)));
    sum += kernel.back();
  }
  for (float& weight : kernel) weight /= sum;
  return kernel;
}

/// First (1) or second (2) derivative of a Gaussian, its positive and its negative weights adding up to 1 each.
inline Kernel derivative(int order, float sigma, int radius) {
  Kernel kernel;
  float positive = 0, negative = 0;
  for (int i = -radius; i <= radius; ++i) {
    const float x = float(i), g = std::exp(-0.5f * x * x / (sigma * sigma));
    kernel.push_back(order == 1 ? -x * g : (x * x / (sigma * sigma) - 1) * g);
    (kernel.back() > 0 ? positive : negative) += std::abs(kernel.back());
  }
  for (float& weight : kernel) weight /= weight > 0 ? positive : negative;
  return kernel;
}

inline glm::vec3 to_xyz(glm::vec3 linear) {
  return {0.4124564f * linear.x + 0.3575761f * linear.y + 0.1804375f * linear.z,
          0.2126729f * linear.x + 0.7151522f * linear.y + 0.0721750f * linear.z,
          0.0193339f * linear.x + 0.1191920f * linear.y + 0.9503041f * linear.z};
}
inline glm::vec3 to_linear(glm::vec3 xyz) {
  return {3.2404542f * xyz.x - 1.5371385f * xyz.y - 0.4985314f * xyz.z,
          -0.9692660f * xyz.x + 1.8760108f * xyz.y + 0.0415560f * xyz.z,
          0.0556434f * xyz.x - 0.2040259f * xyz.y + 1.0572252f * xyz.z};
}
inline glm::vec3 white() {
  return to_xyz(glm::vec3(1));
}

/// CIELAB of a linear colour, its chroma scaled by lightness (Hunt).
inline glm::vec3 to_hunt_lab(glm::vec3 linear) {
  const glm::vec3 xyz = to_xyz(linear) / white();
  const auto f = [](float t) { return t > 0.008856f ? std::cbrt(t) : 7.787f * t + 16.0f / 116.0f; };
  const glm::vec3 v(f(xyz.x), f(xyz.y), f(xyz.z));
  const float lightness = 116 * v.y - 16;
  return {lightness, 0.01f * lightness * 500 * (v.x - v.y), 0.01f * lightness * 200 * (v.y - v.z)};
}

inline float hyab(glm::vec3 a, glm::vec3 b) {
  const glm::vec3 d = a - b;
  return std::abs(d.x) + std::hypot(d.y, d.z);
}

/// What of a picture is compared.
struct Seen {
  glm::ivec2 size{0};
  std::vector<glm::vec3> color;  // filtered as the eye does, Hunt-adjusted
  Plane edges, points;
};

inline Seen see(std::span<const uint8_t> rgb, glm::ivec2 size) {
  const size_t count = size_t(size.x) * size_t(size.y);
  std::array<Plane, 3> opponent;
  Plane lightness(count);
  for (Plane& plane : opponent) plane.resize(count);
  for (size_t i = 0; i < count; ++i) {
    glm::vec3 linear;
    for (int c = 0; c < 3; ++c) {
      const float s = float(rgb[3 * i + size_t(c)]) / 255.0f;
      linear[c] = s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f);
    }
    const glm::vec3 xyz = to_xyz(linear) / white();
    opponent[0][i] = 116 * xyz.y - 16;
    opponent[1][i] = 500 * (xyz.x - xyz.y);
    opponent[2][i] = 200 * (xyz.y - xyz.z);
    lightness[i] = xyz.y;
  }
  // Contrast sensitivity by channel: sums of Gaussians a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees.
  const float pi = std::numbers::pi_v<float>;
  const auto sigma_of = [pi](float b) { return std::sqrt(b / (2 * pi * pi)) * k_pixels_per_degree; };
  const int radius = int(std::ceil(3 * sigma_of(0.04f)));
  const auto filtered = [&](const Plane& plane, float b) {
    const Kernel kernel = gaussian(sigma_of(b), radius);
    return convolve(plane, size, kernel, kernel);
  };
  opponent[0] = filtered(opponent[0], 0.0047f);
  opponent[1] = filtered(opponent[1], 0.0053f);
  const Plane wide = filtered(opponent[2], 0.04f), narrow = filtered(opponent[2], 0.025f);
  const auto volume = [&](float a, float b) { return a * std::sqrt(pi / b) * 2 * pi * sigma_of(b) * sigma_of(b); };
  const float share = volume(34.1f, 0.04f) / (volume(34.1f, 0.04f) + volume(13.5f, 0.025f));
  Seen seen{size, std::vector<glm::vec3>(count), {}, {}};
  for (size_t i = 0; i < count; ++i) {
    const float y = (opponent[0][i] + 16) / 116;
    const float blue = share * wide[i] + (1 - share) * narrow[i];
    const glm::vec3 xyz = glm::vec3(opponent[1][i] / 500 + y, y, y - blue / 200) * white();
    seen.color[i] = to_hunt_lab(glm::clamp(to_linear(xyz), 0.0f, 1.0f));
  }
  const float sigma = 0.5f * 0.082f * k_pixels_per_degree;
  const int reach = int(std::ceil(3 * sigma));
  const Kernel smooth = gaussian(sigma, reach);
  const auto features = [&](int order) {
    const Kernel steep = derivative(order, sigma, reach);
    Plane x = convolve(lightness, size, steep, smooth);
    const Plane y = convolve(lightness, size, smooth, steep);
    for (size_t i = 0; i < count; ++i) x[i] = std::hypot(x[i], y[i]);
    return x;
  };
  seen.edges = features(1);
  seen.points = features(2);
  return seen;
}

/// Mean over the picture, 0 (the same) to 1.
inline double difference(const Seen& a, const Seen& b) {
  const float most = std::pow(hyab(to_hunt_lab({0, 1, 0}), to_hunt_lab({0, 0, 1})), 0.7f);
  double sum = 0;
  for (size_t i = 0; i < a.color.size(); ++i) {
    const float raw = std::pow(hyab(a.color[i], b.color[i]), 0.7f), knee = 0.4f * most;
    const float color = raw < knee ? raw * 0.95f / knee : 0.95f + (raw - knee) / (most - knee) * 0.05f;
    const float feature =
        std::max(std::abs(a.edges[i] - b.edges[i]), std::abs(a.points[i] - b.points[i])) / std::numbers::sqrt2_v<float>;
    sum += std::pow(double(std::min(color, 1.0f)), 1.0 - std::min(std::sqrt(double(feature)), 1.0));
  }
  return sum / double(a.color.size());
}

}  // namespace flip
