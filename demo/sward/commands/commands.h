// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/error.h>
#include <functional>

namespace CLI {
class App;
}

namespace sward::tool {

/// A subcommand that has been declared: what CLI11 parses into, and what to do then.
struct Command {
  CLI::App* app = nullptr;
  std::function<Expected<void>()> run;
};

Command add_render(CLI::App& parent);
Command add_fly(CLI::App& parent);
Command add_mesh(CLI::App& parent);
Command add_plants(CLI::App& parent);
Command add_bake(CLI::App& parent);
Command add_info(CLI::App& parent);
Command add_view(CLI::App& parent);

}  // namespace sward::tool
