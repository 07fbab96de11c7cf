// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
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
SWARD_API Expected<std::vector<double>> blade_equilibrium(int segments, double k_prime);

/// Left-hand sides of the N equations.
SWARD_API std::vector<double> blade_residual(std::span<const double> phi, double k_prime);

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
SWARD_API double blade_k_prime(double stiffness);
/// Some 50 ms, once a process. Any thread.
SWARD_API Expected<BladeShapes> make_blade_shapes();

/// Equilibrium of the same chain in a wind that blows level in the bending plane, towards positive inclinations. Drag
/// on a segment is square to it and goes with the square of the wind's part that is (the cross-flow principle of
/// aerodynamics): `load` cos T |cos T| on an upright segment of weight 1. It vanishes as the segment lies down and
/// lifts one that hangs, so that strong wind flattens and the bend saturates. For each joint n
///   sum_{i=n..N} [ sum_{j=n..i-1} sin T_j + sin(T_i) / 2
///                  + load cos T_i |cos T_i| ( sum_{j=n..i-1} cos(T_j - T_i) + 1/2 ) ] - k' phi_n = 0.
/// On the branch that starts from blade_equilibrium(), followed as the load grows; fails as that does, on a load below
/// 0 or not finite, and where the branch is lost.
SWARD_API Expected<std::vector<double>> wind_equilibrium(int segments, double k_prime, double load);

/// Left-hand sides of the N equations.
SWARD_API std::vector<double> wind_residual(std::span<const double> phi, double k_prime, double load);

/// Shapes over stiffness and wind, for plants that move. Layers of the size of BladeShapes, one after the other:
/// ```
///  layer 0 straight ... k_calm_layer as BladeShapes, bit by bit ... last: wind_of_layer() m/s, flat
/// ```
/// Below k_calm_layer a plant that is pushed against its own bend rises: its inclinations are those of the calm in
/// proportion. w: length of the calm's curve as row + 1 straight pieces, against this curve's; 1 in the calm layer.
/// Times that, a line of row + 1 segments is as long in wind as it is in calm.
inline constexpr int k_calm_layer = 12;
inline constexpr int k_wind_layers = 30;
struct WindShapes {
  std::vector<glm::vec4> texels;  ///< k_wind_layers layers of k_blade_rows rows of k_blade_columns.
};
/// Wind at the plant of a layer, m/s; below k_calm_layer 0. Layers above it stand at equal steps of v / (v + 6 m/s).
SWARD_API double wind_of_layer(double layer);
/// Drag of a wind (m/s, at the plant) on an upright segment against its weight: that of a leaf 0.3 mm thick, a stiffer
/// plant being a thicker one.
SWARD_API double wind_load(double wind, double stiffness);
/// Some 0.2 s the first time, then a copy. Any thread.
SWARD_API Expected<WindShapes> make_wind_shapes();

}  // namespace sward
