// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "file_io.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>

namespace sward {

namespace {

// One call writes or reads at most this much, so that limits of single calls play no part.
constexpr size_t k_most_a_call = size_t(1) << 28;

Expected<void> write_all(int descriptor, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), std::min(bytes.size(), k_most_a_call));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return fail(std::strerror(written < 0 ? errno : ENOSPC));
    bytes = bytes.subspan(size_t(written));
  }
  return {};
}

Expected<void> write_new(const std::string& path, std::span<const std::span<const std::byte>> pieces) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) return fail(std::strerror(errno));
  Expected<void> done;
  for (const auto piece : pieces) {
    if (done) done = write_all(descriptor, piece);
  }
  if (done && ::fsync(descriptor) != 0) done = fail(std::strerror(errno));
  if (::close(descriptor) != 0 && done) done = fail(std::strerror(errno));
  return done;
}

}  // namespace

Expected<InputFile> InputFile::open(const std::string& path, const std::string& what) {
  std::string name = what + " '" + path + "'";
  // Without O_NONBLOCK, opening a pipe would wait for a writer.
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return fail("cannot open " + name + ": " + std::strerror(errno));
  struct stat status {};
  if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) {
    ::close(descriptor);
    return fail(name + " is no ordinary file");
  }
  return InputFile(descriptor, size_t(status.st_size), std::move(name));
}

InputFile::InputFile(InputFile&& other) noexcept
    : descriptor_(other.descriptor_), size_(other.size_), name_(std::move(other.name_)) {
  other.descriptor_ = -1;
}

InputFile::~InputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Expected<void> InputFile::read(size_t offset, std::span<std::byte> to) const {
  while (!to.empty()) {
    const ssize_t got = ::pread(descriptor_, to.data(), std::min(to.size(), k_most_a_call), off_t(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return fail("cannot read " + name_ + ": " + std::strerror(errno));
    if (got == 0) return fail(name_ + " is truncated");
    offset += size_t(got);
    to = to.subspan(size_t(got));
  }
  return {};
}

Expected<std::shared_ptr<const std::byte>> InputFile::map() const {
  void* at = ::mmap(nullptr, size_, PROT_READ, MAP_SHARED | MAP_POPULATE, descriptor_, 0);
  if (at == MAP_FAILED) return fail("cannot map " + name_ + ": " + std::strerror(errno));
  return std::shared_ptr<const std::byte>(static_cast<const std::byte*>(at), [size = size_](const std::byte* begin) {
    ::munmap(const_cast<std::byte*>(begin), size);
  });
}

Expected<void> write_atomically(const std::string& path, const std::string& what,
                                std::span<const std::span<const std::byte>> pieces) {
  static std::atomic<uint32_t> count{0};
  const std::string temporary =
      path + "." + std::to_string(::getpid()) + "." + std::to_string(count.fetch_add(1)) + ".part";
  Expected<void> done = write_new(temporary, pieces);
  if (done && ::rename(temporary.c_str(), path.c_str()) != 0) done = fail(std::strerror(errno));
  if (done) return {};
  ::unlink(temporary.c_str());
  return fail("cannot write " + what + " '" + path + "': " + done.error().message);
}

}  // namespace sward
