// What a look lights of the features of a target, and how these add up in it.
#pragma once

#include "scene/sweep.h"
#include "uncertainty/target_features.h"

namespace raytube {

/// What a look meets. Refers to what it was made of.
struct TargetFeatures {
  const TriangleMesh& mesh;
  const CurvedParts& curved;
  const EdgeFeatures& edges;
};

/// Lengths [m] of one look at one frequency; the same for the look with transmitter and receiver exchanged.
struct LookFeatures {
  double corners = 0.0;  // root of the sum of squares over lit corners of weight times the wavelength, or the reach if shorter
  double edges = 0.0;    // of weak edges: their length in phase over 2 pi, root of the sum of squares over runs
  double tight_curves = 0.0;          // PO currents of curved surfaces times the share that curvature changes, in phase
  double rims = 0.0;                  // of curved surfaces whose radius is below a wavelength, as edges: as `edges`
  ChannelErrors shadow_boundaries{};  // of curved surfaces: as `edges`, times the share of a sharp edge's field
};

/// Shadows that parts of the target cast on others are left out: what is turned to an antenna counts.
LookFeatures find_look_features(const TargetFeatures& target, const Look& look, double frequency);

}  // namespace raytube
