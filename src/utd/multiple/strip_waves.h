// Waves on the faces of a polygonal body: what starts strips on a face, how far these run, and what goes on at the far edge.
// Notation in multiple_diffraction.h.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "mesh/features/outlines.h"
#include "utd/wedge/incidence.h"

namespace raytube {

/// Sine between a strip and an edge below which the strip runs along the edge.
inline constexpr double along_edge = 1e-6;

/// What strips count that arrive at an edge with this sine, where their current is taken as that of a plane wave: one that runs
/// along the edge is none. An engineering bound: of a bundle the width falls with the sine, the edge's answer grows.
inline double skew_window(double sine) {
  constexpr double least = 0.05;
  return sine * sine / (sine * sine + least * least);
}

/// A wave that starts strips on one face of one wedge.
struct StripWave {
  std::uint32_t wedge = no_index;
  int face = 0;
  FaceIncidence incidence;
  // Sign of H along the edge against the wave it came from, times the share of an image, and twice where it stands for two waves.
  double sign = 1.0;
  int strips_left = 1;            // strips one after another that are still followed, this one included
  bool lights_far_edges = false;  // the incident wave only grazes this face: beyond it the count of strips begins anew
  dvec3 direction;                // sigma, in the face: of the grazing diffracted ray the strips follow
  dvec3 across;                   // x_f, mirrored with the strips as the tangent and the direction are
  // The wedge and its face whose fringe current this is; of a mirrored wave not those it starts at.
  std::uint32_t source = no_index;
  int source_face = 0;
  int mirrors = 0;  // right-angle corners that have mirrored it

  bool goes_on() const { return strips_left > 1 || lights_far_edges; }
};

/// The wave that the incident wave, of direction `incident` = s', starts on faces[face] of a wedge; `order` strips one after
/// another are followed.
StripWave first_wave(std::span<const Wedge> wedges, std::uint32_t wedge, int face, const FaceIncidence& incidence,
                     const dvec3& incident, int order);

/// The edge at which the strip of `wave` on `face` from `point` ends; null if it is taken as semi-infinite: over a smooth
/// crease, or because nothing stops it.
const OutlineEdge* strip_end(const Outlines& outlines, const WedgeFace& face, const StripWave& wave, const dvec3& point);

/// The waves on both faces of the wedge at a strip's end; none where nothing goes on: at a concave or missing wedge, at one that
/// is nearly flat, where the strip arrives along it, or when no strips are left. The wave there is half of the arriving current
/// (the other half is its own reflection), E along the edge is none.
std::optional<std::array<StripWave, 2>> waves_beyond(std::span<const Wedge> wedges, const StripWave& wave,
                                                     const OutlineEdge& edge);

/// Image continuation of a wave's strips beyond a right-angle corner, where the face meets another one that stands on it. By
/// image theory they run on in the face with mirrored directions and, J' = -R J, the opposite sign. None at other edges: where
/// the angle is not right the reflected wave leaves the face. None after two corners.
std::optional<StripWave> mirrored_wave(std::span<const Wedge> wedges, const StripWave& wave, const OutlineEdge& edge);

}  // namespace raytube
