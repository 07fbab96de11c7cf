// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/scene/generated_mesh.h>

#include <array>
#include <cmath>
#include <numbers>

namespace sward {

namespace {

constexpr double k_turn = 2 * std::numbers::pi;

glm::dvec3 around(double angle, double radius, double z) {
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

/// A vertex; returns its number.
uint32_t add(TriangleMesh& mesh, const glm::dvec3& p, glm::u8vec3 color) {
  mesh.positions.push_back(p);
  mesh.colors.push_back(color);
  return uint32_t(mesh.positions.size() - 1);
}

/// A ring of the outline of something round.
struct Ring {
  double radius, z;
  glm::u8vec3 color;
};

template <size_t N>
void add_round(TriangleMesh& mesh, const std::array<Ring, N>& rings, int sides) {
  const uint32_t first = uint32_t(mesh.positions.size());
  for (const Ring& ring : rings)
    for (int i = 0; i < sides; ++i) add(mesh, around(k_turn * i / sides, ring.radius, ring.z), ring.color);
  for (uint32_t row = 0; row + 1 < N; ++row) {
    for (int i = 0; i < sides; ++i) {
      const uint32_t a = first + row * uint32_t(sides) + uint32_t(i);
      const uint32_t b = first + row * uint32_t(sides) + uint32_t((i + 1) % sides);
      mesh.indices.insert(mesh.indices.end(), {a, b, b + uint32_t(sides), a, b + uint32_t(sides), a + uint32_t(sides)});
    }
  }
}

/// A leaf that leaves the stem at z and rises, its edge in spines.
void add_leaf(TriangleMesh& mesh, double angle, double z, double length) {
  const glm::u8vec3 rib(136, 156, 100), edge(88, 118, 62), spine(178, 182, 130);
  constexpr int k_spines = 4;
  const glm::dvec3 out = around(angle, 1, 0), side = around(angle + k_turn / 4, 1, 0), up(0, 0, 1);
  const auto along = [&](double s) { return out * (length * s) + up * (z + length * (0.75 * s - 0.55 * s * s)); };
  for (int i = 0; i < k_spines; ++i) {
    const double s = double(i) / k_spines, end = double(i + 1) / k_spines, wide = 0.36 * length * (1 - 0.72 * s);
    for (const double hand : {-1.0, 1.0}) {
      const uint32_t a = add(mesh, along(s), rib), b = add(mesh, along(end), rib);
      const uint32_t c = add(mesh, along(s + 0.4 / k_spines) + side * (hand * 0.45 * wide), edge);
      const uint32_t d = add(mesh, along(end) + side * (hand * wide) + up * (0.1 * length), spine);
      mesh.indices.insert(mesh.indices.end(), {a, b, c, c, b, d});
    }
  }
}

/// The tuft of florets on a head.
void add_florets(TriangleMesh& mesh, double z) {
  const glm::u8vec3 root(130, 60, 130), tip(186, 92, 180);
  for (int i = 0; i < 14; ++i) {
    const double angle = k_turn * i * 0.381966, lean = 0.012 + 0.05 * ((i * 5) % 14) / 14.0;
    const glm::dvec3 foot = around(angle, 0.4 * lean, z),
                     end = around(angle, 1.3 * lean + 0.012, z + 0.085 - 0.4 * lean);
    const glm::dvec3 side = around(angle + k_turn / 4, 0.010, 0);
    const uint32_t a = add(mesh, foot - side, root), b = add(mesh, foot + side, root), c = add(mesh, end + side, tip),
                   d = add(mesh, end - side, tip);
    mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
  }
}

TriangleMesh thistle() {
  TriangleMesh mesh;
  const glm::u8vec3 stem(92, 112, 66), young(108, 130, 78), bract(84, 104, 70), dark(66, 84, 56);
  add_round(mesh,
            std::array<Ring, 4>{{{0.017, 0, stem}, {0.014, 0.35, stem}, {0.012, 0.65, young}, {0.010, 0.86, young}}},
            5);
  add_round(
      mesh,
      std::array<Ring, 4>{{{0.012, 0.845, dark}, {0.056, 0.872, bract}, {0.054, 0.905, dark}, {0.022, 0.925, bract}}},
      8);
  for (int i = 0; i < 10; ++i) add_leaf(mesh, k_turn * 0.381966 * i, 0.03 + 0.08 * i, 0.40 - 0.027 * i);
  add_florets(mesh, 0.915);
  return mesh;
}

}  // namespace

Expected<TriangleMesh> generate_plant_shape(std::string_view shape) {
  if (shape == "thistle") return thistle();
  return fail("there is no plant \"" + std::string(shape) + "\", expected \"thistle\"");
}

}  // namespace sward
