// The edges of a target as fringe currents know them, and how these are computed.
#pragma once

#include <span>

#include "mesh/features/outlines.h"
#include "mesh/trace/tracer.h"
#include "scene/options.h"
#include "scene/surface_rays.h"
#include "utd/corner/corner_waves.h"
#include "utd/surface/curved_faces.h"

namespace raytube {

class OpaqueAndScreens;
struct EdgeMaterials;

/// What is referred to must outlive the scene.
struct EdgeScene {
  std::span<const Wedge> wedges;
  const Outlines& outlines;                   // of the faces beside the wedges; not used at order 1
  const Tracer& tracer;                       // of what casts shadows on them
  const CornerWaves* corners = nullptr;       // along the wedges: from order 2 on, else null
  const CurvedFaces* curved = nullptr;        // of the wedges, over which strips bend: from order 2 on
  const OpaqueAndScreens* screens = nullptr;  // if there are any: then the tracer is of its opaque surfaces
  const EdgeMaterials* materials = nullptr;   // if edges of other materials than perfect conductors count
};

struct FringeOptions {
  int order = 3;                 // edges in a row that a current passes, 1 or more; at 1 faces are taken as semi-infinite
  bool receiver_shadow = false;  // parts of edges hidden from the receiver do not count
  /// From order 2 on: currents that end at a right-angled corner run on as their mirror image. Right only if what edges send to
  /// other faces (utd/interaction) is counted, too.
  bool continue_by_images = false;
  std::vector<SurfaceRay>* rays = nullptr;  // takes the strips over curved faces, as at the first frequency
  bool of_materials = false;                // edges beside other materials count; else those of perfect conductors
};

}  // namespace raytube
