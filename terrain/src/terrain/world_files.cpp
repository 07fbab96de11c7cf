// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "world_files.h"

#include <array>
#include <bit>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "checksum.h"
#include "file_io.h"

namespace sward::world {

namespace {

static_assert(std::endian::native == std::endian::little, "baked worlds are little-endian and used in place");

// "SWINDEX" and "SWSQUAR", and the version; raised whenever a byte's meaning changes.
constexpr uint64_t k_index_magic = 0x015845444e495753u;
constexpr uint64_t k_square_magic = 0x0152415551535753u;

using IndexHeader = std::array<uint64_t, 17>;
using SquareHeader = std::array<uint64_t, 9>;

std::span<const std::byte> bytes_of(const void* data, size_t bytes) {
  return {static_cast<const std::byte*>(data), bytes};
}

template <class T>
std::span<const std::byte> bytes_of(std::span<const T> values) {
  return std::as_bytes(values);
}

constexpr size_t padded(size_t bytes) {
  return (bytes + 7) / 8 * 8;
}

tl::unexpected<Error> damaged(const std::string& name, const char* what) {
  return fail(name + " " + what + ": bake the world again");
}

// Where the parts of a square's payload lie.
struct SquareParts {
  size_t samples = 0, bounds = 0, holes = 0;  // bytes
  size_t bounds_at() const { return padded(samples); }
  size_t holes_at() const { return bounds_at() + padded(bounds); }
  size_t total() const { return holes_at() + padded(holes); }
};

SquareParts parts_of(const WorldLayout& layout, bool holes) {
  const size_t sample = layout.desc.floats ? sizeof(float) : sizeof(uint16_t);
  return {layout.ring_samples() * sample, layout.square_samples() * sizeof(uint16_t),
          holes ? layout.hole_words() * sizeof(uint64_t) : size_t(0)};
}

struct IndexParts {
  size_t checksums = 0, heights = 0, bounds = 0, cells = 0;  // bytes
  size_t total() const { return checksums + padded(heights) + padded(bounds) + padded(cells); }
};

IndexParts parts_of(const WorldLayout& layout) {
  return {layout.square_count() * sizeof(uint64_t), layout.coarse_samples() * sizeof(float),
          layout.coarse_samples() * sizeof(uint16_t), layout.coarse_cells() * sizeof(uint16_t)};
}

// Pieces of a payload with the zeros between them, and their checksum.
class Pieces {
 public:
  void add(std::span<const std::byte> piece) {
    static constexpr std::array<std::byte, 8> k_zeros{};
    all_.push_back(piece);
    if (const size_t rest = padded(piece.size()) - piece.size(); rest > 0)
      all_.push_back(std::span(k_zeros).first(rest));
  }
  uint64_t payload_checksum() const {
    uint64_t sum = 0;
    for (const auto piece : all_) sum = checksum(piece.data(), piece.size(), sum);
    return sum;
  }
  std::vector<std::span<const std::byte>> all_;
};

uint64_t section_checksum(std::span<const std::byte> payload, std::span<const size_t> sections) {
  // The same pieces that Pieces has: each section, then its padding.
  uint64_t sum = 0;
  size_t at = 0;
  for (const size_t bytes : sections) {
    sum = checksum(payload.data() + at, bytes, sum);
    at += bytes;
    if (const size_t rest = padded(bytes) - bytes; rest > 0) {
      sum = checksum(payload.data() + at, rest, sum);
      at += rest;
    }
  }
  return sum;
}

std::array<uint64_t, 12> words_of(const WorldDesc& desc) {
  const auto word = [](double number) { return std::bit_cast<uint64_t>(number); };
  return {uint64_t(desc.columns), uint64_t(desc.rows),      word(desc.spacing.x),       word(desc.spacing.y),
          word(desc.origin.x),    word(desc.origin.y),      word(desc.origin.z),        word(desc.scale),
          word(desc.offset),      uint64_t(desc.root_bits), uint64_t(desc.coarse_bits), uint64_t(desc.floats)};
}

WorldDesc desc_of(const uint64_t* words) {
  const auto number = [&](int i) { return std::bit_cast<double>(words[i]); };
  WorldDesc desc;
  desc.columns = int(words[0]);
  desc.rows = int(words[1]);
  desc.spacing = {number(2), number(3)};
  desc.origin = {number(4), number(5), number(6)};
  desc.scale = number(7);
  desc.offset = number(8);
  desc.root_bits = int(words[9]);
  desc.coarse_bits = int(words[10]);
  desc.floats = words[11] != 0;
  return desc;
}

template <class T>
const std::byte* take(const std::byte* from, std::vector<T>& to, size_t bytes) {
  to.resize(bytes / sizeof(T));
  std::memcpy(to.data(), from, bytes);
  return from + padded(bytes);
}

Expected<void> check_square_header(const SquareHeader& header, const WorldLayout& layout, uint64_t fingerprint,
                                   glm::ivec2 square, const InputFile& file) {
  if (header[0] != k_square_magic) return damaged(file.name(), "is of another version or no square of a world");
  if (header[8] != checksum(header.data(), 8 * sizeof(uint64_t))) return damaged(file.name(), "is damaged");
  if (header[1] != fingerprint || header[2] != uint64_t(square.x) || header[3] != uint64_t(square.y)) {
    return damaged(file.name(), "belongs to another world");
  }
  const SquareParts parts = parts_of(layout, header[6] != 0);
  if (header[4] != parts.samples || header[5] != parts.bounds || header[6] != parts.holes) {
    return damaged(file.name(), "has sizes that do not fit the world");
  }
  const size_t expected = sizeof header + parts.total();
  if (file.size() < expected) return damaged(file.name(), "is truncated");
  if (file.size() > expected) return damaged(file.name(), "is longer than it says");
  return {};
}

using Payload = std::shared_ptr<const std::byte>;

Expected<Payload> copy_payload(const InputFile& file, size_t from, size_t bytes) {
  std::shared_ptr<std::byte[]> copy(new std::byte[bytes]);
  if (auto done = file.read(from, {copy.get(), bytes}); !done) return tl::unexpected<Error>(done.error());
  return Payload(copy, copy.get());
}

// Reads all of the file first: what cannot be read is an error here, not a signal.
Expected<Payload> map_payload(const InputFile& file, size_t from) {
  std::vector<std::byte> scratch(std::min(file.size(), size_t(1) << 20));
  for (size_t at = 0; at < file.size(); at += scratch.size()) {
    const auto part = std::span(scratch).first(std::min(scratch.size(), file.size() - at));
    if (auto done = file.read(at, part); !done) return tl::unexpected<Error>(done.error());
  }
  auto map = file.map();
  if (!map) return map;
  return Payload(*map, map->get() + from);
}

SquareData view_of(const std::byte* payload, const SquareParts& parts, const WorldLayout& layout,
                   std::shared_ptr<const void> owner) {
  SquareData data;
  if (layout.desc.floats)
    data.floats = {reinterpret_cast<const float*>(payload), layout.ring_samples()};
  else
    data.words = {reinterpret_cast<const uint16_t*>(payload), layout.ring_samples()};
  data.bounds = {reinterpret_cast<const uint16_t*>(payload + parts.bounds_at()), layout.square_samples()};
  if (parts.holes > 0)
    data.holes = {reinterpret_cast<const uint64_t*>(payload + parts.holes_at()), layout.hole_words()};
  data.owner = std::move(owner);
  return data;
}

}  // namespace

uint64_t fingerprint_of(const WorldDesc& desc, const std::string& source) {
  const auto words = words_of(desc);
  return checksum(source.data(), source.size(), checksum(words.data(), sizeof words));
}

std::string index_path(const std::string& folder) {
  return (std::filesystem::path(folder) / "world.index").string();
}

std::string square_path(const std::string& folder, glm::ivec2 square) {
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "r%04d/c%04d.square", square.y, square.x);
  return (std::filesystem::path(folder) / name.data()).string();
}

Expected<uint64_t> write_square(const std::string& folder, const WorldLayout& layout, uint64_t fingerprint,
                                glm::ivec2 square, const SquareData& data) {
  const SquareParts parts = parts_of(layout, !data.holes.empty());
  Pieces payload;
  payload.add(layout.desc.floats ? bytes_of(data.floats) : bytes_of(data.words));
  payload.add(bytes_of(data.bounds));
  payload.add(bytes_of(data.holes));
  SquareHeader header{k_square_magic,
                      fingerprint,
                      uint64_t(square.x),
                      uint64_t(square.y),
                      parts.samples,
                      parts.bounds,
                      parts.holes,
                      payload.payload_checksum(),
                      0};
  header[8] = checksum(header.data(), 8 * sizeof(uint64_t));
  payload.all_.insert(payload.all_.begin(), bytes_of(header.data(), sizeof header));

  const std::string path = square_path(folder, square);
  std::error_code ignored;  // What is wrong with the folder, opening the file tells.
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), ignored);
  if (auto done = write_atomically(path, "square of a world", payload.all_); !done)
    return tl::unexpected<Error>(done.error());
  return header[7];
}

Expected<void> write_index(const std::string& folder, const WorldIndex& index) {
  Pieces payload;
  payload.add(bytes_of(std::span<const uint64_t>(index.checksums)));
  payload.add(bytes_of(std::span<const float>(index.coarse.heights)));
  payload.add(bytes_of(std::span<const uint16_t>(index.coarse.bounds)));
  payload.add(bytes_of(std::span<const uint16_t>(index.coarse.cell_bounds)));
  IndexHeader header{k_index_magic, index.fingerprint};
  const auto words = words_of(index.desc);
  std::copy(words.begin(), words.end(), header.begin() + 2);
  header[14] = parts_of(WorldLayout(index.desc)).total();
  header[15] = payload.payload_checksum();
  header[16] = checksum(header.data(), 16 * sizeof(uint64_t));
  payload.all_.insert(payload.all_.begin(), bytes_of(header.data(), sizeof header));
  return write_atomically(index_path(folder), "index of a world", payload.all_);
}

Expected<WorldIndex> read_index(const std::string& folder) {
  auto file = InputFile::open(index_path(folder), "index of a world");
  if (!file) return fail(file.error().message + "; bake a world into that folder first (sward bake)");
  IndexHeader header{};
  if (file->size() < sizeof header) return damaged(file->name(), "is truncated");
  if (auto done = file->read(0, std::as_writable_bytes(std::span(header))); !done)
    return tl::unexpected<Error>(done.error());
  if (header[0] != k_index_magic) return damaged(file->name(), "is of another version or no index of a world");
  if (header[16] != checksum(header.data(), 16 * sizeof(uint64_t))) return damaged(file->name(), "is damaged");

  WorldIndex index;
  index.fingerprint = header[1];
  index.desc = desc_of(header.data() + 2);
  if (auto checked = index.desc.validate(); !checked) return fail(file->name() + ": " + checked.error().message);
  const IndexParts parts = parts_of(WorldLayout(index.desc));
  if (header[14] != parts.total()) return damaged(file->name(), "has sizes that do not fit the world");
  if (file->size() < sizeof header + parts.total()) return damaged(file->name(), "is truncated");
  if (file->size() > sizeof header + parts.total()) return damaged(file->name(), "is longer than it says");
  std::vector<std::byte> payload(parts.total());
  if (auto done = file->read(sizeof header, payload); !done) return tl::unexpected<Error>(done.error());
  const std::array<size_t, 4> sections{parts.checksums, parts.heights, parts.bounds, parts.cells};
  if (header[15] != section_checksum(payload, sections)) return damaged(file->name(), "is damaged");
  const std::byte* at = take(payload.data(), index.checksums, parts.checksums);
  at = take(at, index.coarse.heights, parts.heights);
  at = take(at, index.coarse.bounds, parts.bounds);
  take(at, index.coarse.cell_bounds, parts.cells);
  return index;
}

Expected<ReadSquare> read_square(const std::string& folder, const WorldLayout& layout, uint64_t fingerprint,
                                 glm::ivec2 square, bool mapped) {
  auto file = InputFile::open(square_path(folder, square), "square of a world");
  if (!file) return tl::unexpected<Error>(file.error());
  SquareHeader header{};
  if (file->size() < sizeof header) return damaged(file->name(), "is truncated");
  if (auto done = file->read(0, std::as_writable_bytes(std::span(header))); !done)
    return tl::unexpected<Error>(done.error());
  if (auto checked = check_square_header(header, layout, fingerprint, square, *file); !checked)
    return tl::unexpected<Error>(checked.error());

  const SquareParts parts = parts_of(layout, header[6] != 0);
  auto payload = mapped ? map_payload(*file, sizeof header) : copy_payload(*file, sizeof header, parts.total());
  if (!payload) return tl::unexpected<Error>(payload.error());
  const std::array<size_t, 3> sections{parts.samples, parts.bounds, parts.holes};
  if (header[7] != section_checksum({payload->get(), parts.total()}, sections)) {
    return damaged(file->name(), "is damaged (wrong checksum)");
  }
  return ReadSquare{view_of(payload->get(), parts, layout, *payload), header[7]};
}

}  // namespace sward::world
