// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Portable Network Graphics specification, second edition (ISO/IEC 15948:2003), sections 5 and 11.

#include "image_io/png_chunks.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace sward::image_io {

namespace {

constexpr size_t k_signature_bytes = 8;
constexpr size_t k_frame_bytes = 12;          // length, name and checksum of a chunk
constexpr uint32_t k_largest_side = 1000000;  // libpng's own limit

constexpr std::array<uint32_t, 256> make_crc_table() {
  std::array<uint32_t, 256> table{};
  for (uint32_t i = 0; i < 256; ++i) {
    uint32_t value = i;
    for (int bit = 0; bit < 8; ++bit) value = value >> 1 ^ ((value & 1) != 0 ? 0xedb88320u : 0u);
    table[i] = value;
  }
  return table;
}
constexpr std::array<uint32_t, 256> k_crc_table = make_crc_table();

uint32_t crc(std::string_view bytes) {
  uint32_t value = 0xffffffffu;
  for (const char c : bytes) value = k_crc_table[(value ^ static_cast<unsigned char>(c)) & 0xff] ^ value >> 8;
  return ~value;
}

uint32_t number(std::string_view bytes, size_t at) {
  uint32_t value = 0;
  for (size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

struct Header {
  uint32_t width = 0, height = 0;
  int depth = 0, color = 0, compression = 0, filter = 0, interlace = 0;
};

bool has_known_layout(const Header& header) {
  const int depth = header.depth;
  const bool up_to_8 = depth == 1 || depth == 2 || depth == 4 || depth == 8;
  const bool bytes = depth == 8 || depth == 16;
  const bool layout = header.color == 0   ? up_to_8 || depth == 16
                      : header.color == 3 ? up_to_8
                                          : (header.color == 2 || header.color == 4 || header.color == 6) && bytes;
  return layout && header.compression == 0 && header.filter == 0 && header.interlace <= 1;
}

Expected<Header> read_header(std::string_view data, const std::string& name) {
  if (data.size() != 13) return fail(name + " is damaged: its PNG header has not 13 bytes");
  const auto byte = [&](size_t at) { return int(static_cast<unsigned char>(data[at])); };
  const Header header{number(data, 0), number(data, 4), byte(8), byte(9), byte(10), byte(11), byte(12)};
  const std::string size = std::to_string(header.width) + " x " + std::to_string(header.height);
  if (header.width == 0 || header.height == 0) return fail(name + " has no pixels (" + size + ")");
  if (header.width > k_largest_side || header.height > k_largest_side) {
    return fail(name + " is too large (" + size + "): at most a million pixels a side are read, cut it into tiles");
  }
  if (!has_known_layout(header)) return fail(name + " is damaged: its PNG header names no known layout of pixels");
  return header;
}

/// True for the lengths of palette and transparency that the layout allows.
bool palette_fits(std::string_view data) {
  return !data.empty() && data.size() % 3 == 0 && data.size() <= 768;
}
bool transparency_fits(std::string_view data, const Header& header, size_t palette_entries) {
  if (header.color == 0) return data.size() == 2;
  if (header.color == 2) return data.size() == 6;
  return header.color == 3 && !data.empty() && data.size() <= palette_entries;
}

/// Goes through the chunks and collects those that pixels need.
class Filter {
 public:
  Filter(std::string_view file, const std::string& name) : file_(file), name_(name) {
    kept_ = file.substr(0, k_signature_bytes);
  }

  Expected<std::string> run() {
    size_t at = k_signature_bytes;
    while (!ended_) {
      if (file_.size() - at < k_frame_bytes) return cut_short();
      const uint32_t length = number(file_, at);
      if (length > file_.size() - at - k_frame_bytes) return cut_short();
      const std::string_view chunk = file_.substr(at, k_frame_bytes + length);
      if (auto taken = take(chunk); !taken) return tl::unexpected(taken.error());
      at += chunk.size();
    }
    if (!has_data_) return fail(name_ + " is damaged: it has no pixel data");
    return std::move(kept_);
  }

 private:
  tl::unexpected<Error> cut_short() const {
    return fail(name_ + " is damaged or cut short: a PNG chunk is not complete");
  }

  Expected<void> take(std::string_view chunk) {
    const std::string_view type = chunk.substr(4, 4);
    const std::string_view data = chunk.substr(8, chunk.size() - k_frame_bytes);
    if (!has_header_ && type != "IHDR") return fail(name_ + " is damaged: it does not begin with a PNG header");
    const bool critical = (type[0] & 0x20) == 0;
    if (!critical && type != "tRNS") return {};
    if (crc(chunk.substr(4, chunk.size() - 8)) != number(chunk, chunk.size() - 4)) {
      return fail(name_ + " is damaged: the checksum of a PNG chunk is wrong");
    }
    return keep(type, data, chunk);
  }

  Expected<void> keep(std::string_view type, std::string_view data, std::string_view chunk) {
    if (type == "IHDR") {
      if (has_header_) return fail(name_ + " is damaged: it has two PNG headers");
      const auto header = read_header(data, name_);
      if (!header) return tl::unexpected(header.error());
      header_ = *header;
      has_header_ = true;
    } else if (type == "PLTE") {
      // Beside RGB a palette is only a hint.
      if (header_.color != 3) return {};
      if (!palette_fits(data) || palette_entries_ != 0 || has_data_)
        return fail(name_ + " is damaged: its palette is not sound");
      palette_entries_ = data.size() / 3;
    } else if (type == "tRNS") {
      if (has_data_ || has_transparency_) return {};
      if (!transparency_fits(data, header_, palette_entries_))
        return fail(name_ + " is damaged: its transparency is not sound");
      has_transparency_ = true;
    } else if (type == "IDAT") {
      if (header_.color == 3 && palette_entries_ == 0) return fail(name_ + " is damaged: its palette is missing");
      has_data_ = has_data_ || !data.empty();
    } else if (type == "IEND") {
      ended_ = true;
    } else {
      return fail(name_ + " holds a PNG chunk of unknown meaning");
    }
    kept_ += chunk;
    return {};
  }

  std::string_view file_;
  const std::string& name_;
  std::string kept_;
  Header header_;
  bool has_header_ = false, has_transparency_ = false, has_data_ = false, ended_ = false;
  size_t palette_entries_ = 0;
};

}  // namespace

Expected<std::string> pixel_chunks(const std::string& file, const std::string& name) {
  if (file.size() < k_signature_bytes || file.compare(1, 3, "PNG") != 0) return fail(name + " is not a valid png file");
  return Filter(file, name).run();
}

}  // namespace sward::image_io
