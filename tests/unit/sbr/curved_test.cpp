// Physical optics on pieces of quadrics, and what they reflect.
#include <gtest/gtest.h>

#include "run.h"
#include "sbr/curved/curved_beam.h"
#include "sbr/curved/curved_integral.h"

namespace raytube {
namespace {

using namespace raytube::testing;

constexpr double radius = 3.0, k = 2.0 * pi;  // [m], wavelength 1 m
const std::vector<double> wavenumbers{k};

// A launch plane 8 m across above the origin.
LaunchGrid plane_towards(const Direction& look) {
  const SphericalBasis basis = spherical_basis(look);
  LaunchGrid grid;
  grid.u_hat = basis.phi_hat, grid.v_hat = -basis.theta_hat, grid.direction = -basis.radial;
  grid.plane_origin = 10.0 * basis.radial;
  return grid;
}

// The sphere about the origin, expanded where the ray of these launch coordinates meets it, or next to its
// shadow boundary.
CurvedPiece sphere_piece(const LaunchGrid& grid, dvec2 at) {
  if (glm::length(at) > 0.98 * radius) at *= 0.98 * radius / glm::length(at);
  const dvec3 across = at.x * grid.u_hat + at.y * grid.v_hat;
  const dvec3 point = across - std::sqrt(radius * radius - glm::dot(at, at)) * grid.direction;
  return {grid, {point, point / radius, glm::dmat3(-1.0 / radius)}};
}

// Cells of these sides, none of them fitted to the sphere.
ScatteringMatrix sphere_by_cells(const Direction& transmit, const Direction& receive, const dvec2& sides = dvec2(0.5)) {
  const LaunchGrid grid = plane_towards(transmit);
  const SphericalBasis t = spherical_basis(transmit), r = spherical_basis(receive);
  const Illumination light{grid, t, r, {{}, wavenumbers}};
  ScatteringMatrix sum;
  for (double u = -3.2; u < 3.0; u += sides.x)
    for (double v = -3.3; v < 3.0; v += sides.y) {
      const Bounds cell{{u, v}, dvec2(u, v) + sides};
      sum += curved_far_field(light, sphere_piece(grid, 0.5 * (cell.low + cell.high)), cell).front();
    }
  return sum;
}

// S = -jk a^2 [e^{jc} / jc + (e^{jc} - 1) / c^2], c = 2ka: physical optics on a sphere (Knott et al. 2004, section 5.3, with the
// shadow boundary's term). The quadric is exact; what remains is quadrature, a few 1e-5 of the strongest cell each.
TEST(CurvedPiece, SphereIsItsClosedForm) {
  const double c = 2.0 * k * radius;
  const Complex turn = std::polar(1.0, c);
  const Complex exact = -Complex(0.0, k * radius * radius) * (turn / Complex(0.0, c) + (turn - 1.0) / (c * c));
  for (const Direction& look : {Direction{0.0, 0.0}, Direction{1.1, 0.4}}) {
    const ScatteringMatrix s = sphere_by_cells(look, look);
    EXPECT_LE(std::abs(s.vv() - exact), 1e-3 * std::abs(exact));
    EXPECT_LE(std::abs(s.hh() - exact), 1e-3 * std::abs(exact));
    EXPECT_LE(std::abs(s.vh()), 1e-12 * std::abs(exact));
  }
}

// A look, and wavenumbers of a band of a fifth.
struct ManyFrequencies {
  Direction look{1.1, 0.4};
  LaunchGrid grid = plane_towards(look);
  SphericalBasis basis = spherical_basis(look);
  std::vector<double> many = evenly_spaced();

  static std::vector<double> evenly_spaced() {
    std::vector<double> many;
    for (int i = 0; i < 101; ++i) many.push_back(k * (0.9 + 0.002 * i));
    return many;
  }
};

// Interpolated in frequency or not: 1e-12 of what the cell would give in phase, k area / 2 pi.
TEST(CurvedPiece, ManyFrequenciesAreThoseOfEachByItself) {
  const ManyFrequencies scene;
  const auto& [look, grid, basis, many] = scene;
  Band band(many);
  const Bounds box{{-0.7, 0.2}, {0.4, 1.1}}, at_shadow_boundary{{2.3, 0.5}, {3.4, 1.4}};
  for (const Bounds& cell : {box, at_shadow_boundary}) {
    const CurvedPiece piece = sphere_piece(grid, 0.5 * (cell.low + cell.high));
    const auto each = curved_far_field({grid, basis, basis, {{}, many}}, piece, cell),
               interpolated = curved_far_field({grid, basis, basis, {{}, many}, &band}, piece, cell);
    for (std::size_t f = 0; f < many.size(); ++f)
      EXPECT_LE(std::abs(each[f].vv() - interpolated[f].vv()), 1e-12 * many[f] * area(cell)) << f;
  }
}

// Tubes that a sphere has reflected, on a plane: the same.
TEST(CurvedBeam, ManyFrequenciesAreThoseOfEachByItself) {
  const ManyFrequencies scene;
  const auto& [look, grid, basis, many] = scene;
  Band band(many);
  const dvec2 at(0.8, -0.5), size(0.1, 0.1);
  const CurvedBeam launched = launched_beam(grid, basis, at);
  const CurvedFootprint first = curved_footprint(launched, sphere_piece(grid, at).surface(), Reception{basis});
  const dvec3 hit = first.outgoing.base + 2.0 * first.outgoing.direction;
  const CurvedFootprint second = curved_footprint(first.outgoing, {hit, -first.outgoing.direction, glm::dmat3(0.0)}, Reception{basis});
  std::vector<ScatteringMatrix> sums(many.size());
  add_far_fields(sums, second, band, size);
  for (std::size_t f = 0; f < many.size(); ++f) {
    ScatteringMatrix each;
    add_far_field(each, second, f, many[f], size);
    EXPECT_GT(std::abs(each.vv()), 0.0);
    // The rule's points may be one more at higher frequencies.
    EXPECT_LE(std::abs(each.vv() - sums[f].vv()), 1e-7 * std::abs(each.vv())) << f;
  }
}

// In wide scenes cells are long. Over one that is 4 wavelengths long, as one here that reaches from 3.2 to the left of the
// specular point to 0.8 to its right, the phase runs back and forth by tens of rad. Such cells, the only ones of stationary
// phase, are each to be right to 1e-3 of what they would give in phase; that is a few times the sum, as 4 / sqrt(radius x
// wavelength / 2).
TEST(CurvedPiece, SphereOfLongCellsIsTheSameClosedForm) {
  const double c = 2.0 * k * radius;
  const Complex turn = std::polar(1.0, c);
  const Complex exact = -Complex(0.0, k * radius * radius) * (turn / Complex(0.0, c) + (turn - 1.0) / (c * c));
  for (const dvec2 sides : {dvec2(4.0, 0.25), dvec2(0.25, 4.0), dvec2(3.2, 0.1)}) {
    const double error = std::abs(sphere_by_cells({1.1, 0.4}, {1.1, 0.4}, sides).vv() - exact) / std::abs(exact);
    measured("sphere of long cells, relative error", error, "");
    EXPECT_LE(error, 4e-3) << sides.x << " x " << sides.y;
  }
}

// Bistatic: the integral over the lit half sphere on its own coordinates, where nothing is singular at the shadow boundary.
ScatteringMatrix sphere_by_angles(const Direction& transmit, const Direction& receive) {
  const SphericalBasis t = spherical_basis(transmit), r = spherical_basis(receive);
  const std::array<dvec3, 2> incident{t.theta_hat, t.phi_hat}, received{r.theta_hat, r.phi_hat};
  ScatteringMatrix sum;
  constexpr int steps = 400;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < 2 * steps; ++j) {
      const double polar = (i + 0.5) * 0.5 * pi / steps, azimuth = (j + 0.5) * pi / steps;
      const dvec3 n =
          std::cos(polar) * t.radial + std::sin(polar) * (std::cos(azimuth) * t.theta_hat + std::sin(azimuth) * t.phi_hat);
      const double area = radius * radius * std::sin(polar) * (0.5 * pi / steps) * (pi / steps);
      const Complex factor = Complex(0.0, -k / (4.0 * pi)) * std::polar(area, k * glm::dot(r.radial + t.radial, radius * n));
      for (int p = 0; p < 2; ++p)
        for (int q = 0; q < 2; ++q)
          sum.at(p, q) += factor * 2.0 * glm::dot(received[p], glm::cross(n, glm::cross(-t.radial, incident[q])));
    }
  return sum;
}

// The midpoint rule of 400 steps is good to (phase per step)^2 / 24 = 4e-4 in the worst step, far less in the sum.
TEST(CurvedPiece, BistaticSphereIsTheIntegralOverItsSurface) {
  const Direction transmit{0.7, 0.2};
  for (const Direction& receive : {Direction{1.2, 0.9}, Direction{1.6, -0.8}}) {
    const ScatteringMatrix cells = sphere_by_cells(transmit, receive), surface = sphere_by_angles(transmit, receive);
    const double size = largest_amplitude(surface);
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q) EXPECT_LE(std::abs(cells.at(p, q) - surface.at(p, q)), 2e-3 * size) << p << q;
  }
}

// Rays of a plane wave off a concave mirror meet at half its radius; the tube has shrunk to nothing there and is inside out
// beyond: one caustic in each plane, two in all for a sphere.
TEST(CurvedBeam, ConcaveMirrorFocusesAtHalfItsRadius) {
  const LaunchGrid grid = plane_towards({0.0, 0.0});
  const SphericalBasis basis = spherical_basis({0.0, 0.0});
  const CurvedBeam incident = launched_beam(grid, basis, dvec2(0.0));
  const LocalSurface bowl{{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, glm::dmat3(1.0 / radius)};
  const CurvedBeam up = curved_footprint(incident, bowl, Reception{basis}).outgoing;
  const auto plane_at = [](double height) { return LocalSurface{{0.0, 0.0, height}, {0.0, 0.0, -1.0}, glm::dmat3(0.0)}; };
  const CurvedFootprint focus = curved_footprint(up, plane_at(0.5 * radius), Reception{basis});
  EXPECT_LE(glm::length(focus.outgoing.along_u) + glm::length(focus.outgoing.along_v), 1e-12);
  EXPECT_EQ(curved_footprint(up, plane_at(0.4 * radius), Reception{basis}).outgoing.caustics, 0);
  const CurvedFootprint beyond = curved_footprint(up, plane_at(radius), Reception{basis});
  EXPECT_EQ(beyond.outgoing.caustics, 2);
  EXPECT_LE(glm::length(beyond.outgoing.along_u + incident.along_u), 1e-12);
}

// The derivatives of a tube against rays beside it, on a tilted ellipsoidal cap: what the beam says of a neighbour 1e-4 away is
// wrong by the second order, 1e-8 over the radii of curvature.
TEST(CurvedBeam, DerivativesAreThoseOfNeighbouringRays) {
  const LaunchGrid grid = plane_towards({0.0, 0.0});
  const SphericalBasis basis = spherical_basis({0.0, 0.0});
  const dvec3 n = glm::normalize(dvec3(0.3, 0.1, 1.0)), a = glm::normalize(glm::cross(n, dvec3(0.0, 1.0, 0.0))),
              b = glm::cross(n, a);
  const LocalSurface cap{{0.0, 0.0, 0.0}, n, -glm::outerProduct(a, a) / 2.0 - glm::outerProduct(b, b) / 5.0};
  const CurvedBeam out = curved_footprint(launched_beam(grid, basis, dvec2(0.0)), cap, Reception{basis}).outgoing;
  constexpr double step = 1e-4;
  for (const bool along_u : {true, false}) {
    const dvec3 across = step * (along_u ? grid.u_hat : grid.v_hat);
    dvec3 x = across;  // on the cap, above `across`: fixed-point iteration of n.x = x.C x / 2
    for (int i = 0; i < 50; ++i) x.z += (0.5 * glm::dot(x, cap.curvature * x) - glm::dot(n, x)) / n.z;
    const dvec3 normal = glm::normalize(n - cap.curvature * x),
                d = grid.direction - 2.0 * glm::dot(grid.direction, normal) * normal;
    EXPECT_LE(glm::length(x - out.base - step * (along_u ? out.along_u : out.along_v)), 1e-8);
    EXPECT_LE(glm::length(d - out.direction - step * (along_u ? out.bend_u : out.bend_v)), 1e-8);
  }
}

}  // namespace
}  // namespace raytube
