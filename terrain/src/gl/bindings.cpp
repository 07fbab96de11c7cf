// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/gl/bindings.h>
#include <sward/gl/shader_library.h>

namespace sward::gl {

std::vector<Define> binding_defines(const Bindings& bindings) {
  return {
      {"SWARD_BINDING_FRAME", std::to_string(bindings.frame)},
      {"SWARD_BINDING_SPECIES", std::to_string(bindings.species)},
      {"SWARD_BINDING_BASE_MAP", std::to_string(bindings.base_map)},
      {"SWARD_BINDING_BASE_MAP_RAW", std::to_string(bindings.base_map_raw)},
      {"SWARD_BINDING_SLOPE_MAP", std::to_string(bindings.slope_map)},
      {"SWARD_BINDING_TRIANGLES", std::to_string(bindings.triangles)},
      {"SWARD_BINDING_SURFACE", std::to_string(bindings.surface)},
      {"SWARD_BINDING_BLADE_SHAPE", std::to_string(bindings.blade_shape)},
      {"SWARD_BINDING_PLACEMENT", std::to_string(bindings.placement)},
      {"SWARD_BINDING_EXCLUSIONS", std::to_string(bindings.exclusions)},
      {"SWARD_BINDING_MATERIALS", std::to_string(bindings.materials)},
      {"SWARD_BINDING_DETAIL", std::to_string(bindings.detail)},
      {"SWARD_BINDING_DETAIL_SLOPE", std::to_string(bindings.detail_slope)},
  };
}

}  // namespace sward::gl
