// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/world.h>
#include <memory>
#include <optional>

#include "world_layout.h"

namespace sward::world {

/// What came of a request.
struct LoadAnswer {
  glm::ivec2 square{0};
  Expected<SquareData> data;
};

/// Runs a source of squares on a background thread. Nothing here waits for it but the destructor, for a limited time:
/// the thread owns what it touches together with this object, so that it may outlive it.
class SquareLoader {
 public:
  SquareLoader(LoadSquare load, double close_wait_s);
  SquareLoader(const SquareLoader&) = delete;
  SquareLoader& operator=(const SquareLoader&) = delete;
  ~SquareLoader();

  void request(glm::ivec2 square);
  /// The next answer, in the order in which they came.
  std::optional<LoadAnswer> take();
  /// Hands over data to be freed by the thread.
  void discard(SquareData data);
  /// Makes failures of the loads that have lasted longer, and puts another thread in the place of theirs.
  void expire(double timeout_s);

  /// Squares whose memory may be in use here: asked for, being loaded (those given up included), answered, being freed.
  size_t held() const;
  /// Squares that were discarded and are not yet free.
  size_t freeing() const;
  /// Threads that were given up and have not come back.
  size_t given_up() const;

 private:
  struct Shared;
  struct Worker;
  static void run(const std::shared_ptr<Shared>& shared, const std::shared_ptr<Worker>& worker);
  void add_worker();

  std::shared_ptr<Shared> shared_;
  double close_wait_s_;
};

/// Wraps a source: an answer that does not fit the world is a failure. The coarse data says what coarse samples must
/// be; borders must be those of the neighbours that have been loaded before.
LoadSquare checked_source(const WorldLayout& layout, std::shared_ptr<const WorldCoarse> coarse, LoadSquare load);
/// Wraps a source: an exception is a failure.
LoadSquare guarded_source(LoadSquare load);

}  // namespace sward::world
