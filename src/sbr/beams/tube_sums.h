// What a bundle of tubes adds up to.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/field.h"
#include "mesh/trace/ray.h"
#include "sbr/beams/spectrum.h"
#include "scene/results.h"

namespace raytube {

/// Waves that were inside of solids.
struct WavesInside {
  ScatteringMatrix s{};  // [m]
  double left = 0.0;     // their power as they leave: area times squared amplitude [m^2]

  /// Those of other tubes as well.
  WavesInside& operator+=(const WavesInside& other) {
    s += other.s;
    left += other.left;
    return *this;
  }
};

/// Errors of parts, added up both ways: as amplitudes, and as if their phases were independent.
struct ErrorSum {
  ScatteringMatrix coherent;  // sum of the errors [m]
  ChannelErrors squares{};    // sum of their squared magnitudes [m^2]

  /// One more part, or so many independent ones like it, below zero with the opposite sign.
  void add(const ScatteringMatrix& error, double count = 1.0);
  /// The parts of another sum.
  ErrorSum& operator+=(const ErrorSum& other);
  /// The larger of the two sums' magnitudes [m].
  double size(int p, int q) const { return std::max(std::abs(coherent.at(p, q)), std::sqrt(squares[p][q])); }
};

/// The cells of a look in groups of three by three, each of them one cell whose ray is its middle one's: counted from the grid's
/// corner, and from one cell beside it. An edge along the grid may by chance lie between the groups of one of them.
inline constexpr int coarse_grids = 2;

/// Sums and counts of a tile, or of several added up in order.
struct TubeSums {
  std::vector<std::vector<ScatteringMatrix>> bounces;  // [bounce][frequency]
  /// [frequency][grid], all bounces together: fine minus coarse, summed over tiles; empty: nothing was sampled.
  std::vector<std::array<ErrorSum, coarse_grids>> coarse;
  std::vector<ErrorSum> pieces;                      // [frequency], of single tubes whose error is known; empty: there are none
  std::vector<ErrorSum> quadrature;                  // [frequency], of spherical waves: no grid changes it; empty: there are none
  std::vector<std::array<double, 2>> incoherent;     // [frequency][transmit] sigma of rough surfaces [m^2]; empty: there are none
  std::vector<WavesInside> inside;                   // [frequency], part of `bounces`; empty: there are none
  std::vector<ChannelErrors> error;                  // [frequency], estimate for the whole look [m]; empty in its parts
  std::vector<std::uint64_t> hits;                   // [bounce]
  std::vector<double> met;                           // [bounce] area times squared amplitude of the waves that met surfaces [m^2]
  std::uint64_t tubes = 0, rays = 0, lost_rays = 0;  // see Statistics
  std::vector<LostRay> first_lost;                   // of these, in recentred coordinates, their look not yet told
  TruncatedSums truncated;                           // of this look
  std::uint64_t empty_cells = 0, faces_away = 0;     // not traced: cells of the grid without target, faces turned away
  double sliver_area = 0.0;                          // [m^2] of the launch plane, left out by adaptive tubes

  /// The sums [frequency] of a bounce, counted from 0; they and their counter of hits are made when first asked for.
  std::vector<ScatteringMatrix>& at(int bounce, std::size_t frequencies);

  /// S of all bounces at a frequency, by its index.
  ScatteringMatrix total(std::size_t frequency) const;
  /// S of bounce 1, 2, ... [m].
  std::vector<ScatteringMatrix> bounces_at(std::size_t frequency) const;

  /// A tube of this area across its wave [m^2], of this amplitude of unit incident ones, met a surface.
  void meet(int bounce, double area, double amplitude);

  /// A ray met this triangle of a closed body from inside.
  void lose(const Ray& ray, std::uint32_t triangle, const TriangleMesh& mesh);
  /// A ray that met nothing is lost if it is not finite: where it began, on a triangle of the patch that it left.
  void lose_if_stray(const Ray& ray, const TriangleMesh& mesh);

  /// What the currents of this wave scatter incoherently from so much area across it.
  void add_incoherent(const Spectrum& spectrum, double area);

  /// Waves at one of so many frequencies that were inside of solids.
  void add_inside(std::size_t frequency, std::size_t frequencies, const WavesInside& waves);

  /// Sets `coarse` from what the coarse grids, [grid][frequency], give for all that has been added up so far.
  void compare_with(const std::array<std::vector<ScatteringMatrix>, coarse_grids>& coarse_sums);

  /// Adds the sums and counts of other tubes; `error`, which belongs to a whole look, stays.
  void add(const TubeSums& other);

  /// Takes these frequencies from the sums of other tubes of the same look, of all frequencies. Counts are those of the most
  /// tubes.
  void take(TubeSums other, std::span<const std::size_t> frequencies);

  /// Appends the sums of these tubes at further frequencies. Counts stay those of the first ones: weak waves end by what is left
  /// of them at any frequency traced together.
  void append(TubeSums further);
};

}  // namespace raytube
