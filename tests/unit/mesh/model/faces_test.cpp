// Convex faces of planar patches, and the tree that finds them.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "mesh/model/face_tree.h"
#include "shapes.h"

namespace raytube {
namespace {

dvec3 area_vector_of(const TriangleMesh& mesh, std::span<const std::uint32_t> corners) {
  dvec3 sum(0.0);
  for (std::size_t i = 2; i < corners.size(); ++i)
    sum += 0.5 * area_vector(mesh.vertices[corners[0]], mesh.vertices[corners[i - 1]], mesh.vertices[corners[i]]);
  return sum;
}

// A plate of n x n squares, each cut along its diagonal, less those that `hole` names.
PolygonSoup divided_plate(
    int n, const std::function<bool(int, int)>& hole = [](int, int) { return false; }) {
  PolygonSoup soup;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) soup.points.emplace_back(i, j, 0.0);
  const auto at = [n](int i, int j) { return static_cast<std::uint32_t>(i * (n + 1) + j); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      if (hole(i, j)) continue;
      soup.polygons.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      soup.polygons.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return soup;
}

// Faces keep the area and the winding of their triangles, are convex, and every triangle knows its face.
void expect_sound(const TriangleMesh& mesh, const Faces& faces) {
  std::vector<dvec3> by_patch(mesh.patches.size(), dvec3(0.0));
  for (const auto& t : mesh.triangles)
    by_patch[mesh.triangle_patch[&t - &mesh.triangles[0]]] += 0.5 * area_vector(mesh.vertices, t);
  for (const Face& face : faces.faces) {
    const auto corners = faces.corners_of(face);
    ASSERT_GE(corners.size(), 3u);
    by_patch[face.patch] -= area_vector_of(mesh, corners);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const dvec3 turn = area_vector(mesh.vertices[corners[i]], mesh.vertices[corners[(i + 1) % corners.size()]],
                                     mesh.vertices[corners[(i + 2) % corners.size()]]);
      EXPECT_GE(glm::dot(turn, mesh.patches[face.patch].normal), 0.0);
    }
  }
  for (const dvec3& left : by_patch) EXPECT_NEAR(glm::length(left), 0.0, 1e-12 * mesh.radius * mesh.radius);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    EXPECT_EQ(faces.faces[faces.face_of_triangle[t]].patch, mesh.triangle_patch[t]);
}

TEST(Faces, RectanglesAreWhole) {
  const TriangleMesh plate = build_mesh(shapes::plate(1.0), 1.0).mesh, cube = build_mesh(shapes::cube(1.0), 1.0).mesh,
                     dihedral = build_mesh(shapes::dihedral(1.0, 2.0), 1.0).mesh;
  for (const auto& [mesh, count] : {std::pair(&plate, 1u), std::pair(&cube, 6u), std::pair(&dihedral, 2u)}) {
    const Faces faces = find_faces(*mesh);
    EXPECT_EQ(faces.faces.size(), count);
    for (const Face& face : faces.faces) EXPECT_EQ(face.corners, 4u);
    expect_sound(*mesh, faces);
  }
}

TEST(Faces, ADividedPlateIsMended) {
  const TriangleMesh mesh = build_mesh(divided_plate(12), 1.0).mesh;  // 288 triangles
  const Faces faces = find_faces(mesh);
  EXPECT_EQ(faces.faces.size(), 1u);
  expect_sound(mesh, faces);
}

TEST(Faces, AVertexInsideDoesNotDivideAConvexPatch) {
  const PolygonSoup soup{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.3, 0.6, 0}},
                         {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
  const TriangleMesh mesh = build_mesh(soup, 1.0).mesh;
  const Faces faces = find_faces(mesh);
  ASSERT_EQ(faces.faces.size(), 1u);
  EXPECT_EQ(faces.faces[0].corners, 4u);
  expect_sound(mesh, faces);
}

TEST(Faces, ASliverLiesInThePlaneOfItsCorners) {
  // Along an edge of a cube, 2e-7 of the diagonal high: its corners are near enough to both planes for either.
  PolygonSoup cube = shapes::cube(1.0);
  const double h = 3e-7;
  const auto apex = static_cast<std::uint32_t>(cube.points.size());
  cube.points.emplace_back(0.0, -0.5 + h, -0.5);  // on the face z = -1/2, beside its edge from corner 0 to corner 1
  std::erase(cube.polygons, std::vector<std::uint32_t>{0, 3, 1});
  cube.polygons.insert(cube.polygons.end(), {{0, apex, 1}, {0, 3, apex}, {apex, 3, 1}});
  const TriangleMesh mesh = build_mesh(cube, 1.0).mesh;
  const Faces faces = find_faces(mesh);
  EXPECT_EQ(mesh.patches.size(), 6u);
  EXPECT_EQ(faces.faces.size(), 6u);
  for (const Patch& plane : mesh.patches) EXPECT_NEAR(std::abs(plane.offset), 0.5, 1e-14);
  expect_sound(mesh, faces);
}

TEST(Faces, HolesStayOpen) {
  const auto hole = [](int i, int j) { return (i == 3 || i == 4) && j > 1 && j < 6; };
  const TriangleMesh mesh = build_mesh(divided_plate(9, hole), 1.0).mesh;
  expect_sound(mesh, find_faces(mesh));
}

TEST(Faces, CurvedSurfacesKeepTheirTriangles) {
  const TriangleMesh mesh = build_mesh(shapes::icosphere(2), 1.0).mesh;
  const Faces faces = find_faces(mesh);
  EXPECT_EQ(faces.faces.size(), mesh.triangles.size());
  expect_sound(mesh, faces);
}

TEST(FaceTree, FindsEveryFaceInThePrism) {
  const TriangleMesh mesh = build_mesh(shapes::icosphere(3), 1.0).mesh;
  const FaceTree tree(mesh);
  const SphericalBasis basis = spherical_basis({0.7, 0.4});
  std::vector<std::uint32_t> found;
  for (const double farthest : {-0.5, 0.2, 1e9}) {
    const Prism prism{dvec3(0.1, 0.0, 0.2), basis.theta_hat, basis.phi_hat, basis.radial, {-0.3, -0.1}, {0.2, 0.4}, farthest};
    tree.collect(prism, found);
    EXPECT_LT(found.size(), tree.faces().size() / 2);
    for (std::uint32_t f = 0; f < tree.faces().size(); ++f)
      for (const std::uint32_t v : tree.corners(f)) {
        const dvec3 r = mesh.vertices[v] - prism.base;
        const double u = glm::dot(r, prism.u_hat), w = glm::dot(r, prism.v_hat), depth = glm::dot(r, prism.direction);
        if (u < prism.low.x || u > prism.high.x || w < prism.low.y || w > prism.high.y || depth > farthest) continue;
        EXPECT_TRUE(std::ranges::count(found, f) == 1) << f;
      }
  }
}

TEST(FaceTree, LooksOnlyWithinTheSidesOfAPrism) {
  const TriangleMesh mesh = build_mesh(shapes::icosphere(3), 1.0).mesh;
  const FaceTree tree(mesh);
  const Patch floor{glm::normalize(dvec3(1, 1, 0)), 0.6};
  for (const double side : {1.0, -1.0}) {
    std::vector<std::uint32_t> found;
    Prism prism{dvec3(0.0), {0, 0, 1}, glm::normalize(dvec3(1, -1, 0)), side * floor.normal, {-9, -9}, {9, 9}, 1e9};
    prism.add({side * floor.normal, side * floor.offset});
    tree.collect(prism, found);
    std::vector<bool> is_found(tree.faces().size(), false);
    for (const std::uint32_t f : found) is_found[f] = true;
    for (std::uint32_t f = 0; f < tree.faces().size(); ++f) {
      const bool above = std::ranges::any_of(tree.corners(f), [&](std::uint32_t v) {
        return side * (glm::dot(mesh.vertices[v], floor.normal) - floor.offset) > 0.0;
      });
      EXPECT_TRUE(is_found[f] || !above);
    }
    EXPECT_LT(found.size(), side > 0.0 ? tree.faces().size() / 3 : tree.faces().size());
  }
}

}  // namespace
}  // namespace raytube
