#include "bindings/job.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "case/target.h"
#include "core/bytes.h"
#include "core/threads.h"
#include "jobs/check_report.h"
#include "jobs/density_study.h"
#include "jobs/inputs.h"
#include "jobs/memory.h"
#include "jobs/retrace.h"
#include "jobs/shared_work.h"
#include "jobs/solvable.h"
#include "jobs/solve_case.h"
#include "output/files/sha256.h"
#include "output/tables/stored.h"
#include "output/words/summary.h"
#include "solve/image.h"

namespace raytube::python {

namespace {

int threads_of(int threads, const Ranks* ranks = nullptr) {
  if (threads > 0) return threads;
  return ranks ? ranks->threads() : all_threads();
}

// All ranks were asked for the same, of the same target.
void require_same(Ranks& ranks, const Job& job, const std::string& densities) {
  const TriangleMesh& mesh = job.built->target.mesh;
  ByteWriter bytes;
  bytes(mesh.vertices), bytes(mesh.triangles), bytes(mesh.center);
  const std::string same_mesh = fmt::format("{} triangles {}", mesh.triangles.size(), sha256_of(bytes.take()));
  const JournalIdentity own = shared_work(job.asked, {{"densities", densities}, {"mesh", same_mesh}});
  std::string leaders = text_of_work(own);
  ranks.broadcast(leaders);
  require_same_work(work_of_text(leaders), own);
}

bool is_helper(const Ranks* ranks) { return ranks && !ranks->leads(); }

// Whether to go on, as far as this process and those that share its work are concerned.
bool go_on(Watch& watch, Ranks* ranks, double share) { return watch.tell(share) && !(ranks && ranks->team().is_given_up()); }

// The value of `work`. Whom the others have stopped throws why.
template <class Work>
auto beside_others(const Watch& watch, Ranks* ranks, const Work& work) {
  try {
    return work();
  } catch (const Interrupted&) {
    if (ranks && !watch.stop) ranks->team().finish();
    throw;
  }
}

}  // namespace

std::shared_ptr<const Job> Job::of_file(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  Case c = read_case(file, overrides);
  auto [moving, loaded] = load_target_of_plan(c);
  std::vector<std::string> sha256 = sha256_of_meshes(c, loaded.report);
  auto built = std::make_shared<const BuiltTarget>(std::move(loaded.report), Target(std::move(loaded.mesh), c.wedges), moving);
  return std::make_shared<const Job>(std::move(c), std::move(sha256), std::move(built));
}

std::shared_ptr<const Job> Job::of_target(TargetSource& target, const CaseValue& values, const LookNumbers* looks) {
  Case c = case_of_values(values, values.location, looks);
  auto built = target.built_for(c);
  return std::make_shared<const Job>(std::move(c), target.made_of().sha256, std::move(built));
}

std::optional<StoredResult> Job::solve(int threads, bool parts, Watch& watch, Ranks* ranks) const {
  if (ranks) require_same(*ranks, *this, {});
  const int count = threads_of(threads, ranks);
  const auto progress = [&](double share) { return go_on(watch, ranks, share); };
  return beside_others(watch, ranks, [&]() -> std::optional<StoredResult> {
    if (is_helper(ranks)) {
      help_to_solve_case(asked, built->target, count, parts, ranks->team(), progress, built->moving);
      return {};
    }
    const PlannedCase planned(asked, built->target, built->report, built->outermost, count, parts, built->moving);
    Manifest manifest = described_inputs(asked, built->report, mesh_sha256);
    const SweepResult solved = solve_case(planned, manifest, progress, {}, ranks ? &ranks->team() : nullptr);
    StoredResult result = stored(asked.sweep, solved);
    result.attributes = attributes_of(manifest);
    return result;
  });
}

Json Job::check(int threads) const {
  const MovingTarget* const moving = built->moving.get();
  const Case part = case_of_plan(asked, moving);
  const SolvePlan plan = plan_of_case(built->target, part, threads_of(threads), false);
  const std::size_t plans = plans_of(asked, moving);
  Json data = check_data(asked, built->report, plan, moving, plans);
  check_memory(plan, asked);
  data.update(time_data(plan, predicted_time(plan, plans)));
  return data;
}

LookImage Job::image(std::size_t look, double per_wavelength, int threads, Watch& watch) const {
  require_look(asked, look);
  const SolvePlan plan = plan_of_case(built->target, asked, threads_of(threads), false);
  return naming_the_case(asked, [&] { return image_of_look(plan, look, per_wavelength, watch.progress()); });
}

LookCentres Job::centres(const CentresAsked& which, int threads, Watch& watch) const {
  return centres_of_look(built->target, asked, which, threads_of(threads), watch.progress());
}

TubeTrace Job::trace(std::size_t look, const dvec2& at) const {
  const Sweep& sweep = asked.sweep;
  require_look(asked, look);
  const auto highest = static_cast<std::size_t>(std::ranges::max_element(sweep.frequencies) - sweep.frequencies.begin());
  const std::vector<Material> materials = at_frequency(sweep.materials, highest);
  const ReplayScene scene{built->target.tracer, materials, sweep.radar};
  return naming_the_case(asked,
                         [&] { return trace_tube(scene, sweep.looks[look], sweep.frequencies[highest], asked.tubes, at); });
}

std::optional<Study> Job::converge(const std::vector<double>& densities, int threads, Watch& watch, Ranks* ranks) const {
  if (ranks) require_same(*ranks, *this, fmt::format("{}", fmt::join(densities, " ")));
  refuse_study_of_rays(asked);
  const std::vector<double> ordered = densities_from_coarse_to_fine(densities, "densities");
  check_study(asked, built->target, threads, ordered, "densities");
  ConvergenceStudy study{asked.title, asked.sweep, {}, {}};
  std::vector<std::string> warnings;
  const auto keep = [&](SolvedDensity solved) {
    auto& [density, result] = solved;
    const Statistics& s = result.statistics;
    for (const BeyondBound& part : s.beyond_bound)
      warnings.push_back(fmt::format("{} tubes per wavelength: {}", density, beyond_bound_sentence(part)));
    study.results.push_back({density, s.tubes, s.rays, s.solve_s, std::move(result.total)});
  };
  beside_others(watch, ranks, [&] {
    study_densities(
        asked, built->target, threads_of(threads, ranks), ordered, [&](double share) { return go_on(watch, ranks, share); },
        ranks ? &ranks->team() : nullptr, keep);
  });
  if (is_helper(ranks)) return {};
  study.convergence = study_convergence(study.results);
  return Study{convergence_text(study), std::move(study.results), std::move(study.convergence), std::move(warnings)};
}

}  // namespace raytube::python
