#include "case/read_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "case/data/names.h"
#include "case/directions/looks.h"
#include "case/directions/radar.h"
#include "case/ground.h"
#include "case/materials/materials.h"
#include "case/text/document.h"
#include "case/text/keys.h"
#include "case/text/values.h"
#include "core/decimal.h"
#include "core/error.h"
#include "core/field.h"
#include "core/text.h"

namespace raytube {

namespace {

void read_mesh(const CaseValue& value, const std::string& key, Case& c) {
  c.meshes.push_back(read_file_name(value, key, "mesh"));
  c.mesh_files.push_back((c.file.parent_path() / c.meshes.back()).lexically_normal());
}

void read_meshes(const CaseValue& value, Case& c) {
  c.mesh_location = value.location;
  if (value.kind != CaseValue::Kind::list) return read_mesh(value, "target.mesh", c);
  if (value.items.empty()) reject(value, "target.mesh is an empty list; give at least one mesh file");
  for (std::size_t i = 0; i < value.items.size(); ++i)
    read_mesh(value.items[i], fmt::format("entry {} of target.mesh", i + 1), c);
}

void read_target(const CaseValue& root, Case& c) {
  read_meshes(require(root, "target", "mesh", "mesh = \"file.stl\""), c);
  const CaseValue& unit = require(root, "target", "unit", "unit = \"mm\" (or m, cm, um, in, ft: the length of one mesh unit)");
  c.unit = read_text(unit, "target.unit");
  c.metres_per_unit = read_unit(unit, "target.unit");
}

// Radio waves begin at some kilohertz. Waves of 300 km see no target at all, those of 0.3 nm no surface but atoms.
constexpr double lowest_ghz = 1e-6, highest_ghz = 1e9;

void check_frequency(const CaseValue& value, double ghz) {
  if (!(ghz > 0.0)) reject(value, fmt::format("frequency.ghz must be greater than 0 (found {})", ghz));
  if (ghz < lowest_ghz)
    reject(value,
           fmt::format("frequency.ghz is too small (found {}): below {:g} (1 kHz) there are no radar waves; give gigahertz", ghz,
                       lowest_ghz));
  if (ghz > highest_ghz)
    reject(value, fmt::format("frequency.ghz is too large (found {}): above {:g} waves are shorter than atoms; give gigahertz",
                              ghz, highest_ghz));
}

// Radars end at some hundred gigahertz: 9400 is more likely megahertz, as other programs have it.
constexpr double highest_radar_ghz = 1000.0;

void read_frequencies(const CaseValue& root, Case& c) {
  const CaseValue& value = require(root, "frequency", "ghz", std::string("ghz = a number, a list or ") + range_forms);
  for (const double ghz : read_values(value, "frequency.ghz", c.warnings)) {
    check_frequency(value, ghz);
    c.sweep.frequencies.push_back(rounded_to_15_digits(ghz * 1e9));
  }
  if (const double ghz = std::ranges::max(c.sweep.frequencies) / 1e9; ghz > highest_radar_ghz)
    c.warnings.push_back(
        fmt::format("{}: frequency.ghz goes up to {} GHz, a wavelength of {:.3g} mm; if megahertz were meant, write {}",
                    value.location, number_text(ghz), speed_of_light / (ghz * 1e6), number_text(ghz / 1e3)));
}

dvec3 read_up(const CaseValue& value) {
  const std::string key = "tubes.up";
  const dvec3 vector = read_vector(value, key);
  const double size = glm::length(vector);
  if (!(size > 0.0) || !std::isfinite(size)) reject(value, key + " must not be the zero vector; write for example [0, 0, 1]");
  return vector;
}

CurvedSurfaces read_curved(const CaseValue& value) {
  const std::string text = read_text(value, "tubes.curved");
  for (const CurvedName& known : curved_names)
    if (known.name == text) return known.where;
  reject(value, fmt::format("tubes.curved \"{}\" is unknown; write \"convex\", \"always\" or \"never\"", quotable(text)));
}

double read_share(const CaseValue& value, const std::string& key) {
  const double share = read_number(value, key);
  if (share < 0.0 || share > 1.0) reject(value, fmt::format("{} must be from 0 to 1 (found {})", key, share));
  return share;
}

// Whoever asks for a tolerance gets it, unless a share of the model uncertainty is asked for as well.
void read_accuracy(const CaseValue& root, const CaseValue* mode, const CaseValue* clip, Case& c) {
  const CaseValue *tolerance = find(root, "accuracy", "tolerance_db"), *share = find(root, "accuracy", "model_share");
  for (const auto& [value, key] : {std::pair{tolerance, "tolerance_db"}, {share, "model_share"}})
    if (value && !c.tubes.refines())
      reject(*value, {mode, clip},
             fmt::format("accuracy.{} needs adaptive tubes with clip; the others have the density given, so remove it", key));
  if (tolerance) c.tubes.tolerance_db = read_positive(*tolerance, "accuracy.tolerance_db");
  if (tolerance) c.tubes.model_share = 0.0;
  if (share) c.tubes.model_share = read_share(*share, "accuracy.model_share");
}

void read_tubes(const CaseValue& root, Case& c) {
  const CaseValue *mode = find(root, "tubes", "mode"), *clip = find(root, "tubes", "clip");
  if (mode) {
    const std::string name = read_text(*mode, "tubes.mode");
    if (name != "uniform" && name != "adaptive")
      reject(*mode, fmt::format("tubes.mode \"{}\" is unknown; write \"uniform\" or \"adaptive\"", quotable(name)));
    c.tubes.mode = name == "adaptive" ? TubeMode::adaptive : TubeMode::uniform;
  }
  if (const CaseValue* bounces = find(root, "tubes", "max_bounces"))
    c.tubes.max_bounces = read_whole(*bounces, "tubes.max_bounces", 1, 1000);
  if (clip) {
    if (c.tubes.mode == TubeMode::uniform)
      reject(*clip, {mode}, "tubes.clip needs tubes.mode = \"adaptive\"; a uniform grid is never clipped, so remove it");
    c.tubes.clip = read_flag(*clip, "tubes.clip");
  }
  const bool clipped = c.tubes.refines();
  if (const CaseValue* density = find(root, "tubes", "per_wavelength"))
    (clipped ? c.tubes.max_per_wavelength : c.tubes.per_wavelength) = read_density(*density, "tubes.per_wavelength");
  if (const CaseValue* curved = find(root, "tubes", "curved")) {
    if (!clipped)
      reject(*curved, {mode, clip}, "tubes.curved needs adaptive tubes with clip; the others see facets, so remove it");
    c.tubes.curved = read_curved(*curved);
  }
  read_accuracy(root, mode, clip, c);
  if (const CaseValue* skip = find(root, "tubes", "skip")) c.tubes.skip = read_flag(*skip, "tubes.skip");
  if (const CaseValue* up = find(root, "tubes", "up")) c.tubes.up = read_up(*up);
}

TransitionTier read_transition(const CaseValue& value) {
  const std::string text = read_text(value, "edges.transition");
  for (const TransitionName& known : transition_names)
    if (known.name == text) return known.tier;
  reject(value, fmt::format("edges.transition \"{}\" is unknown; write \"exact\", \"kouyoumjian-pathak\" or \"as-printed\"",
                            quotable(text)));
}

EdgeMethod read_method(const CaseValue& value) {
  const std::string text = read_text(value, "edges.method");
  for (const EdgeMethodName& known : edge_method_names)
    if (known.name == text) return known.method;
  reject(value, fmt::format("edges.method \"{}\" is not in this version; write \"fringe\", \"none\" or \"utd\"", quotable(text)));
}

MaterialEdgeMethod read_material_edges(const CaseValue& value, const CaseValue* method, const Case& c) {
  const std::string text = read_text(value, "edges.materials");
  if (text == "none") return MaterialEdgeMethod::none;
  if (text != "fringe")
    reject(value, fmt::format("edges.materials \"{}\" is unknown; write \"none\" or \"fringe\"", quotable(text)));
  if (c.sweep.materials.empty())
    reject(value,
           "edges.materials says what edges of other materials do, but all of the target is a perfect conductor; remove it");
  if (c.edges.method != EdgeMethod::fringe) reject(value, {method}, "edges.materials needs edges.method = \"fringe\"; remove it");
  return MaterialEdgeMethod::fringe;
}

std::vector<WrittenKey> written_keys(const CaseValue* section) {
  std::vector<WrittenKey> keys;
  for (std::size_t i = 0; section && i < section->keys.size(); ++i) {
    const std::string& location = section->items[i].location;
    keys.push_back({section->keys[i], location, is_override(location)});
  }
  return keys;
}

Use read_use(const CaseValue& value, const std::string& key) {
  if (value.kind == CaseValue::Kind::boolean) return value.boolean;
  if (value.kind == CaseValue::Kind::text && value.text == "auto") return {};
  reject(value, key + " must be true, false or \"auto\" (in looks where it can change the answer)");
}

void read_edges(const CaseValue& root, Case& c) {
  c.edge_keys = written_keys(root.find("edges"));
  const CaseValue* method = find(root, "edges", "method");
  if (method) c.edges.method = read_method(*method);
  if (const CaseValue* range = find(root, "edges", "utd_range_m")) {
    if (c.edges.method != EdgeMethod::utd)
      reject(*range, {method}, "edges.utd_range_m needs edges.method = \"utd\"; currents radiate to infinity, so remove it");
    c.edges.utd_range = read_between(*range, "edges.utd_range_m", 0.0, farthest);
  }
  if (const CaseValue* order = find(root, "edges", "order")) c.edges.order = read_whole(*order, "edges.order", 1, 3);
  if (const CaseValue* between = find(root, "edges", "between")) c.edges.interaction = read_use(*between, "edges.between");
  if (const CaseValue* budget = find(root, "edges", "between_budget")) {
    c.edges.interaction_budget = read_number(*budget, "edges.between_budget");
    if (!(c.edges.interaction_budget >= 0.0))
      reject(*budget, "edges.between_budget is negative; write how many times the other work of a look it may take, or 0");
  }
  if (const CaseValue* shadow = find(root, "edges", "receiver_shadow"))
    c.edges.receiver_shadow = read_flag(*shadow, "edges.receiver_shadow");
  if (const CaseValue* transition = find(root, "edges", "transition")) c.edges.transition = read_transition(*transition);
  if (const CaseValue* materials = find(root, "edges", "materials"))
    c.edges.materials = read_material_edges(*materials, method, c);
  if (const CaseValue* thin = find(root, "edges", "thin_sheets")) c.wedges.thin_plates = read_flag(*thin, "edges.thin_sheets");
  if (const CaseValue* angle = find(root, "edges", "min_wedge_deg")) {
    const double degrees = read_number(*angle, "edges.min_wedge_deg");
    if (degrees < 0.0 || degrees >= 180.0)
      reject(*angle, fmt::format("edges.min_wedge_deg must be at least 0 and less than 180 (found {})", degrees));
    c.wedges.min_wedge_angle = degrees * degree;
  }
}

void read_surfaces(const CaseValue& root, Case& c) {
  if (const CaseValue* waves = find(root, "surfaces", "waves")) c.surfaces.waves = read_use(*waves, "surfaces.waves");
}

std::size_t read_image_look(const CaseValue& value, const Case& c) {
  const double number = read_number(value, "output.image_look");
  if (number >= 0.0 && number < static_cast<double>(c.sweep.looks.size()) && number == std::floor(number))
    return static_cast<std::size_t>(number);
  reject(value, fmt::format("output.image_look {}: the case has {} direction pair(s), counted from 0; choose among these",
                            number_text(number), c.sweep.looks.size()));
}

void read_image_looks(const CaseValue& root, const CaseValue& value, Case& c) {
  const bool list = value.kind == CaseValue::Kind::list;
  if (!list && value.kind != CaseValue::Kind::number)
    reject(value, "output.image_look must be the number of a direction pair or a list of such, counted from 0");
  if (c.edges.method == EdgeMethod::utd)
    reject(value, {find(root, "edges", "method")},
           "output.image_look needs currents, but edges.method is \"utd\"; write \"fringe\" or \"none\" there");
  if (list && value.items.empty())
    reject(value, "output.image_look is an empty list; give at least one direction pair, or remove it");
  for (const CaseValue& item : list ? std::span(value.items) : std::span(&value, 1))
    c.image_looks.push_back(read_image_look(item, c));
  std::ranges::sort(c.image_looks);
  c.image_looks.erase(std::unique(c.image_looks.begin(), c.image_looks.end()), c.image_looks.end());
}

void read_output(const CaseValue& root, Case& c) {
  if (const CaseValue* plots = find(root, "output", "plots")) c.plots = read_flag(*plots, "output.plots");
  if (const CaseValue* netcdf = find(root, "output", "netcdf")) c.netcdf = read_flag(*netcdf, "output.netcdf");
  if (const CaseValue* incoherent = find(root, "output", "incoherent")) {
    c.incoherent = read_flag(*incoherent, "output.incoherent");
    if (c.incoherent && !any_rough(c.sweep.materials))
      reject(*incoherent,
             "output.incoherent: no surface is rough; give roughness_rms_mm to a material of the target, or remove it");
    if (c.incoherent && c.edges.method == EdgeMethod::utd)
      reject(*incoherent,
             "output.incoherent: the rays of edges.method \"utd\" do not add up what roughness scatters; remove one of them");
    if (c.incoherent && c.ground)
      reject(*incoherent, {root.find("ground")},
             "output.incoherent: what a rough surface scatters on the ways over the ground is alike in phase (enhanced "
             "backscattering), so "
             "that powers do not add up; remove [ground]");
  }
  if (const CaseValue* power = find(root, "output", "power_dbm")) {
    c.power = read_flag(*power, "output.power_dbm");
    if (c.power && !c.radar.link)
      reject(*power, "output.power_dbm needs radar.transmit_power_dbm and radar.gain_dbi; add them, or remove it");
  }
  if (const CaseValue* looks = find(root, "output", "image_look")) read_image_looks(root, *looks, c);
  if (const CaseValue* density = find(root, "output", "image_per_wavelength"))
    c.image_per_wavelength = read_density(*density, "output.image_per_wavelength");
}

std::string name_of_mesh(const std::filesystem::path& file) {
  return (lower_case(file.extension().string()) == ".gz" ? file.stem() : file).stem().string();
}

Case resolved(const CaseValue& root, const std::filesystem::path& file, const LookNumbers* looks) {
  check_case_keys(root);
  Case c;
  c.file = file;
  read_target(root, c);
  read_frequencies(root, c);
  read_materials(root, c);
  if (looks)
    fill_looks(*looks, root, c);
  else
    read_looks(root, c);
  read_tubes(root, c);
  read_edges(root, c);
  read_surfaces(root, c);
  read_radar(root, c);
  read_ground(root, c);
  read_output(root, c);
  const CaseValue* title = root.find("title");
  c.title = title ? read_text(*title, "title") : name_of_mesh(c.mesh_files.front());
  return c;
}

}  // namespace

Case read_case(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  return resolved(read_case_document(file, overrides), file, nullptr);
}

Case case_of_values(const CaseValue& root, const std::string& name, const LookNumbers* looks) {
  return resolved(root, name, looks);
}

std::vector<std::pair<std::string, std::filesystem::path>> input_files(const Case& c) {
  std::vector<std::pair<std::string, std::filesystem::path>> files = {{"the case", c.file}};
  for (const std::filesystem::path& mesh : c.mesh_files) files.emplace_back("target.mesh", mesh);
  for (const auto& [name, table] : medium_tables(c)) files.emplace_back("table_csv", table);
  const std::filesystem::path folder = c.file.parent_path();
  if (!c.looks.looks_csv.empty()) files.emplace_back("look.looks_csv", folder / c.looks.looks_csv);
  if (!c.radar.pattern_csv.empty()) files.emplace_back("radar.pattern_csv", folder / c.radar.pattern_csv);
  return files;
}

}  // namespace raytube
