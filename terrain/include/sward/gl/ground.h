// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/gl/disturbed_ground.h>
#include <sward/gl/handles.h>
#include <sward/gl/slope_map.h>
#include <sward/terrain/color_map.h>
#include <sward/terrain/ground_material.h>
#include <sward/terrain/height_field.h>
#include <span>

namespace sward::gl {

/// The ground's static textures: the base map twice (decoded and mipmapped for shading, raw for classification; one
/// storage, two views) and the slope map. GL thread.
class SWARD_API GroundTextures {
 public:
  /// Uploads copies; the arguments may go away afterwards. Fails when a map exceeds the device's texture size or the
  /// base map does not validate. Filters are anisotropic where the device has that in hardware. Leaves all state as it
  /// was. Cost: a few hundred ms for maps of 8192 x 8192.
  static Expected<GroundTextures> create(const HeightField& field, const ColorMap& colors);
  /// The same for a surface that may change or be of any size, such as a world: call slopes().follow() before each draw
  /// and slopes().changed() with each box in which the data have changed. One object serves one eye at a time.
  static Expected<GroundTextures> create(const Surface& surface, const ColorMap& colors,
                                         const SlopeMapOptions& options = {});

  /// The same for a host that draws its ground itself: colours alone, which is all that plants ask for. `colors` needs
  /// min_corner and size of the rectangle that it covers. TerrainRenderer would shade it as level ground.
  static Expected<GroundTextures> create(const ColorMap& colors);

  /// Takes the slopes of an edited field anew, where `changed` (EditResult::changed) is; then the map is what create()
  /// would make of the field now. `field` has the size that it was made from (asserted). Leaves all state as it was.
  /// Cost: that of the area, and once the GPU's for the map's mip levels: a few tenths of a millisecond for 4097 x
  /// 4097.
  void update_slopes(const HeightField& field, const LatticeBox& changed);

  /// Puts these materials' detail textures on the ground near the eye, in place of what was there; none: the finer
  /// octaves of noise instead. Where no material matches there is no texture: include one that is everywhere. Generates the textures that are named. Fails, changing nothing, where the materials do not
  /// validate or the device has no room for them. Leaves all state as it was. Cost: some 35 ms of a core and 2 MB a
  /// different texture.
  Expected<void> set_materials(std::span<const GroundMaterial> materials);

  /// What has touched the ground, for terrain and all plants that are drawn with these textures (DisturbanceTextures in
  /// the vegetation library); {}: nothing, as after creation. The objects must live while anything is drawn.
  void set_disturbed(const DisturbedGround& disturbed) { disturbed_ = disturbed; }
  /// Uniform buffer SwardDisturbance and its texture; where nothing is disturbed, ones that say so.
  DisturbedGround disturbed() const {
    return disturbed_.block != 0 ? disturbed_ : DisturbedGround{undisturbed_.id(), untouched_map_.id()};
  }

  /// Bytes of GPU memory that it holds (gl::storage_bytes). Asks GL: not for every frame. Leaves all state as it was.
  size_t gpu_bytes() const;
  GLuint materials() const { return materials_.id(); }        ///< SwardMaterials, a uniform buffer
  GLuint detail() const { return detail_.id(); }              ///< RGBA8 array, trilinear, repeats
  GLuint detail_slope() const { return detail_slope_.id(); }  ///< RG8_SNORM array, likewise
  GLuint base_map() const { return base_map_.id(); }          ///< SRGB8_ALPHA8, trilinear, clamped
  GLuint base_map_raw() const { return base_map_raw_.id(); }  ///< RGBA8 view, level 0, for texelFetch
  SlopeMap& slopes() { return slopes_; }                      ///< Of the data, for shading
  const SlopeMap& slopes() const { return slopes_; }
  glm::dvec2 map_min() const { return map_min_; }    ///< World x, y of the base map's western, southern corner
  glm::dvec2 map_size() const { return map_size_; }  ///< Metres
  glm::dvec2 data_min() const { return data_min_; }  ///< Western, southern corner of the height data
  glm::dvec2 data_max() const { return data_max_; }  ///< Eastern, northern; what lies beyond is padding
  glm::ivec2 texels() const { return texels_; }      ///< Base map, width and height

 private:
  explicit GroundTextures(SlopeMap slopes) : slopes_(std::move(slopes)) {}
  static Expected<GroundTextures> create(glm::dvec2 data_min, glm::dvec2 data_max, const ColorMap& colors,
                                         Expected<SlopeMap> slopes);

  SlopeMap slopes_;
  Texture base_map_, base_map_raw_, detail_, detail_slope_, untouched_map_;
  Buffer materials_, undisturbed_;
  DisturbedGround disturbed_;
  glm::dvec2 map_min_{0}, map_size_{1}, data_min_{0}, data_max_{0};
  glm::ivec2 texels_{1};
};

}  // namespace sward::gl
