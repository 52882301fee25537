#include "case/text/keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <utility>

#include "core/text.h"

namespace raytube {

namespace {

// Of [materials.NAME]. The first ones say what a layer is.
constexpr std::array<std::string_view, 12> material_keys = {
    "thickness_mm", "eps_r", "mu_r",   "loss_tangent",   "conductivity_s_per_m", "table_csv",
    "medium",       "kind",  "layers", "resistance_ohm", "conductance_s",        "roughness_rms_mm"};
constexpr std::span<const std::string_view> layer_keys = std::span(material_keys).first(7);

// Of [motion.bodies.NAME].
constexpr std::array<std::string_view, 10> body_keys = {"parts",       "on",        "velocity_m_per_s", "axis",  "through_m",
                                                        "rev_per_min", "deg_per_s", "angle_deg",        "poses", "poses_csv"};

bool contains(std::span<const std::string_view> keys, std::string_view key) { return std::ranges::find(keys, key) != keys.end(); }

bool is_above(std::string_view key, std::span<const std::string_view> names) {
  return std::ranges::any_of(names, [&](std::string_view known) { return known.starts_with(std::string(key) + '.'); });
}

// Insertions, deletions, substitutions and exchanges of neighbours that turn `a` into `b` (optimal string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1), above(b.size() + 1), before;
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    before = std::exchange(above, row);
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      row[j + 1] = std::min({above[j] + (a[i] == b[j] ? 0 : 1), row[j] + 1, above[j + 1] + 1});
      if (i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j]) row[j + 1] = std::min(row[j + 1], before[j - 1] + 1);
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

std::string_view section_of(std::string_view key) { return key.substr(0, key.find('.')); }

// The keys of a section, or of none of that name the sections that there are.
std::string choice_beside(std::string_view key, std::span<const std::string_view> known) {
  std::vector<std::string_view> keys, sections;
  for (const std::string_view name : known) {
    if (section_of(name) == section_of(key)) keys.push_back(name);
    if (!contains(sections, section_of(name))) sections.push_back(section_of(name));
  }
  return joined(keys.empty() ? sections : keys, ", ");
}

// Asks whether the nearest key was meant; a key that ends in another unit, such as range_mm for range_m, is no slip of the pen.
std::string nearest_text(std::string_view key, std::string_view nearest) {
  constexpr std::array<std::string_view, 15> units = {"m",   "mm",  "cm",  "um", "km", "in", "ft", "deg",
                                                      "rad", "ghz", "mhz", "hz", "s",  "ms", "us"};
  const auto end_of = [](std::string_view name) { return name.rfind('_') + 1; };
  const auto has_unit = [&](std::string_view name) { return end_of(name) > 0 && contains(units, name.substr(end_of(name))); };
  const bool other_unit = has_unit(key) && has_unit(nearest) && key.substr(0, end_of(key)) == nearest.substr(0, end_of(nearest));
  return fmt::format("did you mean \"{}\"{}?", nearest, other_unit ? ", which has another unit" : "");
}

std::string remedy_for_key(std::string_view key, const KnownKeys& known) {
  if (const std::string_view remedy = known.remedy_for_word ? known.remedy_for_word(key) : ""; !remedy.empty())
    return std::string(remedy);
  if (const std::string_view nearest = nearest_key(key, known.names); !nearest.empty()) return nearest_text(key, nearest);
  return "choose among " + choice_beside(key, known.names);
}

// A key inside an unknown section shows better than the section which one was meant.
[[noreturn]] void reject_unknown(const CaseValue& value, const std::string& key, const KnownKeys& known) {
  if (contains(known.foreign_sections, key))
    reject(value, fmt::format("[{}] belongs to a case for raytube {}; run it with that command", key, known.foreign_command));
  if (contains(known.names, "materials") && edit_distance(key, "materials") <= 2)
    reject(value, fmt::format("unknown section \"{}\"; did you mean \"materials\"?", quotable(key)));
  const bool holds_key = key.find('.') == std::string::npos && value.kind == CaseValue::Kind::table && !value.keys.empty();
  const std::string meant = holds_key ? key + "." + value.keys.front() : key;
  reject(value, fmt::format("unknown key \"{}\"; {}", quotable(meant), remedy_for_key(meant, known)));
}

void check_table(const CaseValue& table, const std::string& prefix, const KnownKeys& known) {
  for (std::size_t i = 0; i < table.keys.size(); ++i) {
    const std::string key = prefix + table.keys[i];
    const CaseValue& value = table.items[i];
    if (contains(known.names, key)) continue;
    if (!is_above(key, known.names)) reject_unknown(value, key, known);
    const bool in_list = key == known.listed_section;
    if (value.kind != (in_list ? CaseValue::Kind::list : CaseValue::Kind::table))
      reject(value, in_list ? fmt::format("{0} must be a list; write [[{0}]] before each entry", key)
                            : fmt::format("{0} must be a section; write [{0}]", key));
    for (const CaseValue& item : in_list ? std::span(value.items) : std::span(&value, 1)) {
      if (item.kind != CaseValue::Kind::table)
        reject(item, fmt::format("every entry of {0} must be a section; write [[{0}]]", key));
      check_table(item, key + '.', known);
    }
  }
}

void check_keys_among(const CaseValue& table, std::span<const std::string_view> known, const std::string& path) {
  for (std::size_t i = 0; i < table.keys.size(); ++i)
    if (const std::string& key = table.keys[i]; !contains(known, key)) {
      const std::string_view nearest = nearest_key(key, known);
      reject(table.items[i], fmt::format("unknown key \"{}.{}\"; {}", path, quotable(key),
                                         nearest.empty() ? "choose among " + joined(known, ", ")
                                                         : nearest_text(path + '.' + key, fmt::format("{}.{}", path, nearest))));
    }
}

void check_body(const CaseValue& body, const std::string& path) {
  if (body.kind != CaseValue::Kind::table) reject(body, fmt::format("{0} must be a section; write [{0}]", path));
  check_keys_among(body, body_keys, path);
}

void check_material(const CaseValue& material, const std::string& path) {
  if (material.kind != CaseValue::Kind::table) reject(material, fmt::format("{0} must be a section; write [{0}]", path));
  check_keys_among(material, material_keys, path);
  const CaseValue* layers = material.find("layers");
  for (std::size_t i = 0; layers && i < layers->items.size(); ++i)
    check_keys_among(layers->items[i], layer_keys, fmt::format("{}.layers[{}]", path, i));
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
  constexpr std::size_t most = 16;
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

void check_keys(const CaseValue& root, const KnownKeys& known) { check_table(root, "", known); }

void check_material_keys(const CaseValue& materials) {
  if (materials.kind != CaseValue::Kind::table)
    reject(materials, "materials must be a section; write [materials.NAME] for each material");
  for (std::size_t i = 0; i < materials.keys.size(); ++i)
    check_material(materials.items[i], "materials." + quotable(materials.keys[i]));
}

void check_body_keys(const CaseValue& bodies) {
  if (bodies.kind != CaseValue::Kind::table)
    reject(bodies, "motion.bodies must be a section; write [motion.bodies.NAME] for each body");
  for (std::size_t i = 0; i < bodies.keys.size(); ++i) check_body(bodies.items[i], "motion.bodies." + quotable(bodies.keys[i]));
}

}  // namespace raytube
