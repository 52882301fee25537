#include "imaging/centres.h"

#include <algorithm>
#include <cmath>

#include "imaging/centre_search.h"
#include "math/dense.h"

namespace raytube {

namespace {

constexpr std::size_t steps_to_a_side = 12;

// Least squares over all wave vectors of even weights: G a = b, G_mn = r(x_n - x_m), b_m = sum of S_i r(x_i - x_m).
std::vector<ScatteringMatrix> fitted(const std::vector<PieceCluster>& clusters, const std::vector<dvec3>& places, double side) {
  const auto count = static_cast<Eigen::Index>(places.size());
  Eigen::MatrixXd gram(count, count);
  Eigen::MatrixXcd right = Eigen::MatrixXcd::Zero(count, 4);
  for (Eigen::Index m = 0; m < count; ++m) {
    const dvec3& at = places[static_cast<std::size_t>(m)];
    for (Eigen::Index n = 0; n < count; ++n) gram(m, n) = even_response(places[static_cast<std::size_t>(n)] - at, side);
    for (const PieceCluster& each : clusters) {
      const double weight = even_response(each.at - at, side);
      for (int channel = 0; channel < 4; ++channel) right(m, channel) += weight * each.s.at(channel / 2, channel % 2);
    }
  }
  const Eigen::MatrixXcd solved = gram.cast<Complex>().ldlt().solve(right);
  std::vector<ScatteringMatrix> result(places.size());
  for (Eigen::Index m = 0; m < count; ++m)
    for (int channel = 0; channel < 4; ++channel)
      result[static_cast<std::size_t>(m)].at(channel / 2, channel % 2) = solved(m, channel);
  return result;
}

// How far from zero, in steps to either side, a sum stays within 3 dB of its largest.
template <class Sum>
double extent(double most, Sum sum) {
  std::vector<double> levels;
  for (int i = -static_cast<int>(steps_to_a_side); i <= static_cast<int>(steps_to_a_side); ++i)
    levels.push_back(power(sum(most * i / static_cast<double>(steps_to_a_side))));
  const double least = 0.5 * std::ranges::max(levels);
  const auto within = std::ranges::count_if(levels, [&](double level) { return level >= least; });
  return 2.0 * most * static_cast<double>(within) / static_cast<double>(levels.size());
}

// What of the pieces is in the cube about a centre.
void describe(const std::vector<PieceCluster>& clusters, const dvec3& at, const CentreOptions& options,
              ScatteringCentre& centre) {
  std::vector<std::pair<dvec3, ScatteringMatrix>> near;
  std::vector<ScatteringMatrix> by_mechanism(options.mechanisms.size());
  double strongest = -1.0;
  for (const PieceCluster& each : clusters) {
    const dvec3 away = each.at - at;
    if (extent_of(away) > options.side) continue;
    ScatteringMatrix s = each.s;
    near.push_back({away, s *= hann_response(away, options.side)});
    by_mechanism[each.mechanism] += s;
    if (power(s) > strongest && each.triangle) strongest = power(s), centre.triangle = each.triangle;
  }
  double all = 0.0;
  for (const ScatteringMatrix& s : by_mechanism) all += power(s);
  for (const ScatteringMatrix& s : by_mechanism) centre.shares.push_back(all > 0.0 ? power(s) / all : 0.0);
  const auto along = [&](int axis) {
    return extent(pi / options.side, [&](double change) {
      ScatteringMatrix sum;
      for (const auto& [away, s] : near) {
        ScatteringMatrix turned = s;
        sum += turned *= std::polar(1.0, change * away[axis]);
      }
      return sum;
    });
  };
  const double k = 2.0 * pi / options.wavelength;
  centre.band = along(0) / (2.0 * k), centre.azimuth = along(1) / (2.0 * k), centre.elevation = along(2) / (2.0 * k);
}

}  // namespace

LookAxes axes_of_look(const Direction& to_radar) {
  const SphericalBasis basis = spherical_basis(to_radar);
  return {-basis.radial, basis.phi_hat, -basis.theta_hat};
}

std::size_t ScatteringCentre::mechanism() const {
  return static_cast<std::size_t>(std::ranges::max_element(shares) - shares.begin());
}

ScatteringCentres scattering_centres(const std::vector<ScatteringPiece>& pieces, const LookAxes& axes,
                                     const CentreOptions& options) {
  ScatteringCentres result{.centres = {}, .rest = {}, .mechanisms = options.mechanisms};
  for (const ScatteringPiece& piece : pieces) result.rest += piece.s;
  if (pieces.empty()) return result;
  const std::vector<PieceCluster> clusters = clusters_of(pieces, axes, options.side);
  const std::vector<dvec3> places = centre_places(clusters, options.side, options.count);
  const std::vector<ScatteringMatrix> amplitudes = fitted(clusters, places, options.side);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const dvec3& at = places[i];
    ScatteringCentre& centre = result.centres.emplace_back();
    centre.place = at.x * axes.range + at.y * axes.cross_range + at.z * axes.height;
    centre.s = amplitudes[i];
    describe(clusters, at, options, centre);
    result.rest = result.rest - centre.s;
  }
  std::ranges::stable_sort(result.centres, std::ranges::greater{}, [](const ScatteringCentre& c) { return power(c.s); });
  return result;
}

ScatteringMatrix scattering_of(const std::vector<ScatteringCentre>& centres, const dvec3& change) {
  ScatteringMatrix sum;
  for (const ScatteringCentre& centre : centres) {
    ScatteringMatrix turned = centre.s;
    sum += turned *= std::polar(1.0, glm::dot(change, centre.place));
  }
  return sum;
}

}  // namespace raytube
