// Waves of an edge that an antenna at a finite distance lights, over rays of one azimuth where these meet a plane. Derived in
// docs/theory/interaction.md.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "math/lanes.h"
#include "utd/interaction/edge_illumination.h"
#include "utd/wedge/image_antenna.h"

namespace raytube {

/// The antenna as the edge's own half planes see it: rays of one azimuth come from one point, `distance` behind the edge's line.
struct AntennaAtEdge {
  double distance, along;  // how far the antenna is from the edge's line, and its position along that [m]

  AntennaAtEdge(const EdgeAxis& edge, const dvec3& antenna);
  double path_to(double position) const { return std::hypot(distance, position - along); }
  double sin_cone(double position) const { return distance / path_to(position); }
  double cos_cone(double position) const { return (position - along) / path_to(position); }
};

/// Rays of one azimuth that meet one plane.
struct NearRow {
  RayFan fan;             // the rays from the image of the edge on
  FanHit hit;             // where they meet that plane
  dvec3 across, turning;  // images of rho_hat and phi_hat of the azimuth
  dvec3 normal;           // that of the plane, against the rays
  const EdgeWaveTerms* terms;
  std::vector<MetFace> faces{};  // met so far, this plane's the last, where any of them is no perfect conductor; else empty
};

/// One of these rays.
struct NearRay {
  double path;       // from the edge on [m]
  double parameter;  // L [m]
  double sin_cone, cos_cone;
  double spread;                                  // L / path
  double area;                                    // area of the plane per position, azimuth and path
  double phase;                                   // exponent / k of the whole way [m]
  std::array<std::array<double, 2>, 2> arriving;  // [transmit][soft, hard]: components of E at the edge
  std::array<std::array<double, 4>, 2> current;   // [receive][soft, hard, outwards, around]: p . eta J per unit eta H along each
  std::vector<std::array<std::array<Complex, 4>, 2>> spectral{};  // [wavenumber] instead; empty: conductors alone
};

/// Integrals over rows of one lit piece of an edge.
class NearRowIntegral {
 public:
  /// `corners` are positions of the ends of the piece at which waves go on, infinite where there are none. Keeps references.
  NearRowIntegral(const LitEdgePiece& source, const AntennaAtEdge& antenna, std::span<const double> wavenumbers,
                  const FaceMaterials& materials)
      : source_(source), antenna_(antenna), wavenumbers_(wavenumbers), materials_(materials) {}

  NearRay ray(const NearRow& row, double position) const;

  /// Adds to `density`, per wavenumber, what the rays of the row excite [m].
  void add(const NearRow& row, const std::array<double, 2>& corners, std::vector<ScatteringMatrix>& density);

  /// Counted so far (utd/wedge/work.h).
  double work() const { return work_; }

 private:
  struct Samples;
  // For the wavenumbers from `first` on, `end` no more.
  struct Indices {
    std::size_t first, end;
  };
  void add_beside(const NearRow& row, double corner, double inwards, std::size_t index, std::vector<ScatteringMatrix>& density);
  void add_in_parts(const NearRow& row, const RowStretch& stretch, int halvings, Indices indices,
                    std::vector<ScatteringMatrix>& density);
  double where_to_split(const NearRow& row, const RowStretch& stretch) const;
  Samples sampled(const NearRow& row, const RowStretch& stretch) const;
  double detour(const NearRay& ray, double position, double corner) const;
  ScatteringMatrix excited(const NearRow& row, const Samples& samples, std::size_t index) const;
  void set_spectral_currents(const NearRow& row, const FaceReceiver& receiver, NearRay& ray) const;

  const LitEdgePiece& source_;
  const AntennaAtEdge& antenna_;
  std::span<const double> wavenumbers_;
  const FaceMaterials& materials_;
  double work_ = 0.0;
};

}  // namespace raytube
