// Fringe currents of edges that reflected waves light.
#pragma once

#include <span>
#include <vector>

#include "scene/image.h"
#include "scene/material.h"
#include "utd/fringe/edge_look_result.h"
#include "utd/fringe/edge_scene.h"
#include "utd/shadow/edge_visibility.h"
#include "utd/wedge/edge_currents.h"
#include "utd/wedge/path_place.h"

namespace raytube {

/// Lit parts of one edge.
struct LitWedge {
  std::uint32_t wedge;
  std::vector<LitInterval> lit;  // in order
  double weight = 1.0;           // of the wave there: 1/2 where the edge lies on the border of the reflected beam
};

/// A reflected plane wave E e^{-jk (s' . r + path)} and what it lights; `look` has its s', E and eta H of a unit wave that was
/// transmitted.
struct ReflectedLook {
  LookVectors look;
  double path = 0.0;  // [m]
  std::vector<LitWedge> edges;
  std::vector<ChannelWeights> weights{};  // [frequency] of the two fields, [own][transmit]; empty: they are those of V and H
};

/// S of the fringe currents (edges.h) of edges lit by reflected waves, one wave or more, from order 2 on. Edges that are only
/// grazed, and those that do not radiate, add nothing. The shadows are in `looks`: neither the tracer nor `receiver_shadow` is
/// used. `frequencies` [Hz] must not be empty.
EdgeLookResult reflected_fringe_scattering(const EdgeScene& scene, std::span<const ReflectedLook> looks,
                                           std::span<const double> frequencies, const FringeOptions& options);

/// The same of one wave at one frequency, strip by strip; `place` is that of its light, but for its path.
std::vector<ImageEdge> reflected_fringe_pieces(const EdgeScene& scene, const ReflectedLook& look,
                                               std::span<const double> frequencies, const FringeOptions& options,
                                               PathPlace place);

}  // namespace raytube
