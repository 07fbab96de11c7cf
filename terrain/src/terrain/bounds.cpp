// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Nested wedgies (Duchaineau et al., "ROAMing Terrain: Real-time Optimally Adapting Meshes", 1997, section 4), kept by
// diamond instead of by triangle, over one grid for all root squares: diamonds on a border between two root squares
// have their triangles in both. Level by level from the data up; diamonds of one level do not depend on each other.
//
// Level 2 (n - i) + 1, i >= 1: base of 2 h = 2^i samples along an axis, centre at (odd h, even h) or (even h, odd h);
// dependent diamonds at (+-h/2, +-h/2). Level 2 (n - i): base along a diagonal of a square of side 2 h, centre at
// (odd h, odd h), dependent diamonds at (+-h, 0) and (0, +-h). Diamonds of the data's own level have their centres
// between samples; they are not stored, the relief's bound around takes their place.
//
// Validity where data is missing. A valid sample in a triangle is off that triangle's plane by its distance from a
// child's plane plus at most what the split moved, whether or not the split's own sample is valid. So a hole or a
// padded sample adds nothing only where no valid sample (nor relief) lies below its diamond.

#include <sward/terrain/bounds.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "bounds_parallel.h"
#include "large_pages.h"
#include "relief.h"
#include "smoothing.h"

namespace sward {

namespace {

constexpr int k_mantissa_bits = 11;
constexpr int k_codes_an_octave = 1 << k_mantissa_bits;
constexpr int k_lowest_exponent = -12;
constexpr double k_lowest = 0x1p-12;
constexpr uint16_t k_largest = 0xfffe;
// Passes over wider spacings take no time worth telling.
constexpr int k_coarsest_reported = 8;

// A double's upper bits are the format but for the exponent's bias; adding all the lower bits rounds up and carries
// into the exponent. Below the lowest exponent numbers are spaced evenly, as in IEEE formats.
uint16_t encode_double_up(double metres) {
  constexpr int k_dropped = 52 - k_mantissa_bits;
  constexpr int64_t k_bias = int64_t(1023 + k_lowest_exponent - 1) << k_mantissa_bits;
  if (!(metres > 0.0)) return 0;
  if (metres < k_lowest) return uint16_t(std::ceil(metres * (k_codes_an_octave / k_lowest)));
  const int64_t bits = std::bit_cast<int64_t>(metres) + ((int64_t(1) << k_dropped) - 1);
  return uint16_t(std::min<int64_t>((bits >> k_dropped) - k_bias, k_largest));
}

float float_up(double value) {
  const float rounded = float(value);
  return double(rounded) < value ? std::nextafter(rounded, std::numeric_limits<float>::infinity()) : rounded;
}

}  // namespace

// Samples, padding included; both corners belong to it.
struct SampleBox {
  glm::ivec2 first, last;
  SampleBox grown(int samples, glm::ivec2 size) const {
    return {glm::max(first - samples, glm::ivec2(0)), glm::min(last + samples, size - 1)};
  }
};

namespace {

// The first of begin, begin + stride, .. that is not below `from`.
int first_from(int from, int begin, int stride) {
  return from <= begin ? begin : begin + (from - begin + stride - 1) / stride * stride;
}

}  // namespace

// What the levels' passes share.
class BoundsBuilder {
 public:
  BoundsBuilder(const HeightField& field, Bounds& bounds)
      : field_(field),
        stored_(bounds.stored_.get()),
        size_(field.root_squares() * (1 << field.root_bits()) + 1),
        data_(field.desc().columns, field.desc().rows),
        scale_(std::abs(field.desc().scale)),
        relief_per_share_(field.noise_bound_.front() / 255.0),
        is_smooth_(!field.relief_curvatures().empty()) {
    if (const auto* words = std::get_if<std::vector<uint16_t>>(&field.samples())) words_ = words->data();
    if (const auto* floats = std::get_if<std::vector<float>>(&field.samples())) floats_ = floats->data();
  }

  glm::ivec2 size() const { return size_; }

  // Level 2 (n - i) + 1, rows of multiples of h, columns of the box.
  void side_row(int row, int h, const SampleBox& box) const {
    const bool along_row = row / h % 2 == 0;
    Columns& relief = columns();
    if (h == 1) {
      largest_in_rows(field_.relief_shares(), row - 2, row + 2, box, relief.shares);
      largest_in_rows(field_.relief_curvatures(), row - 2, row + 1, box, relief.curvatures);
    }
    const int q = h / 2;
    const std::array<glm::ivec2, 4> corners{{{-q, -q}, {q, -q}, {-q, q}, {q, q}}};
    const glm::ivec2 half = along_row ? glm::ivec2(h, 0) : glm::ivec2(0, h);
    for (int column = first_from(box.first.x, along_row ? h : 0, 2 * h); column <= box.last.x; column += 2 * h) {
      const glm::ivec2 centre(column, row);
      store(centre, half, h == 1 ? relief_below(centre, relief) : largest(centre, corners));
    }
  }

  // Level 2 (n - i), rows of odd multiples of h. Root squares are cut from south-west to north-east, smaller ones so
  // that the base joins corners whose indices are both even or both odd.
  void square_row(int row, int h, bool root, const SampleBox& box) const {
    const std::array<glm::ivec2, 4> sides{{{-h, 0}, {h, 0}, {0, -h}, {0, h}}};
    for (int column = first_from(box.first.x, h, 2 * h); column <= box.last.x; column += 2 * h) {
      const bool falls_east = (row / (2 * h) + column / (2 * h)) % 2 == 0;
      const glm::ivec2 centre(column, row);
      store(centre, falls_east && !root ? glm::ivec2(h, h) : glm::ivec2(h, -h), largest(centre, sides));
    }
  }

 private:
  // What depends on a diamond.
  struct Below {
    double bound = 0;
    bool any = false;  // A valid sample or relief.
  };

  // Largest noise and curvature in the rows that matter to a row of diamonds, by column; filled by largest_in_rows().
  struct Columns {
    std::vector<uint8_t> shares, curvatures;
  };
  static Columns& columns() {
    static thread_local Columns largest;
    return largest;
  }

  // Of the rows from `first` to `last`, for columns within two samples of the box.
  void largest_in_rows(std::span<const uint8_t> table, int first, int last, const SampleBox& box,
                       std::vector<uint8_t>& out) const {
    if (table.empty()) return;
    out.resize(size_t(data_.x));
    const int begin = std::clamp(box.first.x - 2, 0, data_.x - 1), end = std::min(box.last.x + 2, data_.x - 1);
    std::fill(out.begin() + begin, out.begin() + end + 1, uint8_t(0));
    for (int y = std::max(first, 0); y <= std::min(last, data_.y - 1); ++y) {
      const uint8_t* values = table.data() + size_t(y) * size_t(data_.x);
      for (int x = begin; x <= end; ++x) out[size_t(x)] = std::max(out[size_t(x)], values[x]);
    }
  }

  uint8_t largest_in_columns(const std::vector<uint8_t>& values, int first, int last) const {
    uint8_t largest = 0;
    const int end = std::min(last, data_.x - 1);
    for (int x = std::max(first, 0); x <= end; ++x) largest = std::max(largest, values[size_t(x)]);
    return largest;
  }

  // The windows of relief_bound(centre, level) for the four diamonds of the data's level, taken together: samples
  // within two of the centre, and the cells between them.
  Below relief_below(glm::ivec2 centre, const Columns& largest) const {
    Below below;
    if (relief_per_share_ > 0.0) {
      below.bound = largest_in_columns(largest.shares, centre.x - 2, centre.x + 2) * relief_per_share_;
    }
    if (is_smooth_) {
      const uint8_t code = largest_in_columns(largest.curvatures, centre.x - 2, centre.x + 1);
      below.bound += smoothing::decode(code) * smoothing::k_coarse_shares[0];
    }
    below.any = below.bound > 0.0;
    return below;
  }

  // Codes rise with what they stand for; one above, k_nothing wraps to 0, below all others.
  uint16_t rank(glm::ivec2 sample) const {
    if (sample.x < 0 || sample.y < 0 || sample.x >= size_.x || sample.y >= size_.y) return 0;
    return uint16_t(stored_[index(sample)] + 1);
  }

  Below largest(glm::ivec2 centre, const std::array<glm::ivec2, 4>& offsets) const {
    uint16_t highest = 0;
    for (const glm::ivec2 offset : offsets) highest = std::max(highest, rank(centre + offset));
    if (highest == 0) return {};
    return {double(Bounds::decode(uint16_t(highest - 1))), true};
  }

  void store(glm::ivec2 centre, glm::ivec2 half, const Below& below) const {
    if (!below.any && !valid(centre)) {
      stored_[index(centre)] = Bounds::k_nothing;
      return;
    }
    const double bend = std::abs(raw(centre) - 0.5 * (raw(centre - half) + raw(centre + half)));
    stored_[index(centre)] = encode_double_up(below.bound + scale_ * bend);
  }

  size_t index(glm::ivec2 sample) const { return size_t(sample.y) * size_t(size_.x) + size_t(sample.x); }

  bool valid(glm::ivec2 sample) const {
    if (sample.x >= data_.x || sample.y >= data_.y) return false;
    return field_.hole_count() == 0 || !field_.is_hole(sample.x, sample.y);
  }

  double raw(glm::ivec2 sample) const {
    const size_t column = size_t(std::min(sample.x, data_.x - 1)), row = size_t(std::min(sample.y, data_.y - 1));
    const size_t at = row * size_t(data_.x) + column;
    return words_ != nullptr ? double(words_[at]) : double(floats_[at]);
  }

  const HeightField& field_;
  uint16_t* stored_;
  glm::ivec2 size_;  // Samples, padding included.
  glm::ivec2 data_;  // Without.
  double scale_;
  double relief_per_share_;
  bool is_smooth_;
  const uint16_t* words_ = nullptr;
  const float* floats_ = nullptr;
};

void Bounds::adopt_layout(const HeightField& field) {
  field_ = &field;
  data_level_ = field.data_level();
  max_level_ = field.max_level();
  step_bits_ = k_root_bits - field.root_bits();
  const glm::ivec2 size = field.root_squares() * (1 << field.root_bits()) + 1;
  stride_ = size.x;
  stored_count_ = size_t(size.x) * size_t(size.y);
  stored_ = std::make_unique_for_overwrite<uint16_t[]>(stored_count_);
  prefer_large_pages(stored_.get(), stored_count_ * sizeof(uint16_t));
  // The corners of root squares are no diamond's centre.
  const int side = 1 << field.root_bits();
  for (int row = 0; row < size.y; row += side)
    for (int column = 0; column < size.x; column += side)
      stored_[size_t(row) * size_t(size.x) + size_t(column)] = k_nothing;
}

// Level by level, those diamonds that depend on samples in the box: what a diamond reads lies within h of its centre.
void Bounds::build(const SampleBox& changed, int threads, const Progress& progress) {
  const BoundsBuilder builder(*field_, *this);
  const glm::ivec2 size = builder.size();
  SampleBox box = changed;
  // A pass over spacing h visits 3 / (4 h^2) of the samples.
  float done = 0.0f;
  for (int i = 1; i <= field_->root_bits(); ++i) {
    const int h = 1 << (i - 1);
    const float visited = 1.0f / (float(h) * float(h));
    const auto pass = [&](int begin, int stride, float share, auto&& row) {
      box = box.grown(h, size);
      const int first = first_from(box.first.y, begin, stride), rows = (box.last.y - first) / stride + 1;
      const Progress report = progress && h <= k_coarsest_reported
                                  ? Progress([&, from = done, share](float part) { progress(from + share * part); })
                                  : Progress();
      if (first <= box.last.y) {
        const int64_t cost = (box.last.x - box.first.x) / h + 1;
        parallel_rows({rows, cost, threads}, report, [&](int k) { row(first + k * stride); });
      }
      done += share;
    };
    const bool root = i == field_->root_bits();
    pass(0, h, 0.5f * visited, [&](int row) { builder.side_row(row, h, box); });
    pass(h, 2 * h, 0.25f * visited, [&](int row) { builder.square_row(row, h, root, box); });
  }
}

Bounds Bounds::create(const HeightField& field, int threads, const Progress& progress) {
  Bounds bounds;
  bounds.adopt_layout(field);
  bounds.build({glm::ivec2(0), (field.root_squares() << field.root_bits())}, threads, progress);
  if (progress) progress(1.0f);
  return bounds;
}

void Bounds::recompute(const LatticeBox& changed, int threads) {
  if (changed.empty()) return;
  const int step = 1 << step_bits_;
  const glm::ivec2 end = field_->root_squares() << field_->root_bits();
  build({glm::max(changed.first, LatticePoint(0)) / step, glm::min((changed.last + (step - 1)) / step, end)}, threads,
        {});
}

// By the passes of build(): 1 + 1 + 2 + 2 + .. + h, twice for squares. Below the data by the window of relief_bound().
LatticeBox Bounds::affected(const LatticeBox& changed, int level) const {
  if (changed.empty()) return changed;
  const int side = k_root_side >> (level / 2), step = 1 << step_bits_;
  const LatticePoint last(field_->root_squares() * k_root_side);
  const int reach = level >= data_level_ ? 2 * side + step : 2 * side;
  return {glm::max(changed.first - reach, LatticePoint(0)), glm::min(changed.last + reach, last)};
}

float Bounds::bound(LatticePoint centre, int level) const {
  if (level >= max_level_) return 0.0f;
  if (level >= data_level_) return float_up(field_->relief_bound(centre, level));
  const uint16_t code = stored_[size_t(centre.y >> step_bits_) * size_t(stride_) + size_t(centre.x >> step_bits_)];
  return code == k_nothing ? 0.0f : decode(code);
}

void Bounds::prefetch(LatticePoint centre) const {
  __builtin_prefetch(&stored_[size_t(centre.y >> step_bits_) * size_t(stride_) + size_t(centre.x >> step_bits_)]);
}

uint16_t Bounds::encode_up(float metres) {
  return encode_double_up(double(metres));
}

float Bounds::decode(uint16_t stored) {
  constexpr uint32_t k_bias = uint32_t(127 + k_lowest_exponent - 1) << k_mantissa_bits;
  if (stored < k_codes_an_octave) return float(stored) * float(k_lowest / k_codes_an_octave);
  return std::bit_cast<float>((stored + k_bias) << (23 - k_mantissa_bits));
}

}  // namespace sward
