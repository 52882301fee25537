#include "output/image_compare/registration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "imaging/fourier.h"
#include "output/compare/error_measures.h"

namespace raytube {

namespace {

// A plane with room for shifts of half an image beside it, so that no end meets the other.
struct Plane {
  std::size_t columns, rows;
  std::vector<Complex> values{};

  void transform(int sign) { fourier_transform(values, std::array{rows, columns}, sign); }
};

std::size_t with_room(std::size_t size) { return size == 1 ? 1 : fast_size(size + size / 2); }

// What images have everywhere alike correlates best where they overlap most, whatever they show.
double background(std::span<const double> values) { return quantile({values.begin(), values.end()}, 0.5); }

Plane spectrum_of(std::span<const double> values, std::size_t columns, std::size_t rows) {
  Plane plane{with_room(columns), with_room(rows)};
  plane.values.resize(plane.columns * plane.rows);
  const double everywhere = background(values);
  for (std::size_t i = 0; i < values.size(); ++i)
    plane.values[i / columns * plane.columns + i % columns] = values[i] - everywhere;
  plane.transform(-1);
  return plane;
}

Plane cross_spectrum(const std::vector<MagnitudePair>& channels, std::size_t columns, std::size_t rows) {
  Plane sum{with_room(columns), with_room(rows)};
  sum.values.resize(sum.columns * sum.rows);
  for (const MagnitudePair& pair : channels) {
    const Plane result = spectrum_of(pair.result, columns, rows), reference = spectrum_of(pair.reference, columns, rows);
    for (std::size_t i = 0; i < sum.values.size(); ++i) sum.values[i] += result.values[i] * std::conj(reference.values[i]);
  }
  return sum;
}

// A number of a transform as one from -size / 2 on.
double centred(std::size_t i, std::size_t size) {
  return static_cast<double>(i) - (2 * i > size ? static_cast<double>(size) : 0.0);
}

// A correlation that is better by more than rounding.
bool beats(double correlation, double highest) { return correlation > highest + 1e-12 * std::abs(highest); }

dvec2 whole_shift(Plane correlation, std::size_t columns, std::size_t rows) {
  correlation.transform(1);
  dvec2 best(0.0);
  double highest = correlation.values.front().real();
  for (std::size_t i = 0; i < correlation.values.size(); ++i) {
    const dvec2 shift(centred(i % correlation.columns, correlation.columns), centred(i / correlation.columns, correlation.rows));
    if (std::abs(shift.x) > 0.5 * static_cast<double>(columns) || std::abs(shift.y) > 0.5 * static_cast<double>(rows)) continue;
    if (beats(correlation.values[i].real(), highest)) highest = correlation.values[i].real(), best = shift;
  }
  return best;
}

constexpr int trials = 10;  // to either side

// 0, -1, 1, -2, ...: of equal trials the nearest comes first.
int outwards(std::size_t i) { return (i % 2 == 1 ? -1 : 1) * static_cast<int>((i + 1) / 2); }

// e^{2 pi j k d / size} of every wave k at every trial d.
std::vector<std::array<Complex, 2 * trials + 1>> waves(std::size_t size, double middle, double step) {
  std::vector<std::array<Complex, 2 * trials + 1>> all(size);
  for (std::size_t k = 0; k < size; ++k)
    for (std::size_t t = 0; t < all[k].size(); ++t)
      all[k][t] = std::polar(1.0, 2.0 * pi * centred(k, size) * (middle + outwards(t) * step) / static_cast<double>(size));
  return all;
}

// The highest correlation among trials `step` apart about `middle`, which wins where all are equal.
dvec2 finer(const Plane& spectrum, const dvec2& middle, double step) {
  constexpr std::size_t count = 2 * trials + 1;
  const auto x = waves(spectrum.columns, middle.x, step), y = waves(spectrum.rows, middle.y, step);
  std::array<std::array<double, count>, count> correlation{};  // [y][x]
  for (std::size_t row = 0; row < spectrum.rows; ++row) {
    std::array<Complex, count> along{};
    for (std::size_t column = 0; column < spectrum.columns; ++column)
      for (std::size_t t = 0; t < count; ++t) along[t] += spectrum.values[row * spectrum.columns + column] * x[column][t];
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < count; ++j) correlation[i][j] += (y[row][i] * along[j]).real();
  }
  dvec2 best = middle;
  double highest = correlation[0][0];
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < count; ++j)
      if (beats(correlation[i][j], highest)) highest = correlation[i][j], best = middle + step * dvec2(outwards(j), outwards(i));
  return best;
}

// What both images show where the result lies by so many pixels further.
struct Overlap {
  Overlap(const std::vector<MagnitudePair>& channels, std::size_t all_columns, std::size_t all_rows, const dvec2& shift)
      : columns(all_columns - static_cast<std::size_t>(std::abs(shift.x))),
        rows(all_rows - static_cast<std::size_t>(std::abs(shift.y))) {
    for (const MagnitudePair& pair : channels) {
      const auto part = [&](std::span<const double> values, const dvec2& from) {
        std::vector<double> kept;
        for (std::size_t row = 0; row < rows; ++row) {
          const auto first = (static_cast<std::size_t>(from.y) + row) * all_columns + static_cast<std::size_t>(from.x);
          kept.insert(kept.end(), values.begin() + static_cast<std::ptrdiff_t>(first),
                      values.begin() + static_cast<std::ptrdiff_t>(first + columns));
        }
        return kept;
      };
      pairs.push_back({part(pair.result, glm::max(shift, dvec2(0.0))), part(pair.reference, glm::max(-shift, dvec2(0.0)))});
    }
  }

  std::size_t columns, rows;
  std::vector<MagnitudePair> pairs;
};

constexpr int most_rounds = 4;

}  // namespace

// Whole pixels until what both show lies still: what comes in or goes out at a border would pull the finer steps along.
dvec2 best_shift(const std::vector<MagnitudePair>& channels, std::size_t columns, std::size_t rows) {
  dvec2 whole(0.0), step = whole_shift(cross_spectrum(channels, columns, rows), columns, rows);
  for (int round = 0; round < most_rounds && step != dvec2(0.0); ++round) {
    const dvec2 next = whole + step;
    if (2.0 * std::abs(next.x) > static_cast<double>(columns) || 2.0 * std::abs(next.y) > static_cast<double>(rows)) break;
    whole = next;
    const Overlap both(channels, columns, rows, whole);
    step = whole_shift(cross_spectrum(both.pairs, both.columns, both.rows), both.columns, both.rows);
  }
  const Overlap both(channels, columns, rows, whole);
  const Plane spectrum = cross_spectrum(both.pairs, both.columns, both.rows);
  dvec2 shift(0.0);
  for (const double fine : {0.1, 0.01, 0.001}) shift = finer(spectrum, shift, fine);
  return whole + shift;
}

}  // namespace raytube
