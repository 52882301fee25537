// Adaptive against uniform tubes on the dihedral, and whole jobs against bare Embree on the uniform grid of the same job.
#include "bare_embree.h"
#include "bodies.h"
#include "case/target.h"
#include "closed_forms.h"
#include "studies.h"
#include "timing.h"

namespace raytube::bench {

namespace {

// ||S - S_ref|| / ||S_ref|| over looks, VV and HH, against both single bounces and the double bounce.
double dihedral_error(const Body& body, double side, const std::vector<ScatteringMatrix>& scattering) {
  const double k = wavenumber(body.sweep.frequencies[0]);
  double difference = 0.0, size = 0.0;
  for (std::size_t i = 0; i < scattering.size(); ++i)
    for (const int channel : {0, 1}) {
      const Complex exact = closed_forms::dihedral(side, side, k, body.sweep.looks[i].transmit.phi, channel == 0 ? -1 : 1);
      difference += std::norm(scattering[i].at(channel, channel) - exact);
      size += std::norm(exact);
    }
  return std::sqrt(difference / size);
}

Json dihedral_rows(const Settings& settings) {
  constexpr double side = 0.15;
  const Body body("dihedral of 150 mm, 94 GHz, 4 looks", repository_mesh("cases/dihedral/case.toml"), dihedral_looks({94e9}));
  Json rows;
  for (const double density : {12.0, 25.0}) {
    if (settings.quick && density > 12.0) break;
    const std::pair<const char*, SolveOptions> modes[] = {{"uniform", uniform(density, settings.threads)},
                                                          {"adaptive", adaptive(0.1, settings.threads)}};
    std::vector<Run> runs;
    for (const auto& [name, options] : modes) runs.push_back([&body, options](int) { return solved(body, body.sweep, options); });
    const std::vector<std::vector<Outcome>> outcomes = in_turn(runs, settings.repeats);
    for (std::size_t i = 0; i < runs.size(); ++i)
      rows.push_back({{"per_wavelength", density},
                      {"mode", modes[i].first},
                      {"rays", outcomes[i][0].rays},
                      {"solve_s", median_seconds(outcomes[i])},
                      {"relative_error", dihedral_error(body, side, outcomes[i][0].scattering)}});
  }
  return rows;
}

double solve_seconds(const Target& target, const Case& job, int threads) {
  SolveOptions options;
  options.tubes = job.tubes;
  options.edges = job.edges;
  options.threads = threads;
  return solve(target, job.sweep, options).statistics.solve_s;
}

Json job_row(const std::string& file, const Settings& settings) {
  const Case tubes = repository_case(file, "adaptive"), grid = repository_case(file, "uniform");
  const LoadedMesh loaded = load_target(grid);
  const Target target(loaded.mesh);
  std::vector<double> adaptive, uniform, bare;
  on_threads(settings.threads, [&] {
    for (int i = 0; i < settings.repeats; ++i) {
      adaptive.push_back(solve_seconds(target, tubes, settings.threads));
      uniform.push_back(solve_seconds(target, grid, settings.threads));
      bare.push_back(bare_embree_time(target, grid.sweep, grid.tubes).seconds);
    }
  });
  return {{"case", file},
          {"looks", grid.sweep.looks.size()},
          {"adaptive_s", median(adaptive)},
          {"uniform_s", median(uniform)},
          {"bare_s", median(bare)}};
}

}  // namespace

Json job_study(const Settings& settings) {
  Json json = {{"dihedral", dihedral_rows(settings)}, {"jobs", Json::array()}};
  std::vector<std::string> files{"cases/trihedral/case.toml"};
  if (!settings.quick) files = {"cases/plate/case.toml", "bench/dihedral.toml", "cases/sphere/case.toml"};
  for (const std::string& file : files) json["jobs"].push_back(job_row(file, settings));
  return json;
}

}  // namespace raytube::bench
