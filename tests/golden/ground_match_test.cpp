// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
//
// Ground and plants agree in colour: means over a patch of meadow 180 to 220 m away, with and without plants, with and
// without detail textures, in sun and in shade.
#include <cmath>
#include <numbers>

#include "gl/gl_fixture.h"
#include "host/render_target.h"
#include "host/scene_renderer.h"

namespace sward {
namespace {

constexpr glm::ivec2 k_size{320, 120};
constexpr double k_height = 25, k_fov = 0.4;

Scene meadow() {
  Scene scene;
  Layer layer;
  layer.horizon_m = 260;
  layer.density = 70;
  Species grass;
  grass.name = "grass";
  grass.reference_hsv = {0.228f, 0.51f, 0.46f};
  layer.species = {grass};
  scene.layers = {layer};
  scene.max_triangles = 3000;
  return scene;
}

class GroundMatch : public test::GlTest {
 protected:
  /// Mean of the rows that show the patch, sRGB codes.
  glm::dvec3 mean(bool splatting, bool plants, float sun_elevation) {
    HeightFieldDesc desc;
    desc.columns = desc.rows = 129;
    desc.spacing = {8, 8};
    auto field = HeightField::create(desc, std::vector<float>(size_t(129 * 129), 0.0f));
    EXPECT_TRUE(field) << field.error().message;
    ColorMap colors{1, 1, {{96, 118, 58, 255}}, field->min_corner(), field->max_corner() - field->min_corner()};
    const host::SceneTerrain terrain(std::move(*field), std::move(colors));
    Scene scene = meadow();
    scene.splatting = splatting;
    auto renderer = host::SceneRenderer::create(scene, terrain, gl::ShaderLibrary());
    EXPECT_TRUE(renderer) << renderer.error().message;
    renderer->set_vegetation(plants);
    gl::Lighting light = gl::Lighting::clear_day(2.2f, sun_elevation);
    const double pitch = -std::atan(k_height / 200);
    const View view = View::look({-150, 0, k_height}, 0, pitch, k_fov, k_size, 0.1, 3000);
    auto target = host::RenderTarget::create(k_size, host::RenderTarget::max_samples() >= 4 ? 4 : 1);
    EXPECT_TRUE(target) << target.error().message;
    target->begin();
    const auto drawn = renderer->draw(view, light, 0, target->framebuffer(), target->samples(), true);
    EXPECT_TRUE(drawn) << drawn.error().message;
    EXPECT_GE(drawn->vegetation.primitives, plants ? 3000u : 0u) << "there must be plants to compare";
    const std::vector<uint8_t> rgb = target->read_rgb();
    const auto row = [&](double distance) {
      return int(k_size.y / 2 - std::tan(-std::atan(k_height / distance) - pitch) * view.focal_px().y);
    };
    glm::dvec3 sum(0);
    int count = 0;
    for (int y = row(220); y <= row(180); ++y)
      for (int x = 0; x < k_size.x; ++x, ++count)
        for (int c = 0; c < 3; ++c) sum[c] += rgb[size_t(y * k_size.x + x) * 3 + size_t(c)];
    EXPECT_GT(count, 5 * k_size.x);
    return sum / double(count);
  }
};

void expect_near(glm::dvec3 a, glm::dvec3 b, double codes, const std::string& what) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], codes) << what << ", channel " << c;
}

TEST_F(GroundMatch, PlantsMeltIntoTheGroundInSunAndShade) {
  for (const auto& [light, elevation] :
       {std::pair{"sun", 0.6f}, std::pair{"low sun", 0.15f}, std::pair{"shade", -0.05f}}) {
    const glm::dvec3 bare = mean(true, false, elevation), grown = mean(true, true, elevation);
    const glm::dvec3 plain = mean(false, false, elevation);
    std::printf("%s: ground %.2f %.2f %.2f, with plants %.2f %.2f %.2f, without textures %.2f %.2f %.2f\n", light,
                bare.r, bare.g, bare.b, grown.r, grown.g, grown.b, plain.r, plain.g, plain.b);
    expect_near(bare, grown, 2, std::string("plants in ") + light);
    expect_near(bare, plain, 0.75, std::string("textures in ") + light);
  }
}

}  // namespace
}  // namespace sward
