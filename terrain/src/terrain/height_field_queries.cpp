// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Heights. At the data's level the bintree's triangles cover the samples' cells: the diagonal of cell (c, r) joins the
// corner whose indices are both even with the one whose indices are both odd, because a split of level 2 i makes the
// centre of a square of cells and a split of level 2 i + 1 the middle of a side, so that triangles of even level have
// their bases between centres (odd, odd) and old corners (even, even). Below the data the same rule holds for the
// smaller cells. The finest surface is linear over the triangles of max_level().

#include <sward/terrain/height_field.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "relief.h"
#include "smoothing.h"

namespace sward {

namespace {

// Corners of one triangle and the weights of a point in it.
struct Weighted {
  std::array<LatticePoint, 3> corner;
  std::array<double, 3> weight;
};

// True where the diagonal runs from the north-west to the south-east.
bool falls_east(int column, int row) {
  return ((column + row) & 1) == 0;
}

// The triangle of a square cell cut along its diagonal; (u, v) in [0, 1]^2 from the north-west.
Weighted in_halved_cell(glm::ivec2 cell, int side, double u, double v) {
  const LatticePoint nw = cell * side, ne = nw + LatticePoint(side, 0), sw = nw + LatticePoint(0, side);
  const LatticePoint se = nw + side;
  if (falls_east(cell.x, cell.y)) {
    if (u >= v) return {{nw, ne, se}, {1.0 - u, u - v, v}};
    return {{nw, sw, se}, {1.0 - v, v - u, u}};
  }
  if (u + v <= 1.0) return {{nw, ne, sw}, {1.0 - u - v, u, v}};
  return {{se, sw, ne}, {u + v - 1.0, 1.0 - u, 1.0 - v}};
}

// The triangle of a cell cut along both diagonals.
Weighted in_quartered_cell(glm::ivec2 cell, int side, double u, double v) {
  const LatticePoint nw = cell * side, ne = nw + LatticePoint(side, 0), sw = nw + LatticePoint(0, side);
  const LatticePoint se = nw + side, centre = nw + side / 2;
  const double x = 2.0 * u - 1.0, y = 2.0 * v - 1.0;
  const bool across = std::abs(x) >= std::abs(y);
  const double out = across ? std::abs(x) : std::abs(y);
  const double along = across ? y : x;
  const LatticePoint first = across ? (x < 0.0 ? nw : ne) : (y < 0.0 ? nw : sw);
  const LatticePoint second = across ? (x < 0.0 ? sw : se) : (y < 0.0 ? ne : se);
  return {{centre, first, second}, {1.0 - out, 0.5 * (out - along), 0.5 * (out + along)}};
}

// The triangle of `level` around a point; cells are those of the data.
Weighted locate(const HeightField& field, glm::dvec2 lattice, int level) {
  const int side = k_root_side >> (level / 2);
  const int per_sample = field.sample_step() / side;
  const glm::ivec2 last = glm::ivec2(field.desc().columns - 1, field.desc().rows - 1) * per_sample - 1;
  const glm::dvec2 scaled = lattice / double(side);
  const glm::ivec2 cell = glm::clamp(glm::ivec2(glm::floor(scaled)), glm::ivec2(0), last);
  const glm::dvec2 place = glm::clamp(scaled - glm::dvec2(cell), 0.0, 1.0);
  if (level % 2 == 0) return in_halved_cell(cell, side, place.x, place.y);
  return in_quartered_cell(cell, side, place.x, place.y);
}

// Linear interpolation in the data's triangle around p; at(column, row) gives a sample.
template <class At>
double interpolate(LatticePoint p, int step_bits, At&& at) {
  const int mask = (1 << step_bits) - 1;
  const int column = p.x >> step_bits, row = p.y >> step_bits;
  const int x = p.x & mask, y = p.y & mask;
  if ((x | y) == 0) return at(column, row);
  const double inverse = 1.0 / double(1 << step_bits);
  const double u = x * inverse, v = y * inverse;
  if (falls_east(column, row)) {
    const double near = at(column, row), far = at(column + 1, row + 1);
    if (x >= y) {
      const double corner = at(column + 1, row);
      return near + u * (corner - near) + v * (far - corner);
    }
    const double corner = at(column, row + 1);
    return near + v * (corner - near) + u * (far - corner);
  }
  const double ne = at(column + 1, row), sw = at(column, row + 1);
  if (x + y <= mask + 1) {
    const double nw = at(column, row);
    return nw + u * (ne - nw) + v * (sw - nw);
  }
  const double se = at(column + 1, row + 1);
  return se + (1.0 - u) * (sw - se) + (1.0 - v) * (ne - se);
}

}  // namespace

double HeightField::raw(int column, int row) const {
  const size_t index = size_t(row) * size_t(desc_.columns) + size_t(column);
  if (const auto* words = std::get_if<std::vector<uint16_t>>(&samples_)) return double((*words)[index]);
  return double((*std::get_if<std::vector<float>>(&samples_))[index]);
}

void HeightField::prefetch(LatticePoint p) const {
  const int step = lattice_.sample_step();
  const int column = std::min(p.x / step, desc_.columns - 1), row = std::min(p.y / step, desc_.rows - 1);
  const size_t index = size_t(row) * size_t(desc_.columns) + size_t(column);
  std::visit([index](const auto& values) { __builtin_prefetch(&values[index]); }, samples_);
}

double HeightField::sample(int column, int row) const {
  const int c = std::clamp(column, 0, desc_.columns - 1), r = std::clamp(row, 0, desc_.rows - 1);
  return raw(c, r) * desc_.scale + (desc_.offset + desc_.origin.z);
}

bool HeightField::is_hole(int column, int row) const {
  if (holes_.empty()) return false;
  const int c = std::clamp(column, 0, desc_.columns - 1), r = std::clamp(row, 0, desc_.rows - 1);
  const size_t index = size_t(r) * size_t(desc_.columns) + size_t(c);
  return (holes_[index / 64] >> (index % 64) & 1) != 0;
}

double HeightField::linear_height(LatticePoint p) const {
  return interpolate(p, k_root_bits - root_bits(), [this](int column, int row) { return sample(column, row); });
}

namespace {

// The cell around a point of the data, and the point's place in it.
struct Place {
  glm::ivec2 cell;
  glm::dvec2 uv;
};

Place place_in_cell(const Lattice& lattice, LatticePoint p) {
  const int step = lattice.sample_step();
  const LatticePoint q = glm::clamp(p, LatticePoint(0), lattice.last());
  const glm::ivec2 cell = glm::min(q / step, glm::ivec2(lattice.columns, lattice.rows) - 2);
  return {cell, glm::dvec2(q - cell * step) / double(step)};
}

}  // namespace

double HeightField::smooth_height(LatticePoint p) const {
  const int mask = sample_step() - 1;
  if (((p.x | p.y) & mask) == 0) return sample(p.x / sample_step(), p.y / sample_step());
  const Place place = place_in_cell(lattice_, p);
  const auto across = smoothing::weights(place.uv.x), along = smoothing::weights(place.uv.y);
  const double raw_height = std::visit(
      [&](const auto& values) {
        const auto patch = smoothing::gather(values.data(), {desc_.columns, desc_.rows}, place.cell);
        return smoothing::weighted(patch, across, along);
      },
      samples_);
  return raw_height * desc_.scale + (desc_.offset + desc_.origin.z);
}

// dz/dx, dz/dy.
glm::dvec2 HeightField::smooth_gradient(LatticePoint p) const {
  const Place place = place_in_cell(lattice_, p);
  const glm::dvec2 per_sample = std::visit(
      [&](const auto& values) {
        const auto patch = smoothing::gather(values.data(), {desc_.columns, desc_.rows}, place.cell);
        const auto across = smoothing::weights(place.uv.x), along = smoothing::weights(place.uv.y);
        return glm::dvec2(smoothing::weighted(patch, smoothing::slope_weights(place.uv.x), along),
                          smoothing::weighted(patch, across, smoothing::slope_weights(place.uv.y)));
      },
      samples_);
  return desc_.scale * per_sample / glm::dvec2(desc_.spacing.x, -desc_.spacing.y);
}

double HeightField::relief_share(LatticePoint p) const {
  return interpolate(p, k_root_bits - root_bits(), [this](int column, int row) {
    const int c = std::clamp(column, 0, desc_.columns - 1), r = std::clamp(row, 0, desc_.rows - 1);
    return double(relief_shares_[size_t(r) * size_t(desc_.columns) + size_t(c)]) * (1.0 / 255.0);
  });
}

double HeightField::height(LatticePoint p) const {
  const double base = coarse_curvatures_.empty() ? linear_height(p) : smooth_height(p);
  if (octaves_ == 0) return base;
  const double sum = relief::octave_sum(p, k_root_bits - root_bits(), octaves_, desc_.relief.seed);
  return sum == 0.0 ? base : base + first_amplitude_ * relief_share(p) * sum;
}

double HeightField::height(glm::dvec2 xy) const {
  const glm::dvec2 lattice = lattice_.from_world(xy);
  if (std::isnan(lattice.x)) return lattice.x;
  const Weighted place = locate(*this, lattice, max_level());
  double z = 0.0;
  for (size_t i = 0; i < 3; ++i) z += place.weight[i] * height(place.corner[i]);
  return z;
}

glm::dvec3 HeightField::normal(glm::dvec2 xy) const {
  const glm::dvec2 lattice = lattice_.from_world(xy);
  if (std::isnan(lattice.x)) return {0.0, 0.0, 1.0};
  const Weighted place = locate(*this, lattice, max_level());
  std::array<glm::dvec3, 3> corner;
  for (size_t i = 0; i < 3; ++i) corner[i] = {world_xy(place.corner[i]), height(place.corner[i])};
  const glm::dvec3 n = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
  return glm::normalize(n.z < 0.0 ? -n : n);
}

glm::dvec2 HeightField::data_gradient(glm::dvec2 xy) const {
  const glm::dvec2 last(desc_.columns - 1, desc_.rows - 1);
  const double x = (xy.x - desc_.origin.x) / desc_.spacing.x + 0.5 * last.x;
  const double y = 0.5 * last.y - (xy.y - desc_.origin.y) / desc_.spacing.y;
  // NaN, too, ends on the data.
  const glm::dvec2 place(x > 0.0 ? std::min(x, last.x) : 0.0, y > 0.0 ? std::min(y, last.y) : 0.0);
  const glm::ivec2 cell = glm::min(glm::ivec2(place), glm::ivec2(last) - 1);
  const glm::dvec2 t = place - glm::dvec2(cell);
  const auto at = [this](int column, int row) {
    const int west = std::max(column - 1, 0), east = std::min(column + 1, desc_.columns - 1);
    const int north = std::max(row - 1, 0), south = std::min(row + 1, desc_.rows - 1);
    return glm::dvec2((sample(east, row) - sample(west, row)) / ((east - west) * desc_.spacing.x),
                      (sample(column, north) - sample(column, south)) / ((south - north) * desc_.spacing.y));
  };
  return glm::mix(glm::mix(at(cell.x, cell.y), at(cell.x + 1, cell.y), t.x),
                  glm::mix(at(cell.x, cell.y + 1), at(cell.x + 1, cell.y + 1), t.x), t.y);
}

glm::dvec2 HeightField::relief_gradient(LatticePoint p) const {
  const glm::dvec2 smooth =
      coarse_curvatures_.empty() ? glm::dvec2(0.0) : smooth_gradient(p) - data_gradient(world_xy(p));
  if (octaves_ == 0) return smooth;
  const int step_bits = k_root_bits - root_bits();
  const glm::dvec3 sum = relief::octave_sum_with_gradient(p, step_bits, octaves_, desc_.relief.seed);
  // The strength has a kink at the edges of the data's triangles: there this is the mean of both sides.
  const LatticePoint east(1, 0), south(0, 1);
  const double to_spacing = 0.5 * double(sample_step());
  const glm::dvec2 share_change(relief_share(p + east) - relief_share(p - east),
                                relief_share(p + south) - relief_share(p - south));
  const glm::dvec2 per_spacing = relief_share(p) * glm::dvec2(sum) + sum.z * to_spacing * share_change;
  return smooth + first_amplitude_ * per_spacing / glm::dvec2(desc_.spacing.x, -desc_.spacing.y);
}

double HeightField::relief_bound(int level) const {
  if (level >= max_level()) return 0.0;
  const auto below = size_t(std::max(level, data_level()) - data_level());
  return noise_bound_[below] + smoothing::bound({largest_coarse_, largest_fine_}, below, curvature_bound_);
}

double HeightField::relief_bound(LatticePoint centre, int level) const {
  if (level >= max_level()) return 0.0;
  const relief::Window window = relief::bound_window(*this, centre, level);
  const auto largest_in = [&](const std::vector<uint8_t>& table, glm::ivec2 last) {
    uint8_t largest = 0;
    if (table.empty()) return largest;
    for (int row = window.first.y; row <= last.y; ++row) {
      const uint8_t* values = table.data() + size_t(row) * size_t(desc_.columns);
      for (int column = window.first.x; column <= last.x; ++column) largest = std::max(largest, values[column]);
    }
    return largest;
  };
  const auto below = size_t(level - data_level());
  // The last samples' cells lie beyond the window.
  const bool coarse = below < smoothing::k_tried_levels;
  const uint8_t largest = largest_in(coarse ? coarse_curvatures_ : fine_curvatures_, window.last - 1);
  return largest_in(relief_shares_, window.last) / 255.0 * noise_bound_[below] +
         smoothing::bound({largest, largest}, below, curvature_bound_);
}

}  // namespace sward
