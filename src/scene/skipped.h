// What a solve did without because it adds nothing or is known already, in numbers and in words.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/results.h"

namespace raytube {

struct SkipCounts {
  std::uint64_t repeated_looks = 0, mirrored_looks = 0;
  std::uint64_t empty_cells = 0;      // sum over looks: cells of the grid under which the target is not
  std::uint64_t faces_away = 0;       // sum over looks: faces of closed bodies turned away from the transmitter
  std::uint64_t reflected_tubes = 0;  // of a target no face of which has anything in front of it
  std::uint64_t enclosed_wedges = 0;  // inside a closed body
  std::uint64_t edgeless_looks = 0;   // no edge of the target can radiate
  std::uint64_t frequencies_above_interaction_limit = 0;  // with too many edges and surfaces for waves between them
  std::uint64_t near_looks = 0;                           // from a finite distance, for which there are no waves between surfaces
  std::uint64_t unlit_looks = 0;                          // no edge that radiates is lit
  std::uint64_t material_looks = 0;                       // without waves between surfaces for the sake of such materials
};

/// The items that are not zero.
std::vector<Skipped> skipped_items(const SkipCounts& counts);

inline constexpr const char* nothing_in_front = "nothing stands in front of any face of the target";

}  // namespace raytube
