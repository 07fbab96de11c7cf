// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "image_io/raw_image.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <exception>
#include <filesystem>
#include <fstream>
#include <memory>
#include <new>
#include <optional>
#include <sstream>
#include <string_view>

#include "image_io/oiio_errors.h"
#include "image_io/png_chunks.h"

namespace sward::image_io {

namespace {

// The densest of the codecs in use (deflate, LZW, wavelets of a flat picture) stay below this many bytes a stored byte;
// a header that promises more is damaged, and the memory for it must not even be asked for.
constexpr uint64_t k_most_expansion = 4096;
constexpr uint64_t k_expansion_slack = 1 << 20;
constexpr uint64_t k_most_samples = uint64_t(1) << 31;

struct Signature {
  std::string_view bytes;
  const char* format;
};
constexpr std::array<Signature, 7> k_signatures{{
    {std::string_view("\x89PNG\r\n\x1a\n", 8), "png"},
    {std::string_view("II*\0", 4), "tiff"},
    {std::string_view("MM\0*", 4), "tiff"},
    {std::string_view("II+\0", 4), "tiff"},
    {std::string_view("MM\0+", 4), "tiff"},
    {std::string_view("\x76\x2f\x31\x01", 4), "openexr"},
    {std::string_view("\xff\xd8\xff", 3), "jpeg"},
}};

// Formats that are no pictures in files: they would invent one, open a stream or play a film.
constexpr std::array<std::string_view, 5> k_refused{"null", "socket", "ffmpeg", "term", "field3d"};

std::string lower_extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return extension;
}

/// The OpenImageIO format that reads an extension, from its list "format:ext,ext;format:ext".
std::string format_of_extension(const std::string& extension) {
  const std::string list = std::string(OIIO::get_string_attribute("extension_list")) + ";";
  for (size_t begin = 0, end; (end = list.find(';', begin)) != std::string::npos; begin = end + 1) {
    const std::string entry = list.substr(begin, end - begin);
    const size_t colon = entry.find(':');
    if (colon == std::string::npos) continue;
    if (("," + entry.substr(colon + 1) + ",").find("," + extension + ",") != std::string::npos) {
      return entry.substr(0, colon);
    }
  }
  return {};
}

std::string format_of_file(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::array<char, 8> head{};
  stream.read(head.data(), head.size());
  const std::string_view seen(head.data(), size_t(stream.gcount()));
  for (const Signature& signature : k_signatures) {
    if (seen.substr(0, signature.bytes.size()) == signature.bytes) return signature.format;
  }
  const std::string extension = lower_extension(path);
  const std::string format = extension.empty() ? std::string() : format_of_extension(extension);
  const bool refused = std::find(k_refused.begin(), k_refused.end(), format) != k_refused.end();
  return refused ? std::string() : format;
}

std::string read_bytes(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << stream.rdbuf();
  return std::move(bytes).str();
}

Expected<uint64_t> check_file(const std::string& path, const std::string& what) {
  std::error_code code;
  const auto status = std::filesystem::status(path, code);
  if (path.empty() || !std::filesystem::exists(status)) {
    return fail(named(what, path) + " does not exist or cannot be reached");
  }
  if (std::filesystem::is_directory(status)) return fail(named(what, path) + " is a folder, expected an image file");
  if (!std::filesystem::is_regular_file(status)) return fail(named(what, path) + " is no ordinary file");
  const uint64_t bytes = std::filesystem::file_size(path, code);
  if (code) return fail(named(what, path) + " cannot be read: " + code.message());
  if (bytes == 0) return fail(named(what, path) + " is empty (0 bytes)");
  if (!std::ifstream(path, std::ios::binary)) return fail(named(what, path) + " cannot be opened: permission denied");
  return bytes;
}

std::optional<SampleType> sample_type(OIIO::TypeDesc type) {
  switch (type.basetype) {
    case OIIO::TypeDesc::UINT8:
      return SampleType::uint8;
    case OIIO::TypeDesc::INT8:
      return SampleType::int8;
    case OIIO::TypeDesc::UINT16:
      return SampleType::uint16;
    case OIIO::TypeDesc::INT16:
      return SampleType::int16;
    case OIIO::TypeDesc::UINT32:
      return SampleType::uint32;
    case OIIO::TypeDesc::INT32:
      return SampleType::int32;
    case OIIO::TypeDesc::HALF:
      return SampleType::half;
    case OIIO::TypeDesc::FLOAT:
      return SampleType::float32;
    case OIIO::TypeDesc::DOUBLE:
      return SampleType::float64;
    default:
      return std::nullopt;
  }
}

Expected<void> check_spec(const OIIO::ImageSpec& spec, uint64_t file_bytes, const std::string& name) {
  if (spec.deep) return fail(name + " is a deep image; flatten it first");
  if (spec.depth > 1) return fail(name + " is a volume; expected a flat image");
  if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0) {
    return fail(name + " has no pixels (" + std::to_string(spec.width) + " x " + std::to_string(spec.height) + ", " +
                std::to_string(spec.nchannels) + " channels)");
  }
  if (!sample_type(spec.format) || !spec.channelformats.empty()) {
    return fail(name + " has samples of type " + std::string(spec.format.c_str()) +
                (spec.channelformats.empty() ? "" : " mixed with others") +
                ", expected one of 8, 16, 32-bit integers, half, float, double for all channels");
  }
  // Divisions, because products of a damaged header's numbers overflow.
  const uint64_t width = uint64_t(spec.width), height = uint64_t(spec.height), channels = uint64_t(spec.nchannels);
  const std::string size = std::to_string(width) + " x " + std::to_string(height);
  if (width > k_most_samples / height || width * height > k_most_samples / channels) {
    return fail(name + " is too large (" + size + ", " + std::to_string(channels) +
                " channels): at most 2^31 samples are read, cut it into tiles");
  }
  const uint64_t bytes = width * height * channels * spec.format.basesize();
  if (bytes > file_bytes * k_most_expansion + k_expansion_slack) {
    return fail(name + " is damaged or cut short: " + size + " pixels cannot come from " + std::to_string(file_bytes) +
                " bytes");
  }
  return {};
}

Expected<RawImage> read_pixels(OIIO::ImageInput& input, const std::string& name) {
  const OIIO::ImageSpec& spec = input.spec();
  RawImage image;
  image.width = spec.width;
  image.height = spec.height;
  image.channels = spec.nchannels;
  image.alpha_channel = spec.alpha_channel;
  image.type = *sample_type(spec.format);
  const int bits = 8 * int(spec.format.basesize());
  image.stretched_from_bits = spec.get_int_attribute("oiio:BitsPerSample", bits) % bits;
  OIIO::TypeDesc wanted = spec.format;
  if (image.type == SampleType::half) {
    image.type = SampleType::float32;
    wanted = OIIO::TypeDesc::FLOAT;
  }
  image.bytes.resize(image.pixels() * size_t(image.channels) * wanted.size());
  // libjpeg fills what is missing with grey and returns success; the error is pending then.
  const bool complete = input.read_image(0, 0, 0, spec.nchannels, wanted, image.bytes.data());
  if (!complete || input.has_error()) {
    return fail(name + " is damaged or cut short: " + one_line(input.geterror()));
  }
  return image;
}

Expected<RawImage> open_and_read(const std::string& path, const std::string& what) {
  const std::string name = named(what, path);
  const auto file_bytes = check_file(path, what);
  if (!file_bytes) return tl::unexpected(file_bytes.error());
  const std::string format = format_of_file(path);
  if (format.empty()) {
    return fail(name + " is not an image of a known format: expected PNG, TIFF, EXR, JPEG or another image file");
  }
  const auto input = OIIO::ImageInput::create(format);
  if (!input) return fail(name + " cannot be read: " + one_line(OIIO::geterror()));
  const DrainErrors drain(*input);

  std::string chunks;
  std::optional<OIIO::Filesystem::IOMemReader> memory;
  if (format == "png") {
    auto kept = pixel_chunks(read_bytes(path), name);
    if (!kept) return tl::unexpected(kept.error());
    chunks = std::move(*kept);
    input->set_ioproxy(&memory.emplace(chunks.data(), chunks.size()));
  }
  OIIO::ImageSpec config, spec;
  config.attribute("oiio:UnassociatedAlpha", 1);
  if (!input->open(path, spec, config)) {
    return fail(name + " is not a valid " + format + " file: " + one_line(input->geterror()));
  }
  if (auto checked = check_spec(spec, *file_bytes, name); !checked) return tl::unexpected(checked.error());
  return read_pixels(*input, name);
}

}  // namespace

const char* describe(SampleType type) {
  switch (type) {
    case SampleType::uint8:
      return "8-bit";
    case SampleType::int8:
      return "signed 8-bit";
    case SampleType::uint16:
      return "16-bit";
    case SampleType::int16:
      return "signed 16-bit";
    case SampleType::uint32:
      return "32-bit";
    case SampleType::int32:
      return "signed 32-bit";
    case SampleType::half:
      return "half";
    case SampleType::float32:
      return "float";
    case SampleType::float64:
      return "double";
  }
  return "unknown";
}

std::string named(const std::string& what, const std::string& path) {
  return what + " \"" + path + "\"";
}

Expected<RawImage> read_image(const std::string& path, const std::string& what) {
  try {
    return open_and_read(path, what);
  } catch (const std::bad_alloc&) {
    return fail(named(what, path) + " does not fit into memory; cut it into tiles");
  } catch (const std::exception& error) {
    return fail(named(what, path) + " cannot be read: " + one_line(error.what()));
  }
}

}  // namespace sward::image_io
