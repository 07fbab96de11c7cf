// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Which squares are resident. A square is worth as many pixels as its coarse triangles may be off on screen, the same
// measure by which the mesh refines: bound of its worst coarse cell, over the distance, times the focal length. The
// most useful that fit are wanted. What is not wanted stays until its room is needed, and what is resident counts a
// quarter more, so that a still or a hovering view changes nothing.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include <sward/terrain/bounds.h>

#include "world_files.h"
#include "world_impl.h"

namespace sward {

namespace {

constexpr float k_resident_bonus = 1.25f;
// Asked for at a time: one being loaded, one that keeps the thread busy meanwhile.
constexpr size_t k_most_asked = 2;
constexpr int k_most_doublings = 6;

std::string name_of(glm::ivec2 square) {
  return "square (" + std::to_string(square.x) + ", " + std::to_string(square.y) + ")";
}

Expected<void> check(const WorldOptions& options) {
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  if (!(options.worth_px >= 0.0f)) return fail("worth_px must be 0 or a positive number of pixels");
  if (options.adopt_per_poll < 1) return fail("adopt_per_poll must be at least 1");
  if (!positive(options.answer_timeout_s)) return fail("answer_timeout_s must be a positive number of seconds");
  if (!positive(options.retry_s)) return fail("retry_s must be a positive number of seconds");
  if (!(options.close_wait_s >= 0.0) || !std::isfinite(options.close_wait_s))
    return fail("close_wait_s must be 0 or a positive number of seconds");
  return {};
}

Expected<void> check(const world::WorldLayout& layout, const WorldCoarse& coarse) {
  if (coarse.heights.size() == layout.coarse_samples() && coarse.bounds.size() == layout.coarse_samples() &&
      coarse.cell_bounds.size() == layout.coarse_cells()) {
    return {};
  }
  return fail("the coarse data does not fit the world: it needs " + std::to_string(layout.coarse_samples()) +
              " heights and bounds and " + std::to_string(layout.coarse_cells()) + " cell bounds");
}

// The part of the cap that the coarse data takes, and what each square costs beside it.
size_t base_bytes_of(const world::WorldLayout& layout) {
  const size_t coarse =
      layout.coarse_samples() * (sizeof(float) + sizeof(uint16_t)) + layout.coarse_cells() * sizeof(uint16_t);
  return coarse + layout.square_count() * (sizeof(void*) + 4 * sizeof(float));
}

Expected<void> check_memory(const world::WorldLayout& layout, const WorldOptions& options) {
  const size_t least = base_bytes_of(layout) + 2 * layout.square_bytes(true);
  if (options.memory_bytes >= least) return {};
  return fail("a memory cap of " + std::to_string(options.memory_bytes) +
              " bytes is below the coarse data and two squares of this world; raise it to at least " +
              std::to_string(least));
}

// A box around a square against the view's halfspaces.
bool meets(std::span<const Plane> planes, glm::dvec3 low, glm::dvec3 high) {
  for (const Plane& plane : planes) {
    const glm::dvec3 far(plane.n.x > 0 ? high.x : low.x, plane.n.y > 0 ? high.y : low.y,
                         plane.n.z > 0 ? high.z : low.z);
    if (glm::dot(plane.n, far) + plane.d < 0) return false;
  }
  return true;
}

}  // namespace

World::Impl::Impl(const WorldDesc& desc, std::shared_ptr<const WorldCoarse> coarse_data, LoadSquare source,
                  const WorldOptions& world_options)
    : layout(desc),
      options(world_options),
      coarse(std::move(coarse_data)),
      squares(layout.square_count()),
      score(layout.square_count(), 0.0f),
      base_bytes(base_bytes_of(layout)),
      capacity((options.memory_bytes - base_bytes) / layout.square_bytes(true)),
      slots(layout.square_count()),
      loader(world::guarded_source(std::move(source)), options.close_wait_s) {
  const int across = 1 << desc.coarse_bits;
  for (uint32_t index = 0; index < squares.size(); ++index) {
    const glm::ivec2 corner = square_of(index) * across;
    SquareInfo& info = squares[index];
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
    for (int row = 0; row <= across; ++row)
      for (int column = 0; column <= across; ++column) {
        const double z = coarse_height(corner + glm::ivec2(column, row));
        low = std::min(low, z);
        high = std::max(high, z);
        if (row == across || column == across) continue;
        const uint16_t code = coarse->cell_bounds[layout.cell_index(corner + glm::ivec2(column, row))];
        if (code != world::k_nothing) info.detail_m = std::max(info.detail_m, Bounds::decode(code));
      }
    info.low = float(low) - info.detail_m;
    info.high = float(high) + info.detail_m;
  }
}

World::World(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
World::~World() = default;

Expected<std::unique_ptr<World>> World::create(const WorldDesc& desc, WorldCoarse coarse, LoadSquare load,
                                               const WorldOptions& options) {
  SWARD_ASSERT(load != nullptr, "a world needs a source of squares");
  if (auto checked = desc.validate(); !checked) return tl::unexpected<Error>(checked.error());
  if (auto checked = check(options); !checked) return tl::unexpected<Error>(checked.error());
  const world::WorldLayout layout(desc);
  if (auto checked = check(layout, coarse); !checked) return tl::unexpected<Error>(checked.error());
  if (auto checked = check_memory(layout, options); !checked) return tl::unexpected<Error>(checked.error());
  const auto shared = std::make_shared<const WorldCoarse>(std::move(coarse));
  return std::unique_ptr<World>(
      new World(std::make_unique<Impl>(desc, shared, world::checked_source(layout, shared, std::move(load)), options)));
}

Expected<std::unique_ptr<World>> World::open(const std::string& folder, const WorldOptions& options) {
  auto index = world::read_index(folder);
  if (!index) return tl::unexpected<Error>(index.error());
  if (auto checked = check(options); !checked) return tl::unexpected<Error>(checked.error());
  const world::WorldLayout layout(index->desc);
  if (auto checked = check_memory(layout, options); !checked) return tl::unexpected<Error>(checked.error());
  const auto sums = std::make_shared<const std::vector<uint64_t>>(std::move(index->checksums));
  const auto load = [folder, layout, sums, print = index->fingerprint,
                     mapped = options.map_files](const SquareRequest& request) -> Expected<SquareData> {
    auto square = world::read_square(folder, layout, print, request.square, mapped);
    if (!square) return tl::unexpected<Error>(square.error());
    if (square->checksum != (*sums)[layout.square_index(request.square)])
      return fail("is not the one that the world's index was written for: bake the world again");
    return std::move(square->data);
  };
  return std::unique_ptr<World>(new World(std::make_unique<Impl>(
      index->desc, std::make_shared<const WorldCoarse>(std::move(index->coarse)), load, options)));
}

// A square's box, world axes.
World::Impl::Box World::Impl::box_of(glm::ivec2 square) const {
  const SquareInfo& info = squares[layout.square_index(square)];
  const LatticePoint nw = square * k_root_side;
  const glm::dvec2 north_west = layout.lattice.world_xy(nw), south_east = layout.lattice.world_xy(nw + k_root_side);
  return {{north_west.x, south_east.y, info.low}, {south_east.x, north_west.y, info.high}};
}

// Scores of the squares around one eye, the higher one where another eye has scored them before.
void World::Impl::score_around(const View& view) {
  // Squares beyond these could only be wanted where nearer ones are flat.
  const int around = int(std::ceil(std::sqrt(double(capacity)))) + 1;
  const WorldDesc& d = layout.desc;
  const glm::dvec2 focal = view.focal_px();
  const double px = std::max(focal.x, focal.y);
  const glm::dvec2 place((view.eye.x - d.origin.x) / d.spacing.x + 0.5 * (d.columns - 1),
                         0.5 * (d.rows - 1) - (view.eye.y - d.origin.y) / d.spacing.y);
  const glm::dvec2 end(layout.squares - 1);
  const glm::ivec2 own(glm::clamp(glm::floor(place / double(layout.cells)), glm::dvec2(0), end));
  const glm::ivec2 first = glm::max(own - around, glm::ivec2(0)), last = glm::min(own + around, glm::ivec2(end));
  for (int row = first.y; row <= last.y; ++row)
    for (int column = first.x; column <= last.x; ++column) {
      const auto index = uint32_t(layout.square_index({column, row}));
      if (squares[index].detail_m <= 0.0f) continue;
      const Box box = box_of({column, row});
      const double away = glm::length(view.eye - glm::clamp(view.eye, box.low, box.high));
      const double off_px = squares[index].detail_m * px / (view.perspective() ? std::max(away, d.spacing.x) : 1.0);
      const bool is_resident = slots[index].load(std::memory_order_relaxed) != nullptr;
      if (score[index] == 0.0f) scored.push_back(index);
      score[index] = std::max(score[index], float(off_px) * (is_resident ? k_resident_bonus : 1.0f));
    }
}

void World::Impl::rank(std::span<const View> views) {
  for (const uint32_t index : scored) score[index] = 0.0f;
  scored.clear();
  ranked.clear();
  std::vector<std::pair<glm::dvec3, std::array<Plane, 6>>> eyes;
  for (const View& view : views) {
    if (!view.validate()) continue;
    score_around(view);
    eyes.emplace_back(view.eye, frustum_planes(view));
  }
  for (const uint32_t index : scored) {
    if (score[index] >= options.worth_px) ranked.push_back({index, score[index], false});
  }
  std::sort(ranked.begin(), ranked.end(), [](const Wanted& a, const Wanted& b) {
    return a.score_px != b.score_px ? a.score_px > b.score_px : a.index < b.index;
  });
  // One square of the capacity is for what is on its way in or out.
  if (ranked.size() > capacity - 1) ranked.resize(capacity - 1);
  for (Wanted& wanted : ranked) {
    const Box box = box_of(square_of(wanted.index));
    wanted.in_sight = std::any_of(eyes.begin(), eyes.end(), [&](const auto& eye) {
      return meets(eye.second, box.low - eye.first, box.high - eye.first);
    });
  }
  std::stable_partition(ranked.begin(), ranked.end(), [](const Wanted& wanted) { return wanted.in_sight; });
}

void World::follow(std::span<const View> views) {
  impl_->rank(views);
}

void World::Impl::note_failure(glm::ivec2 square, const std::string& message) {
  const uint32_t index = uint32_t(layout.square_index(square));
  Failure& failure = failing[index];
  const double wait = std::ldexp(options.retry_s, std::min(failure.attempts, k_most_doublings));
  failure.attempts += 1;
  failure.message = message;
  failure.retry_at = std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                                            std::chrono::duration<double>(wait));
  stats.failures += 1;
  stats.last_error = name_of(square) + ": " + message;
}

void World::Impl::adopt(glm::ivec2 square, SquareData data, std::vector<LatticeBox>& boxes) {
  const uint32_t index = uint32_t(layout.square_index(square));
  auto kept = std::make_unique<SquareData>(std::move(data));
  slots[index].store(kept.get(), std::memory_order_seq_cst);
  resident[index] = std::move(kept);
  failing.erase(index);
  stats.loads += 1;
  boxes.push_back(layout.reach_of(square));
}

void World::Impl::take_answers(std::vector<LatticeBox>& boxes) {
  for (int adopted = 0; adopted < options.adopt_per_poll;) {
    auto answer = loader.take();
    if (!answer) return;
    asked.erase(uint32_t(layout.square_index(answer->square)));
    if (!answer->data) {
      note_failure(answer->square, answer->data.error().message);
      continue;
    }
    adopt(answer->square, std::move(*answer->data), boxes);
    ++adopted;
  }
}

bool World::Impl::may_ask_for(uint32_t index, std::chrono::steady_clock::time_point now) const {
  if (resident.contains(index) || asked.contains(index)) return false;
  const auto failure = failing.find(index);
  return failure == failing.end() || failure->second.retry_at <= now;
}

// Of the resident squares that are not wanted.
bool World::Impl::drop_least_useful(std::vector<LatticeBox>& boxes) {
  std::unordered_set<uint32_t> kept;
  for (const Wanted& wanted : ranked) kept.insert(wanted.index);
  uint32_t least = 0;
  float least_score = std::numeric_limits<float>::infinity();
  for (const auto& [index, data] : resident) {
    if (kept.contains(index)) continue;
    if (score[index] > least_score || (score[index] == least_score && index > least)) continue;
    least = index;
    least_score = score[index];
  }
  if (std::isinf(least_score)) return false;
  slots[least].store(nullptr, std::memory_order_seq_cst);
  dropped.push_back(std::move(resident[least]));
  resident.erase(least);
  stats.drops += 1;
  boxes.push_back(layout.reach_of(square_of(least)));
  return true;
}

// What was dropped goes in two steps: unlinked, and freed when all have gone that may have found it before.
void World::Impl::free_dropped() {
  if (!leaving.empty()) {
    if (!readers.drained()) return;
    for (auto& data : leaving) loader.discard(std::move(*data));
    leaving.clear();
  }
  if (dropped.empty() || !readers.drained()) return;
  leaving.swap(dropped);
  readers.flip();
}

void World::Impl::ask(std::vector<LatticeBox>& boxes) {
  const auto now = std::chrono::steady_clock::now();
  for (const Wanted& wanted : ranked) {
    if (asked.size() >= k_most_asked) return;
    if (!may_ask_for(wanted.index, now)) continue;
    if (squares_in_use() >= capacity) {
      // Room comes once others have stopped reading what is dropped.
      if (dropped.empty() && leaving.empty() && loader.freeing() == 0) drop_least_useful(boxes);
      return;
    }
    asked.insert(wanted.index);
    loader.request(square_of(wanted.index));
  }
}

std::vector<LatticeBox> World::poll() {
  Impl& w = *impl_;
  std::vector<LatticeBox> boxes;
  w.free_dropped();
  w.loader.expire(w.options.answer_timeout_s);
  w.take_answers(boxes);
  w.ask(boxes);
  return boxes;
}

bool World::settled() const {
  const Impl& w = *impl_;
  return w.asked.empty() && std::all_of(w.ranked.begin(), w.ranked.end(), [&w](const Impl::Wanted& wanted) {
           return w.resident.contains(wanted.index) || w.failing.contains(wanted.index);
         });
}

WorldStats World::stats() const {
  const Impl& w = *impl_;
  WorldStats stats = w.stats;
  stats.resident = uint32_t(w.resident.size());
  stats.wanted = uint32_t(w.ranked.size());
  stats.in_flight = uint32_t(w.asked.size());
  stats.failing = uint32_t(w.failing.size());
  stats.given_up = uint32_t(w.loader.given_up());
  stats.bytes = w.base_bytes + w.squares_in_use() * w.layout.square_bytes(true);
  return stats;
}

std::vector<WorldFailure> World::failures() const {
  std::vector<WorldFailure> all;
  for (const auto& [index, failure] : impl_->failing)
    all.push_back({impl_->square_of(index), failure.attempts, failure.message});
  std::sort(all.begin(), all.end(), [](const WorldFailure& a, const WorldFailure& b) {
    return a.square.y != b.square.y ? a.square.y < b.square.y : a.square.x < b.square.x;
  });
  return all;
}

}  // namespace sward
