// How far work reaches among pairs of edge and face, the strongest first, before any of them is looked at.
#pragma once

#include <vector>

namespace raytube {

/// What is expected of a pair is taken to go with length times area, as its bound does (docs/theory/interaction.md).
class PairReach {
 public:
  PairReach() = default;
  /// Lengths of the edges [m] and areas of the faces [m^2], in any order.
  PairReach(std::vector<double> lengths, std::vector<double> areas);

  /// The share of the sum of squares over all pairs that so many of the strongest have.
  double of(double pairs) const;
  /// How many of the strongest pairs have this share of it.
  double pairs(double share) const;

 private:
  std::vector<double> shares_;  // of 2^i pairs
  double all_ = 0.0;            // pairs
};

}  // namespace raytube
