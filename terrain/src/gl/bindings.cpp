// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/gl/bindings.h>
#include <sward/gl/shader_library.h>

namespace sward::gl {

std::vector<Define> binding_defines(const Bindings& bindings) {
  return {
      {"SWARD_BINDING_FRAME", std::to_string(bindings.frame)},
      {"SWARD_BINDING_SPECIES", std::to_string(bindings.species)},
      {"SWARD_BINDING_CLIPMAP", std::to_string(bindings.clipmap)},
      {"SWARD_BINDING_CLIPMAP_HEIGHTS", std::to_string(bindings.clipmap_heights)},
      {"SWARD_BINDING_CLIPMAP_RELIEF", std::to_string(bindings.clipmap_relief)},
      {"SWARD_BINDING_SEEDING", std::to_string(bindings.seeding)},
      {"SWARD_STORAGE_SEED_GROUND", std::to_string(bindings.seed_ground)},
      {"SWARD_STORAGE_SEED_COUNTS", std::to_string(bindings.seed_counts)},
      {"SWARD_STORAGE_SEED_GROUPS", std::to_string(bindings.seed_groups)},
      {"SWARD_STORAGE_SEED_FRAME", std::to_string(bindings.seed_frame)},
      {"SWARD_STORAGE_SEED_RECORDS", std::to_string(bindings.seed_records)},
      {"SWARD_BINDING_BASE_MAP", std::to_string(bindings.base_map)},
      {"SWARD_BINDING_BASE_MAP_RAW", std::to_string(bindings.base_map_raw)},
      {"SWARD_BINDING_SLOPE_MAP", std::to_string(bindings.slope_map)},
      {"SWARD_BINDING_TRIANGLES", std::to_string(bindings.triangles)},
      {"SWARD_BINDING_SURFACE", std::to_string(bindings.surface)},
      {"SWARD_BINDING_BLADE_SHAPE", std::to_string(bindings.blade_shape)},
      {"SWARD_BINDING_PLANT_IMAGES", std::to_string(bindings.plant_images)},
      {"SWARD_BINDING_PLANT_MESH", std::to_string(bindings.plant_mesh)},
      {"SWARD_BINDING_PLACEMENT", std::to_string(bindings.placement)},
      {"SWARD_BINDING_EXCLUSIONS", std::to_string(bindings.exclusions)},
      {"SWARD_BINDING_MATERIALS", std::to_string(bindings.materials)},
      {"SWARD_BINDING_WIND", std::to_string(bindings.wind)},
      {"SWARD_BINDING_WIND_MAPS", std::to_string(bindings.wind_maps)},
      {"SWARD_BINDING_WIND_GRID", std::to_string(bindings.wind_grid)},
      {"SWARD_BINDING_WIND_PAINTED", std::to_string(bindings.wind_painted)},
      {"SWARD_BINDING_DISTURBANCE", std::to_string(bindings.disturbance)},
      {"SWARD_BINDING_DISTURBANCE_MAP", std::to_string(bindings.disturbance_map)},
      {"SWARD_BINDING_DETAIL", std::to_string(bindings.detail)},
      {"SWARD_BINDING_DETAIL_SLOPE", std::to_string(bindings.detail_slope)},
  };
}

}  // namespace sward::gl
