// A case by the Monte Carlo baseline, several times over, beside the solver's tubes; cases/stochastic says what comes out.
//   monte_carlo CASE.toml [--set KEY=VALUE] [--samples N] [--seed S] [--repeat R] [--threads N] [-o FOLDER]
// Writes rcs.csv, the mean of the runs, and random.csv. Flat facets of perfect conductors, far antennas, no ground.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <exception>
#include <filesystem>

#include "case/read_case.h"
#include "case/target.h"
#include "core/decimal.h"
#include "core/error.h"
#include "core/threads.h"
#include "jobs/solvable.h"
#include "monte_carlo.h"
#include "output/files/files.h"
#include "output/tables/csv.h"
#include "solve/solve.h"

namespace {

using namespace raytube;
using bench::Draws;
using bench::Runs;
using bench::Spread;

constexpr const char* columns =
    "# mean: of the runs. det: the tubes of the solver. spread: standard deviation of one run, root of sum |S - mean|^2 / (runs "
    "- 1) "
    "[m].\n# error: standard error of the mean, spread / root of runs [m]. bias: mean - det [m]. spread_db: standard deviation "
    "of the "
    "runs' levels.\n# bias_db: mean of their levels - level of det. nan or inf: a zero.\n"
    "freq_hz,theta_deg,phi_deg,rx_theta_deg,rx_phi_deg,channel,re_mean,im_mean,re_det,im_det,spread_m,error_m,re_bias,im_bias,"
    "sigma_mean_dbsm,sigma_det_dbsm,spread_db,bias_db\n";

struct Asked {
  std::string file;
  std::vector<std::string> overrides;
  Draws draws;
  int threads = all_threads();
  std::filesystem::path output = "monte_carlo";  // never over the results of a run
};

/// What both came to, row by row; times of one run and of the solver [s].
struct Found {
  Runs runs;
  std::vector<ScatteringMatrix> tubes;
  SweepResult mean;
  double run_s = 0.0, tubes_s = 0.0;
};

void require_plain(const Case& c, const SolvePlan& plan) {
  if (!c.sweep.materials.empty() || c.ground || plan.rays() || !c.sweep.looks.front().far())
    throw InputError(
        c.file.string() +
        ": this baseline knows perfect conductors in free space and far antennas alone; remove [materials], [ground], "
        "[radar] and edges.method = \"utd\"");
}

Found found_of(const Case& c, const SolvePlan& plan, const Draws& draws) {
  Found found;
  const SweepResult solved = solve(plan);
  found.tubes_s = solved.statistics.solve_s;
  found.tubes.resize(c.sweep.rows());
  for (const std::vector<ScatteringMatrix>& bounce : solved.bounces)
    for (std::size_t row = 0; row < bounce.size(); ++row) found.tubes[row] += bounce[row];
  const auto start = std::chrono::steady_clock::now();
  found.runs = bench::drawn_runs(plan.target.tracer, c.sweep, plan.tubes.max_bounces, draws);
  found.run_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / draws.runs;
  found.mean.total.resize(c.sweep.rows()), found.mean.error.resize(c.sweep.rows()), found.mean.model.resize(c.sweep.rows());
  for (std::size_t row = 0; row < c.sweep.rows(); ++row)
    for (const int channel : {0, 1, 2, 3}) {
      const Spread spread = bench::spread_of(found.runs, row, channel / 2, channel % 2);
      found.mean.total[row].at(channel / 2, channel % 2) = spread.mean;
      found.mean.error[row][channel / 2][channel % 2] = spread.error;
    }
  return found;
}

// Mean and standard deviation of the runs' levels [dB].
std::pair<double, double> levels_of(const Runs& runs, std::size_t row, int p, int q) {
  const auto count = static_cast<double>(runs.size());
  double mean = 0.0, squares = 0.0;
  for (const auto& run : runs) mean += sigma_dbsm(run[row].at(p, q)) / count;
  for (const auto& run : runs) squares += std::pow(sigma_dbsm(run[row].at(p, q)) - mean, 2);
  return {mean, std::sqrt(squares / (count - 1.0))};
}

std::string line_of(const Sweep& sweep, const Found& found, std::size_t row, int channel) {
  const int p = channel / 2, q = channel % 2;
  const Spread spread = bench::spread_of(found.runs, row, p, q);
  const auto [level, level_spread] = levels_of(found.runs, row, p, q);
  const Complex tubes = found.tubes[row].at(p, q), bias = spread.mean - tubes;
  const std::size_t frequencies = sweep.frequencies.size();
  std::string text = key_text(number_text(sweep.frequencies[row % frequencies]), sweep.looks[row / frequencies]) + ',' +
                     channel_names[static_cast<std::size_t>(channel)];
  for (const double value :
       {spread.mean.real(), spread.mean.imag(), tubes.real(), tubes.imag(), spread.deviation, spread.error, bias.real(),
        bias.imag(), sigma_dbsm(spread.mean), sigma_dbsm(tubes), level_spread, level - sigma_dbsm(tubes)})
    text += ',' + number_text(value);
  return text + '\n';
}

void write(const std::filesystem::path& folder, const Sweep& sweep, const Found& found, const std::string& note) {
  std::filesystem::create_directories(folder);
  write_rcs_csv(folder / "rcs.csv", sweep, found.mean, note);
  OutputFile out(folder / "random.csv");
  out.write(note + fmt::format("# run_s = {:.6g}: seconds of one run\n", found.run_s) + columns);
  for (std::size_t row = 0; row < sweep.rows(); ++row)
    for (const int channel : {0, 1, 2, 3}) out.write(line_of(sweep, found, row, channel));
  out.commit();
}

// Of all rows and channels, as roots of sums of squares, relative to the tubes.
void print(const Found& found, const Draws& draws) {
  double signal = 0.0, spread = 0.0, bias = 0.0;
  for (std::size_t row = 0; row < found.tubes.size(); ++row) {
    signal += std::pow(frobenius_norm(found.tubes[row]), 2);
    bias += std::pow(frobenius_norm(found.mean.total[row] - found.tubes[row]), 2);
    for (const int channel : {0, 1, 2, 3})
      spread += std::pow(bench::spread_of(found.runs, row, channel / 2, channel % 2).deviation, 2);
  }
  fmt::print(
      "draws       {} runs of {} rays a look, seed {}\ntime        {:.3g} s a run; {:.3g} s for the tubes\n"
      "spread      {:.3g} of S in a single run\nbias        {:.3g} of S ({:.3g} by chance alone)\n",
      draws.runs, draws.samples, draws.seed, found.run_s, found.tubes_s, std::sqrt(spread / signal), std::sqrt(bias / signal),
      std::sqrt(spread / signal / draws.runs));
}

void run(const Asked& asked) {
  const Case c = read_case(asked.file, asked.overrides);
  const Target target(load_target(c).mesh, c.wedges);
  const SolvePlan plan = plan_of_case(target, c, asked.threads, true);
  require_plain(c, plan);
  Found found;
  run_on_threads(asked.threads, [&] { found = found_of(c, plan, asked.draws); });
  write(asked.output, c.sweep, found,
        fmt::format("# S is the mean of {} Monte Carlo runs of {} rays a look (Philox4x32-10, seed {}); err_pq_db stands for its "
                    "standard error\n",
                    asked.draws.runs, asked.draws.samples, asked.draws.seed));
  print(found, asked.draws);
}

}  // namespace

int main(int argc, char** argv) {
  Asked asked;
  CLI::App app("A case by random rays, several times over, beside the tubes of the solver", "monte_carlo");
  app.add_option("case", asked.file, "Case file (TOML)")->required();
  app.add_option("--set", asked.overrides, "KEY=VALUE, in the place of what the case has")->allow_extra_args(false);
  app.add_option("--samples", asked.draws.samples, "Rays a look and run; default 100000")->check(CLI::Range(1, 1000000000));
  app.add_option("--seed", asked.draws.seed, "Seed of the random numbers; default 1");
  app.add_option("--repeat", asked.draws.runs, "Independent runs, which give the spread; default 10")
      ->check(CLI::Range(2, 1000000));
  app.add_option("--threads", asked.threads, "Default: all processors")->check(CLI::Range(1, 10000));
  app.add_option("-o", asked.output, "Folder for rcs.csv and random.csv; default monte_carlo");
  CLI11_PARSE(app, argc, argv);
  try {
    run(asked);
  } catch (const std::exception& error) {
    fmt::print(stderr, "monte_carlo: {}\n", error.what());
    return 2;
  }
}
