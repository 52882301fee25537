#include "case/target.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "case/text/keys.h"
#include "core/error.h"
#include "core/text.h"

namespace raytube {

namespace {

using Part = MaterialAssignment::Part;

/// What the names in a mesh say about its polygons.
class NamedMaterials {
 public:
  NamedMaterials(const PolygonSoup& soup, const Case& c) : soup_(soup), case_(c) {
    std::unordered_map<std::string_view, const Part*> parts;
    for (const Part& part : c.assignment.parts) parts.emplace(part.name, &part);
    for (const std::string& name : soup.names.all()) {
      const auto found = parts.find(name);
      part_of_name_.push_back(found == parts.end() ? nullptr : found->second);
    }
    for (const Part& part : c.assignment.parts)
      if (std::ranges::find(part_of_name_, &part) == part_of_name_.end()) reject_unknown(part);
  }

  const std::string& material_of(std::size_t polygon) const {
    const Part *inside = nullptr, *file = nullptr;
    for (const std::uint32_t name : soup_.names.of(polygon))
      if (const Part* part = part_of_name_[name]) {
        const Part*& known = is_file(part->name) ? file : inside;
        if (known && known->material != part->material) reject_two(polygon, *known, *part);
        known = part;
      }
    return inside ? inside->material : file ? file->material : case_.assignment.elsewhere;
  }

 private:
  bool is_file(const std::string& name) const { return std::ranges::find(case_.meshes, name) != case_.meshes.end(); }

  [[noreturn]] void reject_unknown(const Part& part) const {
    const std::vector<std::string>& names = soup_.names.all();
    const std::string meant = name_meant(part.name, names);
    // The mesh that had the name may have gone.
    if (is_override(case_.mesh_location) && !is_override(part.location))
      throw InputError(
          fmt::format("{}: this mesh has no part \"{}\", to which {} gives a material in target.parts; to do "
                      "without these parts add --set 'target.parts={{}}', or {}",
                      case_.mesh_location, quotable(part.name), part.location, meant));
    const std::string where = fmt::format("{}: target.parts.{} is not a name in the mesh", part.location, quotable(part.name));
    throw InputError(fmt::format("{}; {}", where, meant));
  }

  [[noreturn]] static void reject_two(std::size_t polygon, const Part& first, const Part& second) {
    throw InputError(
        fmt::format("{}: facet {} of the mesh goes by the names \"{}\" and \"{}\", which have the materials \"{}\" and \"{}\" in "
                    "target.parts; remove one of them there",
                    is_override(first.location) ? first.location : second.location, polygon, quotable(first.name),
                    quotable(second.name), quotable(first.material), quotable(second.material)));
  }

  const PolygonSoup& soup_;
  const Case& case_;
  std::vector<const Part*> part_of_name_;  // null: the case does not mention it
};

std::unordered_map<std::string_view, std::uint32_t> numbers_of(const std::vector<Material>& materials) {
  std::unordered_map<std::string_view, std::uint32_t> numbers;
  for (std::size_t i = 0; i < materials.size(); ++i) numbers.emplace(materials[i].name, static_cast<std::uint32_t>(i));
  return numbers;
}

void check_last_facet(const Case& c, std::size_t polygons) {
  for (const auto& [first, last, material, location] : c.assignment.facets) {
    if (last < polygons) continue;
    if (is_override(c.mesh_location) && !is_override(location))
      throw InputError(
          fmt::format("{}: this mesh has {} facets, counted from 0, but target.facets.{} names facet {} ({}); add --set "
                      "'target.facets={{}}', or choose among its own facets there",
                      c.mesh_location, polygons, quotable(material), last, location));
    throw InputError(fmt::format("{}: target.facets.{} names facet {}, but the mesh has {}, counted from 0; choose among these",
                                 location, quotable(material), last, polygons));
  }
}

double ground_in_units(const Case& c) { return c.ground->height / c.metres_per_unit; }

constexpr double rounding_of_files = 1e-6;  // of the target's height: single precision, and some

// Names take memory, and are of use to parts alone.
PolygonSoup read_named(const Case& c, std::size_t file, bool named) {
  PolygonSoup soup = read_polygon_soup(c.mesh_files[file], c.metres_per_unit);
  if (c.meshes.size() > 1)
    for (std::string& remark : soup.remarks) remark = fmt::format("{}: {}", c.meshes[file], remark);
  if (!c.assignment.parts.empty() || ((named || c.motion) && c.meshes.size() > 1)) add_name(soup, c.meshes[file]);
  return soup;
}

}  // namespace

std::string mesh_names(const Case& c) {
  std::vector<std::string> names;
  for (const std::filesystem::path& file : c.mesh_files) names.push_back(file.string());
  return joined(names, ", ");
}

void assign_materials(PolygonSoup& soup, const Case& c) {
  const NamedMaterials by_name(soup, c);
  const auto numbers = numbers_of(c.sweep.materials);
  const auto number_of = [&](const std::string& material) {
    const auto found = numbers.find(material);
    return found == numbers.end() ? no_index : found->second;
  };
  soup.materials.resize(soup.polygons.size());
  for (std::size_t i = 0; i < soup.polygons.size(); ++i) soup.materials[i] = number_of(by_name.material_of(i));
  check_last_facet(c, soup.polygons.size());
  for (const auto& [first, last, material, location] : c.assignment.facets)
    std::fill(soup.materials.begin() + first, soup.materials.begin() + last + 1, number_of(material));
  if (numbers.empty()) soup.materials.clear();
}

// What touches the ground but for the rounding of files lies on it, so that it is one with its mirror image.
void stand_on_ground(PolygonSoup& soup, const Case& c) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const std::vector<std::uint32_t>& polygon : soup.polygons)
    for (const std::uint32_t corner : polygon)
      low = std::min(low, soup.points[corner].z), high = std::max(high, soup.points[corner].z);
  const double ground = ground_in_units(c), close = rounding_of_files * std::max(high - low, std::abs(ground));
  if (low < ground - close)
    throw InputError(
        fmt::format("{}: the target reaches down to z = {:.6g} m, below the ground at {:.6g} m; lower "
                    "ground.height_m, or cut the mesh there",
                    c.file.string(), low * c.metres_per_unit, c.ground->height));
  for (dvec3& point : soup.points)
    if (std::abs(point.z - ground) <= close) point.z = ground;
}

void add_mirror_image(PolygonSoup& soup, const Case& c) {
  if (!c.ground) return;
  stand_on_ground(soup, c);
  if (!c.ground->perfect()) return;
  PolygonSoup image = soup;
  for (dvec3& point : image.points) point.z = 2.0 * ground_in_units(c) - point.z;
  for (std::vector<std::uint32_t>& polygon : image.polygons) std::ranges::reverse(polygon);
  image.free_forms = 0, image.further_files.clear(), image.remarks.clear();
  add_polygons(image, soup);
}

PolygonSoup read_target(const Case& c, bool named) {
  PolygonSoup whole = read_named(c, 0, named);
  for (std::size_t i = 1; i < c.meshes.size(); ++i) add_polygons(read_named(c, i, named), whole);
  assign_materials(whole, c);
  return whole;
}

LoadedMesh build_target(PolygonSoup soup, const Case& c, const std::string& name, bool named) {
  add_mirror_image(soup, c);
  if (named) number_parts(soup);
  return build_mesh(std::move(soup), c.metres_per_unit, name, c.sweep.materials);
}

LoadedMesh load_target(const Case& c, bool named) { return build_target(read_target(c, named), c, mesh_names(c), named); }

}  // namespace raytube
