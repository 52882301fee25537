// Waves from corner to corner of one look, edge after edge.
#pragma once

#include <algorithm>

#include "utd/fringe/edge_pass.h"
#include "utd/shadow/lit_edges.h"

namespace raytube {

/// How a wave that comes along `incident` meets an edge whose light is looked for: one that is met exactly along its sheet is
/// seen from the sheet's front.
WedgeIncidence incidence_from_front(const Wedge& wedge, const dvec3& incident);

/// How much of an edge its lit parts are; its waves count in proportion.
double lit_share(std::span<const LitInterval> lit);

/// The part of an edge of a solid between two dark faces that has waves, as both its corners are seen: as much as is lit of the
/// edges that meet it there, at the corner of which less is. `incident`(wedge) is the direction in which the wave comes.
template <class Incident>
double share_between_corners(const EdgeScene& scene, std::uint32_t index, LitEdges& light, Incident incident) {
  const SolidEdge& edge = *scene.corners->solid(index);
  const dvec3 towards = -incident(scene.wedges[index]);
  if (!edge.ends[0].sees(towards) || !edge.ends[1].sees(towards)) return 0.0;
  double share = 1.0;
  for (const SolidEnd& end : edge.ends) {
    double most = 0.0;
    for (const std::uint32_t other : end.beside)
      if (light.find(other, incidence_from_front(scene.wedges[other], incident(scene.wedges[other]))))
        most = std::max(most, lit_share(light.lit()));
    share = std::min(share, most);
  }
  return share;
}

/// Calls add(index, lit) for every edge that has waves and is lit, or its corners are, with its lit parts.
template <class Incident, class Add>
void for_edges_between_corners(const EdgeScene& scene, LitEdges& light, Incident incident, Add add) {
  if (scene.corners == nullptr) return;
  for (std::uint32_t index = 0; index < scene.wedges.size(); ++index) {
    if (!scene.corners->run_along(index)) continue;
    const Wedge& wedge = scene.wedges[index];
    const WedgeIncidence incidence = incidence_from_front(wedge, incident(wedge));
    const SolidEdge* solid = scene.corners->solid(index);
    if (incidence.weight > 0.0 || solid == nullptr) {
      if (light.find(index, incidence)) add(index, light.lit());
    } else if (const double share = share_between_corners(scene, index, light, incident); share > 0.0) {
      const LitInterval part{0.0, share};
      add(index, std::span(&part, 1));
    }
  }
}

/// Antennas at infinity: what edges have beside their strips is added to result.higher.
void add_corner_waves(const EdgeScene& scene, const LookVectors& look, std::span<const double> frequencies, LitEdges& light,
                      EdgeLookResult& result);

}  // namespace raytube
