// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Plants by region: the bintree's triangles of the layer's level are found from the lattice alone.

#include <sward/vegetation/plants.h>

#include <algorithm>
#include <cmath>

#include "vegetation/exclusion_index.h"
#include "vegetation/plant_grower.h"
#include "vegetation/triangle_record.h"

namespace sward {

namespace {

/// Seeds looked at for each plant that may come of it.
constexpr double k_seeds_a_plant = 64;

bool overlaps(const PlantRegion& region, const glm::dvec2 (&corners)[3]) {
  const glm::dvec2 low = glm::min(corners[0], glm::min(corners[1], corners[2]));
  const glm::dvec2 high = glm::max(corners[0], glm::max(corners[1], corners[2]));
  return low.x <= region.high.x && low.y <= region.high.y && high.x >= region.low.x && high.y >= region.low.y;
}

/// The triangles of a level that meet a region, as a mesh would hand them out, without drawn heights.
class TriangleFinder {
 public:
  TriangleFinder(const Layer& layer, const Surface& surface, const PlantRegion& region, size_t most)
      : surface_(surface),
        lattice_(surface.lattice()),
        region_(region),
        level_(level_for_area(lattice_, double(layer.triangle_area_m2))),
        altitudes_(needs_altitudes(layer)),
        most_(most) {
    const double cells = double(int64_t(1) << lattice_.root_bits);
    level_area_ = std::ldexp(0.5 * cells * cells * lattice_.spacing.x * lattice_.spacing.y, -level_);
  }

  /// False where there are more than allowed.
  bool run(FixedTriangles& out) {
    for (int row = 0; row < lattice_.root_squares.y; ++row)
      for (int column = 0; column < lattice_.root_squares.x; ++column)
        for (int root = 0; root < 2; ++root) {
          const TriangleId id = TriangleId::root(root, {column, row});
          if (!descend(id, corners_of(id), out)) return false;
        }
    return true;
  }

 private:
  bool descend(TriangleId id, const TriangleCorners& c, FixedTriangles& out) {
    const glm::dvec2 corners[3] = {lattice_.world_xy(c.apex), lattice_.world_xy(c.left), lattice_.world_xy(c.right)};
    if (!overlaps(region_, corners)) return true;
    if (id.level() == level_) return add(id, c, corners, out);
    const LatticePoint middle = c.left + (c.right - c.left) / 2;
    return descend(id.child(0), {middle, c.apex, c.left}, out) && descend(id.child(1), {middle, c.right, c.apex}, out);
  }

  bool add(TriangleId id, const TriangleCorners& c, const glm::dvec2 (&corners)[3], FixedTriangles& out) {
    const LatticeBox box{glm::min(c.apex, glm::min(c.left, c.right)), glm::max(c.apex, glm::max(c.left, c.right))};
    if (surface_.all_holes(box)) return true;
    if (out.size() == most_) return false;
    FixedTriangle t;
    t.apex = glm::dvec3(corners[0], 0.0);
    t.to_left = glm::vec3(glm::vec2(corners[1] - corners[0]), 0.0f);
    t.to_right = glm::vec3(glm::vec2(corners[2] - corners[0]), 0.0f);
    t.id = id;
    const glm::dvec2 gradient = surface_.data_gradient((corners[0] + corners[1] + corners[2]) / 3.0);
    t.area = float(level_area_ * std::sqrt(1.0 + glm::dot(gradient, gradient)));
    if (altitudes_) {
      t.altitude = glm::vec3(surface_.height(corners[0]), surface_.height(corners[1]), surface_.height(corners[2]));
    }
    out.push_back(t);
    return true;
  }

  const Surface& surface_;
  const Lattice& lattice_;
  const PlantRegion& region_;
  int level_;
  bool altitudes_;
  size_t most_;
  double level_area_ = 0;
};

/// Full density.
float full_limit(const Layer& layer, float area) {
  return layer.law == DensityLaw::distance ? area * layer.density : float(layer.ceiling);
}

Expected<void> check_region(const PlantRegion& region) {
  const glm::dvec2 size = region.high - region.low;
  if (std::isfinite(size.x) && std::isfinite(size.y) && size.x > 0 && size.y > 0) return {};
  return fail(
      "the region is empty or not finite: its eastern and northern ends must lie beyond the western and southern");
}

Error too_many(const PlantQueryOptions& options) {
  return Error{"the region holds more than " + std::to_string(options.most_plants) +
               " plants; ask for a smaller one or allow more"};
}

/// z from the finest data; what lies outside of region or data goes.
void settle(const Surface& surface, const PlantRegion& region, std::vector<Plant>& plants, size_t first) {
  size_t kept = first;
  for (size_t i = first; i < plants.size(); ++i) {
    const glm::dvec2 place(plants[i].position);
    if (!region.contains(place)) continue;
    const double z = surface.height(place);
    if (!std::isfinite(z)) continue;
    plants[kept] = plants[i];
    plants[kept++].position.z = z;
  }
  plants.resize(kept);
}

Expected<void> check_query(const Layer& layer, const PlantRegion& region) {
  if (auto valid = validate(layer); !valid) return valid;
  if (auto loaded = require_maps(layer); !loaded) return loaded;
  return check_region(region);
}

/// Every seed of a triangle.
uint32_t all_clusters(const Layer& layer, TriangleRecord& record, float area) {
  record.limit = full_limit(layer, area);
  record.submitted = uint32_t(std::ceil(record.limit));
  const auto size = uint32_t(layer.cluster_size);
  return (record.submitted + size - 1) / size;
}

}  // namespace

bool PlantRegion::contains(glm::dvec2 place) const {
  if (place.x < low.x || place.y < low.y || place.x > high.x || place.y > high.y) return false;
  const glm::dvec2 from_middle = place - 0.5 * (low + high);
  return radius_m <= 0 || glm::dot(from_middle, from_middle) <= radius_m * radius_m;
}

Expected<std::vector<Plant>> query_plants(const Layer& layer, const Surface& surface, const ColorMap& map,
                                          const PlantRegion& region, const PlantQueryOptions& options) {
  if (auto checked = check_query(layer, region); !checked) return tl::unexpected(checked.error());
  SWARD_ASSERT(!layer.on_mesh, "the plants of a layer on a mesh are asked for with its MeshSurface");
  const double seeds_a_triangle = std::max(double(full_limit(layer, layer.triangle_area_m2)), 1.0);
  const double most = k_seeds_a_plant * double(options.most_plants) / seeds_a_triangle + 16.0;
  FixedTriangles triangles;
  if (!TriangleFinder(layer, surface, region, size_t(std::min(most, 1.0e9))).run(triangles))
    return tl::unexpected(too_many(options));

  View view;
  ExclusionIndex index;
  // All are equal up to turning, and so is how far they extend.
  const float leg = triangles.empty() ? 0.0f
                                      : std::max(glm::length(glm::vec2(triangles.to_left()[0])),
                                                 glm::length(glm::vec2(triangles.to_right()[0])));
  index.follow(options.exclusions, layer.name, 2.0 * double(leg));
  std::vector<glm::vec4> run;
  const RecordMaker maker(layer, map);
  std::vector<Plant> plants;
  PlantGround ground = make_plant_ground(layer, view, map, options.sun_azimuth, {});
  ground.disturbance = options.disturbance;
  for (size_t i = 0; i < triangles.size(); ++i) {
    TriangleRecord record = maker.make(triangles, i);
    run.assign(1, glm::vec4(0.0f));
    if (!index.empty()) {
      const Reach near = index.shapes_near(glm::dvec2(triangles.apex()[i]), glm::vec2(record.to_left),
                                           glm::vec2(record.to_right), run);
      if (near == Reach::all) continue;
      record.exclusions = near == Reach::some ? 1u : 0u;
      run.emplace_back(0.0f);
    }
    ground.exclusions = run;
    const uint32_t clusters = all_clusters(layer, record, triangles.area()[i]);
    const size_t first = plants.size();
    grow_triangle(ground, triangles, i, record, clusters, SeedDistance::near, plants);
    settle(surface, region, plants, first);
    if (plants.size() > options.most_plants) return tl::unexpected(too_many(options));
  }
  return plants;
}

Expected<std::vector<Plant>> query_plants(const Layer& layer, const MeshSurface& surface, const PlantRegion& region,
                                          const PlantQueryOptions& options) {
  if (auto checked = check_query(layer, region); !checked) return tl::unexpected(checked.error());
  SWARD_ASSERT(layer.on_mesh, "the plants of a layer on terrain are asked for with its Surface");
  FixedTriangles triangles;
  surface.all_triangles(layer.triangle_area_m2, triangles);
  const PlantGround ground = make_mesh_ground(layer, View());
  const RecordMaker maker(layer, surface);
  std::vector<Plant> plants;
  for (size_t i = 0; i < triangles.size(); ++i) {
    const glm::dvec2 apex(triangles.apex()[i]);
    const glm::dvec2 left = apex + glm::dvec2(triangles.to_left()[i]),
                     right = apex + glm::dvec2(triangles.to_right()[i]);
    if (!overlaps(region, {apex, left, right})) continue;
    TriangleRecord record = maker.make(triangles, i);
    const uint32_t clusters = all_clusters(layer, record, triangles.area()[i]);
    const size_t first = plants.size();
    grow_triangle(ground, triangles, i, record, clusters, SeedDistance::near, plants);
    const auto outside = [&](const Plant& plant) { return !region.contains(glm::dvec2(plant.position)); };
    plants.erase(std::remove_if(plants.begin() + std::ptrdiff_t(first), plants.end(), outside), plants.end());
    if (plants.size() > options.most_plants) return tl::unexpected(too_many(options));
  }
  return plants;
}

}  // namespace sward
