// Rays of waves over curved surfaces, as plain data and as `raytube trace` writes them.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include "run.h"
#include "scene/frequency_bands.h"
#include "scratch.h"
#include "shapes.h"
#include "smooth_bodies.h"
#include "solve/look_solver.h"
#include "utd/fock/fock.h"
#include "vtk_file.h"

namespace raytube {
namespace {

using namespace raytube::testing;

std::vector<SurfaceRay> rays_of(const Target& target, const Look& look) {
  const Sweep sweep{{speed_of_light}, {look}, true};  // a wavelength of 1 m
  const SolvePlan plan(target, sweep, {});
  return LookSolver(plan).surface_rays(look);
}

SurfaceRayPoint point_before(const SurfaceRay& ray, double arc_length) {
  SurfaceRayPoint found = ray.points.front();
  for (const SurfaceRayPoint& point : ray.points)
    if (std::abs(point.arc_length) <= arc_length) found = point;
  return found;
}

// Of a sphere of 2 wavelengths they run round it in planes through its axis, from the circle across the wave, at theta = s / a
// beyond it; neighbours meet behind: w = cos(s / a). The mesh's chords are off by 4e-3 of the radius, its normals by as much.
TEST(SurfaceRays, RunRoundASphere) {
  const double radius = 2.0;
  PolygonSoup soup = shapes::icosphere(4);
  for (dvec3& point : soup.points) point = radius * point + dvec3(5, 0, 0);
  const Direction direction{1.1, 0.4};
  const dvec3 towards = spherical_basis(direction).radial;
  int dark = 0;
  for (const SurfaceRay& ray : rays_of(Target(build_mesh(soup, 1.0).mesh), {direction, direction})) {
    ASSERT_GE(ray.points.size(), 2u);
    ASSERT_EQ(ray.kind, SurfaceRayKind::into_the_dark);
    ++dark;
    for (const SurfaceRayPoint& point : ray.points) {
      const dvec3 r = (point.position - dvec3(5, 0, 0)) / radius;
      EXPECT_NEAR(glm::length(r), 1.0, 4e-3);
      EXPECT_NEAR(glm::dot(r, towards), -std::sin(point.arc_length / radius), 8e-3);
      EXPECT_NEAR(point.width, std::abs(std::cos(point.arc_length / radius)), 0.03);
    }
  }
  // A circle of 4 pi wavelengths in strips of a quarter of the band's shortest wavelength at most, and one more for each of its
  // six stretches.
  const double strips = 16 * pi * sampled_band(speed_of_light).highest / speed_of_light;
  EXPECT_GE(dark, strips);
  EXPECT_LE(dark, strips + 7);
}

// The steps of strips are those of the top of a band, and finer ones change little: on the axis of a lens with a rim of
// k rho 0.44, whose strips all add up, 0.5 % of S (1.8 % where steps reached from the rim out over the flank).
TEST(SurfaceRays, StepsDoNotMatter) {
  const double a = 0.075, rho = 0.006, join = 70 * degree, flank = (a - rho + rho * std::cos(join)) / std::cos(join);
  const double centre = (rho - flank) * std::sin(join);
  const auto section = [&](double s) {  // 24 rows to a flank, 12 about the rim
    const double row = 60 * std::min(s, 1 - s), side = s < 0.5 ? 1.0 : -1.0;
    const double angle = row < 24 ? pi / 2 - row / 24 * (pi / 2 - join) : join * (30 - row) / 6;
    if (row < 24) return dvec2(flank * std::cos(angle), side * (centre + flank * std::sin(angle)));
    return dvec2(a - rho + rho * std::cos(angle), side * rho * std::sin(angle));
  };
  const Target target(build_mesh(shapes::revolution(section, shapes::even_rows(60), 96), 1.0).mesh);
  SolveOptions options;
  options.surfaces.waves = true;
  const Look look{{0, 0}, {0, 0}};
  const ScatteringMatrix alone = solve(target, {{3.5e9}, {look}, true}, options).total[0];
  const ScatteringMatrix swept = solve(target, {{3.5e9, 7e9, 10.25e9}, {look}, true}, options).total[0];
  EXPECT_LT(frobenius_norm(swept - alone), 0.01 * frobenius_norm(alone));
}

// G(0) and |F(0)| / m at the boundary (Fock 1946), m = (k a / 2)^(1/3), and what falls off from there.
TEST(SurfaceRays, HaveFocksCurrents) {
  const double m = std::cbrt(2 * pi);
  PolygonSoup soup = shapes::icosphere(4);
  for (dvec3& point : soup.points) point *= 2.0;
  for (const SurfaceRay& ray : rays_of(Target(build_mesh(soup, 1.0).mesh), {{1.1, 0.4}, {1.1, 0.4}})) {
    const SurfaceRayPoint start = ray.points.front();
    EXPECT_NEAR(start.hard, 1.399, 0.02);
    EXPECT_NEAR(start.soft, 0.7758 / m, 0.02);
    EXPECT_NEAR(start.xi, 0.0, 0.02);
    const SurfaceRayPoint later = point_before(ray, 1.0);
    EXPECT_NEAR(later.xi, m * later.arc_length / 2.0, 0.03 * later.xi);
    EXPECT_NEAR(later.hard, std::abs(fock_in_the_dark(later.xi).hard) / std::sqrt(later.width), 0.05);
  }
}

// Round a cylinder strips of its edges are helices: z grows with the arc length, but for what steps over 4 m long facets are off,
// 1 %.
TEST(SurfaceRays, OfEdgesAreHelicesRoundACylinder) {
  std::vector<dvec2> circle;
  for (int i = 0; i < 72; ++i) circle.push_back({2 * std::cos(2 * pi * i / 72), 2 * std::sin(2 * pi * i / 72)});
  const Target target(build_mesh(shapes::prism(circle, -2.0, 2.0), 1.0).mesh);
  int from_edges = 0;
  for (const SurfaceRay& ray : rays_of(target, {{0.9, 0.2}, {0.9, 0.2}})) {
    if (ray.kind != SurfaceRayKind::from_an_edge) continue;
    ++from_edges;
    const SurfaceRayPoint &first = ray.points.front(), &last = ray.points.back();
    EXPECT_NEAR(std::abs(first.position.z), 2.0, 1e-9);
    const double slope = (last.position.z - first.position.z) / last.arc_length;
    for (const SurfaceRayPoint& point : ray.points) {
      EXPECT_NEAR(std::hypot(point.position.x, point.position.y), 2.0, 4e-3);
      EXPECT_NEAR(point.position.z, first.position.z + slope * point.arc_length, 0.04);
      EXPECT_TRUE(std::isfinite(point.hard) && std::isfinite(point.soft));
    }
  }
  EXPECT_GE(from_edges, 38);  // the lit half and the dark one are 4 pi long
}

TEST(SurfaceRays, AreWrittenAsLines) {
  const Scratch scratch;
  const std::string file = (scratch / "rays.vtp").string();
  const std::string command = fmt::format("{} trace {}/cases/sphere/case.toml --look 3 --surface-rays {} > {}", RAYTUBE_PROGRAM,
                                          RAYTUBE_SOURCE_DIR, file, (scratch / "said.txt").string());
  for (int time = 0; time < 2; ++time) ASSERT_EQ(WEXITSTATUS(std::system(command.c_str())), 0);  // over its own earlier file, too
  const std::string text = text_of(file);
  const std::vector<double> ends = vtk_numbers(text, "offsets");
  ASSERT_FALSE(ends.empty());
  EXPECT_NE(text_of(scratch / "said.txt")
                .find(fmt::format("surface rays: {} at shadow boundaries, 0 from edges, at 3 GHz", ends.size())),
            std::string::npos);
  EXPECT_EQ(vtk_numbers(text, "points").size(), 3 * static_cast<std::size_t>(ends.back()));
  for (const char* name : {"connectivity", "arc_length", "xi", "width", "hard", "soft"})
    EXPECT_EQ(vtk_numbers(text, name).size(), static_cast<std::size_t>(ends.back())) << name;
  for (const char* name : {"kind", "order"}) EXPECT_EQ(vtk_numbers(text, name).size(), ends.size()) << name;
  const std::vector<double> lengths = vtk_numbers(text, "arc_length");
  EXPECT_EQ(lengths.front(), 0.0);
  // Until xi = 10 at the lowest frequency of the band: s = 10 a / m, of a sphere of 10 wavelengths; what a step may lack.
  const double m = std::cbrt(10 * pi * sampled_band(3e9).lowest / 3e9);
  EXPECT_NEAR(std::ranges::max(lengths), 100.0 / m, 0.5);
}

}  // namespace
}  // namespace raytube
