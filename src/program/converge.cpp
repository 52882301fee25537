// raytube converge: the same case with finer and finer tubes.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <numeric>

#include "case/read_case.h"
#include "case/target.h"
#include "core/csv_reader.h"
#include "core/decimal.h"
#include "core/error.h"
#include "core/text.h"
#include "core/threads.h"
#include "jobs/density_study.h"
#include "output/compare/convergence_report.h"
#include "output/compare/density_results.h"
#include "output/netcdf/netcdf_file.h"
#include "output/tables/stored.h"
#include "program/commands.h"
#include "program/helping.h"
#include "program/python.h"
#include "program/solve_warnings.h"
#include "program/work/interrupt.h"
#include "program/work/progress_bar.h"
#include "program/work/results.h"
#include "ranks/ranks.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;

std::string option_text(const std::string& option) { return fmt::format("--densities {}", quotable(option)); }

std::vector<double> parsed_densities(const std::string& option) {
  std::vector<double> densities;
  for (std::size_t at = 0; at <= option.size();) {
    const std::size_t end = std::min(option.find(',', at), option.size());
    const auto density = parsed_number(option.substr(at, end - at));
    if (!density || !std::isfinite(*density) || *density <= 0.0)
      throw InputError(
          fmt::format("{}: write tubes per wavelength with commas between, for example 4,8,16", option_text(option)));
    densities.push_back(*density);
    at = end + 1;
  }
  return densities_from_coarse_to_fine(std::move(densities), option_text(option));
}

ResultNames names_of_convergence_results(bool with_plot) {
  ResultNames names{{}, {"converge.csv"}};
  if (with_plot) names.pictures = {"converge.png", "converge.svg"};
  return names;
}

// Solves one density after the other and keeps what is finished on disk.
class DensityStudy {
 public:
  DensityStudy(const Case& c, const Request& request, const fs::path& destination, const std::vector<double>& densities)
      : case_(c),
        destination_(destination),
        folder_(destination),
        densities_(densities),
        bar_(request.quiet, fmt::format("solving {} looks at {} densities", c.sweep.looks.size(), densities.size())),
        study_{c.title, c.sweep, {}, {}} {}

  void run(const Target& target, const Request& request) {
    const auto progress = [&](double share) {
      bar_.show(share);
      return !InterruptFlag::raised();
    };
    study_densities(case_, target, request.threads, densities_, progress, team_of(request), [&](SolvedDensity solved) {
      add(std::move(solved));
      write(false);
    });
  }

  /// On disk.
  std::size_t finished() const { return finished_densities_; }
  std::string text() const { return convergence_text(study_); }
  /// Whether any density has rows that must not be used.
  bool unusable() const { return unusable_; }

  const fs::path& folder() const { return folder_.path(); }

  std::string interrupted_sentence() const {
    if (finished() == 0) return Interrupted().what();
    return fmt::format("interrupted; converge.csv in {} holds the {} of {} densities that were finished", destination_.string(),
                       finished(), densities_.size());
  }

  std::optional<std::string> last_words() const {
    if (complete_) return {};
    folder_.abandon();
    return interrupted_sentence();
  }

  /// Puts the study so far in the place of what an earlier one left.
  void write(bool with_plot) {
    folder_.require_there();
    NewResults results(folder());
    write_converge_csv(results.folder() / "converge.csv", study_);
    const std::string trouble = with_plot ? draw_with_python(results.folder(), {"converge.csv"}, case_.file) : "";
    if (with_plot) stop_if_interrupted();
    if (!trouble.empty()) warn(trouble);
    replace_results(results, folder(), names_of_convergence_results(with_plot), names_of_convergence_results(true).pictures, [&] {
      finished_densities_ = study_.results.size();
      complete_ = with_plot || (!case_.plots && finished() == densities_.size());
    });
  }

 private:
  void add(SolvedDensity solved) {
    auto& [density, result] = solved;
    if (warn_of_unusable_rows(result.statistics)) unusable_ = true;
    const Statistics& s = result.statistics;
    study_.results.push_back({density, s.tubes, s.rays, s.solve_s, std::move(result.total)});
    study_.convergence = study_convergence(study_.results);
    bar_.note(note());
  }

  std::string note() const {
    const DensityResult& result = study_.results.back();
    const std::string text =
        fmt::format("{:>8} tubes per wavelength: {:.2f} s", number_text(result.per_wavelength), result.solve_s);
    const std::size_t count = study_.results.size();
    if (count == 1) return text;
    return text + fmt::format(", relative change {:.2g}", study_.convergence.densities[count - 2].relative_change);
  }

  const Case& case_;
  fs::path destination_;  // as it was asked for
  OutputFolder folder_;
  const std::vector<double>& densities_;
  std::atomic<std::size_t> finished_densities_ = 0;
  std::atomic<bool> complete_ = false;
  bool unusable_ = false;
  ProgressBar bar_;
  ConvergenceStudy study_;
};

}  // namespace

void help_to_converge(const Request& request, const Case& c, const Target& target) {
  study_densities(c, target, request.threads, parsed_densities(request.densities), [](double) { return true; }, team_of(request),
                  {});
}

void converge_command(const Request& request) {
  if (!request.studied.empty()) return converge_results(request);
  const std::vector<double> densities = parsed_densities(request.densities);
  const Case c = read_case(request.case_file, request.overrides);
  refuse_study_of_rays(c);
  const fs::path destination = request.output_folder.empty() ? c.file.parent_path() / "out" : request.output_folder;
  check_output(destination, names_of_convergence_results(c.plots), input_files(c));
  std::optional<Target> built;
  LoadedMesh loaded = load_target(c);
  share_work(request, c, loaded.mesh);
  run_on_threads(request.threads, [&] { built.emplace(std::move(loaded.mesh), c.wedges); });
  const Target& target = *built;
  if (!c.image_looks.empty())
    warn(fmt::format("{}: output.image_look has no effect here; use raytube run for images", c.file.string()));
  check_study(c, target, request.threads, densities, option_text(request.densities));
  DensityStudy study(c, request, destination, densities);
  const InterruptFlag interrupt_flag([&study] { return study.last_words(); });
  try {
    study.run(target, request);
    if (request.ranks) request.ranks->end();
    if (c.plots) study.write(true);
    if (!request.quiet) fmt::print("{}results         {}\n", study.text(), study.folder().string());
  } catch (const Interrupted&) {
    throw Interrupted(study.interrupted_sentence());
  }
  if (study.unusable()) throw unusable_rows_in(study.folder());
}

// Of results that are there: netCDF files of one case at several densities.
namespace {

void write_study(const ConvergenceStudy& study, const std::filesystem::path& destination) {
  const OutputFolder folder(destination);
  AllOrNothing ending(folder);
  const InterruptFlag interrupt_flag([&ending] { return ending.last_words(); });
  NewResults results(folder.path());
  write_converge_csv(results.folder() / "converge.csv", study);
  const std::string trouble = draw_with_python(results.folder(), {"converge.csv"}, {});
  stop_if_interrupted();
  if (!trouble.empty()) warn(trouble);
  replace_results(results, folder.path(), names_of_convergence_results(true), {}, [&ending] { ending.complete(); });
}

}  // namespace

void converge_results(const Request& request) {
  const std::filesystem::path destination = request.output_folder.empty()
                                                ? std::filesystem::absolute(request.studied.front()).parent_path() / "out"
                                                : request.output_folder;
  check_output(destination, names_of_convergence_results(true), {});
  std::vector<ResultFile> files;
  for (const std::filesystem::path& file : request.studied) files.push_back({file, read_netcdf(file)});
  const Sweep sweep = sweep_of(files.front().result);
  std::vector<DensityResult> results = density_results(files);
  const Convergence convergence = study_convergence(results);
  const ConvergenceStudy study{attribute_of(files.front().result, "title"), sweep, std::move(results), convergence};
  write_study(study, destination);
  if (!request.quiet) fmt::print("{}results         {}\n", convergence_text(study), destination.string());
}

}  // namespace raytube
