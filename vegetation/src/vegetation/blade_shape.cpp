// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Equilibrium of a chain of hinged segments under its own weight.
//
// After D. Papavasiliou, "Real-Time Grass (and Other Procedural Objects) on Terrain" (2015), section 2.3, with equation
// 12 mended: the subtraction belongs inside the outer sum, and the spring's angle is that of the joint. Collecting the
// sines, the torque about joint n is
//     r_n = sum_{j=n..N} w_j sin T_j - k' phi_n,     w_j = N - j + 1/2,     T_j = phi_1 + ... + phi_j.
//
// Straight up (all phi 0) solves this for every k'. The bent branch leaves it at the critical stiffness: linearised at
// 0, k' phi = A phi with A_nm = sum_{j >= max(n,m)} w_j = (N - max(n,m) + 1)^2 / 2, so the critical k' is the largest
// eigenvalue of A. At k' = 0 the branch is known as well: the chain hangs, phi = (pi, 0, ..., 0). Near the critical
// value its amplitude goes as s = sqrt(1 - k'/k'_c), along which the branch is smooth; Newton's method follows it from
// s = 1 down.

#include "vegetation/blade_chain.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace sward {

namespace {

constexpr int k_most_segments = 64;
constexpr double k_pi = std::numbers::pi;

/// Largest eigenvalue of A above, by power iteration (A is positive, its eigenvalues lie far apart).
double critical_k_prime(int segments) {
  std::vector<double> v(size_t(segments), 1.0), next(v.size());
  double value = 0.0;
  for (int iteration = 0; iteration < 200; ++iteration) {
    double length = 0.0;
    for (int n = 0; n < segments; ++n) {
      next[n] = 0.0;
      for (int m = 0; m < segments; ++m) {
        const double span = segments - std::max(n, m);
        next[n] += 0.5 * span * span * v[m];
      }
      length += next[n] * next[n];
    }
    value = std::sqrt(length);
    for (int n = 0; n < segments; ++n) v[n] = next[n] / value;
  }
  return value;
}

/// d r_n / d phi_m = sum_{j >= max(n,m)} w_j cos T_j - k' [n = m].
std::vector<double> jacobian(std::span<const double> phi, double k_prime) {
  const int n = int(phi.size());
  std::vector<double> tail(phi.size());
  double inclination = 0.0;
  for (int j = 0; j < n; ++j) {
    inclination += phi[j];
    tail[j] = weight_lever(n, j) * std::cos(inclination);
  }
  for (int j = n - 2; j >= 0; --j) tail[j] += tail[j + 1];
  std::vector<double> matrix(size_t(n) * size_t(n));
  for (int row = 0; row < n; ++row) {
    for (int column = 0; column < n; ++column) {
      matrix[row * n + column] = tail[std::max(row, column)] - (row == column ? k_prime : 0.0);
    }
  }
  return matrix;
}

/// Newton's method from `phi`. False when it does not settle within a few steps, or leaves the bent branch.
bool settle(std::vector<double>& phi, double k_prime) {
  for (int iteration = 0; iteration < 12; ++iteration) {
    std::vector<double> step = blade_residual(phi, k_prime);
    std::vector<double> matrix = jacobian(phi, k_prime);
    if (!solve_linear(matrix, step)) return false;
    double largest = 0.0, tip = 0.0;
    for (size_t n = 0; n < phi.size(); ++n) {
      phi[n] -= step[n];
      largest = std::max(largest, std::abs(step[n]));
      tip += phi[n];
    }
    if (!(largest < 1.0) || !(tip > 0.0) || tip > 1.5 * k_pi) return false;
    if (largest < 1.0e-13) return true;
  }
  return true;
}

/// Follows the bent branch from hanging (s = 1) to `target`, halving the step where Newton's method loses it.
bool follow_branch(std::vector<double>& phi, double critical, double target) {
  double s = 1.0, step = 1.0 / 32.0;
  while (s > target) {
    const double next = std::max(target, s - step);
    std::vector<double> trial = phi;
    // The amplitude goes as s close to the critical stiffness, which makes the better first guess there.
    if (s < 0.3) {
      for (double& angle : trial) angle *= next / s;
    }
    if (settle(trial, critical * (1.0 - next * next))) {
      phi = std::move(trial);
      s = next;
      step = std::min(step * 1.5, 1.0 / 32.0);
    } else {
      step *= 0.5;
      if (step < 1.0e-7) return false;
    }
  }
  return true;
}

}  // namespace

std::vector<double> blade_residual(std::span<const double> phi, double k_prime) {
  const int n = int(phi.size());
  std::vector<double> residual(phi.size());
  double inclination = 0.0;
  for (int j = 0; j < n; ++j) {
    inclination += phi[j];
    residual[j] = weight_lever(n, j) * std::sin(inclination);
  }
  for (int j = n - 2; j >= 0; --j) residual[j] += residual[j + 1];
  for (int j = 0; j < n; ++j) residual[j] -= k_prime * phi[j];
  return residual;
}

Expected<std::vector<double>> blade_equilibrium(int segments, double k_prime) {
  if (segments < 1 || segments > k_most_segments) {
    return fail("blade of " + std::to_string(segments) + " segments: the number must lie in [1, 64]");
  }
  if (!(k_prime > 0.0) || !std::isfinite(k_prime)) {
    return fail("blade's k' is " + std::to_string(k_prime) + " but must be more than 0 and finite");
  }
  const double critical = critical_k_prime(segments);
  const double s_squared = 1.0 - k_prime / critical;
  const std::string name = "blade of " + std::to_string(segments) + " segments with k' " + std::to_string(k_prime);
  if (!(s_squared > 1.0e-8)) {
    return fail(name + ": it stands straight from k' " + std::to_string(critical) + " on; give a smaller one");
  }
  std::vector<double> phi(size_t(segments), 0.0);
  phi[0] = k_pi;
  if (!follow_branch(phi, critical, std::sqrt(s_squared))) return fail(name + ": no equilibrium was found");
  return phi;
}

double blade_k_prime(double stiffness) {
  static const double critical = critical_k_prime(k_blade_rows - 1);
  // s = sqrt(1 - k'/k'_c) falls evenly: the tip's deflection goes as s for stiff blades, so that equal steps of
  // stiffness look equal. Softer than 0.72 a blade only lies on the ground.
  constexpr double k_hanging = 0.72, k_straight = 0.04;
  const double t = std::clamp(stiffness, 0.0, 1.0);
  const double s = k_hanging + (k_straight - k_hanging) * t;
  return critical * (1.0 - s * s);
}

namespace {

Expected<BladeShapes> solve_blade_shapes() {
  BladeShapes shapes;
  shapes.texels.resize(size_t(k_blade_rows) * size_t(k_blade_columns));
  for (int column = 0; column < k_blade_columns; ++column) {
    const double stiffness = double(column) / double(k_blade_columns - 1);
    const auto phi = blade_equilibrium(k_blade_rows - 1, blade_k_prime(stiffness));
    if (!phi) return tl::unexpected(phi.error());
    const std::vector<glm::vec4> rows = lay_out(*phi);
    for (size_t row = 0; row < rows.size(); ++row) shapes.texels[row * k_blade_columns + size_t(column)] = rows[row];
  }
  return shapes;
}

}  // namespace

Expected<BladeShapes> make_blade_shapes() {
  static const Expected<BladeShapes> shapes = solve_blade_shapes();
  return shapes;
}

}  // namespace sward
