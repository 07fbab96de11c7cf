// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/terrain/surface.h>
#include <sward/terrain/view.h>
#include <sward/terrain/world_data.h>
#include <cstddef>
#include <memory>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

namespace sward {

/// What a background thread asks for.
struct SquareRequest {
  glm::ivec2 square{0};
  std::stop_token stop;  ///< Requested when the answer is no longer wanted: return soon, with anything.
};

/// A host's source of squares. Called on a background thread of the world, one call at a time unless an earlier one has
/// not answered in time. May take long, fail, or throw (that is a failure with the exception's text). It and what it
/// refers to must live until it has returned, even where the world is gone by then: capture by value or shared_ptr.
using LoadSquare = std::function<Expected<SquareData>(const SquareRequest&)>;

struct WorldOptions {
  /// Most bytes of heights and bounds at any time: the coarse data, resident squares, those being loaded and those
  /// being freed. At least the coarse data and two squares. The meshes' own memory and what a callback uses while it
  /// works are not in it.
  size_t memory_bytes = size_t(512) << 20;
  /// A square is worth loading when its coarse data may be off by this many pixels on screen. >= 0.
  float worth_px = 0.5f;
  /// Most squares taken over in one poll(), >= 1. Each costs some 20 microseconds, and the mesh's work for it.
  int adopt_per_poll = 1;
  /// Seconds after which a load that has not answered counts as failed; its thread is given up and, up to four times,
  /// replaced. > 0.
  double answer_timeout_s = 30;
  /// A failed square is tried again after this many seconds, twice as long after each further failure, 64 times as long
  /// at most. > 0.
  double retry_s = 2;
  /// Longest that destruction waits for a load to return, seconds, >= 0. After that its thread is left to itself: it
  /// touches nothing of the world any more, and ends when the load returns.
  double close_wait_s = 2;
  /// Baked worlds: use squares where the file is mapped instead of copying them. Saves the copy and lets processes
  /// share memory; but a file that is cut short, or whose disk fails, while it is mapped ends the process (SIGBUS), and
  /// a page that the system took back makes a frame wait for the disk.
  bool map_files = false;
};

struct WorldStats {
  uint32_t resident = 0;   ///< Squares whose fine data answers.
  uint32_t wanted = 0;     ///< Squares that the last follow() would have resident.
  uint32_t in_flight = 0;  ///< Asked for, being loaded, or waiting to be taken over.
  uint32_t failing = 0;    ///< Squares that failed last time and wait for another try.
  uint32_t given_up = 0;   ///< Threads whose load has not answered in time and still has not.
  size_t bytes = 0;        ///< Everything that counts against the cap, reserved memory included.
  uint64_t loads = 0;      ///< Squares taken over so far.
  uint64_t drops = 0;
  uint64_t failures = 0;
  std::string last_error;  ///< Of the last failure; empty: none yet.
};

/// A square whose last load failed and that waits for another try.
struct WorldFailure {
  glm::ivec2 square{0};
  int attempts = 0;     ///< Failed so far, >= 1.
  std::string message;  ///< Of the last one.
};

/// Terrain of any size: coarse data everywhere, fine data where views need it, loaded and dropped by a background
/// thread under a memory cap. No frame waits for a load; there is no crack whatever is resident: a diamond can be split
/// where all the fine data is resident that it and the diamonds which have to be split before it depend on.
///
/// Each frame: follow() with the views, poll(), residency_changed() of every mesh with each box that poll() gave,
/// update.
///
///   data      Surface calls and height(): any thread, at any time, without waiting.
///   control   follow(), poll(), settled(), stats(), failures(): one thread at a time.
class SWARD_API World final : public Surface {
 public:
  /// A world that bake_world() made. Reads the index only (8 bytes a coarse cell); fails, naming the file, when it is
  /// missing, truncated, damaged or of another version, and when the memory cap is too small.
  static Expected<std::unique_ptr<World>> open(const std::string& folder, const WorldOptions& options = {});
  /// A world whose squares come from a callback. Fails when `coarse` does not fit the description, when an option is
  /// out of range and when the memory cap is too small.
  static Expected<std::unique_ptr<World>> create(const WorldDesc& desc, WorldCoarse coarse, LoadSquare load,
                                                 const WorldOptions& options = {});
  ~World() override;

  const WorldDesc& desc() const;
  /// Lowest and highest height that any square can have, metres, world.
  glm::dvec2 height_range() const override;

  // Surface. Where no fine data is resident, heights are those of the coarse triangles and the gradient is theirs.
  const Lattice& lattice() const override;
  double height(LatticePoint p) const override;
  glm::dvec2 relief_gradient(LatticePoint p) const override;
  float bound(LatticePoint centre, int level) const override;
  bool can_split(LatticePoint centre, int level) const override;
  glm::dvec2 data_gradient(glm::dvec2 xy) const override;
  bool all_holes(const LatticeBox& box) const override;

  /// Height at world x, y from the finest data that is resident there; NaN outside of the data.
  double height(glm::dvec2 xy) const override;
  /// Cost: some 25 ns a slope. Differences over a stride end at the square's ring.
  void data_gradients(glm::ivec2 first, int stride, glm::ivec2 count, std::span<glm::vec2> out) const override;
  /// Whether a square's fine data is resident.
  bool resident(glm::ivec2 square) const;

  /// Says what is looked at. Squares around each eye are ranked by how many pixels their coarse data may be off; the
  /// most useful that fit are wanted, those in sight are loaded first. Squares that are no longer wanted stay until
  /// their room is needed. Views that are not valid are ignored. Cost: some 20 microseconds a view.
  void follow(std::span<const View> views);
  /// Takes over what has been loaded, drops what has to make room, asks for more. Returns the boxes in which answers
  /// have changed; every mesh must be told before its next update. Never waits for a load. What is dropped is freed
  /// by the background thread when nobody reads it any more.
  std::vector<LatticeBox> poll();
  /// True when every wanted square is resident or failing.
  bool settled() const;
  WorldStats stats() const;
  /// The squares that fail at this moment, row by row from the north-west.
  std::vector<WorldFailure> failures() const;

 private:
  struct Impl;
  explicit World(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace sward
