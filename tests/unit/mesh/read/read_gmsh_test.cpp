// Gmsh meshes against the polygons they were written from. The writers below follow the reference manual ("MSH file format"), and
// files that Gmsh 4.8 itself wrote are in tests/fuzz/corpus/gmsh.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "core/error.h"
#include "scratch.h"
#include "unit/mesh_shapes.h"

namespace raytube::shapes {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::Scratch;

/// How a file writes its numbers.
enum class Gmsh { text, little, big };

class GmshWriter {
 public:
  explicit GmshWriter(Gmsh kind) : kind_(kind) {}

  void line(const std::string& text) { file_ += text + "\n"; }
  void integer(std::int32_t value) { put(value, std::to_string(value)); }
  void size(std::uint64_t value) { put(value, std::to_string(value)); }
  void real(double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.17g", value);
    put(value, buffer);
  }
  void end(const std::string& section) { file_ += "\n$End" + section + "\n"; }
  void head(const std::string& version) {
    line("$MeshFormat\n" + version + (kind_ == Gmsh::text ? " 0 8" : " 1 8"));
    if (kind_ != Gmsh::text) integer(1);
    end("MeshFormat");
    line("$PhysicalNames\n3\n1 1 \"border\"\n2 1 \"front side #1\"\n2 4 \"\\\"\"\n$EndPhysicalNames");
  }
  bool is_binary() const { return kind_ != Gmsh::text; }
  const std::string& file() const { return file_; }

 private:
  template <class Number>
  void put(Number value, const std::string& text) {
    if (kind_ == Gmsh::text) {
      file_ += text + (file_.size() % 3 ? " " : "\n");  // blanks and line ends are alike
      return;
    }
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    if (kind_ == Gmsh::big) std::reverse(bytes, bytes + sizeof value);
    file_.append(bytes, sizeof value);
  }

  Gmsh kind_;
  std::string file_;
};

/// Quads and a triangle, with coordinates that need all their digits.
PolygonSoup quads_and_triangle() {
  PolygonSoup soup = moved(cube(), skew_rotation(), {1e-9, 1e5, 0.3});
  soup.polygons.push_back({0, 5, 7});
  return soup;
}

std::int32_t type_of(const Polygon& polygon) { return polygon.size() == 3 ? 2 : 3; }

std::uint32_t node_of(std::uint32_t corner) { return 10 + 3 * corner; }

/// Nodes have gaps in their numbers. Polygon i is in the physical group i % 3, of which 0 is none, and 2 has no name.
std::string gmsh_2(const PolygonSoup& soup, Gmsh kind) {
  GmshWriter out(kind);
  out.head("2.2");
  out.line("$Nodes\n" + std::to_string(soup.points.size()));
  for (std::uint32_t i = 0; i < soup.points.size(); ++i) {
    out.integer(static_cast<std::int32_t>(node_of(i)));
    for (int axis = 0; axis < 3; ++axis) out.real(soup.points[i][axis]);
  }
  out.end("Nodes");
  out.line("$Elements\n" + std::to_string(soup.polygons.size() + 1));
  const auto element = [&](std::int32_t number, std::int32_t type, std::int32_t group, const Polygon& corners) {
    for (const std::int32_t value : out.is_binary() ? std::vector{type, 1, 2, number} : std::vector{number, type, 2})
      out.integer(value);
    out.integer(group);
    out.integer(17);  // the entity
    for (const std::uint32_t corner : corners) out.integer(static_cast<std::int32_t>(node_of(corner)));
  };
  element(1, 1, 1, {0, 1});  // a line, which is no facet
  for (std::size_t i = 0; i < soup.polygons.size(); ++i)
    element(static_cast<std::int32_t>(i + 2), type_of(soup.polygons[i]), static_cast<std::int32_t>(i % 3), soup.polygons[i]);
  out.end("Elements");
  return out.file();
}

/// The same of surfaces 50, 51 and 52, which are in no group, in group 1, and in the groups 2 and 4. Each polygon is a block.
std::string gmsh_4(const PolygonSoup& soup, Gmsh kind) {
  GmshWriter out(kind);
  out.head("4.1");
  out.line("$Entities");
  for (const std::uint64_t count : {1, 1, 3, 0}) out.size(count);
  out.integer(1);
  for (int i = 0; i < 3; ++i) out.real(0.5);
  out.size(0);
  const auto entity = [&](std::int32_t tag, const std::vector<std::int32_t>& groups) {
    out.integer(tag);
    for (int i = 0; i < 6; ++i) out.real(-0.5);
    out.size(groups.size());
    for (const std::int32_t group : groups) out.integer(group);
    out.size(1);
    out.integer(-1);
  };
  entity(50, {4});  // a curve of the same number as a surface
  entity(50, {});
  entity(51, {-1});
  entity(52, {2, 4});
  out.end("Entities");
  out.line("$Nodes");
  const std::uint64_t points = soup.points.size();
  for (const std::uint64_t value : {std::uint64_t{2}, points, std::uint64_t{10}, std::uint64_t{100}}) out.size(value);
  const auto block = [&](std::int32_t parametric, std::uint32_t begin, std::uint32_t end) {
    for (const std::int32_t value : {2, 50, parametric}) out.integer(value);
    out.size(end - begin);
    for (std::uint32_t i = begin; i < end; ++i) out.size(node_of(i));
    for (std::uint32_t i = begin; i < end; ++i)
      for (int k = 0; k < 3 + 2 * parametric; ++k) out.real(k < 3 ? soup.points[i][k] : 0.25);
  };
  block(0, 0, 5);
  block(1, 5, static_cast<std::uint32_t>(points));
  out.end("Nodes");
  out.line("$Elements");
  for (const std::uint64_t value : {soup.polygons.size() + 1, soup.polygons.size() + 1, std::size_t{1}, std::size_t{100}})
    out.size(value);
  for (const std::int32_t value : {1, 50, 1}) out.integer(value);
  for (const std::uint64_t value : {1u, 1u, node_of(0), node_of(1)}) out.size(value);
  for (std::size_t i = 0; i < soup.polygons.size(); ++i) {
    for (const std::int32_t value : {2, 50 + static_cast<std::int32_t>(i % 3), type_of(soup.polygons[i])}) out.integer(value);
    out.size(1);
    out.size(i + 2);
    for (const std::uint32_t corner : soup.polygons[i]) out.size(node_of(corner));
  }
  out.end("Elements");
  out.line("$NodeData\n1\n\"a # b\"\n$EndNodeData");
  return out.file();
}

std::vector<std::string> names_of(const PolygonSoup& soup, std::size_t polygon) {
  std::vector<std::string> names;
  for (const std::uint32_t name : soup.names.of(polygon)) names.push_back(soup.names.all()[name]);
  return names;
}

void expect_equal(const PolygonSoup& read, const PolygonSoup& written) {
  EXPECT_EQ(read.polygons, written.polygons);
  EXPECT_EQ(read.points, written.points);  // to the bit: 17 digits give a double back
  EXPECT_FALSE(read.stated_unit);
}

constexpr Gmsh all_kinds[] = {Gmsh::text, Gmsh::little, Gmsh::big};

TEST(MeshReadGmsh, Version2KeepsFacetsOrderAndGroups) {
  const Scratch scratch;
  for (const Gmsh kind : all_kinds) {
    const PolygonSoup soup = read_polygon_soup(scratch.write("a.msh", gmsh_2(quads_and_triangle(), kind)));
    expect_equal(soup, quads_and_triangle());
    EXPECT_THAT(names_of(soup, 0), ElementsAre());
    EXPECT_THAT(names_of(soup, 1), ElementsAre("front side #1"));
    EXPECT_THAT(names_of(soup, 2), ElementsAre("2"));
    EXPECT_THAT(names_of(soup, 6), ElementsAre());
  }
}

TEST(MeshReadGmsh, Version4KeepsFacetsOrderAndGroups) {
  const Scratch scratch;
  for (const Gmsh kind : all_kinds) {
    const PolygonSoup soup = read_polygon_soup(scratch.write("a.msh", gmsh_4(quads_and_triangle(), kind)));
    expect_equal(soup, quads_and_triangle());
    EXPECT_THAT(names_of(soup, 0), ElementsAre());
    EXPECT_THAT(names_of(soup, 4), ElementsAre("front side #1"));
    EXPECT_THAT(names_of(soup, 5), ElementsAre("2", "\\\""));
  }
}

/// What Gmsh wrote: a cube of 24 triangles in two groups that share a side, which version 2 writes once for each.
TEST(MeshReadGmsh, FilesOfGmshItself) {
  const Scratch scratch;
  for (const auto& [name, facets] : {std::pair{"text_4", 24u}, {"binary_4", 24u}, {"text_2", 28u}, {"binary_2", 28u}}) {
    const std::string corpus = RAYTUBE_SOURCE_DIR "/tests/fuzz/corpus/gmsh/";
    const LoadedMesh loaded = load_mesh(scratch.write("a.msh", testing::text_of(corpus + name)), 1.0);
    EXPECT_EQ(loaded.report.facets_read, facets) << name;
    EXPECT_EQ(loaded.report.triangles_traced, 24u) << name;
    EXPECT_EQ(loaded.report.open_edges, 0u) << name;
    EXPECT_EQ(wedges_of(loaded).size(), 12u) << name;
  }
}

/// Cut anywhere before its last facet, a file is refused.
TEST(MeshReadGmsh, TruncatedFilesAreRefused) {
  const Scratch scratch;
  for (const Gmsh kind : all_kinds)
    for (const std::string& file : {gmsh_2(quads_and_triangle(), kind), gmsh_4(quads_and_triangle(), kind)})
      for (std::size_t size = 1; size < file.rfind("$EndElements") - 3; size += 5)
        EXPECT_THROW(read_polygon_soup(scratch.write("a.msh", file.substr(0, size))), InputError) << size;
}

}  // namespace
}  // namespace raytube::shapes
