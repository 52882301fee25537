// Solver time of a case, uniform tubes, beside the time bare rtcIntersect16 takes for the very same rays, in one run on one
// machine.
//   embree_ratio [--threads N] [--repeat N] CASE.toml...
// Prints, per case, the median of N runs of each (taken in turn) and their ratio. No plots, no files.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "bare_embree.h"
#include "case/read_case.h"
#include "case/target.h"
#include "timing.h"

namespace {

using namespace raytube;
using bench::median;

void measure(const std::string& file, int threads, int repeat) {
  const Case c = read_case(file, {"tubes.mode=\"uniform\""});
  const LoadedMesh loaded = load_target(c);
  const Target target(loaded.mesh, c.wedges);
  SolveOptions options;
  options.tubes = c.tubes;
  options.edges.method = EdgeMethod::none;
  options.threads = threads;
  std::vector<double> solver, embree, ratio;
  std::uint64_t rays = 0;
  for (int i = 0; i < repeat; ++i) {
    const SweepResult result = solve(target, c.sweep, options);
    rays = result.statistics.rays;
    solver.push_back(result.statistics.solve_s);
    embree.push_back(bench::bare_embree_time(target, c.sweep, c.tubes).seconds);
    ratio.push_back(solver.back() / embree.back());
  }
  fmt::print("{}: {} rays, solve {:.3f} s, bare rtcIntersect16 {:.3f} s, ratio {:.2f} (medians of {}, {} threads)\n", c.title,
             rays, median(solver), median(embree), median(ratio), repeat, threads);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Solver time against bare Embree on the same rays");
  int threads = 2, repeat = 5;
  std::vector<std::string> cases;
  app.add_option("--threads", threads);
  app.add_option("--repeat", repeat);
  app.add_option("cases", cases)->required();
  CLI11_PARSE(app, argc, argv);
  bench::on_threads(threads, [&] {
    for (const std::string& file : cases) measure(file, threads, repeat);
  });
}
