// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What the geometry stage of strips hands to their fragments; SWARD_LINK is `out` there and `in` here. Where vertices
// are lit, fragments are handed no more than they ask for: a third of the rest. GLSL only.

layout(location = 0) SWARD_LINK vec3 strip_place;      // arc length, of heads radius; -1..1 across; share of the strip
                                                       // that the plant covers
layout(location = 1) flat SWARD_LINK vec2 strip_self;  // phase; shadow's strength, or -1 - shoot
layout(location = 2) SWARD_LINK vec3 strip_lit;        // colour as the target takes it, without detail: of the shadow,
                                                       // and of the leaf where vertices are lit; not of heads
#if !SWARD_LIT_AT_VERTICES
layout(location = 3) SWARD_LINK vec3 strip_point;        // relative to the eye
layout(location = 4) SWARD_LINK vec4 strip_normal;       // towards the viewer, rounded, the ground's share in it; leaf_gloss
layout(location = 5) SWARD_LINK vec4 strip_light;        // canopy_light: sky, sun; leaf_through; cosine for leaf_streak
layout(location = 6) flat SWARD_LINK vec4 strip_color;   // ground at the root; age. Of heads linear; 0 petal, 0.5 all of
                                                         // the head, 1 centre
layout(location = 7) flat SWARD_LINK vec4 strip_ground;  // normal; melting
layout(location = 8) flat SWARD_LINK vec2 strip_map;     // base map coordinates below the eye
#endif
