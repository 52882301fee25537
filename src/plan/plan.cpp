#include "plan/plan.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <map>
#include <ranges>
#include <stdexcept>

#include "gtd/ray_fields.h"
#include "mesh/features/symmetry.h"
#include "mesh/smooth/bodies.h"
#include "plan/admissible.h"
#include "plan/material_edges.h"
#include "scene/frequency_bands.h"
#include "utd/corner/corner_waves.h"

namespace raytube {

namespace {

// Tubes see facets where waves run over the surface behind them: rises of more than this many wavelengths put both out of phase.
constexpr double most_rise = 1.0 / 32.0;

double ray_range_of(const SolvePlan& plan) {
  if (!plan.rays() || !all_far(plan.sweep)) return 0.0;
  const double highest = std::ranges::max(plan.sweep.frequencies);
  const double range = plan.edges.utd_range > 0.0 ? plan.edges.utd_range : default_ray_range(plan.target.mesh, highest);
  check_ray_range(plan.target.mesh, range);
  return range;
}

// Facets are taken as the surfaces they stand for where a body is convex, or always if asked.
bool bends_facets(const SolvePlan& plan) {
  return !plan.rays() && plan.tubes.refines() && plan.tubes.curved != CurvedSurfaces::never;
}

// The curved surfaces of a target, of those of the mesh that are known already, if any.
std::shared_ptr<const SmoothSurfaces> surfaces_of(SolvePlan& plan, double max_rise = std::numeric_limits<double>::infinity()) {
  const double max_crease = plan.target.options.min_wedge_angle;
  std::shared_ptr<const SmoothSurfaces>& known = plan.known_surfaces;
  const auto made = known ? std::make_shared<const SmoothSurfaces>(*known, max_crease, max_rise)
                          : std::make_shared<const SmoothSurfaces>(plan.target.mesh, max_crease, max_rise);
  if (!known) known = made;
  return made;
}

// Surfaces without those of sheets, which tubes see as facets. Null if no facet is left that is curved.
std::shared_ptr<const SmoothSurfaces> with_flat_sheets(const SolvePlan& plan, std::shared_ptr<const SmoothSurfaces> surfaces) {
  std::vector<bool> sheets;
  for (const Material& material : plan.sweep.materials) sheets.push_back(material.transmits());
  if (std::ranges::find(sheets, true) != sheets.end()) {
    SmoothSurfaces opaque = *surfaces;
    opaque.flatten(sheets);
    surfaces = std::make_shared<const SmoothSurfaces>(std::move(opaque));
  }
  return surfaces->any() ? surfaces : nullptr;
}

// The surfaces that tubes may see, whatever the wavelength. Null: there are none.
struct CurvedBodies {
  std::shared_ptr<const SmoothSurfaces> all;    // of a target that bends all of its facets where it is convex, or always
  std::shared_ptr<const SmoothSurfaces> apart;  // of separate bodies of a set, whose facets are curved at every frequency
};

// By default convex bodies bend their facets, alone or as bodies of a set that stand apart. A mesh of several components is no
// convex body.
CurvedBodies curved_bodies(SolvePlan& plan) {
  if (!bends_facets(plan)) return {};
  const std::vector<Component>& components = plan.target.mesh.components;
  const bool may_be_convex =
      plan.target.convexity.no_reflection || (plan.tubes.skip && components.size() == 1 && components[0].closed);
  if (may_be_convex || plan.tubes.curved == CurvedSurfaces::always) return {with_flat_sheets(plan, surfaces_of(plan)), {}};
  auto surfaces = components.size() == 1 ? std::nullopt : bodies_apart(plan.target.faces, plan.target.options.min_wedge_angle);
  if (!surfaces) return {};
  plan.known_surfaces = std::make_shared<const SmoothSurfaces>(std::move(*surfaces));
  return {{}, with_flat_sheets(plan, plan.known_surfaces)};
}

// A body all of whose hollows are those between the facets of its surfaces reflects nothing onto itself. Hollow edges are none
// of those: beside them only dents that are small in wavelengths are passed over.
Convexity convexity_at(double wavelength, const SolvePlan& plan, const SmoothSurfaces* all) {
  const TriangleMesh& mesh = plan.target.mesh;
  Convexity convexity = plan.target.convexity;
  if (!all || convexity.no_reflection || !plan.tubes.skip || all->facets() <= mesh.triangles.size() / 2) return convexity;
  const double small = most_rise * wavelength;
  const bool tessellation = std::ranges::all_of(plan.target.wedges, &Wedge::convex);
  convexity.no_reflection = convex_up_to(mesh, tessellation ? std::max(small, most_dent * all->rise()) : small);
  return convexity;
}

// Which facets count as curved, at one wavelength. Waves run over the curved surfaces of any body, even of one whose tubes meet
// its facets, unless the facets are what is meant.
BandPlan band_at(double wavelength, SolvePlan& plan, const CurvedBodies& bodies) {
  BandPlan band{{}, {}, convexity_at(wavelength, plan, bodies.all.get())};
  if (plan.tubes.curved == CurvedSurfaces::always || band.convexity.no_reflection) band.smooth = bodies.all;
  if (band.smooth) {
    band.wave_surfaces = band.smooth;
  } else if (plan.surfaces.waves.possible() && plan.fringe() && bends_facets(plan)) {
    band.wave_surfaces = surfaces_of(plan, most_rise * wavelength);
    if (!band.wave_surfaces->any()) band.wave_surfaces = nullptr;
  }
  if (!band.smooth) band.smooth = bodies.apart;
  return band;
}

// What grows with the wavelength is the same where it is as large.
bool same_body(const BandPlan& a, const BandPlan& b) {
  const auto facets = [](const std::shared_ptr<const SmoothSurfaces>& surfaces) { return surfaces ? surfaces->facets() : 0; };
  return a.convexity.no_reflection == b.convexity.no_reflection && facets(a.smooth) == facets(b.smooth) &&
         facets(a.wave_surfaces) == facets(b.wave_surfaces);
}

// Frequencies in ascending order, each with its index: as many bands as bodies.
template <class BodyAt>
void divide(const BodyAt& body_at, std::span<const std::pair<double, std::size_t>> frequencies, const BandPlan& lowest,
            const BandPlan& highest, std::vector<BandPlan>& bands) {
  if (same_body(lowest, highest)) {
    if (bands.empty() || !same_body(bands.back(), lowest)) bands.push_back(lowest);
    for (const auto& [frequency, index] : frequencies) bands.back().indices.push_back(index);
    return;
  }
  const std::size_t half = frequencies.size() / 2;
  const auto at = [&](std::size_t i) { return body_at(frequencies[i].first); };
  divide(body_at, frequencies.first(half), lowest, half == 1 ? lowest : at(half - 1), bands);
  divide(body_at, frequencies.subspan(half), half + 1 == frequencies.size() ? highest : at(half), highest, bands);
}

// How finely a row is sampled depends on its band alone, not on the other frequencies. Grids of fixed density are as fine as the
// highest of all frequencies asks.
std::vector<BandPlan> in_sampled_bands(const std::vector<BandPlan>& bodies, std::span<const double> frequencies) {
  std::vector<BandPlan> bands;
  for (const BandPlan& body : bodies) {
    std::map<double, BandPlan> parts;
    for (const std::size_t index : body.indices) {
      const auto [part, is_new] = parts.try_emplace(sampled_band(frequencies[index]).lowest, body);
      if (is_new) part->second.indices.clear();
      part->second.indices.push_back(index);
    }
    for (auto& [lowest, part] : parts) bands.push_back(std::move(part));
  }
  return bands;
}

std::vector<BandPlan> bands_of(SolvePlan& plan) {
  std::vector<std::pair<double, std::size_t>> ascending;
  for (const double frequency : plan.sweep.frequencies) ascending.emplace_back(frequency, ascending.size());
  std::ranges::sort(ascending);
  const CurvedBodies bodies = curved_bodies(plan);
  const auto body_at = [&](double frequency) { return band_at(wavelength(frequency), plan, bodies); };
  const BandPlan lowest = body_at(ascending.front().first);
  const bool one = ascending.front().first == ascending.back().first;
  std::vector<BandPlan> bands;
  divide(body_at, ascending, lowest, one ? lowest : body_at(ascending.back().first), bands);
  if (plan.tubes.refines()) bands = in_sampled_bands(bands, plan.sweep.frequencies);
  for (BandPlan& band : bands) {
    std::ranges::sort(band.indices);
    for (const std::size_t index : band.indices) band.frequencies.push_back(plan.sweep.frequencies[index]);
  }
  return bands;
}

// A radar on a circle about the origin is at the same point again where its directions repeat, and aimed at the same one unless
// a turntable turns it away. The mirror image of one stands elsewhere.
LookPlan near_looks(const Sweep& sweep) {
  const bool circle = std::ranges::all_of(sweep.looks, [&](const Look& look) {
    return look.turn == sweep.looks[0].turn && look.transmit_range == sweep.looks[0].transmit_range &&
           look.receive_range == sweep.looks[0].receive_range;
  });
  return circle ? plan_looks(sweep.looks, {false, false, false}) : plan_all(sweep.looks.size());
}

// Images of looks follow where tubes are cut exactly: the grid of uniform tubes, and of those that curved surfaces reflect, is
// not its own image; nor are rays that are searched for, or radars at a finite distance from the origin.
LookPlan looks_of(const SolvePlan& plan) {
  const Sweep& sweep = plan.sweep;
  const auto sees_curved = [](const BandPlan& band) { return band.smooth != nullptr; };
  const auto cut_exactly = [](const BandPlan& band) { return !band.smooth || band.convexity.no_reflection; };
  if (!plan.tubes.skip) return plan_all(sweep.looks.size());
  const auto is_image = [](const Look& look) { return look.transmit_mirror || look.receive_mirror; };
  if (std::ranges::any_of(sweep.looks, is_image)) return plan_all(sweep.looks.size());
  if (!all_far(sweep)) return near_looks(sweep);
  const bool exact = plan.tubes.refines() && std::ranges::all_of(plan.bands, cut_exactly);
  if (!exact || plan.rays()) return plan_looks(sweep.looks, {false, false, false});
  const LookPlan at_best = plan_looks(sweep.looks, {true, true, true});
  if (at_best.mirrored == 0) return at_best;
  return plan_looks(sweep.looks,
                    find_symmetry_planes(plan.target.mesh, plan.target.wedges, std::ranges::any_of(plan.bands, sees_curved)));
}

std::vector<Skipped> skipped_wedges_of(const SolvePlan& plan) {
  const std::vector<Wedge>& wedges = plan.target.wedges;
  if (plan.edges.method == EdgeMethod::none) return {{"wedges", "edges.method is \"none\"", wedges.size()}};
  const auto count = [&](auto left_out) { return static_cast<std::uint64_t>(std::ranges::count_if(wedges, left_out)); };
  std::vector<Skipped> skipped{
      {"wedges", "concave: multiple reflection stands for them", count([](const Wedge& w) { return !w.convex(); })}};
  const MaterialEdgeCount others = count_material_edges(plan.target, plan.sweep, plan.edges);
  const bool none = plan.edges.materials == MaterialEdgeMethod::none;
  skipped.push_back({"wedges", "edges of solids add nothing", others.of_solids});
  skipped.push_back({"wedges", none ? "a face is not a perfect conductor (edges.materials)" : "a face is not a perfect conductor",
                     others.all - others.of_solids - others.computed});
  if (plan.rays()) return skipped;
  const std::vector<double>& frequencies = plan.sweep.frequencies;
  const auto lowest = static_cast<std::size_t>(std::ranges::min_element(frequencies) - frequencies.begin());
  const std::vector<Wedge>& seen = *set_of(plan.wedge_sets, lowest).wedges;
  skipped.push_back({"wedges", "across the edge of a thin plate, no longer than it is thick", thin_plate_corners(seen)});
  skipped.push_back({"wedges", "flat to the wave: steps, slivers and ripples finer than wavelength / 100",
                     static_cast<std::uint64_t>(std::ranges::count_if(seen, &Wedge::flat))});
  return skipped;
}

std::shared_ptr<const Sweep> paths_of(const Sweep& sweep, const SolveOptions& options, const std::optional<Ground>& ground) {
  if (!ground) return {};
  return std::make_shared<const Sweep>(sweep_of_paths(sweep, *ground, options.edges.method == EdgeMethod::utd));
}

}  // namespace

SolvePlan::SolvePlan(const Target& on, const Sweep& given, const SolveOptions& options, const std::optional<Ground>& over,
                     const std::vector<MechanismEntry>& list)
    : target(on),
      asked(given),
      ground(over),
      along_paths(paths_of(given, options, over)),
      sweep(along_paths ? *along_paths : given),
      tubes(options.tubes),
      edges(options.edges),
      surfaces(options.surfaces),
      threads(options.threads),
      keep_parts(options.keep_parts || ground),
      tell_parts(options.keep_parts),
      mechanisms(list) {
  check_options(sweep, tubes, edges);
  check_materials(target.faces, sweep);
  check_antennas(target.mesh, sweep);
  if (!rays()) check_density(target.mesh, sweep, tubes);
  const auto start = std::chrono::steady_clock::now();
  ray_range = ray_range_of(*this);
  bands = bands_of(*this);
  const bool coats_count = fringe() && edges.materials == MaterialEdgeMethod::fringe;
  thin_plate_edges = metal_plate_edges(target.thin_plate_edges, sweep.materials, coats_count);
  wedge_sets = raytube::wedge_sets(
      {target.mesh, target.wedges, target.outlines, thin_plate_edges, target.options.min_wedge_angle}, sweep.frequencies);
  if (fringe() && edges.order > 1)
    for (const WedgeSet& set : wedge_sets) corner_waves.push_back(std::make_shared<CornerWaves>(*set.wedges, edges.corners));
  looks = looks_of(*this);
  const bool skips_wedges = tubes.skip && edges.method != EdgeMethod::none;
  skips = {{"looks", "the same as earlier ones", looks.repeated},
           {"looks", "mirror images of earlier ones: the target is its own image", looks.mirrored},
           {"wedges", "inside a closed body", skips_wedges ? target.wedges_enclosed : 0}};
  skipped_wedges = skipped_wedges_of(*this);
  for (std::vector<Skipped>* items : {&skips, &skipped_wedges})
    std::erase_if(*items, [](const Skipped& item) { return item.count == 0; });
  for (const MechanismEntry& mechanism : mechanisms) states.push_back(mechanism.state(*this));
  seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double BandPlan::shortest_wavelength() const { return wavelength(std::ranges::max(frequencies)); }

double SolvePlan::shortest_wavelength() const { return wavelength(std::ranges::max(sweep.frequencies)); }

std::size_t SolvePlan::columns() const {
  auto count = static_cast<std::size_t>(max_bounces());
  for (const MechanismEntry& mechanism : mechanisms) count += mechanism.columns.size();
  return count;
}

std::size_t SolvePlan::index_of(std::string_view name) const {
  const auto found = std::ranges::find(mechanisms, name, &MechanismEntry::name);
  if (found == mechanisms.end()) throw std::out_of_range("no mechanism " + std::string(name));
  return static_cast<std::size_t>(found - mechanisms.begin());
}

bool SolvePlan::no_reflection() const {
  return std::ranges::all_of(bands, [](const BandPlan& band) { return band.convexity.no_reflection; });
}

}  // namespace raytube
