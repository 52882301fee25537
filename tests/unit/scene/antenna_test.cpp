// Antennas at a finite distance: spherical waves, polarisation, patterns.
#include "scene/antenna.h"

#include <gtest/gtest.h>

namespace raytube {
namespace {

constexpr double rounding = 1e-14;
const AntennaPattern isotropic;
const dvec3 reference{0.02, -0.05, 0.11}, point{0.3, 0.25, -0.4};

Antenna antenna(double range, const AntennaPattern& pattern = isotropic) {
  return Antenna({{0.7, -0.4}, range}, reference, reference, pattern);
}

TEST(Antenna, IsAUnitWaveAtItsReference) {
  const SphericalBasis basis = spherical_basis({0.7, -0.4});
  const AntennaRay ray = antenna(2.5).ray_to(reference);
  EXPECT_NEAR(ray.path, 0.0, rounding);
  EXPECT_NEAR(glm::distance(ray.direction, -basis.radial), 0.0, rounding);
  EXPECT_NEAR(glm::distance(ray.field[0], basis.theta_hat), 0.0, rounding);
  EXPECT_NEAR(glm::distance(ray.field[1], basis.phi_hat), 0.0, rounding);
}

TEST(Antenna, IsASphericalWave) {
  const Antenna a = antenna(2.5);
  const AntennaRay ray = a.ray_to(point);
  const double distance = glm::distance(a.position(), point);
  EXPECT_NEAR(ray.path, distance - 2.5, rounding);
  EXPECT_NEAR(glm::distance(ray.direction, (point - a.position()) / distance), 0.0, rounding);
  for (const dvec3& field : ray.field) {
    EXPECT_NEAR(glm::dot(field, ray.direction), 0.0, rounding);
    EXPECT_NEAR(glm::length(field), 2.5 / distance, rounding);
  }
  EXPECT_NEAR(glm::dot(ray.field[0], ray.field[1]), 0.0, rounding);
}

// 94 GHz over 250 km: k R is 5e8, so that path differences taken as R - R_0 would be off by .06 rad.
TEST(Antenna, LosesNoDigitsAtLongRange) {
  constexpr double range = 250e3;
  const dvec3 radial = spherical_basis({0.7, -0.4}).radial, step = point - reference;
  const double across = glm::length(step - glm::dot(step, radial) * radial);
  const double expected = -glm::dot(step, radial) + across * across / (2.0 * range);  // next term: below 1e-11
  EXPECT_NEAR(antenna(range).ray_to(point).path, expected, 2e-11);
}

// Ludwig's third definition keeps V and H apart: on a sphere about the antenna the field turns least, so that opposite
// directions off the axis see it mirrored in the plane between them.
TEST(Antenna, PolarisationIsCarriedAlongTheShortestWay) {
  const AntennaPattern pattern;
  const Antenna a({{0.0, 0.0}, 1.0}, dvec3(0.0), dvec3(0.0), pattern);  // on +z, V along x
  const AntennaRay in_plane = a.ray_to({0.5, 0.0, 0.5}), across = a.ray_to({0.0, 0.5, 0.5});
  const double cosine = std::cos(45 * degree), spread = 1.0 / std::sqrt(0.5);
  EXPECT_NEAR(glm::distance(in_plane.field[0], spread * dvec3(cosine, 0.0, cosine)), 0.0, rounding);
  EXPECT_NEAR(glm::distance(across.field[0], spread * dvec3(1.0, 0.0, 0.0)), 0.0, rounding);
}

TEST(Antenna, GaussianBeamIsDownByHalfThePowerAtHalfItsWidth) {
  AntennaPattern pattern;
  pattern.azimuth_beamwidth = 8 * degree;
  pattern.elevation_beamwidth = 4 * degree;
  EXPECT_NEAR(pattern.amplitude(4 * degree, 0.0), std::sqrt(0.5), rounding);
  EXPECT_NEAR(pattern.amplitude(0.0, -2 * degree), std::sqrt(0.5), rounding);
  EXPECT_NEAR(pattern.amplitude(4 * degree, 2 * degree), 0.5, rounding);
  EXPECT_EQ(pattern.amplitude(0.0, 0.0), 1.0);
}

TEST(Antenna, AnglesOffTheAxisSplitByTheirBearing) {
  const Antenna a({{90 * degree, 0.0}, 3.0}, dvec3(0.0), dvec3(0.0), isotropic);  // on +x: azimuth along +y, elevation along +z
  const dvec2 right = a.off_axis(glm::normalize(dvec3(-1.0, std::tan(5 * degree), 0.0)));
  EXPECT_NEAR(right.x, 5 * degree, rounding);
  EXPECT_NEAR(right.y, 0.0, rounding);
  const dvec2 up = a.off_axis(glm::normalize(dvec3(-1.0, 0.0, std::tan(70 * degree))));
  EXPECT_NEAR(up.x, 0.0, rounding);
  EXPECT_NEAR(up.y, 70 * degree, rounding);
}

TEST(Antenna, AimedBesideTheReferenceItLosesThereWhatItsPatternSays) {
  AntennaPattern pattern;
  pattern.azimuth_beamwidth = pattern.elevation_beamwidth = 20 * degree;
  const dvec3 aim{0.0, 0.3, 0.0};
  const Antenna a({{90 * degree, 0.0}, 2.0}, dvec3(0.0), aim, pattern);
  EXPECT_NEAR(glm::length(a.ray_to(dvec3(0.0)).field[0]), pattern.amplitude(std::atan(0.15), 0.0), rounding);
  EXPECT_NEAR(glm::length(a.ray_to(aim).field[1]), 2.0 / std::hypot(2.0, 0.3), rounding);
}

TEST(Antenna, CutsAreLinearInDecibels) {
  const PatternCut cut{{-10 * degree, 0.0, 20 * degree}, {-6.0, 0.0, -20.0}};
  EXPECT_NEAR(cut.level(5 * degree), -5.0, rounding);
  EXPECT_NEAR(cut.level(-5 * degree), -3.0, rounding);
  EXPECT_EQ(cut.level(20 * degree), -20.0);
  EXPECT_TRUE(cut.reaches(-10 * degree));
  EXPECT_FALSE(cut.reaches(21 * degree));
  EXPECT_TRUE(PatternCut{}.reaches(pi));
}

}  // namespace
}  // namespace raytube
