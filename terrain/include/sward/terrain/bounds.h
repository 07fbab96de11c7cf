// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/terrain/height_field.h>
#include <cstdint>
#include <memory>
#include <string>

namespace sward {

/// Nested wedgie bounds (Duchaineau et al. 1997, section 4): for every diamond whose centre is a data sample,
///   e(diamond) = max over child diamonds of e + |z(centre) - (z(left) + z(right)) / 2|,
/// so that the finest surface lies within +-e of either of its triangles. Stored once a diamond, by its centre, as a
/// 16-bit float (5 bit exponent, 11 bit mantissa) rounded up: it neither saturates below 500 km nor loses more than
/// 1/2048 (2^-23 m below a quarter of a millimetre). The relief's analytic bound is in it. Diamonds below which there
/// are only holes and padding count 0. A diamond's bound is never below that of the diamonds that depend on it.
class SWARD_API Bounds {
 public:
  /// Bottom-up, in parallel over `threads` threads (0: all cores); the result does not depend on their number.
  /// Cost: some 20 ns a sample a core. The field must outlive the bounds.
  static Bounds create(const HeightField& field, int threads = 0, const Progress& progress = {});

  /// Re-computes what depends on heights and relief of the box, which the field has changed (edits.h calls this): the
  /// result is that of create(). Needs the bounds and the field for itself. Cost: some 100 ns a sample of the box.
  void recompute(const LatticeBox& changed, int threads = 0);
  /// Box of the centres of those diamonds of a level whose bound may change when heights and relief in `changed` do.
  LatticeBox affected(const LatticeBox& changed, int level) const;

  /// Writes the bounds to a file that load() reads: to a temporary beside it, renamed when complete.
  Expected<void> save(const std::string& path) const;
  /// Reads bounds that were saved for the same field. Fails, naming the file and what to do, when it is missing,
  /// truncated, damaged, of another version or of another field.
  static Expected<Bounds> load(const std::string& path, const HeightField& field);

  /// Bound in metres of the triangles of `level` whose base edge's middle is `centre`; 0 at and below max_level().
  float bound(LatticePoint centre, int level) const;

  const HeightField& field() const { return *field_; }
  /// Fetches what bound() reads for a centre into the cache, without waiting for it.
  void prefetch(LatticePoint centre) const;
  /// Bytes held.
  size_t memory() const { return stored_count_ * sizeof(uint16_t); }

  /// The 16-bit format: the smallest representable number >= metres (>= 0).
  static uint16_t encode_up(float metres);
  static float decode(uint16_t stored);

 private:
  friend class BoundsBuilder;
  void adopt_layout(const HeightField& field);
  void build(const struct SampleBox& changed, int threads, const Progress& progress);
  // Stored value of a diamond below which no sample is valid.
  static constexpr uint16_t k_nothing = 0xffff;

  const HeightField* field_ = nullptr;
  int stride_ = 0;     // samples a row, padding included
  int step_bits_ = 0;  // log2 of lattice units between samples
  int data_level_ = 0;
  int max_level_ = 0;
  // By sample, padding included. Not a vector: memory is first touched by the threads that compute it.
  std::unique_ptr<uint16_t[]> stored_;
  size_t stored_count_ = 0;
};

}  // namespace sward
