// raytube run: case -> mesh -> solve -> files.
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "case/case.h"
#include "program/commands.h"
#include "program/interrupt.h"
#include "output/csv.h"
#include "output/files.h"
#include "output/manifest.h"
#include "output/plot.h"
#include "program/progress_bar.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

SweepResult solve_with_progress(const Target& target, const Case& c, const Request& request, int threads) {
  ProgressBar bar(!request.quiet && isatty(STDERR_FILENO) != 0);
  SolveOptions options{c.tubes, c.edges, threads, request.parts, {}};
  options.progress = [&](double share) {
    bar.show(share);
    return !InterruptFlag::raised();
  };
  return solve(target, c.sweep, options);
}

// A folder holds the results of one run: what an earlier run left must not stand beside the new rcs.csv.
void remove_earlier_results(const fs::path& folder) {
  std::error_code ignored;
  for (const char* name : {"run.json", "rcs.csv", "channels.csv", "parts.csv", "rcs.png", "rcs.svg"})
    fs::remove(folder / name, ignored);
}

void write_tables(const fs::path& folder, const Case& c, const SweepResult& result, bool parts) {
  write_rcs_csv(folder / "rcs.csv", c.sweep, result);
  write_channels_csv(folder / "channels.csv", c.sweep, result);
  if (parts) write_parts_csv(folder / "parts.csv", c.sweep, result);
}

void draw_plots(const fs::path& folder, const Case& c, const SweepResult& result) {
  const std::string trouble = plot_rcs(folder, c.title, c.sweep, result);
  if (!trouble.empty()) fmt::print(stderr, "raytube: {}\n", trouble);
}

std::uint64_t peak_rss_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

std::vector<std::pair<std::string, double>> report_entries(const MeshReport& r) {
  const auto count = [](std::uint64_t n) { return static_cast<double>(n); };
  return {{"facets_read", count(r.facets_read)},
          {"triangles_read", count(r.triangles_read)},
          {"vertices_read", count(r.vertices_read)},
          {"vertices_welded", count(r.vertices_welded)},
          {"facets_unusable", count(r.facets_unusable)},
          {"triangles_degenerate", count(r.triangles_degenerate)},
          {"triangles_duplicate", count(r.triangles_duplicate)},
          {"triangles_internal", count(r.triangles_internal)},
          {"triangles_added", count(r.triangles_added)},
          {"t_junctions_split", count(r.t_junctions_split)},
          {"triangles_flipped", count(r.triangles_flipped)},
          {"triangles_traced", count(r.triangles_traced)},
          {"open_edges", count(r.open_edges)},
          {"non_manifold_edges", count(r.non_manifold_edges)},
          {"components", count(r.components)},
          {"components_closed", count(r.components_closed)},
          {"patches", count(r.patches)},
          {"weld_distance_m", r.weld_distance}};
}

Manifest describe(const Case& c, const MeshReport& report, const Target& target, const SweepResult& result, int threads) {
  Manifest manifest;
  manifest.case_json = resolved_case_json(c);
  manifest.program_version = RAYTUBE_VERSION;
  manifest.embree_instruction_set = target.tracer.instruction_set();
  manifest.threads = threads;
  manifest.mesh_report = report_entries(report);
  for (const MeshNote& note : report.notes()) manifest.mesh_notes.emplace_back(note.what, static_cast<double>(note.count));
  manifest.statistics = result.statistics;
  return manifest;
}

double peak_sigma_dbsm(const SweepResult& result) {
  double peak = sigma_dbsm(0.0);
  for (const ScatteringMatrix& s : result.total)
    for (const int channel : {0, 1, 2, 3}) peak = std::max(peak, sigma_dbsm(s.at(channel / 2, channel % 2)));
  return peak;
}

void print_summary(const SweepResult& result, const Manifest& manifest, const fs::path& folder) {
  const Statistics& s = result.statistics;
  fmt::print("rays        {} in {} tubes, {:.2f} s on {} thread{}\n", s.rays, s.tubes, s.solve_s, manifest.threads,
             manifest.threads == 1 ? "" : "s");
  fmt::print("lost rays   {}\n", s.lost_rays);
  if (s.tubes_cut) fmt::print("cut tubes   {} still bounced after tubes.max_bounces\n", s.tubes_cut);
  for (const Skipped& skipped : s.skipped) fmt::print("skipped     {} ({}): {}\n", skipped.what, skipped.count, skipped.why);
  fmt::print("peak sigma  {:.2f} dBsm\n", peak_sigma_dbsm(result));
  fmt::print("results     {}\n", folder.string());
}

}  // namespace

void run_command(const Request& request) {
  const Stopwatch total;
  const Case c = read_case(request.case_file, request.overrides);
  const fs::path results = request.output_folder.empty() ? c.file.parent_path() / "out" : request.output_folder;
  { const OutputFolder refused_now_rather_than_after_the_computation(results); }
  const LoadedMesh loaded = load_mesh(c.mesh_file, c.metres_per_unit);
  Timing time{total.seconds(), 0.0, 0.0};
  const Target target(loaded.mesh, c.edges);
  time.build_s = total.seconds() - time.read_s;

  const InterruptFlag interrupt_flag;
  const int threads = request.threads > 0 ? request.threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const SweepResult result = solve_with_progress(target, c, request, threads);

  const OutputFolder folder(results);
  remove_earlier_results(folder.path());
  write_tables(folder.path(), c, result, request.parts);
  Manifest manifest = describe(c, loaded.report, target, result, threads);
  manifest.mesh_sha256 = sha256_of_file(c.mesh_file);
  manifest.rcs_csv_sha256 = sha256_of_file(folder.path() / "rcs.csv");
  manifest.peak_rss_bytes = peak_rss_bytes();
  if (c.plots) draw_plots(folder.path(), c, result);
  manifest.time = {time.read_s, time.build_s, total.seconds()};
  write_manifest(folder.path() / "run.json", manifest);
  if (!request.quiet) print_summary(result, manifest, folder.path());
}

}  // namespace raytube
