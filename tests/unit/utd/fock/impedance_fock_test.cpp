// Fock's currents on surfaces of an impedance.
#include <gtest/gtest.h>

#include <cmath>

#include "utd/fock/impedance_fock.h"

namespace raytube {
namespace {

TEST(ImpedanceFock, WithoutImpedanceIsThatOfAConductor) {
  // What both are off: 7e-6 and 4e-6 in the dark.
  for (double xi = 0.0; xi < 10.0; xi += 0.25) {
    const FockCurrents found = impedance_fock(xi, 2.5, {0.0, 0.0}), expected = fock_in_the_dark(xi);
    EXPECT_LE(std::abs(found.hard - expected.hard), 1e-5) << xi;
    EXPECT_LE(std::abs(found.soft - expected.soft), 1e-5) << xi;
  }
  // 5e-5 times the current of physical optics, 2 and -2 xi, in the light.
  for (double xi = -5.0; xi < 0.0; xi += 0.25) {
    const FockCurrents found = impedance_fock(xi, 2.5, {0.0, 0.0}), share = fock_factors(xi);
    const Complex phase = std::polar(1.0, xi * xi * xi / 3);
    EXPECT_LE(std::abs(found.hard - 2.0 * phase * share.hard), 1e-4) << xi;
    EXPECT_LE(std::abs(found.soft + 2 * xi * phase * share.soft), 3e-4) << xi;
  }
}

TEST(ImpedanceFock, FarIntoTheLightIsPhysicalOptics) {
  // The next order in 1/xi^3 of a plane face's reflection, a quarter of it for a conductor, at xi = -5.
  const double m = 3.0, c = 5.0 / m;
  const FaceImpedance impedance{{0.5, -0.2}, {0.3, 0.4}};
  const FockCurrents found = impedance_fock(-5.0, m, impedance);
  const Complex phase = std::polar(1.0, -125.0 / 3);
  EXPECT_LE(std::abs(found.hard - phase * 2.0 * c / (c + impedance.hard)), 1e-2);
  EXPECT_LE(std::abs(found.soft / m - phase * 2.0 * c / (1.0 + impedance.soft * c)), 1e-2);
}

TEST(ImpedanceFock, ImpedancesOfFreeSpaceAreOneFunction) {
  // With Z = 1 E and H meet the same condition.
  for (const double xi : {-3.0, -0.5, 0.0, 1.0, 4.0}) {
    const FockCurrents found = impedance_fock(xi, 2.0, {1.0, 1.0});
    EXPECT_LE(std::abs(found.soft / 2.0 - found.hard), 1e-12) << xi;
  }
}

Material coat(double thickness, Complex permittivity, std::size_t frequencies) {
  Material material;
  material.kind = MaterialKind::coated;
  material.layers.assign(frequencies, {Layer{{permittivity, 1.0}, thickness}});
  return material;
}

TEST(FaceImpedance, OfACoatIsThatOfItsShortedLine) {
  // Z = j tan(k d s) / s across and j s tan(k d s) / eps in the plane of incidence, s^2 = eps - 1 at grazing.
  const Complex permittivity(4.0, -0.5);
  const std::vector<Material> materials{coat(2e-3, permittivity, 1)};
  const std::vector<double> frequencies{1e10};
  const double k = wavenumber(frequencies[0]);
  const FaceImpedance found = FaceImpedances(materials, frequencies).at(0, k);
  const Complex s = std::sqrt(permittivity - 1.0), tangent = Complex(0, 1) * std::tan(k * 2e-3 * s);
  EXPECT_LE(std::abs(found.soft - tangent / s), 1e-7);
  EXPECT_LE(std::abs(found.hard - tangent * s / permittivity), 1e-7);
}

TEST(FaceImpedance, BetweenFrequenciesIsLinearInTheirOrder) {
  const std::vector<Material> materials{coat(2e-3, {3.0, -0.1}, 3)};
  const std::vector<double> frequencies{10.2e9, 10.0e9, 10.1e9};
  const FaceImpedances known(materials, frequencies);
  const auto at = [&](double f) { return known.at(0, wavenumber(f)).hard; };
  EXPECT_LE(std::abs(at(10.05e9) - 0.5 * (at(10.0e9) + at(10.1e9))), 1e-12);
  // A single frequency has it right; the second difference over 1 % of the frequency.
  const std::vector<double> alone{10.05e9};
  const std::vector<Material> there{coat(2e-3, {3.0, -0.1}, 1)};
  EXPECT_LE(std::abs(at(10.05e9) - FaceImpedances(there, alone).at(0, wavenumber(10.05e9)).hard), 1e-4);
}

TEST(FaceImpedance, WavesRunOverWhatHasOne) {
  const auto carries = [](MaterialKind kind) {
    Material material;
    material.kind = kind;
    return carries_waves(std::vector{material}, 0);
  };
  EXPECT_TRUE(carries_waves({}, no_index));
  EXPECT_TRUE(carries(MaterialKind::coated) && carries(MaterialKind::half_space));
  EXPECT_TRUE(carries(MaterialKind::conductor));
  EXPECT_FALSE(carries(MaterialKind::absorber) || carries(MaterialKind::sheet) || carries(MaterialKind::solid));
}

// None over vacuum, whose "impedance" at grazing, 0 and infinity, would reflect all.
TEST(FaceImpedance, OfNothingCarriesNoWaves) {
  const auto carries = [](Complex permittivity) {
    Material material;
    material.kind = MaterialKind::half_space;
    material.layers = {{Layer{{permittivity, 1.0}, 0.0}}};
    return carries_waves(std::vector{material}, 0);
  };
  EXPECT_FALSE(carries(1.0) || carries({1.2, -0.1}));
  EXPECT_TRUE(carries(4.0) && carries({1.0, -5.0}));
}

}  // namespace
}  // namespace raytube
