// Features of a target that asymptotic physics has no waves for, or none of their own.
#pragma once

#include <span>
#include <vector>

#include "mesh/features/wedges.h"
#include "scene/material.h"

namespace raytube {

/// A point at which wedges end or turn.
struct SharpCorner {
  double weight;                            // 0 ... 1: how sharp its wedges are (n - 1), times how far they turn there
  double reach;                             // longest of its wedges [m]
  std::uint32_t first_normal, last_normal;  // of the faces at it: TargetFeatures::corner_normals[first ... last - 1]
};

/// A wedge, or a straight part of one, whose currents are missing or are those of other faces than it has.
struct WeakEdge {
  dvec3 middle, half;  // recentred coordinates; vector from the middle to the end [m]
  std::array<dvec3, 2> normals;
  double sharpness;   // n - 1, at most 1
  double missing;     // share of its currents that is missing, whatever the wavelength
  double width;       // of its narrower face: currents on faces below a wavelength are not those of a wedge [m]
  bool curved;        // one of its faces is
  std::uint32_t run;  // edges of one run go on in one another without a corner, or lie beside one narrow face
};

/// A crease of a tessellation: between two facets of a curved surface.
struct SmoothCrease {
  std::array<std::uint32_t, 2> triangles;
  float length, radius;  // of the crease; of curvature across it [m]
  float angle;           // between the facets' normals [rad]
  float area;            // half of the two facets [m^2]
};

/// A plane, or a curved surface as a whole.
struct FaceExtent {
  double area = 0.0;  // [m^2]
  bool ends = false;  // at edges; a closed smooth surface has none
  std::uint32_t material = no_index;
};

/// What of a target is curved.
struct CurvedParts {
  std::vector<SmoothCrease> creases;
  std::vector<FaceExtent> faces;
  std::vector<bool> patches;  // [patch] it is a facet of a curved surface
};

/// Corners, and edges whose currents are missing or wrong, at wavelengths at which the same plates are thin.
struct EdgeFeatures {
  std::vector<SharpCorner> corners;
  std::vector<dvec3> corner_normals;
  std::vector<WeakEdge> edges;  // run after run
};

/// Which edges have currents of their own.
struct EdgeCurrents {
  bool conductors = true;                    // of wedges between perfect conductors
  bool materials = false;                    // of all others
  std::vector<double> material_strengths{};  // of each material: 0 is as if it were not there, 1 a conductor; empty: 0
  std::vector<double> sheet_shares{};        // of each material: of rims of sheets, how much of their currents there is; else 0
  bool over_curved = false;                  // follow curved faces between conductors
};

/// Shares of the amplitude of a wave.
struct PenumbraShares {
  double of_edges = 0.0, of_smooth = 0.0;
  double shells = 0.0;  // what meets closed smooth surfaces that let waves through, all of it
};

/// The shares of a wave reflected evenly by these faces that their edges take, or that waves of edges put in its place, and that
/// shadow boundaries of closed smooth surfaces do: the root mean square over their area of (wavelength / side)^{1/2}, 1 at most,
/// which is what a Fresnel zone takes of a face beside its edges (Born & Wolf 1999, section 8.7: its width is that of wavelength
/// times distance, the distance that of another such face). Many faces add up as squares, so their number plays no part.
PenumbraShares penumbra_shares(std::span<const FaceExtent> faces, double wavelength, std::span<const Material> materials = {});

/// Creases flatter than `min_wedge_angle` [rad] are curvature.
CurvedParts find_curved_parts(const TriangleMesh& mesh, double min_wedge_angle);

/// `wedges` as they are at the wavelengths in question, of which `wavelength` [m] is the longest.
EdgeFeatures find_edge_features(std::span<const Wedge> wedges, const CurvedParts& curved, const EdgeCurrents& currents,
                                double wavelength);

/// The share of the weak edges, by length, that have a curved face.
double curved_share(std::span<const WeakEdge> edges);

/// Whether a face of this width [m] is narrow: below half a wavelength.
constexpr bool is_narrow(double width, double wavelength) { return width < 0.5 * wavelength; }

}  // namespace raytube
