// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What may be asked of a wind.
#include <cmath>
#include <cstdio>
#include <string>

#include "vegetation/wind_state.h"

namespace sward {

namespace {

constexpr double k_farthest_m = 1e9;
// What is smaller has no place in floats' sums.
constexpr double k_least_radius_m = 0.0099999;
constexpr double k_least_rise_s = 0.001;

std::string number(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.9g", value);
  return buffer;
}

/// Collects the first fault.
class Faults {
 public:
  Faults& within(const char* name, double value, double low, double high) {
    if (!(value >= low && value <= high))
      note(std::string(name) + " is " + number(value) + "; give " + number(low) + " to " + number(high));
    return *this;
  }
  /// Without `low` itself.
  Faults& above(const char* name, double value, double low, double high) {
    if (!(value > low && value <= high))
      note(std::string(name) + " is " + number(value) + "; give more than " + number(low) + ", at most " +
           number(high));
    return *this;
  }
  Faults& place(const char* name, glm::dvec2 value) {
    return within(name, value.x, -k_farthest_m, k_farthest_m).within(name, value.y, -k_farthest_m, k_farthest_m);
  }
  bool any() const { return !first_.empty(); }
  Expected<void> result(const char* what) const {
    if (!any()) return {};
    return fail(std::string(what) + ": " + first_);
  }

 private:
  void note(const std::string& fault) {
    if (first_.empty()) first_ = fault;
  }
  std::string first_;
};

}  // namespace

Expected<void> validate(const Weather& w) {
  return Faults()
      .within("speed_m_s", double(w.speed_m_s), 0, 120)
      .within("from_azimuth", double(w.from_azimuth), -1e4, 1e4)
      .within("gustiness", double(w.gustiness), 0, 1)
      .within("gust_length_m", double(w.gust_length_m), 2, 10000)
      .within("ambient_m_s", double(w.ambient_m_s), 0, 20)
      .within("turbulence", double(w.turbulence), 0, 1)
      .result("weather");
}

Expected<void> validate(const WindSource& s) {
  Faults faults;
  faults.place("position", s.position)
      .within("velocity_m_s.x", s.velocity_m_s.x, -120, 120)
      .within("velocity_m_s.y", s.velocity_m_s.y, -120, 120)
      .within("start_s", s.start_s, -1e12, 1e12)
      .above("duration_s", s.duration_s, 0, 1e6)
      .within("rise_s", s.rise_s, k_least_rise_s, 0.5 * s.duration_s);
  if (s.repeat_s != 0) faults.within("repeat_s", s.repeat_s, s.duration_s, 1e6);
  return faults.within("outward_m_s", double(s.outward_m_s), -120, 120)
      .within("around_m_s", double(s.around_m_s), -120, 120)
      .within("radius_m", double(s.radius_m), k_least_radius_m, 10000)
      .within("falloff", double(s.falloff), 0, 4)
      .above("reach_m", double(s.reach_m), double(s.radius_m), 100000)
      .within("travel_m_s", double(s.travel_m_s), 0.1f, 1000)
      .within("wave_period_s", double(s.wave_period_s), 0.05f, 1000)
      .within("wave_share", double(s.wave_share), 0, 1)
      .result("wind source");
}

Expected<void> validate(const WindMover& m) {
  return Faults()
      .place("position", m.position)
      .within("above_ground_m", double(m.above_ground_m), 0, 10000)
      .within("radius_m", double(m.radius_m), k_least_radius_m, 50)
      .within("strength", double(m.strength), 0, m.kind == WindMover::Kind::body ? 4 : 120)
      .result("wind mover");
}

Expected<void> validate(const PaintedWind& p) {
  Faults faults;
  faults.within("width", p.width, 1, 4096).within("height", p.height, 1, 4096);
  faults.place("min", p.min)
      .above("size_m.x", p.size_m.x, 0, k_farthest_m)
      .above("size_m.y", p.size_m.y, 0, k_farthest_m);
  if (faults.any()) return faults.result("painted wind");
  const size_t texels = size_t(p.width) * size_t(p.height);
  if (p.factors.size() != texels)
    return fail("painted wind: it has " + std::to_string(p.factors.size()) + " factors; give " +
                std::to_string(texels));
  for (const glm::vec2 factor : p.factors) {
    faults.within("a factor", double(factor.x), -4, 4).within("a factor", double(factor.y), -4, 4);
    if (faults.any()) break;
  }
  return faults.result("painted wind");
}

}  // namespace sward
