// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <algorithm>

#include "scene/scene_keys.h"
#include "scene/scene_values.h"

namespace sward::scene_file {

namespace {

Key<SceneSurface> surface_color() {
  return {"color",
          "\"#rrggbb\"",
          [](const toml::node& node, SceneSurface& surface) {
            surface.color = rgb_of_hex(node);
            return surface.color.has_value();
          },
          {}};
}

Expected<void> check_surface(const toml::table& table, const SceneSurface& surface, const Context& context) {
  if (surface.layer.empty()) {
    return context.fail_at(table, "a surface names no layer, expected layer = \"...\" of a layer with on_mesh = true");
  }
  if (surface.shape.empty() == surface.mesh_path.empty()) {
    return context.fail_at(table,
                           "a surface is one of shape and mesh, expected shape = \"box_hedge\" or \"topiary\", "
                           "or mesh = \"FILE\"");
  }
  if (surface.shape.empty()) return refuse(table, {"size_m", "seed"}, "on a mesh file, expected scale", context);
  return {};
}

}  // namespace

const Schema<SceneSurface>& surface_schema() {
  using S = SceneSurface;
  static const Schema<S> schema{
      "[[surface]]",
      {text("layer", &S::layer, "a word"),
       choice<S, std::string>("shape", &S::shape, {{"box_hedge", "box_hedge"}, {"topiary", "topiary"}}),
       text("mesh", &S::mesh_path, "the path of a mesh: OBJ, PLY or OFF"),
       triple("size_m", &S::size_m, within(0.2, 200), "metres"),
       whole_number("seed", &S::seed, within(0, 4294967295.0)),
       triple("position_m", &S::position, any_number(), "metres"), flag("above_ground", &S::above_ground),
       flag("drape", &S::drape), angle("yaw_deg", &S::yaw, within(-360, 360)),
       number("scale", &S::scale, above_to(0, 1e6)), surface_color()},
      check_surface};
  return schema;
}

const Schema<PlantMesh>& plant_mesh_schema() {
  using P = PlantMesh;
  static const Schema<P> schema{"[layer.species.mesh]",
                                {text("file", &P::file, "the path of a mesh: OBJ, PLY or OFF"),
                                 choice<P, std::string>("shape", &P::shape, {{"thistle", "thistle"}})},
                                [](const toml::table& table, const P& plant, const Context& context) -> Expected<void> {
                                  if (plant.file.empty() != plant.shape.empty()) return {};
                                  return context.fail_at(
                                      table,
                                      "a plant's mesh is one of file and shape, expected file = \"FILE\" or "
                                      "shape = \"thistle\"");
                                }};
  return schema;
}

Expected<void> check_surfaces(const toml::table& table, const Scene& scene, const Context& context) {
  const auto layer_named = [&](const std::string& name) {
    return std::find_if(scene.layers.begin(), scene.layers.end(), [&](const Layer& l) { return l.name == name; });
  };
  for (size_t i = 0; i < scene.surfaces.size(); ++i) {
    const auto layer = layer_named(scene.surfaces[i].layer);
    const toml::node& node = (*table.get_as<toml::array>("surface"))[i];
    if (layer == scene.layers.end())
      return context.fail_at(node, "there is no layer \"" + scene.surfaces[i].layer + "\" to cover the surface");
    if (!layer->on_mesh)
      return context.fail_at(node, "layer \"" + layer->name + "\" grows on the terrain, expected on_mesh = true there");
  }
  for (size_t i = 0; i < scene.layers.size(); ++i) {
    const auto covers = [&](const SceneSurface& surface) { return surface.layer == scene.layers[i].name; };
    if (!scene.layers[i].on_mesh || std::any_of(scene.surfaces.begin(), scene.surfaces.end(), covers)) continue;
    return context.fail_at((*table.get_as<toml::array>("layer"))[i],
                           "layer \"" + scene.layers[i].name + "\" is on meshes, but no [[surface]] names it");
  }
  return {};
}

}  // namespace sward::scene_file
