// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Making a height field: checks, holes, the choice of root squares, strength of the relief.
//
// Root squares. Any field could be covered without waste by squares of a single cell, but every root square costs two
// triangles of each frame's budget that no merge takes back, and long rows of small roots defeat the hierarchy. So the
// sizes that need at most k_max_squares compete: least padding wins, the larger square at a tie. A field of 2^n + 1
// samples is thus one root square.

#include <sward/terrain/height_field.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "bounds_parallel.h"
#include "height_field_holes.h"
#include "relief.h"
#include "smoothing.h"

namespace sward {

namespace {

constexpr int k_max_squares = 256;
// Leaves one bit of the lattice below the samples.
constexpr int k_max_root_bits = 17;
constexpr int k_max_side = 131073;
constexpr int64_t k_max_samples = int64_t(1) << 31;

std::string size_text(const HeightFieldDesc& desc) {
  return std::to_string(desc.columns) + " x " + std::to_string(desc.rows);
}

Expected<void> check(const ReliefOptions& relief) {
  const auto within = [](float value, float low, float high) { return value >= low && value <= high; };
  if (!within(relief.roughness, 0.0f, 0.5f)) return fail("relief roughness must lie in 0..0.5");
  if (!within(relief.flat_share, 0.0f, 1.0f)) return fail("relief flat_share must lie in 0..1");
  if (!(relief.full_slope > 0.0f) || !std::isfinite(relief.full_slope))
    return fail("relief full_slope must be above 0");
  if (!within(relief.finest_edge_m, 0.1f, 100.0f)) return fail("relief finest_edge_m must lie in 0.1..100 metres");
  return {};
}

Expected<void> check(const HeightFieldDesc& desc, size_t samples, size_t holes) {
  const std::string name = "height field of " + size_text(desc) + " samples";
  if (desc.columns < 2 || desc.rows < 2) return fail(name + " is too small: at least 2 x 2 are needed");
  const int64_t count = int64_t(desc.columns) * desc.rows;
  if (desc.columns > k_max_side || desc.rows > k_max_side || count > k_max_samples) {
    return fail(name + " is too large: at most " + std::to_string(k_max_side) + " a side and 2^31 in all");
  }
  if (int64_t(samples) != count) return fail(name + " was given " + std::to_string(samples) + " of them");
  if (holes != 0 && int64_t(holes) != count) {
    return fail(name + " was given a hole mask of " + std::to_string(holes) + " entries; it needs one a sample");
  }
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  if (!positive(desc.spacing.x) || !positive(desc.spacing.y)) return fail(name + ": spacing must be above 0 metres");
  if (!std::isfinite(desc.scale) || desc.scale == 0.0 || !std::isfinite(desc.offset)) {
    return fail(name + ": height scale must be finite and not 0, offset finite");
  }
  if (!std::isfinite(desc.origin.x) || !std::isfinite(desc.origin.y) || !std::isfinite(desc.origin.z)) {
    return fail(name + ": the origin must be finite");
  }
  return check(desc.relief);
}

glm::ivec2 squares_for(glm::ivec2 cells, int root_bits) {
  const int side = 1 << root_bits;
  return (cells + (side - 1)) / side;
}

int choose_root_bits(glm::ivec2 cells) {
  int best = k_max_root_bits;
  int64_t least = INT64_MAX;
  for (int bits = 1; bits <= k_max_root_bits; ++bits) {
    const glm::ivec2 squares = squares_for(cells, bits);
    const int64_t count = int64_t(squares.x) * squares.y;
    if (count > k_max_squares) continue;
    const int64_t covered = count << (2 * bits);
    if (covered > least) continue;
    least = covered;
    best = bits;
  }
  return best;
}

std::vector<uint8_t> find_missing(const HeightField::Samples& samples, std::span<const uint8_t> holes) {
  const auto* floats = std::get_if<std::vector<float>>(&samples);
  std::vector<uint8_t> missing;
  if (!holes.empty()) missing.assign(holes.begin(), holes.end());
  if (floats == nullptr) return missing;
  for (size_t i = 0; i < floats->size(); ++i) {
    if (std::isfinite((*floats)[i])) continue;
    missing.resize(floats->size(), 0);
    missing[i] = 1;
  }
  return missing;
}

void fill(std::vector<float>& samples, const std::vector<uint8_t>& missing, glm::ivec2 size) {
  fill_holes(samples, missing, size.x, size.y);
}

void fill(std::vector<uint16_t>& samples, const std::vector<uint8_t>& missing, glm::ivec2 size) {
  std::vector<float> values(samples.begin(), samples.end());
  fill_holes(values, missing, size.x, size.y);
  for (size_t i = 0; i < samples.size(); ++i) {
    if (missing[i] != 0) samples[i] = uint16_t(std::clamp(std::lround(values[i]), 0L, 65535L));
  }
}

// Levels below the data until both legs of a triangle are at most `edge` long.
int levels_below(glm::dvec2 spacing, double edge) {
  int halvings = 0;
  for (double leg = std::max(spacing.x, spacing.y); leg > edge; leg *= 0.5) ++halvings;
  return 2 * halvings;
}

// FNV-1a over 64-bit words.
struct Hash {
  uint64_t value = 0xcbf29ce484222325u;

  void add(uint64_t word) { value = (value ^ word) * 0x100000001b3u; }
  void add(double number) {
    uint64_t word = 0;
    std::memcpy(&word, &number, sizeof word);
    add(word);
  }
  void add(const void* data, size_t bytes) {
    const auto* from = static_cast<const unsigned char*>(data);
    for (; bytes >= 8; bytes -= 8, from += 8) {
      uint64_t word = 0;
      std::memcpy(&word, from, 8);
      // The product alone never carries high bits down.
      add(word ^ (value >> 32));
    }
    uint64_t word = 0;
    if (bytes > 0) std::memcpy(&word, from, bytes);
    add(word);
  }
};

}  // namespace

Expected<HeightField> HeightField::create(const HeightFieldDesc& desc, Samples samples,
                                          std::span<const uint8_t> holes) {
  const size_t count = std::visit([](const auto& values) { return values.size(); }, samples);
  if (auto checked = check(desc, count, holes.size()); !checked) return tl::unexpected<Error>(checked.error());
  HeightField field;
  field.desc_ = desc;
  const glm::ivec2 cells(desc.columns - 1, desc.rows - 1);
  Lattice& lattice = field.lattice_;
  lattice = {desc.columns, desc.rows, desc.spacing, desc.origin, choose_root_bits(cells), {}, 0};
  lattice.root_squares = squares_for(cells, lattice.root_bits);
  lattice.max_level = lattice.data_level();
  if (auto taken = field.adopt(std::move(samples), holes); !taken) return tl::unexpected<Error>(taken.error());
  field.measure_range();
  if (!(field.height_range_[1] - field.height_range_[0] <= k_max_span_m)) {
    return fail("heights span more than 262144 m: check the height scale, or mark no-data samples as holes");
  }
  field.set_up_relief();
  return field;
}

Expected<void> HeightField::adopt(Samples samples, std::span<const uint8_t> holes) {
  samples_ = std::move(samples);
  const std::vector<uint8_t> missing = find_missing(samples_, holes);
  hole_count_ = int64_t(missing.size()) - std::count(missing.begin(), missing.end(), uint8_t(0));
  if (hole_count_ == 0) return {};
  if (hole_count_ == int64_t(desc_.columns) * desc_.rows) {
    return fail("height field of " + size_text(desc_) + " samples has no data: every sample is a hole");
  }
  std::visit([&](auto& values) { fill(values, missing, {desc_.columns, desc_.rows}); }, samples_);
  holes_.assign((missing.size() + 63) / 64, 0);
  for (size_t i = 0; i < missing.size(); ++i) {
    if (missing[i] != 0) holes_[i / 64] |= uint64_t(1) << (i % 64);
  }
  return {};
}

void HeightField::measure_range() {
  const auto extremes = std::visit(
      [](const auto& values) {
        const auto [low, high] = std::minmax_element(values.begin(), values.end());
        return glm::dvec2(double(*low), double(*high));
      },
      samples_);
  const glm::dvec2 metres = extremes * desc_.scale + (desc_.offset + desc_.origin.z);
  height_range_ = {std::min(metres.x, metres.y), std::max(metres.x, metres.y)};
}

void HeightField::set_up_relief() {
  const ReliefOptions& relief = desc_.relief;
  const int below = relief.enabled ? levels_below(desc_.spacing, double(relief.finest_edge_m)) : 0;
  lattice_.max_level = std::min(data_level() + below, k_max_level);
  const int levels = max_level() - data_level();
  noise_bound_.assign(size_t(levels) + 1, 0.0);
  curvature_bound_ = smoothing::bound_table(levels);
  if (levels == 0) return;
  const size_t count = size_t(desc_.columns) * size_t(desc_.rows);
  if (relief.smooth) {
    coarse_curvatures_.assign(count, 0);
    fine_curvatures_.assign(count, 0);
  }
  // With no height there is nothing to evaluate.
  if (relief.roughness > 0.0f) {
    octaves_ = levels / 2;
    first_amplitude_ = double(relief.roughness) * std::sqrt(desc_.spacing.x * desc_.spacing.y);
    noise_bound_ = relief::bound_table(octaves_, levels);
    for (double& bound : noise_bound_) bound *= first_amplitude_;
    relief_shares_.assign(count, 0);
  }
  compute_relief(glm::ivec2(0), glm::ivec2(desc_.columns, desc_.rows) - 1);
}

void HeightField::compute_relief(glm::ivec2 first, glm::ivec2 last) {
  const glm::ivec2 data(desc_.columns - 1, desc_.rows - 1);
  first = glm::max(first, glm::ivec2(0));
  last = glm::min(last, data);
  const int64_t cost = last.x - first.x + 1;
  if (!relief_shares_.empty()) {
    parallel_rows({last.y - first.y + 1, cost, 0}, {}, [&](int k) { compute_shares(first.y + k, first.x, last.x); });
  }
  if (!coarse_curvatures_.empty()) {
    // A cell reads one sample more to the west and north than those at its corners.
    first = glm::max(first - 1, glm::ivec2(0));
    last = glm::min(last, data - 1);
    parallel_rows({last.y - first.y + 1, cost, 0}, {},
                  [&](int k) { compute_curvatures(first.y + k, first.x, last.x); });
    const auto largest_of = [&](const std::vector<uint8_t>& table, uint8_t largest) {
      for (int row = first.y; row <= last.y; ++row) {
        const auto begin = table.begin() + int64_t(row) * desc_.columns;
        largest = std::max(largest, *std::max_element(begin + first.x, begin + last.x + 1));
      }
      return largest;
    };
    largest_coarse_ = largest_of(coarse_curvatures_, largest_coarse_);
    largest_fine_ = largest_of(fine_curvatures_, largest_fine_);
  }
  relief_amplitude_ = first_amplitude_ * relief::k_noise_limit * (2.0 - std::ldexp(2.0, -octaves_)) +
                      smoothing::decode(largest_coarse_);
}

void HeightField::compute_shares(int row, int first, int last) {
  const glm::dvec2 half_run = 0.5 / desc_.spacing * desc_.scale;
  const int north = std::max(row - 1, 0), south = std::min(row + 1, desc_.rows - 1);
  for (int column = first; column <= last; ++column) {
    if (is_hole(column, row)) continue;
    const int west = std::max(column - 1, 0), east = std::min(column + 1, desc_.columns - 1);
    const double x = (raw(east, row) - raw(west, row)) * half_run.x * (east - west == 2 ? 1.0 : 2.0);
    const double y = (raw(column, north) - raw(column, south)) * half_run.y * (south - north == 2 ? 1.0 : 2.0);
    relief_shares_[size_t(row) * size_t(desc_.columns) + size_t(column)] =
        relief::share(desc_.relief, float(std::sqrt(x * x + y * y)));
  }
}

void HeightField::compute_curvatures(int row, int first, int last) {
  const double scale = std::abs(desc_.scale);
  const size_t begin = size_t(row) * size_t(desc_.columns);
  std::visit(
      [&](const auto& values) {
        for (int column = first; column <= last; ++column) {
          if (hole_count_ > 0 && is_hole(column, row) && is_hole(column + 1, row) && is_hole(column, row + 1) &&
              is_hole(column + 1, row + 1)) {
            continue;
          }
          const auto patch = smoothing::gather(values.data(), {desc_.columns, desc_.rows}, {column, row});
          const smoothing::Codes codes =
              smoothing::curvature_codes(patch, scale, (column + row) % 2 == 0, curvature_bound_);
          coarse_curvatures_[begin + size_t(column)] = codes.coarse;
          fine_curvatures_[begin + size_t(column)] = codes.fine;
        }
      },
      samples_);
}

uint64_t HeightField::fingerprint() const {
  Hash hash;
  const int smooth = coarse_curvatures_.empty() ? 0 : 1;
  for (const int number : {desc_.columns, desc_.rows, root_bits(), max_level(), octaves_, smooth}) {
    hash.add(uint64_t(number));
  }
  for (const double number : {desc_.spacing.x, desc_.spacing.y, desc_.scale, first_amplitude_}) hash.add(number);
  hash.add(uint64_t(samples_.index()));
  std::visit([&](const auto& values) { hash.add(values.data(), values.size() * sizeof(values[0])); }, samples_);
  hash.add(holes_.data(), holes_.size() * sizeof(uint64_t));
  hash.add(relief_shares_.data(), relief_shares_.size());
  return hash.value;
}

}  // namespace sward
