// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "scene/scene_keys.h"
#include "scene/scene_values.h"

namespace sward::scene_file {

namespace {

/// A key of a material, kept in SceneMaterial::material.
Key<SceneMaterial> of_material(Key<GroundMaterial> key) {
  return {key.name,
          key.expected,
          [read = key.read](const toml::node& node, SceneMaterial& target) { return read(node, target.material); },
          {}};
}

Key<SceneMaterial> hex_key() {
  return {"color",
          "\"#rrggbb\"",
          [](const toml::node& node, SceneMaterial& target) {
            const auto hsv = hsv_of_hex(node);
            if (hsv) target.material.reference_hsv = *hsv;
            return hsv.has_value();
          },
          {}};
}

Key<SceneMaterial> hsv_key() {
  const Interval hue{.low = 0, .high = 360, .high_open = true};
  return {"hsv",
          "[hue, saturation, value] in [0, 360) degrees, [0, 1], [0, 1]",
          [=](const toml::node& node, SceneMaterial& target) {
            const auto hsv = as_numbers<3>(node, {hue, within(0, 1), within(0, 1)});
            if (!hsv) return false;
            // Rounding to float must not make a full turn of the largest hue below 360.
            const float turns = float((*hsv)[0] / 360.0);
            target.material.reference_hsv = glm::vec3(turns < 1.0f ? turns : 0.0f, float((*hsv)[1]), float((*hsv)[2]));
            return true;
          },
          {}};
}

Key<GroundMaterial> weights_key() {
  Key<GroundMaterial> key = triple("weights", &GroundMaterial::weights, within(0, 100));
  key.expected += ", not all 0: of hue, saturation, value";
  key.read = [read = key.read](const toml::node& node, GroundMaterial& target) {
    return read(node, target) && target.weights != glm::vec3(0);
  };
  return key;
}

/// A generated texture's name, or a path, which has a dot.
Key<SceneMaterial> detail_key(std::string name, std::string GroundMaterial::*generated,
                              std::string SceneMaterial::*file) {
  std::string expected;
  for (const std::string_view each : generated_details())
    expected += (expected.empty() ? "\"" : ", \"") + std::string(each) + "\"";
  return {std::move(name),
          expected + " or the path of an image",
          [=](const toml::node& node, SceneMaterial& target) {
            const auto* text = node.as_string();
            if (text == nullptr) return false;
            const auto known = generated_details();
            if (std::find(known.begin(), known.end(), text->get()) != known.end()) {
              target.material.*generated = text->get();
              return true;
            }
            target.*file = text->get();
            return text->get().find('.') != std::string::npos;
          },
          {}};
}

Key<SceneMaterial> broad_key() {
  std::vector<std::pair<std::string, std::string>> names;
  for (const std::string_view each : generated_details()) names.emplace_back(each, each);
  return of_material(choice<GroundMaterial, std::string>("broad_detail", &GroundMaterial::broad_detail, names));
}

Expected<void> check_material(const toml::table& table, const SceneMaterial& material, const Context& context) {
  if (!material.species.empty()) {
    return refuse(table, {"color", "hsv", "weights"}, "beside species, whose colour and weights the material has",
                  context);
  }
  if (!material.material.reference_hsv) {
    return refuse(table, {"weights"}, "without a colour, expected color, hsv or species", context);
  }
  return {};
}

}  // namespace

const Schema<SceneMaterial>& material_schema() {
  using G = GroundMaterial;
  using S = SceneMaterial;
  static const Schema<S> schema{
      "[[terrain.material]]",
      {of_material(text("name", &G::name, "a word")), text("species", &S::species, "the name of a species"), hex_key(),
       hsv_key(), of_material(weights_key()), of_material(number("exponent", &G::exponent, above_to(0, 8))),
       of_material(number("threshold", &G::max_distance, within(1e-4, 1e6), "weighted colour distance")),
       detail_key("detail", &G::detail, &S::detail_file), detail_key("cliff_detail", &G::cliff_detail, &S::cliff_file),
       broad_key(), of_material(number("tile_m", &G::tile_m, within(0.05, 64), "metres")),
       of_material(number("cliff_tile_m", &G::cliff_tile_m, within(0.05, 64), "metres")),
       of_material(number("strength", &G::strength, within(0, 1))),
       of_material(number("relief_m", &G::relief_m, within(0, 2), "metres")),
       of_material(number("cliff_relief_m", &G::cliff_relief_m, within(0, 2), "metres")),
       of_material(number("sharpness", &G::sharpness, within(0, 32)))},
      check_material};
  return schema;
}

Key<Scene> materials_key() {
  const std::string expected = "a list of tables, each headed " + material_schema().title;
  return {
      "material", expected, {}, [=](const toml::node& node, Scene& scene, const Context& context) -> Expected<void> {
        const toml::array* array = node.as_array();
        if (array == nullptr) return context.fail_at(node, "material is no list: expected " + expected);
        for (const toml::node& element : *array) {
          if (!element.is_table()) return context.fail_at(element, quoted(element) + ": expected " + expected);
          SceneMaterial& added = scene.materials.emplace_back();
          added.where = context.file + ":" + std::to_string(element.source().begin.line);
          const auto read = read_fields(*element.as_table(), material_schema(), added, context);
          if (!read) return read;
          GroundMaterial& material = added.material;
          if (material.name.empty()) material.name = material.detail;
        }
        return {};
      }};
}

Expected<void> take_species_colors(const toml::table& table, Scene& scene, const Context& context) {
  const toml::node* list = table["terrain"]["material"].node();
  if (list == nullptr) return {};
  for (size_t i = 0; i < scene.materials.size(); ++i) {
    SceneMaterial& each = scene.materials[i];
    if (each.species.empty()) continue;
    const Species* found = nullptr;
    for (const Layer& layer : scene.layers)
      for (const Species& species : layer.species)
        if (found == nullptr && species.name == each.species) found = &species;
    if (found == nullptr) {
      const toml::node& place = *(*list->as_array())[i].as_table()->get("species");
      return context.fail_at(place, "there is no species \"" + each.species + "\" to take the material's colour from");
    }
    each.material.reference_hsv = found->reference_hsv;
    each.material.weights = found->weights;
  }
  std::vector<GroundMaterial> materials;
  for (const SceneMaterial& each : scene.materials) materials.push_back(each.material);
  if (auto valid = validate(std::span<const GroundMaterial>(materials)); !valid) {
    return context.fail_at(*list, valid.error().message);
  }
  return {};
}

}  // namespace sward::scene_file
