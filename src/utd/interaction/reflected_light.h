// Pieces of edges that a plane wave lights after reflections.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "utd/interaction/pair_plan.h"

namespace raytube {

/// So many pairs of an edge and a sequence of mirrors are looked at in one generation of reflections: a tenth of a second.
inline constexpr std::size_t most_reflected_pairs = 20000;

/// A reflected wave and what it lights.
struct ReflectedWave {
  PlaneWave wave;
  std::vector<std::uint32_t> patches;  // the mirrors, in the order in which the light meets them
  std::vector<LitEdgePiece> lit;
};

/// The wave after a reflection by the plane of a patch.
PlaneWave reflected(const PlaneWave& wave, const Patch& plane);

/// Follows the light of an incident wave back from edges over planar patches. Keeps references to what it is made with.
class ReflectedLight {
 public:
  /// `wavelength` [m] is the shortest of the look; the large ones among the faces are the mirrors. Axes shorter than
  /// `shortest_axis` [m] do not count, and mirrors light the edges that the plan has pairs of with them.
  ReflectedLight(const ReceivingFaces& faces, std::span<const EdgeAxis> axes, const PlaneWave& incident, double wavelength,
                 double shortest_axis = 0.0, const PairPlan& plan = all_pairs);

  /// The waves that light any edge after 1 to `most` reflections. Where one reflection more would make more than 20 000 pairs of
  /// an edge and a sequence of mirrors, the shorter sequences are all. Light does not end at the border of a beam: within a
  /// twenty-fifth of the edge's length to either side of it the weight of a piece goes smoothly from 1 to 0, so that it jumps in
  /// no look; it is 1/2 on the border itself.
  std::deque<ReflectedWave> waves(int most);

  /// Counted so far (utd/wedge/work.h).
  double work() const { return tracer_.work(); }
  /// Pairs of an edge and a sequence of mirrors that waves() did not look at.
  std::uint64_t pairs_left_out() const { return pairs_left_out_; }

 private:
  struct LitPiece {
    double from, to, weight = 1.0;
  };
  struct Mirror {
    std::uint32_t patch;
    bool closed;
  };

  void find_mirrors();
  bool counts(const EdgeAxis& axis) const;
  std::size_t index_of(const EdgeAxis& axis) const { return static_cast<std::size_t>(&axis - axes_.data()); }
  void find_lit(ReflectedWave& wave);
  std::vector<LitPiece> blended(const ReflectedWave& wave, const EdgeAxis& axis, std::span<const LitPiece> over,
                                std::span<const LitPiece> under);
  double share_of_light(const ReflectedWave& wave, const EdgeAxis& axis, double position, double lit);
  RayFan fan_beside(const ReflectedWave& wave, const EdgeAxis& axis, double sideways) const;
  bool reaches(const ReflectedWave& wave, const EdgeAxis& axis, double position, double sideways);
  void find_pieces(const ReflectedWave& wave, const EdgeAxis& axis, double sideways);
  void snap_to_ends(const EdgeAxis& axis);
  void trace_back(const RayFan& fan, const IgnoredPatches& ignored, std::span<const std::uint32_t> mirrors);
  void keep_clear(const RayFan& fan, const IgnoredPatches& ignored);

  const FaceTree& tree_;
  const std::vector<bool>& large_;  // the mirrors
  std::span<const EdgeAxis> axes_;
  const PlaneWave& incident_;
  double wavelength_, shortest_axis_;
  const PairPlan& plan_;
  RayFanTracer tracer_;
  std::uint64_t pairs_left_out_ = 0;
  std::vector<Mirror> mirrors_;
  std::vector<LitPiece> pieces_;
};

}  // namespace raytube
