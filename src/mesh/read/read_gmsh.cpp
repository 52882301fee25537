#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string_view>
#include <unordered_map>

#include "core/text.h"
#include "mesh/files/numbers.h"
#include "mesh/files/text_scanner.h"
#include "mesh/read/formats.h"

namespace raytube {

namespace {

/// The numbers of a Gmsh file one by one, text or binary as its head says, between words that are text in both. Each rejects the
/// file if it ends before.
class GmshNumbers {
 public:
  explicit GmshNumbers(TextScanner& scanner) : scanner_(scanner) {}

  /// Reads what follows the line $MeshFormat; rejects versions other than 2.0 to 2.2 and 4.1.
  void read_format() {
    const std::string_view version = scanner_.word_of_any_line();
    version_4_ = version == "4.1";
    if (!version_4_ && version != "2" && version != "2.0" && version != "2.1" && version != "2.2")
      scanner_.reject(
          fmt::format("version '{}' of the Gmsh format is not read; save it as 4.1: gmsh in.msh -save -format msh41 -o "
                      "out.msh",
                      quotable(version)));
    const std::string_view kind = scanner_.word(), size = scanner_.word();
    if (kind != "0" && kind != "1")
      scanner_.reject(
          fmt::format("'{}' is neither 0 (text) nor 1 (binary); the file is damaged, export it again", quotable(kind)));
    binary_ = kind == "1";
    if (!binary_) return;
    if (size != "8")
      scanner_.reject(fmt::format("binary numbers of '{}' bytes are not read; save the mesh as text", quotable(size)));
    begin();
    const auto one = binary<std::int32_t>();
    swapped_ = one == 1 << 24;
    if (one != 1 && !swapped_) scanner_.reject("the head of its binary numbers is damaged; export the mesh again");
  }

  bool is_version_4() const { return version_4_; }
  bool is_binary() const { return binary_; }

  /// Passes the end of the line behind which binary numbers begin.
  void begin() {
    if (binary_) scanner_.skip_line();
  }

  /// Of 32 bits, with its sign.
  std::int64_t integer() {
    if (binary_) return binary<std::int32_t>();
    const std::string_view word = scanner_.word_of_any_line();
    const double value = scanner_.number(word);
    if (value != std::trunc(value) || std::abs(value) > 0x7FFFFFFF)
      scanner_.reject(
          fmt::format("a whole number was expected instead of '{}'; the file is damaged, export it again", quotable(word)));
    return static_cast<std::int64_t>(value);
  }

  /// Of 64 bits.
  std::uint64_t size() { return binary_ ? binary<std::uint64_t>() : scanner_.count(scanner_.word_of_any_line()); }

  /// The number that an element or a node goes by: 32 bits in version 2, 64 bits in version 4.1.
  std::uint64_t tag() {
    return binary_ && !version_4_ ? static_cast<std::uint64_t>(std::int64_t{binary<std::int32_t>()}) : size();
  }

  double coordinate() {
    if (!binary_) return scanner_.coordinate(scanner_.word_of_any_line());
    const auto value = binary<double>();
    if (!std::isfinite(value)) scanner_.reject("a node has a coordinate that is not finite; correct it or export the mesh again");
    return value;
  }

 private:
  template <class Number>
  Number binary() {
    return number_at<Number>(scanner_.raw_bytes(sizeof(Number)).data(), swapped_);
  }

  TextScanner& scanner_;
  bool version_4_ = false, binary_ = false, swapped_ = false;
};

struct ElementShape {
  std::int64_t type;
  int dimension;
  std::size_t nodes;
};

/// Those with straight edges: point, line, triangle, quadrilateral; tetrahedron, hexahedron, prism, pyramid (Gmsh reference
/// manual, "Node ordering" and "MSH file format").
constexpr std::array<ElementShape, 8> element_shapes = {
    {{15, 0, 1}, {1, 1, 2}, {2, 2, 3}, {3, 2, 4}, {4, 3, 4}, {5, 3, 8}, {6, 3, 6}, {7, 3, 5}}};

/// Gmsh MSH 2 and 4.1, text and binary. Triangles and quadrilaterals are the surface, in the order of the file, and go by the
/// names of their physical groups; points, lines and volumes that the file has beside them are no part of it.
class GmshParser {
 public:
  explicit GmshParser(const MeshFile& file) : file_(file), scanner_(file), numbers_(scanner_) {}

  PolygonSoup parse() {
    std::string first(read_line_word());
    for (; first == "$Comments"; first = read_line_word()) pass_section(first);
    if (first != "$MeshFormat")
      scanner_.reject(
          "a Gmsh file starts with $MeshFormat; meshes of other programs that end in .msh are not read, export STL, "
          "OBJ, PLY or OFF");
    numbers_.read_format();
    expect_end("$MeshFormat");
    while (scanner_.next_line()) read_section(std::string(scanner_.word()));
    if (soup_.polygons.empty() && volumes_ > 0)
      file_.reject(
          fmt::format("holds {} volume elements and no surface; save its surface too (Physical Surface, or "
                      "Mesh.SaveAll = 1)",
                      volumes_));
    soup_.digits = scanner_.digits();
    return std::move(soup_);
  }

 private:
  std::string_view read_line_word() { return scanner_.next_line() ? scanner_.word() : std::string_view(); }

  void pass_coordinates(std::int64_t count) {
    for (; count > 0; --count) numbers_.coordinate();
  }

  /// Of version 4.1: how many blocks follow, before the numbers of all items and of the least and the largest tag.
  std::uint64_t begin_blocks() {
    numbers_.begin();
    const std::uint64_t blocks = numbers_.size();
    for (int left = 3; left > 0; --left) numbers_.size();
    return blocks;
  }

  void read_section(const std::string& name) {
    if (!name.starts_with('$'))
      scanner_.reject(fmt::format("a section such as $Nodes was expected instead of '{}'; the file is damaged, export it again",
                                  quotable(name)));
    if (name == "$PartitionedEntities") scanner_.reject("the mesh is divided into partitions; save it before it is partitioned");
    if (name == "$PhysicalNames")
      read_physical_names();
    else if (name == "$Entities")
      read_entities();
    else if (name == "$Nodes")
      numbers_.is_version_4() ? read_node_blocks() : read_nodes();
    else if (name == "$Elements")
      numbers_.is_version_4() ? read_element_blocks() : read_elements();
    else
      return pass_other_section(name);
    expect_end(name);
  }

  void expect_end(std::string_view name) {
    const std::string_view word = scanner_.word_of_any_line();
    if (!word.starts_with("$End") || word.substr(4) != name.substr(1))
      scanner_.reject(fmt::format("$End{} was expected instead of '{}'; the file is cut short or damaged, export it again",
                                  name.substr(1), quotable(word)));
  }

  /// Comments, fields, and what else belongs to no mesh; unknown ones may hold more of it.
  void pass_other_section(const std::string& name) {
    static constexpr std::string_view known[] = {"$Comments",         "$Periodic",           "$NodeData",
                                                 "$ElementData",      "$ElementNodeData",    "$GhostElements",
                                                 "$Parametrizations", "$InterpolationScheme"};
    if (std::ranges::find(known, name) == std::end(known))
      soup_.remarks.push_back(
          fmt::format("section {} on line {} left out, which is none of Gmsh; save the mesh again if it carries a surface",
                      quotable(name), scanner_.line()));
    pass_section(name);
  }

  void pass_section(const std::string& name) {
    while (scanner_.next_line())
      if (const std::string_view word = scanner_.word(); word.starts_with("$End") && word.substr(4) == name.substr(1)) return;
    scanner_.reject(fmt::format("the file ends without $End{}; it is cut short, export it again", quotable(name.substr(1))));
  }

  /// Text in binary files, too.
  std::uint64_t text_count() { return scanner_.count(scanner_.word_of_any_line()); }

  void read_physical_names() {
    for (std::uint64_t left = text_count(); left > 0; --left) {
      const std::uint64_t dimension = text_count(), group = text_count();
      std::string_view name = scanner_.rest_of_line();
      if (name.size() < 2 || name.front() != '"' || name.back() != '"')
        scanner_.reject(fmt::format("the name of physical group {} lacks its quotes; export the mesh again", group));
      if (dimension == 2) group_names_[static_cast<std::int64_t>(group)] = name.substr(1, name.size() - 2);
    }
  }

  /// A group without a name goes by its number. Its sign tells the side that the normal was to be on.
  std::string group_name(std::int64_t group) const {
    const auto found = group_names_.find(std::abs(group));
    return found != group_names_.end() ? found->second : std::to_string(std::abs(group));
  }

  /// Of version 4.1: which physical groups a surface of the model is in.
  void read_entities() {
    numbers_.begin();
    std::array<std::uint64_t, 4> counts;
    for (std::uint64_t& count : counts) count = numbers_.size();
    for (int dimension = 0; dimension < 4; ++dimension)
      for (std::uint64_t left = counts[dimension]; left > 0; --left) read_entity(dimension);
  }

  void read_entity(int dimension) {
    const std::int64_t entity = numbers_.integer();
    pass_coordinates(dimension == 0 ? 3 : 6);  // its place, or its box
    std::vector<std::string> names;
    for (std::uint64_t left = numbers_.size(); left > 0; --left) names.push_back(group_name(numbers_.integer()));
    if (dimension == 2) names_of_surface_[entity] = soup_.names.list(names);
    if (dimension > 0)
      for (std::uint64_t left = numbers_.size(); left > 0; --left) numbers_.integer();  // what bounds it
  }

  void add_node(std::uint64_t node) {
    if (!index_of_node_.try_emplace(node, static_cast<std::uint32_t>(soup_.points.size())).second)
      scanner_.reject(fmt::format("node {} is there twice; the file is damaged, export it again", node));
    dvec3& point = soup_.points.emplace_back();
    for (int axis = 0; axis < 3; ++axis) point[axis] = numbers_.coordinate();
  }

  void read_nodes() {
    std::uint64_t left = text_count();
    for (numbers_.begin(); left > 0; --left) add_node(numbers_.tag());
  }

  void read_node_blocks() {
    for (std::uint64_t left = begin_blocks(); left > 0; --left) read_node_block();
  }

  void read_node_block() {
    const std::int64_t dimension = numbers_.integer();
    numbers_.integer();  // the entity
    const bool parametric = numbers_.integer() != 0;
    std::vector<std::uint64_t> nodes;
    for (std::uint64_t left = numbers_.size(); left > 0; --left) nodes.push_back(numbers_.tag());
    for (const std::uint64_t node : nodes) {
      add_node(node);
      if (parametric) pass_coordinates(dimension);
    }
  }

  const ElementShape& shape_of(std::int64_t type) const {
    for (const ElementShape& shape : element_shapes)
      if (shape.type == type) return shape;
    scanner_.reject(
        fmt::format("elements of type {} have curved edges or are unknown; mesh the model in first order (gmsh -order 1)", type));
  }

  /// Of version 2: each element with its type and tags, or in binary files a head for several of the same.
  void read_elements() {
    std::uint64_t left = text_count();
    for (numbers_.begin(); left > 0;) {
      const std::uint64_t element = numbers_.is_binary() ? 0 : numbers_.tag();
      const ElementShape& shape = shape_of(numbers_.integer());
      const std::int64_t count = numbers_.is_binary() ? numbers_.integer() : 1, tags = numbers_.integer();
      if (count < 1 || static_cast<std::uint64_t>(count) > left)
        scanner_.reject("the counts of its elements do not agree; the file is damaged, export it again");
      for (std::int64_t i = 0; i < count; ++i) read_tagged_element(numbers_.is_binary() ? numbers_.tag() : element, shape, tags);
      left -= static_cast<std::uint64_t>(count);
    }
  }

  /// Of version 2: the first tag is the physical group, 0 for none.
  void read_tagged_element(std::uint64_t element, const ElementShape& shape, std::int64_t tags) {
    std::int64_t group = 0;
    if (tags > 0) group = numbers_.integer();
    for (std::int64_t i = 1; i < tags; ++i) numbers_.integer();
    add_element(element, shape, group == 0 || shape.dimension != 2 ? 0 : list_of_group(group));
  }

  std::uint32_t list_of_group(std::int64_t group) {
    const auto [entry, is_new] = names_of_group_.try_emplace(group, 0);
    if (is_new) entry->second = soup_.names.list({group_name(group)});
    return entry->second;
  }

  void read_element_blocks() {
    for (std::uint64_t left = begin_blocks(); left > 0; --left) read_element_block();
  }

  void read_element_block() {
    numbers_.integer();  // the dimension, which the type has too
    const std::int64_t entity = numbers_.integer();
    const ElementShape& shape = shape_of(numbers_.integer());
    const auto names = names_of_surface_.find(entity);
    const std::uint32_t list = shape.dimension == 2 && names != names_of_surface_.end() ? names->second : 0;
    for (std::uint64_t left = numbers_.size(); left > 0; --left) add_element(numbers_.tag(), shape, list);
  }

  void add_element(std::uint64_t element, const ElementShape& shape, std::uint32_t names) {
    if (shape.dimension == 3) ++volumes_;
    std::vector<std::uint32_t> polygon;
    for (std::size_t i = 0; i < shape.nodes; ++i) polygon.push_back(index_of(numbers_.tag(), element));
    if (shape.dimension != 2) return;
    soup_.names.give(soup_.polygons.size(), names);
    soup_.polygons.push_back(std::move(polygon));
  }

  std::uint32_t index_of(std::uint64_t node, std::uint64_t element) const {
    const auto found = index_of_node_.find(node);
    if (found == index_of_node_.end())
      scanner_.reject(fmt::format("element {} names node {}, which does not exist; export the mesh again", element, node));
    return found->second;
  }

  const MeshFile& file_;
  TextScanner scanner_;
  GmshNumbers numbers_;
  PolygonSoup soup_;
  std::unordered_map<std::int64_t, std::string> group_names_;         // of surfaces
  std::unordered_map<std::int64_t, std::uint32_t> names_of_group_;    // version 2: lists in soup_.names
  std::unordered_map<std::int64_t, std::uint32_t> names_of_surface_;  // version 4.1, the same
  std::unordered_map<std::uint64_t, std::uint32_t> index_of_node_;
  std::uint64_t volumes_ = 0;
};

}  // namespace

PolygonSoup parse_gmsh(const MeshFile& file) { return GmshParser(file).parse(); }

}  // namespace raytube
