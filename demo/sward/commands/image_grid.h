// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/image_io/image_io.h>
#include <sward/terrain/world_data.h>
#include <list>
#include <string>
#include <vector>

namespace sward::tool {

/// Height maps side by side, all of one size and kind, as one large field. Keeps only those that were read last: those
/// that fit into 1 GiB, one at least.
class ImageGrid {
 public:
  /// `paths`: row by row from the north-west, `columns` in a row. Neighbours share their `overlap` outermost columns
  /// and rows. Reads the first image; spacing, scale and offset are those of `import`, whose path is not used.
  static Expected<ImageGrid> create(std::vector<std::string> paths, int columns, int overlap,
                                    const HeightImport& import);

  /// Size, scale, offset and kind of samples filled in.
  const WorldDesc& world() const { return world_; }
  /// Reads from whatever images the box touches.
  Expected<void> read(const SampleBox& box, std::span<float> heights, std::span<uint8_t> holes);
  /// Names, sizes and dates of the files and how they lie.
  Expected<std::string> source() const;

 private:
  struct Image {
    size_t index = 0;
    HeightField field;
  };

  Expected<const HeightField*> image(size_t index);
  Expected<void> check(const HeightField& field, const std::string& path) const;
  void copy(const HeightField& field, glm::ivec2 corner, const SampleBox& box, std::span<float> heights,
            std::span<uint8_t> holes) const;

  std::vector<std::string> paths_;
  glm::ivec2 images_{1};  // columns by rows
  int overlap_ = 0;
  glm::ivec2 size_{0};  // samples of an image
  HeightImport import_;
  WorldDesc world_;
  std::list<Image> kept_;  // the one used last first
};

}  // namespace sward::tool
