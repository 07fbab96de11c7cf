// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/image_io/image_io.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <exception>
#include <limits>
#include <type_traits>
#include <utility>

#include "image_io/raw_image.h"
#include "image_io/tiff_tags.h"

namespace sward {

namespace {

using image_io::RawImage;
using image_io::SampleType;

/// Samples as HeightField stores them; raw unit = stored + bias.
struct Heights {
  HeightField::Samples samples;
  double bias = 0;
  std::vector<uint8_t> holes;  // empty: none
};

template <class T>
bool same(T a, T b) {
  if constexpr (std::is_floating_point_v<T>) {
    if (std::isnan(a) && std::isnan(b)) return true;
  }
  return a == b;
}

/// The first of equal channels.
template <class T>
Expected<std::vector<T>> single_channel(const RawImage& image, const std::string& name) {
  const std::span<const T> all = image.samples<T>();
  const size_t channels = size_t(image.channels);
  std::vector<T> first(image.pixels());
  for (size_t i = 0; i < first.size(); ++i) {
    first[i] = all[i * channels];
    for (size_t c = 1; c < channels; ++c) {
      if (!same(all[i * channels + c], first[i])) {
        return fail(name + " has " + std::to_string(channels) +
                    " channels that differ; a height map has one, or equal " +
                    "ones: convert it to grey without alpha");
      }
    }
  }
  return first;
}

/// The float that a tag's decimal digits mean; "-3.40282346638529e+38" is the lowest one, though a little beyond it.
double as_float(double value) {
  constexpr double largest = std::numeric_limits<float>::max();
  if (!(std::abs(value) <= largest * (1 + 1e-7))) return value;
  return double(float(std::clamp(value, -largest, largest)));
}

template <class T>
std::vector<uint8_t> find_holes(const std::vector<T>& raw, std::optional<double> no_data) {
  if (!no_data) return {};
  const double exact = std::is_same_v<T, float> ? as_float(*no_data) : *no_data;
  std::vector<uint8_t> holes;
  for (size_t i = 0; i < raw.size(); ++i) {
    if (double(raw[i]) != exact) continue;
    if (holes.empty()) holes.resize(raw.size());
    holes[i] = 1;
  }
  return holes;
}

/// Shifts integers of up to 16 bits into the range of uint16_t.
template <class T>
std::vector<uint16_t> to_unsigned(const std::vector<T>& raw) {
  constexpr int lowest = std::numeric_limits<T>::min();
  std::vector<uint16_t> stored(raw.size());
  std::transform(raw.begin(), raw.end(), stored.begin(), [](T value) { return uint16_t(int(value) - lowest); });
  return stored;
}

Expected<std::vector<float>> to_float(const std::vector<double>& raw, const std::vector<uint8_t>& holes,
                                      const std::string& name) {
  std::vector<float> stored(raw.size(), std::numeric_limits<float>::quiet_NaN());
  for (size_t i = 0; i < raw.size(); ++i) {
    if (!holes.empty() && holes[i] != 0) continue;
    if (std::isfinite(raw[i]) && std::abs(raw[i]) > double(std::numeric_limits<float>::max())) {
      return fail(name + " holds " + std::to_string(raw[i]) + ", beyond what a float can; name it as no_data");
    }
    stored[i] = float(raw[i]);
  }
  return stored;
}

template <class T>
Expected<std::vector<float>> integers_to_float(const std::vector<T>& raw, const std::vector<uint8_t>& holes,
                                               const std::string& name) {
  constexpr int64_t largest = int64_t(1) << 24;
  std::vector<float> stored(raw.size(), 0.0f);
  for (size_t i = 0; i < raw.size(); ++i) {
    if (!holes.empty() && holes[i] != 0) continue;
    if (std::abs(int64_t(raw[i])) > largest) {
      return fail(name + " holds " + std::to_string(raw[i]) +
                  ", beyond 2^24, the largest 32-bit integer that heights " +
                  "keep exactly; name it as no_data or convert the file to float");
    }
    stored[i] = float(raw[i]);
  }
  return stored;
}

template <class T>
Expected<Heights> convert(const RawImage& image, std::optional<double> no_data, const std::string& name) {
  auto raw = single_channel<T>(image, name);
  if (!raw) return tl::unexpected(raw.error());
  Heights heights;
  heights.holes = find_holes(*raw, no_data);
  if constexpr (std::is_same_v<T, uint16_t> || std::is_same_v<T, float>) {
    heights.samples = std::move(*raw);
  } else if constexpr (sizeof(T) <= 2) {
    heights.samples = to_unsigned(*raw);
    heights.bias = std::numeric_limits<T>::min();
  } else {
    Expected<std::vector<float>> stored = [&] {
      if constexpr (std::is_same_v<T, double>)
        return to_float(*raw, heights.holes, name);
      else
        return integers_to_float(*raw, heights.holes, name);
    }();
    if (!stored) return tl::unexpected(stored.error());
    heights.samples = std::move(*stored);
  }
  return heights;
}

Expected<Heights> convert_any(const RawImage& image, std::optional<double> no_data, const std::string& name) {
  switch (image.type) {
    case SampleType::uint8:
      return convert<uint8_t>(image, no_data, name);
    case SampleType::int8:
      return convert<int8_t>(image, no_data, name);
    case SampleType::uint16:
      return convert<uint16_t>(image, no_data, name);
    case SampleType::int16:
      return convert<int16_t>(image, no_data, name);
    case SampleType::uint32:
      return convert<uint32_t>(image, no_data, name);
    case SampleType::int32:
      return convert<int32_t>(image, no_data, name);
    case SampleType::half:
    case SampleType::float32:
      return convert<float>(image, no_data, name);
    case SampleType::float64:
      return convert<double>(image, no_data, name);
  }
  return fail(name + " has samples of an unknown type");
}

/// The import's own value, else the file's tag, else -32768 for signed 16-bit samples. NaN is always a hole.
Expected<std::optional<double>> no_data_value(const HeightImport& import, const image_io::GeoTags& tags,
                                              SampleType type, const std::string& name) {
  if (import.no_data) return import.no_data;
  if (tags.no_data) {
    const std::string& text = *tags.no_data;
    const size_t begin = text.find_first_not_of(' ');
    const size_t end = text.find_last_not_of(' ');
    if (begin == std::string::npos) return std::nullopt;
    const size_t first = text[begin] == '+' ? begin + 1 : begin;
    double value = 0;
    const auto [stop, code] = std::from_chars(text.data() + first, text.data() + end + 1, value);
    if (code != std::errc() || stop != text.data() + end + 1) {
      return fail(name + " has the no-data tag \"" + text + "\", expected a number; give no_data yourself");
    }
    return value;
  }
  if (type == SampleType::int16) return -32768.0;
  return std::nullopt;
}

Expected<glm::dvec2> file_spacing(const image_io::GeoTags& tags, const std::string& name) {
  if (!tags.pixel_scale)
    return fail(name + " says nothing about its spacing (no GeoTIFF pixel scale); give it in metres");
  if (!tags.in_metres()) {
    return fail(name + " has its spacing in " +
                (tags.model_type == 2 ? "degrees" : "units that are not known as metres") + "; give it in metres");
  }
  return *tags.pixel_scale;
}

Expected<HeightField> load(const HeightImport& import) {
  const std::string name = image_io::named("height map", import.path);
  if (!std::isfinite(import.scale) || import.scale == 0.0 || !std::isfinite(import.offset)) {
    return fail(name + ": the height scale must be finite and not 0, the offset finite");
  }
  const auto image = image_io::read_image(import.path, "height map");
  if (!image) return tl::unexpected(image.error());
  if (image->stretched_from_bits != 0) {
    return fail(name + " has " + std::to_string(image->stretched_from_bits) +
                " bits a sample; convert it to 8, 16 or 32");
  }
  const auto tags = image_io::read_geo_tags(import.path);
  if (!tags) return tl::unexpected(tags.error());
  const auto no_data = no_data_value(import, *tags, image->type, name);
  if (!no_data) return tl::unexpected(no_data.error());
  auto heights = convert_any(*image, *no_data, name);
  if (!heights) return tl::unexpected(heights.error());

  HeightFieldDesc desc;
  desc.columns = image->width;
  desc.rows = image->height;
  desc.spacing = import.spacing;
  if (import.use_file_spacing) {
    const auto spacing = file_spacing(*tags, name);
    if (!spacing) return tl::unexpected(spacing.error());
    desc.spacing = *spacing;
  }
  desc.origin = import.origin;
  desc.scale = import.scale;
  desc.offset = import.offset + heights->bias * import.scale;
  desc.relief = import.relief;
  auto field = HeightField::create(desc, std::move(heights->samples), heights->holes);
  if (!field) return fail(name + ": " + field.error().message);
  return field;
}

}  // namespace

Expected<HeightField> load_height_field(const HeightImport& import) {
  try {
    return load(import);
  } catch (const std::exception& error) {
    return fail(image_io::named("height map", import.path) + " cannot be read: " + error.what());
  }
}

}  // namespace sward
