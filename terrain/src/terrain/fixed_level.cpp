// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Section 3.1 of Papavasiliou, "Real-Time Grass (and Other Procedural Objects) on Terrain" (2015): the mesh's own
// hierarchy is culled and cut at one level; leaves above that level are split flat. Departures: the walk ends at chunks
// of 64 triangles, which are kept from frame to frame and tested side by side; canopy and bound are added in the tests,
// not to the mesh's error metric.
#include "fixed_level.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <optional>
#include <thread>

#include "fixed_level_kernel.h"
#include "worker_pool.h"

namespace sward::roam {

namespace {

// Frames that a chunk out of sight is kept for.
constexpr uint64_t k_frames_kept = 60;
// Chunks that are worth a thread of their own: some 0.1 ms of work.
constexpr size_t k_chunks_a_thread = 96;

bool same(const View& a, const View& b) {
  return a.eye == b.eye && a.eye_from_world == b.eye_from_world && a.clip_from_eye == b.clip_from_eye &&
         a.viewport == b.viewport;
}

bool same(const FixedLevelOptions& a, const FixedLevelOptions& b) {
  return a.level == b.level && a.horizon_m == b.horizon_m && a.canopy_m == b.canopy_m && a.spread_m == b.spread_m &&
         a.skip_back_faces == b.skip_back_faces && a.altitudes == b.altitudes;
}

bool meet(const LatticeBox& a, const LatticeBox& b) {
  return !b.empty() && a.first.x <= b.last.x && b.first.x <= a.last.x && a.first.y <= b.last.y && b.first.y <= a.last.y;
}

// Copies the elements that `mask` names to the front of `to`, run by run.
template <class From, class T>
void pack(const From& from, uint64_t mask, T* to) {
  for (uint64_t rest = mask; rest != 0;) {
    const int first = std::countr_zero(rest), length = std::countr_one(rest >> first);
    std::memcpy(to, from.data() + first, size_t(length) * sizeof(T));
    to += length;
    if (first + length == 64) return;
    rest &= ~uint64_t(0) << (first + length);
  }
}

// The next chunk's data are fetched while one is worked on: between frames they leave the fast caches.
void prefetch(const Chunk& chunk) {
  const char* const begin = reinterpret_cast<const char*>(&chunk);
  const size_t size = chunk.flat ? offsetof(Chunk, bound) : sizeof(Chunk);
  for (size_t at = 0; at < size; at += 64) __builtin_prefetch(begin + at);
}

// Where a chunk's share of the output begins.
struct Offset {
  size_t triangle = 0, node = 1;
};

struct KeptChunk {
  uint64_t key;
  uint64_t seen;  // the frame that visited it last
  Chunk* chunk;
};

class Memory final : public FixedTrianglesMemory {
 public:
  void collect(const ChunkSource& source, const SurfaceState& surface, FixedTriangles& out);

 private:
  void forget_changed(const SurfaceState& surface, int level);
  bool match_chunks();
  Chunk* acquire();
  void keep_or_release(const KeptChunk& kept);
  bool refresh(const ChunkSource& source);
  void write_in_order(const ChunkKernel& kernel, FixedTriangles& out);
  void write_side_by_side(const ChunkKernel& kernel, FixedTriangles& out);
  void write_chunk(size_t i, const ChunkResult& result, Offset at, const FixedTriangles::Writer& to) const;
  void write_nodes(const Chunk& chunk, const ChunkResult& result, Offset at, const FixedTriangles::Writer& to) const;
  Offset share(const Chunk& chunk, const ChunkResult& result) const;
  int parts() const;
  template <class Work>
  void for_chunks(Work&& work);

  // What the last call was about.
  std::optional<View> view_;
  FixedLevelOptions options_;
  uint64_t surface_epoch_ = 0;
  uint64_t contents_ = 0;  // of `out` after it

  std::vector<ChunkVisit> visits_;
  std::vector<Chunk*> chunks_;        // of the visits
  std::vector<ChunkResult> results_;  // of the visits, where several threads work
  std::vector<Offset> offsets_;
  int depth_ = 0;
  double surface_z_ = 0;

  uint64_t frame_ = 1;
  std::vector<std::unique_ptr<Chunk>> storage_;
  std::vector<KeptChunk> kept_, merged_;  // by key
  std::vector<Chunk*> free_;
  WorkerPool pool_;
};

void Memory::collect(const ChunkSource& source, const SurfaceState& surface, FixedTriangles& out) {
  const View& view = source.view();
  const FixedLevelOptions& options = source.options();
  forget_changed(surface, options.level);
  const bool holds_this_view = contents_ == out.contents() && view_ && same(*view_, view) && same(options_, options);
  view_ = view;
  options_ = options;
  depth_ = std::min(options.level, k_chunk_depth);
  source.run(options.level - depth_, visits_);
  const bool same_chunks = match_chunks();
  const bool still = holds_this_view && same_chunks;
  const bool changed = refresh(source);
  if (still && !changed) return;
  const ChunkKernel kernel(source);
  surface_z_ = std::round(view.eye.z);
  out.set_surface_z(surface_z_);
  if (parts() == 1) {
    write_in_order(kernel, out);
  } else {
    write_side_by_side(kernel, out);
  }
  contents_ = out.contents();
}

void Memory::forget_changed(const SurfaceState& surface, int level) {
  const bool known = surface.epoch != 0 && surface_epoch_ != 0 && level == options_.level;
  if (known && surface.epoch == surface_epoch_) return;
  // Of another surface's epochs the difference is huge.
  const uint64_t epochs = surface.epoch - surface_epoch_;
  const bool local = known && epochs <= surface.changed.size();
  const auto changed = local ? surface.changed.last(size_t(epochs)) : surface.changed;
  for (const KeptChunk& kept : kept_) {
    Chunk& chunk = *kept.chunk;
    const auto meets = [&](const LatticeBox& box) { return meet(chunk.box, box); };
    if (!local || std::ranges::any_of(changed, meets)) chunk.has_static = chunk.has_drawn = false;
  }
  surface_epoch_ = surface.epoch;
}

// Finds the visits' chunks among those kept, both in the order of their keys. True if they are those of the last call.
bool Memory::match_chunks() {
  const size_t before = chunks_.size();
  bool same_as_before = before == visits_.size();
  ++frame_;
  chunks_.clear();
  merged_.clear();
  size_t next = 0;
  for (const ChunkVisit& visit : visits_) {
    while (next < kept_.size() && kept_[next].key < visit.key) keep_or_release(kept_[next++]);
    const bool found = next < kept_.size() && kept_[next].key == visit.key;
    same_as_before &= found && kept_[next].seen + 1 == frame_;
    Chunk* const chunk = found ? kept_[next++].chunk : acquire();
    __builtin_prefetch(chunk);
    chunks_.push_back(chunk);
    merged_.push_back({visit.key, frame_, chunk});
  }
  while (next < kept_.size()) keep_or_release(kept_[next++]);
  kept_.swap(merged_);
  return same_as_before;
}

Chunk* Memory::acquire() {
  if (free_.empty()) {
    storage_.push_back(std::make_unique<Chunk>());
    free_.push_back(storage_.back().get());
  }
  Chunk* chunk = free_.back();
  free_.pop_back();
  chunk->has_static = chunk->has_drawn = false;
  return chunk;
}

void Memory::keep_or_release(const KeptChunk& kept) {
  if (kept.seen + k_frames_kept >= frame_) {
    merged_.push_back(kept);
  } else {
    free_.push_back(kept.chunk);
  }
}

bool Memory::refresh(const ChunkSource& source) {
  std::atomic<bool> changed = false;
  const auto refresh_one = [&](size_t i) {
    if (source.refresh(visits_[i], depth_, *chunks_[i])) changed.store(true, std::memory_order_relaxed);
  };
  if (source.refreshes_side_by_side()) {
    for_chunks(refresh_one);
  } else {
    for (size_t i = 0; i < visits_.size(); ++i) refresh_one(i);
  }
  return changed;
}

int Memory::parts() const {
  const auto threads = options_.threads > 0 ? size_t(options_.threads) : std::thread::hardware_concurrency();
  return int(std::clamp<size_t>(visits_.size() / k_chunks_a_thread, 1, std::max<size_t>(threads, 1)));
}

// Each thread takes a run of chunks.
template <class Work>
void Memory::for_chunks(Work&& work) {
  const auto count = size_t(parts());
  pool_.run(int(count), [&](int part) {
    const size_t end = visits_.size() * size_t(part + 1) / count;
    for (size_t i = visits_.size() * size_t(part) / count; i < end; ++i) work(i);
  });
}

// What a chunk adds to the output.
Offset Memory::share(const Chunk& chunk, const ChunkResult& result) const {
  Offset share{size_t(std::popcount(result.visible)), 0};
  if (chunk.nodes.empty()) return share;
  for (uint64_t rest = result.visible; rest != 0; rest &= rest - 1)
    share.node += chunk.node_count[size_t(std::countr_zero(rest))];
  return share;
}

// One thread: each chunk is written as soon as it is measured, into room for all of them.
void Memory::write_in_order(const ChunkKernel& kernel, FixedTriangles& out) {
  size_t most_nodes = 1;
  for (const Chunk* chunk : chunks_) most_nodes += chunk->nodes.size();
  const FixedTriangles::Writer to = out.write(chunks_.size() * k_chunk_size, most_nodes);
  Offset next;
  ChunkResult result;
  for (size_t i = 0; i < chunks_.size(); ++i) {
    if (i + 1 < chunks_.size()) prefetch(*chunks_[i + 1]);
    kernel.evaluate(visits_[i], depth_, *chunks_[i], result);
    write_chunk(i, result, next, to);
    const Offset own = share(*chunks_[i], result);
    next = {next.triangle + own.triangle, next.node + own.node};
  }
  out.write(next.triangle, next.node);
}

// Several threads: all chunks are measured, then their places are known.
void Memory::write_side_by_side(const ChunkKernel& kernel, FixedTriangles& out) {
  if (results_.size() < chunks_.size()) results_.resize(chunks_.size() + chunks_.size() / 2);
  for_chunks([&](size_t i) { kernel.evaluate(visits_[i], depth_, *chunks_[i], results_[i]); });
  offsets_.clear();
  Offset next;
  for (size_t i = 0; i < chunks_.size(); ++i) {
    offsets_.push_back(next);
    const Offset own = share(*chunks_[i], results_[i]);
    next = {next.triangle + own.triangle, next.node + own.node};
  }
  const FixedTriangles::Writer to = out.write(next.triangle, next.node);
  for_chunks([&](size_t i) { write_chunk(i, results_[i], offsets_[i], to); });
}

void Memory::write_chunk(size_t i, const ChunkResult& result, Offset at, const FixedTriangles::Writer& to) const {
  if (result.visible == 0) return;
  const Chunk& chunk = *chunks_[i];
  pack(chunk.apex, result.visible, &to.apex[at.triangle]);
  pack(chunk.to_left, result.visible, &to.to_left[at.triangle]);
  pack(chunk.to_right, result.visible, &to.to_right[at.triangle]);
  pack(chunk.area, result.visible, &to.area[at.triangle]);
  pack(result.screen_area, result.visible, &to.screen_area[at.triangle]);
  pack(result.distance, result.visible, &to.distance[at.triangle]);
  if (chunk.altitude.empty()) {
    std::fill_n(&to.altitude[at.triangle], std::popcount(result.visible), glm::vec3(NAN));
  } else {
    pack(chunk.altitude, result.visible, &to.altitude[at.triangle]);
  }
  const uint64_t first = visits_[i].triangle.id.bits + (uint64_t(depth_) << 58);
  const int shift = k_max_level - options_.level;
  TriangleId* id = &to.id[at.triangle];
  for (uint64_t rest = result.visible; rest != 0; rest &= rest - 1)
    *id++ = {first | uint64_t(std::countr_zero(rest)) << shift};
  if (chunk.nodes.empty()) {
    std::fill_n(&to.surface[at.triangle], std::popcount(result.visible), 0u);
  } else {
    write_nodes(chunk, result, at, to);
  }
}

void Memory::write_nodes(const Chunk& chunk, const ChunkResult& result, Offset at,
                         const FixedTriangles::Writer& to) const {
  for (uint64_t rest = result.visible; rest != 0; rest &= rest - 1) {
    const auto j = size_t(std::countr_zero(rest));
    const auto base = uint32_t(at.node);
    const auto place = [base](uint32_t child) { return child == 0 ? 0 : base + child; };
    to.surface[at.triangle++] = chunk.node_count[j] == 0 ? 0 : base;
    const ChunkNode* node = chunk.nodes.data() + chunk.first_node[j];
    for (uint32_t k = 0; k < chunk.node_count[j]; ++k, ++node)
      to.nodes[at.node++] = {float(node->z - surface_z_), {place(node->child[0]), place(node->child[1])}, 0};
  }
}

}  // namespace

SurfaceHistory::SurfaceHistory() {
  static std::atomic<uint64_t> surfaces{0};
  epoch_ = (++surfaces << 40) + 1;
}

void SurfaceHistory::changed(const LatticeBox& box) {
  constexpr size_t k_kept = 16;
  if (changes_.size() == k_kept) changes_.erase(changes_.begin());
  changes_.push_back(box);
  ++epoch_;
}

void collect_fixed_level(const ChunkSource& source, const SurfaceState& surface, FixedTriangles& out) {
  auto* memory = dynamic_cast<Memory*>(out.memory().get());
  if (memory == nullptr) {
    auto fresh = std::make_unique<Memory>();
    memory = fresh.get();
    out.memory() = std::move(fresh);
  }
  memory->collect(source, surface, out);
}

void collect_fixed_level(const RoamTree& tree, const View& view, const FixedLevelOptions& options,
                         const SurfaceState& surface, FixedTriangles& out) {
  collect_fixed_level(FixedLevelWalk(tree, view, options), surface, out);
}

}  // namespace sward::roam
