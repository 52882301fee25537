// What the waves of a tree radiate, from its kernels: each wave is the sum over its strips of amplitude times kernel, and leaves
// amplitudes at the edges where its strips end, for the next ones. Notation in multiple_diffraction.h.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "utd/multiple/curved_strip_radiation.h"
#include "utd/multiple/curved_strips.h"
#include "utd/multiple/strip_groups.h"
#include "utd/multiple/strip_wave_kernels.h"

namespace raytube {

/// What of a tree is added: its first strips, and a share of those that follow them.
struct TreeShare {
  bool first;
  double higher;
};

/// At one wavenumber: quadrature weight [m], phase and field of the strips.
struct StripAmplitudes {
  ComplexColumn direct;                   // weight and phase of the first strips at the points of the first edge
  std::array<ComplexColumn, 2> arriving;  // per transmit polarisation, at the ends of all strips: with eta H along the edge
};

/// Keeps its buffers from one tree to the next.
class StripRadiation {
 public:
  /// Adds S [m] of the waves of a tree.
  void add(const StripLayout& strips, const CurvedWaves& curved, const LookVectors& look, const TreeShare& share,
           StripBins& bins);

 private:
  /// Wavenumbers whose kernels are found together.
  static constexpr std::size_t block = lanes;

  void add_wave(const StripLayout& strips, std::size_t wave, std::size_t node, const TreeShare& share, PathBins& bins);
  void add_curved(const StripLayout& strips, std::size_t wave, std::span<const ArrivedPath> paths, std::size_t node,
                  StripBins& bins) const;

  StripGroups groups_;
  StripWaveKernels finder_;
  WaveKernelBatch kernels_;                        // those of a wave at a block of wavenumbers
  std::array<StripAmplitudes, block> amplitudes_;  // those of all waves at that block
};

}  // namespace raytube
