// What a cube of a given side resolves of the pieces of a look: their sums over small cells, and its response to them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/field.h"
#include "scene/scattering_piece.h"

namespace raytube {

/// Axes of a look, from its radar: away from it, to its right, upwards; unit vectors.
struct LookAxes {
  dvec3 range, cross_range, height;
};

/// Pieces of one mechanism within an eighth of a side, in the axes of the look: over all wave vectors their phases stay together
/// to 0.2 rad at most.
struct PieceCluster {
  dvec3 at{0.0};  // mean, by amplitude
  ScatteringMatrix s{};
  std::size_t mechanism = 0;
  std::optional<std::uint32_t> triangle{};  // of the strongest
  double amplitude = 0.0, strongest = -1.0;

  void add(const dvec3& place, const ScatteringPiece& piece);
};

std::vector<PieceCluster> clusters_of(const std::vector<ScatteringPiece>& pieces, const LookAxes& axes, double side);

/// Of all four channels.
inline double power(const ScatteringMatrix& s) { return std::norm(frobenius_norm(s)); }

inline constexpr double response_reach = 2.0;  // of Hann's weights [sides]

/// Hann's transform over wavenumbers within pi / side, 1 at x = 0 (Harris 1978, eq. 27b, of a continuous window), as far as its
/// first null: what is left out of it are side lobes of 31 dB.
double hann_response(double x, double side);
double hann_response(const dvec3& x, double side);

/// At x from a piece, of even weights over the same wavenumbers.
double even_response(const dvec3& x, double side);

/// The largest component.
inline double extent_of(const dvec3& x) { return std::max({std::abs(x.x), std::abs(x.y), std::abs(x.z)}); }

}  // namespace raytube
