// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Bounds on disk: a header of five 64-bit words (magic and version, the field's fingerprint, count of values, their
// checksum, the header's own) and the values, in the machine's byte order, which the magic number tells.

#include <sward/terrain/bounds.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <system_error>

#include "checksum.h"

namespace sward {

namespace {

// "SWBND" and the version; raised whenever a value's meaning changes.
constexpr uint64_t k_magic = 0x444e4257530001u;

using Header = std::array<uint64_t, 5>;

Header make_header(uint64_t fingerprint, std::span<const uint16_t> values) {
  Header header{k_magic, fingerprint, values.size(), checksum(values.data(), values.size_bytes()), 0};
  header[4] = checksum(header.data(), 4 * sizeof(uint64_t));
  return header;
}

// Deletes what it names unless told that it was renamed away.
struct Temporary {
  std::string path;
  bool kept = false;
  ~Temporary() {
    std::error_code ignored;
    if (!kept) std::filesystem::remove(path, ignored);
  }
};

tl::unexpected<Error> damaged(const std::string& path, const char* what) {
  return fail("bounds file '" + path + "' " + what + ": delete it or let the bounds be computed again");
}

}  // namespace

Expected<void> Bounds::save(const std::string& path) const {
  // A name of its own for each object, so that two writers do not share a temporary.
  std::array<char, 32> suffix{};
  std::snprintf(suffix.data(), suffix.size(), ".%p.part", static_cast<const void*>(this));
  Temporary temporary{path + suffix.data()};
  const Header header = make_header(field_->fingerprint(), {stored_.get(), stored_count_});
  std::ofstream file(temporary.path, std::ios::binary | std::ios::trunc);
  if (!file) {
    temporary.kept = true;
    return fail("cannot write bounds file '" + path + "': check that its folder exists and is writable");
  }
  file.write(reinterpret_cast<const char*>(header.data()), sizeof header);
  file.write(reinterpret_cast<const char*>(stored_.get()), std::streamsize(memory()));
  file.close();
  if (!file) return fail("cannot write all of bounds file '" + path + "': check the free space");
  std::error_code error;
  std::filesystem::rename(temporary.path, path, error);
  if (error) return fail("cannot write bounds file '" + path + "': " + error.message());
  temporary.kept = true;
  return {};
}

Expected<Bounds> Bounds::load(const std::string& path, const HeightField& field) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return fail("cannot read bounds file '" + path + "'");
  Header header{};
  if (!file.read(reinterpret_cast<char*>(header.data()), sizeof header)) return damaged(path, "is truncated");
  if (header[0] != k_magic) return damaged(path, "is of another version or no bounds file");
  if (header[4] != checksum(header.data(), 4 * sizeof(uint64_t))) return damaged(path, "is damaged");

  Bounds bounds;
  bounds.adopt_layout(field);
  if (header[1] != field.fingerprint() || header[2] != bounds.stored_count_) {
    return damaged(path, "belongs to another height field");
  }
  if (!file.read(reinterpret_cast<char*>(bounds.stored_.get()), std::streamsize(bounds.memory()))) {
    return damaged(path, "is truncated");
  }
  if (file.peek() != std::ifstream::traits_type::eof()) return damaged(path, "is longer than it says");
  if (header[3] != checksum(bounds.stored_.get(), bounds.memory())) return damaged(path, "is damaged");
  return bounds;
}

}  // namespace sward
