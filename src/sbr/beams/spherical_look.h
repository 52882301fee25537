// A look from antennas at a finite distance: currents of spherical waves on planes, and what the receiver makes of them.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "math/chebyshev.h"
#include "mesh/smooth/smooth.h"
#include "sbr/beams/beam.h"
#include "sbr/beams/footprint.h"
#include "sbr/beams/surfaces_met.h"
#include "sbr/beams/tube_sums.h"
#include "scene/sweep.h"

namespace raytube {

/// A wave that comes from the image of an antenna in flat mirrors is that antenna's own wave, mirrored with them; so the field of
/// a beam is the transmitter's at the point that the mirrors fold back. A current J is received as it would be transmitted to:
///   S_pq = -(jk / 4 pi) integral of E_p . eta J_q e^{-jk (path_t + path_r)} dA,
/// E_p the receiving antenna's field (Antenna), which is the far field's S where both antennas are far away (Lorentz
/// reciprocity). Valid where the antennas are wavelengths away. Phase reference: the antennas'. Once the wave has met other than
/// perfect conductors it is taken as plane at every point (surfaces_met), and magnetic currents count as well.
class SphericalLook {
 public:
  /// `incident` is the beam as launched. `relative_tolerance`: error that polygons and facets may have in all, as a share of what
  /// they radiate. Keeps references to `antennas` and what `surfaces` refers to.
  SphericalLook(const AntennaPair& antennas, const Beam& incident, const SpectralSurfaces& surfaces, double relative_tolerance);

  const AntennaPair& antennas() const { return antennas_; }

  /// This look at one of its wavenumbers.
  SphericalLook at_frequency(std::size_t index) const;

  /// The wavenumbers of the look [rad/m].
  std::span<const double> wavenumbers() const { return wavenumbers_; }

  /// The wave of a beam at a point, as if all that it has met were perfect conductors.
  AntennaRay wave(const Beam& beam, const dvec3& r) const;
  /// The wave that came to the first of the surfaces that a beam has met, on its way to a point, folded back.
  AntennaRay wave_at_first(const Beam& beam, const dvec3& r) const;

  /// What the tubes about the launch coordinates `at` do on the plane that `outgoing` leaves, as a plane wave's: phases linear,
  /// the rest constant. For cells small against the wavelength times the distance. Where `outgoing` has met other than perfect
  /// conductors the footprint's beam refers to `spectrum`, which has its weights.
  Footprint footprint(const Beam& outgoing, const Patch& plane, const dvec2& at, Spectrum& spectrum) const;

  /// Adds what roughness scatters from so much of the launch plane about `at`, if `outgoing` has met anything rough.
  void add_incoherent(TubeSums& sums, const Beam& outgoing, const Patch& plane, const dvec2& at, double area) const;

  /// Where currents are added up: sums of one thread, and the wavenumbers of the look.
  struct Sums {
    TubeSums& tubes;
    Band& band;
  };

  /// Adds S of the currents of bounce `bounce` on a polygon of launch coordinates on the plane that `outgoing` leaves, at every
  /// wavenumber, and what quadrature may have left. Of many wavenumbers currents on perfect conductors are computed at a few and
  /// interpolated, to 1e-12 of their amplitudes' sum.
  void add(const Sums& sums, int bounce, const Beam& outgoing, const Patch& plane, const ConvexPolygon& polygon) const;

  /// Adds S of the currents of the first bounce on the part of a curved surface over a facet of this material, lit by the
  /// transmitter itself wherever it faces it. False, and nothing is added, if none of the facet's corners is
  /// lit.
  bool add(const Sums& sums, const BentFacet& facet, std::uint32_t material) const;

  /// Adds S of the part of that surface over a polygon of the facet's plane.
  void add(const Sums& sums, const BentFacet& facet, std::uint32_t material, std::span<const dvec3> corners) const;

  /// Adds S of such a part as that of bounce `bounce`, where the transmitter's wave comes through sheets, or the currents are
  /// received through them: `met` has these, and last of its surfaces the facet's plane.
  void add(const Sums& sums, int bounce, const BentFacet& facet, const SurfacesMet& met, std::span<const dvec3> corners) const;

 private:
  struct Current {
    dvec3 point;                                  // on the plane or the facet
    double path;                                  // both ways [m]
    dvec3 change;                                 // - gradient of the path, right along the plane; not for facets
    std::array<std::array<double, 2>, 2> weight;  // E_p . eta J_q, per area there

    bool lit() const { return weight != std::array<std::array<double, 2>, 2>{}; }
    static std::size_t weights_of(std::size_t /*frequencies*/) { return 1; }
    const std::array<std::array<double, 2>, 2>& weight_at(std::size_t /*frequency*/) const { return weight; }
    std::array<double, 2> incoherent_at(std::size_t /*frequency*/) const { return {}; }
  };
  // A current on other than perfect conductors, complex and different at every frequency; null: nothing is lit.
  struct SpectralCurrent {
    dvec3 point;
    double path;
    dvec3 change;
    std::shared_ptr<const ReceivedCurrents> received;

    bool lit() const { return received != nullptr; }
    static std::size_t weights_of(std::size_t frequencies) { return frequencies; }
    const ChannelWeights& weight_at(std::size_t frequency) const {
      static constexpr ChannelWeights dark{};
      return received ? received->weight[frequency] : dark;
    }
    std::array<double, 2> incoherent_at(std::size_t frequency) const {
      return received && !received->incoherent.empty() ? received->incoherent[frequency] : std::array<double, 2>{};
    }
  };
  // Of one bounce.
  struct BounceSums {
    std::vector<ScatteringMatrix>& scattering;  // of each wavenumber
    std::vector<ErrorSum>& errors;
    std::vector<std::array<double, 2>>& incoherent;  // empty: nothing is rough
    Band& band;
  };
  BounceSums sums_of(const Sums& sums, int bounce) const;
  // Corners; side i runs from corner i to the next one.
  template <class C>
  using Corners = std::array<C, 3>;

  Current current(const Beam& outgoing, const Patch& plane, const dvec3& r) const;
  Current current(const BentFacet& facet, const dvec3& r) const;
  SpectralCurrent spectral_current(const Beam& outgoing, const dvec3& r) const;
  SpectralCurrent spectral_current(const BentFacet& facet, SurfacesMet met, const dvec3& r) const;
  template <class At>
  void add_polygon(const BounceSums& sums, const Beam& outgoing, const Patch& plane, const ConvexPolygon& polygon, At at) const;
  template <class Corner, class At>
  void add_fan(const BounceSums& sums, std::size_t corners, Corner corner, At at) const;
  template <class Visit>
  auto with_current(const BentFacet& facet, std::uint32_t material, Visit visit) const;
  template <class C, class At>
  void add(const BounceSums& sums, const Corners<C>& triangle, At at) const;
  template <class C, class At>
  void add(const BounceSums& sums, const Corners<C>& triangle, const Corners<C>& middles, At at) const;
  template <class C>
  double bend_of(const Corners<C>& corners, const Corners<C>& middles) const;
  template <class C>
  static ScatteringMatrix radiated(const Corners<C>& corners, const Corners<C>& middles, std::size_t frequency, double k);
  template <class C>
  void add_smooth(const BounceSums& sums, const Corners<C>& corners, const Corners<C>& middles, double left) const;

  const AntennaPair& antennas_;
  Beam incident_;
  SpectralSurfaces surfaces_;
  std::span<const double> wavenumbers_;
  double highest_, most_bend_;
};

}  // namespace raytube
