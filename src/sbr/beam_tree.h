// All beams of a tile: tubes that met the same patches in the same order share one beam and one footprint.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "sbr/footprint.h"

namespace raytube {

class BeamTree {
 public:
  static constexpr std::uint32_t root = 0;

  BeamTree(const TriangleMesh& mesh, const SphericalBasis& receive, const Beam& incident) : mesh_(mesh), receive_(receive) {
    nodes_.push_back({{incident, {}}, no_index, no_index});
  }

  /// The footprint of beam `parent` on `patch`, computed on first use, with the anchor then given.
  std::uint32_t child(std::uint32_t parent, std::uint32_t patch, const dvec2& anchor);

  const Footprint& footprint(std::uint32_t node) const { return nodes_[node].footprint; }
  const Beam& beam(std::uint32_t node) const { return nodes_[node].footprint.outgoing; }

 private:
  struct Node {
    Footprint footprint;
    std::uint32_t recent_patch, recent_child;  // neighbouring tubes mostly ask for the same child
  };

  const TriangleMesh& mesh_;
  const SphericalBasis& receive_;
  std::vector<Node> nodes_;
  std::unordered_map<std::uint64_t, std::uint32_t> children_;
};

}  // namespace raytube
