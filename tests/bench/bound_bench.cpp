// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// How much larger the bound is than the true error: every sample in the frustum, and with relief below the data points
// between samples, against what is drawn, in 20 frames of three flights, at rest (no clock) and while vertices move.
// 4097 x 4097 samples at 5 m, 1920 x 1080.
//   bench_bound [5000] [15000] [50000] [relief]      (nothing: 5000 and 50000 without relief)
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "flight.h"

namespace {

constexpr int k_measured = 20;

const roam_support::Terrain& terrain(bool relief) {
  if (!relief) return flight::terrain();
  static const roam_support::Terrain made = [] {
    const sward::HeightField& data = *flight::terrain().field;
    sward::HeightFieldDesc desc = data.desc();
    desc.relief.enabled = true;
    roam_support::Terrain fine;
    std::vector<float> samples = std::get<std::vector<float>>(data.samples());
    fine.field = std::make_unique<sward::HeightField>(sward::HeightField::create(desc, std::move(samples), {}).value());
    fine.bounds = std::make_unique<sward::Bounds>(sward::Bounds::create(*fine.field));
    return fine;
  }();
  return made;
}

struct Flight {
  const char* name;
  double speed, turning, low, high;  // metres and radians a second, metres above the ground
};
constexpr std::array<Flight, 3> k_flights{{
    {"down and up, 200 m/s", 200, 0.1, 3, 1500},
    {"low, 60 m/s, turning", 60, 0.5, 15, 15},
    {"walk, 1.5 m/s", 1.5, 0.2, 1.7, 1.7},
}};

sward::View view_of(const Flight& flight, const sward::HeightField& field, double t, double seconds) {
  const glm::dvec2 xy = glm::dvec2(-4000, -2500) + flight.speed * t * glm::dvec2(std::cos(0.5), std::sin(0.5));
  const double share = std::abs(2 * t / seconds - 1);
  const double above = flight.low * std::pow(flight.high / flight.low, share * share * (3 - 2 * share));
  const double pitch = -0.05 - 0.35 * std::min(above / 800, 1.0);
  return sward::View::look({xy, field.height(xy) + above}, 0.5 + 0.7 * std::sin(flight.turning * t), pitch, 0.87,
                           {1920, 1080}, 0.5, 60000);
}

/// The largest distance on screen between what is drawn and the surface.
class Screen {
 public:
  Screen(const sward::View& view, const sward::HeightField& field)
      : clip_(view.clip_from_relative()), eye_(view.eye), half_(0.5 * glm::dvec2(view.viewport)), field_(field) {}

  void point(glm::dvec2 xy, double is_z, double drawn_z) {
    const glm::dvec4 is = clip_ * glm::dvec4(glm::dvec3(xy, is_z) - eye_, 1);
    if (!(std::abs(is.x) <= is.w && std::abs(is.y) <= is.w && std::abs(is.z) <= is.w)) return;
    const glm::dvec4 drawn = clip_ * glm::dvec4(glm::dvec3(xy, drawn_z) - eye_, 1);
    worst = std::max(worst, glm::length(half_ * (glm::dvec2(is) / is.w - glm::dvec2(drawn) / drawn.w)));
    ++seen;
  }

  // All samples over the triangle.
  void samples(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    const int step = field_.sample_step();
    const glm::dvec2 low = glm::min(glm::dvec2(a), glm::min(glm::dvec2(b), glm::dvec2(c)));
    const glm::dvec2 high = glm::max(glm::dvec2(a), glm::max(glm::dvec2(b), glm::dvec2(c)));
    const glm::dvec2 first = glm::ceil(field_.lattice().from_world({low.x, high.y}) / double(step) - 1e-6);
    const glm::dvec2 last = glm::floor(field_.lattice().from_world({high.x, low.y}) / double(step) + 1e-6);
    const glm::dvec3 l = b - a, r = c - a;
    const double area = l.x * r.y - l.y * r.x;
    for (int row = std::max(int(first.y), 0); row <= std::min(int(last.y), field_.desc().rows - 1); ++row) {
      for (int column = std::max(int(first.x), 0); column <= std::min(int(last.x), field_.desc().columns - 1);
           ++column) {
        const glm::dvec2 xy = field_.world_xy(sward::LatticePoint(column, row) * step), q = xy - glm::dvec2(a);
        const double u = (q.x * r.y - q.y * r.x) / area, v = (l.x * q.y - l.y * q.x) / area;
        if (u >= -1e-9 && v >= -1e-9 && u + v <= 1 + 1e-9)
          point(xy, field_.sample(column, row), a.z + u * l.z + v * r.z);
      }
    }
  }

  // The finest surface between samples, at eighths of the triangle's sides.
  void between(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    constexpr int k_parts = 8;
    for (int i = 0; i <= k_parts; ++i) {
      for (int j = 0; i + j <= k_parts; ++j) {
        const glm::dvec3 p = a + (b - a) * (double(i) / k_parts) + (c - a) * (double(j) / k_parts);
        const glm::dvec2 xy = glm::clamp(glm::dvec2(p), field_.min_corner(), field_.max_corner());
        if (xy == glm::dvec2(p)) point(xy, field_.height(xy), p.z);
      }
    }
  }

  double worst = 0;  // pixels
  size_t seen = 0;

 private:
  glm::dmat4 clip_;
  glm::dvec3 eye_;
  glm::dvec2 half_;
  const sward::HeightField& field_;
};

struct Ratios {
  std::vector<double> ratio, error, cost_us, moving;
  int exceeded = 0, endless = 0;
  size_t seen = 0;
};

void measure(const sward::RoamMesh& mesh, const sward::View& view, const roam_support::Terrain& over, bool relief,
             Ratios& found) {
  const double start = flight::thread_ms();
  const double bound = double(mesh.bound_px());
  found.cost_us.push_back(1e3 * (flight::thread_ms() - start));
  if (bound >= double(sward::RoamMesh::k_artificial_max)) {
    ++found.endless;
    return;
  }
  Screen screen(view, *over.field);
  const auto indices = mesh.visible_indices();
  for (size_t i = 0; i < indices.size(); i += 3) {
    const glm::dvec3 a = mesh.vertex_world(indices[i]), b = mesh.vertex_world(indices[i + 1]),
                     c = mesh.vertex_world(indices[i + 2]);
    screen.samples(a, b, c);
    if (relief) screen.between(a, b, c);
  }
  found.exceeded += screen.worst > bound * (1 + 1e-6);
  found.ratio.push_back(bound / screen.worst);
  found.error.push_back(screen.worst);
  found.seen += screen.seen;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void fly(const Flight& flight, uint32_t budget, bool moving, bool relief) {
  const roam_support::Terrain& over = terrain(relief);
  const double seconds = flight.high > flight.low ? 30 : 10;
  const int frames = int(60 * seconds), stride = frames / k_measured;
  sward::RoamOptions options;
  options.max_triangles = budget;
  auto mesh = sward::RoamMesh::create(*over.bounds, options).value();
  Ratios found;
  for (int frame = 0; frame < frames; ++frame) {
    const sward::View view = view_of(flight, *over.field, frame / 60.0, seconds);
    const auto stats = moving ? mesh.update(view, frame / 60.0) : mesh.update(view);
    if (frame % stride != stride - 1) continue;
    found.moving.push_back(double(stats->moving));
    measure(mesh, view, over, relief, found);
  }
  const auto ratios = std::minmax_element(found.ratio.begin(), found.ratio.end());
  std::printf("| %-20s | %6u | %-6s | %-6s | %6.2f | %6.2f | %6.2f | %6.2f | %8d | %7d | %6.0f | %6.0f | %5.1f M |\n",
              flight.name, budget, relief ? "relief" : "data", moving ? "moving" : "rest", median(found.ratio),
              *ratios.first, *ratios.second, median(found.error), found.exceeded, found.endless, median(found.moving),
              median(found.cost_us), double(found.seen) * 1e-6);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<uint32_t> budgets;
  bool relief = false;
  for (int i = 1; i < argc; ++i) {
    if (std::string(argv[i]) == "relief")
      relief = true;
    else
      budgets.push_back(uint32_t(std::strtoul(argv[i], nullptr, 10)));
  }
  if (budgets.empty()) budgets = {5000, 50000};
  std::printf(
      "| flight               | budget | ground | verts  | median |  least |   most | err px | exceeded | endless | "
      "moving | us     | points  |\n");
  for (const uint32_t budget : budgets)
    for (const Flight& flight : k_flights)
      for (const bool moving : {false, true}) fly(flight, budget, moving, relief);
}
