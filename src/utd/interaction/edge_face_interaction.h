// Diffraction between surfaces: waves that edges send to other surfaces, which physical optics lights as if there were none.
// Derived in docs/between.md.
#pragma once

#include <vector>

#include "mesh/features/outlines.h"
#include "mesh/model/face_tree.h"
#include "scene/image.h"
#include "utd/interaction/edge_axes.h"
#include "utd/wedge/transition.h"

namespace raytube {

struct InteractionResult {
  std::vector<ScatteringMatrix> scattering;  // per frequency; phase reference: centre of the mesh. Empty: nothing is painted
  std::vector<ChannelErrors> error;          // per frequency, estimated, of its quadrature [m]
  std::uint64_t lit_pieces = 0;              // of edges, each once per wave that lights it
};

/// A target as diffracted waves see it.
struct InteractionScene {
  const FaceTree& tree;
  const Tracer& tracer;
  std::span<const Wedge> wedges;
  const Outlines& outlines;
  std::span<const EdgeAxis> axes;  // into `wedges`
  std::span<const dvec3> corners;  // where its faces jump or bend as seen from an edge; may be left out
  const std::vector<bool>& large;  // the patches that are painted, and mirrors
};

struct InteractionOptions {
  int order = 3;  // of the fringe currents
  TransitionTier transition = TransitionTier::exact;
  double tolerance = 0.0;  // at which quadrature stops, as far as it can tell [m]
};

/// Reflections of a path from the transmitter over an edge to the last surface it lights, before and after the edge together.
inline constexpr int most_reflections = 2;

/// S of the currents that diffracted waves paint on other surfaces than those of their own edge, at most one edge a path; at
/// order 2 and 3 also of the fringe currents of edges that light reaches after one reflection. Not symmetric in a monostatic
/// look.
InteractionResult interaction_scattering(const InteractionScene& scene, const Look& look, std::span<const double> frequencies,
                                         const InteractionOptions& options);

/// The same at `frequencies[frequency]`, by the lit pieces of edges these waves come from.
std::vector<ImageEdge> interaction_pieces(const InteractionScene& scene, const Look& look, std::span<const double> frequencies,
                                          std::size_t frequency, const InteractionOptions& options);

}  // namespace raytube
