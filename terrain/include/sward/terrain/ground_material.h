// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/terrain/detail_texture.h>
#include <sward/terrain/error.h>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sward {

/// A kind of ground that shows where the base map has its colour (Papavasiliou 2015, section 3.3): a reference colour
/// as a species of plants has one, and a detail texture.
struct GroundMaterial {
  std::string name;
  /// Hue in turns [0, 1), saturation and value [0, 1], of the sRGB-encoded base map. Empty: this ground is everywhere,
  /// as if the base map were `max_distance` away from its colour: it shows where nothing else comes nearer.
  std::optional<glm::vec3> reference_hsv;
  /// Weights of the differences in hue, saturation, value (equation 16). >= 0, not all 0.
  glm::vec3 weights{3.0f, 1.0f, 0.5f};
  float exponent = 4.0f;      ///< p of equation 16, > 0.
  float max_distance = 0.5f;  ///< Largest accepted weighted colour distance, >= 0.0001, may be infinite with a colour.

  std::string detail = "soil";  ///< A name of generated_details(); read where `texture` is null.
  std::string cliff_detail;     ///< The same on steep faces; empty: what lies on flat ground.
  /// What shows at the middle and the broad scale, where a blade or a stone would look like a giant's: a name of
  /// generated_details(); empty: the detail itself for soil, rock, strata, sand and snow, else "mottle".
  std::string broad_detail;
  std::shared_ptr<const DetailTexture> texture, cliff_texture;
  float tile_m = 1.0f;        ///< Side of the detail texture on the ground, metres, 0.05..64.
  float cliff_tile_m = 6.0f;  ///< The same on steep faces.
  float strength = 1.0f;      ///< Share of the detail's contrast, 0..1; 0: none.
  float relief_m = 0.03f;     ///< Height between the texture's lowest and highest place, for light alone, metres, 0..2.
  float cliff_relief_m = 0.25f;
  /// How much the higher of two materials hides the lower at their border, 0 (plain equation 17) .. 32.
  float sharpness = 6.0f;
};

inline constexpr int k_max_materials = 16;

/// Fails naming material, field and range, on more than k_max_materials, and on two that are everywhere.
SWARD_API Expected<void> validate(std::span<const GroundMaterial> materials);

/// Grass, litter, soil, gravel, rock with strata on cliffs, sand and snow by colours that they have anywhere, and soil
/// for the rest.
SWARD_API std::vector<GroundMaterial> default_ground_materials();

/// What a material shows at the coarser scales, on flat ground and on cliffs: broad_detail, or what it stands for.
/// Empty: the same as at the finest.
SWARD_API std::string broad_detail_of(const GroundMaterial& material, bool cliff);

/// Equation 17: the share of each material in ground of this colour (sRGB-encoded, 0..1), before heights sharpen it.
/// Shares are those of the three best scores, each less the fourth, so that what is drawn is bounded and nothing jumps;
/// they sum to 1, or are all 0 where nothing matches. `shares` is as long as `materials`. Fragments compute the same
/// (shaders/common_material.glsl).
SWARD_API void material_shares(std::span<const GroundMaterial> materials, glm::vec3 srgb, std::span<float> shares);

}  // namespace sward
