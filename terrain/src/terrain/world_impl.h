// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/world.h>
#include <array>
#include <atomic>
#include <chrono>
#include <memory>
#include <unordered_map>
#include <unordered_set>

#include "world_layout.h"
#include "world_loader.h"
#include "world_readers.h"

namespace sward {

/// What answers (world_surface.cpp) and what decides on what is resident (world_residency.cpp).
struct World::Impl {
  Impl(const WorldDesc& desc, std::shared_ptr<const WorldCoarse> coarse_data, LoadSquare source,
       const WorldOptions& world_options);

  // A sample of a resident square, 0-based within it.
  struct FineSample {
    const SquareData* data = nullptr;  // null: not resident
    glm::ivec2 at{0};
  };
  // What ranks a square.
  struct SquareInfo {
    float detail_m = 0;       // the most that coarse triangles may be off
    float low = 0, high = 0;  // of all that may be in it, metres, world
  };
  struct Wanted {
    uint32_t index = 0;
    float score_px = 0;  // how much the coarse data may be off on screen, more where the square is resident
    bool in_sight = false;
  };
  struct Box {
    glm::dvec3 low, high;
  };
  struct Failure {
    int attempts = 0;
    std::string message;
    std::chrono::steady_clock::time_point retry_at;
  };

  // Reading; any thread, counted in as a reader.
  const SquareData* fine(glm::ivec2 square) const {
    return slots[layout.square_index(square)].load(std::memory_order_seq_cst);
  }
  FineSample find(glm::ivec2 sample) const;
  double metres(double raw) const { return raw * layout.desc.scale + (layout.desc.offset + layout.desc.origin.z); }
  double coarse_height(glm::ivec2 at) const {
    return metres(double(coarse->heights[layout.coarse_index(glm::min(at, layout.coarse_last))]));
  }
  double sample_height(glm::ivec2 sample) const;
  double surface_height(glm::dvec2 lattice_place) const;
  float cell_bound(LatticePoint centre) const;
  bool ancestors_resident(LatticePoint centre, int level) const;
  glm::dvec2 fine_gradient(const SquareData& data, glm::ivec2 square, glm::ivec2 sample) const;
  glm::dvec2 coarse_gradient(glm::ivec2 at) const;
  // Slopes at the corners of the coarse cell that was asked for last.
  struct CoarseCell {
    glm::ivec2 cell{-1};
    std::array<glm::dvec2, 4> gradient;
  };
  glm::dvec2 coarse_gradient_between(glm::dvec2 place, CoarseCell& kept) const;
  glm::dvec2 gradient_between(glm::dvec2 place) const;
  glm::dvec2 wide_gradient(const SquareData& data, glm::ivec2 square, glm::ivec2 sample, int reach) const;

  // Residency; the controlling thread.
  Box box_of(glm::ivec2 square) const;
  void score_around(const View& view);
  void rank(std::span<const View> views);
  void take_answers(std::vector<LatticeBox>& boxes);
  void adopt(glm::ivec2 square, SquareData data, std::vector<LatticeBox>& boxes);
  void note_failure(glm::ivec2 square, const std::string& message);
  void free_dropped();
  void ask(std::vector<LatticeBox>& boxes);
  bool may_ask_for(uint32_t index, std::chrono::steady_clock::time_point now) const;
  bool drop_least_useful(std::vector<LatticeBox>& boxes);
  size_t squares_in_use() const { return resident.size() + dropped.size() + leaving.size() + loader.held(); }
  glm::ivec2 square_of(uint32_t index) const { return {int(index) % layout.squares.x, int(index) / layout.squares.x}; }

  const world::WorldLayout layout;
  const WorldOptions options;
  const std::shared_ptr<const WorldCoarse> coarse;
  std::vector<SquareInfo> squares;
  std::vector<float> score;  // by square, of the last follow(), pixels; 0 beyond the surroundings of all eyes
  size_t base_bytes = 0;     // what does not come and go
  size_t capacity = 0;       // squares that fit beside that

  std::vector<std::atomic<const SquareData*>> slots;  // by square
  std::unordered_map<uint32_t, std::unique_ptr<SquareData>> resident;
  std::vector<std::unique_ptr<SquareData>> dropped;  // since the readers' last flip
  std::vector<std::unique_ptr<SquareData>> leaving;  // before it: freed when their readers have gone
  world::Readers readers;
  std::unordered_map<uint32_t, Failure> failing;
  std::unordered_set<uint32_t> asked;
  std::vector<Wanted> ranked;    // of the last follow(), in the order of loading; all but the wanted cut off
  std::vector<uint32_t> scored;  // the squares whose score is not 0
  WorldStats stats;
  world::SquareLoader loader;
};

}  // namespace sward
