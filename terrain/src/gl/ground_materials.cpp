// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/gl/ground.h>

#include <algorithm>
#include <array>
#include <future>
#include <string>

#include "ground_textures.h"
#include "terrain/material_params.h"

namespace sward::gl {

namespace {

constexpr float k_reads_without_anisotropy = 3;

/// Mirror of SwardMaterials in shaders/common_splat.glsl.
struct MaterialBlock {
  glm::vec4 head{0};
  std::array<material_glsl::MaterialParams, k_max_materials> material{};
};
static_assert(sizeof(material_glsl::MaterialParams) == 80);
static_assert(sizeof(MaterialBlock) == 16 + 80 * k_max_materials);
static_assert(material_glsl::k_most_materials == k_max_materials);

/// The different textures of a set of materials, each once.
class Layers {
 public:
  /// The number of a texture: `given`, or the generated one of this name.
  int add(const std::shared_ptr<const DetailTexture>& given, const std::string& name) {
    const auto same = [&](const Layer& l) { return given ? l.texture == given : !l.name.empty() && l.name == name; };
    const auto known = std::find_if(layers_.begin(), layers_.end(), same);
    if (known != layers_.end()) return int(known - layers_.begin());
    layers_.push_back({given, given ? std::string() : name});
    return int(layers_.size()) - 1;
  }
  /// Paints what is only named, on as many threads as there are cores.
  Expected<void> generate() {
    std::vector<std::future<Expected<DetailTexture>>> painted;
    for (const Layer& layer : layers_)
      if (!layer.texture)
        painted.push_back(std::async(std::launch::async, [&layer] { return generate_detail(layer.name); }));
    auto next = painted.begin();
    Expected<void> done;
    for (Layer& layer : layers_) {
      if (layer.texture) continue;
      Expected<DetailTexture> texture = (next++)->get();
      if (texture)
        layer.texture = std::make_shared<const DetailTexture>(std::move(*texture));
      else
        done = tl::unexpected(texture.error());
    }
    return done;
  }
  int count() const { return int(layers_.size()); }
  const DetailTexture& operator[](int i) const { return *layers_[size_t(i)].texture; }

 private:
  struct Layer {
    std::shared_ptr<const DetailTexture> texture;
    std::string name;
  };
  std::vector<Layer> layers_;
};

MaterialLayers number_layers(const GroundMaterial& m, Layers& layers) {
  MaterialLayers numbers;
  numbers.flat = numbers.cliff = layers.add(m.texture, m.detail);
  if (m.cliff_texture || !m.cliff_detail.empty()) numbers.cliff = layers.add(m.cliff_texture, m.cliff_detail);
  const auto broad = [&](bool cliff, int own) {
    const std::string name = broad_detail_of(m, cliff);
    return name.empty() ? own : layers.add(nullptr, name);
  };
  numbers.flat_broad = broad(false, numbers.flat);
  numbers.cliff_broad = broad(true, numbers.cliff);
  return numbers;
}

MaterialBlock make_block(std::span<const GroundMaterial> materials, Layers& layers) {
  MaterialBlock block;
  block.head = {float(materials.size()), anisotropic_filters() ? 1.0f : k_reads_without_anisotropy, 0.0f, 0.0f};
  for (size_t i = 0; i < materials.size(); ++i)
    block.material[i] = make_material_params(materials[i], number_layers(materials[i], layers));
  return block;
}

Texture make_array(GLenum format, int side, int levels, int layers) {
  Texture texture = create_texture(GL_TEXTURE_2D_ARRAY);
  glTextureStorage3D(texture.id(), levels, format, side, side, layers);
  set_trilinear(texture.id());
  glTextureParameteri(texture.id(), GL_TEXTURE_WRAP_S, GL_REPEAT);
  glTextureParameteri(texture.id(), GL_TEXTURE_WRAP_T, GL_REPEAT);
  return texture;
}

/// Layers and levels of one of the two arrays, from texels that `all` yields of a texture.
template <class All>
void fill(GLuint array, const Layers& layers, GLenum format, GLenum type, All&& all) {
  for (int layer = 0; layer < layers.count(); ++layer)
    for (int level = 0; level < DetailTexture::k_levels; ++level) {
      const int side = DetailTexture::side(level);
      glTextureSubImage3D(array, level, 0, 0, layer, side, side, 1, format, type,
                          all(layers[layer]).data() + DetailTexture::offset(level));
    }
}

}  // namespace

Expected<void> GroundTextures::set_materials(std::span<const GroundMaterial> materials) {
  if (Expected<void> valid = validate(materials); !valid) return valid;
  Layers layers;
  const MaterialBlock block = make_block(materials, layers);
  if (Expected<void> context = require_context(); !context) return context;
  GLint most = 0;
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &most);
  if (layers.count() > most) {
    return fail("the ground's materials have " + std::to_string(layers.count()) +
                " different textures; this device allows " + std::to_string(most));
  }
  if (Expected<void> painted = layers.generate(); !painted) return painted;
  const DefaultUnpack unpack;
  // Without materials the arrays hold one texel: units must not be empty where a program could read.
  const bool none = layers.count() == 0;
  const int side = none ? 1 : DetailTexture::k_side, levels = none ? 1 : DetailTexture::k_levels;
  detail_ = make_array(GL_RGBA8, side, levels, std::max(layers.count(), 1));
  detail_slope_ = make_array(GL_RG8_SNORM, side, levels, std::max(layers.count(), 1));
  fill(detail_.id(), layers, GL_RGBA, GL_UNSIGNED_BYTE, [](const DetailTexture& t) { return std::span(t.shade); });
  fill(detail_slope_.id(), layers, GL_RG, GL_BYTE, [](const DetailTexture& t) { return std::span(t.slope); });
  materials_ = create_buffer();
  glNamedBufferStorage(materials_.id(), sizeof(MaterialBlock), &block, 0);
  return {};
}

}  // namespace sward::gl
