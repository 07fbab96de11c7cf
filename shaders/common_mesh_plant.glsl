// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Plants that are small meshes: how much of one is drawn. GLSL only.

const float k_faces_a_part = 8.0;

// At this size on screen, pixels, and above, all faces are drawn; at least this share of them is.
const float k_all_faces_px = 90.0;
const float k_least_faces = 0.12;

// Faces of a plant of so many, fractional: smaller ones show fewer and larger ones, in the mesh's own random order (Cook,
// Halstead, Planck, Ryu, "Stochastic simplification of aggregate detail", 2007).
float shown_faces(float faces, float size_px) {
  return max(faces * clamp(size_px / k_all_faces_px, k_least_faces, 1.0), min(faces, 8.0));
}
