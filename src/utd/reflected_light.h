// Pieces of edges that a plane wave lights after reflections.
#pragma once

#include <deque>
#include <vector>

#include "utd/edge_painter.h"

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
  /// a sequence of mirrors. An edge exactly on the border of a beam is lit on one of its sides: such pieces have the weight 1/2
  /// (both sides are tried, a hundred-thousandth of the wavelength off).
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
  bool alike(std::span<const LitPiece> a, std::span<const LitPiece> b) const;
  void find_pieces(const ReflectedWave& wave, const EdgeAxis& axis, double sideways);
  void snap_to_ends(const EdgeAxis& axis);
  void trace_back(const Sheet& sheet, const IgnoredPatches& ignored, std::span<const std::uint32_t> mirrors);
  void keep_clear(const Sheet& sheet, const IgnoredPatches& ignored);

  const FaceTree& tree_;
  const std::vector<bool>& large_;  // the mirrors
  std::span<const EdgeAxis> axes_;
  const PlaneWave& incident_;
  double wavelength_;
  SheetTracer tracer_;
  std::vector<Mirror> mirrors_;
  std::vector<LitPiece> pieces_;
};

}  // namespace raytube
