#include "case/directions/looks.h"

#include <fmt/format.h>

#include <cmath>

#include "case/directions/radar.h"
#include "case/directions/row_limit.h"
#include "case/text/users_words.h"
#include "case/text/values.h"
#include "core/error.h"

namespace raytube {

namespace {

constexpr double finest_step = 1e-12;  // [deg]: less is lost beside the 1 of a cosine

void check_angles(const CaseValue& value, const std::string& key, const std::vector<double>& angles) {
  if (value.kind == CaseValue::Kind::table && angles.size() > 1 && std::abs(angles[1] - angles[0]) < finest_step)
    reject(value, fmt::format("{} has steps of {:.3g}, finer than any direction; write at least {:g} degrees", key,
                              angles[1] - angles[0], finest_step));
  for (const double angle : angles)
    if (const std::string sentence = unresolved_angle(key, angle); !sentence.empty()) reject(value, sentence);
}

/// An angle by its own name, or by the one that users of azimuth and elevation give it.
struct AngleNames {
  std::string_view ours, other;
};
constexpr AngleNames polar_angle{"theta_deg", "elevation_deg"}, azimuth{"phi_deg", "azimuth_deg"};

std::vector<double> read_angles(const CaseValue& root, std::string_view section, const AngleNames& names,
                                std::vector<std::string>& warnings) {
  const auto key_of = [&](std::string_view name) { return fmt::format("{}.{}", section, name); };
  const CaseValue *ours = find(root, key_of(names.ours)), *other = find(root, key_of(names.other));
  if (ours && other)
    reject(*other, {ours},
           fmt::format("{} and {} both give the same angle; remove one of them", key_of(names.other), key_of(names.ours)));
  if (!ours && !other)
    throw InputError(fmt::format("{}: {} is missing; add {} (or {}) = a number, a list or {} under [{}]", root.location,
                                 key_of(names.ours), names.ours, names.other, range_forms, section));
  const CaseValue& value = ours ? *ours : *other;
  const std::string key = key_of(ours ? names.ours : names.other);
  std::vector<double> angles = read_values(value, key, warnings);
  check_angles(value, key, angles);
  if (key.ends_with(polar_angle.other))
    for (double& angle : angles) {
      if (std::abs(angle) > 90.0) reject(value, elevation_outside(key, angle));
      angle = theta_of_elevation(angle);
    }
  for (const double angle : angles)
    if (key.ends_with(polar_angle.ours) && (angle < 0.0 || angle > 180.0)) reject(value, theta_outside(key, angle));
  return angles;
}

std::vector<Direction> directions(const std::vector<double>& theta_deg, const std::vector<double>& phi_deg) {
  std::vector<Direction> all;
  all.reserve(theta_deg.size() * phi_deg.size());
  for (const double theta : theta_deg)
    for (const double phi : phi_deg) all.push_back({theta * degree, phi * degree});
  return all;
}

void fill_from_angles(const CaseValue& section, Case& c) {
  const LookChoice& choice = c.looks;
  const double transmit_count = static_cast<double>(choice.theta_deg.size()) * static_cast<double>(choice.phi_deg.size());
  const double receive_count = static_cast<double>(choice.rx_theta_deg.size()) * static_cast<double>(choice.rx_phi_deg.size());
  check_rows(section, c.sweep.bistatic ? transmit_count * receive_count : transmit_count, c.sweep.frequencies.size());
  const std::vector<Direction> receivers = directions(choice.rx_theta_deg, choice.rx_phi_deg);
  for (const Direction& transmit : directions(choice.theta_deg, choice.phi_deg)) {
    if (!c.sweep.bistatic) c.sweep.looks.push_back({transmit, transmit});
    for (const Direction& receive : receivers) c.sweep.looks.push_back({transmit, receive});
  }
}

void fill_from_list(const CaseValue& look, const CaseValue* receive, Case& c) {
  const CaseValue& name = *look.find("looks_csv");
  for (const std::string_view angle : {polar_angle.ours, azimuth.ours, polar_angle.other, azimuth.other})
    if (const CaseValue* value = look.find(angle))
      reject(name, {value}, fmt::format("look.looks_csv cannot be combined with look.{}; remove one or the other", angle));
  if (receive)
    reject(*receive, {&name},
           "[receive] cannot be combined with look.looks_csv; give the columns rx_theta_deg, rx_phi_deg in the list instead");
  c.looks.looks_csv = read_file_name(name, "look.looks_csv", "look list");
  c.sweep.looks = read_looks_csv(c.file.parent_path() / c.looks.looks_csv, c.sweep.bistatic);
  check_rows(look, static_cast<double>(c.sweep.looks.size()), c.sweep.frequencies.size());
}

}  // namespace

void read_looks(const CaseValue& root, Case& c) {
  const CaseValue* look = root.find("look");
  const CaseValue* receive = root.find("receive");
  if (has_positions(root)) return read_positions(root, c);
  if (!look)
    throw InputError(root.location +
                     ": no directions; add a [look] section with theta_deg and phi_deg (or elevation_deg and azimuth_deg)");
  if (look->find("looks_csv")) return fill_from_list(*look, receive, c);
  c.looks.theta_deg = read_angles(root, "look", polar_angle, c.warnings);
  c.looks.phi_deg = read_angles(root, "look", azimuth, c.warnings);
  c.sweep.bistatic = receive != nullptr;
  if (receive) {
    c.looks.rx_theta_deg = read_angles(root, "receive", polar_angle, c.warnings);
    c.looks.rx_phi_deg = read_angles(root, "receive", azimuth, c.warnings);
  }
  fill_from_angles(*look, c);
}

void fill_looks(const LookNumbers& numbers, const CaseValue& root, Case& c) {
  if (has_positions(root))
    throw InputError(root.location +
                     ": looks cannot be combined with radar.position_m, which says where the antenna stands; remove one");
  check_rows(root, static_cast<double>(numbers.rows.size()), c.sweep.frequencies.size());
  c.looks.given_as_numbers = true;
  c.sweep.bistatic = numbers.bistatic;
  c.sweep.looks = looks_of_numbers(numbers, root.location);
}

}  // namespace raytube
