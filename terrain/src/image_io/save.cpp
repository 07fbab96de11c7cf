// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <OpenImageIO/imageio.h>
#include <sward/image_io/image_io.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <exception>
#include <filesystem>
#include <string_view>

#include "image_io/oiio_errors.h"
#include "image_io/raw_image.h"

namespace sward {

namespace {

namespace fs = std::filesystem;

constexpr int k_largest_side = 65535;
constexpr std::array<std::string_view, 8> k_extensions{".png",  ".jpg", ".jpeg", ".tif",
                                                       ".tiff", ".bmp", ".tga",  ".ppm"};

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

/// Same folder, so that renaming stays within a file system; same extension, which names the format.
fs::path temporary_beside(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  const std::string name = "." + target.stem().string() + ".partial-" + std::to_string(getpid()) + "-" +
                           std::to_string(counter++) + target.extension().string();
  return target.parent_path() / name;
}

Expected<void> check_target(const fs::path& target, const std::string& name) {
  std::error_code code;
  std::string extension = target.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  if (std::find(k_extensions.begin(), k_extensions.end(), extension) == k_extensions.end()) {
    return fail(name + " must end in .png, .jpg, .tif, .bmp, .tga or .ppm");
  }
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, code)) {
    return fail(name + " cannot be written: the folder \"" + folder.string() + "\" does not exist; create it first");
  }
  if (fs::is_directory(target, code)) return fail(name + " cannot be written: it is a folder");
  return {};
}

Expected<void> write_pixels(const fs::path& path, int width, int height, std::span<const uint8_t> rgb,
                            const std::string& name) {
  const auto output = OIIO::ImageOutput::create(path.string());
  if (!output) return fail(name + " cannot be written: " + image_io::one_line(OIIO::geterror()));
  const image_io::DrainErrors drain(*output);
  OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  const bool written = output->open(path.string(), spec) && output->write_image(OIIO::TypeDesc::UINT8, rgb.data());
  if (!output->close() || !written) {
    return fail(name + " cannot be written: " + image_io::one_line(output->geterror()));
  }
  return {};
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
  TemporaryFile temporary(temporary_beside(path));
  if (auto written = write_pixels(temporary.path(), width, height, rgb, name); !written) return written;
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
