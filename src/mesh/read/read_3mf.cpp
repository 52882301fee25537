#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "core/text.h"
#include "mesh/files/mesh_file.h"
#include "mesh/files/packed.h"
#include "mesh/files/text_scanner.h"
#include "mesh/files/xml_reader.h"
#include "mesh/read/formats.h"

namespace raytube {

namespace {

constexpr std::string_view core_namespace = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02",
                           production_path = "http://schemas.microsoft.com/3dmanufacturing/production/2015/06|path";
constexpr int most_3mf_levels = 100;

/// 3MF units, as target.unit calls them.
constexpr std::array<std::pair<std::string_view, StatedUnit>, 6> units_of_3mf = {{{"micron", {"um", 1e-6}},
                                                                                  {"millimeter", {"mm", 1e-3}},
                                                                                  {"centimeter", {"cm", 1e-2}},
                                                                                  {"inch", {"in", 0.0254}},
                                                                                  {"foot", {"ft", 0.3048}},
                                                                                  {"meter", {"m", 1.0}}}};

using ObjectKey = std::pair<std::string, std::string>;  // the model part it stands in, and its id there

/// An object put at a place, by another one or by what is built.
struct Placed {
  ObjectKey object;
  glm::dmat4 place;
};

struct Object3mf {
  std::string name;
  std::vector<dvec3> points;
  Triangles triangles;
  std::vector<Placed> components;
};

/// What the model parts of a file hold.
struct Model3mf {
  std::map<ObjectKey, Object3mf> objects;
  std::vector<Placed> items;
  std::optional<StatedUnit> unit;
  int digits = 0;                   // most of a coordinate
  std::uint64_t not_printable = 0;  // items
  std::uint64_t beams = 0;          // of lattices
};

/// One model part: a text of XML (3MF Consortium, core specification 1.3, and its production extension).
class ModelPartParser {
 public:
  ModelPartParser(const MeshFile& file, std::string part, Model3mf& model)
      : part_(std::move(part)), reader_(file, part_), model_(model) {
    reader_.prefix = [this](std::string_view prefix, std::string_view uri) {
      namespaces_.insert_or_assign(std::string(prefix), uri);
    };
    reader_.begin = [this](const XmlReader::Element& element) { begin(element); };
    reader_.end = [this](std::string_view name) {
      if (core_name(name) == "object") object_ = nullptr;
    };
  }

  void parse(std::string_view text) { reader_.read(text); }

 private:
  /// The name of an element that the core specification knows; empty for others.
  static std::string_view core_name(std::string_view name) {
    const bool is_core = name.starts_with(core_namespace) && name.size() > core_namespace.size();
    return is_core ? name.substr(core_namespace.size() + 1) : std::string_view();
  }

  void begin(const XmlReader::Element& element) {
    const std::string_view name = core_name(element.name);
    if (name == "model") return begin_model(element);
    if (name == "object") return begin_object(element);
    if (name == "item") {
      const std::string_view printable = element.find("printable").value_or("1");
      model_.not_printable += printable == "0" || printable == "false";
      return model_.items.push_back(placed(element));
    }
    model_.beams += element.name.ends_with("|beam");
    if (name != "vertex" && name != "triangle" && name != "component") return;
    if (!object_) reader_.reject(fmt::format("a {} stands outside an object; the file is damaged, export it again", name));
    if (name == "vertex") add_vertex(element);
    if (name == "triangle") object_->triangles.push_back({element.index("v1"), element.index("v2"), element.index("v3")});
    if (name == "component") object_->components.push_back(placed(element));
  }

  void add_vertex(const XmlReader::Element& element) {
    object_->points.emplace_back(element.coordinate("x"), element.coordinate("y"), element.coordinate("z"));
    for (const char* axis : {"x", "y", "z"}) model_.digits = std::max(model_.digits, written_digits(element.text(axis)));
  }

  void begin_model(const XmlReader::Element& element) {
    check_extensions(element.find("requiredextensions").value_or(""));
    const std::string_view unit = element.find("unit").value_or("millimeter");
    const auto found = std::ranges::find(units_of_3mf, unit, [](const auto& entry) { return entry.first; });
    if (found == units_of_3mf.end())
      reader_.reject(fmt::format("the unit '{}' is none of 3MF; correct it there", quotable(unit)));
    if (model_.unit && model_.unit->metres != found->second.metres)
      reader_.reject(fmt::format("the unit '{}' is not that of the other parts of the file; export it again", unit));
    model_.unit = found->second;
  }

  /// Of parts in several texts and of colours; others may change the surface.
  void check_extensions(std::string_view prefixes) {
    while (!prefixes.empty()) {
      const std::string prefix(prefixes.substr(0, prefixes.find(' ')));
      prefixes.remove_prefix(std::min(prefix.size() + 1, prefixes.size()));
      const std::string uri = namespaces_[prefix];
      if (!prefix.empty() && uri.find("/production/") == std::string::npos && uri.find("/material/") == std::string::npos)
        reader_.reject(fmt::format("needs the extension '{}', which is not read; export it as plain 3MF, STL, OBJ or PLY",
                                   quotable(uri.empty() ? prefix : uri)));
    }
  }

  void begin_object(const XmlReader::Element& element) {
    const auto [entry, is_new] = model_.objects.try_emplace({part_, std::string(element.text("id"))});
    if (!is_new) reader_.reject("an object of this id is there already; the file is damaged, export it again");
    object_ = &entry->second;
    object_->name = element.find("name").value_or("");
  }

  Placed placed(const XmlReader::Element& element) const {
    const std::string_view path = element.find(production_path).value_or(part_);
    return {{std::string(path.substr(path.starts_with('/') ? 1 : 0)), std::string(element.text("objectid"))},
            transform_of(element.find("transform"))};
  }

  /// Four rows of three numbers; points are rows on their left (core specification, section 3.3).
  glm::dmat4 transform_of(std::optional<std::string_view> text) const {
    glm::dmat4 place(1.0);
    if (!text) return place;
    constexpr std::string_view blanks_between = " \t\r\n";
    int count = 0;
    for (std::size_t begin = text->find_first_not_of(blanks_between); begin != std::string_view::npos;
         begin = text->find_first_not_of(blanks_between, std::min(begin, text->size()))) {
      const std::string_view word = text->substr(begin, text->find_first_of(blanks_between, begin) - begin);
      if (count < 12) place[count / 3][count % 3] = reader_.finite_number(word);
      ++count;
      begin += word.size();
    }
    if (count != 12)
      reader_.reject(fmt::format("a transform holds {} numbers instead of 12; the file is damaged, export it again", count));
    return place;
  }

  std::string part_;
  XmlReader reader_;
  Model3mf& model_;
  Object3mf* object_ = nullptr;
  std::map<std::string, std::string> namespaces_;
};

/// Puts objects where the build section wants them. Facets go by the names of the objects that hold them.
class Builder3mf {
 public:
  Builder3mf(const MeshFile& file, const Model3mf& model) : file_(file), model_(model) {}

  PolygonSoup build() {
    soup_.digits = model_.digits;
    for (const Placed& item : model_.items) add(item, glm::dmat4(1.0), {}, 0);
    return std::move(soup_);
  }

 private:
  void add(const Placed& placed, const glm::dmat4& above, std::vector<std::string> names, int level) {
    const auto found = model_.objects.find(placed.object);
    if (found == model_.objects.end())
      file_.reject(fmt::format("object {} of {} does not exist; the file is damaged, export it again",
                               quotable(placed.object.second), quotable(placed.object.first)));
    if (level > most_3mf_levels) file_.reject("its objects hold one another without end; the file is damaged, export it again");
    check_repetition(file_, file_.bytes.size(), ++placements_);
    const Object3mf& object = found->second;
    const glm::dmat4 place = above * placed.place;
    names.push_back(object.name);
    add_instance(file_, file_.bytes.size(), object.points, object.triangles, place, names, soup_);
    for (const Placed& component : object.components) add(component, place, names, level + 1);
  }

  const MeshFile& file_;
  const Model3mf& model_;
  PolygonSoup soup_;
  std::uintmax_t placements_ = 0;
};

/// The first model part, which the package's relationships name.
std::string root_part(const MeshFile& file, const ZipArchive& archive) {
  std::string root;
  XmlReader reader(file, "_rels/.rels");
  reader.begin = [&](const XmlReader::Element& element) {
    if (element.name.ends_with("|Relationship") && element.text("Type").ends_with("/3dmodel")) root = element.text("Target");
  };
  reader.read(archive.read("_rels/.rels"));
  if (root.empty()) file.reject("names no model in _rels/.rels; it is not a 3MF file, or damaged, export it again");
  return root.substr(root.starts_with('/') ? 1 : 0);
}

/// Objects of other model parts that are placed somewhere, but not read yet: the first such part; empty if there is none.
std::string missing_part(const Model3mf& model, const std::vector<std::string>& known) {
  const auto missing = [&](const Placed& placed) { return std::ranges::find(known, placed.object.first) == known.end(); };
  const auto first_of = [&](const std::vector<Placed>& all) {
    const auto found = std::ranges::find_if(all, missing);
    return found == all.end() ? std::string() : found->object.first;
  };
  std::string part = first_of(model.items);
  for (auto object = model.objects.begin(); part.empty() && object != model.objects.end(); ++object)
    part = first_of(object->second.components);
  return part;
}

/// Objects that nothing places are left out; items that are not to be printed stand where they are all the same.
void remark_on_model(const Model3mf& model, PolygonSoup& soup) {
  if (model.not_printable > 0)
    soup.remarks.push_back(
        fmt::format("{} items are marked printable=\"0\" and read all the same; export without them what is to be away",
                    model.not_printable));
  if (model.beams > 0)
    soup.remarks.push_back(
        fmt::format("{} beams of lattices left out, only triangles are read; export the lattice as triangles", model.beams));
  std::set<ObjectKey> placed;
  for (const Placed& item : model.items) placed.insert(item.object);
  for (const auto& [key, object] : model.objects)
    for (const Placed& component : object.components) placed.insert(component.object);
  const auto left_out = std::ranges::count_if(
      model.objects, [&](const auto& entry) { return !entry.second.triangles.empty() && !placed.contains(entry.first); });
  if (left_out > 0)
    soup.remarks.push_back(
        fmt::format("{} objects left out, as nothing places them; add an item for what is to be read", left_out));
}

}  // namespace

PolygonSoup parse_3mf(const MeshFile& file) {
  const ZipArchive archive(file);
  Model3mf model;
  std::vector<std::string> parts;
  for (std::string part = root_part(file, archive); !part.empty(); part = missing_part(model, parts)) {
    parts.push_back(part);
    ModelPartParser(file, part, model).parse(archive.read(part));
  }
  PolygonSoup soup = Builder3mf(file, model).build();
  remark_on_model(model, soup);
  soup.stated_unit = model.unit;
  return soup;
}

}  // namespace raytube
