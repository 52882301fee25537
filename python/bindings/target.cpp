#include "bindings/target.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "case/resolved_case.h"
#include "case/target.h"
#include "case/text/values.h"
#include "core/error.h"
#include "core/text.h"
#include "jobs/moving.h"
#include "output/files/sha256.h"

namespace raytube::python {

namespace {

constexpr std::size_t most_built = 4;
constexpr const char* name_of_arrays = "arrays";

std::vector<std::string> names_of(const std::vector<std::filesystem::path>& files) {
  std::vector<std::string> names;
  for (const std::filesystem::path& file : files) names.push_back(file.string());
  return names;
}

double metres_of_unit(const std::string& unit) {
  CaseValue value;
  value.kind = CaseValue::Kind::text;
  value.location = "Target";
  value.text = unit;
  return read_unit(value, "unit");
}

// All that the mesh made ready depends on.
std::string dependencies(const Case& c) {
  std::string text = fmt::format("{} {}", c.wedges.min_wedge_angle, c.wedges.thin_plates);
  if (c.motion) {
    for (const auto& [key, value] : numerical_keys(c)) text += key + '=' + value;
    for (const BodyMotion& body : c.motion->motion.bodies)
      for (const PoseSample& pose : body.poses)
        text += fmt::format(" {} {} {} {} {}", pose.time, pose.position.x, pose.position.y, pose.position.z,
                            fmt::join(pose.turn, " "));
    return text;
  }
  if (c.ground) text += fmt::format(" over {} {}", c.ground->height, c.ground->perfect());
  if (c.sweep.materials.empty() && c.assignment.parts.empty() && c.assignment.facets.empty()) return text;
  for (const auto& [key, value] : numerical_keys(c))
    if (key.starts_with("target.") || key.starts_with("materials.") || key.starts_with("frequency.")) text += key + '=' + value;
  return text;
}

}  // namespace

TargetSource::TargetSource(const std::vector<std::filesystem::path>& files, std::string unit) {
  if (files.empty()) throw InputError("Target: no file; name at least one");
  made_of_ = {"", std::move(unit), names_of(files), {}, {}};
  made_of_.name = joined(made_of_.meshes, ", ");
  for (const std::filesystem::path& file : files) {
    PolygonSoup part = read_polygon_soup(file, metres_of_unit(made_of_.unit));
    if (files.size() > 1) add_name(part, file.string());
    add_polygons(part, made_of_.soup);
    made_of_.sha256.push_back(sha256_of_file(file));
  }
  for (const std::filesystem::path& further : made_of_.soup.further_files) made_of_.sha256.push_back(sha256_of_file(further));
}

TargetSource::TargetSource(PolygonSoup soup, std::string unit)
    : made_of_{name_of_arrays, std::move(unit), {name_of_arrays}, std::move(soup), {}} {
  metres_of_unit(made_of_.unit);  // refuses now what no case could make use of
}

std::shared_ptr<const BuiltTarget> TargetSource::built_for(const Case& c) {
  const std::lock_guard lock(building_);
  const std::string key = dependencies(c);
  const auto found = std::ranges::find(built_, key, [](const auto& entry) { return entry.first; });
  if (found != built_.end()) return found->second;
  const auto& [name, unit, meshes, polygons, sha256] = made_of_;
  PolygonSoup soup = polygons;
  if (meshes.size() == 1 && !sha256.empty() && !c.assignment.parts.empty()) add_name(soup, meshes.front());  // as a case does
  assign_materials(soup, c);
  const auto moving = c.motion ? std::make_shared<const MovingTarget>(std::move(soup), c) : nullptr;
  LoadedMesh loaded = moving ? mesh_of_plan(c, *moving) : build_target(std::move(soup), c, name);
  auto built = std::make_shared<const BuiltTarget>(std::move(loaded.report), Target(std::move(loaded.mesh), c.wedges), moving);
  if (built_.size() == most_built) built_.erase(built_.begin());
  built_.emplace_back(key, built);
  return built;
}

PolygonSoup soup_of(std::vector<dvec3> vertices, std::vector<std::vector<std::uint32_t>> polygons,
                    const std::vector<std::string>& names) {
  PolygonSoup soup{std::move(vertices), std::move(polygons)};
  for (std::size_t i = 0; i < names.size(); ++i) soup.names.give(i, soup.names.list({names[i]}));
  return soup;
}

}  // namespace raytube::python
