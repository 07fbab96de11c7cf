// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <functional>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace sward {

/// An error of data, files or GL: one sentence that names the thing and, where there is one, the remedy.
struct Error {
  std::string message;
};

/// What every call that can fail returns. No exception crosses the API.
template <class T>
using Expected = tl::expected<T, Error>;

inline tl::unexpected<Error> fail(std::string message) {
  return tl::unexpected<Error>(Error{std::move(message)});
}

/// Progress of long work: `done` in [0, 1]. Called from the thread that called the long function, at most some hundred
/// times. An empty function is allowed everywhere.
using Progress = std::function<void(float done)>;

/// A text file compiled into the library: shaders, built-in scenes.
struct EmbeddedText {
  std::string_view name;  ///< File name without folders.
  std::string_view text;
};

/// Called by SWARD_ASSERT on misuse of the API. The default prints to stderr and aborts. Replace it before any other
/// call; a handler that returns lets the call go on with undefined results.
using AssertHandler = void (*)(const char* expression, const char* message, const char* file, int line);
SWARD_API void set_assert_handler(AssertHandler handler);
SWARD_API void assert_failed(const char* expression, const char* message, const char* file, int line);

}  // namespace sward

/// Misuse by the caller (not bad data): checked in every build type.
#define SWARD_ASSERT(expression, message) \
  ((expression) ? void(0) : ::sward::assert_failed(#expression, message, __FILE__, __LINE__))
