#include "sbr/beams/truncated_tubes.h"

namespace raytube {

void count_truncated(TruncatedSum& sum, const Tracer& tracer, const SpectralSurfaces& surfaces, TruncatedTube tube) {
  auto& [ray, hit, area, amplitude] = tube;
  ++sum.tubes;
  while (hit && amplitude > least_amplitude) {
    const std::uint32_t patch = tracer.mesh().triangle_patch[hit.triangle];
    const auto [reflected, transmitted] = surfaces.strongest(tracer.mesh().patches[patch], ray.direction);
    sum.add(area, amplitude * reflected);
    amplitude *= transmitted;
    ray = {ray.origin + hit.distance * ray.direction, ray.direction, patch};
    tracer.closest_hits({&ray, 1}, {&hit, 1});
  }
}

}  // namespace raytube
