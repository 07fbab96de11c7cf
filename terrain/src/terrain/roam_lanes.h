// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstring>

#include "wide.h"

namespace sward::roam {

/// Four floats that are added, multiplied and compared side by side: GCC's and Clang's vector extension.
using Lanes = float __attribute__((vector_size(16)));

SWARD_INLINE Lanes all(float value) {
  return Lanes{value, value, value, value};
}
SWARD_INLINE Lanes larger(Lanes a, Lanes b) {
  return a > b ? a : b;
}
SWARD_INLINE Lanes smaller(Lanes a, Lanes b) {
  return a < b ? a : b;
}

SWARD_INLINE Lanes magnitude(Lanes a) {
  return a < 0.0f ? -a : a;
}
SWARD_INLINE Lanes root(Lanes a) {
  return Lanes{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
}

/// What a view makes of one vertex: values of linear forms.
struct Forms {
  static constexpr int k_sides = 6, k_x = 6, k_y = 7, k_w = 8, k_forms = 9;
  static constexpr int k_lanes = 3;
  Lanes lane[k_lanes];

  static Forms loaded(const float (&form)[k_forms]) {
    Forms out;
    std::memcpy(&out, form, sizeof form);
    out.lane[2] = Lanes{form[k_w], form[k_w], form[k_w], form[k_w]};
    return out;
  }
  void store(float (&form)[k_forms]) const { std::memcpy(form, this, sizeof form); }
  float operator[](int form) const { return lane[form / 4][form % 4]; }
  void set(int form, float value) { lane[form / 4][form % 4] = value; }
  /// Distance to a halfspace of frustum_planes(), 0..5, metres.
  float side(int halfspace) const { return (*this)[halfspace]; }
  /// Pixels of thickness that 1 m of bound gives, times w squared, halved: the length of this.
  float x() const { return (*this)[k_x]; }
  float y() const { return (*this)[k_y]; }
  float square() const { return x() * x() + y() * y(); }
  /// The depth ahead of the eye; 1 without perspective.
  float w() const { return (*this)[k_w]; }
};

}  // namespace sward::roam
