// raytube converge of results that are there: netCDF files of one case at several densities.
#include <fmt/format.h>

#include "output/compare/convergence_report.h"
#include "output/compare/density_results.h"
#include "output/netcdf/netcdf_file.h"
#include "output/plots/convergence_plot.h"
#include "output/tables/stored.h"
#include "program/commands.h"
#include "program/interrupt.h"
#include "program/results.h"

namespace raytube {

namespace {

const ResultNames study_results = {{"converge.png", "converge.svg"}, {"converge.csv"}};

void write_study(const ConvergenceStudy& study, const std::filesystem::path& destination) {
  const OutputFolder folder(destination);
  AllOrNothing ending(folder);
  const InterruptFlag interrupt_flag([&ending] { return ending.last_words(); });
  NewResults results(folder.path());
  write_converge_csv(results.folder() / "converge.csv", study);
  const std::string trouble = plot_convergence(results.folder(), study);
  stop_if_interrupted();
  if (!trouble.empty()) warn(trouble);
  replace_results(results, folder.path(), study_results, {}, [&ending] { ending.complete(); });
}

}  // namespace

void converge_results(const Request& request) {
  const std::filesystem::path destination = request.output_folder.empty()
                                                ? std::filesystem::absolute(request.studied.front()).parent_path() / "out"
                                                : request.output_folder;
  check_output(destination, study_results, {});
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
