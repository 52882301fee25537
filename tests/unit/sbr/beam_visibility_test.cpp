// Hidden surfaces in the launch plane: which beam reaches how much of which face.
#include "sbr/visible/beam_visibility.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <numeric>
#include <random>

#include "sbr/beams/footprint.h"
#include "shapes.h"

namespace raytube {
namespace {

constexpr double rounding = 1e-13;  // areas of order one after some dozens of cuts

const Direction from_above{0.0, 0.0};
const Direction oblique{0.5, 0.3};

// What a plane wave from `look` reaches of a target, and what its reflection meets in turn.
struct View {
  explicit View(PolygonSoup soup, const Direction& look = from_above)
      : loaded(build_mesh(std::move(soup), 1.0)), tree(loaded.mesh), tracer(loaded.mesh), visible(tree, tracer) {
    const LaunchGrid grid = launch_grid(loaded.mesh, look, 0.1, 10.0, {});
    incident = incident_beam(grid, spherical_basis(look), dvec2(0.0));
    receive = spherical_basis(look);
    std::vector<std::uint32_t> all(tree.faces().size());
    std::iota(all.begin(), all.end(), 0u);
    visible.of_faces(incident, all, direct);
  }

  std::vector<VisiblePart> reflected(const VisiblePart& part) {
    const std::uint32_t patch = tree.faces()[part.face].patch;
    const Beam beam = footprint(anchored(incident, middle(part.outline)), loaded.mesh.patches[patch], receive).outgoing;
    const Ray ray = visible.middle_ray(beam, patch, part.outline);
    Hit hit;
    tracer.closest_hits({&ray, 1}, {&hit, 1});
    std::vector<VisiblePart> parts;
    visible.from_surface(beam, patch, part.outline, hit, parts);
    return parts;
  }

  double area_of(std::uint32_t triangle) const {
    double sum = 0.0;
    for (const VisiblePart& part : direct)
      if (part.face == tree.face_of(triangle)) sum += area(part.outline);
    return sum;
  }

  LoadedMesh loaded;
  FaceTree tree;
  Tracer tracer;
  BeamVisibility visible;
  Beam incident;
  SphericalBasis receive;
  std::vector<VisiblePart> direct;
};

double total(const std::vector<VisiblePart>& parts) {
  double sum = 0.0;
  for (const VisiblePart& part : parts) sum += area(part.outline);
  return sum;
}

PolygonSoup triangles(const std::vector<std::array<dvec3, 3>>& list) {
  PolygonSoup soup;
  for (const auto& corners : list) {
    const auto base = static_cast<std::uint32_t>(soup.points.size());
    soup.points.insert(soup.points.end(), corners.begin(), corners.end());
    soup.polygons.push_back({base, base + 1, base + 2});
  }
  return soup;
}

TEST(BeamVisibility, TheUpperOfTwoTrianglesCutsTheLower) {
  // The lower: right triangle of area 2; the upper covers its corner region u + v <= 1 of area 1/2.
  const View view(triangles({{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}}, {{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}}}));
  EXPECT_NEAR(view.area_of(0), 1.5, rounding);
  EXPECT_NEAR(view.area_of(1), 0.5, rounding);
}

TEST(BeamVisibility, CrossingTrianglesAreDividedAtTheirLine) {
  // z = 0 against z = x - 1/2: the second lies above for x > 1/2.
  const View view(triangles({{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}}, {{{0, 0, -0.5}, {1, 0, 0.5}, {1, 1, 0.5}}}}));
  EXPECT_NEAR(view.area_of(0), 0.125, rounding);
  EXPECT_NEAR(view.area_of(1), 0.375, rounding);
}

TEST(BeamVisibility, CoincidentSheetsAreCountedOnce) {
  for (const double gap : {0.0, 1e-15}) {
    PolygonSoup soup = triangles({{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {{{0.1, 0.1, gap}, {1.1, 0.1, gap}, {0.1, 1.1, gap}}}});
    const glm::dmat3 tilt(glm::rotate(glm::dmat4(1.0), 0.4, glm::normalize(dvec3(1, 2, 3))));
    const View view(shapes::transformed(soup, tilt));
    // Union of the two triangles: 1/2 + 1/2 less their overlap, a right triangle of legs 0.8; foreshortened.
    const double cosine = std::abs(view.loaded.mesh.patches[0].normal.z);
    EXPECT_NEAR(total(view.direct), (1.0 - 0.32) * cosine, rounding) << gap;
  }
}

TEST(BeamVisibility, AThinGapIsStillAGap) {
  const View view(triangles({{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {{{0.1, 0.1, 1e-12}, {1.1, 0.1, 1e-12}, {0.1, 1.1, 1e-12}}}}));
  EXPECT_NEAR(view.area_of(1), 0.5, rounding);
  EXPECT_NEAR(view.area_of(0), 0.5 - 0.32, rounding);
}

TEST(BeamVisibility, ATriangleHiddenByManyIsNotSeen) {
  // A plate under a finely divided one, both tilted.
  PolygonSoup soup;
  constexpr int n = 24;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) soup.points.emplace_back(double(i) / n, double(j) / n, 0.3 + 0.01 * std::sin(9.0 * i + 5.0 * j));
  const auto at = [](int i, int j) { return static_cast<std::uint32_t>(i * (n + 1) + j); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      soup.polygons.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      soup.polygons.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  const auto base = static_cast<std::uint32_t>(soup.points.size());
  for (const dvec3& p : {dvec3(0.1, 0.1, 0), dvec3(0.9, 0.1, 0), dvec3(0.1, 0.9, 0)}) soup.points.push_back(p);
  soup.polygons.push_back({base, base + 1, base + 2});
  const View view(soup);
  EXPECT_NEAR(total(view.direct), 1.0, rounding);
  EXPECT_LE(view.area_of(2 * n * n), rounding);
}

TEST(BeamVisibility, AClosedBodyShowsItsProjection) {
  // Sum of |projected facet areas| / 2 for a convex body, whatever the direction.
  const View view(shapes::icosphere(4, 1.0), oblique);
  double projection = 0.0;
  const TriangleMesh& mesh = view.loaded.mesh;
  for (const auto& t : mesh.triangles)
    projection += 0.25 * std::abs(glm::dot(area_vector(mesh.vertices, t), view.incident.direction));
  EXPECT_NEAR(total(view.direct), projection, rounding);
  EXPECT_EQ(2 * view.direct.size(), view.tree.faces().size());
}

TEST(BeamVisibility, ADihedralSendsEachBeamToTheOtherFace) {
  // Faces of 1 m on +x and +y at azimuth g: both single projections are sin g and cos g, and the smaller comes back whole
  // from each side.
  const double g = 30.0 * degree;
  View view(shapes::dihedral(1.0, 1.0), {90.0 * degree, g});
  ASSERT_EQ(view.direct.size(), 2u);
  EXPECT_NEAR(total(view.direct), std::sin(g) + std::cos(g), rounding);
  for (const VisiblePart& part : view.direct) {
    const std::vector<VisiblePart> second = view.reflected(part);
    ASSERT_EQ(second.size(), 1u);
    EXPECT_NE(second[0].face, part.face);
    EXPECT_NEAR(total(second), std::sin(g), rounding);
  }
}

TEST(BeamVisibility, AConvexBodyDoesNotSeeItself) {
  for (const PolygonSoup& soup : {shapes::cube(1.0), shapes::icosphere(3, 1.0), shapes::cylinder(0.3, 1.0, 48)}) {
    View view(soup, oblique);
    for (const VisiblePart& part : view.direct) EXPECT_TRUE(view.reflected(part).empty());
  }
}

// Faces beside a region are left out where its bounding box still has them, and only those: of a plane wave, and of the same wave
// from an antenna at three radii.
TEST(BeamVisibility, AsksForTheFacesOfARegionAlone) {
  const View view(shapes::icosphere(3, 1.0), oblique);
  const ConvexPolygon region = [] {
    ConvexPolygon triangle;
    set_corners(triangle, std::array{dvec2(-0.4, -0.3), dvec2(0.5, 0.4), dvec2(0.45, 0.5)});
    return triangle;
  }();
  Beam from_antenna = view.incident;
  from_antenna.anchor = dvec2(0.0), from_antenna.base = dvec3(0.0), from_antenna.curvature = 1.0 / 3.0;
  for (const Beam& beam : {view.incident, from_antenna}) {
    const auto found = [&](const ConvexPolygon* within) {
      std::vector<std::uint32_t> faces;
      view.tree.collect(prism_of(beam, nullptr, bounds(region), within, 1e9, 1.0), faces);
      return faces;
    };
    const std::vector<std::uint32_t> in_box = found(nullptr), in_region = found(&region);
    EXPECT_LT(in_region.size(), 0.7 * static_cast<double>(in_box.size()));
    for (const std::uint32_t face : in_box) {
      if (std::ranges::count(in_region, face)) continue;
      const auto beyond = [&](const Corner& side) {
        return std::ranges::all_of(view.tree.points(face),
                                   [&](const dvec3& corner) { return side.edge(launch_coordinates(beam, corner)) < 0.0; });
      };
      EXPECT_TRUE(std::ranges::any_of(region, beyond)) << face;
    }
  }
}

// Random triangles in space, thrown together: every ray's own first surface is the part it lies in.
TEST(BeamVisibility, PartsAgreeWithSingleRays) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  std::vector<std::array<dvec3, 3>> list;
  for (int i = 0; i < 120; ++i) {
    const dvec3 center(number(random), number(random), number(random));
    const auto corner = [&] { return center + 0.5 * dvec3(number(random), number(random), number(random)); };
    list.push_back({corner(), corner(), corner()});
  }
  View view(triangles(list), oblique);
  int hits = 0;
  for (int i = 0; i < 4000; ++i) {
    const dvec2 at(1.3 * number(random), 1.3 * number(random));
    const Ray ray{view.incident.base + at.x * view.incident.u_hat + at.y * view.incident.v_hat, view.incident.direction,
                  no_index};
    Hit hit;
    view.tracer.closest_hits({&ray, 1}, {&hit, 1});
    int owners = 0;
    for (const VisiblePart& part : view.direct) {
      if (!std::ranges::all_of(part.outline, [&](const Corner& corner) { return corner.edge(at) >= 0.0; })) continue;
      ++owners;
      EXPECT_EQ(part.face, hit ? view.tree.face_of(hit.triangle) : no_index);
    }
    EXPECT_EQ(owners, hit ? 1 : 0);
    hits += owners;
  }
  EXPECT_GT(hits, 1000);
  EXPECT_LE(view.visible.sliver_area(), 1e-12);
}

}  // namespace
}  // namespace raytube
