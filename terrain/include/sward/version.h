// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>

/// The version of these headers, by the rules of semver.org: before 1.0.0 a minor version may break hosts' code, from
/// then on only a major one; a patch breaks nothing. This is the one place where it is written: the build reads it
/// here.
#define SWARD_VERSION_MAJOR 0
#define SWARD_VERSION_MINOR 1
#define SWARD_VERSION_PATCH 0
/// The same as a string literal, "0.1.0".
#define SWARD_VERSION                    \
  SWARD_DETAIL_TEXT(SWARD_VERSION_MAJOR) \
  "." SWARD_DETAIL_TEXT(SWARD_VERSION_MINOR) "." SWARD_DETAIL_TEXT(SWARD_VERSION_PATCH)
/// The same as one number that #if can compare: 10000 * major + 100 * minor + patch.
#define SWARD_VERSION_NUMBER (10000 * SWARD_VERSION_MAJOR + 100 * SWARD_VERSION_MINOR + SWARD_VERSION_PATCH)

#define SWARD_DETAIL_TEXT(number) SWARD_DETAIL_QUOTE(number)
#define SWARD_DETAIL_QUOTE(text) #text

namespace sward {

struct Version {
  int major = 0, minor = 0, patch = 0;
  friend bool operator==(const Version&, const Version&) = default;
};

/// Of the headers that this file was compiled with.
inline constexpr Version k_header_version{SWARD_VERSION_MAJOR, SWARD_VERSION_MINOR, SWARD_VERSION_PATCH};

/// Of the library that is loaded. Any thread, at any time.
SWARD_API Version library_version();

/// True where a host that was compiled with `headers` may use a library of version `library`: the same major version
/// (and before 1.0.0 the same minor one), and a library no older than the headers. A host that loads sward as a shared
/// library asks this once, before any other call: `headers_match(k_header_version, library_version())`.
constexpr bool headers_match(Version headers, Version library) {
  if (headers.major != library.major) return false;
  if (headers.minor != library.minor) return headers.major > 0 && headers.minor < library.minor;
  return headers.patch <= library.patch;
}

}  // namespace sward
