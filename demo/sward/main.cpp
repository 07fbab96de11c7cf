// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// The command-line tool. Exit status: 0 done; 1 a fault of data, files or GL, told in one line; 2 wrong usage.

#include <sward/version.h>
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "sward/commands/commands.h"

namespace {

constexpr int k_failed = 1, k_wrong_usage = 2;

int report(int status, std::string message) {
  for (char& c : message)
    if (c == '\n') c = ' ';
  while (message.ends_with(' ')) message.pop_back();
  std::fprintf(stderr, "sward: error: %s\n", message.c_str());
  return status;
}

int run(int argc, char** argv) {
  CLI::App app("Terrain covered with vegetation that the GPU grows.", "sward");
  app.set_version_flag("--version", SWARD_VERSION);
  app.require_subcommand(1);
  const sward::tool::Command commands[] = {
      sward::tool::add_view(app), sward::tool::add_render(app), sward::tool::add_fly(app),
      sward::tool::add_mesh(app), sward::tool::add_plants(app), sward::tool::add_bake(app),
      sward::tool::add_info(app),
  };
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& wanted) {
    return app.exit(wanted);
  } catch (const CLI::ParseError& error) {
    return report(k_wrong_usage, std::string(error.what()) + " (see --help)");
  }
  for (const sward::tool::Command& command : commands) {
    if (!command.app->parsed()) continue;
    if (auto done = command.run(); !done) return report(k_failed, done.error().message);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::bad_alloc&) {
    return report(k_failed, "out of memory");
  } catch (const std::exception& error) {
    return report(k_failed, error.what());
  }
}
