// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// How dark shadows are. GLSL only.

// Sunlight left in the densest shadow: light between the blades and through them.
const float k_shadow_light = 0.12;

// Share of the sun that comes to ground in a shadow of this strength, 0..1.
float shadow_light(float strength) { return mix(1.0, k_shadow_light, strength); }
