#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <limits>
#include <optional>

#include "core/text.h"
#include "mesh/files/text_scanner.h"
#include "mesh/read/formats.h"

namespace raytube {

namespace {

/// The statements that make a curve or a surface of the control points before them, those of older versions too (Wavefront,
/// Advanced Visualizer manual, 1992, appendix B1). `cstype`, `parm` and others only belong to one of these.
bool is_free_form(std::string_view keyword) {
  static constexpr std::string_view keywords[] = {"curv", "curv2", "surf", "bzp", "bsp", "cdc", "cdp"};
  return std::ranges::find(keywords, keyword) != std::end(keywords);
}

/// Wavefront OBJ: of all its statements only `v` and `f` carry the surface; groups, objects and materials are names of the facets
/// that follow, curves and surfaces of free form are counted, normals and others passed over.
class ObjParser {
 public:
  explicit ObjParser(const MeshFile& file) : file_(file), scanner_(file, true) {}

  PolygonSoup parse() {
    while (scanner_.next_line()) {
      const std::string_view keyword = scanner_.word();
      if (keyword == "v") read_vertex();
      if (keyword == "f") read_facet();
      if (is_free_form(keyword)) ++soup_.free_forms;
      read_names(keyword);
    }
    if (largest_corner_ > soup_.points.size())
      file_.reject(fmt::format("line {}: vertex {} does not exist, the file holds {}; export the mesh again",
                               largest_corner_line_, largest_corner_, soup_.points.size()));
    return std::move(soup_);
  }

 private:
  void read_vertex() {
    dvec3 point;
    for (int axis = 0; axis < 3; ++axis) point[axis] = scanner_.coordinate(scanner_.word());
    soup_.points.push_back(point);
  }

  /// Of groups there may be several. Objects and materials have one name, in which some programs put blanks.
  void read_names(std::string_view keyword) {
    if (keyword != "g" && keyword != "o" && keyword != "usemtl") return;
    names_.reset();
    if (keyword == "o") object_ = scanner_.rest_of_line();
    if (keyword == "usemtl") material_ = scanner_.rest_of_line();
    if (keyword != "g") return;
    groups_.clear();
    for (std::string_view word = scanner_.word(); !word.empty(); word = scanner_.word()) groups_.emplace_back(word);
  }

  void name_facet() {
    if (!names_) {
      std::vector<std::string> names = groups_;
      names.insert(names.end(), {object_, material_});
      names_ = soup_.names.list(names);
    }
    soup_.names.give(soup_.polygons.size(), *names_);
  }

  void read_facet() {
    name_facet();
    corners_.clear();
    for (std::string_view word = scanner_.word(); !word.empty(); word = scanner_.word()) corners_.push_back(vertex_of(word));
    soup_.polygons.emplace_back(corners_.begin(), corners_.end());
  }

  /// A corner reads vertex[/texture[/normal]]. Vertices count from 1, or backwards from the last one read, which is -1.
  std::uint32_t vertex_of(std::string_view corner) {
    const std::string_view digits = corner.substr(0, corner.find('/'));
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error != std::errc() || end != digits.data() + digits.size() || number > std::numeric_limits<std::int32_t>::max())
      scanner_.reject(fmt::format("the corner '{}' is not a vertex number; correct the line", quotable(corner)));
    if (number < 0) number += static_cast<std::int64_t>(soup_.points.size()) + 1;
    if (number < 1)
      scanner_.reject(fmt::format("the corner '{}' names no vertex; they count from 1, or from -1 backwards", quotable(corner)));
    note_corner(static_cast<std::uint64_t>(number));
    return static_cast<std::uint32_t>(number - 1);
  }

  /// Vertices may follow the facets that use them, so the range is checked at the end of the file.
  void note_corner(std::uint64_t number) {
    if (number <= largest_corner_) return;
    largest_corner_ = number;
    largest_corner_line_ = scanner_.line();
  }

  const MeshFile& file_;
  TextScanner scanner_;
  PolygonSoup soup_;
  std::vector<std::uint32_t> corners_;  // of one facet
  std::vector<std::string> groups_;
  std::string object_, material_;
  std::optional<std::uint32_t> names_;  // the list of these, once a facet goes by it
  std::uint64_t largest_corner_ = 0;
  std::size_t largest_corner_line_ = 0;
};

}  // namespace

PolygonSoup parse_obj(const MeshFile& file) { return ObjParser(file).parse(); }

}  // namespace raytube
