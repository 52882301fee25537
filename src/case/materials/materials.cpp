#include "case/materials/materials.h"

#include <fmt/format.h>

#include <algorithm>

#include "case/materials/material_assignment.h"
#include "case/materials/medium.h"
#include "case/text/values.h"
#include "core/decimal.h"
#include "core/text.h"

namespace raytube {

namespace {

constexpr std::array<std::string_view, 6> kinds = {"pec", "absorber", "dielectric", "solid", "coated", "sheet"};
constexpr std::array<const char*, 6> medium_keys = {"eps_r",     "mu_r",  "loss_tangent", "conductivity_s_per_m",
                                                    "table_csv", "medium"};

constexpr Limits a_thickness{1e-7, farthest * 1e3};  // [mm]: the least is an atom
constexpr Limits a_roughness{0.0, 1e6};              // [mm]: no target is rough by more than a kilometre

/// A table of [materials], or a layer in it, and its dotted name.
struct Entry {
  const CaseValue& table;
  std::string path;

  const CaseValue* find(std::string_view key) const { return table.find(key); }
  std::string key(std::string_view name) const { return fmt::format("{}.{}", path, name); }
};

std::string read_kind(const Entry& entry) {
  const CaseValue* value = entry.find("kind");
  if (!value) reject(entry.table, fmt::format("{} is missing; write \"{}\"", entry.key("kind"), joined(kinds, "\", \"")));
  return std::string(kinds[read_word(*value, entry.key("kind"), kinds)]);
}

// The keys that only some kinds have.
void check_kind_has_keys(const Entry& entry, const std::string& kind) {
  const auto only = [&](std::string_view key, std::initializer_list<std::string_view> having) {
    if (const CaseValue* value = entry.find(key); value && std::ranges::find(having, kind) == having.end())
      reject(*value, {entry.find("kind")},
             fmt::format("{} does not belong to kind \"{}\"; remove it, or write kind = \"{}\"", entry.key(key), kind,
                         joined(having, "\" or \"")));
  };
  for (const char* key : medium_keys) only(key, {"dielectric", "solid", "coated", "sheet"});
  for (const char* key : {"thickness_mm", "layers"}) only(key, {"coated", "sheet"});
  for (const char* key : {"resistance_ohm", "conductance_s"}) only(key, {"sheet"});
  only("roughness_rms_mm", {"pec", "absorber", "dielectric", "coated", "sheet"});
}

LayerChoice read_layer(const Entry& entry) {
  const CaseValue* thickness = entry.find("thickness_mm");
  if (!thickness)
    reject(entry.table, {entry.find("kind")},
           entry.key("thickness_mm") + " is missing; add the thickness of the layer in millimetres");
  const double mm = read_in(*thickness, entry.key("thickness_mm"), a_thickness);
  return {mm, read_medium(entry.table, entry.path)};
}

std::vector<LayerChoice> read_layers(const CaseValue& value, const std::string& key) {
  if (value.kind != CaseValue::Kind::list || value.items.empty())
    reject(value, key + " must be a list of layers, for example [ { thickness_mm = 2, eps_r = 4 } ]");
  std::vector<LayerChoice> layers;
  for (const CaseValue& item : value.items) {
    const Entry layer{item, fmt::format("{}[{}]", key, layers.size())};
    if (item.kind != CaseValue::Kind::table)
      reject(item, layer.path + " must be a layer, for example { thickness_mm = 2, eps_r = 4 }");
    layers.push_back(read_layer(layer));
  }
  return layers;
}

// `first` says what the material is made of, so that none of `others` can.
void check_alone(const Entry& entry, std::string_view first, std::span<const char* const> others) {
  for (const char* key : others)
    if (const CaseValue* value = entry.find(key))
      reject(*value, {entry.find(first)},
             fmt::format("{} cannot be combined with {}; {}", entry.key(key), first,
                         first == "layers" ? "write it inside each layer" : "remove one of them"));
}

std::vector<LayerChoice> read_made_of(const Entry& entry, const std::string& kind) {
  constexpr std::array<const char*, 1> thickness = {"thickness_mm"}, layers = {"layers"};
  for (const char* thin : {"resistance_ohm", "conductance_s"})
    if (entry.find(thin))
      for (const std::span<const char* const> others : {std::span<const char* const>(thickness), {layers}, {medium_keys}})
        check_alone(entry, thin, others);
  if (entry.find("resistance_ohm") || entry.find("conductance_s")) return {};
  if (kind == "dielectric" || kind == "solid") return {{0.0, read_medium(entry.table, entry.path)}};
  const CaseValue* list = entry.find("layers");
  if (!list) return {read_layer(entry)};
  check_alone(entry, "layers", thickness);
  check_alone(entry, "layers", medium_keys);
  return read_layers(*list, entry.key("layers"));
}

MaterialChoice read_material(const Entry& entry, const std::string& name) {
  MaterialChoice material;
  material.name = name;
  material.kind = read_kind(entry);
  check_kind_has_keys(entry, material.kind);
  if (material.kind != "pec" && material.kind != "absorber") material.layers = read_made_of(entry, material.kind);
  if (const CaseValue* value = entry.find("resistance_ohm"))
    material.resistance = read_in(*value, entry.key("resistance_ohm"), at_least_zero);
  if (const CaseValue* value = entry.find("conductance_s"))
    material.conductance = read_in(*value, entry.key("conductance_s"), at_least_zero);
  if (const CaseValue* value = entry.find("roughness_rms_mm"))
    material.roughness_mm = read_in(*value, entry.key("roughness_rms_mm"), a_roughness);
  return material;
}

void read_definitions(const CaseValue& section, Case& c) {
  for (std::size_t i = 0; i < section.keys.size(); ++i) {
    const std::string& name = section.keys[i];
    const Entry entry{section.items[i], "materials." + quotable(name)};
    if (name.empty()) reject(entry.table, "a material has no name; write [materials.NAME]");
    if (std::ranges::find(own_materials, name) != own_materials.end())
      reject(entry.table, entry.path + " is defined already; choose another name");
    c.materials.push_back(read_material(entry, name));
  }
}

bool is_used(const MaterialAssignment& assignment, std::string_view name) {
  const auto names_it = [&](const auto& part) { return part.material == name; };
  return assignment.elsewhere == name || std::ranges::any_of(assignment.parts, names_it) ||
         std::ranges::any_of(assignment.facets, names_it);
}

MaterialKind kind_of(const MaterialChoice& choice) {
  if (choice.kind == "pec") return MaterialKind::conductor;
  if (choice.kind == "absorber") return MaterialKind::absorber;
  if (choice.kind == "dielectric") return MaterialKind::half_space;
  if (choice.kind == "solid") return MaterialKind::solid;
  if (choice.kind == "coated") return MaterialKind::coated;
  return choice.layers.empty() ? MaterialKind::thin_sheet : MaterialKind::sheet;
}

bool is_ground(const Case& c, std::string_view name) {
  return c.ground && c.ground->material && c.ground->material->name == name;
}

}  // namespace

Material material_of(const MaterialChoice& choice, const Case& c, const std::string& asked_at) {
  Material material;
  material.name = choice.name;
  material.kind = kind_of(choice);
  material.roughness = choice.roughness_mm / 1e3;
  if (choice.resistance) material.resistance = *choice.resistance;
  if (choice.conductance) material.conductance = *choice.conductance;
  if (!choice.layers.empty()) material.layers.resize(c.sweep.frequencies.size());
  for (const LayerChoice& layer : choice.layers) {
    const std::vector<Medium> media = media_at(layer.medium, c.file.parent_path(), c.sweep.frequencies, asked_at);
    for (std::size_t i = 0; i < media.size(); ++i) material.layers[i].push_back({media[i], layer.thickness_mm / 1e3});
  }
  return material;
}

void read_materials(const CaseValue& root, Case& c) {
  const CaseValue* section = root.find("materials");
  if (section) read_definitions(*section, c);
  std::vector<std::string> names(own_materials.begin(), own_materials.end());
  for (const MaterialChoice& choice : c.materials) names.push_back(choice.name);
  c.assignment = read_material_assignment(root, names);
  for (const MaterialChoice& choice : c.materials)
    if (is_used(c.assignment, choice.name) && !(choice.kind == "pec" && choice.roughness_mm == 0.0))
      c.sweep.materials.push_back(material_of(choice, c, find(root, "frequency.ghz")->location));
  if (!is_used(c.assignment, "absorber")) return;
  c.sweep.materials.emplace_back();  // which absorbs
  c.sweep.materials.back().name = "absorber";
}

std::vector<std::string> unused_materials(const Case& c) {
  std::vector<std::string> names;
  for (const MaterialChoice& material : c.materials)
    if (!is_used(c.assignment, material.name) && !is_ground(c, material.name)) names.push_back(material.name);
  return names;
}

std::vector<std::pair<std::string, std::filesystem::path>> medium_tables(const Case& c) {
  std::vector<std::pair<std::string, std::filesystem::path>> tables;
  for (const MaterialChoice& material : c.materials)
    for (const LayerChoice& layer : material.layers) {
      const std::pair table{layer.medium.table_csv, c.file.parent_path() / layer.medium.table_csv};
      const bool used = is_used(c.assignment, material.name) || is_ground(c, material.name);
      if (!table.first.empty() && used && std::ranges::find(tables, table) == tables.end()) tables.push_back(table);
    }
  return tables;
}

}  // namespace raytube
