// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "scene/scene_schema.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <numeric>

namespace sward::scene_file {

namespace {

constexpr size_t k_longest_quote = 40;

/// Levenshtein's distance.
size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t(0));
  for (size_t i = 0; i < a.size(); ++i) {
    size_t diagonal = std::exchange(row[0], i + 1);
    for (size_t j = 0; j < b.size(); ++j) {
      const size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, replaced});
    }
  }
  return row.back();
}

/// One line, printable, not longer than k_longest_quote.
std::string shorten(std::string_view text) {
  std::string line;
  for (const char c : text.substr(0, k_longest_quote)) line += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  // Does not cut a UTF-8 sequence in two.
  if (text.size() > k_longest_quote) {
    while (!line.empty() && (static_cast<unsigned char>(line.back()) & 0xc0) == 0x80) line.pop_back();
    if (!line.empty() && static_cast<unsigned char>(line.back()) >= 0xc0) line.pop_back();
    line += "...";
  }
  return line;
}

std::string number_text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.9g", value);
  return buffer;
}

std::string quoted_array(const toml::array& array) {
  std::string text = "[";
  for (size_t i = 0; i < array.size(); ++i) {
    if (i > 3) return text + ", ...]";
    text += (i == 0 ? "" : ", ") + (array[i].is_array() ? std::string("[...]") : quoted(array[i]));
  }
  return text + "]";
}

}  // namespace

tl::unexpected<Error> Context::fail_at(const toml::source_region& source, const std::string& message) const {
  const auto line = std::max<toml::source_index>(source.begin.line, 1);
  return fail(file + ":" + std::to_string(line) + ": " + message);
}

std::vector<std::pair<const toml::key*, const toml::node*>> entries_in_order(const toml::table& table) {
  std::vector<std::pair<const toml::key*, const toml::node*>> entries;
  for (const auto& [key, node] : table) entries.emplace_back(&key, &node);
  std::stable_sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
    const auto &p = a.first->source().begin, &q = b.first->source().begin;
    return std::pair(p.line, p.column) < std::pair(q.line, q.column);
  });
  return entries;
}

Expected<void> refuse(const toml::table& table, std::initializer_list<std::string_view> keys,
                      const std::string& because, const Context& context) {
  for (const auto& [name, node] : entries_in_order(table)) {
    if (std::find(keys.begin(), keys.end(), name->str()) != keys.end()) {
      return context.fail_at(name->source(), std::string(name->str()) + " has no effect " + because);
    }
  }
  return {};
}

std::string quoted(const toml::node& node) {
  if (const auto* text = node.as_string()) return "\"" + shorten(text->get()) + "\"";
  if (const auto* number = node.as_integer()) return std::to_string(number->get());
  if (const auto* number = node.as_floating_point()) return number_text(number->get());
  if (const auto* flag = node.as_boolean()) return flag->get() ? "true" : "false";
  if (const auto* array = node.as_array()) return quoted_array(*array);
  return node.is_table() ? "{ a table }" : "a date or time";
}

std::string suggest(std::string_view unknown, const std::vector<std::string>& known) {
  const std::string* nearest = nullptr;
  size_t least = std::numeric_limits<size_t>::max();
  for (const std::string& name : known) {
    // Leaving a unit away is the commonest slip: it counts little.
    const bool unit_missing = name.starts_with(unknown) && name[unknown.size()] == '_';
    const size_t distance = unit_missing ? 1 : edit_distance(unknown.substr(0, 64), name);
    if (distance < least) {
      least = distance;
      nearest = &name;
    }
  }
  if (nearest != nullptr && least <= std::max<size_t>(2, unknown.size() / 3)) return "\"" + *nearest + "\"";
  std::string all = "one of";
  for (size_t i = 0; i < known.size(); ++i) all += (i == 0 ? " " : ", ") + known[i];
  return all;
}

}  // namespace sward::scene_file
