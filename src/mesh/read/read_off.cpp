#include <fmt/format.h>

#include <string_view>

#include "core/text.h"
#include "mesh/files/text_scanner.h"
#include "mesh/read/formats.h"

namespace raytube {

namespace {

/// The keyword may announce colours, normals or texture (COFF, NOFF, STOFF), which follow the coordinates and are passed over.
void check_keyword(const TextScanner& scanner, std::string_view keyword) {
  if (keyword == "off") return;
  if (!keyword.ends_with("OFF") || keyword.find_first_of("4n") != std::string_view::npos)
    scanner.reject(
        fmt::format("'{}' is not the keyword of a three-dimensional OFF file; export the mesh as plain OFF", quotable(keyword)));
}

void require_line(TextScanner& scanner, const char* what, std::uint64_t index, std::uint64_t count) {
  if (!scanner.next_line())
    scanner.reject(fmt::format("the file ends after {} of {} {}; it is cut short, export it again", index, count, what));
}

dvec3 read_vertex(TextScanner& scanner) {
  dvec3 point;
  for (int axis = 0; axis < 3; ++axis) point[axis] = scanner.coordinate(scanner.word());
  return point;
}

std::vector<std::uint32_t> read_facet(TextScanner& scanner, std::uint64_t vertices) {
  const std::uint64_t corners = scanner.count(scanner.word());
  std::vector<std::uint32_t> polygon;
  for (std::uint64_t i = 0; i < corners; ++i) {
    const std::uint64_t vertex = scanner.count(scanner.word());
    if (vertex >= vertices)
      scanner.reject(
          fmt::format("vertex {} (counted from 0) does not exist, there are {}; export the mesh again", vertex, vertices));
    polygon.push_back(static_cast<std::uint32_t>(vertex));
  }
  return polygon;
}

}  // namespace

PolygonSoup parse_off(const MeshFile& file) {
  TextScanner scanner(file);
  scanner.next_line();
  std::string_view keyword = scanner.word(), word;
  if (const std::size_t end = keyword.find_last_not_of("0123456789"); end + 1 < keyword.size() && end != std::string_view::npos) {
    word = keyword.substr(end + 1);  // OFF8 6 0: the first count without a blank before it
    keyword.remove_suffix(word.size());
  }
  check_keyword(scanner, keyword);
  if (word.empty()) word = scanner.word_of_any_line();
  if (word == "BINARY") scanner.reject("binary OFF is not supported; export the mesh as text OFF or binary PLY");
  const std::uint64_t vertices = scanner.count(word);
  const std::uint64_t facets = scanner.count(scanner.word_of_any_line());

  PolygonSoup soup;
  for (std::uint64_t i = 0; i < vertices; ++i) {
    require_line(scanner, "vertices", i, vertices);
    soup.points.push_back(read_vertex(scanner));
  }
  for (std::uint64_t i = 0; i < facets; ++i) {
    require_line(scanner, "facets", i, facets);
    soup.polygons.push_back(read_facet(scanner, vertices));
  }
  if (scanner.next_line())
    scanner.reject(fmt::format("more lines than the {} vertices and {} facets announced; correct the counts, or export it again",
                               vertices, facets));
  soup.digits = scanner.digits();
  return soup;
}

}  // namespace raytube
