// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Images on plants, where a species has them: detail on its colour, a cutout of its outline. Places are -1..1 across
// the plant, 0..1 from root to tip. GLSL only, fragment stage.
layout(location = 1) uniform vec4 sward_images;  // detail's number or -1, strength, repeats; cutout's number or -1

layout(binding = SWARD_BINDING_PLANT_IMAGES) uniform sampler2DArray sward_plant_images;

bool has_cutout() { return sward_images.w >= 0.0; }

// Factor on the colour, around 1; farther away 1.
float image_detail(vec2 place) {
  if (sward_images.x < 0.0) return 1.0;
  vec2 uv = vec2(0.5 + 0.5 * place.x, (1.0 - place.y) * sward_images.z);
  float grey = texture(sward_plant_images, vec3(uv, sward_images.x)).r;
  return 1.0 + sward_images.y * (2.0 * grey - 1.0);
}

// Share of the fragment within an outline, of what is above 0 inside of it: as sharp as pixels can show, for its slope
// says how far the outline is. Before any discard, for it takes derivatives.
float edge_cover(float inside) {
  float slope = length(vec2(dFdx(inside), dFdy(inside)));
  return clamp(inside / max(slope, 1.0e-4) + 0.5, 0.0, 1.0);
}

float cutout_cover(vec2 place) {
  const float half_texel = 0.5 / 256.0;
  vec2 uv = vec2(0.5 + 0.5 * place.x, clamp(1.0 - place.y, half_texel, 1.0 - half_texel));
  return edge_cover(texture(sward_plant_images, vec3(uv, sward_images.w)).r - 0.5);
}
