// How far the paths of a wave of strips spread: what decides how many wavenumbers have to be computed.
#pragma once

#include <initializer_list>
#include <span>
#include <vector>

#include "utd/multiple/wave_tree.h"
#include "utd/wedge/edge_currents.h"

namespace raytube {

/// Bounds of the exponents over k of what a wave radiates [m].
struct PathRange {
  double low, high;

  double middle() const { return 0.5 * (low + high); }
  double half() const { return 0.5 * (high - low); }
  void include(std::initializer_list<double> paths);
};

/// Finds the ranges of all waves of a tree. Keeps its buffers from one tree to the next.
class PathRanges {
 public:
  /// One for each wave of the tree; they last until the next call.
  std::span<const PathRange> find(const WaveTree& tree, const LookVectors& look);

 private:
  double start(const WaveTree& tree, const TreeWave& wave, const dvec3& difference, double arc_length) const;

  std::vector<PathRange> ranges_;
  std::vector<double> from_ends_, to_ends_;  // exponents over k where the strips from both sides of each bundle end [m]
};

}  // namespace raytube
