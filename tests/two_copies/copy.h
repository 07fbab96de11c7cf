// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// What a copy of the library in a module of its own does for two_copies_test.cpp. With a context current.

#define SWARD_COPY extern "C" __attribute__((visibility("default")))

SWARD_COPY bool copy_create();
/// Into the bound framebuffer, a square of `side` pixels.
SWARD_COPY bool copy_draw(unsigned framebuffer, int side);
SWARD_COPY void copy_destroy();
/// Sets this copy's assertion handler to one that counts.
SWARD_COPY void copy_count_asserts();
/// Misuses this copy; how many assertions it has counted so far.
SWARD_COPY int copy_provoke_assert();
