// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Plants that are small meshes: what is refused, and what growth reads of them.
#include <gtest/gtest.h>

#include <sward/scene/generated_mesh.h>
#include <sward/scene/scene.h>
#include <sward/vegetation/mesh_surface.h>
#include <sward/vegetation/species.h>
#include <cmath>
#include <limits>
#include <numeric>

#include "vegetation/plant_mesh.h"

namespace sward {
namespace {

TriangleMesh arrow() {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 1}, {2, 0, 1}, {0, 0, 5}, {0, 1, 3}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  mesh.colors = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {250, 251, 252}};
  return mesh;
}

Layer layer_of(TriangleMesh mesh, std::vector<float> heights = {}) {
  Layer layer;
  Species species;
  species.name = "arrow";
  species.kind = PlantKind::mesh;
  species.mesh.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
  species.mesh.heights = std::move(heights);
  layer.species = {species};
  return layer;
}

std::string message_of(const Layer& layer) {
  const auto valid = validate(layer);
  return valid ? "" : valid.error().message;
}

template <class Change>
void expect_refused(Change change, const std::string& words) {
  TriangleMesh mesh = arrow();
  change(mesh);
  const std::string message = message_of(layer_of(std::move(mesh)));
  EXPECT_NE(message.find(words), std::string::npos) << message;
  EXPECT_NE(message.find("'arrow'"), std::string::npos) << message;
}

TEST(PlantMesh, WhatCannotGrowIsRefused) {
  EXPECT_EQ(message_of(layer_of(arrow())), "");
  expect_refused([](TriangleMesh& m) { m.indices.pop_back(); }, "multiple of three");
  expect_refused([](TriangleMesh& m) { m.indices[4] = 4; }, "corner 4");
  expect_refused([](TriangleMesh& m) { m.positions[1].y = std::nan(""); }, "not finite");
  expect_refused([](TriangleMesh& m) { m.colors.clear(); }, "no colour");
  expect_refused([](TriangleMesh& m) { m.indices.clear(); }, "no face with an area");
  expect_refused([](TriangleMesh& m) { m.positions = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}}; }, "no height");
  expect_refused(
      [](TriangleMesh& m) {
        for (int i = 0; i < 600; ++i) m.append(arrow());
      },
      "at most 512");
  EXPECT_NE(message_of(layer_of(arrow(), {0, 1})).find("2 heights for 4"), std::string::npos);
  EXPECT_NE(message_of(layer_of(arrow(), {0, 1, 1.5f, 0})).find("not in [0, 1]"), std::string::npos);
  Layer none = layer_of(arrow());
  none.species[0].mesh.mesh = nullptr;
  EXPECT_NE(message_of(none).find("mesh: there is none"), std::string::npos);
  none.species[0].mesh.file = "arrow.ply";
  EXPECT_EQ(message_of(none), "");
  const auto loaded = require_maps(none);
  ASSERT_FALSE(loaded);
  EXPECT_NE(loaded.error().message.find("arrow.ply"), std::string::npos);
}

TEST(PlantMesh, CornersAreScaledToTheAxisAndTheWidth) {
  const Layer layer = layer_of(arrow());
  const std::vector<glm::vec4> texels = make_mesh_texels(layer.species[0].mesh);
  ASSERT_EQ(texels.size(), 12u);
  for (size_t corner = 0; corner < 6; ++corner) {
    const glm::vec4 place = texels[2 * corner], normal = texels[2 * corner + 1];
    const int color = int(place.w);
    if (color == (4 << 16 | 5 << 8 | 6)) {
      EXPECT_EQ(glm::vec3(place), glm::vec3(0.5f, 0, 0));
    } else if (color == (7 << 16 | 8 << 8 | 9)) {
      EXPECT_EQ(glm::vec3(place), glm::vec3(0, 0, 1));
    } else if (color == (250 << 16 | 251 << 8 | 252)) {
      EXPECT_EQ(glm::vec3(place), glm::vec3(0, 0.25f, 0.5f));
    }
    EXPECT_EQ(normal.w, 0);
    EXPECT_NEAR(glm::length(glm::vec3(normal)), 1, 1e-6f);
  }
}

TEST(PlantMesh, AnOwnHeightCoordinateKeepsThePlace) {
  const Layer layer = layer_of(arrow(), {0, 0, 0.5f, 0.25f});
  for (size_t corner = 0; corner < 6; ++corner) {
    const std::vector<glm::vec4> texels = make_mesh_texels(layer.species[0].mesh);
    const glm::vec4 place = texels[2 * corner];
    if (int(place.w) != (7 << 16 | 8 << 8 | 9)) continue;
    EXPECT_EQ(place.z, 0.5f);
    EXPECT_EQ(texels[2 * corner + 1].w, 0.5f);
  }
}

// Any first share of the faces stands for all: their mean height is that of all.
TEST(PlantMesh, FirstFacesStandForAll) {
  auto thistle = generate_plant_shape("thistle");
  ASSERT_TRUE(thistle) << thistle.error().message;
  const Layer layer = layer_of(std::move(*thistle));
  ASSERT_EQ(message_of(layer), "");
  const PlantMesh& plant = layer.species[0].mesh;
  const int faces = face_count(plant);
  EXPECT_GT(faces, 100);
  EXPECT_LE(faces, 300);
  const std::vector<glm::vec4> texels = make_mesh_texels(plant);
  const auto mean = [&](int first) {
    double sum = 0;
    for (int corner = 0; corner < 3 * first; ++corner) sum += double(texels[size_t(2 * corner)].z);
    return sum / (3 * first);
  };
  EXPECT_NEAR(mean(faces / 4), mean(faces), 0.1);
  EXPECT_FALSE(generate_plant_shape("rose"));
}

TEST(PlantMesh, IsReadFromScenes) {
  const std::string text =
      "[terrain]\ngenerator = \"meadow\"\n[[layer]]\n[[layer.species]]\nname = \"t\"\ncolor = \"#304020\"\n";
  const auto message = [](const std::string& t) {
    const auto scene = parse_scene(t, "s.toml");
    return scene ? std::string() : scene.error().message;
  };
  EXPECT_EQ(message(text + "kind = \"mesh\"\n[layer.species.mesh]\nshape = \"thistle\"\n"), "");
  EXPECT_EQ(message(text + "kind = \"mesh\"\n[layer.species.mesh]\nfile = \"a.ply\"\n"), "");
  EXPECT_NE(message(text + "kind = \"mesh\"\n").find("s.toml:4"), std::string::npos);
  EXPECT_NE(message(text + "kind = \"mesh\"\n[layer.species.mesh]\n").find("s.toml:8"), std::string::npos);
  EXPECT_NE(message(text + "[layer.species.mesh]\nshape = \"thistle\"\n").find("s.toml:7"), std::string::npos);
}

}  // namespace
}  // namespace sward
