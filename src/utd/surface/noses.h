// Where a curved surface bends so sharply between flatter flanks that a wave finds a rounded edge there.
#pragma once

#include <span>
#include <vector>

#include "mesh/smooth/curvature_field.h"

namespace raytube {

/// k rho at which a bend counts half as an edge: beyond it Fock's currents are the better ones, on oblate spheroids of k rho 3.5
/// by far (VV at 40 degrees of incidence 0.3 dB, as edges of twice this radius 2.1).
inline constexpr double edge_radius = 3.0;
/// How much of an edge a bend of that radius [m] is, 0 to 1.
double narrowness(double wavenumber, double radius);
/// The least flattening e of a section that has flanks.
inline constexpr double least_flattening = 0.3;
/// The steepest normal of a flank, from that of the nose: between steeper flanks the edge is cut here.
inline constexpr double steepest_flank = 84 * degree;

/// The section across a bend as a conic (utd/rounded/conic_section), found from one facet of it.
struct Nose {
  dvec3 position, outwards, along;    // of its nose: place [m], normal, and direction of the edge
  double radius = 0.0;                // radius of curvature there [m]; 0: there is no nose
  double flattening = 0.0;            // e
  double bend = 0.0;                  // curvature of the edge times `radius`
  double angle = 0.0;                 // theta of the facet
  double turn = 0.0;                  // by which the facet turns, times its length along the edge [rad m]
  double facet_radius = 0.0;          // one over the facet's larger curvature [m]
  double evenness = 1.0;              // 0 where the radius changes along the edge as a cone's does
  std::uint32_t triangle = no_index;  // the facet

  double radius_at(double theta) const;  // [m], endless on the flanks
  double sine_to(const dvec3& ray) const { return glm::length(glm::cross(ray, along)); }
  /// How much the wave sees of an edge in it, [0, 1]: none in what has no flanks, as cylinders, none where it comes along the
  /// edge, none unless it lights both flanks.
  double edge_share(const dvec3& incident, double wavenumber) const;
  /// What a wave from one direction into another one sees of an edge, the same either way round: the harmonic mean of what either
  /// direction sees, none where one sees none.
  double edge_share(const dvec3& incident, const dvec3& scattered, double wavenumber) const;
  /// 1 where the edge is straight for a ray, 1/2 where that bends along it a quarter as much as across.
  double straightness(const dvec3& ray) const;
  /// Share of the section that its facet has for rays at an angle of that sine to the edge, and the integral of it over theta
  /// [rad] for those across.
  double facet_share(double wavenumber, double sine = 1.0) const;
  double shared_turn(double wavenumber) const;
};

/// The noses of facets, in order of triangles, that matter at `wavenumber` and above.
std::vector<Nose> find_noses(const TriangleMesh& mesh, const SmoothSurfaces& surfaces, const CurvatureField& curvatures,
                             double wavenumber);

/// The noses among `noses`, as found at that wavenumber; of facets that reach further than `longest` [m] along their edge one for
/// each part of that length, with its share of `turn`: strips of a wing's leading edge may be as long as the wing.
std::vector<Nose> noses_in_parts(const TriangleMesh& mesh, const SmoothSurfaces& surfaces, const CurvatureField& curvatures,
                                 double wavenumber, std::span<const Nose> noses, double longest);

}  // namespace raytube
