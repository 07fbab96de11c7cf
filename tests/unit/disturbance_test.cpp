// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Ground that remembers: brushes, decay, levels, memory, files.

#include <sward/vegetation/disturbance.h>

#include <gtest/gtest.h>
#include <sward/vegetation/species.h>

#include <unistd.h>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <filesystem>
#include <fstream>
#include <vector>

#include "vegetation/disturbance_tiles.h"

namespace sward {
namespace {

Disturbance make(const DisturbanceOptions& options = {}) {
  auto made = Disturbance::create(options);
  EXPECT_TRUE(made) << made.error().message;
  return std::move(*made);
}

#define EXPECT_DONE(call)                            \
  do {                                               \
    const auto outcome = (call);                     \
    EXPECT_TRUE(outcome) << outcome.error().message; \
  } while (false)

float depth(const Disturbed& d) {
  return glm::length(d.press);
}

/// What is seen of a decayed amount (common_disturbed.glsl).
double seen(double amount) {
  return std::max(amount - 0.02, 0.0) / 0.98;
}

TEST(Disturbance, BrushesDoWhatTheySay) {
  Disturbance d = make();
  EXPECT_DONE(d.press_capsule({0, 0}, {10, 0}, 0.4, 1));
  EXPECT_DONE(d.cut_capsule({0, 5}, {10, 5}, 0.5, 0.05f));
  EXPECT_DONE(d.burn_disc({5, 10}, 1, 1));
  EXPECT_DONE(d.wet_disc({5, 15}, 1, 0.5f));
  EXPECT_DONE(d.paint_disc({5, 20}, 1, {1, 0.5f, 0}, 1));
  const Disturbed middle = d.at({5.03, 0.0});
  EXPECT_NEAR(depth(middle), 1.0, 0.03);
  EXPECT_GT(middle.press.x, 0.95f);  // the way of the brush
  // Out from the line, on both sides.
  EXPECT_GT(d.at({5, 0.2}).press.y, 0.15f);
  EXPECT_LT(d.at({5, -0.2}).press.y, -0.15f);
  EXPECT_NEAR(0.25 * (1 / d.at({5, 5}).cut - 1), 0.05, 0.002);
  EXPECT_NEAR(d.at({5, 10}).burn, 1, 1e-5);
  EXPECT_NEAR(d.at({5, 15}).wet, seen(0.5), 0.01);
  EXPECT_NEAR(d.at({5, 20}).paint.y, 0.5, 0.01);
  EXPECT_NEAR(d.at({5, 20}).paint.w, 1, 1e-5);
  // And nothing elsewhere.
  for (const double y : {-1.0, 3.0, 7.5, 12.5, 17.5, 22.0}) {
    const Disturbed none = d.at({5, y});
    EXPECT_EQ(depth(none) + none.cut + none.burn + none.wet + none.paint.w, 0.0f) << y;
  }
}

TEST(Disturbance, DiscsAndBlastsPressOutwards) {
  Disturbance d = make();
  EXPECT_DONE(d.explode({100, -50}, 6));
  for (int i = 0; i < 16; ++i) {
    const double a = i * 0.3927;
    const glm::dvec2 out(std::cos(a), std::sin(a));
    const Disturbed at = d.at(glm::dvec2(100, -50) + out * 3.0);
    EXPECT_GT(glm::dot(glm::dvec2(at.press), out), 0.98 * double(depth(at))) << i;
    EXPECT_GT(depth(at), 0.5f);
    EXPECT_EQ(d.at(glm::dvec2(100, -50) + out * 3.0).burn, 0.0f);
  }
  EXPECT_NEAR(d.at({100, -50}).burn, 1, 1e-5);
  EXPECT_EQ(depth(d.at({106.2, -50})), 0.0f);
}

TEST(Disturbance, StrongerStaysAndTouchingTwiceIsTouchingOnce) {
  Disturbance once = make(), often = make();
  EXPECT_DONE(once.press_capsule({0, 0}, {3, 1}, 0.3, 0.8f));
  for (int i = 0; i < 20; ++i) EXPECT_DONE(often.press_capsule({0, 0}, {3, 1}, 0.3, 0.8f));
  EXPECT_DONE(often.press_capsule({3, 1}, {0, 0}, 0.3, 0.3f));
  for (double x = -0.5; x < 3.5; x += 0.11) EXPECT_EQ(once.at({x, 0.4}).press, often.at({x, 0.4}).press);
}

TEST(Disturbance, HalfLivesAreRightWhateverTheStep) {
  for (const double step : {1.0 / 240, 1.0 / 60, 1.0 / 7, 1.0, 30.0, 60.0}) {
    DisturbanceOptions options;
    options.press_half_life_s = 60;
    options.wet_half_life_s = 120;
    Disturbance d = make(options);
    EXPECT_DONE(d.advance(11));
    DisturbanceTouch touch;
    touch.press = 1;
    touch.wet = 1;
    touch.way = {0, 1};
    EXPECT_DONE(d.touch({{0, 0}, {0, 0}, 2, 0}, touch));
    const auto steps = size_t(std::lround(60 / step));
    for (size_t i = 0; i < steps; ++i) EXPECT_DONE(d.advance(step));
    const double left = std::exp2(-double(steps) * step / 60);
    EXPECT_NEAR(depth(d.at({0.1, 0.1})), seen(left), 1e-4) << step;
    EXPECT_NEAR(d.at({0.1, 0.1}).wet, seen(std::sqrt(left)), 1e-4) << step;
    for (size_t i = 0; i < steps; ++i) EXPECT_DONE(d.advance(step));
    EXPECT_NEAR(depth(d.at({0.1, 0.1})), seen(left * left), 1e-4) << step;
  }
}

TEST(Disturbance, AStandingFootHoldsAndThenDecaysAlikeAtEveryRate) {
  // What stands on the ground refreshes its cells every frame: neither may anything pile up, nor water that is there
  // stop drying.
  double end[3], wet[3];
  int at = 0;
  for (const int rate : {30, 60, 240}) {
    Disturbance d = make();
    EXPECT_DONE(d.wet_disc({0, 0}, 1, 1));
    for (int i = 0; i < 10 * rate; ++i) {
      EXPECT_DONE(d.press_disc({0, 0}, 0.3, 0.9f));
      EXPECT_DONE(d.advance(1.0 / rate));
    }
    EXPECT_DONE(d.advance(300));
    end[at] = depth(d.at({0.1, 0.15}));
    wet[at++] = d.at({0, 0}).wet;
  }
  EXPECT_NEAR(end[0], end[1], 2e-4);
  EXPECT_NEAR(end[0], end[2], 2e-4);
  EXPECT_NEAR(wet[0], wet[2], 1e-5);
  EXPECT_NEAR(wet[0], seen(std::exp2(-310.0 / 900)), 1e-3);
}

TEST(Disturbance, CutsAndBurnsStayUntilTheyRegrow) {
  Disturbance d = make();
  EXPECT_DONE(d.cut_capsule({0, 0}, {40, 0}, 2, 0.05f));
  EXPECT_DONE(d.burn_disc({60, 0}, 3, 1));
  const float cut = d.at({20, 0}).cut;
  for (int i = 0; i < 30; ++i) EXPECT_DONE(d.advance(900000));
  EXPECT_EQ(d.at({20, 0}).cut, cut);
  EXPECT_EQ(d.at({60, 0}).burn, 1.0f);
  EXPECT_DONE(d.regrow({60, 0}, 10, 100));
  EXPECT_DONE(d.regrow({0, 0}, 10, 100));
  EXPECT_DONE(d.advance(50));
  EXPECT_NEAR(d.at({60, 0}).burn, 0.5, 0.002);
  EXPECT_NEAR(d.at({5, 0}).cut, 0.5 * double(cut), 0.004);
  EXPECT_EQ(d.at({20, 0}).cut, cut);
  // A new cut ends regrowth where it is.
  EXPECT_DONE(d.cut_capsule({4, 0}, {6, 0}, 1, 0.05f));
  EXPECT_DONE(d.advance(60));
  EXPECT_EQ(d.at({60, 0}).burn, 0.0f);
  EXPECT_EQ(d.at({1, 0}).cut, 0.0f);
  EXPECT_EQ(d.at({5, 0}).cut, cut);
  EXPECT_DONE(d.regrow_all(0));
  EXPECT_DONE(d.advance(1));
  EXPECT_EQ(d.stats().tiles, 0u);
  EXPECT_EQ(d.stats().bytes, 0u);
}

/// Feet of a walker, 1.4 m/s, ten positions a second.
size_t walk(Disturbance& d, double metres, size_t* most_tiles = nullptr) {
  size_t most = 0;
  const double pace = 0.14;
  for (double s = 0; s < metres; s += pace) {
    const double side = 0.12 * (std::fmod(s, 1.5) < 0.75 ? 1 : -1);
    // A wide curve, so that it never meets its own track.
    const double a = s / 4000;
    const glm::dvec2 place(4000 * std::sin(a), -4000 * std::cos(a)), way(std::cos(a), std::sin(a));
    const glm::dvec2 foot = place + glm::dvec2(-way.y, way.x) * side;
    EXPECT_TRUE(d.press_capsule(foot, foot + way * 0.25, 0.12, 0.9f));
    EXPECT_TRUE(d.advance(pace / 1.4));
    most = std::max(most, d.stats().bytes);
    if (most_tiles != nullptr) *most_tiles = std::max(*most_tiles, d.stats().tiles);
  }
  return most;
}

TEST(Disturbance, TenKilometresOfTramplingStayBounded) {
  Disturbance d = make();
  size_t tiles = 0;
  const size_t most = walk(d, 10000, &tiles);
  std::printf("10 km: at most %.2f MB in %zu tiles, %zu tiles let go\n", double(most) / 1e6, tiles,
              size_t(d.stats().decayed));
  EXPECT_LT(most, 5.0e6);
  EXPECT_GT(d.stats().decayed, 2000u);
  EXPECT_EQ(d.stats().dropped, 0u);
  // Nothing is left once all has risen.
  EXPECT_DONE(d.advance(10000));
  EXPECT_EQ(d.stats().tiles, 0u);
  EXPECT_EQ(d.stats().bytes, 0u);
}

TEST(Disturbance, AtTheLimitTheFinestOldestTracksGoFirstAndCoarseOnesRemain) {
  DisturbanceOptions options;
  options.press_half_life_s = 1e6;
  options.memory_limit = 2u << 20;
  Disturbance d = make(options);
  EXPECT_DONE(d.cut_capsule({-20, 0}, {20, 0}, 1, 0.05f));
  const glm::dvec2 begin(0, -4000);
  const size_t most = walk(d, 5000);
  EXPECT_LE(most, options.memory_limit);
  EXPECT_GT(d.stats().dropped, 500u);
  EXPECT_EQ(d.stats().refused, 0u);
  EXPECT_GT(d.at({5, 0}).cut, 0.5f);
  // The first steps' own cells are gone, their mean is not.
  const TileKey fine{0, glm::ivec2(glm::floor((begin + glm::dvec2(1, 0)) / tile_m(0)))};
  EXPECT_EQ(d.tiles().find(fine), nullptr);
  TileKey found;
  EXPECT_NE(d.tiles().holder(fine, found), nullptr);
}

TEST(Disturbance, FullOfCutsItRefusesAndKeepsThem) {
  DisturbanceOptions options;
  options.memory_limit = 1u << 20;
  Disturbance d = make(options);
  int done = 0;
  std::string message;
  for (; done < 4000; ++done) {
    const double y = 3.0 * done;
    if (const auto cut = d.cut_capsule({0, y}, {100, y}, 0.5, 0.05f); !cut) {
      message = cut.error().message;
      break;
    }
  }
  EXPECT_LT(done, 4000);
  EXPECT_NE(message.find("regrow"), std::string::npos) << message;
  EXPECT_EQ(d.stats().refused, 1u);
  EXPECT_LE(d.stats().bytes, options.memory_limit);
  for (int i = 0; i < done; ++i) EXPECT_GT(d.at({50, 3.0 * i}).cut, 0.5f) << i;
  EXPECT_EQ(d.at({50, 3.0 * done}).cut, 0.0f);
  EXPECT_DONE(d.regrow_all(0));
  EXPECT_DONE(d.cut_capsule({0, 0}, {100, 0}, 0.5, 0.05f));
}

TEST(Disturbance, CoarserLevelsHoldTheMean) {
  Disturbance d = make();
  EXPECT_DONE(d.cut_capsule({3.1, 2.2}, {17.3, 9.1}, 0.7, 0.05f));
  EXPECT_DONE(d.burn_disc({-7, -3}, 2.5, 1));
  const DisturbanceTiles& tiles = d.tiles();
  const CellClock clock = tiles.clock();
  for (int y = -4; y < 6; ++y) {
    for (int x = -6; x < 10; ++x) {
      double cut = 0, burn = 0;
      for (int i = 0; i < 256; ++i) {
        const Disturbed fine = tiles.cell(0, glm::i64vec2(x * 16 + i % 16, y * 16 + i / 16), clock);
        cut += fine.cut / 256.0;
        burn += fine.burn / 256.0;
      }
      const Disturbed coarse = tiles.cell(2, {x, y}, clock);
      EXPECT_NEAR(coarse.cut, cut, 1.5 / 255) << x << " " << y;
      EXPECT_NEAR(coarse.burn, burn, 1.5 / 255);
    }
  }
}

TEST(Disturbance, LargeBrushesAreCoarseAndReachFinerTiles) {
  Disturbance d = make();
  EXPECT_DONE(d.press_capsule({30, 0}, {32, 0}, 0.3, 1));
  EXPECT_DONE(d.burn_disc({0, 0}, 200, 1));
  EXPECT_LT(d.stats().bytes, 2.5e6);
  EXPECT_NEAR(d.at({31, 0}).burn, 1, 1e-5);
  EXPECT_GT(depth(d.at({31, 0})), 0.9f);
  EXPECT_NEAR(d.at({-90, 40}).burn, 1, 1e-5);
  EXPECT_EQ(d.at({-190, 90}).burn, 0.0f);
  // Walking there afterwards keeps what the coarse cells say.
  EXPECT_DONE(d.press_capsule({-30, 0}, {-32, 0}, 0.3, 1));
  EXPECT_NEAR(d.at({-31, 0}).burn, 1, 1e-5);
  EXPECT_GT(depth(d.at({-31, 0})), 0.9f);
}

TEST(Disturbance, NoSeamAtTileAndLevelBorders) {
  Disturbance d = make();
  // A soft spot across many tiles: neighbours half a cell apart may differ by the slope of its rim alone.
  EXPECT_DONE(d.burn_disc({0, 0}, 12, 1));
  EXPECT_DONE(d.rotor_wash({0, 0}, 12, 1));
  const double step = 0.05, slope = 2.0 / (0.4 * 12);  // smoothstep's steepest is 1.5; cells and bytes add a little
  for (double x = -14; x < 14; x += step) {
    const Disturbed a = d.at({x, 1.3}), b = d.at({x + step, 1.3});
    EXPECT_NEAR(a.burn, b.burn, slope * step + 0.008) << x;
    EXPECT_LT(glm::length(a.press - b.press), 0.12f) << x;
  }
  // Across the levels' borders: a uniform patch stays uniform, whatever level shows it.
  for (double x = -12; x < 250; x += 0.37) {
    const Disturbed at = d.at({0, 0}, {x, 0});
    if (x > 238.05) {
      EXPECT_EQ(at.burn, 0.0f) << x;
    }
    if (x < 170) {
      EXPECT_NEAR(at.burn, 1, 0.02) << x;
    }
  }
  for (double x = 0; x < 250; x += 0.37)
    EXPECT_NEAR(d.at({4, 3}, {4 + x, 3}).burn, d.at({4, 3}, {4.37 + x, 3}).burn, 0.05) << x;
}

TEST(Disturbance, FarFromTheOriginIsTheSame) {
  Disturbance near = make(), far = make();
  const glm::dvec2 there(1.0e7, -9.0e6);
  EXPECT_DONE(near.press_capsule({1, 2}, {5, 4}, 0.3, 0.9f));
  EXPECT_DONE(far.press_capsule(there + glm::dvec2(1, 2), there + glm::dvec2(5, 4), 0.3, 0.9f));
  for (double x = 0; x < 6; x += 0.17)
    EXPECT_LT(glm::length(near.at({x, 3}).press - far.at(there + glm::dvec2(x, 3)).press), 1e-5f) << x;
  EXPECT_GT(depth(near.at({3, 3})), 0.8f);
}

TEST(Disturbance, BadNumbersAreRefusedAndChangeNothing) {
  Disturbance d = make();
  const double nan = std::nan(""), inf = INFINITY;
  for (const double bad : {nan, inf, -inf, 1.1e9}) {
    EXPECT_FALSE(d.press_capsule({bad, 0}, {0, 0}, 1, 1));
    EXPECT_FALSE(d.press_capsule({0, 0}, {0, bad}, 1, 1));
  }
  for (const double bad : {nan, inf, 0.0, -1.0, 1001.0}) EXPECT_FALSE(d.burn_disc({0, 0}, bad, 1));
  for (const float bad : {float(nan), float(inf), -0.1f, 1.1f}) {
    EXPECT_FALSE(d.press_disc({0, 0}, 1, bad));
    EXPECT_FALSE(d.wet_disc({0, 0}, 1, bad));
    EXPECT_FALSE(d.paint_disc({0, 0}, 1, {bad, 0, 0}, 1));
  }
  EXPECT_FALSE(d.cut_capsule({0, 0}, {1, 0}, 1, float(nan)));
  EXPECT_FALSE(d.cut_capsule({-1e8, 0}, {1e8, 0}, 1, 0.1f));  // too long
  for (const double bad : {nan, inf, -1.0, 2e6}) {
    EXPECT_FALSE(d.advance(bad));
    EXPECT_FALSE(d.regrow_all(bad));
  }
  EXPECT_FALSE(d.regrow({nan, 0}, 1, 1));
  EXPECT_EQ(d.revision(), 0u);
  EXPECT_EQ(d.time(), 0.0);
  EXPECT_EQ(d.stats().tiles, 0u);
  EXPECT_FALSE(Disturbance::create({0.5f, 900, 64u << 20}));
  EXPECT_FALSE(Disturbance::create({300, float(nan), 64u << 20}));
  EXPECT_FALSE(Disturbance::create({300, 900, 1000}));
}

TEST(Disturbance, TheEpochMovesOn) {
  DisturbanceOptions options;
  options.press_half_life_s = 1e6;
  Disturbance d = make(options), fresh = make(options);
  for (int i = 0; i < 15; ++i) EXPECT_DONE(d.advance(1e6));
  EXPECT_DONE(d.burn_disc({9, 0}, 1, 1));
  EXPECT_DONE(d.regrow({9, 0}, 2, 1e6));
  EXPECT_DONE(d.press_disc({0, 0}, 1, 1));
  EXPECT_DONE(fresh.press_disc({0, 0}, 1, 1));
  for (int i = 0; i < 2; ++i) {
    EXPECT_DONE(d.advance(4e5));
    EXPECT_DONE(fresh.advance(4e5));
  }
  EXPECT_GT(d.tiles().epoch, 0.0);
  EXPECT_NEAR(depth(d.at({0.3, 0})), depth(fresh.at({0.3, 0})), 1e-6);
  EXPECT_NEAR(d.at({9, 0}).burn, 0.2, 0.01);
}

struct TemporaryFile {
  std::string path =
      (std::filesystem::temp_directory_path() / ("sward_disturbance_" + std::to_string(::getpid()))).string();
  ~TemporaryFile() { std::filesystem::remove(path); }
};

TEST(Disturbance, SavesAndLoads) {
  const TemporaryFile file;
  Disturbance d = make(), other = make();
  EXPECT_DONE(d.advance(77.25));
  EXPECT_DONE(d.press_capsule({1, 2}, {5, 4}, 0.3, 0.9f));
  EXPECT_DONE(d.cut_capsule({0, 5}, {10, 5}, 0.5, 0.05f));
  EXPECT_DONE(d.paint_disc({5, 20}, 1, {1, 0.5f, 0}, 1));
  EXPECT_DONE(d.regrow({0, 5}, 3, 500));
  EXPECT_DONE(d.advance(30));
  EXPECT_DONE(d.save(file.path));
  EXPECT_DONE(other.burn_disc({100, 100}, 2, 1));
  EXPECT_DONE(other.load(file.path));
  EXPECT_EQ(other.time(), d.time());
  EXPECT_EQ(other.at({100, 100}).burn, 0.0f);
  for (int again = 0; again < 2; ++again) {
    for (double y = 0; y < 22; y += 0.31)
      for (double x = -1; x < 11; x += 0.31) {
        const Disturbed a = d.at({x, y}), b = other.at({x, y});
        EXPECT_TRUE(a.press == b.press && a.cut == b.cut && a.burn == b.burn && a.wet == b.wet && a.paint == b.paint);
      }
    EXPECT_EQ(d.stats().bytes, other.stats().bytes);
    EXPECT_DONE(d.advance(1000));
    EXPECT_DONE(other.advance(1000));
  }
}

TEST(Disturbance, OtherFilesAreRefusedAndChangeNothing) {
  const TemporaryFile file;
  Disturbance d = make();
  EXPECT_DONE(d.burn_disc({1, 1}, 2, 1));
  EXPECT_FALSE(d.load("/nowhere/at/all"));
  EXPECT_FALSE(d.save("/nowhere/at/all"));
  const auto refuses = [&](const std::string& bytes, const char* because) {
    std::ofstream(file.path, std::ios::binary) << bytes;
    const auto loaded = d.load(file.path);
    ASSERT_FALSE(loaded) << because;
    EXPECT_NE(loaded.error().message.find(because), std::string::npos) << loaded.error().message;
    EXPECT_NE(loaded.error().message.find(file.path), std::string::npos);
    EXPECT_EQ(d.at({1, 1}).burn, 1.0f);
  };
  refuses("", "truncated");
  refuses(std::string(48, 'x'), "no disturbance file");
  EXPECT_DONE(d.save(file.path));
  std::ifstream stream(file.path, std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(stream), {}};
  std::string later = whole;
  later[0] = 2;
  refuses(later, "version 2");
  refuses(whole.substr(0, whole.size() / 2), "truncated or damaged");
  refuses(whole + "x", "damaged");
  std::string flipped = whole;
  flipped[whole.size() - 9] = char(flipped[whole.size() - 9] ^ 4);
  refuses(flipped, "damaged");
}

TEST(Disturbance, SpeciesResistByKindAndHeight) {
  Species species;
  EXPECT_EQ(resistance_of(species), 0.0f);
  species.height_m = {1, 2.75f};
  EXPECT_FLOAT_EQ(resistance_of(species), 0.5f);
  species.height_m = {5, 9};
  EXPECT_EQ(resistance_of(species), 1.0f);
  species.height_m = {0.2f, 0.4f};
  species.kind = PlantKind::billboard;
  EXPECT_EQ(resistance_of(species), 1.0f);
  species.resistance = 0.25f;
  EXPECT_EQ(resistance_of(species), 0.25f);
}

}  // namespace
}  // namespace sward
