// Where the phase of an amplitude counts from, and what is known of S whatever the target.
#pragma once

#include <span>

#include "mesh/model/triangle_mesh.h"
#include "scene/sweep.h"

namespace raytube {

/// Factor that a shift of all of the target by so much [m] has on the amplitudes of a look from infinity.
Complex shifted_phase(const dvec3& shift, const Look& look, double frequency);

/// Factor that moves the phase reference from the centre of the mesh to the origin of its own coordinates; 1 at a finite
/// distance, where that of the antennas lies there already.
Complex to_mesh_origin(const TriangleMesh& mesh, const Look& look, double frequency);

/// What edge-face interaction, found for plane waves with their phase reference at the centre of the mesh, is times for antennas
/// at a finite distance.
Complex from_plane_waves(const TriangleMesh& mesh, const Look& look, const Radar& radar, double frequency);

/// Reciprocity: the true S of a monostatic look has S_vh = S_hv, so dropping our antisymmetric part brings S closer. One bounce
/// has none; several bounces have one out of their specular directions, fringe currents off their cone. A bistatic sweep is
/// left alone, also where it passes the monostatic direction: there the parts correct one another, and rows must not jump.
void make_reciprocal(std::span<ScatteringMatrix> scattering);

}  // namespace raytube
