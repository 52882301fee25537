// Conventions of raytube, said once.
//
//   Time factor e^{+j omega t}; a wave travels as e^{-j k r}; eps_r = eps' - j eps''.
//   SI units and radians inside; degrees, GHz and mm appear only in case files, outputs and names that carry the unit.
//   A Direction (theta, phi) points FROM THE TARGET TOWARDS THE RADAR; theta from +z, phi from +x towards +y.
//   V is theta-hat and H is phi-hat of the direction in question, for transmitter and receiver alike (no flip on reception).
//   S_pq [m], p receive, q transmit:  E_p^s = S_pq E_q^i e^{-jkr}/r;  sigma_pq = 4 pi |S_pq|^2 [m^2].
//   The phase reference is the origin of the mesh's own coordinates.
//   In formulas: s' propagation direction of the incident wave = -r_hat(transmit), s = r_hat(receive), q = k (s - s').
//   A wedge of interior (metal) angle alpha has the exterior angle n pi = 2 pi - alpha; a half plane is n = 2.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <glm/glm.hpp>
#include <numbers>

namespace raytube {

using glm::dvec2;
using glm::dvec3;
/// Amplitudes, permittivities.
using Complex = std::complex<double>;

inline constexpr double pi = std::numbers::pi;         // half a turn [rad]
inline constexpr double speed_of_light = 299792458.0;  // [m/s], exact by definition of the metre
inline constexpr double degree = pi / 180.0;           // [rad]

/// k = 2 pi f / c [rad/m], of a frequency in Hz.
inline double wavenumber(double frequency_hz) { return 2.0 * pi * frequency_hz / speed_of_light; }
/// c / f [m], of a frequency in Hz.
inline double wavelength(double frequency_hz) { return speed_of_light / frequency_hz; }

/// Direction from the target towards the radar [rad].
struct Direction {
  double theta = 0.0;  // from +z
  double phi = 0.0;    // from +x towards +y
  /// Equal numbers; directions a turn apart differ.
  friend bool operator==(const Direction&, const Direction&) = default;
};

/// Orthonormal right-handed triad (radial, theta_hat, phi_hat) of a direction.
/// Components are exactly 0 and 1 at multiples of 90 degrees, so that face-on and edge-on looks are exact.
struct SphericalBasis {
  dvec3 radial;     // from the target towards the radar
  dvec3 theta_hat;  // V
  dvec3 phi_hat;    // H
};
/// The triad of a direction, unit vectors.
SphericalBasis spherical_basis(const Direction& direction);

/// The direction from the origin towards a point.
Direction direction_of(const dvec3& point);

/// sin(x)/x, 1 at x = 0. Accurate to rounding for every finite x: sin(x) is exact to an ulp and x cancels.
inline double sinc(double x) { return x == 0.0 ? 1.0 : std::sin(x) / x; }

/// Complex polarimetric scattering amplitude in metres; first index receive, second transmit; 0 is V, 1 is H.
struct ScatteringMatrix {
  std::array<std::array<Complex, 2>, 2> s{};  // [receive][transmit]

  Complex vv() const { return s[0][0]; }                                        // receive V, transmit V
  Complex vh() const { return s[0][1]; }                                        // receive V, transmit H
  Complex hv() const { return s[1][0]; }                                        // receive H, transmit V
  Complex hh() const { return s[1][1]; }                                        // receive H, transmit H
  Complex& at(int receive, int transmit) { return s[receive][transmit]; }       // 0 is V, 1 is H
  Complex at(int receive, int transmit) const { return s[receive][transmit]; }  // 0 is V, 1 is H

  /// Channel by channel.
  ScatteringMatrix& operator+=(const ScatteringMatrix& other) {
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q) s[p][q] += other.s[p][q];
    return *this;
  }
  /// Every channel by the same factor.
  ScatteringMatrix& operator*=(Complex factor) {
    for (auto& row : s)
      for (Complex& value : row) value *= factor;
    return *this;
  }
  /// Channel by channel.
  friend ScatteringMatrix operator-(ScatteringMatrix a, ScatteringMatrix b) { return a += (b *= -1.0); }
  /// Channel by channel.
  friend ScatteringMatrix operator+(ScatteringMatrix a, const ScatteringMatrix& b) { return a += b; }
};

/// The largest magnitude of the four channels [m].
inline double largest_amplitude(const ScatteringMatrix& s) {
  return std::max(std::max(std::abs(s.vv()), std::abs(s.vh())), std::max(std::abs(s.hv()), std::abs(s.hh())));
}

/// Root of the sum of squares: the same in every pair of polarisation bases.
inline double frobenius_norm(const ScatteringMatrix& s) {
  return std::sqrt(std::norm(s.vv()) + std::norm(s.vh()) + std::norm(s.hv()) + std::norm(s.hh()));
}

/// Errors of the magnitudes |S_pq| [m]; indices as of ScatteringMatrix.
using ChannelErrors = std::array<std::array<double, 2>, 2>;

/// Mean square of the errors of the two co-polar channels [m^2].
inline double co_polar_square(const ChannelErrors& errors) {
  return 0.5 * (errors[0][0] * errors[0][0] + errors[1][1] * errors[1][1]);
}

/// Adds errors to others, channel by channel.
inline void add(const ChannelErrors& errors, ChannelErrors& sum) {
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q) sum[p][q] += errors[p][q];
}

/// All of them times a factor.
inline ChannelErrors scaled(ChannelErrors errors, double factor) {
  for (std::array<double, 2>& received : errors)
    for (double& error : received) error *= factor;
  return errors;
}

}  // namespace raytube
