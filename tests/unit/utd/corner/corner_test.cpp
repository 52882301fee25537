// Waves along edges of sheets and thin bodies from corner to corner: their parts against closed forms, and invariances.
#include <gtest/gtest.h>

#include <cmath>

#include "mesh/repair/build_mesh.h"
#include "run.h"
#include "shapes.h"
#include "unit/utd_scene.h"
#include "utd/corner/corner_waves.h"
#include "utd/corner/order_nodes.h"

namespace raytube {
namespace {

using testing::measured;

TEST(RadialWave, OrderOneIsAnEllipticIntegral) {
  // P_{1/2}(cos x) = (2 / pi) (2 E(k) - K(k)), k = sin(x / 2) (Abramowitz & Stegun 1964, 8.13.8); x = pi - theta, cos(pi nu) =
  // -1.
  const RadialWave wave(Complex(1.0));
  for (const double theta : {1e-6, 0.01, 0.19, 0.21, 0.5, 1.0, 2.0, 2.8, 2.9, 3.1, pi}) {
    const double k = std::cos(theta / 2);
    const double exact = -(2 * std::comp_ellint_2(k) - std::comp_ellint_1(k)) / (2 * pi);
    EXPECT_NEAR(wave.at(std::cos(theta)).value.real(), exact, 1e-9) << theta;  // digits of k near theta = 0
  }
}

TEST(RadialWave, SolvesLegendresEquationWithAUnitSource) {
  for (const Complex nu : {Complex(0.6, 5.9), Complex(2.3, -0.4), Complex(15.7, -0.4)}) {
    const RadialWave wave(nu);
    for (const double theta : {0.05, 0.2, 0.3, 1.0, 2.0, 2.83, 2.85, 3.0}) {
      const double c = std::cos(theta);
      const RadialWave::Values at = wave.at(c);
      const Complex rest = (1 - c * c) * at.bend - 2 * c * at.slope + (nu * nu - 0.25) * at.value;
      EXPECT_LE(std::abs(rest), 1e-6 * std::abs(nu * nu * at.value)) << theta;  // a Taylor series' last terms
    }
    const double small = 1e-5;
    EXPECT_LE(std::abs(wave.at(std::cos(small)).value + std::log(small) / (2 * pi) - wave.smooth_at_source()), 1e-6);
  }
}

TEST(RadialBasis, HasTheSlopesOfTheGreensFunctions) {
  const RadialBasis& basis = RadialBasis::of_all_orders();
  double worst = 0.0;
  for (std::size_t order = 0; order < nodes_over_orders().size(); ++order) {
    RadialSum sum;
    sum.add(Complex(0, 2), order);
    for (const double theta : {0.05, 0.19, 0.21, 0.5, 1.0, 2.0, 2.8, 2.9, 3.1, pi}) {
      const RadialBasis::Slopes at = basis.at(std::cos(theta));
      const RadialWave::Values wave = basis.wave(order).at(std::cos(theta));
      // To the greatest of all angles' at an order: those grow as theta^-2 and theta^-4 to the source.
      worst = std::max({worst, std::abs(sum.slope(at) - Complex(0, 2) * wave.slope) * theta * theta,
                        std::abs(sum.bend(at) - Complex(0, 2) * wave.bend) * std::pow(theta, 4)});
    }
  }
  measured("slopes of radial waves off those of their basis", worst, "");
  EXPECT_LE(worst, 1e-8);
}

TEST(RadialWave, DigammaAtKnownPlaces) {
  EXPECT_NEAR(digamma(1.0).real(), -std::numbers::egamma, 1e-14);
  EXPECT_NEAR(digamma(0.5).real(), -std::numbers::egamma - 2 * std::numbers::ln2, 1e-13);
  EXPECT_NEAR(digamma(Complex(0.5, 2.0)).imag(), pi / 2 * std::tanh(2 * pi), 1e-13);  // 6.3.12
}

dvec3 towards(double height, double azimuth) {
  return {std::cos(height) * std::cos(azimuth), std::cos(height) * std::sin(azimuth), std::sin(height)};
}

TEST(SheetCorner, StraighterCornersStartWeakerWaves) {
  // 180 degrees are no corner, and start nothing.
  double before = 1e300;
  for (const double angle : {120.0, 150.0, 165.0}) {
    const SheetCorner corner(angle * degree);
    double sum = 0.0;
    for (const double height : {0.4, 0.8, 1.2}) {
      // off the cone of the other edge, into which that one diffracts
      const SheetCorner::Start wave = corner.start(towards(height, -0.2));
      sum += norm(wave.flat + wave.upright);
    }
    measured("starts of a corner, sum over three directions", sum, "");
    EXPECT_LT(sum, before);
    before = sum;
  }
}

TEST(SheetCorner, IsContinuousDownToTheSheet) {
  const SheetCorner corner(pi / 2);
  for (const double azimuth : {-0.6, -0.3, 0.0, 0.5, 1.2, 2.0, -2.5}) {  // not at the ends of the arc, 0.79
    const auto start = [&](double height) {
      const SheetCorner::Start parts = corner.start(towards(height, azimuth));
      return parts.flat + parts.upright;
    };
    ComplexVector before = start(0.2);
    for (double height = 0.1995; height > 0; height -= 0.0005) {
      const ComplexVector now = start(height);
      // Twenty times its mean change over such a step; quadrature and interpolation differ by 1e-3 where they meet.
      EXPECT_LE(norm(now - before), 0.01 * (norm(before) + 0.1)) << azimuth << ' ' << height;
      before = now;
    }
  }
}

/// Edges of a polygon in a plane, anticlockwise about its normal, as wedges.
std::vector<Wedge> rim(const std::vector<dvec3>& polygon) {
  std::vector<Wedge> wedges;
  const dvec3 normal = glm::normalize(glm::cross(polygon[1] - polygon[0], polygon[2] - polygon[1]));
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const dvec3 &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    wedges.push_back(test::half_plane(from, to, glm::normalize(glm::cross(normal, to - from)), normal, 2.0, 0));
  }
  return wedges;
}

const std::vector<dvec3> triangle = {{0, 0, 0}, {2.3, 0.2, 0}, {0.8, 1.7, 0}};

/// From antennas at infinity.
void add(const CornerWaves& waves, std::uint32_t wedge, double share, const LookVectors& look,
         std::span<const double> frequencies, std::span<ScatteringMatrix> sum) {
  const auto visit = [&](const dvec3& corner) {
    return CornerWaves::Visit{look, -glm::dot(look.incident, corner), glm::dot(look.scattered, corner)};
  };
  const std::array<dvec3, 2> corners = waves.corners_of(wedge);
  waves.add(wedge, share * waves.part(wedge, look.incident), {visit(corners[0]), visit(corners[1])}, frequencies, sum);
}

ScatteringMatrix waves_of(const std::vector<Wedge>& wedges, const Look& look, double frequency) {
  const CornerWaves waves(wedges);
  const double frequencies[] = {frequency};
  std::vector<ScatteringMatrix> sum(1);
  for (std::uint32_t i = 0; i < wedges.size(); ++i)
    if (waves.kind(i).has_value()) add(waves, i, 1.0, look_vectors(look), frequencies, sum);
  return sum[0];
}

double difference(const ScatteringMatrix& a, const ScatteringMatrix& b) { return largest_amplitude(a - b); }

TEST(CornerWaves, AreReciprocal) {
  const Direction a{1.0, 0.7}, b{1.9, 4.0};
  const ScatteringMatrix there = waves_of(rim(triangle), {a, b}, 1.3 * speed_of_light);
  const ScatteringMatrix back = waves_of(rim(triangle), {b, a}, 1.3 * speed_of_light);
  EXPECT_GT(largest_amplitude(there), 1e-3);
  EXPECT_LE(std::abs(there.vv() - back.vv()), 1e-15);
  EXPECT_LE(std::abs(there.vh() - back.hv()), 1e-15);
  EXPECT_LE(std::abs(there.hh() - back.hh()), 1e-15);
}

TEST(CornerWaves, DoNotCareForThePlaceTheSizeOrTheOrderOfEdges) {
  const Look look{{1.1, 0.4}, {1.1, 0.4}};
  const ScatteringMatrix s = waves_of(rim(triangle), look, speed_of_light);
  const auto turned = [](const dvec3& p) { return dvec3(-p.y, p.x, p.z); };  // by 90 degrees about z
  std::vector<dvec3> moved, doubled;
  for (const dvec3& p : triangle) moved.push_back(turned(p)), doubled.push_back(2.0 * p);
  const ScatteringMatrix by_turn = waves_of(rim(moved), {{1.1, 0.4 + pi / 2}, {1.1, 0.4 + pi / 2}}, speed_of_light);
  EXPECT_LE(difference(s, by_turn), 1e-12);
  ScatteringMatrix by_size = waves_of(rim(doubled), look, speed_of_light / 2);
  EXPECT_LE(difference(s, by_size *= 0.5), 1e-12);
  const ScatteringMatrix by_order = waves_of(rim({triangle[2], triangle[0], triangle[1]}), look, speed_of_light);
  EXPECT_LE(difference(s, by_order), 1e-12);
  // From below, as the mirror image: V's component along z changes its sign, so that V stays and H turns.
  const ScatteringMatrix below = waves_of(rim(triangle), {{pi - 1.1, 0.4}, {pi - 1.1, 0.4}}, speed_of_light);
  EXPECT_LE(std::abs(s.vv() - below.vv()), 1e-12);
  EXPECT_LE(std::abs(s.hh() - below.hh()), 1e-12);
  EXPECT_LE(std::abs(s.hv() + below.hv()), 1e-12);
}

TEST(CornerWaves, RunOnlyBetweenConvexCornersOfSheets) {
  const CornerWaves ell(rim({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}));
  for (const std::uint32_t i : {0u, 1u, 4u, 5u}) EXPECT_TRUE(ell.kind(i).has_value()) << i;
  for (const std::uint32_t i : {2u, 3u}) EXPECT_FALSE(ell.kind(i).has_value()) << i;
  std::vector<Wedge> box = rim(triangle);
  for (Wedge& wedge : box) wedge.n = 1.5;
  for (const std::uint32_t i : {0u, 1u, 2u}) EXPECT_FALSE(CornerWaves(box).kind(i).has_value());
  std::vector<Wedge> hinge = rim({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}});
  for (const Wedge& wedge : rim({{0, 0, 0}, {0, 1, 0}, {0, 1, 2}, {0, 0, 2}})) hinge.push_back(wedge);
  const CornerWaves at_fold(hinge);
  EXPECT_FALSE(at_fold.kind(0).has_value());  // ends at the fold
  EXPECT_TRUE(at_fold.kind(1).has_value());   // the edge opposite to it
}

TEST(CornerWaves, RunOverSmallSheetsWhoseCoordinatesAreRounded) {
  // As files in single precision have them, 30 m from the origin.
  std::vector<Wedge> wedges;
  const auto single = [](const dvec3& p) { return dvec3(glm::vec3(p)); };
  for (int i = 0; i < 40; ++i) {
    const dvec3 at(30.0 + 0.0731 * i, 18.0 + 0.0127 * i, 0);
    const dvec3 u(0.04, 0.03, 0), v(-0.024, 0.032, 0);
    for (const Wedge& wedge : rim({single(at), single(at + u), single(at + u + v), single(at + v)})) wedges.push_back(wedge);
  }
  const CornerWaves waves(wedges);
  for (std::uint32_t i = 0; i < wedges.size(); ++i) EXPECT_TRUE(waves.kind(i).has_value()) << i;
}

TEST(CornerWaves, AnEdgeThatBendsHasThemAsAWholeOrNotAtAll) {
  for (const double bend : {0.1, 0.15}) {  // twice; 15 degrees are 0.26
    const dvec3 b(1, 0, 0), c = b + dvec3(std::cos(bend), std::sin(bend), 0);
    const CornerWaves waves(rim({{0, 0, 0}, b, c, c + dvec3(std::cos(2 * bend), std::sin(2 * bend), 0), {0.5, 3, 0}}));
    for (const std::uint32_t i : {0u, 1u, 2u}) EXPECT_EQ(waves.kind(i).has_value(), bend == 0.1) << i;
  }
}

TEST(CornerWaves, VanishWhereAnEdgeDiffractsAlongAnother) {
  // In the principal planes of a rectangle the strips have all of it.
  const std::vector<Wedge> plate = rim({{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0}});
  EXPECT_EQ(largest_amplitude(waves_of(plate, {{1.0, 0}, {1.0, 0}}, speed_of_light)), 0.0);
  const double beside = largest_amplitude(waves_of(plate, {{1.0, 1e-3}, {1.0, 1e-3}}, speed_of_light));
  EXPECT_LE(beside, 1e-6);
  EXPECT_GT(largest_amplitude(waves_of(plate, {{1.0, 0.5}, {1.0, 0.5}}, speed_of_light)), 1e-3);
}

TEST(CornerWaves, FrequenciesAtOnceAreThoseOneByOne) {
  const std::vector<Wedge> wedges = rim(triangle);
  const CornerWaves waves(wedges);
  const LookVectors look = look_vectors({{1.1, 0.4}, {0.6, 2.0}});
  const std::vector<double> frequencies = {0.5 * speed_of_light, speed_of_light, 3 * speed_of_light};
  std::vector<ScatteringMatrix> all(3);
  add(waves, 1, 0.7, look, frequencies, all);
  for (std::size_t f = 0; f < 3; ++f) {
    std::vector<ScatteringMatrix> one(1);
    add(waves, 1, 0.7, look, std::span(frequencies).subspan(f, 1), one);
    EXPECT_EQ(difference(one[0], all[f]), 0.0);
  }
}

TEST(SolidCorner, OfACubeIsThatOfAFinerSolution) {
  // Own solution with 64 points a side and the harmonic taken 0.6 rad from the edge; here they are 16 and 0.2.
  const SolidCorner corner({pi / 2, pi / 2, pi / 2});
  struct Case {
    double theta, phi;  // edge along -z, first face beside the edge along -y, the other one along -x
    std::array<Complex, 3> start;
  };
  for (const Case& c : {Case{60, 35, {Complex(-.0528, -.0036), {-.0331, -.0001}, {.1077, .0052}}},
                        Case{60, 15, {Complex(-.0706, -.0256), {-.0147, .0023}, {.1247, .0417}}},
                        Case{110, 40, {Complex(.0162, -.0002), {.0145, -.0002}, {.0598, -.0009}}},
                        Case{30, 10, {Complex(-.3445, -.1374), {-.1592, .0576}, {.2118, .0723}}}}) {
    const Direction from{c.theta * degree, c.phi * degree};
    const dvec3 w = spherical_basis(from).radial;
    const ComplexVector start = corner.start({-w.z, -w.y, -w.x});
    EXPECT_LE(std::abs(dot(start, {0, 0, 1}) + c.start[0]), 0.004) << c.theta;
    EXPECT_LE(std::abs(dot(start, {0, 1, 0}) + c.start[1]), 0.004) << c.theta;
    EXPECT_LE(std::abs(dot(start, {1, 0, 0}) + c.start[2]), 0.004) << c.theta;
  }
  EXPECT_EQ(norm(corner.start(glm::normalize(dvec3(1, 1, 1)))), 0.0);  // from inside
}

TEST(SolidCorner, IsContinuousDownToItsFaces) {
  const SolidCorner corner({80 * degree, 100 * degree, 70 * degree});
  // Over the first face, away from its ends.
  for (const double along : {0.5, 0.8, 1.1}) {
    const auto start = [&](double height) {
      return corner.start({std::cos(height) * std::cos(along), std::cos(height) * std::sin(along), -std::sin(height)});
    };
    ComplexVector before = start(0.4);
    for (double height = 0.399; height > 0; height -= 0.001) {
      const ComplexVector now = start(height);
      // Thirty times its mean change over such a step.
      EXPECT_LE(norm(now - before), 0.03 * (norm(before) + 0.1)) << along << ' ' << height;
      before = now;
    }
  }
}

/// Edges of a closed body of plane faces.
std::vector<Wedge> edges_of(const PolygonSoup& soup) { return find_wedges(build_mesh(soup, 1.0).mesh, 5.0 * degree); }

/// Of a scalene triangle.
PolygonSoup prism_of_three_sides() { return shapes::prism({{0, 0}, {2.1, 0.3}, {0.7, 1.9}}, 0.0, 2.4); }

TEST(SolidEdges, RunBetweenCornersOfThreeEdges) {
  const auto count = [](const std::vector<Wedge>& wedges) {
    const CornerWaves waves(wedges);
    std::size_t edges = 0;
    for (std::uint32_t i = 0; i < wedges.size(); ++i) edges += waves.kind(i).has_value();
    return edges;
  };
  EXPECT_EQ(count(edges_of(shapes::cube(2.0))), 12);
  EXPECT_EQ(count(edges_of(prism_of_three_sides())), 9);
  std::vector<dvec2> polygon;
  for (int i = 0; i < 12; ++i) polygon.push_back({std::cos(i * pi / 6), std::sin(i * pi / 6)});
  EXPECT_EQ(count(edges_of(shapes::prism(polygon, 0.0, 2.0))), 0);  // edges of 30 degrees between its sides
}

TEST(SolidEdges, HaveReciprocalWavesThatTurnAndMirrorWithTheBody) {
  const PolygonSoup body = prism_of_three_sides();
  const Direction a{1.0, 0.7}, b{1.2, 1.6};
  const double f = speed_of_light;
  const ScatteringMatrix there = waves_of(edges_of(body), {a, b}, f), back = waves_of(edges_of(body), {b, a}, f);
  EXPECT_GT(largest_amplitude(there), 1e-3);
  EXPECT_LE(std::abs(there.vv() - back.vv()), 1e-14);
  EXPECT_LE(std::abs(there.vh() - back.hv()), 1e-14);
  EXPECT_LE(std::abs(there.hh() - back.hh()), 1e-14);
  const double c = std::cos(0.4), s = std::sin(0.4);
  const glm::dmat3 turn(dvec3(c, s, 0), dvec3(-s, c, 0), dvec3(0, 0, 1)), mirror(dvec3(1, 0, 0), dvec3(0, -1, 0), dvec3(0, 0, 1));
  const auto turned = [](const Direction& d) { return Direction{d.theta, d.phi + 0.4}; };
  // Meshes are centred in their boxes, so that phases have another origin.
  const ScatteringMatrix other = waves_of(edges_of(shapes::transformed(body, turn)), {turned(a), turned(b)}, f);
  EXPECT_LE(std::abs(std::abs(there.vv()) - std::abs(other.vv())), 1e-12);
  EXPECT_LE(std::abs(std::abs(there.vh()) - std::abs(other.vh())), 1e-12);
  EXPECT_LE(std::abs(std::abs(there.hh()) - std::abs(other.hh())), 1e-12);
  PolygonSoup image = shapes::transformed(body, mirror);
  for (auto& polygon : image.polygons) std::ranges::reverse(polygon);
  const ScatteringMatrix mirrored = waves_of(edges_of(image), {{a.theta, -a.phi}, {b.theta, -b.phi}}, f);
  // Of two equal faces the other one is first, and angles are rounded.
  EXPECT_LE(std::abs(there.vv() - mirrored.vv()), 1e-5);
  EXPECT_LE(std::abs(there.hh() - mirrored.hh()), 1e-5);
  EXPECT_LE(std::abs(there.hv() + mirrored.hv()), 1e-5);
}

// Where the radar sets behind a face, too.
TEST(SolidEdges, HaveWavesThatNowhereStep) {
  const CornerWaves waves(edges_of({{{1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {.1, .2, 1.5}},
                                    {{3, 2, 1, 0}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}}));
  const std::vector<double> frequencies{2 * speed_of_light};
  const auto at = [&](double phi) {
    std::vector<ScatteringMatrix> sum(1);
    for (std::uint32_t i = 0; i < 8; ++i)
      if (waves.kind(i).has_value()) add(waves, i, 1.0, look_vectors({{0.96, phi}, {0.96, phi}}), frequencies, sum);
    return sum[0];
  };
  ScatteringMatrix before = at(0.0);
  double largest = 0.0;
  for (double phi = 0.004; phi < 2 * pi; phi += 0.004) {
    const ScatteringMatrix now = at(phi);
    largest = std::max(largest, largest_amplitude(now));
    // k times the size times the step is 0.1; without the weight of faces they step by 0.01.
    EXPECT_LE(difference(now, before), 0.001) << phi;
    before = now;
  }
  EXPECT_GT(largest, 0.005);
}

TEST(SolidEdges, FadeWhereTheyAreLong) {
  const std::vector<Wedge> wedges = edges_of(shapes::cube(2.0));
  const Look look{{1.0, 0.5}, {1.0, 0.5}};
  EXPECT_GT(largest_amplitude(waves_of(wedges, look, 5 * speed_of_light)), 0.0);
  EXPECT_EQ(largest_amplitude(waves_of(wedges, look, 21 * speed_of_light)), 0.0);  // 42 wavelengths
}

/// A wing's edges: chord 3 m along x between two arcs that rise so far, span 3 m along y, its ends turned by `sweep` [rad].
std::vector<Wedge> wing(double rise, double sweep = 0.0) {
  constexpr int parts = 16;
  std::vector<dvec2> outline;
  for (const double side : {-1.0, 1.0})
    for (int i = 0; i < parts; ++i) {
      const double x = 1.0 - 2.0 * i / parts;
      outline.push_back({1.5 * -side * -x, side * rise * (1.0 - x * x)});
    }
  const glm::dmat3 turn(dvec3(1, 0, 0), dvec3(0, 0, 1), dvec3(std::tan(sweep), -1, 0));
  return find_wedges(build_mesh(shapes::transformed(shapes::prism(outline, -1.5, 1.5), turn), 1.0).mesh, 5.0 * degree);
}

std::size_t edges_with_waves(const std::vector<Wedge>& wedges) {
  const CornerWaves waves(wedges);
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < wedges.size(); ++i)
    if (waves.kind(i).has_value() && waves.first_of(i) == i) ++count;
  return count;
}

// The thinner a wing, the more it is the sheet in its middle.
TEST(ThinEnds, OfAThinWingHaveTheWavesOfASheet) {
  for (const double sweep : {0.0, 0.5}) {
    const double shift = 1.5 * std::tan(sweep);
    const std::vector<dvec3> sheet = {
        {-1.5 + shift, -1.5, 0}, {1.5 + shift, -1.5, 0}, {1.5 - shift, 1.5, 0}, {-1.5 - shift, 1.5, 0}};
    const Look look{{1.2, 0.5}, {1.3, 0.9}};
    const ScatteringMatrix limit = waves_of(rim(sheet), look, speed_of_light);
    double before = 1e300;
    for (const double rise : {1e-1, 1e-2, 1e-3}) {
      const double apart = difference(waves_of(wing(rise, sweep), look, speed_of_light), limit);
      EXPECT_LT(apart, 0.3 * before) << sweep << ' ' << rise;
      before = apart;
    }
    EXPECT_LE(before, 0.01 * largest_amplitude(limit)) << sweep;  // phase of the shifted edge, k t ln(1/kt)
  }
}

TEST(ThinEnds, HaveReciprocalWavesThatMirrorImagesShare) {
  const std::vector<Wedge> wedges = wing(0.15);
  const Direction a{1.0, 0.7}, b{1.3, 4.0};
  const ScatteringMatrix there = waves_of(wedges, {a, b}, speed_of_light), back = waves_of(wedges, {b, a}, speed_of_light);
  EXPECT_GT(largest_amplitude(there), 1e-3);
  EXPECT_LE(std::abs(there.vv() - back.vv()), 1e-13);
  EXPECT_LE(std::abs(there.vh() - back.hv()), 1e-13);
  const ScatteringMatrix mirrored = waves_of(wedges, {{pi - a.theta, a.phi}, {pi - b.theta, b.phi}}, speed_of_light);
  EXPECT_LE(std::abs(there.vv() - mirrored.vv()), 1e-9);
  EXPECT_LE(std::abs(there.hh() - mirrored.hh()), 1e-9);
  EXPECT_LE(std::abs(there.hv() + mirrored.hv()), 1e-9);
}

TEST(ThinEnds, AreThoseBetweenSharpEdgesAlone) {
  EXPECT_EQ(edges_with_waves(wing(0.2)), 4);
  EXPECT_EQ(edges_with_waves(wing(0.5)), 0);  // width of the ends 0.22 of their length, angle at the tips 67 degrees
  std::vector<Wedge> rounded = wing(0.2);
  std::erase_if(rounded, [](const Wedge& wedge) { return wedge.interior_angle() < 60 * degree && wedge.start.x > 1.4; });
  EXPECT_EQ(edges_with_waves(rounded), 0);
}

TEST(ThinEnds, FadeAsTheyGetThickForTheWave) {
  // Mean thickness 0.2 of a length of 3: k t^2 / L of a sheet to 1.7 times that wave's, none from 4 times on.
  const std::vector<Wedge> wedges = wing(0.15);
  const Look look{{1.2, 0.5}, {1.2, 0.5}};
  EXPECT_GT(largest_amplitude(waves_of(wedges, look, 0.5 * speed_of_light)), 1e-3);
  const CornerWaves waves(wedges);
  const std::vector<double> frequencies = {20 * speed_of_light};
  for (std::uint32_t i = 0; i < wedges.size(); ++i) {
    if (!waves.kind(i).has_value() || wedges[i].interior_angle() < 60 * degree) continue;
    std::vector<ScatteringMatrix> sum(1);
    add(waves, i, 1.0, look_vectors(look), frequencies, sum);
    EXPECT_EQ(largest_amplitude(sum[0]), 0.0) << i;
  }
}

}  // namespace
}  // namespace raytube
