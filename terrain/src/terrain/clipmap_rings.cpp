// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// After F. Losasso and H. Hoppe, "Geometry Clipmaps" (2004), and A. Asirvatham and H. Hoppe, "Terrain Rendering Using
// GPU-Based Geometry Clipmaps" (2005): nested grids, toroidal updates, borders that melt into the coarser grid.
#include <sward/terrain/clipmap_rings.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace sward {

namespace {

// Relief is told to shaders for rings that begin nearer than this, metres: further away it says nothing (and shaders
// fade it out at 500 m, times zoom).
constexpr double k_relief_reach_m = 2000;
// A ring is of no use once the eye is so many times its side above it, and melts on the way (Losasso and Hoppe: 0.4).
constexpr double k_melted_height = 0.4, k_melting_height = 0.3;

int positive_modulo(int value, int mask) {
  return value & mask;
}

// True where the diagonal runs from the north-west to the south-east.
bool falls_east(glm::ivec2 cell) {
  return ((cell.x + cell.y) & 1) == 0;
}

double cell_metres(const Lattice& lattice, int shift) {
  return std::max(lattice.spacing.x, lattice.spacing.y) * std::ldexp(1.0, shift) / lattice.sample_step();
}

// A box, relative to the eye, against halfspaces: false where one of them has all of it outside.
bool may_be_seen(const std::array<Plane, 6>& planes, glm::dvec3 low, glm::dvec3 high) {
  for (const Plane& plane : planes) {
    const glm::dvec3 farthest(plane.n.x > 0 ? high.x : low.x, plane.n.y > 0 ? high.y : low.y,
                              plane.n.z > 0 ? high.z : low.z);
    if (glm::dot(plane.n, farthest) + plane.d < 0) return false;
  }
  return true;
}

}  // namespace

Expected<ClipmapRings> ClipmapRings::create(const Surface& surface, const ClipmapOptions& options) {
  if (options.texels < 64 || options.texels > 1024 || !std::has_single_bit(unsigned(options.texels)))
    return fail("clipmap rings of " + std::to_string(options.texels) +
                " points a side; give a power of two from 64 to 1024");
  return ClipmapRings(surface, options.texels);
}

ClipmapRings::ClipmapRings(const Surface& surface, int texels) : surface_(&surface), texels_(texels) {
  const Lattice& lattice = surface.lattice();
  const glm::dvec2 range = surface.height_range();
  base_ = 0.5 * (range.x + range.y);
  const LatticePoint last = lattice.last();
  const int extent = std::max(last.x, last.y);
  for (int shift = k_root_bits - lattice.max_level / 2; shift <= k_root_bits; ++shift) {
    Ring ring;
    ring.shift = shift;
    // The ring begins where the finer one, of half its size, ends.
    ring.has_relief = cell_metres(lattice, shift) * cells() / 4 < k_relief_reach_m;
    rings_.push_back(std::move(ring));
    // From anywhere on the data it reaches the data's end.
    if ((int64_t(cells() / 2 - 2) << shift) >= extent || rings() == k_most_rings) break;
  }
  finest_ = rings();
}

glm::ivec2 ClipmapRings::window_for(const Ring& ring) const {
  const glm::dvec2 cells_from_0 = glm::ldexp(eye_, glm::ivec2(-ring.shift));
  return 2 * glm::ivec2(glm::round(0.5 * cells_from_0)) - cells() / 2;
}

// What a ring has to read to stand at `want`; how many points.
size_t ClipmapRings::plan(const Ring& ring, int index, glm::ivec2 want, std::vector<Change>& parts) const {
  const int points = cells() + 1;
  parts.clear();
  const auto add = [&](glm::ivec2 first, glm::ivec2 end) {
    if (end.x > first.x && end.y > first.y) parts.push_back({index, first, end - first});
  };
  const glm::ivec2 end = want + points, old_end = ring.first + points;
  if (!ring.filled || glm::any(glm::greaterThanEqual(glm::abs(want - ring.first), glm::ivec2(points)))) {
    add(want, end);
  } else {
    // Columns over the whole height, rows over what is left of the width.
    const glm::ivec2 kept_first = glm::max(want, ring.first), kept_end = glm::min(end, old_end);
    add(want, {kept_first.x, end.y});
    add({kept_end.x, want.y}, end);
    add({kept_first.x, want.y}, {kept_end.x, kept_first.y});
    add({kept_first.x, kept_end.y}, {kept_end.x, end.y});
    add(glm::max(kept_first, ring.stale_first), glm::min(kept_end, ring.stale_last + 1));
  }
  size_t count = 0;
  for (const Change& part : parts) count += size_t(part.size.x) * size_t(part.size.y);
  return count;
}

size_t ClipmapRings::place_of(glm::ivec2 point) const {
  const int mask = texels_ - 1;
  return size_t(positive_modulo(point.y, mask)) * size_t(texels_) + size_t(positive_modulo(point.x, mask));
}

void ClipmapRings::read(const Change& change) {
  Ring& ring = rings_[size_t(change.ring)];
  const size_t memory = size_t(texels_) * size_t(texels_);
  ring.z.resize(memory);
  if (ring.has_relief) ring.relief.resize(memory);
  const int side = 1 << ring.shift;
  const LatticeGrid grid{change.first * side, side, change.size};
  scratch_z_.resize(grid.size());
  surface_->grid_heights(grid, base_, scratch_z_);
  if (ring.has_relief) {
    scratch_relief_.resize(grid.size());
    surface_->grid_relief(grid, scratch_relief_);
  }
  size_t from = 0;
  for (int row = 0; row < change.size.y; ++row)
    for (int column = 0; column < change.size.x; ++column, ++from) {
      const size_t to = place_of(change.first + glm::ivec2(column, row));
      ring.z[to] = scratch_z_[from];
      if (ring.has_relief) ring.relief[to] = scratch_relief_[from];
    }
}

// Lowest and highest point of every block.
void ClipmapRings::measure(Ring& ring) {
  const int blocks = cells() / k_block_cells;
  ring.range.resize(size_t(blocks) * size_t(blocks));
  for (int y = 0; y < blocks; ++y)
    for (int x = 0; x < blocks; ++x) {
      glm::vec2 range(INFINITY, -INFINITY);
      for (int row = 0; row <= k_block_cells; ++row)
        for (int column = 0; column <= k_block_cells; ++column) {
          const float z = ring.z[place_of(ring.first + k_block_cells * glm::ivec2(x, y) + glm::ivec2(column, row))];
          range = {std::min(range.x, z), std::max(range.y, z)};
        }
      ring.range[size_t(y) * size_t(blocks) + size_t(x)] = range;
    }
}

std::span<const ClipmapRings::Change> ClipmapRings::follow(const View& view, size_t most_points) {
  const Lattice& lattice = surface_->lattice();
  eye_ = glm::clamp(lattice.extended_from_world(glm::dvec2(view.eye)), glm::dvec2(0), glm::dvec2(lattice.last()));
  const size_t whole = size_t(cells() + 1) * size_t(cells() + 1);
  size_t left = std::max(most_points, whole);
  changes_.clear();
  int usable = rings();
  // A ring is of use only where all coarser ones are.
  for (int i = rings() - 1; i >= 0; --i) {
    Ring& ring = rings_[size_t(i)];
    const glm::ivec2 want = window_for(ring);
    const size_t cost = plan(ring, i, want, parts_);
    if (cost > left) break;
    left -= cost;
    ring.first = want;
    ring.filled = true;
    ring.stale_last = ring.stale_first - 1;
    for (const Change& part : parts_) read(part);
    if (!parts_.empty()) measure(ring);
    changes_.insert(changes_.end(), parts_.begin(), parts_.end());
    usable = i;
  }
  settled_ = usable == 0;
  choose_finest(view, usable);
  return changes_;
}

void ClipmapRings::choose_finest(const View& view, int first_usable) {
  const Lattice& lattice = surface_->lattice();
  std::array<float, 1> ground{};
  surface_->grid_heights({LatticePoint(glm::round(eye_)), 1, {1, 1}}, 0.0, ground);
  const double above = std::max(view.eye.z - double(ground[0]), 0.0) / std::max(view.zoom(), 1e-6);
  finest_ = first_usable;
  const auto side = [&](int ring) { return cells() * cell_metres(lattice, shift(ring)); };
  while (finest_ < rings() - 1 && above >= k_melted_height * side(finest_)) ++finest_;
  finest_melt_ = 0;
  if (finest_ >= rings() - 1) return;
  const double share = above / side(finest_);
  finest_melt_ = std::clamp((share - k_melting_height) / (k_melted_height - k_melting_height), 0.0, 1.0);
}

void ClipmapRings::changed(const LatticeBox& box) {
  if (box.empty()) return;
  // Smooth heights reach two samples.
  const int reach = 2 * surface_->lattice().sample_step();
  for (Ring& ring : rings_) {
    const glm::ivec2 first = (box.first - reach) >> ring.shift, last = ((box.last + reach) >> ring.shift) + 1;
    if (!ring.filled) continue;
    const bool none = glm::any(glm::lessThan(ring.stale_last, ring.stale_first));
    ring.stale_first = none ? first : glm::min(ring.stale_first, first);
    ring.stale_last = none ? last : glm::max(ring.stale_last, last);
  }
  settled_ = false;
}

// The coarser ring's surface at a point of this ring.
double ClipmapRings::coarser_height(int ring, glm::ivec2 point) const {
  const std::vector<float>& z = rings_[size_t(ring) + 1].z;
  const glm::ivec2 odd = point & 1, cell = point >> 1;
  if (odd == glm::ivec2(0)) return z[place_of(cell)];
  if (odd == glm::ivec2(1) && !falls_east(cell))
    return 0.5 * (double(z[place_of(cell + glm::ivec2(1, 0))]) + double(z[place_of(cell + glm::ivec2(0, 1))]));
  return 0.5 * (double(z[place_of(cell)]) + double(z[place_of(cell + odd)]));
}

double ClipmapRings::melted_height(int ring, glm::ivec2 point) const {
  const Ring& r = rings_[size_t(ring)];
  const double own = r.z[place_of(point)];
  if (ring == rings() - 1) return own;
  const glm::dvec2 cells_away = glm::abs(glm::dvec2(point) - glm::ldexp(eye_, glm::ivec2(-r.shift)));
  double melt = std::clamp((std::max(cells_away.x, cells_away.y) - melt_begin()) / melt_width(), 0.0, 1.0);
  if (ring == finest_) melt = std::max(melt, finest_melt_);
  return melt == 0 ? own : glm::mix(own, coarser_height(ring, point), melt);
}

double ClipmapRings::height(glm::dvec2 xy) const {
  const glm::dvec2 place = surface_->lattice().from_world(xy);
  if (std::isnan(place.x) || finest_ == rings()) return std::numeric_limits<double>::quiet_NaN();
  int ring = finest_;
  glm::dvec2 at;
  glm::ivec2 cell;
  for (;; ++ring) {
    at = glm::ldexp(place, glm::ivec2(-shift(ring)));
    cell = glm::ivec2(glm::floor(at));
    const glm::ivec2 in_window = cell - first(ring);
    if (ring == rings() - 1) break;
    if (glm::all(glm::greaterThanEqual(in_window, glm::ivec2(0))) &&
        glm::all(glm::lessThan(in_window, glm::ivec2(cells()))))
      break;
  }
  const glm::dvec2 t = at - glm::dvec2(cell);
  const auto z = [&](int x, int y) { return melted_height(ring, cell + glm::ivec2(x, y)); };
  double above = 0;
  if (falls_east(cell)) {
    above = t.x >= t.y ? z(0, 0) * (1 - t.x) + z(1, 0) * (t.x - t.y) + z(1, 1) * t.y
                       : z(0, 0) * (1 - t.y) + z(0, 1) * (t.y - t.x) + z(1, 1) * t.x;
  } else {
    above = t.x + t.y <= 1 ? z(0, 0) * (1 - t.x - t.y) + z(1, 0) * t.x + z(0, 1) * t.y
                           : z(1, 1) * (t.x + t.y - 1) + z(0, 1) * (1 - t.x) + z(1, 0) * (1 - t.y);
  }
  return above + base_;
}

// Whether the finer ring covers these cells.
bool ClipmapRings::in_hole(int ring, glm::ivec2 first_cell, int count) const {
  if (ring == finest_) return false;
  const glm::ivec2 hole = first(ring - 1) / 2, end = hole + cells() / 2;
  return glm::all(glm::greaterThanEqual(first_cell, hole)) && glm::all(glm::lessThanEqual(first_cell + count, end));
}

void ClipmapRings::visible_blocks(const View& view, std::vector<Block>& out) const {
  out.clear();
  const Lattice& lattice = surface_->lattice();
  const std::array<Plane, 6> planes = frustum_planes(view);
  const int blocks = cells() / k_block_cells;
  const LatticePoint data_end = lattice.last();
  for (int i = finest_; i < rings(); ++i) {
    const Ring& ring = rings_[size_t(i)];
    for (int y = 0; y < blocks; ++y)
      for (int x = 0; x < blocks; ++x) {
        const glm::ivec2 cell = ring.first + k_block_cells * glm::ivec2(x, y);
        if (in_hole(i, cell, k_block_cells)) continue;
        const LatticePoint from = cell * (1 << ring.shift), to = (cell + k_block_cells) * (1 << ring.shift);
        if (glm::any(glm::greaterThanEqual(from, data_end)) || glm::any(glm::lessThanEqual(to, LatticePoint(0))))
          continue;
        const glm::dvec2 north_west = lattice.world_xy(from), south_east = lattice.world_xy(to);
        const glm::vec2 range = ring.range[size_t(y) * size_t(blocks) + size_t(x)];
        const glm::dvec3 low(north_west.x, south_east.y, base_ + double(range.x));
        const glm::dvec3 high(south_east.x, north_west.y, base_ + double(range.y));
        if (may_be_seen(planes, low - view.eye, high - view.eye)) out.push_back({i, {x, y}});
      }
  }
}

}  // namespace sward
