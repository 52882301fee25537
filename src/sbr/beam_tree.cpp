#include "sbr/beam_tree.h"

namespace raytube {

std::uint32_t BeamTree::child(std::uint32_t parent, std::uint32_t patch, const dvec2& anchor) {
  if (nodes_[parent].recent_patch == patch) return nodes_[parent].recent_child;
  const auto next = static_cast<std::uint32_t>(nodes_.size());
  const auto [entry, is_new] = children_.try_emplace(std::uint64_t{parent} << 32 | patch, next);
  if (is_new)
    nodes_.push_back({raytube::footprint(anchored(beam(parent), anchor), mesh_.patches[patch], receive_), no_index, no_index});
  nodes_[parent].recent_patch = patch;
  nodes_[parent].recent_child = entry->second;
  return entry->second;
}

}  // namespace raytube
