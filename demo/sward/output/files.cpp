// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "sward/output/files.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#ifdef SWARD_IMAGE_IO
#include <sward/image_io/image_io.h>
#endif

namespace sward::tool {

namespace fs = std::filesystem;

namespace {

std::string folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  return folder.empty() ? "." : folder.string();
}

std::string extension_of(const std::string& path) {
  std::string extension = fs::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension;
}

// A device or pipe is written in place: renaming a file over it would replace it.
bool is_device(const std::string& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  return fs::exists(status) && !fs::is_regular_file(status);
}

Expected<void> write_bytes(const std::string& path, std::string_view bytes) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) return fail(path + ": cannot be written: " + std::strerror(errno));
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  const int reason = errno;
  if (std::fclose(file) == 0 && written) return {};
  return fail(path + ": cannot be written: " + std::strerror(written ? errno : reason));
}

}  // namespace

Expected<void> check_output_folder(const std::string& path) {
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return fail(path + ": this output folder does not exist; create it first");
  if (!fs::is_directory(path, ignored)) return fail(path + ": is no folder, so nothing can be written into it");
  if (access(path.c_str(), W_OK | X_OK) != 0) return fail(path + ": no permission to write into this folder");
  return {};
}

Expected<void> check_output(const std::string& path) {
  if (path.empty()) return {};
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) return fail(path + ": is a folder; name a file");
  return check_output_folder(folder_of(path));
}

Expected<void> check_picture(const std::string& path) {
  const std::string extension = extension_of(path);
#ifdef SWARD_IMAGE_IO
  constexpr const char* k_known[] = {".ppm", ".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp", ".tga"};
  if (std::find(std::begin(k_known), std::end(k_known), extension) == std::end(k_known))
    return fail(path + ": pictures are written as .png, .ppm, .jpg, .tif, .bmp or .tga");
#else
  if (extension != ".ppm")
    return fail(path + ": this build has no image_io and writes pictures as .ppm only; name a .ppm file");
#endif
  return check_output(path);
}

std::string temporary_name(const std::string& path) {
  const fs::path target(path);
  const std::string name =
      "." + target.stem().string() + ".tmp" + std::to_string(getpid()) + target.extension().string();
  return (target.parent_path() / name).string();
}

Expected<void> write_file(const std::string& path, std::string_view bytes) {
  if (path.empty()) return {};
  if (is_device(path)) return write_bytes(path, bytes);
  const std::string temporary = temporary_name(path);
  auto written = write_bytes(temporary, bytes);
  std::error_code error;
  if (written) fs::rename(temporary, path, error);
  if (written && !error) return {};
  std::error_code ignored;
  fs::remove(temporary, ignored);
  return fail(path + ": cannot be written: " + (written ? error.message() : written.error().message));
}

Expected<void> save_picture(const std::string& path, int width, int height, const std::vector<uint8_t>& rgb) {
  if (extension_of(path) == ".ppm") {
    std::string bytes = "P6\n" + std::to_string(width) + " " + std::to_string(height) + "\n255\n";
    bytes.append(reinterpret_cast<const char*>(rgb.data()), rgb.size());
    return write_file(path, bytes);
  }
#ifdef SWARD_IMAGE_IO
  return save_image(path, width, height, rgb);
#else
  return check_picture(path);
#endif
}

}  // namespace sward::tool
