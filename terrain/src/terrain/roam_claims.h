// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/host_priorities.h>
#include <string>
#include <vector>

#include "roam_tree.h"

namespace sward::roam {

/// Which nodes the host's named points and lines hold.
///
/// A point holds a node that contains it and whose bound is above its tolerance; of nodes that share an edge or a
/// corner on which it lies, one, because the mesh is the same height in both. A line holds a node over which it is
/// neither wholly above nor wholly below the wedgie. Both are nested: what holds a node holds its parent. So a named
/// thing is followed from the roots down, and a new node asks those of its parent only.
///
/// Kept as links: for each node a list of what holds it, for each named thing a list of the nodes that it holds.
class Claims {
 public:
  /// For the next follow(); null: none. Must outlive its use.
  void attach(const HostPriorities* priorities);
  /// Takes over what has changed in the set. False when nothing did.
  bool follow(const RoamTree& tree);
  /// Heights or bounds have changed: all are asked anew.
  void renew(const RoamTree& tree);
  /// The tree has begun anew.
  void restart(const RoamTree& tree);
  /// For a node that has just come into being: asks what holds its parent.
  void ask(const RoamTree& tree, uint32_t child);
  /// The node ceases to be.
  void forget(uint32_t node);

  bool holds(uint32_t node) const { return node < first_.size() && first_[node] != k_none; }
  bool empty() const { return claims_.empty(); }
  /// Nodes, dead ones and repeats among them, that came to be held or ceased to be; the reader clears it.
  std::vector<uint32_t>& touched() { return touched_; }

  /// What holds which node, derived again for all nodes; the first fault, or nothing.
  std::string fault(const RoamTree& tree) const;

 private:
  using Kind = HostPriorities::Kind;
  struct Claim {
    HostPriorities::Place place;  // a line: cut to the data
    uint32_t first = k_none;      // of its links; of a point's the one of the deepest node
  };
  struct Link {
    uint32_t node, claim;
    uint32_t node_previous, node_next;    // what else holds the node
    uint32_t claim_previous, claim_next;  // what else the claim holds
  };

  void take(const RoamTree& tree, uint32_t claim, const HostPriorities::Place& place);
  void find(const RoamTree& tree, uint32_t claim);
  void find_point(const RoamTree& tree, uint32_t claim);
  void find_line(const RoamTree& tree, uint32_t claim);
  void descend(const RoamTree& tree, uint32_t claim, uint32_t node);
  bool wants(const RoamTree& tree, const Claim& claim, uint32_t node) const;
  void link(uint32_t claim, uint32_t node);
  void unlink(uint32_t link);
  void unlink_all(uint32_t claim);
  bool linked(uint32_t claim, uint32_t node) const;

  const HostPriorities* priorities_ = nullptr;
  bool attached_anew_ = false;
  uint64_t seen_revision_ = 0;
  std::vector<Claim> claims_;    // by slot of the set
  std::vector<Link> links_;      // in stable places
  std::vector<uint32_t> free_;   // places
  std::vector<uint32_t> first_;  // by node; k_none: nothing holds it
  std::vector<uint32_t> touched_;
};

}  // namespace sward::roam
