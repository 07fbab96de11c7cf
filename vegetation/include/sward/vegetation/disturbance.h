// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/terrain/error.h>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <string>

namespace sward {

/// What has touched a place. CPU twin of `Disturbed` in shaders/common_disturbed.glsl.
struct Disturbed {
  glm::vec2 press{0};  ///< Way that plants lie (east, north), its length how far: 0 upright .. 1 flat.
  float cut = 0;       ///< 0 uncut .. 1 at the ground; plants are cut off at 0.25 m (1/cut - 1).
  float burn = 0;      ///< 0 .. 1 black and short.
  float wet = 0;       ///< 0 dry .. 1.
  glm::vec4 paint{0};  ///< sRGB times amount; amount 0..1.
};

struct DisturbanceOptions {
  float press_half_life_s = 300;    ///< Until plants have risen half-way. 1 .. 1e6.
  float wet_half_life_s = 900;      ///< Until half has dried. 1 .. 1e6.
  size_t memory_limit = 64u << 20;  ///< Bytes of tiles, at least 1 MiB.
};

/// Where a brush works: all within `radius_m` of the line from `from` to `to` (a capsule; a disc where they are equal).
struct DisturbanceBrush {
  glm::dvec2 from{0}, to{0};  ///< World x, y, metres; finite, within 1e9.
  double radius_m = 0.5;      ///< (0, 1000]; all of it within 4096 squares of 32 m.
  float soft = 0.3f;          ///< Share of the radius over which it fades, 0..1.
};

/// What a brush does, each at its strongest; what is there already and stronger stays.
struct DisturbanceTouch {
  float press = 0;       ///< How far plants are laid down, 0..1: the way of the brush and out from its line.
  glm::vec2 way{0};      ///< Way that they are laid, in place of the brush's; any length; 0: the brush's own.
  bool inwards = false;  ///< Towards the line instead of away from it.
  float cut_m = std::numeric_limits<float>::infinity();  ///< Height that is left, metres, >= 0; infinite: uncut.
  float burn = 0, wet = 0;                               ///< 0..1.
  glm::vec4 paint{0};                                    ///< sRGB, 0..1, and amount 0..1. Later paint covers earlier.
};

struct DisturbanceStats {
  size_t tiles = 0, bytes = 0;  ///< Held now.
  uint64_t decayed = 0;         ///< Tiles let go because nothing of them can be seen any more.
  uint64_t dropped = 0;         ///< Pressed or wet tiles let go early, oldest first, to stay below the limit.
  uint64_t refused = 0;         ///< Brushes that failed because cut, burnt and painted tiles fill the memory.
};

struct DisturbanceTiles;

/// Ground that remembers: press, cut, burn, water and paint over unlimited terrain, as sparse tiles of 16 x 16 cells in
/// three levels of 0.125, 0.5 and 2 m. Each coarser level holds the mean of the finer, so distance neither flickers nor
/// loses a track. Feet and wheels are a cell or two wide; at the border of each level's window
/// (DisturbanceTextures) a cell is some six pixels of a picture 720 high, so none is finer than can be seen, and
/// none so coarse that its shape shows.
///
/// Press and water halve with every half-life since the last touch, worked out where they are read: nothing runs over
/// the tiles, and results depend neither on step nor on frame rate (times are kept in 1/256 s). What is below 0.02 is
/// not shown and is let go. Cuts, burns and paint stay until regrow(). After E. Lee, "Realistic Real-Time Grass
/// Rendering" (2010; the player acts on the grass around it) and 3DWorld, "Infinite Fields of Grass" (2015: cut,
/// crushed, burnt, wet, sprayed grass), which update vertices instead.
///
/// Memory: a tile that is only pressed takes 1.7 KB for 4 m2 of its finest level, one that is only cut or burnt 0.7 KB.
/// At the limit the finest pressed tiles go first, oldest first, then coarser ones; their means remain one level up.
/// Cut, burnt and painted tiles are never let go: where they alone fill the memory, brushes fail and change nothing.
/// While it lasts regrowth takes 2 KB a tile more, beyond the limit where need be (at most four times it), for it is
/// what frees memory.
///
/// One thread at a time. Needs no GL. Move-only.
class SWARD_API Disturbance {
 public:
  static constexpr double k_visible = 0.02;      ///< Press and water below this are not shown.
  static constexpr double k_most_place = 1e9;    ///< Metres from the origin.
  static constexpr double k_most_radius = 1000;  ///< Metres.

  /// Fails on options out of range.
  static Expected<Disturbance> create(const DisturbanceOptions& options = {});
  Disturbance(Disturbance&&) noexcept;
  Disturbance& operator=(Disturbance&&) noexcept;
  ~Disturbance();

  const DisturbanceOptions& options() const;

  /// Lets time pass; fails, changing nothing, on a step that is negative, not finite or above 1e6 s. Cost: that of the
  /// tiles whose end has come.
  Expected<void> advance(double seconds);
  /// Seconds since the beginning.
  double time() const;

  /// Applies a brush. Fails, changing nothing, naming the number that is out of range; and where the memory is full.
  /// Cost: some 20 ns a cell of the finest level; brushes larger than 4096 tiles of a level work on the next
  /// coarser cells.
  Expected<void> touch(const DisturbanceBrush& brush, const DisturbanceTouch& touch);

  // The usual ones, all touch(); `depth`, `amount` 0..1.
  /// Feet and wheels. Plants lie the way of the motion and outwards.
  Expected<void> press_capsule(glm::dvec2 from, glm::dvec2 to, double radius_m, float depth);
  /// What is set down, or a rotor's wash: plants lie away from the centre.
  Expected<void> press_disc(glm::dvec2 centre, double radius_m, float depth);
  Expected<void> cut_capsule(glm::dvec2 from, glm::dvec2 to, double radius_m, float height_left_m);
  Expected<void> burn_disc(glm::dvec2 centre, double radius_m, float amount);
  Expected<void> wet_disc(glm::dvec2 centre, double radius_m, float amount);
  Expected<void> paint_disc(glm::dvec2 centre, double radius_m, glm::vec3 srgb, float amount);
  /// A blast: the inner half of the radius is burnt, everything is laid outwards, less towards the rim. Where
  /// memory ends between the two, it fails with the first of them done.
  Expected<void> explode(glm::dvec2 centre, double radius_m);
  /// A rotor that hovers: laid outwards, softly to the rim; `strength` 0..1.
  Expected<void> rotor_wash(glm::dvec2 centre, double radius_m, float strength);

  /// Cuts, burns and paint within the disc fade linearly to nothing in `seconds` (0: at once; up to 1e6) from now on; a
  /// later touch of the same place ends that there. Fails, changing nothing, on numbers out of range.
  Expected<void> regrow(glm::dvec2 centre, double radius_m, double seconds);
  /// The same everywhere.
  Expected<void> regrow_all(double seconds);
  /// Forgets everything but the time.
  void clear();

  /// What is at a place now, from its finest cells, between them linearly; nothing where the place is not finite. As
  /// plants next to the eye have it.
  Disturbed at(glm::dvec2 place) const;
  /// The same as a plant has it in the view of an eye there: farther away from coarser cells (DisturbanceTextures).
  Disturbed at(glm::dvec2 place, glm::dvec2 eye) const;

  /// Counts every change; equal numbers mean equal cells.
  uint64_t revision() const;
  DisturbanceStats stats() const;

  /// Writes all cells and the time: beside the file, then renamed, so that a failure leaves the old one. Fails naming
  /// the file.
  Expected<void> save(const std::string& path) const;
  /// Replaces all cells and the time; options stay. Fails, changing nothing, naming the file and what is wrong with it:
  /// missing, truncated, altered, of another version, or holding more than the memory limit.
  Expected<void> load(const std::string& path);

  /// For sward's own sources.
  const DisturbanceTiles& tiles() const { return *tiles_; }

 private:
  explicit Disturbance(std::unique_ptr<DisturbanceTiles> tiles);
  std::unique_ptr<DisturbanceTiles> tiles_;
};

}  // namespace sward
