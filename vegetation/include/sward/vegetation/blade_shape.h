// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/error.h>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace sward {

/// Equilibrium of a chain of N rigid segments of unit length and weight on spring hinges (Papavasiliou 2015, section
/// 2.3, equation 12 as mended in docs/papers.md): for each joint n
///   sum_{i=n..N} [ sum_{j=n..i-1} sin T_j + sin(T_i) / 2 ] - k' phi_n = 0,   T_i = phi_1 + ... + phi_i.
/// Returns phi_1..phi_N (radians) on the bent branch, reached by continuation from small k'; fails when there is none
/// (k' above the critical value of about 5.7 for N = 3, 79 for N = 8, 574 for N = 16) or N or k' is out of range
/// (1..64, > 0).
Expected<std::vector<double>> blade_equilibrium(int segments, double k_prime);

/// Left-hand sides of the N equations.
std::vector<double> blade_residual(std::span<const double> phi, double k_prime);

/// Shapes over stiffness 0..1, solved once at N = 16: `columns` stiffnesses by k_blade_rows points at equal arc length
/// from root (row 0) to tip. x: lateral deflection, y: height, both in blade lengths; z: inclination T from the
/// vertical, radians, of the segments that meet at the point (their mean; the only one at root and tip). Segments that
/// would pass below the ground lie on it, length kept. Column c holds stiffness c / (k_blade_columns - 1); 1 is nearly
/// straight. A chain of any other number of segments samples this curve by arc length.
inline constexpr int k_blade_rows = 17;
inline constexpr int k_blade_columns = 64;
struct BladeShapes {
  std::vector<glm::vec4> texels;  ///< k_blade_rows rows of k_blade_columns; w unused (0).
};
/// k' at N = 16 of a stiffness in [0, 1], increasing: 0 hangs to the ground, 1 is just below the critical value.
double blade_k_prime(double stiffness);
/// Some 50 ms. Any thread.
Expected<BladeShapes> make_blade_shapes();

}  // namespace sward
