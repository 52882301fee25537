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

enum class Statement { vertex, facet, name, free_form, without_surface, unknown };

/// Of free form are those that make a curve or a surface of the control points before them, in older versions too (Wavefront,
/// Advanced Visualizer manual, 1992, appendix B1). `cstype`, `parm` and others only belong to one of these.
Statement statement_of(std::string_view keyword) {
  static constexpr std::string_view free_form[] = {"curv", "curv2", "surf", "bzp", "bsp", "cdc", "cdp"};
  static constexpr std::string_view without_surface[] = {
      "vt",  "vn",   "vp",    "l",      "p",     "s",     "mg",       "mtllib",   "usemap",     "maplib",
      "deg", "bmat", "step",  "cstype", "parm",  "trim",  "hole",     "scrv",     "sp",         "end",
      "con", "res",  "bevel", "lod",    "ctech", "stech", "c_interp", "d_interp", "shadow_obj", "trace_obj"};
  if (keyword == "v") return Statement::vertex;
  if (keyword == "f" || keyword == "fo") return Statement::facet;  // fo: in older versions
  if (keyword == "g" || keyword == "o" || keyword == "usemtl") return Statement::name;
  if (std::ranges::find(free_form, keyword) != std::end(free_form)) return Statement::free_form;
  const bool is_known = std::ranges::find(without_surface, keyword) != std::end(without_surface);
  return is_known ? Statement::without_surface : Statement::unknown;
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// A facet or a vertex with a flaw in front of its numbers: F, f1, a no-break space.
bool is_spoilt_surface(std::string_view keyword) {
  while (!keyword.empty() && !is_letter(keyword.front()) && !(keyword.front() >= '0' && keyword.front() <= '9'))
    keyword.remove_prefix(1);
  return !keyword.empty() && std::string_view("fFvV").find(keyword.front()) != std::string_view::npos &&
         (keyword.size() == 1 || !is_letter(keyword[1]));
}

/// Wavefront OBJ: of all its statements only `v` and `f` carry the surface; groups, objects and materials are names of the facets
/// that follow, curves and surfaces of free form are counted, normals and others passed over. Unknown ones may carry surface,
/// too.
class ObjParser {
 public:
  explicit ObjParser(const MeshFile& file) : file_(file), scanner_(file, true) {}

  PolygonSoup parse() {
    while (scanner_.next_line()) {
      const std::string_view keyword = scanner_.word();
      const Statement statement = statement_of(keyword);
      if (statement == Statement::vertex) read_vertex();
      if (statement == Statement::facet) read_facet();
      if (statement == Statement::free_form) ++soup_.free_forms;
      if (statement == Statement::unknown) note_unknown(keyword);
      if (statement == Statement::name) read_names(keyword);
      if (keyword != "mtllib" && statement != Statement::name) pass_words();
    }
    if (unknown_ > 0)
      soup_.remarks.push_back(fmt::format(
          "{} lines left out whose statement is none of OBJ, the first '{}' on line {}; export the mesh again if they "
          "carry a surface",
          unknown_, first_unknown_, first_unknown_line_));
    if (largest_corner_ > soup_.points.size())
      file_.reject(fmt::format("line {}: vertex {} does not exist, the file holds {}; export the mesh again",
                               largest_corner_line_, largest_corner_, soup_.points.size()));
    soup_.digits = scanner_.digits();
    return std::move(soup_);
  }

 private:
  void read_vertex() {
    dvec3 point;
    for (int axis = 0; axis < 3; ++axis) point[axis] = scanner_.coordinate(next_word());
    soup_.points.push_back(point);
  }

  /// The next word of this statement. A backslash at the end of a line, as of a path, must not swallow the statement that
  /// follows.
  std::string_view next_word() {
    const std::size_t line = scanner_.line();
    const std::string_view word = scanner_.word();
    if (scanner_.line() != line && statement_of(word) != Statement::unknown)
      scanner_.reject(fmt::format("'{}' continues the line before, which ends in a backslash; remove that", word));
    return word;
  }

  void pass_words() {
    while (!next_word().empty()) continue;
  }

  void note_unknown(std::string_view keyword) {
    if (is_spoilt_surface(keyword))
      scanner_.reject(
          fmt::format("'{}' is no statement of OBJ; write 'f' or 'v', then blanks, before its numbers", quotable(keyword)));
    if (++unknown_ > 1) return;
    first_unknown_ = quotable(keyword);
    first_unknown_line_ = scanner_.line();
  }

  /// Of groups there may be several. Objects and materials have one name, in which some programs put blanks.
  void read_names(std::string_view keyword) {
    names_.reset();
    if (keyword == "o") object_ = scanner_.rest_of_line();
    if (keyword == "usemtl") material_ = scanner_.rest_of_line();
    if (keyword != "g") return;
    groups_.clear();
    for (std::string_view word = next_word(); !word.empty(); word = next_word()) groups_.emplace_back(word);
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
    for (std::string_view word = next_word(); !word.empty(); word = next_word()) corners_.push_back(vertex_of(word));
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
  std::uint64_t unknown_ = 0;  // lines
  std::string first_unknown_;
  std::size_t first_unknown_line_ = 0;
};

}  // namespace

PolygonSoup parse_obj(const MeshFile& file) { return ObjParser(file).parse(); }

}  // namespace raytube
