#include "jobs/check_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "case/data/names.h"
#include "case/resolved_case.h"
#include "case/target.h"
#include "core/decimal.h"
#include "jobs/inputs.h"
#include "jobs/material_report.h"
#include "jobs/retrace.h"
#include "mesh/features/symmetry.h"
#include "mesh/smooth/pieces.h"
#include "output/words/plural.h"
#include "output/words/summary.h"
#include "plan/material_edges.h"
#include "sbr/launch/launch.h"
#include "sbr/sbr.h"
#include "scene/sampling.h"
#include "solve/image.h"

namespace raytube {

namespace {

// Looks are timed for so long, and the first ones given up after so long [s].
constexpr double probe_seconds = 1.5, probe_patience = 2.0;

Json vector_json(const dvec3& v) { return Json::array({v.x, v.y, v.z}); }

const char* state_text(const Component& component) {
  if (component.penetrable) return "closed, but partly made of sheets: seen from both sides";
  return component.closed ? "closed" : "open";
}

Json components_json(const std::vector<Component>& components) {
  Json json = Json::array();
  for (const Component& component : components)
    json.push_back({{"state", state_text(component)}, {"triangles", component.triangles}});
  return json;
}

// Of the shape: whether any face can see another one, and its mirror planes.
Json shape_json(const Target& target) {
  Json json = Json::array();
  if (target.convexity.no_reflection) json.push_back(target.convexity.no_shadow ? "convex body" : nothing_in_front);
  const std::array<bool, 3> mirrors = find_symmetry_planes(target.mesh, target.wedges);
  for (int axis = 0; axis < 3; ++axis)
    if (mirrors[axis])
      json.push_back(fmt::format("symmetric about the plane {} = {:.6g} m", "xyz"[axis], target.mesh.center[axis]));
  return json;
}

Json mesh_json(const MeshReport& counts, const Target& target, double wavelength) {
  const TriangleMesh& mesh = target.mesh;
  const dvec3 size = size_of(mesh.vertices);
  Json json = {{"size_m", vector_json(size)}, {"size_wavelengths", vector_json(size / wavelength)}};
  for (const auto& [name, value] : mesh_counts(counts)) json[name] = count_or_length(value);
  for (const MeshNote& note : counts.notes()) json["notes"].push_back({{"what", note.what}, {"count", note.count}});
  json["vertices"] = mesh.vertices.size();
  json["center_m"] = vector_json(mesh.center);
  json["radius_m"] = mesh.radius;
  json["convex"] = target.convexity.no_reflection && target.convexity.no_shadow;
  json["bodies"] = components_json(mesh.components);
  json["shape"] = shape_json(target);
  return json;
}

// Classes of equal exterior angle, the longest in total first.
std::vector<Json> wedge_classes(const std::vector<Wedge>& wedges) {
  struct Class {
    double n = 0.0, length = 0.0;
    std::uint64_t count = 0;
  };
  std::map<long, Class> by_angle;
  for (const Wedge& wedge : wedges) {
    Class& found = by_angle[std::lround(wedge.n * 1000.0)];
    found = {wedge.n, found.length + wedge.length(), found.count + 1};
  }
  std::vector<Json> classes;
  for (const auto& [key, found] : by_angle)
    classes.push_back(
        {{"n", found.n}, {"interior_deg", 180.0 * (2.0 - found.n)}, {"count", found.count}, {"length_m", found.length}});
  std::ranges::stable_sort(classes, std::greater(), [](const Json& each) { return each["length_m"].get<double>(); });
  return classes;
}

std::vector<std::string> material_edge_lines(const SolvePlan& plan) {
  std::vector<std::string> lines;
  if (!plan.fringe()) return lines;
  const MaterialEdgeCount count = count_material_edges(plan.target, plan.sweep, plan.edges);
  if (count.computed > 0)
    lines.push_back(
        fmt::format("{} with a face that is not a perfect conductor have edge currents of their own", count.computed));
  if (count.of_solids > 0) lines.push_back(fmt::format("{} of solids add nothing", count.of_solids));
  if (const std::size_t others = count.all - count.of_solids - count.computed; others > 0)
    lines.push_back(fmt::format("{} with a face that is not a perfect conductor add nothing ({})", others,
                                plan.edges.materials == MaterialEdgeMethod::none
                                    ? "edges.materials = \"none\""
                                    : "their currents are unknown, for example those of sheets with k d |n| above 4"));
  return lines;
}

std::vector<std::string> thin_plate_lines(const SolvePlan& plan) {
  const std::vector<ThinPlateEdge>& rims = plan.thin_plate_edges;
  std::vector<std::string> lines;
  const auto [lowest, highest] = std::ranges::minmax(plan.sweep.frequencies);
  if (!plan.fringe() || count_thin(rims, lowest) == 0) return lines;
  const auto add = [&](double frequency) {
    lines.push_back(fmt::format("{} at {} GHz: edges of plates thinner than {:.4g} mm, a tenth of the wavelength",
                                count_text(count_thin(rims, frequency), "half plane"), number_text(frequency / 1e9),
                                thin_limit(frequency) * 1e3));
  };
  add(lowest);
  if (highest > lowest) add(highest);
  return lines;
}

Json wedges_json(const SolvePlan& plan) {
  const std::vector<Wedge>& wedges = plan.target.wedges;
  double length = 0.0;
  for (const Wedge& wedge : wedges) length += wedge.length();
  std::vector<std::string> notes = material_edge_lines(plan);
  std::ranges::copy(thin_plate_lines(plan), std::back_inserter(notes));
  return {{"count", wedges.size()}, {"length_m", length}, {"classes", wedge_classes(wedges)}, {"notes", notes}};
}

// Which facets tubes see as the surfaces they stand for, piece by piece.
Json curved_surfaces_json(const SolvePlan& plan) {
  const TriangleMesh& mesh = plan.target.mesh;
  const double max_crease = plan.target.options.min_wedge_angle;
  const SmoothSurfaces surfaces =
      plan.known_surfaces ? SmoothSurfaces(*plan.known_surfaces, max_crease) : SmoothSurfaces(mesh, max_crease);
  std::size_t taken = 0;
  for (const BandPlan& band : plan.bands) taken = std::max(taken, band.smooth ? band.smooth->facets() : 0);
  const char* counts_as = taken == 0 ? "flat" : taken == surfaces.facets() ? "curved" : "curved and flat";
  Json list = Json::array();
  for (const SmoothPiece& piece : smooth_pieces(mesh, surfaces))
    list.push_back({{"facets", piece.facets}, {"rise_wavelengths", piece.rise / plan.shortest_wavelength()}});
  return {{"facets", surfaces.facets()}, {"facets_of_all", mesh.triangles.size()},
          {"pieces", list.size()},       {"counts_as", counts_as},
          {"facets_curved", taken},      {"list", list}};
}

// What takes part in looks in which it can change the answer, or why it does not.
Json mechanisms_json(const SolvePlan& plan) {
  Json json = Json::array();
  for (std::size_t i = 0; i < plan.mechanisms.size(); ++i) {
    const MechanismEntry& entry = plan.mechanisms[i];
    const MechanismState& state = plan.states[i];
    json.push_back({{"name", entry.name},
                    {"label", entry.label},
                    {"key", entry.key},
                    {"on", state.on},
                    {"forced", state.forced},
                    {"when", state.when},
                    {"what", state.what},
                    {"why_not", state.why_not}});
  }
  return json;
}

// What only the run itself can count.
std::vector<std::string> skipped_as_found(const SolvePlan& plan) {
  const Target& target = plan.target;
  if (plan.rays()) return {"all currents: edges.method is \"utd\", geometrical optics and diffracted rays alone"};
  std::vector<std::string> lines;
  if (plan.tubes.mode == TubeMode::adaptive && std::ranges::any_of(target.mesh.components, &Component::closed))
    lines.emplace_back("in every look: faces of closed bodies turned away from the transmitter");
  if (!plan.tubes.skip) return lines;
  if (plan.tubes.mode == TubeMode::uniform) lines.emplace_back("in every look: empty cells of the grid");
  if (target.convexity.no_reflection) lines.push_back(fmt::format("all reflected tubes: {}", nothing_in_front));
  if (plan.fringe() && std::ranges::any_of(target.wedges, &Wedge::stands_alone))
    lines.emplace_back("in every look: edges that are not lit");
  return lines;
}

std::vector<std::string> skipped_lines(const MeshReport& r, const SolvePlan& plan) {
  std::vector<Skipped> skipped = {{"free-form curves and surfaces", "only polygons are read", r.free_forms_read},
                                  {"facets", "fewer than three distinct corners", r.facets_unusable},
                                  {"triangles", "no area", r.triangles_degenerate},
                                  {"triangles", "same corners as another one", r.triangles_duplicate},
                                  {"triangles", "inside, where two closed bodies touch", r.triangles_internal}};
  std::ranges::copy(plan.skipped_wedges, std::back_inserter(skipped));
  for (std::size_t i = 0; i < plan.mechanisms.size(); ++i) {
    const MechanismState& state = plan.states[i];
    if (state.missed)
      skipped.push_back({fmt::format("looks without {}", plan.mechanisms[i].label), state.why_not, plan.sweep.looks.size()});
    std::ranges::copy(state.skipped, std::back_inserter(skipped));
  }
  std::ranges::copy(plan.skips, std::back_inserter(skipped));
  std::vector<std::string> lines;
  for (const Skipped& s : skipped)
    if (s.count) lines.push_back(fmt::format("{} {}: {}", s.count, s.what, reason_of(s)));
  std::ranges::copy(skipped_as_found(plan), std::back_inserter(lines));
  if (lines.empty()) lines.emplace_back("nothing");
  return lines;
}

std::vector<std::string> warnings_json(const Case& c, const MeshReport& counts, const SolvePlan& plan,
                                       const MovingTarget* moving) {
  const std::vector<dvec3> outermost = outermost_points(plan.target.mesh.vertices);
  std::vector<std::string> sentences = warnings_before(c, plan, outermost, moving);
  std::ranges::copy(reading_sentences(c, counts), std::back_inserter(sentences));
  return sentences;
}

// Of the first look; none for rays and for adaptive tubes, whose number depends on the surfaces alone.
Json launch_grid_json(const SolvePlan& plan) {
  if (plan.rays() || plan.tubes.refines()) return nullptr;
  const LaunchGrid grid =
      grid_of_look(plan.target.mesh, plan.sweep.looks[0], plan.shortest_wavelength(), plan.tubes.per_wavelength, plan.tubes.up);
  return {{"columns", grid.columns}, {"rows", grid.rows}, {"du_m", grid.du}, {"dv_m", grid.dv}};
}

Json memory_json(const SolvePlan& plan, const Case& c) {
  SolvePlan with_parts = plan;
  with_parts.keep_parts = true;
  Json json = {{"with_parts_bytes", memory_of_run(with_parts, c).leader}, {"available_bytes", memory_to_be_had()}};
  if (std::ranges::any_of(c.sweep.materials, &Material::transmits))
    json["between_sheets_bytes"] = plan.threads * tubes_between_sheets_bytes(c.sweep.frequencies.size());
  return json;
}

// A look begun last ends up to one look after all others.
double seconds_of_ranks(const SolvePlan& plan, const TimePrediction& time, int ranks) {
  const double threads = static_cast<double>(ranks) * plan.threads, looks = static_cast<double>(plan.looks.computed.size());
  const double setup = std::max(0.0, time.solve_s - time.look_s * looks / plan.threads);
  return setup + time.look_s * std::max(1.0, looks / threads + 0.5 * (1.0 - 1.0 / threads));
}

}  // namespace

std::size_t plans_of(const Case& c, const MovingTarget* moving) {
  return moving && !is_one_plan(c, *moving) ? computed_case(c, *moving).times() : 1;
}

Json check_data(const Case& c, const MeshReport& counts, const SolvePlan& plan, const MovingTarget* moving, std::size_t plans) {
  Json data;
  data["case_file"] = c.file.string();
  data["case"] = resolved_case(c);
  data["metres_per_unit"] = c.metres_per_unit;
  data["bistatic"] = c.sweep.bistatic;
  data["looks"] = c.sweep.looks.size();
  data["frequencies"] = c.sweep.frequencies.size();
  data["rows"] = c.sweep.rows();
  if (!c.image_looks.empty()) data["image_ghz"] = c.sweep.frequencies[image_frequency(c.sweep)] / 1e9;
  data["mesh"] = mesh_json(counts, plan.target, plan.shortest_wavelength());
  data["materials"] = material_lines(c, plan.target);
  data["wedges"] = wedges_json(plan);
  data["curved_surfaces"] = curved_surfaces_json(plan);
  data["mechanisms"] = mechanisms_json(plan);
  data["skipped"] = skipped_lines(counts, plan);
  data["warnings"] = warnings_json(c, counts, plan, moving);
  data["looks_computed"] = plan.looks.computed.size() * plans;
  data["launch_grid"] = launch_grid_json(plan);
  if (plan.rays()) data["ray_range_m"] = plan.ray_range;
  data["memory_bytes"] = memory_of_run(plan, c).leader;
  data["memory"] = memory_json(plan, c);
  return data;
}

TimePrediction predicted_time(const SolvePlan& plan, std::size_t plans) {
  TimePrediction time = predict_time(plan, probe_seconds, probe_patience);
  time.solve_s *= static_cast<double>(plans), time.least_s *= static_cast<double>(plans);
  return time;
}

Json time_data(const SolvePlan& plan, const TimePrediction& time) {
  return {{"time",
           {{"solve_s", time.solve_s},
            {"least_s", time.least_s},
            {"look_s", time.look_s},
            {"looks_tried", time.looks},
            {"at_most", time.at_most},
            {"given_up_after_s", probe_patience},
            {"threads", plan.threads}}}};
}

Json ranks_data(const SolvePlan& plan, const MemoryOfRun& memory, const TimePrediction& time, int ranks) {
  return {{"ranks",
           {{"count", ranks},
            {"threads", plan.threads},
            {"looks", plan.looks.computed.size()},
            {"solve_s", seconds_of_ranks(plan, time, ranks)},
            {"at_most", time.at_most},
            {"leader_memory_bytes", memory.leader},
            {"memory_bytes", memory.helper}}}};
}

}  // namespace raytube
