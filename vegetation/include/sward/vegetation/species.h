// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/terrain/color_map.h>
#include <sward/terrain/error.h>
#include <sward/vegetation/placement.h>
#include <sward/vegetation/plant_image.h>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sward {

/// What grows (or not) where the ground has a species' colour. What sizes and colours mean to each kind:
/// docs/scene_format.md, "Kinds".
enum class PlantKind : uint32_t {
  none,       ///< Bare ground: soil, rock, snow. Competes for clusters, grows nothing.
  blade,      ///< A blade of grass.
  tuft,       ///< Blades fanned out from one root: Species::tuft.
  flower,     ///< A stem with a head at its end: Species::flower.
  custom,     ///< A host's own, made of shoots by its GLSL functions: Species::custom.
  gravel,     ///< A faceted stone, a third of it in the ground.
  leaf,       ///< A rosette of broad leaves.
  fern,       ///< A rosette of fronds.
  litter,     ///< A dead leaf or a twig, flat on the ground.
  billboard,  ///< A shrub or a tree: a trunk and clusters of leaves that face the eye.
  mesh,       ///< A small mesh with a height coordinate: Species::mesh.
};

struct FloatRange {
  float min = 0, max = 0;
};
struct IntRange {
  int min = 0, max = 0;
};

/// Of PlantKind::tuft. The species' height is its tallest blade's, its width a blade's.
struct TuftShape {
  IntRange blades{4, 7};  ///< Of a seed, each number as likely: 1..9. Fewer and wider ones with distance.
  float spread = 0.7f;    ///< Largest lean of a blade at the root, radians, 0..pi/2.
};

/// Of PlantKind::flower. The species' height, width, stiffness are the stem's; heads look along its end, up, and by
/// phototropism at the sun. Colours are sRGB, 0..1, and not the ground's.
struct FlowerShape {
  std::vector<glm::vec3> petal_colors{{0.95f, 0.94f, 0.90f}};  ///< 1..4; each plant picks one by its own number.
  std::vector<float> petal_shares;  ///< Of plants, by colour, in proportion; one a colour, >= 0; empty: equal shares.
  int petals = 13;                  ///< 3..32.
  float petal_width = 1.0f;         ///< 1: neighbours nearly meet; 0.1..2.
  float cup = 0.15f;                ///< How far petals rise: 0 flat, 1 a bowl as deep as its radius, < 0 hang; -1..1.5.
  FloatRange head_m{0.03f, 0.045f};  ///< Diameter, metres, 0.001..10.
  glm::vec3 centre_color{0.92f, 0.72f, 0.12f};
  float centre_share = 0.3f;  ///< Radius of the centre against the head's, 0..0.9.
  bool own_stem = false;      ///< Stem and leaves have stem_color, else the ground's as grass has.
  glm::vec3 stem_color{0.36f, 0.48f, 0.22f};
  int leaves = 0;  ///< At the foot of the stem, 0..8.
};

/// Of PlantKind::custom.
struct CustomKind {
  /// Name of a file of GLSL functions in the renderer's ShaderLibrary (see shaders/common_shoot.glsl for what it must
  /// define). Not empty.
  std::string functions;
  int shoots = 1;  ///< Most shoots that kind_shoots answers, 1..12.
  /// At most 16, finite; functions find them in own_a..own_d of SpeciesParams, 0 where missing.
  std::vector<float> parameters;
};

/// Where a scene says that a plant's image comes from. Read by those who load scenes, not here.
struct PlantImageFile {
  std::string path;   ///< Of an image, or one of built_in_details(); empty: none.
  std::string place;  ///< Where it says so, for messages: "FILE:LINE".
};

struct TriangleMesh;  // mesh_surface.h

/// Of PlantKind::mesh: bent along its axis, z from the lowest position to the highest, as a blade is; that axis is
/// scaled to the species' height, twice the largest distance from it to its width. Colours are the vertices', times the
/// tint.
struct PlantMesh {
  std::shared_ptr<const TriangleMesh> mesh;  ///< At most 512 faces, a colour each position. Null: not loaded.
  std::vector<float> heights;  ///< How far up the axis each position bends, 0..1; empty: as high as it stands. What has
                               ///< one coordinate stays rigid.
  std::string file;            ///< For those who load scenes, as Species::mask_file: an OBJ, PLY or OFF file, or
  std::string shape;           ///< a generated one (generate_plant_shape).
};

/// No bound of a range.
inline constexpr float k_unbounded = std::numeric_limits<float>::infinity();

/// What a season makes of a species.
struct SeasonValues {
  glm::vec3 reference_hsv{0.25f, 0.5f, 0.4f};  ///< As Species::reference_hsv.
  glm::vec3 tint{1.0f};
  glm::vec3 age_tint{1.25f, 1.05f, 0.55f};
  float age_share = 0.35f;
  float height = 1.0f;   ///< Share of Species::height_m, 0..1.
  float density = 1.0f;  ///< Share of the layer's density, 0..1: the last ranks go first, shrinking.
};

/// The values at one time of the year.
struct SeasonFrame {
  float at = 0;  ///< [0, 1); rising from frame to frame.
  SeasonValues values;
};

/// A reference colour, placement rules and growth parameters (Papavasiliou 2015, section 3.3).
struct Species {
  std::string name;
  PlantKind kind = PlantKind::blade;
  /// Reference colour: hue in turns [0, 1), saturation and value [0, 1], of the sRGB-encoded base map.
  glm::vec3 reference_hsv{0.25f, 0.5f, 0.4f};
  /// Weights of the differences in hue, saturation, value (equation 16). >= 0, not all 0.
  glm::vec3 weights{1.0f, 0.5f, 0.25f};
  /// p of equation 16. > 0.
  float exponent = 2.0f;
  /// Largest accepted weighted colour distance; beyond it the species does not compete. > 0, may be infinite.
  float max_distance = 1.0e9f;
  /// For kind `none`: where this species scores best nothing grows at all, not even by chance (water, runways).
  bool forbids = false;

  FloatRange height_m{0.25f, 0.45f};
  FloatRange width_m{0.004f, 0.008f};       ///< At the base.
  FloatRange stiffness{0.45f, 0.85f};       ///< 0: hangs, 1: stands straight (see blade_shape.h).
  float lean = 0.15f;                       ///< Largest random lean of the root, radians.
  float phototropism = 0.0f;                ///< 0: any azimuth; 1: all plants bend towards the sun.
  int max_segments = 7;                     ///< n_max of equation 4, 1..64.
  glm::vec3 tint{1.0f};                     ///< Multiplies the ground's linear colour: the fresh plant's tip.
  glm::vec3 age_tint{1.25f, 1.05f, 0.55f};  ///< The same for the oldest plants; each plant mixes by its own age.
  float age_share = 0.35f;                  ///< Mean share of the age tint, 0..1.
  float root_shade = 0.35f;                 ///< Reeves' occlusion: brightness at the root against 1 at the tip, 0..1.
  float translucency = 0.6f;                ///< k_t of equation 13 against the diffuse coefficient, >= 0.
  float attenuation = 0.4f;                 ///< alpha of equation 13, >= 0.
  float specular = 0.12f;                   ///< k_s of equation 14, >= 0.
  float shininess = 24.0f;                  ///< n of equation 14, >= 1.
  /// Against feet, wheels, blasts and mowers (Disturbance), 0 yields .. 1 stands; empty: by kind and height, see
  /// resistance_of().
  std::optional<float> resistance;

  PlantMesh mesh;  ///< Read for kind mesh alone.
  TuftShape tuft;  ///< Read for kind tuft alone, the next for flower and custom.
  FlowerShape flower;
  CustomKind custom;
  int leaves = 6;            ///< Kinds leaf and fern: leaves or fronds of a plant, 1..8.
  float trunk_share = 0.3f;  ///< Kind billboard: share of the height below the crown, 0..0.9; 0: a shrub.
  float taper = 0.0f;        ///< Kind billboard: crown's outline from 0, an ellipse, to 1, a cone.

  // Images on the plant (PlantImage). Kinds none and gravel have no detail; cutouts are for blade, tuft, leaf, fern and
  // billboard, whose own outlines they replace.
  std::shared_ptr<const PlantImage> detail;  ///< On the colour: half grey changes nothing. Null: none.
  float detail_strength = 0.35f;             ///< Black and white change the colour by so much, 0..1.
  float detail_repeat = 1.0f;                ///< Times that the image lies along the plant, 0.1..100.
  std::shared_ptr<const PlantImage> cutout;  ///< What is darker than half grey is not there. Null: none.
  PlantImageFile detail_file, cutout_file;

  // Placement rules. Each is a factor 0..1 on the score, asked at a cluster's centre; each seed then asks again at its
  // own place, and stands with the probability of the factor there: nowhere where it is 0.
  FloatRange slope{0.0f, k_unbounded};               ///< Of the data at the seeding triangle, radians.
  float slope_soft = 0.0f;                           ///< The factor falls to 0 so far beyond the range, radians, >= 0.
  FloatRange altitude_m{-k_unbounded, k_unbounded};  ///< World z of the finest data.
  float altitude_soft_m = 0.0f;                      ///< As slope_soft, metres.
  float above_water_m = -k_unbounded;                ///< Least height above Layer::water_level_m; may be negative.
  std::shared_ptr<const GrayMap> mask;               ///< Null: none.
  std::string
      mask_file;  ///< For those who load scenes: where `mask` comes from. Not read here; without `mask`, an error.

  std::vector<SeasonFrame> seasons;  ///< In the order of the year; empty: the species' own values all year.
};

enum class DensityLaw : uint32_t {
  distance,     ///< Full density to d0, then rho0 (d0 / d)^gamma.
  screen_area,  ///< Equation 1 of the paper.
  world_area,   ///< Equation 2, sign mended.
};

/// Species that share a seeding level and a horizon.
struct Layer {
  std::string name = "ground_cover";
  std::vector<Species> species;
  float triangle_area_m2 = 1.6f;  ///< Names the seeding level. > 0.
  float horizon_m = 100.0f;       ///< > 0, at zoom 1.
  int cluster_size = 8;           ///< C, 1..32.
  DensityLaw law = DensityLaw::distance;
  float density = 500.0f;        ///< rho0: plants a square metre (distance); plants a unit of screen area (screen_area,
                                 ///< world_area). > 0.
  float full_distance_m = 5.0f;  ///< d0 of the distance law; the others, unless plain, count what is nearer than
                                 ///< twice this as being there. > 0.
  float falloff = 1.0f;          ///< gamma of the distance law; roll-off exponent on the area of screen_area. > 0.
  int ceiling = 4096;            ///< n_max of equations 1 and 2: most plants a triangle. >= 1.
  bool plain = false;            ///< The paper's behaviour: no growing-in, no widening, no sinking.
  float full_segments_m = 6.0f;  ///< d0 of equation 4: full segments up to here. > 0.
  bool shadows = true;           ///< Planar shadows.
  float shadow_distance_m = 60.0f;  ///< No shadows of plants beyond. >= 0.

  float water_level_m = -k_unbounded;            ///< World z, for Species::above_water_m.
  std::shared_ptr<const GrayMap> mask;           ///< For all species; asked at each seed. Null: none.
  std::shared_ptr<const ColorMap> distribution;  ///< Classification reads its texels (colours, alpha) instead of the
                                                 ///< base map's; its place is the base map's. Null: the base map.
  std::string mask_file, distribution_file;      ///< As Species::mask_file.
  /// A map tiled over the world whose greys vary the plants' heights (Knowles and Fryazinov 2015, section 2): black
  /// makes them `height_least` of what they are, white leaves them. Its first tile begins at the north-western corner
  /// of the map that classification reads. Null: none.
  std::shared_ptr<const GrayMap> height_map;
  std::string height_map_file;  ///< As Species::mask_file.
  float height_tile_m = 24.0f;  ///< A side of a tile, 0.1..100000.
  float height_least = 0.4f;    ///< 0..1.
  /// The triangles come from a MeshSurface, not from a terrain: plants stand along its normals, are chosen by its own
  /// colours and cast no planar shadows. Masks, height maps, distribution maps and phototropism are refused.
  bool on_mesh = false;
  float season = 0.0f;  ///< Time of the year, 0..1, 1 being 0 again; finite. Of no use without Species::seasons.
};

inline constexpr int k_max_species = 64;  ///< In one layer.
inline constexpr int k_max_cluster_size = 32;
inline constexpr int k_density_bins = 32;
inline constexpr int k_most_shoots = 12;  ///< Lines of a plant of a kind made of shoots.
inline constexpr int k_most_petal_colors = 4;
inline constexpr int k_most_parameters = 16;
inline constexpr int k_most_plant_faces = 512;  ///< Of PlantKind::mesh.

/// What a species resists by: its own value, else 1 for gravel, litter and billboards; other kinds yield up to a largest
/// height of 1.5 m and stand from 4 m on, linearly in between.
SWARD_API float resistance_of(const Species& species);

/// Fails naming layer, species, field and range.
SWARD_API Expected<void> validate(const Layer& layer);

/// Fails where a file of a mask, a distribution map or a plant's image is named but not loaded.
SWARD_API Expected<void> require_maps(const Layer& layer);

/// Whether a rule asks for FixedTriangles::altitude().
SWARD_API bool needs_altitudes(const Layer& layer);

/// Values of a species at a time of the year: between two frames eased (smoothstep), hue the shorter way round, from
/// the last frame to the first across the turn of the year. Without frames the species' own, whole height and density.
SWARD_API SeasonValues season_values(const Species& species, float season);

/// Highest a plant of the layer can reach above the ground, metres.
SWARD_API float canopy_height(const Layer& layer);
/// Farthest that a plant of the layer, or its shadow, reaches from its root on the level, metres.
SWARD_API float canopy_spread(const Layer& layer);

}  // namespace sward
