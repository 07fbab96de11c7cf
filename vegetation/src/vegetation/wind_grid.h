// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <glm/ext/vector_int2_sized.hpp>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace sward {

/// Air that movers stir: velocity and acceleration in the cells of a square around the viewer.
///
/// A cell (i, j) of the world, [i, i+1) x [j, j+1) cell sides, is kept at (i mod side, j mod side): the square follows
/// the viewer by forgetting the columns and rows that it leaves. Its outermost ring stays at rest, so that air does not
/// flow around the torus.
class WindGrid {
 public:
  /// `side` cells, a power of two.
  WindGrid(int side, double cell_m);

  int side() const { return side_; }
  double cell_m() const { return cell_m_; }
  /// How far from the viewer all cells are inside, metres.
  double reach_m() const { return (side_ / 2 - 2) * cell_m_; }
  /// m/s, rows of `side` cells.
  std::span<const glm::vec2> velocity() const { return velocity_; }
  /// The step in which a row last changed; counts from 1.
  std::span<const uint64_t> row_stamps() const { return stamps_; }
  uint64_t stamp() const { return stamp_; }
  bool at_rest() const { return live_rows_ == 0; }
  /// Bilinear, repeating; `uv` in squares.
  glm::vec2 sample(glm::vec2 uv) const;

  void follow(glm::dvec2 eye);
  void clear();

  /// Air that is pushed outwards from a place, by a bell curve whose strongest circle has 0.71 of the radius. With
  /// `ahead` of length 1 only ahead of it; zero: all around. `speed`: what the air there takes up if it lasts, m/s.
  struct Push {
    glm::dvec2 at{0};
    glm::vec2 ahead{0};
    float radius_m = 1, speed = 0;
  };
  /// For the next step().
  void push(const Push& push);
  void step();

 private:
  size_t row_begin(int64_t row) const { return size_t(row & (side_ - 1)) * size_t(side_); }
  void forget_row(int64_t row);
  void forget_column(int64_t column);
  void step_row(size_t row, const glm::vec2* above, const glm::vec2* old, const glm::vec2* below);

  int side_;
  double cell_m_;
  float diffusion_;  // share of the neighbours' mean that a cell takes on in a step
  glm::i64vec2 first_{0};
  std::vector<glm::vec2> velocity_, acceleration_, force_;
  std::vector<uint64_t> stamps_;
  std::vector<uint8_t> live_, forced_;  // rows that are not at rest; rows that are being pushed
  int live_rows_ = 0;
  uint64_t stamp_ = 0;
  std::vector<glm::vec2> first_row_;            // of a step, as it was before
  std::array<std::vector<glm::vec2>, 2> kept_;  // so too this row and the one above
  /// Of a push.
  struct PushedColumn {
    size_t cell;    // in its row
    float x, bell;  // radii from the middle; exp(-x^2)
  };
  void push_row(float y, float height, glm::vec2 ahead, glm::vec2* cells) const;
  std::vector<PushedColumn> columns_;
};

/// Seconds of WindGrid::step().
inline constexpr double k_wind_step_s = 1.0 / 120.0;
/// In which air that is not pushed slows to 37 %.
inline constexpr double k_wind_rest_s = 0.8;

}  // namespace sward
