// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "vegetation/fertile_ground.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace sward {

namespace {

/// Beyond so many tiles a triangle is not looked at.
constexpr int k_most_tiles = 64;
/// Scores are rounded: bounds of them give way by this share.
constexpr float k_slack = 1.0e-3f;

struct Range {
  float least, greatest;
};

/// Distance from a reference to the nearest and to the farthest of a range.
Range away_from(float reference, Range range) {
  const float below = range.least - reference, above = reference - range.greatest;
  return {std::max({below, above, 0.0f}), std::max(std::abs(below), std::abs(above))};
}

/// The same on the circle of hues.
Range hue_away_from(float reference, Range hue) {
  const auto apart = [](float a, float b) { return std::abs((a - b) - std::floor((a - b) + 0.5f)); };
  const float least = apart(reference, hue.least), greatest = apart(reference, hue.greatest);
  const auto within = [&](float at) { return at - hue.least - std::floor(at - hue.least) <= hue.greatest - hue.least; };
  return {within(reference) ? 0.0f : std::min(least, greatest),
          within(reference + 0.5f) ? 0.5f : std::max(least, greatest)};
}

float score_of(const shared::SpeciesParams& species, float distance) {
  const float score = std::pow(std::max(distance, 1.0e-4f), -species.reference.w);
  return score >= species.weights.w ? score : 0.0f;
}

/// Rules that do not bind have bounds beyond this (layer_params.cpp).
constexpr float k_unbound = 1.0e30f;

bool has_rules(const shared::SpeciesParams& s) {
  return s.slope.w != 0.0f || s.slope.x > 0.0f || s.slope.y < k_unbound || s.altitude.x > -k_unbound ||
         s.altitude.y < k_unbound || s.altitude.w > -k_unbound;
}

/// Least and greatest score (equation 16) over a range of colours.
Range scores(const shared::SpeciesParams& species, glm::vec3 reference, const HsvRange& range) {
  const bool maybe_grey = range.least.y < 0.02f;
  Range hue = range.any_hue ? Range{0.0f, 0.5f} : hue_away_from(reference.x, {range.least.x, range.greatest.x});
  if (maybe_grey) hue.least = 0.0f;
  const Range saturation = away_from(reference.y, {range.least.y, range.greatest.y});
  const Range value = away_from(reference.z, {range.least.z, range.greatest.z});
  const glm::vec3 weights(species.weights);
  const float near = glm::length(weights * glm::vec3(hue.least, saturation.least, value.least));
  const float far = glm::length(weights * glm::vec3(hue.greatest, saturation.greatest, value.greatest));
  // What rules take away from a score is not known here.
  const float least = has_rules(species) ? 0.0f : score_of(species, far * (1.0f + k_slack) + k_slack * 1.0e-2f);
  return {least, score_of(species, std::max(near * (1.0f - k_slack) - k_slack * 1.0e-2f, 0.0f))};
}

}  // namespace

HsvRange hsv_range(glm::vec3 least, glm::vec3 greatest) {
  const auto largest = [](glm::vec3 c) { return std::max({c.x, c.y, c.z}); };
  const auto smallest = [](glm::vec3 c) { return std::min({c.x, c.y, c.z}); };
  HsvRange range;
  range.least.z = largest(least);
  range.greatest.z = largest(greatest);
  const float dark_least = smallest(least), dark_greatest = smallest(greatest);
  range.least.y = range.least.z > 0.0f ? std::max(1.0f - dark_greatest / range.least.z, 0.0f) : 0.0f;
  range.greatest.y = range.greatest.z > 0.0f ? 1.0f - dark_least / range.greatest.z : 0.0f;
  if (range.least.z <= 0.0f) range.greatest.y = std::max(range.greatest.y, 1.0f);
  for (int c = 0; c < 3; ++c) {
    const int a = (c + 1) % 3, b = (c + 2) % 3;
    // This channel is the brightest of every colour, and none is grey.
    if (!(least[c] > greatest[a] && least[c] > greatest[b])) continue;
    const Range difference{least[a] - greatest[b], greatest[a] - least[b]};
    const float chroma_least = std::max(least[c] - std::min(greatest[a], greatest[b]), 1.0e-6f);
    const auto turns = [&](float d) { return std::clamp(d / chroma_least, -1.0f, 1.0f); };
    // Dividing by the least chroma only widens what leads away from 0; what does not may end at 0.
    range.least.x = (2.0f * float(c) + turns(std::min(difference.least, 0.0f))) / 6.0f;
    range.greatest.x = (2.0f * float(c) + turns(std::max(difference.greatest, 0.0f))) / 6.0f;
    range.any_hue = false;
  }
  return range;
}

bool can_grow(std::span<const shared::SpeciesParams> species, const HsvRange& range, bool next) {
  // The best that growing species may score, the two best that bare ground surely scores, the best that forbids.
  float growing = 0.0f, first = 0.0f, second = 0.0f, forbidding = 0.0f;
  for (const shared::SpeciesParams& s : species) {
    const Range score = scores(s, glm::vec3(next ? s.next : s.reference), range);
    if (s.kind.x > 0.5f) {
      growing = std::max(growing, score.greatest);
      continue;
    }
    second = std::max(second, std::min(first, score.least));
    first = std::max(first, score.least);
    if (s.kind.y > 0.5f) forbidding = std::max(forbidding, score.least);
  }
  // Where a species that forbids is better than what grows, either it is the best, or what grows is third.
  return growing > 0.0f && second <= growing && forbidding <= growing;
}

void FertileGround::follow(const Layer& layer, const ColorMap& map) {
  const ColorMap& read = layer.distribution ? *layer.distribution : map;
  if (!read.bounds) {
    bounds_.reset();
    return;
  }
  texels_ = classification_map(layer, geometry_of(map)).texels;
  corner_ = {map.min_corner.x, map.min_corner.y + map.size.y};
  texels_per_m_ = glm::dvec2(texels_) / map.size * glm::dvec2(1, -1);
  std::vector<shared::SpeciesParams> species = make_species_params(layer);
  const bool same_species =
      species.size() == species_.size() &&
      std::memcmp(species.data(), species_.data(), species.size() * sizeof(shared::SpeciesParams)) == 0;
  if (same_species && read.bounds == bounds_) return;
  bounds_ = read.bounds;
  species_ = std::move(species);
  references_move_ = std::any_of(species_.begin(), species_.end(), [](const shared::SpeciesParams& s) {
    return glm::vec3(s.reference) != glm::vec3(s.next);
  });
  verdicts_.assign(bounds_->least.size(), Verdict::unknown);
}

bool FertileGround::barren(glm::dvec2 apex, glm::dvec2 left, glm::dvec2 right) {
  if (!bounds_) return false;
  const auto place = [this](glm::dvec2 at) { return (at - corner_) * texels_per_m_; };
  const glm::dvec2 a = place(apex), b = place(left), c = place(right);
  // The lookup reads the texels around a place, the outermost again outside of the map.
  const glm::dvec2 low = glm::min(a, glm::min(b, c)) - 1.0, high = glm::max(a, glm::max(b, c)) + 1.0;
  const glm::dvec2 last(texels_ - 1);
  const glm::ivec2 first_tile(glm::clamp(low, glm::dvec2(0), last) / double(ColorBounds::k_tile));
  const glm::ivec2 last_tile(glm::clamp(high, glm::dvec2(0), last) / double(ColorBounds::k_tile));
  const glm::ivec2 count = last_tile - first_tile + 1;
  if (count.x * count.y > k_most_tiles) return false;
  for (int row = first_tile.y; row <= last_tile.y; ++row)
    for (int column = first_tile.x; column <= last_tile.x; ++column)
      if (!tile_is_barren(size_t(row) * size_t(bounds_->columns) + size_t(column))) return false;
  return true;
}

bool FertileGround::tile_is_barren(size_t tile) {
  Verdict& verdict = verdicts_[tile];
  if (verdict == Verdict::unknown) verdict = judge(tile) ? Verdict::barren : Verdict::fertile;
  return verdict == Verdict::barren;
}

bool FertileGround::judge(size_t tile) const {
  const glm::vec4 least = glm::vec4(bounds_->least[tile]) / 255.0f;
  const glm::vec4 greatest = glm::vec4(bounds_->greatest[tile]) / 255.0f;
  if (greatest.w < 0.5f - 1.0e-4f) return true;
  // Blending rounds: a little more than the texels' own range.
  const HsvRange range =
      hsv_range(glm::max(glm::vec3(least) - 1.0e-5f, 0.0f), glm::min(glm::vec3(greatest) + 1.0e-5f, 1.0f));
  if (can_grow(species_, range, false)) return false;
  return !references_move_ || !can_grow(species_, range, true);
}

}  // namespace sward
