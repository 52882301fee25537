#include "scene/skipped.h"

namespace raytube {

SkipCounts& SkipCounts::operator+=(const SkipCounts& other) {
  for (const auto count : {&SkipCounts::repeated_looks, &SkipCounts::mirrored_looks, &SkipCounts::empty_cells,
                           &SkipCounts::faces_away, &SkipCounts::reflected_tubes, &SkipCounts::enclosed_wedges,
                           &SkipCounts::weak_pairs, &SkipCounts::pairs_beyond_budget, &SkipCounts::reflections_beyond_budget,
                           &SkipCounts::fringe_beyond_budget, &SkipCounts::edgeless_looks, &SkipCounts::unlit_looks})
    this->*count += other.*count;
  return *this;
}

std::vector<Skipped> skipped_items(const SkipCounts& counts) {
  std::vector<Skipped> items = {
      {"looks", "the same as earlier ones", counts.repeated_looks},
      {"looks", "mirror images of earlier ones: the target is its own image", counts.mirrored_looks},
      {"tubes", "empty cells of the grid", counts.empty_cells},
      {"faces in a look", "turned away from the transmitter", counts.faces_away},
      {"reflected tubes", nothing_in_front, counts.reflected_tubes},
      {"wedges", "inside a closed body", counts.enclosed_wedges},
      {"pairs of edge and face", "too weak to matter", counts.weak_pairs},
      {"pairs of edge and face", "beyond edges.between_budget", counts.pairs_beyond_budget},
      {"pairs of edge and mirror", "beyond edges.between_budget", counts.reflections_beyond_budget},
      {"edges lit after a reflection, without fringe currents", "beyond edges.between_budget", counts.fringe_beyond_budget},
      {"looks without edge currents", "no edge of the target can radiate", counts.edgeless_looks},
      {"looks without edge currents", "no edge is lit", counts.unlit_looks}};
  std::erase_if(items, [](const Skipped& item) { return item.count == 0; });
  return items;
}

}  // namespace raytube
