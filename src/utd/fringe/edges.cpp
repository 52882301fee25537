#include "utd/fringe/edges.h"

#include <cassert>

#include "core/threads.h"
#include "utd/fringe/corner_pass.h"
#include "utd/wedge/work.h"

namespace raytube {

namespace {

// All lit edges, in their order.
template <class Edges>
EdgeLookResult sum_of(Edges edges, std::size_t count, LitEdges& light) {
  double found = 0.0;
  for (std::uint32_t index = 0; index < count; ++index) {
    stop_if_cancelled();
    const auto meeting = edges.meeting(index);
    if (!meeting) continue;
    found += work::edge_light;
    if (light.find(index, meeting->incidence)) edges.add(index, *meeting, light.lit());
  }
  EdgeLookResult result = edges.take();
  result.work += found;
  return result;
}

}  // namespace

double add_arrivals(const EdgeScene& scene, const LookVectors& look, std::span<const double> frequencies,
                    const FringeOptions& options, const SurfaceLight& light, std::span<ScatteringMatrix> scattering) {
  if (options.order == 1 || scene.curved == nullptr) return 0.0;
  MultipleDiffraction strips(scene.wedges, scene.outlines, scene.curved, look, frequencies, options.order);
  strips.keep_rays(options.rays);
  for (const SurfaceArrival& arrival : light.arrivals) strips.arrive(arrival, light.frequencies);
  const StripSums sums = strips.take();
  for (std::size_t f = 0; f < frequencies.size(); ++f) scattering[f] += sums.higher[f];
  return sums.work;
}

EdgeLookResult fringe_scattering(const EdgeScene& scene, const Look& look, std::span<const double> frequencies,
                                 const FringeOptions& options, const SurfaceLight& surfaces) {
  assert(!frequencies.empty() && options.order >= 1);
  const LookVectors vectors = look_vectors(look);
  LitEdges light(scene.wedges, scene.tracer, vectors, shortest_wavelength(frequencies), options.receiver_shadow);
  EdgeLookResult result =
      at_order(scene, options, [&](auto make) { return sum_of(make(vectors, frequencies), scene.wedges.size(), light); });
  result.work += add_arrivals(scene, vectors, frequencies, options, surfaces, result.higher);
  add_corner_waves(scene, vectors, frequencies, light, result);
  return result;
}

}  // namespace raytube
