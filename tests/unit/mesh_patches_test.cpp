#include "unit/mesh_shapes.h"

namespace raytube::shapes {
namespace {

TEST(MeshPatches, SinglePrecisionFacesStayWhole) {
  for (const int pieces : {1, 40}) {
    const PolygonSoup soup = moved(remeshed(cube(0.09), pieces, pieces), skew_rotation(), dvec3(0.02, -0.01, 0.03));
    const LoadedMesh loaded = build(in_single_precision(soup));
    EXPECT_EQ(loaded.report.patches, 6u);
    EXPECT_EQ(loaded.report.components_closed, 1u);
    const auto wedges = wedges_of(loaded);
    ASSERT_EQ(wedges.size(), 12u);
    for (const Wedge& wedge : wedges) EXPECT_NEAR(wedge.n, 1.5, 3e-7);  // rounding of the file over the size of a face
  }
}

TEST(MeshPatches, CurvedSurfacesAreNotFlattened) {
  const LoadedMesh loaded = build(sphere(200));
  const TriangleMesh& mesh = loaded.mesh;
  EXPECT_GT(mesh.patches.size(), mesh.triangles.size() * 48 / 100);  // the two halves of a quad are coplanar
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Patch& patch = mesh.patches[mesh.triangle_patch[i]];
    for (const std::uint32_t v : mesh.triangles[i])
      EXPECT_NEAR(glm::dot(patch.normal, mesh.vertices[v]), patch.offset, 1e-6);  // 2e-7 of the diagonal, 3.46
  }
}

TEST(MeshPatches, PlanesAreExactWhateverTheMesh) {
  const LoadedMesh loaded = build(moved(remeshed(plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), 31, 17), skew_rotation()));
  ASSERT_EQ(loaded.mesh.patches.size(), 1u);
  EXPECT_NEAR(glm::distance(loaded.mesh.patches[0].normal, skew_rotation()[2]), 0.0, 5e-16);
  EXPECT_NEAR(loaded.mesh.patches[0].offset, 0.0, 1e-16);
}

}  // namespace
}  // namespace raytube::shapes
