#include "math/band_sum.h"

#include <algorithm>
#include <cmath>

#include "math/node_waves.h"

namespace raytube {

namespace {

constexpr double error = 1e-7;           // of the sum of amplitudes
constexpr double least_phase = 1.0 / 8;  // of the narrowest class [rad]: half the band's width times its half span
constexpr double bin_share = 0.5;        // of a class's half span, the width of its bins

}  // namespace

BandSum::BandSum(std::span<const double> wavenumbers, bool every_one)
    : band_(wavenumbers), every_one_(every_one || band_.half_width() <= 0.0) {}

BandSum::Class& BandSum::class_of(double half_span) {
  int power = 0;
  if (!every_one_ && half_span > 0.0) {
    std::frexp(band_.half_width() * half_span / least_phase, &power);
    power = std::max(power, 0);
  }
  const auto [entry, is_new] = classes_.try_emplace(power);
  if (is_new) {
    const double span = every_one_ ? 0.0 : std::ldexp(least_phase / band_.half_width(), power), width = bin_share * span;
    const ChebyshevNodes* nodes = every_one_ ? nullptr : band_.nodes_of_fresnel(span + 0.5 * width, error);
    entry->second = {nodes == nullptr ? band_.wavenumbers() : std::span<const double>(nodes->at), nodes, width};
  }
  return entry->second;
}

BandSum::Bin BandSum::bin(double path, double half_span) {
  Class& group = class_of(half_span);
  const long long index = group.nodes == nullptr ? 0 : std::llround(path / group.width);
  std::vector<ScatteringMatrix>& sum = group.bins[index];
  sum.resize(group.at.size());
  return {group.at, group.nodes == nullptr ? 0.0 : static_cast<double>(index) * group.width, sum};
}

std::vector<Complex> BandSum::interpolated(const std::vector<Complex>& values) {
  const ChebyshevNodes* nodes = class_of(0.0).nodes;
  if (nodes == nullptr) return values;
  std::vector<Complex> all(band_.wavenumbers().size());
  for (std::size_t f = 0; f < all.size(); ++f)
    for (std::size_t n = 0; n < values.size(); ++n) all[f] += nodes->weights[f * values.size() + n] * values[n];
  return all;
}

void BandSum::expand(const Class& group, double path, std::span<const ScatteringMatrix> values,
                     std::span<ScatteringMatrix> sum) const {
  if (group.nodes != nullptr) return add_waves(values, *group.nodes, band_.wavenumbers(), path, sum);
  for (std::size_t f = 0; f < sum.size(); ++f) sum[f] += values[f];
}

void BandSum::add_to(std::span<ScatteringMatrix> sum) const {
  for (const auto& [power, group] : classes_)
    for (const auto& [index, values] : group.bins) expand(group, static_cast<double>(index) * group.width, values, sum);
}

}  // namespace raytube
