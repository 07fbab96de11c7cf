// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/terrain/color_map.h>
#include <sward/terrain/view.h>
#include <sward/vegetation/species.h>
#include <vector>

#include "vegetation/shared_glsl.h"

namespace sward {

/// What the lookup needs to know of a base map: its texels may be on the CPU (ColorMap) or in a texture.
struct MapGeometry {
  glm::dvec2 size{1};    ///< Metres east and north, > 0.
  glm::ivec2 texels{1};  ///< Width and height, > 0.
};
inline MapGeometry geometry_of(const ColorMap& map) {
  return {map.size, {map.width, map.height}};
}

/// What the uniform block of a layer holds for one view. `sun_azimuth`: radians, 0 east, counter-clockwise.
shared::LayerParams make_layer_params(const Layer& layer, const View& view, const MapGeometry& map, float sun_azimuth);

/// What classification reads: the layer's distribution map, where it has one, in the base map's place.
MapGeometry classification_map(const Layer& layer, const MapGeometry& base);

/// The layer's masks, each once, and last the height map. Shaders number them from 1.
std::vector<const GrayMap*> masks_of(const Layer& layer);

/// What shaders know of masks_of()[i] beyond its greys. x, y: of a mask its texels, of the height map its tiles, a
/// texel of the map that classification reads; z: of the height map Layer::height_least; w: 0.
glm::vec4 mask_header(const Layer& layer, size_t i, const MapGeometry& map);

/// One entry a species, in the layer's order, for the layer's season.
std::vector<shared::SpeciesParams> make_species_params(const Layer& layer);

}  // namespace sward
