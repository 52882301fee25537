#include "jobs/retrace.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <set>

namespace raytube {

namespace {

// Coefficients beyond this are left out, and what functions have in common to this is one function.
constexpr double least_coefficient = 1e-5;
// So many times as there are functions are traced, and one in so many of them to check. Fewer than a third saved: all are.
constexpr double times_a_function = 1.3, checked_share = 0.1, worth = 2.0 / 3.0;
// Of an interval, so that least squares take no time to speak of.
constexpr std::size_t most_coefficients = 160, most_pulses = 512;

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

  std::size_t looks() const { return c_.looks_at_a_time(); }  // of a pulse
  const Look& look(std::size_t pulse, std::size_t look) const { return c_.sweep.looks[pulse * looks() + look]; }
  double time(std::size_t pulse) const { return c_.sweep.times[pulse * looks()]; }

  // Over the middle of a part, or over those of two of them, one after the other [m].
  double path(std::size_t a, std::size_t b, std::size_t pulse, std::size_t of) const {
    if (a == b) return path_over_point(a, pulse, of, parts_[a].box.middle());
    return 0.5 * (path(a, a, pulse, of) + path(b, b, pulse, of)) + glm::distance(middle(a, pulse), middle(b, pulse));
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
  dvec3 middle(std::size_t part, std::size_t pulse) const {
    return target_.pose_of_part(parts_[part], time(pulse))(parts_[part].box.middle());
  }

  // Beyond the way over the origin, which S counts from.
  double path_over_point(std::size_t part, std::size_t pulse, std::size_t of, const dvec3& at_rest) const {
    const Look& seen = look(pulse, of);
    return path_over(seen, target_.pose_of_part(parts_[part], time(pulse))(at_rest)) - path_over(seen, dvec3(0.0));
  }

  // Of the phase of a corner against the middle, over half the interval [rad].
  double largest_slope(std::size_t part, std::size_t begin, std::size_t end) const {
    const double half = 0.5 * (time(end - 1) - time(begin)), k = wavenumber(std::ranges::max(c_.sweep.frequencies));
    double largest = 0.0;
    for (std::size_t of = 0; of < looks(); ++of)
      for (const dvec3& corner : corners_of(parts_[part].box)) {
        const auto residual = [&](std::size_t pulse) {
          return path_over_point(part, pulse, of, corner) - path(part, part, pulse, of);
        };
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

using Matrix = Eigen::MatrixXcd;

// Of the space that the columns span.
Matrix orthonormal(const Matrix& columns) {
  Eigen::ColPivHouseholderQR<Matrix> pivoted(columns);
  pivoted.setThreshold(least_coefficient);
  return pivoted.householderQ() * Matrix::Identity(columns.rows(), pivoted.rank());
}

// An orthonormal basis of the functions of a look and a frequency, at all pulses of an interval.
Matrix basis_of(const Times& times, std::size_t begin, std::size_t end, const std::vector<Group>& groups, std::size_t look,
                double k) {
  Matrix values(static_cast<Eigen::Index>(end - begin), static_cast<Eigen::Index>(coefficients_of(groups)));
  const double first = times.time(begin), last = times.time(end - 1);
  for (std::size_t pulse = begin; pulse < end; ++pulse) {
    const auto row = static_cast<Eigen::Index>(pulse - begin);
    const double x = std::clamp((2.0 * times.time(pulse) - first - last) / (last - first), -1.0, 1.0);
    Eigen::Index column = 0;
    for (const auto& [a, b, degree] : groups) {
      const double turns = k * times.path(a, b, pulse, look) / (2.0 * pi);
      const Complex phase = std::polar(1.0, -2.0 * pi * (turns - std::round(turns)));
      double before = x, polynomial = 1.0;  // T_{-1} = T_1, T_0
      for (std::size_t n = 0; n <= degree; ++n) {
        values(row, column++) = polynomial * phase;
        before = std::exchange(polynomial, 2.0 * x * polynomial - before);
      }
    }
  }
  return orthonormal(values);
}

// The pulses that tell functions apart best: pivots of a QR decomposition (Sommariva and Vianello 2009, approximate Fekete
// points), and some more between them.
std::set<std::size_t> telling_pulses(const Matrix& basis, std::size_t count) {
  const Eigen::ColPivHouseholderQR<Matrix> pivoted(basis.adjoint());
  std::set<std::size_t> chosen;
  for (Eigen::Index i = 0; i < basis.cols(); ++i) chosen.insert(static_cast<std::size_t>(pivoted.colsPermutation().indices()(i)));
  const auto pulses = static_cast<std::size_t>(basis.rows());
  chosen.insert({0, pulses - 1});
  for (std::size_t parts = 1; chosen.size() < std::min(count, pulses); ++parts)
    for (std::size_t i = 0; i < parts && chosen.size() < std::min(count, pulses); ++i)
      chosen.insert((2 * i + 1) * pulses / (2 * parts));
  return chosen;
}

TracedInterval traced(const Times& times, std::size_t begin, std::size_t end, const std::vector<Group>& groups, double k) {
  TracedInterval interval{begin, end, {}, {}};
  const std::size_t pulses = end - begin;
  const auto all = [&] {
    interval.fitted.resize(pulses);
    std::iota(interval.fitted.begin(), interval.fitted.end(), begin);
    return interval;
  };
  if (static_cast<double>(pulses) * worth < 4.0) return all();
  std::set<std::size_t> looks{0, times.looks() / 2, times.looks() - 1};
  Matrix bases(static_cast<Eigen::Index>(pulses), 0);
  for (const std::size_t look : looks) {
    const Matrix basis = basis_of(times, begin, end, groups, look, k);
    bases.conservativeResize(Eigen::NoChange, bases.cols() + basis.cols());
    bases.rightCols(basis.cols()) = basis;
  }
  if (looks.size() > 1) bases = orthonormal(bases);
  const auto count = static_cast<std::size_t>(std::ceil(times_a_function * static_cast<double>(bases.cols()))) + 1;
  const std::size_t checks = 2 + static_cast<std::size_t>(checked_share * static_cast<double>(count));
  if (static_cast<double>(count + checks) > worth * static_cast<double>(pulses)) return all();
  const std::set<std::size_t> chosen = telling_pulses(bases, count);
  for (const std::size_t pulse : chosen) interval.fitted.push_back(begin + pulse);
  for (std::size_t i = 0; i < checks; ++i) {  // spread over the interval
    std::size_t pulse = (2 * i + 1) * pulses / (2 * checks);
    while (pulse < pulses && chosen.contains(pulse)) ++pulse;
    if (pulse < pulses && (interval.checked.empty() || interval.checked.back() < begin + pulse))
      interval.checked.push_back(begin + pulse);
  }
  return interval;
}

void add_intervals(const Times& times, std::size_t begin, std::size_t end, double k, std::vector<TracedInterval>& intervals) {
  const std::vector<Group> groups = times.groups(begin, end);
  if (end - begin > 2 && (coefficients_of(groups) > most_coefficients || end - begin > most_pulses)) {
    const std::size_t middle = begin + (end - begin) / 2;
    add_intervals(times, begin, middle, k, intervals);
    add_intervals(times, middle, end, k, intervals);
    return;
  }
  intervals.push_back(traced(times, begin, end, groups, k));
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
  add_intervals(Times(c, target), 0, c.times(), wavenumber(std::ranges::max(c.sweep.frequencies)), intervals);
  return intervals;
}

Case traced_case(const Case& c, const std::vector<TracedInterval>& intervals) {
  Case some = c;
  const std::size_t looks = c.looks_at_a_time();
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

Case computed_case(const Case& c, const MovingTarget& target) {
  return c.motion->retrace ? c : traced_case(c, traced_intervals(c, target));
}

namespace {

// Squares of S at checked times, and of how far off it would have been there.
struct Checked {
  double squares = 0.0, wrong = 0.0;
};

// The rows of one look and frequency at the times that were not traced, in all columns.
class Between {
 public:
  Between(const TracedInterval& interval, std::vector<std::size_t> others, const std::vector<char>& is_traced)
      : interval_(interval), others_(std::move(others)), is_traced_(is_traced) {}

  const std::vector<std::size_t>& others() const { return others_; }  // pulses that are not fitted

  Checked find(const Matrix& basis, const std::function<std::size_t(std::size_t)>& row_of, SweepResult& all) const {
    const auto at_pulses = [&](const std::vector<std::size_t>& pulses) {
      Matrix rows(static_cast<Eigen::Index>(pulses.size()), basis.cols());
      for (std::size_t i = 0; i < pulses.size(); ++i)
        rows.row(static_cast<Eigen::Index>(i)) = basis.row(static_cast<Eigen::Index>(pulses[i] - interval_.begin));
      return rows;
    };
    const Eigen::ColPivHouseholderQR<Matrix> known(at_pulses(interval_.fitted));
    const Matrix unknown = at_pulses(others_);
    Checked checked;
    visit_columns(all, [&](std::vector<ScatteringMatrix>& rows) {
      Matrix values(static_cast<Eigen::Index>(interval_.fitted.size()), 4);
      for (std::size_t i = 0; i < interval_.fitted.size(); ++i)
        for (int channel = 0; channel < 4; ++channel)
          values(static_cast<Eigen::Index>(i), channel) = rows[row_of(interval_.fitted[i])].at(channel / 2, channel % 2);
      const Matrix between = unknown * known.solve(values);
      for (std::size_t i = 0; i < others_.size(); ++i) {
        ScatteringMatrix s;
        for (int channel = 0; channel < 4; ++channel)
          s.at(channel / 2, channel % 2) = between(static_cast<Eigen::Index>(i), channel);
        ScatteringMatrix& row = rows[row_of(others_[i])];
        if (!is_traced_[others_[i]])
          row = s;
        else if (&rows == &all.total)
          checked.wrong += std::norm(frobenius_norm(s - row)), checked.squares += std::norm(frobenius_norm(row));
      }
    });
    const double off = std::sqrt(0.25 * checked.wrong / static_cast<double>(interval_.checked.size()));
    for (const std::size_t pulse : others_)
      if (!is_traced_[pulse])
        for (std::array<double, 2>& received : all.error[row_of(pulse)])
          for (double& error : received) error += off;
    return checked;
  }

 private:
  const TracedInterval& interval_;
  std::vector<std::size_t> others_;
  const std::vector<char>& is_traced_;  // [pulse]
};

}  // namespace

SweepResult with_all_times(const Case& c, const MovingTarget& target, const std::vector<TracedInterval>& intervals,
                           SweepResult all) {
  const Times times(c, target);
  const Sweep& sweep = c.sweep;
  const std::size_t looks = times.looks(), frequencies = sweep.frequencies.size(), per_pulse = looks * frequencies;
  std::vector<std::size_t> pulses;         // that were traced
  std::vector<char> is_traced(c.times());  // [pulse]
  for (const TracedInterval& interval : intervals)
    for (const std::size_t pulse : traced_pulses(interval)) pulses.push_back(pulse), is_traced[pulse] = 1;
  std::vector<std::size_t> source(sweep.rows());  // [row] that of the traced time before
  for (std::size_t row = 0; row < source.size(); ++row) {
    const auto next = std::ranges::upper_bound(pulses, row / per_pulse);
    source[row] = static_cast<std::size_t>(next - pulses.begin() - 1) * per_pulse + row % per_pulse;
  }
  visit_columns(all, [&](std::vector<ScatteringMatrix>& rows) { spread(source, rows); });
  spread(source, all.error), spread(source, all.model);
  all.incoherent.clear();
  for (ModelPart& part : all.model_parts) spread(source, part.rows);
  for (LostRay& ray : all.statistics.first_lost_rays) ray.look = pulses[ray.look / looks] * looks + ray.look % looks;
  for (BeyondBound& beyond : all.statistics.beyond_bound)
    beyond.worst = pulses[beyond.worst / per_pulse] * per_pulse + beyond.worst % per_pulse;
  Checked sum;
  for (const TracedInterval& interval : intervals) {
    if (interval.fitted.size() == interval.end - interval.begin) continue;
    const std::vector<Group> groups = times.groups(interval.begin, interval.end);
    std::vector<std::size_t> others;
    for (std::size_t pulse = interval.begin; pulse < interval.end; ++pulse)
      if (!std::ranges::binary_search(interval.fitted, pulse)) others.push_back(pulse);
    const Between between(interval, std::move(others), is_traced);
    std::vector<Checked> checked(per_pulse);
    tbb::parallel_for(std::size_t{0}, per_pulse, [&](std::size_t i) {
      const double k = wavenumber(sweep.frequencies[i % frequencies]);
      const Matrix basis = basis_of(times, interval.begin, interval.end, groups, i / frequencies, k);
      checked[i] = between.find(
          basis, [&](std::size_t pulse) { return pulse * per_pulse + i; }, all);
    });
    for (const Checked& each : checked) sum.squares += each.squares, sum.wrong += each.wrong;
  }
  put({"times_traced", {}, pulses.size()}, all.statistics.counts);
  if (const std::size_t found = is_traced.size() - pulses.size(); found > 0)
    all.statistics.skipped.push_back({"times",
                                      fmt::format("motion.retrace is \"auto\": S at these is found between those that were; "
                                                  "where it was checked it was off by {:.2g} of S",
                                                  sum.squares > 0.0 ? std::sqrt(sum.wrong / sum.squares) : 0.0),
                                      found});
  return all;
}

}  // namespace raytube
