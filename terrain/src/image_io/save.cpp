// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <sward/image_io/image_io.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>
#include <vector>

#include "image_io/oiio_errors.h"
#include "image_io/raw_image.h"

namespace sward {

namespace {

namespace fs = std::filesystem;

// JPEG's limit; its library ends the process beyond.
constexpr int k_largest_side = 65500;
// What OpenImageIO 2.4 encodes in memory; TIFF it leaves empty.
constexpr std::array<std::string_view, 6> k_extensions{".png", ".jpg", ".jpeg", ".bmp", ".tga", ".ppm"};

/// Removes a file at the end of the scope, unless it was kept.
class TemporaryFile {
 public:
  explicit TemporaryFile(fs::path path) : path_(std::move(path)) {}
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    std::error_code ignored;
    if (!kept_) fs::remove(path_, ignored);
  }
  const fs::path& path() const { return path_; }
  std::error_code rename_to(const fs::path& target) {
    std::error_code code;
    fs::rename(path_, target, code);
    kept_ = !code;
    return code;
  }

 private:
  fs::path path_;
  bool kept_ = false;
};

/// Same folder, so that renaming stays within a file system.
fs::path temporary_beside(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  const std::string name = ".sward-partial-" + std::to_string(getpid()) + "-" + std::to_string(counter++);
  return target.parent_path() / name;
}

Expected<void> check_target(const fs::path& target, const std::string& name) {
  std::error_code code;
  std::string extension = target.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  if (std::find(k_extensions.begin(), k_extensions.end(), extension) == k_extensions.end()) {
    return fail(name + " must end in .png, .jpg, .bmp, .tga or .ppm");
  }
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, code)) {
    return fail(name + " cannot be written: the folder \"" + folder.string() + "\" does not exist; create it first");
  }
  if (fs::is_directory(target, code)) return fail(name + " cannot be written: it is a folder");
  return {};
}

/// In memory first: encoders that write a file themselves miss errors of the last flush.
Expected<std::vector<unsigned char>> encode(const fs::path& path, int width, int height, std::span<const uint8_t> rgb,
                                            const std::string& name) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create(path.string());
  if (!output || !output->set_ioproxy(&memory)) {
    return fail(name + " cannot be written: " + image_io::one_line(OIIO::geterror()));
  }
  const image_io::DrainErrors drain(*output);
  OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  const bool written = output->open(path.string(), spec) && output->write_image(OIIO::TypeDesc::UINT8, rgb.data());
  if (!output->close() || !written) {
    return fail(name + " cannot be written: " + image_io::one_line(output->geterror()));
  }
  return bytes;
}

Expected<void> write_file(const fs::path& path, std::span<const unsigned char> bytes, const std::string& name) {
  errno = 0;
  std::ofstream stream(path, std::ios::binary | std::ios::trunc);
  stream.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
  stream.close();
  if (stream) return {};
  const std::string reason = errno != 0 ? std::generic_category().message(errno) : "writing failed";
  return fail(name + " cannot be written: " + reason);
}

Expected<void> save(const std::string& path, int width, int height, std::span<const uint8_t> rgb) {
  const std::string name = image_io::named("picture", path);
  if (width < 1 || height < 1 || width > k_largest_side || height > k_largest_side) {
    return fail(name + " would be " + std::to_string(width) + " x " + std::to_string(height) +
                " pixels, expected 1 to " + std::to_string(k_largest_side) + " a side");
  }
  const size_t expected_bytes = size_t(width) * size_t(height) * 3;
  if (rgb.size() != expected_bytes) {
    return fail(name + " was given " + std::to_string(rgb.size()) + " bytes of RGB, expected " +
                std::to_string(expected_bytes));
  }
  if (auto checked = check_target(path, name); !checked) return checked;
  const auto bytes = encode(path, width, height, rgb, name);
  if (!bytes) return tl::unexpected(bytes.error());
  TemporaryFile temporary(temporary_beside(path));
  if (auto written = write_file(temporary.path(), *bytes, name); !written) return written;
  if (const auto code = temporary.rename_to(path)) return fail(name + " cannot be written: " + code.message());
  return {};
}

}  // namespace

Expected<void> save_image(const std::string& path, int width, int height, std::span<const uint8_t> rgb) {
  try {
    return save(path, width, height, rgb);
  } catch (const std::exception& error) {
    return fail(image_io::named("picture", path) + " cannot be written: " + image_io::one_line(error.what()));
  }
}

}  // namespace sward
