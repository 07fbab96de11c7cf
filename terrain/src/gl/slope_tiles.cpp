// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "slope_tiles.h"

#include <algorithm>
#include <cmath>

#include <sward/terrain/error.h>

namespace sward::gl {

namespace {

glm::ivec2 tiles_of(glm::ivec2 texels) {
  return (texels + (k_slope_tile - 1)) / k_slope_tile;
}

}  // namespace

SlopeTiles::SlopeTiles(glm::ivec2 samples, int window, int whole) {
  SWARD_ASSERT(window % k_slope_tile == 0 && window >= 4 * k_slope_tile, "the window is 4 tiles wide at least");
  const bool fits = samples.x <= whole && samples.y <= whole;
  texels_ = fits ? samples : glm::ivec2(window);
  slots_ = tiles_of(texels_);
  for (int stride = 1;; stride *= k_slope_factor) {
    Layer layer;
    layer.stride = stride;
    const glm::ivec2 texels = (samples + (stride - 1)) / stride;
    layer.grid = tiles_of(texels);
    layer.holds.assign(size_t(slots_.x) * size_t(slots_.y), glm::ivec2(-1));
    layer.stale.assign(layer.holds.size(), 0);
    layers_.push_back(std::move(layer));
    if (texels.x <= texels_.x && texels.y <= texels_.y) break;
  }
  SWARD_ASSERT(layers_.size() <= size_t(k_slope_layers), "more layers than the shader has");
  count_pending();
}

size_t SlopeTiles::slot(glm::ivec2 tile) const {
  return size_t(tile.y % slots_.y) * size_t(slots_.x) + size_t(tile.x % slots_.x);
}

void SlopeTiles::follow(glm::dvec2 eye) {
  SWARD_ASSERT(std::isfinite(eye.x) && std::isfinite(eye.y), "the eye's place must be finite");
  eye_ = eye;
  bool moved = false;
  for (Layer& layer : layers_) {
    const glm::dvec2 tile = eye / double(layer.stride * k_slope_tile);
    const glm::dvec2 wanted = glm::round(tile) - glm::dvec2(slots_ / 2);
    const glm::dvec2 end(glm::max(layer.grid - slots_, glm::ivec2(0)));
    const glm::ivec2 first(glm::clamp(wanted, glm::dvec2(0), end));
    moved |= first != layer.first;
    layer.first = first;
  }
  if (moved) count_pending();
}

void SlopeTiles::changed(glm::ivec2 first, glm::ivec2 last) {
  for (Layer& layer : layers_) {
    // Differences reach a stride beyond their sample.
    const int side = layer.stride * k_slope_tile;
    const glm::ivec2 low = glm::max((first - layer.stride) / side, layer.first);
    const glm::ivec2 high = glm::min((last + layer.stride) / side, glm::min(layer.first + slots_, layer.grid) - 1);
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x) layer.stale[slot({x, y})] = 1;
  }
  count_pending();
}

void SlopeTiles::gather(int number, std::vector<Tile>& all) const {
  const Layer& layer = layers_[size_t(number)];
  const glm::ivec2 end = glm::min(layer.first + slots_, layer.grid);
  const double side = double(layer.stride * k_slope_tile), near = reach() * layer.stride;
  const bool last = number + 1 == layers();
  for (int y = layer.first.y; y < end.y; ++y)
    for (int x = layer.first.x; x < end.x; ++x) {
      const glm::ivec2 tile(x, y);
      const bool other = layer.holds[slot(tile)] != tile;
      if (!other && layer.stale[slot(tile)] == 0) continue;
      const glm::dvec2 away =
          glm::max(glm::max(glm::dvec2(tile) * side - eye_, eye_ - glm::dvec2(tile + 1) * side), glm::dvec2(0));
      const double distance = std::max(away.x, away.y);
      all.push_back({number, tile, other && (last || distance <= near), distance});
    }
}

void SlopeTiles::count_pending() {
  std::vector<Tile> all;
  for (int layer = 0; layer < layers(); ++layer) gather(layer, all);
  pending_ = all.size();
}

std::vector<SlopeTiles::Tile> SlopeTiles::take(size_t budget) {
  std::vector<Tile> all;
  if (pending_ == 0) return all;
  for (int layer = 0; layer < layers(); ++layer) gather(layer, all);
  std::stable_sort(all.begin(), all.end(), [](const Tile& a, const Tile& b) {
    return a.missing != b.missing ? a.missing : a.distance < b.distance;
  });
  const auto missing = size_t(std::count_if(all.begin(), all.end(), [](const Tile& tile) { return tile.missing; }));
  all.resize(std::min(all.size(), std::max(budget, missing)));
  for (const Tile& tile : all) {
    Layer& layer = layers_[size_t(tile.layer)];
    layer.holds[slot(tile.tile)] = tile.tile;
    layer.stale[slot(tile.tile)] = 0;
  }
  pending_ -= all.size();
  return all;
}

SlopeTiles::Box SlopeTiles::box(const Tile& tile) const {
  const glm::ivec2 place = tile.tile % slots_ * k_slope_tile;
  return {tile.tile * k_slope_tile, glm::min(texels_ - place, glm::ivec2(k_slope_tile)), place};
}

}  // namespace sward::gl
