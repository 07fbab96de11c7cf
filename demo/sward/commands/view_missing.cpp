// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// Stands for the viewer in builds without a window, so that asking for it gets a reason.

#ifndef SWARD_WINDOW

#include <CLI/CLI.hpp>

#include "sward/commands/commands.h"

namespace sward::tool {

Command add_view(CLI::App& parent) {
  CLI::App* app = parent.add_subcommand("view", "Walk and fly through a scene in a window (not in this build)");
  app->allow_extras();
  return {app,
          [] { return fail("this build opens no windows; configure it with SWARD_WINDOW=ON, or use sward render"); }};
}

}  // namespace sward::tool

#endif
