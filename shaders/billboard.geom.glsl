// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of shrubs and trees. The first piece of the line is the trunk, each further one a cluster of leaves at its own
// place in the crown, a square that faces the eye: so crowns have depth and turn with the eye's way around them. Far away
// fewer clusters, larger ones, stand for all (Cook, Halstead, Planck, Ryu, "Stochastic simplification of aggregate
// detail", 2007); clusters keep their numbers and shrink to nothing one after the other.
layout(lines, invocations = SWARD_GROWTH_INVOCATIONS) in;
layout(triangle_strip, max_vertices = 4) out;

#include "common_object_shape.glsl"
#include "common_triangle.glsl"

layout(location = 0) uniform int sward_species;

const float k_trunk_part = 1000.0;  // number of the trunk
const float k_overlap = 2.1;        // area of all clusters against the crown's outline

struct Tree {
  Object object;
  SpeciesParams species;
  vec3 centre;      // of the crown, relative to the eye
  vec3 half_size;   // of the crown, metres
  float clusters;   // fractional
  float cover;
};

#if SWARD_WIND
// The softest trunk's top inclines by this much in the strongest wind, radians.
const float k_tree_bend = 0.9;
const float k_tree_wind = 20.0;  // m/s: half of that

// Of an arc as long as it is high, its top inclined by `pull`, radians.
vec3 arc_at(vec2 pull, float up) {
  float angle = max(length(pull), 1.0e-3);
  float half_turn = 0.5 * angle * up;
  float chord = 2.0 * sin(half_turn) / angle;
  return vec3(pull * (chord * sin(half_turn) / angle), chord * cos(half_turn));
}

// What the wind does to a trunk that inclines by `own` at its top, shares of its height.
vec3 blown_aside(Object o, vec2 own, float up) {
  vec2 wind = swaying_wind(object_air(), 0);
  vec2 pull = own + wind * (k_tree_bend * (1.0 - 0.75 * o.stiffness) / (length(wind) + k_tree_wind));
  return arc_at(pull, up) - arc_at(own, up);
}
#endif

vec3 trunk_at(Object o, float up) {
  vec2 aside = vec2(cos(o.azimuth), sin(o.azimuth)) * (sin(o.lean) * o.height * up * up);
#if SWARD_WIND
  vec2 own = vec2(cos(o.azimuth), sin(o.azimuth)) * (2.0 * sin(o.lean));
  return o.root + vec3(aside, o.height * up) + o.height * blown_aside(o, own, up);
#else
  return o.root + vec3(aside, o.height * up);
#endif
}

Tree this_tree() {
  Tree t;
  t.object = this_object();
  t.species = sward_layer.species[sward_species];
  Object o = t.object;
  float bare = t.species.own_a.x;
  t.centre = trunk_at(o, 0.5 * (1.0 + bare));
  t.half_size = vec3(0.5 * o.width, 0.5 * o.width, 0.5 * (1.0 - bare) * o.height);
  t.clusters = max(o.parts - 1.0, 1.0);
  t.cover = cover_small(pixels(o, max(o.height, o.width)));
  return t;
}

// Van der Corput's sequence: any number of the first clusters fill the crown evenly.
float radical_inverse(uint i) { return float(bitfieldReverse(i)) * 2.3283064365386963e-10; }

// A cluster of leaves: its place from the crown's middle in shares of the crown, its radius in metres.
struct Cluster3 {
  vec3 place;
  vec2 radius;  // across, up
  float leaves;  // its radius when all clusters are shown: leaves keep their size against it
};

Cluster3 leaf_cluster(Tree t, uint i) {
  Object o = t.object;
  float taper = t.species.own_a.y;
  float v = radical_inverse(i + 1u) + 0.12 * (own_number(o, 3u * i + 40u) - 0.5);
  v = clamp(v, 0.02, 0.97);
  // Height in the crown, 0..1: a cone has more of its leaves below, its top is no cluster of its own.
  float up = mix(v, 0.9 * (1.0 - pow(1.0 - v, 0.72)), taper);
  float outline = mix(sqrt(max(1.0 - (2.0 * up - 1.0) * (2.0 * up - 1.0), 0.0)), 1.0 - 0.92 * up, taper);
  float turn = o.azimuth + 2.3999632 * float(i) + 0.9 * own_number(o, 3u * i + 41u);
  float depth = mix(0.45, 0.82, own_number(o, 3u * i + 42u)) * outline;
  Cluster3 c;
  c.place = vec3(cos(turn) * depth, sin(turn) * depth, (2.0 * up - 1.0) * 0.84);
  float most = max(t.species.kind.z, 1.0);
  float merged = clamp((most - t.clusters) / max(most - 1.0, 1.0), 0.0, 1.0);
  // One cluster alone is the crown; two or three come near to it.
  float together = pow(merged, 12.0);
  // The last cluster, partly grown, covers less than its part.
  float whole = floor(t.clusters), last = t.clusters - whole;
  float share = mix(k_overlap, 1.3, together) / (whole + last * last);
  float shown = clamp(t.clusters - float(i), 0.0, 1.0);
  float size = sqrt(share) * shown * mix(1.0, 0.62 + 0.6 * (1.0 - up), taper * (1.0 - merged)) *
               mix(0.85, 1.15, own_number(o, 3u * i + 43u));
  c.place *= 1.0 - together;
  vec2 crown = t.half_size.xz;
  c.leaves = sqrt(k_overlap / most * crown.x * crown.y);
  c.radius = size * mix(vec2(sqrt(crown.x * crown.y)), crown, together);
  return c;
}

// Middle of a cluster, relative to the eye.
vec3 cluster_middle(Tree t, Cluster3 c) {
#if SWARD_WIND
  // Each is carried aside as the trunk is at its own height.
  float bare = t.species.own_a.x;
  vec2 own = vec2(cos(t.object.azimuth), sin(t.object.azimuth)) * (2.0 * sin(t.object.lean));
  vec3 carried = blown_aside(t.object, own, mix(bare, 1.0, 0.5 + 0.5 * c.place.z)) -
                 blown_aside(t.object, own, 0.5 * (1.0 + bare));
  return t.centre + c.place * t.half_size + t.object.height * carried;
#else
  return t.centre + c.place * t.half_size;
#endif
}

#if SWARD_WIND
// A cluster's leaves, turned to and fro by the wind.
mat2 leaf_flutter(Object o, uint i) {
  PlantAir air = object_air();
  float turn = 0.5 * fluttering(air, length(air.wind), own_number(o, 3u * i + 44u));
  return mat2(cos(turn), sin(turn), -sin(turn), cos(turn));
}
#endif

void emit_cluster(Tree t, uint i) {
  Cluster3 c = leaf_cluster(t, i);
  if (c.radius.x <= 0.0) return;
  vec3 centre = cluster_middle(t, c);
  vec3 to_eye = normalize(-centre);
  vec3 right = vec3(-to_eye.y, to_eye.x, 0.0);
  // Straight above any direction will do.
  right = dot(right, right) < 1.0e-8 ? vec3(1.0, 0.0, 0.0) : normalize(right);
  vec3 up = cross(to_eye, right);
  vec3 outward = c.place;
  // Light that comes to the cluster through the others: least inside and below.
  float open = clamp(0.30 + 0.62 * length(c.place) + 0.30 * c.place.z, 0.0, 1.0);
#if SWARD_WIND
  mat2 flutter = leaf_flutter(t.object, i);
#endif
  for (int corner = 0; corner < 4; ++corner) {
    vec2 at = vec2(corner & 1, corner >> 1) * 2.0 - 1.0;
    vec3 aside = right * at.x + up * at.y;
    Part part = Part(at, t.cover, float(i), k_part_object - c.leaves, open);
#if SWARD_WIND
    at = flutter * at;
#endif
    vec3 position = centre + right * (at.x * c.radius.x) + up * (at.y * c.radius.y);
    emit(t.object, part, position, 0.9 * outward + 0.55 * aside + 0.45 * to_eye + vec3(0.0, 0.0, 0.15));
  }
  EndPrimitive();
}

float trunk_half_width(Tree t, float up) { return t.object.height * mix(0.016, 0.006, up); }

// From a little below the ground, so that it stands in any slope, to the crown's middle.
void emit_trunk(Tree t) {
  float top = 0.5 * (1.0 + t.species.own_a.x);
  for (int i = 0; i < 2; ++i) {
    float up = i == 0 ? -0.03 : top;
    vec3 middle = trunk_at(t.object, up);
    vec3 side = normalize(vec3(middle.y, -middle.x, 0.0) + vec3(1.0e-6, 0.0, 0.0));
    float wide = trunk_half_width(t, max(up, 0.0));
    float grown = inflation(pixels(t.object, 2.0 * wide));
    for (int edge = -1; edge < 2; edge += 2) {
      Part part = Part(vec2(float(edge), up), t.cover / grown, k_trunk_part, k_part_object, 1.0);
      vec3 towards = -normalize(vec3(middle.xy, 1.0e-3));
      emit(t.object, part, middle + side * (float(edge) * wide * grown), towards + 1.2 * float(edge) * side);
    }
  }
  EndPrimitive();
}

// The drawn ground below a place (relative to the eye), where the object's own triangle has it; else its plane.
struct GroundPatch {
  vec3 point, normal;
};

GroundPatch ground_at(Object o, vec2 place) {
  float fall = dot(o.plane.xy, place - o.root.xy) / max(o.plane.z, 0.05);
  GroundPatch g = GroundPatch(vec3(place, o.root.z - fall), o.plane);
  Triangle triangle = fetch_triangle(line_record[0]);
  vec2 q = place - triangle.apex.xy;
  float area = triangle.to_left.x * triangle.to_right.y - triangle.to_left.y * triangle.to_right.x;
  vec2 weights = vec2(q.x * triangle.to_right.y - q.y * triangle.to_right.x,
                      q.y * triangle.to_left.x - q.x * triangle.to_left.y) / area;
  if (min(weights.x, weights.y) < 0.0 || weights.x + weights.y > 1.0) return g;
  SurfacePoint surface = surface_at(triangle, weights);
  return GroundPatch(vec3(place, surface.z), surface.normal);
}

// A cluster's soft shadow: an ellipse on the ground where the light through its middle meets it.
void emit_cluster_shadow(Tree t, uint i, float strength) {
  Cluster3 c = leaf_cluster(t, i);
  if (c.radius.x <= 0.0) return;
  Object o = t.object;
  vec3 centre = cluster_middle(t, c);
  ShadowPlane plane = object_shadow_plane(o);
  vec3 hit = cast_shadow(plane, centre);
  GroundPatch g = ground_at(o, hit.xy);
  vec3 sun = frame.sun_direction.xyz;
  float facing = max(dot(g.normal, sun), 0.08);
  vec3 along = sun - g.normal * dot(g.normal, sun);
  along = dot(along, along) < 1.0e-6 ? vec3(1.0, 0.0, 0.0) : normalize(along);
  vec3 across = cross(g.normal, along);
  float radius = 0.5 * (c.radius.x + c.radius.y);
  float stretched = radius * min(1.0 / facing, k_longest_shadow);
  for (int corner = 0; corner < 4; ++corner) {
    vec2 at = vec2(corner & 1, corner >> 1) * 2.0 - 1.0;
    Part part = Part(at, t.cover, float(i), strength, 1.0);
    vec3 level = g.point + across * (at.x * radius) + along * (at.y * stretched);
    GroundPatch below = ground_at(o, level.xy);
    emit(o, part, lifted(plane, below.point), g.normal);
  }
  EndPrimitive();
}

void emit_trunk_shadow(Tree t, float strength) {
  Object o = t.object;
  ShadowPlane ground = object_shadow_plane(o);
  for (int i = 0; i < 2; ++i) {
    float up = i == 0 ? 0.0 : 0.5 * (1.0 + t.species.own_a.x);
    vec3 foot = cast_on_ground(ground, trunk_at(o, up));
    vec3 way = cross(o.plane, frame.sun_direction.xyz);
    vec3 side = way / max(length(way), 1.0e-4) * trunk_half_width(t, up);
    for (int edge = -1; edge < 2; edge += 2) {
      Part part = Part(vec2(float(edge), up), t.cover, k_trunk_part, strength, 1.0);
      emit(o, part, foot + side * float(edge), o.plane);
    }
  }
  EndPrimitive();
}

void main() {
  Tree t = this_tree();
  int piece = int(floor(t.object.first * ceil(line_self[0].w) + 0.5));
  if (float(piece) >= t.clusters + 1.0) return;
  if (gl_InvocationID == 0) {
    if (piece == 0) emit_trunk(t);
    else emit_cluster(t, uint(piece - 1));
    return;
  }
  float strength = object_shadow_strength(t.object);
  if (strength <= 0.01) return;
  if (piece == 0) emit_trunk_shadow(t, strength);
  else emit_cluster_shadow(t, uint(piece - 1), strength);
}
