// raytube converge: the same case with finer and finer tubes.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <atomic>

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
#include "program/helping.h"
#include "program/python.h"
#include "program/solve_warnings.h"
#include "program/work/destination.h"
#include "program/work/progress_bar.h"
#include "program/work/results.h"
#include "ranks/ranks.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;

constexpr const char* converge_examples =
    R"(Solves the whole case at each density, coarse ones first, in place of its tubes.per_wavelength. Prints the observed order,
the extrapolated value with its uncertainty, and the density that is fine enough. Writes converge.csv, converge.png and
converge.svg. If interrupted, it leaves converge.csv with the finished densities.
Given netCDF files of runs with uniform tubes in place of the case, it computes nothing and studies these.

Examples:
  raytube converge cases/convergence/case.toml
  raytube converge case.toml --densities 5,10,20 --set look.phi_deg=0
  raytube converge n5.nc n10.nc n20.nc -o study)";

struct ConvergeRequest {
  std::vector<fs::path> files;  // one case, or netCDF files
  CaseInput input;              // the case, if it is one
  fs::path output;              // empty: <case folder>/out
  Work work;
  std::string densities = "2,4,8,16,32,64";  // tubes per wavelength
};

std::string option_text(const std::string& option) { return fmt::format("--densities {}", quotable(option)); }

std::vector<double> parsed_densities(const std::string& option) {
  std::vector<double> densities;
  for (std::size_t at = 0; at <= option.size();) {
    const std::size_t end = std::min(option.find(',', at), option.size());
    const auto density = parsed_number(option.substr(at, end - at));
    if (!density || !std::isfinite(*density) || *density <= 0.0)
      throw InputError(
          fmt::format("{}: write tubes per wavelength separated by commas, for example 4,8,16", option_text(option)));
    densities.push_back(*density);
    at = end + 1;
  }
  return densities_from_coarse_to_fine(std::move(densities), option_text(option));
}

ResultNames convergence_results(bool with_plot) {
  ResultNames names{{}, {"converge.csv"}};
  if (with_plot) names.pictures = {"converge.png", "converge.svg"};
  return names;
}

std::string note_of(const ConvergenceStudy& study) {
  const DensityResult& result = study.results.back();
  const std::string text =
      fmt::format("{:>8} tubes per wavelength: {:.2f} s", number_text(result.per_wavelength), result.solve_s);
  const std::size_t count = study.results.size();
  if (count == 1) return text;
  return text + fmt::format(", relative change {:.2g}", study.convergence.densities[count - 2].relative_change);
}

// Solves one density after the other, and keeps the finished ones on disk, in place of an earlier study.
void solve_densities(const Case& c, const Target& target, const std::vector<double>& densities, const Work& work,
                     const fs::path& destination) {
  const OutputFolder folder(destination);
  ConvergenceStudy study{c.title, c.sweep, {}, {}};
  std::atomic<std::size_t> finished = 0;  // densities on disk
  std::atomic<bool> complete = false;
  bool unusable = false;
  ProgressBar bar(work.quiet, fmt::format("solving {} looks at {} densities", c.sweep.looks.size(), densities.size()));
  const auto interrupted_sentence = [&]() -> std::string {
    if (finished == 0) return Interrupted().what();
    return fmt::format("interrupted; converge.csv in {} holds the {} of {} densities that were finished", destination.string(),
                       finished.load(), densities.size());
  };
  const InterruptFlag interrupt_flag([&]() -> std::optional<std::string> {
    if (complete) return {};
    folder.abandon();
    return interrupted_sentence();
  });
  const auto write = [&](bool with_plot) {
    folder.require_there();
    NewResults results(folder.path());
    write_converge_csv(results.folder() / "converge.csv", study);
    if (with_plot) draw_with_python(results.folder(), {"converge.csv"}, c.file);
    const auto placed = [&] {
      finished = study.results.size();
      complete = with_plot || (!c.plots && finished == densities.size());
    };
    replace_results(results, folder.path(), convergence_results(with_plot), convergence_results(true).pictures, placed);
  };
  const auto keep = [&](SolvedDensity solved) {
    auto& [density, result] = solved;
    const Statistics& s = result.statistics;
    unusable = warn_of_unusable_rows(s) || unusable;
    study.results.push_back({density, s.tubes, s.rays, s.solve_s, std::move(result.total)});
    study.convergence = study_convergence(study.results);
    bar.note(note_of(study));
    write(false);
  };
  try {
    study_densities(
        c, target, work.threads, densities, [&](double share) { return bar.show(share); }, team_of(work), keep);
    if (work.ranks) work.ranks->end();
    if (c.plots) write(true);
  } catch (const Interrupted&) {
    throw Interrupted(interrupted_sentence());
  }
  if (!work.quiet) fmt::print("{}results         {}\n", convergence_text(study), folder.path().string());
  if (unusable) throw unusable_rows_in(folder.path());
}

JournalIdentity asked_of(const ConvergeRequest& asked) { return {{"--densities", asked.densities}}; }

void help_to_converge(const ConvergeRequest& asked) {
  help_leader(asked.work, asked.input, asked_of(asked), [&](const Case& c, const Target& target) {
    const auto go_on = [](double) { return true; };
    study_densities(c, target, asked.work.threads, parsed_densities(asked.densities), go_on, team_of(asked.work), {});
  });
}

void converge_case(const ConvergeRequest& asked) {
  const std::vector<double> densities = parsed_densities(asked.densities);
  const Work& work = asked.work;
  const Case c = read_case(asked.input.file, asked.input.overrides);
  refuse_study_of_rays(c);
  const fs::path destination = asked.output.empty() ? c.file.parent_path() / "out" : asked.output;
  check_output(destination, convergence_results(c.plots), input_files(c));
  std::optional<Target> target;
  LoadedMesh loaded = load_target(c);
  share_work(work, asked_of(asked), c, loaded.mesh);
  run_on_threads(work.threads, [&] { target.emplace(std::move(loaded.mesh), c.wedges); });
  if (!c.image_looks.empty())
    warn(fmt::format("{}: output.image_look has no effect here; use raytube run for images", c.file.string()));
  check_study(c, *target, work.threads, densities, option_text(asked.densities));
  solve_densities(c, *target, densities, work, destination);
}

// Studies results of one case at several densities.
void converge_results(const CLI::App& converge, const ConvergeRequest& asked) {
  for (const fs::path& file : asked.files)
    if (!is_netcdf_name(file))
      throw InputError(
          fmt::format("{}: is not a netCDF file; converge takes one case, or only netCDF files (.nc)", file.string()));
  for (const char* option : {"--set", "--densities", "--threads", "--instruction-set"})
    if (converge.count(option) > 0)
      throw InputError(fmt::format("{}: has no effect on finished results; leave it out, or give a case", option));
  const fs::path destination = asked.output.empty() ? fs::absolute(asked.files.front()).parent_path() / "out" : asked.output;
  const ResultNames names = convergence_results(true);
  check_output(destination, names, {});
  std::vector<ResultFile> files;
  for (const fs::path& file : asked.files) files.push_back({file, read_netcdf(file)});
  const Sweep sweep = sweep_of(files.front().result);
  std::vector<DensityResult> results = density_results(files);
  const Convergence convergence = study_convergence(results);
  const ConvergenceStudy study{attribute_of(files.front().result, "title"), sweep, std::move(results), convergence};
  AllOrNothing(destination).place(names, [&](const fs::path& folder) {
    write_converge_csv(folder / "converge.csv", study);
    draw_with_python(folder, {"converge.csv"});
  });
  if (!asked.work.quiet) fmt::print("{}results         {}\n", convergence_text(study), destination.string());
}

// Finds the results in folders; returns whether the one file is a case.
bool has_case(ConvergeRequest& asked) {
  for (fs::path& file : asked.files) file = result_in(file, std::array{"rcs.nc"});
  asked.input.file = asked.files.front();
  return asked.files.size() == 1 && !is_netcdf_name(asked.files.front());
}

}  // namespace

CLI::App& add_converge(CommandLine& line) {
  const auto asked = std::make_shared<ConvergeRequest>();
  CLI::App& converge = add_command(line, "converge", "Study how a case converges with tube density", converge_examples);
  add_value(converge, "case CASE.toml|FILE.nc...", asked->files,
            "Case file (TOML), or netCDF files of runs at different densities")
      ->required();
  add_set_option(converge, asked->input);
  add_output_option(converge, asked->output,
                    "Folder for the results; default <case folder>/out, or out beside the first netCDF file");
  add_machine_options(line, converge, asked->work);
  add_value(converge, "--densities N,N,...", asked->densities, "Tubes per wavelength, at least three; default 2,4,8,16,32,64");
  add_quiet_option(converge, asked->work.quiet, "table");
  const auto act = [asked, &converge] { has_case(*asked) ? converge_case(*asked) : converge_results(converge, *asked); };
  return set_action(line, converge, act, [asked] {
    if (has_case(*asked)) help_to_converge(*asked);
  });
}

}  // namespace raytube
