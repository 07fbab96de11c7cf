// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "vegetation/blade_chain.h"

#include <algorithm>
#include <cmath>

namespace sward {

bool solve_linear(std::vector<double>& a, std::vector<double>& b) {
  const int n = int(b.size());
  for (int column = 0; column < n; ++column) {
    int pivot = column;
    for (int row = column + 1; row < n; ++row) {
      if (std::abs(a[row * n + column]) > std::abs(a[pivot * n + column])) pivot = row;
    }
    if (a[pivot * n + column] == 0.0) return false;
    std::swap_ranges(a.begin() + pivot * n, a.begin() + (pivot + 1) * n, a.begin() + column * n);
    std::swap(b[pivot], b[column]);
    for (int row = column + 1; row < n; ++row) {
      const double factor = a[row * n + column] / a[column * n + column];
      if (factor == 0.0) continue;
      for (int k = column; k < n; ++k) a[row * n + k] -= factor * a[column * n + k];
      b[row] -= factor * b[column];
    }
  }
  for (int row = n - 1; row >= 0; --row) {
    for (int k = row + 1; k < n; ++k) b[row] -= a[row * n + k] * b[k];
    b[row] /= a[row * n + row];
  }
  return true;
}

std::vector<glm::vec4> lay_out(std::span<const double> phi) {
  const int segments = int(phi.size());
  const double length = 1.0 / segments;
  std::vector<double> inclinations(phi.size());
  std::vector<glm::dvec2> points{glm::dvec2(0.0)};
  double inclination = 0.0;
  for (int j = 0; j < segments; ++j) {
    inclination += phi[j];
    const glm::dvec2 foot = points.back();
    // What would end below the ground ends on it, as long as it was.
    const double rise = std::max(length * std::cos(inclination), -foot.y);
    const double reach = std::sqrt(length * length - rise * rise);
    points.push_back({foot.x + reach, foot.y + rise});
    inclinations[j] = std::atan2(reach, rise);
  }
  std::vector<glm::vec4> rows;
  for (int row = 0; row <= segments; ++row) {
    const double below = inclinations[std::max(row - 1, 0)];
    const double above = inclinations[std::min(row, segments - 1)];
    rows.push_back(glm::vec4(glm::dvec4(points[row].x, points[row].y, 0.5 * (below + above), 0.0)));
  }
  return rows;
}

}  // namespace sward
