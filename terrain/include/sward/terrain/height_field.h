// Copyright (c) 2026 the sward authors
// SPDX-License-Identifier: MIT
#pragma once

#include <sward/api.h>
#include <sward/terrain/error.h>
#include <sward/terrain/lattice.h>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <variant>
#include <vector>

namespace sward {

/// Relief below the data: a smooth surface through the samples, and deterministic gradient noise in octaves whose
/// lattices contain the samples, where it is zero. Part of the height function: mesh, bounds, queries and plants agree
/// on it.
struct ReliefOptions {
  bool enabled = true;
  /// Bicubic between samples, through them and with central differences for slopes; else flat triangles, whose edges
  /// show on horizons. Adds to bounds by the curvature of the samples around.
  bool smooth = true;
  /// Height of a noise octave against its wavelength, on steep ground. Range 0..0.5.
  float roughness = 0.035f;
  /// Share of that left on flat ground. Range 0..1.
  float flat_share = 0.25f;
  /// Slope (rise over run) at which the full roughness is reached. > 0.
  float full_slope = 0.7f;
  /// The mesh ends where a triangle's legs are at most this long, metres. Range 0.1..100.
  float finest_edge_m = 0.5f;
  uint32_t seed = 1;
};

struct HeightFieldDesc {
  int columns = 0;               ///< Samples west to east, >= 2.
  int rows = 0;                  ///< Samples north to south, >= 2.
  glm::dvec2 spacing{1.0, 1.0};  ///< Metres between samples, > 0: x between columns, y between rows.
  glm::dvec3 origin{0.0};        ///< World position of the field's middle; z is added to every height.
  double scale = 1.0;            ///< Metres a raw unit.
  double offset = 0.0;           ///< Metres added after scaling.
  ReliefOptions relief;
};

/// Heights over root squares side by side. Sample (column, row), row 0 the northern edge, stands at
/// x = origin.x + (column - (columns-1)/2) dx, y = origin.y + ((rows-1)/2 - row) dy.
///
/// The bintree covers whole root squares of 2^n + 1 samples: among the sizes that need at most 256 squares (the root
/// mesh costs two triangles of every frame's budget a square), the one that pads least, the larger at a tie. What lies
/// beyond the data is padding: it repeats the edge and is never drawn, seeded or counted in bounds.
///
/// Const calls are safe from several threads. Only edit() (edits.h) changes a field, in place; while it runs nothing
/// else may use the field: no query, no mesh update.
class SWARD_API HeightField {
 public:
  using Samples = std::variant<std::vector<uint16_t>, std::vector<float>>;

  /// Takes rows of `columns` samples, north first. `holes` is empty or has one entry a sample, not 0 for no data:
  /// those samples are filled smoothly from their surroundings and marked. Float samples that are NaN or infinite are
  /// holes too. Fails on sizes, spacings or counts out of range and when every sample is a hole.
  static Expected<HeightField> create(const HeightFieldDesc& desc, Samples samples,
                                      std::span<const uint8_t> holes = {});

  const HeightFieldDesc& desc() const { return desc_; }
  /// The bintree's lattice over this field.
  const Lattice& lattice() const { return lattice_; }
  int root_bits() const { return lattice_.root_bits; }
  glm::ivec2 root_squares() const { return lattice_.root_squares; }
  int data_level() const { return lattice_.data_level(); }
  int max_level() const { return lattice_.max_level; }
  int sample_step() const { return lattice_.sample_step(); }
  /// The samples as given (row by row, north first), holes filled.
  const Samples& samples() const { return samples_; }
  /// Number of samples that were holes.
  int64_t hole_count() const { return hole_count_; }
  /// Lowest and highest sample, metres, world (origin.z included); relief reaches up to relief_amplitude() beyond.
  /// Edits widen both, and do not narrow them.
  glm::dvec2 height_range() const { return height_range_; }
  double relief_amplitude() const { return relief_amplitude_; }
  /// Western/southern and eastern/northern corner of the data, world.
  glm::dvec2 min_corner() const { return lattice_.min_corner(); }
  glm::dvec2 max_corner() const { return lattice_.max_corner(); }

  /// Sample in metres, world; indices are clamped to the data (so padding repeats the edge).
  double sample(int column, int row) const;
  bool is_hole(int column, int row) const;

  /// World x, y of a lattice point: exact for what ids need (the same bits for the same point, always).
  glm::dvec2 world_xy(LatticePoint p) const { return lattice_.world_xy(p); }
  /// True where the lattice point lies on the data, borders included (not in the padding).
  bool inside(LatticePoint p) const { return lattice_.inside(p); }
  /// Surface height at a lattice point, relief included, metres, world.
  double height(LatticePoint p) const;
  /// Fetches a sample that height() reads for a point in the lattice into the cache, without waiting for it.
  void prefetch(LatticePoint p) const;
  /// Finest surface (the mesh of max_level everywhere) at world x, y. NaN outside of the data.
  double height(glm::dvec2 xy) const;
  /// Unit normal of the finest surface at world x, y; up outside of the data.
  glm::dvec3 normal(glm::dvec2 xy) const;
  /// Slope of the samples (dz/dx, dz/dy; no relief), bilinear between central differences: static data for densities
  /// and for shading far away. Clamped to the edge outside.
  glm::dvec2 data_gradient(glm::dvec2 xy) const;
  /// What the relief adds to data_gradient() at a lattice point (dz/dx, dz/dy), for shading.
  glm::dvec2 relief_gradient(LatticePoint p) const;
  /// Upper bound of |z(m) - (z(l)+z(r))/2| that the relief adds at splits of triangles of `level` and below, summed
  /// over all levels from `level` to max_level(); 0 at max_level(). Analytic; see relief.cpp.
  double relief_bound(int level) const;
  /// The same for one diamond, by the lattice point that its split creates and its level (>= data_level()), from the
  /// strength of the noise and the curvature of the samples around it, so that no descendant's bound is above its
  /// ancestor's. 0 in the padding and in holes.
  double relief_bound(LatticePoint centre, int level) const;
  /// Local strength of the noise by sample, 255: full; 0 in holes. Empty without noise.
  std::span<const uint8_t> relief_shares() const { return relief_shares_; }
  /// What the smooth surface adds to bounds by cell (at its north-western sample), coded; rises with it. 0 where a
  /// cell's corners are all holes and in the last column and row. Empty where the surface is not smooth.
  std::span<const uint8_t> relief_curvatures() const { return coarse_curvatures_; }

  /// Hash of all that bounds depend on: sizes, spacing, scale, samples, holes, relief. Cost: 1 ns a sample.
  uint64_t fingerprint() const;

 private:
  friend class FieldEditor;
  friend class BoundsBuilder;
  // The bounds' 16-bit format ends at 2^19 m.
  static constexpr double k_max_span_m = 262144.0;
  // Relief at a sample depends on samples up to so many columns and rows from it.
  static constexpr int k_relief_reach = 1;

  double raw(int column, int row) const;
  double linear_height(LatticePoint p) const;
  double smooth_height(LatticePoint p) const;
  glm::dvec2 smooth_gradient(LatticePoint p) const;
  double relief_share(LatticePoint p) const;
  Expected<void> adopt(Samples samples, std::span<const uint8_t> holes);
  void measure_range();
  void set_up_relief();
  // The relief's tables for samples from `first` to `last`, cut to the data.
  void compute_relief(glm::ivec2 first, glm::ivec2 last);
  void compute_shares(int row, int first, int last);
  void compute_curvatures(int row, int first, int last);

  HeightFieldDesc desc_;
  Samples samples_;
  std::vector<uint64_t> holes_;  // one bit a sample; empty when there is none
  Lattice lattice_;
  int64_t hole_count_ = 0;
  glm::dvec2 height_range_{0};
  double relief_amplitude_ = 0;
  int octaves_ = 0;                     // of relief; 0: none
  double first_amplitude_ = 0;          // metres, of octave 0; halves with each octave
  std::vector<uint8_t> relief_shares_;  // by sample; empty without noise
  // By cell, as smoothing.h says; empty where the surface is not smooth.
  std::vector<uint8_t> coarse_curvatures_, fine_curvatures_;
  uint8_t largest_coarse_ = 0, largest_fine_ = 0;
  // By level, from data_level() to max_level(): of noise at full strength, and of a curvature of 1.
  std::vector<double> noise_bound_, curvature_bound_;
};

}  // namespace sward
