// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT

// Loops over the 64 triangles of a chunk, without branches and gathers, for the compiler to vectorise. Rule B of
// Papavasiliou (2015), section 3.1: the chunk's apex is transformed, in double precision; everything else is the
// linear part applied to offsets from it.
#include "fixed_level_kernel.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "wide.h"

namespace sward::roam {

namespace {

// Rounding of the tests below: a few times the distance's unit in the last place, more on steep ground.
constexpr float k_rounding = 2.0e-6f;
constexpr unsigned k_near = 4;
// Runs of triangles that are measured or skipped together: the sub-trees three levels below a chunk.
constexpr int k_block_depth = 3;
constexpr size_t k_blocks = size_t(1) << k_block_depth, k_block_size = k_chunk_size / k_blocks;
constexpr unsigned k_all_blocks = (1u << k_blocks) - 1;

struct WeightedTriangle {
  glm::dvec2 apex, left, right;
};

void fill(const WeightedTriangle& t, int depth, unsigned index, ChunkPattern& pattern) {
  if (depth == 0) {
    const auto put = [index](ChunkPattern::Weights& to, glm::dvec2 w) {
      to.s[index] = float(w.x);
      to.t[index] = float(w.y);
    };
    put(pattern.apex, t.apex);
    put(pattern.left, t.left - t.apex);
    put(pattern.right, t.right - t.apex);
    return;
  }
  const glm::dvec2 m = 0.5 * (t.left + t.right);
  fill({m, t.apex, t.left}, depth - 1, 2 * index, pattern);
  fill({m, t.right, t.apex}, depth - 1, 2 * index + 1, pattern);
}

// Of a row (x, y, w) of a clip matrix, the part that multiplies positions.
glm::dvec3 linear(glm::dvec4 row) {
  return glm::dvec3(row);
}

glm::dvec4 row_of(const glm::dmat4& m, int i) {
  return {m[0][i], m[1][i], m[2][i], m[3][i]};
}

// Squared distance from the origin to the edge from p along e.
inline float squared_distance(float px, float py, float pz, float ex, float ey, float ez) {
  const float along = -(px * ex + py * ey + pz * ez) / (ex * ex + ey * ey + ez * ez);
  // Clamped to [0, 1] without a comparison, which would keep the loop from being vectorised. What it adds in rounding
  // is below the distance's own.
  const float t = 0.5f * (std::abs(along) - std::abs(along - 1) + 1);
  const float x = px + t * ex, y = py + t * ey, z = pz + t * ez;
  return x * x + y * y + z * z;
}

// Calls work(first, last) for every run of triangles that the blocks named make.
template <class Work>
inline void for_runs(unsigned blocks, Work&& work) {
  for (unsigned rest = blocks; rest != 0;) {
    const int first = std::countr_zero(rest), length = std::countr_one(rest >> first);
    work(size_t(first) * k_block_size, size_t(first + length) * k_block_size);
    rest &= ~0u << (first + length);
  }
}

}  // namespace

const ChunkPattern& chunk_pattern(int depth) {
  static const auto patterns = [] {
    std::array<ChunkPattern, k_chunk_depth + 1> all;
    for (int i = 0; i <= k_chunk_depth; ++i) fill({{0, 0}, {1, 0}, {0, 1}}, i, 0, all[size_t(i)]);
    return all;
  }();
  return patterns[size_t(depth)];
}

// Triangles [first, last) of a chunk.
struct ChunkKernel::Range {
  size_t first, last;
};

struct ChunkKernel::Frame {
  const ChunkPattern* pattern;
  glm::vec3 apex;                  // relative to the eye
  glm::vec2 left, right;           // edges from there
  std::array<float, 6> plane;      // of the apex
  float w;                         // of the apex
  float away;                      // a triangle faces away when its plane is more than this above the eye
  float doubt;                     // margins below are in doubt
  bool all_pass;                   // no test can fail
  unsigned blocks = k_all_blocks;  // bit i: triangles of block i may be in sight
};

ChunkKernel::ChunkKernel(const ChunkSource& source) : source_(source) {
  const View& view = source.view();
  const glm::dmat4 clip = view.clip_from_relative();
  const glm::dvec4 x = row_of(clip, 0) * (double(view.viewport.x) / view.viewport.y), y = row_of(clip, 1);
  row_w_ = row_of(clip, 3);
  w_ = glm::vec3(linear(row_w_));
  // With M the 3 x 3 part and m the last column, the determinant of the corners' (x, y, w) is that of M p + m, M l and
  // M r, so det(M) p . n + (cofactors(M)^T m) . n with n = l x r.
  const glm::dvec3 yw = glm::cross(linear(y), linear(row_w_)), wx = glm::cross(linear(row_w_), linear(x)),
                   xy = glm::cross(linear(x), linear(y));
  determinant_ = float(glm::dot(linear(x), yw));
  shift_ = glm::vec3(x.w * yw + y.w * wx + row_w_.w * xy);
  horizon_ = source.options().horizon_m;
  canopy_ = source.options().canopy_m;
  for (size_t i = 0; i < 6; ++i) {
    const glm::vec3 n(source.planes()[i].n);
    const float aside = glm::length(glm::vec2(n)) * source.options().spread_m;
    halfspaces_[i] = {n, std::max(n.z, 0.0f) * canopy_ + aside, std::abs(n.z)};
  }
}

ChunkKernel::Frame ChunkKernel::frame_of(const ChunkVisit& visit, int depth, const Chunk& chunk) const {
  const DrawnTriangle& t = visit.triangle;
  const glm::dvec3 apex = t.apex.world - source_.view().eye;
  Frame frame;
  frame.pattern = &chunk_pattern(depth);
  frame.apex = glm::vec3(apex);
  frame.left = glm::vec2(t.left.world - t.apex.world);
  frame.right = glm::vec2(t.right.world - t.apex.world);
  for (size_t i = 0; i < 6; ++i) frame.plane[i] = float(t.apex.plane[i]);
  frame.w = float(glm::dot(linear(row_w_), apex) + row_w_.w);
  const bool test_facing = source_.options().skip_back_faces && !chunk.flat;
  frame.away = test_facing ? canopy_ : std::numeric_limits<float>::max();
  const double farthest = std::max(
      {glm::length(apex), glm::length(t.left.world - source_.view().eye), glm::length(t.right.world - source_.view().eye)});
  const float bound = visit.bound;
  frame.doubt = k_rounding * (2 + chunk.steepness) * (float(farthest) + bound);
  frame.all_pass = visit.active == 0 && float(farthest) + bound + frame.doubt <= horizon_ && !test_facing;
  if (!frame.all_pass && depth == k_chunk_depth) frame.blocks = blocks_in_sight(visit, bound);
  return frame;
}

// By the distances of the blocks' corners to the halfspaces, which are linear, too. Leaves some room for rounding.
unsigned ChunkKernel::blocks_in_sight(const ChunkVisit& visit, float bound) const {
  constexpr float k_room = 1.0e-3f;
  const ChunkPattern& pattern = chunk_pattern(k_block_depth);
  const DrawnTriangle& t = visit.triangle;
  unsigned blocks = k_all_blocks;
  for (unsigned rest = visit.active; rest != 0; rest &= rest - 1) {
    const auto i = size_t(std::countr_zero(rest));
    const auto apex = float(t.apex.plane[i]);
    const float along_left = float(t.left.plane[i] - t.apex.plane[i]);
    const float along_right = float(t.right.plane[i] - t.apex.plane[i]);
    const float room = halfspaces_[i].up + 2 * halfspaces_[i].reach * bound +
                       k_room * (std::abs(apex) + std::abs(along_left) + std::abs(along_right));
    for (size_t block = 0; block < k_blocks; ++block) {
      const float a = apex + pattern.apex.s[block] * along_left + pattern.apex.t[block] * along_right;
      const float l = pattern.left.s[block] * along_left + pattern.left.t[block] * along_right;
      const float r = pattern.right.s[block] * along_left + pattern.right.t[block] * along_right;
      if (a + std::max(std::max(l, r), 0.0f) + room < 0) blocks &= ~(1u << block);
    }
  }
  return blocks;
}

void ChunkKernel::evaluate(const ChunkVisit& visit, int depth, const Chunk& chunk, ChunkResult& result) const {
  const Frame frame = frame_of(visit, depth, chunk);
  Margins margins;
  uint64_t doubtful = 0, passed = 0;
  for_runs(frame.blocks, [&](size_t first, size_t last) {
    const Range range{first, last};
    measure(frame, range, chunk, {result.distance.data(), result.screen_area.data(), margins.data()});
    if (visit.active >> k_near & 1) doubtful |= test_near(frame, range, chunk, result);
    if (frame.all_pass) return;
    for (unsigned rest = visit.active; rest != 0; rest &= rest - 1)
      test_halfspace(frame, unsigned(std::countr_zero(rest)), range, chunk, margins);
    for (size_t j = range.first; j < range.last; ++j) {
      passed |= uint64_t(margins[j] >= 0) << j;
      doubtful |= uint64_t(!(std::abs(margins[j]) > frame.doubt)) << j;
    }
  });
  result.visible = frame.all_pass ? chunk.solid : chunk.solid & passed;
  for (uint64_t rest = doubtful & chunk.solid; rest != 0; rest &= rest - 1) {
    const auto j = unsigned(std::countr_zero(rest));
    const ExactTriangle exact = source_.exact(visit, depth, chunk, j);
    result.visible = (result.visible & ~(uint64_t(1) << j)) | uint64_t(exact.visible) << j;
    result.distance[j] = float(exact.distance);
    result.screen_area[j] = exact.screen_area;
  }
}

// Longer than most: it is one loop body, each line a column of arithmetic.
SWARD_WIDE void ChunkKernel::measure(const Frame& frame, Range range, const Chunk& chunk, const Columns& to) const {
  const ChunkPattern& pattern = *frame.pattern;
  const glm::vec3 row = w_, shift = shift_, origin = frame.apex;
  const glm::vec2 to_left = frame.left, to_right = frame.right;
  const float determinant = determinant_, apex_w = frame.w, horizon = horizon_, away = frame.away;
  float* const __restrict distances = to.distance;
  float* const __restrict areas = to.screen_area;
  float* const __restrict margins = to.margin;
  for (size_t j = range.first; j < range.last; ++j) {
    // Apex p against the chunk's and the eye, edges l and r.
    const float ox = pattern.apex.s[j] * to_left.x + pattern.apex.t[j] * to_right.x;
    const float oy = pattern.apex.s[j] * to_left.y + pattern.apex.t[j] * to_right.y, oz = chunk.apex_z[j];
    const float px = origin.x + ox, py = origin.y + oy, pz = origin.z + oz;
    const float lx = pattern.left.s[j] * to_left.x + pattern.left.t[j] * to_right.x;
    const float ly = pattern.left.s[j] * to_left.y + pattern.left.t[j] * to_right.y, lz = chunk.left_z[j];
    const float rx = pattern.right.s[j] * to_left.x + pattern.right.t[j] * to_right.x;
    const float ry = pattern.right.s[j] * to_left.y + pattern.right.t[j] * to_right.y, rz = chunk.right_z[j];
    // Normal, and the eye's height below the plane.
    const float nx = ly * rz - lz * ry, ny = lz * rx - lx * rz, nz = lx * ry - ly * rx;
    const float n2 = nx * nx + ny * ny + nz * nz, n_p = nx * px + ny * py + nz * pz;
    const float below = n_p / std::sqrt(n2);
    // Barycentric coordinates of the eye's foot, times n2: (r x p) . n and (p x l) . n.
    const float to_l = (ry * pz - rz * py) * nx + (rz * px - rx * pz) * ny + (rx * py - ry * px) * nz;
    const float to_r = (py * lz - pz * ly) * nx + (pz * lx - px * lz) * ny + (px * ly - py * lx) * nz;
    const float outside = std::min(std::min(to_l, to_r), n2 - to_l - to_r);
    const float edges =
        std::min(std::min(squared_distance(px, py, pz, lx, ly, lz), squared_distance(px, py, pz, rx, ry, rz)),
                 squared_distance(px + lx, py + ly, pz + lz, rx - lx, ry - ly, rz - lz));
    const float to_edge = std::sqrt(edges), to_plane = std::abs(below);
    const float distance = outside >= 0 ? to_plane : to_edge;
    distances[j] = distance;
    margins[j] = std::min(horizon - distance, away - below);
    // Projected area.
    const float w = apex_w + row.x * ox + row.y * oy + row.z * oz;
    const float left_w = w + row.x * lx + row.y * ly + row.z * lz, right_w = w + row.x * rx + row.y * ry + row.z * rz;
    const float twice = determinant * n_p + shift.x * nx + shift.y * ny + shift.z * nz;
    areas[j] = 0.5f * std::abs(twice) / (w * left_w * right_w);
  }
}

SWARD_WIDE void ChunkKernel::test_halfspace(const Frame& frame, unsigned i, Range range, const Chunk& chunk,
                                            Margins& margins) const {
  static constexpr std::array<float, k_chunk_size> k_no_bound{};
  const ChunkPattern& pattern = *frame.pattern;
  const std::array<float, k_chunk_size>& bound = chunk.flat ? k_no_bound : chunk.bound;
  const Halfspace& h = halfspaces_[i];
  const float apex = frame.plane[i] + h.up, reach = h.reach, up = h.n.z;
  const float along_left = h.n.x * frame.left.x + h.n.y * frame.left.y;
  const float along_right = h.n.x * frame.right.x + h.n.y * frame.right.y;
  for (size_t j = range.first; j < range.last; ++j) {
    const float p = apex + pattern.apex.s[j] * along_left + pattern.apex.t[j] * along_right + up * chunk.apex_z[j];
    const float l = pattern.left.s[j] * along_left + pattern.left.t[j] * along_right + up * chunk.left_z[j];
    const float r = pattern.right.s[j] * along_left + pattern.right.t[j] * along_right + up * chunk.right_z[j];
    const float most = p + std::max(std::max(l, r), 0.0f) + reach * bound[j];
    margins[j] = std::min(margins[j], most);
  }
}

// A triangle with a corner behind the near plane has no projected area. Returns those too close to it to tell.
uint64_t ChunkKernel::test_near(const Frame& frame, Range range, const Chunk& chunk, ChunkResult& result) const {
  const ChunkPattern& pattern = *frame.pattern;
  const glm::vec3 n = halfspaces_[k_near].n;
  uint64_t doubtful = 0;
  for (size_t j = range.first; j < range.last; ++j) {
    const auto along = [&](const ChunkPattern::Weights& weights, float z) {
      const glm::vec2 offset = weights.s[j] * frame.left + weights.t[j] * frame.right;
      return n.x * offset.x + n.y * offset.y + n.z * z;
    };
    const float apex = frame.plane[k_near] + along(pattern.apex, chunk.apex_z[j]);
    const float least =
        apex + std::min(std::min(along(pattern.left, chunk.left_z[j]), along(pattern.right, chunk.right_z[j])), 0.0f);
    if (least < 0) result.screen_area[j] = std::numeric_limits<float>::infinity();
    doubtful |= uint64_t(!(std::abs(least) > frame.doubt)) << j;
  }
  return doubtful;
}

}  // namespace sward::roam
