// Edge-diffracted illumination: the waves of a lit edge excite currents of physical optics on other faces, which radiate.
// Derived in docs/theory/interaction.md; notation: edge_face_interaction.h.
#pragma once

#include <optional>
#include <vector>

#include "math/node_waves.h"
#include "scene/image.h"
#include "utd/fan/azimuth_integral.h"
#include "utd/fan/face_waves.h"
#include "utd/fan/ray_fan.h"
#include "utd/wedge/edge_currents.h"
#include "utd/wedge/edge_wave_integral.h"
#include "utd/wedge/image_antenna.h"
#include "utd/wedge/path_place.h"

namespace raytube {

/// Files of few digits turn faces by as much [rad], and move their corners by as much of their size: whether an edge touches a
/// face, and on which side of a plane light runs, is not told from less.
inline constexpr double rounding_of_files = 1e-5;

/// E e^{-jk (d.r + path)}: the incident wave, or what surfaces have made of it. Fields of unit transmit V and H.
struct PlaneWave {
  dvec3 direction;
  std::array<dvec3, 2> electric;
  double path = 0.0;  // [m]
  // At a finite distance; what stands above is then the wave at the centre of the mesh.
  std::optional<NearAntennas> antennas{};

  /// As it is about this point.
  PlaneWave about(const dvec3& point) const;
};

/// A look in which this wave arrives.
LookVectors look_of(const PlaneWave& wave, const LookVectors& look);

/// A wedge with a coordinate of its own: the position along the tangent of its first face, from `origin` on, 0 to `length` [m].
struct EdgeAxis {
  const Wedge* wedge = nullptr;
  dvec3 origin, tangent;
  double length = 0.0;
  // At either end: the faces of the wedge that meet another surface there in a concave edge. That surface carries on their waves
  // as a mirror.
  std::array<std::vector<int>, 2> abutting_faces{};

  /// Whether positions count from the wedge's end.
  bool reversed() const { return origin != wedge->start; }
};

/// A piece of an edge lit by a plane wave.
struct LitEdgePiece {
  const EdgeAxis* edge;
  const PlaneWave* wave;
  FaceIncidence incidence;  // on the first face
  double from, to;          // positions along the edge [m]
  double weight = 1.0;      // what the wave counts
  double light = 1.0;       // share in it that a border of reflected light leaves, smooth across that border
  // [wavenumber] of the wave's two fields, where it has met other than perfect conductors; else empty.
  std::vector<ChannelWeights> by_surfaces{};

  /// S of the unit wave as that of the transmitter's V and H.
  ScatteringMatrix of_transmitter(const ScatteringMatrix& s, std::size_t index) const {
    return by_surfaces.empty() ? s : times(s, by_surfaces[index]);
  }
};

/// Whether a piece ends at a surface that goes on with its waves towards this side of the edge, as their mirror; 0 its beginning.
bool ends_at_surface(const LitEdgePiece& piece, int end, const dvec3& direction);
/// Positions of the ends over which its waves go on; infinite where there are none.
std::array<double, 2> corners_of(const LitEdgePiece& piece, const dvec3& direction);

/// The faces that edges may illuminate. What is referred to must outlive it.
struct ReceivingFaces {
  const FaceTree& tree;                        // all faces: any of them may stand in the way
  const std::vector<bool>& large;              // the patches that receive, and are mirrors
  std::span<const dvec3> corners;              // where the faces jump or bend as seen from an edge; may be left out
  std::span<const std::uint32_t> first_met{};  // the only patches from which waves of edges count, ascending; empty: all
  FaceMaterials materials{};
};

/// Components of H that the waves of an edge have along them: that of a ray, of a soft and of a hard wave, and what their slopes
/// add, outwards and around.
inline constexpr int wave_components = 4;

/// Rays over which their waves are summed up.
struct ExcitedRays {
  const std::array<std::array<double, 2>, 2>& arriving;  // [transmit][soft, hard]: components of E at the edge
  double area;                                           // area of the face per position, azimuth and length of the ray, weighted
  double sin_cone, cos_cone;
};

/// S of the currents that they excite, those of unit waves being `currents`: p_hat . eta J, [receive][component].
// S = -(jk / 4 pi) p_hat . eta J * integral (Stratton & Chu 1939). Of the ray, eta H = -s_hat x (b0_hat E_s u_s + phi_hat E_h
// u_h), the diffracted E being minus the sum of the waves; the slopes of E_z and eta H_z, both -sin(beta0) of E_s and E_h, add
//   eta H = (j / k sin(beta0)) {E_s [phi_hat du_s/d(rho) - rho_hat du_s/(rho d(phi))]
//                               + cos(beta0) E_h [rho_hat du_h/d(rho) + phi_hat du_h/(rho d(phi))]}      (Maxwell's equations).
template <class Currents>
ScatteringMatrix excited(const ExcitedRays& rays, const Currents& currents, const WaveIntegrals& sums, double wavenumber) {
  const WaveSums soft_waves = sums.incident - sums.reflected, hard_waves = sums.incident + sums.reflected;
  const Complex ray(0.0, rays.area * wavenumber / (4 * pi));
  const double slope = rays.area / (4 * pi * rays.sin_cone);
  ScatteringMatrix result;
  for (int p = 0; p < 2; ++p) {
    const auto& [soft, hard, outwards, around] = currents[p];
    const Complex of_soft = ray * soft * soft_waves.value + slope * (around * soft_waves.outwards - outwards * soft_waves.around);
    const Complex of_hard =
        ray * hard * hard_waves.value + slope * rays.cos_cone * (outwards * hard_waves.outwards + around * hard_waves.around);
    for (int q = 0; q < 2; ++q) result.at(p, q) = rays.arriving[q][0] * of_soft + rays.arriving[q][1] * of_hard;
  }
  return result;
}

/// Adds up, azimuth by azimuth about the edge, the far field of the currents that the waves of one lit piece excite on all they
/// meet: on the first face, and after up to `reflections` reflections on further ones. The edge's own two faces are not met on
/// the way out. Beyond an end of the piece the wave fades (corner factor); beyond one at another surface (abutting_faces) its
/// mirror image takes over.
class EdgeIllumination {
 public:
  /// Keeps references to its arguments.
  EdgeIllumination(const ReceivingFaces& faces, const LookVectors& look, std::span<const double> wavenumbers,
                   const LitEdgePiece& source, int reflections);

  /// Sets `density` to dS / d(azimuth) [m], per wavenumber; `azimuth` is phi of the diffracted rays, measured as phi' [rad].
  void at(double azimuth, std::vector<ScatteringMatrix>& density);
  /// `weight` times the same at the only wavenumber, taken apart along the edge; appended to `pieces`.
  void take_apart(double azimuth, double weight, const PathPlace& place, std::vector<ImageEdge>& pieces);
  /// Between which phases the density lies there; none if the rays meet nothing.
  std::optional<PhaseRange> survey(double azimuth);

  /// Counted so far (utd/wedge/work.h).
  double work() const { return work_ + tracer_.work(); }

 private:
  /// Diffracted rays of one azimuth on their way.
  struct Rays {
    RayFan fan;
    double path = 0.0, path_rate = 0.0;                                  // way from the edge to where the fan begins [m]
    std::array<dvec3, wave_components> magnetic;                         // directions, as perfect conductors leave them
    std::vector<std::array<ComplexVector, wave_components>> spectral{};  // [wavenumber] once others are met; else empty
  };
  /// Where they meet a face.
  struct Footprint {
    RayRow row;
    dvec3 base, step;                                            // points on the face, by position
    double area;                                                 // area of the face per position, azimuth and length of the ray
    std::array<std::array<double, wave_components>, 2> current;  // [receive]: p_hat . eta J per unit eta H along each direction
    std::vector<std::array<std::array<Complex, wave_components>, 2>> spectral{};  // [wavenumber] instead; empty: conductors alone
  };

  double margin(double way) const;
  Rays diffracted_rays(double azimuth) const;
  EdgeWaveIntegral waves(const dvec3& direction) const;
  template <class Visit>
  void follow(Rays rays, Visit visit);
  template <class Visit>
  void follow(const Rays& rays, const IgnoredPatches& ignored, int reflections, Visit visit);
  Footprint footprint(const Rays& rays, const FanHit& hit, const Patch& plane) const;
  Rays reflected_rays(const Rays& rays, const FanHit& hit, const Patch& plane) const;
  bool meets_conductors(const Rays& rays, const Patch& plane) const;
  ComplexVector magnetic(const Rays& rays, std::size_t index, int component) const;
  void radiate(const Footprint& on, const EdgeWaveIntegral& waves, std::vector<ScatteringMatrix>& density);
  void radiate_band(const Footprint& on, const EdgeWaveIntegral& waves, std::vector<ScatteringMatrix>& density);
  struct RowPieces;
  void take_apart(const Footprint& on, const EdgeWaveIntegral& waves, double weight, const PathPlace& place,
                  std::vector<ImageEdge>& pieces) const;
  ScatteringMatrix excited(const Footprint& on, const WaveIntegrals& sums, std::size_t index, double wavenumber) const;

  const FaceTree& tree_;
  const std::vector<bool>& large_;
  std::span<const std::uint32_t> first_met_;
  const LookVectors& look_;
  std::span<const double> wavenumbers_;
  const LitEdgePiece& source_;
  FaceMaterials materials_;
  int reflections_;
  RayFanTracer tracer_;
  std::array<std::vector<FanHit>, 3> hits_;        // by reflections left
  std::array<std::array<double, 2>, 2> arriving_;  // [transmit][soft, hard]: components of E at the edge
  EdgeWaveTerms terms_;                            // those of the azimuth at hand
  Band band_;
  const ChebyshevNodes* amplitudes_;                       // where the amplitudes of waves are found; null: at all wavenumbers
  std::array<std::vector<ScatteringMatrix>, 2> at_nodes_;  // those of the wave at hand, or of both ends of a stretch
  double work_ = 0.0;
};

}  // namespace raytube
