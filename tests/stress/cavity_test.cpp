// Hundreds of bounces: in a box with a slit, and between two plates.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "run.h"
#include "shapes.h"
#include "stress/stability.h"

namespace raytube::testing {
namespace {

constexpr double frequency = 10e9;
const double lambda = wavelength(frequency);

/// A box of sides a, open by a slit of this width all along the middle of its top.
PolygonSoup box_with_slit(double a, double slit) {
  const double h = a / 2, s = slit / 2;
  return {{{-h, -h, -h},
           {h, -h, -h},
           {h, h, -h},
           {-h, h, -h},
           {-h, -h, h},
           {h, -h, h},
           {h, h, h},
           {-h, h, h},
           {-s, -h, h},
           {s, -h, h},
           {s, h, h},
           {-s, h, h}},
          {{0, 3, 2, 1}, {0, 1, 5, 9, 8, 4}, {2, 3, 7, 11, 10, 6}, {1, 2, 6, 5}, {3, 0, 4, 7}, {4, 8, 11, 7}, {9, 5, 6, 10}}};
}

PolygonSoup parallel_plates(double a, double gap) {
  PolygonSoup soup = shapes::plate(a);
  for (const dvec3& p : shapes::plate(a).points) soup.points.push_back(p + dvec3(0, 0, gap));
  soup.polygons.push_back({4, 5, 6});
  soup.polygons.push_back({4, 6, 7});
  return soup;
}

struct Scene {
  const char* name;
  PolygonSoup soup;
  Direction look;
};

const double side = 3 * lambda;

std::vector<Scene> scenes() {
  return {{"box with a slit", box_with_slit(side, 0.03 * lambda), {25 * degree, 20.3 * degree}},
          {"two plates", parallel_plates(side, side / 400), {50 * degree, 10 * degree}}};
}

/// S of a bounce over its bound: the current is at most 2 per unit field, |S| <= k / (2 pi) times the surface lit; a beam of
/// cross section A, never more than the target's, lights A / |d . n| of a wall, and |d . n| is one of the components of d for
/// ever, as the walls are upright on the axes.
double energy(const Scene& scene, const SweepResult& result) {
  const dvec3 d = glm::abs(spherical_basis(scene.look).radial);
  const double lit = side * side * (d.x + d.y + d.z) / std::min({d.x, d.y, d.z});
  double worst = 0.0;
  for (const std::vector<ScatteringMatrix>& bounce : result.bounces) {
    const double share = largest_amplitude(bounce[0]) / (wavenumber(frequency) / (2 * pi) * lit);
    worst = worse(worst, std::isfinite(share) ? share : std::numeric_limits<double>::infinity());
  }
  return worst;
}

TEST(Cavity, EnergyAndCountsStayBounded) {
  double strongest = 0.0, pieces = 0.0, rays = 0.0, gain = 0.0;
  std::size_t most_bounces = 0;
  for (const Scene& scene : scenes()) {
    const LoadedMesh loaded = build_mesh(scene.soup, 1.0);
    for (const TubeMode mode : {TubeMode::adaptive, TubeMode::uniform}) {
      SolveOptions o = options(EdgeMethod::none, 20.0);
      o.tubes.mode = mode;
      const Target target(loaded.mesh);
      SweepResult before;
      for (const int bounces : {1, 2, 3, 10, 50, 200}) {
        o.tubes.max_bounces = bounces;
        const SweepResult result = solve(target, monostatic({scene.look}, frequency), o);
        const Statistics& count = result.statistics;
        strongest = std::max(strongest, energy(scene, result));
        most_bounces = std::max(most_bounces, count.hits.size());
        // A ray is a tube or the reflection of one that hit; with one tube a cell nothing is added on the way.
        std::uint64_t hits = 0;
        for (std::size_t b = 0; b < count.hits.size(); ++b) {
          hits += count.hits[b];
          if (mode == TubeMode::uniform && b > 0) gain = std::max(gain, double(count.hits[b]) - double(count.hits[b - 1]));
          if (mode == TubeMode::adaptive) pieces = std::max(pieces, double(count.hits[b]) / double(b + 1));
        }
        rays = std::max(rays, double(count.rays) / double(count.tubes + hits));
        EXPECT_LE(count.hits.size(), static_cast<std::size_t>(bounces));
        EXPECT_EQ(count.lost_rays, 0u);
        // Bounces that were followed before are the same now.
        for (std::size_t b = 0; b < before.bounces.size() && b < result.bounces.size() && mode == TubeMode::uniform; ++b)
          EXPECT_EQ(before.bounces[b][0].s, result.bounces[b][0].s) << scene.name << ", bounce " << b + 1 << " of " << bounces;
        before = result;
      }
    }
  }
  std::printf("measured: up to %zu bounces; %.0f pieces per bounce\n", most_bounces, pieces);
  expect_stable({"1 ... 200 bounces: S of a bounce over k/(2 pi) times the most that the beam can light",
                 "box with a slit, two "
                 "plates; adaptive, uniform",
                 strongest, 1.0, "a beam keeps its cross section"});
  expect_stable({"the same: more tubes after a bounce than before it", "uniform", gain, 0.0, "a tube is one ray"});
  expect_stable({"the same: pieces of tubes that hit at bounce b over b", "adaptive", pieces, 2000.0,
                 "edges cut a beam once per bounce and border"});
  expect_stable({"the same: rays over tubes and hits", "adaptive, uniform", rays, 1.0, "every ray is accounted for"});
}

}  // namespace
}  // namespace raytube::testing
