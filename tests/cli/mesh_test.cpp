// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// mesh and plants without GL: files well-formed, budgets kept, and the bound in pixels held against every sample of a
// map whose heights this test knows.

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <set>

#include "cli_support.h"

namespace {

using Vec3 = std::array<double, 3>;

struct Ply {
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> triangles;
};

// Reads exactly the form that the contract names, and fails on anything else.
void read_ply(const std::string& bytes, Ply& ply) {
  const std::string end = "end_header\n";
  const size_t body = bytes.find(end) + end.size();
  ASSERT_NE(bytes.find(end), std::string::npos);
  const std::vector<std::string> lines = cli::split(bytes.substr(0, body), '\n');
  ASSERT_EQ(lines.size(), 9u);
  EXPECT_EQ(lines[0], "ply");
  EXPECT_EQ(lines[1], "format binary_little_endian 1.0");
  ASSERT_EQ(lines[2].rfind("element vertex ", 0), 0u);
  EXPECT_EQ(lines[3] + lines[4] + lines[5], "property double xproperty double yproperty double z");
  ASSERT_EQ(lines[6].rfind("element face ", 0), 0u);
  EXPECT_EQ(lines[7], "property list uchar int vertex_indices");
  const size_t vertices = std::stoul(lines[2].substr(15)), triangles = std::stoul(lines[6].substr(13));
  ASSERT_EQ(bytes.size(), body + vertices * 24 + triangles * 13);
  ply.vertices.resize(vertices);
  std::memcpy(ply.vertices.data(), bytes.data() + body, vertices * 24);
  for (size_t i = 0; i < triangles; ++i) {
    const char* at = bytes.data() + body + vertices * 24 + i * 13;
    ASSERT_EQ(*at, 3);
    ply.triangles.emplace_back();
    std::memcpy(ply.triangles.back().data(), at + 1, 12);
    for (const int index : ply.triangles.back()) ASSERT_LT(size_t(index), vertices);
  }
}

// Twice the area seen from above; positive when counter-clockwise.
double area_from_above(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
}

class CliMesh : public cli::CliTest {
 protected:
  Ply mesh_at(int frame, const std::string& options) {
    Ply ply;
    const cli::Result result = run("mesh " + scene() + " --at " + std::to_string(frame) + " -o m.ply " + options);
    EXPECT_EQ(result.status, 0) << result.err;
    read_ply(cli::read_file(folder() / "m.ply"), ply);
    return ply;
  }
};

TEST_F(CliMesh, AllLeavesCoverTheMapWithoutCracks) {
  const Ply ply = mesh_at(15, "--fps 1 --all --triangles 700");
  double area = 0;
  std::map<std::pair<int, int>, int> edges;
  for (const auto& t : ply.triangles) {
    const double twice =
        area_from_above(ply.vertices[size_t(t[0])], ply.vertices[size_t(t[1])], ply.vertices[size_t(t[2])]);
    EXPECT_GT(twice, 0) << "clockwise or flat";
    area += twice / 2;
    for (int i = 0; i < 3; ++i) ++edges[{t[size_t(i)], t[size_t(i + 1) % 3]}];
  }
  Vec3 low = ply.vertices[0], high = low;
  for (const Vec3& vertex : ply.vertices)
    for (size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], vertex[axis]);
      high[axis] = std::max(high[axis], vertex[axis]);
    }
  EXPECT_NEAR(area, (high[0] - low[0]) * (high[1] - low[1]), 1e-6 * area);
  // Each edge once in either direction, but for the outer ones.
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1) << "an edge is used twice in one direction";
    if (edges.count({edge.second, edge.first}) != 0) continue;
    const Vec3 &a = ply.vertices[size_t(edge.first)], &b = ply.vertices[size_t(edge.second)];
    const bool outer =
        (a[0] == b[0] && (a[0] == low[0] || a[0] == high[0])) || (a[1] == b[1] && (a[1] == low[1] || a[1] == high[1]));
    EXPECT_TRUE(outer) << "a crack at " << a[0] << ", " << a[1];
  }
}

TEST_F(CliMesh, NeverAboveTheBudget) {
  for (const int budget : {50, 300, 1200}) {
    ASSERT_EQ(run("mesh " + scene() + " --fps 6 --timings t.csv --triangles " + std::to_string(budget)).status, 0);
    const auto rows = cli::read_csv(folder() / "t.csv");
    const std::vector<std::string> header{"frame",  "update_ms", "fixed_level_ms", "visible",
                                          "splits", "merges",    "bound_px",       "fixed_triangles"};
    ASSERT_EQ(rows.size(), 181u);
    EXPECT_EQ(rows[0], header);
    int most = 0;
    for (size_t i = 1; i < rows.size(); ++i) {
      ASSERT_EQ(rows[i].size(), header.size());
      EXPECT_EQ(rows[i][0], std::to_string(i - 1));
      EXPECT_LE(std::stoi(rows[i][3]), budget);
      most = std::max(most, std::stoi(rows[i][3]));
    }
    EXPECT_GT(most, budget * 8 / 10) << "the budget is there to be used";
  }
}

TEST_F(CliMesh, TheSameTwice) {
  std::set<std::string> meshes;
  for (int i = 0; i < 2; ++i) {
    ASSERT_EQ(run("mesh " + scene() + " --fps 2 --at 40 -o m.ply").status, 0);
    meshes.insert(cli::read_file(folder() / "m.ply"));
  }
  EXPECT_EQ(meshes.size(), 1u);
}

// A camera as the flight's file gives it, and projection by its own arithmetic: yaw 0 east, counter-clockwise; 50
// degrees of vertical field of view.
struct Camera {
  double x, y, z, yaw, pitch;  // metres, degrees
  int width, height;

  static constexpr double k_degree = 3.14159265358979323846 / 180;
  double focal() const { return height / 2.0 / std::tan(25 * k_degree); }

  // Pixels right of and above the middle, and metres ahead.
  Vec3 project(const Vec3& world) const {
    const double cy = std::cos(yaw * k_degree), sy = std::sin(yaw * k_degree);
    const double cp = std::cos(pitch * k_degree), sp = std::sin(pitch * k_degree);
    const double dx = world[0] - x, dy = world[1] - y, dz = world[2] - z;
    const double along = cy * dx + sy * dy, right = sy * dx - cy * dy;
    const double ahead = cp * along + sp * dz, up = -sp * along + cp * dz;
    return {focal() * right / ahead, focal() * up / ahead, ahead};
  }
  bool sees(const Vec3& world) const {
    const Vec3 at = project(world);
    return at[2] > 0.1 && std::abs(at[0]) <= width / 2.0 && std::abs(at[1]) <= height / 2.0;
  }
  std::string row(double time) const {
    std::ostringstream line;
    line.precision(17);
    line << time << ',' << x << ',' << y << ',' << z << ',' << yaw << ',' << pitch << '\n';
    return line.str();
  }
  // The other form's row: view and projection column by column.
  std::string matrix_row(int frame) const {
    const double cy = std::cos(yaw * k_degree), sy = std::sin(yaw * k_degree);
    const double cp = std::cos(pitch * k_degree), sp = std::sin(pitch * k_degree);
    const double near_plane = 0.1, far_plane = 3000, f = 1 / std::tan(25 * k_degree);
    const Vec3 right{sy, -cy, 0}, up{-sp * cy, -sp * sy, cp}, back{-cp * cy, -cp * sy, -sp};
    std::ostringstream line;
    line.precision(17);
    line << frame << ',' << x << ',' << y << ',' << z;
    for (size_t axis = 0; axis < 3; ++axis) line << ',' << right[axis] << ',' << up[axis] << ',' << back[axis] << ",0";
    for (const Vec3& side : {right, up, back}) line << ',' << -(side[0] * x + side[1] * y + side[2] * z);
    line << ",1," << f * height / width << ",0,0,0,0," << f << ",0,0,0,0,"
         << -(far_plane + near_plane) / (far_plane - near_plane) << ",-1,0,0,"
         << -2 * far_plane * near_plane / (far_plane - near_plane) << ",0," << width << ',' << height << '\n';
    return line.str();
  }
};

std::string matrix_header() {
  std::string header = "frame,ex,ey,ez";
  for (const char* matrix : {",v", ",p"})
    for (int i = 0; i < 16; ++i) header += matrix + std::to_string(i);
  return header + ",vpw,vph\n";
}

std::vector<Camera> test_cameras() {
  std::vector<Camera> cameras;
  for (int i = 0; i < 5; ++i)
    cameras.push_back({-200.0 + 60 * i, -120.0 + 50 * i, 120 - 18.0 * i, 20 + 40.0 * i, -25 + 4.0 * i, 1920, 1080});
  return cameras;
}

// Both forms of a flight are the same flight.
TEST_F(CliMesh, BothFormsOfFlights) {
  std::string poses = "time,x,y,z,yaw,pitch\n", matrices = matrix_header();
  const std::vector<Camera> cameras = test_cameras();
  for (size_t i = 0; i < cameras.size(); ++i) {
    poses += cameras[i].row(double(i) / 60);
    matrices += cameras[i].matrix_row(int(i));
  }
  cli::write_file(inputs() / "poses.csv", poses);
  cli::write_file(inputs() / "matrices.csv", matrices);
  std::vector<std::vector<std::vector<std::string>>> timings;
  for (const char* name : {"poses.csv", "matrices.csv"}) {
    const cli::Result result =
        run("mesh " + scene() + " --triangles 400 --timings t.csv --flight '" + (inputs() / name).string() + "'");
    ASSERT_EQ(result.status, 0) << result.err;
    timings.push_back(cli::read_csv(folder() / "t.csv"));
    ASSERT_EQ(timings.back().size(), cameras.size() + 1);
  }
  for (size_t i = 1; i <= cameras.size(); ++i) {
    for (const size_t column : {3, 4, 5, 7})
      EXPECT_EQ(timings[0][i][column], timings[1][i][column]) << "frame " << i - 1;
    EXPECT_NEAR(std::stod(timings[0][i][6]), std::stod(timings[1][i][6]), 1e-3 * std::stod(timings[0][i][6]));
  }
}

#ifdef SWARD_IMAGE_IO

Vec3 sample(int column, int row) {
  return {cli::sample_x(column), cli::sample_y(row), cli::raw_height(column, row) * cli::k_scale};
}

// Largest distance on screen between a sample and the mesh's point above or below it, over the samples that the frustum
// holds and visible leaves cover.
double largest_error_px(const Ply& ply, const Camera& camera, int& tested) {
  double largest = 0;
  for (const auto& t : ply.triangles) {
    const Vec3 &a = ply.vertices[size_t(t[0])], &b = ply.vertices[size_t(t[1])], &c = ply.vertices[size_t(t[2])];
    const auto column = [](double x) { return x / cli::k_spacing + (cli::k_columns - 1) / 2.0; };
    const auto row = [](double y) { return (cli::k_rows - 1) / 2.0 - y / cli::k_spacing; };
    const int last_column = std::min(int(std::floor(column(std::max({a[0], b[0], c[0]})) + 1e-9)), cli::k_columns - 1);
    const int last_row = std::min(int(std::floor(row(std::min({a[1], b[1], c[1]})) + 1e-9)), cli::k_rows - 1);
    const double twice = area_from_above(a, b, c);
    for (int i = std::max(int(std::ceil(column(std::min({a[0], b[0], c[0]})) - 1e-9)), 0); i <= last_column; ++i)
      for (int j = std::max(int(std::ceil(row(std::max({a[1], b[1], c[1]})) - 1e-9)), 0); j <= last_row; ++j) {
        const Vec3 truth = sample(i, j);
        const double u = area_from_above(truth, c, a) / twice, v = area_from_above(truth, a, b) / twice;
        if (u < -1e-9 || v < -1e-9 || u + v > 1 + 1e-9 || !camera.sees(truth)) continue;
        const Vec3 drawn{truth[0], truth[1], a[2] + u * (b[2] - a[2]) + v * (c[2] - a[2])};
        const Vec3 p = camera.project(truth), q = camera.project(drawn);
        largest = std::max(largest, std::hypot(p[0] - q[0], p[1] - q[1]));
        ++tested;
      }
  }
  return largest;
}

// The cameras are far apart, so that with the morph on vertices are on their way in every frame.
TEST_F(CliMesh, TheBoundHoldsForEverySample) {
  const std::vector<Camera> cameras = test_cameras();
  std::string poses = "time,x,y,z,yaw,pitch\n";
  for (size_t i = 0; i < cameras.size(); ++i) poses += cameras[i].row(double(i) / 60);
  cli::write_file(inputs() / "poses.csv", poses);
  for (const std::string morph : {"", "--no-morph "}) {
    const std::string options = " --triangles 1500 " + morph + "--flight '" + (inputs() / "poses.csv").string() + "' ";
    ASSERT_EQ(run("mesh " + scene() + options + "--timings t.csv").status, 0);
    const auto rows = cli::read_csv(folder() / "t.csv");
    std::vector<double> ratios;
    for (size_t i = 0; i < cameras.size(); ++i) {
      const Ply ply = mesh_at(int(i), options);
      EXPECT_EQ(std::to_string(ply.triangles.size()), rows[i + 1][3]);
      int tested = 0;
      const double bound = std::stod(rows[i + 1][6]), error = largest_error_px(ply, cameras[i], tested);
      EXPECT_GT(tested, 200) << "the camera looks at the map";
      EXPECT_GT(error, 0);
      EXPECT_LE(error, bound) << "frame " << i << " " << morph;
      ratios.push_back(bound / error);
    }
    std::sort(ratios.begin(), ratios.end());
    EXPECT_LE(ratios[ratios.size() / 2], 4) << "a bound must be useful too";
  }
}

// Raw units are not normalised: height = raw * scale + offset at every sample.
TEST_F(CliMesh, HeightOptionsAreMetresARawUnit) {
  const std::string map = " --height '" + (inputs() / "small.pgm").string() + "' ";
  ASSERT_EQ(run("mesh" + map +
                "--spacing 2,8 --height-scale 0.5 --height-offset -100 --triangles 100000 --fps 1 --at 0 "
                "--all -o m.ply")
                .status,
            0);
  Ply ply;
  read_ply(cli::read_file(folder() / "m.ply"), ply);
  int found = 0;
  for (const Vec3& vertex : ply.vertices) {
    const double column = vertex[0] / 2 + (cli::k_columns - 1) / 2.0, row = (cli::k_rows - 1) / 2.0 - vertex[1] / 8;
    ASSERT_EQ(column, std::floor(column));
    if (column < 0 || column >= cli::k_columns || row < 0 || row >= cli::k_rows) continue;
    EXPECT_NEAR(vertex[2], cli::raw_height(int(column), int(row)) * 0.5 - 100, 1e-6);
    ++found;
  }
  EXPECT_GT(found, 1000);
}

#endif  // SWARD_IMAGE_IO

TEST_F(CliMesh, PlantsAreListed) {
  ASSERT_EQ(run("plants " + scene() + " --fps 1 --at 15 -o p.csv").status, 0);
  const auto rows = cli::read_csv(folder() / "p.csv");
  const std::vector<std::string> header{"triangle", "rank",  "species",   "x",       "y",     "z",
                                        "height",   "width", "stiffness", "azimuth", "score", "fade"};
  ASSERT_GT(rows.size(), 100u);
  EXPECT_EQ(rows[0], header);
  std::set<std::pair<std::string, std::string>> identities;
  for (size_t i = 1; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i].size(), header.size());
    EXPECT_TRUE(identities.insert({rows[i][0], rows[i][1]}).second) << "two plants of one triangle and rank";
    EXPECT_LT(std::stoi(rows[i][2]), 2);
    EXPECT_LE(std::abs(std::stod(rows[i][3])), 256);
    EXPECT_GT(std::stod(rows[i][11]), 0);
    EXPECT_LE(std::stod(rows[i][11]), 1);
  }
}

TEST_F(CliMesh, PlantsOfTheGpuAreThoseOfTheCpu) {
  SWARD_NEEDS_GL();
  const std::string command = "plants " + scene() + " --fps 1 --at 15 ";
  ASSERT_EQ(run(command + "-o cpu.csv").status, 0);
  const cli::Result gpu = run(command + "--gpu -o gpu.csv");
  ASSERT_EQ(gpu.status, 0) << gpu.err;
  std::map<std::pair<std::string, std::string>, std::vector<std::string>> cpu_plants;
  for (const auto& row : cli::read_csv(folder() / "cpu.csv")) cpu_plants[{row[0], row[1]}] = row;
  const auto gpu_rows = cli::read_csv(folder() / "gpu.csv");
  EXPECT_EQ(gpu_rows.size(), cpu_plants.size());
  size_t other_species = 0;
  for (size_t i = 1; i < gpu_rows.size(); ++i) {
    const auto twin = cpu_plants.find({gpu_rows[i][0], gpu_rows[i][1]});
    ASSERT_NE(twin, cpu_plants.end());
    other_species += twin->second[2] != gpu_rows[i][2];
    for (size_t axis = 3; axis < 6; ++axis)
      EXPECT_NEAR(std::stod(gpu_rows[i][axis]), std::stod(twin->second[axis]), 1e-3);
  }
  EXPECT_LE(other_species * 1000, gpu_rows.size());
}

}  // namespace
