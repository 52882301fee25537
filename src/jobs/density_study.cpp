#include "jobs/density_study.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/decimal.h"
#include "core/error.h"
#include "core/threads.h"
#include "jobs/memory.h"
#include "jobs/solvable.h"
#include "plan/admissible.h"

namespace raytube {

namespace {

constexpr std::size_t most_densities = 100;

void check_finest(double density, const std::string& asked, const Case& c, const TriangleMesh& mesh) {
  const double most = densest_tubes(mesh, c.sweep, c.tubes);
  if (density > most)
    throw InputError(
        fmt::format("{}: {} tubes per wavelength are more than 10^6 along one side of the launch plane; {} would fit, or check "
                    "target.unit and frequency.ghz",
                    asked, number_text(density), rounded_down_text(most)));
}

}  // namespace

std::vector<double> densities_from_coarse_to_fine(std::vector<double> densities, const std::string& asked) {
  if (densities.size() > most_densities)
    throw InputError(
        fmt::format("{}: {} densities are more than the {} allowed; leave some out", asked, densities.size(), most_densities));
  std::ranges::sort(densities);
  if (densities.size() < 3 || std::ranges::adjacent_find(densities) != densities.end())
    throw InputError(fmt::format("{}: at least three different densities are needed; write for example 4,8,16", asked));
  return densities;
}

void refuse_study_of_rays(const Case& c) {
  refuse_motion(c);
  if (c.edges.method == EdgeMethod::utd)
    throw InputError(
        fmt::format("{}: edges.method \"utd\" has no tubes whose density could be studied; remove it", c.file.string()));
}

SolveOptions options_of_study(const Case& c, int threads) {
  TubeOptions tubes = c.tubes;
  tubes.mode = TubeMode::uniform;
  return {tubes, c.edges, c.surfaces, threads > 0 ? threads : all_threads(), false, {}};
}

void check_study(const Case& c, const Target& target, int threads, const std::vector<double>& densities,
                 const std::string& asked) {
  check_antennas(target.mesh, c.sweep);
  check_finest(densities.back(), asked, c, target.mesh);
  SolveOptions finest = options_of_study(c, threads);
  finest.tubes.per_wavelength = densities.back();
  const SolvePlan plan(target, c.sweep, finest, c.ground);
  const double kept = static_cast<double>(densities.size() * c.sweep.rows() * sizeof(ScatteringMatrix));
  Case study = c;
  study.image_looks.clear();
  check_memory(plan, study, kept);
}

void study_densities(const Case& c, const Target& target, int threads, std::span<const double> densities,
                     const std::function<bool(double)>& progress, WorkTeam* team,
                     const std::function<void(SolvedDensity)>& solved) {
  SolveOptions options = options_of_study(c, threads);
  for (std::size_t i = 0; i < densities.size(); ++i) {
    options.tubes.per_wavelength = densities[i];
    const SolvePlan plan(target, c.sweep, options, c.ground);
    const auto of_study = [&](double share) { return progress(finished_share(densities, i, share)); };
    if (team && !team->leads())
      help_to_solve(plan, *team, of_study);
    else
      solved({densities[i], solve(plan, of_study, {}, team)});
  }
}

double finished_share(std::span<const double> densities, std::size_t done, double of_next) {
  double finished = 0.0, whole = 0.0;
  for (std::size_t i = 0; i < densities.size(); ++i) {
    const double work = densities[i] * densities[i];
    whole += work;
    finished += i < done ? work : i == done ? of_next * work : 0.0;
  }
  return finished / whole;
}

}  // namespace raytube
