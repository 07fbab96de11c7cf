// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/view.h>

#include <string>

namespace sward {

/// Asserts that a view validates; `call` is for the message. False where an assertion handler has returned: then the
/// call does nothing.
inline bool usable(const View& view, const char* call) {
  const Expected<void> valid = view.validate();
  if (valid) return true;
  assert_failed("the view validates", (std::string(call) + ": " + valid.error().message).c_str(), __FILE__, __LINE__);
  return false;
}

}  // namespace sward
