// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "scene/scene_keys.h"
#include "scene/scene_values.h"

namespace sward::scene_file {

namespace {

constexpr double k_farthest = 1e9;
constexpr size_t k_most_corners = 4096;

Interval place() {
  return within(-k_farthest, k_farthest);
}

/// [x, y]; `put` stores it.
template <class Put>
Key<SceneEvent> place_key(std::string name, Put put) {
  return {std::move(name),
          "[x, y], two numbers in [-1000000000, 1000000000] (metres)",
          [=](const toml::node& node, SceneEvent& event) {
            const auto xy = as_numbers<2>(node, {place(), place()});
            if (xy) put(event, glm::dvec2((*xy)[0], (*xy)[1]));
            return xy.has_value();
          },
          {}};
}

Key<SceneEvent> paint_color_key() {
  return {"color",
          "\"#rrggbb\"",
          [](const toml::node& node, SceneEvent& event) {
            const auto color = rgb_of_hex(node);
            if (color) event.color = *color;
            return color.has_value();
          },
          {}};
}

Key<SceneWalker> path_key() {
  return {"path",
          "a list of 2 to 4096 places [time, x, y] (seconds, metres), times from 0 to 1000000 and rising",
          [](const toml::node& node, SceneWalker& walker) {
            const toml::array* array = node.as_array();
            if (array == nullptr || array->size() < 2 || array->size() > k_most_corners) return false;
            for (const toml::node& element : *array) {
              const auto at = as_numbers<3>(element, {within(0, 1e6), place(), place()});
              if (!at || (!walker.path.empty() && (*at)[0] <= walker.path.back().x)) return false;
              walker.path.emplace_back((*at)[0], (*at)[1], (*at)[2]);
            }
            return true;
          },
          {}};
}

Key<SceneWalker> gait_key() {
  return choice<SceneWalker, bool>("gait", &SceneWalker::wheels, {{"feet", false}, {"wheels", true}});
}

Expected<void> check_walker(const toml::table& table, const SceneWalker& walker, const Context& context) {
  if (walker.path.empty()) return context.fail_at(table, "a walker has no path, expected path = [[time, x, y], ...]");
  return walker.wheels ? refuse(table, {"step_m"}, "on wheels, expected only with gait = \"feet\"", context)
                       : Expected<void>();
}

Expected<void> check_event(const toml::table& table, const SceneEvent& event, const Context& context) {
  using Kind = SceneEvent::Kind;
  if (!table.contains("kind") || !table.contains("position_m")) {
    return context.fail_at(table,
                           "an event needs kind and position_m, expected kind = \"explosion\", \"cut\", \"burn\", "
                           "\"wet\", \"paint\" or \"rotor\" and position_m = [x, y]");
  }
  const Kind kind = event.kind;
  if (kind == Kind::explosion || kind == Kind::rotor)
    if (auto fits = refuse(table, {"to_m"}, "on what is round, expected only on strips", context); !fits) return fits;
  if (kind == Kind::explosion || kind == Kind::cut)
    if (auto fits = refuse(table, {"amount"}, "on an explosion or a cut", context); !fits) return fits;
  if (kind != Kind::cut)
    if (auto fits = refuse(table, {"height_m"}, "on this kind, expected only with kind = \"cut\"", context); !fits)
      return fits;
  return kind == Kind::paint ? Expected<void>()
                             : refuse(table, {"color"}, "on this kind, expected only with kind = \"paint\"", context);
}

}  // namespace

Key<Species> resistance_key() {
  return {"resistance",
          "a number in [0, 1]",
          [](const toml::node& node, Species& species) {
            const auto value = as_number(node);
            if (!value || !within(0, 1).contains(*value)) return false;
            species.resistance = float(*value);
            return true;
          },
          {}};
}

const Schema<SceneWalker>& walker_schema() {
  using W = SceneWalker;
  static const Schema<W> schema{
      "[[disturbance.walker]]",
      {gait_key(), number("radius_m", &W::radius_m, within(0.02, 10), "metres"),
       number("weight", &W::weight, within(0, 1)), number("track_m", &W::track_m, within(0, 20), "metres"),
       number("step_m", &W::step_m, within(0.1, 20), "metres"), path_key()},
      check_walker};
  return schema;
}

const Schema<SceneEvent>& event_schema() {
  using E = SceneEvent;
  using Kind = E::Kind;
  static const Schema<E> schema{
      "[[disturbance.event]]",
      {choice<E, Kind>("kind", &E::kind,
                       {{"explosion", Kind::explosion},
                        {"cut", Kind::cut},
                        {"burn", Kind::burn},
                        {"wet", Kind::wet},
                        {"paint", Kind::paint},
                        {"rotor", Kind::rotor}}),
       number("time_s", &E::time_s, within(0, 1e6), "seconds"),
       place_key("position_m", [](E& event, glm::dvec2 at) { event.position = at; }),
       place_key("to_m", [](E& event, glm::dvec2 at) { event.to = at; }),
       number("radius_m", &E::radius_m, above_to(0, 1000), "metres"), number("amount", &E::amount, within(0, 1)),
       number("height_m", &E::height_m, within(0, 10), "metres"), paint_color_key()},
      check_event};
  return schema;
}

const Schema<SceneDisturbance>& disturbance_schema() {
  using D = SceneDisturbance;
  static const Schema<D> schema{"[disturbance]",
                                {text("file", &D::file, "the path of a saved disturbance"),
                                 number("press_half_life_s", &D::press_half_life_s, within(1, 1000000), "seconds"),
                                 number("wet_half_life_s", &D::wet_half_life_s, within(1, 1000000), "seconds"),
                                 number("memory_mb", &D::memory_mb, within(1, 65536), "megabytes"),
                                 tables<D, SceneWalker>("walker", &D::walkers, walker_schema()),
                                 tables<D, SceneEvent>("event", &D::events, event_schema())},
                                {}};
  return schema;
}

}  // namespace sward::scene_file
