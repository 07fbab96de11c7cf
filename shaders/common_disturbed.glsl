// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What has touched a place. Read by GLSL and C++.

struct Disturbed {
  vec2 press;  // way that plants lie (east, north), its length how far: 0 upright .. 1 flat
  float cut;   // 0 uncut .. 1 at the ground
  float burn;  // 0 .. 1 black and short
  float wet;   // 0 dry .. 1
  vec4 paint;  // sRGB times amount; amount
};

// Press and water below this are nothing, so that what decays ends without a step (Disturbance::k_visible).
const float k_disturbed_visible = 0.02f;

SWARD_FN Disturbed undisturbed() {
  Disturbed d;
  d.press = vec2(0.0f);
  d.cut = 0.0f;
  d.burn = 0.0f;
  d.wet = 0.0f;
  d.paint = vec4(0.0f);
  return d;
}

SWARD_FN Disturbed mix_disturbed(Disturbed a, Disturbed b, float t) {
  Disturbed d;
  d.press = a.press + (b.press - a.press) * t;
  d.cut = a.cut + (b.cut - a.cut) * t;
  d.burn = a.burn + (b.burn - a.burn) * t;
  d.wet = a.wet + (b.wet - a.wet) * t;
  d.paint = a.paint + (b.paint - a.paint) * t;
  return d;
}

SWARD_FN float disturbed_seen(float amount) {
  return max(amount - k_disturbed_visible, 0.0f) / (1.0f - k_disturbed_visible);
}

// What is seen of decayed press and water.
SWARD_FN Disturbed settle_disturbed(Disturbed d) {
  float depth = sqrt(d.press.x * d.press.x + d.press.y * d.press.y);
  d.press = d.press * (disturbed_seen(depth) / max(depth, 1.0e-6f));
  d.wet = disturbed_seen(d.wet);
  return d;
}

// Share of a level's reach, 0..1, at which the next level takes over; `away`: larger of the distances east and north,
// against the reach.
SWARD_FN float next_disturbance_level(float away) {
  float t = clamp((away - 0.75f) / 0.25f, 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}
