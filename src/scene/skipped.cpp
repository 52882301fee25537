#include "scene/skipped.h"

namespace raytube {

std::vector<Skipped> skipped_items(const SkipCounts& counts) {
  std::vector<Skipped> items = {
      {"looks", "the same as earlier ones", counts.repeated_looks},
      {"looks", "mirror images of earlier ones: the target is its own image", counts.mirrored_looks},
      {"tubes", "empty cells of the grid", counts.empty_cells},
      {"faces in a look", "turned away from the transmitter", counts.faces_away},
      {"reflected tubes", nothing_in_front, counts.reflected_tubes},
      {"wedges", "inside a closed body", counts.enclosed_wedges},
      {"frequencies without waves between surfaces", "too many edges and faces of a wavelength and more",
       counts.frequencies_above_interaction_limit},
      {"looks without waves between surfaces", "antennas too near for plane waves", counts.near_looks},
      {"looks without waves between surfaces", "they know perfect conductors only", counts.material_looks},
      {"edge passes", "no edge of the target can radiate", counts.edgeless_looks},
      {"edge passes", "no edge is lit", counts.unlit_looks}};
  std::erase_if(items, [](const Skipped& item) { return item.count == 0; });
  return items;
}

}  // namespace raytube
