// All keys of a case file. Those that hold one number, word or flag are read, repeated in the resolved case, checked and
// looked for on the page about case keys by this list alone: a new one is an entry here, or in scene/keys/option_keys.h if it
// sets an option of the solver.
#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

#include "case/data/case.h"
#include "scene/keys/option_keys.h"

namespace raytube {

/// Keys whose values have a shape of their own, and a reader; with blanks between them.
inline constexpr std::string_view shaped_keys =
    "title target.mesh target.unit target.material target.parts target.facets materials frequency.ghz look.theta_deg "
    "look.phi_deg look.azimuth_deg look.elevation_deg look.looks_csv receive.theta_deg receive.phi_deg "
    "receive.azimuth_deg receive.elevation_deg radar.range_m radar.receive_range_m radar.position_m "
    "radar.receive_position_m radar.aim_m radar.receive_aim_m radar.turntable_deg radar.transmit_power_dbm "
    "radar.gain_dbi radar.beamwidth_deg radar.pattern_csv ground.height_m ground.material "
    "motion.pulses motion.times_s motion.reference_s motion.retrace motion.bodies "
    "motion.radar.velocity_m_per_s motion.radar.track_csv motion.radar.aim_moves";

/// visit(key, member) for every other key; a Case or a const one.
template <class C, class Visit>
void visit_case_keys(C& c, Visit&& visit) {
  visit_tube_keys(c.tubes, visit);
  visit_edge_keys(c.edges, c.wedges, !c.sweep.materials.empty(), visit);
  visit_surface_keys(c.surfaces, visit);
  visit(CaseKey{"output.plots"}, c.plots);
  visit(CaseKey{"output.netcdf"}, c.netcdf);
  visit(CaseKey{.name = "output.incoherent", .shown = c.incoherent}, c.incoherent);
  visit(CaseKey{.name = "output.power_dbm", .shown = c.power}, c.power);
  visit(CaseKey{.name = "output.image_look", .by_default = "none", .shown = !c.image_looks.empty()}, c.image_looks);
  visit(CaseKey{.name = "output.image_per_wavelength", .limits = a_density, .shown = !c.image_looks.empty()},
        c.image_per_wavelength);
}

/// Their names, or those of all keys.
inline std::vector<std::string_view> shaped_key_names() {
  std::vector<std::string_view> names;
  for (std::size_t at = 0, end = 0; at < shaped_keys.size(); at = end + 1) {
    end = std::min(shaped_keys.find(' ', at), shaped_keys.size());
    names.push_back(shaped_keys.substr(at, end - at));
  }
  return names;
}
inline std::vector<std::string_view> case_key_names() {
  std::vector<std::string_view> names = shaped_key_names();
  visit_case_keys(static_cast<const Case&>(Case()), [&](const CaseKey& key, const auto&) { names.push_back(key.name); });
  return names;
}

}  // namespace raytube
