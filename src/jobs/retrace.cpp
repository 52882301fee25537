#include "jobs/retrace.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <set>

#include "jobs/path_samples.h"
#include "math/dense.h"

namespace raytube {

namespace {

using Matrix = Eigen::MatrixXcd;

// What is weaker than this among functions of one magnitude is left out.
constexpr double least_share = 1e-4;
// So many times as there are functions are traced, and one in so many of them to check. Fewer than a third saved: all are.
constexpr double times_a_function = 1.2, checked_share = 0.1, worth = 2.0 / 3.0;
// The first samples of each kind, and the share of functions that hardly any is.
constexpr std::size_t samples_of_a_kind = 4;
constexpr Eigen::Index hardly_any = 16;
// Of errors at random in both parts the share e^{-4} is beyond this times their root mean square, known from so many of them: a
// share of (1 + c^2 / n)^{-n} is beyond c times it, as squares of both are sums of exponential variables.
double error_of_rms(std::size_t checks) {
  const auto n = static_cast<double>(checks);
  return std::sqrt(n * (std::exp(4.0 / n) - 1.0));
}
// Of an interval, so that linear algebra takes no time to speak of.
constexpr std::size_t most_pulses = 512;
std::size_t checks_of(std::size_t fitted) { return 2 + static_cast<std::size_t>(checked_share * static_cast<double>(fitted)); }

std::size_t fitted_of(const Matrix& basis) {
  return static_cast<std::size_t>(std::ceil(times_a_function * static_cast<double>(basis.cols()))) + 1;
}

double traced_share(const Matrix& basis) {
  const std::size_t fitted = fitted_of(basis);
  return static_cast<double>(fitted + checks_of(fitted)) / static_cast<double>(basis.rows());
}

// What columns add to the space of an orthonormal basis, but for what is shorter than `least`.
void extend(Matrix& basis, Matrix columns, double least) {
  for (int twice = 0; twice < 2; ++twice) {
    columns -= basis * (basis.adjoint() * columns).eval();
    Eigen::Index kept = 0;
    for (Eigen::Index i = 0; i < columns.cols(); ++i)
      if (columns.col(i).norm() > least) columns.col(kept++) = columns.col(i);
    columns.conservativeResize(Eigen::NoChange, kept);
  }
  if (columns.cols() == 0) return;
  Eigen::ColPivHouseholderQR<Matrix> pivoted(columns);
  pivoted.setThreshold(least / pivoted.maxPivot());
  const Eigen::Index before = basis.cols(), rank = pivoted.rank();
  basis.conservativeResize(Eigen::NoChange, before + rank);
  basis.rightCols(rank) = pivoted.householderQ() * Matrix::Identity(basis.rows(), rank);
}

// An orthonormal basis of what S may be at the pulses of an interval, but for the mean phasor; or so many columns that all are
// traced. Samples are taken until as many again add hardly anything.
Matrix basis_of(const PathSamples& samples, std::size_t begin, std::size_t end) {
  constexpr std::size_t at_once = 128;
  const auto pulses = static_cast<Eigen::Index>(end - begin);
  const double least = least_share * std::sqrt(static_cast<double>(pulses));
  Matrix basis(pulses, 0);
  for (std::size_t taken = 0, until = samples_of_a_kind * samples.kinds();; until *= 2) {
    const Eigen::Index before = basis.cols();
    for (; taken < until && traced_share(basis) <= worth; taken += std::min(at_once, until - taken)) {
      const std::size_t count = std::min(at_once, until - taken);
      const std::vector<Complex> columns = samples.columns(begin, end, taken, count);
      extend(basis, Eigen::Map<const Matrix>(columns.data(), pulses, static_cast<Eigen::Index>(count)), least);
    }
    if (basis.cols() - before <= before / hardly_any || traced_share(basis) > worth) return basis;
  }
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

// The pulses that are not fitted.
std::vector<std::size_t> others_of(const TracedInterval& interval) {
  std::vector<std::size_t> others;
  for (std::size_t pulse = interval.begin; pulse < interval.end; ++pulse)
    if (!std::ranges::binary_search(interval.fitted, pulse)) others.push_back(pulse);
  return others;
}

TracedInterval traced(const PathSamples& samples, std::size_t begin, std::size_t end) {
  TracedInterval interval{begin, end, {}, {}, {}};
  const std::size_t pulses = end - begin;
  const auto all = [&] {
    interval.fitted.resize(pulses);
    std::iota(interval.fitted.begin(), interval.fitted.end(), begin);
    return interval;
  };
  if (static_cast<double>(pulses) * worth < 4.0) return all();
  const Matrix basis = basis_of(samples, begin, end);
  if (traced_share(basis) > worth) return all();
  const std::size_t checks = checks_of(fitted_of(basis));
  const std::set<std::size_t> chosen = telling_pulses(basis, fitted_of(basis));
  for (const std::size_t pulse : chosen) interval.fitted.push_back(begin + pulse);
  for (std::size_t i = 0; i < checks; ++i) {  // spread over the interval
    std::size_t pulse = (2 * i + 1) * pulses / (2 * checks);
    while (pulse < pulses && chosen.contains(pulse)) ++pulse;
    if (pulse < pulses && (interval.checked.empty() || interval.checked.back() < begin + pulse))
      interval.checked.push_back(begin + pulse);
  }
  const auto at = [&](const std::vector<std::size_t>& some) {
    Matrix rows(static_cast<Eigen::Index>(some.size()), basis.cols());
    for (std::size_t i = 0; i < some.size(); ++i)
      rows.row(static_cast<Eigen::Index>(i)) = basis.row(static_cast<Eigen::Index>(some[i] - begin));
    return rows;
  };
  const auto fitted = static_cast<Eigen::Index>(interval.fitted.size());
  const Matrix from_fitted =
      at(others_of(interval)) * Eigen::ColPivHouseholderQR<Matrix>(at(interval.fitted)).solve(Matrix::Identity(fitted, fitted));
  interval.from_fitted.assign(from_fitted.data(), from_fitted.data() + from_fitted.size());
  return interval;
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
  const PathSamples samples(c, target);
  const std::size_t pulses = c.times(), count = (pulses + most_pulses - 1) / most_pulses;
  std::vector<TracedInterval> intervals(count);
  tbb::parallel_for(std::size_t{0}, count,
                    [&](std::size_t i) { intervals[i] = traced(samples, i * pulses / count, (i + 1) * pulses / count); });
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

// Squares of S at checked times, and of how far off it would have been there, by channel.
struct Checked {
  ChannelErrors squares{}, wrong{};
};

double sum_of(const ChannelErrors& squares) { return squares[0][0] + squares[0][1] + squares[1][0] + squares[1][1]; }

// The rows at the times of an interval that were not traced, in all columns.
class Between {
 public:
  Between(const PathSamples& samples, const TracedInterval& interval, const std::vector<char>& is_traced)
      : samples_(samples), interval_(interval), is_traced_(is_traced), others_(others_of(interval)) {}

  // Those of one look and wavenumber, whose row at a pulse row_of tells.
  Checked find(std::size_t look, double k, const std::function<std::size_t(std::size_t)>& row_of, SweepResult& all) const {
    const auto phasors = [&](const std::vector<std::size_t>& pulses) {
      std::vector<Complex> values;
      for (const std::size_t pulse : pulses) values.push_back(samples_.mean_phasor(pulse, look, k));
      return values;
    };
    const std::vector<Complex> at_fitted = phasors(interval_.fitted), at_others = phasors(others_);
    const Eigen::Map<const Matrix> from_fitted(interval_.from_fitted.data(), static_cast<Eigen::Index>(others_.size()),
                                               static_cast<Eigen::Index>(interval_.fitted.size()));
    Checked checked;
    visit_columns(all, [&](std::vector<ScatteringMatrix>& rows) {
      Matrix values(static_cast<Eigen::Index>(interval_.fitted.size()), 4);
      for (std::size_t i = 0; i < interval_.fitted.size(); ++i)
        for (int channel = 0; channel < 4; ++channel)
          values(static_cast<Eigen::Index>(i), channel) =
              rows[row_of(interval_.fitted[i])].at(channel / 2, channel % 2) * std::conj(at_fitted[i]);
      const Matrix between = from_fitted * values;
      for (std::size_t i = 0; i < others_.size(); ++i) {
        ScatteringMatrix s;
        for (int channel = 0; channel < 4; ++channel)
          s.at(channel / 2, channel % 2) = between(static_cast<Eigen::Index>(i), channel) * at_others[i];
        ScatteringMatrix& row = rows[row_of(others_[i])];
        if (!is_traced_[others_[i]])
          row = s;
        else if (&rows == &all.total)
          for (int p = 0; p < 2; ++p)
            for (int q = 0; q < 2; ++q)
              checked.wrong[p][q] += std::norm(s.at(p, q) - row.at(p, q)), checked.squares[p][q] += std::norm(row.at(p, q));
      }
    });
    for (const std::size_t pulse : others_)
      if (!is_traced_[pulse])
        for (int p = 0; p < 2; ++p)
          for (int q = 0; q < 2; ++q)
            all.error[row_of(pulse)][p][q] += error_of_rms(interval_.checked.size()) *
                                              std::sqrt(checked.wrong[p][q] / static_cast<double>(interval_.checked.size()));
    return checked;
  }

 private:
  const PathSamples& samples_;
  const TracedInterval& interval_;
  const std::vector<char>& is_traced_;  // [pulse]
  std::vector<std::size_t> others_;     // pulses that are not fitted
};

}  // namespace

SweepResult with_all_times(const Case& c, const MovingTarget& target, const std::vector<TracedInterval>& intervals,
                           SweepResult all) {
  const PathSamples samples(c, target);
  const Sweep& sweep = c.sweep;
  const std::size_t looks = samples.looks(), frequencies = sweep.frequencies.size(), per_pulse = looks * frequencies;
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
  double off = 0.0;  // the largest share of S at a look and frequency
  for (const TracedInterval& interval : intervals) {
    if (interval.fitted.size() == interval.end - interval.begin) continue;
    const Between between(samples, interval, is_traced);
    std::vector<Checked> checked(per_pulse);
    tbb::parallel_for(std::size_t{0}, per_pulse, [&](std::size_t i) {
      const double k = wavenumber(sweep.frequencies[i % frequencies]);
      checked[i] = between.find(
          i / frequencies, k, [&](std::size_t pulse) { return pulse * per_pulse + i; }, all);
    });
    for (const Checked& each : checked)
      if (const double squares = sum_of(each.squares); squares > 0.0)
        off = std::max(off, std::sqrt(sum_of(each.wrong) / squares));
  }
  put({"times_traced", {}, pulses.size()}, all.statistics.counts);
  if (const std::size_t found = is_traced.size() - pulses.size(); found > 0)
    all.statistics.skipped.push_back({times_between,
                                      "motion.retrace is \"auto\": S at these is found between those that were; where it was "
                                      "checked it was off by {:.2g} of S at most, of a look and a frequency",
                                      found, off});
  return all;
}

}  // namespace raytube
