// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/image_io/image_io.h>
