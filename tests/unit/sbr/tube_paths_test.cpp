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
    const TubeTrace cell = replay.follow(path.column, path.row).front();
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

// A film of half the impedance of space reflects -1/2 of the field at normal incidence: -eta / (2 R + eta). 1/2 goes on.
const Material half_film{"film", MaterialKind::thin_sheet, 0.0, {}, 0.5 * 376.730313668};

TEST(TubePaths, KeepWhatSurfacesReflectOfThePower) {
  for (const TubePath& path : plate_of(half_film).paths(from_above, 100).paths) {
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

Scene two_films() {
  Scene films =
      of(shapes::joined(shapes::plate(1.0), shapes::transformed(shapes::plate(1.0), glm::dmat3(1.0), 1.0, {0, 0, -0.5})));
  for (Patch& patch : films.mesh.patches) patch.material = 0;
  films.materials = {half_film};
  films.options.max_bounces = 3;
  return films;
}

// What the first film lets through goes to and fro between both, and on behind each of them.
TEST(TubePaths, GoOnBothWaysAtSheets) {
  const Scene films = two_films();
  const TubePaths tubes = films.paths(from_above, 100);
  ASSERT_EQ(tubes.met_target(), 100u);
  ASSERT_EQ(tubes.paths.size(), 400u);
  const TubePath* const of_one = &tubes.paths[0];
  const std::array shares{0.25, 1.0 / 64.0, 1.0 / 16.0, 1.0 / 64.0};  // R; T R R, cut; T T; T R T
  const std::array<int, 4> first{0, 1, 2, 3}, last{1, 3, 2, 3};
  for (std::size_t way = 0; way < 4; ++way) {
    EXPECT_EQ(of_one[way].column, of_one[0].column);
    EXPECT_EQ(of_one[way].points.front().bounce, first[way]);
    EXPECT_EQ(of_one[way].bounces(), last[way]);
    EXPECT_NEAR(of_one[way].power(), shares[way] * of_one[way].area, 1e-9 * of_one[way].area);
    EXPECT_EQ(of_one[way].end, way == 1 ? TubeEnd::truncated : TubeEnd::left_the_scene);
  }
  EXPECT_NEAR(of_one[2].points.front().path_length, of_one[0].points[1].path_length + 0.5, rounding);
  const FacetHits hits = facet_hits(tubes, films.mesh.triangles.size());
  ASSERT_EQ(hits.at_bounce.size(), 3u);
  for (const auto& at_bounce : hits.at_bounce) EXPECT_EQ(std::reduce(at_bounce.begin(), at_bounce.end()), 100u);
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

// The ways of a plane wave, each surface at the ray's own angle: R of a film is -1 / (1 + c) in TE and -c / (1 + c) in TM if R =
// eta / 2, T = 1 + R. From 3 m the rays pass both films at one angle; the shares of two polarisations multiply each by itself.
TEST(TubePaths, AtAFiniteDistanceGoOnBothWaysAtSheets) {
  const Scene films = two_films();
  const Tracer tracer(films.mesh);
  const TubePaths tubes =
      tube_paths({tracer, films.materials}, {from_above, from_above, 3.0, 3.0}, frequency, films.options, 100);
  ASSERT_EQ(tubes.met_target(), 100u);
  std::size_t whole = 0;
  for (std::size_t i = 0; i + 4 <= tubes.paths.size(); ++i) {
    const TubePath* const way = &tubes.paths[i];
    if (way[3].column != way[0].column || way[3].row != way[0].row || way[0].points.front().bounce != 0) continue;
    ++whole;
    const dvec3 first = way[0].points[1].position, from = dvec3(0.0, 0.0, 3.0), d = glm::normalize(first - from);
    const SurfaceResponse at = response(half_film, 0, wavenumber(frequency), -d.z, false);
    const auto share = [&](int transmitted, int reflected) {
      const auto of = [&](Complex t, Complex r) {
        return std::pow(std::norm(t), transmitted) * std::pow(std::norm(r), reflected);
      };
      return 0.5 * (of(at.transmitted.te, at.reflected.te) + of(at.transmitted.tm, at.reflected.tm));
    };
    EXPECT_NEAR(way[0].power(), share(0, 1) * way[0].area, 1e-9 * way[0].area);
    EXPECT_NEAR(way[1].points.front().power, share(1, 0), 1e-9);
    EXPECT_NEAR(way[1].points[1].power, share(1, 1), 1e-9);
    EXPECT_NEAR(way[2].power(), share(2, 0) * way[2].area, 1e-9 * way[2].area);
    EXPECT_NEAR(way[3].power(), share(2, 1) * way[3].area, 1e-9 * way[3].area);
    EXPECT_NEAR(glm::length(glm::cross(way[2].points.front().position - from, d)), 0.0, rounding);  // straight on
  }
  EXPECT_GT(whole, 50u);
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
