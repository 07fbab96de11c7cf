// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Light on plants and their planar shadows. Where a picture mixes effects, a fragment program of the test's own shows
// one of them: what the stages before hand over is sward's.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>

#include "gl/vegetation_fixture.h"
#include "host/render_target.h"

namespace sward {
namespace {

using namespace test;

class PlantShading : public GlTest {};

constexpr glm::ivec2 k_size{240, 160};
constexpr float k_degree = float(std::numbers::pi / 180);

struct Picture {
  std::vector<uint8_t> rgb;
  glm::vec3 at(int x, int y) const {
    const uint8_t* p = &rgb[size_t(y * k_size.x + x) * 3];
    return glm::vec3(p[0], p[1], p[2]) / 255.0f;
  }
  /// Pixels that anything was drawn on.
  void each_lit(const std::function<void(glm::vec3)>& visit) const {
    for (int y = 0; y < k_size.y; ++y)
      for (int x = 0; x < k_size.x; ++x)
        if (at(x, y) != glm::vec3(0)) visit(at(x, y));
  }
};

double linear_light(glm::vec3 color) {
  const auto linear = [](float c) { return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f); };
  return 0.2126 * double(linear(color.x)) + 0.7152 * double(linear(color.y)) + 0.0722 * double(linear(color.z));
}

double mean_light(const Picture& picture) {
  double sum = 0, count = 0;
  picture.each_lit([&](glm::vec3 color) {
    sum += linear_light(color);
    ++count;
  });
  return sum / std::max(count, 1.0);
}

/// Plants alone on black, or on a colour.
Picture render(Patch& patch, const View& view, FixedTriangles ground, glm::vec3 background = glm::vec3(0)) {
  auto target = host::RenderTarget::create(k_size, patch.samples);
  EXPECT_TRUE(target) << target.error().message;
  target->begin();
  const float color[] = {background.x, background.y, background.z, 1.0f};
  glClearNamedFramebufferfv(target->framebuffer(), GL_COLOR, 0, color);
  patch.look(view, std::move(ground));
  patch.classify(target->framebuffer());
  patch.draw();
  return {target->read_rgb()};
}
Picture render(Patch& patch, const View& view) {
  return render(patch, view, level_ground(k_side, patch.level, view.eye, 1000));
}

Layer grass(float density) {
  Layer layer;
  layer.species = {grass_of("grass", k_green)};
  layer.species[0].height_m = {0.4f, 0.4f};
  layer.species[0].width_m = {0.02f, 0.02f};
  layer.species[0].stiffness = {0.5f, 0.5f};
  layer.plain = true;
  layer.shadows = false;
  layer.density = density;
  layer.full_distance_m = layer.full_segments_m = 60;
  layer.horizon_m = 1000;
  return layer;
}

/// An embedded file.
std::string text_of(std::string_view file) {
  for (const EmbeddedText& embedded : gl::embedded_shaders())
    if (embedded.name == file) return std::string(embedded.text);
  ADD_FAILURE() << "no file " << file;
  return {};
}

/// Blades drawn by a fragment program of this body; it is to write `color`. It is handed all that a kind whose
/// fragments are lit is.
gl::ShaderLibrary with_fragments(const std::string& body) {
  gl::ShaderLibrary shaders;
  shaders.add_source("common_strip_links.glsl", "#undef SWARD_LIT_AT_VERTICES\n#define SWARD_LIT_AT_VERTICES 0\n" +
                                                    text_of("common_strip_links.glsl"));
  shaders.add_source("grass_blade.frag.glsl", "#include \"common_strip.glsl\"\nvoid main() {\n" + body + "\n}\n");
  return shaders;
}

/// An embedded file with a piece replaced.
std::string changed(std::string_view file, std::string_view from, std::string_view to) {
  std::string text = text_of(file);
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << file << " has no '" << from << "'";
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

View low_view() {
  return View::look({8.0, -15.5, 0.3}, std::numbers::pi / 2, 0, 0.9, k_size, 0.05, 1000);
}

// ---- Leaves.

/// Mean light of blades seen to the north.
double light_with(float translucency, float sun_azimuth_deg) {
  Layer layer = grass(12);
  layer.species[0].translucency = translucency;
  layer.species[0].specular = 0;
  Patch patch(layer, plain_map(k_side, 8, k_green));
  patch.lighting = gl::Lighting::clear_day(sun_azimuth_deg * k_degree, 25 * k_degree);
  return mean_light(render(patch, low_view()));
}

TEST_F(PlantShading, BladesGlowAgainstTheSun) {
  const double against = light_with(0.6f, 90), opaque = light_with(0, 90);
  EXPECT_GT(against, 1.35 * opaque);
  // With the sun behind the eye hardly any light comes through to it.
  const double with_it = light_with(0.6f, -90), opaque_with_it = light_with(0, -90);
  EXPECT_GT(against - opaque, 3 * (with_it - opaque_with_it));
  // From the side half of the blades are lit from behind, but less of it comes this way.
  const double aside = light_with(0.6f, 0) - light_with(0, 0);
  EXPECT_GT(against - opaque, 3.5 * aside) << (against - opaque) / aside;
}

/// Mean arc length of the streak on bent blades, and its whole light.
glm::dvec2 streak(float sun_elevation_deg, float specular) {
  Layer layer = grass(4);
  layer.species[0].stiffness = {0.15f, 0.15f};
  layer.species[0].phototropism = 1;
  layer.species[0].specular = specular;
  layer.species[0].shininess = 60;
  Patch patch(layer, plain_map(k_side, 8, k_green), {},
              with_fragments("float shine = leaf_streak(sward_layer.species[sward_species].optics, strip_light.w) * "
                             "strip_normal.w;\n"
                             "color = vec4(min(shine, 1.0), strip_place.x, 0.0, 1.0);"));
  patch.lighting = gl::Lighting::clear_day(90 * k_degree, sun_elevation_deg * k_degree);
  glm::dvec2 sum(0);
  render(patch, low_view()).each_lit([&](glm::vec3 color) { sum += double(color.x) * glm::dvec2(color.y, 1); });
  return {sum.x / std::max(sum.y, 1e-9), sum.y};
}

TEST_F(PlantShading, TheStreakMovesAlongTheBladeWithTheSun) {
  const glm::dvec2 low = streak(10, 0.5f), high = streak(70, 0.5f);
  EXPECT_GT(low.y, 5.0);
  EXPECT_GT(high.y, 5.0);
  EXPECT_GT(std::abs(low.x - high.x), 0.1) << low.x << " " << high.x;
}

TEST_F(PlantShading, TheStreakIsLightOfThePicture) {
  double light[2];
  for (const bool shiny : {false, true}) {
    Layer layer = grass(4);
    layer.species[0].translucency = 0;
    layer.species[0].specular = shiny ? 0.5f : 0.0f;
    Patch patch(layer, plain_map(k_side, 8, k_green));
    patch.lighting = gl::Lighting::clear_day(90 * k_degree, 30 * k_degree);
    light[shiny] = mean_light(render(patch, low_view()));
  }
  EXPECT_GT(light[1], 1.03 * light[0]);
  // Not plastic: four times the default's strength adds less than half.
  EXPECT_LT(light[1], 1.5 * light[0]);
}

struct CanopyLight {
  glm::dvec2 root{0}, tip{0};  ///< Share of the sky's light, of the sun's.
};

/// What the blades of a layer hand to their fragments.
CanopyLight canopy_light(float density, float sun_elevation_deg) {
  Layer layer = grass(density);
  layer.species[0].width_m = {0.06f, 0.06f};
  layer.species[0].stiffness = {0.9f, 0.9f};
  Patch patch(layer, plain_map(k_side, 8, k_green), {},
              with_fragments("color = vec4(strip_light.xy, 0.05 + 0.9 * strip_place.x, 1.0);"));
  patch.lighting = gl::Lighting::clear_day(0, sun_elevation_deg * k_degree);
  CanopyLight light;
  double roots = 0, tips = 0;
  // From straight above, so that roots are seen between any neighbours.
  const View view = View::look({8.0, -8.0, 3.0}, 0, -0.5 * std::numbers::pi, 1.0, k_size, 0.05, 1000);
  render(patch, view).each_lit([&](glm::vec3 color) {
    const double s = (double(color.z) - 0.05) / 0.9;
    if (s < 0.08) light.root += glm::dvec2(color), ++roots;
    if (s > 0.92) light.tip += glm::dvec2(color), ++tips;
  });
  EXPECT_GT(roots, 10);
  EXPECT_GT(tips, 10);
  light.root /= roots;
  light.tip /= tips;
  return light;
}

TEST_F(PlantShading, DenseCanopiesAreDarkBelowAndLoneBladesAreNot) {
  const CanopyLight dense = canopy_light(60, 60), thin = canopy_light(0.2f, 60);
  EXPECT_NEAR(dense.root.x, 0.35, 0.08);  // Species::root_shade
  EXPECT_GT(thin.root.x, 0.95 * thin.tip.x);
  EXPECT_LT(thin.tip.x, 0.8);  // leaves are not as bright as those that hide others
  EXPECT_GT(dense.tip.x, 0.95);
  EXPECT_GT(dense.tip.y, 0.95);
  // A low sun shines further through the neighbours; the sky's light does not change.
  const CanopyLight evening = canopy_light(60, 15);
  EXPECT_LT(evening.root.y, 0.5 * dense.root.y);
  EXPECT_NEAR(evening.root.x, dense.root.x, 0.02);
}

/// Mean change of far plants between two views a third of a pixel apart, of 255.
double shimmer(const gl::ShaderLibrary& shaders) {
  Layer layer = grass(60);
  layer.species[0].width_m = {0.008f, 0.012f};
  layer.species[0].age_share = 0;
  layer.full_distance_m = 200;
  layer.horizon_m = 300;
  Patch patch(layer, plain_map(k_side, 8, k_green), {}, shaders);
  patch.samples = std::min(4, host::RenderTarget::max_samples());
  patch.lighting = gl::Lighting::clear_day(0, 30 * k_degree);
  const double distance = 110, fov = 8 * double(k_degree), pixel = fov / k_size.y;
  const auto at = [&](double aside) {
    return View::look({8.0, -8.0 - distance, 12.0}, std::numbers::pi / 2 + aside, std::atan2(-12, distance), fov,
                      k_size, 0.5, 1000);
  };
  // Behind them their own mean, so that coverage alone changes little. One sample a pixel shows no background.
  const int samples = std::exchange(patch.samples, 1);
  glm::vec3 mean(0);
  float count = 0;
  render(patch, at(0)).each_lit([&](glm::vec3 color) { mean += color, ++count; });
  mean /= std::max(count, 1.0f);
  patch.samples = samples;
  const auto ground = [&](const View& view) { return level_ground(k_side, patch.level, view.eye, 1000); };
  const Picture first = render(patch, at(0), ground(at(0)), mean);
  const Picture second = render(patch, at(pixel / 3), ground(at(pixel / 3)), mean);
  double change = 0;
  for (size_t i = 0; i < first.rgb.size(); ++i) change += std::abs(int(first.rgb[i]) - int(second.rgb[i]));
  EXPECT_GT(count, 1000.0f);
  return change / double(count) / 3;
}

TEST_F(PlantShading, FarPlantsDoNotShimmer) {
  gl::ShaderLibrary without;
  without.add_source("common_strip_light.glsl", changed("common_strip_light.glsl", "return max(melting,",
                                                        "return 0.0; float unused = max(melting,"));
  const double faded = shimmer({}), bare = shimmer(without);
  RecordProperty("faded", std::to_string(faded));
  RecordProperty("bare", std::to_string(bare));
  EXPECT_LT(faded, 0.7 * bare) << faded << " of 255 against " << bare;
  EXPECT_LT(faded, 6.5);
}

// ---- Images on plants.

std::shared_ptr<const PlantImage> image_of(int side, const std::function<int(double across, double along)>& grey) {
  std::vector<uint8_t> greys;
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column)
      greys.push_back(uint8_t(grey((column + 0.5) / side * 2 - 1, 1 - (row + 0.5) / side)));
  auto image = PlantImage::create(side, side, greys);
  EXPECT_TRUE(image) << image.error().message;
  return *image;
}

/// Broad upright blades before the eye.
Layer broad(PlantKind kind) {
  Layer layer = grass(3);
  layer.species[0].kind = kind;
  layer.species[0].width_m = {0.3f, 0.3f};
  layer.species[0].stiffness = {1, 1};
  layer.species[0].lean = 0;
  layer.species[0].age_share = 0;
  return layer;
}

Picture picture_of(const Layer& layer, float sun_azimuth_deg = -60) {
  Patch patch(layer, plain_map(k_side, 8, k_green));
  patch.samples = std::min(4, host::RenderTarget::max_samples());
  patch.lighting = gl::Lighting::clear_day(sun_azimuth_deg * k_degree, 40 * k_degree);
  return render(patch, low_view());
}

size_t lit_pixels(const Picture& picture) {
  size_t count = 0;
  picture.each_lit([&](glm::vec3) { ++count; });
  return count;
}

constexpr PlantKind k_outlined[] = {PlantKind::blade, PlantKind::tuft, PlantKind::leaf, PlantKind::fern,
                                    PlantKind::billboard};

TEST_F(PlantShading, DetailChangesColoursAndHalfGreyDoesNot) {
  for (const PlantKind kind : k_outlined) {
    Layer layer = broad(kind);
    const Picture plain = picture_of(layer);
    layer.species[0].detail_strength = 0.8f;
    layer.species[0].detail = image_of(64, [](double, double) { return 128; });
    const double light = mean_light(plain);
    EXPECT_NEAR(mean_light(picture_of(layer)) / light, 1, 0.01) << int(kind);
    layer.species[0].detail = image_of(64, [](double, double) { return 0; });
    // Trunks, and light that mirrors, have none.
    EXPECT_LT(mean_light(picture_of(layer)), 0.7 * light) << int(kind);
  }
}

TEST_F(PlantShading, CutoutsTakeTheOutlinesPlace) {
  for (const PlantKind kind : k_outlined) {
    Layer layer = broad(kind);
    if (kind == PlantKind::billboard) layer.species[0].trunk_share = 0;
    // Rosettes of many leaves must not fill the picture.
    if (kind == PlantKind::leaf || kind == PlantKind::fern) layer.density = 0.2f;
    layer.species[0].cutout = image_of(64, [](double, double) { return 255; });
    const size_t whole = lit_pixels(picture_of(layer));
    layer.species[0].cutout = image_of(64, [](double across, double) { return std::abs(across) < 0.25 ? 255 : 0; });
    const size_t quarter = lit_pixels(picture_of(layer));
    EXPECT_GT(whole, 500u) << int(kind);
    EXPECT_GT(quarter, whole / 8) << int(kind);
    // Plants that overlap hide less of each other.
    EXPECT_LT(double(quarter), 0.7 * double(whole)) << int(kind);
  }
}

TEST_F(PlantShading, RowZeroOfACutoutIsTheTip) {
  Layer layer = broad(PlantKind::blade);
  const auto height = [&](bool tip) {
    layer.species[0].cutout = image_of(64, [=](double, double along) { return (along > 0.5) == tip ? 255 : 0; });
    const Picture picture = picture_of(layer);
    double sum = 0, count = 0;
    for (int y = 0; y < k_size.y; ++y)
      for (int x = 0; x < k_size.x; ++x)
        if (picture.at(x, y) != glm::vec3(0)) sum += k_size.y - y, ++count;
    return sum / std::max(count, 1.0);
  };
  EXPECT_GT(height(true), height(false) + 5);
}

TEST_F(PlantShading, EdgesOfEnlargedCutoutsAreAPixelWide) {
  // Eight texels over some hundred pixels: the image's own slope from 0 to 255 is a dozen pixels wide.
  Layer layer = broad(PlantKind::blade);
  layer.density = 1.0f / 256;
  layer.species[0].height_m = {2, 2};
  layer.species[0].width_m = {1.6f, 1.6f};
  layer.species[0].cutout = image_of(8, [](double across, double) { return std::abs(across) < 0.5 ? 255 : 0; });
  Patch patch(layer, plain_map(k_side, 8, k_green), {},
              with_fragments("int mask = strip_mask();\n"
                             "if (mask == 0) discard;\n"
                             "gl_SampleMask[0] = mask;\n"
                             "color = vec4(1.0);"));
  patch.samples = std::min(4, host::RenderTarget::max_samples());
  patch.level = 0;
  render(patch, low_view());
  const std::vector<Plant> plants = patch.plants_of_gpu();
  ASSERT_FALSE(plants.empty());
  const Plant& plant = plants.front();
  const glm::dvec3 eye = plant.position + 2.5 * glm::dvec3(std::cos(plant.azimuth), std::sin(plant.azimuth), 0.3);
  const glm::dvec3 to = plant.position + glm::dvec3(0, 0, 0.75) - eye;
  const View view = View::look(eye, std::atan2(to.y, to.x), 0, 0.9, k_size, 0.05, 1000);
  const Picture picture = render(patch, view);
  size_t rows = 0, partial = 0, full = 0;
  for (int y = 60; y < 100; ++y) {
    double most = 0;
    for (int x = 0; x < k_size.x; ++x) most = std::max(most, linear_light(picture.at(x, y)));
    if (most <= 0) continue;
    ++rows;
    for (int x = 0; x < k_size.x; ++x) {
      const double light = linear_light(picture.at(x, y));
      partial += light > 0.04 * most && light < 0.8 * most;
      full += light >= 0.8 * most;
    }
  }
  EXPECT_GT(rows, 20u);
  EXPECT_GT(full, rows * 20);
  EXPECT_LT(partial, rows * 4);  // two edges
}

// ---- Shadows.

constexpr double k_steep = 35 * std::numbers::pi / 180;

constexpr int k_cell_level = 2;  ///< Two triangles are a cell of 8 m.

/// Ground that rises by `slope` a metre north, and within each cell by a pyramid of this height.
FixedTriangles folded_ground(double slope, double fold, const View& view) {
  const FixedTriangles flat = level_ground(k_side, k_cell_level, view.eye, 1000);
  FixedTriangles ground;
  ground.set_surface_z(0);
  for (size_t i = 0; i < flat.size(); ++i) {
    FixedTriangle t = flat[i];
    t.apex.z = slope * (t.apex.y + 8);
    t.to_left.z = float(slope * double(t.to_left.y));
    t.to_right.z = float(slope * double(t.to_right.y));
    t.distance = 0.01f;
    if (fold > 0) {
      const double middle = t.apex.z + 0.5 * double(t.to_left.z + t.to_right.z);
      t.surface = ground.add_node({float(middle + fold), {0, 0}, 0});
    }
    ground.push_back(t);
  }
  return ground;
}

/// Heights of shadows' fragments over that ground, metres, sampled by pixels; within 5 cm.
std::vector<double> shadow_heights(Patch& patch, const View& view, double slope, double fold) {
  std::vector<double> heights;
  render(patch, view, folded_ground(slope, fold, view)).each_lit([&](glm::vec3 color) {
    heights.push_back((double(color.x) - 0.5) * 0.1);
  });
  std::sort(heights.begin(), heights.end());
  return heights;
}

/// Writes a shadow's height over folded_ground as 0.5 + 10 a metre. Only where what casts it stands on the same
/// triangle: away from borders of cells and from their diagonals, which all meet in the middle of the patch.
gl::ShaderLibrary height_probe(const View& view, double slope, double fold) {
  const auto number = [](double value) { return std::to_string(value); };
  return with_fragments(
      "if (!strip_is_shadow()) discard;\n"
      "vec3 at = strip_point + vec3(" +
      number(view.eye.x) + ", " + number(view.eye.y) + ", " + number(view.eye.z) +
      ");\n"
      "vec2 cell = abs(fract(at.xy / 8.0) - 0.5);\n"
      "vec2 place = abs(at.xy - vec2(8.0, -8.0));\n"
      "if (abs(place.x - place.y) < 2.0 || min(place.x, place.y) < 1.3) discard;\n"
      "float ground = " +
      number(slope) + " * (at.y + 8.0) + " + number(fold) +
      " * (1.0 - 2.0 * max(cell.x, cell.y));\n"
      "float height = (at.z - ground) * " +
      number(std::cos(std::atan(slope))) +
      ";\n"
      "color = vec4(clamp(0.5 + 10.0 * height, 0.002, 1.0), strip_self.y, 1.0, 1.0);");
}

Layer casting() {
  Layer layer = grass(3);
  layer.shadows = true;
  layer.shadow_distance_m = 1000;
  return layer;
}

View above_slope() {
  return View::look({8.0, -8.0, 7.0}, std::numbers::pi / 2, -0.5 * std::numbers::pi, 0.9, k_size, 0.05, 1000);
}

TEST_F(PlantShading, ShadowsLieOnSteepGround) {
  const double slope = std::tan(k_steep);
  const View view = above_slope();
  Patch patch(casting(), plain_map(k_side, 8, k_green), {}, height_probe(view, slope, 0));
  for (const float elevation : {2.0f, 10.0f, 45.0f}) {
    for (const float azimuth : {-90.0f, -30.0f, 180.0f}) {
      patch.lighting = gl::Lighting::clear_day(azimuth * k_degree, elevation * k_degree);
      const std::vector<double> heights = shadow_heights(patch, view, slope, 0);
      ASSERT_GT(heights.size(), 100u) << elevation << " " << azimuth;
      EXPECT_GT(heights.front(), 0.0) << elevation << " " << azimuth;
      EXPECT_LT(heights.back(), 0.015) << elevation << " " << azimuth;
    }
  }
}

TEST_F(PlantShading, ShadowsFollowGroundThatBends) {
  const double fold = 0.6;
  for (const double slope : {0.0, std::tan(k_steep)}) {
    const View view = above_slope();
    gl::ShaderLibrary probe = height_probe(view, slope, fold), flat = probe;
    flat.add_source(
        "common_shadow_projection.glsl",
        changed("common_shadow_projection.glsl", "p.bend = unpack_bend(packed_bend)", "p.bend = vec2(0.0)"));
    const auto spread = [&](const gl::ShaderLibrary& shaders, float elevation) {
      Patch patch(casting(), plain_map(k_side, 8, k_green), {}, shaders);
      patch.lighting = gl::Lighting::clear_day(-120 * k_degree, elevation * k_degree);
      const std::vector<double> heights = shadow_heights(patch, view, slope, fold);
      EXPECT_GT(heights.size(), 100u);
      // Of the worst tenth: most shadows do not meet a fold.
      std::vector<double> errors;
      for (const double height : heights) errors.push_back(std::abs(height - 0.004));
      std::sort(errors.begin(), errors.end());
      const size_t worst = errors.size() / 10 + 1;
      return std::accumulate(errors.end() - long(worst), errors.end(), 0.0) / double(worst);
    };
    for (const float elevation : {10.0f, 45.0f}) {
      const double followed = spread(probe, elevation), plane = spread(flat, elevation);
      RecordProperty("followed_" + std::to_string(int(elevation)), std::to_string(followed));
      // The longer the shadow, the more it leaves the plane of its root; short ones lie within millimetres either way.
      const double share = slope == 0 ? 0.65 : 0.9;
      if (elevation < 20) {
        EXPECT_LT(followed, share * plane) << elevation << ": " << followed;
      }
      EXPECT_LT(followed, 0.01) << elevation;
    }
  }
}

/// Light that shadows take from level ground, over all pixels, the sun being so high.
double shadow_energy(Patch& patch, float elevation_deg) {
  patch.lighting = gl::Lighting::clear_day(-90 * k_degree, elevation_deg * k_degree);
  double sum = 0;
  render(patch, above_slope()).each_lit([&](glm::vec3 color) { sum += double(color.x); });
  return sum;
}

TEST_F(PlantShading, ShadowsFadeAsTheSunSets) {
  Patch patch(casting(), plain_map(k_side, 8, k_green), {},
              with_fragments("if (!strip_is_shadow()) discard;\n"
                             "vec3 open = darkened_ground(strip_point, strip_map, strip_ground.xyz, 1.0, 1.0);\n"
                             "vec3 taken = open - shadow_color(strip_self.y);\n"
                             "color = vec4(clamp(dot(taken, vec3(30.0)) * strip_place.z, 0.0, 1.0), 0.0, 0.0, 1.0);"));
  std::vector<double> energy;
  for (float elevation = 6; elevation >= -0.5f; elevation -= 0.25f) energy.push_back(shadow_energy(patch, elevation));
  EXPECT_GT(energy.front(), 10.0);
  double most = *std::max_element(energy.begin(), energy.end());
  for (size_t i = 1; i < energy.size(); ++i)
    EXPECT_LT(std::abs(energy[i] - energy[i - 1]), 0.15 * most) << 6 - 0.25 * double(i) << " degrees";
  EXPECT_GT(energy[20], 0.0);  // 1 degree: still some
  EXPECT_EQ(energy[24], 0.0);  // on the horizon
  EXPECT_LT(energy[23], 0.02 * most);
  EXPECT_EQ(energy.back(), 0.0);
}

}  // namespace
}  // namespace sward
