#include "plan/admissible.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "core/error.h"
#include "mesh/soundness/solids.h"
#include "sbr/launch/launch.h"
#include "sbr/sbr.h"
#include "scene/keys/option_keys.h"

namespace raytube {

namespace {

// All of the target in front, as seen from the antenna towards the target and towards the origin, for which V and H are given.
void check_place(const TriangleMesh& mesh, const Antenna& antenna, bool image) {
  const bool past_origin = std::ranges::any_of(
      mesh.vertices, [&](const dvec3& vertex) { return glm::dot(vertex - antenna.position(), antenna.radial()) >= 0.0; });
  if (image && (past_origin || !stands_in_front(mesh, antenna.position())))
    throw InputError(
        fmt::format("an antenna {:.6g} m from the mesh's origin sees the target by way of the ground farther than 45 degrees off "
                    "the line to the middle of its mirror image; move it away (radar.range_m, radar.position_m)",
                    antenna.range()));
  if (past_origin || !stands_in_front(mesh, antenna.position()))
    throw InputError(fmt::format(
        "an antenna {:.6g} m from the mesh's origin stands beside the target, or too near to it, to have all of it and "
        "the origin in front, within 45 degrees of the line to its middle; move it away (radar.range_m, radar.position_m), or "
        "check target.unit",
        antenna.range()));
  if (!(glm::dot(antenna.axis(), antenna.radial()) < 0.0))
    throw InputError("radar.aim_m lies at an antenna, or behind one; give a point on the side of the target");
}

// A measured pattern says nothing beyond its ends.
void check_pattern(const TriangleMesh& mesh, const Antenna& antenna, const AntennaPattern& pattern) {
  if (pattern.azimuth.angles.empty() && pattern.elevation.angles.empty()) return;
  for (const dvec3& vertex : mesh.vertices) {
    const dvec2 angles = antenna.off_axis(antenna.ray_to(vertex).direction);
    if (!pattern.azimuth.reaches(angles.x) || !pattern.elevation.reaches(angles.y))
      throw InputError(
          fmt::format("the target reaches {:.3g} degrees off the antenna's axis in azimuth and {:.3g} in elevation, beyond "
                      "the pattern in radar.pattern_csv; add rows up to there",
                      angles.x / degree, angles.y / degree));
  }
}

void check_near(const Sweep& sweep, const EdgeOptions& edges) {
  if (std::ranges::any_of(sweep.looks, &Look::far))
    throw InputError("either every look has antennas at a finite distance, or none");
  if (edges.utd_range > 0.0)
    throw InputError("antennas at a finite distance have a range of their own; remove edges.utd_range_m or [radar]");
}

void check_with_solids(const Sweep& sweep, const EdgeOptions& edges) {
  if (!all_far(sweep))
    throw InputError("materials of kind \"solid\" are computed for plane waves; remove [radar], or write kind = \"dielectric\"");
  if (std::ranges::any_of(sweep.materials, &Material::transmits))
    throw InputError(
        "kinds \"solid\" and \"sheet\" do not go together; write kind = \"dielectric\" for one that returns nothing from inside");
  if (edges.method == EdgeMethod::utd)
    throw InputError("edges.method \"utd\" has no rays inside of kind \"solid\"; write \"fringe\" or \"none\"");
}

}  // namespace

bool all_far(const Sweep& sweep) { return std::ranges::all_of(sweep.looks, &Look::far); }

void check_options(const Sweep& sweep, const TubeOptions& tubes, const EdgeOptions& edges) {
  if (sweep.frequencies.empty() || sweep.looks.empty()) throw InputError("the sweep has no frequency or no look");
  for (const double f : sweep.frequencies)
    if (!(f > 0.0) || !std::isfinite(f)) throw InputError("every frequency must be a positive number of hertz");
  const auto check = [](const CaseKey& key, const auto& member) {
    if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(member)>>)
      if (const double value = member / key.factor; key.shown && !(key.limits.hold(value) && std::isfinite(value)))
        throw InputError(fmt::format("{} must be a finite number {}", key.name, key.limits.text()));
  };
  visit_tube_keys(tubes, check);
  const WedgeOptions wedges;  // checked with the target
  visit_edge_keys(edges, wedges, true, check);
  if (!all_far(sweep)) check_near(sweep, edges);
  if (any_solid(sweep.materials)) check_with_solids(sweep, edges);
}

void check_materials(const FaceTree& faces, const Sweep& sweep) {
  const auto missing = [&](const Patch& patch) { return patch.material != no_index && patch.material >= sweep.materials.size(); };
  if (std::ranges::any_of(faces.mesh().patches, missing))
    throw InputError("the mesh is made of materials that the sweep does not have");
  check_solids(faces, sweep.materials);
}

void check_antennas(const TriangleMesh& mesh, const Sweep& sweep) {
  for (const Look& look : sweep.looks) {
    if (look.far()) continue;
    const AntennaPair antennas(look, sweep.radar, mesh.center);
    for (const auto& [antenna, image] : {std::pair(&antennas.transmit, look.transmit_mirror.has_value()),
                                         std::pair(&antennas.receive, look.receive_mirror.has_value())}) {
      check_place(mesh, *antenna, image);
      check_pattern(mesh, *antenna, sweep.radar.pattern);
    }
  }
}

double densest_tubes(const TriangleMesh& mesh, const Sweep& sweep, const TubeOptions& tubes) {
  const double shortest = wavelength(std::ranges::max(sweep.frequencies));
  double most = std::numeric_limits<double>::infinity();
  for (const Look& look : sweep.looks) most = std::min(most, densest_grid(mesh, look, shortest, tubes.up));
  return most;
}

void check_density(const TriangleMesh& mesh, const Sweep& sweep, const TubeOptions& tubes) {
  // No look sees more of the target than its sphere; an antenna in front of it (stands_in_front) sees it up to 20 times as large.
  const double widest = (all_far(sweep) ? 2.0 : 40.0) * mesh.radius / wavelength(std::ranges::max(sweep.frequencies));
  const double density = first_density(tubes);
  if (widest * density < 1e6) return;
  if (const double most = densest_tubes(mesh, sweep, tubes); density > most) throw InputError(too_dense(density, most));
}

}  // namespace raytube
