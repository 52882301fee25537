// Edge-diffracted illumination from and to antennas at a finite distance.
#pragma once

#include "utd/interaction/near_row.h"

namespace raytube {

/// What EdgeIllumination is for plane waves, of a piece whose wave has antennas: every ray has its own cone, path and fields, and
/// every point of a face its own receiver.
class NearIllumination {
 public:
  /// Keeps references to its arguments but for the look, whose antennas are those of the wave.
  NearIllumination(const ReceivingFaces& faces, const LookVectors& look, std::span<const double> wavenumbers,
                   const LitEdgePiece& source, int reflections);
  NearIllumination(const NearIllumination&) = delete;

  /// As of EdgeIllumination.
  void at(double azimuth, std::vector<ScatteringMatrix>& density);
  std::optional<PhaseRange> survey(double azimuth);
  double work() const { return integral_.work() + tracer_.work(); }

 private:
  template <class Visit>
  void follow(double azimuth, Visit visit);
  template <class Visit>
  void follow(const NearRow& rays, const std::vector<MetFace>& mirrors, const IgnoredPatches& ignored, int reflections,
              Visit visit);
  NearRow diffracted_rays(double azimuth) const;
  double margin(double position, double way) const;

  const ReceivingFaces& faces_;
  std::span<const double> wavenumbers_;
  const LitEdgePiece& source_;
  int reflections_;
  AntennaAtEdge antenna_;
  NearRowIntegral integral_;
  RayFanTracer tracer_;
  std::array<std::vector<FanHit>, 3> hits_;  // by reflections left
  EdgeWaveTerms terms_{};                    // those of the azimuth at hand
};

}  // namespace raytube
