#include "point_source/source_tracing.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/error.h"
#include "jobs/memory.h"
#include "mesh/load.h"
#include "point_source/launch_limit.h"

namespace raytube {

namespace {

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

}  // namespace

SourceTracing::SourceTracing(const SourceCase& c, int threads)
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

void SourceTracing::solve(const std::function<bool(double)>& progress) {
  progress_ = progress;
  for (std::size_t position = 0; position < case_.points.size(); ++position) {
    const std::vector<VisiblePiece> seen = seen_from({site(position).source, {}});
    for (const LaunchModel model : case_.models) run_model(position, model, seen);
  }
}

void SourceTracing::check_memory() const {
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

LaunchSite SourceTracing::site(std::size_t position) const {
  const TriangleMesh& mesh = joined_.mesh;
  return {&mesh, box_, case_.points[position] - mesh.center, case_.wall, weld_fraction * box_.diagonal()};
}

void SourceTracing::require_free(std::size_t position) const {
  const LaunchSite at = site(position);
  for (std::uint32_t t = 0; t < joined_.mesh.triangles.size(); ++t)
    if (lies_on(joined_.mesh, t, at.source, at.tolerance))
      throw InputError(fmt::format("{}: source.point_m {} lies on the surface of part \"{}\"; move it off", case_.file.string(),
                                   position + 1, case_.parts[joined_.triangle_part[t]].name));
}

Launch SourceTracing::launch(std::size_t position, LaunchModel model, std::uint64_t rays) const {
  try {
    return Launch(model, site(position), rays, case_.seed);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", case_.file.string(), error.what()));
  }
}

std::vector<VisiblePiece> SourceTracing::seen_from(const Eye& eye) const {
  return exact() ? visible_pieces(joined_.mesh, eye) : std::vector<VisiblePiece>();
}

void SourceTracing::run_model(std::size_t position, LaunchModel model, const std::vector<VisiblePiece>& seen) {
  const bool shown = position == 0;
  if (shown) study_.views.push_back({model, 0, 0, {}, {}});
  for (const std::uint64_t asked : case_.rays) {
    const auto begin = std::chrono::steady_clock::now();
    const Launch rays = launch(position, model, asked);
    RayHits hits = trace_rays(tracer_, joined_.triangle_part, surfaces_, rays, options(shown && asked == case_.rays.back()));
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    SourceRun run{position, case_.points[position], model, asked, rays.rays(), hits.escaped, hits.absorbed, hits.cut, hits.missed,
                  seconds,  std::move(hits.parts)};
    if (exact()) add_exact(rays, seen, run);
    study_.runs.push_back(std::move(run));
    if (shown) show(rays, asked, std::move(hits.hits));
    ++finished_;
  }
}

void SourceTracing::show(const Launch& rays, std::uint64_t asked, std::vector<CountedHit> hits) {
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

double SourceTracing::sampled_hits_per_ray(LaunchModel model) const {
  const Launch sample = launch(0, model, std::min(sampled_rays, case_.rays.back()));
  const HitOptions keep{case_.max_reflections, case_.counted, true, threads_, {}};
  const RayHits found = trace_rays(tracer_, joined_.triangle_part, surfaces_, sample, keep);
  return static_cast<double>(found.hits.size()) / static_cast<double>(sample.rays());
}

HitOptions SourceTracing::options(bool keep) const {
  const double runs = static_cast<double>(case_.points.size() * case_.models.size() * case_.rays.size());
  const double before = static_cast<double>(finished_) / runs;
  const auto overall = [this, before, runs](double share) { return progress_(before + share / runs); };
  return {case_.max_reflections, case_.counted, keep, threads_, overall};
}

void SourceTracing::add_exact(const Launch& rays, const std::vector<VisiblePiece>& seen, SourceRun& run) {
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

}  // namespace raytube
