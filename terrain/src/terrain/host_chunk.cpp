// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "host_chunk.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sward::roam {

HostHeights::Slot& HostHeights::find(LatticePoint p) {
  const uint64_t mixed = (uint64_t(uint32_t(p.x)) << 32 | uint32_t(p.y)) * 0x9E3779B97F4A7C15u;
  const size_t last = slots_.size() - 1;
  size_t i = size_t(mixed >> 32) & last;
  while (slots_[i].round == round_ && slots_[i].point != p) i = (i + 1) & last;
  return slots_[i];
}

void HostHeights::grow() {
  std::vector<Slot> before(std::max<size_t>(1024, 2 * slots_.size()), Slot{LatticePoint(0), 0, 0});
  before.swap(slots_);
  for (const Slot& slot : before)
    if (slot.round == round_) find(slot.point) = slot;
}

double HostHeights::at(LatticePoint p) {
  if (2 * count_ >= slots_.size()) grow();
  Slot& slot = find(p);
  if (slot.round != round_) {
    const double z = height_(lattice_.world_xy(p));
    slot = {p, round_, std::isfinite(z) ? z : std::numeric_limits<double>::quiet_NaN()};
    ++count_;
  }
  return slot.z;
}

namespace {

LatticePoint middle_of(LatticePoint a, LatticePoint b) {
  return (a + b) / 2;
}

// The ground below one triangle of the level, split where it leaves the plane.
class Feet {
 public:
  Feet(HostHeights& heights, double error, int deepest, std::vector<ChunkNode>& nodes)
      : heights_(heights), error_(error), deepest_(deepest), nodes_(nodes), first_(nodes.size()) {}

  /// z of corners (apex, left, right): of the ground, and of the triangle's plane. Returns the node, counted from the
  /// triangle's first; nothing to count where it is flat.
  bool split(const TriangleCorners& c, int level, glm::dvec3 ground, glm::dvec3 plane, uint32_t& node) {
    if (level >= deepest_ || !leaves_plane(c, level, ground)) return false;
    const double z = heights_.at(centre_of(c)), below = 0.5 * (plane[1] + plane[2]);
    deviation_ = std::max(deviation_, std::abs(z - below));
    node = uint32_t(nodes_.size() - first_);
    nodes_.push_back({z, {0, 0}});
    const glm::dvec3 grounds[2] = {{z, ground[0], ground[1]}, {z, ground[2], ground[0]}};
    const glm::dvec3 planes[2] = {{below, plane[0], plane[1]}, {below, plane[2], plane[0]}};
    for (int turn = 0; turn < 2; ++turn) {
      uint32_t child = 0;
      if (split(child_corners(c, turn), level + 1, grounds[turn], planes[turn], child))
        nodes_[first_ + node].child[turn] = child;
    }
    return true;
  }

  bool holes() const { return holes_; }
  double deviation() const { return deviation_; }

 private:
  // By the middles of the base and, where these are on the lattice, of the legs.
  bool leaves_plane(const TriangleCorners& c, int level, glm::dvec3 z) {
    bool leaves = far(centre_of(c), 0.5 * (z[1] + z[2]));
    if (level + 1 >= k_max_level) return leaves;
    leaves |= far(middle_of(c.apex, c.left), 0.5 * (z[0] + z[1]));
    leaves |= far(middle_of(c.apex, c.right), 0.5 * (z[0] + z[2]));
    return leaves && !holes_;
  }

  bool far(LatticePoint p, double expected) {
    const double z = heights_.at(p);
    holes_ |= std::isnan(z);
    return std::abs(z - expected) > error_;
  }

  HostHeights& heights_;
  double error_;
  int deepest_;
  std::vector<ChunkNode>& nodes_;
  size_t first_;
  bool holes_ = false;
  double deviation_ = 0;
};

class HostChunkBuilder {
 public:
  HostChunkBuilder(HostHeights& heights, const HostChunkOptions& options, int level, Chunk& chunk)
      : heights_(heights),
        options_(options),
        level_(level),
        deepest_(std::min(level + options.foot_splits, k_max_level)),
        chunk_(chunk) {}

  void descend(const TriangleCorners& c, int depth, unsigned index) {
    if (depth == 0) return put(c, index);
    for (unsigned turn = 0; turn < 2; ++turn) descend(child_corners(c, int(turn)), depth - 1, 2 * index + turn);
  }

  float steepness() const { return steepness_; }
  double lowest() const { return lowest_; }
  double highest() const { return highest_; }

 private:
  void put(const TriangleCorners& c, unsigned j) {
    const Lattice& lattice = heights_.lattice();
    const glm::dvec3 z(heights_.at(c.apex), heights_.at(c.left), heights_.at(c.right));
    chunk_.first_node[j] = uint32_t(chunk_.nodes.size());
    chunk_.node_count[j] = 0;
    if (std::isnan(z[0] + z[1] + z[2])) return;
    Feet feet(heights_, double(options_.foot_error_m), deepest_, chunk_.nodes);
    uint32_t root = 0;
    feet.split(c, level_, z, z, root);
    if (feet.holes()) return chunk_.nodes.resize(chunk_.first_node[j]);
    chunk_.node_count[j] = uint32_t(chunk_.nodes.size()) - chunk_.first_node[j];
    chunk_.bound[j] = float(feet.deviation());
    const glm::dvec3 apex(lattice.world_xy(c.apex), z[0]);
    const glm::dvec3 left = glm::dvec3(lattice.world_xy(c.left), z[1]) - apex;
    const glm::dvec3 right = glm::dvec3(lattice.world_xy(c.right), z[2]) - apex;
    chunk_.apex[j] = apex;
    chunk_.to_left[j] = glm::vec3(left);
    chunk_.to_right[j] = glm::vec3(right);
    chunk_.left_z[j] = chunk_.to_left[j].z;
    chunk_.right_z[j] = chunk_.to_right[j].z;
    chunk_.area[j] = float(0.5 * glm::length(glm::cross(left, right)));
    if (!chunk_.altitude.empty()) chunk_.altitude[j] = glm::vec3(z);
    chunk_.solid |= uint64_t(1) << j;
    include(left, right, z, feet.deviation());
  }

  void include(glm::dvec3 left, glm::dvec3 right, glm::dvec3 z, double deviation) {
    const double leg = std::min(glm::length(glm::dvec2(left)), glm::length(glm::dvec2(right)));
    steepness_ = std::max(steepness_, float((std::abs(left.z) + std::abs(right.z)) / leg));
    lowest_ = std::min(lowest_, std::min({z[0], z[1], z[2]}) - deviation);
    highest_ = std::max(highest_, std::max({z[0], z[1], z[2]}) + deviation);
  }

  HostHeights& heights_;
  const HostChunkOptions& options_;
  int level_, deepest_;
  Chunk& chunk_;
  float steepness_ = 0;
  double lowest_ = std::numeric_limits<double>::max(), highest_ = std::numeric_limits<double>::lowest();
};

}  // namespace

void build_host_chunk(HostHeights& heights, const HostChunkOptions& options, const ChunkVisit& visit, int depth,
                      Chunk& chunk) {
  const DrawnTriangle& t = visit.triangle;
  const TriangleCorners c{t.apex.lattice, t.left.lattice, t.right.lattice};
  heights.forget();
  chunk.solid = 0;
  chunk.flat = false;
  chunk.box = {glm::min(c.apex, glm::min(c.left, c.right)), glm::max(c.apex, glm::max(c.left, c.right))};
  chunk.altitude.assign(options.altitudes ? k_chunk_size : 0, glm::vec3(0));
  chunk.nodes.clear();
  // What is left out stays level ground without a bound: kernels measure it, too.
  chunk.apex_z.fill(0);
  chunk.left_z.fill(0);
  chunk.right_z.fill(0);
  chunk.bound.fill(0);
  HostChunkBuilder builder(heights, options, t.id.level() + depth, chunk);
  builder.descend(c, depth, 0);
  chunk.steepness = builder.steepness();
  chunk.corner_z = glm::dvec3(0.5 * (builder.lowest() + builder.highest()));
  chunk.reach = chunk.solid == 0 ? 0.0f : float(0.5 * (builder.highest() - builder.lowest()));
  for (size_t j = 0; j < k_chunk_size; ++j)
    if (chunk.solid >> j & 1) chunk.apex_z[j] = float(chunk.apex[j].z - chunk.corner_z[0]);
  chunk.has_static = chunk.has_drawn = true;
}

}  // namespace sward::roam
