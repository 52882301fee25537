// The reference itself: the limits in which the coated sphere is known otherwise.
#include "coated_sphere.h"

#include <gtest/gtest.h>

#include "closed_forms.h"

namespace raytube {
namespace {

constexpr Medium lossy{{6.0, -1.5}, {1.3, -0.4}};

Complex conducting_sphere(double radius, double k) { return closed_forms::sphere(radius, k, 0.0).first; }

// Rounding: S is a sum of ka terms of size 1/k, and Bessel functions of the other series are good to some 1e-13.
TEST(CoatedSphere, WithoutCoatIsTheConductor) {
  for (const double ka : {0.01, 1.0, 10.0, 63.0, 200.0})
    EXPECT_LE(std::abs(coated_sphere(1.0, {lossy, 0.0}, ka) - conducting_sphere(1.0, ka)),
              2e-12 * std::abs(conducting_sphere(1.0, ka)))
        << ka;
}

// The phase, too, is that of the core: its centre is the reference.
TEST(CoatedSphere, CoatOfVacuumIsNotThere) {
  for (const double ka : {0.01, 1.0, 10.0, 63.0, 150.0})
    for (const double thickness : {1e-6, 0.01, 0.3})
      EXPECT_LE(std::abs(coated_sphere(1.0, {{}, thickness}, ka) - conducting_sphere(1.0, ka)),
                2e-12 * std::abs(conducting_sphere(1.0, ka)))
          << ka << ' ' << thickness;
}

// Of the core nothing comes back through an absorber: e^{-2 |Im m| k d}, |Im m| = 0.78, is 1e-25 under the thinner coat.
TEST(CoatedSphere, CoreUnderThickAbsorberDoesNotMatter) {
  const Complex thick = coated_sphere(0.3, {lossy, 0.7}, 126.0), thicker = coated_sphere(0.7, {lossy, 0.3}, 126.0);
  EXPECT_LE(std::abs(thick - thicker), 1e-14 * std::abs(thick));
}

// z j_n(z), z y_n(z) and their slopes, from the standard library.
struct Standing {
  double psi, chi, psi_slope, chi_slope;
};
Standing standing(int n, double z) {
  const auto order = static_cast<unsigned>(n);
  const double j = std::sph_bessel(order, z), y = std::sph_neumann(order, z);
  return {z * j, z * y, z * std::sph_bessel(order - 1, z) - n * j, z * std::sph_neumann(order - 1, z) - n * y};
}

// The boundary conditions once more, of standing waves in a lossless coat: in the layer F = psi(r) chi(core) - chi(r) psi(core),
// its slope in place of its value at the core for TM, and outside psi - a (psi - j chi), with F' / F times the wave impedance
// continuous. It neither makes nor takes energy: |2 a - 1| = 1. Bessel functions are good to 1e-13, and F loses a few digits
// where its two terms nearly cancel.
TEST(CoatedSphere, LosslessCoatMatchesStandingWaves) {
  const double eps = 2.5, mu = 1.2, a = 0.8, m = std::sqrt(eps * mu), eta = std::sqrt(mu / eps);
  for (const double k : {0.7, 3.0, 10.0, 25.0}) {
    Complex sum = 0.0;
    const auto coefficient = [](double f, double slope, const Standing& out) {
      const Complex xi(out.psi, -out.chi), xi_slope(out.psi_slope, -out.chi_slope);
      const Complex value = (out.psi_slope * f - slope * out.psi) / (xi_slope * f - slope * xi);
      EXPECT_NEAR(std::abs(2.0 * value - 1.0), 1.0, 1e-14);
      return value;
    };
    for (int n = 1; n < k + 4.0 * std::cbrt(k) + 6.0; ++n) {
      const Standing core = standing(n, m * k * a), top = standing(n, m * k), out = standing(n, k);
      const Complex tm = coefficient(top.psi * core.chi_slope - top.chi * core.psi_slope,
                                     eta * (top.psi_slope * core.chi_slope - top.chi_slope * core.psi_slope), out),
                    te = coefficient(top.psi * core.chi - top.chi * core.psi,
                                     (top.psi_slope * core.chi - top.chi_slope * core.psi) / eta, out);
      sum += (n % 2 ? -1.0 : 1.0) * (n + 0.5) * (tm - te);
    }
    const Complex expected = Complex(0.0, 1.0 / k) * sum;
    EXPECT_LE(std::abs(coated_sphere(a, {{eps, mu}, 1.0 - a}, k) - expected), 1e-11 * std::abs(expected)) << k;
  }
}

// Electric and magnetic dipole of static fields: Bohren & Huffman 1983, equation 5.36, with a core of infinite permittivity and
// of no permeability. What is left out is (kb)^2 eps mu, of order 1e-5.
TEST(CoatedSphere, RayleighLimit) {
  const double b = 1.0, k = 1e-3;
  for (const Medium& medium : {Medium{2.5, 1.0}, Medium{1.0, 3.0}, lossy})
    for (const double a : {0.2, 0.6, 0.95}) {
      const Complex eps = medium.permittivity, mu = medium.permeability;
      const double f = std::pow(a / b, 3);
      const Complex electric = (eps - 1.0 + f * (1.0 + 2.0 * eps)) / (eps + 2.0 + 2.0 * f * (eps - 1.0)),
                    magnetic = (2.0 * (mu - 1.0) - f * (1.0 + 2.0 * mu)) / (2.0 * (mu + 2.0) - 2.0 * f * (mu - 1.0));
      const Complex s = coated_sphere(a, {medium, b - a}, k), dipoles = k * k * (electric - magnetic);
      EXPECT_LE(std::abs(s - dipoles), 2e-5 * std::abs(dipoles)) << a << ' ' << medium.permittivity;
    }
}

// Geometrical optics: the reflection of the flat coat at normal incidence times b/2, and the path to the front and back. What is
// left out is of relative order 1/(kb), 1/2 for the bare conductor (Ruck et al. 1970, section 3.2).
TEST(CoatedSphere, LargeSphereReflectsAsTheFlatCoat) {
  for (const double kb : {50.0, 100.0, 200.0}) {
    const double k = kb, kd = 0.5;
    const Layer coat{lossy, kd / k};
    const Complex flat = coated_response(std::span(&coat, 1), k, 1.0).reflected.te;
    const Complex s = coated_sphere(1.0 - coat.thickness, coat, k), optics = 0.5 * flat * std::polar(1.0, 2.0 * kb);
    EXPECT_LE(std::abs(s / optics - 1.0), 1.0 / kb) << kb;
  }
}

// Everything ten times as large, the wavelength too: S is a length. Rounding of k a, times k a.
TEST(CoatedSphere, ScalesWithTheWavelength) {
  const Complex one = coated_sphere(0.8, {lossy, 0.2}, 40.0), ten = coated_sphere(8.0, {lossy, 2.0}, 4.0);
  EXPECT_LE(std::abs(ten - 10.0 * one), 1e-13 * std::abs(ten));
}

}  // namespace
}  // namespace raytube
