// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/error.h>
#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/scene_toml.h"

namespace sward::scene_file {

/// Places in the file that is being read, for messages "FILE:LINE: what is wrong, what was expected".
struct Context {
  std::string file;

  tl::unexpected<Error> fail_at(const toml::source_region& source, const std::string& message) const;
  tl::unexpected<Error> fail_at(const toml::node& node, const std::string& message) const {
    return fail_at(node.source(), message);
  }
};

/// One key of a table: what its value must be, and where it goes.
template <class T>
struct Key {
  std::string name;
  std::string expected;  ///< "a number > 0 (metres)"
  /// Stores the value and returns true, or false when it is not as expected. Empty for tables.
  std::function<bool(const toml::node&, T&)> read;
  /// Reads a table or a list of tables; its errors are complete.
  std::function<Expected<void>(const toml::node&, T&, const Context&)> read_table;
};

/// A table: its keys, and what must hold between them.
template <class T>
struct Schema {
  std::string title;  ///< "[terrain]", as messages call it.
  std::vector<Key<T>> keys;
  std::function<Expected<void>(const toml::table&, const T&, const Context&)> check;
};

/// A table's entries in the order of the file, so that the first fault in it is the one reported.
std::vector<std::pair<const toml::key*, const toml::node*>> entries_in_order(const toml::table& table);
/// Fails at the first of these keys that the table has: "KEY has no effect BECAUSE".
Expected<void> refuse(const toml::table& table, std::initializer_list<std::string_view> keys,
                      const std::string& because, const Context& context);
/// The value as messages quote it, shortened.
std::string quoted(const toml::node& node);
/// "expected \"horizon_m\"" when a known name is near, else all names.
std::string suggest(std::string_view unknown, const std::vector<std::string>& known);

template <class T>
Expected<void> read_entry(const toml::key& name, const toml::node& node, const Schema<T>& schema, T& target,
                          const Context& context) {
  for (const Key<T>& key : schema.keys) {
    if (key.name != name.str()) continue;
    if (key.read_table) return key.read_table(node, target, context);
    if (key.read(node, target)) return {};
    return context.fail_at(node,
                           key.name + " = " + quoted(node) + " in " + schema.title + ": expected " + key.expected);
  }
  std::vector<std::string> known;
  for (const Key<T>& key : schema.keys) known.push_back(key.name);
  return context.fail_at(name.source(), "unknown key \"" + std::string(name.str()) + "\" in " + schema.title +
                                            ", expected " + suggest(name.str(), known));
}

template <class T>
Expected<void> read_fields(const toml::table& table, const Schema<T>& schema, T& target, const Context& context) {
  for (const auto& [name, node] : entries_in_order(table)) {
    if (auto read = read_entry(*name, *node, schema, target, context); !read) return read;
  }
  return schema.check ? schema.check(table, target, context) : Expected<void>();
}

}  // namespace sward::scene_file
