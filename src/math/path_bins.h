// Sums of many waves A(k) e^{jk path} with slow amplitudes A, at all wavenumbers of a sweep.
//
// Waves of neighbouring paths are added up in bins at a few wavenumbers, the nodes; between them each bin is interpolated, once
// for all of its waves, with the phase of its middle taken out.
#pragma once

#include <unordered_map>

#include "math/chebyshev.h"

namespace raytube {

/// Amplitudes must be analytic in k but for k = 0 and bounded where Re k > 0, as roots, logarithms and Fresnel integrals are.
/// Where there are few wavenumbers, or where it is told not to interpolate, these are the nodes and all waves go into one bin.
class PathBins {
 public:
  PathBins(Band& band, bool interpolate);
  /// All wavenumbers are nodes, and paths in a bin differ by up to `width` [m].
  PathBins(std::span<const double> wavenumbers, double width)
      : wavenumbers_(wavenumbers), at_(wavenumbers), width_(width), spread_(width) {}

  /// Where amplitudes are wanted [rad/m].
  std::span<const double> nodes() const { return at_; }

  /// A wave may contain others whose paths differ from its own by so much [m].
  double spread() const { return spread_; }

  /// The number of the bin that a path belongs to, within its half-width of it; new ones are empty. Paths that give the same key
  /// share a bin.
  std::int64_t key(double path) const;
  std::size_t find(double path);
  /// One more bin, that no path leads to, of waves of any path; only without interpolation.
  std::size_t append() { return append(0); }

  /// How many bins there are, and the path in the middle of one that a path led to.
  std::size_t size() const { return keys_.size(); }
  double middle(std::size_t bin) const { return (static_cast<double>(keys_[bin]) + 0.5) * width_; }

  /// What the waves of a bin, with their phases, sum to at a node.
  ScatteringMatrix& at(std::size_t bin, std::size_t node) { return values_[bin * at_.size() + node]; }

  /// Adds the sum over all bins at all wavenumbers of the band to `sums`, and empties the bins.
  void move_to(std::span<ScatteringMatrix> sums);

 private:
  std::size_t append(std::int64_t key);
  void expand(std::size_t bin, std::span<ScatteringMatrix> sums) const;

  std::span<const double> wavenumbers_, at_;  // at_: the nodes, or all wavenumbers
  const ChebyshevNodes* nodes_ = nullptr;     // null: nothing is interpolated
  double width_ = 0.0, spread_;
  std::unordered_map<std::int64_t, std::size_t> index_;
  std::vector<std::int64_t> keys_;
  std::vector<ScatteringMatrix> values_;  // [bin][node]
};

}  // namespace raytube
