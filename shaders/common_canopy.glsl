// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Light among plants: how much of the sky's and of the sun's comes down to a height between the neighbours (Reeves,
// Blau 1985; absorption by the leaf area above), and what a leaf lets through and reflects (Papavasiliou 2015,
// equations 13 and 14; the streak after Kajiya, Kay 1989). Whatever is linear along a blade is meant to be asked at its
// vertices. GLSL only.
#include "common_frame.glsl"
#include "common_layer.glsl"

struct Canopy {
  float height;  // of the plants' mean, metres
  float sky;     // optical depth from there to the ground, for the sky's light
  float sun;     // the same for the sun's, on its slanted way
  float open;    // factor on a leaf's light for what grass_leaf takes for granted: neighbours
};

// Leaves a square metre of ground, by one side, were all of the layer of this species. Laws of area are taken for what
// they give at twice full_distance_m, looking straight on; their ceiling is not counted.
float leaf_area(LayerParams layer, SpeciesParams species) {
  float plants = layer.law.y;
  if (layer.law.x != 0.0) {
    float focal = layer.law.x == 1.0 ? 2.0 * frame.focal.y * frame.viewport.w : 1.0;
    float relative = focal / max(2.0 * layer.law.z, 1.0e-3);
    plants *= relative * relative;
  }
  float share = 0.6 * 0.25;  // of the mean height times the mean width, outlines being pointed
  return share * plants * (species.size.x + species.size.y) * (species.size.z + species.size.w);
}

// `facing`: cosine between the ground's normal and the sun. A dense canopy leaves root_shade of the sky's light at the
// root, a lone plant stands in the open.
Canopy canopy_of(LayerParams layer, SpeciesParams species, float facing) {
  float density = 1.0 - exp(-leaf_area(layer, species) * 5.0);
  float depth = -log(max(species.age_tint.w, 0.02)) * density;
  float open = (1.0 + species.age_tint.w) / (1.0 + exp(-depth));
  // Blades bend: the canopy ends below their mean length.
  return Canopy(max(0.4 * (species.size.x + species.size.y), 1.0e-4), depth, depth / max(facing, 0.3), open);
}

// Share of the sky's light and of the sun's at a height above the ground (m). Leaf area is densest at the ground, for
// plants taper and are of many heights: what lies above grows with the square of the depth. Times Canopy::open.
vec2 canopy_light(Canopy canopy, float height) {
  float below = clamp(1.0 - height / canopy.height, 0.0, 1.0);
  return canopy.open * exp(-below * below * vec2(canopy.sky, canopy.sun));
}

// Light through a leaf against the diffuse (equation 13), wrapped around its edge, strongest where the eye looks at the
// sun. `facing`: cosine between the sun and the normal on the viewer's side; `towards`: between the view and the sun.
float leaf_through(vec4 optics, float facing, float towards) {
  const float wrap = 0.2;
  float behind = (wrap - facing) / (1.0 + wrap);
  if (behind <= 0.0) return 0.0;
  float ahead = max(towards, 0.0);
  return optics.x * behind * exp(-optics.y / max(behind, 0.05)) * (0.45 + 1.3 * ahead * ahead * ahead);
}

// What a leaf reflects of the sun without its streak's own fall: little at steep angles, all at grazing ones; broad
// across the leaf. `half_way`: unit, between the ways to the eye and to the sun.
float leaf_gloss(vec3 normal, vec3 half_way, vec3 to_eye) {
  float up = max(dot(normal, half_way), 0.0);
  float away = 1.0 - clamp(dot(to_eye, half_way), 0.0, 1.0);
  float grazing = away * away;
  return up * up * (0.4 + 0.6 * grazing * grazing * away);
}

// The streak across a leaf where it mirrors the sun. `along`: cosine between the leaf's way and half_way; shiny leaves
// have narrow ones.
float leaf_streak(vec4 optics, float along) { return optics.z * exp2(-0.72 * optics.w * along * along); }
