#include "utd/fan/azimuth_integral.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/gauss.h"

namespace raytube {

namespace {

constexpr std::array counts = {6, 8, 12, 16, 24, 32, 48};
/// A rule, and what its points say of the last two terms of the Legendre series they resolve.
struct Rule {
  std::span<const GaussPoint> points;
  std::array<std::vector<double>, 2> tail;  // weight of each point

  explicit Rule(int count) : points(gauss_rule(count)) {
    for (std::vector<double>& term : tail) term.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double x = 2 * points[i].node - 1;
      double before = 1.0, value = x;
      for (int n = 2; n < count; ++n) {
        const double next = ((2 * n - 1) * x * value - (n - 1) * before) / n;
        before = value;
        value = next;
      }
      tail[0][i] = points[i].weight * (2 * count - 3) * before;
      tail[1][i] = points[i].weight * (2 * count - 1) * value;
    }
  }
};

const std::vector<Rule>& rules() {
  static const std::vector<Rule> all(counts.begin(), counts.end());
  return all;
}

class Integrator {
 public:
  Integrator(const AzimuthDensity& density, std::size_t frequency_count) : density_(density), frequency_count_(frequency_count) {
    result_.value.resize(frequency_count);
    result_.error.resize(frequency_count);
  }

  // Panels are halved 8 times at most: what is left then is a jump, and its error is as small as the panel.
  void add(double from, double to, double tolerance, int halvings) {
    const std::optional<std::size_t> first = first_rule(from, to);
    if (!first) return;
    for (std::size_t rule = halvings == 8 ? std::min(*first, counts.size() - 1) : *first; rule < counts.size(); ++rule) {
      sample(rules()[rule], from, to);
      if (!estimate(rules()[rule], to - from, tolerance) && !(halvings == 8 && rule + 1 == counts.size())) continue;
      accept();
      if (density_.counted)
        for (const GaussPoint& point : rules()[rule].points)
          density_.counted(from + point.node * (to - from), (to - from) * point.weight);
      return;
    }
    const double middle = (from + to) / 2;
    add(from, middle, tolerance / 2, halvings + 1);
    add(middle, to, tolerance / 2, halvings + 1);
  }

  AzimuthIntegral take() { return std::move(result_); }

 private:
  // A polynomial of degree n follows e^{jx} over 2n radians; some more make it exact. So it does where the phase is steepest: of
  // a phase that changes by up to a in half a panel, as the parabola through three azimuths does, the Legendre series ends beyond
  // n = a, like j_n(a) (DLMF 10.19(iii)). Of both ends of the range that counts which changes less: where rays come to meet
  // another face, one of them jumps. Much of the way round an edge rays meet nothing.
  std::optional<std::size_t> first_rule(double from, double to) const {
    constexpr std::array shares = {0.03, 0.5, 0.97};
    std::array<std::optional<PhaseRange>, shares.size()> at;
    for (std::size_t i = 0; i < at.size(); ++i) at[i] = density_.survey(from + shares[i] * (to - from));
    if (std::ranges::none_of(at, [](const auto& range) { return range.has_value(); })) return {};
    std::array<PhaseRange, 2> change{};
    for (std::size_t i = 0; i < 2; ++i)
      if (at[i] && at[i + 1]) change[i] = {at[i + 1]->low - at[i]->low, at[i + 1]->high - at[i]->high};
    const double bend = at[0] && at[1] && at[2] ? 0.5 : 0.0, half = 2 * (shares[1] - shares[0]);
    double turned = 0.0, steepest = 0.0;
    for (std::size_t i = 0; i < 2; ++i) {
      turned += std::max(std::abs(change[i].low), std::abs(change[i].high));
      const auto slope = [&](double PhaseRange::*end) {
        return std::abs((1 + bend) * change[i].*end - bend * change[1 - i].*end) / half;
      };
      steepest = std::max(steepest, std::min(slope(&PhaseRange::low), slope(&PhaseRange::high)));
    }
    // A millionth of a point keeps the first rule the same on bodies of whole wavelengths, whatever the rounding.
    const double points = 5.0 + std::max(turned / 2, steepest) - 1e-6;
    return std::ranges::lower_bound(counts, points) - counts.begin();
  }

  void sample(const Rule& rule, double from, double to) {
    samples_.resize(rule.points.size());
    for (std::size_t i = 0; i < samples_.size(); ++i) density_.at(from + rule.points[i].node * (to - from), samples_[i]);
  }

  // The series goes on after the terms the rule resolves about as it ends, and of what follows a Gauss rule of n points misses
  // the terms from 2n on: about the square of the last ones. Bends inside a panel leave four times what smooth functions do. All
  // channels decide together, so that it is not the polarisation
  // basis that does.
  bool estimate(const Rule& rule, double width, double tolerance) {
    sum_.assign(frequency_count_, {});
    error_.assign(frequency_count_, {});
    bool good = true;
    for (std::size_t f = 0; f < frequency_count_; ++f) {
      std::array<ScatteringMatrix, 2> tail;
      double size = 0.0;
      for (std::size_t i = 0; i < samples_.size(); ++i) {
        const ScatteringMatrix& sample = samples_[i][f];
        sum_[f] += ScatteringMatrix(sample) *= width * rule.points[i].weight;
        for (int term = 0; term < 2; ++term) tail[term] += ScatteringMatrix(sample) *= rule.tail[term][i];
        size = std::max(size, frobenius_norm(sample));
      }
      const double left = std::max(frobenius_norm(tail[0]), frobenius_norm(tail[1])),
                   share = size > 0.0 ? std::min(1.0, 4.0 * left / size) : 0.0;
      for (int p = 0; p < 2; ++p)
        for (int q = 0; q < 2; ++q)
          error_[f][p][q] = width * share * std::max(std::abs(tail[0].at(p, q)), std::abs(tail[1].at(p, q)));
      good = good && width * share * left <= tolerance;
    }
    return good;
  }

  void accept() {
    for (std::size_t f = 0; f < frequency_count_; ++f) {
      result_.value[f] += sum_[f];
      for (int p = 0; p < 2; ++p)
        for (int q = 0; q < 2; ++q) result_.error[f][p][q] += error_[f][p][q];
    }
  }

  const AzimuthDensity& density_;
  std::size_t frequency_count_;
  std::vector<std::vector<ScatteringMatrix>> samples_;
  std::vector<ScatteringMatrix> sum_;
  std::vector<ChannelErrors> error_;
  AzimuthIntegral result_;
};

}  // namespace

AzimuthIntegral integrate_over_azimuth(const AzimuthDensity& density, std::size_t frequency_count,
                                       const std::vector<double>& cuts, double tolerance, std::span<const AzimuthRange> wanted) {
  Integrator integrator(density, frequency_count);
  const double whole = cuts.back() - cuts.front();
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    const double width = cuts[i] - cuts[i - 1];
    const auto reaches = [&](const AzimuthRange& range) { return range.from < cuts[i] && range.to > cuts[i - 1]; };
    if (!wanted.empty() && std::ranges::none_of(wanted, reaches)) continue;
    integrator.add(cuts[i - 1], cuts[i], tolerance * width / whole, 0);
  }
  return integrator.take();
}

}  // namespace raytube
