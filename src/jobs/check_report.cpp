#include "jobs/check_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "case/data/names.h"
#include "case/resolved_case.h"
#include "case/target.h"
#include "core/decimal.h"
#include "core/json.h"
#include "jobs/check_cost.h"
#include "jobs/inputs.h"
#include "jobs/material_report.h"
#include "jobs/solvable.h"
#include "jobs/warnings/warnings.h"
#include "mesh/features/symmetry.h"
#include "mesh/smooth/pieces.h"
#include "output/tables/sampled_rows.h"
#include "plan/material_edges.h"
#include "scene/sampling.h"
#include "scene/skipped.h"
#include "solve/image.h"
#include "solve/mechanisms/list.h"
#include "solve/probe.h"

namespace raytube {

namespace {

// Looks are timed for so long, and the first ones given up after so long [s].
constexpr double probe_seconds = 1.5, probe_patience = 2.0;
constexpr std::size_t most_lines = 10;

std::string values_text(const std::vector<double>& values) {
  if (values.size() == 1) return number_text(values.front());
  return fmt::format("{} values from {} to {}", values.size(), number_text(values.front()), number_text(values.back()));
}

std::string looks_text(const Case& c) {
  const LookChoice& l = c.looks;
  const std::string count = fmt::format("{} {}", c.sweep.looks.size(), c.sweep.bistatic ? "bistatic" : "monostatic");
  if (!c.radar.positions.empty()) return count + ", from the positions in [radar]";
  if (!l.looks_csv.empty()) return count + ", listed in " + l.looks_csv;
  const std::string transmit =
      fmt::format("{}: theta {} deg, phi {} deg", count, values_text(l.theta_deg), values_text(l.phi_deg));
  if (!c.sweep.bistatic) return transmit;
  return transmit + fmt::format("; receive theta {} deg, phi {} deg", values_text(l.rx_theta_deg), values_text(l.rx_phi_deg));
}

double highest_frequency(const Sweep& sweep) { return std::ranges::max(sweep.frequencies); }

const char* mode_text(const TubeOptions& tubes) {
  if (tubes.mode == TubeMode::uniform) return "uniform";
  return tubes.clip ? "adaptive, cut exactly at edges" : "adaptive, cut at the cells of the grid";
}

void tell_antennas(CheckReport& report, const Case& c) {
  const RadarChoice& radar = c.radar;
  if (c.sweep.looks.front().far()) return;
  if (radar.positions.empty())
    report.print("antennas     {} m from the mesh's origin, the receiver {} m; S is the apparent amplitude\n", radar.range_m,
                 radar.receive_range_m);
  if (!radar.turntable_deg.empty())
    report.print("             they stand, the target turns: {} deg\n", values_text(radar.turntable_deg));
  const std::string beam = radar.beamwidth_deg.empty() ? "" : fmt::format("beams of {} deg", values_text(radar.beamwidth_deg));
  if (!beam.empty() || !radar.pattern_csv.empty())
    report.print("             {}{}{}\n", beam, beam.empty() || radar.pattern_csv.empty() ? "" : ", ", radar.pattern_csv);
}

double densest(const TubeOptions& tubes) { return tubes.refines() ? tubes.max_per_wavelength : tubes.per_wavelength; }

// A target deeper than that is warned of.
void tell_range_profile(CheckReport& report, const std::vector<double>& frequencies) {
  if (frequencies.size() < 4 || !in_even_steps(frequencies)) return;
  const double step = frequencies[1] - frequencies[0], count = static_cast<double>(frequencies.size());
  report.print("             in steps of {:.4g} GHz: a range profile resolves {:.3g} m and repeats after {:.3g} m\n", step / 1e9,
               speed_of_light / (2.0 * step * count), speed_of_light / (2.0 * step));
}

void tell_request(CheckReport& report, const Case& c) {
  std::vector<double> ghz;
  for (const double hertz : c.sweep.frequencies) ghz.push_back(hertz / 1e9);
  report.print("case         {}\n", c.file.string());
  report.print("title        {}\n", c.title);
  report.print("mesh         {}, one unit is {} m ({}){}\n", mesh_names(c), c.metres_per_unit, c.unit,
               c.sweep.materials.empty() ? ", perfect conductor" : "");
  report.print("frequency    {} GHz\n", values_text(ghz));
  tell_range_profile(report, c.sweep.frequencies);
  report.print("looks        {}\n", looks_text(c));
  tell_antennas(report, c);
  if (c.ground)
    report.print(
        "ground       at z = {} m, {}\n", c.ground->height,
        c.ground->perfect() ? "perfect conductor: target and mirror image together" : c.ground->material->name + ": four paths");
  if (c.edges.method == EdgeMethod::utd)
    report.print("tubes        none: rays instead (edges.method \"utd\"), at most {} reflections\n", c.tubes.max_bounces);
  else
    report.print("tubes        {}, {} per wavelength at {} GHz, at most {} bounces\n", mode_text(c.tubes), densest(c.tubes),
                 number_text(highest_frequency(c.sweep) / 1e9), c.tubes.max_bounces);
  if (c.tubes.up) report.print("             grid rows follow ({}, {}, {})\n", c.tubes.up->x, c.tubes.up->y, c.tubes.up->z);
  if (c.edges.method == EdgeMethod::none)
    report.print("edges        none\n");
  else if (c.edges.method == EdgeMethod::fringe)
    report.print("edges        fringe currents, order {}, creases of {} deg and more\n", c.edges.order,
                 decimal_degrees(c.wedges.min_wedge_angle));
  if (c.edges.method == EdgeMethod::fringe && c.edges.transition != TransitionTier::exact)
    report.print("             transition function {}{}\n", transition_name(c.edges.transition),
                 c.edges.order == 1 ? ", which has no effect at order 1" : "");
  report.print("plots        {}\n", c.plots ? "yes" : "no");
  if (!c.image_looks.empty())
    report.print("images       look {}: {} cells per wavelength at {} GHz\n", fmt::join(c.image_looks, ", "),
                 c.image_per_wavelength, number_text(c.sweep.frequencies[image_frequency(c.sweep)] / 1e9));
  report.print("rows         {}\n", c.sweep.rows());
  report.data["case"] = parsed_json(resolved_case_json(c)).value_or(JsonValue());
  report.data["looks"] = c.sweep.looks.size();
  report.data["frequencies"] = c.sweep.frequencies.size();
  report.data["rows"] = c.sweep.rows();
}

const char* state_text(const Component& component) {
  if (component.penetrable) return "closed, but partly of sheets: seen from both sides";
  return component.closed ? "closed" : "open";
}

void tell_components(CheckReport& report, const std::vector<Component>& components) {
  for (std::size_t i = 0; i < std::min(components.size(), most_lines); ++i)
    report.print("  component {}: {}, {} triangles\n", i, state_text(components[i]), components[i].triangles);
  if (components.size() > most_lines) report.print("  and {} more components\n", components.size() - most_lines);
}

void tell_shape(CheckReport& report, const Target& target) {
  if (target.convexity.no_reflection) report.print("  {}\n", target.convexity.no_shadow ? "convex body" : nothing_in_front);
  const std::array<bool, 3> mirrors = find_symmetry_planes(target.mesh, target.wedges);
  for (int axis = 0; axis < 3; ++axis)
    if (mirrors[axis]) report.print("  its own mirror image across {} = {:.6g} m\n", "xyz"[axis], target.mesh.center[axis]);
}

JsonValue vector_json(const dvec3& v) { return std::vector<double>{v.x, v.y, v.z}; }

JsonValue mesh_json(const MeshReport& counts, const Target& target) {
  JsonValue json;
  for (const auto& [name, value] : mesh_counts(counts)) json[name] = count_or_length(value);
  for (const MeshNote& note : counts.notes()) json["notes"].append({{"what", note.what}, {"count", note.count}});
  json["center_m"] = vector_json(target.mesh.center);
  json["radius_m"] = target.mesh.radius;
  json["convex"] = target.convexity.no_reflection && target.convexity.no_shadow;
  return json;
}

void tell_mesh(CheckReport& report, const MeshReport& counts, const Target& target) {
  const TriangleMesh& mesh = target.mesh;
  report.print("\nmesh report\n  {} facets read, {} triangles traced, {} vertices\n", counts.facets_read, counts.triangles_traced,
               mesh.vertices.size());
  for (const MeshNote& note : counts.notes()) report.print("  {}: {}\n", note.what, note.count);
  report.print("  centre ({:.6g}, {:.6g}, {:.6g}) m, radius {:.6g} m\n", mesh.center.x, mesh.center.y, mesh.center.z,
               mesh.radius);
  report.print("  planar patches: {}\n  components: {}\n", mesh.patches.size(), mesh.components.size());
  report.data["mesh"] = mesh_json(counts, target);
  tell_components(report, mesh.components);
  tell_shape(report, target);
}

struct WedgeClass {
  double n = 0.0;
  std::uint64_t count = 0;
  double length = 0.0;
};

// Classes of equal exterior angle, the longest in total first.
std::vector<WedgeClass> wedge_classes(const std::vector<Wedge>& wedges) {
  std::map<long, WedgeClass> by_angle;
  for (const Wedge& wedge : wedges) {
    WedgeClass& found = by_angle[std::lround(wedge.n * 1000.0)];
    found.n = wedge.n;
    ++found.count;
    found.length += wedge.length();
  }
  std::vector<WedgeClass> classes;
  for (const auto& [key, found] : by_angle) classes.push_back(found);
  std::stable_sort(classes.begin(), classes.end(), [](const auto& a, const auto& b) { return a.length > b.length; });
  return classes;
}

std::string why_nothing(const Case& c) {
  if (c.edges.materials == MaterialEdgeMethod::none) return "edges.materials = \"none\"";
  return "their currents are not known, as of sheets of k d |n| above 4";
}

void tell_material_edges(CheckReport& report, const Case& c, const std::vector<Wedge>& wedges) {
  if (c.edges.method != EdgeMethod::fringe) return;
  const auto [all, of_solids, known] = count_material_edges(wedges, c.sweep.materials, c.sweep.frequencies);
  const std::size_t computed = c.edges.materials == MaterialEdgeMethod::none ? 0 : known;
  if (computed > 0) report.print("  {} with a face that is not a perfect conductor have edge currents of their own\n", computed);
  if (of_solids > 0) report.print("  {} of solids add nothing\n", of_solids);
  if (const std::size_t others = all - of_solids - computed; others > 0)
    report.print("  {} with a face that is not a perfect conductor add nothing ({})\n", others, why_nothing(c));
}

JsonValue wedges_json(const std::vector<WedgeClass>& classes, double length) {
  JsonValue json;
  std::uint64_t count = 0;
  for (const WedgeClass& found : classes) {
    json["classes"].append(
        {{"n", found.n}, {"interior_deg", 180.0 * (2.0 - found.n)}, {"count", found.count}, {"length_m", found.length}});
    count += found.count;
  }
  json["count"] = count;
  json["length_m"] = length;
  return json;
}

void tell_wedges(CheckReport& report, const std::vector<Wedge>& wedges) {
  double length = 0.0;
  for (const Wedge& wedge : wedges) length += wedge.length();
  report.print("\nwedges\n  {} wedges, {:.6g} m in all\n", wedges.size(), length);
  const std::vector<WedgeClass> classes = wedge_classes(wedges);
  report.data["wedges"] = wedges_json(classes, length);
  for (std::size_t i = 0; i < std::min(classes.size(), most_lines); ++i)
    report.print("  n = {:.3f} (interior {:.1f} deg): {} wedges, {:.6g} m\n", classes[i].n, 180.0 * (2.0 - classes[i].n),
                 classes[i].count, classes[i].length);
  if (classes.size() > most_lines) report.print("  and {} more angles\n", classes.size() - most_lines);
}

// Which facets tubes see as the surfaces they stand for, piece by piece.
void tell_curved_surfaces(CheckReport& report, const SolvePlan& plan) {
  const TriangleMesh& mesh = plan.target.mesh;
  const double max_crease = plan.target.options.min_wedge_angle;
  const SmoothSurfaces surfaces =
      plan.known_surfaces ? SmoothSurfaces(*plan.known_surfaces, max_crease) : SmoothSurfaces(mesh, max_crease);
  const std::vector<SmoothPiece> pieces = smooth_pieces(mesh, surfaces);
  const std::size_t all = mesh.triangles.size();
  std::size_t taken = 0;
  for (const BandPlan& band : plan.bands) taken = std::max(taken, band.smooth ? band.smooth->facets() : 0);
  const char* counts_as = taken == 0 ? "flat" : taken == surfaces.facets() ? "curved" : "curved and flat";
  report.data["curved_surfaces"] = {{"facets", surfaces.facets()}, {"pieces", pieces.size()}, {"counts_as", counts_as}};
  report.print("\ncurved surfaces\n");
  if (pieces.empty()) return report.print("  none: all {} facets are flat\n", all);
  report.print("  {} of {} facets stand for curved surfaces and count as {}{}\n", surfaces.facets(), all, counts_as,
               taken < surfaces.facets() ? " (tubes.curved)" : "");
  for (std::size_t i = 0; i < std::min(pieces.size(), most_lines); ++i)
    report.print("  piece of {} facets: the surface rises above them by up to {:.3g} wavelengths\n", pieces[i].facets,
                 pieces[i].rise / plan.shortest_wavelength());
  if (pieces.size() > most_lines) report.print("  and {} smaller pieces\n", pieces.size() - most_lines);
}

// What takes part in looks in which it can change the answer, or why it does not.
void tell_mechanisms(CheckReport& report, const SolvePlan& plan) {
  report.print("\nmechanisms beside the tubes\n");
  for (const MechanismEntry& entry : mechanism_list()) {
    const MechanismState state = entry.state(plan);
    const std::string what = state.what.empty() ? "" : ": " + state.what;
    const std::string how = state.forced ? "on" : "auto, " + state.when;
    report.print("  {:<28}{}\n", entry.name, state.on ? how + what : "off: " + state.why_not);
    report.data["mechanisms"].append(
        {{"name", entry.name}, {"key", entry.key}, {"on", state.on}, {"forced", state.forced}, {"why_not", state.why_not}});
  }
}

void tell_thin_plate_edges(CheckReport& report, const Case& c, std::span<const ThinPlateEdge> rims) {
  const auto [lowest, highest] = std::ranges::minmax(c.sweep.frequencies);
  if (c.edges.method != EdgeMethod::fringe || count_thin(rims, lowest) == 0) return;
  const auto print = [&](double frequency) {
    report.print("  {} half planes at {} GHz: edges of plates thinner than {:.4g} mm, a tenth of the wavelength\n",
                 count_thin(rims, frequency), number_text(frequency / 1e9), thin_limit(frequency) * 1e3);
  };
  print(lowest);
  if (highest > lowest) print(highest);
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

void tell_skipped(CheckReport& report, const MeshReport& r, const SolvePlan& plan) {
  std::vector<Skipped> skipped = {{"curves and surfaces", "of free form: only polygons are read", r.free_forms_read},
                                  {"facets", "fewer than three distinct corners", r.facets_unusable},
                                  {"triangles", "no area", r.triangles_degenerate},
                                  {"triangles", "same corners as another one", r.triangles_duplicate},
                                  {"triangles", "inside, where two closed bodies touch", r.triangles_internal}};
  std::ranges::copy(plan.skipped_wedges, std::back_inserter(skipped));
  for (const MechanismEntry& entry : mechanism_list()) {
    const MechanismState state = entry.state(plan);
    if (state.missed) skipped.push_back({fmt::format("looks without {}", entry.name), state.why_not, plan.sweep.looks.size()});
    std::ranges::copy(state.skipped, std::back_inserter(skipped));
  }
  std::ranges::copy(skipped_items(plan.skips), std::back_inserter(skipped));
  std::vector<std::string> lines;
  for (const Skipped& s : skipped)
    if (s.count) lines.push_back(fmt::format("{} {}: {}", s.count, s.what, s.why));
  std::ranges::copy(skipped_as_found(plan), std::back_inserter(lines));
  if (lines.empty()) lines.emplace_back("nothing");
  report.print("\nskipped\n");
  for (const std::string& line : lines) report.print("  {}\n", line);
  report.data["skipped"] = lines;
}

void tell_warnings(CheckReport& report, const Case& c, const MeshReport& counts, const SolvePlan& plan) {
  std::vector<std::string> sentences = warnings_of(c, plan, outermost_points(plan.target.mesh.vertices));
  std::ranges::copy(reading_sentences(c, counts), std::back_inserter(sentences));
  report.print("\nwarnings\n");
  for (const std::string& sentence : sentences) report.print("  {}\n", sentence);
  if (sentences.empty()) report.print("  none\n");
  report.data["warnings"] = sentences;
}

}  // namespace

std::string seconds_text(double seconds) {
  if (seconds < 120.0) return fmt::format("{:.2g} s", seconds);
  if (seconds < 7200.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.3g} h", seconds / 3600.0);
}

void tell_case(CheckReport& report, const Case& c, const MeshReport& counts, const SolvePlan& plan) {
  const Target& target = plan.target;
  tell_request(report, c);
  tell_mesh(report, counts, target);
  report.print("{}", materials_text(c, target));
  tell_wedges(report, target.wedges);
  tell_material_edges(report, c, target.wedges);
  tell_thin_plate_edges(report, c, plan.thin_plate_edges);
  tell_curved_surfaces(report, plan);
  tell_mechanisms(report, plan);
  tell_skipped(report, counts, plan);
  tell_warnings(report, c, counts, plan);
  tell_cost(report, plan);
  tell_memory(report, plan, c);
}

TimePrediction tell_time(CheckReport& report, const SolvePlan& plan) {
  const TimePrediction time = predict_time(plan, probe_seconds, probe_patience);
  report.data["time"] = {{"solve_s", time.solve_s},
                         {"look_s", time.look_s},
                         {"looks_tried", time.looks},
                         {"at_most", time.at_most},
                         {"threads", plan.threads}};
  const std::string threads = fmt::format("{} thread{}", plan.threads, plan.threads == 1 ? "" : "s");
  if (time.at_most)
    report.print(
        "\ntime\n  at most about {} on {}, and at least {}: no look was finished in {:.0f} s, each takes at most about {}\n",
        seconds_text(time.solve_s), threads, seconds_text(time.least_s), probe_patience, seconds_text(time.look_s));
  else
    report.print("\ntime\n  about {} on {}, about {} a look ({} tried)\n", seconds_text(time.solve_s), threads,
                 seconds_text(time.look_s), time.looks);
  return time;
}

}  // namespace raytube
