// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "sward/viewer/file_watch.h"

namespace sward::tool {

namespace {

constexpr std::chrono::milliseconds k_interval(500);

}  // namespace

FileWatch::FileWatch(std::vector<std::string> paths) : paths_(std::move(paths)) {
  std::erase(paths_, std::string());
  seen_ = look();
  next_look_ = std::chrono::steady_clock::now() + k_interval;
}

FileWatch::Times FileWatch::look() const {
  namespace fs = std::filesystem;
  Times times;
  std::error_code error;
  const auto note = [&](const fs::path& path) {
    const auto time = fs::last_write_time(path, error);
    if (!error) times[path] = time;
  };
  for (const std::string& path : paths_) {
    if (!fs::is_directory(path, error)) note(path);
    for (fs::directory_iterator entry(path, error), end; !error && entry != end; entry.increment(error))
      note(entry->path());
  }
  return times;
}

bool FileWatch::changed() {
  const auto now = std::chrono::steady_clock::now();
  if (now < next_look_) return false;
  next_look_ = now + k_interval;
  Times times = look();
  if (times == seen_) return false;
  seen_ = std::move(times);
  return true;
}

}  // namespace sward::tool
