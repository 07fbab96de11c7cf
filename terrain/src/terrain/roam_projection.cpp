// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// How long a finding lasts. Let the eye travel up to T metres and the view turn by up to A radians.
//
// Sides. A point R metres away moves by at most m = T + A (R + T) in the eye's axes, and its distance to a halfspace
// changes by at most m.
//
// Priorities. p = 2 e N / D; N the length of V = (x, y), the largest of the corners; D = (w - C e)(w + C e), w the
// least of the corners. V is bilinear: x = (row_x ^ row_w)(vertical, P) = (row_x x row_w) . (vertical x P), y alike.
// First order, for the corner a of the largest N and the corner b of the least w, with u = V / N:
//   d ln p = u . dV / N - (2 w / D) dw
// Travel by t gives dV = -(grad x, grad y) t, dw = -row_w t; a turn by the vector o gives dx = o . ((row_x x row_w) x
// (vertical x P)), dw = o . (row_w x P). So the rate is at most |G_t| a metre and |G_o| a radian, where G_t and G_o add
// up those terms: what moves N and w the same way cancels, as it does on screen.
//
// What that leaves out, with k = |dV| / N and h = |dw| / (w - C e) a tick, s = R A^2 / 2 + T A a tick what turning and
// travelling is more than linear by:
//   - ln N' <= ln N + u . dV / N + k^2 / 2, and >= ln N + u . dV / N - k^2 while k <= 1/2;
//   - -ln D' <= -ln D - (2 w / D) dw + 2 h^2 while h <= 1/2, and >= the same without h^2;
//   - another corner may take over: its direction differs from u, its arm from that of a or b by a side's length; only
//     upwards, since the largest is never below what a has become;
//   - C changes by |row_w| A.
// So after n ticks |ln p' - ln p| <= L n + Q n^2, which is solved for the n at which the guard may be reached. Ticks in
// which the guard moves by log_guard are counted beside those of motion; L n + Q n^2 is convex, so the lesser of the
// two numbers of ticks holds for any mixture.
#include "roam_projection.h"

#include <cmath>

namespace sward::roam {

namespace {

// A halfspace at infinity is one that everything satisfies by far.
constexpr double k_infinitely_inside = 1e30;
// Of single precision, over the arithmetic below.
constexpr float k_rounding = 1.001f;

double size_of_bivector(glm::dvec4 a, glm::dvec4 b) {
  return glm::length(glm::cross(glm::dvec3(a), glm::dvec3(b)));
}

}  // namespace

Projection::Projection(const View& view) : eye_(view.eye) {
  const std::array<Plane, 6> planes = frustum_planes(view);
  std::array<glm::dvec4, Forms::k_forms> forms{};
  for (size_t i = 0; i < 6; ++i) {
    const bool infinite = planes[i].n == glm::dvec3(0.0);
    forms[i] = glm::dvec4(planes[i].n, infinite ? k_infinitely_inside : planes[i].d);
    reach_.set(int(i), float(std::abs(planes[i].n.z)));
  }
  const glm::dmat4 rows = glm::transpose(view.clip_from_relative());
  const glm::dvec4 to_x = rows[0] * (0.5 * view.viewport.x), to_y = rows[1] * (0.5 * view.viewport.y), to_w = rows[3];
  forms[Forms::k_x] = to_x.z * to_w - to_w.z * to_x;
  forms[Forms::k_y] = to_y.z * to_w - to_w.z * to_y;
  forms[Forms::k_w] = to_w;
  for (int i = 0; i < Forms::k_forms; ++i) {
    form_x_.set(i, float(forms[size_t(i)].x));
    form_y_.set(i, float(forms[size_t(i)].y));
    form_z_.set(i, float(forms[size_t(i)].z));
    form_1_.set(i, float(forms[size_t(i)].w));
  }
  depth_per_metre_ = float(std::abs(to_w.z));
  x_axis_ = glm::vec3(forms[Forms::k_x]);
  y_axis_ = glm::vec3(forms[Forms::k_y]);
  w_axis_ = glm::vec3(forms[8]);
  x_turn_ = glm::vec3(glm::cross(glm::dvec3(to_x), glm::dvec3(to_w)));
  y_turn_ = glm::vec3(glm::cross(glm::dvec3(to_y), glm::dvec3(to_w)));
  const auto constants = [&](glm::dvec4 a) {
    return glm::length(glm::dvec3(a)) * std::abs(to_w.w) + glm::length(glm::dvec3(to_w)) * std::abs(a.w);
  };
  thickness_per_metre_ = float(std::hypot(size_of_bivector(to_x, to_w), size_of_bivector(to_y, to_w)));
  thickness_per_radian_ = float(std::hypot(constants(to_x), constants(to_y)));
  depth_rate_ = float(glm::length(glm::dvec3(to_w)));
}

Reading Projection::read(const Wedgie& wedgie) const {
  Reading r;
  if (wedgie.bound < 0) return r;
  r.bound = wedgie.bound;
  r.at[0] = glm::vec3(wedgie.apex - eye_);
  r.at[1] = r.at[0] + wedgie.to_left;
  r.at[2] = r.at[0] + wedgie.to_right;
  for (int corner = 0; corner < 3; ++corner) r.form[corner] = project(r.at[corner]);
  const auto& [a, b, c] = r.form;
  const Lanes first = larger(a.lane[0], larger(b.lane[0], c.lane[0])) + r.bound * reach_.lane[0];
  const Lanes second = larger(a.lane[1], larger(b.lane[1], c.lane[1])) + r.bound * reach_.lane[1];
  r.farthest[0] = first;
  r.farthest[1] = second;
  r.outside =
      std::min(std::min(std::min(first[0], first[1]), std::min(first[2], first[3])), std::min(second[0], second[1]));
  r.near_inside = std::min(a.side(4), std::min(b.side(4), c.side(4))) - r.bound * reach_.side(4);
  if (r.out()) return r;
  const float nearest = std::min(a.w(), std::min(b.w(), c.w()));
  r.priority = priority(thickness(a, b, c), nearest, r.bound, r.near_inside >= 0);
  return r;
}

void Projection::expect(const Projection& before, double ticks) {
  if (!(ticks > 0)) return;
  const glm::vec3 travel(eye_ - before.eye_);
  const float per_tick = float(1 / ticks);
  for (int i = 0; i < 2; ++i) {
    rate_x_[i] = per_tick * (form_x_.lane[i] - before.form_x_.lane[i]);
    rate_y_[i] = per_tick * (form_y_.lane[i] - before.form_y_.lane[i]);
    rate_z_[i] = per_tick * (form_z_.lane[i] - before.form_z_.lane[i]);
    // A point at p now was at p + travel, seen from the last eye.
    rate_1_[i] = per_tick * (form_1_.lane[i] - before.form_1_.lane[i] - before.form_x_.lane[i] * travel.x -
                             before.form_y_.lane[i] * travel.y - before.form_z_.lane[i] * travel.z);
  }
}

float Projection::ticks_to_leave(const Reading& r) const {
  const glm::vec3 p = (r.at[0] + r.at[1] + r.at[2]) / 3.0f;
  float least = Calendar::k_span;
  for (int i = 0; i < 2; ++i) {
    const Lanes rate = rate_x_[i] * p.x + rate_y_[i] * p.y + rate_z_[i] * p.z + rate_1_[i];
    for (int lane = 0; lane < (i == 0 ? 4 : 2); ++lane)
      if (rate[lane] * least < -r.farthest[i][lane]) least = -r.farthest[i][lane] / rate[lane];
  }
  return least;
}

// What a tick may change a wedgie's priority by: L and Q upwards and downwards, and the ticks for which they hold.
struct Projection::Change {
  float linear_up = 0, linear_down = 0, square_up = 0, square_down = 0, valid = 0;
  float range = 0;  // of the farthest corner, metres
};

float Projection::side_ticks(const Reading& r, const TickUnits& units) const {
  const glm::vec3 &p = r.at[0], &q = r.at[1], &t = r.at[2];
  const float range = std::sqrt(std::max(glm::dot(p, p), std::max(glm::dot(q, q), glm::dot(t, t)))) + r.bound;
  const float slack = std::abs(r.outside);
  return slack / (units.metres + units.radians * (range + slack));
}

Projection::Change Projection::change_of(const Reading& r, const TickUnits& units) const {
  int a = 0, b = 0;
  float x[3], y[3], square[3], range2 = 0;
  const glm::vec3* p = r.at;
  for (int i = 0; i < 3; ++i) {
    x[i] = r.form[i].x();
    y[i] = r.form[i].y();
    square[i] = x[i] * x[i] + y[i] * y[i];
    range2 = std::max(range2, glm::dot(p[i], p[i]));
    if (square[i] > square[a]) a = i;
    if (r.form[i].w() < r.form[b].w()) b = i;
  }
  const float n = std::sqrt(square[a]), inverse = 1 / n, w = r.form[b].w();
  const float reach = r.bound * depth_per_metre_;
  const float margin = w - reach, per_depth = 2 * w / (margin * (w + reach));
  const float ux = x[a] * inverse, uy = y[a] * inverse;
  // Vertical x P.
  const glm::vec3 arm(-p[a].y, p[a].x, 0);
  const glm::vec3 travel = inverse * (ux * x_axis_ + uy * y_axis_) - per_depth * w_axis_;
  const glm::vec3 turn =
      inverse * (ux * glm::cross(x_turn_, arm) + uy * glm::cross(y_turn_, arm)) - per_depth * glm::cross(w_axis_, p[b]);
  const float range = std::sqrt(range2) + r.bound, side = glm::length(p[1] - p[2]);
  const float metres = units.metres + units.radians * range;
  const float more = 0.5f * range * units.radians * units.radians + units.metres * units.radians;
  const float k = (thickness_per_metre_ * metres + thickness_per_radian_ * units.radians) * inverse;
  const float h = depth_rate_ * metres / margin;
  float spread = 0;
  for (int i = 0; i < 3; ++i) {
    const float dx = x[i] - x[a], dy = y[i] - y[a];
    spread = std::max(spread, dx * dx + dy * dy);
  }
  spread = 2 * std::sqrt(spread) * inverse;
  Change c;
  c.linear_down = glm::length(travel) * units.metres + glm::length(turn) * units.radians +
                  thickness_per_radian_ * inverse * units.radians +
                  2 * reach * r.bound * depth_rate_ * units.radians / (margin * (w + reach));
  c.linear_up =
      c.linear_down + spread * k + side * units.radians * (thickness_per_metre_ * inverse + 2 * depth_rate_ / margin);
  const float reach_turn = r.bound * depth_rate_ * units.radians / margin;
  const float curved =
      thickness_per_metre_ * more * inverse + 2 * depth_rate_ * more / margin + 2 * reach_turn * reach_turn;
  c.square_up = 0.5f * k * k + 2 * h * h + curved;
  c.square_down = k * k + curved;
  c.valid = 0.5f / std::max(k, h);
  c.range = range;
  return c;
}

namespace {

// The n > 0 at which l n + q n^2 = limit.
float solve(float l, float q, float limit) {
  return 2 * limit / (l + std::sqrt(l * l + 4 * q * limit));
}

}  // namespace

float Projection::below_ticks(const Reading& r, float guard, const TickUnits& units) const {
  if (r.priority * k_rounding > guard) return 0;
  if (r.bound <= 0) return float(Calendar::k_span);
  if (!(r.priority > 0) || r.near_inside <= 0) return 0;
  const Change c = change_of(r, units);
  const float limit = std::log(guard / (r.priority * k_rounding));
  const float near_ticks = r.near_inside / (units.metres + units.radians * (c.range + r.near_inside));
  return std::min(std::min(solve(c.linear_up, c.square_up, limit), limit / units.log_guard),
                  std::min(c.valid, near_ticks));
}

float Projection::above_ticks(const Reading& r, float guard, const TickUnits& units) const {
  if (r.priority <= guard * k_rounding || r.priority >= RoamMesh::k_artificial_max) return 0;
  const Change c = change_of(r, units);
  const float limit = std::log(r.priority / (guard * k_rounding));
  return std::min(std::min(solve(c.linear_down, c.square_down, limit), limit / units.log_guard), c.valid);
}

}  // namespace sward::roam
