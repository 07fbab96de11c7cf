// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/terrain/world_bake.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <optional>

#include "sward/arguments.h"
#include "sward/commands/commands.h"
#include "sward/output/progress.h"

#ifdef SWARD_IMAGE_IO
#include "sward/commands/image_grid.h"
#endif

namespace sward::tool {

namespace {

struct BakeOptions {
  std::vector<std::string> inputs;
  std::string output;
  int square = 1025;
  int images_a_row = 1, overlap = 0;
  std::string spacing = "1", origin = "0,0,0";
  double height_scale = 1, height_offset = 0;
  std::optional<double> no_data;
};

// log2 of the cells of a square of so many samples a side.
Expected<int> bits_of(int samples) {
  for (int bits = 2; bits <= 14; ++bits)
    if ((1 << bits) + 1 == samples) return bits;
  return fail("--square takes a power of two and one, from 5 to 16385, as in 1025 or 2049; " + std::to_string(samples) +
              " is none");
}

#ifdef SWARD_IMAGE_IO

// 33 x 33 samples of a square are always resident.
constexpr int k_coarse_bits = 5;

Expected<HeightImport> import_of(const BakeOptions& options) {
  HeightImport import;
  const auto spacing = parse_numbers(options.spacing, 1, 2);
  if (!spacing) return tl::unexpected(spacing.error());
  import.spacing = {spacing->front(), spacing->back()};
  const auto origin = parse_numbers(options.origin, 3, 3);
  if (!origin) return tl::unexpected(origin.error());
  import.origin = {(*origin)[0], (*origin)[1], (*origin)[2]};
  import.scale = options.height_scale;
  import.offset = options.height_offset;
  import.no_data = options.no_data;
  return import;
}

Expected<void> bake(const BakeOptions& options) {
  const auto bits = bits_of(options.square);
  if (!bits) return tl::unexpected(bits.error());
  const auto import = import_of(options);
  if (!import) return tl::unexpected(import.error());
  if (options.images_a_row < 1) return fail("--images-a-row must be at least 1");
  auto grid = ImageGrid::create(options.inputs, options.images_a_row, options.overlap, *import);
  if (!grid) return tl::unexpected(grid.error());
  const auto source = grid->source();
  if (!source) return tl::unexpected(source.error());

  BakeDesc desc;
  desc.world = grid->world();
  desc.world.root_bits = *bits;
  desc.world.coarse_bits = std::min(k_coarse_bits, *bits - 1);
  desc.source = *source;
  ProgressLine line("bake");
  const auto read = [&](const SampleBox& box, std::span<float> heights, std::span<uint8_t> holes) {
    return grid->read(box, heights, holes);
  };
  auto stats = bake_world(options.output, desc, read, line.callback());
  if (!stats) return tl::unexpected(stats.error());
  const glm::ivec2 squares = desc.world.squares();
  std::printf("%d x %d squares of %d samples: %u baked, %u were there; %llu holes; %.1f MB\n", squares.x, squares.y,
              options.square, stats->baked, stats->skipped, static_cast<unsigned long long>(stats->holes),
              double(stats->bytes) * 1e-6);
  return {};
}

#else

Expected<void> bake(const BakeOptions& options) {
  if (auto bits = bits_of(options.square); !bits) return tl::unexpected(bits.error());
  return fail("this build reads no height maps; configure it with SWARD_IMAGE_IO=ON");
}

#endif

}  // namespace

Command add_bake(CLI::App& parent) {
  auto options = std::make_shared<BakeOptions>();
  CLI::App* app = parent.add_subcommand(
      "bake", "Cut height maps into a world of squares that is loaded piece by piece; goes on where it was cut off");
  app->add_option("inputs", options->inputs, "Height maps of one size, row by row from the north-west")
      ->type_name("IMAGE...")
      ->required();
  app->add_option("-o,--output", options->output, "Folder of the world; made when it is missing")
      ->type_name("FOLDER")
      ->required();
  app->add_option("--square", options->square, "Samples along a square's side: a power of two and one")
      ->type_name("N")
      ->capture_default_str();
  app->add_option("--images-a-row", options->images_a_row, "How many of several height maps make a row")
      ->type_name("N")
      ->capture_default_str();
  app->add_option("--overlap", options->overlap, "Samples that neighbouring height maps share")
      ->type_name("N")
      ->capture_default_str();
  app->add_option("--spacing", options->spacing, "Metres between samples, east-west[,north-south]")
      ->type_name("M[,M]")
      ->check(as_check([](const std::string& text) { return parse_numbers(text, 1, 2); }))
      ->capture_default_str();
  app->add_option("--origin", options->origin, "World position of the middle, metres")
      ->type_name("X,Y,Z")
      ->check(as_check([](const std::string& text) { return parse_numbers(text, 3, 3); }))
      ->capture_default_str();
  app->add_option("--height-scale", options->height_scale, "Metres a raw unit")->type_name("M")->capture_default_str();
  app->add_option("--height-offset", options->height_offset, "Metres added to every height")
      ->type_name("M")
      ->capture_default_str();
  app->add_option("--no-data", options->no_data, "Raw value of samples without data, instead of the files' own")
      ->type_name("VALUE");
  return {app, [options] { return bake(*options); }};
}

}  // namespace sward::tool
