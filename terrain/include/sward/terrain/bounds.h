// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <sward/terrain/height_field.h>
#include <vector>

namespace sward {

/// Nested wedgie bounds (Duchaineau et al. 1997, section 4): for every diamond whose centre is a data sample,
///   e(diamond) = max over child diamonds of e + |z(centre) - (z(left) + z(right)) / 2|,
/// so that the finest data lies within +-e of either of its triangles. Stored once a diamond, by its centre, as a
/// 16-bit float (5 bit exponent, 11 bit mantissa) rounded up: it neither saturates below 2^19 m nor loses more than
/// 1/2048. The relief's analytic bound is added on reading. Samples in holes and in the padding add nothing.
class Bounds {
 public:
  /// Bottom-up, in parallel over `threads` threads (0: all cores); the result does not depend on their number.
  /// Cost: about 10 ns a sample a core. The field must outlive the bounds.
  static Bounds create(const HeightField& field, int threads = 0, const Progress& progress = {});

  /// Bound in metres of the triangles of `level` whose base edge's middle is `centre`; 0 at and below max_level().
  float bound(LatticePoint centre, int level) const;

  const HeightField& field() const { return *field_; }
  /// Bytes held.
  size_t memory() const { return stored_.size() * sizeof(uint16_t); }

  /// The 16-bit format: the smallest representable number >= metres (>= 0).
  static uint16_t encode_up(float metres);
  static float decode(uint16_t stored);

 private:
  const HeightField* field_ = nullptr;
  int stride_ = 0;                // samples a row, padding included
  std::vector<uint16_t> stored_;  // by sample, padding included
};

}  // namespace sward
