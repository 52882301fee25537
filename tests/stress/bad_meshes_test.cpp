// Meshes with every defect that files have: each facet accounted for, finite results, the same for every number of bodies turned
// inside out.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "run.h"
#include "stress/stability.h"
#include "stress/warts.h"

namespace raytube::testing {
namespace {

/// What does not add up in a report, 0 if all does.
std::uint64_t unaccounted(const PolygonSoup& soup, const LoadedMesh& loaded) {
  const MeshReport& r = loaded.report;
  const TriangleMesh& mesh = loaded.mesh;
  const auto differ = [](std::uint64_t a, std::uint64_t b) { return a > b ? a - b : b - a; };
  std::uint64_t off = differ(r.facets_read, soup.polygons.size()) + differ(r.vertices_read, soup.points.size());
  off += differ(r.triangles_read + r.triangles_added,
                r.triangles_traced + r.triangles_degenerate + r.triangles_duplicate + r.triangles_internal);
  off += differ(r.triangles_traced, mesh.triangles.size()) + differ(r.components, mesh.components.size());
  off += differ(r.patches, mesh.patches.size());
  std::uint64_t in_components = 0, closed = 0;
  for (const Component& component : mesh.components) {
    in_components += component.triangles;
    closed += component.closed ? 1 : 0;
  }
  return off + differ(in_components, mesh.triangles.size()) + differ(closed, r.components_closed);
}

/// Numbers that are no numbers, and triangles without an area.
std::uint64_t senseless(const TriangleMesh& mesh) {
  std::uint64_t count = 0;
  for (const dvec3& v : mesh.vertices) count += std::isfinite(v.x + v.y + v.z) ? 0 : 1;
  for (const Patch& patch : mesh.patches) count += std::abs(glm::length(patch.normal) - 1.0) < 1e-9 ? 0 : 1;
  for (const auto& [i, j, k] : mesh.triangles) {
    const dvec3 across = glm::cross(mesh.vertices[j] - mesh.vertices[i], mesh.vertices[k] - mesh.vertices[i]);
    count += glm::length(across) > 0.0 ? 0 : 1;
  }
  return count;
}

std::uint64_t not_finite(const SweepResult& result) {
  std::uint64_t count = 0;
  for (const ScatteringMatrix& s : result.total) count += std::isfinite(largest_amplitude(s)) ? 0 : 1;
  for (const ChannelErrors& errors : result.error)
    for (const auto& row : errors)
      for (const double error : row) count += std::isfinite(error) && error >= 0.0 ? 0 : 1;
  return count;
}

TEST(BadMeshes, EveryFacetIsAccountedForAndResultsAreFinite) {
  std::uint64_t off = 0, no_sense = 0, infinite = 0, facets = 0, open = 0, rows = 0, lost = 0, rays = 0;
  const int meshes = size_of_run(24, 200);
  const double frequency = 3e9;  // the space of the parts is 10 wavelengths wide
  for (int seed = 0; seed < meshes; ++seed) {
    const PolygonSoup soup = Warts(static_cast<std::uint64_t>(seed)).next(1 + seed % 7, 0.05 * (seed % 12));
    const LoadedMesh loaded = build_mesh(soup, 1.0);
    off += unaccounted(soup, loaded);
    no_sense += senseless(loaded.mesh);
    facets += loaded.report.triangles_read;
    open += loaded.report.open_edges;
    SolveOptions o = options(EdgeMethod::fringe, 5.0);
    o.tubes.mode = seed % 2 ? TubeMode::uniform : TubeMode::adaptive;
    o.tubes.max_bounces = 5;
    o.edges.order = 1 + seed % 3;
    o.edges.interaction = seed % 6 == 5;
    const Target target(loaded.mesh);
    for (const bool bistatic : {false, true}) {
      const Direction a{1.2, 0.4 + seed}, b{90 * degree, 0.0}, c{0.0, 0.0};
      Sweep sweep{{frequency}, {}, bistatic};
      for (const Direction& look : {a, b, c}) sweep.looks.push_back({look, bistatic ? Direction{1.9, 2.2} : look});
      const SweepResult result = solve(target, sweep, o);
      infinite += not_finite(result);
      rows += result.total.size();
      lost += result.statistics.lost_rays;
      rays += result.statistics.rays;
    }
  }
  std::printf("measured: %llu of %llu rays came from inside a body\n", static_cast<unsigned long long>(lost),
              static_cast<unsigned long long>(rays));
  const std::string which =
      fmt::format("{} meshes with the warts of CAD exports, {} facets, {} open edges left", meshes, facets, open);
  expect_stable({"facets, triangles, patches, components not accounted for in the report", which, double(off), 0.0, "counts"});
  expect_stable({"vertices, normals, triangles that make no sense after the repair", which, double(no_sense), 0.0, "counts"});
  expect_stable(
      {fmt::format("amplitudes and estimates that are no numbers, of {} rows", rows), which, double(infinite), 0.0, "counts"});
}

TEST(BadMeshes, TurnedInsideOutIsTheSame) {
  // Closed bodies are wound outward whatever the file says, sheets have two sides: not a bit may differ but for the order of the
  // corners, and with it the rounding of normals.
  double worst = 0.0;
  const int meshes = size_of_run(6, 30);
  for (int seed = 0; seed < meshes; ++seed) {
    PolygonSoup soup = Warts(static_cast<std::uint64_t>(1000 + seed)).next(3, 0.0);
    SolveOptions o = options(EdgeMethod::fringe, 5.0);
    o.tubes.mode = TubeMode::adaptive;
    o.edges.interaction = false;
    const Sweep sweep = monostatic({{1.2, 0.4 + seed}, {0.5, 2.0}}, 3e9);
    const SweepResult one = solve_soup(soup, sweep, o);
    for (auto& polygon : soup.polygons) std::ranges::reverse(polygon);
    const SweepResult other = solve_soup(soup, sweep, o);
    for (std::size_t i = 0; i < one.total.size(); ++i) {
      const double estimate = std::max(one.error[i][0][0], one.error[i][1][1]);
      const double change = largest_amplitude(one.total[i] - other.total[i]);
      worst = worse(worst, std::isfinite(change) ? (change - estimate) / largest_amplitude(one.total[i])
                                                 : std::numeric_limits<double>::infinity());
    }
  }
  expect_stable({"all facets of a file turned over: change beyond the estimated error",
                 "boxes, cylinders, plates, spheres through one another", worst, 1e-9,
                 "winding is mended, open surfaces have two sides"});
}

}  // namespace
}  // namespace raytube::testing
