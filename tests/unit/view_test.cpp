// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>
#include <sward/terrain/color_map.h>
#include <sward/terrain/view.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

using sward::frustum_planes;
using sward::Plane;
using sward::View;

namespace {

constexpr double k_pi = 3.14159265358979323846;
constexpr double k_infinity = std::numeric_limits<double>::infinity();

// A projection from its numbers: x and y scale and shift, depth row (a, b), perspective or not.
glm::dmat4 perspective(double sx, double sy, glm::dvec2 shift, double a, double b) {
  glm::dmat4 m(0.0);
  m[0][0] = sx;
  m[1][1] = sy;
  m[2] = glm::dvec4(shift, a, -1.0);
  m[3][2] = b;
  return m;
}

struct Case {
  std::string name;
  glm::dmat4 projection;
  double near_distance;
  bool infinite_far;  // One plane has no place.
};

// near 0.5, far 200.
std::vector<Case> cases() {
  const double n = 0.5, f = 200.0;
  std::vector<Case> all;
  all.push_back({"normal", perspective(1.2, 1.9, {}, -(f + n) / (f - n), -2 * f * n / (f - n)), n, false});
  all.push_back({"off-centre", perspective(1.2, 1.9, {0.4, -0.3}, -(f + n) / (f - n), -2 * f * n / (f - n)), n, false});
  all.push_back({"infinite", perspective(1.2, 1.9, {}, -1.0, -2 * n), n, true});
  all.push_back({"reversed", perspective(1.2, 1.9, {}, (f + n) / (f - n), 2 * f * n / (f - n)), n, false});
  all.push_back({"reversed infinite", perspective(1.2, 1.9, {}, 1.0, 2 * n), n, true});
  all.push_back({"reversed, depth 0 to 1", perspective(1.2, 1.9, {}, n / (f - n), f * n / (f - n)), n, false});
  all.push_back({"reversed infinite, depth 0 to 1", perspective(1.2, 1.9, {}, 0.0, n), n, false});
  all.push_back({"upside down", perspective(1.2, -1.9, {}, -(f + n) / (f - n), -2 * f * n / (f - n)), n, false});
  glm::dmat4 flat(1.0);
  flat[0][0] = 0.05;
  flat[1][1] = 0.08;
  flat[2][2] = -2.0 / (f - n);
  flat[3] = {0.2, -0.1, -(f + n) / (f - n), 1.0};
  all.push_back({"orthographic", flat, n, false});
  flat[2][2] = -flat[2][2];
  flat[3][2] = -flat[3][2];
  all.push_back({"orthographic reversed", flat, n, false});
  return all;
}

View view_with(const glm::dmat4& projection) {
  View view = View::look({100, 200, 30}, 0.7, -0.3, 1.0, {1280, 720}, 0.1, 1000);
  view.clip_from_eye = projection;
  return view;
}

double signed_distance(const Plane& plane, glm::dvec3 p) {
  return glm::dot(plane.n, p) + plane.d;
}

TEST(View, LooksEastAtAzimuthZero) {
  const View view = View::look({5, 6, 7}, 0.0, 0.0, 1.0, {800, 600}, 0.1, 1000.0);
  EXPECT_NEAR(glm::length(view.eye_from_world * glm::dvec3(1, 0, 0) - glm::dvec3(0, 0, -1)), 0.0, 1e-15);
  EXPECT_NEAR(glm::length(view.eye_from_world * glm::dvec3(0, 1, 0) - glm::dvec3(-1, 0, 0)), 0.0, 1e-15);
  EXPECT_NEAR(glm::length(view.eye_from_world * glm::dvec3(0, 0, 1) - glm::dvec3(0, 1, 0)), 0.0, 1e-15);
}

TEST(View, AzimuthTurnsCounterClockwiseAndPitchUp) {
  const View view = View::look({}, k_pi / 2, k_pi / 6, 1.0, {800, 600}, 0.1, 1000.0);
  const glm::dvec3 ahead(0, std::cos(k_pi / 6), std::sin(k_pi / 6));
  EXPECT_NEAR(glm::length(view.eye_from_world * ahead - glm::dvec3(0, 0, -1)), 0.0, 1e-15);
  EXPECT_TRUE(view.validate());
}

TEST(View, NearAndFarPlaneEndTheDepthRange) {
  const View view = View::look({}, 0, 0, 1.0, {800, 600}, 0.25, 640.0);
  for (const auto& [distance, depth] : {std::pair(0.25, -1.0), std::pair(640.0, 1.0)}) {
    const glm::dvec4 clip = view.clip_from_relative() * glm::dvec4(distance, 0, 0, 1);
    EXPECT_NEAR(clip.z / clip.w, depth, 1e-12);
  }
  const View endless = View::look({}, 0, 0, 1.0, {800, 600}, 0.25, k_infinity);
  const glm::dvec4 clip = endless.clip_from_relative() * glm::dvec4(0.25, 0, 0, 1);
  EXPECT_NEAR(clip.z / clip.w, -1.0, 1e-12);
  EXPECT_TRUE(endless.validate());
}

TEST(View, PlanesAgreeWithTheClipTest) {
  for (const Case& c : cases()) {
    const View view = view_with(c.projection);
    ASSERT_TRUE(view.validate()) << c.name;
    const auto planes = frustum_planes(view);
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    int inside = 0;
    for (int i = 0; i < 20000; ++i) {
      const double reach = std::pow(10.0, double(random() % 1000) / 300.0 - 0.5);
      const glm::dvec3 p = reach * glm::dvec3(normal(random), normal(random), normal(random));
      const glm::dvec4 clip = view.clip_from_relative() * glm::dvec4(p, 1.0);
      double margin = k_infinity, nearest = k_infinity;
      for (int axis = 0; axis < 3; ++axis) {
        margin = std::min({margin, clip.w - clip[axis], clip.w + clip[axis]});
      }
      for (const Plane& plane : planes) nearest = std::min(nearest, signed_distance(plane, p));
      if (std::abs(margin) < 1e-9 * reach) continue;
      EXPECT_EQ(margin > 0.0, nearest > 0.0) << c.name << " at " << p.x << " " << p.y << " " << p.z;
      inside += margin > 0.0 ? 1 : 0;
    }
    EXPECT_GT(inside, 200) << c.name;
  }
}

TEST(View, PlanesComeInOrderAndNormalised) {
  for (const Case& c : cases()) {
    const View view = view_with(c.projection);
    const auto planes = frustum_planes(view);
    const glm::dmat3 world_from_eye = glm::transpose(view.eye_from_world);
    const glm::dvec3 right = world_from_eye[0], ahead = -world_from_eye[2];
    const glm::dvec3 up = c.projection[1][1] > 0 ? world_from_eye[1] : -world_from_eye[1];
    EXPECT_GT(glm::dot(planes[0].n, right), 0.0) << c.name;
    EXPECT_LT(glm::dot(planes[1].n, right), 0.0) << c.name;
    EXPECT_GT(glm::dot(planes[2].n, up), 0.0) << c.name;
    EXPECT_LT(glm::dot(planes[3].n, up), 0.0) << c.name;
    for (int i = 0; i < 5; ++i) EXPECT_NEAR(glm::length(planes[size_t(i)].n), 1.0, 1e-12) << c.name << " " << i;
    // The near plane: 0.5 m ahead, facing ahead.
    EXPECT_NEAR(glm::dot(planes[4].n, ahead), 1.0, 1e-12) << c.name;
    EXPECT_NEAR(planes[4].d, -0.5, 1e-9) << c.name;
    if (c.infinite_far) {
      EXPECT_EQ(planes[5].n, glm::dvec3(0.0)) << c.name;
      EXPECT_EQ(planes[5].d, 1.0) << c.name;
    } else {
      EXPECT_NEAR(glm::length(planes[5].n), 1.0, 1e-12) << c.name;
    }
  }
}

TEST(View, NearDistanceOfEveryProjection) {
  for (const Case& c : cases()) EXPECT_NEAR(view_with(c.projection).near_distance(), c.near_distance, 1e-9) << c.name;
}

TEST(View, FocalLengthIsTheSizeOfAMetreOneMetreAhead) {
  for (const Case& c : cases()) {
    const View view = view_with(c.projection);
    const auto pixel = [&](glm::dvec3 p) {
      const glm::dvec4 clip = view.clip_from_eye * glm::dvec4(p, 1.0);
      return 0.5 * glm::dvec2(clip) / clip.w * glm::dvec2(view.viewport);
    };
    const glm::dvec2 centre = pixel({0, 0, -1});
    EXPECT_NEAR(view.focal_px().x, std::abs(pixel({1, 0, -1}).x - centre.x), 1e-9) << c.name;
    EXPECT_NEAR(view.focal_px().y, std::abs(pixel({0, 1, -1}).y - centre.y), 1e-9) << c.name;
  }
}

TEST(View, ZoomIsAgainstFiftyDegrees) {
  const auto zoom = [](double degrees) {
    return View::look({}, 0, 0, degrees * k_pi / 180.0, {640, 480}, 0.1, 10.0).zoom();
  };
  EXPECT_NEAR(zoom(50.0), 1.0, 1e-12);
  // tan 25 / tan 5.
  EXPECT_NEAR(zoom(10.0), 5.3299, 1e-4);
}

TEST(View, FromMatricesTakesAHostsMatrices) {
  const View view = View::look({100, 200, 30}, 0.7, -0.3, 1.0, {1280, 720}, 0.1, 1000);
  glm::dmat4 matrix(view.eye_from_world);
  matrix[3] = glm::dvec4(view.eye_from_world * -view.eye, 1.0);
  const auto made = View::from_matrices(view.eye, matrix, view.clip_from_eye, view.viewport);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->eye_from_world, view.eye_from_world);
  EXPECT_EQ(made->clip_from_eye, view.clip_from_eye);

  glm::dmat4 scaled = matrix;
  scaled[0] *= 2.0;
  EXPECT_FALSE(View::from_matrices(view.eye, scaled, view.clip_from_eye, view.viewport));
  glm::dmat4 skewed = matrix;
  skewed[0][3] = 0.5;
  EXPECT_FALSE(View::from_matrices(view.eye, skewed, view.clip_from_eye, view.viewport));
  glm::dmat4 broken = matrix;
  broken[3][3] = std::nan("");
  EXPECT_FALSE(View::from_matrices(view.eye, broken, view.clip_from_eye, view.viewport));
}

TEST(View, RefusesWhatIsNoCamera) {
  const View good = View::look({1, 2, 3}, 0.2, 0.1, 1.0, {640, 480}, 0.1, 100.0);
  ASSERT_TRUE(good.validate());
  const auto message_of = [&](auto&& spoil) {
    View view = good;
    spoil(view);
    const auto result = view.validate();
    return result ? std::string() : result.error().message;
  };
  using std::string;
  const double nan = std::nan("");
  EXPECT_NE(message_of([](View& v) { v.viewport = {0, 480}; }).find("viewport"), string::npos);
  EXPECT_NE(message_of([](View& v) { v.viewport = {640, -1}; }).find("viewport"), string::npos);
  EXPECT_NE(message_of([&](View& v) { v.eye.y = nan; }).find("eye"), string::npos);
  EXPECT_NE(message_of([&](View& v) { v.eye.z = k_infinity; }).find("eye"), string::npos);
  EXPECT_NE(message_of([&](View& v) { v.eye_from_world[1][2] = nan; }).find("rotation"), string::npos);
  EXPECT_NE(message_of([&](View& v) { v.clip_from_eye[1][1] = nan; }).find("projection"), string::npos);
  EXPECT_NE(message_of([](View& v) { v.clip_from_eye[1][1] = 0.0; }).find("singular"), string::npos);
  EXPECT_NE(message_of([](View& v) { v.clip_from_eye = glm::dmat4(0.0); }).find("singular"), string::npos);
  EXPECT_NE(message_of([](View& v) { v.eye_from_world[0] *= -1.0; }).find("rotation"), string::npos);
  EXPECT_NE(message_of([](View& v) { v.eye_from_world *= 1.01; }).find("rotation"), string::npos);
}

TEST(ColorMap, ChecksItsSizes) {
  sward::ColorMap map{2, 3, std::vector<glm::u8vec4>(6), {0, 0}, {10, 20}};
  EXPECT_TRUE(map.validate());
  map.texels.pop_back();
  EXPECT_FALSE(map.validate());
  map = {0, 3, {}, {0, 0}, {10, 20}};
  EXPECT_FALSE(map.validate());
  map = {1, 1, std::vector<glm::u8vec4>(1), {0, 0}, {10, 0}};
  EXPECT_FALSE(map.validate());
  map.size = {10, std::nan("")};
  EXPECT_FALSE(map.validate());
}

}  // namespace
