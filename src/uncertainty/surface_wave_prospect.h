// What waves over curved surfaces may add to a look, before they are computed.
#pragma once

#include "scene/sweep.h"
#include "uncertainty/target_features.h"

namespace raytube {

/// Keeps a reference to the mesh.
class SurfaceWaveProspect {
 public:
  /// Creases flatter than `min_wedge_angle` [rad] are curvature; `wedges` are those of the mesh. The longest wavelength [m] tells
  /// which of their faces are narrow.
  /// `many_edges`: so many that what their strips over curved faces change adds up at random.
  SurfaceWaveProspect(const TriangleMesh& mesh, std::span<const Wedge> wedges, double min_wedge_angle, double longest_wavelength,
                      bool many_edges);

  /// Size of |S| of the co-polar channels [m]: of the correction at shadow boundaries, of that where surfaces bend tightly, of
  /// sharply bent rims (docs/theory/model_uncertainty.md, B, C and E), as large as they are on spheres, and of edges beside
  /// curved faces; no bound.
  double amplitude(const Look& look, double frequency) const;

 private:
  const TriangleMesh& mesh_;
  CurvedParts curved_;
  EdgeFeatures edges_;
};

}  // namespace raytube
