// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#if defined(SWARD_MESH_SOURCE)
#include <gtest/gtest.h>

#include <sward/mesh_source/mesh_source.h>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>

namespace {

using namespace sward;

View view_of_origin() {
  return View::look({0, -20, 5}, 1.5707963, -0.2, 1.0, {640, 480}, 0.1, 1000.0);
}

std::string write_file(const std::string& name, const std::string& text) {
  const auto path = std::filesystem::temp_directory_path() / ("sward_mesh_source_" + name);
  std::ofstream(path) << text;
  return path.string();
}

double total_area(const FixedTriangles& out) {
  double area = 0;
  for (const float each : out.area()) area += double(each);
  return area;
}

TEST(MeshSource, PiecesCoverTheFaceAndRespectTheArea) {
  const auto source = MeshSource::from_corners({{-3, -3, 0}, {3, -3, 0}, {-3, 3, 0}});
  ASSERT_TRUE(source);
  FixedTriangles out;
  source->fixed_level_triangles(view_of_origin(), 0.3f, {}, out);
  EXPECT_NEAR(total_area(out), 18.0, 1e-4);
  std::set<uint64_t> ids;
  for (size_t i = 0; i < out.size(); ++i) {
    const FixedTriangle t = out[i];
    EXPECT_LE(t.area, 0.3f);
    EXPECT_GT(t.area, 0.1f);
    ids.insert(t.id.bits);
  }
  EXPECT_EQ(ids.size(), out.size());
  EXPECT_EQ(out.size(), 64u);  // 18 / 64 is the first power of two not above 0.3
}

TEST(MeshSource, DistanceIsThatOfTheNearestPoint) {
  const auto source = MeshSource::from_corners({{-3, -3, 0}, {3, -3, 0}, {-3, 3, 0}});
  ASSERT_TRUE(source);
  FixedTriangles out;
  source->fixed_level_triangles(view_of_origin(), 100.0f, {}, out);
  ASSERT_EQ(out.size(), 1u);
  EXPECT_NEAR(out[0].distance, std::hypot(17.0, 5.0), 1e-4);
}

TEST(MeshSource, CullsByHorizonFrustumAndFacing) {
  const auto source = MeshSource::from_corners({{-3, -3, 0}, {3, -3, 0}, {-3, 3, 0}});
  ASSERT_TRUE(source);
  FixedTriangles out;
  FixedLevelOptions options;
  options.horizon_m = 10;
  source->fixed_level_triangles(view_of_origin(), 0.3f, options, out);
  EXPECT_TRUE(out.empty());
  const View away = View::look({0, -20, 5}, -1.5707963, -0.2, 1.0, {640, 480}, 0.1, 1000.0);
  source->fixed_level_triangles(away, 0.3f, {}, out);
  EXPECT_TRUE(out.empty());
  const View below = View::look({0, -20, -5}, 1.5707963, 0.2, 1.0, {640, 480}, 0.1, 1000.0);
  source->fixed_level_triangles(below, 0.3f, {}, out);
  EXPECT_TRUE(out.empty());
}

TEST(MeshSource, ReadsPolygonsFromObjAndDropsDegenerateFaces) {
  const auto path = write_file("quad.obj", "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 4 0 0\nf 1 2 3 4\nf 1 2 5\n");
  const auto source = MeshSource::load(path, glm::dmat4(1.0));
  ASSERT_TRUE(source) << source.error().message;
  EXPECT_EQ(source->faces(), 2u);
  EXPECT_EQ(source->dropped_faces(), 1u);
}

TEST(MeshSource, RefusesWhatIsNoMesh) {
  EXPECT_FALSE(MeshSource::load("/nowhere/hedge.obj"));
  EXPECT_FALSE(MeshSource::load(write_file("empty.obj", "")));
  EXPECT_FALSE(MeshSource::load(write_file("noise.ply", "ply\nformat nothing\n")));
  EXPECT_FALSE(MeshSource::load(write_file("text.txt", "hello")));
  EXPECT_FALSE(MeshSource::from_corners({{0, 0, 0}, {1, 0, 0}}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(MeshSource::from_corners({{0, 0, 0}, {1, 0, 0}, {nan, 1, 0}}));
}

}  // namespace
#endif
