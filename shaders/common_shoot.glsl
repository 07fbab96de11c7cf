// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Kinds made of shoots: plants of one or more bent lines from one root, each grown by the stages shoot.*.glsl. A kind
// is a file with four functions; sward's own are kind_tuft.glsl and kind_flower.glsl, a host registers its own. GLSL
// only.
//
//   vec2 kind_shoots(SpeciesParams species, PlantTraits traits, float ratio)
//     How many shoots the plant shows (0..SWARD_MOST_SHOOTS; of a fraction the last has that share of its width), and a
//     factor on the width of all, which makes up for those left out. `ratio`: distance from the eye against the layer's
//     full_segments_m. Continuous in `ratio`, so that nothing pops.
//   Shoot kind_shoot(SpeciesParams species, PlantTraits traits, int index)
//     A shoot's posture. traits.height and width are as drawn in this frame, traits.state the plant's own numbers.
//   float kind_outline(SpeciesParams species, int index, float s)
//     Half its width at arc length s of 0..1, against the half width at the base; 0 ends it in a point.
//   Leaf kind_leaf(SpeciesParams species, vec4 ground_and_age, int index, float s, float across, float phase)
//     Its colour and light at arc length s, -1..1 across; ground_and_age: linear colour of the ground at the root, the
//     plant's age; phase: the plant's own number, 0..1. grass_leaf() (common_leaf.glsl) does it as grass does.
#include "common_leaf.glsl"
#include "common_kinds.glsl"
#include "common_disturbed.glsl"
#include "common_disturbed_plant.glsl"

struct Shoot {
  float height;     // length, against the plant's height, 0..1
  float width;      // against the plant's width
  float stiffness;  // 0 hangs .. 1 straight
  float azimuth;    // of bending, radians
  float lean;       // at the root, radians
  float edge;       // share of the width that its edge shows: 1 round, 0.35 a blade
  vec2 foot;        // where it leaves the ground, metres east and north of the root
};

// A further number of a part's own, 0..1.
float next_uniform(inout uint state) {
  state = lcg_next(state);
  return uniform_float(state);
}

// Of the packed sRGB colours in SpeciesParams: red * 65536 + green * 256 + blue, to linear.
vec3 unpack_color(float packed_color) {
  vec3 bytes = floor(mod(vec3(packed_color) / vec3(65536.0, 256.0, 1.0) + 0.0009765625, vec3(256.0)));
  vec3 encoded = bytes / 255.0;
  vec3 low = encoded / 12.92;
  vec3 high = pow((encoded + 0.055) / 1.055, vec3(2.4));
  return mix(low, high, greaterThan(encoded, vec3(0.04045)));
}

// A shoot of a plant that is pressed (common_disturbed_plant.glsl) lies with it.
Shoot lay_shoot(SpeciesParams species, PlantTraits traits, Shoot shoot) {
  float pressed = pressed_by_lean(species.posture.z, traits.lean);
  if (pressed <= 0.0) return shoot;
  float turn = (traits.azimuth - shoot.azimuth) / 6.2831853;
  turn = (turn - floor(turn + 0.5)) * 6.2831853;
  // Shoots stay fanned out a little.
  shoot.azimuth += 0.85 * turn * smoothstep(0.0, 0.5, pressed);
  shoot.lean = mix(shoot.lean, traits.lean, pressed);
  shoot.stiffness = mix(shoot.stiffness, traits.stiffness, pressed);
  return shoot;
}
