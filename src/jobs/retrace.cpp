#include "jobs/retrace.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <set>

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
// Of the wavelength: by so much places are sampled beyond a box, as amplitudes change with the direction of the path.
constexpr double beyond_box = 0.25;

// Numbers from 0 to 1 that fill a cube evenly as i goes on: multiples of the roots of primes without their integers (Weyl 1916,
// Math. Annalen 77, 313), one after the other.
class Draws {
 public:
  explicit Draws(std::size_t i) : i_(static_cast<double>(i + 1)) {}

  double next() {
    constexpr std::array primes{2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53, 59, 61, 67, 71};
    const double multiple = i_ * std::sqrt(primes.at(taken_++));
    return multiple - std::floor(multiple);
  }

 private:
  double i_;
  std::size_t taken_ = 0;
};

// What a case tells of its times.
class Times {
 public:
  Times(const Case& c, const MovingTarget& target) : c_(c), parts_(target.rigid_parts()) {
    for (std::size_t pulse = 0; pulse < c.times(); ++pulse) {
      std::vector<dvec3> middles;
      for (const MovingTarget::RigidPart& part : parts_) {
        const Pose pose = target.pose_of_part(part, c.sweep.times[pulse * looks()]);
        Box box;
        for (const dvec3& corner : corners_of(part.box)) box.add(pose(corner));
        poses_.push_back(pose), boxes_.push_back(box), middles.push_back(pose(part.box.middle()));
      }
      for (std::size_t of = 0; of < looks(); ++of) {
        ends_.emplace_back(c.sweep.looks[pulse * looks() + of]);
        double sum = 0.0;
        for (const dvec3& middle : middles) sum += ends_.back().way_to(middle) + ends_.back().way_from(middle);
        mean_paths_.push_back(sum / static_cast<double>(parts_.size()));
      }
    }
    find_ways();
  }

  std::size_t looks() const { return c_.looks_at_a_time(); }    // of a pulse
  std::size_t kinds() const { return ways_.size() * looks(); }  // of samples: a way from part to part at a look

  // Of the mean path over the middles of all parts, beyond the way over the origin, which S counts from.
  Complex mean_phasor(std::size_t pulse, std::size_t of, double k) const {
    const Ends& ends = ends_[pulse * looks() + of];
    return phasor(k * (ends.way_to(dvec3(0.0)) + ends.way_from(dvec3(0.0)) - mean_path(pulse, of)));
  }

  // Of the pulses of an interval [pulse][sample]: phasors of paths over places of the target, less the mean path, at every look
  // and any frequency, over ground by way of it or not, times what polarisation makes of them. Columns have one length.
  Matrix samples(std::size_t begin, std::size_t end, std::size_t first, std::size_t count) const {
    Matrix values(static_cast<Eigen::Index>(end - begin), static_cast<Eigen::Index>(count));
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      const Sample sample = drawn(first + i);
      auto column = values.col(static_cast<Eigen::Index>(i));
      for (std::size_t pulse = begin; pulse < end; ++pulse)
        column(static_cast<Eigen::Index>(pulse - begin)) =
            polarisation(sample, pulse) * phasor(sample.k * (mean_path(pulse, sample.look) - path(sample, pulse)));
      if (const double length = column.norm(); length > 0.0) column *= std::sqrt(static_cast<double>(end - begin)) / length;
    });
    return values;
  }

 private:
  // Where antennas are, or the directions to them.
  struct Ends {
    explicit Ends(const Look& look)
        : far(look.far()),
          transmit_basis(spherical_basis(look.transmit)),
          receive_basis(spherical_basis(look.receive)),
          transmit(far ? transmit_basis.radial : look.transmitter().point()),
          receive(far ? receive_basis.radial : look.receiver().point()) {}

    double way_to(const dvec3& place) const { return far ? -glm::dot(transmit, place) : glm::distance(transmit, place); }
    double way_from(const dvec3& place) const { return far ? -glm::dot(receive, place) : glm::distance(place, receive); }

    bool far;
    SphericalBasis transmit_basis, receive_basis;
    dvec3 transmit, receive;
  };

  struct Stop {
    std::size_t part;
    dvec3 at_rest;
    bool by_ground;  // on the way to it
  };
  struct Sample {
    std::size_t look;
    double k;
    std::vector<Stop> stops;
    bool leaves_by_ground;
    std::array<double, 2> channel;     // angles of the fields from V to H: of the transmitter's, and of the receiver's
    std::array<dvec3, 2> on_the_body;  // along which the first part takes the field up, and the last one gives it
  };

  // Over one part, from one to another, and back; from one place to another of one part where that is not as over a place
  // between: by way of a ground, and where transmitter and receiver are apart.
  void find_ways() {
    for (std::size_t a = 0; a < parts_.size(); ++a) {
      ways_.push_back({a});
      if (c_.ground || c_.sweep.bistatic) ways_.push_back({a, a});
      for (std::size_t b = a + 1; b < parts_.size(); ++b) {
        ways_.push_back({a, b});
        if (c_.sweep.bistatic) ways_.push_back({b, a});
        if (c_.tubes.max_bounces > 2 && ever_near(a, b)) ways_.insert(ways_.end(), {{a, b, a}, {b, a, b}});
      }
    }
  }

  // Whether at any time they are within the distance to which the smaller one, flat and of the diagonal D, sends a beam no wider
  // than itself, D^2 / wavelength: else little gets from one to the other and back.
  bool ever_near(std::size_t a, std::size_t b) const {
    const double narrow = std::min(parts_[a].box.diagonal(), parts_[b].box.diagonal()),
                 reach = narrow * narrow / wavelength(std::ranges::max(c_.sweep.frequencies));
    for (std::size_t first = 0; first < boxes_.size(); first += parts_.size()) {
      const Box &at_a = boxes_[first + a], &at_b = boxes_[first + b];
      if (glm::length(glm::max(dvec3(0.0), glm::max(at_a.low - at_b.high, at_b.low - at_a.high))) < reach) return true;
    }
    return false;
  }

  Sample drawn(std::size_t i) const {
    const auto [lowest, highest] = std::ranges::minmax(c_.sweep.frequencies);
    Draws draws(i / kinds());
    const auto by_ground = [&] { return c_.ground && draws.next() < 0.5; };
    const auto direction = [&] {
      const double z = 2.0 * draws.next() - 1.0, azimuth = 2.0 * pi * draws.next(), across = std::sqrt(1.0 - z * z);
      return dvec3(across * std::cos(azimuth), across * std::sin(azimuth), z);
    };
    Sample sample{.look = i / ways_.size() % looks(),
                  .k = wavenumber(std::lerp(lowest, highest, draws.next())),
                  .stops = {},
                  .leaves_by_ground = by_ground(),
                  .channel = {pi * draws.next(), pi * draws.next()},
                  .on_the_body = {direction(), direction()}};
    for (const std::size_t part : ways_[i % ways_.size()]) {
      const bool mirrored = by_ground();
      sample.stops.push_back({part, place(parts_[part].box, draws, sample.k), mirrored});
    }
    return sample;
  }

  // More of them near the sides of the box, whose paths are the shortest and the longest.
  static dvec3 place(const Box& box, Draws& draws, double k) {
    const double beyond = beyond_box * 2.0 * pi / k;
    dvec3 at;
    for (int axis = 0; axis < 3; ++axis)
      at[axis] = std::lerp(box.low[axis] - beyond, box.high[axis] + beyond, 0.5 - 0.5 * std::cos(pi * draws.next()));
    return at;
  }

  double path(const Sample& sample, std::size_t pulse) const {
    const Ends& ends = ends_[pulse * looks() + sample.look];
    const auto mirrored = [&](const dvec3& r, bool by_ground) {
      return by_ground ? dvec3(r.x, r.y, 2.0 * c_.ground->height - r.z) : r;
    };
    double way = 0.0;
    dvec3 at{0.0};
    for (const Stop& stop : sample.stops) {
      const dvec3 next = poses_[pulse * parts_.size() + stop.part](stop.at_rest), seen = mirrored(next, stop.by_ground);
      way += &stop == &sample.stops.front() ? ends.way_to(seen) : glm::distance(at, seen);
      at = next;
    }
    return way + ends.way_from(mirrored(at, sample.leaves_by_ground));
  }

  // Amplitudes are linear in the fields of transmitter and receiver as the body sees them, which turn with it.
  double polarisation(const Sample& sample, std::size_t pulse) const {
    const Ends& ends = ends_[pulse * looks() + sample.look];
    const auto turned = [&](const Stop& stop, const SphericalBasis& basis, std::size_t end) {
      const double angle = sample.channel[end];
      return glm::dot(std::cos(angle) * basis.theta_hat + std::sin(angle) * basis.phi_hat,
                      poses_[pulse * parts_.size() + stop.part].turn * sample.on_the_body[end]);
    };
    return turned(sample.stops.front(), ends.transmit_basis, 0) * turned(sample.stops.back(), ends.receive_basis, 1);
  }

  double mean_path(std::size_t pulse, std::size_t of) const { return mean_paths_[pulse * looks() + of]; }

  static Complex phasor(double phase) {
    const double turns = phase / (2.0 * pi);
    return std::polar(1.0, 2.0 * pi * (turns - std::round(turns)));
  }

  const Case& c_;
  std::vector<MovingTarget::RigidPart> parts_;
  std::vector<Pose> poses_;         // [pulse][part]
  std::vector<Box> boxes_;          // [pulse][part]
  std::vector<Ends> ends_;          // [pulse][look]
  std::vector<double> mean_paths_;  // [pulse][look], over the middles of all parts [m]
  std::vector<std::vector<std::size_t>> ways_;
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
  for (std::size_t taken = 0, until = samples_of_a_kind * times.kinds();; until *= 2) {
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
  std::vector<TracedInterval> intervals(count);
  tbb::parallel_for(std::size_t{0}, count,
                    [&](std::size_t i) { intervals[i] = traced(times, i * pulses / count, (i + 1) * pulses / count); });
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
  double off = 0.0;  // the largest share of S at a look and frequency
  for (const TracedInterval& interval : intervals) {
    if (interval.fitted.size() == interval.end - interval.begin) continue;
    const Between between(times, interval, is_traced);
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
