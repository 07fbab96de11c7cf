// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What a touch makes of a plant: pressed, cut, burnt. Read by GLSL and C++.

// Lean of what lies flat, radians: blades rest on each other.
const float k_pressed_lean = 1.48f;
// Plants that are cut by `cut` have this times (1 / cut - 1) left, metres: fine where stubble is short.
const float k_cut_scale = 0.25f;
// Share of its height that a burnt plant keeps.
const float k_burnt_height = 0.18f;

// How far a species yields to what touches it, 0..1; kept below 0 beside the flag of those that grow nothing.
SWARD_FN float yields(SpeciesParams species) { return max(-species.kind.y, 0.0f); }

// Metres that a cut leaves.
SWARD_FN float height_left(float cut) { return k_cut_scale * (1.0f / max(cut, 1.0e-6f) - 1.0f); }

// Share of its height that a plant keeps. Stubble is uneven by the plant's own number.
SWARD_FN float share_left(PlantTraits t, Disturbed d, float yielding) {
  float stubble = height_left(d.cut * yielding) * (0.88f + 0.24f * t.phase);
  float left = min(stubble / max(t.height, 1.0e-6f), 1.0f);
  return left * (1.0f - (1.0f - k_burnt_height) * d.burn * yielding);
}

// A pressed plant turns to the press the short way, leans and stretches, its length kept: every kind obeys by its
// traits. Continuous in the press, so that rising plants do not jump.
// `left`: share_left().
SWARD_FN PlantTraits disturb_traits(PlantTraits t, Disturbed d, float yielding, float left) {
  t.height = t.height * left;
  float p = min(sqrt(d.press.x * d.press.x + d.press.y * d.press.y), 1.0f) * yielding;
  if (p <= 0.0f) return t;
  // Neighbours lie a little apart.
  float own = t.phase * 7.31f;
  float toward = atan(d.press.y, d.press.x) + 0.7f * (own - floor(own) - 0.5f);
  float turn = (toward - t.azimuth) / 6.2831853f;
  turn = (turn - floor(turn + 0.5f)) * 6.2831853f;
  float way = clamp(p / 0.4f, 0.0f, 1.0f);
  t.azimuth = t.azimuth + turn * (way * way * (3.0f - 2.0f * way));
  t.lean = t.lean + (max(t.lean, k_pressed_lean) - t.lean) * p;
  t.stiffness = t.stiffness + (max(t.stiffness, 0.9f) - t.stiffness) * p;
  return t;
}

// How far a plant lies, 0..1, told from its lean, which nothing else raises above the species' largest.
SWARD_FN float pressed_by_lean(float largest, float lean) {
  return clamp((lean - largest) / max(k_pressed_lean - largest, 0.05f), 0.0f, 1.0f);
}
