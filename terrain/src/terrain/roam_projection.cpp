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

#include "wide.h"

namespace sward::roam {

namespace {

// A halfspace at infinity is one that everything satisfies by far.
constexpr double k_infinitely_inside = 1e30;
// Of single precision, over the arithmetic below.
constexpr float k_rounding = 1.001f;
// The same, over projections alone.
constexpr double k_error_rounding = 1.00001;

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
  for (size_t i = 0; i < Forms::k_forms; ++i)
    form_[i] = {all(float(forms[i].x)), all(float(forms[i].y)), all(float(forms[i].z)), all(float(forms[i].w))};
  depth_per_metre_ = float(std::abs(to_w.z));
  if (to_w.z != 0) {
    const glm::dvec2 beyond = glm::abs(glm::dvec2(to_x.z, to_y.z) / to_w.z) - 0.5 * glm::dvec2(view.viewport);
    vanishing_px_ = glm::length(glm::max(beyond, 0.0));
  }
  x_axis_ = glm::vec3(forms[Forms::k_x]);
  y_axis_ = glm::vec3(forms[Forms::k_y]);
  w_axis_ = glm::vec3(forms[Forms::k_w]);
  x_turn_ = glm::vec3(glm::cross(glm::dvec3(to_x), glm::dvec3(to_w)));
  y_turn_ = glm::vec3(glm::cross(glm::dvec3(to_y), glm::dvec3(to_w)));
  const auto constants = [&](glm::dvec4 a) {
    return glm::length(glm::dvec3(a)) * std::abs(to_w.w) + glm::length(glm::dvec3(to_w)) * std::abs(a.w);
  };
  thickness_per_metre_ = float(std::hypot(size_of_bivector(to_x, to_w), size_of_bivector(to_y, to_w)));
  thickness_per_radian_ = float(std::hypot(constants(to_x), constants(to_y)));
  depth_rate_ = float(glm::length(glm::dvec3(to_w)));
}

// Four wedgies side by side: corners relative to the eye, what the view makes of them.
struct Projection::Four {
  Lanes px[3], py[3], pz[3];
  Lanes bound;
  Lanes farthest[Forms::k_sides], outside, near_inside;
  Lanes x[3], y[3], w[3];
  // The largest thickness squared, and the least w.
  Lanes square, nearest;
};

SWARD_INLINE Projection::Four Projection::place(std::span<const Wedgie* const> wedgies) const {
  const size_t last = wedgies.size() - 1;
  const Wedgie* const w[k_together] = {wedgies[0], wedgies[std::min<size_t>(1, last)],
                                       wedgies[std::min<size_t>(2, last)], wedgies[std::min<size_t>(3, last)]};
  const auto gather = [&](auto value) { return Lanes{value(*w[0]), value(*w[1]), value(*w[2]), value(*w[3])}; };
  Four f;
  f.px[0] = gather([&](const Wedgie& g) { return float(g.apex.x - eye_.x); });
  f.py[0] = gather([&](const Wedgie& g) { return float(g.apex.y - eye_.y); });
  f.pz[0] = gather([&](const Wedgie& g) { return float(g.apex.z - eye_.z); });
  f.px[1] = f.px[0] + gather([](const Wedgie& g) { return g.to_left.x; });
  f.py[1] = f.py[0] + gather([](const Wedgie& g) { return g.to_left.y; });
  f.pz[1] = f.pz[0] + gather([](const Wedgie& g) { return g.to_left.z; });
  f.px[2] = f.px[0] + gather([](const Wedgie& g) { return g.to_right.x; });
  f.py[2] = f.py[0] + gather([](const Wedgie& g) { return g.to_right.y; });
  f.pz[2] = f.pz[0] + gather([](const Wedgie& g) { return g.to_right.z; });
  f.bound = gather([](const Wedgie& g) { return g.bound; });
  return f;
}

SWARD_INLINE void Projection::measure_sides(Four& f) const {
  for (int i = 0; i < Forms::k_sides; ++i) {
    const Form& form = form_[size_t(i)];
    const Lanes a = form.at(f.px[0], f.py[0], f.pz[0]), b = form.at(f.px[1], f.py[1], f.pz[1]),
                c = form.at(f.px[2], f.py[2], f.pz[2]);
    const Lanes reach = f.bound * reach_.side(i);
    f.farthest[i] = larger(a, larger(b, c)) + reach;
    f.outside = i == 0 ? f.farthest[0] : smaller(f.outside, f.farthest[i]);
    if (i == 4) f.near_inside = smaller(a, smaller(b, c)) - reach;
  }
  f.outside = f.bound < 0.0f ? all(-1) : f.outside;
}

SWARD_WIDE std::array<bool, Projection::k_together> Projection::out(std::span<const Wedgie* const> wedgies) const {
  Four f = place(wedgies);
  measure_sides(f);
  return {f.outside[0] < 0, f.outside[1] < 0, f.outside[2] < 0, f.outside[3] < 0};
}

SWARD_INLINE void Projection::measure_thickness(Four& f) const {
  for (int i = 0; i < 3; ++i) {
    f.x[i] = form_[Forms::k_x].at(f.px[i], f.py[i], f.pz[i]);
    f.y[i] = form_[Forms::k_y].at(f.px[i], f.py[i], f.pz[i]);
    f.w[i] = form_[Forms::k_w].at(f.px[i], f.py[i], f.pz[i]);
  }
  f.square = larger(f.x[0] * f.x[0] + f.y[0] * f.y[0],
                    larger(f.x[1] * f.x[1] + f.y[1] * f.y[1], f.x[2] * f.x[2] + f.y[2] * f.y[2]));
  f.nearest = smaller(f.w[0], smaller(f.w[1], f.w[2]));
}

namespace {

// For how many ticks a distance of `slack` metres does not change its sign, of what is up to `range` metres away.
SWARD_INLINE Lanes sign_ticks(Lanes slack, Lanes range, const TickUnits& units) {
  return slack / (units.metres + units.radians * (range + slack));
}

}  // namespace

// Of the farthest corner, metres.
SWARD_INLINE Lanes Projection::range(const Four& f) const {
  const auto square = [&](int i) { return f.px[i] * f.px[i] + f.py[i] * f.py[i] + f.pz[i] * f.pz[i]; };
  return root(larger(square(0), larger(square(1), square(2)))) + f.bound;
}

float Projection::clear_ticks(const Wedgie& wedgie, float reach, const TickUnits& units) const {
  constexpr float k_rounding_per_metre = 1e-6f;
  Wedgie wide = wedgie;
  wide.bound = reach;
  const Wedgie* const one = &wide;
  Four f = place({&one, 1});
  measure_sides(f);
  const Lanes distance = range(f), margin = k_rounding_per_metre * distance;
  const Lanes inside = f.near_inside - margin, outside = -f.outside - margin;
  if (inside[0] >= 0) return sign_ticks(inside, distance, units)[0];
  return outside[0] > 0 ? sign_ticks(outside, distance, units)[0] : -1;
}

// roam_morph.cpp.
float Projection::largest_error(float priority) const {
  if (priority >= RoamMesh::k_artificial_max) return RoamMesh::k_artificial_max;
  const double p = double(priority);
  return cap(float(k_error_rounding * (p < vanishing_px_ ? p / (2 - p / vanishing_px_) : p)));
}

float Projection::priority_of(float error) const {
  const double e = double(error) / (k_error_rounding * k_error_rounding);
  return float(e < vanishing_px_ ? 2 * e / (1 + e / vanishing_px_) : e);
}

float Projection::moved_error(const Wedgie& wedgie, float offset) const {
  const Wedgie* const one = &wedgie;
  Four f = place({&one, 1});
  measure_sides(f);
  if (f.outside[0] < 0) return 0;
  measure_thickness(f);
  const float most = std::max(wedgie.bound, offset), least = std::min(wedgie.bound, offset);
  const float near_inside = f.near_inside[0] - (most - wedgie.bound) * reach_.side(4);
  const float above = f.nearest[0] - most * depth_per_metre_, below = f.nearest[0] + least * depth_per_metre_;
  if (near_inside < 0 || above <= 0 || above * below <= 0) return RoamMesh::k_artificial_max;
  return cap(float(k_error_rounding) * (most + least) * std::sqrt(f.square[0]) / (above * below));
}

SWARD_INLINE Lanes Projection::priority(const Four& f) const {
  const Lanes reach = f.bound * depth_per_metre_;
  const Lanes denominator = (f.nearest - reach) * (f.nearest + reach);
  const Lanes most = all(RoamMesh::k_artificial_max);
  Lanes p = smaller(2 * f.bound * root(f.square) / denominator, most);
  p = f.near_inside < 0.0f ? most : p;
  p = f.nearest <= reach ? most : p;
  p = denominator <= 0.0f ? most : p;
  p = f.bound <= 0.0f ? all(0) : p;
  return f.outside < 0.0f ? all(-1) : p;
}

void Projection::expect(const Projection& before, double ticks) {
  if (!(ticks > 0)) return;
  const glm::vec3 travel(eye_ - before.eye_);
  const Lanes per_tick = all(float(1 / ticks));
  for (size_t i = 0; i < Forms::k_sides; ++i) {
    const Form &now = form_[i], &last = before.form_[i];
    // A point at p now was at p + travel, seen from the last eye.
    rate_[i] = {per_tick * (now.x - last.x), per_tick * (now.y - last.y), per_tick * (now.z - last.z),
                per_tick * (now.one - last.at(all(travel.x), all(travel.y), all(travel.z)))};
  }
}

SWARD_INLINE Lanes Projection::ticks_to_leave(const Four& f) const {
  const Lanes third = all(1 / 3.0f);
  const Lanes x = third * (f.px[0] + f.px[1] + f.px[2]), y = third * (f.py[0] + f.py[1] + f.py[2]),
              z = third * (f.pz[0] + f.pz[1] + f.pz[2]);
  const Lanes never = all(float(Calendar::k_span));
  Lanes least = never;
  for (size_t i = 0; i < Forms::k_sides; ++i) {
    const Lanes rate = rate_[i].at(x, y, z);
    least = smaller(least, rate < 0.0f ? f.farthest[i] / -rate : never);
  }
  return larger(least, all(0));
}

// What a tick may change the wedgies' priorities by: L and Q upwards and downwards, and the ticks for which they hold.
struct Projection::Change {
  Lanes linear_up, linear_down, square_up, square_down, valid;
  Lanes range;  // of the farthest corner, metres
};

namespace {

SWARD_INLINE Lanes length_of(Lanes x, Lanes y, Lanes z) {
  return root(x * x + y * y + z * z);
}

}  // namespace

SWARD_INLINE Projection::Change Projection::change_of(const Four& f, const TickUnits& units) const {
  // a: the corner of the largest thickness, b: that of the least depth.
  Lanes most = f.x[0] * f.x[0] + f.y[0] * f.y[0], xa = f.x[0], ya = f.y[0], pxa = f.px[0], pya = f.py[0];
  Lanes w = f.w[0], pxb = f.px[0], pyb = f.py[0], pzb = f.pz[0];
  for (int i = 1; i < 3; ++i) {
    const Lanes square = f.x[i] * f.x[i] + f.y[i] * f.y[i];
    const auto thicker = square > most;
    most = thicker ? square : most;
    xa = thicker ? f.x[i] : xa;
    ya = thicker ? f.y[i] : ya;
    pxa = thicker ? f.px[i] : pxa;
    pya = thicker ? f.py[i] : pya;
    const auto nearer = f.w[i] < w;
    w = nearer ? f.w[i] : w;
    pxb = nearer ? f.px[i] : pxb;
    pyb = nearer ? f.py[i] : pyb;
    pzb = nearer ? f.pz[i] : pzb;
  }
  const Lanes inverse = 1 / root(most), reach = f.bound * depth_per_metre_;
  const Lanes margin = w - reach, per_depth = 2 * w / (margin * (w + reach));
  const Lanes ux = xa * inverse, uy = ya * inverse;
  const glm::vec3 &wa = w_axis_, &xt = x_turn_, &yt = y_turn_;
  const Lanes travel = length_of(inverse * (ux * x_axis_.x + uy * y_axis_.x) - per_depth * wa.x,
                                 inverse * (ux * x_axis_.y + uy * y_axis_.y) - per_depth * wa.y,
                                 inverse * (ux * x_axis_.z + uy * y_axis_.z) - per_depth * wa.z);
  // The axis of turning, crossed with vertical x P = (-y, x, 0).
  const Lanes ax = inverse * (ux * xt.x + uy * yt.x), ay = inverse * (ux * xt.y + uy * yt.y),
              az = inverse * (ux * xt.z + uy * yt.z);
  const Lanes turn =
      length_of(-az * pxa - per_depth * (wa.y * pzb - wa.z * pyb), -az * pya - per_depth * (wa.z * pxb - wa.x * pzb),
                ax * pxa + ay * pya - per_depth * (wa.x * pyb - wa.y * pxb));
  Lanes spread = all(0);
  for (int i = 0; i < 3; ++i) {
    const Lanes dx = f.x[i] - xa, dy = f.y[i] - ya;
    spread = larger(spread, dx * dx + dy * dy);
  }
  spread = 2 * root(spread) * inverse;
  const Lanes side = length_of(f.px[1] - f.px[2], f.py[1] - f.py[2], f.pz[1] - f.pz[2]);
  Change c;
  c.range = range(f);
  const Lanes metres = units.metres + units.radians * c.range;
  const Lanes more = 0.5f * units.radians * units.radians * c.range + units.metres * units.radians;
  const Lanes k = (thickness_per_metre_ * metres + thickness_per_radian_ * units.radians) * inverse;
  const Lanes per_margin = 1 / margin, h = depth_rate_ * metres * per_margin;
  const Lanes reach_turn = f.bound * (depth_rate_ * units.radians) * per_margin;
  c.linear_down = travel * units.metres + turn * units.radians + thickness_per_radian_ * units.radians * inverse +
                  2 * reach * reach_turn / (w + reach);
  c.linear_up = c.linear_down + spread * k +
                units.radians * side * (thickness_per_metre_ * inverse + 2 * depth_rate_ * per_margin);
  const Lanes curved =
      thickness_per_metre_ * more * inverse + 2 * depth_rate_ * more * per_margin + 2 * reach_turn * reach_turn;
  c.square_up = 0.5f * k * k + 2 * h * h + curved;
  c.square_down = k * k + curved;
  c.valid = 0.5f / larger(k, h);
  return c;
}

namespace {

// The n > 0 at which l n + q n^2 = limit.
SWARD_INLINE Lanes solve(Lanes l, Lanes q, Lanes limit) {
  return 2 * limit / (l + root(l * l + 4 * q * limit));
}

// No more than the logarithm of a ratio >= 1: the first term of its series about 1.
SWARD_INLINE Lanes least_log(Lanes ratio) {
  return 2 * (ratio - 1) / (ratio + 1);
}

}  // namespace

SWARD_INLINE Lanes Projection::below_ticks(const Four& f, const Change& c, Lanes p, const Deferral& deferral) const {
  const TickUnits& units = deferral.units;
  const Lanes zero = all(0), rounded = p * k_rounding, rise = least_log(deferral.leaf_guard / rounded);
  const Lanes near_ticks = sign_ticks(f.near_inside, c.range, units);
  Lanes ticks =
      smaller(smaller(solve(c.linear_up, c.square_up, rise), rise / units.log_guard), smaller(c.valid, near_ticks));
  ticks = f.near_inside > 0.0f ? ticks : zero;
  ticks = p > 0.0f ? ticks : zero;
  ticks = f.bound <= 0.0f ? all(float(Calendar::k_span)) : ticks;
  return rounded <= deferral.leaf_guard ? ticks : zero;
}

SWARD_INLINE Lanes Projection::above_ticks(const Change& c, Lanes p, const Deferral& deferral) const {
  const float reached = deferral.diamond_guard * k_rounding;
  const Lanes zero = all(0), fall = least_log(p / reached);
  Lanes ticks = smaller(smaller(solve(c.linear_down, c.square_down, fall), fall / deferral.units.log_guard), c.valid);
  ticks = p > reached ? ticks : zero;
  return p < RoamMesh::k_artificial_max ? ticks : zero;
}

SWARD_WIDE void Projection::read(std::span<const Wedgie* const> wedgies, const Deferral& deferral, Wanted wanted,
                                 Reading* readings) const {
  Four f = place(wedgies);
  measure_sides(f);
  Lanes p = f.outside < 0.0f ? all(-1) : all(0);
  Lanes below = all(0), above = all(0), leaves = all(0), distance;
  if (wanted != k_outside) {
    measure_thickness(f);
    p = priority(f);
    const Change c = change_of(f, deferral.units);
    distance = c.range;
    if (wanted & k_below) {
      below = below_ticks(f, c, p, deferral);
      leaves = ticks_to_leave(f);
    }
    if (wanted & k_above) above = above_ticks(c, p, deferral);
  } else {
    distance = range(f);
  }
  const Lanes side = sign_ticks(magnitude(f.outside), distance, deferral.units);
  for (size_t i = 0; i < wedgies.size(); ++i)
    readings[i] = {f.bound[i], f.outside[i], p[i], below[i], above[i], side[i], leaves[i]};
}

}  // namespace sward::roam
