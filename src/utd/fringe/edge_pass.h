// One look at the edges of a target, edge after edge: at first order, or as strips.
#pragma once

#include <optional>
#include <vector>

#include "utd/fringe/edge_look_result.h"
#include "utd/fringe/material_edges.h"
#include "utd/multiple/multiple_diffraction.h"
#include "utd/shadow/edge_phase.h"

namespace raytube {

inline dvec3 point_on(const Wedge& wedge, double fraction) { return wedge.start + fraction * (wedge.end - wedge.start); }

/// [m]; `frequencies` must not be empty.
double shortest_wavelength(std::span<const double> frequencies);

/// How a wave meets a wedge. If it comes along a thin plate only the current on the plate's edge face counts.
struct EdgeMeeting {
  EdgeMeeting(const Wedge& wedge, const dvec3& incident);
  /// Of an edge of other materials.
  explicit EdgeMeeting(const WedgeIncidence& at) : incidence(at), of_materials(true) {}

  WedgeIncidence incidence;
  bool edge_face_only = false, of_materials = false;
};

/// What the thickness of thin plates adds; nothing at sharp edges. Keeps references to its arguments.
class ThicknessPass {
 public:
  ThicknessPass(const LookVectors& look, std::span<const double> frequencies) : look_(look), frequencies_(frequencies) {}

  /// The current on the narrow face of the plate's edge.
  void add_edge_face(const Wedge& wedge, const WedgeIncidence& incidence, std::span<const LitInterval> lit);

  /// At first order, the change of the currents on both sides of the plate.
  void add_sides(const Wedge& wedge, const WedgeIncidence& incidence, std::span<const LitInterval> lit);

  void add_to(std::vector<ScatteringMatrix>& scattering) const;

 private:
  template <class Amplitude>
  void add(const Wedge& wedge, std::span<const LitInterval> lit, Amplitude amplitude, double weight = 1.0);

  const LookVectors& look_;
  std::span<const double> frequencies_;
  std::vector<EdgePhase> pieces_;
  std::vector<ScatteringMatrix> sums_;  // empty while there are none
};

/// First order, one look: adds up edge after edge, keeping its buffers between them. Keeps references to its arguments.
class FirstOrderEdges {
 public:
  FirstOrderEdges(const EdgeScene& scene, const LookVectors& look, std::span<const double> frequencies);

  /// How the wave meets wedge `index`; none if the edge adds nothing.
  std::optional<EdgeMeeting> meeting(std::uint32_t index) const;

  void add(std::uint32_t index, const EdgeMeeting& meeting, std::span<const LitInterval> lit);

  /// The sum; nothing may be added after that.
  EdgeLookResult take();

 private:
  void radiate(const EdgeAmplitude& amplitude);

  std::span<const Wedge> wedges_;
  const LookVectors& look_;
  std::span<const double> frequencies_;
  ThicknessPass thickness_;
  MaterialEdges materials_;
  std::vector<EdgePhase> pieces_;
  EdgeLookResult result_;
};

/// Order 2 or more, one look: adds up the strips of edge after edge. Keeps references to its arguments, but not to the options.
class StripEdges {
 public:
  StripEdges(const EdgeScene& scene, const LookVectors& look, std::span<const double> frequencies, const FringeOptions& options);

  /// How the wave meets wedge `index`; none if the edge adds nothing. One that is only grazed, over one face, takes its light
  /// from the edge at the other end of that face.
  std::optional<EdgeMeeting> meeting(std::uint32_t index) const;

  void add(std::uint32_t index, const EdgeMeeting& meeting, std::span<const LitInterval> lit);

  const dvec3& towards() const { return look_.scattered; }

  /// What an edge that is added alone adds at the only frequency, each wave at its place (strip_groups.h); `parts` are those of
  /// the lit ones on which the current of a plate's edge face has one place. Nothing may be added after that.
  std::vector<ImageEdge> pieces(std::uint32_t index, const EdgeMeeting& meeting, std::span<const LitInterval> lit,
                                std::span<const LitInterval> parts, const PathPlace& place);

  /// The sum; nothing may be added after that.
  EdgeLookResult take();

 private:
  std::span<const Wedge> wedges_;
  const LookVectors& look_;
  std::span<const double> frequencies_;
  MultipleDiffraction multiple_;
  ThicknessPass thickness_;
  MaterialEdges materials_;
  EdgeLookResult result_;
};

/// Calls with(make), where make(look, frequencies) is a new sum over edges of the order asked for; returns what `with` does.
template <class With>
auto at_order(const EdgeScene& scene, const FringeOptions& options, With with) {
  if (options.order == 1)
    return with([&](const LookVectors& look, std::span<const double> frequencies) {
      return FirstOrderEdges(scene, look, frequencies);
    });
  return with([&](const LookVectors& look, std::span<const double> frequencies) {
    return StripEdges(scene, look, frequencies, options);
  });
}

}  // namespace raytube
