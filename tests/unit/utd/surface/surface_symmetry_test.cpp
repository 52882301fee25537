// Waves over curved surfaces: what they owe to symmetry, and a band of frequencies to each of its frequencies.
#include <gtest/gtest.h>

#include <algorithm>

#include "shapes.h"
#include "solve/solve.h"
#include "utd/surface/surface_waves.h"

namespace raytube {
namespace {

struct Body {
  explicit Body(const PolygonSoup& soup)
      : loaded(build_mesh(soup, 1.0)),
        target(loaded.mesh),
        smooth(loaded.mesh, 15 * degree, 0.1),
        curved(target.tracer, smooth, true) {}

  SurfaceWaveResult waves(const Look& look, std::span<const double> frequencies) const {
    return surface_wave_scattering(curved, look_vectors(look), frequencies);
  }
  ScatteringMatrix at(double k, const Look& look) const {
    const double frequencies[] = {k / (2 * pi) * speed_of_light};
    return waves(look, frequencies).scattering[0];
  }

  LoadedMesh loaded;
  Target target;
  SmoothSurfaces smooth;
  CurvedTarget curved;
};

PolygonSoup ellipsoid(int level) {
  return shapes::transformed(shapes::icosphere(level), glm::dmat3(dvec3(1.5, 0, 0.1), dvec3(0, 1.0, 0.2), dvec3(0, 0.1, 0.8)));
}

Look mirrored(const Look& look) { return {{look.transmit.theta, -look.transmit.phi}, {look.receive.theta, -look.receive.phi}}; }

// Off 0 and 180 degrees, where the bases are mirrored with the looks: V as it is, H turned.
double difference(const ScatteringMatrix& a, const ScatteringMatrix& mirror) {
  ScatteringMatrix turned = mirror;
  for (int p = 0; p < 2; ++p) turned.at(p, 1 - p) *= -1.0;
  return frobenius_norm(a - turned);
}

const Look looks[] = {{{1.1, 0.4}, {1.1, 0.4}}, {{0.8, 0.3}, {1.9, 2.5}}, {{pi / 2, 0.2}, {pi / 2, 3.0}}};

TEST(SurfaceWaves, MirrorImagesHaveMirrorImages) {
  // The same operations but for signs: what is left is rounding, 1e-16 a step over some 1e4 steps.
  PolygonSoup soup = ellipsoid(3);
  const Body body(soup);
  for (dvec3& point : soup.points) point.y = -point.y;
  for (auto& polygon : soup.polygons) std::ranges::reverse(polygon);
  const Body mirror(soup);
  for (const Look& look : looks) {
    const ScatteringMatrix s = body.at(20.0, look);
    EXPECT_LE(difference(s, mirror.at(20.0, mirrored(look))), 1e-9 * frobenius_norm(s));
  }
}

TEST(SurfaceWaves, DoNotHangOnHowTrianglesAreNumbered) {
  // Pieces of the boundary are those of the line alone, wherever it is found first: rounding is left.
  PolygonSoup soup = ellipsoid(3);
  const Body body(soup);
  std::ranges::reverse(soup.polygons);
  for (auto& polygon : soup.polygons) std::ranges::rotate(polygon, polygon.begin() + 1);
  const Body other(soup);
  for (const Look& look : looks) {
    const ScatteringMatrix s = body.at(20.0, look);
    EXPECT_LE(frobenius_norm(s - other.at(20.0, look)), 1e-9 * frobenius_norm(s));
  }
}

TEST(SurfaceWaves, AreReciprocal) {
  // In an interchange of transmitter and receiver the strips run the other way and the lit side is another one: nothing in the
  // formulas makes them reciprocal. Measured 0.010 to 0.050 of S at ka 30, of which physical optics alone has a half; waves of
  // the wrong sign or polarisation are 0.05 to 0.2.
  for (const PolygonSoup& soup : {shapes::icosphere(4), ellipsoid(4)}) {
    const Target target(build_mesh(soup, 1.0).mesh);
    Sweep sweep{{30 / (2 * pi) * speed_of_light}, {}, true};
    for (const double angle : {0.5, 1.0, 1.5}) {
      sweep.looks.push_back({{1.2, 0.3}, {1.2 - 0.3 * angle, 0.3 + angle}});
      sweep.looks.push_back({{1.2 - 0.3 * angle, 0.3 + angle}, {1.2, 0.3}});
    }
    const SweepResult result = solve(target, sweep, {});
    for (std::size_t i = 0; i < sweep.looks.size(); i += 2) {
      ScatteringMatrix back = result.total[i + 1];
      std::swap(back.s[0][1], back.s[1][0]);
      EXPECT_LE(frobenius_norm(result.total[i] - back), 0.06 * frobenius_norm(result.total[i])) << i;
    }
  }
}

TEST(SurfaceWaves, ChangeSmoothlyWithTheLook) {
  // Over 0.02 degrees phases turn by 2 ka 3.5e-4 = 0.02 and S by no more than that; where pieces of the boundary get fewer or
  // facets leave it, the quadrature shows: 5e-3 of it at most.
  const Body body(ellipsoid(4));
  ScatteringMatrix before[2];
  for (int i = 0; i < 200; ++i) {
    const Direction look{1.1, 0.4 + 0.02 * degree * i};
    const ScatteringMatrix s = body.at(30.0, {look, look});
    if (i > 1) {
      ScatteringMatrix bend = s - before[0];
      bend = bend - (before[0] - before[1]);
      EXPECT_LE(frobenius_norm(bend), 1e-3 * 0.3) << i;
    }
    before[1] = before[0];
    before[0] = s;
  }
}

// Two frequencies or three are evaluated one by one, with the points of a band that has the same ends.
void compare_with_direct(const Body& body, const Look& look, double middle, double share, double scale) {
  constexpr int count = 61;
  std::vector<double> frequencies;
  for (int i = 0; i < count; ++i)
    frequencies.push_back(middle / (2 * pi) * speed_of_light * (1.0 + share * (2.0 * i / (count - 1) - 1.0)));
  const SurfaceWaveResult band = body.waves(look, frequencies);
  double worst = 0.0, arrivals = 0.0;
  for (int i = 0; i < count; i += 7) {
    const double three[] = {frequencies.front(), frequencies[i], frequencies.back()};
    const SurfaceWaveResult direct = body.waves(look, three);
    worst = std::max(worst, frobenius_norm(band.scattering[i] - direct.scattering[1]));
    ASSERT_EQ(band.arrivals.size(), direct.arrivals.size());
    for (std::size_t a = 0; a < band.arrivals.size(); ++a)
      for (int t = 0; t < 2; ++t)
        arrivals = std::max(arrivals, std::abs(band.arrivals[a].magnetic[i][t] - direct.arrivals[a].magnetic[1][t]));
  }
  // A quarter of the radius is less than the amplitude |S| of the whole body; arrivals are widths times currents.
  EXPECT_LE(worst, 1e-6 * scale) << middle << ' ' << share;
  EXPECT_LE(arrivals, 1e-6 * 2 * pi / middle) << middle << ' ' << share;
}

TEST(SurfaceWaves, ABandIsAsEachOfItsFrequencies) {
  const Body ball(shapes::icosphere(4)), cylinder(shapes::cylinder(1.0, 3.0, 72));
  for (const double share : {0.075, 0.2})
    for (const Look& look : looks) {
      compare_with_direct(ball, look, 30.0, share, 0.25);
      compare_with_direct(cylinder, look, 20.0, share, 0.25);
    }
}

}  // namespace
}  // namespace raytube
