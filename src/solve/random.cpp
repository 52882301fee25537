#include "solve/random.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/bytes.h"
#include "core/threads.h"
#include "core/work_sharing.h"
#include "plan/phase_reference.h"
#include "sbr/random_tubes.h"
#include "solve/solve.h"
#include "solve/sum_of_paths.h"

namespace raytube {

namespace {

// Between processes.
template <class Archive, class Sums>
void visit_sums(Archive& archive, Sums& sums) {
  archive(sums.scattering), archive(sums.hits), archive(sums.rays), archive(sums.lost_rays), archive(sums.truncated);
}

std::string bytes_of_sums(const RandomSums& sums) {
  ByteWriter writer;
  visit_sums(writer, sums);
  return writer.take();
}

RandomSums sums_of_bytes(const std::string& bytes) {
  RandomSums sums;
  ByteReader reader(bytes);
  visit_sums(reader, sums);
  return sums;
}

constexpr double solution_share = 0.5;  // of the progress; the random runs have the rest

using Amplitudes = std::vector<ScatteringMatrix>;

// S of what random tubes do not replace.
Amplitudes fixed_part(const SweepResult& solution) {
  Amplitudes rows(solution.total.size());
  for (const MechanismRows& part : solution.mechanisms)
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] += part.rows[i];
  return rows;
}

// Of every look of every run; runs vary slowest.
std::size_t draws(const SolvePlan& plan, const RandomOptions& random) {
  return static_cast<std::size_t>(random.runs) * plan.sweep.looks.size();
}

// A look's stream depends on nothing but its index and the run.
RandomSums drawn_one(const SolvePlan& plan, const RandomOptions& random, std::size_t i) {
  const std::size_t looks = plan.sweep.looks.size();
  const std::uint64_t stream = std::uint64_t{i / looks} << 32 | i % looks;
  return random_tubes(plan.target.tracer, plan.sweep.looks[i % looks], plan.sweep.frequencies, plan.tubes,
                      {random.samples, random.seed, stream}, plan.sweep.materials, plan.sweep.radar);
}

std::vector<RandomSums> draw(const SolvePlan& plan, const RandomOptions& random, const std::function<bool(double)>& callback,
                             WorkTeam& team) {
  std::vector<RandomSums> drawn(draws(plan, random));
  const double share = (1.0 - solution_share) / static_cast<double>(drawn.size());
  Progress progress(callback ? [&](double done) { return callback(solution_share + done); } : std::function<bool(double)>());
  TeamMember leader(team, std::vector<bool>(drawn.size()), [&](std::size_t i, const std::string& bytes) {
    drawn[i] = sums_of_bytes(bytes);
    progress.add(share);
  });
  compute_items(team, drawn.size(), plan.threads, [&](std::size_t i) {
    drawn[i] = drawn_one(plan, random, i);
    progress.add(share);
  });
  leader.finish();
  return drawn;
}

// Amplitudes of one run; monostatic ones are made reciprocal as solve() does.
Amplitudes rows_of_run(const SolvePlan& plan, const Amplitudes& fixed, const RandomSums* looks) {
  Amplitudes tubes, rows = fixed;
  for (std::size_t i = 0; i < plan.sweep.looks.size(); ++i)
    tubes.insert(tubes.end(), looks[i].scattering.begin(), looks[i].scattering.end());
  tubes = sum_of_paths(plan, std::move(tubes));
  if (!plan.asked.bistatic) make_reciprocal(tubes);
  for (std::size_t row = 0; row < rows.size(); ++row) rows[row] += tubes[row];
  return rows;
}

double decibels(Complex s) { return 20.0 * std::log10(std::abs(s)); }

struct Moments {
  double mean, deviation;
};

Moments moments(const std::vector<double>& values) {
  const auto count = static_cast<double>(values.size());
  double sum = 0.0, squares = 0.0;
  for (const double value : values) sum += value;
  for (const double value : values) squares += (value - sum / count) * (value - sum / count);
  return {sum / count, std::sqrt(squares / (count - 1.0))};
}

// Adds the statistics of one channel of one row over the runs to the result.
void describe(RandomResult& result, const std::vector<Amplitudes>& runs, std::size_t row, int p, int q) {
  std::vector<double> re, im, levels;
  for (const Amplitudes& run : runs) {
    const Complex s = run[row].at(p, q);
    re.push_back(s.real()), im.push_back(s.imag()), levels.push_back(decibels(s));
  }
  const Moments x = moments(re), y = moments(im), level = moments(levels);
  const double spread = std::hypot(x.deviation, y.deviation);
  result.mean.total[row].at(p, q) = {x.mean, y.mean};
  result.mean.error[row][p][q] = spread / std::sqrt(static_cast<double>(runs.size()));
  result.spread[row][p][q] = {spread, level.deviation, level.mean - decibels(result.deterministic.total[row].at(p, q))};
}

Statistics statistics_of(const SolvePlan& plan, const Statistics& solution, const std::vector<RandomSums>& drawn,
                         const RandomOptions& random) {
  RandomSums sum;
  Statistics s = solution;  // of wedges
  s.truncated = {};
  for (const RandomSums& look : drawn) {
    sum += look;
    add_look(s.truncated, look.truncated);
  }
  s.tubes = random.samples * drawn.size();
  s.rays = sum.rays, s.hits = sum.hits, s.lost_rays = sum.lost_rays;
  s.looks_with_lost_rays = 0, s.first_lost_rays.clear();
  s.sliver_area = 0.0;
  s.skipped = plan.skipped_wedges;
  return s;
}

}  // namespace

void check_random_tubes(const SolvePlan& plan, const RandomOptions& random) {
  if (plan.rays()) throw InputError("edges.method \"utd\" has no tubes to place at random; remove it");
  if (any_solid(plan.sweep.materials))
    throw InputError("random tubes do not go on inside of kind \"solid\"; write kind = \"dielectric\"");
  if (!plan.tell_parts) throw InputError("random tubes take the place of tubes alone: the plan must keep parts");
  if (random.samples < 1) throw InputError("random tubes: a look needs at least 1");
  if (random.runs < 2) throw InputError("random tubes: a spread needs at least 2 runs");
}

RandomResult solve_with_random_tubes(const SolvePlan& plan, const RandomOptions& random,
                                     const std::function<bool(double)>& callback, WorkTeam* team) {
  check_random_tubes(plan, random);
  const auto first_half = [&](double done) { return callback(solution_share * done); };
  RandomResult result{random, {}, solve(plan, callback ? first_half : std::function<bool(double)>(), {}, team), {}, 0.0};

  const auto start = std::chrono::steady_clock::now();
  std::vector<RandomSums> drawn;
  TeamOfOne alone;
  run_on_threads(plan.threads, [&] { drawn = draw(plan, random, callback, team ? *team : alone); });
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;

  const std::size_t looks = plan.sweep.looks.size(), rows = plan.asked.rows();
  const Amplitudes fixed = fixed_part(result.deterministic);
  std::vector<Amplitudes> runs;
  for (std::size_t run = 0; run < static_cast<std::size_t>(random.runs); ++run)
    runs.push_back(rows_of_run(plan, fixed, &drawn[run * looks]));
  result.mean.total.resize(rows), result.mean.error.resize(rows), result.spread.resize(rows);
  result.mean.model = result.deterministic.model, result.mean.model_parts = result.deterministic.model_parts;
  for (std::size_t row = 0; row < rows; ++row)
    for (const int channel : {0, 1, 2, 3}) describe(result, runs, row, channel / 2, channel % 2);
  result.mean.statistics = statistics_of(plan, result.deterministic.statistics, drawn, random);
  result.mean.statistics.solve_s = result.deterministic.statistics.solve_s + elapsed.count();
  result.run_s = elapsed.count() / random.runs;
  return result;
}

void help_with_random_tubes(const SolvePlan& plan, const RandomOptions& random, WorkTeam& team) {
  help_to_solve(plan, team);
  run_on_threads(plan.threads, [&] {
    const std::size_t items = draws(plan, random);
    TeamMember member(team, std::vector<bool>(items), {});
    compute_items(team, items, plan.threads, [&](std::size_t i) { team.give(i, bytes_of_sums(drawn_one(plan, random, i))); });
    member.finish();
  });
}

RandomResult solve_with_random_tubes(const Target& target, const Sweep& sweep, const SolveOptions& options,
                                     const RandomOptions& random) {
  SolveOptions apart = options;
  apart.keep_parts = true;
  return solve_with_random_tubes(SolvePlan(target, sweep, apart), random, options.progress);
}

}  // namespace raytube
