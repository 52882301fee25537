#include "jobs/retrace.h"

#include <tbb/parallel_for.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <set>

namespace raytube {

namespace {

using Matrix = Eigen::MatrixXcd;

// What is weaker than this among functions of one magnitude is left out.
constexpr double least_share = 1e-4;
// So many times as there are functions are traced, and one in so many of them to check. Fewer than a third saved: all are.
constexpr double times_a_function = 1.2, checked_share = 0.1, worth = 2.0 / 3.0;
// The first samples of each way, and the share of functions that hardly any is.
constexpr std::size_t samples_a_way = 16;
constexpr Eigen::Index hardly_any = 16;
// Of an interval, so that linear algebra takes no time to speak of.
constexpr std::size_t most_pulses = 512;
// Of the wavelength: by so much places are sampled beyond a box, as amplitudes change with the direction of the path.
constexpr double beyond_box = 0.25;
// Of the numbers that places are drawn by, at each stop of a way [axis].
constexpr std::array<std::array<std::size_t, 3>, 3> place_bases{{{3, 5, 7}, {11, 13, 17}, {19, 23, 29}}};

// The i-th number of the sequence of van der Corput (1935) in a base that is prime; those in several bases are that of Halton.
double van_der_corput(std::size_t i, std::size_t base) {
  double value = 0.0, digit = 1.0;
  for (++i; i > 0; i /= base) digit /= static_cast<double>(base), value += digit * static_cast<double>(i % base);
  return value;
}

// What a case tells of its times.
class Times {
 public:
  Times(const Case& c, const MovingTarget& target) : c_(c), parts_(target.rigid_parts()) {
    for (std::size_t pulse = 0; pulse < c.times(); ++pulse) {
      std::vector<dvec3> middles;
      for (const MovingTarget::RigidPart& part : parts_) {
        poses_.push_back(target.pose_of_part(part, c.sweep.times[pulse * looks()]));
        middles.push_back(poses_.back()(part.box.middle()));
      }
      for (std::size_t of = 0; of < looks(); ++of) {
        double sum = 0.0;
        for (const dvec3& middle : middles) sum += path_over(look(pulse, of), middle);
        mean_paths_.push_back(sum / static_cast<double>(parts_.size()));
      }
    }
    for (std::size_t a = 0; a < parts_.size(); ++a) {
      ways_.push_back({a});
      for (std::size_t b = a + 1; b < parts_.size(); ++b) {
        ways_.push_back({a, b});
        if (ever_near(a, b)) ways_.insert(ways_.end(), {{a, b, a}, {b, a, b}});
      }
    }
  }

  std::size_t looks() const { return c_.looks_at_a_time(); }  // of a pulse
  std::size_t ways() const { return ways_.size(); }           // from part to part

  // Of the mean path over the middles of all parts, beyond the way over the origin, which S counts from.
  Complex mean_phasor(std::size_t pulse, std::size_t of, double k) const {
    return phasor(k * (path_over(look(pulse, of), dvec3(0.0)) - mean_path(pulse, of)));
  }

  // Of the pulses of an interval [pulse][sample]: phasors of paths over places of the target, less the mean path, at any look and
  // frequency.
  Matrix samples(std::size_t begin, std::size_t end, std::size_t first, std::size_t count) const {
    const auto [lowest, highest] = std::ranges::minmax(c_.sweep.frequencies);
    Matrix values(static_cast<Eigen::Index>(end - begin), static_cast<Eigen::Index>(count));
    for (std::size_t i = 0; i < count; ++i) {
      const std::vector<std::size_t>& way = ways_[(first + i) % ways()];
      const std::size_t draw = (first + i) / ways();
      const auto of = static_cast<std::size_t>(van_der_corput(draw, 31) * static_cast<double>(looks()));
      const double k = wavenumber(std::lerp(lowest, highest, van_der_corput(draw, 2)));
      std::vector<dvec3> at_rest;
      for (std::size_t stop = 0; stop < way.size(); ++stop) at_rest.push_back(place(way[stop], draw, place_bases[stop], k));
      for (std::size_t pulse = begin; pulse < end; ++pulse) {
        dvec3 at = posed(way[0], pulse, at_rest[0]);
        double path = 0.5 * path_over(look(pulse, of), at);
        for (std::size_t stop = 1; stop < way.size(); ++stop) {
          const dvec3 next = posed(way[stop], pulse, at_rest[stop]);
          path += glm::distance(at, next);
          at = next;
        }
        path += 0.5 * path_over(look(pulse, of), at);
        values(static_cast<Eigen::Index>(pulse - begin), static_cast<Eigen::Index>(i)) =
            phasor(k * (mean_path(pulse, of) - path));
      }
    }
    return values;
  }

 private:
  const Look& look(std::size_t pulse, std::size_t of) const { return c_.sweep.looks[pulse * looks() + of]; }

  static Complex phasor(double phase) {
    const double turns = phase / (2.0 * pi);
    return std::polar(1.0, 2.0 * pi * (turns - std::round(turns)));
  }

  dvec3 posed(std::size_t part, std::size_t pulse, const dvec3& at_rest) const {
    return poses_[pulse * parts_.size() + part](at_rest);
  }

  // Whether at any time the gap between them is narrower than either: else hardly anything gets from one to the other and back.
  bool ever_near(std::size_t a, std::size_t b) const {
    const double narrow = std::min(parts_[a].box.diagonal(), parts_[b].box.diagonal());
    const auto box_of = [&](std::size_t part, std::size_t pulse) {
      Box box;
      for (const dvec3& corner : corners_of(parts_[part].box)) box.add(posed(part, pulse, corner));
      return box;
    };
    for (std::size_t pulse = 0; pulse < c_.times(); ++pulse) {
      const Box box_a = box_of(a, pulse), box_b = box_of(b, pulse);
      if (glm::length(glm::max(dvec3(0.0), glm::max(box_a.low - box_b.high, box_b.low - box_a.high))) < narrow) return true;
    }
    return false;
  }

  // More of them near the sides of its box, whose paths are the shortest and the longest.
  dvec3 place(std::size_t part, std::size_t draw, const std::array<std::size_t, 3>& bases, double k) const {
    const Box& box = parts_[part].box;
    const double beyond = beyond_box * 2.0 * pi / k;
    dvec3 at;
    for (int axis = 0; axis < 3; ++axis) {
      const double share = 0.5 - 0.5 * std::cos(pi * van_der_corput(draw, bases[static_cast<std::size_t>(axis)]));
      at[axis] = std::lerp(box.low[axis] - beyond, box.high[axis] + beyond, share);
    }
    return at;
  }

  double mean_path(std::size_t pulse, std::size_t of) const { return mean_paths_[pulse * looks() + of]; }

  const Case& c_;
  std::vector<MovingTarget::RigidPart> parts_;
  std::vector<Pose> poses_;                     // [pulse][part]
  std::vector<double> mean_paths_;              // [pulse][look], over the middles of all parts [m]
  std::vector<std::vector<std::size_t>> ways_;  // over one part, from one to another, and back
};

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
Matrix basis_of(const Times& times, std::size_t begin, std::size_t end) {
  constexpr std::size_t at_once = 128;
  const auto pulses = static_cast<Eigen::Index>(end - begin);
  const double least = least_share * std::sqrt(static_cast<double>(pulses));
  Matrix basis(pulses, 0);
  for (std::size_t taken = 0, until = samples_a_way * times.ways();; until *= 2) {
    const Eigen::Index before = basis.cols();
    for (; taken < until && traced_share(basis) <= worth; taken += std::min(at_once, until - taken))
      extend(basis, times.samples(begin, end, taken, std::min(at_once, until - taken)), least);
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

TracedInterval traced(const Times& times, std::size_t begin, std::size_t end) {
  TracedInterval interval{begin, end, {}, {}};
  const std::size_t pulses = end - begin;
  const auto all = [&] {
    interval.fitted.resize(pulses);
    std::iota(interval.fitted.begin(), interval.fitted.end(), begin);
    return interval;
  };
  if (static_cast<double>(pulses) * worth < 4.0) return all();
  const Matrix basis = basis_of(times, begin, end);
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
  const Times times(c, target);
  const std::size_t pulses = c.times(), count = (pulses + most_pulses - 1) / most_pulses;
  std::vector<TracedInterval> intervals;
  for (std::size_t i = 0; i < count; ++i) intervals.push_back(traced(times, i * pulses / count, (i + 1) * pulses / count));
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

// The rows at the times of an interval that were not traced, in all columns.
class Between {
 public:
  Between(const Times& times, const TracedInterval& interval, const std::vector<char>& is_traced)
      : times_(times), interval_(interval), is_traced_(is_traced) {
    for (std::size_t pulse = interval.begin; pulse < interval.end; ++pulse)
      if (!std::ranges::binary_search(interval.fitted, pulse)) others_.push_back(pulse);
    const Matrix basis = basis_of(times, interval.begin, interval.end);
    const auto at = [&](const std::vector<std::size_t>& pulses) {
      Matrix rows(static_cast<Eigen::Index>(pulses.size()), basis.cols());
      for (std::size_t i = 0; i < pulses.size(); ++i)
        rows.row(static_cast<Eigen::Index>(i)) = basis.row(static_cast<Eigen::Index>(pulses[i] - interval.begin));
      return rows;
    };
    const auto fitted = static_cast<Eigen::Index>(interval.fitted.size());
    from_fitted_ = at(others_) * Eigen::ColPivHouseholderQR<Matrix>(at(interval.fitted)).solve(Matrix::Identity(fitted, fitted));
  }

  // Those of one look and wavenumber, whose row at a pulse row_of tells.
  Checked find(std::size_t look, double k, const std::function<std::size_t(std::size_t)>& row_of, SweepResult& all) const {
    const auto phasors = [&](const std::vector<std::size_t>& pulses) {
      std::vector<Complex> values;
      for (const std::size_t pulse : pulses) values.push_back(times_.mean_phasor(pulse, look, k));
      return values;
    };
    const std::vector<Complex> at_fitted = phasors(interval_.fitted), at_others = phasors(others_);
    Checked checked;
    visit_columns(all, [&](std::vector<ScatteringMatrix>& rows) {
      Matrix values(static_cast<Eigen::Index>(interval_.fitted.size()), 4);
      for (std::size_t i = 0; i < interval_.fitted.size(); ++i)
        for (int channel = 0; channel < 4; ++channel)
          values(static_cast<Eigen::Index>(i), channel) =
              rows[row_of(interval_.fitted[i])].at(channel / 2, channel % 2) * std::conj(at_fitted[i]);
      const Matrix between = from_fitted_ * values;
      for (std::size_t i = 0; i < others_.size(); ++i) {
        ScatteringMatrix s;
        for (int channel = 0; channel < 4; ++channel)
          s.at(channel / 2, channel % 2) = between(static_cast<Eigen::Index>(i), channel) * at_others[i];
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
  const Times& times_;
  const TracedInterval& interval_;
  const std::vector<char>& is_traced_;  // [pulse]
  std::vector<std::size_t> others_;     // pulses that are not fitted
  Matrix from_fitted_;                  // what those add to it, without their phasors
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
    const Between between(times, interval, is_traced);
    std::vector<Checked> checked(per_pulse);
    tbb::parallel_for(std::size_t{0}, per_pulse, [&](std::size_t i) {
      const double k = wavenumber(sweep.frequencies[i % frequencies]);
      checked[i] = between.find(
          i / frequencies, k, [&](std::size_t pulse) { return pulse * per_pulse + i; }, all);
    });
    for (const Checked& each : checked) sum.squares += each.squares, sum.wrong += each.wrong;
  }
  put({"times_traced", {}, pulses.size()}, all.statistics.counts);
  if (const std::size_t found = is_traced.size() - pulses.size(); found > 0)
    all.statistics.skipped.push_back({"times",
                                      "motion.retrace is \"auto\": S at these is found between those that were; where it was "
                                      "checked it was off by {:.2g} of S",
                                      found, std::sqrt(sum.wrong / std::max(sum.squares, std::numeric_limits<double>::min()))});
  return all;
}

}  // namespace raytube
