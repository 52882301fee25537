#include "case/read_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "case/data/case_keys.h"
#include "case/data/names.h"
#include "case/directions/looks.h"
#include "case/directions/radar.h"
#include "case/ground.h"
#include "case/materials/materials.h"
#include "case/motion.h"
#include "case/text/document.h"
#include "case/text/keys.h"
#include "case/text/users_words.h"
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
  read_meshes(require(root, "target.mesh", "mesh = \"file.stl\""), c);
  const CaseValue& unit = require(root, "target.unit", "unit = \"mm\" (or m, cm, um, in, ft: the length of one mesh unit)");
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

// Rows are told apart by their frequency.
void check_different(const CaseValue& value, std::vector<double> frequencies) {
  std::ranges::sort(frequencies);
  if (const auto twice = std::ranges::adjacent_find(frequencies); twice != frequencies.end())
    reject(value, fmt::format("frequency.ghz has {} twice; give each frequency once", number_text(*twice / 1e9)));
}

// Radars end at some hundred gigahertz: 9400 is more likely megahertz, as other programs have it.
constexpr double highest_radar_ghz = 1000.0;

void read_frequencies(const CaseValue& root, Case& c) {
  const CaseValue& value = require(root, "frequency.ghz", std::string("ghz = a number, a list or ") + range_forms);
  for (const double ghz : read_values(value, "frequency.ghz", c.warnings)) {
    check_frequency(value, ghz);
    c.sweep.frequencies.push_back(rounded_to_15_digits(ghz * 1e9));
  }
  check_different(value, c.sweep.frequencies);
  if (const double ghz = std::ranges::max(c.sweep.frequencies) / 1e9; ghz > highest_radar_ghz)
    c.warnings.push_back(
        fmt::format("{}: frequency.ghz goes up to {} GHz, a wavelength of {:.3g} mm; if megahertz were meant, write {}",
                    value.location, number_text(ghz), speed_of_light / (ghz * 1e6), number_text(ghz / 1e3)));
}

std::vector<WrittenKey> written_keys(const CaseValue* section) {
  std::vector<WrittenKey> keys;
  for (std::size_t i = 0; section && i < section->keys.size(); ++i) {
    const std::string& location = section->items[i].location;
    keys.push_back({section->keys[i], location, is_override(location)});
  }
  return keys;
}

void read(const CaseValue& value, const CaseKey& key, bool& member) { member = read_flag(value, std::string(key.name)); }

void read(const CaseValue& value, const CaseKey& key, int& member) {
  member = read_whole(value, std::string(key.name), key.limits);
}

void read(const CaseValue& value, const CaseKey& key, double& member) {
  member = read_in(value, std::string(key.name), key.limits) * key.factor;
}

void read(const CaseValue& value, const CaseKey& key, std::optional<dvec3>& member) {
  member = read_vector(value, std::string(key.name));
  const double size = glm::length(*member);
  if (!(size > 0.0) || !std::isfinite(size))
    reject(value, fmt::format("{} must not be the zero vector; write for example [0, 0, 1]", key.name));
}

void read(const CaseValue&, const CaseKey&, std::vector<std::size_t>&) {}  // output.image_look: once the looks are known

void read(const CaseValue& value, const CaseKey& key, Use& member) {
  if (value.kind == CaseValue::Kind::boolean)
    member = value.boolean;
  else if (value.kind == CaseValue::Kind::text && value.text == "auto")
    member = {};
  else
    reject(value, fmt::format("{} must be true, false or \"auto\" (in looks where it can change the answer)", key.name));
}

template <class Choice>
requires std::is_enum_v<Choice>
void read(const CaseValue& value, const CaseKey& key, Choice& member) {
  member = static_cast<Choice>(read_word(value, std::string(key.name), words_of(member)));
}

// Words and flags come first, for they decide which of the numbers are allowed, and which member a number is for.
void read_scalar_keys(const CaseValue& root, Case& c) {
  if (find(root, "accuracy.tolerance_db")) c.tubes.model_share = 0.0;  // who asks for a tolerance gets it
  for (const bool numbers : {false, true})
    visit_case_keys(c, [&]<class Member>(const CaseKey& key, Member& member) {
      if (numbers != (std::is_arithmetic_v<Member> && !std::is_same_v<Member, bool>)) return;
      const CaseValue* value = find(root, key.name);
      if (!value) return;
      if (!key.allowed)
        reject(*value, {find(root, key.choices[0]), find(root, key.choices[1])}, fmt::format("{} needs {}", key.name, key.needs));
      read(*value, key, member);
    });
}

void check_material_edges(const CaseValue& root, const Case& c) {
  const CaseValue* value = find(root, "edges.materials");
  if (!value || c.edges.materials == MaterialEdgeMethod::none) return;
  if (c.sweep.materials.empty())
    reject(*value, "edges.materials is about edges of other materials, but the whole target is a perfect conductor; remove it");
  if (c.edges.method != EdgeMethod::fringe)
    reject(*value, {find(root, "edges.method")}, "edges.materials needs edges.method = \"fringe\"; remove it");
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
    reject(value, {find(root, "edges.method")},
           "output.image_look needs currents, but edges.method is \"utd\"; write \"fringe\" or \"none\" there");
  if (list && value.items.empty())
    reject(value, "output.image_look is an empty list; give at least one direction pair, or remove it");
  for (const CaseValue& item : list ? std::span(value.items) : std::span(&value, 1))
    c.image_looks.push_back(read_image_look(item, c));
  std::ranges::sort(c.image_looks);
  c.image_looks.erase(std::unique(c.image_looks.begin(), c.image_looks.end()), c.image_looks.end());
}

void check_incoherent(const CaseValue& root, const Case& c) {
  if (!c.incoherent) return;
  const CaseValue& incoherent = *find(root, "output.incoherent");
  if (!any_rough(c.sweep.materials))
    reject(incoherent, "output.incoherent: no surface is rough; give roughness_rms_mm to a material of the target, or remove it");
  if (c.edges.method == EdgeMethod::utd)
    reject(incoherent, {find(root, "edges.method")},
           "output.incoherent: incoherent power is not computed with edges.method = \"utd\"; remove one of them");
  if (c.ground)
    reject(incoherent, {root.find("ground")},
           "output.incoherent: over the ground a rough surface scatters along several paths in phase (enhanced backscattering), "
           "so powers do not add up; remove [ground]");
}

void read_output(const CaseValue& root, Case& c) {
  check_incoherent(root, c);
  if (c.power && !c.radar.link)
    reject(*find(root, "output.power_dbm"),
           "output.power_dbm needs radar.transmit_power_dbm and radar.gain_dbi; add them, or remove it");
  if (const CaseValue* looks = find(root, "output.image_look")) read_image_looks(root, *looks, c);
}

std::string name_of_mesh(const std::filesystem::path& file) {
  return (lower_case(file.extension().string()) == ".gz" ? file.stem() : file).stem().string();
}

void check_known_keys(const CaseValue& root) {
  constexpr std::array<std::string_view, 2> foreign = {"scene", "source"};
  const std::vector<std::string_view> names = case_key_names();
  check_keys(root, {names, foreign, "sources", {}, remedy_for_word});
  if (const CaseValue* materials = root.find("materials")) check_material_keys(*materials);
  if (const CaseValue* bodies = find(root, "motion.bodies")) check_body_keys(*bodies);
}

Case resolved(const CaseValue& root, const std::filesystem::path& file, const LookNumbers* looks) {
  check_known_keys(root);
  Case c;
  c.file = file;
  read_target(root, c);
  read_frequencies(root, c);
  read_materials(root, c);
  if (looks)
    fill_looks(*looks, root, c);
  else
    read_looks(root, c);
  read_scalar_keys(root, c);
  c.edge_keys = written_keys(root.find("edges"));
  check_material_edges(root, c);
  read_radar(root, c);
  read_motion(root, c);
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
  for (const std::string& table : pose_tables(c)) files.emplace_back("poses_csv", folder / table);
  return files;
}

}  // namespace raytube
