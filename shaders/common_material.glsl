// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Kinds of ground by the base map's colour (Papavasiliou 2015, section 3.3, equations 16 and 17), with the scores that
// plants are chosen by. Read by GLSL and C++; needs common_classify.glsl.

const int k_most_materials = 16;  // k_max_materials

// std140: every member a vec4.
struct MaterialParams {
  vec4 reference;  // hue (turns), saturation, value; exponent p
  vec4 weights;    // of hue, saturation, value; least accepted score
  vec4 look;       // tiles in 1024 m on flat ground, on cliffs; strength; sharpness of borders
  vec4 layers;     // of the detail on flat ground, on cliffs; score where the ground is everywhere, else 0; unused
  vec4 relief;     // slope of the detail's code 1 on flat ground, on cliffs (m/m); layers of the coarser scales
};

SWARD_FN float material_score(MaterialParams material, vec3 hsv) {
  return material.layers.z > 0.0f ? material.layers.z : color_score(material.reference, material.weights, hsv);
}

// The best four scores so far, the best first. Index -1: none.
struct BestMaterials {
  int first, second, third;
  vec4 scores;
};

SWARD_FN BestMaterials no_materials() {
  BestMaterials b;
  b.first = -1;
  b.second = -1;
  b.third = -1;
  b.scores = vec4(0.0f, 0.0f, 0.0f, 0.0f);
  return b;
}

SWARD_FN BestMaterials insert_material(BestMaterials b, int index, float score) {
  vec4 s = b.scores;
  if (score > s.x) {
    b.third = b.second;
    b.second = b.first;
    b.first = index;
    b.scores = vec4(score, s.x, s.y, s.z);
  } else if (score > s.y) {
    b.third = b.second;
    b.second = index;
    b.scores = vec4(s.x, score, s.y, s.z);
  } else if (score > s.z) {
    b.third = index;
    b.scores = vec4(s.x, s.y, score, s.z);
  } else if (score > s.w) {
    b.scores = vec4(s.x, s.y, s.z, score);
  }
  return b;
}

// Equation 17 over the three best, each score less the fourth, so that none appears or goes at once: with three
// materials, or where no fourth counts, the equation as it stands.
SWARD_FN vec3 material_shares_of(BestMaterials b) {
  SWARD_PRECISE float x = b.scores.x - b.scores.w;
  SWARD_PRECISE float y = b.scores.y - b.scores.w;
  SWARD_PRECISE float z = b.scores.z - b.scores.w;
  SWARD_PRECISE float sum = x + y + z;
  if (b.first < 0) return vec3(0.0f, 0.0f, 0.0f);
  if (sum <= 0.0f) return vec3(1.0f, 0.0f, 0.0f);
  return vec3(x / sum, y / sum, z / sum);
}
