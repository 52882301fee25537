#include "case/text/keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>

#include "case/text/users_words.h"
#include "core/text.h"

namespace raytube {

namespace {

constexpr std::array<std::string_view, 51> known_keys = {"title",
                                                         "target.mesh",
                                                         "target.unit",
                                                         "target.material",
                                                         "target.parts",
                                                         "target.facets",
                                                         "frequency.ghz",
                                                         "look.theta_deg",
                                                         "look.phi_deg",
                                                         "look.looks_csv",
                                                         "receive.theta_deg",
                                                         "receive.phi_deg",
                                                         "tubes.mode",
                                                         "tubes.per_wavelength",
                                                         "tubes.max_bounces",
                                                         "tubes.up",
                                                         "tubes.clip",
                                                         "tubes.curved",
                                                         "accuracy.tolerance_db",
                                                         "accuracy.model_share",
                                                         "tubes.skip",
                                                         "edges.method",
                                                         "edges.order",
                                                         "edges.between",
                                                         "edges.between_budget",
                                                         "edges.receiver_shadow",
                                                         "edges.transition",
                                                         "edges.materials",
                                                         "edges.thin_sheets",
                                                         "edges.utd_range_m",
                                                         "edges.min_wedge_deg",
                                                         "surfaces.waves",
                                                         "radar.range_m",
                                                         "radar.receive_range_m",
                                                         "radar.position_m",
                                                         "radar.receive_position_m",
                                                         "radar.aim_m",
                                                         "radar.receive_aim_m",
                                                         "radar.turntable_deg",
                                                         "radar.transmit_power_dbm",
                                                         "radar.gain_dbi",
                                                         "radar.beamwidth_deg",
                                                         "radar.pattern_csv",
                                                         "ground.height_m",
                                                         "ground.material",
                                                         "output.plots",
                                                         "output.netcdf",
                                                         "output.incoherent",
                                                         "output.power_dbm",
                                                         "output.image_look",
                                                         "output.image_per_wavelength"};

// Of [materials.NAME]. The first ones say what a layer is.
constexpr std::array<std::string_view, 12> material_keys = {
    "thickness_mm", "eps_r", "mu_r",   "loss_tangent",   "conductivity_s_per_m", "table_csv",
    "medium",       "kind",  "layers", "resistance_ohm", "conductance_s",        "roughness_rms_mm"};
constexpr std::span<const std::string_view> layer_keys = std::span(material_keys).first(7);

bool contains(std::span<const std::string_view> keys, std::string_view key) { return std::ranges::find(keys, key) != keys.end(); }

bool is_section(std::string_view key) {
  return std::any_of(known_keys.begin(), known_keys.end(), [&](std::string_view known) {
    return known.size() > key.size() && known.substr(0, key.size()) == key && known[key.size()] == '.';
  });
}

// Levenshtein: insertions, deletions and substitutions that turn `a` into `b`.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({substituted, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

std::string_view last_part(std::string_view key) { return key.substr(key.rfind('.') + 1); }

// A misspelt section, a misspelt key and a key under the wrong section should all find their way home.
std::size_t key_distance(std::string_view key, std::string_view known) {
  return std::min(edit_distance(key, known), 1 + edit_distance(last_part(key), last_part(known)));
}

// Farther away another word was meant: a third of the letters, so that a letter may be wrong in "unit", two in "order".
bool are_near(std::string_view name, std::string_view known) {
  return edit_distance(name, known) <= std::max<std::size_t>((name.size() + 1) / 3, 1);
}

// Also "theta" for theta_deg, "thickness" for thickness_mm: the name without its unit.
bool are_near_keys(std::string_view key, std::string_view known) {
  const std::string name = lower_case(last_part(key));
  return are_near(name, last_part(known)) || last_part(known).starts_with(name + "_");
}

std::string keys_of_section(std::string_view section) {
  std::vector<std::string_view> keys;
  for (const std::string_view known : known_keys)
    if (known.substr(0, known.find('.')) == section) keys.push_back(known);
  return joined(keys, ", ");
}

std::string sections() {
  std::vector<std::string_view> names = {"materials"};
  for (const std::string_view known : known_keys)
    if (const std::string_view section = known.substr(0, known.find('.')); !contains(names, section)) names.push_back(section);
  return joined(names, ", ");
}

std::string remedy_for_key(std::string_view key) {
  if (const std::string_view remedy = remedy_for_word(key); !remedy.empty()) return std::string(remedy);
  if (const std::string_view nearest = nearest_key(key, known_keys); !nearest.empty())
    return fmt::format("did you mean \"{}\"?", nearest);
  const std::string keys = keys_of_section(key.substr(0, key.find('.')));
  return "choose among " + (keys.empty() ? sections() : keys);
}

void check_key(const CaseValue& value, const std::string& key) {
  if (!contains(known_keys, key)) reject(value, fmt::format("unknown key \"{}\"; {}", quotable(key), remedy_for_key(key)));
}

// A key inside tells better than its misspelt section which one was meant.
void check_unknown_section(const CaseValue& value, const std::string& section) {
  if (section == "scene" || section == "source")
    reject(value, fmt::format("[{}] belongs to a case for raytube sources; run it with that command", section));
  if (edit_distance(section, "materials") <= 2)
    reject(value, fmt::format("unknown section \"{}\"; did you mean \"materials\"?", quotable(section)));
  const bool holds_key = value.kind == CaseValue::Kind::table && !value.keys.empty();
  check_key(value, holds_key ? section + "." + value.keys.front() : section);
}

void check_keys_among(const CaseValue& table, std::span<const std::string_view> known, const std::string& path) {
  for (std::size_t i = 0; i < table.keys.size(); ++i)
    if (const std::string& key = table.keys[i]; !contains(known, key)) {
      const std::string_view nearest = nearest_key(key, known);
      reject(table.items[i], fmt::format("unknown key \"{}.{}\"; {}", path, quotable(key),
                                         nearest.empty() ? "choose among " + joined(known, ", ")
                                                         : fmt::format("did you mean \"{}.{}\"?", path, nearest)));
    }
}

void check_material(const CaseValue& material, const std::string& path) {
  if (material.kind != CaseValue::Kind::table) reject(material, fmt::format("{0} must be a section; write [{0}]", path));
  check_keys_among(material, material_keys, path);
  const CaseValue* layers = material.find("layers");
  for (std::size_t i = 0; layers && i < layers->items.size(); ++i)
    check_keys_among(layers->items[i], layer_keys, fmt::format("{}.layers[{}]", path, i));
}

void check_materials(const CaseValue& materials) {
  if (materials.kind != CaseValue::Kind::table)
    reject(materials, "materials must be a section; write [materials.NAME] for each material");
  for (std::size_t i = 0; i < materials.keys.size(); ++i)
    check_material(materials.items[i], "materials." + quotable(materials.keys[i]));
}

}  // namespace

// Capitals tell apart only what nothing else does.
std::string_view nearest_name(std::string_view name, std::span<const std::string> known) {
  if (known.empty()) return {};
  const std::string lower = lower_case(name);
  const std::string_view nearest = *std::ranges::min_element(known, {}, [&](const std::string& other) {
    return std::pair(edit_distance(lower, lower_case(other)), edit_distance(name, other));
  });
  return are_near(lower, lower_case(nearest)) ? nearest : std::string_view();
}

std::string name_meant(std::string_view name, std::span<const std::string> known) {
  constexpr std::size_t most = 12;
  if (known.empty()) return "there are no names to choose among";
  if (const std::string_view nearest = nearest_name(name, known); !nearest.empty())
    return fmt::format("did you mean \"{}\"?", quotable(nearest));
  std::vector<std::string> names;
  for (const std::string& other : known.first(std::min(known.size(), most))) names.push_back(quotable(other));
  return fmt::format("choose among {}{}", joined(names, ", "), known.size() > most ? ", ..." : "");
}

std::string_view nearest_key(std::string_view key, std::span<const std::string_view> known) {
  std::vector<std::string_view> near;
  std::ranges::copy_if(known, std::back_inserter(near), [&](std::string_view other) { return are_near_keys(key, other); });
  const auto nearest = std::ranges::min_element(near, {}, [&](std::string_view other) { return key_distance(key, other); });
  return nearest == near.end() ? std::string_view() : *nearest;
}

void check_case_keys(const CaseValue& root) {
  for (std::size_t i = 0; i < root.keys.size(); ++i) {
    const std::string& section = root.keys[i];
    const CaseValue& value = root.items[i];
    if (section == "materials") {
      check_materials(value);
      continue;
    }
    if (!is_section(section)) {
      check_unknown_section(value, section);
      continue;
    }
    if (value.kind != CaseValue::Kind::table) reject(value, fmt::format("{0} must be a section; write [{0}]", section));
    for (std::size_t j = 0; j < value.keys.size(); ++j) check_key(value.items[j], section + "." + value.keys[j]);
  }
}

}  // namespace raytube
