// Waves over curved surfaces: their currents, their paths, and spheres against Mie's series.
#include <gtest/gtest.h>

#include <cmath>

#include "closed_forms.h"
#include "run.h"
#include "shapes.h"
#include "utd/surface/surface_ray.h"
#include "utd/surface/surface_waves.h"

namespace raytube {
namespace {

using namespace raytube::testing;

struct Sphere {
  explicit Sphere(int level) : loaded(build_mesh(shapes::icosphere(level), 1.0)), target(loaded.mesh) {}

  LoadedMesh loaded;
  Target target;
};

TEST(CurvatureField, OfASphere) {
  const Sphere sphere(3);
  const SmoothSurfaces smooth(sphere.loaded.mesh, 15 * degree, 0.1);
  const CurvatureField field(sphere.loaded.mesh, smooth);
  for (std::uint32_t t = 0; t < sphere.loaded.mesh.triangles.size(); t += 7) {
    const SurfaceFrame frame = field.at(t, {0.2, 0.5});
    EXPECT_NEAR(frame.gaussian(), 1.0, 0.02);
    EXPECT_NEAR(frame.curvature(glm::normalize(glm::cross(frame.normal, dvec3(0.3, 0.5, 0.8)))), 1.0, 0.01);
  }
}

TEST(Geodesic, GoesRoundASphereInItsPlane) {
  const Sphere sphere(4);
  const SmoothSurfaces smooth(sphere.loaded.mesh, 15 * degree, 0.1);
  const Triangle& t = sphere.loaded.mesh.triangles[5];
  const dvec3 a = sphere.loaded.mesh.vertices[t[0]], b = sphere.loaded.mesh.vertices[t[1]], c = sphere.loaded.mesh.vertices[t[2]];
  const dvec3 start = (a + b + c) / 3.0, along = glm::normalize(b - 0.3 * a - 0.7 * c);
  const dvec3 across = glm::normalize(glm::cross(start, along));
  const CurvatureField field(sphere.loaded.mesh, smooth);
  Geodesic geodesic(field, {5, {1.0 / 3, 1.0 / 3}}, along);
  GeodesicPiece piece;
  double length = 0.0, off = 0.0;
  while (length < 2 * pi && geodesic.next(piece)) {
    const BentFacet facet = smooth.facet(piece.from.triangle);
    length += glm::distance(facet.point(piece.from.l), facet.point(piece.to));
    off = std::max(off, std::abs(glm::dot(facet.point(piece.to), across)));
  }
  EXPECT_GE(length, 2 * pi);
  EXPECT_LE(off, 1e-3);  // what normals between vertices are off radial
}

double mean_error_db(const std::vector<double>& errors) {
  double sum = 0.0;
  for (const double error : errors) sum += std::abs(error);
  return sum / static_cast<double>(errors.size());
}

TEST(SurfaceWaves, SphereAgainstMie) {
  // What is measured and a quarter, and 0.15 dB for a single monostatic look. Fock's currents of the first order, with the
  // direction of the wave along the surface for an axis, leave .31 and .30 dB at ka 10, .09 and .08 at 30, mean over 0 to 170
  // degrees; physical optics .86 and 1.7, .56 and 1.2 dB.
  struct Limit {
    double ka, monostatic, across, in_plane;
  };
  const Sphere sphere(4);
  for (const Limit& limit :
       {Limit{8, 0.15, 0.24, 0.3}, {10, 0.15, 0.21, 0.22}, {15, 0.15, 0.15, 0.14}, {30, 0.05, 0.075, 0.06}}) {
    Sweep sweep{{limit.ka / (2 * pi) * speed_of_light}, {}, true};
    for (int angle = 0; angle <= 170; angle += 2) sweep.looks.push_back({{90 * degree, 0.0}, {90 * degree, angle * degree}});
    const SweepResult result = solve(sphere.target, sweep, {});
    std::vector<double> across, in_plane;
    for (std::size_t i = 0; i < sweep.looks.size(); ++i) {
      const auto [h, v] = closed_forms::sphere(1.0, limit.ka, sweep.looks[i].receive.phi);
      across.push_back(dbsm(result.total[i].vv()) - dbsm(v));
      in_plane.push_back(dbsm(result.total[i].hh()) - dbsm(h));
    }
    measured("sphere, monostatic", across[0], "dB");
    measured("sphere, 0 to 170 deg, E across the plane, mean |error|", mean_error_db(across), "dB");
    measured("sphere, 0 to 170 deg, E in the plane, mean |error|", mean_error_db(in_plane), "dB");
    EXPECT_LE(std::abs(across[0]), limit.monostatic) << limit.ka;
    EXPECT_LE(mean_error_db(across), limit.across) << limit.ka;
    EXPECT_LE(mean_error_db(in_plane), limit.in_plane) << limit.ka;
  }
}

TEST(SurfaceWaves, DoNotHangOnTheMesh) {
  // The same sphere of 1280 and 20480 facets: 2 % of what the waves add, that of facets of 0.5 wavelengths.
  std::vector<ScatteringMatrix> waves;
  for (const int level : {3, 5}) {
    const Sphere sphere(level);
    const SmoothSurfaces smooth(sphere.loaded.mesh, 15 * degree, 0.1);
    const CurvedTarget target(sphere.target.tracer, smooth, true);
    const double frequencies[] = {10 / (2 * pi) * speed_of_light};
    waves.push_back(surface_wave_scattering(target, look_vectors({{1.0, 0.4}, {1.9, 2.5}}), frequencies).scattering[0]);
  }
  EXPECT_LE(frobenius_norm(waves[0] - waves[1]), 0.04 * frobenius_norm(waves[1]));
}

TEST(SurfaceWaves, PiecesAddUp) {
  const Sphere sphere(3);
  const SmoothSurfaces smooth(sphere.loaded.mesh, 15 * degree, 0.1);
  const CurvedTarget target(sphere.target.tracer, smooth, true);
  const double frequencies[] = {12 / (2 * pi) * speed_of_light, 10 / (2 * pi) * speed_of_light};
  const LookVectors look = look_vectors({{1.0, 0.4}, {1.9, 2.5}});
  StripPlaces places{1};
  const auto all = surface_wave_scattering(target, look, frequencies, &places).scattering[1];
  ScatteringMatrix sum;
  for (const ImageEdge& piece : places.pieces) sum += piece.s;
  EXPECT_LE(frobenius_norm(sum - all), 1e-12 * frobenius_norm(all));
}

TEST(SurfaceWaves, AreTheSameWithRaysKept) {
  const Sphere sphere(3);
  const SmoothSurfaces smooth(sphere.loaded.mesh, 15 * degree, 0.1);
  const CurvedTarget target(sphere.target.tracer, smooth, true);
  const double frequencies[] = {12 / (2 * pi) * speed_of_light};
  const LookVectors look = look_vectors({{1.0, 0.4}, {1.9, 2.5}});
  std::vector<SurfaceRay> rays;
  const auto with = surface_wave_scattering(target, look, frequencies, nullptr, &rays);
  EXPECT_EQ(frobenius_norm(with.scattering[0] - surface_wave_scattering(target, look, frequencies).scattering[0]), 0.0);
  EXPECT_EQ(rays.size(), with.strips);
}

TEST(SurfaceWaves, CostGrowsWithTheLengthOfACylinder) {
  // Ten times as long, of as many facets: ten times as many strips, and no more points on the lit side. Facets in pieces of a
  // wavelength would make it a hundred times.
  const auto work = [](double length) {
    const LoadedMesh loaded = build_mesh(shapes::cylinder(1.0, length, 72), 1.0);
    const Target target(loaded.mesh);
    const SmoothSurfaces smooth(loaded.mesh, 15 * degree, 0.1);
    const double frequencies[] = {20 / (2 * pi) * speed_of_light};
    return surface_wave_scattering({target.tracer, smooth, true}, look_vectors({{1.0, 0.4}, {1.0, 0.4}}), frequencies).work;
  };
  EXPECT_LE(work(100.0), 12.0 * work(10.0));
}

TEST(SurfaceWaves, NoneOnFlatFaces) {
  Sweep sweep = monostatic({{1.0, 0.4}}, speed_of_light);
  SolveOptions options;
  options.keep_parts = true;
  const SweepResult result = solve(Target(build_mesh(shapes::box({2, 3, 4}), 1.0).mesh), sweep, options);
  EXPECT_EQ(frobenius_norm(result.of("surface_waves")[0]), 0.0);
}

TEST(Convexity, UpToTheDentsOfATessellation) {
  PolygonSoup soup = shapes::icosphere(3);
  for (std::size_t i = 0; i < soup.points.size(); i += 5) soup.points[i] *= 1.0 - 5e-3 * static_cast<double>(i % 3);
  const TriangleMesh mesh = build_mesh(soup, 1.0).mesh;
  EXPECT_TRUE(convex_up_to(mesh, 2e-2));
  EXPECT_FALSE(convex_up_to(mesh, 1e-5));
  EXPECT_FALSE(convex_up_to(build_mesh(shapes::plate(1.0), 1.0).mesh, 1.0));
}

}  // namespace
}  // namespace raytube
