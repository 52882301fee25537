// What a bundle of tubes adds up to.
#pragma once

#include <cstdint>
#include <vector>

#include "field.h"

namespace raytube {

/// What a grid three times as coarse, made of the same rays, gives less than the fine one.
struct CoarseDifference {
  ScatteringMatrix coherent;  // sum over tiles of the difference, fine minus coarse [m]
  std::array<std::array<double, 2>, 2>
      squares{};  // sum over tiles of its squared magnitude [m^2]; indices as of ScatteringMatrix

  CoarseDifference& operator+=(const CoarseDifference& other);
};

/// Sums and counts of a tile, or of several added up in order.
struct TubeSums {
  std::vector<std::vector<ScatteringMatrix>> bounces;  // [bounce][frequency]
  std::vector<CoarseDifference> coarse;                // [frequency], all bounces together; empty: nothing was sampled
  std::vector<ChannelErrors> error;                    // [frequency], estimate for the whole look [m]; empty in its parts
  std::vector<ChannelErrors> squared_errors;           // [frequency], sum of those of single tubes, where known [m^2]
  std::vector<std::uint64_t> hits;                     // [bounce]
  std::uint64_t tubes = 0, rays = 0, lost_rays = 0, tubes_cut = 0;
  double sliver_area = 0.0;  // [m^2] of the launch plane, left out by adaptive tubes

  /// The sums of a bounce, counted from 0; they and their counter of hits come into being when first asked for.
  std::vector<ScatteringMatrix>& at(int bounce, std::size_t frequencies);

  /// Sets `coarse` from what the coarse grid gives for all that has been added up so far.
  void compare_with(const std::vector<ScatteringMatrix>& coarse_sums);

  /// Counts an error of |S_pq| that is independent of the others.
  void add_error(std::size_t frequency, std::size_t frequencies, int p, int q, double size);

  void add(const TubeSums& other);
};

}  // namespace raytube
