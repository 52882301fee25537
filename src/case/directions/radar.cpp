#include "case/directions/radar.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "case/directions/pattern_csv.h"
#include "case/directions/row_limit.h"
#include "case/text/values.h"
#include "core/error.h"

namespace raytube {

namespace {

constexpr Limits a_beamwidth{1e-6, 180.0};  // [deg]; the least is that of an antenna of 10^8 wavelengths

std::vector<dvec3> read_antenna_positions(const CaseValue& value, const std::string& key) {
  const std::vector<dvec3> positions = read_vectors(value, key);
  for (const dvec3& position : positions)
    if (!(glm::length(position) > 0.0 && glm::length(position) < farthest))
      reject(value,
             fmt::format("{} must not be the origin of the mesh's coordinates, nor farther than {:g} m from it", key, farthest));
  return positions;
}

void read_beamwidth(const CaseValue& value, Case& c) {
  const std::string key = "radar.beamwidth_deg";
  if (value.kind == CaseValue::Kind::list) {
    if (value.items.size() != 2) reject(value, key + " must be one angle, or [azimuth, elevation]");
    for (const CaseValue& item : value.items)
      c.radar.beamwidth_deg.push_back(read_in(item, "every entry of " + key, a_beamwidth));
  } else {
    c.radar.beamwidth_deg = {read_in(value, key, a_beamwidth)};
  }
  c.sweep.radar.pattern.azimuth_beamwidth = c.radar.beamwidth_deg.front() * degree;
  c.sweep.radar.pattern.elevation_beamwidth = c.radar.beamwidth_deg.back() * degree;
}

void set_ranges(const CaseValue& section, Case& c) {
  const CaseValue* range = section.find("range_m");
  const CaseValue* receive = section.find("receive_range_m");
  if (!range)
    throw InputError(section.location + ": radar.range_m is missing; give the distance from the mesh's origin in metres");
  c.radar.range_m = c.radar.receive_range_m = read_in(*range, "radar.range_m", a_range);
  if (receive && !c.sweep.bistatic)
    reject(*receive, "radar.receive_range_m needs a receiver of its own; add [receive], or remove it");
  if (receive) c.radar.receive_range_m = read_in(*receive, "radar.receive_range_m", a_range);
  for (Look& look : c.sweep.looks) {
    look.transmit_range = c.radar.range_m;
    look.receive_range = c.radar.receive_range_m;
  }
}

// The receiver must have its aim in front, on the side of the origin.
void read_receive_aim(const CaseValue& value, Case& c) {
  if (!c.sweep.bistatic)
    reject(value, "radar.receive_aim_m needs a receiver of its own; add [receive] or radar.receive_position_m, or remove it");
  const dvec3 aim = read_vector(value, "radar.receive_aim_m");
  for (const Look& look : c.sweep.looks)
    if (!(glm::dot(aim, spherical_basis(look.receive).radial) < look.receive_range))
      reject(value, "radar.receive_aim_m lies at a receiver, or behind one; give a point on the side of the target");
  c.sweep.radar.receive_aim = aim;
}

// Every look at every angle of the table, which turns fastest. Antennas go the other way round, as the target sees them.
void put_on_turntable(const CaseValue& value, Case& c) {
  c.radar.turntable_deg = read_values(value, "radar.turntable_deg", c.warnings);
  for (const double angle : c.radar.turntable_deg)
    if (const std::string sentence = unresolved_angle("radar.turntable_deg", angle); !sentence.empty()) reject(value, sentence);
  const std::vector<Look> standing = std::move(c.sweep.looks);
  check_rows(value, static_cast<double>(standing.size()) * static_cast<double>(c.radar.turntable_deg.size()),
             c.sweep.frequencies.size());
  c.sweep.looks.clear();
  for (const Look& look : standing)
    for (const double angle : c.radar.turntable_deg) {
      Look& turned = c.sweep.looks.emplace_back(look);
      turned.turn = angle * degree;
      turned.transmit.phi -= turned.turn, turned.receive.phi -= turned.turn;
    }
}

void read_link(const CaseValue& section, Case& c) {
  const CaseValue *power = section.find("transmit_power_dbm"), *gain = section.find("gain_dbi");
  if (!power && !gain) return;
  if (!power || !gain)
    reject(power ? *power : *gain, "radar.transmit_power_dbm and radar.gain_dbi go together; give both, or remove one");
  c.radar.link = LinkBudget{read_number(*power, "radar.transmit_power_dbm"), read_number(*gain, "radar.gain_dbi")};
}

}  // namespace

Look look_between(const dvec3& transmit, const dvec3& receive) {
  return {direction_of(transmit), direction_of(receive), glm::length(transmit), glm::length(receive)};
}

bool has_positions(const CaseValue& root) { return find(root, "radar.position_m") != nullptr; }

void read_positions(const CaseValue& root, Case& c) {
  const CaseValue& position = *find(root, "radar.position_m");
  for (const char* section : {"look", "receive"})
    if (const CaseValue* given = root.find(section))
      reject(
          *given, {&position},
          fmt::format("[{}] cannot be combined with radar.position_m, which says where the antenna stands; remove one", section));
  for (const char* key : {"range_m", "receive_range_m"})
    if (const CaseValue* given = find(root, fmt::format("radar.{}", key)))
      reject(*given, {&position}, fmt::format("radar.{} cannot be combined with radar.position_m; remove one of them", key));
  c.radar.positions = read_antenna_positions(position, "radar.position_m");
  if (const CaseValue* receive = find(root, "radar.receive_position_m"))
    c.radar.receive_positions = read_antenna_positions(*receive, "radar.receive_position_m");
  c.sweep.bistatic = !c.radar.receive_positions.empty();
  const double pairs = static_cast<double>(c.radar.positions.size()) *
                       static_cast<double>(c.sweep.bistatic ? c.radar.receive_positions.size() : 1);
  check_rows(position, pairs, c.sweep.frequencies.size());
  for (const dvec3& transmit : c.radar.positions) {
    if (!c.sweep.bistatic) c.sweep.looks.push_back(look_between(transmit, transmit));
    for (const dvec3& receive : c.radar.receive_positions) c.sweep.looks.push_back(look_between(transmit, receive));
  }
}

void read_radar(const CaseValue& root, Case& c) {
  const CaseValue* section = root.find("radar");
  if (!section) return;
  if (const CaseValue* receive = section->find("receive_position_m"); receive && !has_positions(root))
    reject(*receive, "radar.receive_position_m needs radar.position_m; with angles add [receive] instead");
  if (!has_positions(root)) set_ranges(*section, c);
  if (const CaseValue* aim = section->find("aim_m")) c.sweep.radar.aim = read_vector(*aim, "radar.aim_m");
  if (const CaseValue* aim = section->find("receive_aim_m")) read_receive_aim(*aim, c);
  if (const CaseValue* turntable = section->find("turntable_deg")) put_on_turntable(*turntable, c);
  read_link(*section, c);
  if (const CaseValue* width = section->find("beamwidth_deg")) read_beamwidth(*width, c);
  if (const CaseValue* pattern = section->find("pattern_csv")) {
    c.radar.pattern_csv = read_file_name(*pattern, "radar.pattern_csv", "antenna pattern");
    read_pattern_csv(c.file.parent_path() / c.radar.pattern_csv, c.sweep.radar.pattern);
  }
  if (c.edges.utd_range > 0.0)
    reject(*section, {find(root, "edges.utd_range_m")},
           "[radar] has the places of the antennas, edges.utd_range_m a range for them; remove one of the two");
}

}  // namespace raytube
