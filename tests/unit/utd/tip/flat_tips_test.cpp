// Flat tips of curved bodies: where they are, the lengths of their rims, what their waves obey.
#include <gtest/gtest.h>

#include <array>

#include "run.h"
#include "smooth_bodies.h"
#include "utd/tip/flat_tip_waves.h"

namespace raytube {
namespace {

using namespace raytube::testing;

constexpr double half_angle = 30 * degree, half_width = 0.5;
constexpr double frequency = speed_of_light;

/// An ogive along z with tips at both ends, 3.7 wavelengths long and 1 wide along x, pressed flat along y.
struct Leaf {
  explicit Leaf(double flatness)
      : loaded(build_mesh(soup(flatness), 1.0)),
        body(loaded.mesh),
        smooth(loaded.mesh, 15 * degree, 0.1),
        target(body.tracer, smooth, true, {}, std::span(&frequency, 1)) {}

  static PolygonSoup soup(double flatness) {
    const double radius = half_width / (1.0 - std::cos(half_angle));
    const shapes::Meridian meridian = [=](double x) {
      const double turn = half_angle * (2 * x - 1);
      return dvec2(x == 0.0 || x == 1.0 ? 0.0 : radius * (std::cos(turn) - std::cos(half_angle)), -radius * std::sin(turn));
    };
    std::vector<double> rows;
    for (int i = 0; i <= 80; ++i) rows.push_back(0.5 * (1.0 - std::cos(pi * i / 80)));
    PolygonSoup soup = shapes::revolution(meridian, rows, 144);
    for (dvec3& p : soup.points) p.y *= flatness;
    return soup;
  }

  LoadedMesh loaded;
  Target body;
  SmoothSurfaces smooth;
  CurvedTarget target;
};

ScatteringMatrix waves_of(const Leaf& leaf, const Look& look) {
  const FlatTipWaves waves(find_flat_tips(leaf.target, wavelength(frequency)));
  LocalLook local(look_vectors(look));
  return waves.scattering(leaf.target, local, wavenumber(frequency), nullptr).s;
}

TEST(FlatTips, AreWhereRimsMeet) {
  const Leaf leaf(0.25);
  const std::vector<FlatTip> tips = find_flat_tips(leaf.target, wavelength(frequency));
  ASSERT_EQ(tips.size(), 2u);
  const double arc = 2 * half_angle * half_width / (1.0 - std::cos(half_angle));
  for (const FlatTip& tip : tips) {
    EXPECT_NEAR(std::abs(glm::dot(tip.normal, dvec3(0, 1, 0))), 1.0, 1e-3);
    // The rims bend by 4 degrees in a sixth of the wavelength, over which their directions are known.
    EXPECT_NEAR(tip.angle / degree, 2 * half_angle / degree, 4.0);
    for (const Rim& rim : tip.rims) {
      ASSERT_TRUE(rim.end);
      EXPECT_NE(&tips[rim.end->tip], &tip);
      EXPECT_NEAR(rim.end->length, arc, 0.005 * arc);  // a phase of 0.1
      EXPECT_NEAR(rim.curvature * arc, 2 * half_angle, 0.15);
    }
  }
}

TEST(FlatTips, AreNoneWhereBodiesAreRoundOrHaveNoTips) {
  EXPECT_TRUE(find_flat_tips(Leaf(1.0).target, wavelength(frequency)).empty());
  PolygonSoup lens = shapes::icosphere(4);
  for (dvec3& p : lens.points) p.y *= 0.2;
  const LoadedMesh loaded = build_mesh(lens, 1.0);
  const Target body(loaded.mesh);
  const SmoothSurfaces smooth(loaded.mesh, 15 * degree, 0.1);
  EXPECT_TRUE(
      find_flat_tips(CurvedTarget(body.tracer, smooth, true, {}, std::span(&frequency, 1)), wavelength(frequency)).empty());
}

TEST(FlatTips, WavesAreReciprocal) {
  const Leaf leaf(0.25);
  for (const auto& [a, b] : {std::pair(Direction{20 * degree, 10 * degree}, Direction{165 * degree, 40 * degree}),
                             std::pair(Direction{150 * degree, 0.0}, Direction{30 * degree, 200 * degree})}) {
    const ScatteringMatrix there = waves_of(leaf, {a, b}), back = waves_of(leaf, {b, a});
    EXPECT_GT(frobenius_norm(there), 1e-4);
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q) EXPECT_NEAR(std::abs(there.at(p, q) - back.at(q, p)), 0.0, 1e-13);
  }
}

// By their paths pieces lie on the line of sight where they come back: what runs from the far tip to the near one as much behind
// the middle of both as half the rim is long.
TEST(FlatTips, PiecesHaveThePlacesOfTheirPaths) {
  const Leaf leaf(0.25);
  const std::vector<FlatTip> tips = find_flat_tips(leaf.target, wavelength(frequency));
  const LookVectors look = look_vectors({{60 * degree, 0.0}, {60 * degree, 0.0}});
  StripPlaces places{0, PathPlace{look.scattered}};
  LocalLook local(look);
  const ScatteringMatrix all = FlatTipWaves(tips).scattering(leaf.target, local, wavenumber(frequency), &places).s;
  ScatteringMatrix sum;
  bool found = false;
  for (const ImageEdge& piece : places.pieces) {
    sum += piece.s;
    found = found || std::abs(glm::dot(piece.begin, look.scattered) + 0.5 * tips[0].rims[0].end->length) < 1e-6;
  }
  EXPECT_LE(frobenius_norm(sum - all), 1e-12 * frobenius_norm(all));
  EXPECT_TRUE(found);
}

// In the plane of the rims E across it meets no edge, E in it does, and most from 20 degrees off the axis, as waves that travel
// along thin bodies return: 49 degrees sqrt(wavelength / length) (Peters, IRE Trans. AP 6, 133, 1958) is 25 degrees here.
TEST(FlatTips, ReturnsLookLikeThoseOfTravellingWaves) {
  const Leaf leaf(0.25);
  double best = 0.0, best_angle = 0.0;
  for (int theta = 0; theta <= 90; theta += 3) {
    const ScatteringMatrix s = waves_of(leaf, {{theta * degree, 0.0}, {theta * degree, 0.0}});
    EXPECT_LE(std::abs(s.hh()), 1e-5) << theta;
    if (std::abs(s.vv()) > best) best = std::abs(s.vv()), best_angle = theta;
  }
  EXPECT_GT(best, 0.1);
  EXPECT_GT(best_angle, 15);
  EXPECT_LT(best_angle, 40);
}

}  // namespace
}  // namespace raytube
