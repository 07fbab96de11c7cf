// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Ground, painted with the simplest of brushes: stones, strands and leaves stamped on noise by a fixed sequence of
// numbers. A tile is about a metre (strata: some metres), so a texel is 2 mm.

#include <sward/terrain/detail_texture.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "terrain/detail_canvas.h"

namespace sward {

namespace {

using detail::Canvas;
using detail::PaintRandom;

constexpr float k_turn = 6.2831853f;
constexpr float k_side = float(Canvas::k_side);

glm::vec2 anywhere(PaintRandom& random) {
  const float x = random.within(0, k_side), y = random.within(0, k_side);
  return {x, y};
}

/// Stones from the largest to the smallest, few large and many small.
struct Stones {
  int count = 100;
  float largest = 20, smallest = 3;  ///< Radius, texels.
  float rise = 0.03f;                ///< Height of a stone against its radius.
  float sunk = 0.3f;                 ///< Share of that below the ground.
  float dents = 0.2f, flat = 0.3f, spread = 0.3f;
  glm::vec3 color{0.3f}, warm{0.3f};
  float skew = 2.0f;  ///< More: fewer large ones.
};

void scatter(Canvas& canvas, const Stones& stones, uint32_t seed) {
  PaintRandom random(seed);
  for (int i = 0; i < stones.count; ++i) {
    const float size = std::pow(random.unit(), stones.skew);
    detail::Stone stone;
    stone.centre = anywhere(random);
    const float radius = stones.smallest + (stones.largest - stones.smallest) * size;
    stone.radius = radius * glm::vec2(1.0f, random.within(0.6f, 1.0f));
    stone.angle = random.within(0, k_turn);
    stone.rise = stones.rise * radius * random.within(0.7f, 1.2f);
    stone.base =
        canvas.height[Canvas::index(int(stone.centre.x), int(stone.centre.y))] * 0.5f - stones.sunk * stone.rise;
    stone.dents = stones.dents;
    stone.flat = stones.flat;
    stone.color = glm::mix(stones.color, stones.warm, random.unit()) * (1 + stones.spread * random.within(-1, 1));
    stone.number = random.bits();
    detail::draw_stone(canvas, stone);
  }
}

struct Strands {
  int count = 1000;
  float length = 50, width = 2, bend = 0.8f;
  float base = 0, lift = 0.5f;
  glm::vec3 fresh{0.2f, 0.3f, 0.08f}, dry{0.45f, 0.38f, 0.2f};
  float dry_share = 0.5f;
};

void strew(Canvas& canvas, const Strands& strands, uint32_t seed) {
  PaintRandom random(seed);
  for (int i = 0; i < strands.count; ++i) {
    detail::Strand strand;
    strand.root = anywhere(random);
    strand.angle = random.within(0, k_turn);
    strand.bend = strands.bend * random.within(-1, 1);
    strand.length = strands.length * random.within(0.5f, 1.2f);
    strand.width = strands.width * random.within(0.7f, 1.2f);
    strand.base = strands.base + random.within(0, strands.lift);
    strand.rise = random.within(0.05f, 0.35f);
    const float dry = std::clamp((random.unit() - 1 + strands.dry_share) * 6 + 0.5f, 0.0f, 1.0f);
    strand.color = glm::mix(strands.fresh, strands.dry, dry) * random.within(0.65f, 1.3f);
    detail::draw_strand(canvas, strand);
  }
}

DetailTexture paint_soil() {
  Canvas canvas(glm::vec3(0.20f, 0.135f, 0.085f));
  detail::roughen(canvas, 5, 6, 0.55f, 0.28f, 11);
  scatter(canvas,
          {.count = 420,
           .largest = 19,
           .smallest = 4,
           .rise = 0.045f,
           .sunk = 0.35f,
           .dents = 0.35f,
           .flat = 0.15f,
           .spread = 0.18f,
           .color = glm::vec3(0.20f, 0.135f, 0.085f),
           .warm = glm::vec3(0.25f, 0.17f, 0.11f),
           .skew = 3.0f},
          12);
  scatter(canvas,
          {.count = 2600,
           .largest = 5,
           .smallest = 1.5f,
           .rise = 0.06f,
           .sunk = 0.2f,
           .dents = 0.3f,
           .flat = 0.1f,
           .spread = 0.3f,
           .color = glm::vec3(0.19f, 0.13f, 0.08f),
           .warm = glm::vec3(0.29f, 0.22f, 0.16f)},
          13);
  strew(canvas,
        {.count = 60,
         .length = 34,
         .width = 1.6f,
         .bend = 1.2f,
         .base = 0.5f,
         .lift = 0.5f,
         .fresh = glm::vec3(0.26f, 0.18f, 0.11f),
         .dry = glm::vec3(0.40f, 0.31f, 0.19f)},
        14);
  detail::shade_hollows(canvas, 0.45f);
  detail::roughen(canvas, 64, 2, 0.05f, 0.10f, 15);
  detail::calm(canvas, 0.6f);
  return detail::finish(std::move(canvas));
}

DetailTexture paint_grass() {
  Canvas canvas(glm::vec3(0.13f, 0.105f, 0.05f));
  detail::roughen(canvas, 4, 6, 0.30f, 0.30f, 21);
  const std::vector<float> clumps = detail::octaves(6, 2, 22);
  // Old straw below, fresh blades above.
  strew(canvas,
        {.count = 2600,
         .length = 56,
         .width = 1.7f,
         .bend = 1.4f,
         .base = -0.15f,
         .lift = 0.35f,
         .fresh = glm::vec3(0.20f, 0.21f, 0.075f),
         .dry = glm::vec3(0.34f, 0.28f, 0.13f),
         .dry_share = 0.75f},
        23);
  strew(canvas,
        {.count = 3600,
         .length = 42,
         .width = 2.1f,
         .bend = 1.0f,
         .base = 0.05f,
         .lift = 0.55f,
         .fresh = glm::vec3(0.155f, 0.225f, 0.06f),
         .dry = glm::vec3(0.26f, 0.27f, 0.10f),
         .dry_share = 0.3f},
        24);
  for (size_t i = 0; i < clumps.size(); ++i) {
    canvas.height[i] += 0.25f * clumps[i];
    canvas.color[i] *= 1 + 0.16f * clumps[i];
  }
  detail::shade_hollows(canvas, 0.38f);
  detail::calm(canvas, 0.7f);
  return detail::finish(std::move(canvas));
}

DetailTexture paint_gravel() {
  Canvas canvas(glm::vec3(0.20f, 0.17f, 0.13f));
  detail::roughen(canvas, 8, 5, 0.20f, 0.30f, 31);
  const glm::vec3 cold(0.30f, 0.295f, 0.285f), warm(0.37f, 0.31f, 0.24f);
  scatter(canvas,
          {.count = 5200,
           .largest = 8,
           .smallest = 2,
           .rise = 0.05f,
           .sunk = 0.1f,
           .dents = 0.28f,
           .flat = 0.25f,
           .spread = 0.4f,
           .color = cold,
           .warm = warm},
          32);
  scatter(canvas,
          {.count = 900,
           .largest = 17,
           .smallest = 5,
           .rise = 0.055f,
           .sunk = 0.15f,
           .dents = 0.32f,
           .flat = 0.4f,
           .spread = 0.36f,
           .color = cold,
           .warm = warm,
           .skew = 2.4f},
          33);
  detail::shade_hollows(canvas, 0.35f);
  detail::roughen(canvas, 96, 2, 0.03f, 0.12f, 34);
  detail::calm(canvas, 0.5f);
  return detail::finish(std::move(canvas));
}

DetailTexture paint_rock() {
  const glm::vec3 grey(0.30f, 0.29f, 0.275f), pale(0.33f, 0.315f, 0.29f);
  Canvas canvas(grey);
  detail::roughen(canvas, 3, 6, 0.7f, 0.16f, 41);
  // Plates that have broken along planes, worn, then the rubble of their edges.
  scatter(canvas, {.count = 130, .largest = 120, .smallest = 25, .rise = 0.003f, .sunk = 0.35f, .dents = 0.4f,
                   .flat = 0.35f, .spread = 0.10f, .color = grey, .warm = pale, .skew = 1.5f}, 42);
  detail::wear(canvas, 5);
  scatter(canvas, {.count = 600, .largest = 18, .smallest = 3, .rise = 0.010f, .sunk = 0.4f, .dents = 0.4f,
                   .flat = 0.3f, .spread = 0.13f, .color = grey, .warm = pale, .skew = 3.0f}, 43);
  const std::vector<float> lichen = detail::octaves(7, 4, 45);
  for (size_t i = 0; i < Canvas::k_texels; ++i) {
    const float grown = std::clamp((lichen[i] - 0.30f) * 7, 0.0f, 1.0f);
    canvas.color[i] = glm::mix(canvas.color[i], glm::vec3(0.38f, 0.375f, 0.31f), 0.4f * grown);
  }
  detail::wear(canvas, 1);
  detail::roughen(canvas, 20, 5, 0.22f, 0.26f, 46);
  detail::shade_hollows(canvas, 0.55f);
  return detail::finish(std::move(canvas));
}

/// Beds of the strata: where each begins, how bright it is and how far it stands out.
struct Bed {
  float top, light, out;
};
std::vector<Bed> make_beds(PaintRandom& random) {
  std::vector<Bed> beds;
  for (float at = 0; at < 1;) {
    at += random.unit() < 0.35f ? random.within(0.04f, 0.09f) : random.within(0.008f, 0.028f);
    beds.push_back({at, random.within(0.82f, 1.16f), random.within(-1, 1)});
  }
  const float all = beds.back().top;
  for (Bed& bed : beds) bed.top /= all;
  return beds;
}

DetailTexture paint_strata() {
  PaintRandom random(51);
  const std::vector<Bed> beds = make_beds(random);
  Canvas canvas(glm::vec3(0.31f, 0.285f, 0.255f));
  const std::vector<float> wave = detail::octaves(2, 5, 52), joint = detail::octaves(5, 2, 53),
                           rough = detail::octaves(10, 5, 54), blocks = detail::noise({14, 30}, 55);
  for (int y = 0; y < Canvas::k_side; ++y) {
    for (int x = 0; x < Canvas::k_side; ++x) {
      const size_t i = Canvas::index(x, y);
      float place = 0.31f + float(y) / k_side + 0.030f * wave[i] + 0.006f * rough[i];
      place -= std::floor(place);
      const auto bed =
          std::lower_bound(beds.begin(), beds.end(), place, [](const Bed& each, float at) { return each.top < at; });
      const Bed& own = bed == beds.end() ? beds.front() : *bed;
      const float below = std::abs(own.top - place) * k_side;  // texels to the bed's edge
      const float edge = std::clamp(1 - below / 3, 0.0f, 1.0f);
      const float open =
          std::max(0.0f, 1 - std::abs(joint[i] + 0.5f * own.out) * 16) * (0.4f + 0.6f * std::abs(own.out));
      canvas.height[i] = 0.35f * own.out + 0.25f * rough[i] + 0.22f * blocks[i] - 0.45f * edge - 0.35f * open;
      canvas.color[i] *= own.light * (1 + 0.20f * rough[i] + 0.10f * blocks[i]) * (1 - 0.35f * std::max(edge, open));
      canvas.color[i] *= glm::vec3(1 + 0.03f * own.out, 1.0f, 1 - 0.04f * own.out);
    }
  }
  detail::roughen(canvas, 48, 4, 0.10f, 0.18f, 56);
  detail::shade_hollows(canvas, 0.6f);
  return detail::finish(std::move(canvas));
}

DetailTexture paint_sand() {
  Canvas canvas(glm::vec3(0.48f, 0.40f, 0.28f));
  const std::vector<float> bend = detail::octaves(2, 3, 61);
  for (int y = 0; y < Canvas::k_side; ++y) {
    for (int x = 0; x < Canvas::k_side; ++x) {
      const size_t i = Canvas::index(x, y);
      const float phase = k_turn * (11 * float(y) / k_side + 2 * float(x) / k_side + 0.55f * bend[i]);
      const float ripple = 0.5f + 0.5f * std::sin(phase + 0.5f * std::sin(phase));
      canvas.height[i] = 0.5f * ripple + 0.3f * bend[i];
      canvas.color[i] *= 0.93f + 0.12f * ripple;
    }
  }
  scatter(canvas,
          {.count = 140,
           .largest = 5,
           .smallest = 1.5f,
           .rise = 0.05f,
           .sunk = 0.1f,
           .dents = 0.2f,
           .flat = 0.2f,
           .spread = 0.4f,
           .color = glm::vec3(0.42f, 0.36f, 0.29f),
           .warm = glm::vec3(0.56f, 0.50f, 0.41f)},
          62);
  detail::roughen(canvas, 96, 3, 0.07f, 0.16f, 63);
  detail::shade_hollows(canvas, 0.78f);
  return detail::finish(std::move(canvas));
}

DetailTexture paint_litter() {
  Canvas canvas(glm::vec3(0.12f, 0.085f, 0.055f));
  detail::roughen(canvas, 6, 6, 0.30f, 0.35f, 71);
  PaintRandom random(72);
  for (int i = 0; i < 1150; ++i) {
    detail::FlatLeaf leaf;
    leaf.centre = anywhere(random);
    leaf.angle = random.within(0, k_turn);
    leaf.length = random.within(20, 46);
    leaf.width = leaf.length * random.within(0.4f, 0.62f);
    leaf.base = -0.3f + 0.0009f * float(i) + random.within(0, 0.25f);
    leaf.tilt = random.within(0.05f, 0.3f);
    const glm::vec3 tan(0.36f, 0.235f, 0.12f), brown(0.22f, 0.135f, 0.075f);
    leaf.color = glm::mix(brown, tan, random.unit()) * random.within(0.6f, 1.25f);
    detail::draw_leaf(canvas, leaf);
  }
  strew(canvas,
        {.count = 70,
         .length = 90,
         .width = 3.2f,
         .bend = 0.6f,
         .base = 0.4f,
         .lift = 0.5f,
         .fresh = glm::vec3(0.17f, 0.125f, 0.085f),
         .dry = glm::vec3(0.27f, 0.21f, 0.15f)},
        73);
  detail::shade_hollows(canvas, 0.4f);
  detail::roughen(canvas, 64, 3, 0.03f, 0.12f, 74);
  detail::calm(canvas, 0.6f);
  return detail::finish(std::move(canvas));
}

DetailTexture paint_snow() {
  Canvas canvas(glm::vec3(0.9f));
  const std::vector<float> drift = detail::noise({3, 9}, 81), fine = detail::octaves(6, 5, 82);
  for (size_t i = 0; i < Canvas::k_texels; ++i) {
    canvas.height[i] = 0.6f * drift[i] + 0.5f * fine[i];
    canvas.color[i] *= 1 + 0.025f * drift[i] + 0.03f * fine[i];
  }
  detail::roughen(canvas, 128, 2, 0.06f, 0.05f, 83);
  detail::shade_hollows(canvas, 0.9f);
  return detail::finish(std::move(canvas));
}

DetailTexture paint_mottle() {
  Canvas canvas(glm::vec3(0.2f));
  const std::vector<float> broad = detail::octaves(4, 6, 91), tint = detail::octaves(5, 4, 92);
  for (size_t i = 0; i < Canvas::k_texels; ++i) {
    canvas.height[i] = 0.4f * broad[i];
    canvas.color[i] *= glm::vec3(1 + 0.09f * tint[i], 1.0f, 1 - 0.06f * tint[i]) * (1 + 0.22f * broad[i]);
  }
  // Tussocks and hollows of all sizes.
  scatter(canvas,
          {.count = 420,
           .largest = 34,
           .smallest = 5,
           .rise = 0.016f,
           .sunk = 0.3f,
           .dents = 0.12f,
           .flat = 0.05f,
           .spread = 0.14f,
           .color = glm::vec3(0.195f, 0.205f, 0.18f),
           .warm = glm::vec3(0.23f, 0.21f, 0.195f),
           .skew = 2.2f},
          93);
  detail::roughen(canvas, 12, 6, 0.20f, 0.42f, 94);
  detail::shade_hollows(canvas, 0.7f);
  return detail::finish(std::move(canvas));
}

struct Painter {
  std::string_view name;
  DetailTexture (*paint)();
};
constexpr Painter k_painters[] = {
    {"soil", paint_soil},     {"grass", paint_grass},   {"gravel", paint_gravel},
    {"rock", paint_rock},     {"strata", paint_strata}, {"sand", paint_sand},
    {"litter", paint_litter}, {"snow", paint_snow},     {"mottle", paint_mottle},
};

}  // namespace

std::span<const std::string_view> generated_details() {
  static const std::array<std::string_view, std::size(k_painters)> names = [] {
    std::array<std::string_view, std::size(k_painters)> all;
    std::transform(std::begin(k_painters), std::end(k_painters), all.begin(), [](const Painter& p) { return p.name; });
    return all;
  }();
  return names;
}

Expected<DetailTexture> generate_detail(std::string_view name) {
  std::string known;
  for (const Painter& painter : k_painters) {
    if (painter.name == name) return painter.paint();
    known += (known.empty() ? "\"" : ", \"") + std::string(painter.name) + "\"";
  }
  return fail("there is no generated detail texture \"" + std::string(name) + "\", expected one of " + known);
}

}  // namespace sward
