// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// Random sequences of views, loads that come, fail and come late, drops and
// updates of several meshes over one world; the validator runs after each.
// SWARD_FUZZ_ROUNDS: how many sequences, default 60.

#include <gtest/gtest.h>

#include <cstdlib>
#include <mutex>
#include <random>

#include "../world_support.h"

namespace {

using namespace world_support;

struct Sequence {
  std::mt19937 random;
  Heights heights;
  std::unique_ptr<sward::World> world;
  std::vector<sward::RoamMesh> meshes;
  size_t cap = 0;
  uint64_t splits = 0;

  explicit Sequence(uint32_t seed) : random(seed) {
    const int bits = 3 + int(random() % 3);
    const int coarse = 1 + int(random() % uint32_t(bits - 1));
    sward::WorldDesc desc = make_desc({1 + int(random() % 5), 1 + int(random() % 5)}, bits, coarse);
    if (random() % 2 == 0) desc.columns = std::max(2, desc.columns - int(random() % (1u << bits)));
    if (random() % 2 == 0) desc.rows = std::max(2, desc.rows - int(random() % (1u << bits)));
    desc.floats = random() % 2 == 0;
    heights = make_heights(desc, seed);
    auto built = sward::build_coarse(desc, heights.reader());
    sward::WorldOptions options = roomy();
    options.retry_s = 0.0005;
    options.adopt_per_poll = 1 + int(random() % 3);
    // Room for two squares to all of them: the error of a cap that is too small
    // says what is needed.
    options.memory_bytes = 1;
    const auto needed = sward::World::create(desc, *built, loader_of(heights), options);
    const std::string message = needed.error().message;
    const size_t least = std::stoul(message.substr(message.rfind(' ')));
    options.memory_bytes = cap = least + least * (random() % 8);
    auto failing = std::make_shared<std::mt19937>(seed + 1);
    const auto load = [failing, build = loader_of(heights)](
                          const sward::SquareRequest& request) -> sward::Expected<sward::SquareData> {
      if ((*failing)() % 4 == 0) return sward::fail("now and then");
      return build(request);
    };
    world = sward::World::create(desc, std::move(*built), load, options).value();
    for (int i = 0; i < 2; ++i) {
      sward::RoamOptions roam;
      roam.max_triangles = 200 + uint32_t(random() % 2000);
      roam.plain = i == 1 && random() % 2 == 0;
      roam.time_cap_s = random() % 4 == 0 ? 1e-9 : 0;
      meshes.push_back(std::move(*sward::RoamMesh::create(*world, roam)));
    }
  }

  double uniform(double low, double high) { return low + (high - low) * (double(random() >> 8) / 16777216.0); }

  sward::View any_view() {
    const glm::dvec2 low = world->lattice().min_corner(), high = world->lattice().max_corner();
    const glm::dvec2 z = world->height_range();
    return sward::View::look(
        {uniform(low.x - 100, high.x + 100), uniform(low.y - 100, high.y + 100), uniform(z.x - 50, z.y + 300)},
        uniform(-3, 3), uniform(-1.5, 0.5), uniform(0.1, 1.8), {640, 480}, uniform(0.1, 20), 1e5);
  }

  void step(double time_s) {
    const sward::View views[2] = {any_view(), any_view()};
    if (random() % 3 != 0) world->follow({views, random() % 3});
    if (random() % 2 == 0) std::this_thread::sleep_for(std::chrono::microseconds(random() % 300));
    const auto boxes = world->poll();
    ASSERT_LE(world->stats().bytes, cap);
    for (size_t i = 0; i < meshes.size(); ++i) {
      for (const sward::LatticeBox& box : boxes) meshes[i].residency_changed(box);
      const auto stats = random() % 2 == 0 ? meshes[i].update(views[i], time_s) : meshes[i].update(views[i]);
      ASSERT_TRUE(stats) << stats.error().message;
      ASSERT_LE(stats->visible, meshes[i].options().max_triangles)
          << (meshes[i].options().plain ? "plain" : "deferred") << (stats->capped ? ", capped" : "");
      splits += stats->splits;
      const auto valid = meshes[i].validate();
      ASSERT_TRUE(valid) << valid.error().message;
    }
  }
};

TEST(WorldFuzz, AnySequenceLeavesValidMeshes) {
  const char* wanted = std::getenv("SWARD_FUZZ_ROUNDS");
  const int rounds = wanted != nullptr ? std::atoi(wanted) : 60;
  uint64_t splits = 0, loads = 0, drops = 0;
  for (int round = 0; round < rounds; ++round) {
    Sequence sequence{uint32_t(round + 1)};
    for (int i = 0; i < 60 && !testing::Test::HasFatalFailure(); ++i) sequence.step(i / 60.0);
    ASSERT_FALSE(testing::Test::HasFatalFailure()) << "round " << round;
    splits += sequence.splits;
    loads += sequence.world->stats().loads;
    drops += sequence.world->stats().drops;
  }
  std::printf("%d sequences: %llu splits, %llu loads, %llu drops\n", rounds, (unsigned long long)splits,
              (unsigned long long)loads, (unsigned long long)drops);
  EXPECT_GT(loads, uint64_t(rounds));
  EXPECT_GT(drops, uint64_t(rounds) / 4);
}

}  // namespace
