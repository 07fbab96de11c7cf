// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "sward/commands/image_grid.h"

#include <algorithm>
#include <filesystem>

namespace sward::tool {

namespace fs = std::filesystem;

namespace {

constexpr size_t k_kept_bytes = size_t(1) << 30;

bool holds_floats(const HeightField& field) {
  return std::holds_alternative<std::vector<float>>(field.samples());
}

size_t bytes_of(const HeightField& field) {
  return std::visit([](const auto& samples) { return samples.size() * sizeof(samples[0]); }, field.samples());
}

std::string size_text(glm::ivec2 size) {
  return std::to_string(size.x) + " x " + std::to_string(size.y);
}

}  // namespace

Expected<ImageGrid> ImageGrid::create(std::vector<std::string> paths, int columns, int overlap,
                                      const HeightImport& import) {
  ImageGrid grid;
  grid.images_ = {columns, int(paths.size()) / columns};
  if (size_t(grid.images_.x) * size_t(grid.images_.y) != paths.size()) {
    return fail(std::to_string(paths.size()) + " height maps do not fill rows of " + std::to_string(columns));
  }
  grid.paths_ = std::move(paths);
  grid.overlap_ = overlap;
  grid.import_ = import;
  grid.import_.relief.enabled = false;
  auto first = grid.image(0);
  if (!first) return tl::unexpected(first.error());
  const HeightFieldDesc& desc = (*first)->desc();
  grid.size_ = {desc.columns, desc.rows};
  if (overlap < 0 || overlap >= std::min(desc.columns, desc.rows)) {
    return fail("height maps of " + size_text(grid.size_) + " samples cannot share " + std::to_string(overlap));
  }
  const glm::ivec2 world_size = grid.images_ * (grid.size_ - overlap) + overlap;
  grid.world_.columns = world_size.x;
  grid.world_.rows = world_size.y;
  grid.world_.spacing = desc.spacing;
  grid.world_.origin = desc.origin;
  grid.world_.scale = desc.scale;
  grid.world_.offset = desc.offset;
  grid.world_.floats = holds_floats(**first);
  return grid;
}

Expected<void> ImageGrid::check(const HeightField& field, const std::string& path) const {
  const glm::ivec2 size(field.desc().columns, field.desc().rows);
  if (size != size_)
    return fail(path + " has " + size_text(size) + " samples, the first height map " + size_text(size_));
  if (holds_floats(field) != world_.floats || field.desc().offset != world_.offset)
    return fail(path + " has another kind of samples than the first height map; convert them to one");
  return {};
}

Expected<const HeightField*> ImageGrid::image(size_t index) {
  const auto known = std::find_if(kept_.begin(), kept_.end(), [&](const Image& each) { return each.index == index; });
  if (known != kept_.end()) {
    kept_.splice(kept_.begin(), kept_, known);
    return &kept_.front().field;
  }
  HeightImport import = import_;
  import.path = paths_[index];
  auto field = load_height_field(import);
  if (!field) return tl::unexpected(field.error());
  if (size_.x > 0)
    if (auto checked = check(*field, import.path); !checked) return tl::unexpected(checked.error());
  const size_t most = std::max<size_t>(k_kept_bytes / bytes_of(*field), 1);
  while (kept_.size() >= most) kept_.pop_back();
  kept_.push_front({index, std::move(*field)});
  return &kept_.front().field;
}

// The part of the box that lies on the image whose first sample is `corner`.
void ImageGrid::copy(const HeightField& field, glm::ivec2 corner, const SampleBox& box, std::span<float> heights,
                     std::span<uint8_t> holes) const {
  const glm::ivec2 first = glm::max(box.first, corner), end = glm::min(box.first + box.size, corner + size_);
  for (int row = first.y; row < end.y; ++row) {
    const size_t from = size_t(row - corner.y) * size_t(size_.x) + size_t(first.x - corner.x);
    const size_t to = size_t(row - box.first.y) * size_t(box.size.x) + size_t(first.x - box.first.x);
    const size_t count = size_t(end.x - first.x);
    std::visit(
        [&](const auto& samples) {
          for (size_t i = 0; i < count; ++i) heights[to + i] = float(samples[from + i]);
        },
        field.samples());
    if (field.hole_count() == 0) continue;
    for (size_t i = 0; i < count; ++i) holes[to + i] = field.is_hole(first.x - corner.x + int(i), row - corner.y);
  }
}

// Where images overlap, the one to the north-west decides.
Expected<void> ImageGrid::read(const SampleBox& box, std::span<float> heights, std::span<uint8_t> holes) {
  const glm::ivec2 stride = size_ - overlap_;
  const glm::ivec2 last = glm::min((box.first + box.size - 1) / stride, images_ - 1);
  const glm::ivec2 first = glm::max((box.first - overlap_) / stride, glm::ivec2(0));
  for (int row = last.y; row >= first.y; --row)
    for (int column = last.x; column >= first.x; --column) {
      auto field = image(size_t(row) * size_t(images_.x) + size_t(column));
      if (!field) return tl::unexpected(field.error());
      copy(**field, glm::ivec2(column, row) * stride, box, heights, holes);
    }
  return {};
}

Expected<std::string> ImageGrid::source() const {
  std::string text = std::to_string(images_.x) + "," + std::to_string(overlap_);
  for (const std::string& path : paths_) {
    std::error_code error;
    const auto bytes = fs::file_size(path, error);
    if (error) return fail("height map \"" + path + "\" cannot be read: " + error.message());
    const auto changed = fs::last_write_time(path, error).time_since_epoch().count();
    text += "\n" + fs::path(path).filename().string() + "," + std::to_string(bytes) + "," + std::to_string(changed);
  }
  return text;
}

}  // namespace sward::tool
