// Fringe currents of one look in plane waves, edge after edge.
#pragma once

#include <optional>
#include <vector>

#include "scene/image.h"
#include "utd/fringe/material_edges.h"
#include "utd/multiple/multiple_diffraction.h"
#include "utd/shadow/edge_phase.h"

namespace raytube {

/// How a wave meets a wedge. If it comes along a thin plate only the current on the plate's edge face counts.
struct EdgeMeeting {
  WedgeIncidence incidence;
  bool edge_face_only = false;
};

/// Whether a wedge has currents of the kind asked for.
bool radiates(const EdgeScene& scene, const Wedge& wedge, const FringeOptions& options);

/// How a wave that comes along `incident` meets wedge `index`; none if the edge adds nothing. From order 2 on an edge of perfect
/// conductors that is only grazed, over one face, takes its light from the edge at the other end of that face.
std::optional<EdgeMeeting> meeting(const EdgeScene& scene, std::uint32_t index, const dvec3& incident,
                                   const FringeOptions& options);

/// An edge and where it is lit.
struct LitEdge {
  std::uint32_t wedge;
  EdgeMeeting meeting;
  std::vector<LitInterval> lit;  // in order
};

/// Adds up what edges radiate, at first order or as strips. Keeps its buffers between edges, and references to its arguments but
/// not to the options.
class EdgeSum {
 public:
  EdgeSum(const EdgeScene& scene, const LookVectors& look, std::span<const double> frequencies, const FringeOptions& options);

  void add(const LitEdge& edge);

  /// What an edge that is added alone adds at the only frequency, from order 2 on, each wave at its place (strip_groups.h);
  /// `parts` are those of the lit ones on which the current of a plate's edge face has one place. Nothing may be added after
  /// that.
  std::vector<ImageEdge> pieces(const LitEdge& edge, std::span<const LitInterval> parts, const PathPlace& place);

  /// The sum; nothing may be added after that.
  EdgeLookResult take();

 private:
  void add_first_order(const Wedge& wedge, const LitEdge& edge);
  template <class Amplitude>
  void add_thickness(const Wedge& wedge, std::span<const LitInterval> lit, Amplitude amplitude);
  void add_edge_face(const Wedge& wedge, const EdgeMeeting& meeting, std::span<const LitInterval> lit);
  void add_sides(const Wedge& wedge, const EdgeMeeting& meeting, std::span<const LitInterval> lit);

  std::span<const Wedge> wedges_;
  const LookVectors& look_;
  std::span<const double> frequencies_;
  std::optional<MaterialEdges> materials_;     // if these are asked for; else:
  std::optional<MultipleDiffraction> strips_;  // from order 2 on
  std::vector<EdgePhase> phases_;
  EdgeLookResult result_;
};

}  // namespace raytube
