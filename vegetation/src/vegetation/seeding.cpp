// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// How many seeds a triangle gets, and their layout for instanced draws.
//
// After D. Papavasiliou, "Real-Time Grass (and Other Procedural Objects) on Terrain" (2015): equations 1 and 2 (the
// second with its sign mended, since v runs from the observer to the triangle) and section 3.2. Departures: a law of
// distance, upper edges instead of centres for the geometric bins so that no triangle gets fewer seeds than it asked
// for, and this frame's extremes instead of the last one's.

#include <sward/vegetation/seeding.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "terrain/usable_view.h"
#include "vegetation/exclusion_index.h"
#include "vegetation/fertile_ground.h"
#include "vegetation/triangle_record.h"

namespace sward {

namespace {

/// Ranks above are not exact in a float. Far beyond what a layer that validates asks for.
constexpr float k_most_seeds = 16777216.0f;

float distance_law(const Layer& layer, float zoom, float area, float distance) {
  const float ratio = std::max(distance / (layer.full_distance_m * zoom), 1.0f);
  return area * layer.density / std::pow(ratio, layer.falloff);
}

float screen_law(const Layer& layer, float screen_area) {
  if (std::isinf(screen_area)) return float(layer.ceiling);
  return std::min(layer.density * std::pow(screen_area, layer.falloff), float(layer.ceiling));
}

/// A triangle's area, its direction from the eye, and the cosine between that and its normal; positive for ground that
/// is seen.
struct Seen {
  double area, distance, facing;
};

/// Area times normal is half the cross product.
Seen seen_from(const View& view, const FixedTriangle& triangle) {
  const glm::dvec3 to_left(triangle.to_left), to_right(triangle.to_right);
  const glm::dvec3 v = triangle.apex - view.eye + (to_left + to_right) / 3.0;
  const glm::dvec3 normal = 0.5 * glm::cross(to_left, to_right);
  const double area = glm::length(normal), distance = glm::length(v);
  return {area, distance, -glm::dot(normal, v) / (area * distance)};
}

/// Equation 2 without its density, as it is.
double plain_area(const Seen& seen) {
  return std::max(seen.facing, 0.0) * seen.area / (seen.distance * seen.distance);
}

/// The same for counts that change slowly. Plants come and go by rank as a triangle's count changes, and the nearer
/// they are, the more pixels that is; so near by the count stays what it is at a distance. Ground that is seen from its
/// edge shows its plants nevertheless, since they stand upright; so the cosine falls to 0 smoothly, beyond the edge.
double steady_area(const Layer& layer, float zoom, const Seen& seen) {
  const double distance = std::max(seen.distance, 2.0 * double(layer.full_distance_m * zoom));
  const double facing = 0.5 * (seen.facing + std::sqrt(seen.facing * seen.facing + 0.25));
  return facing * seen.area / (distance * distance);
}

/// Equation 1 grows towards the borders of the picture, so that turning the head would change plants: outside of plain
/// layers the area counts as it is in the picture's middle.
float screen_count(const Layer& layer, const View& view, float zoom, const FixedTriangle& triangle) {
  if (layer.plain) return screen_law(layer, triangle.screen_area);
  const double focal = view.clip_from_eye[1][1];
  return screen_law(layer, float(focal * focal * steady_area(layer, zoom, seen_from(view, triangle))));
}

float world_count(const Layer& layer, const View& view, float zoom, const FixedTriangle& triangle) {
  const Seen seen = seen_from(view, triangle);
  const double area = layer.plain ? plain_area(seen) : steady_area(layer, zoom, seen);
  return float(std::min(double(layer.density) * area, double(layer.ceiling)));
}

float limit_at(const Layer& layer, const View& view, float zoom, const FixedTriangle& triangle, float distance) {
  if (!(distance <= layer.horizon_m * zoom)) return 0.0f;
  switch (layer.law) {
    case DensityLaw::distance:
      return distance_law(layer, zoom, triangle.area, distance);
    case DensityLaw::screen_area:
      return screen_count(layer, view, zoom, triangle);
    case DensityLaw::world_area:
      return world_count(layer, view, zoom, triangle);
  }
  return 0.0f;
}

/// A node of the drawn surface below a triangle: corners as weights of (left, right).
struct SurfaceCorner {
  glm::vec2 apex, left, right;
  uint32_t node;
};

/// How far the drawn surface leaves the plane of triangle i, metres, up or down.
float surface_deviation(const FixedTriangles& triangles, size_t i) {
  SurfaceCorner stack[64];
  int size = 0;
  float deviation = 0.0f;
  const std::span<const SurfaceNode> nodes = triangles.nodes();
  const double base = triangles.surface_z() - triangles.apex()[i].z;
  const float left = triangles.to_left()[i].z, right = triangles.to_right()[i].z;
  stack[size++] = {{0.0f, 0.0f}, {1.0f, 0.0f}, {0.0f, 1.0f}, triangles.surface()[i]};
  while (size > 0) {
    const SurfaceCorner at = stack[--size];
    const SurfaceNode& node = nodes[at.node];
    const glm::vec2 middle = 0.5f * (at.left + at.right);
    const float plane = middle.x * left + middle.y * right;
    deviation = std::max(deviation, std::abs(float(double(node.z) + base) - plane));
    SWARD_ASSERT(size + 2 <= 64, "a triangle's drawn surface is deeper than any bintree");
    if (node.child[0] != 0) stack[size++] = {middle, at.apex, at.left, node.child[0]};
    if (node.child[1] != 0) stack[size++] = {middle, at.right, at.apex, node.child[1]};
  }
  return deviation;
}

/// A bound from below: where the mesh is finer than the triangle, seeds stand off its plane.
float nearest_seed(const FixedTriangles& triangles, size_t i) {
  const float distance = triangles.distance()[i];
  return triangles.surface()[i] == 0 ? distance : std::max(distance - surface_deviation(triangles, i), 0.0f);
}

/// limit_at() of triangle i for its nearest seed. The law of distance reads three columns, so nothing is gathered.
float limit_of(const Layer& layer, const View& view, float zoom, const FixedTriangles& triangles, size_t i) {
  const float distance = nearest_seed(triangles, i);
  if (!(distance <= layer.horizon_m * zoom)) return 0.0f;
  if (layer.law == DensityLaw::distance) return distance_law(layer, zoom, triangles.area()[i], distance);
  return limit_at(layer, view, zoom, triangles[i], distance);
}

/// Whether excluded shapes cover all of triangle i; else what it needs to know of them.
bool excluded(const FixedTriangles& triangles, size_t i, Seeding& out) {
  const size_t first = out.exclusions.size();
  const Reach reach = out.scratch.index->shapes_near(glm::dvec2(triangles.apex()[i]), glm::vec2(triangles.to_left()[i]),
                                                     glm::vec2(triangles.to_right()[i]), out.exclusions);
  if (reach == Reach::all) {
    out.exclusions.resize(first);
    return true;
  }
  if (reach == Reach::some) {
    out.exclusions.emplace_back(0.0f);
    out.counts[i].exclusions = uint32_t(first);
  }
  return false;
}

/// How far triangles extend from their apex, east-west or north-south, metres.
double largest_extent(const FixedTriangles& triangles) {
  glm::vec2 extent(0.0f);
  for (size_t i = 0; i < triangles.size(); ++i) {
    extent = glm::max(
        extent, glm::max(glm::abs(glm::vec2(triangles.to_left()[i])), glm::abs(glm::vec2(triangles.to_right()[i]))));
  }
  return double(std::max(extent.x, extent.y));
}

void follow_exclusions(const Layer& layer, const FixedTriangles& triangles, const Exclusions* exclusions,
                       Seeding& out) {
  if (!out.scratch.index) out.scratch.index = std::make_shared<ExclusionIndex>();
  const bool any = exclusions != nullptr && exclusions->size() > 0;
  out.scratch.index->follow(exclusions, layer.name, any ? largest_extent(triangles) : 0.0);
  out.exclusions.assign(1, glm::vec4(0.0f));
}

/// Whether the ground's colours can feed no species on triangle i.
bool barren(FertileGround& ground, const FixedTriangles& triangles, size_t i) {
  const glm::dvec2 apex(triangles.apex()[i]);
  return ground.barren(apex, apex + glm::dvec2(triangles.to_left()[i]), apex + glm::dvec2(triangles.to_right()[i]));
}

/// Seeds of every triangle; their smallest and largest number goes to n_min and n_max. Without a map (on meshes) all
/// ground is fertile.
void count_seeds(const Layer& layer, const View& view, const ColorMap* map, const FixedTriangles& triangles,
                 Seeding& out) {
  if (map != nullptr) {
    if (!out.scratch.ground) out.scratch.ground = std::make_shared<FertileGround>();
    out.scratch.ground->follow(layer, *map);
  }
  const float zoom = float(view.zoom());
  const float full = layer.law == DensityLaw::distance ? layer.density : 0.0f;
  uint32_t least = UINT32_MAX, most = 0;
  const std::span<const float> area = triangles.area();
  out.counts.resize(triangles.size());
  for (size_t i = 0; i < triangles.size(); ++i) {
    const float limit = limit_of(layer, view, zoom, triangles, i);
    const uint32_t submitted = limit > 0.0f ? uint32_t(std::ceil(std::min(limit, k_most_seeds))) : 0u;
    out.counts[i] = {full > 0.0f ? area[i] * full : limit, submitted, 0, 0};
    if (submitted == 0) continue;
    if ((map != nullptr && barren(*out.scratch.ground, triangles, i)) ||
        (!out.scratch.index->empty() && excluded(triangles, i, out))) {
      out.counts[i].submitted = 0;
      continue;
    }
    least = std::min(least, submitted);
    most = std::max(most, submitted);
  }
  out.n_min = most > 0 ? float(least) : 0.0f;
  out.n_max = float(most);
}

/// Bin of a count, smallest first: the first whose upper edge reaches it. The logarithm guesses, the edges decide.
uint32_t bin_of(float count, float n_min, float bins_per_log, const std::array<float, k_density_bins>& edges) {
  const int guess = int(std::log(count / n_min) * bins_per_log);
  int bin = std::clamp(guess, 0, k_density_bins - 1);
  while (bin > 0 && count <= edges[bin - 1]) --bin;
  while (bin < k_density_bins - 1 && count > edges[bin]) ++bin;
  return uint32_t(bin);
}

/// Bins in drawing order (largest count first), with their sizes and first records.
void lay_out_bins(const Layer& layer, Seeding& out) {
  const std::array<float, k_density_bins> edges = bin_edges(out.n_min, out.n_max);
  const float bins_per_log = out.n_max > out.n_min ? float(k_density_bins) / std::log(out.n_max / out.n_min) : 0.0f;
  for (Seeding::Count& count : out.counts) {
    if (count.submitted == 0) continue;
    count.bin = uint32_t(k_density_bins - 1) - bin_of(float(count.submitted), out.n_min, bins_per_log, edges);
    ++out.bins[count.bin].triangles;
  }
  uint32_t first = 0;
  for (int i = 0; i < k_density_bins; ++i) {
    DensityBin& bin = out.bins[i];
    bin.first = first;
    first += bin.triangles;
    if (bin.triangles == 0) continue;
    bin.clusters = uint32_t(std::ceil(edges[k_density_bins - 1 - i] / float(layer.cluster_size)));
    out.clusters += bin.triangles * bin.clusters;
  }
  out.records.resize(first);
  out.source.resize(first);
}

/// Triangles that submit seeds, nearest first to within steps of 2 sqrt(d r) / 1024 metres, r being the farthest: what
/// is drawn first hides the rest before it is shaded.
void sort_by_distance(const FixedTriangles& triangles, Seeding& out) {
  constexpr size_t k_steps = 1024;
  const std::span<const float> distance = triangles.distance();
  float farthest = 1.0e-3f;
  for (size_t i = 0; i < triangles.size(); ++i)
    if (out.counts[i].submitted > 0) farthest = std::max(farthest, distance[i]);
  const auto step = [&](size_t i) {
    return std::min(size_t(float(k_steps) * std::sqrt(distance[i] / farthest)), k_steps - 1);
  };
  std::array<uint32_t, k_steps + 1> next{};
  for (size_t i = 0; i < triangles.size(); ++i)
    if (out.counts[i].submitted > 0) ++next[step(i) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  out.scratch.near_first.resize(next.back());
  for (size_t i = 0; i < triangles.size(); ++i)
    if (out.counts[i].submitted > 0) out.scratch.near_first[next[step(i)]++] = uint32_t(i);
}

TriangleRecord make_record(const RecordMaker& maker, const View& view, const FixedTriangles& triangles, size_t i,
                           const Seeding::Count& count) {
  TriangleRecord record = maker.make(triangles, i);
  record.apex = glm::vec3(triangles.apex()[i] - view.eye);
  record.limit = count.limit;
  record.surface_z = float(triangles.surface_z() - view.eye.z);
  record.submitted = count.submitted;
  record.exclusions = count.exclusions;
  return record;
}

}  // namespace

float seed_limit(const Layer& layer, const View& view, const FixedTriangle& triangle) {
  return limit_at(layer, view, float(view.zoom()), triangle, triangle.distance);
}

std::array<float, k_density_bins> bin_edges(float n_min, float n_max) {
  std::array<float, k_density_bins> edges{};
  const double ratio = double(n_max) / double(n_min);
  for (int i = 0; i < k_density_bins; ++i) {
    edges[i] = float(double(n_min) * std::pow(ratio, double(i + 1) / double(k_density_bins)));
  }
  edges[k_density_bins - 1] = n_max;
  return edges;
}

namespace {

void seed_triangles(const Layer& layer, const View& view, const RecordMaker& maker, const ColorMap* map,
                    const FixedTriangles& triangles, const Exclusions* exclusions, Seeding& out) {
  out.bins = {};
  out.clusters = 0;
  out.surface_z_origin = triangles.surface_z();
  out.records.clear();
  out.source.clear();
  if (!usable(view, "seed")) return;
  follow_exclusions(layer, triangles, exclusions, out);
  count_seeds(layer, view, map, triangles, out);
  if (out.n_max == 0.0f) return;
  lay_out_bins(layer, out);
  std::array<uint32_t, k_density_bins> next{};
  for (int i = 0; i < k_density_bins; ++i) next[i] = out.bins[i].first;
  sort_by_distance(triangles, out);
  for (const uint32_t i : out.scratch.near_first) {
    const uint32_t place = next[out.counts[i].bin]++;
    out.records[place] = make_record(maker, view, triangles, i, out.counts[i]);
    out.source[place] = i;
  }
}

}  // namespace

void seed(const Layer& layer, const View& view, const ColorMap& map, const FixedTriangles& triangles, Seeding& out,
          const Exclusions* exclusions) {
  SWARD_ASSERT(!layer.on_mesh, "a layer on a mesh is seeded with its MeshSurface");
  seed_triangles(layer, view, RecordMaker(layer, map), &map, triangles, exclusions, out);
}

void seed(const Layer& layer, const View& view, const MeshSurface& surface, const FixedTriangles& triangles,
          Seeding& out) {
  SWARD_ASSERT(layer.on_mesh, "a layer on terrain is seeded with its base map");
  seed_triangles(layer, view, RecordMaker(layer, surface), nullptr, triangles, nullptr, out);
}

}  // namespace sward
