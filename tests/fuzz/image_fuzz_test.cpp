// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Damaged images: an error or a whole result, never a crash and never half a map.

#if defined(SWARD_IMAGE_IO)
#include <gtest/gtest.h>
#include <sward/image_io/image_io.h>

#include <random>

#include "unit/image_files.h"

namespace {

using namespace sward;
using namespace sward::testing_files;
using OIIO::TypeDesc;

constexpr int k_side = 24;

std::vector<uint16_t> noise_heights() {
  std::mt19937 random(7);
  std::vector<uint16_t> heights(k_side * k_side);
  for (auto& height : heights) height = uint16_t(random());
  return heights;
}

/// Loads every `step`-th prefix of the file; a success must give the whole map.
void expect_error_or_whole(const TemporaryFolder& folder, const std::string& name, size_t step) {
  const std::string whole = read_bytes(folder.file(name));
  ASSERT_GT(whole.size(), 300u);
  const auto reference = load_height_field({.path = folder.file(name)});
  ASSERT_TRUE(reference) << reference.error().message;
  size_t errors = 0, tried = 0;
  for (size_t length = 0; length < whole.size(); length += step, ++tried) {
    write_bytes(folder.file("cut_" + name), whole.substr(0, length));
    const auto cut = load_height_field({.path = folder.file("cut_" + name)});
    if (!cut) {
      ++errors;
      ASSERT_NE(cut.error().message.find("cut_" + name), std::string::npos) << cut.error().message;
      ASSERT_EQ(cut.error().message.find('\n'), std::string::npos) << cut.error().message;
      continue;
    }
    for (int i = 0; i < k_side * k_side; ++i) {
      ASSERT_EQ(cut->sample(i % k_side, i / k_side), reference->sample(i % k_side, i / k_side))
          << name << " cut to " << length << " of " << whole.size() << " bytes, sample " << i;
    }
  }
  // Only what follows the pixels may be missing.
  EXPECT_GT(errors * 10, tried * 9) << name << ": " << errors << " of " << tried;
}

class ImageFuzz : public testing::Test {
 protected:
  TemporaryFolder folder_;
};

TEST_F(ImageFuzz, TruncatedFilesAreErrors) {
  testing::internal::CaptureStderr();
  const auto heights = noise_heights();
  const PictureLayout layout{k_side, k_side};
  ASSERT_TRUE(write_picture(folder_.file("a.png"), layout, heights, TypeDesc::UINT16));
  expect_error_or_whole(folder_, "a.png", 7);
  ASSERT_TRUE(write_picture(folder_.file("a.tif"), layout, heights, TypeDesc::UINT16));
  expect_error_or_whole(folder_, "a.tif", 7);
  ASSERT_TRUE(write_picture(folder_.file("a.exr"), layout, std::vector<float>(heights.begin(), heights.end()),
                            TypeDesc::FLOAT));
  expect_error_or_whole(folder_, "a.exr", 7);
  // Grey repeated three times, as JPEG may not store one channel.
  std::vector<uint8_t> grey;
  for (const uint16_t height : heights) grey.push_back(uint8_t(height));
  ASSERT_TRUE(write_picture(folder_.file("a.jpg"), layout, grey, TypeDesc::UINT8));
  expect_error_or_whole(folder_, "a.jpg", 7);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(ImageFuzz, TruncatedUncompressedTiffWithItsDirectoryFirst) {
  // Header, directory, pixels: every cut leaves a readable directory.
  TiffFile file{.width = k_side, .height = k_side};
  for (const uint16_t height : noise_heights()) file.samples.push_back(double(height) / 4);
  const std::string whole = file.bytes();
  const size_t pixel_bytes = size_t(k_side * k_side * 2), directory_bytes = whole.size() - 8 - pixel_bytes;
  std::string moved = whole.substr(0, 8) + whole.substr(8 + pixel_bytes) + whole.substr(8, pixel_bytes);
  moved[4] = 8, moved[5] = 0, moved[6] = 0, moved[7] = 0;
  // The strip's offset is the value of the sixth entry (tag 273).
  const size_t strip_at = 8 + 2 + 5 * 12 + 8;
  moved[strip_at] = char(8 + directory_bytes);
  moved[strip_at + 1] = char((8 + directory_bytes) >> 8);
  write_bytes(folder_.file("first.tif"), moved);
  expect_error_or_whole(folder_, "first.tif", 5);
}

TEST_F(ImageFuzz, FlippedBytesNeverCrash) {
  testing::internal::CaptureStderr();
  const auto heights = noise_heights();
  std::mt19937 random(11);
  for (const std::string name : {"a.png", "a.tif"}) {
    ASSERT_TRUE(write_picture(folder_.file(name), {k_side, k_side}, heights, TypeDesc::UINT16));
    const std::string whole = read_bytes(folder_.file(name));
    for (int round = 0; round < 300; ++round) {
      std::string damaged = whole;
      const size_t flips = 1 + random() % 4;
      for (size_t i = 0; i < flips; ++i) {
        // Half of them in the header and directory, where sizes and types are.
        const size_t reach = i % 2 == 0 ? damaged.size() : std::min<size_t>(damaged.size(), 200);
        const size_t at = name == "a.tif" && i % 2 == 1 ? damaged.size() - 1 - random() % reach : random() % reach;
        damaged[at] = char(random());
      }
      write_bytes(folder_.file("bad_" + name), damaged);
      const auto field = load_height_field({.path = folder_.file("bad_" + name)});
      if (!field) {
        EXPECT_NE(field.error().message.find("bad_" + name), std::string::npos) << field.error().message;
      }
    }
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
#endif
