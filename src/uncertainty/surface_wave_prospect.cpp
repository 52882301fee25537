#include "uncertainty/surface_wave_prospect.h"

#include <algorithm>
#include <cmath>

#include "uncertainty/constants.h"
#include "uncertainty/look_features.h"

namespace raytube {

SurfaceWaveProspect::SurfaceWaveProspect(const TriangleMesh& mesh, std::span<const Wedge> wedges, double min_wedge_angle,
                                         double longest_wavelength, bool many_edges)
    : mesh_(mesh),
      curved_(find_curved_parts(mesh, min_wedge_angle)),
      edges_(find_edge_features(wedges, curved_, {.over_curved = many_edges}, longest_wavelength)) {}

double SurfaceWaveProspect::amplitude(const Look& look, double frequency) const {
  const LookFeatures features = find_look_features({mesh_, curved_, edges_}, look, frequency);
  const double boundaries = std::max(features.shadow_boundaries[0][0], features.shadow_boundaries[1][1]);
  return std::hypot(std::hypot(boundaries, features.tight_curves, features.rims), uncertainty::edge_amplitude * features.edges);
}

}  // namespace raytube
