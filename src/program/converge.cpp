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
#include "output/compare/convergence_report.h"
#include "output/plots/convergence_plot.h"
#include "program/commands.h"
#include "program/interrupt.h"
#include "jobs/memory.h"
#include "program/progress_bar.h"
#include "program/results.h"
#include "program/unusable_rows.h"
#include "solve/admissible.h"
#include "solve/solve.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_densities = 100;

std::vector<double> parsed_densities(const std::string& option) {
  std::vector<double> densities;
  for (std::size_t at = 0; at <= option.size();) {
    const std::size_t end = std::min(option.find(',', at), option.size());
    const auto density = parsed_number(option.substr(at, end - at));
    if (!density || !std::isfinite(*density) || *density <= 0.0)
      throw InputError(
          fmt::format("--densities {}: write tubes per wavelength with commas between, for example 4,8,16", quotable(option)));
    densities.push_back(*density);
    at = end + 1;
  }
  if (densities.size() > most_densities)
    throw InputError(fmt::format("--densities: {} are more than {}; leave some out", densities.size(), most_densities));
  std::ranges::sort(densities);
  if (densities.size() < 3 || std::ranges::adjacent_find(densities) != densities.end())
    throw InputError(
        fmt::format("--densities {}: an order needs three different densities or more, for example 4,8,16", quotable(option)));
  return densities;
}

// Refuses now what the last density would be refused for after hours.
void check_finest(double density, const std::string& option, const Case& c, const TriangleMesh& mesh) {
  const double most = densest_tubes(mesh, c.sweep, c.tubes);
  if (density > most)
    throw InputError(fmt::format(
        "--densities {}: {} tubes per wavelength are more than 10^6 along one side of the launch plane; {} would fit, or check "
        "target.unit and frequency.ghz",
        quotable(option), number_text(density), rounded_down_text(most)));
}

// Shares of the whole study's work: tubes grow with the square of the density.
double work(double density) { return density * density; }

ResultNames names_of_convergence_results(bool with_plot) {
  ResultNames names{{}, {"converge.csv"}};
  if (with_plot) names.pictures = {"converge.png", "converge.svg"};
  return names;
}

// Clipped tubes have no density to study.
SolveOptions options_of(const Case& c, const Request& request) {
  TubeOptions tubes = c.tubes;
  if (tubes.clip) tubes.mode = TubeMode::uniform;
  return {tubes, c.edges, c.surfaces, request.threads > 0 ? request.threads : all_threads(), false, {}};
}

// The amplitudes of every density are kept to the end.
void check_study_memory(const Target& target, const Case& c, const Request& request, const std::vector<double>& densities) {
  SolveOptions finest = options_of(c, request);
  finest.tubes.per_wavelength = densities.back();
  const SolvePlan plan(target, c.sweep, finest);
  const double kept = static_cast<double>(densities.size() * c.sweep.rows() * sizeof(ScatteringMatrix));
  Case study = c;
  study.image_looks.clear();
  check_memory(plan, study, nullptr, kept);
}

// Solves one density after the other and keeps what is finished on disk.
class DensityStudy {
 public:
  DensityStudy(const Case& c, const Target& target, const Request& request, const fs::path& destination,
               const std::vector<double>& densities)
      : case_(c),
        target_(target),
        destination_(destination),
        folder_(destination),
        densities_(densities.size()),
        bar_(request.quiet, fmt::format("solving {} looks at {} densities", c.sweep.looks.size(), densities.size())),
        study_{c.title, c.sweep, {}, {}} {
    options_ = options_of(c, request);
    for (const double density : densities) whole_ += work(density);
  }

  void add(double density) {
    options_.tubes.per_wavelength = density;
    options_.progress = [&](double share) {
      bar_.show((finished_ + share * work(density)) / whole_);
      return !InterruptFlag::raised();
    };
    SweepResult result = solve(target_, case_.sweep, options_);
    finished_ += work(density);
    if (warn_of_unusable_rows(result.statistics)) unusable_ = true;
    const Statistics& s = result.statistics;
    study_.results.push_back({density, s.tubes, s.rays, s.solve_s, std::move(result.total)});
    study_.convergence = study_convergence(study_.results);
    bar_.note(note());
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
                       finished(), densities_);
  }

  std::optional<std::string> last_words() const {
    if (complete_) return {};
    folder_.abandon();
    return interrupted_sentence();
  }

  /// Puts the study so far in the place of what an earlier one left.
  void write(bool with_plot) {
    make_again_if_gone(folder_);
    NewResults results(folder());
    write_converge_csv(results.folder() / "converge.csv", study_);
    const std::string trouble = with_plot ? plot_convergence(results.folder(), study_) : "";
    if (with_plot) stop_if_interrupted();
    if (!trouble.empty()) warn(trouble);
    replace_results(results, folder(), names_of_convergence_results(with_plot), names_of_convergence_results(true).pictures, [&] {
      finished_densities_ = study_.results.size();
      complete_ = with_plot || (!case_.plots && finished() == densities_);
    });
  }

 private:
  std::string note() const {
    const DensityResult& result = study_.results.back();
    const std::string text =
        fmt::format("{:>8} tubes per wavelength: {:.2f} s", number_text(result.per_wavelength), result.solve_s);
    const std::size_t count = study_.results.size();
    if (count == 1) return text;
    return text + fmt::format(", relative change {:.2g}", study_.convergence.densities[count - 2].relative_change);
  }

  const Case& case_;
  const Target& target_;
  fs::path destination_;  // as it was asked for
  OutputFolder folder_;
  std::size_t densities_;
  std::atomic<std::size_t> finished_densities_ = 0;
  std::atomic<bool> complete_ = false;
  bool unusable_ = false;
  ProgressBar bar_;
  SolveOptions options_;
  ConvergenceStudy study_;
  double whole_ = 0.0, finished_ = 0.0;
};

}  // namespace

void converge_command(const Request& request) {
  const std::vector<double> densities = parsed_densities(request.densities);
  const Case c = read_case(request.case_file, request.overrides);
  if (c.edges.method == EdgeMethod::utd)
    throw InputError(
        fmt::format("{}: edges.method \"utd\" has no tubes whose density could be studied; remove it", c.file.string()));
  const fs::path destination = request.output_folder.empty() ? c.file.parent_path() / "out" : request.output_folder;
  check_output(destination, names_of_convergence_results(c.plots), input_files(c));
  std::optional<Target> built;
  run_on_threads(request.threads, [&] { built.emplace(load_target(c).mesh, c.wedges); });
  const Target& target = *built;
  if (!c.image_looks.empty())
    warn(fmt::format("{}: output.image_look has no effect here: a study of density makes no images; use raytube run for them",
                     c.file.string()));
  check_antennas(target.mesh, c.sweep);
  check_finest(densities.back(), request.densities, c, target.mesh);
  check_study_memory(target, c, request, densities);
  DensityStudy study(c, target, request, destination, densities);
  const InterruptFlag interrupt_flag([&study] { return study.last_words(); });
  try {
    for (const double density : densities) {
      study.add(density);
      study.write(false);
    }
    if (c.plots) study.write(true);
    if (!request.quiet) fmt::print("{}results         {}\n", study.text(), study.folder().string());
  } catch (const Interrupted&) {
    throw Interrupted(study.interrupted_sentence());
  }
  if (study.unusable()) throw unusable_rows_in(study.folder());
}

}  // namespace raytube
