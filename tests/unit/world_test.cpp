// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// What a world answers: against a height field of the same samples with its bounds, and, for every choice of resident
// squares, against the definition of what has to be split before what.

#include <gtest/gtest.h>

#include <random>

#include "world_support.h"

namespace {

using namespace world_support;
using sward::LatticePoint;

struct Field {
  std::unique_ptr<sward::HeightField> field;
  std::unique_ptr<sward::Bounds> bounds;
};

Field field_of(const Heights& heights) {
  const sward::WorldDesc& world = heights.desc;
  sward::HeightFieldDesc desc;
  desc.columns = world.columns;
  desc.rows = world.rows;
  desc.spacing = world.spacing;
  desc.origin = world.origin;
  desc.scale = world.scale;
  desc.offset = world.offset;
  desc.relief.enabled = false;
  sward::HeightField::Samples samples = std::vector<uint16_t>(heights.samples.begin(), heights.samples.end());
  if (world.floats) samples = heights.samples;
  Field made;
  made.field =
      std::make_unique<sward::HeightField>(sward::HeightField::create(desc, std::move(samples), heights.holes).value());
  made.bounds = std::make_unique<sward::Bounds>(sward::Bounds::create(*made.field));
  return made;
}

// The heights with which a field fills holes.
void adopt_filled(Heights& heights, const sward::HeightField& field) {
  std::visit([&](const auto& samples) { heights.samples.assign(samples.begin(), samples.end()); }, field.samples());
}

void expect_same(const sward::World& world, const Field& reference, int levels) {
  const sward::Lattice& lattice = world.lattice();
  ASSERT_EQ(lattice.root_bits, reference.field->root_bits());
  ASSERT_EQ(lattice.root_squares, reference.field->root_squares());
  size_t compared = 0;
  for (const auto& [key, parents] : all_diamonds(lattice)) {
    const LatticePoint centre(key.second.first, key.second.second);
    if (key.first >= levels) continue;
    ASSERT_TRUE(world.can_split(centre, key.first));
    ASSERT_EQ(world.bound(centre, key.first), reference.bounds->bound(centre, key.first))
        << "level " << key.first << " at " << centre.x << ", " << centre.y;
    ASSERT_EQ(world.height(centre), reference.field->height(centre));
    ++compared;
  }
  EXPECT_GT(compared, 500u);
}

class WorldAgainstField : public testing::TestWithParam<int> {
 protected:
  // 0: whole squares; 1: padding, unequal spacing; 2: holes and padding; 3: floats.
  Heights make() const {
    sward::WorldDesc desc = make_desc({3, 5}, 6, 3);
    desc.offset = -40;
    desc.origin = {1000, -2000, 300};
    if (GetParam() == 1 || GetParam() == 2) {
      desc.columns = desc.rows = 300;
      desc.spacing = {7, 11};
    }
    if (GetParam() == 3) desc.floats = true;
    Heights heights = make_heights(desc, uint32_t(GetParam() + 1));
    if (GetParam() == 3)
      for (float& sample : heights.samples) sample = sample * 0.37f - 9000.5f;
    if (GetParam() == 2) {
      heights.holes.assign(heights.samples.size(), 0);
      for (int row = 0; row < desc.rows; ++row)
        for (int column = 0; column < desc.columns; ++column)
          heights.holes[size_t(row) * 300 + size_t(column)] =
              (column > 40 && column < 210 && row > 100 && row < 180) || (column * 7 + row * 13) % 97 == 0;
      adopt_filled(heights, *field_of(heights).field);
    }
    return heights;
  }
};

TEST_P(WorldAgainstField, SameHeightsAndBoundsAtEveryDiamond) {
  const Heights heights = make();
  const Field reference = field_of(heights);
  const auto world = make_world(heights, loader_of(heights), roomy());
  const int coarse_levels = 2 * heights.desc.coarse_bits;
  // With nothing resident all coarse levels answer, and the bounds of the triangles that cannot be split.
  expect_same(*world, reference, coarse_levels);
  for (const auto& [key, parents] : all_diamonds(world->lattice())) {
    if (key.first != coarse_levels) continue;
    const LatticePoint centre(key.second.first, key.second.second);
    ASSERT_EQ(world->bound(centre, key.first), reference.bounds->bound(centre, key.first));
    ASSERT_FALSE(world->can_split(centre, key.first));
  }
  settle(*world, view_over(*world));
  ASSERT_EQ(world->stats().resident, uint32_t(world->lattice().root_squares.x * world->lattice().root_squares.y));
  expect_same(*world, reference, world->lattice().max_level);
}

TEST_P(WorldAgainstField, SameQueries) {
  const Heights heights = make();
  const Field reference = field_of(heights);
  const auto world = make_world(heights, loader_of(heights), roomy());
  settle(*world, view_over(*world));
  std::mt19937 random(7);
  const glm::dvec2 low = reference.field->min_corner(), high = reference.field->max_corner();
  std::uniform_real_distribution<double> x(low.x - 20, high.x + 20), y(low.y - 20, high.y + 20);
  size_t outside = 0;
  for (int i = 0; i < 4000; ++i) {
    const glm::dvec2 xy(x(random), y(random));
    const double expected = reference.field->height(xy);
    if (std::isnan(expected)) {
      EXPECT_TRUE(std::isnan(world->height(xy)));
      ++outside;
    } else {
      EXPECT_NEAR(world->height(xy), expected, 1e-9 * 1000);
    }
    const glm::dvec2 gradient = reference.field->data_gradient(xy), own = world->data_gradient(xy);
    EXPECT_NEAR(own.x, gradient.x, 1e-9);
    EXPECT_NEAR(own.y, gradient.y, 1e-9);
    EXPECT_EQ(world->relief_gradient({0, 0}), glm::dvec2(0));
  }
  EXPECT_GT(outside, 10u);
  const sward::FieldSurface surface(*reference.bounds);
  size_t in_holes = 0;
  const LatticePoint last = world->lattice().last();
  for (int i = 0; i < 4000; ++i) {
    const LatticePoint at(int(random() % uint32_t(last.x)), int(random() % uint32_t(last.y)));
    const sward::LatticeBox box{at, glm::min(at + int(random() % 9000), last)};
    EXPECT_EQ(world->all_holes(box), surface.all_holes(box));
    in_holes += surface.all_holes(box);
  }
  EXPECT_EQ(in_holes > 10, !heights.holes.empty());
}

INSTANTIATE_TEST_SUITE_P(Kinds, WorldAgainstField, testing::Range(0, 4));

// What must be split before a diamond, of one level, by the definition.
std::set<Key> ancestors_at(const std::map<Key, std::set<Key>>& diamonds, const Key& key, int level) {
  std::set<Key> front{key};
  while (!front.empty() && front.begin()->first > level) {
    std::set<Key> above;
    for (const Key& one : front) above.insert(diamonds.at(one).begin(), diamonds.at(one).end());
    front = above;
  }
  return front;
}

TEST(World, EveryChoiceOfResidentSquaresIsNested) {
  const Heights heights = make_heights(make_desc({3, 3}, 4, 2));
  const Field reference = field_of(heights);
  const auto diamonds = all_diamonds(reference.field->lattice());
  std::map<Key, std::set<int>> needed;  // squares, by diamond
  for (const auto& [key, parents] : diamonds) {
    if (key.first < 4) continue;
    for (const Key& cell : ancestors_at(diamonds, key, 4))
      needed[key].insert((cell.second.second >> sward::k_root_bits) * 3 + (cell.second.first >> sward::k_root_bits));
  }
  auto coarse = sward::build_coarse(heights.desc, heights.reader());
  for (uint32_t chosen = 0; chosen < 512; ++chosen) {
    const auto load = [&, build = loader_of(heights)](const sward::SquareRequest& request) {
      const int index = request.square.y * 3 + request.square.x;
      return (chosen >> index & 1) != 0 ? build(request) : sward::Expected<sward::SquareData>(sward::fail("left out"));
    };
    const auto world = sward::World::create(heights.desc, *coarse, load, roomy()).value();
    settle(*world, view_over(*world));
    ASSERT_EQ(world->stats().resident, uint32_t(std::popcount(chosen)));
    for (const auto& [key, parents] : diamonds) {
      const LatticePoint centre(key.second.first, key.second.second);
      bool expected = true;
      if (key.first >= 4)
        for (const int square : needed[key]) expected = expected && (chosen >> square & 1) != 0;
      ASSERT_EQ(world->can_split(centre, key.first), expected) << "chosen " << chosen << " level " << key.first;
      if (!expected) continue;
      for (const Key& parent : parents)
        ASSERT_TRUE(world->can_split({parent.second.first, parent.second.second}, parent.first));
      ASSERT_EQ(world->height(centre), reference.field->height(centre));
    }
    // The bounds of all triangles that can come into being.
    for (const auto& [key, parents] : diamonds)
      for (const Key& parent : parents) {
        if (!world->can_split({parent.second.first, parent.second.second}, parent.first)) continue;
        const LatticePoint centre(key.second.first, key.second.second);
        ASSERT_EQ(world->bound(centre, key.first), reference.bounds->bound(centre, key.first));
      }
  }
}

TEST(World, BoxesHoldEverythingThatChanges) {
  const Heights heights = make_heights(make_desc({4, 3}, 4, 2));
  const auto diamonds = all_diamonds(field_of(heights).field->lattice());
  sward::WorldOptions options = roomy();
  options.adopt_per_poll = 1;
  const auto world = make_world(heights, loader_of(heights), options);
  const auto answers = [&] {
    std::vector<std::tuple<bool, float, double>> all;
    for (const auto& [key, parents] : diamonds) {
      const LatticePoint centre(key.second.first, key.second.second);
      all.emplace_back(world->can_split(centre, key.first), world->bound(centre, key.first), world->height(centre));
    }
    return all;
  };
  const sward::View view = view_over(*world);
  world->follow({&view, 1});
  auto before = answers();
  size_t changes = 0;
  ASSERT_TRUE(wait_until([&] {
    const auto boxes = world->poll();
    const auto after = answers();
    size_t i = 0;
    for (const auto& [key, parents] : diamonds) {
      if (before[i] != after[i]) {
        ++changes;
        const auto holds = [&k = key](const sward::LatticeBox& box) {
          return k.second.first >= box.first.x && k.second.second >= box.first.y && k.second.first <= box.last.x &&
                 k.second.second <= box.last.y;
        };
        EXPECT_TRUE(std::any_of(boxes.begin(), boxes.end(), holds));
      }
      ++i;
    }
    before = after;
    return world->settled();
  }));
  EXPECT_GT(changes, 1000u);
}

// The answers of a world at 10 000 km are those at the origin, but for x and y.
TEST(World, FarFromTheOrigin) {
  Heights heights = make_heights(make_desc({3, 3}, 5, 2));
  const auto near_world = make_world(heights, loader_of(heights), roomy());
  Heights far = heights;
  far.desc.origin = {1.0e7, -1.0e7, 0};
  const auto far_world = make_world(far, loader_of(far), roomy());
  settle(*near_world, view_over(*near_world));
  settle(*far_world, view_over(*far_world, {1.0e7, -1.0e7}));
  ASSERT_EQ(far_world->stats().resident, 9u);
  for (const auto& [key, parents] : all_diamonds(near_world->lattice())) {
    const LatticePoint centre(key.second.first, key.second.second);
    ASSERT_EQ(near_world->height(centre), far_world->height(centre));
    ASSERT_EQ(near_world->bound(centre, key.first), far_world->bound(centre, key.first));
    // Half a unit in the last place of 1e7 m.
    const glm::dvec2 moved = far_world->lattice().world_xy(centre) - glm::dvec2(1.0e7, -1.0e7);
    ASSERT_NEAR(moved.x, near_world->lattice().world_xy(centre).x, 2e-9);
    ASSERT_NEAR(moved.y, near_world->lattice().world_xy(centre).y, 2e-9);
  }
  EXPECT_NEAR(far_world->height(glm::dvec2(1.0e7 + 33.3, -1.0e7 - 71.9)), near_world->height(glm::dvec2(33.3, -71.9)),
              1e-6);
}

TEST(World, RefusesWhatItCannotBe) {
  const Heights heights = make_heights(make_desc({2, 2}, 4, 2));
  const auto coarse = sward::build_coarse(heights.desc, heights.reader()).value();
  const auto message = [&](auto change) {
    sward::WorldDesc desc = heights.desc;
    sward::WorldOptions options;
    change(desc, options);
    const auto world = sward::World::create(desc, coarse, loader_of(heights), options);
    return world ? std::string() : world.error().message;
  };
  const auto expect = [&](const char* part, auto change) {
    EXPECT_NE(message(change).find(part), std::string::npos) << message(change);
  };
  EXPECT_EQ(message([](auto&, auto&) {}), "");
  expect("at least 2 x 2", [](auto& d, auto&) { d.columns = 1; });
  expect("root_bits", [](auto& d, auto&) { d.root_bits = 15; });
  expect("coarse_bits", [](auto& d, auto&) { d.coarse_bits = 4; });
  expect("spacing", [](auto& d, auto&) { d.spacing.y = 0; });
  expect("scale", [](auto& d, auto&) { d.scale = NAN; });
  expect("origin", [](auto& d, auto&) { d.origin.x = INFINITY; });
  expect("1024", [](auto& d, auto&) { d.rows = 1024 * 16 + 2; });
  expect("does not fit", [](auto& d, auto&) { d.coarse_bits = 3; });
  expect("memory cap of 100 bytes", [](auto&, auto& o) { o.memory_bytes = 100; });
  expect("worth_px", [](auto&, auto& o) { o.worth_px = NAN; });
  expect("adopt_per_poll", [](auto&, auto& o) { o.adopt_per_poll = 0; });
  expect("answer_timeout_s", [](auto&, auto& o) { o.answer_timeout_s = 0; });
  expect("retry_s", [](auto&, auto& o) { o.retry_s = -1; });
  expect("close_wait_s", [](auto&, auto& o) { o.close_wait_s = NAN; });
}

TEST(World, RefusesSamplesThatItCannotHold) {
  Heights heights = make_heights(make_desc({1, 1}, 4, 2));
  const auto message = [&](float sample) {
    heights.samples[40] = sample;
    const auto square = sward::build_square(heights.desc, {0, 0}, heights.reader());
    return square ? std::string() : square.error().message;
  };
  EXPECT_EQ(message(7), "");
  EXPECT_NE(message(NAN).find("not finite"), std::string::npos);
  EXPECT_NE(message(0.5f).find("16-bit"), std::string::npos);
  EXPECT_NE(message(65536).find("16-bit"), std::string::npos);
  EXPECT_NE(message(-1).find("square (0, 0)"), std::string::npos);
}

}  // namespace
