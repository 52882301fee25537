#include "jobs/retrace.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <set>

namespace raytube {

namespace {

// Coefficients beyond this are left out; singular values below `least_singular` of the largest belong to functions that are the
// same but for rounding.
constexpr double least_coefficient = 1e-5, least_singular = 1e-9;
// So many times as there are coefficients are traced, and one in so many of them to check. Fewer than a third saved: all are.
constexpr double times_a_coefficient = 1.3, checked_share = 0.1, worth = 2.0 / 3.0;
// Of an interval, so that least squares take no time to speak of.
constexpr std::size_t most_coefficients = 160, most_pulses = 1024;

// The largest n for which J_n(z) may exceed least_coefficient: |J_n(z)| <= (z / 2)^n / n! (Abramowitz and Stegun 9.1.62), and for
// large z it falls beyond n = z within some z^{1/3} (9.3.23).
std::size_t degree_of(double z) {
  std::size_t n = 0;
  for (double bound = 1.0; bound > least_coefficient && n < 2 * most_coefficients; bound *= 0.5 * z / static_cast<double>(n)) ++n;
  return std::min(n, static_cast<std::size_t>(std::ceil(z + 5.0 * std::cbrt(z) + 3.0)));
}

// One of the functions A_g e^{-j k L_g} of a look and a frequency.
struct Group {
  std::size_t first, second;  // among the rigid parts; the same for what stays on one
  std::size_t degree;
};

// What a case tells of its times.
class Times {
 public:
  Times(const Case& c, const MovingTarget& target) : c_(c), target_(target), parts_(target.rigid_parts()) {}

  std::size_t looks() const { return c_.sweep.looks.size() / c_.motion->times(); }  // of a pulse
  const Look& look(std::size_t pulse, std::size_t look) const { return c_.sweep.looks[pulse * looks() + look]; }
  double time(std::size_t pulse) const { return c_.sweep.times[pulse * looks()]; }

  // Over the middle of a part [m].
  double path(std::size_t part, std::size_t pulse, std::size_t of) const {
    return path_over_point(part, pulse, of, parts_[part].box.middle());
  }

  std::vector<Group> groups(std::size_t begin, std::size_t end) const {
    std::vector<double> z;
    for (std::size_t part = 0; part < parts_.size(); ++part) z.push_back(largest_slope(part, begin, end));
    std::vector<Group> groups;
    for (std::size_t a = 0; a < parts_.size(); ++a)
      for (std::size_t b = a; b < parts_.size(); ++b) groups.push_back({a, b, degree_of(0.5 * (z[a] + z[b]))});
    return groups;
  }

 private:
  double path_over_point(std::size_t part, std::size_t pulse, std::size_t of, const dvec3& at_rest) const {
    return path_over(look(pulse, of), target_.pose_of_part(parts_[part], time(pulse))(at_rest));
  }

  // Of the phase of a corner against the middle, over half the interval [rad].
  double largest_slope(std::size_t part, std::size_t begin, std::size_t end) const {
    const double half = 0.5 * (time(end - 1) - time(begin)), k = wavenumber(std::ranges::max(c_.sweep.frequencies));
    double largest = 0.0;
    for (std::size_t of = 0; of < looks(); ++of)
      for (const dvec3& corner : corners_of(parts_[part].box)) {
        const auto residual = [&](std::size_t pulse) { return path_over_point(part, pulse, of, corner) - path(part, pulse, of); };
        for (std::size_t pulse = begin; pulse + 1 < end; ++pulse)
          largest = std::max(largest, std::abs(residual(pulse + 1) - residual(pulse)) / (time(pulse + 1) - time(pulse)));
      }
    return k * largest * half;
  }

  const Case& c_;
  const MovingTarget& target_;
  std::vector<MovingTarget::RigidPart> parts_;
};

std::size_t coefficients_of(const std::vector<Group>& groups) {
  std::size_t count = 0;
  for (const Group& group : groups) count += group.degree + 1;
  return count;
}

// The pulses nearest to Chebyshev's points, and as many as there are of them.
std::set<std::size_t> near_chebyshev(const Times& times, std::size_t begin, std::size_t end, std::size_t count) {
  std::set<std::size_t> chosen{begin, end - 1};
  const double middle = 0.5 * (times.time(begin) + times.time(end - 1)), half = times.time(end - 1) - middle;
  for (std::size_t i = 0; i < count; ++i) {
    const double wanted = middle - half * std::cos(pi * (static_cast<double>(i) + 0.5) / static_cast<double>(count));
    std::size_t nearest = begin;
    for (std::size_t pulse = begin; pulse < end; ++pulse)
      if (std::abs(times.time(pulse) - wanted) < std::abs(times.time(nearest) - wanted)) nearest = pulse;
    chosen.insert(nearest);
  }
  for (std::size_t pulse = begin; pulse < end && chosen.size() < std::min(count, end - begin); ++pulse) chosen.insert(pulse);
  return chosen;
}

TracedInterval traced(const Times& times, std::size_t begin, std::size_t end, std::size_t coefficients) {
  TracedInterval interval{begin, end, {}, {}};
  const auto count = static_cast<std::size_t>(std::ceil(times_a_coefficient * static_cast<double>(coefficients)));
  const std::size_t checks = 2 + static_cast<std::size_t>(checked_share * static_cast<double>(count));
  if (static_cast<double>(count + checks) > worth * static_cast<double>(end - begin)) {
    interval.fitted.resize(end - begin);
    std::iota(interval.fitted.begin(), interval.fitted.end(), begin);
    return interval;
  }
  const std::set<std::size_t> chosen = near_chebyshev(times, begin, end, count);
  interval.fitted.assign(chosen.begin(), chosen.end());
  // In the middles of the widest gaps, spread over the interval.
  for (std::size_t i = 0; i < checks; ++i) {
    std::size_t pulse = begin + (2 * i + 1) * (end - begin) / (2 * checks);
    while (pulse < end && chosen.contains(pulse)) ++pulse;
    if (pulse < end && (interval.checked.empty() || interval.checked.back() < pulse)) interval.checked.push_back(pulse);
  }
  return interval;
}

void add_intervals(const Times& times, std::size_t begin, std::size_t end, std::vector<TracedInterval>& intervals) {
  const std::size_t coefficients = coefficients_of(times.groups(begin, end));
  if (end - begin > 2 && (coefficients > most_coefficients || end - begin > most_pulses)) {
    const std::size_t middle = begin + (end - begin) / 2;
    add_intervals(times, begin, middle, intervals);
    add_intervals(times, middle, end, intervals);
    return;
  }
  intervals.push_back(traced(times, begin, end, coefficients));
}

using Matrix = Eigen::MatrixXcd;

// The functions of a look and a frequency at some pulses.
Matrix functions(const Times& times, const TracedInterval& interval, const std::vector<Group>& groups, std::size_t look, double k,
                 const std::vector<std::size_t>& pulses) {
  Matrix values(static_cast<Eigen::Index>(pulses.size()), static_cast<Eigen::Index>(coefficients_of(groups)));
  const double first = times.time(interval.begin), last = times.time(interval.end - 1);
  for (std::size_t i = 0; i < pulses.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const double x = std::clamp((2.0 * times.time(pulses[i]) - first - last) / (last - first), -1.0, 1.0);
    Eigen::Index column = 0;
    for (const auto& [a, b, degree] : groups) {
      const double path = 0.5 * (times.path(a, pulses[i], look) + times.path(b, pulses[i], look));
      const double turns = k * path / (2.0 * pi);
      const Complex phase = std::polar(1.0, -2.0 * pi * (turns - std::round(turns)));
      double before = x, polynomial = 1.0;  // T_1 = T_{-1}, T_0
      for (std::size_t n = 0; n <= degree; ++n) {
        values(row, column++) = polynomial * phase;
        before = std::exchange(polynomial, 2.0 * x * polynomial - before);
      }
    }
  }
  return values;
}

std::vector<std::size_t> traced_pulses(const TracedInterval& interval) {
  std::vector<std::size_t> pulses = interval.fitted;
  pulses.insert(pulses.end(), interval.checked.begin(), interval.checked.end());
  std::ranges::sort(pulses);
  return pulses;
}

// Every column of S in a result.
void visit_columns(SweepResult& result, const std::function<void(std::vector<ScatteringMatrix>&)>& visit) {
  visit(result.total);
  for (std::vector<ScatteringMatrix>& column : result.bounces) visit(column);
  for (MechanismRows& mechanism : result.mechanisms)
    if (!mechanism.rows.empty()) visit(mechanism.rows);
}

// Rows of all times, those that were not traced as at the traced time before.
template <class Row>
void spread(const std::vector<std::size_t>& source, std::vector<Row>& rows) {
  if (rows.empty()) return;
  std::vector<Row> all(source.size());
  for (std::size_t i = 0; i < source.size(); ++i) all[i] = rows[source[i]];
  rows = std::move(all);
}

}  // namespace

std::vector<TracedInterval> traced_intervals(const Case& c, const MovingTarget& target) {
  std::vector<TracedInterval> intervals;
  add_intervals(Times(c, target), 0, c.motion->times(), intervals);
  return intervals;
}

Case traced_case(const Case& c, const std::vector<TracedInterval>& intervals) {
  Case some = c;
  const std::size_t looks = c.sweep.looks.size() / c.motion->times();
  some.sweep.looks.clear(), some.sweep.times.clear();
  some.motion->pulses = 0, some.motion->times_s.clear();
  for (const TracedInterval& interval : intervals)
    for (const std::size_t pulse : traced_pulses(interval)) {
      some.motion->times_s.push_back(c.sweep.times[pulse * looks]);
      for (std::size_t look = 0; look < looks; ++look) {
        some.sweep.looks.push_back(c.sweep.looks[pulse * looks + look]);
        some.sweep.times.push_back(some.motion->times_s.back());
      }
    }
  return some;
}

SweepResult with_all_times(const Case& c, const MovingTarget& target, const std::vector<TracedInterval>& intervals,
                           const SweepResult& traced_result) {
  const Times times(c, target);
  const Sweep& sweep = c.sweep;
  const std::size_t frequencies = sweep.frequencies.size(), per_pulse = times.looks() * frequencies;
  std::vector<std::size_t> source(sweep.rows());   // [row] that of the traced time
  std::vector<char> is_traced(c.motion->times());  // [pulse]
  for (std::size_t pulse = 0, slot = 0, interval = 0; pulse < is_traced.size(); ++pulse) {
    if (pulse == intervals[interval].end) ++interval;
    const std::vector<std::size_t> own = traced_pulses(intervals[interval]);
    is_traced[pulse] = std::ranges::binary_search(own, pulse);
    if (is_traced[pulse] && pulse > 0) ++slot;
    for (std::size_t row = 0; row < per_pulse; ++row) source[pulse * per_pulse + row] = slot * per_pulse + row;
  }
  SweepResult all = traced_result;
  visit_columns(all, [&](std::vector<ScatteringMatrix>& rows) { spread(source, rows); });
  spread(source, all.error), spread(source, all.model), spread(source, all.incoherent);
  for (ModelPart& part : all.model_parts) spread(source, part.rows);
  double squares = 0.0, wrong = 0.0;
  std::uint64_t found = 0;
  for (const TracedInterval& interval : intervals) {
    if (interval.fitted.size() == interval.end - interval.begin) continue;
    const std::vector<Group> groups = times.groups(interval.begin, interval.end);
    std::vector<std::size_t> others;
    for (std::size_t pulse = interval.begin; pulse < interval.end; ++pulse)
      if (!std::ranges::binary_search(interval.fitted, pulse)) others.push_back(pulse);
    found += others.size() - interval.checked.size();
    for (std::size_t look = 0; look < times.looks(); ++look)
      for (std::size_t f = 0; f < frequencies; ++f) {
        const auto row_of = [&](std::size_t pulse) { return pulse * per_pulse + look * frequencies + f; };
        const double k = wavenumber(sweep.frequencies[f]);
        Eigen::CompleteOrthogonalDecomposition<Matrix> known(functions(times, interval, groups, look, k, interval.fitted));
        known.setThreshold(least_singular);
        const Matrix unknown = functions(times, interval, groups, look, k, others);
        double checks = 0.0;
        visit_columns(all, [&](std::vector<ScatteringMatrix>& rows) {
          Matrix values(static_cast<Eigen::Index>(interval.fitted.size()), 4);
          for (std::size_t i = 0; i < interval.fitted.size(); ++i)
            for (int channel = 0; channel < 4; ++channel)
              values(static_cast<Eigen::Index>(i), channel) = rows[row_of(interval.fitted[i])].at(channel / 2, channel % 2);
          const Matrix between = unknown * known.solve(values);
          for (std::size_t i = 0; i < others.size(); ++i) {
            ScatteringMatrix s;
            for (int channel = 0; channel < 4; ++channel)
              s.at(channel / 2, channel % 2) = between(static_cast<Eigen::Index>(i), channel);
            ScatteringMatrix& row = rows[row_of(others[i])];
            if (!is_traced[others[i]])
              row = s;
            else if (&rows == &all.total)
              checks += std::norm(frobenius_norm(s - row)), squares += std::norm(frobenius_norm(row));
          }
        });
        wrong += checks;
        const double off = std::sqrt(0.25 * checks / static_cast<double>(interval.checked.size()));
        for (const std::size_t pulse : others)
          if (!is_traced[pulse])
            for (std::array<double, 2>& received : all.error[row_of(pulse)])
              for (double& error : received) error += off;
      }
  }
  if (found > 0)
    all.statistics.skipped.push_back({"times traced",
                                      fmt::format("motion.retrace is \"auto\": S at these is found between those that were; "
                                                  "where it was checked it was off by {:.2g} of S",
                                                  squares > 0.0 ? std::sqrt(wrong / squares) : 0.0),
                                      found});
  return all;
}

}  // namespace raytube
