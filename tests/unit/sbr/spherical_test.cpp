// Spherical waves in launch coordinates, and the integrals of what they excite.
#include <gtest/gtest.h>

#include <random>

#include "math/gauss.h"
#include "math/triangle_moments.h"
#include "sbr/beams/polygon_integral.h"
#include "sbr/beams/spherical_look.h"

namespace raytube {
namespace {

// The mean over a triangle by Gauss's rule on the square that collapses to it: exact to rounding for phases up to 10 rad.
Complex mean_by_quadrature(const std::array<double, 3>& x, int i, int j) {
  Complex sum = 0.0;
  for (const GaussPoint& s : gauss_rule(40))
    for (const GaussPoint& t : gauss_rule(40)) {
      const std::array<double, 3> l{1.0 - s.node, s.node * (1.0 - t.node), s.node * t.node};
      sum += 2.0 * s.weight * t.weight * s.node * l[i] * l[j] * std::polar(1.0, x[0] * l[0] + x[1] * l[1] + x[2] * l[2]);
    }
  return sum;
}

TEST(TriangleMoments, AreThoseOfQuadratureForAnySpread) {
  const std::array<std::array<int, 2>, 6> pairs{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};
  for (const auto& x : {std::array<double, 3>{0.0, 0.0, 0.0},
                        {0.3, 0.3, 0.3},
                        {0.0, 1e-9, -1e-9},
                        {0.0, 1.4, 0.2},
                        {1.0, 1.0, 4.0},
                        {0.0, 1e-7, 6.0},
                        {-5.0, 5.0, 0.1},
                        {9.0, 9.0 + 1e-12, 0.0},
                        {0.0, 1.5, 3.0},
                        {8.0, 1.0, 7.9}}) {
    const auto moments = triangle_moments(x);
    for (std::size_t m = 0; m < 6; ++m)
      EXPECT_NEAR(std::abs(moments[m] - mean_by_quadrature(x, pairs[m][0], pairs[m][1])), 0.0, 1e-14)
          << x[0] << ' ' << x[1] << ' ' << x[2];
  }
}

// The squares and products of barycentric coordinates add up to one.
TEST(TriangleMoments, AddUpToTheMeanPhasor) {
  std::mt19937 draw(7);
  std::uniform_real_distribution<double> phase(-400.0, 400.0);
  for (int i = 0; i < 200; ++i) {
    const std::array<double, 3> x{phase(draw), phase(draw), phase(draw)};
    const auto m = triangle_moments(x);
    EXPECT_NEAR(std::abs(m[0] + m[1] + m[2] + 2.0 * (m[3] + m[4] + m[5]) - triangle_phase_mean(x[0], x[1], x[2])), 0.0, 1e-14);
  }
}

struct Scene {
  Look look{{0.5, 0.8}, {0.9, -0.4}, 3.0, 4.0};
  Radar radar;
  AntennaPair antennas{look, radar, dvec3(0.1, 0.0, -0.2)};
  Beam incident = launched();
  std::vector<double> wavenumbers{20.0};
  SphericalLook spherical{antennas, incident, {{}, wavenumbers}, 0.01};
  Patch first{glm::normalize(dvec3(0.3, -0.2, 1.0)), 0.35}, second{glm::normalize(dvec3(1.0, 0.4, -0.3)), 0.5};

  Beam launched() const {
    Beam beam;
    const dvec3 antenna = antennas.transmit.position();
    beam.curvature = 1.0 / glm::length(antenna);
    beam.direction = -glm::normalize(antenna);
    beam.u_hat = glm::normalize(glm::cross(beam.direction, dvec3(0.2, 0.1, 0.9)));
    beam.v_hat = glm::cross(-beam.direction, beam.u_hat);
    beam.launch_depth = -1.0;
    return beam;
  }
};

constexpr double rounding = 1e-13;

TEST(SphericalBeam, PlacesAreHomogeneous) {
  const Scene scene;
  for (const Beam& beam : {scene.incident, reflected_spherical(scene.incident, scene.first)})
    for (const dvec2 at : {dvec2(0.0, 0.0), dvec2(0.3, -0.2), dvec2(-0.5, 0.6)}) {
      const Affine depth = depth_of(beam, scene.second);
      const dvec3 r = point_at(beam, at, depth(at));
      EXPECT_NEAR(glm::dot(r, scene.second.normal), scene.second.offset, rounding);
      EXPECT_NEAR(glm::distance(launch_coordinates(beam, r), at), 0.0, rounding);
      EXPECT_NEAR(widening(beam, r), widening_at(beam, depth(at)), rounding);
    }
}

// All rays come from the antenna, or from its image in the plane they leave.
TEST(SphericalBeam, RaysComeFromTheAntennaAndItsImage) {
  const Scene scene;
  const dvec2 at{0.2, -0.3};
  const Ray out = tube_ray(scene.incident, at, nullptr, no_index);
  const dvec3 antenna = scene.antennas.transmit.position();
  EXPECT_NEAR(glm::length(glm::cross(out.direction, out.origin - antenna)), 0.0, rounding);
  const Ray back = tube_ray(reflected_spherical(scene.incident, scene.first), at, &scene.first, 0);
  const dvec3 image = antenna - 2.0 * (glm::dot(antenna, scene.first.normal) - scene.first.offset) * scene.first.normal;
  EXPECT_NEAR(glm::dot(back.origin, scene.first.normal), scene.first.offset, rounding);
  EXPECT_NEAR(glm::length(glm::cross(back.direction, back.origin - image)), 0.0, rounding);
  EXPECT_NEAR(glm::length(glm::cross(out.direction, back.origin - antenna)), 0.0, rounding);
}

// On a perfect conductor the waves that come and leave have the same path, no tangential E together, and twice the tangential H
// of one.
TEST(SphericalBeam, MirroredWaveMeetsTheBoundaryConditions) {
  const Scene scene;
  Beam arriving = scene.incident;
  for (const Patch& plane : {scene.first, scene.second, scene.first}) {
    const Beam leaving = reflected_spherical(arriving, plane);
    const dvec3 r = point_at(leaving, {0.1, 0.2}, depth_of(leaving, plane)({0.1, 0.2}));
    const AntennaRay in = scene.spherical.wave(arriving, r), out = scene.spherical.wave(leaving, r);
    EXPECT_NEAR(in.path, out.path, rounding);
    for (int q = 0; q < 2; ++q) {
      EXPECT_NEAR(glm::length(glm::cross(plane.normal, in.field[q] + out.field[q])), 0.0, rounding);
      const dvec3 h_in = glm::cross(in.direction, in.field[q]), h_out = glm::cross(out.direction, out.field[q]);
      EXPECT_NEAR(glm::length(glm::cross(plane.normal, h_in - h_out)), 0.0, rounding);
    }
    arriving = leaving;
  }
}

// Phase slopes and area of a footprint against finite differences of its own parts; step h: their error is h^2 of the curvature.
TEST(SphericalLook, FootprintIsTheLinearPartOfItsSurroundings) {
  const Scene scene;
  const Beam beam = reflected_spherical(scene.incident, scene.first);
  const dvec2 at{0.1, -0.15};
  constexpr double h = 1e-4, tolerance = 1e-7;
  Spectrum none;
  const auto phase = [&](const dvec2& uv) { return scene.spherical.footprint(beam, scene.first, uv, none).phase; };
  const auto point = [&](const dvec2& uv) { return point_at(beam, uv, depth_of(beam, scene.first)(uv)); };
  const Footprint f = scene.spherical.footprint(beam, scene.first, at, none);
  EXPECT_NEAR(f.phase_u, (phase(at + dvec2(h, 0)) - phase(at - dvec2(h, 0))) / (2 * h), tolerance);
  EXPECT_NEAR(f.phase_v, (phase(at + dvec2(0, h)) - phase(at - dvec2(0, h))) / (2 * h), tolerance);
  const dvec3 u = (point(at + dvec2(h, 0)) - point(at - dvec2(h, 0))) / (2 * h),
              v = (point(at + dvec2(0, h)) - point(at - dvec2(0, h))) / (2 * h);
  EXPECT_NEAR(f.area, glm::length(glm::cross(u, v)), tolerance);
}

}  // namespace
}  // namespace raytube
