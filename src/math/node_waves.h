// Sums over all frequencies of a band of waves that are known at a few.
#pragma once

#include "math/chebyshev.h"

namespace raytube {

/// Share of the magnitudes added up by which wavenumbers between nodes may differ. A hundredth of what the rules along the
/// rays leave (illuminated_faces.h).
inline constexpr double node_error = 1e-7;

/// Exponents over k of some waves [m].
struct PathSpan {
  double low, high;

  double middle() const { return (low + high) / 2; }
  double half() const { return (high - low) / 2; }
};

/// Adds to `sums`, at each of the wavenumbers, a wave e^{jk path} times the amplitudes that are known at the nodes.
void add_waves(std::span<const ScatteringMatrix> amplitudes, const ChebyshevNodes& nodes, std::span<const double> wavenumbers,
               double path, std::span<ScatteringMatrix> sums);

/// Adds to `sums`, at each of the wavenumbers, what `at_nodes` are at the nodes. The phase of the middle path is exact.
void add_interpolated(std::span<const ScatteringMatrix> at_nodes, const ChebyshevNodes& nodes,
                      std::span<const double> wavenumbers, double middle, std::span<ScatteringMatrix> sums);

}  // namespace raytube
