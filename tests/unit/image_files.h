// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// Image files for tests: pictures through OpenImageIO, and TIFF and PNG byte by byte where the tags or the damage
// matter.

#include <OpenImageIO/imageio.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

namespace sward::testing_files {

namespace fs = std::filesystem;

/// A folder of its own, removed with everything in it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    static std::atomic<int> counter{0};
    path_ = fs::temp_directory_path() / ("sward_test_" + std::to_string(getpid()) + "_" + std::to_string(counter++));
    fs::create_directories(path_);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  std::string file(const std::string& name) const { return (path_ / name).string(); }
  const fs::path& path() const { return path_; }
  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(path_)) found.push_back(entry.path().filename().string());
    return found;
  }

 private:
  fs::path path_;
};

inline std::string read_bytes(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
}

struct PictureLayout {
  int width, height, channels = 1;
  int alpha_channel = -1;
};

/// Samples as they are, channels interleaved. False when OpenImageIO could not write them.
template <class T>
bool write_picture(const std::string& path, PictureLayout layout, const std::vector<T>& samples, OIIO::TypeDesc type) {
  const auto output = OIIO::ImageOutput::create(path);
  if (!output) return false;
  OIIO::ImageSpec spec(layout.width, layout.height, layout.channels, type);
  spec.alpha_channel = layout.alpha_channel;
  spec.attribute("oiio:UnassociatedAlpha", 1);
  const bool written = output->open(path, spec) && output->write_image(type, samples.data());
  return output->close() && written;
}

/// A TIFF with one strip, written by hand.
struct TiffFile {
  int width = 2, height = 2;
  bool big_endian = false, big_tiff = false;
  int sample_format = 2;  // 1 unsigned, 2 signed, 3 float
  int bits = 16;
  std::vector<double> samples{};
  std::string no_data{};                         // GDAL_NODATA, where not empty
  std::optional<std::array<double, 3>> scale{};  // ModelPixelScale
  std::vector<uint16_t> geo_keys{};              // GeoKeyDirectory
  bool stray_tag = false;                        // GDAL_NODATA points beyond the end

  std::string bytes() const {
    struct Entry {
      uint16_t tag, type;
      uint64_t count;
      std::string value;
    };
    const auto shorts = [this](std::initializer_list<int> values) {
      std::string text;
      for (const int value : values) append(text, uint64_t(value), 2);
      return text;
    };
    const std::string pixels = encoded_samples();
    const size_t head = big_tiff ? 16 : 8;
    std::string strip_at, strip_bytes;
    append(strip_at, head, 4);
    append(strip_bytes, pixels.size(), 4);
    std::vector<Entry> entries{{256, 3, 1, shorts({width})}, {257, 3, 1, shorts({height})},
                               {258, 3, 1, shorts({bits})},  {259, 3, 1, shorts({1})},
                               {262, 3, 1, shorts({1})},     {273, 4, 1, strip_at},
                               {277, 3, 1, shorts({1})},     {278, 3, 1, shorts({height})},
                               {279, 4, 1, strip_bytes},     {339, 3, 1, shorts({sample_format})}};
    if (scale) {
      std::string doubles;
      for (const double value : *scale) append(doubles, std::bit_cast<uint64_t>(value), 8);
      entries.push_back({33550, 12, 3, doubles});
    }
    if (!geo_keys.empty()) {
      std::string keys;
      for (const uint16_t key : geo_keys) append(keys, key, 2);
      entries.push_back({34735, 3, geo_keys.size(), keys});
    }
    if (!no_data.empty()) entries.push_back({42113, 2, no_data.size() + 1, no_data + '\0'});

    // Header, pixels, values that do not fit into their entries, directory.
    std::string file(big_endian ? "MM" : "II");
    append(file, big_tiff ? 43 : 42, 2);
    if (big_tiff) append(file, 8, 2), append(file, 0, 2);
    const size_t directory_field = file.size();
    file.resize(head);
    file += pixels;
    const size_t inline_bytes = big_tiff ? 8 : 4;
    std::string directory;
    append(directory, entries.size(), big_tiff ? 8 : 2);
    for (Entry& entry : entries) {
      append(directory, entry.tag, 2);
      append(directory, entry.type, 2);
      append(directory, entry.count, inline_bytes);
      if (entry.tag == 42113 && stray_tag) {
        append(directory, 1000000, inline_bytes);
      } else if (entry.value.size() > inline_bytes) {
        append(directory, file.size(), inline_bytes);
        file += entry.value;
      } else {
        entry.value.resize(inline_bytes);
        directory += entry.value;
      }
    }
    append(directory, 0, inline_bytes);
    std::string at;
    append(at, file.size(), inline_bytes);
    file.replace(directory_field, at.size(), at);
    return file + directory;
  }

 private:
  void append(std::string& text, uint64_t value, size_t count) const {
    for (size_t i = 0; i < count; ++i) text += char(value >> 8 * (big_endian ? count - 1 - i : i));
  }
  std::string encoded_samples() const {
    std::string text;
    for (const double value : samples) {
      if (sample_format == 3)
        append(text, std::bit_cast<uint32_t>(float(value)), 4);
      else
        append(text, uint64_t(int64_t(value)), size_t(bits / 8));
    }
    return text;
  }
};

/// A PNG with a sound header of this size and next to no pixels.
inline std::string png_claiming(uint32_t width, uint32_t height) {
  const auto crc = [](const std::string& bytes) {
    uint32_t value = 0xffffffffu;
    for (const char c : bytes) {
      value ^= uint8_t(c);
      for (int bit = 0; bit < 8; ++bit) value = value >> 1 ^ (value & 1 ? 0xedb88320u : 0);
    }
    return ~value;
  };
  const auto number = [](uint32_t value) {
    return std::string{char(value >> 24), char(value >> 16), char(value >> 8), char(value)};
  };
  const auto chunk = [&](const std::string& name, const std::string& data) {
    return number(uint32_t(data.size())) + name + data + number(crc(name + data));
  };
  const std::string header = number(width) + number(height) + std::string("\x08\x00\x00\x00\x00", 5);
  return std::string("\x89PNG\r\n\x1a\n", 8) + chunk("IHDR", header) +
         chunk("IDAT", std::string("\x78\x9c\x63\x00\x00\x00\x01\x00\x01", 9)) + chunk("IEND", "");
}

}  // namespace sward::testing_files
