#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include "core/text.h"
#include "mesh/files/numbers.h"
#include "mesh/files/text_scanner.h"
#include "mesh/read/formats.h"

static_assert(std::endian::native == std::endian::little, "binary STL and PLY are read in the machine's own byte order");

namespace raytube {

namespace {

constexpr std::size_t header_bytes = 84;  // 80 free ones, then the number of facets
constexpr std::size_t facet_bytes = 50;   // normal and three corners in single precision, two bytes of attributes

/// Numbers points, each once: where its number stands, by its coordinates.
class PointNumbers {
 public:
  /// The number of a point in `points`, behind which it is put if it is new.
  std::uint32_t number_of(const dvec3& point, std::vector<dvec3>& points) {
    if (2 * (points.size() + 1) > slots_.size()) grow(points);
    std::uint32_t& slot = slots_[slot_of(point, points)];
    if (slot == no_index) {
      slot = static_cast<std::uint32_t>(points.size());
      points.push_back(point);
    }
    return slot;
  }

 private:
  /// Where it stands, or may be put: the next free slot from that of its hash.
  std::size_t slot_of(const dvec3& point, const std::vector<dvec3>& points) const {
    std::size_t slot = hash(point) & (slots_.size() - 1);
    while (slots_[slot] != no_index && points[slots_[slot]] != point) slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }

  void grow(const std::vector<dvec3>& points) {
    slots_.assign(std::max<std::size_t>(1024, 2 * slots_.size()), no_index);
    for (std::uint32_t i = 0; i < points.size(); ++i) slots_[slot_of(points[i], points)] = i;
  }

  static std::size_t hash(const dvec3& p) {
    std::size_t hash = 0;
    for (int axis = 0; axis < 3; ++axis) hash = (hash ^ std::bit_cast<std::uint64_t>(p[axis])) * 0x9E3779B97F4A7C15u;
    return hash ^ (hash >> 32);
  }

  std::vector<std::uint32_t> slots_;  // a power of two of them
};

/// STL repeats a corner in each facet that has it; corners with the same coordinates become one vertex.
class SoupBuilder {
 public:
  void add_corner(const dvec3& point) {
    corners_.push_back(numbers_.number_of(point + 0.0, soup_.points));  // -0 becomes 0
  }
  void end_facet() {
    if (!names_) names_ = soup_.names.list({name_});
    soup_.names.give(soup_.polygons.size(), *names_);
    soup_.polygons.emplace_back(corners_.begin(), corners_.end());
    corners_.clear();
  }
  /// Of the facets that follow.
  void set_name(std::string_view name) {
    name_ = name;
    names_.reset();
  }
  PolygonSoup take() { return std::move(soup_); }

 private:
  PolygonSoup soup_;
  std::vector<std::uint32_t> corners_;
  std::string name_;
  std::optional<std::uint32_t> names_;
  PointNumbers numbers_;
};

std::uint64_t announced_facets(const MeshFile& file) {
  return number_at<std::uint32_t>(file.bytes.data() + header_bytes - sizeof(std::uint32_t));
}

PolygonSoup parse_binary(const MeshFile& file) {
  if (file.bytes.size() < header_bytes) file.reject("is too short for an STL file; export it again");
  const std::uint64_t facets = announced_facets(file);
  const std::uint64_t present = (file.bytes.size() - header_bytes) / facet_bytes;
  if (present > facets)
    file.reject(fmt::format("holds {} facets but announces {}; the count is damaged, export the mesh again", present, facets));
  if (present < facets)
    file.reject(fmt::format("holds {} of the {} facets it announces; it is cut short, export it again", present, facets));
  SoupBuilder soup;
  for (std::uint64_t facet = 0; facet < facets; ++facet) {
    std::array<float, 12> numbers;
    std::memcpy(numbers.data(), file.bytes.data() + header_bytes + facet * facet_bytes, sizeof numbers);
    if (!std::all_of(numbers.begin() + 3, numbers.end(), [](float x) { return std::isfinite(x); }))
      file.reject(fmt::format("facet {} has a coordinate that is not finite; correct it or export the mesh again", facet + 1));
    for (std::size_t i = 3; i < 12; i += 3) soup.add_corner({numbers[i], numbers[i + 1], numbers[i + 2]});
    soup.end_facet();
  }
  return soup.take();
}

/// The name behind `solid` or `endsolid`, which may be any text. Files of one line have facets or the next solid behind it.
std::string_view read_name(TextScanner& scanner, bool ends) {
  const std::string_view rest = scanner.rest_of_line();
  const std::string small = lower_case(rest);
  const std::size_t facet = small.find("facet normal");
  if (facet == std::string::npos) return rest;
  const std::size_t solid = ends ? small.rfind("solid", facet) : std::string::npos;
  const std::string_view name = rest.substr(0, std::min(facet, solid));
  scanner.read_again(rest.substr(name.size()));
  return name.substr(0, name.find_last_not_of(" \t") + 1);
}

PolygonSoup parse_text(const MeshFile& file) {
  TextScanner scanner(file);
  SoupBuilder soup;
  std::string last;
  int corners = 0;
  for (std::string word = lower_case(scanner.word_of_any_line()); !word.empty(); word = lower_case(scanner.word_of_any_line())) {
    last = word;
    if (corners > 0 && (word == "facet" || word == "endsolid"))
      scanner.reject("the facet before has no 'endfacet'; the file is damaged, export it again");
    if (word == "solid") {
      soup.set_name(read_name(scanner, false));
    } else if (word == "endsolid") {
      read_name(scanner, true);
      soup.set_name({});
    } else if (word == "normal") {
      for (int i = 0; i < 3; ++i) scanner.word_of_any_line();  // not used, and often NaN for slivers
    } else if (word == "vertex") {
      dvec3 point;
      for (int axis = 0; axis < 3; ++axis) point[axis] = scanner.coordinate(scanner.word_of_any_line());
      soup.add_corner(point);
      ++corners;
    } else if (word == "endfacet") {
      if (corners < 3) scanner.reject("a facet needs three vertices; the file is damaged, export it again");
      soup.end_facet();
      corners = 0;
    } else if (word != "facet" && word != "outer" && word != "loop" && word != "endloop") {
      scanner.reject(
          fmt::format("'{}' is not a word of the STL format; correct the line or export the mesh again", quotable(word)));
    }
  }
  if (last != "endsolid") scanner.reject("the file ends without 'endsolid'; it is cut short, export it again");
  PolygonSoup read = soup.take();
  read.digits = scanner.digits();
  return read;
}

/// Binary headers may start with "solid" as well; but then the size matches the facet count, or a zero byte appears early.
bool is_text(const MeshFile& file) {
  const std::size_t size = file.bytes.size();
  if (size >= header_bytes && size == header_bytes + facet_bytes * announced_facets(file)) return false;
  if (is_utf16(file.bytes)) return true;  // and refused as such
  if (without_padding(file.bytes).substr(0, 2 * header_bytes).find('\0') != std::string_view::npos) return false;
  TextScanner scanner(file);
  return lower_case(scanner.word_of_any_line()) == "solid";
}

}  // namespace

PolygonSoup parse_stl(const MeshFile& file) { return is_text(file) ? parse_text(file) : parse_binary(file); }

}  // namespace raytube
