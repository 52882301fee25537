#include "utd/fringe/corner_pass.h"

#include <cmath>
#include <vector>

#include "utd/wedge/work.h"

namespace raytube {

WedgeIncidence incidence_from_front(const Wedge& wedge, const dvec3& incident) {
  WedgeIncidence incidence = incidence_on(wedge, incident);
  const WedgeFace& sheet = wedge.faces[0];
  if (incidence.weight < 1.0 && std::abs(glm::dot(incident, sheet.normal)) <= lit_threshold) incidence.free_side = sheet.normal;
  return incidence;
}

double lit_share(std::span<const LitInterval> lit) {
  double share = 0.0;
  for (const LitInterval& part : lit) share += part.end - part.begin;
  return share;
}

void add_corner_waves(const EdgeScene& scene, const LookVectors& look, std::span<const double> frequencies, LitEdges& light,
                      EdgeLookResult& result) {
  if (scene.corners == nullptr) return;
  const auto incident = [&](const Wedge&) { return look.incident; };
  std::vector<double> shares(scene.wedges.size());
  for_edges_between_corners(scene, light, incident, [&](std::uint32_t index, std::span<const LitInterval> lit) {
    result.work += work::edge_light;
    shares[scene.corners->first_of(index)] += lit_share(lit) * scene.corners->part(index, look.incident);
  });
  for (std::uint32_t index = 0; index < shares.size(); ++index) {
    if (shares[index] == 0.0) continue;
    result.work += work::corner_wave;
    scene.corners->add_edge(index, shares[index], look, frequencies, result.higher);
  }
}

}  // namespace raytube
