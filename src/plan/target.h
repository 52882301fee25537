// A mesh made ready: everything a solve needs of it that no look and no frequency changes.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "mesh/features/convexity.h"
#include "mesh/features/outlines.h"
#include "mesh/features/thin_plates.h"
#include "mesh/load.h"
#include "mesh/model/face_tree.h"
#include "mesh/trace/tracer.h"
#include "scene/options.h"

namespace raytube {

/// What the surface of a mesh tells by itself: its wedges, the outlines of their faces, and the narrow faces that may be edges of
/// thin plates (none without `thin_plates`). Keeps a reference to the mesh.
struct SurfaceFeatures {
  /// Finds them, each from what stands before it.
  SurfaceFeatures(const TriangleMesh& mesh, const WedgeOptions& options);

  FaceTree faces;                               // convex polygons of its patches
  Convexity convexity;                          // what its shape rules out
  std::vector<Wedge> wedges;                    // convex and concave
  std::vector<bool> components_enclosed;        // find_enclosed_components
  std::uint64_t wedges_enclosed;                // of these, inside a closed body
  Outlines outlines;                            // of the faces of wedges
  std::vector<ThinPlateEdge> thin_plate_edges;  // of any material, thinnest first
};

/// Ray-tracing structures of a mesh, and what its surface tells. Owns the mesh; can be moved, not copied.
struct Target : SurfaceFeatures {
  /// Builds all of it, which takes longer than the solve of a simple look.
  explicit Target(TriangleMesh mesh, const WedgeOptions& options = {});

 private:
  struct Made;
  explicit Target(Made&& made);

  std::unique_ptr<const TriangleMesh> owned_;  // stays where it is when the target is moved

 public:
  const TriangleMesh& mesh;  // owned
  WedgeOptions options;      // it was made with; creases of the threshold to 1e-3 are tessellation
  Tracer tracer;             // rays against the mesh
};

}  // namespace raytube
