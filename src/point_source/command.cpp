// raytube sources: a scene traced from a point by any launch model, and the hits on each part.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>

#include "core/threads.h"
#include "point_source/source_tracing.h"
#include "point_source/sources_csv.h"
#include "program/options.h"
#include "program/python.h"
#include "program/work/progress_bar.h"
#include "program/work/results.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;

constexpr const char* sources_examples =
    R"(Traces a scene of named parts from a point, with rays launched by six models, and counts what they hit. Writes sources.csv,
hits.ply and pictures of the launch points, of the hits on one part and of the errors against rays and time.

Examples:
  raytube sources cases/double_slit/case.toml
  raytube sources case.toml --set source.rays=1000000 --set source.models=geometry)";

struct SourcesRequest {
  CaseInput input;
  fs::path output;  // empty: <case folder>/out
  Work work;
};

std::string percent_text(double share) { return std::isnan(share) ? "-" : fmt::format("{:.4f}", 100.0 * share); }

void print_run(const SourceRun& run, std::size_t counted) {
  const PartHits& part = run.parts[counted];
  const double rays = static_cast<double>(run.rays);
  fmt::print("{:>5} {:<11} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9.3f}\n", run.position, launch_model_name(run.model),
             run.rays, percent_text(static_cast<double>(part.all_hits) / rays),
             percent_text(static_cast<double>(part.first_hits) / rays), percent_text(part.limit), percent_text(part.response),
             percent_text(part.estimate), percent_text(part.exact), run.seconds);
}

void print_summary(const SourceStudy& study, bool exact, const fs::path& folder) {
  fmt::print("hits on {} in percent of the rays; response (all) and weighted (direct) in percent of the solid angle\n",
             study.part_names[study.counted]);
  fmt::print("{:>5} {:<11} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "place", "model", "rays", "all", "direct", "limit",
             "response", "weighted", "exact", "seconds");
  for (const SourceRun& run : study.runs) print_run(run, study.counted);
  if (!exact) fmt::print("skipped     exact shares: the scene has more than {} triangles\n", SourceTracing::most_triangles);
  fmt::print("results     {}\n", folder.string());
}

ResultNames names_of_source_results(bool plots) {
  ResultNames names{{}, {"hits.ply", "launch.ply", "sources.csv"}};
  if (plots) names.pictures = {"launch.png", "launch.svg", "hits.png", "hits.svg", "sources.png", "sources.svg"};
  return names;
}

void trace_sources(const SourcesRequest& asked) {
  const SourceCase c = read_source_case(asked.input.file, asked.input.overrides);
  const fs::path destination = asked.output.empty() ? c.file.parent_path() / "out" : asked.output;
  check_output(destination, names_of_source_results(c.plots), input_files(c));
  const int threads = asked.work.threads > 0 ? asked.work.threads : all_threads();
  SourceTracing study(c, threads);
  study.check_memory();

  AllOrNothing results(destination);
  ProgressBar bar(asked.work.quiet, "tracing rays from the source");
  run_on_threads(threads, [&] { study.solve([&](double share) { return bar.show(share); }); });
  const SourceStudy& result = study.result();
  const auto write = [&](const fs::path& folder) {
    write_sources_csv(folder / "sources.csv", result);
    stop_if_interrupted();
    write_hits_ply(folder / "hits.ply", result);
    write_launch_ply(folder / "launch.ply", result);
    stop_if_interrupted();
    if (c.plots) draw_with_python(folder, {"sources.csv"}, c.file);
  };
  results.place(names_of_source_results(c.plots), write, names_of_source_results(true).pictures);
  if (!asked.work.quiet) print_summary(result, study.exact(), results.folder());
}

}  // namespace

CLI::App& add_sources(CommandLine& line) {
  const auto asked = std::make_shared<SourcesRequest>();
  CLI::App& sources = add_command(line, "sources", "Count what rays from a point hit, for six launch models", sources_examples);
  add_case_options(sources, asked->input);
  add_output_option(sources, asked->output, "Folder for the results; default <case folder>/out");
  add_machine_options(line, sources, asked->work);
  add_quiet_option(sources, asked->work.quiet, "table");
  return set_action(line, sources, [asked] { trace_sources(*asked); });
}

}  // namespace raytube
