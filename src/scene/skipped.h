// What a solve did without because it adds nothing or is known already, in numbers and in words.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/results.h"

namespace raytube {

/// What the solver leaves out, counted by reason.
struct SkipCounts {
  std::uint64_t repeated_looks = 0, mirrored_looks = 0;  // known from an equal look, or from a mirror image
  std::uint64_t empty_cells = 0;                         // sum over looks: cells of the grid under which the target is not
  std::uint64_t faces_away = 0;                 // sum over looks: faces of closed bodies turned away from the transmitter
  std::uint64_t reflected_tubes = 0;            // of a target no face of which has anything in front of it
  std::uint64_t enclosed_wedges = 0;            // inside a closed body
  std::uint64_t edgeless_looks = 0;             // no edge of the target can radiate
  std::uint64_t frequencies_without_large = 0;  // no edge of a wavelength, or no face of a wavelength squared, to be lit
  std::uint64_t short_edges = 0;                // at the lowest frequency: they send no waves to other surfaces
  std::uint64_t small_faces = 0;                // at the lowest frequency: they receive none
  std::uint64_t weak_pairs = 0;                 // sum over looks: of an edge and a face, too weak together to matter
  std::uint64_t pairs_beyond_budget = 0;        // sum over looks
  std::uint64_t reflections_beyond_budget = 0;  // sum over looks: of an edge and a mirror by which light might reach it
  std::uint64_t fringe_beyond_budget = 0;       // sum over looks: pieces of edges lit after a reflection, without fringe currents
  std::uint64_t dark_interaction_looks = 0;     // no lit edge faces another surface
  std::uint64_t unreached_looks = 0;            // without waves between surfaces, of which the budget reaches too few
  std::uint64_t weak_surface_looks = 0;         // to which waves over curved surfaces would add too little
  std::uint64_t unbudgeted_looks = 0;           // without waves between surfaces, as edges.between_budget is 0
  std::uint64_t long_surface_looks = 0;         // curved surfaces with edges too long for waves over them
  std::uint64_t near_surface_looks = 0;         // from a finite distance, for which there are no waves over curved surfaces
  std::uint64_t near_looks = 0;                 // from a finite distance, for which there are no waves between surfaces
  std::uint64_t unlit_looks = 0;                // no edge that radiates is lit
  std::uint64_t material_looks = 0;             // without waves between surfaces for the sake of such materials
};

/// The items that are not zero.
std::vector<Skipped> skipped_items(const SkipCounts& counts);

/// The reason of a target that cannot light itself.
inline constexpr const char* nothing_in_front = "nothing stands in front of any face of the target";

}  // namespace raytube
