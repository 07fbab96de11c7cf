// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Equilibrium of a chain of hinged segments under its own weight and wind.
//
// After D. Papavasiliou, "Real-Time Grass (and Other Procedural Objects) on Terrain" (2015), section 2.3, whose chain
// bends under gravity alone; drag is added here (see blade_shape.h). With c_j, s_j cosine and sine of T_j, and
// f_i = load c_i |c_i|, the torque about joint n is that of gravity and, of segment i,
//     f_i (C c_i + S s_i + 1/2),   C = sum_{j=n..i-1} c_j,   S = sum_{j=n..i-1} s_j.

#include <algorithm>
#include <cmath>

#include "vegetation/blade_chain.h"

namespace sward {

namespace {

/// A chain at given angles: sines, cosines, drag and the drag's derivative of each segment.
struct Posture {
  std::vector<double> sine, cosine, drag, change;
  Posture(std::span<const double> phi, double load) {
    double inclination = 0.0;
    for (const double angle : phi) {
      inclination += angle;
      const double s = std::sin(inclination), c = std::cos(inclination);
      sine.push_back(s);
      cosine.push_back(c);
      drag.push_back(load * c * std::abs(c));
      change.push_back(-2.0 * load * std::abs(c) * s);
    }
  }
};

/// d r_n / d T_p for p = n.. of one joint n.
void row_by_inclination(const Posture& at, int n, std::vector<double>& row) {
  const int segments = int(row.size());
  // What lies beyond p is turned by p's inclination as a whole.
  double beyond_sine = 0.0, beyond_cosine = 0.0;
  for (int i = segments - 1; i >= n; --i) {
    const double s = at.sine[i], c = at.cosine[i];
    row[i] = weight_lever(segments, i) * c + beyond_sine * c - beyond_cosine * s;
    beyond_sine += at.drag[i] * s;
    beyond_cosine += at.drag[i] * c;
  }
  double to_sine = 0.0, to_cosine = 0.0;
  for (int p = n; p < segments; ++p) {
    const double s = at.sine[p], c = at.cosine[p];
    row[p] += at.change[p] * (to_cosine * c + to_sine * s + 0.5) + at.drag[p] * (to_sine * c - to_cosine * s);
    to_sine += s;
    to_cosine += c;
  }
}

std::vector<double> wind_jacobian(std::span<const double> phi, double k_prime, double load) {
  const int n = int(phi.size());
  const Posture at(phi, load);
  std::vector<double> matrix(size_t(n) * size_t(n)), row(phi.size());
  for (int joint = 0; joint < n; ++joint) {
    row_by_inclination(at, joint, row);
    double sum = 0.0;
    // An angle turns every segment from its own on.
    for (int m = n - 1; m >= 0; --m) {
      if (m >= joint) sum += row[m];
      matrix[joint * n + m] = sum - (m == joint ? k_prime : 0.0);
    }
  }
  return matrix;
}

/// On the branch that is followed every joint bends with the wind.
bool bends_one_way(std::span<const double> phi) {
  return std::all_of(phi.begin(), phi.end(), [](double angle) { return angle > -1.0e-9; });
}

/// Newton's method from `phi`. False when it does not settle within a few steps, or on another branch.
bool settle(std::vector<double>& phi, double k_prime, double load) {
  for (int iteration = 0; iteration < 16; ++iteration) {
    std::vector<double> step = wind_residual(phi, k_prime, load);
    std::vector<double> matrix = wind_jacobian(phi, k_prime, load);
    if (!solve_linear(matrix, step)) return false;
    double largest = 0.0;
    for (size_t n = 0; n < phi.size(); ++n) {
      phi[n] -= step[n];
      largest = std::max(largest, std::abs(step[n]));
    }
    if (!(largest < 1.0)) return false;
    if (largest < 1.0e-12) return bends_one_way(phi);
  }
  return false;
}

/// Follows the branch from the load `from` to `to`, in steps of the load's root, which is as the wind's speed.
bool follow_wind(std::vector<double>& phi, double k_prime, double from, double to) {
  double at = std::sqrt(from), step = 0.25;
  const double end = std::sqrt(to);
  while (at < end) {
    const double next = std::min(end, at + step);
    std::vector<double> trial = phi;
    if (settle(trial, k_prime, next * next)) {
      phi = std::move(trial);
      at = next;
    } else {
      step *= 0.5;
      if (step < 1.0e-7) return false;
    }
  }
  return true;
}

}  // namespace

std::vector<double> wind_residual(std::span<const double> phi, double k_prime, double load) {
  const int n = int(phi.size());
  std::vector<double> residual = blade_residual(phi, k_prime);
  if (load == 0.0) return residual;
  const Posture at(phi, load);
  for (int joint = 0; joint < n; ++joint) {
    double to_sine = 0.0, to_cosine = 0.0;
    for (int i = joint; i < n; ++i) {
      residual[joint] += at.drag[i] * (to_cosine * at.cosine[i] + to_sine * at.sine[i] + 0.5);
      to_sine += at.sine[i];
      to_cosine += at.cosine[i];
    }
  }
  return residual;
}

Expected<std::vector<double>> wind_equilibrium(int segments, double k_prime, double load) {
  if (!(load >= 0.0) || !std::isfinite(load))
    return fail("blade's wind load is " + std::to_string(load) + " but must be 0 or more and finite");
  auto phi = blade_equilibrium(segments, k_prime);
  if (!phi || load == 0.0) return phi;
  if (!follow_wind(*phi, k_prime, 0.0, load)) {
    return fail("blade of " + std::to_string(segments) + " segments with k' " + std::to_string(k_prime) +
                ": no equilibrium was found at the wind load " + std::to_string(load));
  }
  return phi;
}

namespace {

constexpr double k_half_speed = 6.0;   // m/s: half way along the axis of winds
constexpr double k_most_speed = 40.0;  // m/s: of the last layer

/// Length of a curve of k_blade_rows points as `pieces` straight ones.
double inscribed_length(const std::vector<glm::vec4>& rows, int pieces) {
  const double last = double(rows.size() - 1);
  glm::dvec2 before(0.0);
  double length = 0.0;
  for (int i = 1; i <= pieces; ++i) {
    const double place = last * i / pieces;
    const size_t below = std::min(size_t(place), rows.size() - 2);
    const glm::dvec2 here = glm::mix(glm::dvec2(rows[below]), glm::dvec2(rows[below + 1]), place - double(below));
    length += glm::distance(before, here);
    before = here;
  }
  return length;
}

class WindTable {
 public:
  WindTable() { shapes_.texels.resize(size_t(k_wind_layers) * k_blade_rows * k_blade_columns); }

  /// All layers of one stiffness.
  Expected<void> fill(int column) {
    const double stiffness = double(column) / double(k_blade_columns - 1), k_prime = blade_k_prime(stiffness);
    auto phi = blade_equilibrium(k_blade_rows - 1, k_prime);
    if (!phi) return tl::unexpected(phi.error());
    const std::vector<glm::vec4> calm = lay_out(*phi);
    for (int layer = 0; layer < k_calm_layer; ++layer) {
      std::vector<double> raised = *phi;
      for (double& angle : raised) angle *= double(layer) / k_calm_layer;
      store(layer, column, lay_out(raised), calm);
    }
    store(k_calm_layer, column, calm, calm);
    double before = 0.0;
    for (int layer = k_calm_layer + 1; layer < k_wind_layers; ++layer) {
      const double load = wind_load(wind_of_layer(layer), stiffness);
      if (!follow_wind(*phi, k_prime, before, load))
        return fail("no equilibrium of stiffness " + std::to_string(stiffness) + " in wind was found");
      store(layer, column, lay_out(*phi), calm);
      before = load;
    }
    return {};
  }

  WindShapes take() { return std::move(shapes_); }

 private:
  void store(int layer, int column, std::vector<glm::vec4> rows, const std::vector<glm::vec4>& calm) {
    for (int row = 0; row < k_blade_rows; ++row) {
      const int pieces = std::min(row + 1, k_blade_rows - 1);
      rows[row].w = float(inscribed_length(calm, pieces) / inscribed_length(rows, pieces));
      shapes_.texels[size_t((layer * k_blade_rows + row) * k_blade_columns + column)] = rows[row];
    }
  }

  WindShapes shapes_;
};

Expected<WindShapes> solve_wind_shapes() {
  WindTable table;
  for (int column = 0; column < k_blade_columns; ++column)
    if (auto filled = table.fill(column); !filled) return tl::unexpected(filled.error());
  return table.take();
}

}  // namespace

double wind_of_layer(double layer) {
  constexpr double k_end = k_most_speed / (k_most_speed + k_half_speed);
  const double share = k_end * std::clamp(layer - k_calm_layer, 0.0, double(k_wind_layers - 1 - k_calm_layer)) /
                       (k_wind_layers - 1 - k_calm_layer);
  return k_half_speed * share / (1.0 - share);
}

double wind_load(double wind, double stiffness) {
  return 0.02 * wind * wind * (1.1 - std::clamp(stiffness, 0.0, 1.0));
}

Expected<WindShapes> make_wind_shapes() {
  static const Expected<WindShapes> shapes = solve_wind_shapes();
  return shapes;
}

}  // namespace sward
