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
      {"frequencies without edge-face interaction", "no edge of a wavelength sees a face of a wavelength squared",
       counts.frequencies_without_large},
      {"edges without edge-face interaction", "shorter than a wavelength at the lowest frequency", counts.short_edges},
      {"faces without edge-face interaction", "smaller than a wavelength squared at the lowest frequency", counts.small_faces},
      {"pairs of edge and face", "too weak to matter", counts.weak_pairs},
      {"pairs of edge and face", "beyond edges.between_budget", counts.pairs_beyond_budget},
      {"pairs of edge and mirror", "beyond edges.between_budget", counts.reflections_beyond_budget},
      {"edges lit after a reflection, without fringe currents", "beyond edges.between_budget", counts.fringe_beyond_budget},
      {"looks without edge-face interaction", "edges.between_budget is 0", counts.unbudgeted_looks},
      {"looks without edge-face interaction", "edges.between_budget reaches less than half of what is expected",
       counts.unreached_looks},
      {"looks without edge-face interaction", "no lit edge faces another surface", counts.dark_interaction_looks},
      {"looks without edge-face interaction", "antennas too close for plane waves", counts.near_looks},
      {"looks without waves over curved surfaces", "too weak compared with the tubes for accuracy.tolerance_db",
       counts.weak_surface_looks},
      {"looks without waves over curved surfaces", "antennas at a finite distance", counts.near_surface_looks},
      {"looks without waves over curved surfaces", "edges of curved surfaces too long in wavelengths", counts.long_surface_looks},
      {"looks without edge-face interaction", "it is computed for perfect conductors only", counts.material_looks},
      {"edge passes", "no edge of the target can radiate", counts.edgeless_looks},
      {"edge passes", "no edge is lit", counts.unlit_looks}};
  std::erase_if(items, [](const Skipped& item) { return item.count == 0; });
  return items;
}

}  // namespace raytube
