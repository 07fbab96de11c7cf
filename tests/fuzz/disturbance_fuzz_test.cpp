// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Random brushes, times and damaged files: done or refused, never a crash, a lost cell or a wrong count of bytes.

#include <gtest/gtest.h>
#include <sward/vegetation/disturbance.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "vegetation/disturbance_tiles.h"

namespace sward {
namespace {

int runs() {
  const char* given = std::getenv("SWARD_FUZZ_RUNS");
  return given == nullptr ? 4000 : std::atoi(given);
}

/// Numbers that hurt, among ordinary ones.
class Numbers {
 public:
  explicit Numbers(uint32_t seed) : random_(seed) {}
  double any() {
    const double odd[] = {0.0, -0.0, NAN, INFINITY, -INFINITY, 1e-300, 1e300,
                          1e7, -1e7, 1e9, 1.0001e9, 1000,      0.125,  -1};
    return pick(4) == 0 ? odd[pick(std::size(odd))] : within(-60, 60);
  }
  double radius() { return pick(5) == 0 ? any() : pick(40) == 0 ? within(50, 1000) : within(0.01, 6); }
  float share() { return pick(8) == 0 ? float(any()) : float(within(0, 1)); }
  double within(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  size_t pick(size_t count) { return random_() % count; }

 private:
  std::mt19937 random_;
};

/// What must hold of the tiles after any call.
void expect_sound(const Disturbance& d) {
  const DisturbanceTiles& tiles = d.tiles();
  size_t bytes = 0;
  for (const auto& [packed, tile] : tiles.map) {
    bytes += tile.bytes();
    EXPECT_EQ(TileKey::unpack(packed).packed(), packed);
    EXPECT_LT(TileKey::unpack(packed).level, k_tile_levels);
  }
  EXPECT_EQ(bytes, tiles.bytes);
}

bool is_sound(const Disturbed& d) {
  for (const float v : {d.cut, d.burn, d.wet, d.paint.x, d.paint.y, d.paint.z, d.paint.w})
    if (!(v >= 0 && v <= 1.001f)) return false;
  return glm::length(d.press) <= 1.01f;
}

Expected<void> random_call(Disturbance& d, Numbers& n) {
  const glm::dvec2 a(n.any(), n.any()), b = n.pick(2) == 0 ? a : glm::dvec2(n.any(), n.any());
  switch (n.pick(10)) {
    case 0:
      return d.press_capsule(a, b, n.radius(), n.share());
    case 1:
      return d.cut_capsule(a, b, n.radius(), float(n.any()));
    case 2:
      return d.burn_disc(a, n.radius(), n.share());
    case 3:
      return d.wet_disc(a, n.radius(), n.share());
    case 4:
      return d.paint_disc(a, n.radius(), {n.share(), n.share(), n.share()}, n.share());
    case 5:
      return d.explode(a, n.radius());
    case 6:
      return d.advance(n.pick(3) == 0 ? n.any() : n.within(0, 300));
    case 7:
      return d.regrow(a, n.radius(), n.any());
    case 8:
      return n.pick(10) == 0 ? d.regrow_all(n.any()) : d.rotor_wash(a, n.radius(), n.share());
    default: {
      DisturbanceTouch touch;
      touch.press = n.share();
      touch.way = {float(n.any()), float(n.any())};
      touch.inwards = n.pick(2) == 0;
      touch.burn = n.share();
      return d.touch({a, b, n.radius(), n.share()}, touch);
    }
  }
}

TEST(DisturbanceFuzz, BrushesAreDoneOrRefused) {
  DisturbanceOptions options;
  options.memory_limit = 8u << 20;
  auto d = Disturbance::create(options);
  ASSERT_TRUE(d);
  Numbers n(11);
  int done = 0, refused = 0;
  for (int i = 0; i < runs(); ++i) {
    const uint64_t before = d->revision();
    const double time = d->time();
    const Expected<void> outcome = random_call(*d, n);
    if (!outcome) {
      EXPECT_FALSE(outcome.error().message.empty());
      // A blast is two brushes: the second may fail for want of memory alone.
      if (d->stats().refused == 0) {
        EXPECT_EQ(d->revision(), before);
      }
      EXPECT_EQ(d->time(), time);
    }
    (outcome ? done : refused)++;
    EXPECT_TRUE(is_sound(d->at({n.any(), n.any()})));
    EXPECT_TRUE(is_sound(d->at({n.any(), n.any()}, {n.any(), n.any()})));
    if (i % 50 == 0) expect_sound(*d);
    // Regrowth's own times may stand above the limit for as long as it lasts.
    EXPECT_LE(d->stats().bytes, 4 * options.memory_limit);
  }
  EXPECT_GT(done, runs() / 4);
  EXPECT_GT(refused, runs() / 20);
}

TEST(DisturbanceFuzz, DamagedFilesAreRefusedOrSound) {
  const std::string path =
      (std::filesystem::temp_directory_path() / ("sward_disturbance_fuzz_" + std::to_string(::getpid()))).string();
  auto d = Disturbance::create();
  ASSERT_TRUE(d);
  ASSERT_TRUE(d->explode({3, 4}, 2));
  ASSERT_TRUE(d->cut_capsule({0, 0}, {5, 1}, 0.5, 0.05f));
  ASSERT_TRUE(d->regrow({0, 0}, 2, 50));
  ASSERT_TRUE(d->save(path));
  std::ifstream stream(path, std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(stream), {}};
  auto other = Disturbance::create();
  ASSERT_TRUE(other);
  ASSERT_TRUE(other->burn_disc({50, 50}, 1, 1));
  std::mt19937 random(5);
  for (int i = 0; i < runs() / 8; ++i) {
    std::string bytes = whole;
    if (i % 3 == 0) {
      bytes.resize(random() % whole.size());
    } else {
      for (uint32_t k = 0; k <= random() % 4; ++k)
        bytes[random() % (i % 3 == 1 ? 80 : bytes.size())] ^= char(1u << random() % 8);
    }
    if (bytes == whole) continue;
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
    const auto loaded = other->load(path);
    ASSERT_FALSE(loaded) << i;
    EXPECT_NE(loaded.error().message.find(path), std::string::npos);
    EXPECT_EQ(other->at({50, 50}).burn, 1.0f);
  }
  std::ofstream(path, std::ios::binary | std::ios::trunc) << whole;
  EXPECT_TRUE(other->load(path));
  EXPECT_EQ(other->at({50, 50}).burn, 0.0f);
  expect_sound(*other);
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace sward
