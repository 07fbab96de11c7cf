// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Vertices do not jump: the centre of a diamond that is split rises from the drawn surface to its height, and the
// centre of one that is given up first falls to the base edge's middle; only then is the diamond merged. The halves of
// a falling diamond stand in the queues as the leaves that they are going to be, and falls are stopped half way when
// they turn out to be worth splitting.
//
// Why bound_px() holds. A drawn triangle is flat between its three corners, which are drawn o_i above or below where
// they stand on the surface. Over it the finest surface is at most the leaf's bound b above or below the plane through
// the places where the corners are to stand; the drawn triangle is off that plane by the o_i, interpolated, which is at
// most o, the largest |o_i|. So on one vertical the drawn point is f and the surface g off the plane, |f| <= o and
// |g| <= b. How a vertex came to be where it is drawn, and what its neighbours do, does not matter.
//
// In pixels: with N and the depths w of roam_projection.h, C what a metre of height changes of the depth, c = |C|, the
// two are N |f - g| / ((w + C f)(w + C g)) apart: the difference of a function of height that rises throughout. So it
// is greatest for f and g at opposite ends, where the denominator is (w + C o)(w - C b) or (w - C o)(w + C b). With m
// the larger and l the lesser of o and b the smaller of these is w^2 - c (m - l) w - c^2 m l = (w - c m)(w + c l), and
//   error <= N (b + o) / ((w - c m)(w + c l)):  Projection::moved_error().
// N is the same all along a vertical and convex over the triangle, the denominator rises with w: as for priorities the
// largest N and the least w of the corners bound it for all of the triangle.
//
// At rest (o = 0) that is N b / (w (w - c b)) = p (1 + r) / 2, p = 2 N b / ((w - c b)(w + c b)) the leaf's priority and
// r = c b / w < 1 unless p is the artificial maximum. How large r can be follows from p. Let c > 0; verticals then
// vanish at the point (A / C, B / C) of the screen, and N = |(A w - C x, B w - C y)| = c w s, where s is the distance
// in pixels from there to the image of the point whose depth is w. One with an image in the viewport has s >= d, the
// viewport's distance to the vanishing point. If any point within the wedgie is seen, its depth is at least w - c b for
// the least w of the corners, so the largest N of these is at least c d (w - c b), and
//   p >= 2 d c b / (w + c b) = 2 d r / (1 + r),  so  1 + r <= 1 / (1 - p / (2 d))  while p < 2 d.
// The error is at most p / (2 - p / d) for p < d, and at most p in any case (r < 1). Both rise with p, so what holds
// for the largest priority K of the leaves holds for all of them: Projection::largest_error(). Where c = 0 (a level
// view, an orthographic one) r = 0: K / 2, as for d without end. Where the vanishing point is on screen, d = 0: K. A
// leaf with nothing to see in its wedgie has no error to count.
//
// Of leaves that move, with t = o / b <= 1: moved_error() is p (1 + t)(1 + r) / (2 (1 + t r)), at most 1 + t times the
// bound at rest; only those for which that exceeds what has been found are projected. They are found from the vertices
// that move: all triangles with a corner at a vertex lie in the diamond whose centre it is, a handful of leaves, four
// at first. At birth the drawn triangle lies in that which was split, and from there what it is off falls.
#include <algorithm>

#include "roam_engine.h"

namespace sward::roam {

namespace {

// After the view has come to rest everything has ended its motion within this time.
constexpr double k_rest_seconds = 0.5;
// Motions shorter than this are none.
constexpr double k_least_seconds = 0.02;
// What moves is ended where the eye comes so near that it would be off by this many times the bound at rest; that many
// pixels are never worth it.
constexpr float k_modest = 2, k_least_balance = 1;
// Share of the ticks to the near plane for which the priority of what begins to move is near enough that of its start.
constexpr float k_unread = 0.25f;

}  // namespace

// What is left of the time in which motions have to end, were the view to rest from now on.
double RoamEngine::seconds_left() const {
  return still_since_ + k_rest_seconds - tree_.vertices.now;
}

// For how many ticks no triangle at the centre of the node's diamond crosses the near plane while that moves between
// two heights; negative when one may now. These triangles lie in the diamond: what they are compared with is at most
// their bound off their planes, and they are drawn at most as far off these as the centre is, or it is found by another
// motion. Their planes +- their bounds lie in the wedgies of the halves.
float RoamEngine::clear_ticks(uint32_t node, double from_z, double to_z) const {
  const double z = tree_.vertices.points[tree_.centre_vertex(node)].world.z;
  const auto off = float(std::max(std::abs(from_z - z), std::abs(to_z - z)));
  auto ticks = float(Calendar::k_span);
  for (const uint32_t half : {node, tree_.neighbour[node].base}) {
    if (half == k_none || wedgie_[half].bound < 0) continue;
    ticks = std::min(ticks, projection_.clear_ticks(wedgie_[half], wedgie_[half].bound + off, units_));
  }
  return ticks;
}

// The largest priority of what moves: below the artificial maximum.
float RoamEngine::modest() const {
  return std::min(k_modest * std::max(balance_, k_least_balance), 0.5f * RoamMesh::k_artificial_max);
}

// For how many ticks the halves of the node's diamond have at most some times the priority of the balance, counted with
// what their triangles are off now; negative when one has more.
float RoamEngine::modest_ticks(uint32_t node) const {
  const VertexPool& v = tree_.vertices;
  const Corners& c = tree_.corner[node];
  const uint32_t vertex = tree_.centre_vertex(node);
  const double rise = v.points[vertex].world.z - 0.5 * (v.points[c.left].world.z + v.points[c.right].world.z);
  const float less = v.off_surface(vertex) - float(std::abs(rise));
  std::array<Wedgie, 2> halves;
  std::array<const Wedgie*, 2> asked{};
  size_t count = 0;
  for (const uint32_t half : {node, tree_.neighbour[node].base}) {
    if (half == k_none || wedgie_[half].bound < 0) continue;
    halves[count] = wedgie_[half];
    halves[count].bound = std::max(halves[count].bound + less, 0.0f);
    asked[count] = &halves[count];
    ++count;
  }
  auto ticks = float(Calendar::k_span);
  if (count == 0) return ticks;
  const float most = modest();
  std::array<Reading, 2> readings;
  projection_.read({asked.data(), count}, {units_, most, 0}, Projection::k_below, readings.data());
  for (size_t i = 0; i < count; ++i) {
    if (readings[i].priority > most) return -1;
    ticks = std::min(ticks, readings[i].out() ? readings[i].side : readings[i].below);
  }
  return ticks;
}

void RoamEngine::move_centre(uint32_t node, double from_z, double to_z, float seconds, float clear_ticks) {
  const uint32_t vertex = tree_.centre_vertex(node);
  tree_.vertices.begin_motion(vertex, from_z, to_z, seconds);
  motions_.push_back(
      {node, vertex, tree_.vertices.arrival(vertex), out_calendar_.tick_after(k_unread * clear_ticks), false});
}

// The centre of the node's diamond stands at its height from now on.
void RoamEngine::stand_still(uint32_t node) {
  const uint32_t vertex = tree_.centre_vertex(node);
  tree_.vertices.end_motion(vertex);
  tree_.vertices.reread(tree_.surface(), vertex);
  refresh_diamond(node);
}

// What was found out by a clock that begins anew, or of a surface that has changed.
void RoamEngine::forget_clearances() {
  for (Motion& motion : motions_) motion.clear_until = 0;
}

// The diamond has just been split; its centre was drawn at `from_z`.
void RoamEngine::rise(uint32_t node, double from_z) {
  const double to_z = tree_.vertices.points[tree_.centre_vertex(node)].world.z;
  const auto seconds = float(std::min(double(options_.morph_s), seconds_left()));
  const float ticks = double(seconds) < k_least_seconds ? -1 : clear_ticks(node, from_z, to_z);
  if (ticks < 0) return refresh_diamond(node);
  move_centre(node, from_z, to_z, seconds, ticks);
}

// Falls that follow one another, finer diamonds before coarser ones, must end in time: each takes half of what is left.
void RoamEngine::fall(uint32_t node) {
  const auto seconds = float(std::min(double(options_.morph_s), 0.5 * seconds_left()));
  if (!morphs() || double(seconds) < k_least_seconds || diamond_claimed(node)) return merge_now(node);
  const VertexPool& v = tree_.vertices;
  const Corners& c = tree_.corner[node];
  const double from_z = v.points[tree_.centre_vertex(node)].world.z;
  const double to_z = 0.5 * (v.points[c.left].world.z + v.points[c.right].world.z);
  const float ticks = clear_ticks(node, from_z, to_z);
  if (ticks < 0) return merge_now(node);
  forget_diamond(node);
  falling_surplus_ += merge_gain(node);
  move_centre(node, from_z, to_z, seconds, ticks);
  motions_.back().falls = true;
  for (const uint32_t half : {node, tree_.neighbour[node].base}) {
    if (half == k_none) continue;
    state_[half].cull |= k_falling;
    for (uint32_t child = tree_.child[half]; child <= tree_.child[half] + 1; ++child) {
      if (is_visible(child)) unplace(child);
      state_[child].held = true;
    }
    if (is_visible(half)) place(half, read(half));
  }
}

void RoamEngine::stop_fall(uint32_t node) {
  falling_surplus_ -= merge_gain(node);
  for (const uint32_t half : {node, tree_.neighbour[node].base}) {
    if (half == k_none) continue;
    if (is_visible(half)) unplace(half);
    state_[half].cull = CullFlags(state_[half].cull & ~k_falling);
    for (uint32_t child = tree_.child[half]; child <= tree_.child[half] + 1; ++child) {
      state_[child].held = false;
      if (is_visible(child)) place(child, read(child));
    }
  }
  // Its entry in motions_ is void.
  const double seconds = std::max(std::min(double(options_.morph_s), seconds_left()), k_least_seconds);
  const VertexPool& v = tree_.vertices;
  const uint32_t vertex = tree_.centre_vertex(node);
  const double from_z = v.drawn_z(vertex), to_z = v.points[vertex].world.z;
  const float ticks = clear_ticks(node, from_z, to_z);
  if (ticks < 0) return stand_still(node);
  move_centre(node, from_z, to_z, float(seconds), ticks);
}

// False when the diamond is gone or its centre rests.
bool RoamEngine::lasts(const Motion& motion) const {
  const VertexPool& v = tree_.vertices;
  return v.alive[motion.vertex] && v.moves(motion.vertex) && tree_.is_split(motion.node) &&
         tree_.centre_vertex(motion.node) == motion.vertex;
}

// False, too, when its vertex makes a later motion.
bool RoamEngine::is_current(const Motion& motion) const {
  return lasts(motion) && tree_.vertices.arrival(motion.vertex) == motion.arrives;
}

// The largest over the visible leaves at `vertex`, a corner of `node`, whose other corners are drawn no farther off;
// `worst` when none is larger.
float RoamEngine::moved_error(uint32_t node, uint32_t vertex, float rest, float worst) const {
  if (!is_visible(node)) return worst;
  const Corners& c = tree_.corner[node];
  if (!tree_.is_leaf(node)) {
    const uint32_t child = tree_.child[node];
    if (vertex != c.right) worst = moved_error(child, vertex, rest, worst);
    return vertex != c.left ? moved_error(child + 1, vertex, rest, worst) : worst;
  }
  const float off = tree_.vertices.off_surface(vertex);
  if (off <= c.bound && (c.bound + off) * rest <= c.bound * worst) return worst;
  for (const uint32_t corner : {c.apex, c.left, c.right})
    if (tree_.vertices.off_surface(corner) > off) return worst;
  return std::max(worst, projection_.moved_error(wedgie_[node], off));
}

// The largest of what moves, and of what rests, which is at most `rest`.
float RoamEngine::moved_error(float rest) const {
  if (rest >= RoamMesh::k_artificial_max) return rest;
  float worst = rest;
  for (const Motion& motion : motions_) {
    if (!lasts(motion)) continue;
    for (const uint32_t half : {motion.node, tree_.neighbour[motion.node].base}) {
      if (half == k_none) continue;
      for (uint32_t child = tree_.child[half]; child <= tree_.child[half] + 1; ++child)
        worst = moved_error(child, motion.vertex, rest, worst);
    }
  }
  return worst;
}

// Looked at anew. False, too, when the motion is not the one that its vertex makes.
bool RoamEngine::stays_clear(Motion& motion) const {
  if (!is_current(motion)) return false;
  const VertexPool::Motion& m = tree_.vertices.points[motion.vertex].motion;
  float ticks = clear_ticks(motion.node, m.from_z, m.to_z);
  if (ticks >= 0) ticks = std::min(ticks, modest_ticks(motion.node));
  motion.clear_until = out_calendar_.tick_after(ticks);
  return ticks >= 0;
}

// Motions that are over, whose diamond is gone, or that may cross the near plane.
void RoamEngine::finish_motions() {
  VertexPool& v = tree_.vertices;
  for (size_t i = 0; i < motions_.size();) {
    const bool goes_on = v.now < motions_[i].arrives && morphs();
    if (goes_on && (!out_calendar_.past(motions_[i].clear_until) || stays_clear(motions_[i]))) {
      ++i;
      continue;
    }
    const Motion motion = motions_[i];
    const bool lives = morphs() ? is_current(motion) : lasts(motion);
    motions_[i] = motions_.back();
    motions_.pop_back();
    if (!lives) continue;
    settled_ = false;
    if (state_[motion.node].cull & k_falling) {
      merge_now(motion.node);
      ++stats_.merges;
    } else if (v.now < motion.arrives || !morphs()) {
      stand_still(motion.node);
    } else {
      v.end_motion(motion.vertex);
      refresh_diamond(motion.node);
    }
  }
  count_falling_surplus();
}

// Where triangles that came into sight leave no room for those on their way out.
void RoamEngine::finish_falls_now(uint32_t most_visible) {
  for (size_t i = motions_.size(); i-- > 0 && visible_count() > most_visible;) {
    const Motion motion = motions_[i];
    if (!lasts(motion) || !(state_[motion.node].cull & k_falling)) continue;
    falling_surplus_ -= merge_gain(motion.node);
    merge_now(motion.node);
    ++stats_.merges;
  }
}

// What rises cannot be merged until it has arrived.
void RoamEngine::finish_motions_now() {
  finish_falls_now(options_.max_triangles);
  size_t kept = 0;
  for (size_t i = 0; i < motions_.size(); ++i) {
    const Motion motion = motions_[i];
    if (!lasts(motion)) continue;
    if (state_[motion.node].cull & k_falling) {
      motions_[kept++] = motion;
      continue;
    }
    stand_still(motion.node);
  }
  motions_.resize(kept);
}

void RoamEngine::count_falling_surplus() {
  falling_surplus_ = 0;
  for (const Motion& motion : motions_)
    if (motion.falls && is_current(motion) && (state_[motion.node].cull & k_falling))
      falling_surplus_ += merge_gain(motion.node);
}

}  // namespace sward::roam
