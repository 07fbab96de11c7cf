// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/scene/generated_mesh.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/generated_noise.h"

namespace sward {

namespace {

using generated::noise;
using generated::smooth_step;

constexpr double k_below_ground_m = 0.3;
constexpr double k_cell_m = 0.25;

/// Noise of space, looked at along a direction that no wall or level has.
float noise_at(const glm::dvec3& p, double wavelength, uint32_t seed) {
  return noise(glm::vec2(glm::dvec2(p.x + 0.71 * p.z, p.y - 0.59 * p.z) / wavelength), seed);
}

/// Young leaves on top and where light comes, old ones below, some patches drier.
glm::u8vec3 leaf_color(const glm::dvec3& p, double height, uint32_t seed) {
  const float up = smooth_step(0.0f, 1.0f, float(p.z / height));
  const float patch = 0.5f + 0.5f * noise_at(p, 0.9, seed + 7);
  const float dry = smooth_step(0.25f, 0.7f, noise_at(p, 1.7, seed + 8));
  glm::vec3 color = glm::mix(glm::vec3(42, 60, 24), glm::vec3(74, 98, 36), 0.55f * up + 0.45f * patch);
  color = glm::mix(color, glm::vec3(84, 86, 38), 0.45f * dry);
  // The foot of a hedge is bare and in its own shade.
  color *= glm::mix(0.55f, 1.0f, smooth_step(-0.05f, 0.30f, float(p.z)));
  return glm::u8vec3(glm::clamp(color + 0.5f, 0.0f, 255.0f));
}

/// Number of cells along a length, all in all few enough.
int cells(double length, double coarser) {
  return std::max(int(std::ceil(length / (k_cell_m * coarser))), 2);
}

/// A grid of (columns + 1) x (rows + 1) places becomes triangles, counter-clockwise where `at` turns left.
template <class At>
void add_grid(int columns, int rows, const At& at, TriangleMesh& mesh) {
  const uint32_t first = uint32_t(mesh.positions.size());
  for (int row = 0; row <= rows; ++row)
    for (int column = 0; column <= columns; ++column) mesh.positions.push_back(at(column, row));
  const auto corner = [&](int column, int row) { return first + uint32_t(row * (columns + 1) + column); };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const uint32_t a = corner(column, row), b = corner(column + 1, row), c = corner(column + 1, row + 1),
                     d = corner(column, row + 1);
      mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
    }
  }
}

/// The box with its edges rounded and its sides uneven.
class Hedge {
 public:
  Hedge(const glm::dvec3& size, uint32_t seed) : seed_(seed) {
    low_ = {-0.5 * size.x, -0.5 * size.y, -k_below_ground_m};
    high_ = {0.5 * size.x, 0.5 * size.y, size.z};
    round_ = std::min(0.12, 0.35 * std::min({size.x, size.y, size.z}));
  }

  glm::dvec3 shaped(const glm::dvec3& p) const {
    const glm::dvec3 inner(glm::clamp(p.x, low_.x + round_, high_.x - round_),
                           glm::clamp(p.y, low_.y + round_, high_.y - round_), std::min(p.z, high_.z - round_));
    const glm::dvec3 out = p - inner;
    const double length = glm::length(out);
    if (length == 0) return p;
    const double swell = 0.030 * double(noise_at(p, 0.8, seed_)) + 0.015 * double(noise_at(p, 0.33, seed_ + 1));
    return inner + out / length * (round_ + swell);
  }

  TriangleMesh mesh() const {
    const glm::dvec3 size = high_ - low_;
    const double area = 2 * size.z * (size.x + size.y) + size.x * size.y;
    const double coarser = std::max(1.0, std::sqrt(area / (100000 * k_cell_m * k_cell_m)));
    const glm::ivec3 n(cells(size.x, coarser), cells(size.y, coarser), cells(size.z, coarser));
    const auto at = [&](int x, int y, int z) {
      return shaped(low_ + size * glm::dvec3(double(x) / n.x, double(y) / n.y, double(z) / n.z));
    };
    TriangleMesh mesh;
    add_grid(
        n.x, n.z, [&](int x, int z) { return at(x, 0, z); }, mesh);  // south
    add_grid(
        n.y, n.z, [&](int y, int z) { return at(n.x, y, z); }, mesh);  // east
    add_grid(
        n.x, n.z, [&](int x, int z) { return at(n.x - x, n.y, z); }, mesh);  // north
    add_grid(
        n.y, n.z, [&](int y, int z) { return at(0, n.y - y, z); }, mesh);  // west
    add_grid(
        n.x, n.y, [&](int x, int y) { return at(x, y, n.z); }, mesh);  // top
    return mesh;
  }

 private:
  glm::dvec3 low_, high_;
  double round_;
  uint32_t seed_;
};

/// Half width (of 1) and height (of 1) along a topiary's outline, from the ground to its top; `slender` is its height
/// against its half width.
glm::dvec2 topiary_outline(double along, double slender) {
  constexpr double k_cone_part = 0.55, k_wide = 0.56;
  const double start = std::asin(0.42);  // the ball's angle at the neck, from below
  const double high = std::min(k_wide / slender, 0.3), middle = 1 - high;
  const glm::dvec2 neck(k_wide * std::sin(start), middle - high * std::cos(start));
  if (along < k_cone_part) {
    const double t = along / k_cone_part;
    return {glm::mix(1.0, neck.x, t) + 0.12 * std::sin(std::numbers::pi * t), neck.y * t};
  }
  const double angle = glm::mix(start, std::numbers::pi, (along - k_cone_part) / (1 - k_cone_part));
  return {k_wide * std::sin(angle), middle - high * std::cos(angle)};
}

TriangleMesh topiary(const glm::dvec3& size, uint32_t seed) {
  const double around = std::numbers::pi * std::max(size.x, size.y);
  const double coarser = std::max(1.0, std::sqrt(around * size.z / (60000 * k_cell_m * k_cell_m)));
  const int columns = std::max(cells(around, coarser), 12), rows = std::max(cells(1.6 * size.z, coarser), 16);
  const double slender = 2 * size.z / std::max(size.x, size.y);
  const auto at = [&](int column, int row) {
    const double turn = 2 * std::numbers::pi * (column % columns) / columns;
    // The first row lies below the ground.
    const glm::dvec2 outline = topiary_outline(std::max(row - 1, 0) / double(rows - 1), slender);
    const double z = row == 0 ? -k_below_ground_m : outline.y * size.z;
    const double radius = row == rows ? 0.0 : outline.x;
    const glm::dvec3 p(0.5 * size.x * radius * std::cos(turn), 0.5 * size.y * radius * std::sin(turn), z);
    const double swell = 0.020 * double(noise_at(p, 0.45, seed));
    return p * glm::dvec3(1 + swell / (0.25 * size.x), 1 + swell / (0.25 * size.y), 1);
  };
  TriangleMesh mesh;
  add_grid(columns, rows, at, mesh);
  return mesh;
}

}  // namespace

Expected<TriangleMesh> generate_mesh_shape(std::string_view shape, const MeshShapeOptions& options) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(options.size_m[axis] >= 0.2 && options.size_m[axis] <= 200))
      return fail("the size of a generated shape must lie in 0.2 to 200 m along each axis");
  }
  TriangleMesh mesh;
  if (shape == "box_hedge") {
    mesh = Hedge(options.size_m, options.seed).mesh();
  } else if (shape == "topiary") {
    mesh = topiary(options.size_m, options.seed);
  } else {
    return fail("there is no shape \"" + std::string(shape) + "\", expected \"box_hedge\" or \"topiary\"");
  }
  for (const glm::dvec3& p : mesh.positions) mesh.colors.push_back(leaf_color(p, options.size_m.z, options.seed));
  return mesh;
}

}  // namespace sward
