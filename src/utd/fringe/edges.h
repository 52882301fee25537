// Fringe currents of a target's edges, one look at a time: what the wedges add to physical optics.
//
// In formulas: s' is the direction of the incident wave, s the one it is scattered to, k the wavenumber, S the scattering matrix
// with its phase reference at the centre of the mesh; fields go as e^{j omega t}.
//
// The fringe current is the exact current on the two faces of a wedge less the one that physical optics has there (Ufimtsev
// 1957). It is integrated along strips that leave every point of the edge on the grazing diffracted ray (Michaeli 1986), which
// gives an amplitude per length of edge; a straight piece radiates that amplitude times the integral of e^{jk (s - s') . r}.
//   order 1       strips are semi-infinite, as if every face went on for ever (utd/wedge)
//   order 2 or 3  strips end where their face does, and start further ones at the edge there (utd/multiple)
// Parts of edges count if the transmitter lights them and, where that is asked for, the receiver sees them (utd/shadow).
//
//   edge_scene.h       what is given: wedges, outlines, tracer; options
//   edge_look.h        the look: from infinity, or from antennas at a finite distance (near_pieces.h)
//   edge_groups.h      what of it lights which parts of edges, behind which screens (screens.h)
//   edge_sum.h         what edges in the same plane waves radiate, at either order
//   material_edges.h   edges of other materials
//   reflected_edges.h  edges lit by reflected waves
//   corner_edges.h     waves from corner to corner along edges
#pragma once

#include <span>

#include "scene/image.h"
#include "utd/fringe/edge_groups.h"
#include "utd/fringe/edge_look.h"
#include "utd/fringe/edge_look_result.h"
#include "utd/fringe/edge_scene.h"
#include "utd/fringe/screens.h"
#include "utd/surface/surface_arrival.h"

namespace raytube {

/// What waves over curved surfaces bring to the edges, and which of their frequencies are those asked for.
struct SurfaceLight {
  std::span<const SurfaceArrival> arrivals{};
  std::span<const std::size_t> frequencies{};
};

/// S of what these waves start at the edges, per frequency; added to `scattering`. Counted work (utd/wedge/work.h).
double add_arrivals(const EdgeScene& scene, const EdgeLook& look, std::span<const double> frequencies,
                    const FringeOptions& options, const SurfaceLight& light, std::span<ScatteringMatrix> scattering);

/// S of the fringe currents on all convex wedges that the transmitter lights, each clipped to its lit part, with
/// `receiver_shadow` also to what the receiver sees; summed coherently in wedge order. Not symmetric in a monostatic look: fringe
/// currents are reciprocal on the Keller cone only. From order 2 on, where currents end with their face and diffract again at the
/// edge there, S is bounded in every direction on polygonal faces, and no edge needs the forward-grazing window there.
///
/// From a finite distance (phase reference: the antennas') each edge is taken in pieces so short that the waves of both antennas
/// are plane along them; each has its own directions, fields and path, and at order 2 or more its current follows its face as a
/// plane wave would, so that what it starts at an edge x away is late by up to k x^2 / (2 range). So does what waves over curved
/// surfaces start, from where each of them has arrived.
///
/// Behind screens opaque surfaces cast shadows and screens do not. What parts of edges behind the same screens radiate is
/// transformed by what these let through along both lines of sight. Valid as T of the plane waves is: far from the screens' own
/// edges. What a current starts at another edge has the screens of its own edge, wherever that one is.
///
/// `subset.frequencies` [Hz] must not be empty.
EdgeLookResult fringe_scattering(const EdgeScene& scene, const EdgeLook& look, const SweepSubset& subset,
                                 const FringeOptions& options, const SurfaceLight& light = {});

/// The currents of fringe_scattering() at one of the frequencies, piece by piece of the lit edges within a cell of the lattice
/// each: S [m] of those on the faces beside a piece, and of what these start at other edges. Quadrature along the pieces differs
/// from that along the whole edge by its error, which they share by length: they add up to the sum of all.
std::vector<ImageEdge> fringe_pieces(const EdgeScene& scene, const EdgeLook& look, const SweepSubset& subset,
                                     const PieceRequest& request, const FringeOptions& options);

}  // namespace raytube
