// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>
#include <sward/terrain/edits.h>
#include <sward/terrain/queries.h>

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#include "unit/field_reference.h"

using namespace field_reference;
using sward::Bounds;
using sward::Edit;
using sward::EditRegion;
using sward::EditResult;
using sward::HeightFieldDesc;
using sward::LatticeBox;

namespace {

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();

struct Ground {
  HeightFieldDesc desc;
  std::vector<uint8_t> holes;
  std::unique_ptr<HeightField> field;
  std::unique_ptr<Bounds> bounds;
};

Ground make(const HeightFieldDesc& desc, HeightField::Samples samples, std::vector<uint8_t> holes = {}) {
  auto field = HeightField::create(desc, std::move(samples), holes);
  if (!field) throw std::runtime_error(field.error().message);
  Ground g{desc, std::move(holes), std::make_unique<HeightField>(std::move(*field)), nullptr};
  g.bounds = std::make_unique<Bounds>(Bounds::create(*g.field));
  return g;
}

struct Shape {
  int columns = 65, rows = 65;
  bool relief = false, holes = false, words = false;
};

Ground rough(const Shape& shape) {
  HeightFieldDesc desc;
  desc.columns = shape.columns;
  desc.rows = shape.rows;
  desc.spacing = {4.0, 6.0};
  desc.origin = {1000.0, -500.0, 30.0};
  desc.relief.enabled = shape.relief;
  const std::vector<float> heights = rough_heights(shape.columns, shape.rows, 17);
  std::vector<uint8_t> holes;
  if (shape.holes) {
    std::mt19937 random(2);
    for (size_t i = 0; i < heights.size(); ++i) {
      const int column = int(i) % shape.columns, row = int(i) / shape.columns;
      const bool lake = std::hypot(column - shape.columns / 3, row - shape.rows / 2) < shape.rows / 5.0;
      holes.push_back(lake || random() % 50 == 0 ? 1 : 0);
    }
  }
  if (!shape.words) return make(desc, heights, holes);
  desc.scale = 0.05;
  desc.offset = -200.0;
  std::vector<uint16_t> words;
  for (const float height : heights) words.push_back(uint16_t((height + 200.0f) * 20.0f));
  return make(desc, words, holes);
}

// Edits of all kinds, sizes from a sample to the field, on and across borders.
Edit random_edit(const HeightField& field, std::mt19937& random) {
  const glm::dvec2 low = field.min_corner(), size = field.max_corner() - low;
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  Edit edit;
  edit.kind = Edit::Kind(random() % 4);
  const glm::dvec2 centre = low + size * (glm::dvec2(uniform(random), uniform(random)) * 1.1 - 0.05);
  const double radius = 0.5 * size.x * std::pow(uniform(random), 3.0) + 3.0;
  edit.region = EditRegion::disc(centre, radius, random() % 2 == 0 ? 0.0 : uniform(random) * radius);
  if (edit.kind != Edit::Kind::crater && random() % 2 == 0) {
    edit.region.shape = EditRegion::Shape::rectangle;
    edit.region.half_size.y = radius * (0.1 + uniform(random));
  }
  edit.metres = 20.0 * uniform(random);
  return edit;
}

// Bounds and relief against those computed from scratch, on the same field and on one made of the edited samples.
void expect_as_from_scratch(const Ground& g) {
  const HeightField& field = *g.field;
  const Bounds fresh = Bounds::create(field);
  for (int level = 0; level <= field.data_level() + 2 && level < field.max_level(); ++level) {
    all_triangles(field, level, [&](const Triangle& t) {
      ASSERT_EQ(g.bounds->bound(t.middle(), level), fresh.bound(t.middle(), level))
          << "level " << level << " at " << t.middle().x << ", " << t.middle().y;
    });
  }
  const auto made = HeightField::create(g.desc, field.samples());
  ASSERT_TRUE(made) << made.error().message;
  if (g.holes.empty()) {
    ASSERT_EQ(made->fingerprint(), field.fingerprint());
  }
  EXPECT_LE(field.height_range()[0], made->height_range()[0]);
  EXPECT_GE(field.height_range()[1], made->height_range()[1]);
}

void check_random_edits(Shape shape, int count) {
  Ground g = rough(shape);
  std::mt19937 random(3);
  int changed = 0;
  for (int i = 0; i < count && !testing::Test::HasFatalFailure(); ++i) {
    const uint64_t before = g.field->fingerprint();
    const auto result = sward::edit(*g.field, *g.bounds, random_edit(*g.field, random));
    if (!result) {
      EXPECT_NE(result.error().message.find("outside"), std::string::npos);
      continue;
    }
    ASSERT_EQ(before != g.field->fingerprint(), result->samples > 0);
    ASSERT_EQ(result->samples == 0, result->changed.empty());
    changed += result->samples > 0 ? 1 : 0;
    expect_as_from_scratch(g);
  }
  EXPECT_GT(changed, count / 2);
}

TEST(Edits, BoundsAreThoseFromScratch) {
  check_random_edits({}, 60);
}
TEST(Edits, BoundsAreThoseFromScratchWithRelief) {
  check_random_edits({.relief = true}, 30);
}
TEST(Edits, BoundsAreThoseFromScratchInSeveralPaddedSquares) {
  check_random_edits({.columns = 130, .rows = 70}, 40);
  check_random_edits({.columns = 130, .rows = 70, .relief = true}, 15);
  check_random_edits({.columns = 300, .rows = 21, .relief = true}, 15);
}
TEST(Edits, BoundsAreThoseFromScratchAroundHoles) {
  check_random_edits({.columns = 80, .rows = 65, .holes = true}, 30);
  check_random_edits({.columns = 80, .rows = 65, .relief = true, .holes = true}, 15);
}
TEST(Edits, BoundsAreThoseFromScratchOfWords) {
  check_random_edits({.relief = true, .words = true}, 20);
}

bool contains(const LatticeBox& box, LatticePoint p) {
  return p.x >= box.first.x && p.x <= box.last.x && p.y >= box.first.y && p.y <= box.last.y;
}

// The box holds every point whose height changed, padding included, and Bounds::affected() every diamond.
void check_boxes(Shape shape) {
  std::mt19937 random(5);
  for (int i = 0; i < 40; ++i) {
    Ground g = rough(shape);
    const Ground before = rough(shape);
    Edit edit = random_edit(*g.field, random);
    edit.region.half_size = glm::min(edit.region.half_size, glm::dvec2(30.0));
    const auto result = sward::edit(*g.field, *g.bounds, edit);
    if (!result || result->samples == 0) continue;
    const LatticePoint end = g.field->root_squares() * sward::k_root_side;
    int64_t points = 0;
    for (int k = 0; k < 20000; ++k) {
      LatticePoint p(int(random() % uint32_t(end.x + 1)), int(random() % uint32_t(end.y + 1)));
      if (k % 2 == 0) {  // Around the box.
        const LatticePoint size = result->changed.last - result->changed.first;
        p = result->changed.first - size / 4 +
            LatticePoint(int(random() % uint32_t(size.x * 3 / 2)), int(random() % uint32_t(size.y * 3 / 2)));
        p = glm::clamp(p, LatticePoint(0), end);
      }
      if (g.field->height(p) == before.field->height(p)) continue;
      ASSERT_TRUE(contains(result->changed, p)) << "edit " << i;
      ++points;
    }
    EXPECT_GT(points, 0);
    for (int level = 0; level < g.field->max_level() && level <= g.field->data_level() + 3; ++level) {
      const LatticeBox affected = g.bounds->affected(result->changed, level);
      all_triangles(*g.field, level, [&](const Triangle& t) {
        if (g.bounds->bound(t.middle(), level) == before.bounds->bound(t.middle(), level)) return;
        ASSERT_TRUE(contains(affected, t.middle())) << "level " << level;
      });
    }
  }
}

TEST(Edits, BoxCoversWhatChanged) {
  check_boxes({.columns = 47, .rows = 33});
}
TEST(Edits, BoxCoversWhatChangedWithRelief) {
  check_boxes({.columns = 47, .rows = 33, .relief = true});
}
TEST(Edits, BoxIsLocal) {
  Ground g = rough({.relief = true});
  const auto result = sward::edit(*g.field, *g.bounds, {.region = EditRegion::disc(glm::dvec2(g.desc.origin), 5.0)});
  ASSERT_TRUE(result);
  // 3 x 1 samples and four cells around them at most.
  EXPECT_EQ(result->samples, 3);
  const glm::ivec2 cells = (result->changed.last - result->changed.first) / g.field->sample_step();
  EXPECT_LE(cells.x, 2 + 6);
  EXPECT_LE(cells.y, 0 + 6);
}

double at(const Ground& g, glm::dvec2 offset) {
  return g.field->height(glm::dvec2(g.desc.origin) + offset);
}

Ground flat(float height = 10.0f) {
  HeightFieldDesc desc;
  desc.columns = desc.rows = 65;
  desc.origin = {500.0, 600.0, 5.0};
  desc.relief.enabled = false;
  return make(desc, std::vector<float>(65 * 65, height));
}

TEST(Edits, RaiseLowerFlattenByHand) {
  Ground g = flat();
  const glm::dvec2 middle(g.desc.origin);
  Edit edit{.kind = Edit::Kind::raise, .region = EditRegion::disc(middle, 10.0, 4.0), .metres = 3.0};
  ASSERT_TRUE(sward::edit(*g.field, *g.bounds, edit));
  EXPECT_EQ(at(g, {0, 0}), 18.0);
  EXPECT_EQ(at(g, {6, 0}), 18.0);
  EXPECT_NEAR(at(g, {0, -8}), 15.0 + 1.5, 1e-6);  // Half of the soft edge.
  EXPECT_EQ(at(g, {10, 0}), 15.0);
  EXPECT_EQ(at(g, {-11, 0}), 15.0);
  EXPECT_EQ(g.field->height_range(), glm::dvec2(15.0, 18.0));

  edit = {.kind = Edit::Kind::lower,
          .region = EditRegion::rectangle(middle - 3.0, middle + glm::dvec2(1.0, 2.0)),
          .metres = 1.0};
  const auto lowered = sward::edit(*g.field, *g.bounds, edit);
  ASSERT_TRUE(lowered);
  EXPECT_EQ(lowered->samples, 5 * 6);
  EXPECT_EQ(at(g, {1, 2}), 17.0);
  EXPECT_EQ(at(g, {-3, -3}), 17.0);
  EXPECT_EQ(at(g, {2, 0}), 18.0);
  EXPECT_EQ(at(g, {0, 3}), 18.0);

  edit = {.kind = Edit::Kind::flatten, .region = EditRegion::disc(middle, 100.0), .metres = -2.5};
  ASSERT_TRUE(sward::edit(*g.field, *g.bounds, edit));
  EXPECT_EQ(at(g, {-32, 32}), -2.5);
  EXPECT_EQ(at(g, {0, 0}), -2.5);
  expect_as_from_scratch(g);
}

TEST(Edits, CraterHasABowlAndARim) {
  Ground g = flat();
  const Edit edit{.kind = Edit::Kind::crater,
                  .region = EditRegion::disc(glm::dvec2(g.desc.origin), 20.0),
                  .metres = 6.0,
                  .rim_share = 0.25};
  ASSERT_TRUE(sward::edit(*g.field, *g.bounds, edit));
  EXPECT_NEAR(at(g, {0, 0}), 15.0 - 6.0, 1e-6);
  EXPECT_NEAR(at(g, {15, 0}), 15.0 + 1.5, 1e-6);
  EXPECT_NEAR(at(g, {0, -15}), 15.0 + 1.5, 1e-6);
  EXPECT_EQ(at(g, {20, 0}), 15.0);
  EXPECT_EQ(at(g, {21, 0}), 15.0);
  for (int x = 0; x < 15; ++x) EXPECT_GT(at(g, {x + 1, 0}), at(g, {x, 0}));
  for (int x = 15; x < 20; ++x) EXPECT_LT(at(g, {x + 1, 0}), at(g, {x, 0}));
}

TEST(Edits, FunctionGetsPlaceAndHeight) {
  Ground g = flat();
  const glm::dvec2 middle(g.desc.origin);
  const auto result =
      sward::edit(*g.field, *g.bounds, EditRegion::rectangle(middle - 4.0, middle + 4.0),
                  [&](glm::dvec2 xy, double z) { return z + (xy.x - middle.x) - 2.0 * (xy.y - middle.y); });
  ASSERT_TRUE(result);
  EXPECT_EQ(at(g, {3, 0}), 18.0);
  EXPECT_EQ(at(g, {0, 3}), 9.0);
  EXPECT_EQ(at(g, {0, 5}), 15.0);
  // Where the height stays, samples stay.
  EXPECT_EQ(result->samples, 9 * 9 - 5);
}

TEST(Edits, WordsAreRoundedAndClamped) {
  HeightFieldDesc desc;
  desc.columns = desc.rows = 17;
  desc.scale = 0.5;
  desc.offset = -10.0;
  desc.relief.enabled = false;
  Ground g = make(desc, std::vector<uint16_t>(17 * 17, 20));
  const EditRegion region = EditRegion::rectangle({-1, -1}, {1, 1});
  auto result = sward::edit(*g.field, *g.bounds, {.region = region, .metres = 1.3});
  ASSERT_TRUE(result);
  EXPECT_EQ(at(g, {0, 0}), 1.5);
  EXPECT_EQ(result->clamped, 0);
  result = sward::edit(*g.field, *g.bounds, {.region = region, .metres = 0.2});
  EXPECT_EQ(result->samples, 0);
  EXPECT_TRUE(result->changed.empty());
  result = sward::edit(*g.field, *g.bounds, {.kind = Edit::Kind::lower, .region = region, .metres = 100.0});
  EXPECT_EQ(result->clamped, 9);
  EXPECT_EQ(result->samples, 9);
  EXPECT_EQ(at(g, {1, 1}), -10.0);
  result = sward::edit(*g.field, *g.bounds, {.kind = Edit::Kind::raise, .region = region, .metres = 1e6});
  EXPECT_EQ(result->clamped, 9);
  EXPECT_EQ(at(g, {1, 1}), 65535 * 0.5 - 10.0);
}

TEST(Edits, QueriesSeeThem) {
  Ground g = rough({.relief = true});
  const glm::dvec2 middle(g.desc.origin);
  const sward::TerrainQueries queries(*g.bounds);
  ASSERT_TRUE(sward::edit(*g.field, *g.bounds,
                          {.kind = Edit::Kind::flatten, .region = EditRegion::disc(middle, 40.0), .metres = 200.0}));
  const auto hit = queries.ray({{middle, 900.0}, {0, 0, -1}});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->point.z, 200.0, 0.2);
}

TEST(Edits, RefusesWhatIsNotValidAndChangesNothing) {
  Ground g = rough({.relief = true});
  const glm::dvec2 middle(g.desc.origin);
  const uint64_t before = g.field->fingerprint();
  const auto message = [&](const Edit& edit) {
    const auto result = sward::edit(*g.field, *g.bounds, edit);
    return result ? std::string() : result.error().message;
  };
  const auto has = [](const std::string& text, const char* word) { return text.find(word) != std::string::npos; };
  const EditRegion good = EditRegion::disc(middle, 20.0);
  EXPECT_PRED2(has, message({.region = EditRegion::disc(middle + 1e4, 20.0)}), "outside");
  EXPECT_PRED2(has, message({.region = EditRegion::disc(middle, 0.0)}), "size");
  EXPECT_PRED2(has, message({.region = EditRegion::disc(middle, k_nan)}), "size");
  EXPECT_PRED2(has, message({.region = EditRegion::rectangle(middle + 1.0, middle - 1.0)}), "size");
  EXPECT_PRED2(has, message({.region = EditRegion::disc({k_nan, 0}, 20.0)}), "centre");
  EXPECT_PRED2(has, message({.region = EditRegion::disc(middle, 20.0, -1.0)}), "soft edge");
  EXPECT_PRED2(has, message({.region = EditRegion::disc(middle, 20.0, k_nan)}), "soft edge");
  EXPECT_PRED2(has, message({.region = good, .metres = k_nan}), "metres");
  EXPECT_PRED2(has, message({.region = good, .metres = 3e5}), "262144");
  EXPECT_PRED2(has, message({.region = good, .metres = 1e39}), "finite");
  EXPECT_PRED2(has, message({.kind = Edit::Kind::crater, .region = EditRegion::rectangle(middle - 5.0, middle + 5.0)}),
               "disc");
  EXPECT_PRED2(has, message({.kind = Edit::Kind::crater, .region = good, .rim_share = -1.0}), "rim_share");
  const auto result = sward::edit(*g.field, *g.bounds, good, [](glm::dvec2, double) { return k_nan; });
  ASSERT_FALSE(result);
  EXPECT_PRED2(has, result.error().message, "finite");
  EXPECT_EQ(g.field->fingerprint(), before);
  // Between samples: no error, no change.
  const auto none = sward::edit(*g.field, *g.bounds, {.region = EditRegion::disc(middle + 2.0, 0.5)});
  ASSERT_TRUE(none);
  EXPECT_EQ(none->samples, 0);
  EXPECT_EQ(g.field->fingerprint(), before);
  expect_as_from_scratch(g);
}

}  // namespace
