// Pieces of edges that a plane wave lights after reflections.
#pragma once

#include <deque>
#include <vector>

#include "utd/interaction/edge_illumination.h"

namespace raytube {

/// A reflected wave and what it lights.
struct ReflectedWave {
  PlaneWave wave;
  std::vector<std::uint32_t> patches;  // the mirrors, in the order in which the light meets them
  std::vector<EdgeLight> lights;
};

/// The wave after a reflection by the plane of a patch.
PlaneWave reflected(const PlaneWave& wave, const Patch& plane);

/// Follows the light of an incident wave back from edges over planar patches.
class ReflectedLight {
 public:
  ReflectedLight(const FaceTree& tree, const std::vector<bool>& large, std::span<const EdgeAxis> axes, const PlaneWave& incident,
                 double wavelength)
      : tree_(tree), large_(large), axes_(axes), incident_(incident), wavelength_(wavelength), tracer_(tree) {}

  /// The waves that light any edge after one up to `most` reflections; no further ones than there are 20 000 pairs of an edge and
  /// a sequence of mirrors. Light does not end at the border of a beam: within a twenty-fifth of the edge's length to either
  /// side of it the weight of a piece goes smoothly from 1 to 0, so that no look makes it jump; it is 1/2 on the border itself.
  std::deque<ReflectedWave> waves(int most);

 private:
  struct LitPiece {
    double from, to, weight = 1.0;
  };
  struct Mirror {
    std::uint32_t patch;
    bool closed;
  };

  void find_mirrors();
  void light(ReflectedWave& wave);
  std::vector<LitPiece> blended(const ReflectedWave& wave, const EdgeAxis& axis, std::span<const LitPiece> over,
                                std::span<const LitPiece> under);
  double share_of_light(const ReflectedWave& wave, const EdgeAxis& axis, double place, double lit);
  RayFan fan_beside(const ReflectedWave& wave, const EdgeAxis& axis, double sideways) const;
  bool reaches(const ReflectedWave& wave, const EdgeAxis& axis, double place, double sideways);
  void find_pieces(const ReflectedWave& wave, const EdgeAxis& axis, double sideways);
  void snap_to_ends(const EdgeAxis& axis);
  void trace_back(const RayFan& fan, const IgnoredPatches& ignored, std::span<const std::uint32_t> mirrors);
  void keep_clear(const RayFan& fan, const IgnoredPatches& ignored);

  const FaceTree& tree_;
  const std::vector<bool>& large_;  // the mirrors
  std::span<const EdgeAxis> axes_;
  const PlaneWave& incident_;
  double wavelength_;
  RayFanTracer tracer_;
  std::vector<Mirror> mirrors_;
  std::vector<LitPiece> pieces_;
};

}  // namespace raytube
