// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// A plant's own numbers and how much of it is shown: growing in, widening, sinking. Read by GLSL and C++.

// Drawn in this order from the seed's sequence (see common_philox.glsl).
struct PlantTraits {
  float height, width, stiffness;  // full-grown, metres, metres, 0..1
  float azimuth;                   // direction of bending, radians
  float age;                       // 0 fresh .. 1 old
  float lean;                      // of the root, radians
  float phase;                     // 0..1, for what moves
  uint state;                      // of the sequence, from which a kind draws its own numbers (common_kinds.glsl)
};

SWARD_FN PlantTraits make_traits(SpeciesParams species, LayerParams layer, uvec2 id, uint rank, float score) {
  uint state = random_pair(rank | k_sequence_space, id).x;
  SWARD_PRECISE float u_height = uniform_float(state);
  state = lcg_next(state);
  SWARD_PRECISE float u_width = uniform_float(state);
  state = lcg_next(state);
  SWARD_PRECISE float u_stiffness = uniform_float(state);
  state = lcg_next(state);
  SWARD_PRECISE float u_azimuth = uniform_float(state);
  state = lcg_next(state);
  SWARD_PRECISE float u_age = uniform_float(state);
  state = lcg_next(state);
  SWARD_PRECISE float u_lean = uniform_float(state);
  state = lcg_next(state);
  SWARD_PRECISE float u_phase = uniform_float(state);

  PlantTraits t;
  // Where two species are balanced (s' near one half) plants stay smaller.
  SWARD_PRECISE float vigour = 0.6f + 0.4f * min(2.0f * score, 1.0f);
  SWARD_PRECISE float height = (species.size.x + (species.size.y - species.size.x) * u_height) * vigour;
  SWARD_PRECISE float width = species.size.z + (species.size.w - species.size.z) * u_width;
  SWARD_PRECISE float stiffness = species.posture.x + (species.posture.y - species.posture.x) * u_stiffness;
  // Phototropic plants bend towards the sun's azimuth, the more the narrower around it.
  SWARD_PRECISE float spread = (u_azimuth - 0.5f) * 6.2831853f;
  SWARD_PRECISE float azimuth = layer.detail.w + spread * (1.0f - species.posture.w);
  if (species.posture.w == 0.0f) azimuth = spread;
  SWARD_PRECISE float age = clamp(u_age * 2.0f * species.tint.w, 0.0f, 1.0f);
  t.height = height;
  t.width = width;
  t.stiffness = stiffness;
  t.azimuth = azimuth;
  t.age = age;
  t.lean = u_lean * species.posture.z;
  t.phase = u_phase;
  t.state = state;
  return t;
}

struct Presence {
  float fade;   // 0: not there .. 1: full size; growing in times sinking
  float grow;   // growing in alone
  float widen;  // factor on the width, 1..8
};

// Ranks count from a start between 0 and 1 that is the triangle's own: where 2.3 seeds are due, three triangles of ten
// show a third. Without it every triangle would round up, and thin layers would stand far too dense.
SWARD_FN float first_rank(uvec2 id) { return uniform_float(random_pair(k_triangle_index, id).x); }

// How much of the seed of this rank is shown at distance d (metres, eye to seed). `limit` is the record's: for the
// distance law area * rho0, else the triangle's seed count.
SWARD_FN Presence seed_presence(LayerParams layer, float limit, uvec2 id, uint rank, float d) {
  SWARD_PRECISE float r = float(rank);
  SWARD_PRECISE float thinning = 1.0f;
  SWARD_PRECISE float here = limit;
  if (layer.law.x == 0.0f) {
    thinning = pow(max(d / layer.law.z, 1.0f), layer.law.w);
    here = limit / thinning;
  } else {
    thinning = max(layer.detail.z / max(limit, 1.0f), 1.0f);
  }
  Presence p;
  p.grow = r < here && d <= layer.reach.x ? 1.0f : 0.0f;
  p.fade = p.grow;
  p.widen = 1.0f;
  if (layer.reach.z != 0.0f) return p;
  r = r + first_rank(id);
  SWARD_PRECISE float margin = clamp((layer.reach.x - d) / (0.2f * layer.reach.x), 0.0f, 1.0f);
  here = here * margin;
  SWARD_PRECISE float grow = here > 0.0f ? clamp((here - r) / (0.4f * here), 0.0f, 1.0f) : 0.0f;
  SWARD_PRECISE float fade = grow * margin;
  p.grow = grow;
  p.fade = fade;
  p.widen = min(thinning, 8.0f);
  return p;
}

// Equation 4: segments of a plant at distance d, fractional.
SWARD_FN float segment_count(SpeciesParams species, LayerParams layer, float d) {
  float ratio = max(d / layer.detail.x, 1.0f);
  return max(species.kind.z / (ratio * ratio), 1.0f);
}
