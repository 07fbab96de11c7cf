// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// What solving chains of hinged segments takes, with and without wind (blade_shape.h).
#include <sward/vegetation/blade_shape.h>

namespace sward {

/// Torque of segment j (0-based) about the joints below it, per sine of its inclination.
inline double weight_lever(int segments, int j) {
  return double(segments - j) - 0.5;
}

/// Solves a x = b in place (partial pivoting); x is left in b. False when singular.
bool solve_linear(std::vector<double>& a, std::vector<double>& b);

/// Ends of the segments, root first, in blade lengths, kept above level ground: x along, y up, z mean inclination of
/// the segments that meet there, w 0. `phi`: angles of the joints.
std::vector<glm::vec4> lay_out(std::span<const double> phi);

}  // namespace sward
