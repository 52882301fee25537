#include "jobs/over_ground.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "core/error.h"
#include "jobs/ground_paths.h"
#include "plan/phase_reference.h"

namespace raytube {

namespace {

using Factors = std::array<Complex, 2>;  // of V and H

// Adds up the rows of paths.
class PathSum {
 public:
  PathSum(const Ground& ground, const Sweep& sweep) : sweep_(sweep), paths_(ground_paths(ground)), factors_(sweep.rows()) {
    for (std::size_t look = 0; look < sweep.looks.size(); ++look)
      for (std::size_t f = 0; f < sweep.frequencies.size(); ++f)
        for (const Direction* end : {&sweep.looks[look].transmit, &sweep.looks[look].receive})
          factors_[sweep.row(look, f)].push_back(ground_reflection(ground, *end, f, sweep.frequencies[f]));
  }

  void add_up(std::vector<ScatteringMatrix>& rows) const {
    if (rows.empty()) return;
    std::vector<ScatteringMatrix> sums(sweep_.rows());
    for_each_entry([&](std::size_t row, std::size_t from, int p, int q, Complex factor) {
      sums[row].at(p, q) += factor * rows[from].at(p, q);
    });
    if (!sweep_.bistatic) make_reciprocal(sums);
    rows = std::move(sums);
  }

  void add_up(std::vector<ChannelErrors>& rows) const {
    std::vector<ChannelErrors> sums(sweep_.rows());
    for_each_entry([&](std::size_t row, std::size_t from, int p, int q, Complex factor) {
      sums[row][p][q] += std::abs(factor) * rows[from][p][q];
    });
    rows = std::move(sums);
  }

  /// The row of a path in the sweep asked for, and its look.
  std::size_t row_of(std::size_t row) const {
    const std::size_t frequencies = sweep_.frequencies.size();
    return sweep_.row(look_of(row / frequencies), row % frequencies);
  }
  std::size_t look_of(std::size_t look) const { return look / paths_.size(); }

 private:
  template <class Action>
  void for_each_entry(const Action& action) const {
    for (std::size_t look = 0; look < sweep_.looks.size(); ++look)
      for (std::size_t f = 0; f < sweep_.frequencies.size(); ++f)
        for (std::size_t i = 0; i < paths_.size(); ++i)
          for (int p = 0; p < 2; ++p)
            for (int q = 0; q < 2; ++q)
              action(sweep_.row(look, f), sweep_.row(look * paths_.size() + i, f), p, q,
                     factor(sweep_.row(look, f), paths_[i], p, q));
  }

  Complex factor(std::size_t row, const GroundPath& path, int receive, int transmit) const {
    const std::vector<Factors>& of = factors_[row];
    return (path.lit_by_ground ? of[0][transmit] : 1.0) * (path.seen_by_ground ? of[1][receive] : 1.0);
  }

  const Sweep& sweep_;
  std::span<const GroundPath> paths_;
  std::vector<std::vector<Factors>> factors_;  // [row]: of transmitter and receiver
};

// Of the two co-polar channels together [m^2].
double co_polar_square(const ChannelErrors& e) { return 0.5 * (e[0][0] * e[0][0] + e[1][1] * e[1][1]); }

void count_largest(std::vector<ModelPart>& parts, std::size_t row) {
  const auto square = [row](const ModelPart& part) { return co_polar_square(part.rows[row]); };
  const auto largest = std::ranges::max_element(parts, {}, square);
  if (largest != parts.end() && square(*largest) > 0.0) ++largest->rows_largest;
}

// As of a solve, of rows that have been added up.
void tell_model(SweepResult& result) {
  double all = 0.0;
  result.model.assign(result.total.size(), {});
  for (ModelPart& part : result.model_parts) {
    double sum = 0.0;
    for (std::size_t row = 0; row < part.rows.size(); ++row) {
      sum += co_polar_square(part.rows[row]);
      for (int p = 0; p < 2; ++p)
        for (int q = 0; q < 2; ++q) result.model[row][p][q] += part.rows[row][p][q] * part.rows[row][p][q];
    }
    part.rms = std::sqrt(sum / static_cast<double>(part.rows.size()));
    part.share = sum, part.rows_largest = 0;
    all += sum;
  }
  for (ChannelErrors& row : result.model)
    for (std::array<double, 2>& received : row)
      for (double& error : received) error = std::sqrt(error);
  for (ModelPart& part : result.model_parts) part.share = all > 0.0 ? part.share / all : 0.0;
  for (std::size_t row = 0; row < result.total.size(); ++row) count_largest(result.model_parts, row);
  std::ranges::stable_sort(result.model_parts, std::ranges::greater{}, &ModelPart::share);
}

void tell_looks(const PathSum& sum, const Sweep& sweep, Statistics& s) {
  for (LostRay& ray : s.first_lost_rays) ray.look = sum.look_of(ray.look);
  s.looks_with_lost_rays = std::min<std::uint64_t>(s.looks_with_lost_rays, sweep.looks.size());
  s.windowed_rows = std::min<std::uint64_t>(s.windowed_rows, sweep.rows());
  for (BeyondBound& part : s.beyond_bound) {
    part.worst = sum.row_of(part.worst);
    part.rows = std::min<std::uint64_t>(part.rows, sweep.rows());
  }
}

void drop_parts(SweepResult& result) {
  result.bounces.clear();
  for (std::vector<ScatteringMatrix>& part : result.parts.of) part.clear();
  for (ModelPart& part : result.model_parts) part.rows.clear();
}

}  // namespace

SolvePlan planned(const Target& target, const Case& c, const SolveOptions& options) {
  if (!c.ground) return {target, c.sweep, options};
  SolveOptions with_parts = options;
  with_parts.keep_parts = true;
  return {target, std::make_shared<const Sweep>(sweep_of_paths(c.sweep, *c.ground)), with_parts};
}

SweepResult result_of_case(const Case& c, SweepResult solved, bool keep_parts) {
  if (!c.ground) return solved;
  const PathSum sum(*c.ground, c.sweep);
  sum.add_up(solved.total);
  for (std::vector<ScatteringMatrix>& bounce : solved.bounces) sum.add_up(bounce);
  for (std::vector<ScatteringMatrix>& part : solved.parts.of) sum.add_up(part);
  sum.add_up(solved.error);
  for (ModelPart& part : solved.model_parts) sum.add_up(part.rows);
  tell_model(solved);
  tell_looks(sum, c.sweep, solved.statistics);
  solved.incoherent.clear();
  if (!c.ground->perfect())
    solved.statistics.skipped.push_back({"multiple reflection between target and ground",
                                         "the ground is no perfect conductor: four paths of the target alone are added up",
                                         c.sweep.looks.size()});
  if (!keep_parts) drop_parts(solved);
  return solved;
}

void refuse_ground(const Case& c, const std::string& what) {
  if (c.ground)
    throw InputError(fmt::format("{}: {} over ground are not in this version; remove [ground]", c.file.string(), what));
}

}  // namespace raytube
