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
//   edge_pass.h        the sum over edges at either order, which all of the following share
//   corner_pass.h      waves from corner to corner of a sheet (utd/corner), from order 2 on
//   edges.h            antennas at infinity           near_edges.h       at a finite distance
//   reflected_edges.h  edges lit by reflected waves   screened_edges.h   behind sheets that let waves through (screens.h)
//   material_edges.h   edges of other materials       fringe_pieces.h    single pieces of edges, for images
#pragma once

#include <span>

#include "scene/sweep.h"
#include "utd/fringe/edge_look_result.h"
#include "utd/fringe/edge_scene.h"
#include "utd/surface/surface_arrival.h"

namespace raytube {

/// What waves over curved surfaces bring to the edges, and which of their frequencies are those asked for.
struct SurfaceLight {
  std::span<const SurfaceArrival> arrivals{};
  std::span<const std::size_t> frequencies{};
};

/// S of what these waves start at the edges, per frequency; added to `scattering`. Counted work (utd/wedge/work.h).
double add_arrivals(const EdgeScene& scene, const LookVectors& look, std::span<const double> frequencies,
                    const FringeOptions& options, const SurfaceLight& light, std::span<ScatteringMatrix> scattering);

/// S of the fringe currents on all convex wedges that the transmitter lights, each clipped to its lit part, with
/// `receiver_shadow` also to what the receiver sees; summed coherently in wedge order. Not symmetric in a monostatic look: fringe
/// currents are reciprocal on the Keller cone only. From order 2 on, where currents end with their face and diffract again at the
/// edge there, S is bounded in every direction on polygonal faces, and no edge needs the forward-grazing window there.
/// `frequencies` [Hz] must not be empty.
EdgeLookResult fringe_scattering(const EdgeScene& scene, const Look& look, std::span<const double> frequencies,
                                 const FringeOptions& options, const SurfaceLight& light = {});

}  // namespace raytube
