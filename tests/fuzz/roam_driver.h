// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <string>

#include "../../terrain/src/terrain/roam_engine.h"
#include "../roam_support.h"
#include "partly_resident.h"

/// Turns bytes into operations on a mesh and checks its structure after each. One driver for the seeded test and for
/// libFuzzer.
namespace roam_driver {

/// The next bytes of the input as numbers; zeros when it has run out.
class Input {
 public:
  explicit Input(std::span<const uint8_t> bytes) : bytes_(bytes) {}
  bool empty() const { return at_ >= bytes_.size(); }
  uint8_t byte() { return at_ < bytes_.size() ? bytes_[at_++] : uint8_t(0); }
  uint16_t word() { return uint16_t(byte() | byte() << 8); }
  double unit() { return word() / 65535.0; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  /// Any bit pattern, NaN and infinity included.
  double any_double() {
    uint64_t bits = 0;
    for (int i = 0; i < 8; ++i) bits = bits << 8 | byte();
    return std::bit_cast<double>(bits);
  }

 private:
  std::span<const uint8_t> bytes_;
  size_t at_ = 0;
};

/// Fields of different kinds: plain, padded with several root squares, with holes, with relief, flat. Made anew for
/// each run, because edits change them.
inline roam_support::Terrain make_terrain_of_kind(int kind) {
  const int i = kind % 5;
  roam_support::TerrainOptions options;
  options.seed = uint32_t(i + 1);
  if (i == 1) options.columns = 75, options.rows = 22;
  if (i == 2) {
    options.holes.assign(65 * 65, 0);
    for (size_t k = 0; k < options.holes.size(); ++k) options.holes[k] = k % 65 > 30 && k % 65 < 50 && k > 800;
  }
  if (i == 3) options.columns = options.rows = 17, options.spacing = 20, options.detail = true;
  if (i == 4) options.relief_m = 0;
  return roam_support::make_terrain(options);
}

inline sward::View read_view(Input& in, const sward::Lattice& field) {
  const glm::dvec2 low = field.min_corner(), high = field.max_corner();
  const glm::dvec3 eye(in.between(low.x - 50, high.x + 50), in.between(low.y - 50, high.y + 50), in.between(-200, 400));
  const double azimuth = in.between(-4, 4), pitch = in.between(-1.6, 1.6), fov = in.between(0.02, 2.5);
  const double near_plane = in.between(0.01, 60);
  sward::View view = sward::View::look(eye, azimuth, pitch, fov, {640, 480}, near_plane, near_plane + 2000);
  const uint8_t odd = in.byte();
  if (odd == 255) view.eye.x = in.any_double();
  if (odd == 254) view.clip_from_eye[0][0] = in.any_double();
  if (odd >= 240 && odd < 250) view.viewport.x = int(odd) - 240;
  return view;
}

inline sward::RoamOptions read_options(Input& in) {
  sward::RoamOptions options;
  options.max_triangles = in.word() % 1500;
  options.hysteresis = float(in.unit() * 0.2);
  options.target_px = in.byte() % 4 == 0 ? float(in.unit() * 40) : 0;
  options.time_cap_s = in.byte() % 8 == 0 ? 1e-9 : 0;
  options.plain = in.byte() % 16 == 0;
  return options;
}

/// The first node from `start` on, around, for which `wanted` holds.
template <class Wanted>
uint32_t find_node(const sward::roam::RoamTree& tree, uint32_t start, Wanted&& wanted) {
  const uint32_t count = uint32_t(tree.size());
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t node = (start + i) % count;
    if (tree.is_alive(node) && wanted(node)) return node;
  }
  return sward::roam::k_none;
}

/// What a run works on.
struct Scene {
  roam_support::Terrain terrain;
  PartlyResident surface;
  sward::roam::RoamEngine engine;
  sward::HostPriorities named;
  double clock = 0;

  explicit Scene(int kind)
      : terrain(make_terrain_of_kind(kind)), surface(*terrain.bounds), engine(surface, {}), named(surface.lattice()) {
    engine.set_priorities(&named);
  }
};

inline std::string check_budget(const sward::roam::RoamEngine& engine) {
  return engine.visible_count() > engine.options().max_triangles ? "the budget is exceeded" : "";
}

/// After an update nothing is split that the surface does not allow. Forced splits go deeper than it where the driver
/// asks for them, which it only does while all is resident.
inline std::string check_residency(const Scene& scene) {
  const sward::roam::RoamTree& tree = scene.engine.tree();
  for (uint32_t node = 0; node < tree.size(); ++node) {
    if (!tree.is_split(node)) continue;
    const int level = tree.nodes[node].id.level();
    if (level >= tree.lattice().max_level) continue;
    if (!scene.surface.can_split(sward::roam::centre_of(tree.corners(node)), level))
      return "what is not resident is split";
  }
  return "";
}

inline std::string split_some_leaf(Input& in, Scene& scene) {
  sward::roam::RoamEngine& engine = scene.engine;
  const sward::roam::RoamTree& tree = engine.tree();
  const bool all = scene.surface.present().all();
  const int deepest = std::min(tree.lattice().max_level + 2, sward::k_max_level - 1);
  const uint32_t leaf = find_node(tree, in.word(), [&](uint32_t n) {
    return tree.is_leaf(n) && (all ? tree.nodes[n].id.level() < deepest : tree.splittable(n));
  });
  if (leaf == sward::roam::k_none) return "";
  const sward::roam::Chain chain = tree.forced_chain(leaf);
  for (int i = 0; i < chain.length; ++i)
    if (!all && !tree.splittable(chain.node[i])) return "a forced split is not allowed where the split is";
  const int cost = engine.view() ? engine.split_cost(chain) : 0;
  const int before = int(engine.visible_count());
  engine.split(leaf);
  return int(engine.visible_count()) - before == cost ? "" : "a split cost other than foretold";
}

inline std::string merge_some_diamond(Input& in, sward::roam::RoamEngine& engine) {
  const sward::roam::RoamTree& tree = engine.tree();
  const uint32_t node = find_node(tree, in.word(), [&](uint32_t n) { return tree.mergeable(n); });
  if (node == sward::roam::k_none) return "";
  const int gain = engine.merge_gain(node), before = int(engine.visible_count());
  engine.merge(node);
  // More where a half was shown although it had gone out of sight.
  const int more = before - int(engine.visible_count()) - gain;
  return more >= 0 && more <= 2 ? "" : "a merge gained other than foretold";
}

/// Loads and drops squares (not with relief, which worlds do not have). The mesh follows in its next update, which may
/// come some steps later.
inline void change_residency(Input& in, Scene& scene) {
  if (scene.terrain.field->desc().relief.enabled) return;
  PartlyResident::Squares present = scene.surface.present();
  switch (in.byte() % 4) {
    case 0:
      present.set();
      break;
    case 1:
      present &= PartlyResident::Squares(in.word());
      break;
    default:
      present.flip(in.byte() % present.size());
  }
  scene.engine.residency_changed(scene.surface.set_present(present));
}

/// Raises or lowers some of the ground. Meshes follow in the next update, before which they do not fit the field.
inline std::string edit_ground(Input& in, Scene& scene) {
  if (!scene.engine.view()) return "";
  const sward::HeightField& field = *scene.terrain.field;
  const glm::dvec2 low = field.min_corner(), high = field.max_corner();
  sward::Edit edit;
  edit.kind = in.byte() % 2 ? sward::Edit::Kind::raise : sward::Edit::Kind::flatten;
  edit.metres = in.between(-60, 60);
  edit.region = sward::EditRegion::disc({in.between(low.x, high.x), in.between(low.y, high.y)}, in.between(1, 200),
                                        in.between(0, 50));
  const auto edited = sward::edit(*scene.terrain.field, *scene.terrain.bounds, edit);
  if (!edited) return edited.error().message;
  scene.engine.surface_changed(edited->changed);
  if (const auto stats = scene.engine.update(*scene.engine.view(), scene.clock); !stats) return stats.error().message;
  return check_budget(scene.engine);
}

inline sward::NamedPoint read_point(Input& in, const sward::Lattice& field) {
  const glm::dvec2 low = field.min_corner(), high = field.max_corner();
  sward::NamedPoint point{in.byte() % 12u, {in.between(low.x, high.x), in.between(low.y, high.y)}};
  point.tolerance_m = in.byte() % 4 * 0.5;
  const uint8_t odd = in.byte();
  if (odd == 255) point.xy.x = in.any_double();
  if (odd == 254) point.tolerance_m = in.any_double();
  if (odd >= 230 && odd < 240) point.xy.x = high.x;
  if (odd >= 220 && odd < 235) point.xy.y = low.y;
  // On vertices and edges.
  if (odd < 64) point.xy = field.world_xy(sward::LatticePoint(field.from_world(point.xy)) / 4096 * 4096);
  return point;
}

inline sward::NamedLine read_line(Input& in, const sward::Lattice& field) {
  const glm::dvec2 low = field.min_corner(), high = field.max_corner();
  const auto end = [&] {
    return glm::dvec3(in.between(low.x - 50, high.x + 50), in.between(low.y - 50, high.y + 50), in.between(-150, 200));
  };
  sward::NamedLine line{in.byte() % 12u, end(), end()};
  const uint8_t odd = in.byte();
  if (odd == 255) line.to.z = in.any_double();
  if (odd == 254) line.from.x = in.any_double();
  if (odd < 16) line.to = line.from;
  if (odd >= 16 && odd < 32) line.to.x = line.from.x;
  return line;
}

// Adds, moves, removes named things, or hands the set to the mesh or takes it away.
inline void name_things(Input& in, sward::roam::RoamEngine& engine, sward::HostPriorities& named) {
  const sward::Lattice& field = engine.tree().lattice();
  switch (in.byte() % 8) {
    case 0:
      return engine.set_priorities(in.byte() % 4 == 0 ? nullptr : &named);
    case 1:
      return (void)named.remove(in.byte() % 12u);
    case 2:
      if (in.byte() % 4 == 0) named.clear();
      return;
    case 3:
    case 4: {
      const sward::NamedPoint point = read_point(in, field);
      return (void)(named.contains(point.id) ? named.move(point) : named.add(point));
    }
    default: {
      const sward::NamedLine line = read_line(in, field);
      return (void)(named.contains(line.id) ? named.move(line) : named.add(line));
    }
  }
}

/// One operation; what it did wrong, or nothing.
inline std::string step(Input& in, Scene& scene) {
  sward::roam::RoamEngine& engine = scene.engine;
  const sward::Lattice& lattice = engine.tree().lattice();
  const auto after_update = [&] {
    const std::string fault = check_budget(engine);
    return fault.empty() && !scene.surface.present().all() ? check_residency(scene) : fault;
  };
  switch (in.byte() % 10) {
    case 0:
      (void)engine.set_options(read_options(in));
      return "";
    case 1:
    case 2:
      return engine.update(read_view(in, lattice)) ? after_update() : "";
    case 3:
      return split_some_leaf(in, scene);
    case 4: {
      // With a clock: a new view, or the last one some time later.
      scene.clock += in.between(0, 0.2);
      const bool still = in.byte() % 2 == 0 && engine.view();
      return engine.update(still ? *engine.view() : read_view(in, lattice), scene.clock) ? after_update() : "";
    }
    case 5: {
      const sward::LatticePoint first(in.word() * 8, in.word() * 8);
      const sward::LatticeBox box{first, first + sward::LatticePoint(in.word() * 4, in.word() * 4)};
      in.byte() % 2 ? engine.surface_changed(box) : engine.residency_changed(box);
      return "";
    }
    case 6:
      return merge_some_diamond(in, engine);
    case 7:
      change_residency(in, scene);
      return "";
    case 8:
      name_things(in, engine, scene.named);
      return "";
    default:
      return edit_ground(in, scene);
  }
}

/// Runs the input; the first fault, or nothing. Adds the number of steps to `steps`.
inline std::string run(std::span<const uint8_t> bytes, uint64_t& steps) {
  Input in(bytes);
  Scene scene(in.byte());
  for (; !in.empty(); ++steps) {
    if (std::string fault = step(in, scene); !fault.empty()) return fault;
    if (const auto valid = scene.engine.validate(); !valid) return valid.error().message;
  }
  return "";
}

}  // namespace roam_driver
