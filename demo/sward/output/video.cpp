// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "sward/output/video.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <utility>

#include "sward/output/files.h"

extern char** environ;

namespace sward::tool {

namespace {

// Starts `arguments[0]` with its standard input coming from the returned descriptor.
Expected<std::pair<int, pid_t>> start_with_input(std::vector<std::string> arguments) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return fail(std::string("no pipe to ffmpeg: ") + std::strerror(errno));
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
  pid_t process = -1;
  const int error = posix_spawn(&process, pointers[0], &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[0]);
  if (error == 0) return std::pair(ends[1], process);
  close(ends[1]);
  return fail("cannot start " + arguments[0] + ": " + std::strerror(error));
}

}  // namespace

std::string find_program(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::stringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    std::string candidate = (folder.empty() ? "." : folder) + "/" + program;
    if (access(candidate.c_str(), X_OK) == 0) return candidate;
  }
  return {};
}

Expected<VideoPipe> VideoPipe::open(const std::string& path, glm::ivec2 size, double fps) {
  const std::string ffmpeg = find_program("ffmpeg");
  if (ffmpeg.empty()) return fail("--video needs ffmpeg, which is not in PATH; install it or leave --video out");
  // A reader that goes away is an error of write(), not a signal.
  std::signal(SIGPIPE, SIG_IGN);
  VideoPipe video;
  video.path_ = path;
  video.temporary_ = temporary_name(path);
  auto started =
      start_with_input({ffmpeg, "-y", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s",
                        std::to_string(size.x) + "x" + std::to_string(size.y), "-r", std::to_string(fps), "-i", "-",
                        "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", video.temporary_});
  if (!started) return tl::unexpected(started.error());
  std::tie(video.pipe_, video.process_) = *started;
  return video;
}

VideoPipe::VideoPipe(VideoPipe&& other) noexcept
    : path_(std::move(other.path_)),
      temporary_(std::move(other.temporary_)),
      pipe_(std::exchange(other.pipe_, -1)),
      process_(std::exchange(other.process_, -1)) {}

VideoPipe::~VideoPipe() {
  if (process_ < 0) return;
  wait_for_exit();
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

Expected<void> VideoPipe::write(const std::vector<uint8_t>& rgb) {
  for (size_t done = 0; done < rgb.size();) {
    const ssize_t written = ::write(pipe_, rgb.data() + done, rgb.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return fail(path_ + ": ffmpeg stopped taking frames: " + std::strerror(errno));
    done += size_t(written);
  }
  return {};
}

int VideoPipe::wait_for_exit() {
  if (pipe_ >= 0) close(std::exchange(pipe_, -1));
  int status = -1;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  return status;
}

Expected<void> VideoPipe::finish() {
  const int status = wait_for_exit();
  std::error_code error;
  if (status == 0) std::filesystem::rename(temporary_, path_, error);
  if (status == 0 && !error) return {};
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
  return fail(path_ + ": ffmpeg failed to write the video");
}

}  // namespace sward::tool
