#include "imaging/centres.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/error.h"
#include "imaging/fourier.h"
#include "imaging/window.h"

namespace raytube {

namespace {

constexpr double cells_to_a_side = 2.0, most_cells = 3e7;
constexpr std::size_t steps_to_a_side = 12;

double power(const ScatteringMatrix& s) { return std::norm(frobenius_norm(s)); }

// Hann's transform over wavenumbers within pi / side, 1 at x = 0 (Harris 1978, eq. 27b, of a continuous window), as far as its
// first null: what is left out of it are side lobes of 31 dB.
constexpr double response_reach = 2.0;  // [sides]
double hann_response(double x, double side) {
  const double t = x / side;
  if (std::abs(t) >= response_reach) return 0.0;
  if (std::abs(t) < 1e-9) return 1.0;
  if (std::abs(std::abs(t) - 1.0) < 1e-9) return 0.5;
  return std::sin(pi * t) / (pi * t * (1.0 - t * t));
}

// Even weights.
double even_response(double x, double side) { return sinc(pi * x / side); }

template <class Response>
double response(const dvec3& x, double side, Response along) {
  return along(x.x, side) * along(x.y, side) * along(x.z, side);
}

// Pieces of one mechanism within an eighth of a side, in the axes of the look: over all wave vectors their phases stay together
// to 0.2 rad at most.
struct Cluster {
  dvec3 at{0.0};  // mean, by amplitude
  ScatteringMatrix s{};
  std::size_t mechanism = 0;
  std::optional<std::uint32_t> triangle{};  // of the strongest
  double amplitude = 0.0, strongest = -1.0;

  void add(const dvec3& place, const ScatteringPiece& piece) {
    const double size = frobenius_norm(piece.s);
    at += size * place, amplitude += size, s += piece.s;
    if (size > strongest) strongest = size, triangle = piece.triangle;
  }
};

std::vector<Cluster> clusters_of(const std::vector<ScatteringPiece>& pieces, const LookAxes& axes, double side) {
  constexpr double to_a_side = 8.0;
  std::map<std::array<std::int64_t, 4>, std::size_t> known;
  std::vector<Cluster> clusters;
  for (const ScatteringPiece& piece : pieces) {
    const dvec3 place(glm::dot(piece.place, axes.range), glm::dot(piece.place, axes.cross_range),
                      glm::dot(piece.place, axes.height));
    const dvec3 cell = glm::floor(place * to_a_side / side);
    const std::array<std::int64_t, 4> key{static_cast<std::int64_t>(cell.x), static_cast<std::int64_t>(cell.y),
                                          static_cast<std::int64_t>(cell.z), static_cast<std::int64_t>(piece.mechanism)};
    const auto [found, is_new] = known.try_emplace(key, clusters.size());
    if (is_new) clusters.emplace_back().mechanism = static_cast<std::size_t>(piece.mechanism);
    clusters[found->second].add(place, piece);
  }
  std::erase_if(clusters, [](const Cluster& each) { return each.amplitude == 0.0; });
  for (Cluster& each : clusters) each.at /= each.amplitude;
  return clusters;
}

class CentreSearch {
 public:
  CentreSearch(const std::vector<ScatteringPiece>& pieces, const LookAxes& axes, const CentreOptions& options)
      : options_(options), clusters_(clusters_of(pieces, axes, options.side)) {
    find_box();
    make_image();
  }

  // Places of the strongest responses, one after the other.
  std::vector<dvec3> places() {
    std::vector<dvec3> found;
    for (std::size_t i = 0; i < most_looks_per_centre * options_.count && found.size() < options_.count; ++i) {
      const auto peak = std::ranges::max_element(image_, {}, power);
      first_power_ = std::max(first_power_, power(*peak));
      if (!(power(*peak) > least_power * first_power_)) break;
      const dvec3 at = refined(static_cast<std::size_t>(peak - image_.begin()));
      take_off(at, value_at(at));
      // What is left of one that is larger than the cube lies beside it, and is no other one.
      const bool is_new =
          std::ranges::none_of(found, [&](const dvec3& other) { return glm::length(at - other) < 0.5 * options_.side; });
      if (is_new) found.push_back(at);
    }
    return found;
  }

  const std::vector<Cluster>& clusters() const { return clusters_; }

 private:
  static constexpr double least_power = 1e-8;  // 80 dB below the first one
  static constexpr std::size_t most_looks_per_centre = 4;

  void find_box() {
    dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
    for (const Cluster& each : clusters_) low = glm::min(low, each.at), high = glm::max(high, each.at);
    step_ = options_.side / cells_to_a_side;
    middle_ = 0.5 * (low + high);
    double cells = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double count = std::ceil((high[axis] - low[axis]) / step_) + 5.0;
      count_[axis] = count, cells *= count;
    }
    if (!(cells <= most_cells))
      throw InputError(fmt::format("the target has {:.3g} cells of {:g} m, more than {:g}; ask for a coarser --resolution", cells,
                                   step_, most_cells));
    for (std::size_t axis = 0; axis < 3; ++axis) size_[axis] = static_cast<std::size_t>(count_[static_cast<int>(axis)]);
    image_.resize(size_[0] * size_[1] * size_[2]);
  }

  dvec3 place(std::size_t index) const {
    const dvec3 at(static_cast<double>(index / (size_[1] * size_[2])), static_cast<double>(index / size_[2] % size_[1]),
                   static_cast<double>(index % size_[2]));
    return middle_ + (at - 0.5 * (count_ - 1.0)) * step_;
  }

  // Calls visit(cell, response) for the cells that a response at `at` reaches.
  template <class Visit>
  void for_cells_about(const dvec3& at, Visit visit) {
    constexpr double reach = response_reach * cells_to_a_side;
    std::array<std::vector<double>, 3> along;
    std::array<std::size_t, 3> first{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int a = static_cast<int>(axis);
      const double centre = (at[a] - middle_[a]) / step_ + 0.5 * (count_[a] - 1.0);
      const auto begin = static_cast<std::ptrdiff_t>(std::max(0.0, std::ceil(centre - reach)));
      const auto end =
          std::min(static_cast<std::ptrdiff_t>(size_[axis]), static_cast<std::ptrdiff_t>(std::floor(centre + reach)) + 1);
      first[axis] = static_cast<std::size_t>(begin);
      for (std::ptrdiff_t i = begin; i < end; ++i)
        along[axis].push_back(hann_response((static_cast<double>(i) - centre) * step_, options_.side));
    }
    for (std::size_t a = 0; a < along[0].size(); ++a)
      for (std::size_t b = 0; b < along[1].size(); ++b) {
        ScatteringMatrix* const line = image_.data() + ((first[0] + a) * size_[1] + first[1] + b) * size_[2] + first[2];
        for (std::size_t c = 0; c < along[2].size(); ++c) visit(line[c], along[0][a] * along[1][b] * along[2][c]);
      }
  }

  void add(const dvec3& at, const ScatteringMatrix& s, double sign) {
    for_cells_about(at, [&](ScatteringMatrix& cell, double response) {
      ScatteringMatrix part = s;
      cell += part *= sign * response;
    });
  }

  void make_image() {
    for (const Cluster& each : clusters_) add(each.at, each.s, 1.0);
  }

  void take_off(const dvec3& at, const ScatteringMatrix& s) {
    taken_.push_back({at, s});
    add(at, s, -1.0);
  }

  // Of the pieces, less what was taken off.
  ScatteringMatrix value_at(const dvec3& at) const {
    ScatteringMatrix sum;
    const auto add = [&](const dvec3& place, ScatteringMatrix s, double sign) {
      const dvec3 away = place - at;
      if (std::max({std::abs(away.x), std::abs(away.y), std::abs(away.z)}) < response_reach * options_.side)
        sum += s *= sign * response(away, options_.side, hann_response);
    };
    for (const Cluster& each : clusters_) add(each.at, each.s, 1.0);
    for (const auto& [place, s] : taken_) add(place, s, -1.0);
    return sum;
  }

  // A parabola through the levels of the cell and its neighbours, along each axis.
  dvec3 refined(std::size_t index) const {
    dvec3 at = place(index);
    const std::array<std::size_t, 3> stride{size_[1] * size_[2], size_[2], 1};
    const std::array<std::size_t, 3> cell{index / stride[0], index / stride[1] % size_[1], index % size_[2]};
    const auto level = [&](std::size_t i) { return std::log(power(image_[i]) + std::numeric_limits<double>::min()); };
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (cell[axis] == 0 || cell[axis] + 1 == size_[axis]) continue;
      const double before = level(index - stride[axis]), after = level(index + stride[axis]),
                   bend = before - 2.0 * level(index) + after;
      if (bend < 0.0) at[static_cast<int>(axis)] += step_ * std::clamp(0.5 * (before - after) / bend, -0.5, 0.5);
    }
    return at;
  }

  const CentreOptions& options_;
  std::vector<Cluster> clusters_;
  dvec3 middle_{0.0}, count_{0.0};
  double step_ = 0.0, first_power_ = 0.0;
  std::array<std::size_t, 3> size_{};
  std::vector<ScatteringMatrix> image_;
  std::vector<std::pair<dvec3, ScatteringMatrix>> taken_;
};

// Least squares over all wave vectors of even weights: G a = b, G_mn = r(x_n - x_m), b_m = sum of S_i r(x_i - x_m).
std::vector<ScatteringMatrix> fitted(const std::vector<Cluster>& clusters, const std::vector<dvec3>& places, double side) {
  const auto count = static_cast<Eigen::Index>(places.size());
  Eigen::MatrixXd gram(count, count);
  Eigen::MatrixXcd right = Eigen::MatrixXcd::Zero(count, 4);
  for (Eigen::Index m = 0; m < count; ++m) {
    const dvec3& at = places[static_cast<std::size_t>(m)];
    for (Eigen::Index n = 0; n < count; ++n) gram(m, n) = response(places[static_cast<std::size_t>(n)] - at, side, even_response);
    for (const Cluster& each : clusters) {
      const double weight = response(each.at - at, side, even_response);
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
void describe(const std::vector<Cluster>& clusters, const dvec3& at, const CentreOptions& options, ScatteringCentre& centre) {
  std::vector<std::pair<dvec3, ScatteringMatrix>> near;
  std::array<ScatteringMatrix, scattering_mechanisms.size()> by_mechanism{};
  double strongest = -1.0;
  for (const Cluster& each : clusters) {
    const dvec3 away = each.at - at;
    if (std::max({std::abs(away.x), std::abs(away.y), std::abs(away.z)}) > options.side) continue;
    ScatteringMatrix s = each.s;
    near.push_back({away, s *= response(away, options.side, hann_response)});
    by_mechanism[each.mechanism] += s;
    if (power(s) > strongest && each.triangle) strongest = power(s), centre.triangle = each.triangle;
  }
  double all = 0.0;
  for (const ScatteringMatrix& s : by_mechanism) all += power(s);
  for (std::size_t m = 0; m < by_mechanism.size() && all > 0.0; ++m) centre.shares[m] = power(by_mechanism[m]) / all;
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
  ScatteringCentres result;
  for (const ScatteringPiece& piece : pieces) result.rest += piece.s;
  if (pieces.empty()) return result;
  CentreSearch search(pieces, axes, options);
  const std::vector<dvec3> places = search.places();
  const std::vector<ScatteringMatrix> amplitudes = fitted(search.clusters(), places, options.side);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const dvec3& at = places[i];
    ScatteringCentre& centre = result.centres.emplace_back();
    centre.place = at.x * axes.range + at.y * axes.cross_range + at.z * axes.height;
    centre.s = amplitudes[i];
    describe(search.clusters(), at, options, centre);
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
