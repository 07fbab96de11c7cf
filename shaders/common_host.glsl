// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// What a host adds to the light of everything that sward draws. These do nothing; a host puts its own in their place:
// ShaderLibrary::add_source("common_host.glsl", text), before it creates renderers. Positions are metres along the
// world's axes, relative to the eye; colours are linear radiance, before exposure. `frame` (common_frame.glsl) may be
// read. Called in fragment and geometry stages, so no derivatives: look textures up with textureLod. Units and uniform
// buffers that the host's functions read are the host's to bind, at numbers that gl::Bindings does not use.

// The last word on a surface's colour, after sward's haze (which Lighting::haze_distance_m puts out of sight).
vec3 host_fog(vec3 radiance, vec3 relative_position) { return radiance; }

// Share of the sun that comes to a place: 1 all, 0 none. Sward's own shadows come on top of it.
float host_shadow(vec3 relative_position) { return 1.0; }
