#include "sbr/beams/estimate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "scene/tolerance.h"

namespace raytube {

namespace {

// Phases of some k radius are known to a few roundings, on a current of unit amplitude all over the launch plane.
double rounding(const LaunchGrid& grid, double k, double radius) {
  const double area = grid.columns * grid.du * grid.rows * grid.dv;
  return 4.0 * std::numeric_limits<double>::epsilon() * (1.0 + k * radius) * k * area / (2.0 * pi);
}

// A grid's error falls with its cell to the power 1 (edges along the grid) to 1.5 (across it): the difference to a grid three
// times as coarse is 2 to 4.2 times the error on average. Two samples of it may be small by chance, so nothing is taken off.
double sampling(const std::array<ErrorSum, coarse_grids>& coarse, int p, int q) {
  double square = 0.0;
  for (const ErrorSum& difference : coarse) square += std::pow(difference.size(p, q), 2);
  return std::sqrt(square / coarse_grids);
}

}  // namespace

std::vector<ChannelErrors> numerical_error(const TubeSums& sums, const LaunchGrid& grid, std::span<const double> wavenumbers,
                                           double radius) {
  std::vector<ChannelErrors> errors(wavenumbers.size());
  for (std::size_t f = 0; f < errors.size(); ++f) {
    const double k = wavenumbers[f];
    // PO radiates k / 2 pi per launch area at most, both ways across a sliver.
    const double certain = rounding(grid, k, radius) + k / (2.0 * pi) * sums.sliver_area;
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q) {
        const double sampled = sums.coarse.empty() ? 0.0 : sampling(sums.coarse[f], p, q);
        const double known = sums.pieces.empty() ? 0.0 : sums.pieces[f].size(p, q);
        const double left = sums.quadrature.empty() ? 0.0 : sums.quadrature[f].size(p, q);
        errors[f][p][q] = certain + std::hypot(sampled, known, left);
      }
  }
  return errors;
}

namespace {

// What truncated tubes would meet next, and after that: of what the last bounces brought the share that a geometric series goes
// on with, and what is left of their waves if it goes into all directions alike, sigma = area, into the receive polarisations
// that bounces have gone into so far. Between sheets waves come back into the same direction every second bounce or later.
class TruncatedTubes {
 public:
  explicit TruncatedTubes(const TubeSums& sums) : sums_(sums), first_(first_of_last(sums.bounces.size())) {
    const double before = first_ < sums.met.size() ? sums.met[first_] : 0.0;
    const double share = before > 0.0 ? std::min(std::sqrt(sums.truncated.sigma() / before), most) : most;
    series_ = share / (1.0 - share);
  }

  double error(std::size_t f, std::size_t p, std::size_t q) const {
    double last = 0.0;
    std::array<double, 2> power{};
    for (std::size_t b = 0; b < sums_.bounces.size(); ++b) {
      const auto& s = sums_.bounces[b][f].s;
      if (b >= first_) last += std::abs(s[p][q]);
      for (std::size_t receive = 0; receive < 2; ++receive) power[receive] += std::norm(s[receive][q]);
    }
    const double all = power[0] + power[1], polarised = all > 0.0 ? power[p] / all : 0.5;
    return std::hypot(series_ * last, std::sqrt(polarised * sums_.truncated.sigma() / (4.0 * pi)));
  }

 private:
  static constexpr double most = 0.9;  // beyond, nothing is known of what follows
  static std::size_t first_of_last(std::size_t bounces) {
    return bounces - std::min(bounces, std::max<std::size_t>(2, bounces / 2));
  }

  const TubeSums& sums_;
  std::size_t first_;
  double series_;
};

}  // namespace

void add_truncated_tubes(TubeSums& sums) {
  if (sums.truncated.sigma() == 0.0) return;
  const TruncatedTubes truncated(sums);
  for (std::size_t f = 0; f < sums.error.size(); ++f)
    for (std::size_t p = 0; p < 2; ++p)
      for (std::size_t q = 0; q < 2; ++q) sums.error[f][p][q] += truncated.error(f, p, q);
}

double excess(ScatteringMatrix total, ChannelErrors errors, bool monostatic, double relative_tolerance,
              const ChannelErrors& permitted) {
  if (monostatic) {
    total.at(0, 1) = total.at(1, 0) = 0.5 * (total.at(0, 1) + total.at(1, 0));
    errors[0][1] = errors[1][0] = 0.5 * (errors[0][1] + errors[1][0]);
  }
  return excess(total, errors, relative_tolerance, permitted);
}

}  // namespace raytube
