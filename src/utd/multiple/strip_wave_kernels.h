// The kernels of all strips of one wave. Notation in multiple_diffraction.h.
#pragma once

#include <span>
#include <vector>

#include "utd/multiple/strip_layout.h"

namespace raytube {

/// The kernels of a wave, and where they are wanted in parts those that go with the paths over the starts of its strips and over
/// their ends.
struct WaveKernelBatch {
  KernelBatch whole, start, end;
};

/// Finds them for several wavenumbers at once, so that lanes are full where a wave has a kernel or two. Keeps its buffers.
class StripWaveKernels {
 public:
  /// Fills `kernels` with those of waves()[wave] of the tree: WaveFace::kernels of them for the first wavenumber [rad/m], as many
  /// for the next one; `in_parts`, too, if so asked.
  void find(const StripLayout& strips, std::size_t wave, std::span<const double> wavenumbers, bool in_parts,
            WaveKernelBatch& kernels);

 private:
  void find_lengths(const StripLayout& strips, std::size_t wave, std::span<const double> wavenumbers);
  void find_parts(const WaveFace& face, std::span<const double> wavenumbers, WaveKernelBatch& kernels);
  void keep_mirrored_part(const WaveFace& face, std::span<const double> wavenumbers, bool in_parts, WaveKernelBatch& kernels);
  void turn(KernelBatch& kernels) const;

  // For each kernel:
  std::vector<double> lengths_;  // X
  std::vector<double> behind_;   // X at the start of a mirrored strip
  std::vector<double> detours_;  // and the phase of the image of its source
  KernelBatch shorter_;
};

/// Whether the forward-grazing window changes the kernels of the first wave.
bool is_windowed(const StripLayout& strips, double wavenumber);

}  // namespace raytube
