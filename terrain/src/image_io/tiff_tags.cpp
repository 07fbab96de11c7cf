// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// TIFF 6.0 (Adobe, 1992) and its 64-bit form; GeoTIFF (OGC 19-008r4) keys; GDAL's GDAL_NODATA tag.

#include "image_io/tiff_tags.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <vector>

namespace sward::image_io {

namespace {

constexpr uint16_t k_pixel_scale_tag = 33550, k_geo_keys_tag = 34735, k_no_data_tag = 42113;
constexpr uint16_t k_model_type_key = 1024, k_projection_key = 3072, k_linear_units_key = 3076;
constexpr uint16_t k_ascii = 2, k_short = 3, k_double = 12;
constexpr uint64_t k_most_entries = 4096, k_most_bytes = 1 << 20;

struct Entry {
  uint16_t tag = 0, type = 0;
  uint64_t count = 0;
  uint64_t value_at = 0;  // position of the value or of the offset to it
};

/// Numbers of a TIFF at any position, in its byte order.
class TiffReader {
 public:
  explicit TiffReader(const std::string& path) : stream_(path, std::ios::binary) { good_ = read_header(); }
  bool is_tiff() const { return good_; }

  std::vector<Entry> directory() {
    std::vector<Entry> entries;
    const uint64_t count = number(first_directory_, big_ ? 8 : 2).value_or(0);
    if (count > k_most_entries) return entries;
    for (uint64_t i = 0; i < count; ++i) {
      const uint64_t at = first_directory_ + (big_ ? 8 + 20 * i : 2 + 12 * i);
      const auto tag = number(at, 2), type = number(at + 2, 2), values = number(at + 4, big_ ? 8 : 4);
      if (!tag || !type || !values) return entries;
      entries.push_back({uint16_t(*tag), uint16_t(*type), *values, at + (big_ ? 12 : 8)});
    }
    return entries;
  }

  /// The values' bytes in the file's order, or nothing when they are not all there.
  std::optional<std::vector<char>> values(const Entry& entry, uint64_t value_bytes) {
    if (entry.count > k_most_bytes / value_bytes) return std::nullopt;
    const uint64_t bytes = entry.count * value_bytes;
    const uint64_t inline_bytes = big_ ? 8 : 4;
    if (bytes <= inline_bytes) return read(entry.value_at, bytes);
    const auto at = number(entry.value_at, inline_bytes);
    return at ? read(*at, bytes) : std::nullopt;
  }

  uint64_t decode(const char* bytes, uint64_t count) const {
    uint64_t value = 0;
    for (uint64_t i = 0; i < count; ++i) {
      const uint64_t byte = static_cast<unsigned char>(bytes[i]);
      value |= byte << 8 * (big_endian_ ? count - 1 - i : i);
    }
    return value;
  }

 private:
  bool read_header() {
    const auto head = read(0, 4);
    if (!head) return false;
    const std::string_view order(head->data(), 2);
    if (order != "II" && order != "MM") return false;
    big_endian_ = order == "MM";
    const uint64_t version = decode(head->data() + 2, 2);
    if (version != 42 && version != 43) return false;
    big_ = version == 43;
    const auto at = big_ ? number(8, 8) : number(4, 4);
    first_directory_ = at.value_or(0);
    return at.has_value();
  }

  std::optional<uint64_t> number(uint64_t at, uint64_t count) {
    const auto bytes = read(at, count);
    return bytes ? std::optional(decode(bytes->data(), count)) : std::nullopt;
  }

  std::optional<std::vector<char>> read(uint64_t at, uint64_t count) {
    if (at > uint64_t(INT64_MAX) - count) return std::nullopt;
    std::vector<char> bytes(count);
    stream_.clear();
    stream_.seekg(std::streamoff(at));
    stream_.read(bytes.data(), std::streamsize(count));
    if (!stream_ || uint64_t(stream_.gcount()) != count) return std::nullopt;
    return bytes;
  }

  std::ifstream stream_;
  bool good_ = false, big_ = false, big_endian_ = false;
  uint64_t first_directory_ = 0;
};

/// The directory of short keys: groups of (key, place of the value, count, value); place 0 means the value itself.
void read_geo_keys(const TiffReader& tiff, const std::vector<char>& bytes, GeoTags& tags) {
  for (size_t i = 8; i + 8 <= bytes.size(); i += 8) {
    const auto key = tiff.decode(&bytes[i], 2), place = tiff.decode(&bytes[i + 2], 2);
    const auto value = uint16_t(tiff.decode(&bytes[i + 6], 2));
    if (place != 0) continue;
    if (key == k_model_type_key) tags.model_type = value;
    if (key == k_projection_key) tags.projection = value;
    if (key == k_linear_units_key) tags.linear_units = value;
  }
}

bool read_tag(TiffReader& tiff, const Entry& entry, GeoTags& tags) {
  if (entry.tag == k_no_data_tag && entry.type == k_ascii) {
    const auto text = tiff.values(entry, 1);
    if (!text) return false;
    tags.no_data = std::string(text->begin(), std::find(text->begin(), text->end(), '\0'));
  } else if (entry.tag == k_pixel_scale_tag && entry.type == k_double && entry.count >= 2) {
    const auto scale = tiff.values(entry, 8);
    if (!scale) return false;
    tags.pixel_scale = glm::dvec2(std::bit_cast<double>(tiff.decode(scale->data(), 8)),
                                  std::bit_cast<double>(tiff.decode(scale->data() + 8, 8)));
  } else if (entry.tag == k_geo_keys_tag && entry.type == k_short) {
    const auto keys = tiff.values(entry, 2);
    if (!keys) return false;
    read_geo_keys(tiff, *keys, tags);
  }
  return true;
}

}  // namespace

bool GeoTags::in_metres() const {
  if (model_type != 1) return false;
  if (linear_units) return *linear_units == 9001;
  const int code = projection.value_or(0);
  return (code >= 32601 && code <= 32660) || (code >= 32701 && code <= 32760);
}

Expected<GeoTags> read_geo_tags(const std::string& path) {
  GeoTags tags;
  TiffReader tiff(path);
  if (!tiff.is_tiff()) return tags;
  for (const Entry& entry : tiff.directory()) {
    if (!read_tag(tiff, entry, tags)) {
      return fail("\"" + path + "\" is damaged: its TIFF tag " + std::to_string(entry.tag) +
                  " points outside of the file");
    }
  }
  return tags;
}

}  // namespace sward::image_io
