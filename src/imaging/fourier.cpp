#include "imaging/fourier.h"

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>

#include "math/gauss.h"

namespace raytube {

namespace {

// Making plans is not thread-safe, following them is.
std::mutex planning;

class Plan {
 public:
  Plan(std::span<Complex> data, std::span<const std::size_t> shape, int sign) {
    const std::vector<int> sizes(shape.begin(), shape.end());
    auto* const numbers = reinterpret_cast<fftw_complex*>(data.data());
    const std::lock_guard lock(planning);
    plan_ = fftw_plan_dft(static_cast<int>(sizes.size()), sizes.data(), numbers, numbers, sign > 0 ? FFTW_BACKWARD : FFTW_FORWARD,
                          FFTW_ESTIMATE);
  }
  ~Plan() {
    const std::lock_guard lock(planning);
    fftw_destroy_plan(plan_);
  }
  Plan(const Plan&) = delete;

  void follow() const { fftw_execute(plan_); }

 private:
  fftw_plan plan_;
};

// Points of the fine grid that a sample goes to, along each axis, and the exponent of the kernel e^{beta (sqrt(1 - z^2) - 1)} for
// a grid twice as fine: 2.30 a point (Barnett et al. 2019, eq. 3.4).
constexpr int kernel_width = 8;
constexpr double kernel_exponent = 2.30 * kernel_width;
constexpr std::size_t finer = 2;

double kernel(double z) { return z * z < 1.0 ? std::exp(kernel_exponent * (std::sqrt(1.0 - z * z) - 1.0)) : 0.0; }

// What a sample gives to points of one axis.
struct KernelRow {
  std::array<std::size_t, kernel_width> at{};
  std::array<double, kernel_width> weight{};
  int count = 1;
};

// `phase` of a step of the grid [rad].
KernelRow kernel_row(double phase, std::size_t fine) {
  if (fine == 1) return {{}, {1.0}, 1};
  const auto size = static_cast<double>(fine);
  const double turns = phase / (2.0 * pi), place = (turns - std::floor(turns)) * size;
  const double first = std::ceil(place - 0.5 * kernel_width);
  KernelRow row{.count = kernel_width};
  for (int i = 0; i < kernel_width; ++i) {
    const double point = first + i;
    row.weight[static_cast<std::size_t>(i)] = kernel((point - place) / (0.5 * kernel_width));
    row.at[static_cast<std::size_t>(i)] = static_cast<std::size_t>(point + size) % fine;
  }
  return row;
}

}  // namespace

void fourier_transform(std::span<Complex> data, std::span<const std::size_t> shape, int sign) {
  if (!data.empty()) Plan(data, shape, sign).follow();
}

std::size_t fast_size(std::size_t least) {
  for (std::size_t size = std::max<std::size_t>(2, least + least % 2);; size += 2) {
    std::size_t left = size;
    for (const std::size_t factor : {2, 3, 5})
      while (left % factor == 0) left /= factor;
    if (left == 1) return size;
  }
}

GriddedTransform::GriddedTransform(const EvenGrid& grid, std::span<const dvec3> wave_vectors)
    : grid_(grid), wave_vectors_(wave_vectors) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (grid.count[axis] > 1) fine_[axis] = fast_size(std::max<std::size_t>(finer * grid.count[axis], 2 * kernel_width));
}

std::vector<Complex> GriddedTransform::spread(std::span<const Complex> values) const {
  std::vector<Complex> fine(fine_[0] * fine_[1] * fine_[2]);
  for (std::size_t j = 0; j < values.size(); ++j) {
    std::array<KernelRow, 3> rows;
    for (int axis = 0; axis < 3; ++axis)
      rows[static_cast<std::size_t>(axis)] =
          kernel_row(wave_vectors_[j][axis] * grid_.step[static_cast<std::size_t>(axis)], fine_[static_cast<std::size_t>(axis)]);
    for (std::size_t a = 0; a < static_cast<std::size_t>(rows[0].count); ++a)
      for (std::size_t b = 0; b < static_cast<std::size_t>(rows[1].count); ++b) {
        const Complex value = values[j] * (rows[0].weight[a] * rows[1].weight[b]);
        Complex* const line = fine.data() + (rows[0].at[a] * fine_[1] + rows[1].at[b]) * fine_[2];
        for (std::size_t c = 0; c < static_cast<std::size_t>(rows[2].count); ++c)
          line[rows[2].at[c]] += value * rows[2].weight[c];
      }
  }
  return fine;
}

// One over the transform of the kernel, at the points of the grid.
std::vector<double> GriddedTransform::correction(int axis) const {
  const std::size_t count = grid_.count[static_cast<std::size_t>(axis)], fine = fine_[static_cast<std::size_t>(axis)];
  if (count == 1) return {1.0};
  std::vector<double> result;
  for (std::size_t i = 0; i < count; ++i) {
    const double turns = (static_cast<double>(i) - static_cast<double>(count / 2)) / static_cast<double>(fine),
                 half = 0.5 * kernel_width;
    double sum = 0.0;
    for (const GaussPoint& point : gauss_rule(most_gauss_points))
      sum += point.weight * kernel(point.node) * std::cos(2.0 * pi * turns * half * point.node);
    result.push_back(1.0 / (2.0 * half * sum));
  }
  return result;
}

std::vector<Complex> GriddedTransform::operator()(std::span<const Complex> values) const {
  std::vector<Complex> fine = spread(values);
  fourier_transform(fine, fine_, -1);
  const std::array corrections{correction(0), correction(1), correction(2)};
  const auto place = [&](std::size_t axis, std::size_t i) { return (i + fine_[axis] - grid_.count[axis] / 2) % fine_[axis]; };
  std::vector<Complex> result;
  result.reserve(grid_.size());
  for (std::size_t a = 0; a < grid_.count[0]; ++a)
    for (std::size_t b = 0; b < grid_.count[1]; ++b)
      for (std::size_t c = 0; c < grid_.count[2]; ++c)
        result.push_back(fine[(place(0, a) * fine_[1] + place(1, b)) * fine_[2] + place(2, c)] *
                         (corrections[0][a] * corrections[1][b] * corrections[2][c]));
  return result;
}

}  // namespace raytube
