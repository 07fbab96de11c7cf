// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "image_io/oiio_errors.h"

namespace sward::image_io {

std::string one_line(const std::string& message) {
  std::string line;
  for (const char c : message) {
    if (c == '\n' || c == '\r') {
      if (!line.empty() && !line.ends_with("; ")) line += "; ";
    } else {
      line += c;
    }
  }
  while (line.ends_with("; ")) line.resize(line.size() - 2);
  return line.empty() ? "no reason given" : line;
}

}  // namespace sward::image_io
