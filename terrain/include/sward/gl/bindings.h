// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <epoxy/gl.h>

#include <string>
#include <vector>

namespace sward::gl {

/// Every binding point that sward uses. A host that needs one of them for itself moves it here, before creating
/// anything; the numbers reach the shaders as defines.
struct Bindings {
  // Uniform buffers.
  GLuint frame = 0;        ///< SwardFrame
  GLuint species = 1;      ///< SwardSpecies
  GLuint clipmap = 2;      ///< SwardClipmap
  GLuint seeding = 3;      ///< SwardSeeding
  GLuint materials = 5;    ///< SwardMaterials
  GLuint wind = 6;         ///< SwardWind
  GLuint disturbance = 7;  ///< SwardDisturbance
  // Shader storage buffers.
  GLuint seed_ground = 0;   ///< What is static of candidate triangles
  GLuint seed_counts = 1;   ///< Seeds of each
  GLuint seed_groups = 2;   ///< Bin sizes of work groups
  GLuint seed_frame = 3;    ///< Bins and draws
  GLuint seed_records = 4;  ///< Triangle records
  // Texture units.
  GLuint base_map = 0;          ///< sRGB base map, filtered, decoded to linear
  GLuint base_map_raw = 1;      ///< the same texels, encoded, for texelFetch
  GLuint slope_map = 2;         ///< RG16F dz/dx, dz/dy of the data
  GLuint triangles = 3;         ///< RGBA32UI buffer texture: triangle records
  GLuint surface = 4;           ///< RGBA32UI buffer texture: surface nodes
  GLuint blade_shape = 5;       ///< RGBA32F blade shapes
  GLuint plant_images = 6;      ///< R8 array: details and cutouts of a layer's plants
  GLuint plant_mesh = 9;        ///< RGBA32F buffer texture: the mesh of a plant
  GLuint clipmap_heights = 10;  ///< R32F array: heights of clipmap rings
  GLuint clipmap_relief = 11;   ///< RG16F array: their relief's gradients
  GLuint detail = 12;           ///< RGBA8 array: the ground's detail textures
  GLuint detail_slope = 13;     ///< RG8_SNORM array: their slopes
  GLuint placement = 14;        ///< RGBA32UI buffer texture: masks
  GLuint exclusions = 15;       ///< RGBA32F buffer texture: excluded shapes near triangles
  GLuint wind_maps = 7;         ///< RGBA8 array: gusts and noise that the wind carries along
  GLuint wind_grid = 8;         ///< RG16F: what moves near the viewer adds to the wind, m/s
  GLuint wind_painted = 16;     ///< RG16F: factor on the wind over the terrain
  GLuint disturbance_map = 17;  ///< RGBA16F array: what has touched the plants around the viewer
};

struct Define;
/// SWARD_BINDING_FRAME and so on, for ProgramDesc::defines.
SWARD_API std::vector<Define> binding_defines(const Bindings& bindings);

}  // namespace sward::gl
