// Which pairs of an edge and a face a budget pays for. Derived in docs/theory/interaction.md.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "utd/fan/azimuth_integral.h"
#include "utd/interaction/edge_illumination.h"

namespace raytube {

/// Where a patch is.
struct PatchExtent {
  dvec3 centroid{0.0};  // [m]
  double area = 0.0;    // [m^2]
  bool closed = false;  // part of a closed body, met from outside only
};

/// The extents of all patches of a mesh.
std::vector<PatchExtent> patch_extents(const TriangleMesh& mesh);

/// The edges and faces of a target, some of which are large enough to make pairs.
struct PairCandidates {
  std::span<const EdgeAxis> axes;
  double shortest_axis;  // the shortest axis that counts [m]
  const TriangleMesh& mesh;
  std::span<const PatchExtent> extents;    // [patch]
  std::span<const std::uint32_t> patches;  // that count
};

/// The pairs of an edge and a face that interact, in every look and at every frequency at which the same edges and faces count.
class PairPlan {
 public:
  /// All of them.
  PairPlan() = default;
  /// The strongest that `work` (utd/wedge/work.h) pays for in a look at one frequency. Of pairs as strong all count or none,
  /// whatever their order: all if these are not more than twice as many as are paid for. None where less than a thousandth of all
  /// is paid for: what is left out is then taken to fill a half space about every edge.
  PairPlan(const PairCandidates& of, double work);

  bool all() const { return all_; }
  /// Whether the edge with this index among the axes is of any pair, and of one with this patch.
  bool has(std::size_t axis) const { return all_ || !patches_[axis].empty(); }
  bool has(std::size_t axis, std::uint32_t patch) const;
  /// Those with an edge, ascending; empty if all are.
  std::span<const std::uint32_t> patches(std::size_t axis) const;
  /// Sum of the squares expected of the pairs with an edge, over the wavelength [m].
  double expected(std::size_t axis) const { return all_ ? 0.0 : expected_[axis]; }

  std::uint64_t pairs() const { return pairs_; }        // that were chosen; 0 if nothing limits them
  std::uint64_t left_out() const { return left_out_; }  // others whose edge sees the face
  double expected_of_left_out() const { return left_; }
  /// Share of the squares expected of all pairs that those chosen have.
  double reach() const { return all_ ? 1.0 : chosen_ > 0.0 ? chosen_ / (chosen_ + left_) : 0.0; }

 private:
  bool all_ = true;
  std::vector<std::vector<std::uint32_t>> patches_;  // [axis]
  std::vector<double> expected_;                     // [axis]
  std::uint64_t pairs_ = 0, left_out_ = 0;
  double chosen_ = 0.0, left_ = 0.0;
};

inline const PairPlan all_pairs{};

/// Expected |S_pq|^2 over the wavelength of the waves that an edge sends to a face, in the mean over all looks [m]; 0: the face
/// is not seen from the edge.
double expected_of_pair(const EdgeAxis& axis, const TriangleMesh& mesh, std::uint32_t patch, const PatchExtent& face);

/// Work of a pair at one frequency where so many patches count (utd/wedge/work.h): within a factor of ten on boxes.
double work_of_pair(std::size_t patches);

/// Bytes that the choice among so many pairs takes.
double bytes_of_pairs(double pairs, double work);

/// Between which azimuths about an edge a face lies.
AzimuthRange azimuths_of(const EdgeAxis& axis, const TriangleMesh& mesh, std::uint32_t patch, const PatchExtent& face);

}  // namespace raytube
