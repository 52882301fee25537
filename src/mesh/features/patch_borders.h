// The vertices on the border of each patch.
#pragma once

#include <span>
#include <vector>

#include "mesh/model/triangle_mesh.h"

namespace raytube {

/// The vertices on the border of each patch.
class PatchBorders {
 public:
  /// Of a mesh that need not outlive it.
  explicit PatchBorders(const TriangleMesh& mesh);

  /// Each once, in ascending order; the patch's extent in any direction is theirs.
  std::span<const std::uint32_t> operator[](std::uint32_t patch) const {
    return {vertices_.data() + first_[patch], vertices_.data() + last_[patch]};
  }

 private:
  std::vector<std::uint32_t> vertices_;
  std::vector<std::uint32_t> first_, last_;  // of each patch, in vertices_: where its own begin, and end
};

}  // namespace raytube
