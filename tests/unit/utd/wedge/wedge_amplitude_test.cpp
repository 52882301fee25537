// Both faces of a wedge together: the field they radiate against the classical diffraction coefficients.
#include <gtest/gtest.h>

#include "utd/wedge/edge_currents.h"

namespace raytube {
namespace {

constexpr double k = 2 * pi;
constexpr double no_window = 1e30;  // face width [m]: the forward-grazing window shrinks to nothing

/// Edge along z, face 0 in the half plane phi = 0.
Wedge wedge_along_z(double n) {
  const double a = n * pi;
  const dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  return {-0.5 * z,
          0.5 * z,
          n,
          {WedgeFace{0, x, y, no_window},
           WedgeFace{1, std::cos(a) * x + std::sin(a) * y, std::sin(a) * x - std::cos(a) * y, no_window}}};
}

/// Edge-fixed basis: electric[0] is beta0'-hat, electric[1] phi'-hat, likewise the receive basis; cone angle beta0.
LookVectors edge_fixed_look(double cone, double source_angle, double observation_angle) {
  const dvec3 z(0, 0, 1);
  const dvec3 incident(-std::sin(cone) * std::cos(source_angle), -std::sin(cone) * std::sin(source_angle), std::cos(cone));
  const dvec3 scattered(std::sin(cone) * std::cos(observation_angle), std::sin(cone) * std::sin(observation_angle),
                        std::cos(cone));
  const dvec3 source_phi = -glm::normalize(glm::cross(z, incident)), phi = glm::normalize(glm::cross(z, scattered));
  const dvec3 source_beta = glm::cross(incident, source_phi), beta = glm::cross(scattered, phi);
  return {incident,
          scattered,
          {source_beta, source_phi},
          {glm::cross(incident, source_beta), glm::cross(incident, source_phi)},
          {beta, phi}};
}

/// Soft and hard coefficients times sqrt(2 pi k) e^{j pi/4}, real. In long double: their difference near a boundary is wanted.
struct Coefficients {
  long double soft, hard;
};

/// Keller (1962), as the limit of the uniform coefficient away from its boundaries.
Coefficients keller(long double n, long double cone, long double source, long double observer) {
  const long double half_turn = std::numbers::pi_v<long double>, edge = std::cos(half_turn / n);
  const long double factor = std::sin(half_turn / n) / (n * std::sin(cone));
  const long double minus = 1 / (edge - std::cos((observer - source) / n)), plus = 1 / (edge - std::cos((observer + source) / n));
  return {factor * (minus - plus), factor * (minus + plus)};
}

/// Edge wave inside a physical-optics integral at normal incidence: f0 and g0 of Ufimtsev (1957), summed over the lit faces.
Coefficients physical_optics(long double n, long double source, long double observer) {
  const long double half_turn = std::numbers::pi_v<long double>;
  Coefficients sum{0, 0};
  for (const auto& [from, to] : {std::pair(source, observer), std::pair(n * half_turn - source, n * half_turn - observer)}) {
    if (from >= half_turn) continue;
    sum.soft += std::sin(from) / (std::cos(to) + std::cos(from));
    sum.hard -= std::sin(to) / (std::cos(to) + std::cos(from));
  }
  return sum;
}

ScatteringMatrix fringe(const Wedge& wedge, const LookVectors& look) {
  bool windowed = false;
  return amplitude_at(edge_amplitude(wedge, incidence_on(wedge, look.incident), look), k, windowed);
}

/// Physical-optics amplitude of both half-infinite faces from their kernels in closed form.
ScatteringMatrix physical_optics(const Wedge& wedge, const LookVectors& look) {
  ScatteringMatrix sum;
  for (int side = 0; side < 2; ++side) {
    const FaceIncidence incidence = incidence_on(wedge, look.incident).faces[side];
    if (!incidence.lit) continue;
    const WedgeFace& face = wedge.faces[side];
    const double half = grazing_half_cosine(face, incidence, look.scattered), mu = 1 - 2 * half * half;
    const double hard = 1 / (std::cos(incidence.source_angle) + mu);
    const FringeKernels kernels{std::sin(incidence.source_angle) * hard, hard, -1.0 + mu * hard};
    for (int q = 0; q < 2; ++q) {
      const FaceMoment moment = face_moment(kernels, incidence, glm::dot(look.electric[q], incidence.tangent),
                                            glm::dot(look.magnetic[q], incidence.tangent));
      for (int p = 0; p < 2; ++p)
        sum.at(p, q) += (glm::dot(look.receive[p], face.into_face) * moment.across +
                         glm::dot(look.receive[p], incidence.tangent) * moment.along) /
                        (2 * pi);
    }
  }
  return sum;
}

/// D = S sqrt(2 pi/k) e^{-j pi/4} / (length sin beta0), a line of stationary phase seen from its Keller cone; here without
/// e^{-j pi/4} / sqrt(2 pi k), like the references.
Complex coefficient_of(Complex amplitude, double cone) { return 2 * pi / std::sin(cone) * amplitude; }

double distance(Complex value, long double reference) { return std::abs(value - static_cast<double>(reference)); }

TEST(WedgeAmplitude, TotalCurrentsGiveKellersDyadicOnTheCone) {
  // Kouyoumjian and Pathak (1974): E_d = -(beta0 beta0' D_s + phi phi' D_h) . E. 1e-11 relative to the largest coefficient:
  // observers keep 0.05 rad from every boundary, where physical optics and fringe are up to 20 times their sum.
  for (const double n : {2.0, 1.5, 1.3})
    for (const double cone : {0.3, 0.9, pi / 2, 2.4})
      for (const double source : {0.2, 1.1, 2.0, 2.9, 3.6})
        for (double observer = 0.05; observer < n * pi; observer += 0.173) {
          const double clearance = std::min({std::abs(observer - pi - source), std::abs(observer + source - pi),
                                             std::abs(observer + source - 2 * n * pi + pi), std::abs(observer - source + pi)});
          if (source > n * pi - 0.05 || clearance < 0.05) continue;
          SCOPED_TRACE(testing::Message() << n << ' ' << cone << ' ' << source << ' ' << observer);
          const Wedge wedge = wedge_along_z(n);
          const LookVectors look = edge_fixed_look(cone, source, observer);
          const ScatteringMatrix total = fringe(wedge, look) + physical_optics(wedge, look);
          const Coefficients exact = keller(n, cone, source, observer);
          const double tolerance = 1e-11 * static_cast<double>(std::abs(exact.soft) + std::abs(exact.hard));
          EXPECT_LE(distance(coefficient_of(total.at(0, 0), cone), -exact.soft), tolerance);
          EXPECT_LE(distance(coefficient_of(total.at(1, 1), cone), -exact.hard), tolerance);
          EXPECT_LE(std::abs(coefficient_of(total.at(0, 1), cone)), tolerance);
          EXPECT_LE(std::abs(coefficient_of(total.at(1, 0), cone)), tolerance);
        }
}

TEST(WedgeAmplitude, FringeIsKellerMinusPhysicalOptics) {
  // Normal incidence, as close as 1e-3 rad to the boundaries, where Keller reaches 1e3 and the difference stays of order one.
  // 1e-11: two boundaries 3e-2 apart leave the reference a relative error of 1e-15, and the result its rounding of phi.
  for (const double n : {2.0, 1.5, 1.25})
    for (const double source : {0.2, 0.8, 1.6, 2.3, 2.9})
      for (const double boundary : {pi - source, pi + source, 2 * n * pi - pi - source, 0.7, 2.1})
        for (const double step : {-0.3, -1e-3, 1e-3, 0.3}) {
          const double observer = boundary + step;
          if (observer <= 0.01 || observer >= n * pi - 0.01) continue;
          SCOPED_TRACE(testing::Message() << n << ' ' << source << ' ' << observer);
          const ScatteringMatrix s = fringe(wedge_along_z(n), edge_fixed_look(pi / 2, source, observer));
          const Coefficients exact = keller(n, std::numbers::pi_v<long double> / 2, source, observer);
          const Coefficients po = physical_optics(n, source, observer);
          EXPECT_LE(distance(coefficient_of(s.at(0, 0), pi / 2), po.soft - exact.soft), 1e-11);
          EXPECT_LE(distance(coefficient_of(s.at(1, 1), pi / 2), po.hard - exact.hard), 1e-11);
        }
}

TEST(WedgeAmplitude, SecondFaceMirrorsTheFirst) {
  // Exchanging the faces of the wedge is the same body: equal to rounding.
  Wedge wedge = wedge_along_z(1.4), swapped = wedge;
  std::swap(swapped.faces[0], swapped.faces[1]);
  const LookVectors look = look_vectors({{1.1, 0.7}, {0.8, 2.4}});
  const ScatteringMatrix a = fringe(wedge, look), b = fringe(swapped, look);
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q) EXPECT_LE(std::abs(a.at(p, q) - b.at(p, q)), 1e-15);
}

TEST(WedgeIncidence, GrazingLooks) {
  const Wedge edge = wedge_along_z(1.5), half_plane = wedge_along_z(2.0);
  // Over face 0 towards the edge: half, and face 0 counts as lit.
  EXPECT_EQ(incidence_on(edge, {-1, 0, 0}).weight, 0.5);
  EXPECT_TRUE(incidence_on(edge, {-1, 0, 0}).faces[0].lit);
  EXPECT_EQ(incidence_on(half_plane, {-1, 0, 0}).weight, 0.0);
  // From the open side along face 0: face 1 of the right-angled edge is lit; the half plane is met edge-on, both sides dark at
  // pi.
  EXPECT_EQ(incidence_on(edge, {1, 0, 0}).weight, 1.0);
  EXPECT_EQ(incidence_on(half_plane, {1, 0, 0}).weight, 1.0);
  for (const FaceIncidence& face : incidence_on(half_plane, {1, 0, 0}).faces) {
    EXPECT_FALSE(face.lit);
    EXPECT_EQ(face.source_angle, pi);
  }
  // From inside the metal, and along the edge.
  EXPECT_EQ(incidence_on(edge, glm::normalize(dvec3(-1, 1, 0))).weight, 0.0);
  EXPECT_EQ(incidence_on(edge, {0, 0, 1}).weight, 0.0);
}

// One side of a half plane stands for both: the same wedge between two patches is computed side by side. They differ by rounding.
TEST(WedgeAmplitude, SidesOfAHalfPlaneAreAlike) {
  Wedge sheet = wedge_along_z(2.0);
  sheet.n = 2.0;
  sheet.faces[0].width = sheet.faces[1].width = 3.0;
  sheet.faces[1].into_face = sheet.faces[0].into_face;
  sheet.faces[1].normal = -sheet.faces[0].normal;
  const Wedge folded = sheet;
  sheet.faces[1].patch = sheet.faces[0].patch;
  for (const double source : {0.3, 1.7, 3.0, 3.3, 5.9})
    for (const double observer : {0.2, 2.5, 3.6, 6.0}) {
      const LookVectors look = edge_fixed_look(1.1, source, observer);
      const WedgeIncidence incidence = incidence_on(sheet, look.incident);
      bool windowed = false, windowed_by_sides = false;
      const ScatteringMatrix once = amplitude_at(edge_amplitude(sheet, incidence, look), k, windowed),
                             by_sides = amplitude_at(edge_amplitude(folded, incidence, look), k, windowed_by_sides);
      EXPECT_LT(largest_amplitude(once - by_sides), 1e-12 * largest_amplitude(by_sides)) << source << ' ' << observer;
      EXPECT_EQ(windowed, windowed_by_sides);
    }
}

}  // namespace
}  // namespace raytube
