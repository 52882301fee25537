#include "point_source/source_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "case/text/document.h"
#include "case/text/keys.h"
#include "case/text/values.h"
#include "core/error.h"
#include "core/text.h"

namespace raytube {

namespace {

using Kind = CaseValue::Kind;

constexpr std::array<std::string_view, 14> source_case_keys = {
    "title",          "scene.box_m",   "scene.parts.name", "scene.parts.mesh", "scene.parts.unit", "scene.parts.surface",
    "source.point_m", "source.models", "source.rays",      "source.seed",      "source.wall",      "source.max_reflections",
    "source.counted", "output.plots"};
constexpr std::array<std::string_view, 11> run_sections = {"target", "look",     "frequency", "materials", "tubes", "accuracy",
                                                           "edges",  "surfaces", "receive",   "radar",     "ground"};
constexpr std::array<std::string_view, 6> wall_names = {"-x", "+x", "-y", "+y", "-z", "+z"};
constexpr std::array<std::string_view, 2> surface_names = {"pec", "absorber"};
constexpr double most_rays = 1e8, most_seed = 9007199254740992.0;  // 2^53: whole numbers of a case file are doubles

const CaseValue& require_of_part(const CaseValue& part, std::string_view key, std::string_view remedy) {
  const CaseValue* value = part.find(key);
  if (!value) reject(part, fmt::format("scene.parts.{} is missing; add {} to this part", key, remedy));
  return *value;
}

// Names become columns of a table and words of a picture.
std::string read_part_name(const CaseValue& value) {
  std::string name = read_text(value, "scene.parts.name");
  const auto fits = [](unsigned char c) { return c > ' ' && c != ',' && c != '"' && c != 127; };
  if (name.empty() || !std::ranges::all_of(name, fits))
    reject(value, "scene.parts.name must be a word without blanks, commas and quotes, for example \"screen\"");
  return name;
}

ScenePart read_part(const CaseValue& table, const std::filesystem::path& folder) {
  ScenePart part;
  part.name = read_part_name(require_of_part(table, "name", "name = \"screen\""));
  const CaseValue& mesh = require_of_part(table, "mesh", "mesh = \"file.off\"");
  const std::string file = read_file_name(mesh, "scene.parts.mesh", "mesh");
  part.mesh_file = (folder / file).lexically_normal();
  part.metres_per_unit = read_unit(
      require_of_part(table, "unit", "unit = \"m\" (or cm, mm, um, in, ft: the length of one mesh unit)"), "scene.parts.unit");
  const CaseValue& surface = require_of_part(table, "surface", "surface = \"pec\" or \"absorber\"");
  part.surface = read_word(surface, "scene.parts.surface", surface_names) == 0 ? RaySurface::pec : RaySurface::absorber;
  return part;
}

void read_parts(const CaseValue& root, SourceCase& c) {
  const CaseValue* list = find(root, "scene.parts");
  if (!list || list->items.empty())
    throw InputError(root.location + ": no scene; add a [[scene.parts]] with name, mesh, unit and surface for every part");
  for (const CaseValue& table : list->items) {
    c.parts.push_back(read_part(table, c.file.parent_path()));
    const auto same = [&](const ScenePart& part) { return part.name == c.parts.back().name; };
    if (std::ranges::count_if(c.parts, same) > 1)
      reject(table,
             fmt::format("scene.parts.name \"{}\" is given twice; give every part its own", quotable(c.parts.back().name)));
  }
}

void read_box(const CaseValue& value, SourceCase& c) {
  if (value.kind != Kind::list || value.items.size() != 2)
    reject(value, "scene.box_m must be a list of two corners [m], for example [[-1, -1, 0], [1, 1, 2]]");
  c.box = Box{read_vector(value.items[0], "a corner of scene.box_m"), read_vector(value.items[1], "a corner of scene.box_m")};
  if (!(glm::length(c.box->low) < farthest && glm::length(c.box->high) < farthest))
    reject(value, fmt::format("scene.box_m must reach no farther than {:g} m from the origin", farthest));
  if (!glm::all(glm::lessThan(c.box->low, c.box->high)))
    reject(value, "scene.box_m must have its lower corner first, each coordinate less than the second one's");
}

void read_points(const CaseValue& root, SourceCase& c) {
  const CaseValue& value = require(root, "source.point_m", "point_m = [x, y, z] or a list of these");
  c.points = read_vectors(value, "source.point_m");
}

// One word or a list of them.
std::vector<const CaseValue*> entries(const CaseValue& value, const std::string& key) {
  std::vector<const CaseValue*> all;
  if (value.kind != Kind::list) return {&value};
  if (value.items.empty()) reject(value, key + " is an empty list; give at least one");
  for (const CaseValue& item : value.items) all.push_back(&item);
  return all;
}

void read_models(const CaseValue* value, SourceCase& c) {
  if (!value) {
    for (std::size_t i = 0; i < launch_model_names.size(); ++i) c.models.push_back(static_cast<LaunchModel>(i));
    return;
  }
  for (const CaseValue* item : entries(*value, "source.models")) {
    c.models.push_back(static_cast<LaunchModel>(read_word(*item, "source.models", launch_model_names)));
    if (std::ranges::count(c.models, c.models.back()) > 1)
      reject(*item, fmt::format("source.models names \"{}\" twice; name it once", launch_model_name(c.models.back())));
  }
}

void read_rays(const CaseValue& value, SourceCase& c) {
  for (const CaseValue* item : entries(value, "source.rays"))
    c.rays.push_back(static_cast<std::uint64_t>(read_whole(*item, "source.rays", {1, most_rays})));
  std::ranges::sort(c.rays);
  if (std::ranges::adjacent_find(c.rays) != c.rays.end()) reject(value, "source.rays gives a number twice; give it once");
}

void read_seed(const CaseValue& value, SourceCase& c) {
  const double seed = read_number(value, "source.seed");
  if (seed < 0.0 || seed > most_seed || seed != std::floor(seed))
    reject(value, fmt::format("source.seed must be a whole number from 0 to 2^53 (found {})", seed));
  c.seed = static_cast<std::uint64_t>(seed);
}

void read_counted(const CaseValue& root, SourceCase& c) {
  const CaseValue& value = require(root, "source.counted", "counted = the name of the part whose hits are shown");
  const std::string name = read_text(value, "source.counted");
  const auto found = std::ranges::find(c.parts, name, &ScenePart::name);
  std::vector<std::string> names;
  for (const ScenePart& part : c.parts) names.push_back(part.name);
  if (found == c.parts.end())
    reject(value,
           fmt::format("source.counted \"{}\" is not a part of the scene; write {}", quotable(name), joined(names, " or ")));
  c.counted = found - c.parts.begin();
}

}  // namespace

SourceCase read_source_case(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  const CaseValue root = read_case_document(file, overrides);
  check_keys(root, {source_case_keys, run_sections, "run", "scene.parts"});
  SourceCase c;
  c.file = file;
  read_parts(root, c);
  if (const CaseValue* box = find(root, "scene.box_m")) read_box(*box, c);
  read_points(root, c);
  read_models(find(root, "source.models"), c);
  read_rays(require(root, "source.rays", "rays = a number or a list, for example [2000, 10000]"), c);
  if (const CaseValue* seed = find(root, "source.seed")) read_seed(*seed, c);
  if (const CaseValue* wall = find(root, "source.wall")) c.wall = static_cast<int>(read_word(*wall, "source.wall", wall_names));
  if (const CaseValue* most = find(root, "source.max_reflections"))
    c.max_reflections = read_whole(*most, "source.max_reflections", {0, 1000});
  read_counted(root, c);
  if (const CaseValue* plots = find(root, "output.plots")) c.plots = read_flag(*plots, "output.plots");
  const CaseValue* title = root.find("title");
  c.title = title ? read_text(*title, "title") : file.stem().string();
  return c;
}

std::vector<std::pair<std::string, std::filesystem::path>> input_files(const SourceCase& c) {
  std::vector<std::pair<std::string, std::filesystem::path>> files = {{"the case", c.file}};
  for (const ScenePart& part : c.parts) files.emplace_back("scene.parts.mesh", part.mesh_file);
  return files;
}

}  // namespace raytube
