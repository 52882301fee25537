// What cannot be solved is refused before anything is computed.
#pragma once

#include "mesh/model/face_tree.h"
#include "scene/options.h"
#include "scene/sweep.h"

namespace raytube {

/// Whether all antennas are at infinity; else none is.
bool all_far(const Sweep& sweep);

/// Throws InputError for an empty or non-physical sweep, options out of range, or the two asking for what does not go together.
void check_options(const Sweep& sweep, const TubeOptions& tubes, const EdgeOptions& edges);

/// Throws InputError if the mesh is made of materials that the sweep has not, or of solids that cannot be
/// (mesh/soundness/solids.h).
void check_materials(const FaceTree& faces, const Sweep& sweep);

/// Throws InputError if an antenna at a finite distance has not all of the target in front, or its pattern ends on it.
void check_antennas(const TriangleMesh& mesh, const Sweep& sweep);

/// The most tubes per wavelength that every look of a sweep takes (densest_grid).
double densest_tubes(const TriangleMesh& mesh, const Sweep& sweep, const TubeOptions& tubes);

/// Throws InputError, with the density that would fit, if a look would have to begin with more.
void check_density(const TriangleMesh& mesh, const Sweep& sweep, const TubeOptions& tubes);

}  // namespace raytube
