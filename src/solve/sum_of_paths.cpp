#include "solve/sum_of_paths.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "plan/phase_reference.h"
#include "solve/rows.h"

namespace raytube {

namespace {

// Adds up the rows of paths.
class PathSum {
 public:
  explicit PathSum(const SolvePlan& plan) : asked_(plan.asked), reflections_(plan.reflections()) {
    for (std::size_t look = 0; look < plan.sweep.looks.size(); ++look)
      for (std::size_t f = 0; f < asked_.frequencies.size(); ++f) factors_.push_back(reflections_.factors(look, f));
  }

  template <class Row>
  std::vector<Row> sum(const std::vector<Row>& rows) const {
    if (rows.empty()) return {};
    std::vector<Row> sums(asked_.rows());
    for (std::size_t row = 0; row < rows.size(); ++row) add(factors_[row](rows[row]), sums[row_of(row)]);
    return sums;
  }

  void add_up(std::vector<ScatteringMatrix>& rows) const {
    rows = sum(rows);
    if (!asked_.bistatic) make_reciprocal(rows);
  }
  void add_up(std::vector<ChannelErrors>& rows) const { rows = sum(rows); }

  /// The row of a path in the sweep asked for, and its look.
  std::size_t row_of(std::size_t row) const {
    const std::size_t frequencies = asked_.frequencies.size();
    return asked_.row(look_of(row / frequencies), row % frequencies);
  }
  std::size_t look_of(std::size_t look) const { return reflections_.asked_look(look); }

 private:
  static void add(const ScatteringMatrix& row, ScatteringMatrix& sum) { sum += row; }
  static void add(const ChannelErrors& row, ChannelErrors& sum) { raytube::add(row, sum); }

  const Sweep& asked_;
  GroundReflections reflections_;
  std::vector<PathFactors> factors_;  // [row along paths]
};

void count_largest(std::vector<ModelPart>& parts, std::size_t row) {
  const auto square = [row](const ModelPart& part) { return co_polar_square(part.rows[row]); };
  const auto largest = std::ranges::max_element(parts, {}, square);
  if (largest != parts.end() && square(*largest) > 0.0) ++largest->rows_largest;
}

// As of a solve, of rows that have been added up.
void tell_model(SweepResult& result) {
  std::vector<double> sums;
  for (const ModelPart& part : result.model_parts) {
    double& sum = sums.emplace_back(0.0);
    for (const ChannelErrors& row : part.rows) sum += co_polar_square(row);
  }
  result.model.resize(result.total.size());
  for (ModelPart& part : result.model_parts) part.rows_largest = 0;
  for (std::size_t row = 0; row < result.total.size(); ++row) {
    std::vector<ChannelErrors> errors;
    for (const ModelPart& part : result.model_parts) errors.push_back(part.rows[row]);
    result.model[row] = root_sum_square(errors);
    count_largest(result.model_parts, row);
  }
  tell_shares(sums, result.total.size(), result.model_parts);
}

void tell_looks(const PathSum& sum, const Sweep& sweep, Statistics& s) {
  for (LostRay& ray : s.first_lost_rays) ray.look = sum.look_of(ray.look);
  s.looks_with_lost_rays = std::min<std::uint64_t>(s.looks_with_lost_rays, sweep.looks.size());
  for (Count& count : s.counts)
    if (count.what == "windowed_rows") count.count = std::min<std::uint64_t>(count.count, sweep.rows());
  for (BeyondBound& part : s.beyond_bound) {
    part.worst = sum.row_of(part.worst);
    part.rows = std::min<std::uint64_t>(part.rows, sweep.rows());
  }
}

}  // namespace

SweepResult sum_of_paths(const SolvePlan& plan, SweepResult solved) {
  const PathSum sum(plan);
  sum.add_up(solved.total);
  for (std::vector<ScatteringMatrix>& bounce : solved.bounces) sum.add_up(bounce);
  for (MechanismRows& part : solved.mechanisms) sum.add_up(part.rows);
  sum.add_up(solved.error);
  for (ModelPart& part : solved.model_parts) sum.add_up(part.rows);
  tell_model(solved);
  tell_looks(sum, plan.asked, solved.statistics);
  solved.incoherent.clear();
  if (!plan.ground->perfect())
    solved.statistics.skipped.push_back({"multiple reflection between target and ground",
                                         "the ground is no perfect conductor: four paths of the target alone are added up",
                                         plan.asked.looks.size()});
  if (!plan.tell_parts) drop_parts(solved);
  return solved;
}

std::vector<ScatteringMatrix> sum_of_paths(const SolvePlan& plan, std::vector<ScatteringMatrix> rows) {
  if (plan.ground) PathSum(plan).add_up(rows);
  return rows;
}

}  // namespace raytube
