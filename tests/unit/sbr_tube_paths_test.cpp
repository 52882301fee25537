// The paths of all tubes of a look.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/error.h"
#include "core/threads.h"
#include "sbr/tube_paths.h"
#include "shapes.h"

namespace raytube {
namespace {

constexpr double frequency = 10 * speed_of_light;  // [Hz]; a wavelength of 0.1 m: ten tubes are 0.1 m wide
constexpr double rounding = 1e-12;                 // [m] distances of a few metres through a handful of operations

struct Scene {
  TriangleMesh mesh;
  std::vector<Material> materials{};
  TubeOptions options{};

  TubePaths paths(const Direction& look, std::uint64_t most) const {
    const Tracer tracer(mesh);
    return tube_paths({tracer, materials}, {look, look}, frequency, options, most);
  }
};

Scene of(PolygonSoup soup) { return {build_mesh(std::move(soup), 1.0).mesh}; }

Scene plate_of(const Material& material) {
  Scene scene = of(shapes::plate(1.0));
  for (Patch& patch : scene.mesh.patches) patch.material = 0;
  scene.materials = {material};
  return scene;
}

double area_of(const TubePaths& tubes) {
  return std::accumulate(tubes.paths.begin(), tubes.paths.end(), 0.0,
                         [](double sum, const TubePath& path) { return sum + path.area; });
}

const Direction from_above{0.0, 0.0};
const Direction into_dihedral{90 * degree, 30 * degree};

TEST(TubePaths, RunFromTheLaunchPlaneToASphereAroundTheTarget) {
  const Scene plate = of(shapes::plate(1.0));
  const TubePaths tubes = plate.paths(from_above, 10000);
  EXPECT_EQ(tubes.columns * tubes.rows, 10000u);
  EXPECT_EQ(tubes.stride, 1u);
  EXPECT_EQ(tubes.followed, 10000u);
  ASSERT_EQ(tubes.paths.size(), 10000u);
  EXPECT_NEAR(area_of(tubes), 1.0, rounding);
  const double radius = std::sqrt(0.5);
  for (const TubePath& path : tubes.paths) {
    ASSERT_EQ(path.points.size(), 3u);
    EXPECT_EQ(path.end, TubeEnd::left_the_scene);
    EXPECT_EQ(path.bounces(), 1);
    EXPECT_NEAR(path.points[0].position.z, 1.001 * radius, rounding);
    EXPECT_NEAR(path.points[1].position.z, 0.0, rounding);
    EXPECT_NEAR(path.points[1].path_length, 1.001 * radius, rounding);
    EXPECT_NEAR(glm::length(path.points[2].position), 1.25 * radius, rounding);
    EXPECT_NEAR(path.length(), path.points[0].position.z + path.points[2].position.z, rounding);
    EXPECT_NEAR(path.power(), path.area, rounding * path.area);
  }
}

// 100 x 100 cells: 60 tubes are 7 x 7 blocks of 15 and fewer; smaller blocks would be 8 x 8 and more.
TEST(TubePaths, OfBigLooksStandForBlocksOfCells) {
  const TubePaths tubes = of(shapes::plate(1.0)).paths(from_above, 60);
  EXPECT_EQ(tubes.stride, 15u);
  EXPECT_EQ(tubes.followed, 49u);
  ASSERT_EQ(tubes.paths.size(), 49u);
  EXPECT_EQ(tubes.paths[1].column, 22u);
  EXPECT_EQ(tubes.paths[1].row, 7u);
  EXPECT_EQ(tubes.paths.back().column, 95u);  // the middle of 90 to 99
  EXPECT_NEAR(tubes.paths.front().area, 0.15 * 0.15, rounding);
  EXPECT_NEAR(tubes.paths.back().area, 0.1 * 0.1, rounding);
  EXPECT_NEAR(area_of(tubes), 1.0, rounding);
}

TEST(TubePaths, AreThoseOfSingleTubes) {
  const Scene dihedral = of(shapes::dihedral(1.0, 1.0));
  const Tracer tracer(dihedral.mesh);
  const Look look{into_dihedral, into_dihedral};
  const TubeReplay replay({tracer}, look, frequency, dihedral.options);
  for (const TubePath& path : dihedral.paths(into_dihedral, 100).paths) {
    const TubeTrace cell = replay.follow(path.column, path.row);
    const TubeTrace tube = trace_tube({tracer}, look, frequency, dihedral.options, cell.center);
    EXPECT_EQ(tube.column, path.column);
    EXPECT_EQ(tube.row, path.row);
    ASSERT_EQ(static_cast<int>(tube.bounces.size()), path.bounces());
    for (std::size_t i = 0; i < tube.bounces.size(); ++i) {
      EXPECT_EQ(path.points[i + 1].position, tube.bounces[i].point + dihedral.mesh.center);
      EXPECT_EQ(path.points[i + 1].triangle, tube.bounces[i].triangle);
    }
  }
}

// Tubes that meet one face of a right-angle corner go on to the other one, or past it.
TEST(TubePaths, ThatAreTruncatedEndWhereTheyWouldBounceAgain) {
  Scene dihedral = of(shapes::dihedral(1.0, 1.0));
  const TubePaths whole = dihedral.paths(into_dihedral, 400);
  dihedral.options.max_bounces = 1;
  const TubePaths cut = dihedral.paths(into_dihedral, 400);
  ASSERT_EQ(cut.paths.size(), whole.paths.size());
  int truncated = 0;
  for (std::size_t i = 0; i < cut.paths.size(); ++i) {
    const TubePath &path = cut.paths[i], &full = whole.paths[i];
    EXPECT_EQ(path.end == TubeEnd::truncated, full.bounces() == 2);
    EXPECT_EQ(path.bounces(), 1);
    if (path.end != TubeEnd::truncated) continue;
    ++truncated;
    ASSERT_EQ(path.points.size(), 3u);
    EXPECT_EQ(path.points[2].triangle, -1);
    EXPECT_NEAR(glm::distance(path.points[2].position, full.points[2].position), 0.0, rounding);
  }
  EXPECT_GT(truncated, 100);
  const FacetHits hits = facet_hits(cut, dihedral.mesh.triangles.size());
  ASSERT_EQ(hits.at_bounce.size(), 1u);
  EXPECT_EQ(std::reduce(hits.at_bounce[0].begin(), hits.at_bounce[0].end()), cut.paths.size());
}

TEST(TubePaths, HitsAreTheBouncesOfAllPaths) {
  const Scene trihedral = of(shapes::trihedral(1.0));
  const TubePaths tubes = trihedral.paths({std::acos(1 / std::sqrt(3.0)), 45 * degree}, 5000);
  const std::vector<std::uint32_t> hits = facet_hits(tubes, trihedral.mesh.triangles.size()).at_any_bounce();
  int bounces = 0;
  for (const TubePath& path : tubes.paths) bounces += path.bounces();
  EXPECT_EQ(std::reduce(hits.begin(), hits.end()), static_cast<std::uint32_t>(bounces));
  EXPECT_GT(bounces, 2 * static_cast<int>(tubes.paths.size()));
}

// A film of half the impedance of space reflects -1/2 of the field at normal incidence: -eta / (2 R + eta).
TEST(TubePaths, KeepWhatSurfacesReflectOfThePower) {
  const Material film{"film", MaterialKind::thin_sheet, 0.0, {}, 0.5 * 376.730313668};
  for (const TubePath& path : plate_of(film).paths(from_above, 100).paths) {
    EXPECT_NEAR(path.points[1].power, 0.25, 1e-9);  // the digits of eta
    EXPECT_NEAR(path.power(), 0.25 * path.area, 1e-9 * path.area);
  }
  const Material absorber{"absorber", MaterialKind::absorber, 0.0, {}};
  for (const TubePath& path : plate_of(absorber).paths(from_above, 100).paths) {
    EXPECT_EQ(path.end, TubeEnd::absorbed);
    EXPECT_EQ(path.points.size(), 2u);
    EXPECT_EQ(path.power(), 0.0);
  }
}

TEST(TubePaths, AtAFiniteDistanceSpread) {
  const Scene plate = of(shapes::plate(1.0));
  const Tracer tracer(plate.mesh);
  const Look look{from_above, from_above, 5.0, 5.0};
  const TubePaths tubes = tube_paths({tracer}, look, frequency, plate.options, 100);
  ASSERT_EQ(tubes.paths.size(), 100u);
  for (const TubePath& path : tubes.paths) {
    const dvec3 start = path.points[0].position, hit = path.points[1].position;
    EXPECT_NEAR(glm::length(glm::cross(hit - start, start - dvec3(0, 0, 5))), 0.0, rounding);  // on a line from the antenna
    EXPECT_EQ(path.points[1].power, 1.0);
  }
}

// What is left of the mean of two polarisations across the ray, by the ray's own angle.
TEST(TubePaths, AtAFiniteDistanceKeepWhatIsReflectedAtTheirAngle) {
  Material glass{"glass", MaterialKind::half_space, 0.0, {}};
  glass.layers = {{{{{4.0, -0.2}}, 0.0}}};
  const Scene plate = plate_of(glass);
  const Tracer tracer(plate.mesh);
  const Look look{from_above, from_above, 1.5, 1.5};
  for (const TubePath& path : tube_paths({tracer, plate.materials}, look, frequency, plate.options, 100).paths) {
    const double cosine = 1.5 / glm::length(path.points[1].position - dvec3(0.0, 0.0, 1.5));
    const SurfaceResponse at = half_space_response({{4.0, -0.2}}, cosine);
    EXPECT_NEAR(path.points[1].power, 0.5 * (std::norm(at.reflected.te) + std::norm(at.reflected.tm)), rounding);
  }
}

TEST(TubePaths, AreTheSameForAnyNumberOfThreads) {
  const Scene trihedral = of(shapes::trihedral(1.0));
  std::vector<TubePaths> found;
  for (const int threads : {1, 4}) run_on_threads(threads, [&] { found.push_back(trihedral.paths({1.0, 0.5}, 3000)); });
  ASSERT_EQ(found[0].paths.size(), found[1].paths.size());
  for (std::size_t i = 0; i < found[0].paths.size(); ++i) {
    const TubePath &a = found[0].paths[i], &b = found[1].paths[i];
    EXPECT_EQ(a.column, b.column);
    EXPECT_EQ(a.row, b.row);
    ASSERT_EQ(a.points.size(), b.points.size());
    EXPECT_EQ(a.points.back().position, b.points.back().position);
  }
}

TEST(TubePaths, OfAPlateEdgeOnAreRefused) { EXPECT_THROW(of(shapes::plate(1.0)).paths({90 * degree, 0.0}, 100), InputError); }

}  // namespace
}  // namespace raytube
