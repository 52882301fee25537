#include "sbr/curved/near_facets.h"

#include <algorithm>
#include <cmath>

#include "sbr/beams/current_map.h"
#include "sbr/beams/spherical_look.h"

namespace raytube {

namespace {

// Of a facet that cells divide: one seen at a flatter angle is in one of them as a whole.
constexpr double least_facing = 1e-6;

Patch plane_of(const BentFacet& facet) {
  const auto& [a, b, c] = facet.corners();
  const dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
  return {normal, glm::dot(normal, a)};
}

// Cut up where the antenna sees the facet's plane.
void add_to_map(const TubeLook& look, const BentFacet& facet, std::uint32_t material, std::uint32_t triangle,
                const ScatteringMatrix& whole) {
  const Beam beam = incident_beam(look.grid, look.transmit, dvec2(0.0));
  std::array<dvec2, 3> corners;
  std::ranges::transform(facet.corners(), corners.begin(), [&](const dvec3& r) { return launch_coordinates(beam, r); });
  CurrentInParts parts(*look.map, whole, (corners[0] + corners[1] + corners[2]) / 3.0, triangle);
  const Patch plane = plane_of(facet);
  if (!(std::abs(facing(beam, plane)) > least_facing)) return parts.finish();
  const Affine depth = depth_of(beam, plane);
  const SphericalLook at_frequency = look.spherical->at_frequency(look.map->frequency_index());
  ConvexPolygon outline;
  set_corners(outline, corners);
  std::vector<dvec3> points;
  look.map->cut_up(outline, [&](const ConvexPolygon& part) {
    points.clear();
    for (const Corner& corner : part) points.push_back(point_at(beam, corner.at, depth(corner.at)));
    TubeSums alone;
    at_frequency.add(alone, facet, material, points);
    parts.add(middle(part), triangle, alone.bounces[0][0]);
  });
  parts.finish();
}

void light(const TubeLook& look, std::uint32_t triangle, TubeSums& sums) {
  const TriangleMesh& mesh = look.tracer.mesh();
  const BentFacet facet = look.smooth->facet(triangle);
  const std::uint32_t material = mesh.patches[mesh.triangle_patch[triangle]].material;
  const std::size_t f = look.map ? look.map->frequency_index() : 0;
  const ScatteringMatrix before = sums.bounces[0][f];
  if (!look.spherical->add(sums, facet, material)) return;
  ++sums.hits[0];
  if (look.map) add_to_map(look, facet, material, triangle, sums.bounces[0][f] - before);
}

}  // namespace

TubeSums light_curved_facets(const TubeLook& look, std::uint32_t begin, std::uint32_t end) {
  TubeSums sums;
  sums.at(0, look.wavenumbers().size());
  for (std::uint32_t t = begin; t < end; ++t)
    if (look.smooth->region(t) != no_index) light(look, t, sums);
  sums.tubes = sums.hits[0];
  return sums;
}

}  // namespace raytube
