// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// One update: what has ended its motion, what the new view makes of the mesh, then the greedy loop.
#include "roam_engine.h"

#include <cmath>
#include <string>

namespace sward::roam {

namespace {

bool same(const View& a, const View& b) {
  return a.eye == b.eye && a.eye_from_world == b.eye_from_world && a.clip_from_eye == b.clip_from_eye &&
         a.viewport == b.viewport;
}

}  // namespace

Expected<void> check_options(const RoamOptions& options, uint32_t drawable_roots) {
  if (options.max_triangles < drawable_roots) {
    return fail("a budget of " + std::to_string(options.max_triangles) + " triangles is below the root mesh of " +
                std::to_string(drawable_roots) + "; raise max_triangles to at least that");
  }
  if (!(options.target_px >= 0)) return fail("target_px must be 0 or a positive number of pixels");
  if (!(options.hysteresis >= 0) || !std::isfinite(options.hysteresis))
    return fail("hysteresis must be 0 or a positive number");
  if (!(options.time_cap_s >= 0)) return fail("time_cap_s must be 0 or a positive number of seconds");
  if (!(options.morph_s >= 0 && options.morph_s <= 10)) return fail("morph_s must lie in 0..10 seconds");
  return {};
}

RoamEngine::RoamEngine(const Surface& surface, const RoamOptions& options) : tree_(surface), options_(options) {
  tree_.vertices.rebase(tree_.lattice().origin);
  take_roots();
}

Expected<void> RoamEngine::set_options(const RoamOptions& options) {
  uint32_t drawable = 0;
  for (uint32_t root = 0; root < tree_.root_count(); ++root) drawable += tree_.nodes[root].cover != Cover::padding;
  if (auto checked = check_options(options, drawable); !checked) return checked;
  if (options.plain && !options_.plain)
    for (uint32_t vertex = 0; vertex < tree_.vertices.points.size(); ++vertex) take_vertex(vertex);
  // The two ways of keeping the queues do not mix.
  if (options.plain != options_.plain && view_) {
    options_ = options;
    start_over();
  }
  options_ = options;
  settled_ = false;
  still_since_ = tree_.vertices.now;
  return {};
}

Expected<RoamStats> RoamEngine::update(const View& view, std::optional<double> time_s) {
  if (auto valid = view.validate(); !valid) return tl::unexpected<Error>(valid.error());
  if (time_s && !std::isfinite(*time_s)) return fail("the time of an update must be finite");
  if (options_.time_cap_s > 0) {
    deadline_ = std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                                       std::chrono::duration<double>(options_.time_cap_s));
  }
  tree_.vertices.begin_changes();
  draws_.begin_changes();
  stats_ = {};
  const bool new_view = fresh_ || !view_ || !same(*view_, view);
  now_ = time_s;
  from_nothing_ = false;
  if (time_s) set_time(*time_s);
  if (new_view) {
    still_since_ = tree_.vertices.now;
    follow_eye(view.eye);
    const std::optional<View> last = view_;
    const Projection before = projection_;
    view_ = view;
    projection_ = Projection(view);
    ++view_number_;
    settled_ = false;
    look_anew(last, before);
  } else if (new_to_rest_) {
    look_at_lingering();
    settled_ = false;
  }
  new_to_rest_ = new_view && !options_.plain;
  const bool surface_changed = !changes_.empty();
  if (surface_changed) {
    still_since_ = tree_.vertices.now;
    read_surface_again();
  }
  follow_claims(surface_changed);
  finish_motions();
  if (!settled_) {
    operations_ = 0;
    operation_limit_ = 4 * (uint64_t(tree_.leaf_count()) + options_.max_triangles) + 1024;
    time_checks_ = leaf_guard_steps_ = diamond_guard_steps_ = 0;
    settled_ = converge();
    release_more();
  }
  if (stats_.capped) still_since_ = tree_.vertices.now;
  draws_.close();
  stats_.visible = visible_count();
  stats_.leaves = tree_.leaf_count();
  stats_.moving = tree_.vertices.moving;
  stats_.unmet = unmet_claims();
  return stats_;
}

// A clock that was set back begins anew: what moves arrives at once, and every slot is written with the new times.
void RoamEngine::set_time(double time_s) {
  VertexPool& v = tree_.vertices;
  from_nothing_ = time_s < v.now;
  v.now = time_s;
  if (!from_nothing_) return;
  still_since_ = time_s;
  finish_motions();
  v.rebase(v.origin);
}

uint32_t RoamEngine::split(uint32_t leaf) {
  settled_ = false;
  const uint32_t count = split_chain(tree_.forced_chain(leaf));
  draws_.close();
  return count;
}

void RoamEngine::merge(uint32_t node) {
  settled_ = false;
  merge_now(node);
  draws_.close();
}

float RoamEngine::greatest_priority() const {
  float worst = 0;
  for (const BucketQueue* queue : {&split_queue_, &blocked_queue_}) worst = std::max(worst, bound_of(*queue));
  if (!leaf_calendar_.empty()) worst = std::max(worst, leaf_guard_);
  return worst;
}

float RoamEngine::bound_px() const {
  return moved_error(projection_.largest_error(greatest_priority()));
}

}  // namespace sward::roam
