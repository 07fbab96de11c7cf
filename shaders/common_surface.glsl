// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Plants on meshes: what differs from terrain. Read by GLSL and C++.
//
// A record's texel and texel_fraction hold the colours of the corners, each red * 65536 + green * 256 + blue:
//   texel.x apex, texel.y left, texel_fraction.x right

SWARD_FN vec3 unpack_corner(int color) {
  return vec3(float((color >> 16) & 255), float((color >> 8) & 255), float(color & 255));
}

// sRGB, 0..1, at a point given in weights (left, right).
SWARD_FN vec3 surface_color(ivec2 texel, vec2 texel_fraction, vec2 point) {
  vec3 apex = unpack_corner(texel.x);
  vec3 left = unpack_corner(texel.y);
  vec3 right = unpack_corner(int(texel_fraction.x));
  SWARD_PRECISE vec3 along = (left - apex) * point.x;
  SWARD_PRECISE vec3 across = (right - apex) * point.y;
  SWARD_PRECISE vec3 color = apex + along + across;
  SWARD_PRECISE vec3 unit = color / 255.0f;
  return unit;
}

SWARD_FN vec3 triangle_normal(vec3 to_left, vec3 to_right) {
  SWARD_PRECISE float x = to_left.y * to_right.z - to_left.z * to_right.y;
  SWARD_PRECISE float y = to_left.z * to_right.x - to_left.x * to_right.z;
  SWARD_PRECISE float z = to_left.x * to_right.y - to_left.y * to_right.x;
  SWARD_PRECISE float size = sqrt(x * x + y * y + z * z);
  SWARD_PRECISE vec3 normal = vec3(x / size, y / size, z / size);
  return normal;
}

// How far plants on a wall turn to hang down: 0 in any direction, 1 all straight down.
const float k_hanging = 0.7f;

// A plant's posture in the frame of its surface, whose first axis points downhill: the steeper the surface, the closer
// around that plants bend; under an overhang they hang along their axis.
SWARD_FN PlantTraits settle_traits(PlantTraits t, vec3 normal) {
  SWARD_PRECISE float tilt = min(sqrt(normal.x * normal.x + normal.y * normal.y), 1.0f);
  SWARD_PRECISE float azimuth = t.azimuth * (1.0f - k_hanging * tilt);
  SWARD_PRECISE float stiffness = t.stiffness + (1.0f - t.stiffness) * max(-normal.z, 0.0f);
  t.azimuth = azimuth;
  t.stiffness = stiffness;
  return t;
}
