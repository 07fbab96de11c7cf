// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/terrain/error.h>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

namespace sward {

/// The wind that blows everywhere. Metres and seconds; azimuths in radians, 0 east, counter-clockwise.
struct Weather {
  float speed_m_s = 0;       ///< Mean speed among the plants, [0, 120]. 0: calm.
  float from_azimuth = 0;    ///< Where it comes from, as weather reports say it: 0 is a wind from the east.
  float gustiness = 0.6f;    ///< [0, 1]: speeds run from (1 - gustiness) to (1 + gustiness) times the mean.
  float gust_length_m = 60;  ///< From gust to gust, [2, 10000].
  float ambient_m_s = 0.2f;  ///< Of the noise that moves grass in calm, [0, 20]. 0: calm is still.
  float turbulence = 0.2f;   ///< What wind adds to that noise, as a share of its speed here, [0, 1].
};

/// Mean speed of a force on Beaufort's scale, 0 to 12: 0.836 force^1.5 m/s. Clamps to the scale; 0 for NaN.
SWARD_API float beaufort_speed(float force);

/// Wind at a place.
struct WindHere {
  glm::vec2 velocity{0};  ///< m/s east and north: weather, sources and movers.
  glm::vec2 ambient{0};   ///< m/s: the small, quick part; in calm the only one.
  float gust = 0;         ///< Of the gust map, 0..1; 0.5 is the mean wind. 0 in calm.
};

/// A place from which wind starts, and reaches plants the later the farther they are (Bakay, Lalonde, Heidrich 2002,
/// section 4). A gust blows outwards; whirlwind() makes one that turns.
struct WindSource {
  glm::dvec2 position{0};      ///< World, metres.
  glm::dvec2 velocity_m_s{0};  ///< It may travel, at most 120 m/s.
  double start_s = 0;          ///< On the wind's clock, Wind::time(). May lie in the past or the future.
  double duration_s = 4;       ///< (0, 1e6]
  double rise_s = 2;           ///< To full strength, and from it: [0.001, duration / 2].
  double repeat_s = 0;         ///< It starts again after so long, [duration, 1e6]; 0: once.
  float outward_m_s = 12;      ///< At its strongest, [-120, 120]; negative: towards it.
  float around_m_s = 0;        ///< Counter-clockwise around it, [-120, 120].
  float radius_m = 3;          ///< Where it is strongest, [0.01, 10000]. 0 in the middle.
  float falloff = 0;           ///< [0, 4]: speed falls with distance^-falloff outside of the radius.
  float reach_m = 400;         ///< Where it ends, (radius, 100000]; at half of it 56 % are left.
  float travel_m_s = 15;       ///< How fast its front goes outwards, [0.1, 1000].
  float wave_period_s = 1.5f;  ///< Between the waves in it, [0.05, 1000].
  float wave_share = 0.4f;     ///< Share of the speed that is gone between waves, [0, 1]; 0: one smooth gust.
};

/// A whirlwind of a radius and a speed at that radius, that lasts half a minute unless told otherwise.
SWARD_API WindSource whirlwind(glm::dvec2 position, float radius_m, float speed_m_s, double start_s);

/// What moves among the plants, and the air with it (Lee 2010, "Wind Simulation").
struct WindMover {
  enum class Kind {
    body,   ///< Walkers, vehicles, aircraft: pushes the air ahead of its motion.
    rotor,  ///< Blows downwards: outwards over the ground, moving or not.
  };
  Kind kind = Kind::body;
  glm::dvec2 position{0};    ///< World, metres.
  float above_ground_m = 0;  ///< [0, 10000]: at twice the radius half of its wind reaches the ground.
  float radius_m = 0.6f;     ///< [0.01, 50]. Bodies under 1.6 m only stir the air of the fine grid.
  float strength = 1;        ///< Of a body: about the share of its speed that air ahead takes up, [0, 4]. Of a rotor:
                             ///< m/s outwards where it is strongest, [0, 120].
};

/// Whether a wind would take them; errors name the value and what it may be.
SWARD_API Expected<void> validate(const Weather& weather);
SWARD_API Expected<void> validate(const WindSource& source);
SWARD_API Expected<void> validate(const WindMover& mover);

/// Value ids; of what has been removed they stay invalid.
struct WindSourceId {
  uint32_t index = UINT32_MAX, generation = 0;
};
struct WindMoverId {
  uint32_t index = UINT32_MAX, generation = 0;
};

/// An artist's map: what the terrain makes of the wind (Bakay et al., section 4). Immutable once given to a Wind.
struct PaintedWind {
  int width = 0, height = 0;     ///< Texels, 1 to 4096; row 0 is the northern edge.
  glm::dvec2 min{0}, size_m{0};  ///< South-western corner (world) and extent, metres, > 0.
  /// Of the wind from Weather: along it, and to its left; (1, 0) leaves it as it is. Each [-4, 4]. Sources, movers and
  /// noise are multiplied by its length. Beyond the map its border goes on.
  std::vector<glm::vec2> factors;
};

/// What a Wind holds at most; all of it is allocated as it is needed.
inline constexpr uint32_t k_most_wind_sources = 1024;
inline constexpr uint32_t k_most_wind_movers = 16384;
/// Sources that blow at once: of more, those that are strongest at the eye, where their fronts have come or not.
inline constexpr int k_wind_sources_at_once = 16;

struct WindState;

/// The wind over unlimited ground: weather, sources, movers, a painted map. Any thread, one at a time; deterministic:
/// the same calls give the same wind. Calm gives velocities of exactly 0; no value is ever infinite or NaN.
///
/// Movers act on two grids of velocity and acceleration that follow the viewer in whole cells: 128 x 128 cells of
/// 0.5 m, seen to 31 m, and as many of 2 m for what has a radius of 1.6 m or more, seen to 124 m. Beyond, movers do
/// nothing.
///
/// No failing call changes anything.
class SWARD_API Wind {
 public:
  Wind();
  Wind(Wind&&) noexcept;
  Wind& operator=(Wind&&) noexcept;
  ~Wind();

  /// Takes effect at once; to ease it in, call it each frame. The map of gusts goes on from where it is; a new
  /// gust_length_m scales it around the eye. Fails on values out of range.
  Expected<void> set_weather(const Weather& weather);
  const Weather& weather() const;

  /// Fails on values out of range and beyond k_most_wind_sources. A source that is over goes by itself.
  Expected<WindSourceId> add_source(const WindSource& source);
  /// False when there is none such (any more).
  bool remove_source(WindSourceId id);
  uint32_t sources() const;

  /// Fails on values out of range and beyond k_most_wind_movers.
  Expected<WindMoverId> add_mover(const WindMover& mover);
  /// Where it will be at the end of the next advance(); it goes there in a straight line. A pace beyond 500 m/s is no
  /// motion but a jump and stirs nothing. Fails on values out of range and on movers that there are not.
  Expected<void> move(WindMoverId id, glm::dvec2 position, float above_ground_m);
  /// False when there is none such (any more).
  bool remove_mover(WindMoverId id);
  uint32_t movers() const;

  /// Null: none. Fails on maps that do not fit their description.
  Expected<void> set_painted(std::shared_ptr<const PaintedWind> painted);

  /// Goes on by `seconds` >= 0 and follows the viewer. The grids go in steps of 1/120 s, so that they do not depend on
  /// the frame rate; of more than 10 s only the last 10 are stepped, since air rests sooner. Fails on what is not
  /// finite, negative, or farther than 1e9 m from the origin.
  Expected<void> advance(double seconds, glm::dvec3 eye);
  double time() const;  ///< Seconds advanced.

  /// The wind at a place, as plants feel it: for sound, particles, aircraft. Equal to wind_here() in
  /// shaders/common_wind.glsl within 0.5 % of the strongest wind around and 0.01 m/s. Precise to some 100 km from the
  /// eye. A place that is not finite, or farther than 4e9 m, has no wind.
  WindHere at(glm::dvec3 world) const;

  /// For WindTextures.
  const WindState& state() const { return *state_; }

 private:
  std::unique_ptr<WindState> state_;
};

}  // namespace sward
