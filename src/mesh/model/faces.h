// Planar patches as few convex polygons: what a beam of any width can be clipped against.
#pragma once

#include <span>
#include <vector>

#include "mesh/model/triangle_mesh.h"

namespace raytube {

/// A convex polygon of one patch, wound as its triangles are.
struct Face {
  std::uint32_t patch;                  // that it is part of
  std::uint32_t triangle;               // the lowest of those it stands for
  std::uint32_t first_corner, corners;  // in Faces::corners: where its own begin, and how many
};

/// Every triangle of the mesh is part of exactly one face.
struct Faces {
  std::vector<Face> faces;                      // in order of patches
  std::vector<std::uint32_t> corners;           // vertices of the mesh, face after face
  std::vector<std::uint32_t> face_of_triangle;  // index in `faces`

  /// The corners of a face, as vertices of the mesh.
  std::span<const std::uint32_t> corners_of(const Face& face) const { return {&corners[face.first_corner], face.corners}; }
};

/// A patch with a convex outline is one face; in others neighbouring triangles are joined as long as the union stays convex
/// (Hertel & Mehlhorn 1983), longest edges first. Patches whose corners lie beside their plane by more than rounding keep their
/// triangles, so that the projection of a face is convex from everywhere.
Faces find_faces(const TriangleMesh& mesh);

}  // namespace raytube
