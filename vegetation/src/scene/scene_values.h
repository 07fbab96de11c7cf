// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

// Makers of keys: each joins a name, a member and a range, and words what is expected from the same range.

#include <sward/vegetation/species.h>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <numbers>
#include <optional>

#include "scene/scene_schema.h"

namespace sward::scene_file {

struct Interval {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false, high_open = false;
  bool not_zero = false, infinite = false;  ///< `infinite`: inf is allowed.

  bool contains(double value) const;
  /// " in [0, 1]", " > 0", or nothing.
  std::string text() const;
};
inline Interval any_number() {
  return {};
}
inline Interval within(double low, double high) {
  return {.low = low, .high = high};
}
inline Interval at_least(double low) {
  return {.low = low};
}
inline Interval above_to(double low, double high) {
  return {.low = low, .high = high, .low_open = true};
}
inline Interval above(double low) {
  return {.low = low, .low_open = true};
}

/// Integers and floats.
std::optional<double> as_number(const toml::node& node);
std::optional<int64_t> as_whole_number(const toml::node& node, Interval range);
/// Exactly N numbers, each in its range.
template <size_t N>
std::optional<std::array<double, N>> as_numbers(const toml::node& node, const std::array<Interval, N>& ranges) {
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() != N) return std::nullopt;
  std::array<double, N> values;
  for (size_t i = 0; i < N; ++i) {
    const auto value = as_number((*array)[i]);
    if (!value || !ranges[i].contains(*value)) return std::nullopt;
    values[i] = *value;
  }
  return values;
}
/// `#rrggbb` as red, green, blue, 0..1.
std::optional<glm::vec3> rgb_of_hex(const toml::node& node);
/// `#rrggbb` as hue (turns), saturation, value.
std::optional<glm::vec3> hsv_of_hex(const toml::node& node);

inline std::string with_unit(std::string text, std::string_view unit) {
  return unit.empty() ? text : text + " (" + std::string(unit) + ")";
}

/// Stores a double as the member's type where that keeps it inside its range.
template <class V>
bool store(double value, Interval range, V& target) {
  if (!range.contains(value)) return false;
  const V stored = V(value);
  if (std::isinf(stored) != std::isinf(value)) return false;
  if (stored == V(0) && !range.contains(0.0)) return false;
  target = stored;
  return true;
}

template <class T, class V>
Key<T> number(std::string name, V T::*member, Interval range, std::string_view unit = {}) {
  return {std::move(name),
          with_unit("a number" + range.text(), unit),
          [=](const toml::node& node, T& target) {
            const auto value = as_number(node);
            return value && store(*value, range, target.*member);
          },
          {}};
}

/// Degrees in the file, radians in memory.
template <class T, class V>
Key<T> angle(std::string name, V T::*member, Interval range) {
  return {std::move(name),
          with_unit("a number" + range.text(), "degrees"),
          [=](const toml::node& node, T& target) {
            const auto degrees = as_number(node);
            if (!degrees || !range.contains(*degrees)) return false;
            target.*member = V(*degrees * (std::numbers::pi / 180.0));
            return true;
          },
          {}};
}

template <class T, class V>
Key<T> whole_number(std::string name, V T::*member, Interval range) {
  return {std::move(name),
          "a whole number" + range.text(),
          [=](const toml::node& node, T& target) {
            const auto value = as_whole_number(node, range);
            if (value) target.*member = V(*value);
            return value.has_value();
          },
          {}};
}

template <class T>
Key<T> flag(std::string name, bool T::*member) {
  return {std::move(name),
          "true or false",
          [=](const toml::node& node, T& target) {
            const auto* value = node.as_boolean();
            if (value != nullptr) target.*member = value->get();
            return value != nullptr;
          },
          {}};
}

template <class T>
Key<T> text(std::string name, std::string T::*member, std::string expected) {
  return {std::move(name),
          std::move(expected),
          [=](const toml::node& node, T& target) {
            const auto* value = node.as_string();
            if (value == nullptr || value->get().empty()) return false;
            target.*member = value->get();
            return true;
          },
          {}};
}

template <class T, class V>
Key<T> choice(std::string name, V T::*member, std::vector<std::pair<std::string, V>> names) {
  std::string expected;
  for (const auto& [word, value] : names) expected += (expected.empty() ? "\"" : " or \"") + word + "\"";
  return {std::move(name),
          expected,
          [=](const toml::node& node, T& target) {
            const auto* chosen = node.as_string();
            if (chosen == nullptr) return false;
            for (const auto& [word, value] : names) {
              if (word != chosen->get()) continue;
              target.*member = value;
              return true;
            }
            return false;
          },
          {}};
}

/// `[x, y, z]`, all in one range.
template <class T, class V>
Key<T> triple(std::string name, V T::*member, Interval range, std::string_view unit = {}) {
  return {std::move(name),
          with_unit("three numbers" + range.text(), unit),
          [=](const toml::node& node, T& target) {
            const auto values = as_numbers<3>(node, {range, range, range});
            V read{};
            for (int i = 0; values && i < 3; ++i) {
              if (!store((*values)[size_t(i)], range, read[i])) return false;
            }
            if (values) target.*member = read;
            return values.has_value();
          },
          {}};
}

/// `[min, max]`.
template <class T>
Key<T> min_max(std::string name, FloatRange T::*member, Interval range, std::string_view unit = {}) {
  return {std::move(name),
          with_unit("[min, max], two numbers" + range.text() + " with min <= max", unit),
          [=](const toml::node& node, T& target) {
            const auto values = as_numbers<2>(node, {range, range});
            FloatRange read;
            if (!values || !store((*values)[0], range, read.min) || !store((*values)[1], range, read.max)) return false;
            if (read.min > read.max) return false;
            target.*member = read;
            return true;
          },
          {}};
}

/// `[min, max]` in degrees in the file, radians in memory.
template <class T>
Key<T> min_max_angle(std::string name, FloatRange T::*member, Interval range) {
  return {std::move(name),
          with_unit("[min, max], two numbers" + range.text() + " with min <= max", "degrees"),
          [=](const toml::node& node, T& target) {
            const auto values = as_numbers<2>(node, {range, range});
            if (!values || (*values)[0] > (*values)[1]) return false;
            constexpr double k_radians = std::numbers::pi / 180.0;
            target.*member = {float((*values)[0] * k_radians), float((*values)[1] * k_radians)};
            return true;
          },
          {}};
}

/// A table whose keys fill the same object.
template <class T>
Key<T> section(std::string name, Schema<T> schema) {
  const std::string expected = "a table " + schema.title;
  return {
      std::move(name), expected, {}, [=](const toml::node& node, T& target, const Context& context) -> Expected<void> {
        if (!node.is_table()) return context.fail_at(node, quoted(node) + ": expected " + expected);
        return read_fields(*node.as_table(), schema, target, context);
      }};
}

/// A table that fills a member.
template <class T, class V>
Key<T> table(std::string name, V T::*member, Schema<V> schema) {
  const std::string expected = "a table " + schema.title;
  return {
      std::move(name), expected, {}, [=](const toml::node& node, T& target, const Context& context) -> Expected<void> {
        if (!node.is_table()) return context.fail_at(node, quoted(node) + ": expected " + expected);
        return read_fields(*node.as_table(), schema, target.*member, context);
      }};
}

/// `[[name]]`: a list of tables, each a new element of the member.
template <class T, class V>
Key<T> tables(std::string name, std::vector<V> T::*member, Schema<V> schema) {
  const std::string expected = "a list of tables, each headed " + schema.title;
  return {name, expected, {}, [=](const toml::node& node, T& target, const Context& context) -> Expected<void> {
            const toml::array* array = node.as_array();
            if (array == nullptr) return context.fail_at(node, name + " is no list: expected " + expected);
            for (const toml::node& element : *array) {
              if (!element.is_table()) return context.fail_at(element, quoted(element) + ": expected " + expected);
              auto& added = (target.*member).emplace_back();
              if (auto read = read_fields(*element.as_table(), schema, added, context); !read) return read;
            }
            return {};
          }};
}

}  // namespace sward::scene_file
