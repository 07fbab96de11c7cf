// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

#include <sward/terrain/many_views.h>

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace sward {

namespace {

bool each_mesh_once(std::span<const MeshUpdate> updates) {
  std::vector<const RoamMesh*> meshes;
  for (const MeshUpdate& update : updates) meshes.push_back(update.mesh);
  std::sort(meshes.begin(), meshes.end());
  return (meshes.empty() || meshes.front()) && std::adjacent_find(meshes.begin(), meshes.end()) == meshes.end();
}

}  // namespace

void update_all(std::span<MeshUpdate> updates, int threads) {
  SWARD_ASSERT(each_mesh_once(updates), "update_all needs meshes, each of them once");
  SWARD_ASSERT(threads >= 0, "the number of threads must not be negative");
  std::atomic<size_t> next{0};
  const auto work = [&] {
    for (size_t i = next++; i < updates.size(); i = next++) {
      MeshUpdate& u = updates[i];
      u.stats = u.time_s ? u.mesh->update(u.view, *u.time_s) : u.mesh->update(u.view);
    }
  };
  const size_t wanted = threads > 0 ? size_t(threads) : std::max(1u, std::thread::hardware_concurrency());
  std::vector<std::thread> helpers;
  for (size_t i = 1; i < std::min(wanted, updates.size()); ++i) helpers.emplace_back(work);
  work();
  for (std::thread& helper : helpers) helper.join();
}

}  // namespace sward
