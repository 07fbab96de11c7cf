// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include "vegetation/wind_bindings.h"

#include "gl/bind.h"

namespace sward {

WindBindings::WindBindings(const gl::Bindings& bindings, const WindTextures* wind)
    : bindings_(bindings), bound_(wind != nullptr) {
  if (!bound_) return;
  gl::bind_uniforms(bindings.wind, wind->block());
  const GLuint units[] = {bindings.wind_maps, bindings.wind_grid, bindings.wind_painted};
  const GLuint textures[] = {wind->maps(), wind->grid(), wind->painted()};
  for (int i = 0; i < 3; ++i) gl::bind_texture(units[i], textures[i]);
}

WindBindings::~WindBindings() {
  if (!bound_) return;
  gl::bind_uniforms(bindings_.wind, 0);
  for (const GLuint unit : {bindings_.wind_maps, bindings_.wind_grid, bindings_.wind_painted})
    glBindTextureUnit(unit, 0);
}

}  // namespace sward
