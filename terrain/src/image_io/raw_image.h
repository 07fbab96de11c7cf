// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/error.h>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sward::image_io {

enum class SampleType { uint8, int8, uint16, int16, uint32, int32, half, float32, float64 };

const char* describe(SampleType type);

/// An image file's first picture, samples as stored: not normalised, not multiplied by alpha.
struct RawImage {
  int width = 0, height = 0, channels = 0;
  int alpha_channel = -1;  ///< -1: none.
  SampleType type = SampleType::uint8;
  /// Bits a sample in the file where OpenImageIO stretched them to fill `type` (1, 2, 4, 10, 12 ...), else 0.
  int stretched_from_bits = 0;
  std::vector<std::byte> bytes;  ///< Rows from the top, channels interleaved. Half becomes float32.

  size_t pixels() const { return size_t(width) * size_t(height); }
  /// All samples; T must be the stored type.
  template <class T>
  std::span<const T> samples() const {
    return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
  }
};

/// Reads through OpenImageIO. The file's first bytes decide what it is, its extension only where they are not known.
/// `what` begins messages: "height map". Fails on files that are missing, empty, folders, no images, cut short, deep,
/// volumes, above 2^31 samples, or larger than their file can hold.
Expected<RawImage> read_image(const std::string& path, const std::string& what);

/// "height map "a.png"".
std::string named(const std::string& what, const std::string& path);

}  // namespace sward::image_io
