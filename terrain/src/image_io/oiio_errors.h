// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <OpenImageIO/imageio.h>

#include <string>

namespace sward::image_io {

/// A library's message as part of one line: line breaks become "; ", trailing ones go.
std::string one_line(const std::string& message);

/// Fetches an ImageInput's or ImageOutput's pending messages when it goes out of scope; OpenImageIO prints to stderr
/// those that nobody fetched.
template <class File>
class DrainErrors {
 public:
  explicit DrainErrors(File& file) : file_(file) {}
  DrainErrors(const DrainErrors&) = delete;
  DrainErrors& operator=(const DrainErrors&) = delete;
  ~DrainErrors() {
    if (file_.has_error()) file_.geterror();
    if (OIIO::has_error()) OIIO::geterror();
  }

 private:
  File& file_;
};

}  // namespace sward::image_io
