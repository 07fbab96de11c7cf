// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// Loading and dropping: the memory cap, the order, callbacks that are slow, fail, lie or never answer.

#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <random>
#include <stdexcept>

#include "world_support.h"

namespace {

using namespace world_support;

// A gate that callbacks wait at.
class Gate {
 public:
  void open() {
    const std::lock_guard lock(mutex_);
    open_ = true;
    changed_.notify_all();
  }
  void pass() {
    std::unique_lock lock(mutex_);
    ++waiting_;
    changed_.notify_all();
    changed_.wait(lock, [this] { return open_; });
    ++passed_;
    changed_.notify_all();
  }
  void await_waiting(int count) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return waiting_ >= count; });
  }
  void await_passed(int count) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return passed_ >= count; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool open_ = false;
  int waiting_ = 0, passed_ = 0;
};

// Squares that are alive anywhere, by their owners.
struct Census {
  std::atomic<int> alive{0}, most{0};
  sward::SquareData count(sward::SquareData data) {
    const int now = ++alive;
    for (int seen = most; now > seen && !most.compare_exchange_weak(seen, now);) continue;
    data.owner = std::shared_ptr<const void>(data.owner.get(), [this, kept = data.owner](const void*) mutable {
      kept.reset();
      --alive;
    });
    return data;
  }
};

TEST(WorldLoading, StaysUnderTheCapOnAWildFlight) {
  const Heights heights = make_heights(make_desc({8, 8}, 4, 2));
  Census census;
  sward::WorldOptions options = roomy();
  const size_t square = 19 * 19 * 2 + 17 * 17 * 2 + 5 * 8;
  const size_t base = 33 * 33 * 6 + 32 * 32 * 2 + 64 * 24;
  options.memory_bytes = base + 10 * square + square / 2;
  options.adopt_per_poll = 2;
  {
    const auto world = make_world(
        heights,
        [&, build = loader_of(heights)](const sward::SquareRequest& request) -> sward::Expected<sward::SquareData> {
          auto data = build(request);
          if (!data) return data;
          return census.count(std::move(*data));
        },
        options);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> at(-700, 700);
    for (int leg = 0; leg < 40; ++leg) {
      const sward::View view = view_over(*world, {at(random), at(random)}, 20);
      world->follow({&view, 1});
      for (int frame = 0; frame < 12; ++frame) {
        world->poll();
        const sward::WorldStats stats = world->stats();
        EXPECT_LE(stats.bytes, options.memory_bytes);
        EXPECT_LE(stats.resident, 10u);
        std::this_thread::sleep_for(std::chrono::microseconds(100));
      }
    }
    EXPECT_GT(world->stats().drops, 20u);
    EXPECT_EQ(world->stats().failures, 0u);
    // The ones that matter are resident in the end.
    const sward::View view = view_over(*world, {-600, 600}, 20);
    settle(*world, view);
    EXPECT_EQ(world->stats().wanted, 9u);
    EXPECT_TRUE(world->resident({0, 0}));
    EXPECT_FALSE(world->resident({7, 7}));
    // A view that stays changes nothing.
    const sward::WorldStats before = world->stats();
    for (int frame = 0; frame < 50; ++frame) {
      world->follow({&view, 1});
      EXPECT_TRUE(world->poll().empty());
    }
    EXPECT_EQ(world->stats().loads, before.loads);
  }
  EXPECT_LE(census.most, 10);
  EXPECT_EQ(census.alive, 0);
}

TEST(WorldLoading, NearAndVisibleFirst) {
  const Heights heights = make_heights(make_desc({8, 8}, 4, 2));
  std::mutex mutex;
  std::vector<glm::ivec2> order;
  const auto world = make_world(
      heights,
      [&, build = loader_of(heights)](const sward::SquareRequest& request) {
        const std::lock_guard lock(mutex);
        order.push_back(request.square);
        return build(request);
      },
      roomy());
  // From the middle of square (2, 3), looking east, along the ground.
  const glm::dvec2 eye(-640 + 2.5 * 160, 640 - 3.5 * 160);
  const sward::View view = sward::View::look({eye, world->height_range().x + 100}, 0, -0.05, 0.87, {1280, 720}, 1, 1e6);
  settle(*world, view);
  ASSERT_EQ(order.size(), 64u);
  EXPECT_EQ(order[0], glm::ivec2(2, 3));
  size_t last_ahead = 0, first_behind = 64;
  for (size_t i = 0; i < order.size(); ++i) {
    if (order[i].y == 3 && order[i].x > 2) last_ahead = i;
    if (order[i].x < 2) first_behind = std::min(first_behind, i);
  }
  EXPECT_LT(last_ahead, first_behind);
}

TEST(WorldLoading, AFrameNeverWaits) {
  const Heights heights = make_heights(make_desc({2, 2}, 4, 2));
  const auto gate = std::make_shared<Gate>();
  const auto world = make_world(
      heights,
      [gate, build = loader_of(heights)](const sward::SquareRequest& request) {
        gate->pass();
        return build(request);
      },
      roomy());
  const sward::View view = view_over(*world);
  world->follow({&view, 1});
  EXPECT_TRUE(world->poll().empty());
  gate->await_waiting(1);
  // The callback hangs; these return.
  for (int frame = 0; frame < 100; ++frame) {
    world->follow({&view, 1});
    EXPECT_TRUE(world->poll().empty());
  }
  EXPECT_EQ(world->stats().in_flight, 2u);
  gate->open();
  settle(*world, view);
  EXPECT_EQ(world->stats().resident, 4u);
}

TEST(WorldLoading, ACallbackThatNeverAnswersHoldsUpNothingElse) {
  const Heights heights = make_heights(make_desc({3, 3}, 4, 2));
  const auto gate = std::make_shared<Gate>();
  const auto stop_seen = std::make_shared<std::atomic<bool>>(false);
  sward::WorldOptions options = roomy();
  options.answer_timeout_s = 0.05;
  options.close_wait_s = 0.01;
  auto world = make_world(
      heights,
      [gate, stop_seen, build = loader_of(heights)](const sward::SquareRequest& request) {
        if (request.square == glm::ivec2(1, 1)) {
          gate->pass();
          *stop_seen = request.stop.stop_requested();
        }
        return build(request);
      },
      options);
  settle(*world, view_over(*world));
  const sward::WorldStats stats = world->stats();
  EXPECT_EQ(stats.resident, 8u);
  EXPECT_EQ(stats.failing, 1u);
  EXPECT_EQ(stats.given_up, 1u);
  EXPECT_NE(stats.last_error.find("square (1, 1): did not answer within 0.05 s"), std::string::npos)
      << stats.last_error;
  // Destruction does not wait for it; it ends by itself, told to stop.
  world.reset();
  gate->open();
  gate->await_passed(1);
  EXPECT_TRUE(wait_until([&] { return gate.use_count() == 1; }));
  EXPECT_TRUE(*stop_seen);
}

TEST(WorldLoading, WhenAllAnswersAreMissingItSaysSo) {
  const Heights heights = make_heights(make_desc({3, 3}, 4, 2));
  const auto gate = std::make_shared<Gate>();
  sward::WorldOptions options = roomy();
  options.answer_timeout_s = 0.02;
  options.close_wait_s = 0;
  auto world = make_world(
      heights,
      [gate, build = loader_of(heights)](const sward::SquareRequest& request) {
        gate->pass();
        return build(request);
      },
      options);
  settle(*world, view_over(*world));
  EXPECT_EQ(world->stats().given_up, 4u);
  EXPECT_EQ(world->stats().failing, 9u);
  EXPECT_NE(world->stats().last_error.find("4 earlier loads have not answered"), std::string::npos);
  // Once they answer, loading goes on.
  gate->open();
  gate->await_passed(4);
  EXPECT_TRUE(wait_until([&] {
    world->poll();
    return world->stats().given_up == 0;
  }));
}

TEST(WorldLoading, FailuresAreTriedAgain) {
  const Heights heights = make_heights(make_desc({2, 2}, 4, 2));
  std::atomic<int> calls{0};
  sward::WorldOptions options = roomy();
  options.retry_s = 0.002;
  const auto world = make_world(
      heights,
      [&, build = loader_of(heights)](const sward::SquareRequest& request) -> sward::Expected<sward::SquareData> {
        if (request.square == glm::ivec2(1, 0) && ++calls <= 3) return sward::fail("busy");
        return build(request);
      },
      options);
  const sward::View view = view_over(*world);
  world->follow({&view, 1});
  ASSERT_TRUE(wait_until([&] {
    world->poll();
    return world->stats().resident == 4;
  }));
  EXPECT_EQ(world->stats().failures, 3u);
  EXPECT_EQ(world->stats().failing, 0u);
  EXPECT_EQ(world->stats().last_error, "square (1, 0): busy");
}

// What a host may get wrong.
struct Lie {
  const char* name;
  const char* message;
  sward::Expected<sward::SquareData> (*tell)(sward::SquareData data);
};

template <class T>
std::span<const T> keep(sward::SquareData& data, std::vector<T> values) {
  auto kept = std::make_shared<std::pair<std::vector<T>, std::shared_ptr<const void>>>(std::move(values), data.owner);
  data.owner = kept;
  return kept->first;
}

const Lie k_lies[] = {
    {"Fails", "no such thing",
     [](sward::SquareData) -> sward::Expected<sward::SquareData> { return sward::fail("no such thing"); }},
    {"Throws", "thrown by the host",
     [](sward::SquareData) -> sward::Expected<sward::SquareData> { throw std::runtime_error("thrown by the host"); }},
    {"ThrowsANumber", "no exception", [](sward::SquareData) -> sward::Expected<sward::SquareData> { throw 7; }},
    {"RunsOutOfMemory", "out of memory",
     [](sward::SquareData) -> sward::Expected<sward::SquareData> { throw std::bad_alloc(); }},
    {"Nothing", "has 0 integer",
     [](sward::SquareData) -> sward::Expected<sward::SquareData> { return sward::SquareData{}; }},
    {"TooFewSamples", "has 360 integer",
     [](sward::SquareData data) -> sward::Expected<sward::SquareData> {
       data.words = data.words.first(360);
       return data;
     }},
    {"NoBounds", "has 0 bounds",
     [](sward::SquareData data) -> sward::Expected<sward::SquareData> {
       data.bounds = {};
       return data;
     }},
    {"WrongMask", "hole mask of 1",
     [](sward::SquareData data) -> sward::Expected<sward::SquareData> {
       data.holes = keep<uint64_t>(data, {1});
       return data;
     }},
    {"OtherCoarseHeights", "other heights than",
     [](sward::SquareData data) -> sward::Expected<sward::SquareData> {
       std::vector<uint16_t> words(data.words.begin(), data.words.end());
       words[20] = uint16_t(words[20] + 1);
       data.words = keep(data, std::move(words));
       return data;
     }},
    {"OtherBorder", "shared border",
     [](sward::SquareData data) -> sward::Expected<sward::SquareData> {
       std::vector<uint16_t> words(data.words.begin(), data.words.end());
       for (size_t i = 0; i < 19; ++i) words[i * 19 + 1] = uint16_t(words[i * 19 + 1] + (i % 4 == 2));
       for (size_t i = 0; i < 19; ++i) words[i * 19 + 17] = uint16_t(words[i * 19 + 17] + (i % 4 == 2));
       data.words = keep(data, std::move(words));
       return data;
     }},
    {"LargerBounds", "larger bounds",
     [](sward::SquareData data) -> sward::Expected<sward::SquareData> {
       data.bounds = keep(data, std::vector<uint16_t>(data.bounds.size(), uint16_t(0xfff0)));
       return data;
     }},
};

class WorldLies : public testing::TestWithParam<Lie> {};

TEST_P(WorldLies, AreFailuresOfThatSquare) {
  const Heights heights = make_heights(make_desc({3, 1}, 4, 2));
  const auto world = make_world(
      heights,
      [build = loader_of(heights)](const sward::SquareRequest& request) -> sward::Expected<sward::SquareData> {
        auto data = build(request);
        if (!data || request.square != glm::ivec2(1, 0)) return data;
        return GetParam().tell(std::move(*data));
      },
      roomy());
  // The neighbours are loaded before: the view is over the first, and the second comes when it is the nearest left.
  settle(*world, view_over(*world, {-200, 0}));
  const sward::WorldStats stats = world->stats();
  EXPECT_GE(stats.failures, 1u);
  EXPECT_NE(stats.last_error.find(GetParam().message), std::string::npos) << stats.last_error;
  EXPECT_GE(stats.resident, 1u);
  EXPECT_TRUE(world->resident({0, 0}));
}

INSTANTIATE_TEST_SUITE_P(Kinds, WorldLies, testing::ValuesIn(k_lies),
                         [](const auto& lie) { return std::string(lie.param.name); });

TEST(WorldLoading, FloatsThatAreNoNumbers) {
  sward::WorldDesc desc = make_desc({2, 1}, 4, 2);
  desc.floats = true;
  const Heights heights = make_heights(desc);
  const auto world = make_world(
      heights,
      [build = loader_of(heights)](const sward::SquareRequest& request) -> sward::Expected<sward::SquareData> {
        auto data = build(request);
        std::vector<float> floats(data->floats.begin(), data->floats.end());
        floats[45] = NAN;
        data->floats = keep(*data, std::move(floats));
        return data;
      },
      roomy());
  settle(*world, view_over(*world));
  EXPECT_EQ(world->stats().resident, 0u);
  EXPECT_NE(world->stats().last_error.find("not finite"), std::string::npos);
}

TEST(WorldLoading, SeveralViewsAndNone) {
  const Heights heights = make_heights(make_desc({8, 8}, 4, 2));
  sward::WorldOptions options = roomy();
  options.memory_bytes = 33 * 33 * 6 + 32 * 32 * 2 + 64 * 24 + 7 * (19 * 19 * 2 + 17 * 17 * 2 + 40);
  const auto world = make_world(heights, loader_of(heights), options);
  sward::View views[2] = {view_over(*world, {-560, 560}, 20), view_over(*world, {560, -560}, 20)};
  world->follow(views);
  ASSERT_TRUE(wait_until([&] {
    world->poll();
    return world->settled();
  }));
  EXPECT_EQ(world->stats().resident, 6u);
  EXPECT_TRUE(world->resident({0, 0}));
  EXPECT_TRUE(world->resident({7, 7}));
  // Nothing is looked at, or nothing that is a view: nothing is wanted, nothing is dropped.
  views[0].eye.x = NAN;
  world->follow({views, 1});
  EXPECT_TRUE(world->poll().empty());
  world->follow({});
  EXPECT_TRUE(world->poll().empty());
  EXPECT_EQ(world->stats().wanted, 0u);
  EXPECT_EQ(world->stats().resident, 6u);
}

// Readers on other threads while squares come and go: heights are never anything but the coarse or the true ones. Run
// under the thread sanitizer, this is the test of the hand-over.
TEST(WorldLoading, ReadersOnOtherThreads) {
  const Heights heights = make_heights(make_desc({6, 6}, 4, 2));
  sward::WorldOptions options = roomy();
  options.memory_bytes = 25 * 25 * 6 + 24 * 24 * 2 + 36 * 24 + 5 * (19 * 19 * 2 + 17 * 17 * 2 + 40);
  const auto world = make_world(heights, loader_of(heights), options);
  std::atomic<bool> done{false};
  std::atomic<int> faults{0}, fine{0};
  std::vector<std::thread> readers;
  const int step = world->lattice().sample_step();
  for (uint32_t seed = 0; seed < 2; ++seed)
    readers.emplace_back([&, seed] {
      std::mt19937 random(seed);
      while (!done) {
        const glm::ivec2 sample(int(random() % 97), int(random() % 97));
        const glm::ivec2 square = glm::min(sample / 16, glm::ivec2(5));
        const bool before = world->resident(square);
        const double z = world->height(sward::LatticePoint(sample * step));
        const double exact = double(heights.at(sample.x, sample.y)) * 0.01;
        const double off = std::abs(z - exact);
        // Coarse triangles are off by no more than the finest coarse bound there.
        const double bound = double(world->bound(square * sward::k_root_side + sward::k_root_side / 2, 0));
        faults += off > bound + 1e-9;
        fine += before && off == 0;
      }
    });
  std::mt19937 random(9);
  std::uniform_real_distribution<double> at(-480, 480);
  for (int frame = 0; frame < 3000; ++frame) {
    const sward::View view = view_over(*world, {at(random), at(random)}, 10);
    if (frame % 10 == 0) world->follow({&view, 1});
    world->poll();
    std::this_thread::sleep_for(std::chrono::microseconds(50));
  }
  done = true;
  for (std::thread& reader : readers) reader.join();
  EXPECT_EQ(faults, 0);
  EXPECT_GT(fine, 0);
  EXPECT_GT(world->stats().drops, 20u);
}

}  // namespace
