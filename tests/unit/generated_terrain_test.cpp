// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>
#include <sward/scene/generated_terrain.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include "scene/generated_erosion.h"
#include "scene/generated_noise.h"
#include "scene/generated_paint.h"
#include "scene/generated_relief.h"
#include "scene/generated_trails.h"

namespace {

using namespace sward;
using namespace sward::generated;

constexpr double k_degrees = 57.29577951308232;

// FNV-1a.
template <class T>
uint64_t hash_bytes(const std::vector<T>& values, uint64_t hash = 0xCBF29CE484222325u) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
  for (size_t i = 0; i < values.size() * sizeof(T); ++i) hash = (hash ^ bytes[i]) * 0x100000001B3u;
  return hash;
}

struct Hsv {
  double hue, saturation, value;  // degrees, 0..1, 0..1
};

// By the definition of the hexcone, from the sorted channels.
Hsv hsv_of(glm::u8vec4 texel) {
  const double r = texel.x / 255.0, g = texel.y / 255.0, b = texel.z / 255.0;
  const double high = std::max({r, g, b}), low = std::min({r, g, b});
  if (high == low) return {0, 0, high};
  // Angle of the chroma vector's hexagon side.
  double hue = 0;
  if (high == r) hue = 60 * (g - b) / (high - low);
  if (high == g) hue = 120 + 60 * (b - r) / (high - low);
  if (high == b) hue = 240 + 60 * (r - g) / (high - low);
  return {hue < 0 ? hue + 360 : hue, (high - low) / high, high};
}

// Colours that a scene on this terrain lets its species look for.
constexpr std::array<Hsv, k_grounds> k_references{
    {{77, 0.45, 0.43}, {51, 0.415, 0.565}, {32, 0.37, 0.45}, {40, 0.08, 0.435}, {210, 0.025, 0.9}}};

// Distance with a species' default weights; hue in turns, and none where there is hardly any colour.
double distance(Hsv a, Hsv reference) {
  double hue = (a.hue - reference.hue) / 360;
  hue -= std::floor(hue + 0.5);
  if (a.saturation < 0.02) hue = 0;
  const double saturation = 0.5 * (a.saturation - reference.saturation);
  const double value = 0.25 * (a.value - reference.value);
  return std::sqrt(hue * hue + saturation * saturation + value * value);
}

Ground nearest_ground(glm::u8vec4 texel) {
  const Hsv hsv = hsv_of(texel);
  // Greys have no useful hue: tell rock from snow by their brightness.
  if (hsv.saturation < 0.15) return hsv.value > 0.7 ? Ground::snow : Ground::rock;
  int best = 0;
  for (int i = 1; i < 3; ++i)
    if (distance(hsv, k_references[size_t(i)]) < distance(hsv, k_references[size_t(best)])) best = i;
  return Ground(best);
}

Grid from_function(int side, float spacing, const std::function<float(glm::vec2)>& f) {
  Grid grid(side, spacing);
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) grid.at(column, row) = f(grid.position(column, row));
  return grid;
}

Forces constant_forces(int side, float spacing, float uplift, float incision, float creep) {
  return {Grid(side, spacing, uplift), Grid(side, spacing, incision), Grid(side, spacing, creep),
          Grid(side, spacing, 10.0f)};
}

TEST(Noise, VanishesOnTheLatticeAndStaysInRange) {
  double square_sum = 0;
  const int count = 20000;
  for (int i = 0; i < count; ++i) {
    EXPECT_EQ(noise(glm::vec2(i % 97 - 40, i / 97 - 80), 5), 0.0f);
    const glm::vec2 p(float(i) * 0.377f - 300, float(i) * 0.119f + 20);
    const float value = noise(p, 5);
    EXPECT_LE(std::abs(value), 1.1f);
    square_sum += double(value) * double(value);
    const float crest = ridged(p, 5, 9);
    EXPECT_TRUE(crest >= 0 && crest <= 1) << crest;
  }
  EXPECT_NEAR(std::sqrt(square_sum / count), 0.35, 0.1);
}

TEST(Noise, IsContinuousAcrossCellBorders) {
  for (int i = -30; i < 30; ++i) {
    const float y = 0.37f * float(i);
    EXPECT_NEAR(noise({float(i) - 1e-4f, y}, 3), noise({float(i) + 1e-4f, y}, 3), 2e-3f);
    EXPECT_NEAR(noise({y, float(i) - 1e-4f}, 3), noise({y, float(i) + 1e-4f}, 3), 2e-3f);
  }
}

TEST(Grid, InterpolationReproducesPolynomials) {
  const auto parabola = [](glm::vec2 p) {
    return 3 + 0.5f * p.x - 0.25f * p.y + 0.02f * p.x * p.x + 0.01f * p.y * p.y;
  };
  const Grid grid = from_function(17, 2, parabola);
  for (const glm::vec2 p : {glm::vec2(0.3f, -2.7f), glm::vec2(-7.9f, 5.1f), glm::vec2(10.2f, 9.9f)})
    EXPECT_NEAR(grid.bicubic(p), parabola(p), 2e-4f);
  const Grid fine = refined(grid);
  ASSERT_EQ(fine.side, 33);
  EXPECT_FLOAT_EQ(fine.spacing, 1);
  for (int row = 4; row < 29; ++row)
    for (int column = 4; column < 29; ++column)
      EXPECT_NEAR(fine.at(column, row), parabola(fine.position(column, row)), 1e-4f);
  EXPECT_EQ(every_second(fine).values, grid.values);
  const glm::vec2 slope = gradient(grid, 8, 8);
  EXPECT_NEAR(slope.x, 0.5f, 1e-5f);
  EXPECT_NEAR(slope.y, -0.25f, 1e-5f);
}

TEST(Grid, BlurHasTheWidthItIsGiven) {
  Grid grid(129, 2);
  grid.at(64, 64) = 1;
  const Grid result = blurred(grid, 15);
  double mass = 0, variance = 0;
  for (int row = 0; row < grid.side; ++row) {
    for (int column = 0; column < grid.side; ++column) {
      mass += double(result.at(column, row));
      variance += double(result.at(column, row)) * std::pow(grid.position(column, row).x, 2);
    }
  }
  EXPECT_NEAR(mass, 1, 1e-4);
  EXPECT_NEAR(std::sqrt(variance / mass), 15, 1);
}

TEST(Erosion, EveryDropReachesTheEdge) {
  // A bowl without an outlet beside a slope.
  Grid heights = from_function(65, 10, [](glm::vec2 p) {
    const float bowl = glm::length(p - glm::vec2(60, 40));
    return 500 + 0.2f * p.x + 3 * noise(p / 45.0f, 2) - 80 * std::exp(-bowl * bowl / 8000);
  });
  const Grid before = heights;
  Flow flow;
  route_flow(heights, 11, flow);
  std::vector<int> place(heights.values.size(), -1);
  for (size_t i = 0; i < flow.order.size(); ++i) place[size_t(flow.order[i])] = int(i);
  double out = 0;
  int filled = 0;
  for (size_t i = 0; i < heights.values.size(); ++i) {
    ASSERT_GE(place[i], 0);
    EXPECT_GE(heights.values[i], before.values[i]);
    filled += heights.values[i] > before.values[i];
    const size_t receiver = size_t(flow.receiver[i]);
    if (receiver == i) {
      out += double(flow.area[i]);
      continue;
    }
    EXPECT_LT(place[receiver], place[i]);
    EXPECT_LT(heights.values[receiver], heights.values[i]);
  }
  EXPECT_NEAR(out, 65.0 * 65.0 * 100.0, 65.0 * 65.0 * 0.01);
  EXPECT_GT(filled, 50);  // the bowl
  const Grid shared = spread_area(heights, flow);
  double shared_out = 0;
  for (size_t i = 0; i < heights.values.size(); ++i)
    if (flow.receiver[i] == int(i)) shared_out += double(shared.values[i]);
  EXPECT_NEAR(shared_out, out, out * 1e-3);
}

TEST(Erosion, SettlesWhereIncisionBalancesUplift) {
  // At rest U = K sqrt(A) S along every flow line; 1500 m2 of sheet flow belong to A.
  const float uplift = 120, incision = 4;
  Grid heights = from_function(65, 20, [](glm::vec2 p) { return 50 + 4 * noise(p / 130.0f, 4); });
  Grid drained = heights;
  Flow flow;
  route_flow(drained, 3, flow);
  // One routing for all steps, which is the one just made.
  erode(heights, constant_forces(65, 20, uplift, incision, 0), {400, 0.05f, 400}, 3);
  for (size_t i = 0; i < heights.values.size(); ++i) {
    if (flow.receiver[i] == int(i)) continue;
    const double drop = double(heights.values[i]) - double(heights.values[size_t(flow.receiver[i])]);
    const double expected = double(uplift) / (double(incision) * std::sqrt(double(flow.area[i]) + 1500));
    EXPECT_NEAR(drop / double(flow.distance[i]) / expected, 1, 0.02);
  }
}

TEST(Erosion, CreepDiffusesAtItsRate) {
  // A cosine hill decays by exp(-D k^2 t), in x as in the diagonal direction.
  const float wavelength = 400, creep = 900, time = 2;
  const float k = 6.2831853f / wavelength;
  for (const glm::vec2 way : {glm::vec2(1, 0), glm::vec2(0.70710678f, 0.70710678f)}) {
    Grid heights = from_function(161, 10, [&](glm::vec2 p) { return 100 + std::cos(k * glm::dot(way, p)); });
    Forces forces = constant_forces(161, 10, 0, 0, creep);
    erode(heights, forces, {100, time / 100, 100}, 1);
    EXPECT_NEAR(heights.at(80, 80) - 100, std::exp(-creep * k * k * time), 0.02);
  }
}

TEST(Trails, WearTheGroundAlongTheirLineOnly) {
  const std::vector<Trail> trails{{{-100, 31}, {90, 31}}};
  const int texels = 256;
  const std::vector<uint8_t> wear = trail_wear(trails, texels, 256);  // 1 m texels
  const auto at = [&](int x, int y) { return wear[size_t(128 - y) * texels + size_t(x + 128)]; };
  for (int x = -99; x < 89; ++x) {
    EXPECT_GT(at(x, 31), 200) << x;
    EXPECT_EQ(at(x, 36), 0) << x;
    EXPECT_EQ(at(x, 26), 0) << x;
  }
  EXPECT_EQ(at(-110, 31), 0);
  EXPECT_EQ(at(100, 31), 0);
}

TEST(Trails, GoAroundASteepHill) {
  // The straight line between the way points would climb 120 m.
  const Grid heights = from_function(513, 10, [](glm::vec2 p) {
    const float d = glm::length(p - glm::vec2(175, 400));
    return 120 * std::exp(-d * d / 20000);
  });
  float highest = 0;
  for (const Trail& trail : find_trails(heights, 1)) {
    ASSERT_GT(trail.size(), 100u);
    for (const glm::vec2 p : trail) highest = std::max(highest, heights.bilinear(p));
  }
  EXPECT_LT(highest, 40);
}

TEST(GenerateMeadow, RefusesBadOptions) {
  const auto refused = [](auto change, const char* word) {
    GeneratorOptions options;
    change(options);
    const auto result = generate_meadow(options);
    ASSERT_FALSE(result) << word;
    EXPECT_NE(result.error().message.find(word), std::string::npos) << result.error().message;
  };
  for (const int samples : {-1, 0, 64, 8194}) refused([&](auto& o) { o.samples = samples; }, "65 to 8193");
  for (const int texels : {-7, 0, 63, 8193}) refused([&](auto& o) { o.map_texels = texels; }, "64 to 8192");
  for (const double size :
       {0.0, -4096.0, 63.0, 2.0e6, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    refused([&](auto& o) { o.size_m = size; }, "64 to 1000000");
}

// The default place, made once for all that looks at it.
struct Place {
  Relief relief = make_relief(1, {});
  Grid surface = sample_surface(relief, 1025, 1, 0);
  Paint paint = paint_ground(relief, surface, 2048, 1, 0, {});
};

const Place& default_place() {
  static const Place place;
  return place;
}

TEST(GenerateMeadow, SameBitsForTheSameOptionsWhateverTheThreads) {
  const Relief& relief = default_place().relief;
  const Relief again = make_relief(1, {});
  EXPECT_EQ(hash_bytes(relief.heights.values), hash_bytes(again.heights.values));
  EXPECT_EQ(hash_bytes(relief.area.values), hash_bytes(again.area.values));
  const Grid one = sample_surface(relief, 257, 1, 1);
  const Grid five = sample_surface(again, 257, 1, 5);
  EXPECT_EQ(hash_bytes(one.values), hash_bytes(five.values));
  const Paint alone = paint_ground(relief, one, 300, 1, 1, {});
  const Paint shared = paint_ground(again, five, 300, 1, 5, {});
  EXPECT_EQ(hash_bytes(alone.texels), hash_bytes(shared.texels));

  // Another seed: another place, not the same one with other details.
  const Relief other = make_relief(8, {});
  double difference = 0;
  for (size_t i = 0; i < relief.heights.values.size(); ++i)
    difference += std::abs(double(relief.heights.values[i] - other.heights.values[i]));
  EXPECT_GT(difference / double(relief.heights.values.size()), 8);
}

TEST(GenerateMeadow, KeepsItsShapeAtAnotherSizeAndReportsProgress) {
  GeneratorOptions options;
  options.samples = 129;
  options.map_texels = 96;
  options.size_m = 1024;
  std::vector<float> reports;
  const auto place = generate_meadow(options, [&](float done) { reports.push_back(done); });
  ASSERT_TRUE(place) << place.error().message;
  EXPECT_EQ(place->field.desc().columns, 129);
  EXPECT_EQ(place->field.desc().rows, 129);
  EXPECT_DOUBLE_EQ(place->field.desc().spacing.x, 8);
  EXPECT_NEAR(place->field.height_range().y - place->field.height_range().x, 150, 15);
  EXPECT_TRUE(place->colors.validate());
  EXPECT_EQ(place->colors.width, 96);
  EXPECT_EQ(place->colors.min_corner, glm::dvec2(-512));
  EXPECT_EQ(place->colors.size, glm::dvec2(1024));
  ASSERT_GE(reports.size(), 4u);
  EXPECT_LE(reports.size(), 500u);
  EXPECT_TRUE(std::is_sorted(reports.begin(), reports.end()));
  EXPECT_EQ(reports.back(), 1.0f);
}

double slope_degrees(const Grid& surface, int column, int row) {
  return std::atan(double(glm::length(gradient(surface, column, row)))) * k_degrees;
}

void check_centre(const Grid& surface) {
  int count = 0, gentle = 0, flat = 0;
  for (int row = 0; row < surface.side; ++row) {
    for (int column = 0; column < surface.side; ++column) {
      if (glm::length(surface.position(column, row)) > 350) continue;
      const double slope = slope_degrees(surface, column, row);
      ++count;
      gentle += slope < 12;
      flat += slope < 1;
    }
  }
  EXPECT_GT(double(gentle) / count, 0.9);
  EXPECT_LT(double(flat) / count, 0.2);  // it rolls
}

// Elevation in degrees of the skyline seen from 1.7 m above the middle.
double skyline(const Grid& surface, double azimuth) {
  const double eye = double(surface.bilinear({0, 0})) + 1.7;
  double highest = -90;
  for (double d = 20; d < 2000; d += 4) {
    const glm::vec2 p(float(d * std::cos(azimuth)), float(d * std::sin(azimuth)));
    highest = std::max(highest, std::atan((double(surface.bilinear(p)) - eye) / d) * k_degrees);
  }
  return highest;
}

// Correlation of two curvature fields, one moved by `shift` samples: near 1 where a pattern repeats.
double self_correlation(const Grid& surface, glm::ivec2 shift) {
  const auto curvature = [&](int column, int row) {
    return double(surface.at(column + 1, row) + surface.at(column - 1, row) + surface.at(column, row + 1) +
                  surface.at(column, row - 1) - 4 * surface.at(column, row));
  };
  double both = 0, first = 0, second = 0;
  for (int row = 1; row + 1 + shift.y < surface.side; row += 2) {
    for (int column = 1; column + 1 + shift.x < surface.side; column += 2) {
      const double a = curvature(column, row), b = curvature(column + shift.x, row + shift.y);
      both += a * b;
      first += a * a;
      second += b * b;
    }
  }
  return both / std::sqrt(first * second);
}

TEST(GenerateMeadow, HasTheShapeOfAPlace) {
  const Grid& surface = default_place().surface;
  const auto [low, high] = std::minmax_element(surface.values.begin(), surface.values.end());
  ASSERT_TRUE(std::all_of(surface.values.begin(), surface.values.end(), [](float z) { return std::isfinite(z); }));
  EXPECT_GT(*high - *low, 400);
  EXPECT_LT(*high - *low, 680);
  check_centre(surface);
  // A mountain view to the north, an open one to the south.
  for (const double azimuth : {60.0, 95.0, 130.0}) EXPECT_GT(skyline(surface, azimuth / k_degrees), 8) << azimuth;
  EXPECT_LT(skyline(surface, 270 / k_degrees), 4);
  for (const int shift : {64, 128, 256, 512}) {
    EXPECT_LT(std::abs(self_correlation(surface, {shift, 0})), 0.1) << shift;
    EXPECT_LT(std::abs(self_correlation(surface, {0, shift})), 0.1) << shift;
    EXPECT_LT(std::abs(self_correlation(surface, {shift, shift})), 0.1) << shift;
  }
  // Valleys drain: hardly a sample of the eroded ground lies below all of its neighbours.
  const Grid& ground = default_place().relief.heights;
  int pits = 0;
  for (int row = 1; row + 1 < ground.side; ++row) {
    for (int column = 1; column + 1 < ground.side; ++column) {
      bool pit = true;
      for (int k = 0; k < 9 && pit; ++k)
        pit = k == 4 || ground.at(column + k % 3 - 1, row + k / 3 - 1) > ground.at(column, row);
      pits += pit;
    }
  }
  EXPECT_LT(pits, ground.side * ground.side / 1000);
}

TEST(GenerateMeadow, PaintsFiveKindsOfGroundThatColourTellsApart) {
  const Place& place = default_place();
  std::array<double, k_grounds> count{}, saturation{}, value{}, hue_x{}, hue_y{}, agree{};
  for (size_t i = 0; i < place.paint.texels.size(); ++i) {
    const glm::u8vec4 texel = place.paint.texels[i];
    ASSERT_EQ(texel.w, 255);
    const size_t ground = size_t(place.paint.ground[i]);
    const Hsv hsv = hsv_of(texel);
    count[ground] += 1;
    saturation[ground] += hsv.saturation;
    value[ground] += hsv.value;
    hue_x[ground] += std::cos(hsv.hue / k_degrees);
    hue_y[ground] += std::sin(hsv.hue / k_degrees);
    agree[ground] += nearest_ground(texel) == Ground(ground);
  }
  const double all = double(place.paint.texels.size());
  const auto share = [&](Ground g) { return count[size_t(g)] / all; };
  EXPECT_GT(share(Ground::grass) + share(Ground::dry_grass), 0.45);
  EXPECT_LT(share(Ground::grass) + share(Ground::dry_grass), 0.70);
  EXPECT_GT(share(Ground::dry_grass), 0.10);
  EXPECT_GT(share(Ground::soil), 0.04);
  EXPECT_GT(share(Ground::rock), 0.12);
  EXPECT_GT(share(Ground::snow), 0.015);
  EXPECT_LT(share(Ground::snow), 0.12);

  struct Range {
    double hue_low, hue_high, saturation_low, saturation_high, value_low, value_high;
  };
  constexpr std::array<Range, k_grounds> k_ranges{{{70, 95, 0.35, 0.55, 0.35, 0.5},
                                                   {45, 53, 0.35, 0.5, 0.48, 0.65},
                                                   {27, 34, 0.3, 0.48, 0.35, 0.52},
                                                   {0, 360, 0, 0.1, 0.35, 0.55},
                                                   {0, 360, 0, 0.1, 0.8, 1}}};
  for (size_t g = 0; g < k_grounds; ++g) {
    const double hue = std::fmod(std::atan2(hue_y[g], hue_x[g]) * k_degrees + 360, 360);
    const Range& range = k_ranges[g];
    EXPECT_TRUE(hue > range.hue_low && hue < range.hue_high) << g << ": hue " << hue;
    const double s = saturation[g] / count[g], v = value[g] / count[g];
    EXPECT_TRUE(s >= range.saturation_low && s < range.saturation_high) << g << ": saturation " << s;
    EXPECT_TRUE(v >= range.value_low && v <= range.value_high) << g << ": value " << v;
    EXPECT_GT(agree[g] / count[g], 0.85) << g;
  }
}

TEST(GenerateMeadow, GroundFollowsTheLand) {
  const Place& place = default_place();
  const int texels = 2048;
  std::array<double, k_grounds> count{}, height{}, slope{};
  for (int row = 1; row + 1 < texels; row += 3) {
    for (int column = 1; column + 1 < texels; column += 3) {
      const size_t g = size_t(place.paint.ground[size_t(row) * texels + size_t(column)]);
      count[g] += 1;
      height[g] += double(place.surface.at(column / 2, row / 2));
      slope[g] += slope_degrees(place.surface, column / 2, row / 2);
    }
  }
  const auto mean = [&](const auto& sum, Ground g) { return sum[size_t(g)] / count[size_t(g)]; };
  EXPECT_GT(mean(height, Ground::snow), mean(height, Ground::rock) + 60);
  EXPECT_GT(mean(height, Ground::rock), mean(height, Ground::grass) + 100);
  EXPECT_GT(mean(slope, Ground::rock), 28);
  EXPECT_LT(mean(slope, Ground::grass), 14);
  EXPECT_LT(mean(slope, Ground::dry_grass), 16);
  // Mottled at the scale of a texel: neighbours are hardly ever equal, and many colours occur.
  std::set<uint32_t> colors;
  int equal = 0, pairs = 0;
  for (int row = 0; row < texels; row += 5) {
    for (int column = 0; column + 1 < texels; column += 5) {
      const glm::u8vec4* texel = &place.paint.texels[size_t(row) * texels + size_t(column)];
      colors.insert(uint32_t(texel->x) << 16 | uint32_t(texel->y) << 8 | texel->z);
      equal += texel[0] == texel[1];
      ++pairs;
    }
  }
  EXPECT_LT(double(equal) / pairs, 0.05);
  EXPECT_GT(colors.size(), 5000u);
}

}  // namespace
