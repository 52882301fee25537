#include "case/materials/material_assignment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "case/materials/medium.h"
#include "case/text/keys.h"
#include "case/text/values.h"
#include "core/decimal.h"
#include "core/text.h"

namespace raytube {

namespace {

using Kind = CaseValue::Kind;
using Facets = MaterialAssignment::Facets;

constexpr double most_facets = 9007199254740992.0;  // 2^53: whole numbers of a case file are doubles

// A medium of the library makes a material only together with a kind.
void check_name(const CaseValue& value, const std::string& sentence, const std::string& name,
                const std::vector<std::string>& names) {
  if (std::ranges::find(names, name) != names.end()) return;
  const std::string medium = lower_case(nearest_name(name, names)) == lower_case(name) ? "" : medium_meant(name);
  if (medium.empty())
    reject(value, fmt::format("{} is no material; add [materials.{}], or {}", sentence, quotable(name), name_meant(name, names)));
  reject(value,
         fmt::format("{0} is a medium, not a material; add [materials.{1}] with a kind and medium = \"{1}\", and name that here",
                     sentence, medium));
}

std::string read_name(const CaseValue& value, const std::string& key, const std::vector<std::string>& names) {
  const std::string name = read_text(value, key);
  if (name.empty()) reject(value, key + " is empty; write \"pec\", \"absorber\" or the NAME of a [materials.NAME]");
  check_name(value, fmt::format("{} \"{}\"", key, quotable(name)), name, names);
  return name;
}

std::uint64_t read_facet(const CaseValue& value, const std::string& key) {
  const double number = read_number(value, "every facet of " + key);
  if (number < 0.0 || number > most_facets || number != std::floor(number))
    reject(value, fmt::format("every facet of {} must be a whole number, counted from 0 (found {})", key, number_text(number)));
  return static_cast<std::uint64_t>(number);
}

Facets read_facet_range(const CaseValue& value, const std::string& key, const std::string& material) {
  if (value.kind != Kind::list) return {read_facet(value, key), read_facet(value, key), material, value.location};
  if (value.items.size() != 2) reject(value, key + " has a range that is not [first, last]; write for example [10, 20]");
  const Facets range{read_facet(value.items[0], key), read_facet(value.items[1], key), material, value.location};
  if (range.first > range.last)
    reject(value, fmt::format("{0} has the range [{1}, {2}]; write [{2}, {1}]", key, range.first, range.last));
  return range;
}

bool before(const Facets& a, const Facets& b) { return std::tie(a.first, a.last) < std::tie(b.first, b.last); }

// Ranges that overlap or follow one another, made one.
std::vector<Facets> merged(std::vector<Facets> ranges) {
  std::ranges::sort(ranges, before);
  std::vector<Facets> result;
  for (Facets& range : ranges)
    if (!result.empty() && range.first <= result.back().last + 1)
      result.back().last = std::max(result.back().last, range.last);
    else
      result.push_back(std::move(range));
  return result;
}

std::vector<Facets> read_ranges(const CaseValue& value, const std::string& material) {
  const std::string key = "target.facets." + quotable(material);
  if (value.kind != Kind::list) reject(value, key + " must be a list of facets and ranges, for example [0, 1, [10, 20]]");
  if (value.items.empty()) reject(value, key + " is an empty list; give at least one facet, or remove it");
  std::vector<Facets> ranges;
  for (const CaseValue& item : value.items) ranges.push_back(read_facet_range(item, key, material));
  return merged(std::move(ranges));
}

// Those of one material lie apart, so two that overlap are neighbours.
void check_apart(const std::vector<Facets>& facets, const CaseValue& section) {
  const auto overlap = [](const Facets& a, const Facets& b) { return b.first <= a.last; };
  const auto found = std::ranges::adjacent_find(facets, overlap);
  if (found != facets.end())
    reject(*section.find(std::next(found)->material), {section.find(found->material)},
           fmt::format("target.facets gives facet {} both to \"{}\" and to \"{}\"; remove it from one of them",
                       std::next(found)->first, quotable(found->material), quotable(std::next(found)->material)));
}

std::vector<Facets> read_facets(const CaseValue& section, const std::vector<std::string>& names) {
  if (section.kind != Kind::table) reject(section, "target.facets must be a section; write [target.facets]");
  std::vector<Facets> facets;
  for (std::size_t i = 0; i < section.keys.size(); ++i) {
    const std::string& material = section.keys[i];
    check_name(section.items[i], "target.facets." + quotable(material), material, names);
    for (Facets& range : read_ranges(section.items[i], material)) facets.push_back(std::move(range));
  }
  std::ranges::sort(facets, before);
  check_apart(facets, section);
  return facets;
}

// A dot in a name without quotes reads as a section in a section.
[[noreturn]] void reject_dots(const std::string& first, const CaseValue& value) {
  std::string name = first;
  const CaseValue* inside = &value;
  for (; inside->kind == Kind::table && !inside->keys.empty(); inside = &inside->items.front())
    name += "." + inside->keys.front();
  const std::string key = fmt::format("parts.\"{}\"", quotable(name)),
                    material = inside->kind == Kind::text ? quotable(inside->text) : "MATERIAL";
  reject(value, "a name with dots needs quotes; write " + (is_override(value.location)
                                                               ? fmt::format("--set 'target.{}={}'", key, material)
                                                               : fmt::format("{} = \"{}\" under [target]", key, material)));
}

std::vector<MaterialAssignment::Part> read_parts(const CaseValue& section, const std::vector<std::string>& names) {
  if (section.kind != Kind::table) reject(section, "target.parts must be a section; write [target.parts]");
  std::vector<MaterialAssignment::Part> parts;
  for (std::size_t i = 0; i < section.keys.size(); ++i) {
    const CaseValue& value = section.items[i];
    if (section.keys[i].empty()) reject(value, "target.parts has a part without a name; give the name that the mesh has for it");
    if (value.kind == Kind::table) reject_dots(section.keys[i], value);
    parts.push_back({section.keys[i], read_name(value, "target.parts." + quotable(section.keys[i]), names), value.location});
  }
  return parts;
}

}  // namespace

MaterialAssignment read_material_assignment(const CaseValue& root, const std::vector<std::string>& names) {
  MaterialAssignment assignment;
  if (const CaseValue* material = find(root, "target.material"))
    assignment.elsewhere = read_name(*material, "target.material", names);
  if (const CaseValue* parts = find(root, "target.parts")) assignment.parts = read_parts(*parts, names);
  if (const CaseValue* facets = find(root, "target.facets")) assignment.facets = read_facets(*facets, names);
  return assignment;
}

}  // namespace raytube
