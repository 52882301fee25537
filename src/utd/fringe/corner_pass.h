// Waves from corner to corner of one look, edge after edge.
#pragma once

#include "utd/fringe/edge_pass.h"
#include "utd/shadow/lit_edges.h"

namespace raytube {

/// How a wave that comes along `incident` meets an edge whose light is looked for: one that is met exactly along its sheet is
/// seen from the sheet's front.
WedgeIncidence incidence_from_front(const Wedge& wedge, const dvec3& incident);

/// Calls add(index, lit) for every edge that has waves and is lit, with its lit parts; `incident`(wedge) is the direction in
/// which the wave comes.
template <class Incident, class Add>
void for_edges_between_corners(const EdgeScene& scene, LitEdges& light, Incident incident, Add add) {
  if (scene.corners == nullptr) return;
  for (std::uint32_t index = 0; index < scene.wedges.size(); ++index) {
    if (!scene.corners->run_along(index)) continue;
    const Wedge& wedge = scene.wedges[index];
    if (light.find(index, incidence_from_front(wedge, incident(wedge)))) add(index, light.lit());
  }
}

/// How much of an edge its lit parts are; its waves count in proportion.
double lit_share(std::span<const LitInterval> lit);

/// Antennas at infinity: what edges have beside their strips is added to result.higher.
void add_corner_waves(const EdgeScene& scene, const LookVectors& look, std::span<const double> frequencies, LitEdges& light,
                      EdgeLookResult& result);

}  // namespace raytube
