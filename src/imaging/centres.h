// Scattering centres: the places that the pieces of a look scatter from, resolved to a cube of a given side.
//
// The pieces stand for S about the look: S(K) = sum of S_i e^{j (K - K_0) . x_i}. Over wave vectors within pi / side of K_0, of
// Hann's weights, the image is I(x) = sum of S_i h(x_i - x), h the product of the weights' transforms along three axes. The
// strongest place of all four channels together is a centre; its response is taken off, and so on (CLEAN: Hogbom, Astron.
// Astrophys. Suppl. 15 (1974), 417). Then the amplitudes are fitted to all pieces at once, by least squares over those wave
// vectors.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "imaging/piece_clusters.h"

namespace raytube {

/// `to_radar`: the direction of the look.
LookAxes axes_of_look(const Direction& to_radar);

struct CentreOptions {
  std::size_t count = 50;                 // at most
  double side = 0.0;                      // of the cube that is resolved: c / 2B, lambda / 2 dphi [m]
  double wavelength = 0.0;                // [m]
  std::vector<std::string> mechanisms{};  // that pieces may belong to, by ScatteringPiece::mechanism
};

struct ScatteringCentre {
  dvec3 place;                              // [m]
  ScatteringMatrix s;                       // [m]
  std::vector<double> shares{};             // of the power of the pieces within the cube, by mechanism; of sum 1
  std::optional<std::uint32_t> triangle{};  // with the strongest current within it
  // Over which the sum of the pieces within the cube is within 3 dB of its largest, as far as is resolved: frequency as a share
  // of the look's, angles [rad].
  double band = 0.0, azimuth = 0.0, elevation = 0.0;

  std::size_t mechanism() const;  // the one with the largest share
};

struct ScatteringCentres {
  std::vector<ScatteringCentre> centres;  // the strongest first
  ScatteringMatrix rest;                  // of S, that they do not hold [m]
  std::vector<std::string> mechanisms;    // names of the shares

  /// The mechanism with the largest share of a centre.
  const std::string& mechanism_of(const ScatteringCentre& centre) const { return mechanisms[centre.mechanism()]; }
};

/// Throws InputError for a target of more cells than can be held.
ScatteringCentres scattering_centres(const std::vector<ScatteringPiece>& pieces, const LookAxes& axes,
                                     const CentreOptions& options);

/// What the centres add up to at a wave vector that differs from the look's own by `change` [rad/m].
ScatteringMatrix scattering_of(const std::vector<ScatteringCentre>& centres, const dvec3& change);

}  // namespace raytube
