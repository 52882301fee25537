#include "mesh/repair/steps.h"

#include <algorithm>

#include "mesh/features/convexity.h"
#include "mesh/model/faces.h"
#include "mesh/model/geometry.h"
#include "mesh/read/formats.h"
#include "unit/mesh_shapes.h"

namespace raytube::shapes {
namespace {

TEST(MeshPatches, SinglePrecisionFacesStayWhole) {
  for (const int pieces : {1, 40}) {
    const PolygonSoup soup =
        moved(remeshed(box(dvec3(0.0), dvec3(0.09)), pieces, pieces), skew_rotation(), dvec3(0.02, -0.01, 0.03));
    const LoadedMesh loaded = build(in_single_precision(soup));
    EXPECT_EQ(loaded.report.patches, 6u);
    EXPECT_EQ(loaded.report.components_closed, 1u);
    const auto wedges = wedges_of(loaded);
    ASSERT_EQ(wedges.size(), 12u);
    for (const Wedge& wedge : wedges) EXPECT_NEAR(wedge.n, 1.5, 3e-7);  // rounding of the file over the size of a face
  }
}

// Rounded coordinates, told as such, are put back on the planes of faces: what meets at right angles lies in one another, and a
// face is one polygon however it is cut.
TEST(MeshPatches, RoundedFacesArePlane) {
  const PolygonSoup exact = moved(remeshed(box(dvec3(0.0), dvec3(0.09)), 4, 4), skew_rotation(), dvec3(0.7, -0.6, 0.5));
  PolygonSoup rounded = in_single_precision(exact);
  rounded.step = coordinate_step(rounded.points, 0);
  const TriangleMesh mesh = build(rounded).mesh, before = build(exact).mesh;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Patch& plane = mesh.patch_of(t);
    for (const std::uint32_t v : mesh.triangles[t])
      EXPECT_LE(std::abs(glm::dot(plane.normal, mesh.vertices[v]) - plane.offset), 4e-16 * mesh.radius);
  }
  EXPECT_EQ(find_faces(mesh).faces.size(), 6u);
  EXPECT_TRUE(find_convexity(mesh).no_shadow);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)  // three roundings of half a step each way, and the plane's own
    EXPECT_LE(glm::distance(mesh.vertices[v] + mesh.center, before.vertices[v] + before.center), 2.0 * mesh.coordinate_step);
  EXPECT_GT(find_faces(build(in_single_precision(exact)).mesh).faces.size(), 6u);  // of a file that says nothing of rounding
}

TEST(MeshPatches, CurvedSurfacesAreNotFlattened) {
  const LoadedMesh loaded = build(sphere(200));
  const TriangleMesh& mesh = loaded.mesh;
  EXPECT_GT(mesh.patches.size(), mesh.triangles.size() * 46 / 100);  // the halves of a quad are coplanar, and a few at the poles
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const Patch& patch = mesh.patch_of(i);
    for (const std::uint32_t v : mesh.triangles[i])
      // 2e-6 of the diagonal, 3.46, and how far planes move as they grow.
      EXPECT_NEAR(glm::dot(patch.normal, mesh.vertices[v]), patch.offset, 1e-5);
  }
}

TEST(MeshPatches, PlanesAreExactWhateverTheMesh) {
  const LoadedMesh loaded = build(moved(remeshed(plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), 31, 17), skew_rotation()));
  ASSERT_EQ(loaded.mesh.patches.size(), 1u);
  EXPECT_NEAR(glm::distance(loaded.mesh.patches[0].normal, skew_rotation()[2]), 0.0, 5e-16);
  EXPECT_NEAR(loaded.mesh.patches[0].offset, 0.0, 1e-16);
}

// Two planes at right angles, of each a largest triangle of area 1/2, and a sliver along their crease that is as near to one as
// to the other. Whether it lies in the plane z = 0 may depend on where things are, not on how they are listed.
bool sliver_lies_in_the_ground(std::size_t first_triangle, int first_corner) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0.5, 1e-4, 1e-4}, {0.5, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0.5, 0, 2}};
  const std::vector<Triangle> listed{{0, 2, 1}, {0, 1, 3}, {5, 4, 6}, {0, 4, 2}, {2, 4, 5}, {2, 5, 1}};
  for (std::size_t i = 0; i < listed.size(); ++i) {
    Triangle triangle = listed[(i + first_triangle) % listed.size()];
    std::ranges::rotate(triangle, triangle.begin() + first_corner);
    mesh.triangles.push_back(triangle);
  }
  mesh.triangle_component.assign(listed.size(), 0);
  find_patches(mesh, 1e-3);
  EXPECT_EQ(mesh.patches.size(), 2u);
  const std::uint32_t patch = mesh.triangle_patch[(listed.size() - first_triangle) % listed.size()];
  return std::abs(mesh.patches[patch].normal.z) > 0.5;
}

TEST(MeshPatches, ASliverHasItsPlaneInWhateverOrderTrianglesAreListed) {
  const bool as_listed = sliver_lies_in_the_ground(0, 0);
  for (std::size_t triangle = 0; triangle < 6; ++triangle)
    for (int corner = 0; corner < 3; ++corner)
      EXPECT_EQ(sliver_lies_in_the_ground(triangle, corner), as_listed) << triangle << ' ' << corner;
}

}  // namespace
}  // namespace raytube::shapes
