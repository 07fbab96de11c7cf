// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/error.h>
#include <string>

namespace sward::image_io {

/// A PNG with nothing but the chunks that make its pixels (header, palette, transparency, data, end), each checked.
/// libpng prints to stderr on a damaged chunk and on many sound ones that say nothing about pixels (colour profiles,
/// text), so it gets to see neither. `name` begins messages. Fails on a file that is cut short or damaged.
Expected<std::string> pixel_chunks(const std::string& file, const std::string& name);

}  // namespace sward::image_io
