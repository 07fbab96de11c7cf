// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#include <sward/version.h>

namespace sward {

Version library_version() {
  return k_header_version;
}

}  // namespace sward
