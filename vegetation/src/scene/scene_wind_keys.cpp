// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// [wind], [[wind.source]], [[wind.mover]].
#include <algorithm>

#include "scene/scene_keys.h"
#include "scene/scene_values.h"

namespace sward::scene_file {

namespace {

constexpr size_t k_most_places = 4096;

/// A key of what a table's struct holds.
template <class T, class V>
Key<T> of(V T::*member, Key<V> key) {
  return {key.name,
          key.expected,
          [member, read = key.read](const toml::node& node, T& target) { return read(node, target.*member); },
          {}};
}

/// `[x, y]`.
template <class T>
Key<T> pair(std::string name, glm::dvec2 T::*member, Interval range, std::string_view unit) {
  return {std::move(name),
          with_unit("two numbers" + range.text(), unit),
          [=](const toml::node& node, T& target) {
            const auto both = as_numbers<2>(node, {range, range});
            if (both) target.*member = {(*both)[0], (*both)[1]};
            return both.has_value();
          },
          {}};
}

// ---- [[wind.source]]

WindSource first_source(const toml::table& table) {
  const auto* kind = table.get_as<std::string>("kind");
  return kind != nullptr && kind->get() == "whirlwind" ? whirlwind({0, 0}, 5, 10, 0) : WindSource();
}

/// What follows from other keys where the table does not say it.
void complete(const toml::table& table, SceneWindSource& read) {
  WindSource& source = read.source;
  if (read.kind == SceneWindSource::Kind::whirlwind) {
    const WindSource derived = whirlwind(source.position, source.radius_m, read.speed_m_s, source.start_s);
    source.outward_m_s = derived.outward_m_s;
    source.around_m_s = derived.around_m_s;
    if (!table.contains("reach_m")) source.reach_m = derived.reach_m;
  } else {
    source.outward_m_s = read.speed_m_s;
  }
  if (!table.contains("rise_s")) source.rise_s = std::min(source.rise_s, 0.5 * source.duration_s);
}

Expected<void> read_source(const toml::node& node, SceneWind& wind, const Context& context) {
  const toml::table& table = *node.as_table();
  SceneWindSource read;
  read.source = first_source(table);
  if (auto fields = read_fields(table, wind_source_schema(), read, context); !fields) return fields;
  if (!table.contains("position_m"))
    return context.fail_at(table, "a source of wind has no place, expected position_m = [x, y]");
  complete(table, read);
  if (auto valid = validate(read.source); !valid) return context.fail_at(table, valid.error().message);
  wind.sources.push_back(read.source);
  if (wind.sources.size() <= k_most_wind_sources) return {};
  return context.fail_at(table, "more than " + std::to_string(k_most_wind_sources) + " sources, expected fewer");
}

// ---- [[wind.mover]]

Key<SceneWindMover> path_key() {
  return {"path",
          "a list of 1 to 4096 places [seconds, x, y, metres above the ground] with rising times",
          [](const toml::node& node, SceneWindMover& mover) {
            const toml::array* array = node.as_array();
            if (array == nullptr || array->empty() || array->size() > k_most_places) return false;
            for (const toml::node& element : *array) {
              const auto place =
                  as_numbers<4>(element, {within(0, 1e9), within(-1e9, 1e9), within(-1e9, 1e9), within(0, 10000)});
              if (!place) return false;
              const bool later = mover.path.empty() || (*place)[0] > mover.path.back()[0];
              if (!later) return false;
              mover.path.emplace_back((*place)[0], (*place)[1], (*place)[2], (*place)[3]);
            }
            return true;
          },
          {}};
}

Expected<void> check_mover(const toml::table& table, const SceneWindMover& mover, const Context& context) {
  if (mover.path.empty())
    return context.fail_at(table, "a mover has no path, expected path = [[seconds, x, y, metres above the ground]]");
  if (mover.mover.kind == WindMover::Kind::rotor)
    return refuse(table, {"share"}, "on a rotor, expected wash_m_s", context);
  if (mover.path.size() < 2) return context.fail_at(table, "a body of one place moves no air, expected two or more");
  return refuse(table, {"wash_m_s"}, "on a body, expected share", context);
}

Expected<void> read_mover(const toml::node& node, SceneWind& wind, const Context& context) {
  SceneWindMover read;
  const auto* kind = node.as_table()->get_as<std::string>("kind");
  if (kind != nullptr && kind->get() == "rotor") {
    read.mover.radius_m = 6;
    read.mover.strength = 15;
  }
  if (auto fields = read_fields(*node.as_table(), wind_mover_schema(), read, context); !fields) return fields;
  wind.movers.push_back(std::move(read));
  if (wind.movers.size() <= k_most_wind_movers) return {};
  return context.fail_at(node, "more than " + std::to_string(k_most_wind_movers) + " movers, expected fewer");
}

// ---- [wind]

/// `[[wind.NAME]]`, each table by `read`.
Key<SceneWind> list_key(std::string name, const std::string& title,
                        Expected<void> (*read)(const toml::node&, SceneWind&, const Context&)) {
  const std::string expected = "a list of tables, each headed " + title;
  return {name, expected, {}, [=](const toml::node& node, SceneWind& wind, const Context& context) -> Expected<void> {
            const toml::array* array = node.as_array();
            if (array == nullptr) return context.fail_at(node, name + " is no list: expected " + expected);
            for (const toml::node& element : *array) {
              if (!element.is_table()) return context.fail_at(element, quoted(element) + ": expected " + expected);
              if (auto added = read(element, wind, context); !added) return added;
            }
            return {};
          }};
}

Key<SceneWind> beaufort_key() {
  const Interval range = within(0, 12);
  return {"beaufort",
          "a number" + range.text(),
          [=](const toml::node& node, SceneWind& wind) {
            const auto force = as_number(node);
            if (!force || !range.contains(*force)) return false;
            wind.weather.speed_m_s = beaufort_speed(float(*force));
            return true;
          },
          {}};
}

Expected<void> check_wind(const toml::table& table, const SceneWind&, const Context& context) {
  if (!table.contains("beaufort") || !table.contains("speed_m_s")) return {};
  return context.fail_at(*table.get("beaufort"), "speed_m_s and beaufort contradict each other, expected one of them");
}

}  // namespace

const Schema<SceneWindSource>& wind_source_schema() {
  using S = SceneWindSource;
  using W = WindSource;
  static const Schema<S> schema{
      "[[wind.source]]",
      {choice<S, S::Kind>("kind", &S::kind, {{"gust", S::Kind::gust}, {"whirlwind", S::Kind::whirlwind}}),
       of(&S::source, pair("position_m", &W::position, within(-1e9, 1e9), "metres")),
       of(&S::source, pair("velocity_m_s", &W::velocity_m_s, within(-120, 120), "metres a second")),
       of(&S::source, number("start_s", &W::start_s, within(-1e9, 1e9), "seconds")),
       of(&S::source, number("duration_s", &W::duration_s, above_to(0, 1e6), "seconds")),
       of(&S::source, number("rise_s", &W::rise_s, within(0.001, 500000), "seconds")),
       of(&S::source, number("repeat_s", &W::repeat_s, above_to(0, 1e6), "seconds")),
       number("speed_m_s", &S::speed_m_s, within(-120, 120), "metres a second"),
       of(&S::source, number("radius_m", &W::radius_m, within(0.01, 10000), "metres")),
       of(&S::source, number("reach_m", &W::reach_m, above_to(0, 100000), "metres")),
       of(&S::source, number("falloff", &W::falloff, within(0, 4))),
       of(&S::source, number("travel_m_s", &W::travel_m_s, within(0.1, 1000), "metres a second")),
       of(&S::source, number("wave_period_s", &W::wave_period_s, within(0.05, 1000), "seconds")),
       of(&S::source, number("wave_share", &W::wave_share, within(0, 1)))},
      {}};
  return schema;
}

const Schema<SceneWindMover>& wind_mover_schema() {
  using S = SceneWindMover;
  using M = WindMover;
  static const Schema<S> schema{
      "[[wind.mover]]",
      {of(&S::mover, choice<M, M::Kind>("kind", &M::kind, {{"body", M::Kind::body}, {"rotor", M::Kind::rotor}})),
       of(&S::mover, number("radius_m", &M::radius_m, within(0.01, 50), "metres")),
       of(&S::mover, number("share", &M::strength, within(0, 4))),
       of(&S::mover, number("wash_m_s", &M::strength, within(0, 120), "metres a second")), path_key()},
      check_mover};
  return schema;
}

const Schema<SceneWind>& wind_schema() {
  using S = SceneWind;
  using W = Weather;
  static const Schema<S> schema{
      "[wind]",
      {of(&S::weather, number("speed_m_s", &W::speed_m_s, within(0, 120), "metres a second")), beaufort_key(),
       of(&S::weather, angle("from_deg", &W::from_azimuth, within(-360, 360))),
       of(&S::weather, number("gustiness", &W::gustiness, within(0, 1))),
       of(&S::weather, number("gust_length_m", &W::gust_length_m, within(2, 10000), "metres")),
       of(&S::weather, number("ambient_m_s", &W::ambient_m_s, within(0, 20), "metres a second")),
       of(&S::weather, number("turbulence", &W::turbulence, within(0, 1))),
       text("strength_map", &S::strength_file, "the path of an image"),
       text("turn_map", &S::turn_file, "the path of an image"), list_key("source", "[[wind.source]]", read_source),
       list_key("mover", "[[wind.mover]]", read_mover)},
      check_wind};
  return schema;
}

Key<Scene> wind_key() {
  return {
      "wind", "a table [wind]", {}, [](const toml::node& node, Scene& scene, const Context& context) -> Expected<void> {
        if (!node.is_table()) return context.fail_at(node, quoted(node) + ": expected a table [wind]");
        scene.wind.emplace();
        scene.wind->where = context.file + ":" + std::to_string(node.source().begin.line);
        return read_fields(*node.as_table(), wind_schema(), *scene.wind, context);
      }};
}

}  // namespace sward::scene_file
