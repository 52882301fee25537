// The ray that a straight edge diffracts from a source at any distance to a point at any distance: with the rays of geometrical
// optics it gives the total field, continuous over every shadow and reflection boundary and over the ends of the edge.
#pragma once

#include <limits>
#include <optional>

#include "mesh/features/wedges.h"
#include "utd/wedge/ray_source.h"

namespace raytube {

/// A wedge with a straight edge; arc length on it is measured from `origin` along `tangent`. Angles as in EdgeWaveTerms, from the
/// face of `into_face` and `normal`.
struct StraightEdge {
  dvec3 origin;                                             // where arc length is 0 [m]
  dvec3 into_face, normal;                                  // x_f and n_f of face 0, unit
  double n = 2.0;                                           // exterior angle / pi, in (0, 2]
  double begin = -std::numeric_limits<double>::infinity();  // [m]
  double end = std::numeric_limits<double>::infinity();     // arc lengths of its ends [m]

  /// Unit, along the edge.
  dvec3 tangent() const { return glm::cross(into_face, normal); }
};

/// The whole of a mesh's wedge; its origin is wedge.start.
StraightEdge straight_edge(const Wedge& wedge);

/// A ray from the source over the edge to the observer. Q may lie beyond the ends of the edge: what arrives then is the
/// uniform remainder of the corner wave.
struct EdgeRay {
  double arc_length;                       // place of the diffraction point Q on the edge [m]
  dvec3 point;                             // Q
  dvec3 arriving, leaving;                 // s' and s, unit
  double path;                             // from source to observer over Q [m]
  double spread;                           // what a straight ray as long as this one would have
  double source_angle, observation_angle;  // phi' and phi, in [0, n pi] [rad]
  double sin_cone;                         // sin(beta0)
  double distance_parameter;               // L [m]
  std::array<double, 2> detours;           // how much longer the way over either end of the edge is [m]
};

/// Closed form: about the edge's line the observer is turned into the plane of source and edge, where the ray is straight
/// (Keller's cone). L and A of Kouyoumjian and Pathak (1974) for plane, cylindrical and spherical waves; sqrt(L) A |E_i(Q)| /
/// sin(beta0) is `spread`, a symmetric one. Throws InputError if source or observer lies on the edge's line or in the metal, or a
/// line source is not parallel to the edge.
EdgeRay edge_ray(const StraightEdge& edge, const RaySource& source, const dvec3& observer);

/// False if source or observer lies in the metal or on the edge's line, or a plane wave comes along it: there is no ray then.
bool has_edge_ray(const StraightEdge& edge, const RaySource& source, const dvec3& observer);

/// A point about an edge's line: rho and z [m], and the angle from face 0 [rad], negative in the metal.
struct AboutEdge {
  double distance;  // rho [m]
  double along;     // z [m]
  double angle;     // [rad]
  dvec3 outwards;   // unit, from the line to the point
};

/// The rays of one source over one edge; both must be as edge_ray() wants them.
class EdgeRays {
 public:
  /// Keeps copies of both.
  EdgeRays(const StraightEdge& edge, const RaySource& source);
  /// None where has_edge_ray() is false. `observer` in the coordinates of the edge [m].
  std::optional<EdgeRay> to(const dvec3& observer) const;

 private:
  StraightEdge edge_;
  RaySource source_;
  AboutEdge from_;
};

/// The diffracted ray for a unit scalar wave that vanishes (soft) or has no slope (hard) on the wedge.
struct DiffractedWave {
  Complex soft, hard;  // per unit of the incident wave
};

/// The terms of EdgeWaveTerms with the argument rate sqrt(kL), each times its corner factor C = H_begin + H_end - 1. Per end,
/// with x^2 = k detour and z = rate sqrt(kL) of the term, H is the step of the Fresnel integral across the end,
///   inside 1 - G, outside G,   G = (1/2) e^{-jx^2} W(x) z^2 / (z^2 + x^2),
/// so that H = 1/2 from both sides as Q passes the end; the last factor is the share of the corner wave this edge has, of which
/// the other edge that meets there has the rest. It is 0 on the boundary itself, so the wave ends there with the rays it
/// completes. The idea of a uniform corner term after Sikta, Burnside, Chu and Peters (1983), IEEE Trans. AP-31, 584; this one is
/// our own (docs/theory/edges_derivation.md). Valid for k L above about 1.
DiffractedWave diffracted_wave(const StraightEdge& edge, const EdgeRay& ray, double wavenumber);

/// E_d = -[b0_hat b0'_hat soft + phi_hat phi'_hat hard] . p, the edge-fixed unit vectors of Kouyoumjian and Pathak (1974):
/// phi'_hat along -t x s', b0'_hat = s' x phi'_hat, phi_hat along t x s, b0_hat = s x phi_hat.
ComplexVector diffracted_field(const StraightEdge& edge, const EdgeRay& ray, const ComplexVector& moment, double wavenumber);

/// E [V/m] at `observer` by the ray over the edge. For the total field add the source's own ray and the reflected ones where they
/// exist, with the weight 1/2 within 1e-12 rad of their boundary; for n < 1 the multiply reflected ones too. Throws InputError as
/// edge_ray does, and if `wavenumber` is not positive.
ComplexVector diffracted_field(const StraightEdge& edge, const RaySource& source, const dvec3& observer, double wavenumber);

}  // namespace raytube
