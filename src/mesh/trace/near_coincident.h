// Near-coincident facets: triangles that lie on one another, cross, or come close.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "mesh/model/triangle_mesh.h"
#include "mesh/model/triangle_tree.h"

namespace raytube {

/// For each triangle, the triangles of other patches that come within a distance of it elsewhere than along a common edge or at a
/// common corner, or that open from there at a narrow angle and lie over one another: single precision cannot tell which of the
/// two a ray meets first, however far from all edges.
class NearCoincident {
 public:
  /// `tree` is the mesh's; `distance` in metres, `narrow` in radians. May list triangles that are a little further apart.
  NearCoincident(const TriangleMesh& mesh, const TriangleTree& tree, double distance, double narrow);

  /// The near-coincident triangles of one, in ascending order.
  std::span<const std::uint32_t> operator[](std::uint32_t triangle) const {
    return std::span(others_).subspan(first_[triangle], first_[triangle + 1] - first_[triangle]);
  }

  /// The patches of these, in ascending order.
  std::span<const std::uint32_t> patches(std::uint32_t triangle) const {
    return std::span(patches_).subspan(first_patch_[triangle], first_patch_[triangle + 1] - first_patch_[triangle]);
  }

 private:
  void find_patches(const TriangleMesh& mesh);

  std::vector<std::uint32_t> first_, first_patch_;
  std::vector<std::uint32_t> others_, patches_;
};

}  // namespace raytube
