// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Growth of kinds made of shoots: a cluster, and the instance that says which of its plants' shoots are grown.
layout(location = 0) in uvec4 cluster;
layout(location = 0) out uvec4 cluster_words;
layout(location = 1) out int cluster_instance;

void main() {
  cluster_words = cluster;
  cluster_instance = gl_InstanceID;
}
