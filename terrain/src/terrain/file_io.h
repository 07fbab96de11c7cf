// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/terrain/error.h>
#include <cstddef>
#include <memory>
#include <span>
#include <string>

namespace sward {

/// An ordinary file open for reading.
class SWARD_API InputFile {
 public:
  /// Fails, naming `what` and the path, when the file is missing, closed to us, a folder, a pipe or a device.
  static Expected<InputFile> open(const std::string& path, const std::string& what);
  InputFile(InputFile&& other) noexcept;
  InputFile& operator=(InputFile&&) = delete;
  ~InputFile();

  /// Bytes when it was opened.
  size_t size() const { return size_; }
  /// Reads all of `to`; fails on read errors and when the file ends early.
  Expected<void> read(size_t offset, std::span<std::byte> to) const;
  /// Maps the whole file read-only; it stays mapped while the result lives.
  Expected<std::shared_ptr<const std::byte>> map() const;
  /// "what 'path'".
  const std::string& name() const { return name_; }

 private:
  InputFile(int descriptor, size_t size, std::string name)
      : descriptor_(descriptor), size_(size), name_(std::move(name)) {}
  int descriptor_ = -1;
  size_t size_ = 0;
  std::string name_;
};

/// Writes the pieces one after the other to a temporary beside `path`, syncs it and renames it. Removes the temporary
/// and fails, naming `what` and the path, when any of that fails.
SWARD_API Expected<void> write_atomically(const std::string& path, const std::string& what,
                                          std::span<const std::span<const std::byte>> pieces);

}  // namespace sward
