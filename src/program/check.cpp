// raytube check: what a run would do, without doing it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "case/data/names.h"
#include "case/read_case.h"
#include "case/target.h"
#include "core/decimal.h"
#include "core/threads.h"
#include "mesh/features/symmetry.h"
#include "mesh/smooth/pieces.h"
#include "output/tables/sampled_rows.h"
#include "program/commands.h"
#include "program/material_report.h"
#include "program/memory.h"
#include "program/solvable.h"
#include "program/warnings/warnings.h"
#include "program/wedge_list.h"
#include "sbr/launch/launch.h"
#include "sbr/sbr.h"
#include "scene/sampling.h"
#include "scene/skipped.h"
#include "solve/image.h"
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
  if (!c.radar.positions.empty()) return count + ", from the places in [radar]";
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

void print_antennas(const Case& c) {
  const RadarChoice& radar = c.radar;
  if (c.sweep.looks.front().far()) return;
  if (radar.positions.empty())
    fmt::print("antennas     {} m from the mesh's origin, the receiver {} m; S is the apparent amplitude\n", radar.range_m,
               radar.receive_range_m);
  const std::string beam = radar.beamwidth_deg.empty() ? "" : fmt::format("beams of {} deg", values_text(radar.beamwidth_deg));
  if (!beam.empty() || !radar.pattern_csv.empty())
    fmt::print("             {}{}{}\n", beam, beam.empty() || radar.pattern_csv.empty() ? "" : ", ", radar.pattern_csv);
}

double densest(const TubeOptions& tubes) { return tubes.refines() ? tubes.max_per_wavelength : tubes.per_wavelength; }

// A target deeper than that is warned of.
void print_range_profile(const std::vector<double>& frequencies) {
  if (frequencies.size() < 4 || !in_even_steps(frequencies)) return;
  const double step = frequencies[1] - frequencies[0], count = static_cast<double>(frequencies.size());
  fmt::print("             in steps of {:.4g} GHz: a range profile resolves {:.3g} m and repeats after {:.3g} m\n", step / 1e9,
             speed_of_light / (2.0 * step * count), speed_of_light / (2.0 * step));
}

void print_case(const Case& c) {
  std::vector<double> ghz;
  for (const double hertz : c.sweep.frequencies) ghz.push_back(hertz / 1e9);
  fmt::print("case         {}\n", c.file.string());
  fmt::print("title        {}\n", c.title);
  fmt::print("mesh         {}, one unit is {} m ({}){}\n", mesh_names(c), c.metres_per_unit, c.unit,
             c.sweep.materials.empty() ? ", perfect conductor" : "");
  fmt::print("frequency    {} GHz\n", values_text(ghz));
  print_range_profile(c.sweep.frequencies);
  fmt::print("looks        {}\n", looks_text(c));
  print_antennas(c);
  if (c.edges.method == EdgeMethod::utd)
    fmt::print("tubes        none: rays in their place (edges.method \"utd\"), at most {} reflections\n", c.tubes.max_bounces);
  else
    fmt::print("tubes        {}, {} per wavelength at {} GHz, at most {} bounces\n", mode_text(c.tubes), densest(c.tubes),
               number_text(highest_frequency(c.sweep) / 1e9), c.tubes.max_bounces);
  if (c.tubes.up) fmt::print("             grid rows follow ({}, {}, {})\n", c.tubes.up->x, c.tubes.up->y, c.tubes.up->z);
  if (c.edges.method == EdgeMethod::none)
    fmt::print("edges        none\n");
  else if (c.edges.method == EdgeMethod::fringe)
    fmt::print("edges        fringe currents, order {}, creases of {} deg and more{}\n", c.edges.order,
               decimal_degrees(c.wedges.min_wedge_angle), c.edges.interaction.possible() ? "; waves between surfaces" : "");
  if (c.edges.method == EdgeMethod::fringe && c.edges.transition != TransitionTier::exact)
    fmt::print("             transition function {}{}\n", transition_name(c.edges.transition),
               c.edges.order == 1 ? ", which plays no part at order 1" : "");
  fmt::print("plots        {}\n", c.plots ? "yes" : "no");
  if (!c.image_looks.empty())
    fmt::print("images       look {}: {} cells per wavelength at {} GHz\n", fmt::join(c.image_looks, ", "),
               c.image_per_wavelength, number_text(c.sweep.frequencies[image_frequency(c.sweep)] / 1e9));
  fmt::print("rows         {}\n", c.sweep.rows());
}

const char* state_text(const Component& component) {
  if (component.penetrable) return "closed, but partly of sheets: seen from both sides";
  return component.closed ? "closed" : "open";
}

void print_components(const std::vector<Component>& components) {
  for (std::size_t i = 0; i < std::min(components.size(), most_lines); ++i)
    fmt::print("  component {}: {}, {} triangles\n", i, state_text(components[i]), components[i].triangles);
  if (components.size() > most_lines) fmt::print("  and {} more components\n", components.size() - most_lines);
}

void print_shape(const Target& target) {
  if (target.convexity.no_reflection) fmt::print("  {}\n", target.convexity.no_shadow ? "convex body" : nothing_in_front);
  const std::array<bool, 3> mirrors = find_symmetry_planes(target.mesh, target.wedges);
  for (int axis = 0; axis < 3; ++axis)
    if (mirrors[axis]) fmt::print("  its own mirror image across {} = {:.6g} m\n", "xyz"[axis], target.mesh.center[axis]);
}

void print_mesh(const MeshReport& report, const Target& target) {
  const TriangleMesh& mesh = target.mesh;
  fmt::print("\nmesh report\n  {} facets read, {} triangles traced, {} vertices\n", report.facets_read, report.triangles_traced,
             mesh.vertices.size());
  for (const MeshNote& note : report.notes()) fmt::print("  {}: {}\n", note.what, note.count);
  fmt::print("  centre ({:.6g}, {:.6g}, {:.6g}) m, radius {:.6g} m\n", mesh.center.x, mesh.center.y, mesh.center.z, mesh.radius);
  fmt::print("  planar patches: {}\n  components: {}\n", mesh.patches.size(), mesh.components.size());
  print_components(mesh.components);
  print_shape(target);
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

void print_material_edges(const EdgeOptions& edges, const std::vector<Wedge>& wedges) {
  const auto count = std::ranges::count_if(wedges, [](const Wedge& w) { return w.convex() && !w.conducting(); });
  if (count == 0 || edges.method != EdgeMethod::fringe) return;
  fmt::print("  {} with a face that is no perfect conductor {} (edges.materials = \"{}\")\n", count,
             edges.materials == MaterialEdgeMethod::none ? "add nothing" : "add their first order, by a heuristic",
             material_edge_name(edges.materials));
}

void print_wedges(const std::vector<Wedge>& wedges) {
  double length = 0.0;
  for (const Wedge& wedge : wedges) length += wedge.length();
  fmt::print("\nwedges\n  {} wedges, {:.6g} m in all\n", wedges.size(), length);
  const std::vector<WedgeClass> classes = wedge_classes(wedges);
  for (std::size_t i = 0; i < std::min(classes.size(), most_lines); ++i)
    fmt::print("  n = {:.3f} (interior {:.1f} deg): {} wedges, {:.6g} m\n", classes[i].n, 180.0 * (2.0 - classes[i].n),
               classes[i].count, classes[i].length);
  if (classes.size() > most_lines) fmt::print("  and {} more angles\n", classes.size() - most_lines);
}

// Which facets tubes see as the surfaces they stand for, piece by piece.
void print_curved_surfaces(const SolvePlan& plan) {
  const TriangleMesh& mesh = plan.target.mesh;
  const SmoothSurfaces surfaces(mesh, plan.target.options.min_wedge_angle);
  const std::vector<SmoothPiece> pieces = smooth_pieces(mesh, surfaces);
  const std::size_t all = mesh.triangles.size();
  fmt::print("\ncurved surfaces\n");
  if (pieces.empty()) return fmt::print("  none: all {} facets are flat\n", all);
  const char* how = plan.smooth ? "curved" : "flat (tubes.curved)";
  fmt::print("  {} of {} facets stand for curved surfaces and count as {}\n", surfaces.facets(), all, how);
  for (std::size_t i = 0; i < std::min(pieces.size(), most_lines); ++i)
    fmt::print("  piece of {} facets: the surface rises above them by up to {:.3g} wavelengths\n", pieces[i].facets,
               pieces[i].rise / plan.shortest_wavelength());
  if (pieces.size() > most_lines) fmt::print("  and {} smaller pieces\n", pieces.size() - most_lines);
}

std::string surface_waves_text(const SolvePlan& plan) {
  if (plan.surface_waves != SurfaceWaveState::computed) return fmt::format("none: {}", why_not(plan.surface_waves));
  const std::size_t facets = plan.wave_surfaces->conducting_facets(), others = plan.wave_surfaces->facets() - facets;
  return fmt::format("computed: over {} facets{}", facets,
                     others == 0 ? "" : fmt::format(", not over {} more that are no perfect conductors", others));
}

void print_surface_waves(const SolvePlan& plan) {
  fmt::print("\nwaves over curved surfaces\n  {}\n", surface_waves_text(plan));
  if (plan.wave_surfaces)
    fmt::print("  edges of curved surfaces: {:.4g} wavelengths at {} GHz, of at most {}\n",
               plan.wave_surfaces->boundary_length() / plan.shortest_wavelength(),
               number_text(highest_frequency(plan.sweep) / 1e9), longest_surface_edges);
}

void print_thin_plate_edges(const Case& c, std::span<const ThinPlateEdge> rims) {
  const auto [lowest, highest] = std::ranges::minmax(c.sweep.frequencies);
  if (c.edges.method != EdgeMethod::fringe || count_thin(rims, lowest) == 0) return;
  const auto print = [&](double frequency) {
    fmt::print("  {} half planes at {} GHz: edges of plates thinner than {:.4g} mm, a tenth of the wavelength\n",
               count_thin(rims, frequency), number_text(frequency / 1e9), thin_limit(frequency) * 1e3);
  };
  print(lowest);
  if (highest > lowest) print(highest);
}

// What only the run itself can count.
std::vector<std::string> skipped_as_found(const SolvePlan& plan) {
  const Target& target = plan.target;
  if (plan.mechanisms.rays) return {"all currents: edges.method is \"utd\", geometrical optics and diffracted rays alone"};
  std::vector<std::string> lines;
  if (plan.tubes.mode == TubeMode::adaptive && std::ranges::any_of(target.mesh.components, &Component::closed))
    lines.emplace_back("in every look: faces of closed bodies turned away from the transmitter");
  if (!plan.tubes.skip) return lines;
  if (plan.tubes.mode == TubeMode::uniform) lines.emplace_back("in every look: empty cells of the grid");
  if (target.convexity.no_reflection) lines.push_back(fmt::format("all reflected tubes: {}", nothing_in_front));
  if (plan.mechanisms.fringe && std::ranges::any_of(target.wedges, &Wedge::stands_alone))
    lines.emplace_back("in every look: edges that are not lit");
  return lines;
}

void print_skipped(const MeshReport& r, const SolvePlan& plan) {
  std::vector<Skipped> skipped = {{"curves and surfaces", "of free form: only polygons are read", r.free_forms_read},
                                  {"facets", "fewer than three distinct corners", r.facets_unusable},
                                  {"triangles", "no area", r.triangles_degenerate},
                                  {"triangles", "same corners as another one", r.triangles_duplicate},
                                  {"triangles", "inside, where two closed bodies touch", r.triangles_internal}};
  std::ranges::copy(plan.skipped_wedges, std::back_inserter(skipped));
  std::ranges::copy(skipped_items(plan.skips), std::back_inserter(skipped));
  std::vector<std::string> lines;
  for (const Skipped& s : skipped)
    if (s.count) lines.push_back(fmt::format("{} {}: {}", s.count, s.what, s.why));
  std::ranges::copy(skipped_as_found(plan), std::back_inserter(lines));
  if (lines.empty()) lines.emplace_back("nothing");
  fmt::print("\nskipped\n");
  for (const std::string& line : lines) fmt::print("  {}\n", line);
}

void print_warnings(const Case& c, const SolvePlan& plan) {
  const std::vector<std::string> sentences = warnings_of(c, plan, outermost_points(plan.target.mesh.vertices));
  fmt::print("\nwarnings\n");
  for (const std::string& sentence : sentences) fmt::print("  {}\n", sentence);
  if (sentences.empty()) fmt::print("  none\n");
}

LaunchGrid grid_of(const SolvePlan& plan, std::size_t look) {
  return grid_of_look(plan.target.mesh, plan.sweep.looks[look], plan.shortest_wavelength(), plan.tubes.per_wavelength,
                      plan.tubes.up);
}

void print_clipped_cost(const SolvePlan& plan) {
  fmt::print(
      "\ncost\n  looks computed: {}\n  adaptive tubes, clipped: {} planar patches; the fewer, the quicker, at any frequency\n",
      plan.looks.computed.size(), plan.target.mesh.patches.size());
}

void print_rays(const SolvePlan& plan) {
  fmt::print("\nrays in the place of currents (edges.method \"utd\")\n");
  fmt::print("  transmitter and receiver {:.6g} m from the origin; amplitudes are apparent ones at that range\n", plan.ray_range);
  fmt::print("  looks computed: {}; {} planar patches as mirrors, {} wedges\n", plan.looks.computed.size(),
             plan.target.mesh.patches.size(), plan.target.wedges.size());
}

void print_grid_cost(const SolvePlan& plan) {
  const LaunchGrid first = grid_of(plan, 0);
  fmt::print("\ncost\n  first look: {} x {} tubes of {:.4g} mm x {:.4g} mm{}\n  looks computed: {}\n", first.columns, first.rows,
             first.du * 1e3, first.dv * 1e3, plan.tubes.mode == TubeMode::adaptive ? "; adaptive tubes are mostly far fewer" : "",
             plan.looks.computed.size());
}

void print_cost(const SolvePlan& plan) {
  if (plan.mechanisms.rays)
    print_rays(plan);
  else if (plan.tubes.refines())
    print_clipped_cost(plan);
  else
    print_grid_cost(plan);
}

std::string seconds_text(double seconds) {
  if (seconds < 120.0) return fmt::format("{:.2g} s", seconds);
  if (seconds < 7200.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.3g} h", seconds / 3600.0);
}

void print_time(const SolvePlan& plan) {
  const TimePrediction time = predict_time(plan, probe_seconds, probe_patience);
  const std::string threads = fmt::format("{} thread{}", plan.threads, plan.threads == 1 ? "" : "s");
  if (time.at_most)
    fmt::print("\ntime\n  at most about {} on {}, and at least {}: no look was done in {:.0f} s, each takes at most about {}\n",
               seconds_text(time.solve_s), threads, seconds_text(time.least_s), probe_patience, seconds_text(time.look_s));
  else
    fmt::print("\ntime\n  about {} on {}, about {} a look ({} tried)\n", seconds_text(time.solve_s), threads,
               seconds_text(time.look_s), time.looks);
}

void print_memory(const SolvePlan& plan, const Case& c) {
  SolvePlan with_parts = plan;
  with_parts.keep_parts = true;
  fmt::print("\nmemory\n  at most about {}, {} with --parts, however dense the tubes are; {} are to be had\n",
             memory_text(memory_of_run(plan, c, nullptr)), memory_text(memory_of_run(with_parts, c, nullptr)),
             memory_text(memory_to_be_had()));
  if (std::ranges::any_of(c.sweep.materials, &Material::transmits))
    fmt::print("  and about {} where sheets double as many tubes as may be; more where many stand in a row\n",
               memory_text(plan.threads * tubes_between_sheets_bytes(c.sweep.frequencies.size())));
}

}  // namespace

void check_command(const Request& request) {
  const Case c = read_case(request.case_file, request.overrides);
  if (!request.wedge_list.empty()) check_wedges_file(request.wedge_list);
  LoadedMesh loaded = load_target(c);
  const Target target(std::move(loaded.mesh), c.wedges);
  const SolvePlan plan = plan_of_case(target, c, request.threads > 0 ? request.threads : all_threads(), false);
  print_case(c);
  print_mesh(loaded.report, target);
  fmt::print("{}", materials_text(c, target));
  print_wedges(target.wedges);
  print_material_edges(c.edges, target.wedges);
  print_thin_plate_edges(c, target.thin_plate_edges);
  print_curved_surfaces(plan);
  print_surface_waves(plan);
  print_skipped(loaded.report, plan);
  print_warnings(c, plan);
  print_cost(plan);
  print_memory(plan, c);
  if (!request.wedge_list.empty()) {
    const double highest = highest_frequency(c.sweep);
    const std::vector<Wedge> used = merge_thin_plate_edges(target.wedges, target.thin_plate_edges, thin_limit(highest));
    write_wedge_list(request.wedge_list, target.mesh, used, c.sweep);
  }
  check_memory(plan, c, nullptr);  // as a run would
  print_time(plan);
}

}  // namespace raytube
