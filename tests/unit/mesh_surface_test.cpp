// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Meshes as sources of triangles, and the plants that the CPU twin grows on them.
#include <gtest/gtest.h>

#include <sward/scene/generated_mesh.h>
#include <sward/vegetation/mesh_surface.h>
#include <sward/vegetation/plants.h>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <tuple>

#include "unit/plant_fixtures.h"

namespace sward {
namespace {

using namespace test;

constexpr double k_right_angle = std::numbers::pi / 2;

View view_of_origin() {
  return View::look({0, -20, 5}, k_right_angle, -0.2, 1.0, {640, 480}, 0.1, 1000.0);
}

MeshSurface surface_of(const std::vector<glm::dvec3>& corners, const std::vector<glm::u8vec3>& colors = {}) {
  std::vector<uint32_t> indices(corners.size());
  for (size_t i = 0; i < indices.size(); ++i) indices[i] = uint32_t(i);
  auto surface = MeshSurface::create(corners, indices, colors);
  EXPECT_TRUE(surface) << surface.error().message;
  return std::move(*surface);
}

const std::vector<glm::dvec3> k_level_face{{-3, -3, 0}, {3, -3, 0}, {-3, 3, 0}};

MeshSurface level_face() {
  return surface_of(k_level_face);
}

double total_area(const FixedTriangles& out) {
  double area = 0;
  for (const float each : out.area()) area += double(each);
  return area;
}

TEST(MeshSurface, PiecesCoverTheFaceAndRespectTheArea) {
  FixedTriangles out;
  level_face().fixed_level_triangles(view_of_origin(), 0.3f, {}, out);
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

TEST(MeshSurface, DistanceIsThatOfTheNearestPoint) {
  FixedTriangles out;
  level_face().fixed_level_triangles(view_of_origin(), 100.0f, {}, out);
  ASSERT_EQ(out.size(), 1u);
  EXPECT_NEAR(out[0].distance, std::hypot(17.0, 5.0), 1e-4);
}

size_t pieces_seen(const View& view, float horizon = 100) {
  FixedLevelOptions options;
  options.horizon_m = horizon;
  FixedTriangles out;
  level_face().fixed_level_triangles(view, 0.3f, options, out);
  return out.size();
}

TEST(MeshSurface, CullsByHorizonFrustumAndFacing) {
  EXPECT_EQ(pieces_seen(view_of_origin()), 64u);
  EXPECT_EQ(pieces_seen(view_of_origin(), 10), 0u);
  EXPECT_EQ(pieces_seen(View::look({0, -20, 5}, -k_right_angle, -0.2, 1.0, {640, 480}, 0.1, 1000.0)), 0u);
  // From well below: all of it shows its back.
  EXPECT_EQ(pieces_seen(View::look({0, -8, -9}, k_right_angle, 0.9, 1.5, {640, 480}, 0.1, 1000.0)), 0u);
  // From a little below: plants still stand above its edge.
  EXPECT_EQ(pieces_seen(View::look({0, -20, -2}, k_right_angle, 0.1, 1.0, {640, 480}, 0.1, 1000.0)), 64u);
}

TEST(MeshSurface, WholeBlocksAreCulledLikeTheirFaces) {
  auto mesh = generate_mesh_shape("box_hedge", {.size_m = {12, 0.8, 1.2}, .seed = 3});
  ASSERT_TRUE(mesh);
  const auto whole = MeshSurface::create(*mesh);
  ASSERT_TRUE(whole);
  const View view = View::look({-4, -3, 1.5}, 1.2, -0.1, 0.7, {640, 480}, 0.1, 1000.0);
  FixedLevelOptions options;
  options.horizon_m = 9;
  options.canopy_m = 0.05f;
  FixedTriangles together;
  whole->fixed_level_triangles(view, 0.05f, options, together);
  size_t one_by_one = 0;
  for (size_t i = 0; i < mesh->indices.size(); i += 3) {
    const auto face = MeshSurface::create(mesh->positions, std::span(mesh->indices).subspan(i, 3), mesh->colors);
    ASSERT_TRUE(face);
    FixedTriangles out;
    face->fixed_level_triangles(view, 0.05f, options, out);
    one_by_one += out.size();
  }
  EXPECT_GT(one_by_one, 50u);
  EXPECT_LT(one_by_one, whole->faces());
  EXPECT_EQ(together.size(), one_by_one);
}

TEST(MeshSurface, ColoursAreThoseOfTheCornersAndBetween) {
  const MeshSurface surface = surface_of(k_level_face, {{200, 0, 0}, {0, 200, 0}, {0, 0, 200}});
  FixedTriangles out;
  surface.all_triangles(100.0f, out);
  ASSERT_EQ(out.size(), 1u);
  const auto whole = surface.piece_colors(out.id()[0]);
  EXPECT_EQ(whole[0], glm::u8vec3(200, 0, 0));
  surface.all_triangles(9.0f, out);
  ASSERT_EQ(out.size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    const auto half = surface.piece_colors(out.id()[i]);
    EXPECT_EQ(half[0], glm::u8vec3(0, 100, 100));
    EXPECT_EQ(half[i == 0 ? 1 : 2], glm::u8vec3(200, 0, 0));
  }
}

TEST(MeshSurface, RefusesWhatIsNoMesh) {
  const std::vector<glm::dvec3> corners = k_level_face;
  const std::vector<uint32_t> good{0, 1, 2};
  const auto message = [&](const std::vector<glm::dvec3>& positions, const std::vector<uint32_t>& indices,
                           const std::vector<glm::u8vec3>& colors = {}) {
    const auto surface = MeshSurface::create(positions, indices, colors);
    return surface ? std::string("accepted") : surface.error().message;
  };
  EXPECT_NE(message(corners, {0, 1}).find("three indices"), std::string::npos);
  EXPECT_NE(message(corners, {0, 1, 3}).find("face 0"), std::string::npos);
  EXPECT_NE(message(corners, good, {{1, 2, 3}}).find("1 colours for 3"), std::string::npos);
  EXPECT_NE(message(corners, {}).find("no face"), std::string::npos);
  EXPECT_NE(message(corners, {0, 0, 1}).find("no face"), std::string::npos);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(message({{0, 0, 0}, {1, 0, 0}, {nan, 1, 0}}, good).find("no face"), std::string::npos);
}

// The good face among bad ones keeps its number, so that mending the others changes no plant.
TEST(MeshSurface, BadFacesAreLeftOutAndCounted) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<glm::dvec3> corners{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {0, 0, 0}, {nan, 0, 0}, {0, 1, 0}};
  corners.insert(corners.end(), k_level_face.begin(), k_level_face.end());
  const MeshSurface surface = surface_of(corners);
  EXPECT_EQ(surface.report().dropped_faces, 2u);
  EXPECT_EQ(surface.report().first_dropped, 0u);
  EXPECT_EQ(surface.report().open_edges, 3u);
  FixedTriangles out;
  surface.all_triangles(0.3f, out);
  ASSERT_EQ(out.size(), 64u);
  for (const TriangleId id : out.id()) EXPECT_EQ(id.bits >> 35 & 0x7fffff, 2u);
}

TEST(MeshSurface, GeneratedShapesAreClosedAboveTheGround) {
  for (const char* shape : {"box_hedge", "topiary"}) {
    const auto mesh = generate_mesh_shape(shape, {.size_m = {2.0, 0.8, 1.4}, .seed = 1});
    ASSERT_TRUE(mesh) << shape;
    const auto surface = MeshSurface::create(*mesh);
    ASSERT_TRUE(surface) << shape;
    EXPECT_EQ(surface->report().non_manifold_edges, 0u) << shape;
    // Open edges stand below the ground only.
    TriangleMesh above;
    double lowest = 1e9, volume = 0;
    const auto corners = surface->corners();
    for (size_t i = 0; i < corners.size(); i += 3) {
      lowest = std::min({lowest, corners[i].z, corners[i + 1].z, corners[i + 2].z});
      volume += glm::dot(corners[i], glm::cross(corners[i + 1], corners[i + 2])) / 6;
    }
    EXPECT_LT(lowest, -0.2) << shape;
    EXPECT_GT(volume, 0.2) << shape << ": faces look inwards";
    size_t rim = 0;
    for (size_t i = 0; i < corners.size(); ++i) {
      const glm::dvec3 a = corners[i], b = corners[i / 3 * 3 + (i + 1) % 3];
      rim += a.z < -0.25 && b.z < -0.25 && a != b ? 1u : 0u;
    }
    EXPECT_EQ(surface->report().open_edges, rim) << shape;
  }
}

TEST(MeshSurface, GeneratedShapesRefuseOtherNamesAndSizes) {
  EXPECT_FALSE(generate_mesh_shape("swan", {}));
  EXPECT_FALSE(generate_mesh_shape("topiary", {.size_m = {0.1, 1, 1}}));
  EXPECT_FALSE(generate_mesh_shape("box_hedge", {.size_m = {1, std::nan(""), 1}}));
}

// ---- plants ----

Layer ivy() {
  Layer layer;
  Species species;
  species.name = "ivy";
  species.reference_hsv = {0.25f, 0.5f, 0.4f};
  layer.species = {species};
  layer.on_mesh = true;
  layer.triangle_area_m2 = 0.3f;
  layer.density = 300;
  layer.horizon_m = 40;
  layer.full_distance_m = 30;
  return layer;
}

std::vector<Plant> plants_seen(const Layer& layer, const MeshSurface& surface, const View& view) {
  FixedLevelOptions options;
  options.horizon_m = layer.horizon_m * float(view.zoom());
  options.canopy_m = canopy_height(layer);
  FixedTriangles triangles;
  surface.fixed_level_triangles(view, layer.triangle_area_m2, options, triangles);
  Seeding seeding;
  seed(layer, view, surface, triangles, seeding);
  return grow_plants(layer, view, triangles, seeding);
}

auto key(const Plant& p) {
  return std::tuple(p.triangle.bits, p.rank);
}

/// Triangles of any shape and direction, some long and thin.
MeshSurface odd_triangles() {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-4, 4), thin(0.1, 1.0);
  std::vector<glm::dvec3> corners;
  for (int i = 0; i < 24; ++i) {
    const glm::dvec3 a(place(random), place(random), place(random)), b(place(random), place(random), place(random));
    const glm::dvec3 c(place(random), place(random), place(random));
    corners.insert(corners.end(), {a, b, a + (c - a) * thin(random)});
  }
  return surface_of(corners);
}

// Weights of seeds in their whole faces, in cells of equal area: the four triangles of a face's middles, twice.
TEST(PlantsOnMeshes, AreUniformOverTrianglesOfAnyShape) {
  const MeshSurface surface = odd_triangles();
  Layer layer = ivy();
  layer.plain = true;
  layer.cluster_size = 1;  // seeds of a cluster share a stratum: they are not independent
  const auto plants = query_plants(layer, surface, PlantRegion::rectangle({-20, -20}, {20, 20}));
  ASSERT_TRUE(plants) << plants.error().message;
  std::vector<int> cells(64);
  std::map<size_t, int> faces;
  double area = 0;
  for (const Plant& plant : *plants) {
    const size_t face = plant.triangle.bits >> 35 & 0x7fffff;
    const glm::dvec3* c = &surface.corners()[3 * face];
    const glm::dvec3 u = c[1] - c[0], v = c[2] - c[0], n = glm::cross(u, v), p = plant.position - c[0];
    double a = glm::dot(glm::cross(p, v), n) / glm::dot(n, n), b = glm::dot(glm::cross(u, p), n) / glm::dot(n, n);
    ASSERT_GE(std::min(a, b), -1e-4);
    ASSERT_LE(a + b, 1 + 1e-4);
    EXPECT_LT(std::abs(glm::dot(p, glm::normalize(n))), 1e-4) << "off its face";
    ++faces[face];
    size_t cell = 0;
    for (int level = 0; level < 3; ++level) {
      a *= 2, b *= 2;
      const size_t corner = a >= 1 ? 1 : b >= 1 ? 2 : a + b <= 1 ? 0 : 3;
      if (corner == 1) a -= 1;
      if (corner == 2) b -= 1;
      if (corner == 3) a = 1 - a, b = 1 - b;
      cell = cell * 4 + corner;
    }
    ++cells[cell];
  }
  EXPECT_GT(plants->size(), 20000u);
  EXPECT_LT(chi_square(cells), chi_square_limit(63, 3.1)) << "beyond the 99.9 % point";
  for (size_t face = 0; face < surface.faces(); ++face) {
    const glm::dvec3* c = &surface.corners()[3 * face];
    area = 0.5 * glm::length(glm::cross(c[1] - c[0], c[2] - c[0]));
    // Each piece rounds up.
    EXPECT_GE(faces[face], area * 300) << face;
    EXPECT_LE(faces[face], area * 300 * 1.05 + 64) << face;
  }
}

TEST(PlantsOnMeshes, AreTheSameFromEveryView) {
  auto mesh = generate_mesh_shape("topiary", {.size_m = {1.5, 1.5, 2.2}, .seed = 2});
  ASSERT_TRUE(mesh);
  mesh->transform(glm::dmat4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 512345.678, -4123456.5, 812.25, 1));
  const auto surface = MeshSurface::create(*mesh);
  ASSERT_TRUE(surface);
  const glm::dvec3 middle(512345.678, -4123456.5, 813.25);
  std::map<std::tuple<uint64_t, uint32_t>, Plant> known;
  size_t again = 0;
  for (int turn = 0; turn < 12; ++turn) {
    const double angle = 0.6 * turn;
    const glm::dvec3 eye = middle + glm::dvec3(-5 * std::cos(angle), -5 * std::sin(angle), 0.3 * turn - 1);
    const View view = View::look(eye, angle, 0, 1.0, {640, 480}, 0.1, 100);
    for (const Plant& plant : plants_seen(ivy(), *surface, view)) {
      const auto [place, added] = known.emplace(key(plant), plant);
      if (added) continue;
      ++again;
      const Plant& before = place->second;
      EXPECT_EQ(before.position, plant.position);
      EXPECT_EQ(before.height, plant.height);
      EXPECT_EQ(before.azimuth, plant.azimuth);
      EXPECT_EQ(before.axis, plant.axis);
    }
  }
  EXPECT_GT(again, 5000u);
}

TEST(PlantsOnMeshes, OfARegionAreThoseThatAViewShows) {
  auto mesh = generate_mesh_shape("topiary", {.size_m = {1.5, 1.5, 2.2}, .seed = 2});
  const auto surface = MeshSurface::create(*mesh);
  ASSERT_TRUE(surface);
  const auto all = query_plants(ivy(), *surface, PlantRegion::disc({0, 0}, 5));
  ASSERT_TRUE(all);
  std::map<std::tuple<uint64_t, uint32_t>, Plant> known;
  for (const Plant& plant : *all) known.emplace(key(plant), plant);
  const auto seen = plants_seen(ivy(), *surface, View::look({-5, 0, 1.2}, 0, 0, 1.0, {640, 480}, 0.1, 100));
  ASSERT_GT(seen.size(), 500u);
  for (const Plant& plant : seen) {
    ASSERT_TRUE(known.contains(key(plant)));
    EXPECT_EQ(known.at(key(plant)).position, plant.position);
  }
  const auto half = query_plants(ivy(), *surface, PlantRegion::rectangle({0, -5}, {5, 5}));
  ASSERT_TRUE(half);
  for (const Plant& plant : *half) EXPECT_GE(plant.position.x, 0);
  EXPECT_NEAR(double(half->size()), 0.5 * double(all->size()), 0.1 * double(all->size()));
  EXPECT_FALSE(query_plants(ivy(), *surface, PlantRegion::disc({0, 0}, 5), {.most_plants = 10}));
}

TEST(PlantsOnMeshes, GrowAlongTheNormalAndHangOnWalls) {
  // A level face, a wall that looks south, an overhang.
  const MeshSurface surface =
      surface_of({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {4, 0, 0}, {6, 0, 0}, {4, 0, 2}, {8, 0, 3}, {8, 2, 3}, {10, 0, 3}});
  const glm::vec3 axes[] = {{0, 0, 1}, {0, -1, 0}, {0, 0, -1}};
  Layer layer = ivy();
  layer.species[0].stiffness = {0.4f, 0.5f};
  const auto plants = query_plants(layer, surface, PlantRegion::rectangle({-20, -20}, {20, 20}));
  ASSERT_TRUE(plants);
  float widest[3] = {0, 0, 0}, stiffest[3] = {0, 0, 0};
  for (const Plant& plant : *plants) {
    const size_t face = plant.triangle.bits >> 35 & 0x7fffff;
    EXPECT_LT(glm::length(plant.axis - axes[face]), 1e-6f);
    widest[face] = std::max(widest[face], std::abs(plant.azimuth));
    stiffest[face] = std::max(stiffest[face], plant.stiffness);
  }
  EXPECT_GT(widest[0], 3.0f);
  EXPECT_LT(widest[1], 0.31f * 3.1416f);
  EXPECT_LE(stiffest[0], 0.5f);
  EXPECT_EQ(stiffest[2], 1.0f);
}

TEST(PlantsOnMeshes, AreChosenByTheSurfacesOwnColour) {
  const std::vector<glm::dvec3> corners{{0, 0, 0}, {4, 0, 0}, {0, 0, 4}, {4, 0, 0}, {4, 0, 4}, {0, 0, 4}};
  const glm::u8vec3 green(60, 90, 30), brown(120, 80, 50);
  const MeshSurface surface = surface_of(corners, {green, green, green, brown, brown, brown});
  Layer layer = ivy();
  const auto hsv = [](float hue) { return glm::vec3(hue, 0.6f, 0.4f); };
  layer.species = {layer.species[0], layer.species[0], layer.species[0]};
  layer.species[0].reference_hsv = hsv(0.25f);
  layer.species[1].reference_hsv = hsv(0.07f);
  layer.species[2].reference_hsv = hsv(0.6f);
  for (Species& species : layer.species) species.max_distance = 0.12f;
  const auto plants = query_plants(layer, surface, PlantRegion::rectangle({-20, -20}, {20, 20}));
  ASSERT_TRUE(plants);
  ASSERT_GT(plants->size(), 1000u);
  for (const Plant& plant : *plants) EXPECT_EQ(plant.species, uint32_t(plant.triangle.bits >> 35 & 0x7fffff));
}

TEST(PlantsOnMeshes, RulesOfPlaceThatDoNotFitAreRefused) {
  const auto message = [](auto change) {
    Layer layer = ivy();
    change(layer);
    const auto valid = validate(layer);
    return valid ? std::string() : valid.error().message;
  };
  EXPECT_EQ(message([](Layer&) {}), "");
  EXPECT_NE(message([](Layer& l) { l.mask_file = "m.png"; }).find("mask"), std::string::npos);
  EXPECT_NE(message([](Layer& l) { l.distribution_file = "m.png"; }).find("distribution"), std::string::npos);
  EXPECT_NE(message([](Layer& l) { l.species[0].mask_file = "m.png"; }).find("'ivy'"), std::string::npos);
  EXPECT_NE(message([](Layer& l) { l.species[0].phototropism = 0.5f; }).find("phototropism"), std::string::npos);
}

}  // namespace
}  // namespace sward
