// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "vegetation/clipmap_table.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace sward {

namespace {

// The drawn triangle may be steeper than the data that its static area stands for: room in bounds for laws that
// measure the drawn one.
constexpr double k_drawn_area_room = 4.0;
// The drawn surface and the triangle's plane each stay within the bound of the finest surface, as do the corners.
constexpr double k_deviation_bounds = 3.0;
// Runs of excluded shapes of triangles that the window has left stay until there are so many texels.
constexpr size_t k_stale_runs = 65536;

// In sixths of a cell's side, as in shaders/common_seeding.glsl.
glm::ivec2 point_in_candidate(int level, glm::ivec2 cell, int triangle) {
  static constexpr glm::ivec2 k_quarters[] = {{3, 1}, {5, 3}, {3, 5}, {1, 3}};
  if (level % 2 == 1) return k_quarters[triangle];
  const bool falls_east = ((cell.x + cell.y) & 1) == 0 && level > 0;
  if (falls_east) return triangle == 0 ? glm::ivec2(4, 2) : glm::ivec2(2, 4);
  return triangle == 0 ? glm::ivec2(2, 2) : glm::ivec2(4, 4);
}

/// Most seeds that the law gives a triangle of static area `area` at `near` metres or more, any view from there.
double most_seeds(const Layer& layer, const View& view, double area, double near) {
  const double zoom = view.zoom(), d0 = double(layer.full_distance_m) * zoom;
  if (layer.law == DensityLaw::distance)
    return area * double(layer.density) / std::pow(std::max(near / d0, 1.0), double(layer.falloff));
  const double ceiling = layer.ceiling;
  // (1 + sqrt(1 + 1/4)) / 2, for ground that faces the eye.
  const double facing = layer.plain ? 1.0 : 0.5 * (1.0 + std::sqrt(1.25));
  const double away = layer.plain ? near : std::max(near, 2.0 * d0);
  if (away <= 0) return ceiling;
  double seen = k_drawn_area_room * facing * area / (away * away);
  if (layer.law == DensityLaw::world_area) return std::min(double(layer.density) * seen, ceiling);
  const double focal = view.clip_from_eye[1][1];
  seen *= focal * focal;
  if (layer.plain) {
    // Towards the picture's corners areas grow with the cube of the depth that is less than the distance.
    const double across = view.clip_from_eye[0][0];
    const double cosine = 1.0 / std::sqrt(1.0 + 1.0 / (focal * focal) + 1.0 / (across * across));
    seen /= cosine * cosine * cosine;
  }
  return std::min(double(layer.density) * std::pow(seen, double(layer.falloff)), ceiling);
}

}  // namespace

CandidateTriangle find_candidate(int level, glm::ivec2 cell, int triangle) {
  const int side_bits = k_root_bits - level / 2;
  const glm::ivec2 corner = cell * (1 << side_bits), square = corner >> k_root_bits;
  const glm::ivec2 origin = square * k_root_side;
  const glm::ivec2 point = 6 * (corner - origin) + (1 << side_bits) * point_in_candidate(level, cell, triangle);
  CandidateTriangle t;
  t.id = TriangleId::root(point.x + point.y > 6 * k_root_side ? 1 : 0, square);
  t.corners = corners_of(t.id);
  for (int i = 0; i < level; ++i) {
    const TriangleCorners c = t.corners;
    const LatticePoint middle = c.left + (c.right - c.left) / 2;
    const glm::ivec2 towards = glm::sign(c.left - c.right), offset = point - 6 * (middle - origin);
    const int turn = towards.x * offset.x + towards.y * offset.y > 0 ? 0 : 1;
    t.corners = turn == 0 ? TriangleCorners{middle, c.apex, c.left} : TriangleCorners{middle, c.right, c.apex};
    t.id = t.id.child(turn);
  }
  return t;
}

ClipmapTable::ClipmapTable(const Layer& layer, const Surface& surface, const ColorMap& map)
    : layer_(layer), surface_(&surface), maker_(layer, map), altitudes_(needs_altitudes(layer)) {
  const Lattice& lattice = surface.lattice();
  level_ = level_for_area(lattice, double(layer.triangle_area_m2));
  bits_ = level_ / 2;
  shift_ = k_root_bits - bits_;
  a_cell_ = level_ % 2 == 0 ? 2 : 4;
  const double cells = double(int64_t(1) << lattice.root_bits);
  level_area_ = std::ldexp(0.5 * cells * cells * lattice.spacing.x * lattice.spacing.y, -level_);
  cell_m_ = lattice.spacing * (std::ldexp(1.0, shift_) / lattice.sample_step());
  // All are equal up to turning, and reach no further than across a cell.
  reach_m_ = glm::length(cell_m_);
  scratch_.push_back({});
  map_.width = map.width;
  map_.height = map.height;
  map_.min_corner = map.min_corner;
  map_.size = map.size;
  map_.bounds = map.bounds;
}

bool ClipmapTable::references_moved() {
  if (layer_.season == known_season_) return false;
  known_season_ = layer_.season;
  std::vector<glm::vec3> references;
  for (const shared::SpeciesParams& params : make_species_params(layer_)) {
    references.emplace_back(params.reference);
    references.emplace_back(params.next);
  }
  const bool moved = references != references_;
  references_ = std::move(references);
  return moved;
}

Expected<void> ClipmapTable::resize(glm::ivec2 cells) {
  const glm::ivec2 memory(int(std::bit_ceil(unsigned(cells.x))), int(std::bit_ceil(unsigned(cells.y))));
  if (size_t(cells.x) * size_t(cells.y) * size_t(a_cell_) > k_most_candidates)
    return fail("layer '" + layer_.name + "': " + std::to_string(cells.x) + " x " + std::to_string(cells.y) +
                " cells of triangles lie within its horizon, more than a clipmap seeds; raise its triangle area or "
                "lower its horizon");
  if (cells == cells_ && memory == memory_) return {};
  cells_ = cells;
  memory_ = memory;
  ground_.assign(size_t(memory.x) * size_t(memory.y) * size_t(a_cell_), {});
  filled_ = false;
  return {};
}

// Slopes reach a sample further than heights, bounds of triangles as far as their neighbours.
void ClipmapTable::changed(const LatticeBox& box) {
  if (box.empty()) return;
  const int reach = 2 * surface_->lattice().sample_step();
  const glm::ivec2 first = ((box.first - reach) >> shift_) - 2, end = ((box.last + reach) >> shift_) + 3;
  const bool none = glm::any(glm::lessThanEqual(stale_end_, stale_first_));
  stale_first_ = none ? first : glm::min(stale_first_, first);
  stale_end_ = none ? end : glm::max(stale_end_, end);
}

size_t ClipmapTable::place_of(glm::ivec2 cell) const {
  const glm::ivec2 wrapped = cell & (memory_ - 1);
  return (size_t(wrapped.y) * size_t(memory_.x) + size_t(wrapped.x)) * size_t(a_cell_);
}

Expected<void> ClipmapTable::follow(const View& view, const Exclusions* exclusions) {
  written_.clear();
  runs_written_ = false;
  const Lattice& lattice = surface_->lattice();
  const double horizon = double(layer_.horizon_m) * view.zoom();
  // Far beyond the data everything is out of reach, wherever the eye is exactly.
  const glm::dvec2 margin = horizon / cell_m_ + 2.0;
  if (!(margin.x < 1e6 && margin.y < 1e6)) return resize(glm::ivec2(1 << 20));
  const glm::ivec2 half(glm::ceil(margin));
  if (auto fits = resize(2 * half + 1); !fits) return fits;
  const glm::dvec2 lattice_eye = lattice.extended_from_world(glm::dvec2(view.eye));
  const glm::dvec2 reach = glm::dvec2(half + 2) * std::ldexp(1.0, shift_);
  const glm::dvec2 eye = glm::clamp(lattice_eye, -reach, glm::dvec2(lattice.last()) + reach);
  const glm::ivec2 want = glm::ivec2(glm::floor(glm::ldexp(eye, glm::ivec2(-shift_)))) - half;

  const uint64_t version = exclusions != nullptr ? exclusions->version() : 0;
  const bool references = references_moved();
  const bool anew = !filled_ || references || version != exclusions_version_ ||
                    runs_.size() > 2 * runs_at_fill_ + k_stale_runs ||
                    glm::any(glm::greaterThanEqual(glm::abs(want - first_), cells_));
  index_.follow(exclusions != nullptr && exclusions->size() > 0 ? exclusions : nullptr, layer_.name, reach_m_);
  const glm::ivec2 old = first_, end = want + cells_;
  const bool stale = glm::all(glm::greaterThan(stale_end_, stale_first_));
  const bool moved = anew || stale || want != first_;
  first_ = want;
  if (anew) {
    fertile_.follow(layer_, map_);
    runs_.assign(1, glm::vec4(0.0f));
    runs_written_ = true;
    fill(want, end);
    runs_at_fill_ = runs_.size();
  } else if (moved) {
    const size_t runs = runs_.size();
    const glm::ivec2 kept_first = glm::max(want, old), kept_end = glm::min(end, old + cells_);
    if (stale) fill(glm::max(kept_first, stale_first_), glm::min(kept_end, stale_end_));
    fill(want, {kept_first.x, end.y});
    fill({kept_end.x, want.y}, end);
    fill({kept_first.x, want.y}, {kept_end.x, kept_first.y});
    fill({kept_first.x, kept_end.y}, {kept_end.x, end.y});
    runs_written_ = runs_.size() != runs;
  }
  filled_ = true;
  stale_end_ = stale_first_;
  exclusions_version_ = version;
  if (moved || zoom_ != view.zoom()) bound_clusters(view);
  zoom_ = view.zoom();
  return {};
}

void ClipmapTable::fill(glm::ivec2 first, glm::ivec2 end) {
  for (int y = first.y; y < end.y; ++y)
    for (int x = first.x; x < end.x; ++x) {
      const size_t place = place_of({x, y});
      for (int i = 0; i < a_cell_; ++i) ground_[place + size_t(i)] = make({x, y}, i);
      if (!written_.empty() && written_.back().first + written_.back().count == place) {
        written_.back().count += size_t(a_cell_);
      } else {
        written_.push_back({place, size_t(a_cell_)});
      }
    }
}

// As fixed_level_chunk.cpp has it, and RecordMaker.
SeedGround ClipmapTable::make(glm::ivec2 cell, int triangle) {
  SeedGround ground;
  const Lattice& lattice = surface_->lattice();
  const glm::ivec2 cells = lattice.root_squares * (1 << bits_);
  if (cell.x < 0 || cell.y < 0 || cell.x >= cells.x || cell.y >= cells.y) return ground;
  const CandidateTriangle t = find_candidate(level_, cell, triangle);
  const TriangleCorners& c = t.corners;
  const LatticeBox box{glm::min(c.apex, glm::min(c.left, c.right)), glm::max(c.apex, glm::max(c.left, c.right))};
  const LatticePoint end = lattice.last();
  if (box.first.x >= end.x || box.first.y >= end.y || surface_->all_holes(box)) return ground;
  const glm::dvec2 apex = lattice.world_xy(c.apex), left = lattice.world_xy(c.left), right = lattice.world_xy(c.right);
  if (fertile_.barren(apex, left, right)) return ground;
  FixedTriangle fixed;
  fixed.apex = glm::dvec3(apex, 0);
  fixed.to_left = glm::vec3(glm::vec2(left - apex), 0);
  fixed.to_right = glm::vec3(glm::vec2(right - apex), 0);
  fixed.id = t.id;
  const glm::dvec2 gradient = surface_->data_gradient((apex + left + right) / 3.0);
  fixed.area = float(level_area_ * std::sqrt(1.0 + glm::dot(gradient, gradient)));
  fixed.altitude = glm::vec3(NAN);
  if (altitudes_) fixed.altitude = glm::vec3(surface_->height(apex), surface_->height(left), surface_->height(right));
  scratch_.set(0, fixed);
  const TriangleRecord record = maker_.make(scratch_, 0);
  ground.texel = record.texel;
  ground.texel_fraction = record.texel_fraction;
  ground.slope = record.slope;
  ground.altitude = glm::vec4(record.altitude, 0);
  const LatticePoint middle = c.left + (c.right - c.left) / 2;
  ground.bound = level_ < lattice.max_level ? surface_->bound(middle, level_) : 0.0f;
  if (!exclude(apex, glm::vec2(fixed.to_left), glm::vec2(fixed.to_right), ground)) ground.area = fixed.area;
  return ground;
}

// Whether shapes cover all of a triangle; else it gets what it needs to know of them.
bool ClipmapTable::exclude(glm::dvec2 apex, glm::vec2 to_left, glm::vec2 to_right, SeedGround& ground) {
  if (index_.empty()) return false;
  const size_t begin = runs_.size();
  const Reach reach = index_.shapes_near(apex, to_left, to_right, runs_);
  if (reach != Reach::some) runs_.resize(begin);
  if (reach == Reach::some) {
    runs_.emplace_back(0.0f);
    ground.exclusions = uint32_t(begin);
  }
  return reach == Reach::all;
}

// A bin submits at most (n_max / n_min)^(1/32) times what its triangles ask for, and n_min is 1 at least.
void ClipmapTable::bound_clusters(const View& view) {
  const glm::ivec2 middle = first_ + cells_ / 2;
  double most = 1, total = 0;
  std::vector<float> seeds;
  seeds.reserve(candidates());
  for (int y = first_.y; y < first_.y + cells_.y; ++y)
    for (int x = first_.x; x < first_.x + cells_.x; ++x) {
      const size_t place = place_of({x, y});
      const glm::dvec2 gap = glm::dvec2(glm::max(glm::abs(glm::ivec2(x, y) - middle) - 1, glm::ivec2(0))) * cell_m_;
      const double near = glm::length(gap);
      for (int i = 0; i < a_cell_; ++i) {
        const double area = double(ground_[place + size_t(i)].area);
        if (area == 0) continue;
        // Seeds may be nearer than the triangle: see common_seeding.glsl.
        const double nearest = std::max(near - k_deviation_bounds * double(ground_[place + size_t(i)].bound), 0.0);
        seeds.push_back(float(std::ceil(most_seeds(layer_, view, area, nearest))));
        most = std::max(most, double(seeds.back()));
      }
    }
  const double room = std::pow(most, 1.0 / k_density_bins) * (1 + 1e-4);
  for (const float count : seeds) total += std::ceil(double(count) * room / layer_.cluster_size);
  most_clusters_ = size_t(total);
}

}  // namespace sward
