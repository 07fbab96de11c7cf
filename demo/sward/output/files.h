// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <sward/terrain/error.h>
#include <string>
#include <string_view>
#include <vector>

namespace sward::tool {

/// Fails when a file could not be written there: its folder is missing or closed to us, or the path is a folder. Call
/// it before long work. An empty path is fine: nothing is to be written.
Expected<void> check_output(const std::string& path);
/// The same for a folder that files are to be written into.
Expected<void> check_output_folder(const std::string& path);
/// check_output, and the name's ending must be one that save_picture can write.
Expected<void> check_picture(const std::string& path);

/// A name beside `path` for a file in the making; keeps the ending.
std::string temporary_name(const std::string& path);

/// Writes all of it or nothing: to a temporary file beside it, which is then renamed. An empty path writes nothing.
Expected<void> write_file(const std::string& path, std::string_view bytes);

/// 8-bit RGB rows, top first. .ppm always; .png and what else the build's image_io writes.
Expected<void> save_picture(const std::string& path, int width, int height, const std::vector<uint8_t>& rgb);

}  // namespace sward::tool
