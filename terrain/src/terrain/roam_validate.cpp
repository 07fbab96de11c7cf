// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// The structural check of a mesh: everything that the other files keep up step by step is derived again from ids.
#include <string>

#include "roam_engine.h"

namespace sward::roam {

class Validator {
 public:
  explicit Validator(const RoamEngine& engine) : e_(engine), t_(engine.tree_) {}

  Expected<void> run() {
    std::vector<uint32_t> stack;
    for (uint32_t root = 0; root < t_.root_count(); ++root) stack.push_back(root);
    while (!stack.empty()) {
      const uint32_t node = stack.back();
      stack.pop_back();
      ++nodes_;
      check_identity(node);
      check_claimed(node);
      check_view(node);
      if (t_.is_leaf(node)) {
        check_leaf(node);
      } else {
        check_split(node);
        stack.push_back(t_.child[node]);
        stack.push_back(t_.child[node] + 1);
      }
      if (!fault_.empty()) return fail(fault_);
    }
    check_counts();
    check_motions();
    if (fault_.empty() && !e_.claims_.empty()) fault_ = e_.claims_.fault(t_);
    if (!fault_.empty()) return fail(fault_);
    return {};
  }

 private:
  void require(bool holds, uint32_t node, const char* what) {
    if (!holds && fault_.empty()) fault_ = "ROAM mesh: node " + std::to_string(node) + ": " + what;
  }

  void check_identity(uint32_t node) {
    const TriangleCorners expected = corners_of(t_.nodes[node].id), actual = t_.corners(node);
    require(expected.apex == actual.apex && expected.left == actual.left && expected.right == actual.right, node,
            "corners differ from those of its id");
    for (const uint32_t slot : {t_.corner[node].apex, t_.corner[node].left, t_.corner[node].right}) {
      require(t_.vertices.alive[slot], node, "uses a dead vertex");
      const glm::dvec3 world(t_.lattice().world_xy(t_.vertices.lattice[slot]),
                             t_.surface().height(t_.vertices.lattice[slot]));
      require(world == t_.vertices.points[slot].world, node, "has a vertex off the height field");
    }
    const bool padding = t_.nodes[node].cover == Cover::padding;
    const float bound = padding ? -1.0f : t_.surface().bound(centre_of(actual), t_.nodes[node].id.level());
    require(t_.corner[node].bound == bound, node, "has a bound other than the surface's");
    const uint32_t parent = t_.nodes[node].parent;
    if (parent == k_none) {
      require(node < t_.root_count(), node, "has no parent and is no root");
      return;
    }
    require(t_.is_split(parent) && (t_.child[parent] | 1) == (node | 1), node, "is unknown to its parent");
    require(t_.nodes[node].id == t_.nodes[parent].id.child(int(node & 1)), node,
            "has an id that does not follow its parent's");
  }

  void check_claimed(uint32_t node) {
    require(e_.wedgie_[node].claimed == e_.claims_.holds(node), node, "is marked as claimed wrongly");
    if (t_.is_split(node) && e_.diamond_claimed(node))
      require(!e_.centre_moves(node), node, "is claimed, and its centre moves");
  }

  // Deferred findings are derived again for the present view: none may be wrong by now.
  void check_view(uint32_t node) {
    if (e_.fresh_) return;  // nothing is known of any node
    const NodeState& s = e_.state_[node];
    const uint32_t parent = t_.nodes[node].parent, due = e_.wedgie_[node].due;
    const bool below_out = parent != k_none && !e_.is_visible(parent);
    if (e_.options_.plain) {
      const Assessment now = e_.assess(node, e_.inherited_flags(node));
      require(now.cull == s.cull, node, "has flags of another view");
      require(now.priority == s.priority, node, "has the priority of another view");
      return;
    }
    if (!e_.view_) return;
    if (below_out) {
      require(!e_.is_visible(node), node, "is visible below what is out");
      return require(due == 0, node, "is watched below what is out");
    }
    const bool padding = t_.corner[node].bound < 0;
    if (!e_.is_visible(node)) {
      require(padding || e_.read(node).out(), node, "is taken to be out and is not");
      require(padding || due & k_watch, node, "is out and nobody watches");
    } else {
      require(!(due & k_watch), node, "is visible and watched");
      require(due == 0 || e_.acts_as_leaf(node), node, "is entered as the leaf that it is not");
    }
    if (s.cull & k_falling) {
      const bool moves = t_.is_split(node) && e_.centre_moves(node);
      require(moves && t_.mergeable(node), node, "falls and does not move");
    }
  }

  void check_leaf(uint32_t node) {
    ++leaves_;
    const bool visible = e_.is_visible(node);
    visible_ += visible;
    require(e_.draws_.contains(node) == visible, node, visible ? "is visible, not drawn" : "is drawn, not visible");
    if (visible && e_.draws_.contains(node)) {
      const uint32_t slot = e_.draws_.slot(node);
      const Corners& c = t_.corner[node];
      const auto drawn = e_.draws_.indices();
      require(slot < e_.draws_.count() && e_.draws_.nodes()[slot] == node, node,
              "has another's place in the draw list");
      require(drawn[3 * slot] == c.apex && drawn[3 * slot + 1] == c.left && drawn[3 * slot + 2] == c.right, node,
              "is drawn with other corners");
    }
    if (e_.acts_as_leaf(node)) {
      check_placed(node);
    } else {
      require(!e_.state_[node].queued(), node, "is queued, and its parent is falling");
    }
    const Neighbours& n = t_.neighbour[node];
    const Corners& c = t_.corner[node];
    check_edge(node, n.base, c.left, c.right);
    check_edge(node, n.left, c.apex, c.left);
    check_edge(node, n.right, c.right, c.apex);
  }

  // A leaf, or half of a falling diamond: queued by its priority, or known to be below the guard.
  void check_placed(uint32_t node) {
    const NodeState& s = e_.state_[node];
    if (!e_.is_visible(node)) return require(!s.queued(), node, "is queued, not visible");
    const float priority = e_.options_.plain ? s.priority : e_.read(node).priority;
    if (s.queued()) {
      queued_leaves_ += 1;
      check_queued(node, priority);
      return;
    }
    require(!e_.options_.plain, node, "is visible, not queued");
    require(e_.wedgie_[node].due != 0, node, "is neither queued nor entered in a calendar");
    require(priority <= e_.leaf_guard_ * k_rounding, node, "has risen above the guard unseen");
  }

  // The neighbour must be a leaf that has the same edge, run through the other way, and knows this node across it.
  void check_edge(uint32_t node, uint32_t across, uint32_t from, uint32_t to) {
    if (across == k_none) {
      require(on_border(from, to), node, "has no neighbour across an inner edge");
      return;
    }
    if (!t_.is_alive(across) || !t_.is_leaf(across)) return require(false, node, "has a neighbour that is no leaf");
    const Corners& c = t_.corner[across];
    const Neighbours& n = t_.neighbour[across];
    const bool over_base = n.base == node && c.left == to && c.right == from;
    const bool over_left = n.left == node && c.apex == to && c.left == from;
    const bool over_right = n.right == node && c.right == to && c.apex == from;
    require(over_base || over_left || over_right, node, "does not share its edge with its neighbour");
  }

  bool on_border(uint32_t a, uint32_t b) const {
    const LatticePoint p = t_.vertices.lattice[a], q = t_.vertices.lattice[b];
    const LatticePoint far = t_.lattice().root_squares * k_root_side;
    return (p.x == q.x && (p.x == 0 || p.x == far.x)) || (p.y == q.y && (p.y == 0 || p.y == far.y));
  }

  void check_split(uint32_t node) {
    const uint32_t base = t_.neighbour[node].base;
    const uint32_t middle = t_.corner[t_.child[node]].apex;
    require(middle == t_.corner[t_.child[node] + 1].apex, node, "has children with different apexes");
    if (base == k_none) {
      require(on_border(t_.corner[node].left, t_.corner[node].right), node, "is half a diamond at an inner edge");
    } else if (!t_.is_split(base) || t_.neighbour[base].base != node) {
      return require(false, node, "is split and the other half of its diamond is not");
    } else {
      require(t_.corner[t_.child[base]].apex == middle, node, "has another centre than the other half of its diamond");
    }
    const bool stands_for_diamond = t_.diamond_of(node) == node;
    diamonds_ += stands_for_diamond;
    if (e_.state_[node].cull & k_falling) return check_placed(node);
    if (stands_for_diamond) check_diamond(node);
    const bool queued = stands_for_diamond && e_.state_[node].half_queued;
    require(e_.state_[node].queued() == queued, node, "is queued wrongly");
  }

  void check_diamond(uint32_t node) {
    const uint32_t base = t_.neighbour[node].base;
    const NodeState& s = e_.state_[node];
    require(base == k_none || e_.state_[base].half_queued == s.half_queued, node, "does not agree with its other half");
    const bool candidate = t_.mergeable(node) && !e_.centre_moves(node);
    require(candidate || !s.half_queued, node, "is queued and cannot be merged");
    if (!candidate) return;
    float key = -1;
    bool lingers = false;
    for (const uint32_t half : {node, base}) {
      if (half == k_none || !e_.is_visible(half)) continue;
      key = std::max(key, e_.options_.plain ? e_.state_[half].priority : e_.read(half).priority);
      lingers |= !e_.options_.plain && e_.read(half).out();
    }
    if (s.half_queued) {
      ++mergeable_;
      return check_queued(node, key);
    }
    require(!e_.options_.plain, node, "is mergeable, not queued");
    require(e_.wedgie_[node].diamond_due != 0, node, "is neither queued nor entered in a calendar");
    require(lingers || key * k_rounding >= e_.diamond_guard_, node, "has fallen below the guard unseen");
  }

  void check_queued(uint32_t node, float key) {
    require(e_.state_[node].key == key, node, "is queued by an old priority");
    require(e_.state_[node].bucket == BucketQueue::bucket_of(key), node, "is in the wrong bucket");
  }

  void check_counts() {
    size_t alive_nodes = 0, alive_vertices = 0;
    for (uint32_t node = 0; node < t_.size(); ++node) alive_nodes += t_.is_alive(node);
    for (const uint8_t alive : t_.vertices.alive) alive_vertices += alive;
    const glm::ivec2 squares = t_.lattice().root_squares;
    const size_t root_vertices = size_t(squares.x + 1) * size_t(squares.y + 1);
    require(alive_nodes == nodes_, 0, "nodes live that no root leads to");
    require(alive_vertices == root_vertices + diamonds_, 0, "vertices live that no diamond owns");
    require(leaves_ == t_.leaf_count(), 0, "the number of leaves is wrong");
    require(visible_ == e_.visible_count() && e_.draws_.indices().size() == 3 * visible_, 0,
            "the number drawn is wrong");
    require(e_.split_queue_.size() + e_.blocked_queue_.size() == queued_leaves_, 0, "the split queue's size is wrong");
    require(e_.merge_queue_.size() == mergeable_, 0, "the merge queue's size is wrong");
    require(!e_.settled_ || visible_ <= e_.options_.max_triangles, 0, "the budget is exceeded");
  }

  // bound_px() finds what moves by the list of motions. None crosses the near plane in the present view.
  void check_motions() {
    std::vector<bool> listed(t_.vertices.lattice.size());
    for (const auto& motion : e_.motions_) {
      if (!e_.lasts(motion)) continue;
      listed[motion.vertex] = true;
      if (t_.vertices.arrival(motion.vertex) != motion.arrives) continue;
      const VertexPool::Motion& moves = t_.vertices.points[motion.vertex].motion;
      require(e_.clear_ticks(motion.node, moves.from_z, moves.to_z) >= 0, motion.node,
              "moves where it may cross the near plane");
      for (const uint32_t half : {motion.node, t_.neighbour[motion.node].base})
        require(half == k_none || crossed(half, motion.vertex) == k_none, motion.node,
                "has a moving corner of a triangle without a bound");
    }
    for (uint32_t vertex = 0; vertex < listed.size(); ++vertex)
      require(listed[vertex] || !t_.vertices.alive[vertex] || !t_.vertices.moves(vertex), 0, "lost a motion");
  }

  // A leaf at `vertex` below `node` that has the artificial maximum while it moves and not at rest.
  uint32_t crossed(uint32_t node, uint32_t vertex) const {
    if (!t_.is_leaf(node)) {
      const uint32_t found = crossed(t_.child[node], vertex);
      return found != k_none ? found : crossed(t_.child[node] + 1, vertex);
    }
    if (e_.moved_error(node, vertex, 0, 0) < RoamMesh::k_artificial_max) return k_none;
    return e_.measure(node).priority < RoamMesh::k_artificial_max ? node : k_none;
  }

  const RoamEngine& e_;
  const RoamTree& t_;
  // Of priorities and of the arithmetic that foretells them.
  static constexpr float k_rounding = 1.0001f;

  std::string fault_;
  size_t nodes_ = 0, leaves_ = 0, visible_ = 0, diamonds_ = 0, mergeable_ = 0, queued_leaves_ = 0;
};

Expected<void> RoamEngine::validate() const {
  return Validator(*this).run();
}

}  // namespace sward::roam
