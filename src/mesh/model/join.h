// Several meshes as one scene that knows which triangle came from which.
#pragma once

#include <span>

#include "mesh/model/triangle_mesh.h"

namespace raytube {

struct JoinedMesh {
  TriangleMesh mesh;
  std::vector<std::uint32_t> triangle_part;  // index of the mesh each triangle came from
};

/// Puts meshes beside each other, each mended on its own before: nothing is welded across, no coincident facet is dropped, and
/// components and patches stay within their part. At least one mesh.
JoinedMesh join_meshes(std::span<const TriangleMesh> parts);

}  // namespace raytube
