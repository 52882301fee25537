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
constexpr std::size_t kernel_width = 8;
constexpr double kernel_exponent = 2.30 * kernel_width;
constexpr std::size_t finer = 2;

double kernel(double z) { return z * z < 1.0 ? std::exp(kernel_exponent * (std::sqrt(1.0 - z * z) - 1.0)) : 0.0; }

// What a sample gives to points of one axis.
struct KernelRow {
  std::array<std::size_t, kernel_width> at{};
  std::array<double, kernel_width> weight{};
  std::size_t count = 1;
};

// `phase` of a step of the grid [rad].
KernelRow kernel_row(double phase, std::size_t fine) {
  if (fine == 1) return {{}, {1.0}, 1};
  const auto size = static_cast<double>(fine);
  const double turns = phase / (2.0 * pi), place = (turns - std::floor(turns)) * size;
  const double first = std::ceil(place - 0.5 * kernel_width);
  KernelRow row{.count = kernel_width};
  for (std::size_t i = 0; i < kernel_width; ++i) {
    const double point = first + static_cast<double>(i);
    row.weight[i] = kernel((point - place) / (0.5 * kernel_width));
    row.at[i] = static_cast<std::size_t>(point + size) % fine;
  }
  return row;
}

std::array<std::size_t, 3> fine_counts(const EvenGrid& grid) {
  std::array<std::size_t, 3> fine{1, 1, 1};
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (grid.count[axis] > 1) fine[axis] = fast_size(std::max<std::size_t>(finer * grid.count[axis], 2 * kernel_width));
  return fine;
}

// sum += factor value. Complex numbers are pairs of doubles: four channels, as two vectors.
template <class Value>
void add_scaled(Value& sum, const Value& value, double factor) {
  auto* const to = reinterpret_cast<double*>(&sum);
  const auto* const from = reinterpret_cast<const double*>(&value);
  for (std::size_t i = 0; i < sizeof(Value) / sizeof(double); ++i) to[i] += factor * from[i];
}

// Onto the points about its place on the fine grid.
template <class Value>
void spread(const Value value, const dvec3& wave_vector, const EvenGrid& grid, const std::array<std::size_t, 3>& fine,
            std::vector<Value>& sums) {
  std::array<KernelRow, 3> rows;
  for (std::size_t axis = 0; axis < 3; ++axis)
    rows[axis] = kernel_row(wave_vector[static_cast<int>(axis)] * grid.step[axis], fine[axis]);
  for (std::size_t a = 0; a < rows[0].count; ++a)
    for (std::size_t b = 0; b < rows[1].count; ++b) {
      Value* const line = sums.data() + (rows[0].at[a] * fine[1] + rows[1].at[b]) * fine[2];
      const double weight = rows[0].weight[a] * rows[1].weight[b];
      for (std::size_t c = 0; c < rows[2].count; ++c) add_scaled(line[rows[2].at[c]], value, weight * rows[2].weight[c]);
    }
}

// One over the transform of the kernel, at the points of the grid.
std::vector<double> correction(std::size_t count, std::size_t fine) {
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

// The transform of the sums on the fine grid, where it is wanted.
std::vector<Complex> points_of(std::vector<Complex> sums, const EvenGrid& grid, const std::array<std::size_t, 3>& fine) {
  fourier_transform(sums, fine, -1);
  std::array<std::vector<double>, 3> corrections;
  for (std::size_t axis = 0; axis < 3; ++axis) corrections[axis] = correction(grid.count[axis], fine[axis]);
  const auto place = [&](std::size_t axis, std::size_t i) { return (i + fine[axis] - grid.count[axis] / 2) % fine[axis]; };
  std::vector<Complex> result;
  result.reserve(grid.size());
  for (std::size_t a = 0; a < grid.count[0]; ++a)
    for (std::size_t b = 0; b < grid.count[1]; ++b)
      for (std::size_t c = 0; c < grid.count[2]; ++c)
        result.push_back(sums[(place(0, a) * fine[1] + place(1, b)) * fine[2] + place(2, c)] *
                         (corrections[0][a] * corrections[1][b] * corrections[2][c]));
  return result;
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
    : grid_(grid), wave_vectors_(wave_vectors) {}

std::vector<Complex> GriddedTransform::operator()(std::span<const Complex> values) const {
  const std::array<std::size_t, 3> fine = fine_counts(grid_);
  std::vector<Complex> sums(fine[0] * fine[1] * fine[2]);
  for (std::size_t j = 0; j < values.size(); ++j) spread(values[j], wave_vectors_[j], grid_, fine, sums);
  return points_of(std::move(sums), grid_, fine);
}

GriddedSum::GriddedSum(const EvenGrid& grid) : grid_(grid), fine_(fine_counts(grid)), sums_(fine_[0] * fine_[1] * fine_[2]) {}

void GriddedSum::add(const dvec3& wave_vector, const ScatteringMatrix& value) { spread(value, wave_vector, grid_, fine_, sums_); }

std::vector<ScatteringMatrix> GriddedSum::at_points() const {
  std::vector<ScatteringMatrix> result(grid_.size());
  for (const int channel : {0, 1, 2, 3}) {
    std::vector<Complex> sums;
    for (const ScatteringMatrix& s : sums_) sums.push_back(s.at(channel / 2, channel % 2));
    sums = points_of(std::move(sums), grid_, fine_);
    for (std::size_t i = 0; i < sums.size(); ++i) result[i].at(channel / 2, channel % 2) = sums[i];
  }
  return result;
}

}  // namespace raytube
