#include "solve/mechanisms/list.h"

#include "scene/bounce_names.h"

namespace raytube {

const std::vector<MechanismEntry>& mechanism_list() {
  static const std::vector<MechanismEntry> list{
      surface_waves_entry(),  rounded_edges_entry(), flat_tips_entry(), round_tips_entry(),    edge_currents_entry(),
      material_edges_entry(), plate_corners_entry(), thin_ends_entry(), solid_corners_entry(), interaction_entry()};
  return list;
}

std::vector<std::string> piece_names(const std::vector<MechanismEntry>& mechanisms) {
  std::vector<std::string> names(tube_pieces.begin(), tube_pieces.end());
  for (const MechanismEntry& mechanism : mechanisms) names.emplace_back(mechanism.name);
  return names;
}

}  // namespace raytube
