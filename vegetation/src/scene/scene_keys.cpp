// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "scene/scene_keys.h"

#include <algorithm>
#include <initializer_list>
#include <set>

#include "scene/scene_values.h"

namespace sward::scene_file {

namespace {

constexpr double k_most_uint32 = std::numeric_limits<uint32_t>::max();

/// Fails at the first table of a list whose name an earlier one has.
Expected<void> refuse_same_names(const toml::table& table, std::string_view list, const Context& context) {
  std::set<std::string> seen;
  const toml::array* array = table.get_as<toml::array>(list);
  if (array == nullptr) return {};
  for (const toml::node& element : *array) {
    const toml::node* name = element.as_table()->get("name");
    const auto* words = name == nullptr ? nullptr : name->as_string();
    if (words != nullptr && !seen.insert(words->get()).second) {
      return context.fail_at(
          *name, "a second " + std::string(list) + " is named " + quoted(*name) + ", expected a name of its own");
    }
  }
  return {};
}

// ---- [terrain] ----

Key<Scene> spacing_key() {
  const Interval range = above(0);
  return {"spacing_m",
          "a number > 0, or two (east-west, north-south) (metres)",
          [=](const toml::node& node, Scene& scene) {
            if (const auto same = as_number(node)) {
              if (!range.contains(*same)) return false;
              scene.spacing = glm::dvec2(*same);
              return true;
            }
            const auto both = as_numbers<2>(node, {range, range});
            if (both) scene.spacing = {(*both)[0], (*both)[1]};
            return both.has_value();
          },
          {}};
}

Key<Scene> no_data_key() {
  return {"no_data",
          "a number (raw units)",
          [](const toml::node& node, Scene& scene) {
            const auto value = as_number(node);
            if (!value || !any_number().contains(*value)) return false;
            scene.has_no_data = true;
            scene.no_data = *value;
            return true;
          },
          {}};
}

Expected<void> check_terrain(const toml::table& table, const Scene& scene, const Context& context) {
  const bool generated = !scene.generator.empty(), read = !scene.height_path.empty();
  const bool world = !scene.world_path.empty();
  if (generated && read) {
    return context.fail_at(*table.get("height"), "generator and height contradict each other, expected one of them");
  }
  if (world && (generated || read)) {
    return context.fail_at(*table.get("world"), std::string(generated ? "generator" : "height") +
                                                    " and world contradict each other, expected one of them");
  }
  if (!generated && !read && !world) {
    return context.fail_at(
        table, "[terrain] has no ground, expected generator = \"meadow\", height = \"FILE\" or world = \"FOLDER\"");
  }
  if (scene.source == TerrainSource::clipmap) {
    const auto no_mesh = refuse(table, {"max_triangles", "target_px"},
                                "on a clipmap, whose triangles are those of its rings, expected only with source = "
                                "\"roam\"",
                                context);
    if (!no_mesh) return no_mesh;
  }
  if (!world) {
    const auto no_world =
        refuse(table, {"memory_mb", "worth_px"}, "on ground that is no world, expected only with world", context);
    if (!no_world) return no_world;
  }
  if (world) {
    const auto baked =
        refuse(table, {"spacing_m", "height_scale_m", "height_offset_m", "no_data", "origin_m", "relief"},
               "on a world, which was baked with its own, expected only with height", context);
    if (!baked) return baked;
  }
  if (generated) {
    return refuse(table, {"spacing_m", "height_scale_m", "height_offset_m", "no_data", "origin_m"},
                  "on generated terrain, expected only with height", context);
  }
  return refuse(table, {"seed", "samples", "size_m"},
                world ? "on a world, expected only with generator" : "on a height file, expected only with generator",
                context);
}

// ---- [[layer.species]] ----

Key<Species> hex_color_key() {
  return {"color",
          "\"#rrggbb\"",
          [](const toml::node& node, Species& species) {
            const auto hsv = hsv_of_hex(node);
            if (hsv) species.reference_hsv = *hsv;
            return hsv.has_value();
          },
          {}};
}

Key<Species> hsv_key() {
  const Interval hue{.low = 0, .high = 360, .high_open = true};
  return {"hsv",
          "[hue, saturation, value] in [0, 360) degrees, [0, 1], [0, 1]",
          [=](const toml::node& node, Species& species) {
            const auto hsv = as_numbers<3>(node, {hue, within(0, 1), within(0, 1)});
            if (!hsv) return false;
            // Rounding to float must not make a full turn of the largest hue below 360.
            const float turns = float((*hsv)[0] / 360.0);
            species.reference_hsv = {turns < 1.0f ? turns : 0.0f, float((*hsv)[1]), float((*hsv)[2])};
            return true;
          },
          {}};
}

Key<Species> weights_key() {
  Key<Species> key = triple("weights", &Species::weights, within(0, 100));
  key.expected += ", not all 0: of hue, saturation, value";
  key.read = [read = key.read](const toml::node& node, Species& species) {
    return read(node, species) && species.weights != glm::vec3(0);
  };
  return key;
}

/// An image on the plant, and where the scene names it.
Key<Species> plant_image_key(const std::string& name, PlantImageFile Species::*member, const std::string& expected) {
  return {name, expected, {}, [=](const toml::node& node, Species& species, const Context& context) -> Expected<void> {
            const auto* value = node.as_string();
            if (value == nullptr || value->get().empty()) {
              return context.fail_at(node, name + " = " + quoted(node) + " in [[layer.species]]: expected " + expected);
            }
            species.*member = {value->get(), context.file + ":" + std::to_string(node.source().begin.line)};
            return {};
          }};
}

std::string detail_expected() {
  std::string names;
  for (const std::string_view name : built_in_details()) names += "\"" + std::string(name) + "\" or ";
  return names + "the path of an image";
}

// ---- [layer.species.tuft], [layer.species.flower], [layer.species.custom] ----

/// `#rrggbb` as sRGB, 0..1.
Key<FlowerShape> color_key(std::string name, glm::vec3 FlowerShape::*member) {
  return {std::move(name),
          "\"#rrggbb\"",
          [=](const toml::node& node, FlowerShape& flower) {
            const auto color = rgb_of_hex(node);
            if (color) flower.*member = *color;
            return color.has_value();
          },
          {}};
}

/// A key of a season's values, read as the species' key of the same name.
template <class V>
Key<SeasonFrame> as_season(Key<Species> key, V SeasonValues::*to, V Species::*from) {
  return {key.name,
          key.expected,
          [=](const toml::node& node, SeasonFrame& frame) {
            Species read;
            if (!key.read(node, read)) return false;
            frame.values.*to = read.*from;
            return true;
          },
          {}};
}

Key<FlowerShape> stem_key() {
  Key<FlowerShape> key = color_key("stem_color", &FlowerShape::stem_color);
  key.read = [read = key.read](const toml::node& node, FlowerShape& flower) {
    flower.own_stem = read(node, flower);
    return flower.own_stem;
  };
  return key;
}

Key<FlowerShape> petal_colors_key() {
  return {"petal_colors",
          "a list of 1 to 4 colours \"#rrggbb\"",
          [](const toml::node& node, FlowerShape& flower) {
            const toml::array* array = node.as_array();
            if (array == nullptr || array->empty() || array->size() > size_t(k_most_petal_colors)) return false;
            flower.petal_colors.clear();
            for (const toml::node& element : *array) {
              const auto color = rgb_of_hex(element);
              if (!color) return false;
              flower.petal_colors.push_back(*color);
            }
            return true;
          },
          {}};
}

/// A list of numbers in a range, at most so many.
template <class T>
Key<T> numbers(std::string name, std::vector<float> T::*member, Interval range, size_t most) {
  return {std::move(name),
          "a list of at most " + std::to_string(most) + " numbers" + range.text(),
          [=](const toml::node& node, T& target) {
            const toml::array* array = node.as_array();
            if (array == nullptr || array->size() > most) return false;
            (target.*member).clear();
            for (const toml::node& element : *array) {
              const auto value = as_number(element);
              float read = 0;
              if (!value || !store(*value, range, read)) return false;
              (target.*member).push_back(read);
            }
            return true;
          },
          {}};
}

Key<TuftShape> blades_key() {
  const Interval range = within(1, 9);
  return {"blades",
          "[min, max], two whole numbers" + range.text() + " with min <= max",
          [=](const toml::node& node, TuftShape& tuft) {
            const toml::array* array = node.as_array();
            if (array == nullptr || array->size() != 2) return false;
            const auto low = as_whole_number((*array)[0], range), high = as_whole_number((*array)[1], range);
            if (!low || !high || *low > *high) return false;
            tuft.blades = {int(*low), int(*high)};
            return true;
          },
          {}};
}

Expected<void> check_flower(const toml::table& table, const FlowerShape& flower, const Context& context) {
  const auto& shares = flower.petal_shares;
  if (shares.empty()) return {};
  if (shares.size() != flower.petal_colors.size()) {
    return context.fail_at(*table.get("petal_shares"),
                           "there are " + std::to_string(shares.size()) + " petal_shares, expected one for each of " +
                               std::to_string(flower.petal_colors.size()) + " petal_colors");
  }
  if (std::all_of(shares.begin(), shares.end(), [](float share) { return share == 0; })) {
    return context.fail_at(*table.get("petal_shares"), "petal_shares are all 0, expected at least one that is more");
  }
  return {};
}

Key<SeasonFrame> season_share(const std::string& name, float SeasonValues::*member) {
  return {name,
          "a number in [0, 1]",
          [=](const toml::node& node, SeasonFrame& frame) {
            const auto value = as_number(node);
            return value && store(*value, within(0, 1), frame.values.*member);
          },
          {}};
}

/// A list of frames, each of which starts as `first` makes it and stands later in the year than the one before.
template <class T, class Frame, class First>
Key<T> frames(std::string name, std::vector<Frame> T::*member, Schema<Frame> schema, First first) {
  const std::string expected = "a list of tables, each headed " + schema.title;
  return {name, expected, {}, [=](const toml::node& node, T& target, const Context& context) -> Expected<void> {
            const toml::array* array = node.as_array();
            if (array == nullptr) return context.fail_at(node, name + " is no list: expected " + expected);
            for (const toml::node& element : *array) {
              if (!element.is_table()) return context.fail_at(element, quoted(element) + ": expected " + expected);
              Frame frame = first(target);
              if (auto read = read_fields(*element.as_table(), schema, frame, context); !read) return read;
              const bool later = (target.*member).empty() || frame.at > (target.*member).back().at;
              if (!later) return context.fail_at(element, "at is not above that of the frame before");
              (target.*member).push_back(frame);
            }
            return {};
          }};
}

/// A frame of a species begins as the species is: so the species' own keys must have been read.
Expected<void> check_season_order(const toml::table& table, const Context& context) {
  bool seasons = false;
  for (const auto& [name, node] : entries_in_order(table)) {
    if (name->str() == "season") seasons = true;
    for (const char* key : {"color", "hsv", "tint", "age_tint", "age_share"}) {
      if (seasons && name->str() == key)
        return context.fail_at(name->source(), std::string(key) + " stands after season, expected before it");
    }
  }
  return {};
}

Expected<void> check_custom(const toml::table& table, const CustomKind&, const Context& context) {
  if (table.contains("functions")) return {};
  return context.fail_at(table, "[layer.species.custom] has no functions, expected functions = \"FILE\"");
}

/// Tables of a kind stand only with that kind; a custom one needs its.
Expected<void> check_kind_tables(const toml::table& table, const Species& species, const Context& context) {
  const std::pair<const char*, PlantKind> owners[] = {{"tuft", PlantKind::tuft},
                                                      {"flower", PlantKind::flower},
                                                      {"custom", PlantKind::custom},
                                                      {"mesh", PlantKind::mesh}};
  for (const auto& [name, kind] : owners) {
    if (species.kind == kind) continue;
    const std::string because = "on another kind, expected only with kind = \"" + std::string(name) + "\"";
    if (auto fits = refuse(table, {name}, because, context); !fits) return fits;
  }
  if (species.kind == PlantKind::mesh && !table.contains("mesh")) {
    return context.fail_at(table, "species \"" + species.name +
                                      "\" has no mesh, expected [layer.species.mesh] with file = \"FILE\" or shape");
  }
  if (species.kind == PlantKind::custom && !table.contains("custom")) {
    return context.fail_at(table, "species \"" + species.name +
                                      "\" has no functions, expected [layer.species.custom] with functions = \"FILE\"");
  }
  return {};
}

/// Kinds whose outline an image can take the place of.
Expected<void> check_cutout(const toml::table& table, PlantKind kind, const Context& context) {
  for (const PlantKind outlined :
       {PlantKind::blade, PlantKind::tuft, PlantKind::leaf, PlantKind::fern, PlantKind::billboard})
    if (kind == outlined) return {};
  return refuse(table, {"cutout"},
                "here, expected only with kind = \"blade\", \"tuft\", \"leaf\", \"fern\" or \"billboard\"", context);
}

/// Keys that say nothing to the species' kind.
Expected<void> check_kind(const toml::table& table, const Species& species, const Context& context) {
  const PlantKind kind = species.kind;
  if (auto fits = check_cutout(table, kind, context); !fits) return fits;
  if (kind == PlantKind::gravel) {
    auto fits = refuse(table,
                       {"stiffness", "lean_deg", "phototropism", "translucency", "attenuation", "detail",
                        "detail_strength", "detail_repeat", "cutout"},
                       "on stones (kind = \"gravel\")", context);
    if (!fits) return fits;
  }
  if (kind == PlantKind::mesh) {
    auto fits = refuse(table, {"segments", "detail", "detail_strength", "detail_repeat"},
                       "on plants that are meshes (kind = \"mesh\")", context);
    if (!fits) return fits;
  }
  if (kind == PlantKind::litter) {
    auto fits = refuse(table, {"lean_deg", "phototropism"}, "on what lies flat (kind = \"litter\")", context);
    if (!fits) return fits;
  }
  if (kind == PlantKind::billboard) {
    auto fits = refuse(table, {"stiffness"}, "on shrubs and trees (kind = \"billboard\")", context);
    if (!fits) return fits;
  } else if (auto fits =
                 refuse(table, {"trunk_share", "taper"}, "here, expected only with kind = \"billboard\"", context);
             !fits) {
    return fits;
  }
  if (kind == PlantKind::leaf || kind == PlantKind::fern) return {};
  return refuse(table, {"leaves"}, "here, expected only with kind = \"leaf\" or \"fern\"", context);
}

Expected<void> check_at(const toml::table& table, const Context& context) {
  if (table.contains("at")) return {};
  return context.fail_at(table, "a season's frame has no time of the year, expected at = 0 to 1");
}

Expected<void> check_species(const toml::table& table, const Species& species, const Context& context) {
  if (!table.contains("name")) return context.fail_at(table, "a species has no name, expected name = \"...\"");
  if (auto ordered = check_season_order(table, context); !ordered) return ordered;
  if (table.contains("color") && table.contains("hsv")) {
    return context.fail_at(*table.get("hsv"), "color and hsv contradict each other, expected one of them");
  }
  if (!table.contains("color") && !table.contains("hsv")) {
    return context.fail_at(table,
                           "species \"" + species.name +
                               "\" has no colour, expected color = \"#rrggbb\" or hsv = [hue, saturation, value]");
  }
  if (auto fits = check_kind_tables(table, species, context); !fits) return fits;
  if (species.kind == PlantKind::none) {
    return refuse(table, {"height_m",     "width_m",     "stiffness", "lean_deg",        "phototropism",
                          "segments",     "tint",        "age_tint",  "age_share",       "root_shade",
                          "translucency", "attenuation", "specular",  "shininess",       "leaves",
                          "trunk_share",  "taper",       "detail",    "detail_strength", "detail_repeat",
                          "cutout",       "resistance"},
                  "where nothing grows (kind = \"none\")", context);
  }
  if (auto fits = refuse(table, {"forbids"}, "on what grows, expected only with kind = \"none\"", context); !fits) {
    return fits;
  }
  return check_kind(table, species, context);
}

// ---- [[exclude]] ----

Key<ExclusionShape> disc_key() {
  return {"disc",
          "[x, y, radius], finite numbers (metres), the radius in (0, 1000000]",
          [](const toml::node& node, ExclusionShape& shape) {
            const auto disc = as_numbers<3>(node, {any_number(), any_number(), above_to(0, 1e6)});
            if (!disc) return false;
            shape.centre = {(*disc)[0], (*disc)[1]};
            shape.radius_m = (*disc)[2];
            return true;
          },
          {}};
}

Key<ExclusionShape> polygon_key() {
  return {"polygon",
          "a list of 3 to 4096 corners [x, y], finite numbers (metres)",
          [](const toml::node& node, ExclusionShape& shape) {
            const toml::array* array = node.as_array();
            if (array == nullptr || array->size() < 3 || array->size() > 4096) return false;
            for (const toml::node& element : *array) {
              const auto corner = as_numbers<2>(element, {any_number(), any_number()});
              if (!corner) return false;
              shape.corners.emplace_back((*corner)[0], (*corner)[1]);
            }
            return true;
          },
          {}};
}

Expected<void> check_exclude(const toml::table& table, const ExclusionShape& shape, const Context& context) {
  if (auto valid = shape.validate(); !valid) return context.fail_at(table, valid.error().message);
  return {};
}

// ---- [[layer]] ----

Expected<void> check_layer(const toml::table& table, const Layer& layer, const Context& context) {
  if (layer.species.empty()) {
    return context.fail_at(table, "layer \"" + layer.name + "\" has no species, expected [[layer.species]]");
  }
  if (auto distinct = refuse_same_names(table, "species", context); !distinct) return distinct;
  if (layer.law == DensityLaw::distance) {
    const std::string because = "under law = \"distance\", expected only with screen_area or world_area";
    if (auto fits = refuse(table, {"ceiling"}, because, context); !fits) return fits;
  } else if (layer.plain) {
    const std::string because =
        "under this law in a plain layer, expected only with law = \"distance\" or plain = false";
    if (auto fits = refuse(table, {"full_distance_m"}, because, context); !fits) return fits;
  }
  if (layer.law == DensityLaw::world_area) {
    const std::string because = "under law = \"world_area\", expected only with distance or screen_area";
    if (auto fits = refuse(table, {"falloff"}, because, context); !fits) return fits;
  }
  if (layer.on_mesh) {
    const std::string because = "on meshes, where plants cast no planar shadows";
    if (auto fits = refuse(table, {"shadows", "shadow_distance_m"}, because, context); !fits) return fits;
  }
  if (!layer.shadows) {
    const std::string because = "with shadows = false";
    if (auto fits = refuse(table, {"shadow_distance_m"}, because, context); !fits) return fits;
  }
  if (auto valid = validate(layer); !valid) return context.fail_at(table, valid.error().message);
  return {};
}

Expected<void> check_scene(const toml::table& table, const Scene& scene, const Context& context) {
  if (!table.contains("terrain")) {
    return context.fail_at(table,
                           "the scene has no [terrain], expected one with generator = \"meadow\", height = \"FILE\" "
                           "or world = \"FOLDER\"");
  }
  for (const ExclusionShape& shape : scene.exclusions) {
    const auto named = [&](const Layer& layer) { return layer.name == shape.layer; };
    if (!shape.layer.empty() && std::none_of(scene.layers.begin(), scene.layers.end(), named))
      return context.fail_at(*table.get("exclude"), "there is no layer \"" + shape.layer + "\" to exclude");
  }
  if (auto covered = check_surfaces(table, scene, context); !covered) return covered;
  return refuse_same_names(table, "layer", context);
}

}  // namespace

const Schema<ReliefOptions>& relief_schema() {
  using R = ReliefOptions;
  static const Schema<R> schema{
      "[terrain.relief]",
      {flag("enabled", &R::enabled), flag("smooth", &R::smooth), number("roughness", &R::roughness, within(0, 0.5)),
       number("flat_share", &R::flat_share, within(0, 1)),
       number("full_slope", &R::full_slope, above(0), "rise over run"),
       number("finest_edge_m", &R::finest_edge_m, within(0.1, 100), "metres"),
       whole_number("seed", &R::seed, within(0, k_most_uint32))},
      {}};
  return schema;
}

const Schema<Scene>& terrain_schema() {
  static const Schema<Scene> schema{
      "[terrain]",
      {choice<Scene, std::string>("generator", &Scene::generator, {{"meadow", "meadow"}}),
       whole_number("seed", &Scene::generator_seed, within(0, k_most_uint32)),
       whole_number("samples", &Scene::generator_samples, within(65, 8193)),
       number("size_m", &Scene::generator_size_m, above(0), "metres"),
       text("height", &Scene::height_path, "the path of an image"), spacing_key(),
       number("height_scale_m", &Scene::height_scale, {.not_zero = true}, "metres a raw unit"),
       number("height_offset_m", &Scene::height_offset, any_number(), "metres"), no_data_key(),
       triple("origin_m", &Scene::origin, any_number(), "metres"),
       text("world", &Scene::world_path, "the path of a folder"),
       number("memory_mb", &Scene::world_memory_mb, above_to(0, 1e9), "megabytes"),
       number("worth_px", &Scene::world_worth_px, at_least(0), "pixels"),
       whole_number("max_triangles", &Scene::max_triangles, within(2, k_most_uint32)),
       number("target_px", &Scene::target_px, at_least(0), "pixels"),
       choice<Scene, TerrainSource>("source", &Scene::source,
                                    {{"roam", TerrainSource::roam}, {"clipmap", TerrainSource::clipmap}}),
       table<Scene, ReliefOptions>("relief", &Scene::relief, relief_schema()), flag("splatting", &Scene::splatting),
       materials_key()},
      check_terrain};
  return schema;
}

const Schema<Scene>& base_map_schema() {
  static const Schema<Scene> schema{"[base_map]", {text("texture", &Scene::texture_path, "the path of an image")}, {}};
  return schema;
}

const Schema<Scene>& sun_schema() {
  static const Schema<Scene> schema{"[sun]",
                                    {angle("azimuth_deg", &Scene::sun_azimuth, within(-360, 360)),
                                     angle("elevation_deg", &Scene::sun_elevation, within(-90, 90))},
                                    {}};
  return schema;
}

const Schema<Scene>& haze_schema() {
  static const Schema<Scene> schema{"[haze]", {number("distance_m", &Scene::haze_distance_m, above(0), "metres")}, {}};
  return schema;
}

const Schema<Scene>& camera_schema() {
  static const Schema<Scene> schema{
      "[camera]",
      {triple("position_m", &Scene::camera, any_number(), "metres"), flag("above_ground", &Scene::camera_above_ground),
       angle("yaw_deg", &Scene::camera_yaw, within(-360, 360)),
       angle("pitch_deg", &Scene::camera_pitch, within(-90, 90)), angle("fov_deg", &Scene::fov_y, within(1, 170))},
      {}};
  return schema;
}

const Schema<TuftShape>& tuft_schema() {
  static const Schema<TuftShape> schema{
      "[layer.species.tuft]", {blades_key(), angle("spread_deg", &TuftShape::spread, within(0, 90))}, {}};
  return schema;
}

const Schema<FlowerShape>& flower_schema() {
  using F = FlowerShape;
  static const Schema<F> schema{
      "[layer.species.flower]",
      {petal_colors_key(), numbers("petal_shares", &F::petal_shares, within(0, 1e6), k_most_petal_colors),
       whole_number("petals", &F::petals, within(3, 32)), number("petal_width", &F::petal_width, within(0.1, 2)),
       number("cup", &F::cup, within(-1, 1.5)), min_max("head_m", &F::head_m, within(0.001, 10), "metres"),
       color_key("centre_color", &F::centre_color), number("centre_share", &F::centre_share, within(0, 0.9)),
       stem_key(), whole_number("leaves", &F::leaves, within(0, 8))},
      check_flower};
  return schema;
}

const Schema<CustomKind>& custom_schema() {
  using C = CustomKind;
  static const Schema<C> schema{"[layer.species.custom]",
                                {text("functions", &C::functions, "the path of a file of GLSL functions"),
                                 whole_number("shoots", &C::shoots, within(1, k_most_shoots)),
                                 numbers("parameters", &C::parameters, any_number(), k_most_parameters)},
                                check_custom};
  return schema;
}

const Schema<Species>& species_schema() {
  using S = Species;
  static const Schema<S> schema{
      "[[layer.species]]",
      {text("name", &S::name, "a word"),
       choice<S, PlantKind>("kind", &S::kind,
                            {{"blade", PlantKind::blade},
                             {"none", PlantKind::none},
                             {"tuft", PlantKind::tuft},
                             {"flower", PlantKind::flower},
                             {"custom", PlantKind::custom},
                             {"gravel", PlantKind::gravel},
                             {"leaf", PlantKind::leaf},
                             {"fern", PlantKind::fern},
                             {"litter", PlantKind::litter},
                             {"billboard", PlantKind::billboard},
                             {"mesh", PlantKind::mesh}}),
       hex_color_key(),
       hsv_key(),
       weights_key(),
       number("exponent", &S::exponent, above_to(0, 8)),
       number("threshold", &S::max_distance, {.low = 1e-4, .infinite = true}, "weighted colour distance"),
       flag("forbids", &S::forbids),
       min_max("height_m", &S::height_m, within(0.001, 200), "metres"),
       min_max("width_m", &S::width_m, within(0.00001, 200), "metres"),
       min_max("stiffness", &S::stiffness, within(0, 1)),
       angle("lean_deg", &S::lean, within(0, 90)),
       number("phototropism", &S::phototropism, within(0, 1)),
       whole_number("segments", &S::max_segments, within(1, 64)),
       triple("tint", &S::tint, within(0, 10000)),
       triple("age_tint", &S::age_tint, within(0, 10000)),
       number("age_share", &S::age_share, within(0, 1)),
       number("root_shade", &S::root_shade, within(0, 1)),
       number("translucency", &S::translucency, within(0, 10000)),
       number("attenuation", &S::attenuation, within(0, 10000)),
       number("specular", &S::specular, within(0, 10000)),
       number("shininess", &S::shininess, within(1, 10000)),
       resistance_key(),
       plant_image_key("detail", &S::detail_file, detail_expected()),
       number("detail_strength", &S::detail_strength, within(0, 1)),
       number("detail_repeat", &S::detail_repeat, within(0.1, 100)),
       plant_image_key("cutout", &S::cutout_file, "the path of an image"),
       whole_number("leaves", &S::leaves, within(1, 8)),
       number("trunk_share", &S::trunk_share, within(0, 0.9)),
       number("taper", &S::taper, within(0, 1)),
       table<S, TuftShape>("tuft", &S::tuft, tuft_schema()),
       table<S, FlowerShape>("flower", &S::flower, flower_schema()),
       table<S, CustomKind>("custom", &S::custom, custom_schema()),
       table<S, PlantMesh>("mesh", &S::mesh, plant_mesh_schema()),
       min_max_angle("slope_deg", &S::slope, within(0, 90)),
       angle("slope_soft_deg", &S::slope_soft, within(0, 90)),
       min_max("altitude_m", &S::altitude_m, any_number(), "metres"),
       number("altitude_soft_m", &S::altitude_soft_m, at_least(0), "metres"),
       number("above_water_m", &S::above_water_m, any_number(), "metres"),
       text("mask", &S::mask_file, "the path of an image"),
       frames("season", &S::seasons, species_season_schema(),
              [](const S& s) {
                return SeasonFrame{0.0f, {s.reference_hsv, s.tint, s.age_tint, s.age_share, 1.0f, 1.0f}};
              })},
      check_species};
  return schema;
}

const Schema<SeasonFrame>& species_season_schema() {
  using S = Species;
  using V = SeasonValues;
  static const Schema<SeasonFrame> schema{
      "[[layer.species.season]]",
      {number("at", &SeasonFrame::at, {.low = 0, .high = 1, .high_open = true}),
       as_season(hex_color_key(), &V::reference_hsv, &S::reference_hsv),
       as_season(hsv_key(), &V::reference_hsv, &S::reference_hsv),
       as_season(triple("tint", &S::tint, within(0, 10000)), &V::tint, &S::tint),
       as_season(triple("age_tint", &S::age_tint, within(0, 10000)), &V::age_tint, &S::age_tint),
       as_season(number("age_share", &S::age_share, within(0, 1)), &V::age_share, &S::age_share),
       season_share("height", &V::height), season_share("density", &V::density)},
      [](const toml::table& table, const SeasonFrame&, const Context& context) { return check_at(table, context); }};
  return schema;
}

const Schema<GroundSeason>& ground_season_schema() {
  static const Schema<GroundSeason> schema{
      "[[season.ground]]",
      {number("at", &GroundSeason::at, {.low = 0, .high = 1, .high_open = true}),
       triple("tint", &GroundSeason::tint, within(0, 10000))},
      [](const toml::table& table, const GroundSeason&, const Context& context) { return check_at(table, context); }};
  return schema;
}

const Schema<Scene>& season_schema() {
  static const Schema<Scene> schema{
      "[season]",
      {number("at", &Scene::season, within(0, 1)),
       frames("ground", &Scene::ground_seasons, ground_season_schema(), [](const Scene&) { return GroundSeason{}; })},
      {}};
  return schema;
}

const Schema<ExclusionShape>& exclude_schema() {
  static const Schema<ExclusionShape> schema{
      "[[exclude]]", {text("layer", &ExclusionShape::layer, "a word"), disc_key(), polygon_key()}, check_exclude};
  return schema;
}

const Schema<Layer>& layer_schema() {
  using L = Layer;
  static const Schema<L> schema{
      "[[layer]]",
      {text("name", &L::name, "a word"),
       number("triangle_area_m2", &L::triangle_area_m2, above(0), "square metres"),
       number("horizon_m", &L::horizon_m, above(0), "metres"),
       whole_number("cluster_size", &L::cluster_size, within(1, k_max_cluster_size)),
       choice<L, DensityLaw>("law", &L::law,
                             {{"distance", DensityLaw::distance},
                              {"screen_area", DensityLaw::screen_area},
                              {"world_area", DensityLaw::world_area}}),
       number("density", &L::density, above(0), "plants a square metre or a unit of screen area"),
       number("full_distance_m", &L::full_distance_m, above(0), "metres"),
       number("falloff", &L::falloff, above_to(0, 16)),
       whole_number("ceiling", &L::ceiling, within(1, 1048576)),
       flag("plain", &L::plain),
       flag("on_mesh", &L::on_mesh),
       number("full_segments_m", &L::full_segments_m, above(0), "metres"),
       flag("shadows", &L::shadows),
       number("shadow_distance_m", &L::shadow_distance_m, at_least(0), "metres"),
       number("water_level_m", &L::water_level_m, any_number(), "metres"),
       text("mask", &L::mask_file, "the path of an image"),
       text("height_map", &L::height_map_file, "the path of an image"),
       number("height_tile_m", &L::height_tile_m, within(0.1, 100000), "metres"),
       number("height_least", &L::height_least, within(0, 1)),
       text("distribution", &L::distribution_file, "the path of an image"),
       tables<L, Species>("species", &L::species, species_schema())},
      check_layer};
  return schema;
}

const Schema<Scene>& scene_schema() {
  static const Schema<Scene> schema{
      "the scene",
      {text("name", &Scene::name, "a word"), section("terrain", terrain_schema()),
       section("base_map", base_map_schema()), section("sun", sun_schema()), section("haze", haze_schema()),
       section("camera", camera_schema()), tables<Scene, Layer>("layer", &Scene::layers, layer_schema()),
       section("season", season_schema()),
       tables<Scene, ExclusionShape>("exclude", &Scene::exclusions, exclude_schema()),
       tables<Scene, SceneSurface>("surface", &Scene::surfaces, surface_schema()),
       table<Scene, SceneDisturbance>("disturbance", &Scene::disturbance, disturbance_schema()), wind_key()},
      check_scene};
  return schema;
}

}  // namespace sward::scene_file
