// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <epoxy/gl.h>

#include <string>
#include <vector>

namespace sward::gl {

/// Every binding point that sward uses. A host that needs one of them for itself moves it here, before creating
/// anything; the numbers reach the shaders as defines.
struct Bindings {
  // Uniform buffers.
  GLuint frame = 0;         ///< SwardFrame
  GLuint species = 1;       ///< SwardSpecies
  GLuint materials = 5;     ///< SwardMaterials
  // Texture units.
  GLuint base_map = 0;      ///< sRGB base map, filtered, decoded to linear
  GLuint base_map_raw = 1;  ///< the same texels, encoded, for texelFetch
  GLuint slope_map = 2;     ///< RG16F dz/dx, dz/dy of the data
  GLuint triangles = 3;     ///< RGBA32UI buffer texture: triangle records
  GLuint surface = 4;       ///< RGBA32UI buffer texture: surface nodes
  GLuint blade_shape = 5;   ///< RGBA32F blade shapes
  GLuint detail = 12;        ///< RGBA8 array: the ground's detail textures
  GLuint detail_slope = 13;  ///< RG8_SNORM array: their slopes
  GLuint placement = 14;    ///< RGBA32UI buffer texture: masks
  GLuint exclusions = 15;   ///< RGBA32F buffer texture: excluded shapes near triangles
};

struct Define;
/// SWARD_BINDING_FRAME and so on, for ProgramDesc::defines.
std::vector<Define> binding_defines(const Bindings& bindings);

}  // namespace sward::gl
