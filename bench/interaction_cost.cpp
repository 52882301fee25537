// Time of waves between surfaces beside that of tubes and edge currents, in one run, everything in turn.
//   interaction_cost CASE.toml [--repeat N] [--threads N]
// Prints medians as ratios to the tubes' time, adaptive and on the uniform grid. No timing is asserted.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "case/read_case.h"
#include "case/target.h"
#include "solve/solve.h"
#include "timing.h"

namespace {

using namespace raytube;
using bench::median;

struct Way {
  const char* name;
  TubeMode mode;
  EdgeMethod method;
  int order;
  bool between;
};

constexpr Way ways[] = {{"adaptive tubes alone", TubeMode::adaptive, EdgeMethod::none, 1, false},
                        {"uniform tubes alone, 10 per wavelength", TubeMode::uniform, EdgeMethod::none, 1, false},
                        {"adaptive tubes and edge currents, order 1", TubeMode::adaptive, EdgeMethod::fringe, 1, false},
                        {"the same and waves between surfaces", TubeMode::adaptive, EdgeMethod::fringe, 1, true},
                        {"adaptive tubes and edge currents, order 2", TubeMode::adaptive, EdgeMethod::fringe, 2, false},
                        {"the same and waves between surfaces", TubeMode::adaptive, EdgeMethod::fringe, 2, true},
                        {"adaptive tubes and edge currents, order 3", TubeMode::adaptive, EdgeMethod::fringe, 3, false},
                        {"the same and waves between surfaces", TubeMode::adaptive, EdgeMethod::fringe, 3, true}};

double solve_time(const Target& target, const Case& c, const Way& way, int threads) {
  SolveOptions options{c.tubes, c.edges, c.surfaces, threads, false, {}};
  options.tubes.mode = way.mode;
  if (way.mode == TubeMode::uniform) options.tubes.per_wavelength = 10.0;
  options.edges.method = way.method;
  options.edges.order = way.order;
  options.edges.interaction = way.between;
  return solve(target, c.sweep, options).statistics.solve_s;
}

}  // namespace

int main(int argc, char** argv) {
  std::string file;
  int repeat = 5, threads = 1;
  CLI::App app{"Time of waves between surfaces beside that of tubes and edge currents"};
  app.add_option("case", file, "case file")->required();
  app.add_option("--repeat", repeat, "runs of which the median is taken");
  app.add_option("--threads", threads, "threads");
  CLI11_PARSE(app, argc, argv);

  const Case c = read_case(file, {});
  const LoadedMesh loaded = load_target(c);
  const Target target(loaded.mesh, c.wedges);
  std::vector<double> times[std::size(ways)];
  for (int run = 0; run < repeat; ++run)
    for (std::size_t i = 0; i < std::size(ways); ++i) times[i].push_back(solve_time(target, c, ways[i], threads));
  for (std::size_t i = 0; i < std::size(ways); ++i)
    fmt::print("{:45} {:8.4f} s {:8.1f} x\n", ways[i].name, median(times[i]), median(times[i]) / median(times[0]));
}
