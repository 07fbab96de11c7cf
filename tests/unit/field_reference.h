// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/height_field.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

// What the tests of height fields share: the bintree by its definition, generated heights, and a check of a wedgie
// against every sample. None of it calls the code that it is compared with.
namespace field_reference {

using sward::HeightField;
using sward::LatticePoint;

struct Triangle {
  LatticePoint apex, left, right;
  int level = 0;
  LatticePoint middle() const { return (left + right) / 2; }
  Triangle child(int turn) const {
    if (turn == 0) return {middle(), apex, left, level + 1};
    return {middle(), right, apex, level + 1};
  }
};

inline Triangle root_triangle(int root, glm::ivec2 square) {
  const LatticePoint nw = square * sward::k_root_side, se = nw + sward::k_root_side;
  const LatticePoint sw(nw.x, se.y), ne(se.x, nw.y);
  return root == 0 ? Triangle{nw, sw, ne, 0} : Triangle{se, ne, sw, 0};
}

template <class Random>
Triangle random_triangle(const HeightField& field, int level, Random& random) {
  const glm::ivec2 squares = field.root_squares();
  Triangle t = root_triangle(int(random() % 2), {int(random() % squares.x), int(random() % squares.y)});
  while (t.level < level) t = t.child(int(random() % 2));
  return t;
}

// Calls visit(triangle) for all triangles of a level.
template <class Visit>
void all_triangles(const HeightField& field, int level, Visit&& visit) {
  const auto descend = [&](auto&& self, const Triangle& t) -> void {
    if (t.level == level) return visit(t);
    self(self, t.child(0));
    self(self, t.child(1));
  };
  for (int row = 0; row < field.root_squares().y; ++row) {
    for (int column = 0; column < field.root_squares().x; ++column) {
      descend(descend, root_triangle(0, {column, row}));
      descend(descend, root_triangle(1, {column, row}));
    }
  }
}

// Weights of p in a triangle (apex, left, right); all in [0, 1] inside.
inline glm::dvec3 weights(const Triangle& t, glm::dvec2 p) {
  const glm::dvec2 a(t.apex), l = glm::dvec2(t.left) - a, r = glm::dvec2(t.right) - a, q = p - a;
  const double area = l.x * r.y - l.y * r.x;
  const double left = (q.x * r.y - q.y * r.x) / area, right = (l.x * q.y - l.y * q.x) / area;
  return {1.0 - left - right, left, right};
}

inline double plane_height(const HeightField& field, const Triangle& t, glm::dvec2 p) {
  const glm::dvec3 w = weights(t, p);
  return w.x * field.height(t.apex) + w.y * field.height(t.left) + w.z * field.height(t.right);
}

// Largest distance of a valid sample in the triangle from its plane; -1 when there is none.
inline double largest_sample_error(const HeightField& field, const Triangle& t) {
  const int step = field.sample_step();
  const LatticePoint low = glm::min(t.apex, glm::min(t.left, t.right));
  const LatticePoint high = glm::max(t.apex, glm::max(t.left, t.right));
  const glm::dvec3 z(field.height(t.apex), field.height(t.left), field.height(t.right));
  const int last_row = std::min(high.y / step, field.desc().rows - 1);
  const int last_column = std::min(high.x / step, field.desc().columns - 1);
  double worst = -1.0;
  for (int row = (low.y + step - 1) / step; row <= last_row; ++row) {
    for (int column = (low.x + step - 1) / step; column <= last_column; ++column) {
      const glm::dvec3 w = weights(t, glm::dvec2(column * double(step), row * double(step)));
      if (std::min({w.x, w.y, w.z}) < 0.0 || field.is_hole(column, row)) continue;
      worst = std::max(worst, std::abs(field.sample(column, row) - glm::dot(w, z)));
    }
  }
  return worst;
}

// Rough ground: value noise of several sizes, some cliffs.
inline std::vector<float> rough_heights(int columns, int rows, uint32_t seed) {
  std::vector<float> heights(size_t(columns) * size_t(rows), 0.0f);
  for (int size = 64, octave = 0; size >= 1; size /= 2, ++octave) {
    std::mt19937 random(seed + uint32_t(octave));
    const int across = columns / size + 2, along = rows / size + 2;
    std::vector<float> nodes(size_t(across) * size_t(along));
    for (float& node : nodes) node = float(random() % 2000) / 1000.0f - 1.0f;
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        const int x = column / size, y = row / size;
        const float u = float(column % size) / float(size), v = float(row % size) / float(size);
        const auto node = [&](int i, int j) { return nodes[size_t(y + j) * size_t(across) + size_t(x + i)]; };
        const float north = node(0, 0) + u * (node(1, 0) - node(0, 0));
        const float south = node(0, 1) + u * (node(1, 1) - node(0, 1));
        heights[size_t(row) * size_t(columns) + size_t(column)] += float(size) * (north + v * (south - north));
      }
    }
  }
  for (float& height : heights) height += height > 20.0f ? 35.0f : 0.0f;
  return heights;
}

}  // namespace field_reference
