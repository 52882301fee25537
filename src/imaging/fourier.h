// Fourier transforms on even grids, by FFTW, and of samples that lie anywhere, by gridding.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/field.h"

namespace raytube {

/// In place: data[m] = sum over n of data[n] e^{sign 2 pi j m n / size}, along every axis of `shape`, the last one running
/// fastest. Not divided by anything. sign: 1 or -1. Thread-safe.
void fourier_transform(std::span<Complex> data, std::span<const std::size_t> shape, int sign);

/// The next number from `least` on whose transform is fast: even, without prime factors above 5.
std::size_t fast_size(std::size_t least);

/// An even grid in up to three axes: points (i - count / 2) step along each; one point along those that are not there.
struct EvenGrid {
  std::array<std::size_t, 3> count{1, 1, 1};
  std::array<double, 3> step{1.0, 1.0, 1.0};

  std::size_t size() const { return count[0] * count[1] * count[2]; }
};

/// Sums of samples v_j at wave vectors K_j over a grid x: I(x) = sum of v_j e^{-j K_j . x}, to 1e-7 of the sum of |v_j|. By a
/// convolution onto a grid twice as fine, its transform, and division by the kernel's (Barnett, Magland & af Klinteberg, SIAM J.
/// Sci. Comput. 41 (2019), sec. 3.1, type 1).
class GriddedTransform {
 public:
  /// `wave_vectors` along the grid's axes [rad/m]; must outlive it.
  GriddedTransform(const EvenGrid& grid, std::span<const dvec3> wave_vectors);

  /// At grid points, the last axis running fastest. Thread-safe.
  std::vector<Complex> operator()(std::span<const Complex> values) const;

 private:
  EvenGrid grid_;
  std::span<const dvec3> wave_vectors_;
};

/// The same sum of scattering matrices, added one after the other.
class GriddedSum {
 public:
  explicit GriddedSum(const EvenGrid& grid);

  void add(const dvec3& wave_vector, const ScatteringMatrix& value);
  /// At grid points, the last axis running fastest.
  std::vector<ScatteringMatrix> at_points() const;

 private:
  EvenGrid grid_;
  std::array<std::size_t, 3> fine_;
  std::vector<ScatteringMatrix> sums_;  // on the fine grid
};

}  // namespace raytube
