#include "bodies.h"

#include "case/target.h"
#include "timing.h"

namespace raytube::bench {

Sweep looks_from(std::vector<double> frequencies, std::initializer_list<std::pair<double, double>> degrees) {
  Sweep sweep{std::move(frequencies), {}, false};
  for (const auto& [theta, phi] : degrees) {
    const Direction look{theta * degree, phi * degree};
    sweep.looks.push_back({look, look});
  }
  return sweep;
}

Sweep dihedral_looks(std::vector<double> frequencies) {
  return looks_from(std::move(frequencies), {{90, 20.3}, {90, 31.7}, {90, 47.3}, {90, 69.1}});
}

Sweep looks_round(double frequency, int count) {
  Sweep sweep{{frequency}, {}, false};
  for (int i = 0; i < count; ++i) {
    const Direction look{(72.0 + 9.7 * std::sin(2.4 * i)) * degree, (11.3 + 360.0 * i / count) * degree};
    sweep.looks.push_back({look, look});
  }
  return sweep;
}

Case repository_case(const std::string& file, const std::string& mode) {
  return read_case(std::filesystem::path(RAYTUBE_SOURCE_DIR) / file, {"tubes.mode=\"" + mode + "\""});
}

LoadedMesh repository_mesh(const std::string& case_file) {
  const Case c = repository_case(case_file, "uniform");
  return load_target(c);
}

SolveOptions uniform(double per_wavelength, int threads) {
  SolveOptions options;
  options.tubes.mode = TubeMode::uniform;
  options.tubes.per_wavelength = per_wavelength;
  options.tubes.skip = false;  // every ray counts here
  options.edges.method = EdgeMethod::none;
  options.threads = threads;
  return options;
}

SolveOptions adaptive(double tolerance_db, int threads, bool curved, double most_per_wavelength) {
  SolveOptions options = uniform(10.0, threads);
  options.tubes.mode = TubeMode::adaptive;
  options.tubes.max_per_wavelength = most_per_wavelength;
  options.tubes.curved = curved ? CurvedSurfaces::always : CurvedSurfaces::never;
  options.tubes.tolerance_db = tolerance_db;
  return options;
}

Outcome solved(const Body& body, const Sweep& sweep, const SolveOptions& options) {
  SweepResult result = solve(body.target, sweep, options);
  return {std::move(result.total), result.statistics.rays, result.statistics.solve_s};
}

std::vector<std::vector<Outcome>> in_turn(const std::vector<Run>& runs, int repeats) {
  std::vector<std::vector<Outcome>> outcomes(runs.size());
  for (int repeat = 0; repeat < repeats; ++repeat)
    for (std::size_t i = 0; i < runs.size(); ++i) outcomes[i].push_back(runs[i](repeat));
  return outcomes;
}

double median_seconds(const std::vector<Outcome>& outcomes) {
  std::vector<double> seconds;
  for (const Outcome& outcome : outcomes) seconds.push_back(outcome.seconds);
  return median(seconds);
}

}  // namespace raytube::bench
