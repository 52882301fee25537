// A look from antennas at a finite distance: currents of spherical waves on planes, and what the receiver makes of them.
#pragma once

#include <span>
#include <vector>

#include "mesh/smooth/smooth.h"
#include "sbr/beams/beam.h"
#include "sbr/beams/footprint.h"
#include "sbr/beams/tube_sums.h"
#include "scene/sweep.h"

namespace raytube {

/// A wave that comes from the image of an antenna in flat mirrors is that antenna's own wave, mirrored with them; so the field of
/// a beam is the transmitter's at the point that the mirrors fold back. A current J is received as it would be transmitted to:
///   S_pq = -(jk / 4 pi) integral of E_p . eta J_q e^{-jk (path_t + path_r)} dA,
/// E_p the receiving antenna's field (Antenna), which is the far field's S where both antennas are far away (Lorentz
/// reciprocity). Valid where the antennas are wavelengths away. Phase reference: the antennas'.
class SphericalLook {
 public:
  /// `incident` is the beam as launched. `relative_tolerance`: error that polygons and facets may have in all, as a share of what
  /// they radiate. Keeps references to `antennas` and `wavenumbers`.
  SphericalLook(const AntennaPair& antennas, const Beam& incident, std::span<const double> wavenumbers,
                double relative_tolerance);

  /// The same look at one of its wavenumbers.
  SphericalLook at_frequency(std::size_t index) const;

  /// The wave of a beam at a point.
  AntennaRay wave(const Beam& beam, const dvec3& r) const;

  /// What the tubes about the launch coordinates `at` do on the plane that `outgoing` leaves, as a plane wave's: phases linear,
  /// the rest constant. For cells small against the wavelength times the distance.
  Footprint footprint(const Beam& outgoing, const Patch& plane, const dvec2& at) const;

  /// Adds S of the currents of bounce `bounce` on a polygon of launch coordinates on the plane that `outgoing` leaves, at every
  /// wavenumber, and what quadrature may have left.
  void add(TubeSums& sums, int bounce, const Beam& outgoing, const Patch& plane, const ConvexPolygon& polygon) const;

  /// Adds S of the currents of the first bounce on the part of a curved surface over a facet, lit by the transmitter itself
  /// wherever it faces it, as on a convex body. False, and nothing is added, if none of the facet's corners is lit.
  bool add(TubeSums& sums, const BentFacet& facet) const;

  /// The same of what is over a polygon of the facet's plane.
  void add(TubeSums& sums, const BentFacet& facet, std::span<const dvec3> corners) const;

 private:
  struct Current {
    dvec3 point;                                  // on the plane or the facet
    double path;                                  // both ways [m]
    dvec3 change;                                 // - gradient of the path, right along the plane; not for facets
    std::array<std::array<double, 2>, 2> weight;  // E_p . eta J_q, per area there
  };
  struct Sums {
    std::vector<ScatteringMatrix>& scattering;  // of each wavenumber
    std::vector<ErrorSum>& errors;
  };
  Sums sums_of(TubeSums& sums, int bounce) const;
  // Corners; side i runs from corner i to the next one.
  using Triangle = std::array<Current, 3>;

  Current current(const Beam& outgoing, const Patch& plane, const dvec3& r) const;
  Current current(const BentFacet& facet, const dvec3& r) const;
  template <class Corner, class At>
  void add_fan(const Sums& sums, std::size_t corners, Corner corner, At at) const;
  template <class At>
  void add(const Sums& sums, const Triangle& triangle, At at) const;
  double bend_of(const Triangle& corners, const Triangle& middles) const;
  void add_smooth(const Sums& sums, const Triangle& corners, const Triangle& middles, double left) const;

  const AntennaPair& antennas_;
  Beam incident_;
  std::span<const double> wavenumbers_;
  double highest_, most_bend_;
};

}  // namespace raytube
