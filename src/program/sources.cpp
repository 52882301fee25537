// raytube sources: a scene traced from a point by any launch model, and what each part is hit by.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

#include "case/source_case.h"
#include "core/decimal.h"
#include "core/error.h"
#include "core/threads.h"
#include "jobs/memory.h"
#include "mesh/load.h"
#include "mesh/model/join.h"
#include "output/tables/sources_csv.h"
#include "point_source/launch_limit.h"
#include "point_source/ray_hits.h"
#include "program/commands.h"
#include "program/python.h"
#include "program/work/interrupt.h"
#include "program/work/progress_bar.h"
#include "program/work/results.h"

namespace raytube {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_triangles = 4000;   // for exact shares: their cost grows with the square
constexpr std::uint64_t sampled_rays = 10000;  // to know how many hits there will be
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
  const Patch& plane = mesh.patches[mesh.triangle_patch[triangle]];
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

// A scene from one position after the other.
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
    // Refuses now what the last position would be refused for.
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

  /// Throws InputError if the hits to be shown find no room: those of each model's largest launch are kept, while they are put
  /// together three times over. How many a ray makes, a sample tells, taken only where the most of them would not fit.
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

  // From a point of a surface one sees neither that surface nor all that lies behind it.
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

  const std::vector<VisiblePiece>& seen_by_plane_wave(const Eye& eye) {
    if (!plane_wave_sees_) plane_wave_sees_ = seen_from(eye);
    return *plane_wave_sees_;
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
      if (shown && asked == case_.rays.front()) keep_launch_points(rays);
      if (shown && asked == case_.rays.back()) keep_hits(rays, std::move(hits.hits));
      ++finished_;
    }
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
    const std::vector<VisiblePiece>& lit = rays.eye().direction ? seen_by_plane_wave(rays.eye()) : seen;
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

  void keep_launch_points(const Launch& rays) {
    SourceView& view = study_.views.back();
    view.launched = rays.rays();
    const std::uint64_t step = (rays.rays() + most_launch_points - 1) / most_launch_points;
    for (std::uint64_t i = 0; i < rays.rays(); i += step) view.launch_points.push_back(rays.ray(i).through + joined_.mesh.center);
  }

  void keep_hits(const Launch& rays, std::vector<CountedHit> hits) {
    for (CountedHit& hit : hits) hit.point += joined_.mesh.center;
    study_.views.back().traced = rays.rays();
    study_.views.back().hits = std::move(hits);
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
  fmt::print("hits on {}, in percent of the rays; response and weighted: of the solid angle, all and direct\n",
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

}  // namespace

void sources_command(const Request& request) {
  const SourceCase c = read_source_case(request.case_file, request.overrides);
  const fs::path destination = request.output_folder.empty() ? c.file.parent_path() / "out" : request.output_folder;
  check_output(destination, names_of_source_results(c.plots), input_files(c));
  const int threads = request.threads > 0 ? request.threads : all_threads();
  SourceTracing study(c, threads);
  study.check_memory();

  OutputFolder folder(destination);
  AllOrNothing ending(folder);
  const InterruptFlag interrupt_flag([&ending] { return ending.last_words(); });
  ProgressBar bar(request.quiet, "tracing rays from the source");
  const auto go_on = [&](double share) {
    bar.show(share);
    return !InterruptFlag::raised();
  };
  run_on_threads(threads, [&] { study.solve(go_on); });
  const SourceStudy& result = study.result();

  folder.require_there();
  NewResults results(folder.path());
  write_sources_csv(results.folder() / "sources.csv", result);
  stop_if_interrupted();
  write_hits_ply(results.folder() / "hits.ply", result);
  write_launch_ply(results.folder() / "launch.ply", result);
  stop_if_interrupted();
  const std::string trouble = c.plots ? draw_with_python(results.folder(), {"sources.csv"}, c.file) : "";
  stop_if_interrupted();
  if (!trouble.empty()) warn(trouble);
  replace_results(results, folder.path(), names_of_source_results(c.plots), names_of_source_results(true).pictures,
                  [&ending] { ending.complete(); });
  if (!request.quiet) print_summary(result, study.exact(), folder.path());
}

}  // namespace raytube
