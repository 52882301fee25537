#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string_view>

#include "core/text.h"
#include "mesh/read/formats.h"
#include "mesh/read/gltf_file.h"

namespace raytube {

namespace {

constexpr int most_gltf_levels = 100;

/// Khronos glTF 2.0: the triangles of the scene that is shown, each mesh where its nodes put it. Facets go by the names of their
/// nodes, the mesh and the material. Points and lines are no surface.
class GltfParser {
 public:
  explicit GltfParser(const MeshFile& file) : file_(file), document_(read_gltf_document(file)), data_(document_) {}

  PolygonSoup parse() {
    for (const Json& root : document_.list(shown_scene(), "nodes")) add_node(document_.whole(root), glm::dmat4(1.0), {}, 0);
    remark_on_nodes();
    soup_.stated_unit = StatedUnit{"m", 1.0};
    soup_.further_files = data_.further_files();
    return std::move(soup_);
  }

 private:
  const Json& shown_scene() const {
    const std::size_t scenes = document_.list(*document_.json, "scenes").size();
    if (scenes == 0) file_.reject("holds no scene; export the mesh as a scene");
    if (scenes > 1 && !find(*document_.json, "scene"))
      file_.reject(fmt::format("holds {} scenes and says of none that it is the one to show; export one scene", scenes));
    return document_.element("scenes", document_.whole(*document_.json, "scene", 0));
  }

  /// Drawn as hidden is not the same as away, and what no scene shows may be meant all the same.
  void remark_on_nodes() {
    soup_.remarks.emplace_back(
        "+y of a glTF file is up, and axes stay as they are: theta is the angle from its +z; turn the mesh if z is to be up");
    const std::span<const Json> nodes = document_.list(*document_.json, "nodes");
    visited_.resize(nodes.size());
    std::uint64_t hidden = 0, left_out = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      hidden += visited_[i] && is_hidden(nodes[i]);
      left_out += !visited_[i] && find(nodes[i], "mesh");
    }
    if (hidden > 0)
      soup_.remarks.push_back(fmt::format(
          "{} nodes are hidden (KHR_node_visibility) and read all the same; export without them what is to be away", hidden));
    if (left_out > 0)
      soup_.remarks.push_back(fmt::format(
          "{} nodes with a mesh left out, as the scene that is shown does not hold them; move there what is to be read",
          left_out));
  }

  static bool is_hidden(const Json& node) {
    const Json* extensions = find(node, "extensions");
    const Json* visibility = extensions ? find(*extensions, "KHR_node_visibility") : nullptr;
    const Json* visible = visibility ? find(*visibility, "visible") : nullptr;
    return visible && *visible == false;
  }

  /// `names` are those of the nodes above.
  void add_node(std::uint64_t index, const glm::dmat4& above, std::vector<std::string> names, int level) {
    const Json& node = document_.element("nodes", index);
    visited_.resize(document_.list(*document_.json, "nodes").size());
    if (visited_[index] || level > most_gltf_levels)
      file_.reject(
          fmt::format("nodes[{}] stands at two places of the scene or {} levels deep; export the mesh again", index, level));
    visited_[index] = true;
    if (find(node, "skin")) file_.reject(fmt::format("nodes[{}] is bent by a skeleton; apply the pose before the export", index));
    const glm::dmat4 place = above * transform_of(node);
    names.push_back(text_at(node, "name"));
    if (find(node, "mesh")) add_mesh(node, place, names);
    for (const Json& child : document_.list(node, "children")) add_node(document_.whole(child), place, names, level + 1);
  }

  /// As many numbers as `otherwise`, which stands for them where they are missing.
  std::vector<double> numbers_of(const Json& table, std::string_view name, std::vector<double> otherwise) const {
    if (!find(table, name)) return otherwise;
    std::vector<double> numbers;
    for (const Json& value : document_.list(table, name)) numbers.push_back(document_.number(value));
    if (numbers.size() != otherwise.size())
      file_.reject(fmt::format("'{}' of a node holds {} numbers instead of {}; export the mesh again", name, numbers.size(),
                               otherwise.size()));
    return numbers;
  }

  glm::dmat4 transform_of(const Json& node) const {
    if (find(node, "matrix")) {
      const std::vector<double> m = numbers_of(node, "matrix", std::vector<double>(16));
      if (m[3] != 0.0 || m[7] != 0.0 || m[11] != 0.0 || m[15] != 1.0)
        file_.reject("the matrix of a node does not end in 0, 0, 0, 1; export the mesh again");
      return glm::make_mat4(m.data());
    }
    const std::vector<double> t = numbers_of(node, "translation", {0, 0, 0}), r = numbers_of(node, "rotation", {0, 0, 0, 1}),
                              s = numbers_of(node, "scale", {1, 1, 1});
    const glm::dquat turn(r[3], r[0], r[1], r[2]);
    if (!(std::abs(glm::length(turn) - 1.0) < 1e-3))  // single precision leaves 1e-7, few digits of text more
      file_.reject(fmt::format("the rotation of a node is not a unit quaternion (its length is {}); export the mesh again",
                               glm::length(turn)));
    return glm::scale(glm::translate(glm::dmat4(1.0), {t[0], t[1], t[2]}) * glm::mat4_cast(glm::normalize(turn)),
                      {s[0], s[1], s[2]});
  }

  void add_mesh(const Json& node, const glm::dmat4& place, std::vector<std::string> names) {
    const std::uint64_t index = document_.required_whole(node, "mesh");
    const Json& mesh = document_.element("meshes", index);
    for (const Json* shaped : {&node, &mesh})
      for (const Json& weight : document_.list(*shaped, "weights"))
        if (document_.number(weight) != 0.0)
          file_.reject(fmt::format("meshes[{}] is shaped by morph targets; apply them before the export", index));
    names.push_back(text_at(mesh, "name"));
    names.emplace_back();
    for (const Json& primitive : document_.list(mesh, "primitives")) {
      names.back() = material_of(primitive);
      add_primitive(primitive, place, names);
    }
  }

  std::string material_of(const Json& primitive) const {
    if (!find(primitive, "material")) return {};
    return text_at(document_.element("materials", document_.required_whole(primitive, "material")), "name");
  }

  void add_primitive(const Json& primitive, const glm::dmat4& place, const std::vector<std::string>& names) {
    const std::uint64_t mode = document_.whole(primitive, "mode", 4);
    if (mode < 4) return;  // points and lines
    const Json* attributes = find(primitive, "attributes");
    if (!attributes || !find(*attributes, "POSITION"))
      file_.reject("a primitive of a mesh has no POSITION; export it without compression");
    const std::vector<dvec3> points = data_.positions(document_.required_whole(*attributes, "POSITION"));
    const std::vector<std::uint32_t> corners =
        find(primitive, "indices") ? data_.indices(document_.required_whole(primitive, "indices")) : counted(points.size());
    add_instance(file_, data_.bytes(), points, triangles_of(mode, corners), place, names, soup_);
  }

  static std::vector<std::uint32_t> counted(std::size_t count) {
    std::vector<std::uint32_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0u);
    return numbers;
  }

  /// Triangles (mode 4), strips (5) and fans (6), wound as section 3.7.2.1 of the specification says.
  Triangles triangles_of(std::uint64_t mode, const std::vector<std::uint32_t>& c) const {
    Triangles triangles;
    if (mode > 6) file_.reject(fmt::format("mode {} of a primitive is unknown; the file is damaged, export it again", mode));
    if (mode == 4 && c.size() % 3 != 0)
      file_.reject(fmt::format("a primitive of triangles has {} corners; the file is damaged, export it again", c.size()));
    for (std::size_t i = 0; i + 2 < c.size(); i += mode == 4 ? 3 : 1) {
      if (mode == 4) triangles.push_back({c[i], c[i + 1], c[i + 2]});
      if (mode == 5) triangles.push_back({c[i], c[i + 1 + i % 2], c[i + 2 - i % 2]});
      if (mode == 6) triangles.push_back({c[i + 1], c[i + 2], c[0]});
    }
    return triangles;
  }

  const MeshFile& file_;
  GltfDocument document_;
  GltfData data_;
  PolygonSoup soup_;
  std::vector<bool> visited_;
};

}  // namespace

PolygonSoup parse_gltf(const MeshFile& file) { return GltfParser(file).parse(); }

}  // namespace raytube
