// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

/// Marks what the shared libraries export: everything that the public headers declare and that is not inline. All else
/// is hidden (the build compiles with -fvisibility=hidden), so that private names cannot clash with a host's. On
/// private headers it marks what one of sward's libraries takes from another; hosts have no such header.
#define SWARD_API __attribute__((visibility("default")))
