// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What a world answers. Levels 0 to 2 coarse_bits - 1 (splits) and their triangles come from the coarse data, always.
//
// When a diamond below may be split. Its ancestors are the diamonds that have to be split before it; those of level
// 2 coarse_bits are cells of the coarse grid, each in one square. It may be split exactly where the squares of all its
// ancestors of that level are resident. So where it may, its ancestors may (theirs are among its own), and its centre
// and the bounds of its children lie in a triangle that descends from one of those cells, so in a resident square.
// Descendants of a cell stay within one and a half cells of its centre: unless a square that near is missing, nothing
// has to be searched.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <sward/terrain/bounds.h>

#include "world_impl.h"

namespace sward {

namespace {

// The bintree's rule for the diagonal of a cell of an even level (height_field_queries.cpp derives it).
bool falls_east(glm::ivec2 cell) {
  return ((cell.x + cell.y) & 1) == 0;
}

// Linear interpolation over the triangle of a unit cell that holds `place`; at(point) gives corners.
template <class At>
double interpolate(glm::dvec2 place, glm::ivec2 last, At&& at) {
  const glm::ivec2 cell = glm::clamp(glm::ivec2(glm::floor(place)), glm::ivec2(0), last - 1);
  const double u = place.x - cell.x, v = place.y - cell.y;
  const auto corner = [&](int x, int y) { return at(cell + glm::ivec2(x, y)); };
  if (falls_east(cell)) {
    const double nw = corner(0, 0), se = corner(1, 1);
    if (u >= v) {
      const double ne = corner(1, 0);
      return nw + u * (ne - nw) + v * (se - ne);
    }
    const double sw = corner(0, 1);
    return nw + v * (sw - nw) + u * (se - sw);
  }
  const double ne = corner(1, 0), sw = corner(0, 1);
  if (u + v <= 1.0) {
    const double nw = corner(0, 0);
    return nw + u * (ne - nw) + v * (sw - nw);
  }
  const double se = corner(1, 1);
  return se + (1.0 - u) * (sw - se) + (1.0 - v) * (ne - se);
}

// Corners in the order NW, NE, SW, SE; t within the cell.
glm::dvec2 bilinear(const std::array<glm::dvec2, 4>& corner, glm::dvec2 t) {
  return glm::mix(glm::mix(corner[0], corner[1], t.x), glm::mix(corner[2], corner[3], t.x), t.y);
}

float decode_bound(uint16_t code) {
  return code == world::k_nothing ? 0.0f : Bounds::decode(code);
}

// Diamonds of one level that all have to be split.
struct Front {
  std::array<LatticePoint, 64> centre;
  size_t count = 0;
  void add(LatticePoint p) {
    const auto end = centre.begin() + std::ptrdiff_t(count);
    if (std::find(centre.begin(), end, p) == end) centre[count++] = p;
  }
};

// The centres of a diamond's two parents are the apexes of its triangles.
//   level 2 k + 1: centre in the middle of a side of a square of side s = root side >> k, base along the side; the
//   apexes are the centres of the squares on both sides.
//   level 2 k >= 2: centre in the middle of such a square, base along the diagonal whose corners, counted in s, have an
//   even sum; the apexes are the other two corners.
std::array<LatticePoint, 2> parents_of(LatticePoint centre, int level) {
  const int s = k_root_side >> (level / 2);
  const int h = s / 2;
  if (level % 2 == 1) {
    const LatticePoint across = centre.y % s == 0 ? LatticePoint(0, h) : LatticePoint(h, 0);
    return {centre - across, centre + across};
  }
  const LatticePoint nw = centre - h;
  const bool odd = ((nw.x / s + nw.y / s) & 1) != 0;
  if (odd) return {nw, nw + s};
  return {nw + LatticePoint(s, 0), nw + LatticePoint(0, s)};
}

}  // namespace

World::Impl::FineSample World::Impl::find(glm::ivec2 sample) const {
  const int bits = layout.desc.root_bits, mask = layout.cells - 1;
  const glm::ivec2 south_east = glm::min(sample >> bits, layout.squares - 1);
  // On a border the neighbours to the west and north have it, too.
  const int wests = (sample.x & mask) == 0 && south_east.x > 0 && sample.x < layout.grid_last.x ? 1 : 0;
  const int norths = (sample.y & mask) == 0 && south_east.y > 0 && sample.y < layout.grid_last.y ? 1 : 0;
  for (int north = 0; north <= norths; ++north)
    for (int west = 0; west <= wests; ++west) {
      const glm::ivec2 square = south_east - glm::ivec2(west, north);
      if (const SquareData* data = fine(square)) return {data, sample - square * layout.cells};
    }
  return {};
}

double World::Impl::sample_height(glm::ivec2 sample) const {
  if (((sample.x | sample.y) & (layout.coarse_step - 1)) == 0) return coarse_height(sample / layout.coarse_step);
  if (const FineSample found = find(sample); found.data != nullptr)
    return metres(world::raw_sample(layout, *found.data, found.at));
  const glm::dvec2 place = glm::dvec2(sample) / double(layout.coarse_step);
  return interpolate(place, layout.coarse_last, [this](glm::ivec2 at) { return coarse_height(at); });
}

// `place` in samples. All three corners come from the same square, or all from the coarse grid.
double World::Impl::surface_height(glm::dvec2 place) const {
  const glm::ivec2 cell = glm::clamp(glm::ivec2(glm::floor(place)), glm::ivec2(0), layout.grid_last - 1);
  const glm::ivec2 square = cell >> layout.desc.root_bits;
  if (const SquareData* data = fine(square)) {
    return interpolate(place, layout.grid_last, [&](glm::ivec2 sample) {
      return metres(world::raw_sample(layout, *data, sample - square * layout.cells));
    });
  }
  return interpolate(place / double(layout.coarse_step), layout.coarse_last,
                     [this](glm::ivec2 at) { return coarse_height(at); });
}

float World::Impl::cell_bound(LatticePoint centre) const {
  const glm::ivec2 cell = glm::min(centre >> layout.coarse_unit_bits, layout.coarse_last - 1);
  return decode_bound(coarse->cell_bounds[layout.cell_index(cell)]);
}

bool World::Impl::ancestors_resident(LatticePoint centre, int level) const {
  const int coarsest = 2 * layout.desc.coarse_bits;
  const LatticePoint end = layout.squares * k_root_side;
  Front front;
  front.add(centre);
  for (int l = level; l > coarsest; --l) {
    Front above;
    for (size_t i = 0; i < front.count; ++i)
      for (const LatticePoint parent : parents_of(front.centre[i], l)) {
        // Beyond the world's edge there is nothing to split.
        if (parent.x < 0 || parent.y < 0 || parent.x > end.x || parent.y > end.y) continue;
        above.add(parent);
      }
    front = above;
  }
  return std::all_of(front.centre.begin(), front.centre.begin() + std::ptrdiff_t(front.count),
                     [&](LatticePoint p) { return fine(p >> k_root_bits) != nullptr; });
}

const WorldDesc& World::desc() const {
  return impl_->layout.desc;
}

const Lattice& World::lattice() const {
  return impl_->layout.lattice;
}

double World::height(LatticePoint p) const {
  const world::Readers::Guard guard(impl_->readers);
  const Impl& w = *impl_;
  const int mask = (1 << w.layout.step_bits) - 1;
  if (((p.x | p.y) & mask) == 0) return w.sample_height(p >> w.layout.step_bits);
  return w.surface_height(glm::dvec2(p) / double(mask + 1));
}

double World::height(glm::dvec2 xy) const {
  const glm::dvec2 place = lattice().from_world(xy);
  if (std::isnan(place.x)) return place.x;
  const world::Readers::Guard guard(impl_->readers);
  return impl_->surface_height(place / double(lattice().sample_step()));
}

glm::dvec2 World::relief_gradient(LatticePoint) const {
  return glm::dvec2(0.0);
}

float World::bound(LatticePoint centre, int level) const {
  const Impl& w = *impl_;
  const int coarsest = 2 * w.layout.desc.coarse_bits;
  if (level >= lattice().max_level) return 0.0f;
  if (level < coarsest)
    return decode_bound(w.coarse->bounds[w.layout.coarse_index(centre >> w.layout.coarse_unit_bits)]);
  if (level == coarsest) return w.cell_bound(centre);
  const world::Readers::Guard guard(impl_->readers);
  const Impl::FineSample found = w.find(centre >> w.layout.step_bits);
  if (found.data == nullptr) return w.cell_bound(centre);
  return decode_bound(found.data->bounds[size_t(found.at.y) * size_t(w.layout.side()) + size_t(found.at.x)]);
}

bool World::can_split(LatticePoint centre, int level) const {
  const Impl& w = *impl_;
  if (level < 2 * w.layout.desc.coarse_bits) return true;
  if (level >= lattice().max_level) return false;
  const world::Readers::Guard guard(impl_->readers);
  const int reach = (3 << w.layout.coarse_unit_bits) / 2 - 1;
  const glm::ivec2 first = glm::max(centre - reach, LatticePoint(0)) >> k_root_bits;
  const glm::ivec2 last = glm::min((centre + reach) >> k_root_bits, w.layout.squares - 1);
  bool all = true;
  for (int row = first.y; row <= last.y; ++row)
    for (int column = first.x; column <= last.x; ++column) all = all && w.fine({column, row}) != nullptr;
  return all || w.ancestors_resident(centre, level);
}

glm::dvec2 World::Impl::fine_gradient(const SquareData& data, glm::ivec2 square, glm::ivec2 sample) const {
  const glm::ivec2 low = glm::max(sample - 1, glm::ivec2(0)), high = glm::min(sample + 1, layout.data_last);
  const auto at = [&](int column, int row) {
    return metres(world::raw_sample(layout, data, glm::ivec2(column, row) - square * layout.cells));
  };
  const glm::dvec2 spacing = layout.desc.spacing;
  return {(at(high.x, sample.y) - at(low.x, sample.y)) / ((high.x - low.x) * spacing.x),
          (at(sample.x, low.y) - at(sample.x, high.y)) / ((high.y - low.y) * spacing.y)};
}

glm::dvec2 World::Impl::coarse_gradient(glm::ivec2 at) const {
  const glm::ivec2 low = glm::max(at - 1, glm::ivec2(0)), high = glm::min(at + 1, layout.coarse_last);
  const glm::dvec2 spacing = layout.desc.spacing * double(layout.coarse_step);
  return {(coarse_height({high.x, at.y}) - coarse_height({low.x, at.y})) / ((high.x - low.x) * spacing.x),
          (coarse_height({at.x, low.y}) - coarse_height({at.x, high.y})) / ((high.y - low.y) * spacing.y)};
}

// `place` in coarse samples, on the data. Neighbours ask for the same cell many times.
glm::dvec2 World::Impl::coarse_gradient_between(glm::dvec2 place, CoarseCell& kept) const {
  const glm::ivec2 cell = glm::min(glm::ivec2(place), layout.coarse_last - 1);
  if (cell != kept.cell) {
    kept.cell = cell;
    for (int corner = 0; corner < 4; ++corner)
      kept.gradient[size_t(corner)] = coarse_gradient(cell + glm::ivec2(corner & 1, corner >> 1));
  }
  return bilinear(kept.gradient, place - glm::dvec2(cell));
}

// `place` in samples, on the data.
glm::dvec2 World::Impl::gradient_between(glm::dvec2 place) const {
  const glm::ivec2 cell = glm::min(glm::ivec2(place), layout.data_last - 1);
  const glm::ivec2 square = cell >> layout.desc.root_bits;
  const SquareData* data = fine(square);
  CoarseCell coarse_cell;
  if (data == nullptr) return coarse_gradient_between(place / double(layout.coarse_step), coarse_cell);
  std::array<glm::dvec2, 4> gradient;
  for (int corner = 0; corner < 4; ++corner)
    gradient[size_t(corner)] = fine_gradient(*data, square, cell + glm::ivec2(corner & 1, corner >> 1));
  return bilinear(gradient, place - glm::dvec2(cell));
}

glm::dvec2 World::data_gradient(glm::dvec2 xy) const {
  const world::Readers::Guard guard(impl_->readers);
  const WorldDesc& d = impl_->layout.desc;
  const glm::dvec2 last(impl_->layout.data_last);
  const double x = (xy.x - d.origin.x) / d.spacing.x + 0.5 * last.x;
  const double y = 0.5 * last.y - (xy.y - d.origin.y) / d.spacing.y;
  // NaN, too, ends on the data.
  return impl_->gradient_between({x > 0.0 ? std::min(x, last.x) : 0.0, y > 0.0 ? std::min(y, last.y) : 0.0});
}

// Differences over `reach` samples to each side, as far as the square's ring and the data go.
glm::dvec2 World::Impl::wide_gradient(const SquareData& data, glm::ivec2 square, glm::ivec2 sample, int reach) const {
  const glm::ivec2 corner = square * layout.cells;
  const glm::ivec2 low = glm::max(glm::max(sample - reach, corner - 1), glm::ivec2(0));
  const glm::ivec2 high = glm::min(glm::min(sample + reach, corner + layout.cells + 1), layout.data_last);
  const auto at = [&](int column, int row) {
    return world::raw_sample(layout, data, glm::ivec2(column, row) - corner) * layout.desc.scale;
  };
  const glm::dvec2 spacing = layout.desc.spacing;
  return {(at(high.x, sample.y) - at(low.x, sample.y)) / ((high.x - low.x) * spacing.x),
          (at(sample.x, low.y) - at(sample.x, high.y)) / ((high.y - low.y) * spacing.y)};
}

void World::data_gradients(glm::ivec2 first, int stride, glm::ivec2 count, std::span<glm::vec2> out) const {
  SWARD_ASSERT(out.size() == size_t(count.x) * size_t(count.y), "data_gradients: one place a sample");
  const world::Readers::Guard guard(impl_->readers);
  const Impl& w = *impl_;
  const int reach = std::max(stride / 2, 1);
  const double to_coarse = 1.0 / double(w.layout.coarse_step);
  Impl::CoarseCell coarse_cell;
  size_t i = 0;
  for (int row = 0; row < count.y; ++row)
    for (int column = 0; column < count.x; ++column) {
      const glm::ivec2 sample = glm::clamp(first + stride * glm::ivec2(column, row), glm::ivec2(0), w.layout.data_last);
      const glm::ivec2 square = glm::min(sample, w.layout.data_last - 1) >> w.layout.desc.root_bits;
      const SquareData* data = w.fine(square);
      out[i++] = glm::vec2(data != nullptr ? w.wide_gradient(*data, square, sample, reach)
                                           : w.coarse_gradient_between(glm::dvec2(sample) * to_coarse, coarse_cell));
    }
}

bool World::all_holes(const LatticeBox& box) const {
  const world::Readers::Guard guard(impl_->readers);
  const Impl& w = *impl_;
  const int bits = w.layout.step_bits;
  const glm::ivec2 low = glm::max(box.first >> bits, glm::ivec2(0));
  const glm::ivec2 high = glm::min((box.last + ((1 << bits) - 1)) >> bits, w.layout.data_last);
  for (int row = low.y; row <= high.y; ++row)
    for (int column = low.x; column <= high.x; ++column) {
      const Impl::FineSample found = w.find({column, row});
      if (found.data == nullptr || !world::is_hole(w.layout, *found.data, found.at)) return false;
    }
  return true;
}

bool World::resident(glm::ivec2 square) const {
  return impl_->layout.has(square) && impl_->fine(square) != nullptr;
}

glm::dvec2 World::height_range() const {
  glm::dvec2 range(std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest());
  for (const Impl::SquareInfo& square : impl_->squares) {
    range = {std::min(range.x, double(square.low)), std::max(range.y, double(square.high))};
  }
  return range;
}

}  // namespace sward
