// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/terrain/world_bake.h>

#include <bit>
#include <filesystem>

#include "world_files.h"
#include "world_layout.h"

namespace sward {

namespace {

namespace fs = std::filesystem;

// What is in the folder already must not be another world.
Expected<void> check_folder(const std::string& folder, uint64_t fingerprint) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return fail("cannot create the folder '" + folder + "': " + error.message());
  if (!fs::exists(world::index_path(folder), error)) return {};
  const auto index = world::read_index(folder);
  if (index && index->fingerprint == fingerprint) return {};
  return fail("the folder '" + folder +
              "' holds another world, or one baked from other files; delete it or name another");
}

// What runs that were killed have left.
void remove_temporaries(const std::string& folder) {
  std::error_code error;
  std::vector<fs::path> found;
  for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (it->path().extension() == ".part") found.push_back(it->path());
  }
  for (const fs::path& path : found) fs::remove(path, error);
}

uint64_t count_holes(const SquareData& data) {
  uint64_t count = 0;
  for (const uint64_t word : data.holes) count += uint64_t(std::popcount(word));
  return count;
}

class Baker {
 public:
  Baker(const std::string& folder, const BakeDesc& desc, const ReadHeights& read)
      : folder_(folder), desc_(desc), read_(read), layout_(desc.world), coarse_(layout_) {
    index_.desc = desc.world;
    index_.fingerprint = world::fingerprint_of(desc.world, desc.source);
    index_.checksums.resize(layout_.square_count());
  }

  Expected<BakeStats> run(const Progress& progress) {
    if (auto checked = check_folder(folder_, index_.fingerprint); !checked)
      return tl::unexpected<Error>(checked.error());
    const size_t count = layout_.square_count();
    const size_t stride = (count + 255) / 256;
    for (size_t i = 0; i < count; ++i) {
      const glm::ivec2 square(int(i % size_t(layout_.squares.x)), int(i / size_t(layout_.squares.x)));
      if (auto done = bake(square); !done) return tl::unexpected<Error>(done.error());
      if (progress && (i + 1) % stride == 0) progress(float(i + 1) / float(count));
    }
    index_.coarse = coarse_.finish(desc_.threads);
    if (auto written = world::write_index(folder_, index_); !written) return tl::unexpected<Error>(written.error());
    remove_temporaries(folder_);
    std::error_code ignored;
    stats_.bytes += fs::file_size(world::index_path(folder_), ignored);
    if (progress) progress(1.0f);
    return stats_;
  }

 private:
  Expected<void> bake(glm::ivec2 square) {
    auto finished = world::read_square(folder_, layout_, index_.fingerprint, square, false);
    if (finished) {
      stats_.skipped += 1;
      take(square, finished->data, finished->checksum);
      return {};
    }
    auto data = build_square(desc_.world, square, read_, desc_.threads);
    if (!data) return tl::unexpected<Error>(data.error());
    auto checksum = world::write_square(folder_, layout_, index_.fingerprint, square, *data);
    if (!checksum) {
      return fail(checksum.error().message + "; finished squares stay: mend that and bake again to go on");
    }
    stats_.baked += 1;
    take(square, *data, *checksum);
    return {};
  }

  void take(glm::ivec2 square, const SquareData& data, uint64_t checksum) {
    index_.checksums[layout_.square_index(square)] = checksum;
    coarse_.add(square, data);
    stats_.holes += count_holes(data);
    std::error_code ignored;
    stats_.bytes += fs::file_size(world::square_path(folder_, square), ignored);
  }

  const std::string& folder_;
  const BakeDesc& desc_;
  const ReadHeights& read_;
  world::WorldLayout layout_;
  world::CoarseBuilder coarse_;
  world::WorldIndex index_;
  BakeStats stats_;
};

}  // namespace

Expected<BakeStats> bake_world(const std::string& folder, const BakeDesc& desc, const ReadHeights& read,
                               const Progress& progress) {
  if (auto checked = desc.world.validate(); !checked) return tl::unexpected<Error>(checked.error());
  return Baker(folder, desc, read).run(progress);
}

}  // namespace sward
