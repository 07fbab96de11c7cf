// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "vegetation/exclusion_index.h"

#include <algorithm>
#include <cmath>

#include "vegetation/shared_glsl.h"

namespace sward {

namespace {

constexpr float k_polygon = 2.0f;
constexpr size_t k_most_cells = 65536;
constexpr double k_least_cell_m = 8.0;

struct Box {
  glm::dvec2 low, high;
  bool meets(glm::dvec2 other_low, glm::dvec2 other_high) const {
    return other_low.x <= high.x && other_low.y <= high.y && other_high.x >= low.x && other_high.y >= low.y;
  }
};

Reach disc_reach(const ExclusionShape& disc, const Box& box) {
  const glm::dvec2 nearest = glm::clamp(disc.centre, box.low, box.high) - disc.centre;
  const glm::dvec2 farthest = glm::max(glm::abs(box.low - disc.centre), glm::abs(box.high - disc.centre));
  const double squared = disc.radius_m * disc.radius_m;
  if (glm::dot(nearest, nearest) > squared) return Reach::none;
  return glm::dot(farthest, farthest) < squared ? Reach::all : Reach::some;
}

/// Cuts `from`, or the whole polygon where it is null, down to a box.
Reach cut_polygon(const ExclusionShape& polygon, const PolygonPart* from, const Box& box, PolygonPart& part) {
  const std::vector<glm::dvec2>& corners = polygon.corners;
  const size_t count = from == nullptr ? corners.size() : from->edges.size();
  part.inside = from != nullptr && from->inside;
  part.edges.clear();
  bool meets = false;
  for (size_t i = 0; i < count; ++i) {
    const uint32_t edge = from == nullptr ? uint32_t(i) : from->edges[i];
    const glm::dvec2 a = corners[edge], b = corners[(edge + 1) % corners.size()];
    const glm::dvec2 low = glm::min(a, b), high = glm::max(a, b);
    if (high.y < box.low.y || low.y > box.high.y || high.x < box.low.x) continue;
    if (low.x > box.high.x && low.y <= box.low.y && high.y > box.high.y) {
      part.inside = !part.inside;
      continue;
    }
    meets = meets || low.x <= box.high.x;
    part.edges.push_back(edge);
  }
  if (meets) return Reach::some;
  // No edge comes near: the box is inside or outside as a whole.
  bool inside = part.inside;
  const glm::dvec2 middle = 0.5 * (box.low + box.high);
  for (const uint32_t edge : part.edges) {
    const glm::dvec2 a = corners[edge], b = corners[(edge + 1) % corners.size()];
    if ((a.y <= middle.y) != (b.y <= middle.y)) inside = !inside;  // it lies to the east
  }
  return inside ? Reach::all : Reach::none;
}

}  // namespace

void ExclusionIndex::follow(const Exclusions* exclusions, const std::string& layer, double reach) {
  exclusions_ = exclusions != nullptr && exclusions->size() > 0 ? exclusions : nullptr;
  if (exclusions_ == nullptr) return;
  const bool holds = version_ == exclusions->version() && layer_ == layer && reach <= reach_;
  if (!holds || cells_.size() > k_most_cells) {
    cells_.clear();
    last_ = nullptr;
    reach_ = reach;
    cell_m_ = std::max(4.0 * reach, k_least_cell_m);
  }
  version_ = exclusions->version();
  layer_ = layer;
}

ExclusionIndex::Cell ExclusionIndex::build(glm::dvec2 low, glm::dvec2 high) const {
  Cell cell;
  const Box box{low, high};
  PolygonPart part;
  const std::vector<Exclusions::Entry>& entries = exclusions_->entries();
  for (uint32_t i = 0; i < entries.size() && !cell.covered; ++i) {
    const Exclusions::Entry& entry = entries[i];
    if (!entry.used || !box.meets(entry.low, entry.high)) continue;
    if (!entry.shape.layer.empty() && entry.shape.layer != layer_) continue;
    const bool disc = entry.shape.corners.empty();
    const Reach reach = disc ? disc_reach(entry.shape, box) : cut_polygon(entry.shape, nullptr, box, part);
    if (reach == Reach::none) continue;
    cell.covered = reach == Reach::all;
    part.entry = i;
    disc ? cell.discs.push_back(i) : cell.polygons.push_back(part);
  }
  return cell;
}

const ExclusionIndex::Cell& ExclusionIndex::cell_of(glm::dvec2 apex) {
  const glm::dvec2 at = glm::floor(apex / cell_m_);
  const uint64_t key = uint64_t(uint32_t(int32_t(at.x))) << 32 | uint32_t(int32_t(at.y));
  if (last_ != nullptr && key == last_key_) return *last_;
  auto found = cells_.find(key);
  if (found == cells_.end()) {
    found = cells_.emplace(key, build(at * cell_m_ - reach_, (at + 1.0) * cell_m_ + reach_)).first;
  }
  last_key_ = key;
  last_ = &found->second;
  return *last_;
}

Reach ExclusionIndex::shapes_near(glm::dvec2 apex, glm::vec2 to_left, glm::vec2 to_right, std::vector<glm::vec4>& run) {
  const Cell& cell = cell_of(apex);
  if (cell.covered) return Reach::all;
  const glm::dvec2 left = apex + glm::dvec2(to_left), right = apex + glm::dvec2(to_right);
  // Seeds are placed in floats: a hair wider than the triangle.
  const double hair = 1.0e-6 * reach_;
  const Box box{glm::min(apex, glm::min(left, right)) - hair, glm::max(apex, glm::max(left, right)) + hair};
  const size_t begin = run.size();
  for (const uint32_t i : cell.discs) {
    const ExclusionShape& disc = exclusions_->entries()[i].shape;
    const Reach reach = disc_reach(disc, box);
    if (reach == Reach::all) return Reach::all;
    const glm::dvec2 centre = disc.centre - apex;
    if (reach == Reach::some)
      run.emplace_back(float(centre.x), float(centre.y), float(disc.radius_m * disc.radius_m), shared::k_shape_disc);
  }
  for (const PolygonPart& part : cell.polygons) {
    const std::vector<glm::dvec2>& corners = exclusions_->entries()[part.entry].shape.corners;
    const Reach reach = cut_polygon(exclusions_->entries()[part.entry].shape, &part, box, scratch_);
    if (reach == Reach::all) return Reach::all;
    if (reach == Reach::none) continue;
    run.emplace_back(scratch_.inside ? 1.0f : 0.0f, float(scratch_.edges.size()), 0.0f, k_polygon);
    for (const uint32_t edge : scratch_.edges) {
      const glm::dvec2 a = corners[edge] - apex, b = corners[(edge + 1) % corners.size()] - apex;
      run.emplace_back(glm::vec4(glm::vec2(a), glm::vec2(b)));
    }
  }
  return run.size() == begin ? Reach::none : Reach::some;
}

}  // namespace sward
