// The currents beside a shadow boundary, and where it runs.
#include "utd/surface/shadow_boundary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "shapes.h"
#include "solve/solve.h"
#include "utd/rounded/rims.h"
#include "utd/surface/lit_frame.h"

namespace raytube {
namespace {

// Convex, about an axis along z, seen at its point in direction x.
SurfaceFrame bent(double along_y, double along_z) { return {dvec3(1, 0, 0), dvec3(0, along_y, along_z)}; }

TEST(LitFrame, IsThatOfAnObliqueCylinder) {
  // A cylinder of radius 2 is a plane problem for k sin b': |xi| = (k sin b' R / 2)^(1/3) cos(theta) / sin b', and waves with E
  // or H across its axis keep apart. Exact but for rounding.
  for (const double theta : {0.0, 0.4, 1.2, 1.5})
    for (const double azimuth : {0.1, 0.7, 1.5}) {
      const dvec3 d = -dvec3(std::cos(theta), std::sin(theta) * std::cos(azimuth), std::sin(theta) * std::sin(azimuth));
      const LitFrame frame(bent(0.5, 0.0), d);
      const double sine = std::sqrt(1.0 - d.z * d.z), k = 30.0;
      EXPECT_NEAR(frame.distance(k), -std::cbrt(0.5 * k * sine * 2.0) * std::cos(theta) / sine, 1e-9);
      EXPECT_NEAR(frame.bent.z, 0.0, 1e-9);
      EXPECT_NEAR(glm::dot(frame.straight, d), 0.0, 1e-12);
    }
}

TEST(LitFrame, SecondOrderAtNormalIncidence) {
  // J = J_PO (1 +- j (kappa_1 - kappa_2) / 2k) along the principal directions; nothing on a sphere.
  const double k = 4000.0;
  const LitFrame frame(bent(3.0, 1.0), dvec3(-1, 0, 0));
  const double xi = frame.distance(k);
  EXPECT_NEAR(0.25 / (-xi * xi * xi), (3.0 - 1.0) / (2 * k), 1e-15);
  EXPECT_NEAR(std::abs(frame.bent.y), 1.0, 1e-12);
  EXPECT_EQ(lit_excess(LitFrame(bent(2.0, 2.0), dvec3(-1, 0, 0)), k).hard, 0.0);
}

TEST(LitFrame, NearTheBoundaryTheCurvatureAlongTheWaveDecides) {
  // |xi| = (k / 2 kappa_t)^(1/3) |n . d| for any curvature across; 1e-4 are left of it at 0.2 degrees.
  const double grazing = 0.2 * degree, k = 50.0;
  for (const double across : {0.0, 1.0, 4.0}) {
    const LitFrame frame(bent(1.5, across), dvec3(-std::sin(grazing), std::cos(grazing), 0.0));
    EXPECT_NEAR(frame.distance(k) / (-std::cbrt(k / 3.0) * std::sin(grazing)), 1.0, 1e-4);
  }
}

TEST(LitFrame, HollowSurfacesAreAsFlat) {
  EXPECT_EQ(lit_excess(LitFrame(bent(-1.0, -2.0), glm::normalize(dvec3(-0.2, 1, 0))), 10.0).soft, 0.0);
}

TEST(LitFrame, NothingWhereTheSurfaceIsHollowAlongTheWave) {
  // A saddle, grazed along its hollow direction: what it is convex by across the wave makes no shadow boundary there.
  const LitFrame frame(bent(-1.0, 2.0), glm::normalize(dvec3(-1e-3, 1, 0)));
  EXPECT_EQ(lit_excess(frame, 10.0).hard, 0.0);
  EXPECT_EQ(lit_excess(frame, 10.0).soft, 0.0);
}

// Of a hard wave that meets a circular cylinder of radius 1 (Bowman, Senior & Uslenghi 1969, eq. 2.2.1.3): the current at
// `angle` from the shadow boundary, in the dark.
Complex current_of_a_cylinder(double k, double angle) {
  Complex sum = 0.0;
  const int last = static_cast<int>(k + 8 * std::cbrt(k) + 10);
  for (int n = 0; n <= last; ++n) {
    const auto hankel = [&](int m) { return Complex(std::cyl_bessel_j(double(m), k), -std::cyl_neumann(double(m), k)); };
    const Complex slope = n == 0 ? -hankel(1) : 0.5 * (hankel(n - 1) - hankel(n + 1));
    sum += (n == 0 ? 1.0 : 2.0) * std::polar(1.0, -0.5 * pi * n) * std::cos(n * (0.5 * pi - angle)) / slope;
  }
  return sum * Complex(0, -2 / (pi * k));
}

TEST(DarkWay, FallsAsTheCreepingWaveOfACylinder) {
  // Over 30 degrees at k = 1000 (m^2 = 63), where the wave that comes the other way is 6e-5: the first order leaves 0.8 %.
  const double k = 1000.0, from = 20 * degree, to = 50 * degree;
  const auto after = [&](double angle) {
    DarkWay way;
    for (int i = 0; i < 100; ++i) way.step(1.0, 0.0, angle / 100);
    return way.currents(k).hard * std::polar(1.0, -k * angle);
  };
  const Complex exact = current_of_a_cylinder(k, to) / current_of_a_cylinder(k, from);
  EXPECT_LE(std::abs(after(to) / after(from) / exact - 1.0), 1e-3);
  const auto first = [&](double angle) {
    return fock_in_the_dark(std::cbrt(0.5 * k) * angle).hard * std::polar(1.0, -k * angle);
  };
  EXPECT_GE(std::abs(first(to) / first(from) / exact - 1.0), 6e-3);
}

struct Ball {
  explicit Ball(const PolygonSoup& soup) : loaded(build_mesh(soup, 1.0)), target(loaded.mesh) {}

  std::vector<BoundaryPiece> boundary(const Look& look, double widest) const {
    const SmoothSurfaces smooth(loaded.mesh, 15 * degree, 0.1);
    std::vector<BoundaryPiece> pieces;
    for (const BoundaryLine& line : shadow_boundary(CurvedTarget(target.tracer, smooth, true), look_vectors(look), widest, 0.3))
      for (const BoundaryPiece& piece : line.pieces()) pieces.push_back(piece);
    return pieces;
  }
  dvec3 place(const FacetPoint& p) const {
    const Triangle& t = loaded.mesh.triangles[p.triangle];
    return (1.0 - p.l.x - p.l.y) * loaded.mesh.vertices[t[0]] + p.l.x * loaded.mesh.vertices[t[1]] +
           p.l.y * loaded.mesh.vertices[t[2]];
  }

  LoadedMesh loaded;
  Target target;
};

// Half axes 3, 3 and 1: the rim has radius b^2 / a = 1/3 and e = 1 - b^2 / a^2; curvatures of this mesh are good to a few per
// cent.
TEST(Noses, OfAnOblateSpheroidAreItsRim) {
  PolygonSoup soup = shapes::icosphere(5);
  for (dvec3& point : soup.points) point *= dvec3(3, 3, 1);
  const Ball body(soup);
  const SmoothSurfaces smooth(body.loaded.mesh, 30 * degree, 0.1);
  const double k = 3.0;
  const std::vector<double> frequencies{k * speed_of_light / (2 * pi)};
  const CurvedTarget curved(body.target.tracer, smooth, true, {}, frequencies);
  double length = 0.0;
  for (const Nose& nose : curved.noses) {
    if (nose.radius <= 0.0) continue;
    length += nose.turn * nose.facet_share(k) / nose.shared_turn(k);
    EXPECT_NEAR(nose.radius, 1.0 / 3, 0.05);
    EXPECT_NEAR(nose.flattening, 8.0 / 9, 0.05);
    EXPECT_NEAR(glm::length(nose.position), 3.0, 0.03);
    EXPECT_NEAR(std::abs(nose.along.z), 0.0, 0.05);
  }
  EXPECT_NEAR(length / (2 * pi * 3), 1.0, 0.1);
}

// What is found for a wave is the same among lower frequencies; what is found for those beside has no share of it.
TEST(Noses, DoNotHangOnLowerFrequencies) {
  PolygonSoup soup = shapes::icosphere(5);
  for (dvec3& point : soup.points) point *= dvec3(3, 2, 0.5);
  const Ball body(soup);
  const SmoothSurfaces smooth(body.loaded.mesh, 30 * degree, 0.1);
  const double k = 8.0;
  const auto noses_of = [&](std::vector<double> wavenumbers) {
    for (double& w : wavenumbers) w *= speed_of_light / (2 * pi);
    return CurvedTarget(body.target.tracer, smooth, true, {}, wavenumbers).noses;
  };
  const std::vector<Nose> alone = noses_of({k}), among = noses_of({k / 4, k});
  int both = 0, others = 0;
  for (const Nose& other : among) {
    const auto one = std::ranges::lower_bound(alone, other.triangle, {}, &Nose::triangle);
    if (one != alone.end() && one->triangle == other.triangle) {
      EXPECT_EQ(one->radius, other.radius);
      EXPECT_EQ(one->flattening, other.flattening);
      EXPECT_EQ(one->position, other.position);
      ++both;
    } else {
      EXPECT_EQ(other.edge_share(-other.outwards, k) * other.facet_share(k), 0.0);
      ++others;
    }
  }
  EXPECT_EQ(static_cast<std::size_t>(both), alone.size());
  EXPECT_GT(both, 100);
  EXPECT_GT(others, 100);
}

// The sides of a cylinder of half axes 1 and 1/3 along y: strips of two triangles each, as long as it is.
PolygonSoup elliptic_cylinder(std::uint32_t sides, double length) {
  PolygonSoup soup;
  std::vector<std::uint32_t> bottom, top;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * pi * i / sides;
    for (const double y : {-0.5 * length, 0.5 * length}) soup.points.emplace_back(std::cos(angle), y, std::sin(angle) / 3);
    const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % sides);
    soup.polygons.push_back({a, a + 1, b + 1});
    soup.polygons.push_back({a, b + 1, b});
    bottom.push_back(a);
    top.insert(top.begin(), a + 1);
  }
  soup.polygons.push_back(bottom);
  soup.polygons.push_back(top);
  return soup;
}

// Both rims, wherever along them the middles of their two triangles a strip are.
TEST(Noses, OfLongStripsAreRimsFromEndToEnd) {
  const double length = 6.0, k = 2.0;
  const Ball body(elliptic_cylinder(64, length));
  const SmoothSurfaces smooth(body.loaded.mesh, 30 * degree, 0.1);
  const std::vector<double> frequencies{k * speed_of_light / (2 * pi)};
  const CurvedTarget curved(body.target.tracer, smooth, true, {}, frequencies);
  double sum = 0.0, squares = 0.0;
  for (const RimPiece& piece : rim_pieces(curved.short_noses(longest_nose(frequencies[0])), k)) {
    EXPECT_NEAR(std::abs(piece.nose.position.x), 1.0, 0.02);
    EXPECT_NEAR(piece.nose.radius, 1.0 / 9, 0.02);
    EXPECT_LE(piece.length, 1.1 * longest_nose(frequencies[0]));
    sum += piece.length;
    squares += piece.length * piece.nose.position.y * piece.nose.position.y;
  }
  EXPECT_NEAR(sum / (2 * length), 1.0, 0.1);
  EXPECT_NEAR(squares / sum, length * length / 12, 0.05);  // 1 of two points a strip
}

// Its rim radiates as much of an edge as its lit currents leave out.
TEST(Noses, OfHalfAnEdgeAreHalfARim) {
  Nose nose{{}, dvec3(1, 0, 0), dvec3(0, 1, 0), 1.0, 8.0 / 9, 1.0 / 9};
  nose.turn = 0.3;
  nose.facet_radius = 1.0;
  const double whole = rim_pieces(std::vector{nose}, 1.0).at(0).length, share = nose.edge_share({-1, 0, 0}, 1.0);
  nose.evenness = 0.5;
  const RimPiece half = rim_pieces(std::vector{nose}, 1.0).at(0);
  EXPECT_NEAR(half.length * half.nose.edge_share({-1, 0, 0}, 1.0), 0.5 * whole * share, 1e-12);
  EXPECT_NEAR(nose.edge_share({-1, 0, 0}, 1.0), 0.5 * share, 1e-12);
}

// A lower frequency of the sweep has found it, and its facet is sharp enough by itself.
TEST(Noses, TooRoundForAnEdgeAreNoRims) {
  Nose nose{{}, dvec3(1, 0, 0), dvec3(0, 1, 0), 1.0, 8.0 / 9, 1.0 / 9};
  nose.turn = 0.3;
  nose.facet_radius = 0.05;
  EXPECT_EQ(rim_pieces(std::vector{nose}, 0.9 * edge_radius).size(), 1u);
  for (const double k : {edge_radius, 3.1 * edge_radius, 30.0 * edge_radius})
    EXPECT_TRUE(rim_pieces(std::vector{nose}, k).empty()) << k;
}

// Of directions all around there is none, nor is there of a facet that turns back as much as the others turn.
TEST(Noses, WithoutAMeanAreNoRims) {
  Nose nose{{}, dvec3(1, 0, 0), dvec3(0, 1, 0), 1.0, 8.0 / 9, 1.0 / 9};
  nose.turn = 0.3;
  nose.facet_radius = 1.0;
  Nose back = nose;
  back.turn = -0.3 + 1e-17, back.outwards = glm::normalize(dvec3(1, 0.2, 0)), back.along = glm::normalize(dvec3(-0.2, 1, 0));
  const std::vector<RimPiece> both = rim_pieces(std::vector{nose, back}, 1.0);
  ASSERT_EQ(both.size(), 1u);
  EXPECT_EQ(both[0].length, rim_pieces(std::vector{nose}, 1.0).at(0).length);
  EXPECT_EQ(both[0].nose.outwards, nose.outwards);

  std::vector<Nose> around;
  for (int i = 0; i < 12; ++i) {
    around.push_back(nose);
    around.back().along = dvec3(0, std::cos(i * 15 * degree), std::sin(i * 15 * degree));
    if (i % 2 == 1) around.back().along = -around.back().along;
  }
  for (const RimPiece& piece : rim_pieces(around, 1.0)) {
    EXPECT_NEAR(glm::length(piece.nose.along), 1.0, 1e-12);
    EXPECT_NEAR(glm::dot(piece.nose.along, piece.nose.outwards), 0.0, 1e-12);
  }
  // Along what is outwards of the others.
  nose.outwards = glm::normalize(dvec3(1, 0.95, 0)), nose.along = glm::normalize(dvec3(-0.95, 1, 0));
  back = nose, back.outwards = glm::normalize(dvec3(1, -0.95, 0)), back.along = glm::normalize(dvec3(-0.95, -1, 0));
  for (Nose* each : {&nose, &back}) each->along = each->along.x < 0.0 ? -each->along : each->along;
  for (const RimPiece& piece : rim_pieces(std::vector{nose, back}, 1.0))
    EXPECT_TRUE(std::isfinite(glm::length(piece.nose.along)));
}

// k rho = 1 and e = 8/9: flanks from 49 degrees of the normal on, so that waves light both up to 41 degrees off the nose.
TEST(Noses, AreEdgesForWavesThatLightBothFlanks) {
  const Nose nose{{}, dvec3(1, 0, 0), dvec3(0, 1, 0), 1.0, 8.0 / 9, 1.0 / 9};
  const double straight = nose.straightness(dvec3(-1, 0, 0));
  EXPECT_NEAR(straight, 1.0 / (1.0 + std::pow(4.0 / 9, 4)), 1e-12);
  const auto share = [&](double off, double along) {
    return nose.edge_share(dvec3(-std::cos(off) * std::cos(along), std::sin(along), std::sin(off) * std::cos(along)), 1.0);
  };
  EXPECT_NEAR(share(0, 0), straight, 0.01);
  EXPECT_NEAR(share(30 * degree, 0), share(-30 * degree, 0), 1e-12);
  EXPECT_NEAR(share(31 * degree, 0), 0.5 * straight, 0.05);
  EXPECT_EQ(share(45 * degree, 0), 0.0);
  EXPECT_EQ(share(pi, 0), 0.0);
  EXPECT_LT(share(0, 70 * degree), 0.01);  // along the edge, which bends more than across by then
  EXPECT_EQ(nose.edge_share(dvec3(-1, 0, 0), 3.1), 0.0);
}

// About the tips of the needle, where the curvatures of the mesh are rough, a piece of edge of a fortieth of the wavelength is
// left.
TEST(Noses, AreNotOfSpheresAndNeedles) {
  const double k = 2.0, most = 2 * pi / k / 30;
  for (const double stretch : {1.0, 8.0}) {
    PolygonSoup soup = shapes::icosphere(4);
    for (dvec3& point : soup.points) point.z *= stretch;
    const Ball body(soup);
    const SmoothSurfaces smooth(body.loaded.mesh, 30 * degree, 0.1);
    const std::vector<double> frequencies{k * speed_of_light / (2 * pi)};
    const CurvedTarget curved(body.target.tracer, smooth, true, {}, frequencies);
    double length = 0.0;
    for (const Nose& nose : curved.noses)
      if (nose.radius > 0.0) length += nose.turn * nose.facet_share(k) / nose.shared_turn(k) * nose.edge_share(-nose.outwards, k);
    EXPECT_LE(length, stretch == 1.0 ? 0.0 : most) << stretch;
  }
}

TEST(ShadowBoundary, GoesRoundASphereInStretchesOfEqualPieces) {
  // Three planes cut it in six stretches at most, of which each may have a piece more than its length asks for.
  const Ball ball(shapes::icosphere(4));
  const Look look{{1.0, 0.4}, {1.0, 0.4}};
  for (const auto& [widest, piece_at_most] : {std::pair(0.11, 0.11), std::pair(1.0, 0.3)}) {
    const std::vector<BoundaryPiece> pieces = ball.boundary(look, widest);
    EXPECT_GE(pieces.size(), 2 * pi / piece_at_most - 0.1);
    EXPECT_LE(pieces.size(), 2 * pi / piece_at_most + 6);
    dvec3 once_round(0.0);
    for (const BoundaryPiece& piece : pieces) {
      EXPECT_LE(glm::length(piece.chord), piece_at_most * 1.01);  // normals turn by no more where they are not radial
      EXPECT_NEAR(glm::dot(ball.place(piece.middle), look_vectors(look).incident), 0.0, 1e-3);
      once_round += piece.chord;
    }
    EXPECT_LE(glm::length(once_round), 1e-9);
  }
}

TEST(ShadowBoundary, OfACylinderEndsAtItsCaps) {
  // Seen across the axis it is two lines along the sides, each in equal pieces. Lengths are many, as rounding decides on which
  // side of a line's end its last piece ends.
  const Look look{{90 * degree, 15.5 * degree}, {90 * degree, 15.5 * degree}};
  for (int tenths = 10; tenths < 100; ++tenths) {
    const double length = 0.1 * tenths, widest = 1.0 / 6.0;
    const std::vector<BoundaryPiece> pieces = Ball(shapes::cylinder(1.0, length, 72)).boundary(look, widest);
    ASSERT_EQ(pieces.size() % 2, 0u);
    for (const BoundaryPiece& piece : pieces)
      EXPECT_NEAR(glm::length(piece.chord), 2.0 * length / static_cast<double>(pieces.size()), 1e-9) << length;
  }
}

TEST(ShadowBoundary, DoesNotHangOnTheOrderOfTriangles) {
  PolygonSoup soup = shapes::icosphere(2);
  const Ball ball(soup);
  std::ranges::reverse(soup.polygons);
  const Ball other(soup);
  const Look look{{0.7, 2.4}, {0.7, 2.4}};
  const std::vector<BoundaryPiece> a = ball.boundary(look, 0.2), b = other.boundary(look, 0.2);
  ASSERT_EQ(a.size(), b.size());
  for (const BoundaryPiece& piece : a) {
    const auto same = [&](const BoundaryPiece& p) {
      return glm::distance(other.place(p.middle), ball.place(piece.middle)) < 1e-9;
    };
    EXPECT_TRUE(std::ranges::any_of(b, same));
  }
}

}  // namespace
}  // namespace raytube
