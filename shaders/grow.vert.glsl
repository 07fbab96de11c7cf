// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth: hands a fed-back cluster to tessellation; serves every kind of plant.
layout(location = 0) in uvec4 cluster;
layout(location = 0) out uvec4 cluster_words;

void main() { cluster_words = cluster; }
