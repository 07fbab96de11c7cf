// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "host/scene_maps.h"

#include <sward/scene/generated_mesh.h>
#include <map>

#include "host/scene_surfaces.h"

#ifdef SWARD_IMAGE_IO
#include <sward/image_io/image_io.h>
#endif

namespace sward::host {

namespace {

#ifdef SWARD_IMAGE_IO
// Its place is the base map's, whatever is said here.
Expected<ColorMap> load_map(const std::string& path) {
  return load_color_map(path, glm::dvec2(0), glm::dvec2(1));
}
#else
Expected<ColorMap> load_map(const std::string& path) {
  return fail(path + ": this build reads no images; configure it with SWARD_IMAGE_IO=ON");
}
#endif

Expected<std::shared_ptr<const GrayMap>> load_mask(const std::string& path) {
  auto colors = load_map(path);
  if (!colors) return tl::unexpected(colors.error());
  auto mask = std::make_shared<GrayMap>();
  mask->width = colors->width;
  mask->height = colors->height;
  mask->values.reserve(colors->texels.size());
  for (const glm::u8vec4 texel : colors->texels) {
    if (texel.r != texel.g || texel.g != texel.b) return fail(path + ": a mask must be grey, and this one has colours");
    mask->values.push_back(texel.r);
  }
  if (auto valid = mask->validate(); !valid) return fail(path + " " + valid.error().message);
  return std::shared_ptr<const GrayMap>(std::move(mask));
}

/// A failure to load what a scene names, told where it does.
tl::unexpected<Error> fail_at(const PlantImageFile& file, const char* key, const std::string& why) {
  const std::string where = file.place.empty() ? std::string() : file.place + ": ";
  return fail(where + key + " = \"" + file.path + "\": " + why);
}

using PlantImages = std::map<std::string, std::shared_ptr<const PlantImage>>;

Expected<std::shared_ptr<const PlantImage>> load_plant_image(const std::string& path) {
  auto grey = load_mask(path);
  if (!grey) return tl::unexpected(grey.error());
  return PlantImage::create((*grey)->width, (*grey)->height, (*grey)->values);
}

Expected<void> fill_image(const PlantImageFile& file, const char* key, const Scene& scene, PlantImages& known,
                          std::shared_ptr<const PlantImage>& image) {
  if (file.path.empty()) return {};
  const std::string path = scene.resolve(file.path);
  std::shared_ptr<const PlantImage>& kept = known[path];
  if (!kept) {
    auto loaded = load_plant_image(path);
    if (!loaded) return fail_at(file, key, loaded.error().message);
    kept = std::move(*loaded);
  }
  image = kept;
  return {};
}

Expected<void> fill_images(const Scene& scene, PlantImages& known, Species& species) {
  species.detail = built_in_detail(species.detail_file.path);
  if (!species.detail) {
    if (auto filled = fill_image(species.detail_file, "detail", scene, known, species.detail); !filled) return filled;
  }
  return fill_image(species.cutout_file, "cutout", scene, known, species.cutout);
}

using Masks = std::map<std::string, std::shared_ptr<const GrayMap>>;

Expected<void> fill_mask(const std::string& file, const Scene& scene, Masks& known,
                         std::shared_ptr<const GrayMap>& mask) {
  if (file.empty()) return {};
  std::shared_ptr<const GrayMap>& kept = known[file];
  if (!kept) {
    auto loaded = load_mask(scene.resolve(file));
    if (!loaded) return tl::unexpected(loaded.error());
    kept = std::move(*loaded);
  }
  mask = kept;
  return {};
}

Expected<void> fill_plant_mesh(const Scene& scene, Species& species) {
  PlantMesh& plant = species.mesh;
  if (species.kind != PlantKind::mesh || plant.mesh) return {};
  auto mesh = plant.file.empty() ? generate_plant_shape(plant.shape) : load_mesh_file(scene.resolve(plant.file));
  if (!mesh) return tl::unexpected(mesh.error());
  plant.mesh = std::make_shared<const TriangleMesh>(std::move(*mesh));
  return {};
}

Expected<void> fill_wind(Scene& scene, Masks& known) {
  if (!scene.wind) return {};
  SceneWind& wind = *scene.wind;
  auto strength = fill_mask(wind.strength_file, scene, known, wind.strength);
  if (!strength) return fail(wind.where + ": strength_map: " + strength.error().message);
  auto turn = fill_mask(wind.turn_file, scene, known, wind.turn);
  if (!turn) return fail(wind.where + ": turn_map: " + turn.error().message);
  return {};
}

using Details = std::map<std::string, std::shared_ptr<const DetailTexture>>;

Expected<void> fill_detail(const std::string& file, const std::string& where, const Scene& scene, Details& known,
                           std::shared_ptr<const DetailTexture>& texture) {
  if (file.empty()) return {};
  std::shared_ptr<const DetailTexture>& kept = known[file];
  if (!kept) {
    const std::string path = scene.resolve(file);
    auto image = load_map(path);
    if (!image) return fail(where + ": " + image.error().message);
    auto detail = detail_from_image(path, image->width, image->height, image->texels);
    if (!detail) return fail(where + ": " + detail.error().message);
    kept = std::make_shared<const DetailTexture>(std::move(*detail));
  }
  texture = kept;
  return {};
}

Expected<void> load_details(Scene& scene) {
  Details known;
  for (SceneMaterial& each : scene.materials) {
    GroundMaterial& material = each.material;
    if (auto flat = fill_detail(each.detail_file, each.where, scene, known, material.texture); !flat) return flat;
    if (auto cliff = fill_detail(each.cliff_file, each.where, scene, known, material.cliff_texture); !cliff)
      return cliff;
  }
  return {};
}

}  // namespace

Expected<void> load_maps(Scene& scene) {
  if (auto loaded = load_details(scene); !loaded) return loaded;
  Masks masks;
  PlantImages images;
  if (auto filled = fill_wind(scene, masks); !filled) return filled;
  for (Layer& layer : scene.layers) {
    if (auto filled = fill_mask(layer.mask_file, scene, masks, layer.mask); !filled) return filled;
    if (auto filled = fill_mask(layer.height_map_file, scene, masks, layer.height_map); !filled) return filled;
    for (Species& species : layer.species)
      if (auto filled = fill_mask(species.mask_file, scene, masks, species.mask); !filled) return filled;
    for (Species& species : layer.species) {
      if (auto filled = fill_images(scene, images, species); !filled) return filled;
      if (auto filled = fill_plant_mesh(scene, species); !filled) return filled;
    }
    if (layer.distribution_file.empty()) continue;
    auto colors = load_map(scene.resolve(layer.distribution_file));
    if (!colors) return tl::unexpected(colors.error());
    layer.distribution = std::make_shared<const ColorMap>(std::move(*colors));
  }
  return {};
}

}  // namespace sward::host
