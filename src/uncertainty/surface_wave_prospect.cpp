#include "uncertainty/surface_wave_prospect.h"

#include <algorithm>
#include <cmath>

#include "uncertainty/look_features.h"

namespace raytube {

SurfaceWaveProspect::SurfaceWaveProspect(const TriangleMesh& mesh, double min_wedge_angle)
    : mesh_(mesh), curved_(find_curved_parts(mesh, min_wedge_angle)) {}

double SurfaceWaveProspect::amplitude(const Look& look, double frequency) const {
  const EdgeFeatures no_edges;
  const LookFeatures features = find_look_features({mesh_, curved_, no_edges}, look, frequency);
  const double boundaries = std::max(features.shadow_boundaries[0][0], features.shadow_boundaries[1][1]);
  return std::hypot(boundaries, features.tight_curves, features.rims);
}

}  // namespace raytube
