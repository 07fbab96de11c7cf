// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Rules as a botanist would give them: snow lies high and not on cliffs; rock shows where soil cannot stay; soil is
// bare on gully banks, in stream beds, on trails and in worn patches; grass dries on swells and sunny slopes and stays
// green in hollows. Noise of several octaves frays every border, so that the map has no smooth edges at any scale.

#include "scene/generated_paint.h"

#include <algorithm>
#include <cmath>

#include "scene/generated_noise.h"
#include "scene/generated_trails.h"

namespace sward::generated {

namespace {

// Slow quantities, computed once on the relief's grid or a coarser one.
struct Survey {
  Grid dryness;   // above 0: dry grass
  Grid channel;   // log2 of the drainage area, square metres
  Grid hollow;    // metres below the mean of the surroundings (some 20 m)
  Grid snowline;  // height above which snow stays, metres
  Grid worn;      // 0..1: pastures that hooves have opened
  Grid mottle;    // noise of about 300 m
};

struct Site {
  glm::vec2 p;
  float height, slope;
  float dryness, channel, hollow, snowline, worn, trail;
  float mottle[4];  // noise of about 300, 60, 14 and 4 m, each about [-1, 1]
  float grain;      // texel by texel, [-0.5, 0.5)
};

struct Cover {
  std::array<float, k_grounds> share{};

  // The ground covers this much of what was there before.
  void lay(Ground ground, float amount) {
    for (float& value : share) value *= 1 - amount;
    share[size_t(ground)] += amount;
  }
};

Grid difference(Grid a, const Grid& b) {
  for (size_t i = 0; i < a.values.size(); ++i) a.values[i] -= b.values[i];
  return a;
}

float site_dryness(const Grid& broad, const Grid& swell, const Grid& channel, int column, int row, uint32_t seed) {
  const glm::vec2 p = broad.position(column, row);
  const glm::vec2 slope = gradient(broad, column, row);
  const float sunny = slope.y;  // rises northwards: faces south
  const float wet = smooth_step(9.5f, 15.0f, channel.at(column, row));
  const glm::vec2 q = p + 110.0f * warp(p / 420.0f, 2, seed + 400);
  return 0.05f * std::clamp(swell.at(column, row), -9.0f, 9.0f) + 1.1f * std::clamp(sunny, -0.3f, 0.3f) - 0.42f * wet +
         0.62f * fbm(q / 640.0f, 2, 0.5f, seed + 410) + 0.42f * fbm(q / 170.0f, 2, 0.5f, seed + 411);
}

Survey make_survey(const Relief& relief, uint32_t seed) {
  Survey survey;
  survey.channel = relief.area;
  for (float& value : survey.channel.values) value = std::log2(value);
  const Grid z = every_second(blurred(relief.heights, 5));
  survey.hollow = difference(blurred(z, 20), z);
  const Grid broad = blurred(z, 30);
  const Grid swell = difference(broad, blurred(z, 120));
  const Grid channel = blurred(every_second(survey.channel), 14);
  survey.dryness = survey.snowline = survey.worn = survey.mottle = Grid(z.side, z.spacing);
  for (int row = 0; row < z.side; ++row) {
    for (int column = 0; column < z.side; ++column) {
      const glm::vec2 p = z.position(column, row);
      const size_t i = size_t(z.index(column, row));
      survey.dryness.values[i] = site_dryness(broad, swell, channel, column, row, seed);
      const float shade = -std::clamp(gradient(broad, column, row).y, -0.7f, 0.7f);
      survey.snowline.values[i] = 392 - 75 * shade + 34 * fbm(p / 520.0f, 2, 0.5f, seed + 420);
      survey.mottle.values[i] = fbm(p / 310.0f, 2, 0.5f, seed + 500);
      survey.worn.values[i] = smooth_step(0.05f, 0.5f, fbm(p / 260.0f, 2, 0.5f, seed + 430));
    }
  }
  return survey;
}

Cover cover_of(const Site& site) {
  const float fray = 0.5f * site.mottle[1] + 0.35f * site.mottle[2] + 0.25f * site.mottle[3] + 0.25f * site.grain;
  const float bare = 0.45f * site.mottle[2] + 0.4f * site.mottle[3] + 0.25f * site.mottle[1] + 0.3f * site.grain;
  const float high = smooth_step(190, 420, site.height);
  Cover cover;
  cover.share[size_t(Ground::grass)] = 1;
  cover.lay(Ground::dry_grass, smooth_step(-0.24f, 0.36f, site.dryness + 0.55f * fray - 0.12f + 0.15f * high));

  const float wear = smooth_step(0.33f, 0.45f, bare * (0.35f + 0.75f * site.worn) + 0.13f * high);
  const float bank = smooth_step(0.5f, 0.62f, site.slope + 0.28f * fray + 0.16f * high - 0.02f * site.hollow);
  const float gully = smooth_step(11.0f, 12.6f, site.channel + 2.2f * bare) * smooth_step(0.26f, 0.42f, site.slope);
  const float bed = smooth_step(18.6f, 19.5f, site.channel + 1.3f * fray);
  const float trail = smooth_step(0.3f, 0.8f, site.trail * (1 + 0.5f * bare) + 0.2f * (site.trail > 0 ? bare : 0.0f));
  const float open = std::max({wear, bank, 0.9f * gully, 0.85f * bed});
  cover.lay(Ground::soil, std::max(smooth_step(0.25f, 0.7f, open), trail));

  // Scree fills the hollows between the buttresses.
  const float cliff = smooth_step(0.66f, 0.78f, site.slope + 0.3f * fray + 0.12f * high - 0.035f * site.hollow);
  const float outcrop = smooth_step(0.62f, 0.74f, bare + 0.25f * high - 0.05f * std::max(site.hollow, -2.0f));
  const float crest = smooth_step(380, 450, site.height + 60 * fray - 12 * site.hollow);
  cover.lay(Ground::rock, std::max({cliff, 0.9f * outcrop, crest}));

  const float line = site.height - site.snowline + 30 * fray + 13 * std::clamp(site.hollow, -4.0f, 5.0f);
  const float holds = 1 - smooth_step(0.92f, 1.2f, site.slope + 0.25f * bare - 0.02f * site.hollow);
  cover.lay(Ground::snow, smooth_step(-10, 10, line) * holds);
  return cover;
}

glm::vec3 between(glm::vec3 a, glm::vec3 b, float t) {
  return glm::mix(a, b, std::clamp(t, 0.0f, 1.0f));
}

glm::vec3 rock_color(const Site& site, float tone) {
  // Strata: bands of height, dipping and bent; cliffs are darker than what lies at rest.
  const float level = site.height + 0.21f * site.p.x + 0.13f * site.p.y + 14 * site.mottle[1];
  const float band = noise({level / 21.0f, 0.4f * site.mottle[0]}, 77) + 0.6f * noise({level / 6.5f, 3.1f}, 78);
  const float cliff = smooth_step(0.6f, 1.15f, site.slope) - 0.1f * std::clamp(site.hollow, -2.5f, 2.5f);
  return between({88, 86, 82}, {148, 144, 136},
                 0.62f * tone + 0.3f + 0.17f * band - 0.38f * cliff + 0.16f * site.mottle[3]);
}

// sRGB 0..255 of each ground at a site, before its brightness varies.
glm::vec3 ground_color(Ground ground, const Site& site) {
  const float tone = 0.5f + 0.3f * site.mottle[0] + 0.3f * site.mottle[1] + 0.2f * site.mottle[2];
  switch (ground) {
    case Ground::grass: {
      const glm::vec3 meadow = between({88, 103, 55}, {111, 121, 67}, tone);
      const float damp = smooth_step(0.1f, -0.6f, site.dryness);
      return between(meadow, {80, 104, 55}, 0.65f * damp);
    }
    case Ground::dry_grass:
      return between({138, 126, 78}, {158, 146, 94}, tone);
    case Ground::soil:
      return between({98, 79, 59}, {124, 101, 77}, tone + 0.6f * site.mottle[3]);
    case Ground::rock:
      return rock_color(site, tone);
    case Ground::snow:
      return between({226, 230, 236}, {242, 244, 246}, tone);
  }
  return {};
}

glm::u8vec4 color_of(const Cover& cover, const Site& site) {
  glm::vec3 color(0);
  for (int i = 0; i < k_grounds; ++i)
    if (cover.share[size_t(i)] > 0.002f) color += cover.share[size_t(i)] * ground_color(Ground(i), site);
  const float lively = 1 - 0.8f * cover.share[size_t(Ground::snow)];
  const float brightness = 1 + lively * (0.05f * site.mottle[0] + 0.06f * site.mottle[1] + 0.07f * site.mottle[2] +
                                         0.07f * site.mottle[3] + 0.1f * site.grain);
  const glm::vec3 c = glm::clamp(color * brightness + 0.5f, 0.0f, 255.0f);
  return {uint8_t(c.x), uint8_t(c.y), uint8_t(c.z), 255};
}

Site site_at(const Survey& survey, const Grid& surface, glm::vec2 p, float reach, uint32_t seed) {
  Site site;
  site.p = p;
  site.height = surface.bilinear(p);
  const glm::vec2 x(reach, 0), y(0, reach);
  const glm::vec2 rise(surface.bilinear(p + x) - surface.bilinear(p - x),
                       surface.bilinear(p + y) - surface.bilinear(p - y));
  site.slope = glm::length(rise) / (2 * reach);
  site.dryness = survey.dryness.bilinear(p);
  site.channel = survey.channel.bilinear(p);
  site.hollow = survey.hollow.bilinear(p);
  site.snowline = survey.snowline.bilinear(p);
  site.worn = survey.worn.bilinear(p);
  site.mottle[0] = survey.mottle.bilinear(p);
  site.mottle[1] = 1.3f * fbm(p / 62.0f, 2, 0.6f, seed + 510);
  site.mottle[2] = 1.3f * fbm(p / 15.0f, 2, 0.6f, seed + 520);
  site.mottle[3] = 1.2f * noise(p / 5.3f, seed + 530);
  return site;
}

}  // namespace

Paint paint_ground(const Relief& relief, const Grid& surface, int texels, uint32_t seed, int threads,
                   const std::function<void(float done)>& progress) {
  const Survey survey = make_survey(relief, seed);
  const std::vector<uint8_t> wear = trail_wear(find_trails(relief.heights, seed), texels, k_width);
  const float texel = k_width / float(texels);
  const float reach = std::max(texel, surface.spacing);
  const size_t count = size_t(texels) * size_t(texels);
  Paint paint{std::vector<glm::u8vec4>(count), std::vector<Ground>(count)};
  const auto paint_row = [&](int row) {
    for (int column = 0; column < texels; ++column) {
      const glm::vec2 p((float(column) + 0.5f) * texel - 0.5f * k_width, 0.5f * k_width - (float(row) + 0.5f) * texel);
      const size_t i = size_t(row) * size_t(texels) + size_t(column);
      Site site = site_at(survey, surface, p, reach, seed);
      site.trail = float(wear[i]) / 255;
      site.grain = hash01(column, row, seed + 540) - 0.5f;
      const Cover cover = cover_of(site);
      paint.texels[i] = color_of(cover, site);
      paint.ground[i] = Ground(std::max_element(cover.share.begin(), cover.share.end()) - cover.share.begin());
    }
  };
  for_each_row(texels, threads, paint_row, progress);
  return paint;
}

}  // namespace sward::generated
