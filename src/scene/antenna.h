// Antennas at a finite distance: what one radiates to a point, and by reciprocity what it receives from there.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "core/field.h"

namespace raytube {

/// Level against the angle off the axis in one plane.
struct PatternCut {
  std::vector<double> angles{};  // ascending [rad]; empty: 0 dB all round
  std::vector<double> levels{};  // [dB], relative to the axis

  double level(double angle) const;  // linear in between, the last value beyond the ends
  bool reaches(double angle) const;  // true if the cut says something there
};

/// How an antenna's amplitude falls off its axis: Gaussian beam times the two cuts. Angles: azimuth along phi_hat, elevation
/// along -theta_hat, together the angle off the axis split by its bearing.
struct AntennaPattern {
  double azimuth_beamwidth = std::numeric_limits<double>::infinity();    // half power, full width [rad]
  double elevation_beamwidth = std::numeric_limits<double>::infinity();  // infinite: isotropic
  PatternCut azimuth{}, elevation{};                                     // in the plane of phi_hat; in that of theta_hat

  /// The same all round.
  bool isotropic() const {
    return std::isinf(azimuth_beamwidth) && std::isinf(elevation_beamwidth) && azimuth.angles.empty() && elevation.angles.empty();
  }
  /// Field relative to the axis: at half a beamwidth off it the power is 1/2.
  double amplitude(double azimuth_angle, double elevation_angle) const;
};

/// What the antennas of a radar have in common.
struct Radar {
  AntennaPattern pattern{};            // of transmitter and receiver alike
  dvec3 aim{0.0};                      // the point on their axes, in the mesh's own coordinates [m]
  std::optional<dvec3> receive_aim{};  // on that of the receiver; none: `aim`
};

/// A radar in absolute terms. Its antennas have the same gain.
struct LinkBudget {
  double transmit_power_dbm = 0.0;  // into the transmitter's antenna
  double gain_dbi = 0.0;            // on the axis

  /// Power received by antennas at these ranges with the apparent amplitude `s` [m], into a matched load: P_t G^2 wavelength^2
  /// sigma /
  /// ((4 pi)^3 R_t^2 R_r^2), sigma = 4 pi |s|^2 (bistatic radar equation: Skolnik 2008, Radar Handbook, section 23.2). The
  /// pattern off the axis and what distances differ over the target are in `s`, whose unit fields and ranges are those at the
  /// origin.
  double received_dbm(double transmit_range, double receive_range, double frequency, Complex s) const {
    const double spread = wavelength(frequency) / (4.0 * pi * transmit_range) / receive_range;
    return transmit_power_dbm + 2.0 * gain_dbi + 20.0 * std::log10(std::hypot(s.real(), s.imag())) + 20.0 * std::log10(spread);
  }
};

/// The least turn that carries the direction `from` into `to`, applied to a vector across `from`.
inline dvec3 carried(const dvec3& vector, const dvec3& from, const dvec3& to) {
  return vector - glm::dot(vector, to) / (1.0 + glm::dot(from, to)) * (from + to);
}

/// The position of an antenna. That of the mirror image of one in a plane across z counts from the image of the origin, as the
/// antenna's own from the origin.
struct AntennaPosition {
  Direction direction;             // from the origin of the mesh's own coordinates to the antenna
  double range;                    // [m]
  std::optional<double> mirror{};  // z of the plane, in the mesh's own coordinates [m]; none: it is no image

  /// What direction and range count from, in the mesh's own coordinates.
  dvec3 reference() const { return {0.0, 0.0, mirror ? 2.0 * *mirror : 0.0}; }
  /// In the mesh's own coordinates.
  dvec3 point() const { return reference() + range * spherical_basis(direction).radial; }
};

/// A spherical wave as a point meets it.
struct AntennaRay {
  double path;                 // distance from the antenna less that of the reference point [m]
  dvec3 direction;             // of propagation, unit
  std::array<dvec3, 2> field;  // E of transmit V and H, without the phase e^{-jk path}
};

/// An antenna in its far zone, calibrated: without its pattern V and H are unit fields of phase zero at the reference point, with
/// theta_hat and phi_hat of its direction; off that line they are turned with the ray, Ludwig's third definition (Ludwig 1973,
/// IEEE Trans. AP-21, 116), and all amplitudes fall as 1/distance. Valid beyond some wavelengths from the antenna.
class Antenna {
 public:
  /// `origin` is that of the mesh's own coordinates and `aim` the point on the axis, of a mirror image that of the antenna
  /// itself, both in the coordinates that points are given in. An image has V and H as theta_hat and phi_hat of its own
  /// direction, of phase zero at the image of the origin. Keeps a reference to `pattern`.
  Antenna(const AntennaPosition& position, const dvec3& origin, const dvec3& aim, const AntennaPattern& pattern);

  /// No digits are lost at long range.
  AntennaRay ray_to(const dvec3& point) const;

  /// Its V and H there, turned with the ray.
  SphericalBasis basis_at(const dvec3& point) const;

  /// Where it stands.
  dvec3 position() const { return reference_ + range_ * basis_.radial; }
  const dvec3& radial() const { return basis_.radial; }  // unit, from the reference to the antenna
  /// The origin of the mesh's own coordinates, or its image.
  const dvec3& reference() const { return reference_; }
  /// Unit, from the antenna to the aim.
  const dvec3& axis() const { return axis_; }
  /// Distance from the reference [m].
  double range() const { return range_; }
  /// Angles off the axis, along phi_hat and along -theta_hat [rad].
  dvec2 off_axis(const dvec3& direction) const;

 private:
  dvec3 reference_;
  SphericalBasis basis_;
  double range_;
  dvec3 axis_, azimuth_hat_, elevation_hat_;
  const AntennaPattern& pattern_;
};

}  // namespace raytube
