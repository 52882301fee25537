// The edges of a look from antennas at a finite distance.
#pragma once

#include <span>

#include "scene/sweep.h"
#include "utd/fringe/edge_look_result.h"
#include "utd/fringe/edge_scene.h"
#include "utd/fringe/edges.h"
#include "utd/fringe/fringe_pieces.h"
#include "utd/fringe/screens.h"

namespace raytube {

/// S of the fringe currents (edges.h) as antennas at a finite distance find it; phase reference: the antennas'. Each edge is
/// taken in pieces so short that the waves of both antennas are plane along them; each has its own directions, fields and path,
/// and at order 2 or more its current follows its face as a plane wave would, so that what it starts at an edge x away is late by
/// up to k x^2 / (2 range). So does what waves over curved surfaces start, from where each of them has arrived. Behind screens,
/// as screened_fringe_scattering() has them, each piece with what they let through in its own directions, corner waves in those
/// of the middle of their edge. `subset.frequencies` [Hz] must not be empty; its indices count with screens only.
EdgeLookResult fringe_scattering_near(const EdgeScene& scene, const AntennaPair& antennas, const SweepSubset& subset,
                                      const FringeOptions& options, const SurfaceLight& light = {});

/// The same piece by piece of the lit edges within a cell of the lattice, as fringe_pieces() has them; not by path.
std::vector<ImageEdge> fringe_pieces_near(const EdgeScene& scene, const AntennaPair& antennas, const SweepSubset& subset,
                                          const PieceRequest& request, const FringeOptions& options);

}  // namespace raytube
