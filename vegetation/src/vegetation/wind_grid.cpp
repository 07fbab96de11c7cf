// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Lee, "Realistic Real-Time Grass Rendering" (2010), "Wind Simulation": a bell curve of acceleration ahead of what
// moves, Euler steps, damped acceleration, velocity diffused among neighbours, a grid that follows in whole cells. Here
// steps are fixed and damping is their exact exponential, so that nothing depends on the frame rate; velocity is damped
// too, which diffusion alone does not bring to rest; and cells stay where they are in memory.
#include "vegetation/wind_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace sward {

namespace {

constexpr double k_acceleration_s = 0.12;  // in which a push falls to 37 %
constexpr double k_diffusion = 0.25;       // m2/s
constexpr float k_rest = 2e-3f;            // m/s: slower rows come to rest
constexpr float k_nothing = 1e-7f;         // m/s: less would end in denormals, which are slow
constexpr float k_bell_reach = 2.5f;       // radii: beyond, the curve is under 1.2 % of its top
constexpr float k_bell_top = 0.42888194f;  // of x exp(-x^2), at 0.71

const float k_keep_acceleration = float(std::exp(-k_wind_step_s / k_acceleration_s));
const float k_keep_velocity = float(std::exp(-k_wind_step_s / k_wind_rest_s));

bool moving(glm::vec2 v) {
  return std::abs(v.x) > k_rest || std::abs(v.y) > k_rest;
}

struct Neighbours {
  const glm::vec2 *above, *old, *below;
};

// Sizes of floats are ordered as their bits are: comparing those keeps the loop below free of branches.
constexpr int32_t k_size_bits = 0x7FFFFFFF, k_nothing_bits = std::bit_cast<int32_t>(k_nothing);

/// The bits of a speed, 0 where it is next to nothing.
inline int32_t without_denormals(float speed) {
  const auto bits = std::bit_cast<int32_t>(speed);
  return bits & -int32_t((bits & k_size_bits) > k_nothing_bits);
}

/// Cells `from` up to `to` of a row, as a plain loop over floats, which compilers make wide. Returns whether any moves.
bool step_cells(const Neighbours& rows, const glm::vec2* force, size_t from, size_t to, float diffusion,
                glm::vec2* velocity, glm::vec2* acceleration) {
  const float *const up = &rows.above->x, *const down = &rows.below->x, *const old = &rows.old->x;
  const float* const push = &force->x;
  float* __restrict const v = &velocity->x, * __restrict const a = &acceleration->x;
  const float keep_a = k_keep_acceleration, keep_v = k_keep_velocity;
  int32_t most = 0;
  for (size_t i = 2 * from; i < 2 * to; ++i) {
    const float around = 0.25f * (up[i] + down[i] + old[i - 2] + old[i + 2]);
    // In m/s: acceleration times the time in which velocity is damped.
    const int32_t pushed = without_denormals(keep_a * a[i] + (1 - keep_a) * push[i]);
    a[i] = std::bit_cast<float>(pushed);
    const float moved = keep_v * (old[i] + diffusion * (around - old[i])) + (1 - keep_v) * std::bit_cast<float>(pushed);
    const int32_t kept = without_denormals(moved);
    v[i] = std::bit_cast<float>(kept);
    most = std::max(most, std::max(kept & k_size_bits, pushed & k_size_bits));
  }
  return std::bit_cast<float>(most) > k_rest;
}

}  // namespace

WindGrid::WindGrid(int side, double cell_m)
    : side_(side),
      cell_m_(cell_m),
      diffusion_(float(1.0 - std::exp(-4.0 * k_diffusion * k_wind_step_s / (cell_m * cell_m)))),
      first_(-side / 2),
      velocity_(size_t(side) * size_t(side)),
      acceleration_(velocity_.size()),
      force_(velocity_.size()),
      stamps_(size_t(side)),
      live_(size_t(side)),
      forced_(size_t(side)),
      first_row_(size_t(side)),
      kept_{first_row_, first_row_} {}

glm::vec2 WindGrid::sample(glm::vec2 uv) const {
  const glm::vec2 q = (uv - glm::floor(uv)) * float(side_) - 0.5f, corner = glm::floor(q), f = q - corner;
  const auto cell = [&](int x, int y) {
    return velocity_[row_begin(int(corner.y) + y) + size_t((int(corner.x) + x) & (side_ - 1))];
  };
  return glm::mix(glm::mix(cell(0, 0), cell(1, 0), f.x), glm::mix(cell(0, 1), cell(1, 1), f.x), f.y);
}

void WindGrid::clear() {
  if (live_rows_ == 0) return;
  ++stamp_;
  for (int row = 0; row < side_; ++row) forget_row(row);
}

void WindGrid::forget_row(int64_t row) {
  const size_t at = size_t(row & (side_ - 1)), begin = row_begin(row), end = begin + size_t(side_);
  if (!live_[at]) return;
  std::fill(velocity_.begin() + begin, velocity_.begin() + end, glm::vec2(0));
  std::fill(acceleration_.begin() + begin, acceleration_.begin() + end, glm::vec2(0));
  live_[at] = 0;
  --live_rows_;
  stamps_[at] = stamp_;
}

void WindGrid::forget_column(int64_t column) {
  for (size_t row = 0; row < size_t(side_); ++row) {
    if (!live_[row]) continue;
    const size_t at = row * size_t(side_) + size_t(column & (side_ - 1));
    velocity_[at] = acceleration_[at] = glm::vec2(0);
    stamps_[row] = stamp_;
  }
}

void WindGrid::follow(glm::dvec2 eye) {
  const glm::i64vec2 first = glm::i64vec2(glm::floor(eye / cell_m_)) - int64_t(side_ / 2);
  const glm::i64vec2 by = first - first_;
  first_ = first;
  if (live_rows_ == 0 || by == glm::i64vec2(0)) return;
  if (std::max(std::abs(by.x), std::abs(by.y)) >= side_) return clear();
  ++stamp_;
  // What it leaves, what it enters, and the ring around, all of which are the same cells in memory.
  const auto each = [&](int64_t from, int64_t steps, auto&& forget) {
    const int64_t begin = steps > 0 ? from - steps : from, count = std::abs(steps);
    if (steps == 0) return;
    for (int64_t i = -1; i <= count; ++i) forget(begin + i);
  };
  each(first.x, by.x, [&](int64_t column) { forget_column(column); });
  each(first.y, by.y, [&](int64_t row) { forget_row(row); });
}

void WindGrid::push(const Push& push) {
  // Less than a cell wide it would fall between cells: it is widened, its push kept.
  const float radius = std::max(push.radius_m, float(0.8 * cell_m_));
  const float speed = push.speed * (push.radius_m / radius) * (push.radius_m / radius) / k_bell_top;
  const glm::dvec2 reach(double(k_bell_reach) * double(radius));
  const glm::i64vec2 low = glm::max(glm::i64vec2(glm::floor((push.at - reach) / cell_m_)), first_ + int64_t(1));
  const glm::i64vec2 high =
      glm::min(glm::i64vec2(glm::floor((push.at + reach) / cell_m_)), first_ + int64_t(side_ - 2));
  if (low.x > high.x || low.y > high.y) return;
  // exp(-x^2 - y^2) = exp(-x^2) exp(-y^2): one curve a column, one a row.
  const auto offset = [&](int64_t cell, double at) { return float((double(cell) + 0.5) * cell_m_ - at) / radius; };
  columns_.clear();
  for (int64_t column = low.x; column <= high.x; ++column) {
    const float x = offset(column, push.at.x);
    columns_.push_back({size_t(column & (side_ - 1)), x, std::exp(-x * x)});
  }
  for (int64_t row = low.y; row <= high.y; ++row) {
    const float y = offset(row, push.at.y);
    forced_[size_t(row & (side_ - 1))] = 1;
    push_row(y, speed * std::exp(-y * y), push.ahead, force_.data() + row_begin(row));
  }
}

void WindGrid::push_row(float y, float height, glm::vec2 ahead, glm::vec2* cells) const {
  const bool all_around = ahead == glm::vec2(0);
  for (const PushedColumn& column : columns_) {
    const glm::vec2 from(column.x, y);
    float share = height * column.bell;
    if (!all_around) {
      const float towards = from.x * ahead.x + from.y * ahead.y;
      if (towards <= 0) continue;
      share *= towards / std::sqrt(from.x * from.x + from.y * from.y);
    }
    cells[column.cell] += share * from;
  }
}

void WindGrid::step() {
  if (live_rows_ == 0 && std::find(forced_.begin(), forced_.end(), 1) == forced_.end()) return;
  ++stamp_;
  const size_t rows = size_t(side_), mask = rows - 1;
  const std::vector<uint8_t> live = live_;
  const auto row_at = [&](size_t row) { return velocity_.begin() + row * rows; };
  const size_t ring[2] = {size_t(first_.y) & mask, size_t(first_.y + side_ - 1) & mask};
  std::copy_n(row_at(0), rows, first_row_.begin());
  // Rows are stepped in place: of the one above, what it was is kept; an unstepped one still is what it was.
  const glm::vec2* above = &*row_at(rows - 1);
  for (size_t row = 0; row < rows; ++row) {
    const bool active = forced_[row] || live[row] || live[(row - 1) & mask] || live[(row + 1) & mask];
    if (!active || row == ring[0] || row == ring[1]) {
      above = &*row_at(row);
      continue;
    }
    std::vector<glm::vec2>& old = kept_[row & 1];
    std::copy_n(row_at(row), rows, old.begin());
    step_row(row, above, old.data(), row + 1 < rows ? &*row_at(row + 1) : first_row_.data());
    above = old.data();
  }
}

void WindGrid::step_row(size_t row, const glm::vec2* above, const glm::vec2* old, const glm::vec2* below) {
  const size_t side = size_t(side_), mask = side - 1, begin = row * side;
  glm::vec2* const velocity = velocity_.data() + begin;
  glm::vec2* const acceleration = acceleration_.data() + begin;
  const Neighbours rows{above, old, below};
  // The first and the last cell are neighbours on the torus.
  bool moves = step_cells(rows, force_.data() + begin, 1, side - 1, diffusion_, velocity, acceleration);
  for (const size_t i : {size_t(0), mask}) {
    const glm::vec2 around = 0.25f * (above[i] + below[i] + old[(i - 1) & mask] + old[(i + 1) & mask]);
    acceleration[i] = k_keep_acceleration * acceleration[i] + (1 - k_keep_acceleration) * force_[begin + i];
    velocity[i] = k_keep_velocity * (old[i] + diffusion_ * (around - old[i])) + (1 - k_keep_velocity) * acceleration[i];
    moves = moves || moving(velocity[i]) || moving(acceleration[i]);
  }
  for (const int64_t column : {first_.x, first_.x + side_ - 1})
    velocity[size_t(column) & mask] = acceleration[size_t(column) & mask] = glm::vec2(0);
  if (forced_[row]) std::fill(force_.begin() + begin, force_.begin() + begin + side, glm::vec2(0));
  forced_[row] = 0;
  stamps_[row] = stamp_;
  live_rows_ += int(moves) - int(live_[row]);
  live_[row] = moves;
  if (moves) return;
  std::fill(velocity, velocity + side, glm::vec2(0));
  std::fill(acceleration, acceleration + side, glm::vec2(0));
}

}  // namespace sward
