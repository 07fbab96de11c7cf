// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Meshes out of files.
#if defined(SWARD_MESH_SOURCE)
#include <gtest/gtest.h>

#include <sward/mesh_source/mesh_source.h>
#include <filesystem>
#include <fstream>

namespace {

using namespace sward;

std::string write_file(const std::string& name, const std::string& text) {
  const auto path = std::filesystem::path(testing::TempDir()) / ("sward_mesh_source_" + name);
  std::ofstream(path) << text;
  return path.string();
}

void expect_refused(const std::string& path, const std::string& word) {
  const auto mesh = load_mesh(path);
  ASSERT_FALSE(mesh) << path;
  EXPECT_EQ(mesh.error().message.find(path), 0u) << mesh.error().message;
  EXPECT_NE(mesh.error().message.find(word), std::string::npos) << mesh.error().message;
  EXPECT_EQ(mesh.error().message.find('\n'), std::string::npos) << mesh.error().message;
}

TEST(MeshSource, ReadsPolygonsFromObjAndCountsFacesWithoutArea) {
  const auto mesh =
      load_mesh(write_file("quad.obj", "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 4 0 0\nf 1 2 3 4\nf 1 2 5\n"));
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->indices.size(), 9u);
  EXPECT_TRUE(mesh->colors.empty());
  const auto surface = MeshSurface::create(*mesh);
  ASSERT_TRUE(surface) << surface.error().message;
  EXPECT_EQ(surface->report().dropped_faces, 1u);
  EXPECT_NE(surface->report().text().find("1 faces without area"), std::string::npos) << surface->report().text();
}

TEST(MeshSource, ReadsVertexColoursFromPlyAndOff) {
  const std::string corners = "0 0 0 200 10 20\n1 0 0 30 200 40\n0 1 0 50 60 200\n3 0 1 2\n";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n" +
      corners;
  for (const std::string& path : {write_file("colors.ply", ply), write_file("colors.off", "COFF\n3 1 3\n" + corners)}) {
    const auto mesh = load_mesh(path);
    ASSERT_TRUE(mesh) << mesh.error().message;
    ASSERT_EQ(mesh->colors.size(), 3u) << path;
    EXPECT_EQ(mesh->colors[0], glm::u8vec3(200, 10, 20)) << path;
    EXPECT_EQ(mesh->colors[2], glm::u8vec3(50, 60, 200)) << path;
  }
}

// A fan of three faces on one edge, which is no surface; and an open one.
TEST(MeshSource, NonManifoldEdgesAndHolesAreReportedAndKept) {
  const auto mesh =
      load_mesh(write_file("fan.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nf 1 2 3\nf 1 2 4\nf 1 2 5\n"));
  ASSERT_TRUE(mesh) << mesh.error().message;
  const auto surface = MeshSurface::create(*mesh);
  ASSERT_TRUE(surface);
  EXPECT_EQ(surface->faces(), 3u);
  EXPECT_EQ(surface->report().non_manifold_edges, 1u);
  EXPECT_EQ(surface->report().open_edges, 6u);
  EXPECT_NE(surface->report().text().find("more than two faces"), std::string::npos);
}

TEST(MeshSource, RefusesWhatIsNoMeshNamingTheFile) {
  expect_refused("/nowhere/hedge.obj", "no such mesh file");
  expect_refused(testing::TempDir(), "no such mesh file");
  expect_refused(write_file("empty.obj", ""), "no faces");
  expect_refused(write_file("points.obj", "v 0 0 0\nv 1 0 0\n"), "no faces");
  expect_refused(write_file("noise.ply", "ply\nformat nothing\n"), "OBJ, PLY and OFF");
  expect_refused(write_file("short.off", "OFF\n3 1"), "mesh");
  expect_refused(write_file("text.txt", "hello"), "OBJ, PLY and OFF");
}

// What a reader makes of "nan" is its own; a plant must not stand there.
TEST(MeshSource, CornersThatAreNoNumbersMakeNoPlants) {
  const auto mesh = load_mesh(write_file("nan.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\nnan 2 0\n3 0 1 2\n3 0 1 3\n"));
  if (!mesh) return;  // refused, with a message
  const auto surface = MeshSurface::create(*mesh);
  if (!surface) return;
  FixedTriangles pieces;
  surface->all_triangles(1.0f, pieces);
  for (size_t i = 0; i < pieces.size(); ++i) EXPECT_TRUE(pieces.area()[i] < 10.0f) << i;
}

}  // namespace
#endif
