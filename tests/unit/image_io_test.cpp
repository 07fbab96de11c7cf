// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#if defined(SWARD_IMAGE_IO)
#include <gtest/gtest.h>
#include <sward/image_io/image_io.h>

#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <limits>

#include "unit/image_files.h"

namespace {

using namespace sward;
using namespace sward::testing_files;
using OIIO::TypeDesc;

constexpr float k_nan = std::numeric_limits<float>::quiet_NaN();

bool mentions(const std::string& message, const std::string& words) {
  return message.find(words) != std::string::npos;
}

/// One line, that names the file and has the words.
template <class T>
void expect_error(const Expected<T>& result, const std::string& path, const std::string& words) {
  ASSERT_FALSE(result) << "expected an error with: " << words;
  EXPECT_TRUE(mentions(result.error().message, path)) << result.error().message;
  EXPECT_TRUE(mentions(result.error().message, words)) << result.error().message;
  EXPECT_FALSE(mentions(result.error().message, "\n")) << result.error().message;
}

class ImageIo : public testing::Test {
 protected:
  TemporaryFolder folder_;

  HeightImport import(const std::string& name) const { return {.path = folder_.file(name)}; }
  HeightImport tiff(const TiffFile& file) const {
    write_bytes(folder_.file("hand.tif"), file.bytes());
    return import("hand.tif");
  }
  /// Loads 3 columns x 2 rows of raw values written as `type` and compares every sample with scale * raw + offset.
  template <class T>
  void round_trip(const std::string& name, TypeDesc type, const std::vector<T>& raw) const {
    ASSERT_EQ(raw.size(), 6u);
    ASSERT_TRUE(write_picture(folder_.file(name), {3, 2}, raw, type)) << name;
    HeightImport options = import(name);
    options.scale = 1.0 / 256;
    options.offset = 12.0;
    const auto field = load_height_field(options);
    ASSERT_TRUE(field) << field.error().message;
    ASSERT_EQ(field->desc().columns, 3);
    ASSERT_EQ(field->desc().rows, 2);
    EXPECT_EQ(field->hole_count(), 0);
    for (int i = 0; i < 6; ++i) {
      EXPECT_EQ(field->sample(i % 3, i / 3), double(raw[size_t(i)]) / 256 + 12.0) << name << " sample " << i;
    }
  }
};

// ---- Formats and types: integers are not normalised, signs and extremes are kept ----

TEST_F(ImageIo, UnsignedIntegersKeepTheirUnits) {
  round_trip<uint8_t>("a.png", TypeDesc::UINT8, {0, 1, 2, 127, 128, 255});
  round_trip<uint8_t>("a.tif", TypeDesc::UINT8, {0, 1, 2, 127, 128, 255});
  round_trip<uint16_t>("b.png", TypeDesc::UINT16, {0, 1, 255, 256, 43798, 65535});
  round_trip<uint16_t>("b.tif", TypeDesc::UINT16, {0, 1, 255, 256, 43798, 65535});
}

TEST_F(ImageIo, SignedIntegersKeepTheirSign) {
  round_trip<int8_t>("a.tif", TypeDesc::INT8, {-128, -1, 0, 1, 100, 127});
  round_trip<int16_t>("b.tif", TypeDesc::INT16, {-32767, -1, 0, 1, 4380, 32767});
}

TEST_F(ImageIo, FloatsAreKept) {
  round_trip<float>("a.tif", TypeDesc::FLOAT, {-10.25f, 0.0f, 1e-3f, 4380.5f, -0.125f, 8848.86f});
  round_trip<float>("a.exr", TypeDesc::FLOAT, {-10.25f, 0.0f, 1e-3f, 4380.5f, -0.125f, 8848.86f});
  round_trip<double>("b.tif", TypeDesc::DOUBLE, {-10.25, 0.0, 0.5, 4380.5, -0.125, 8848.0});
}

TEST_F(ImageIo, HalfFloatsAreKept) {
  // Every value is a half exactly.
  const std::vector<float> values{-10.25f, 0.0f, 0.5f, 4380.0f, -0.125f, 2047.0f};
  const auto output = OIIO::ImageOutput::create("a.exr");
  ASSERT_TRUE(output);
  ASSERT_TRUE(output->open(folder_.file("a.exr"), OIIO::ImageSpec(3, 2, 1, TypeDesc::HALF)));
  ASSERT_TRUE(output->write_image(TypeDesc::FLOAT, values.data()) && output->close());
  const auto field = load_height_field(import("a.exr"));
  ASSERT_TRUE(field) << field.error().message;
  for (int i = 0; i < 6; ++i) EXPECT_EQ(field->sample(i % 3, i / 3), double(values[size_t(i)]));
}

TEST_F(ImageIo, LongIntegersUpToTwentyFourBits) {
  round_trip<int32_t>("a.tif", TypeDesc::INT32, {-16777216, -1, 0, 70000, 16777215, 16777216});
  round_trip<uint32_t>("b.tif", TypeDesc::UINT32, {0, 1, 65536, 70000, 16777215, 16777216});
  ASSERT_TRUE(write_picture<int32_t>(folder_.file("c.tif"), {3, 1}, {0, 16777217, 1}, TypeDesc::INT32));
  expect_error(load_height_field(import("c.tif")), "c.tif", "2^24");
}

TEST_F(ImageIo, SignedUnitsFoldIntoTheOffset) {
  ASSERT_TRUE(write_picture<int16_t>(folder_.file("a.tif"), {2, 2}, {-430, 0, 1, 8848}, TypeDesc::INT16));
  HeightImport options = import("a.tif");
  options.scale = 0.1;
  options.offset = -7;
  options.origin = {1000, 2000, 300};
  const auto field = load_height_field(options);
  ASSERT_TRUE(field) << field.error().message;
  EXPECT_NEAR(field->sample(0, 0), 250.0, 1e-9);
  EXPECT_NEAR(field->sample(1, 0), 293.0, 1e-9);
  EXPECT_NEAR(field->sample(0, 1), 293.1, 1e-9);
  EXPECT_NEAR(field->sample(1, 1), 1177.8, 1e-9);
}

TEST_F(ImageIo, ContentsDecideBeforeTheExtension) {
  ASSERT_TRUE(write_picture<uint16_t>(folder_.file("a.png"), {2, 2}, {1, 2, 3, 40000}, TypeDesc::UINT16));
  for (const std::string name : {"a.tif", "a.exr", "a.dem", "a"}) {
    fs::copy_file(folder_.file("a.png"), folder_.file(name));
    const auto field = load_height_field(import(name));
    ASSERT_TRUE(field) << field.error().message;
    EXPECT_EQ(field->sample(1, 1), 40000.0);
  }
}

// ---- Channels ----

TEST_F(ImageIo, EqualChannelsAreOne) {
  ASSERT_TRUE(write_picture<uint16_t>(folder_.file("a.png"), {2, 2, 3},
                                      {1, 1, 1, 500, 500, 500, 3, 3, 3, 65535, 65535, 65535}, TypeDesc::UINT16));
  const auto field = load_height_field(import("a.png"));
  ASSERT_TRUE(field) << field.error().message;
  EXPECT_EQ(field->sample(1, 0), 500.0);
  EXPECT_EQ(field->sample(1, 1), 65535.0);
}

TEST_F(ImageIo, DifferentChannelsAreRefused) {
  ASSERT_TRUE(write_picture<uint8_t>(folder_.file("a.png"), {2, 1, 3}, {1, 1, 1, 5, 5, 6}, TypeDesc::UINT8));
  expect_error(load_height_field(import("a.png")), "a.png", "3 channels that differ");
  ASSERT_TRUE(write_picture<uint8_t>(folder_.file("b.png"), {2, 1, 2, 1}, {1, 255, 5, 255}, TypeDesc::UINT8));
  expect_error(load_height_field(import("b.png")), "b.png", "2 channels that differ");
}

TEST_F(ImageIo, StretchedBitsAreRefused) {
  const auto output = OIIO::ImageOutput::create("a.tif");
  OIIO::ImageSpec spec(8, 2, 1, TypeDesc::UINT8);
  spec.attribute("oiio:BitsPerSample", 4);
  const std::vector<uint8_t> samples(16, 0x11);
  ASSERT_TRUE(output->open(folder_.file("a.tif"), spec) && output->write_image(TypeDesc::UINT8, samples.data()));
  ASSERT_TRUE(output->close());
  expect_error(load_height_field(import("a.tif")), "a.tif", "4 bits");
}

// ---- No data ----

TEST_F(ImageIo, SignedSixteenBitsHaveNoDataAtTheLowest) {
  ASSERT_TRUE(
      write_picture<int16_t>(folder_.file("a.tif"), {3, 2}, {100, -32768, 100, -32767, -32768, 5}, TypeDesc::INT16));
  const auto field = load_height_field(import("a.tif"));
  ASSERT_TRUE(field) << field.error().message;
  EXPECT_EQ(field->hole_count(), 2);
  EXPECT_TRUE(field->is_hole(1, 0));
  EXPECT_TRUE(field->is_hole(1, 1));
  EXPECT_FALSE(field->is_hole(0, 1));
  EXPECT_EQ(field->sample(0, 1), -32767.0);
}

TEST_F(ImageIo, UnsignedHasNoDataOnlyWhenTold) {
  ASSERT_TRUE(write_picture<uint16_t>(folder_.file("a.png"), {2, 2}, {0, 7, 65535, 9}, TypeDesc::UINT16));
  HeightImport options = import("a.png");
  EXPECT_EQ(load_height_field(options)->hole_count(), 0);
  options.no_data = 65535.0;
  const auto field = load_height_field(options);
  ASSERT_TRUE(field) << field.error().message;
  EXPECT_EQ(field->hole_count(), 1);
  EXPECT_TRUE(field->is_hole(0, 1));
}

TEST_F(ImageIo, NotANumberIsAHole) {
  for (const std::string name : {"a.exr", "a.tif"}) {
    ASSERT_TRUE(write_picture<float>(folder_.file(name), {2, 2}, {1, k_nan, 3, 4}, TypeDesc::FLOAT));
    const auto field = load_height_field(import(name));
    ASSERT_TRUE(field) << field.error().message;
    EXPECT_EQ(field->hole_count(), 1);
    EXPECT_TRUE(field->is_hole(1, 0));
    EXPECT_TRUE(std::isfinite(field->sample(1, 0)));
  }
}

TEST_F(ImageIo, TheFilesOwnTagReplacesTheDefault) {
  for (const bool big_endian : {false, true}) {
    for (const bool big_tiff : {false, true}) {
      TiffFile file{
          .big_endian = big_endian, .big_tiff = big_tiff, .samples = {-9999, 4, 5, -32768}, .no_data = "-9999"};
      const auto field = load_height_field(tiff(file));
      ASSERT_TRUE(field) << field.error().message;
      EXPECT_EQ(field->hole_count(), 1);
      EXPECT_TRUE(field->is_hole(0, 0));
      EXPECT_EQ(field->sample(1, 1), -32768.0);
      EXPECT_EQ(field->sample(0, 1), 5.0);
    }
  }
}

TEST_F(ImageIo, GivenNoDataReplacesTheTag) {
  HeightImport options = tiff({.samples = {-9999, 4, 5, 6}, .no_data = "-9999"});
  options.no_data = 4.0;
  const auto field = load_height_field(options);
  ASSERT_TRUE(field) << field.error().message;
  EXPECT_EQ(field->hole_count(), 1);
  EXPECT_TRUE(field->is_hole(1, 0));
  EXPECT_EQ(field->sample(0, 0), -9999.0);
}

TEST_F(ImageIo, FloatTagsMatchTheFloatTheyMean) {
  const double lowest = -std::numeric_limits<float>::max();
  for (const std::string tag : {"-3.4028234663852886e+38", "-3.40282346638529e+38", "-3.4028235e+38"}) {
    const auto field =
        load_height_field(tiff({.sample_format = 3, .bits = 32, .samples = {1, 2, lowest, 4}, .no_data = tag}));
    ASSERT_TRUE(field) << tag << ": " << field.error().message;
    EXPECT_EQ(field->hole_count(), 1) << tag;
    EXPECT_TRUE(field->is_hole(0, 1));
  }
  const auto field =
      load_height_field(tiff({.sample_format = 3, .bits = 32, .samples = {1, 2, k_nan, 4}, .no_data = "nan"}));
  ASSERT_TRUE(field) << field.error().message;
  EXPECT_EQ(field->hole_count(), 1);
}

TEST_F(ImageIo, BadTagsAreErrors) {
  expect_error(load_height_field(tiff({.samples = {1, 2, 3, 4}, .no_data = "none"})), "hand.tif",
               "no-data tag \"none\"");
  expect_error(load_height_field(tiff({.samples = {1, 2, 3, 4}, .no_data = "-99999", .stray_tag = true})), "hand.tif",
               "42113");
}

TEST_F(ImageIo, NothingButHolesIsAnError) {
  expect_error(load_height_field(tiff({.samples = {-32768, -32768, -32768, -32768}})), "hand.tif", "");
}

// ---- Spacing ----

TEST_F(ImageIo, SpacingComesFromTheFileOnlyWhenAsked) {
  HeightImport options = tiff({.samples = {1, 2, 3, 4},
                               .scale = std::array<double, 3>{30.0, 20.0, 0.0},
                               .geo_keys = {1, 1, 0, 2, 1024, 0, 1, 1, 3076, 0, 1, 9001}});
  options.spacing = {7, 8};
  EXPECT_EQ(load_height_field(options)->desc().spacing, glm::dvec2(7, 8));
  options.use_file_spacing = true;
  EXPECT_EQ(load_height_field(options)->desc().spacing, glm::dvec2(30, 20));
}

TEST_F(ImageIo, SpacingInUtmZonesIsInMetres) {
  HeightImport options = tiff({.big_endian = true,
                               .samples = {1, 2, 3, 4},
                               .scale = std::array<double, 3>{10.0, 12.0, 0.0},
                               .geo_keys = {1, 1, 0, 2, 1024, 0, 1, 1, 3072, 0, 1, 32610}});
  options.use_file_spacing = true;
  const auto field = load_height_field(options);
  ASSERT_TRUE(field) << field.error().message;
  EXPECT_EQ(field->desc().spacing, glm::dvec2(10, 12));
}

TEST_F(ImageIo, SpacingThatIsNotInMetresIsAnError) {
  const std::array<double, 3> scale{0.001, 0.001, 0.0};
  HeightImport degrees = tiff({.samples = {1, 2, 3, 4}, .scale = scale, .geo_keys = {1, 1, 0, 1, 1024, 0, 1, 2}});
  degrees.use_file_spacing = true;
  expect_error(load_height_field(degrees), "hand.tif", "degrees");
  HeightImport feet =
      tiff({.samples = {1, 2, 3, 4}, .scale = scale, .geo_keys = {1, 1, 0, 2, 1024, 0, 1, 1, 3076, 0, 1, 9002}});
  feet.use_file_spacing = true;
  expect_error(load_height_field(feet), "hand.tif", "metres");
  HeightImport none = tiff({.samples = {1, 2, 3, 4}});
  none.use_file_spacing = true;
  expect_error(load_height_field(none), "hand.tif", "GeoTIFF");
}

TEST_F(ImageIo, BadSpacingAndScaleAreErrors) {
  HeightImport options = tiff({.samples = {1, 2, 3, 4}});
  for (const double bad : {0.0, -1.0, double(k_nan), std::numeric_limits<double>::infinity()}) {
    options.spacing = {1, bad};
    expect_error(load_height_field(options), "hand.tif", "spacing");
  }
  options.spacing = {1, 1};
  for (const double bad : {0.0, double(k_nan), std::numeric_limits<double>::infinity()}) {
    options.scale = bad;
    expect_error(load_height_field(options), "hand.tif", "scale");
  }
}

// ---- Sizes ----

TEST_F(ImageIo, AnySizeOfTwoByTwoAndMore) {
  for (const auto& [width, height] : {std::pair(2, 2), {2, 301}, {257, 3}, {100, 37}}) {
    std::vector<uint16_t> raw(size_t(width * height));
    for (size_t i = 0; i < raw.size(); ++i) raw[i] = uint16_t(i * 7919);
    ASSERT_TRUE(write_picture(folder_.file("a.png"), {width, height}, raw, TypeDesc::UINT16));
    const auto field = load_height_field(import("a.png"));
    ASSERT_TRUE(field) << field.error().message;
    ASSERT_EQ(field->desc().columns, width);
    ASSERT_EQ(field->desc().rows, height);
    for (size_t i = 0; i < raw.size(); ++i)
      ASSERT_EQ(field->sample(int(i) % width, int(i) / width), double(raw[i])) << i;
  }
}

TEST_F(ImageIo, OneSampleWideIsAnError) {
  for (const auto& [width, height] : {std::pair(1, 1), {1, 9}, {9, 1}}) {
    ASSERT_TRUE(write_picture(folder_.file("a.png"), {width, height}, std::vector<uint8_t>(size_t(width * height), 3),
                              TypeDesc::UINT8));
    expect_error(load_height_field(import("a.png")), "a.png", "2");
  }
}

// ---- Bad files: one clear line, nothing printed ----

TEST_F(ImageIo, BadFilesAreNamed) {
  write_bytes(folder_.file("empty.png"), "");
  write_bytes(folder_.file("text.png"), "This is no picture, whatever its name says.\n");
  write_bytes(folder_.file("text.tif"), "This is no picture, whatever its name says.\n");
  write_bytes(folder_.file("text.exr"), "This is no picture, whatever its name says.\n");
  write_bytes(folder_.file("text.jpg"), "This is no picture, whatever its name says.\n");
  write_bytes(folder_.file("text.hdr"), "This is no picture, whatever its name says.\n");
  write_bytes(folder_.file("notes.txt"), "This is no picture.\n");
  write_bytes(folder_.file("film.mp4"), std::string("\0\0\0\x18"
                                                    "ftypmp42",
                                                    12));
  write_bytes(folder_.file("nothing.null"), "x");
  write_bytes(folder_.file("plain"), "x");
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  expect_error(load_height_field(import("missing.png")), "missing.png", "does not exist");
  expect_error(load_height_field({.path = ""}), "", "does not exist");
  expect_error(load_height_field({.path = folder_.path().string()}), folder_.path().string(), "folder");
  expect_error(load_height_field(import("empty.png")), "empty.png", "empty");
  for (const std::string name : {"text.png", "text.tif", "text.exr", "text.jpg", "text.hdr"})
    expect_error(load_height_field(import(name)), name, "not a valid");
  for (const std::string name : {"notes.txt", "film.mp4", "nothing.null", "plain"})
    expect_error(load_height_field(import(name)), name, "not an image of a known format");
  expect_error(load_color_map(folder_.file("missing.png"), {0, 0}, {1, 1}), "missing.png", "does not exist");
  expect_error(load_color_map(folder_.file("text.png"), {0, 0}, {1, 1}), "text.png", "not a valid");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(ImageIo, SizesThatCannotBeAreRefusedWithoutTheMemory) {
  testing::internal::CaptureStderr();
  write_bytes(folder_.file("zero.png"), png_claiming(0, 0));
  expect_error(load_height_field(import("zero.png")), "zero.png", "");
  write_bytes(folder_.file("huge.png"), png_claiming(0x7fffffff, 0x7fffffff));
  expect_error(load_height_field(import("huge.png")), "huge.png", "");
  write_bytes(folder_.file("large.png"), png_claiming(40000, 40000));
  expect_error(load_height_field(import("large.png")), "large.png", "cut short");
  expect_error(load_height_field(tiff({.width = 0, .height = 2, .samples = {1}})), "hand.tif", "");
  expect_error(load_height_field(tiff({.width = 65535, .height = 65535, .samples = {1}})), "hand.tif", "2^31");
  expect_error(load_height_field(tiff({.width = 30000, .height = 30000, .samples = {1}})), "hand.tif", "cut short");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

// ---- Base maps ----

TEST_F(ImageIo, ColorMapsOfEveryLayout) {
  const glm::dvec2 corner(-10, 20), size(300, 400);
  const auto load = [&](const std::string& name) { return load_color_map(folder_.file(name), corner, size); };
  using Texels = std::vector<glm::u8vec4>;

  ASSERT_TRUE(write_picture<uint8_t>(folder_.file("grey.png"), {2, 1}, {7, 200}, TypeDesc::UINT8));
  const auto grey = load("grey.png");
  ASSERT_TRUE(grey) << grey.error().message;
  EXPECT_EQ(grey->texels, (Texels{{7, 7, 7, 255}, {200, 200, 200, 255}}));
  EXPECT_EQ(grey->width, 2);
  EXPECT_EQ(grey->height, 1);
  EXPECT_EQ(grey->min_corner, corner);
  EXPECT_EQ(grey->size, size);

  ASSERT_TRUE(write_picture<uint8_t>(folder_.file("rgb.tif"), {1, 2, 3}, {1, 2, 3, 254, 128, 0}, TypeDesc::UINT8));
  const auto rgb = load("rgb.tif");
  ASSERT_TRUE(rgb) << rgb.error().message;
  EXPECT_EQ(rgb->texels, (Texels{{1, 2, 3, 255}, {254, 128, 0, 255}}));

  // 16 bits: 0x8080 is 128 of 255 exactly, 0x00ff rounds to 1.
  ASSERT_TRUE(write_picture<uint16_t>(folder_.file("deep.png"), {1, 1, 3}, {0x8080, 0x00ff, 0xffff}, TypeDesc::UINT16));
  const auto deep = load("deep.png");
  ASSERT_TRUE(deep) << deep.error().message;
  EXPECT_EQ(deep->texels, (Texels{{128, 1, 255, 255}}));
}

TEST_F(ImageIo, AlphaBelowOneHalfForbidsAndKeepsTheColor) {
  const auto load = [&](const std::string& name) { return load_color_map(folder_.file(name), {0, 0}, {1, 1}); };
  using Texels = std::vector<glm::u8vec4>;
  for (const std::string name : {"a.png", "a.tif"}) {
    ASSERT_TRUE(write_picture<uint8_t>(folder_.file(name), {2, 2, 4, 3},
                                       {90, 80, 70, 0, 91, 81, 71, 127, 92, 82, 72, 128, 93, 83, 73, 255},
                                       TypeDesc::UINT8));
    const auto map = load(name);
    ASSERT_TRUE(map) << map.error().message;
    EXPECT_EQ(map->texels, (Texels{{90, 80, 70, 0}, {91, 81, 71, 0}, {92, 82, 72, 255}, {93, 83, 73, 255}})) << name;
  }
  ASSERT_TRUE(
      write_picture<uint16_t>(folder_.file("b.png"), {2, 1, 2, 1}, {0xc0c0, 32767, 0xc0c0, 32768}, TypeDesc::UINT16));
  const auto grey = load("b.png");
  ASSERT_TRUE(grey) << grey.error().message;
  EXPECT_EQ(grey->texels, (Texels{{192, 192, 192, 0}, {192, 192, 192, 255}}));
}

TEST_F(ImageIo, ColorMapsOfOtherKindsAreRefused) {
  ASSERT_TRUE(write_picture<float>(folder_.file("a.exr"), {1, 1, 3}, {0.5f, 0.5f, 0.5f}, TypeDesc::FLOAT));
  expect_error(load_color_map(folder_.file("a.exr"), {0, 0}, {1, 1}), "a.exr", "8 or 16 bits");
  ASSERT_TRUE(write_picture<uint8_t>(folder_.file("b.tif"), {1, 1, 5}, {1, 2, 3, 4, 5}, TypeDesc::UINT8));
  expect_error(load_color_map(folder_.file("b.tif"), {0, 0}, {1, 1}), "b.tif", "5 channels");
  ASSERT_TRUE(write_picture<uint8_t>(folder_.file("c.png"), {1, 1}, {1}, TypeDesc::UINT8));
  expect_error(load_color_map(folder_.file("c.png"), {0, 0}, {0, 1}), "c.png", "");
  expect_error(load_color_map(folder_.file("c.png"), {k_nan, 0}, {1, 1}), "c.png", "");
}

/// 5 x 5 samples, 10 m apart about (100, 200): x 80..120, y 180..220. One hole at column 2, row 1.
HeightField field_with_a_hole(std::initializer_list<glm::ivec2> holes) {
  HeightFieldDesc desc;
  desc.columns = desc.rows = 5;
  desc.spacing = {10, 10};
  desc.origin = {100, 200, 0};
  std::vector<uint8_t> mask(25, 0);
  for (const glm::ivec2 hole : holes) mask[size_t(hole.y * 5 + hole.x)] = 1;
  return HeightField::create(desc, std::vector<float>(25, 3.0f), mask).value();
}

TEST_F(ImageIo, HolesForbidEveryTexelTheyTouch) {
  const HeightField field = field_with_a_hole({{2, 1}});
  // Two texels a cell. The hole's cells cover x 90..110, y 200..220: texels 2..5 by 0..3; the next ones share an edge.
  ColorMap map{.width = 8,
               .height = 8,
               .texels = std::vector<glm::u8vec4>(64, {9, 8, 7, 255}),
               .min_corner = {80, 180},
               .size = {40, 40}};
  mask_holes(map, field);
  for (int j = 0; j < 8; ++j) {
    for (int i = 0; i < 8; ++i) {
      const bool masked = i >= 1 && i <= 6 && j <= 4;
      EXPECT_EQ(map.texels[size_t(8 * j + i)], glm::u8vec4(9, 8, 7, masked ? 0 : 255)) << i << ", " << j;
    }
  }
}

TEST_F(ImageIo, HolesReachMapsThatLieElsewhere) {
  // A hole in the south-western corner: its one cell is x 80..90, y 180..190.
  const HeightField field = field_with_a_hole({{0, 4}});
  // 7 m texels from (60, 160): columns by x = 60, 67, 74, 81, 88, 95; rows from the north, y = 202, 195, 188, 181, 174.
  ColorMap map{.width = 5,
               .height = 6,
               .texels = std::vector<glm::u8vec4>(30, {0, 0, 0, 255}),
               .min_corner = {60, 160},
               .size = {35, 42}};
  mask_holes(map, field);
  for (int j = 0; j < 6; ++j) {
    for (int i = 0; i < 5; ++i) {
      const double west = 60 + 7 * i, south = 202 - 7 * (j + 1);
      const bool masked = west + 7 >= 80 && west <= 90 && south + 7 >= 180 && south <= 190;
      EXPECT_EQ(map.texels[size_t(5 * j + i)].a, masked ? 0 : 255) << i << ", " << j;
    }
  }
  ColorMap away{.width = 2,
                .height = 2,
                .texels = std::vector<glm::u8vec4>(4, {0, 0, 0, 255}),
                .min_corner = {5000, 160},
                .size = {35, 42}};
  mask_holes(away, field);
  for (const auto& texel : away.texels) EXPECT_EQ(texel.a, 255);
}

// ---- Pictures ----

std::vector<uint8_t> gradient(int width, int height) {
  std::vector<uint8_t> rgb;
  for (int i = 0; i < width * height; ++i) {
    rgb.insert(rgb.end(), {uint8_t(i % 256), uint8_t(i * 3 % 256), uint8_t(255 - i % 256)});
  }
  return rgb;
}

TEST_F(ImageIo, PicturesComeBackAsTheyWere) {
  const auto rgb = gradient(31, 17);
  for (const std::string name : {"a.png", "a.PNG", "a.bmp", "a.tga", "a.ppm"}) {
    const auto saved = save_image(folder_.file(name), 31, 17, rgb);
    ASSERT_TRUE(saved) << saved.error().message;
    const auto input = OIIO::ImageInput::open(folder_.file(name));
    ASSERT_TRUE(input) << name;
    ASSERT_EQ(input->spec().width, 31);
    ASSERT_EQ(input->spec().height, 17);
    ASSERT_EQ(input->spec().nchannels, 3);
    std::vector<uint8_t> read(rgb.size());
    ASSERT_TRUE(input->read_image(0, 0, 0, 3, TypeDesc::UINT8, read.data()));
    EXPECT_EQ(read, rgb) << name;
  }
  EXPECT_EQ(folder_.names().size(), 5u) << "temporary files stayed";
}

TEST_F(ImageIo, PicturesAreTheSameBytesEachTime) {
  ASSERT_TRUE(save_image(folder_.file("a.png"), 31, 17, gradient(31, 17)));
  ASSERT_TRUE(save_image(folder_.file("b.png"), 31, 17, gradient(31, 17)));
  EXPECT_EQ(read_bytes(folder_.file("a.png")), read_bytes(folder_.file("b.png")));
}

TEST_F(ImageIo, PicturesThatCannotBeWrittenLeaveNothing) {
  const auto rgb = gradient(4, 3);
  fs::create_directory(folder_.file("taken.png"));
  testing::internal::CaptureStderr();
  expect_error(save_image(folder_.file("none/a.png"), 4, 3, rgb), "none/a.png",
               "folder \"" + folder_.file("none") + "\"");
  expect_error(save_image(folder_.file("taken.png"), 4, 3, rgb), "taken.png", "folder");
  expect_error(save_image(folder_.file("a.xyz"), 4, 3, rgb), "a.xyz", ".png");
  expect_error(save_image(folder_.file("a"), 4, 3, rgb), "a", ".png");
  expect_error(save_image(folder_.file("a.png"), 4, 4, rgb), "a.png", "48");
  expect_error(save_image(folder_.file("a.png"), 0, 3, {}), "a.png", "0 x 3");
  expect_error(save_image(folder_.file("a.png"), -1, -12, rgb), "a.png", "-1 x -12");
  expect_error(save_image("", 4, 3, rgb), "", ".png");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(folder_.names(), std::vector<std::string>{"taken.png"});
}

TEST_F(ImageIo, AFailedWriteKeepsTheOlderPicture) {
  ASSERT_TRUE(save_image(folder_.file("a.png"), 4, 3, gradient(4, 3)));
  const std::string before = read_bytes(folder_.file("a.png"));
  // A full disk: no file may grow beyond 1000 bytes.
  rlimit old_limit{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &old_limit), 0);
  const rlimit limit{1000, old_limit.rlim_max};
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
  const auto saved = save_image(folder_.file("a.png"), 300, 300, std::vector<uint8_t>(gradient(300, 300)));
  setrlimit(RLIMIT_FSIZE, &old_limit);
  std::signal(SIGXFSZ, old_handler);
  expect_error(saved, "a.png", "File too large");
  EXPECT_EQ(read_bytes(folder_.file("a.png")), before);
  EXPECT_EQ(folder_.names(), std::vector<std::string>{"a.png"});
}

TEST_F(ImageIo, PicturesBeyondTheLargestSideAreRefused) {
  for (const std::string name : {"a.jpg", "a.png"}) {
    expect_error(save_image(folder_.file(name), 65501, 1, std::vector<uint8_t>(65501 * 3)), name, "65500");
    const auto saved = save_image(folder_.file(name), 65500, 1, std::vector<uint8_t>(65500 * 3));
    EXPECT_TRUE(saved) << saved.error().message;
  }
}

TEST_F(ImageIo, LongNamesAreWritten) {
  const std::string name = std::string(240, 'x') + ".png";
  const auto saved = save_image(folder_.file(name), 4, 3, gradient(4, 3));
  EXPECT_TRUE(saved) << saved.error().message;
  EXPECT_EQ(folder_.names(), std::vector<std::string>{name});
}

// ---- Real maps ----

class SharedMaps : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(fs::path(SWARD_SHARED_DATA) / "ps_height_1k.png"))
      GTEST_SKIP() << "no maps in " << SWARD_SHARED_DATA;
  }
  static std::string file(const std::string& name) { return (fs::path(SWARD_SHARED_DATA) / name).string(); }
};

TEST_F(SharedMaps, RainierHasItsHoles) {
  HeightImport options{.path = file("mt_rainier_90m.tif"), .spacing = {63.5, 92.6}};
  const auto field = load_height_field(options);
  ASSERT_TRUE(field) << field.error().message;
  EXPECT_EQ(field->desc().columns, 1201);
  EXPECT_EQ(field->desc().rows, 1201);
  EXPECT_EQ(field->hole_count(), 9033);
  EXPECT_GT(field->height_range()[0], -100.0);
  EXPECT_LT(field->height_range()[1], 4400.0);
  options.use_file_spacing = true;
  expect_error(load_height_field(options), "mt_rainier_90m.tif", "degrees");
}

TEST_F(SharedMaps, PugetSoundReachesTheTopOfMountRainier) {
  const auto field = load_height_field({.path = file("ps_height_1k.png"), .spacing = {160, 160}, .scale = 0.1});
  ASSERT_TRUE(field) << field.error().message;
  EXPECT_EQ(field->desc().columns, 1025);
  EXPECT_EQ(field->desc().rows, 1025);
  EXPECT_EQ(field->hole_count(), 0);
  EXPECT_NEAR(field->height_range()[1], 4379.8, 1e-9);
  EXPECT_EQ(field->height_range()[0], 0.0);
}

}  // namespace
#endif
