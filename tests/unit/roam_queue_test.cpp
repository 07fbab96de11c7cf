// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The mesh's priority queue against a list of its keys.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "terrain/roam_queue.h"

namespace sward::roam {
namespace {

constexpr uint32_t k_nodes = 300;

struct Queued {
  NodeStates states{k_nodes};
  BucketQueue queue;

  float largest() const {
    float key = -1;
    for (const NodeState& s : states)
      if (s.queued()) key = std::max(key, s.key);
    return key;
  }
  float smallest() const {
    float key = -1;
    for (const NodeState& s : states)
      if (s.queued() && s.key >= 0 && (key < 0 || s.key < key)) key = s.key;
    return key;
  }
  float key(uint32_t node) const { return node == k_none ? -1 : states[node].key; }
  void put(uint32_t node, float key) {
    if (states[node].queued()) {
      queue.change_key(states, node, key);
    } else {
      queue.insert(states, node, key);
    }
  }
};

// Few different keys, so that many share a bucket or are equal; some without a priority.
float random_key(std::mt19937& random) {
  const uint32_t draw = uint32_t(random() % 64);
  if (draw == 0) return -1;
  return draw < 48 ? 3.0f + 0.0001f * float(draw) : std::exp2(float(draw) - 50);
}

TEST(RoamQueue, ExtremesAreThoseOfAList) {
  std::mt19937 random(7);
  Queued q;
  for (int step = 0; step < 20000; ++step) {
    const uint32_t node = uint32_t(random() % k_nodes);
    if (q.states[node].queued() && random() % 2) {
      q.queue.remove(q.states, node);
    } else {
      q.put(node, random_key(random));
    }
    // Asked for now and then: what is known of the top has to survive what comes in between.
    if (random() % 3 == 0) {
      ASSERT_EQ(q.key(q.queue.top(q.states)), q.largest()) << step;
    }
    ASSERT_EQ(q.key(q.queue.highest(q.states)), q.largest()) << step;
    ASSERT_EQ(q.key(q.queue.lowest(q.states)), q.smallest()) << step;
  }
}

TEST(RoamQueue, ClearedIsEmpty) {
  Queued q;
  q.put(3, 1.0f);
  ASSERT_EQ(q.queue.top(q.states), 3u);
  q.queue.clear();
  EXPECT_EQ(q.queue.top(q.states), k_none);
  EXPECT_EQ(q.queue.size(), 0u);
}

}  // namespace
}  // namespace sward::roam
