// Which pairs of a lit piece of an edge and a face come first where there are more than a look may take.
#pragma once

#include <cstdint>
#include <vector>

#include "utd/interaction/pair_bound.h"

namespace raytube {

/// What one lit piece of an edge illuminates.
struct IlluminationJob {
  const LitEdgePiece* piece;
  int reflections;  // after the edge
};

struct EdgeFacePair {
  std::uint32_t job, patch;
  PairBound bound;
};

/// Pairs left out: how many, and the sum of the squares of what is expected of them [m^2].
struct LeftOut {
  std::uint64_t count = 0;
  double squares = 0.0;

  void add(const EdgeFacePair& pair) { ++count, squares += pair.bound.expected * pair.bound.expected; }
};

struct PairChoice {
  std::vector<EdgeFacePair> strongest;  // strongest first; of pairs as strong, in the order of jobs and patches
  LeftOut weak, beyond;
  double work = 0.0;  // counted (utd/wedge/work.h)
};

/// What may be chosen from.
struct PairLimits {
  PairView view;
  double tolerance;  // pairs whose bounds add up to less than this are too weak to matter [m]
  double work;       // that finding the bounds may take
};

/// Pairs that are kept at a time.
inline constexpr std::size_t most_pairs_kept = 16384;

/// Bounds of all pairs of a job and one of `patches`, the large ones from the largest on. Where there are too many for the work
/// allowed it is the longest pieces and the largest patches that are looked at, and of the others it is taken that their bounds
/// go with length and area. Keeps `most_pairs_kept`.
PairChoice choose_pairs(std::span<const IlluminationJob> jobs, const TriangleMesh& mesh, std::span<const PatchExtent> extents,
                        std::span<const std::uint32_t> patches, const PairLimits& limits);

}  // namespace raytube
