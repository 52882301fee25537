#include "solve/parts.h"

#include <algorithm>
#include <cmath>

#include "sbr/beams/estimate.h"

namespace raytube {

namespace {

// A surface that rises from its facets by more than this many wavelengths is not known well enough to be anything but facets.
constexpr double most_rise = 1.0 / 32.0;

// k a^2 / R [rad], both ways together the phase by which a spherical wave is late where a target reaches a from the origin.
constexpr double most_phase = 0.5;

// What quadrature may leave of the tolerance, at the frequency where most comes back.
constexpr double interaction_share = 0.1;

// Towards the direction, as spherical_basis has it. At 94 GHz and 1000 km from the origin 10^9 rad come of it, of which double
// keeps six decimals and the extended precision of x86 nine.
long double along(const Direction& direction, const dvec3& point) {
  const auto without_dust = [](long double x) { return std::abs(x) < 1e-15L ? 0.0L : x; };
  const long double theta = direction.theta, phi = direction.phi;
  const long double across = without_dust(std::cos(phi)) * point.x + without_dust(std::sin(phi)) * point.y;
  return without_dust(std::sin(theta)) * across + without_dust(std::cos(theta)) * point.z;
}

void check_near(const Sweep& sweep, const SolveOptions& options) {
  if (std::ranges::any_of(sweep.looks, &Look::far))
    throw InputError("either every look has antennas at a finite distance, or none");
  if (options.tubes.mode == TubeMode::adaptive && !options.tubes.clip)
    throw InputError("antennas at a finite distance need tubes that are clipped or uniform");
  if (options.edges.method == EdgeMethod::utd)
    throw InputError("antennas at a finite distance have no part in the edge method utd, which has a range of its own");
}

void check_materials(const Sweep& sweep, const SolveOptions& options) {
  if (sweep.materials.empty()) return;
  if (!all_far(sweep))
    throw InputError("antennas at a finite distance know perfect conductors only; remove [radar] or the materials");
  if (options.edges.method == EdgeMethod::utd)
    throw InputError("edges.method \"utd\" knows perfect conductors only; write \"fringe\" or \"none\", or remove the materials");
  const bool sheets = std::ranges::any_of(sweep.materials, &Material::transmits);
  if (sheets && options.tubes.curved == CurvedSurfaces::always)
    throw InputError("tubes.curved \"always\" knows no sheets that let waves through; write \"convex\" or \"never\"");
}

}  // namespace

bool all_far(const Sweep& sweep) { return std::ranges::all_of(sweep.looks, &Look::far); }

bool waves_are_plane(const TriangleMesh& mesh, const Sweep& sweep) {
  const double reach = glm::length(mesh.center) + mesh.radius;
  const double phase = wavenumber(std::ranges::max(sweep.frequencies)) * reach * reach;
  return std::ranges::all_of(sweep.looks, [&](const Look& look) {
    return look.far() || phase < most_phase * std::min(look.transmit_range, look.receive_range);
  });
}

void check(const Sweep& sweep, const SolveOptions& options) {
  if (sweep.frequencies.empty() || sweep.looks.empty()) throw InputError("the sweep has no frequency or no look");
  for (const double f : sweep.frequencies)
    if (!(f > 0.0) || !std::isfinite(f)) throw InputError("every frequency must be a positive number of hertz");
  if (!(options.tubes.per_wavelength > 0.0)) throw InputError("tubes.per_wavelength must be positive");
  if (options.edges.order < 1 || options.edges.order > 3) throw InputError("edges.order must be 1, 2 or 3");
  if (options.tubes.max_bounces < 1) throw InputError("tubes.max_bounces must be at least 1");
  if (!all_far(sweep)) check_near(sweep, options);
  check_materials(sweep, options);
  if (!(options.edges.utd_range >= 0.0)) throw InputError("edges.utd_range_m must be positive, or 0 for the default");
}

void check_materials(const TriangleMesh& mesh, const Sweep& sweep) {
  const auto missing = [&](const Patch& patch) { return patch.material != no_index && patch.material >= sweep.materials.size(); };
  if (std::ranges::any_of(mesh.patches, missing)) throw InputError("the mesh is made of materials that the sweep does not have");
}

void make_reciprocal(std::span<ScatteringMatrix> scattering) {
  for (ScatteringMatrix& s : scattering) s.at(0, 1) = s.at(1, 0) = 0.5 * (s.vh() + s.hv());
}

std::optional<SmoothSurfaces> smooth_surfaces(const Target& target, const Sweep& sweep, const TubeOptions& tubes) {
  if (tubes.mode != TubeMode::adaptive || !tubes.clip || tubes.curved == CurvedSurfaces::never) return {};
  const bool convex_only = tubes.curved == CurvedSurfaces::convex || !all_far(sweep);
  if (convex_only && !target.convexity.no_reflection) return {};
  SmoothSurfaces smooth(target.mesh, target.options.min_wedge_angle, most_rise * wavelength(std::ranges::max(sweep.frequencies)));
  if (!smooth.any()) return {};
  return smooth;
}

EdgeSetup edge_setup(const Target& target, const Sweep& sweep, const SolveOptions& options) {
  EdgeSetup setup{target.tracer, target.faces, target.wedges, target.outlines, target.rims, target.options.min_wedge_angle};
  setup.frequencies = sweep.frequencies;
  setup.interaction = above_interaction_limit(target, sweep, options.edges);
  setup.interaction.flip();
  if (options.edges.method == EdgeMethod::fringe && std::ranges::any_of(sweep.materials, &Material::transmits))
    setup.screens = sweep.materials;
  setup.skip_enclosed = options.tubes.skip;
  setup.fringe = {options.edges.order, options.edges.receiver_shadow, options.edges.transition, false};
  return setup;
}

double interaction_tolerance(const TubeSums& tubes, const SolveOptions& options) {
  double strongest = 0.0;
  for (std::size_t f = 0; !tubes.bounces.empty() && f < tubes.bounces[0].size(); ++f) {
    ScatteringMatrix sum;
    for (const std::vector<ScatteringMatrix>& bounce : tubes.bounces) sum += bounce[f];
    strongest = std::max(strongest, frobenius_norm(sum));
  }
  return interaction_share * relative_error(options.tubes.tolerance_db) * strongest;
}

bool edges_count(const EdgeSets& edges, const SolveOptions& options) {
  return options.edges.method == EdgeMethod::fringe && (edges.radiate() || !options.tubes.skip);
}

Complex from_plane_waves(const TriangleMesh& mesh, const Look& look, const Radar& radar, double frequency) {
  const AntennaPair antennas(look, radar, mesh.center);
  const AntennaRay arriving = antennas.transmit.ray_to(dvec3(0.0)), received = antennas.receive.ray_to(dvec3(0.0));
  return std::polar(glm::length(arriving.field[0]) * glm::length(received.field[0]),
                    -wavenumber(frequency) * (arriving.path + received.path));
}

Complex to_mesh_origin(const TriangleMesh& mesh, const Look& look, double frequency) {
  if (!look.far()) return 1.0;
  const long double path = along(look.receive, mesh.center) + along(look.transmit, mesh.center);
  const long double cycles = path * frequency / speed_of_light;
  return std::polar(1.0, 2.0 * pi * static_cast<double>(cycles - std::round(cycles)));
}

}  // namespace raytube
