// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace sward::tool {

/// Whether files, or the files in folders, have been written, come or gone. Looks twice a second at most.
class FileWatch {
 public:
  /// Empty paths are left out.
  explicit FileWatch(std::vector<std::string> paths);
  /// True once for each change; changes that come together count as one.
  bool changed();

 private:
  using Times = std::map<std::filesystem::path, std::filesystem::file_time_type>;
  Times look() const;

  std::vector<std::string> paths_;
  Times seen_;
  std::chrono::steady_clock::time_point next_look_;
};

}  // namespace sward::tool
