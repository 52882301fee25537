// raytube sources: a scene traced from a point by any launch model, and the hits on each part.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>

#include "case/source_case.h"
#include "core/error.h"
#include "core/threads.h"
#include "jobs/memory.h"
#include "mesh/load.h"
#include "mesh/model/join.h"
#include "output/tables/sources_csv.h"
#include "point_source/launch_limit.h"
#include "point_source/ray_hits.h"
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

constexpr std::size_t most_triangles = 4000;   // for exact shares: their cost grows with the square
constexpr std::uint64_t sampled_rays = 10000;  // to estimate the number of hits
constexpr double sample_margin = 1.2;
constexpr std::uint64_t most_launch_points = 4000;  // in a picture

JoinedMesh load_scene(const SourceCase& c) {
  std::vector<TriangleMesh> parts;
  for (const ScenePart& part : c.parts) parts.push_back(load_mesh(part.mesh_file, part.metres_per_unit).mesh);
  return join_meshes(parts);
}

// The enclosing box, in recentred coordinates.
Box enclosing_box(const SourceCase& c, const TriangleMesh& mesh) {
  const Box scene = bounding_box(mesh.vertices);
  if (!c.box) return scene;
  const Box given{c.box->low - mesh.center, c.box->high - mesh.center};
  const dvec3 rounding(weld_fraction * scene.diagonal());
  if (glm::any(glm::lessThan(scene.low, given.low - rounding)) || glm::any(glm::greaterThan(scene.high, given.high + rounding)))
    throw InputError(
        fmt::format("{}: scene.box_m does not enclose the parts of the scene; enlarge it or remove it", c.file.string()));
  return given;
}

// True if a point lies on a triangle, to within `tolerance` [m].
bool lies_on(const TriangleMesh& mesh, std::uint32_t triangle, const dvec3& point, double tolerance) {
  const Patch& plane = mesh.patch_of(triangle);
  if (std::abs(glm::dot(plane.normal, point) - plane.offset) > tolerance) return false;
  const auto& corners = mesh.triangles[triangle];
  int left = 0, right = 0;
  for (int c = 0; c < 3; ++c) {
    const dvec3 &a = mesh.vertices[corners[c]], &b = mesh.vertices[corners[(c + 1) % 3]];
    const double aside = glm::dot(plane.normal, glm::cross(b - a, point - a)) / glm::length(b - a);
    left += aside > tolerance ? 1 : 0;
    right += aside < -tolerance ? 1 : 0;
  }
  return left == 0 || right == 0;
}

// Traces a scene from one position after the other.
class SourceTracing {
 public:
  SourceTracing(const SourceCase& c, int threads)
      : case_(c), joined_(load_scene(c)), tracer_(joined_.mesh), box_(enclosing_box(c, joined_.mesh)), threads_(threads) {
    for (const ScenePart& part : c.parts) {
      study_.part_names.push_back(part.name);
      surfaces_.push_back(part.surface);
    }
    study_.title = c.title;
    study_.counted = c.counted;
    // Refuses a bad position now, not after the positions before it.
    for (std::size_t i = 0; i < c.points.size(); ++i) require_free(i);
    for (std::size_t i = 0; i < c.points.size(); ++i)
      for (const LaunchModel model : c.models) launch(i, model, 1);
  }

  void solve(const std::function<bool(double)>& progress) {
    progress_ = progress;
    for (std::size_t position = 0; position < case_.points.size(); ++position) {
      const std::vector<VisiblePiece> seen = seen_from({site(position).source, {}});
      for (const LaunchModel model : case_.models) run_model(position, model, seen);
    }
  }

  /// Throws InputError if memory cannot hold the hits for the pictures: those of each model's largest launch, three times over
  /// while they are collected. A sample estimates the hits of a ray, and is taken only if their largest number would not fit.
  void check_memory() const {
    const double rays = static_cast<double>(case_.rays.back()), models = static_cast<double>(case_.models.size());
    const double available = memory_to_be_had(), bytes_per_ray = (case_.max_reflections + 1.0) * sizeof(CountedHit);
    if (rays * (models + 2.0) * bytes_per_ray <= available) return;
    double sum = 0.0, most = 0.0;
    for (const LaunchModel model : case_.models) {
      const double hits = sampled_hits_per_ray(model);
      sum += hits, most = std::max(most, hits);
    }
    const double bytes = sample_margin * rays * (sum + 2.0 * most) * sizeof(CountedHit);
    require_memory(bytes, case_.file.string(),
                   fmt::format("the hits of {} rays on \"{}\"", case_.rays.back(), case_.parts[case_.counted].name),
                   fmt::format("source.rays = {:.0f} would fit", std::floor(rays * available / bytes)));
  }

  const SourceStudy& result() const { return study_; }

  bool exact() const { return joined_.mesh.triangles.size() <= most_triangles; }

 private:
  LaunchSite site(std::size_t position) const {
    const TriangleMesh& mesh = joined_.mesh;
    return {&mesh, box_, case_.points[position] - mesh.center, case_.wall, weld_fraction * box_.diagonal()};
  }

  // A source on a surface would see neither that surface nor anything behind it.
  void require_free(std::size_t position) const {
    const LaunchSite at = site(position);
    for (std::uint32_t t = 0; t < joined_.mesh.triangles.size(); ++t)
      if (lies_on(joined_.mesh, t, at.source, at.tolerance))
        throw InputError(fmt::format("{}: source.point_m {} lies on the surface of part \"{}\"; move it off", case_.file.string(),
                                     position + 1, case_.parts[joined_.triangle_part[t]].name));
  }

  Launch launch(std::size_t position, LaunchModel model, std::uint64_t rays) const {
    try {
      return Launch(model, site(position), rays, case_.seed);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}", case_.file.string(), error.what()));
    }
  }

  std::vector<VisiblePiece> seen_from(const Eye& eye) const {
    return exact() ? visible_pieces(joined_.mesh, eye) : std::vector<VisiblePiece>();
  }

  void run_model(std::size_t position, LaunchModel model, const std::vector<VisiblePiece>& seen) {
    const bool shown = position == 0;
    if (shown) study_.views.push_back({model, 0, 0, {}, {}});
    for (const std::uint64_t asked : case_.rays) {
      const auto begin = std::chrono::steady_clock::now();
      const Launch rays = launch(position, model, asked);
      RayHits hits = trace_rays(tracer_, joined_.triangle_part, surfaces_, rays, options(shown && asked == case_.rays.back()));
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      SourceRun run{
          position, case_.points[position], model, asked, rays.rays(), hits.escaped, hits.absorbed, hits.cut, hits.missed,
          seconds,  std::move(hits.parts)};
      if (exact()) add_exact(rays, seen, run);
      study_.runs.push_back(std::move(run));
      if (shown) show(rays, asked, std::move(hits.hits));
      ++finished_;
    }
  }

  // Keeps launch points and hits for the pictures: those of the smallest launch, and of the largest.
  void show(const Launch& rays, std::uint64_t asked, std::vector<CountedHit> hits) {
    SourceView& view = study_.views.back();
    const dvec3& origin = joined_.mesh.center;
    if (asked == case_.rays.front()) {
      view.launched = rays.rays();
      const std::uint64_t step = (rays.rays() + most_launch_points - 1) / most_launch_points;
      for (std::uint64_t i = 0; i < rays.rays(); i += step) view.launch_points.push_back(rays.ray(i).through + origin);
    }
    if (asked != case_.rays.back()) return;
    for (CountedHit& hit : hits) hit.point += origin;
    view.traced = rays.rays();
    view.hits = std::move(hits);
  }

  double sampled_hits_per_ray(LaunchModel model) const {
    const Launch sample = launch(0, model, std::min(sampled_rays, case_.rays.back()));
    const HitOptions keep{case_.max_reflections, case_.counted, true, threads_, {}};
    const RayHits found = trace_rays(tracer_, joined_.triangle_part, surfaces_, sample, keep);
    return static_cast<double>(found.hits.size()) / static_cast<double>(sample.rays());
  }

  HitOptions options(bool keep) const {
    const double runs = static_cast<double>(case_.points.size() * case_.models.size() * case_.rays.size());
    const double before = static_cast<double>(finished_) / runs;
    const auto overall = [this, before, runs](double share) { return progress_(before + share / runs); };
    return {case_.max_reflections, case_.counted, keep, threads_, overall};
  }

  void add_exact(const Launch& rays, const std::vector<VisiblePiece>& seen, SourceRun& run) {
    const double tolerance = cut_tolerance(joined_.mesh, rays.eye());
    if (rays.eye().direction && !plane_wave_sees_) plane_wave_sees_ = seen_from(rays.eye());
    const std::vector<VisiblePiece>& lit = rays.eye().direction ? *plane_wave_sees_ : seen;
    const auto limits = launch_limits(rays, lit, joined_.triangle_part, run.parts.size(), tolerance);
    for (std::size_t part = 0; part < limits.size(); ++part) {
      PartHits& hits = run.parts[part];
      hits.limit = limits[part].share;
      hits.limit_bound = limits[part].bound;
      if (run.model != LaunchModel::random) hits.estimate_bound = limits[part].estimate_bound;
      hits.exact = 0.0;
    }
    const dvec3 source = site(run.position).source;
    for (const VisiblePiece& piece : seen)
      run.parts[joined_.triangle_part[piece.triangle]].exact += solid_angle(piece.outline, source) / (4.0 * pi);
  }

  const SourceCase& case_;
  JoinedMesh joined_;
  Tracer tracer_;
  Box box_;
  int threads_;
  std::vector<RaySurface> surfaces_;
  std::function<bool(double)> progress_;
  std::size_t finished_ = 0;
  std::optional<std::vector<VisiblePiece>> plane_wave_sees_;
  SourceStudy study_;
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
  if (!exact) fmt::print("skipped     exact shares: the scene has more than {} triangles\n", most_triangles);
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
