// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/terrain/edits.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace sward {

namespace {

constexpr double k_crest = 0.75;  // Of a crater's radius.

double smooth_step(double t) {
  return t * t * (3.0 - 2.0 * t);
}

// Height over the ground before at a share of the radius.
double crater_profile(double place, double depth, double rim) {
  if (place >= 1.0) return 0.0;
  if (place > k_crest) return rim * smooth_step((1.0 - place) / (1.0 - k_crest));
  const double s = place / k_crest * (place / k_crest);
  return s * rim - (1.0 - s) * depth;
}

Expected<void> check(const EditRegion& region) {
  const glm::dvec2 half = region.half_size;
  const bool disc = region.shape == EditRegion::Shape::disc;
  if (!std::isfinite(region.centre.x) || !std::isfinite(region.centre.y)) {
    return fail("edit region: its centre must be finite");
  }
  if (!std::isfinite(half.x) || !(half.x > 0.0) || (!disc && (!std::isfinite(half.y) || !(half.y > 0.0)))) {
    return fail("edit region: its size must be finite and above 0");
  }
  if (!(region.soft_edge >= 0.0)) return fail("edit region: its soft edge must be at least 0");
  return {};
}

glm::dvec2 extent(const EditRegion& region) {
  return region.shape == EditRegion::Shape::disc ? glm::dvec2(region.half_size.x) : region.half_size;
}

struct SampleRectangle {
  glm::ivec2 first{0}, last{-1};
  glm::ivec2 size() const { return last - first + 1; }
  bool empty() const { return last.x < first.x || last.y < first.y; }
};

// Samples in the region's box, cut to the field.
SampleRectangle samples_in(const Lattice& lattice, const EditRegion& region) {
  const glm::dvec2 nw = lattice.world_xy({0, 0}), half = extent(region);
  const glm::dvec2 last(lattice.columns - 1, lattice.rows - 1);
  const glm::dvec2 from = (region.centre - half - nw) / lattice.spacing,
                   to = (region.centre + half - nw) / lattice.spacing;
  // Rows count south.
  const glm::dvec2 low = glm::clamp(glm::ceil(glm::dvec2(from.x, -to.y)), glm::dvec2(0.0), last + 1.0);
  const glm::dvec2 high = glm::clamp(glm::floor(glm::dvec2(to.x, -from.y)), glm::dvec2(-1.0), last);
  return {glm::ivec2(low), glm::ivec2(high)};
}

bool overlaps(const HeightField& field, const EditRegion& region) {
  const glm::dvec2 low = field.min_corner(), high = field.max_corner(), half = extent(region);
  return region.centre.x + half.x >= low.x && region.centre.x - half.x <= high.x && region.centre.y + half.y >= low.y &&
         region.centre.y - half.y <= high.y;
}

}  // namespace

double EditRegion::weight(glm::dvec2 xy) const {
  const glm::dvec2 away = glm::abs(xy - centre);
  const double inside =
      shape == Shape::disc ? half_size.x - glm::length(away) : std::min(half_size.x - away.x, half_size.y - away.y);
  if (!(inside >= 0.0)) return 0.0;
  if (inside >= soft_edge) return 1.0;
  return smooth_step(inside / soft_edge);
}

// The one that may write a field's samples.
class FieldEditor {
 public:
  FieldEditor(HeightField& field, const SampleRectangle& rectangle)
      : field_(field),
        rectangle_(rectangle),
        words_(std::get_if<std::vector<uint16_t>>(&field.samples_)),
        floats_(std::get_if<std::vector<float>>(&field.samples_)) {}

  // Works out new samples, in raw units; the field is not changed.
  Expected<void> plan(const EditRegion& region, const HeightFunction& height) {
    const HeightFieldDesc& desc = field_.desc();
    const glm::ivec2 size = rectangle_.size();
    planned_.reserve(size_t(size.x) * size_t(size.y));
    range_ = field_.height_range();
    for (int row = rectangle_.first.y; row <= rectangle_.last.y; ++row) {
      for (int column = rectangle_.first.x; column <= rectangle_.last.x; ++column) {
        const glm::dvec2 xy = field_.world_xy(LatticePoint(column, row) * field_.sample_step());
        const double weight = region.weight(xy);
        double raw = field_.raw(column, row);
        if (weight > 0.0) {
          const double before = field_.sample(column, row), wanted = height(xy, before);
          const double z = before + weight * (wanted - before);
          if (z != before) raw = storable((z - (desc.offset + desc.origin.z)) / desc.scale);
          if (!std::isfinite(raw)) return fail("edit: a new height is not finite or does not fit the samples' format");
          widen(raw * desc.scale + (desc.offset + desc.origin.z));
        }
        planned_.push_back(raw);
      }
    }
    if (range_[1] - range_[0] > HeightField::k_max_span_m) {
      return fail("edit: heights would span more than 262144 m");
    }
    return {};
  }

  // Writes them; returns how many changed and where.
  EditResult apply() {
    EditResult result;
    result.clamped = clamped_;
    SampleRectangle changed{rectangle_.last, rectangle_.first};
    size_t next = 0;
    for (int row = rectangle_.first.y; row <= rectangle_.last.y; ++row) {
      for (int column = rectangle_.first.x; column <= rectangle_.last.x; ++column) {
        const double raw = planned_[next++];
        if (raw == field_.raw(column, row)) continue;
        const size_t index = size_t(row) * size_t(field_.desc().columns) + size_t(column);
        if (words_ != nullptr) (*words_)[index] = uint16_t(raw);
        if (floats_ != nullptr) (*floats_)[index] = float(raw);
        changed.first = glm::min(changed.first, glm::ivec2(column, row));
        changed.last = glm::max(changed.last, glm::ivec2(column, row));
        ++result.samples;
      }
    }
    if (result.samples == 0) return result;
    field_.height_range_ = range_;
    field_.compute_relief(changed.first - HeightField::k_relief_reach, changed.last + HeightField::k_relief_reach);
    result.changed = heights_changed(changed);
    return result;
  }

 private:
  double storable(double raw) {
    if (floats_ != nullptr) return double(float(raw));
    if (!std::isfinite(raw)) return raw;
    const double whole = std::round(raw), held = std::clamp(whole, 0.0, 65535.0);
    clamped_ += held != whole ? 1 : 0;
    return held;
  }

  void widen(double z) { range_ = {std::min(range_[0], z), std::max(range_[1], z)}; }

  // Triangles around a sample, and around those whose relief depends on it. Padding repeats the edge.
  LatticeBox heights_changed(const SampleRectangle& samples) const {
    const Lattice& lattice = field_.lattice();
    const int reach = lattice.max_level > lattice.data_level() ? 1 + HeightField::k_relief_reach : 1;
    const glm::ivec2 data(lattice.columns - 1, lattice.rows - 1), end = lattice.root_squares << lattice.root_bits;
    glm::ivec2 last = samples.last + reach;
    for (int i = 0; i < 2; ++i) last[i] = last[i] >= data[i] ? end[i] : last[i];
    return {glm::max(samples.first - reach, glm::ivec2(0)) * lattice.sample_step(), last * lattice.sample_step()};
  }

  HeightField& field_;
  SampleRectangle rectangle_;
  std::vector<uint16_t>* words_;
  std::vector<float>* floats_;
  std::vector<double> planned_;
  glm::dvec2 range_{0.0};
  int64_t clamped_ = 0;
};

Expected<EditResult> edit(HeightField& field, Bounds& bounds, const EditRegion& region, const HeightFunction& height) {
  SWARD_ASSERT(&bounds.field() == &field, "the bounds must be those of the field");
  if (auto checked = check(region); !checked) return tl::unexpected<Error>(checked.error());
  if (!overlaps(field, region)) return fail("edit region lies outside of the height field");
  const SampleRectangle rectangle = samples_in(field.lattice(), region);
  if (rectangle.empty()) return EditResult{};
  FieldEditor editor(field, rectangle);
  if (auto planned = editor.plan(region, height); !planned) return tl::unexpected<Error>(planned.error());
  const EditResult result = editor.apply();
  if (result.samples > 0) bounds.recompute(result.changed);
  return result;
}

Expected<EditResult> edit(HeightField& field, Bounds& bounds, const Edit& edit) {
  if (!std::isfinite(edit.metres)) return fail("edit: metres must be finite");
  const double metres = edit.metres;
  switch (edit.kind) {
    case Edit::Kind::raise:
      return sward::edit(field, bounds, edit.region, [=](glm::dvec2, double z) { return z + metres; });
    case Edit::Kind::lower:
      return sward::edit(field, bounds, edit.region, [=](glm::dvec2, double z) { return z - metres; });
    case Edit::Kind::flatten:
      return sward::edit(field, bounds, edit.region, [=](glm::dvec2, double) { return metres; });
    case Edit::Kind::crater:
      break;
  }
  if (edit.region.shape != EditRegion::Shape::disc) return fail("edit: a crater needs a disc");
  if (!std::isfinite(edit.rim_share) || edit.rim_share < 0.0) return fail("edit: rim_share must be at least 0");
  const double rim = edit.rim_share * metres, radius = edit.region.half_size.x;
  return sward::edit(field, bounds, edit.region, [&](glm::dvec2 xy, double z) {
    return z + crater_profile(glm::distance(xy, edit.region.centre) / radius, metres, rim);
  });
}

}  // namespace sward
