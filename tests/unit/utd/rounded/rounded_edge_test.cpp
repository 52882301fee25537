// Rounded edges against the exact two-dimensional solution with endless flanks, energy, reciprocity and the sharp wedge.
#include <gtest/gtest.h>

#include "utd/rounded/rounded_edge.h"
#include "utd/rounded/rounded_wedge.h"

namespace raytube {
namespace {

constexpr double k = 2 * pi;

/// Edge along z, face 0 in the half plane phi = 0, no forward-grazing window.
Wedge wedge_of(double interior_angle) {
  const double n = 2 - interior_angle / pi, a = n * pi, no_window = 1e30;
  const dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  return {-0.5 * z,
          0.5 * z,
          n,
          {WedgeFace{0, x, y, no_window},
           WedgeFace{1, std::cos(a) * x + std::sin(a) * y, std::sin(a) * x - std::cos(a) * y, no_window}}};
}

/// Directions towards both antennas: azimuth about the edge and elevation above the plane across it.
struct Antennas {
  double source, source_elevation, observer, observer_elevation;
};

LookVectors look_of(const Antennas& at) {
  return look_vectors(
      {.transmit = {pi / 2 - at.source_elevation, at.source}, .receive = {pi / 2 - at.observer_elevation, at.observer}});
}

/// An arc whose ends are kt from the virtual apex.
RoundedWedge arc_wedge(double interior_angle, double tangent_distance) {
  return {interior_angle, section_modes(arc_section(interior_angle, tangent_distance), interior_angle, tangent_distance)};
}

/// At the wavenumber across the edge.
RoundedWedge arc_modes(const RoundedEdge& edge, const WedgeIncidence& incidence, const LookVectors& look) {
  return arc_wedge(edge.wedge.interior_angle(), wavenumber_across(incidence, look, k) * edge.section.tangent_distance());
}

ScatteringMatrix arc_amplitude(const Wedge& wedge, double radius, const LookVectors& look) {
  const WedgeIncidence incidence = incidence_on(wedge, look.incident);
  const RoundedEdge edge{wedge, arc_of(radius, wedge.interior_angle())};
  return rounded_edge_amplitude(edge, arc_modes(edge, incidence, look), incidence, look, k);
}

/// Soft and hard, root mean square over monostatic looks from 2.03 degrees off the faces on.
struct Strengths {
  double soft = 0.0, hard = 0.0;
};

template <class Find>
Strengths mean_strengths(double n, Find find) {
  constexpr int looks = 97;
  Strengths sum;
  for (int i = 0; i < looks; ++i) {
    const double margin = 2.03 * degree, angle = margin + (n * pi - 2 * margin) * i / (looks - 1);
    const ScatteringMatrix s = find(angle);
    sum.soft += std::norm(s.at(0, 0)) / looks;
    sum.hard += std::norm(s.at(1, 1)) / looks;
  }
  return {std::sqrt(sum.soft), std::sqrt(sum.hard)};
}

struct MeanCase {
  double interior_angle, wavenumber_radius;  // [deg], k rho
  Strengths rounding, all;                   // |dP| and |P - physical optics| over root lambda, of the boundary-integral solution
};

constexpr MeanCase mean_cases[] = {{20, 0.05, {0.040, 0.038}, {0.090, 0.083}}, {20, 0.2, {0.17, 0.15}, {0.097, 0.073}},
                                   {60, 0.1, {0.012, 0.012}, {0.080, 0.074}},  {60, 0.5, {0.085, 0.079}, {0.087, 0.058}},
                                   {60, 1, {0.20, 0.17}, {0.084, 0.047}},      {90, 0.2, {0.008, 0.008}, {0.070, 0.064}},
                                   {90, 1, {0.071, 0.073}, {0.071, 0.046}},    {120, 0.5, {0.007, 0.008}, {0.055, 0.049}},
                                   {120, 2, {0.054, 0.068}, {0.049, 0.035}},   {150, 3, {0.013, 0.022}, {0.030, 0.025}}};

// The tables are rounded to two digits; the small ones to one, half a unit of which is 7 % of 0.007.
constexpr double rounding_of_tables = 0.08;

TEST(RoundedEdge, HasTheMeanStrengthOfTheExactSolution) {
  for (const MeanCase& at : mean_cases) {
    const Wedge wedge = wedge_of(at.interior_angle * degree);
    const RoundedEdge edge{wedge, arc_of(at.wavenumber_radius / k, wedge.interior_angle())};
    const RoundedWedge modes = arc_wedge(wedge.interior_angle(), k * edge.section.tangent_distance());
    const auto with = [&](auto amplitude) {
      return mean_strengths(wedge.n, [&](double angle) {
        const LookVectors look = look_of({angle, 0, angle, 0});
        return amplitude(incidence_on(wedge, look.incident), look);
      });
    };
    const Strengths rounding = with([&](const WedgeIncidence& incidence, const LookVectors& look) {
      return rounding_amplitude(edge, modes, incidence, look);
    });
    const Strengths all = with([&](const WedgeIncidence& incidence, const LookVectors& look) {
      return rounded_edge_amplitude(edge, modes, incidence, look, k);
    });
    EXPECT_NEAR(rounding.soft, at.rounding.soft, rounding_of_tables * at.rounding.soft) << at.interior_angle;
    EXPECT_NEAR(rounding.hard, at.rounding.hard, rounding_of_tables * at.rounding.hard) << at.interior_angle;
    EXPECT_NEAR(all.soft, at.all.soft, rounding_of_tables * at.all.soft) << at.interior_angle;
    EXPECT_NEAR(all.hard, at.all.hard, rounding_of_tables * at.all.hard) << at.interior_angle;
  }
}

struct ExactCase {
  double interior_angle, tangent_distance, observer, source;  // [deg], kt, [rad]
  Complex soft, hard;
};

// Boundary-integral solutions with all modes. But for those above kt + 8 or so, which make the difference.
TEST(RoundedEdge, HasTheStrengthOfTheExactSolution) {
  const ExactCase cases[] = {{25, 0.6, 0.8, 0.8, {-0.009265, 0.019749}, {0.043274, -0.095441}},
                             {25, 1.2, 2.1, 0.5, {-0.018373, 0.062714}, {0.037156, -0.110393}},
                             {52, 0.27, 0.8, 0.8, {-0.002604, 0.006881}, {0.011122, -0.027351}},
                             {52, 1.2, 2.1, 0.5, {-0.020221, 0.051610}, {0.044667, -0.068774}},
                             {83, 0.6, 2.1, 0.5, {-0.008885, 0.016919}, {0.015247, -0.012168}},
                             {112, 1.2, 0.8, 0.8, {-0.019530, 0.014081}, {0.078461, -0.037750}},
                             {143, 0.6, 2.1, 0.5, {-0.005802, 0.003540}, {0.006134, 0.000953}},
                             {25, 3, 2.1, 0.5, {-0.087764, 0.138401}, {0.175064, -0.251623}},
                             {60, 5.2, 2.1, 0.5, {-0.183042, 0.140214}, {0.353284, -0.241763}},
                             {112, 2.5, 0.8, 0.8, {-0.040094, 0.007362}, {0.167148, -0.029596}}};
  for (const ExactCase& at : cases) {
    const RoundedWedge wedge = arc_wedge(at.interior_angle * degree, at.tangent_distance);
    EXPECT_NEAR(std::abs(wedge.soft(at.observer, at.source) - at.soft), 0.0, 5e-5) << at.interior_angle;
    EXPECT_NEAR(std::abs(wedge.hard(at.observer, at.source) - at.hard), 0.0, 5e-5) << at.interior_angle;
  }
}

// No power is lost: 1 + 2T is unitary, for a section that is no arc and leans over, too; to the highest modes left out.
TEST(RoundedEdge, OfAnySectionLosesNoPower) {
  const double alpha = 70 * degree, distance = 2.5, a = 2 * pi - alpha;
  // A cubic Bezier curve from face 1 to face 0 with handles of different lengths.
  const dvec2 from = distance * dvec2(std::cos(a), std::sin(a)), to(distance, 0), first = 0.5 * from, second = 0.7 * to;
  const Section section = [=](double u) {
    const double v = 1 - u;
    return SectionPoint{v * v * v * from + 3 * v * v * u * first + 3 * v * u * u * second + u * u * u * to,
                        3 * v * v * (first - from) + 6 * v * u * (second - first) + 3 * u * u * (to - second),
                        6 * v * (second - 2.0 * first + from) + 6 * u * (to - 2.0 * second + first)};
  };
  const SoftHardModes modes = section_modes(section, alpha, distance);
  for (const ModeMatrix* t : {&modes.soft, &modes.hard})
    for (std::size_t m = 0; m < 6; ++m)
      for (std::size_t q = 0; q < 6; ++q) {
        Complex product = 0.0;
        const auto unitary = [&](std::size_t i, std::size_t j) { return 2.0 * t->at(i, j) + (i == j ? 1.0 : 0.0); };
        for (std::size_t i = 0; i < t->size; ++i) product += std::conj(unitary(i, m)) * unitary(i, q);
        EXPECT_NEAR(std::abs(product - (m == q ? 1.0 : 0.0)), 0.0, 1e-3);
        EXPECT_NEAR(std::abs(t->at(m, q) - t->at(q, m)), 0.0, 1e-3);
      }
}

// Up to kt = 0.45, T = -jK with K_00 = k^2 A / 2n, A the area of the metal that is taken away, and K_11 = -+ C (kt)^(2/n).
TEST(RoundedEdge, FollowsTheClosedFormOfSmallRadii) {
  const std::pair<double, double> constants[] = {{60, 0.206}, {90, 0.1295}, {120, 0.0718}};  // alpha [deg], C
  for (const auto& [angle, constant] : constants)
    for (const double distance : {0.02, 0.05, 0.2}) {
      const double alpha = angle * degree, n = 2 - alpha / pi, rho = distance * std::tan(alpha / 2);
      const double area = rho * rho * (1 / std::tan(alpha / 2) - (pi - alpha) / 2), first = constant * std::pow(distance, 2 / n);
      const SoftHardModes modes = section_modes(arc_section(alpha, distance), alpha, distance);
      EXPECT_NEAR(-modes.hard.at(0, 0).imag(), area / (2 * n), 0.005 * area / (2 * n));
      EXPECT_NEAR(modes.hard.at(1, 1).imag(), first, 0.02 * first);
      EXPECT_NEAR(-modes.soft.at(1, 1).imag(), first, 0.02 * first);
    }
}

// Modes are symmetric to 1e-5 of S.
TEST(RoundedEdge, IsReciprocalInAllDirections) {
  Wedge wedge = wedge_of(70 * degree);
  const auto turn = [](dvec3& v) { v = {v.y, v.z, v.x}; };  // so that V and H mix soft and hard waves
  for (dvec3* v : {&wedge.start, &wedge.end, &wedge.faces[0].into_face, &wedge.faces[0].normal, &wedge.faces[1].into_face,
                   &wedge.faces[1].normal})
    turn(*v);
  const Antennas there{1.2, 0.4, 0.3, 0.7}, back{0.3, 0.7, 1.2, 0.4};
  const auto amplitude = [&](const LookVectors& look) {
    const WedgeIncidence incidence = incidence_on(wedge, look.incident);
    const RoundedEdge edge{wedge, arc_of(0.1, wedge.interior_angle())};
    return rounding_amplitude(edge, arc_modes(edge, incidence, look), incidence, look);
  };
  const ScatteringMatrix s = amplitude(look_of(there)), r = amplitude(look_of(back));
  ASSERT_GT(std::abs(s.at(0, 1)), 1e-3);
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q) EXPECT_NEAR(std::abs(s.at(p, q) - r.at(q, p)), 0.0, 5e-6);
}

// Faces are alike: seen from the other one the same numbers come out.
TEST(RoundedEdge, DoesNotDependOnWhichFaceIsTheFirst) {
  const double n = 2 - 70.0 / 180;
  const Wedge wedge = wedge_of(70 * degree);
  Wedge turned = wedge;
  std::swap(turned.faces[0], turned.faces[1]);
  std::swap(turned.start, turned.end);
  const LookVectors look = look_of({0.4, 0.3, n * pi - 1.0, 0.2});
  const ScatteringMatrix a = arc_amplitude(wedge, 0.1, look);
  const ScatteringMatrix b = arc_amplitude(turned, 0.1, look);
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q) EXPECT_NEAR(std::abs(a.at(p, q) - b.at(p, q)), 0.0, 1e-12);
}

TEST(RoundedEdge, WithoutRadiusIsTheSharpWedge) {
  for (const double alpha : {20 * degree, 90 * degree, 150 * degree}) {
    const Wedge wedge = wedge_of(alpha);
    for (const Antennas& at : {Antennas{0.5, 0.4, 0.5, 0.4}, Antennas{1.0, -0.2, 2.0, 0.3}}) {
      const LookVectors look = look_of(at);
      const WedgeIncidence incidence = incidence_on(wedge, look.incident);
      bool windowed = false;
      const ScatteringMatrix sharp = amplitude_at(edge_amplitude(wedge, incidence, look), k, windowed);
      const ScatteringMatrix rounded = arc_amplitude(wedge, 1e-13, look);
      for (int p = 0; p < 2; ++p)
        for (int q = 0; q < 2; ++q) EXPECT_NEAR(std::abs(sharp.at(p, q) - rounded.at(p, q)), 0.0, 1e-9);
    }
  }
}

// Face 0 lit and seen from straight above: its physical optics is -jk/2pi of the area, the arc's by quadrature here.
TEST(RoundedEdge, TakesTheArcFromThePhysicalOpticsOfTheFaces) {
  const double alpha = 90 * degree, radius = 0.3;
  const Wedge wedge = wedge_of(alpha);
  const LookVectors look = look_of({pi / 2, 0, pi / 2, 0});
  const ScatteringMatrix s = missing_physical_optics({wedge, arc_of(radius, alpha)}, incidence_on(wedge, look.incident), look, k);
  Complex arc = 0.0;  // INT cos(theta) e^{2jk rho (cos(theta) - 1)} rho dtheta over the lit quarter
  constexpr int points = 20000;
  for (int i = 0; i < points; ++i) {
    const double theta = (i + 0.5) / points * pi / 2;
    arc += std::cos(theta) * std::polar(radius * pi / 2 / points, 2 * k * radius * (std::cos(theta) - 1));
  }
  const Complex expected = Complex(0, -k / (2 * pi)) * (radius - arc);
  EXPECT_NEAR(std::abs(s.at(0, 0) - expected), 0.0, 1e-8);
  EXPECT_NEAR(std::abs(s.at(1, 1) - expected), 0.0, 1e-8);
  EXPECT_NEAR(std::abs(s.at(0, 1)), 0.0, 1e-12);
}

// The end of an ellipse with half axes a and b, b^2 / a its radius: points, and radii from second differences of them.
TEST(ConicSection, IsAnEllipseAboutTheEndOfItsAxis) {
  const double a = 3, b = 1;
  const ConicSection conic{b * b / a, 1 - b * b / (a * a), 80 * degree};
  for (const double theta : {0.0, 0.3, -0.9, 1.3}) {
    const dvec2 p = conic.at(theta);
    EXPECT_NEAR(std::pow((p.x + a) / a, 2) + std::pow(p.y / b, 2), 1.0, 1e-12);
    const double step = 1e-4, arc = glm::distance(conic.at(theta + step), conic.at(theta - step));
    EXPECT_NEAR(arc / (2 * step), conic.radius_at(theta), 1e-6 * conic.radius_at(theta));
  }
  const dvec2 along = conic.at(conic.end) - dvec2(conic.apex(), 0);
  EXPECT_NEAR(glm::length(along), conic.tangent_distance(), 1e-12);
  EXPECT_NEAR(along.x * std::cos(conic.end) + along.y * std::sin(conic.end), 0.0, 1e-12);
}

// A conic that is an arc has its modes; 1e-5 is the error of these.
TEST(ConicSection, HasTheModesOfAnArc) {
  const double alpha = 70 * degree, distance = 2.5;
  const SoftHardModes expected = section_modes(arc_section(alpha, distance), alpha, distance);
  const ConicSection conic = arc_of(distance * std::tan(alpha / 2) / k, alpha);
  const SoftHardModes modes = section_modes(section_of(conic, k), alpha, distance);
  for (std::size_t m = 0; m < 4; ++m)
    for (std::size_t q = 0; q < 4; ++q) EXPECT_NEAR(std::abs(modes.hard.at(m, q) - expected.hard.at(m, q)), 0.0, 1e-5);
}

}  // namespace
}  // namespace raytube
