#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include "core/error.h"
#include "gzipped.h"
#include "unit/mesh_shapes.h"

namespace raytube::shapes {
namespace {

/// Mesh files in a folder of their own, removed in the end.
class MeshRead : public ::testing::Test {
 protected:
  MeshRead() { std::filesystem::create_directories(folder_); }
  ~MeshRead() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }

  PolygonSoup read(const std::string& name, const std::string& bytes) const { return read_polygon_soup(write(name, bytes)); }

  /// The sentence for a bad file; it always names the file and fits one line.
  std::string complaint(const std::string& name, const std::string& bytes) const {
    try {
      read(name, bytes);
    } catch (const InputError& error) {
      const std::string sentence = error.what();
      EXPECT_NE(sentence.find(name), std::string::npos) << sentence;
      EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
      return sentence;
    }
    return "accepted";
  }

  std::filesystem::path folder_ = std::filesystem::temp_directory_path() / ("raytube_mesh_read_" + std::to_string(getpid()));
};

template <class Number>
std::string bytes_of(Number number, bool swapped = false) {
  std::string bytes(sizeof number, '\0');
  std::memcpy(bytes.data(), &number, sizeof number);
  return swapped ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

std::string text(double x) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.17g", x);
  return buffer;
}

std::string text(const dvec3& p) { return text(p.x) + " " + text(p.y) + " " + text(p.z); }

std::string stl_text(const PolygonSoup& soup) {
  std::string file = "solid test\n";
  for (const Polygon& polygon : soup.polygons) {
    file += " facet normal nan nan nan\n  outer loop\n";
    for (const std::uint32_t v : polygon) file += "   vertex " + text(soup.points[v]) + "\n";
    file += "  endloop\n endfacet\n";
  }
  return file + "endsolid test\n";
}

std::string stl_binary(const PolygonSoup& soup, std::string header = "a header") {
  header.resize(80, ' ');
  std::string file = header + bytes_of(static_cast<std::uint32_t>(soup.polygons.size()));
  for (const Polygon& polygon : soup.polygons) {
    file += std::string(12, '\0');
    for (const std::uint32_t v : polygon)
      for (int axis = 0; axis < 3; ++axis) file += bytes_of(static_cast<float>(soup.points[v][axis]));
    file += std::string(2, '\0');
  }
  return file;
}

std::string obj_text(const PolygonSoup& soup) {
  std::string file = "# a comment\nmtllib missing.mtl\no thing\n";
  for (const dvec3& p : soup.points) file += "v " + text(p) + "\nvt 0 0\nvn 0 0 1\n";
  file += "g group\nusemtl nothing\ns off\n";
  for (const Polygon& polygon : soup.polygons) {
    file += "f";
    for (const std::uint32_t v : polygon) file += " " + std::to_string(v + 1) + "/1/1";
    file += "\n";
  }
  return file;
}

std::string off_text(const PolygonSoup& soup) {
  std::string file =
      "OFF # keyword\n# counts\n" + std::to_string(soup.points.size()) + " " + std::to_string(soup.polygons.size()) + " 0\n\n";
  for (const dvec3& p : soup.points) file += text(p) + " # a vertex\n";
  for (const Polygon& polygon : soup.polygons) {
    file += std::to_string(polygon.size());
    for (const std::uint32_t v : polygon) file += " " + std::to_string(v);
    file += " 255 0 0\n";
  }
  return file;
}

enum class Ply { ascii, little, big };

std::string ply(const PolygonSoup& soup, Ply format, bool doubles = true) {
  const char* names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
  const std::string type = doubles ? "double" : "float";
  std::string file = std::string("ply\nformat ") + names[static_cast<int>(format)] + " 1.0\ncomment by hand\nobj_info none\n" +
                     "element vertex " + std::to_string(soup.points.size()) + "\nproperty uchar red\nproperty " + type +
                     " x\nproperty " + type + " y\nproperty " + type + " z\nproperty list uchar float extra\nelement edge 1\n" +
                     "property int vertex1\nelement face " + std::to_string(soup.polygons.size()) +
                     "\nproperty list uchar uint vertex_indices\nproperty float quality\nend_header\n";
  const bool ascii = format == Ply::ascii, swapped = format == Ply::big;
  const auto put = [&](auto number) { file += ascii ? text(double(number)) + " " : bytes_of(number, swapped); };
  const auto put_real = [&](double x) { doubles ? put(x) : put(static_cast<float>(x)); };
  for (const dvec3& p : soup.points) {
    put(std::uint8_t{200});
    for (int axis = 0; axis < 3; ++axis) put_real(p[axis]);
    put(std::uint8_t{1});
    put(0.5f);
    if (ascii) file += "\n";
  }
  put(std::int32_t{-7});
  for (const Polygon& polygon : soup.polygons) {
    if (ascii) file += "\n";
    put(static_cast<std::uint8_t>(polygon.size()));
    for (const std::uint32_t v : polygon) put(v);
    put(1.0f);
  }
  return file;
}

/// Triangles, quads and a hexagon, with coordinates that need all their digits.
PolygonSoup sample() {
  PolygonSoup soup = moved(prism({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}, 0.1), skew_rotation(), {1e-9, 1e5, 0.3});
  soup.polygons.push_back({0, 5, 9});
  return soup;
}

PolygonSoup triangles() { return {sample().points, {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}}}; }

void expect_same(const PolygonSoup& read, const PolygonSoup& written) {
  EXPECT_EQ(read.polygons, written.polygons);
  ASSERT_EQ(read.points.size(), written.points.size());
  for (std::size_t i = 0; i < read.points.size(); ++i) EXPECT_EQ(read.points[i], written.points[i]);  // to the bit
}

std::string with_crlf(std::string file) {
  for (std::size_t i = 0; (i = file.find('\n', i)) != std::string::npos; i += 2) file.insert(i, "\r");
  return file;
}

TEST_F(MeshRead, EveryFormatKeepsEveryBit) {
  expect_same(read("a.obj", obj_text(sample())), sample());
  expect_same(read("a.off", off_text(sample())), sample());
  for (const Ply format : {Ply::ascii, Ply::little, Ply::big}) {
    expect_same(read("a.ply", ply(sample(), format)), sample());
    if (format != Ply::ascii) expect_same(read("a.ply", ply(sample(), format, false)), in_single_precision(sample()));
  }
  expect_same(read("a.stl", stl_text(triangles())), triangles());
  expect_same(read("a.stl", stl_binary(triangles())), in_single_precision(triangles()));
}

TEST_F(MeshRead, LineEndsDoNotMatter) {
  expect_same(read("a.obj", with_crlf(obj_text(sample()))), sample());
  expect_same(read("a.off", with_crlf(off_text(sample()))), sample());
  expect_same(read("a.ply", with_crlf(ply(sample(), Ply::ascii))), sample());
  expect_same(read("a.stl", with_crlf(stl_text(triangles()))), triangles());
  std::string mac = obj_text(sample());
  std::replace(mac.begin(), mac.end(), '\n', '\r');
  expect_same(read("a.obj", mac), sample());
  expect_same(read("a.obj", "\xEF\xBB\xBF" + obj_text(sample())), sample());
}

TEST_F(MeshRead, EndingsAreNotCaseSensitive) { expect_same(read("A.STL", stl_text(triangles())), triangles()); }

TEST_F(MeshRead, StlVariants) {
  std::string upper = stl_text(triangles());
  for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  expect_same(read("a.stl", upper), triangles());
  expect_same(read("a.stl", " \n\t" + stl_text(triangles())), triangles());
  expect_same(read("a.stl", "solid facet vertex of # nothing\n" + stl_text(triangles()).substr(11)), triangles());
  expect_same(read("a.stl", stl_binary(triangles(), "solid made by a program")), in_single_precision(triangles()));
  expect_same(read("a.stl", stl_binary(triangles(), "solid ") + "trailing"), in_single_precision(triangles()));
  EXPECT_EQ(read("a.stl", stl_text(triangles()) + stl_text(triangles())).polygons.size(), 8u);  // two solids in one file
}

TEST_F(MeshRead, ObjVariants) {
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  const auto facets = [&](const std::string& lines) { return read("a.obj", corners + lines).polygons; };
  using Polygons = std::vector<Polygon>;
  EXPECT_EQ(facets("f 1 2 3 4\n"), (Polygons{{0, 1, 2, 3}}));
  EXPECT_EQ(facets("f 1/5 2/5/6 3//6"), (Polygons{{0, 1, 2}}));
  EXPECT_EQ(facets("f -4 -3 -2\nv 5 5 5\nf -1 -2 -3\n"), (Polygons{{0, 1, 2}, {4, 3, 2}}));
  EXPECT_EQ(facets("  f\t1\t2\t3  # comment\n"), (Polygons{{0, 1, 2}}));
  EXPECT_EQ(facets("f 1 2 \\\n 3\nf 2 3\\\n 4\n"), (Polygons{{0, 1, 2}, {1, 2, 3}}));
  EXPECT_EQ(facets("l 1 2\np 3\nf 1 2 3\n"), (Polygons{{0, 1, 2}}));
  EXPECT_EQ(facets("f 1 2 5\nv 9 9 9\n"), (Polygons{{0, 1, 4}}));  // vertices may follow
  EXPECT_EQ(read("a.obj", "v 1 2 3 1.0\nv +4e0 -.5 6. 0.1 0.2 0.3\nv 1e-400 0 0\nf 1 2 3\n").points[1], dvec3(4, -0.5, 6));
}

/// Those of each polygon, one after the other.
std::vector<std::string> names(const PolygonSoup& soup) {
  std::vector<std::string> result;
  for (std::size_t i = 0; i < soup.polygons.size(); ++i) {
    std::string& all = result.emplace_back();
    for (const std::uint32_t index : soup.names.of(i)) all += "<" + soup.names.all()[index] + ">";
  }
  return result;
}

using Names = std::vector<std::string>;

TEST_F(MeshRead, ObjNames) {
  const std::string file =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n"
      "g hull left # port\no  mast 1 \nusemtl Material #25\nf 1 2 3\nf 2 3 1\n"
      "g nowhere\ng\nf 1 2 3\no\nusemtl\r\nf 1 2 3\n"
      "g left \\\n hull hull\nusemtl left\nf 1 2 3\n";
  const PolygonSoup soup = read("a.obj", file);
  EXPECT_EQ(names(soup), (Names{"", "<hull><left><mast 1><Material #25>", "<hull><left><mast 1><Material #25>",
                                "<mast 1><Material #25>", "", "<hull><left>"}));
  EXPECT_EQ(soup.names.all(), (Names{"hull", "left", "mast 1", "Material #25"}));
}

TEST_F(MeshRead, StlNames) {
  const auto solid = [](const std::string& name) {
    const std::string facet = "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
    return "solid" + name + "\n" + facet + facet + "endsolid" + name + "\n";
  };
  const PolygonSoup soup = read("a.stl", solid(" nose  cone #1 ") + solid("") + "solid empty\nendsolid\n" + solid("\tWing\r"));
  EXPECT_EQ(names(soup), (Names{"<nose  cone #1>", "<nose  cone #1>", "", "", "<Wing>", "<Wing>"}));
  EXPECT_EQ(soup.names.all(), (Names{"nose  cone #1", "Wing"}));
  EXPECT_EQ(names(read("b.stl", stl_binary(triangles(), "solid made by a program"))), Names(4));
}

TEST_F(MeshRead, SeveralFilesAreOneTarget) {
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  PolygonSoup whole = read("a.obj", corners + "f 1 2 3\ng wing\nf 1 2 3\n"), part = read("b.obj", corners + "g wing\nf 3 2 1\n");
  add_name(whole, "a.obj");
  add_name(part, "b.obj");
  add_polygons(part, whole);
  add_polygons(read("c.off", "OFF 3 1 0\n5 0 0\n6 0 0\n6 1 0\n3 0 1 2\n"), whole);
  EXPECT_EQ(whole.polygons, (std::vector<Polygon>{{0, 1, 2}, {0, 1, 2}, {5, 4, 3}, {6, 7, 8}}));
  EXPECT_EQ(whole.points[8], dvec3(6, 1, 0));
  EXPECT_EQ(names(whole), (Names{"<a.obj>", "<wing><a.obj>", "<wing><b.obj>", ""}));
  EXPECT_EQ(whole.names.all(), (Names{"wing", "a.obj", "b.obj"}));
  EXPECT_TRUE(whole.materials.empty());
  part.materials = {7};
  add_polygons(part, whole);
  add_polygons(read("d.obj", corners + "f 1 2 3\n"), whole);
  EXPECT_EQ(whole.materials, (std::vector<std::uint32_t>{no_index, no_index, no_index, no_index, 7, no_index}));
}

TEST_F(MeshRead, OffVariants) {
  const PolygonSoup soup = read("a.off", "COFF 3 1 0\n0 0 0 0 0 255\n\n1 0 0 0 0 255\n0 1 0 0 0 255\n3 0 1 2\n");
  EXPECT_EQ(soup.polygons.size(), 1u);
  EXPECT_EQ(soup.points[1], dvec3(1, 0, 0));
}

TEST_F(MeshRead, PlyVariants) {
  const std::string head =
      "ply\ncomment before the format\nformat ascii 1.0\nelement face 1\nproperty list int short vertex_index\n";
  EXPECT_EQ(read("a.ply", head + "element vertex 3\nproperty int x\nproperty int z\nproperty int y\nend_header\n"
                                 "3 0 1 2\n1 3 2\n4 6 5 7 8 9\n")
                .points[0],
            dvec3(1, 2, 3));
}

TEST_F(MeshRead, FilesThatCannotBeOpened) {
  EXPECT_THROW(read_polygon_soup(folder_ / "absent.stl"), InputError);
  EXPECT_THROW(read_polygon_soup(folder_), InputError);
  std::filesystem::create_directory(folder_ / "folder.obj");
  EXPECT_THROW(read_polygon_soup(folder_ / "folder.obj"), InputError);
  EXPECT_NE(complaint("a.step", "x").find(".stl, .obj, .ply, .off, .msh, .gltf, .glb or .3mf"), std::string::npos);
  EXPECT_NE(complaint("mesh", "x").find(".stl, .obj, .ply, .off, .msh, .gltf, .glb or .3mf"), std::string::npos);
}

TEST_F(MeshRead, EmptyAndFacetlessFiles) {
  for (const char* name : {"a.stl", "a.obj", "a.ply", "a.off"}) {
    EXPECT_NE(complaint(name, ""), "accepted");
    EXPECT_NE(complaint(name, "\n"), "accepted");
    EXPECT_NE(complaint(name, "rubbish"), "accepted");
    EXPECT_NE(complaint(name, std::string(300, '\0')), "accepted");
  }
  EXPECT_NE(complaint("a.obj", "v 0 0 0\n").find("no facets"), std::string::npos);
  EXPECT_NE(complaint("a.stl", "solid\nendsolid\n").find("no facets"), std::string::npos);
  EXPECT_NE(complaint("a.off", "OFF\n1 0 0\n0 0 0\n").find("no facets"), std::string::npos);
  EXPECT_NE(complaint("a.stl", stl_binary({})).find("no facets"), std::string::npos);
}

TEST_F(MeshRead, SentencesNameTheLine) {
  EXPECT_NE(complaint("a.obj", "v 0 0 0\nv 1 x 0\n").find("line 2: 'x' is not a number"), std::string::npos);
  EXPECT_NE(complaint("a.obj", "v 0 0 0\nv 1 0\n").find("line 2"), std::string::npos);
  EXPECT_NE(complaint("a.obj", "v 0 0 nan\n").find("line 1: the coordinate 'nan' is not finite"), std::string::npos);
  EXPECT_NE(complaint("a.obj", "v 0 0 1e999\n").find("not finite"), std::string::npos);
  EXPECT_NE(complaint("a.obj", "v 0 0 0\n\nf 1 1 2\n").find("line 3: vertex 2 does not exist"), std::string::npos);
  EXPECT_NE(complaint("a.obj", "v 0 0 0\nf 1 0 1\n").find("line 2"), std::string::npos);
  EXPECT_NE(complaint("a.obj", "v 0 0 0\nf 1 -2 1\n").find("line 2"), std::string::npos);
  EXPECT_NE(complaint("a.obj", "v 0 0 0\nf 1 99999999999999999999 1\n").find("line 2"), std::string::npos);
  EXPECT_NE(complaint("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n").find("line 6: vertex 3"), std::string::npos);
  EXPECT_NE(complaint("a.off", "OFF\n-3 1 0\n").find("line 2"), std::string::npos);
  EXPECT_NE(complaint("a.off", "4OFF\n3 1 0\n").find("line 1"), std::string::npos);
  EXPECT_NE(complaint("a.off", "OFF BINARY\n").find("binary OFF"), std::string::npos);
  EXPECT_NE(complaint("a.stl", "solid\nfacet\nvertex 0 0 0\nvertex 1 0\nendfacet\n").find("line 5"), std::string::npos);
  EXPECT_NE(complaint("a.stl", "solid\nfacet\nvertex 0 0 0\nendfacet\n").find("line 4"), std::string::npos);
  EXPECT_NE(complaint("a.stl", "solid\nfaset\n").find("line 2: 'faset'"), std::string::npos);
}

TEST_F(MeshRead, BinaryFilesWithBadNumbers) {
  PolygonSoup soup = triangles();
  soup.points[4].y = std::numeric_limits<double>::infinity();
  EXPECT_NE(complaint("a.stl", stl_binary(soup)).find("facet 2"), std::string::npos);
  EXPECT_NE(complaint("a.ply", ply(soup, Ply::little)).find("vertex 5"), std::string::npos);
  soup = triangles();
  soup.polygons[1][2] = 12;
  EXPECT_NE(complaint("a.ply", ply(soup, Ply::big)).find("facet 2 names vertex 12"), std::string::npos);
  const std::string head =
      "ply\nformat binary_little_endian 1.0\nelement face 1\nproperty list uint int vertex_indices\nend_header\n";
  EXPECT_NE(complaint("a.ply", head + std::string(40, '\xff')), "accepted");
  EXPECT_NE(complaint("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n").find("lack"),
            std::string::npos);
  EXPECT_NE(complaint("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\nend_header\n0\n").find("line 4"),
            std::string::npos);
}

/// Cut anywhere, a file is refused, unless only its last line's end is missing or what follows the last facet.
TEST_F(MeshRead, TruncatedFilesAreRefused) {
  const auto refuses_cuts = [&](const std::string& name, const std::string& bytes, std::size_t longest) {
    for (std::size_t size = longest % 7; size <= longest; size += 7)
      ASSERT_NE(complaint(name, bytes.substr(0, size)), "accepted") << name << " cut to " << size << " of " << bytes.size();
  };
  const std::string binary = stl_binary(triangles()), ascii = stl_text(triangles()), off = off_text(triangles());
  refuses_cuts("a.stl", binary, binary.size() - 1);
  refuses_cuts("a.stl", ascii, ascii.size() - 7);  // up to "endsoli"
  refuses_cuts("a.off", off, off.rfind('\n', off.size() - 2));
  refuses_cuts("a.ply", ply(triangles(), Ply::little), ply(triangles(), Ply::little).size() - 1);
}

/// The same rotated cube through every format gives the same mesh; what a format rounds shows in its last digits only.
TEST_F(MeshRead, FormatsAgreeOnTheMesh) {
  const PolygonSoup soup = moved(remeshed(cube(), 3, 3), skew_rotation());
  const auto load = [&](const std::string& name, const std::string& bytes) { return load_mesh(write(name, bytes), 1e-3); };
  const LoadedMesh reference = load("a.obj", obj_text(soup));
  expect_consistent(reference);
  for (const LoadedMesh& other :
       {load("b.off", off_text(soup)), load("c.ply", ply(soup, Ply::little)), load("d.stl", stl_text(soup))}) {
    EXPECT_EQ(other.mesh.vertices, reference.mesh.vertices);
    EXPECT_EQ(other.mesh.triangles, reference.mesh.triangles);
  }
  const LoadedMesh rounded = load("e.stl", stl_binary(soup));
  EXPECT_EQ(rounded.report.patches, 6u);
  EXPECT_EQ(wedges_of(rounded).size(), 12u);
}

TEST_F(MeshRead, GzipIsUnpacked) {
  const std::string off = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n",
                    obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";
  const PolygonSoup plain = read("a.off", off);
  const std::string several = testing::gzipped(off.substr(0, 11)) + testing::gzipped("") + testing::gzipped(off.substr(11));
  for (const PolygonSoup& packed :
       {read("a.off.gz", testing::gzipped(off)), read("B.OFF.GZ", testing::gzipped(off)), read("c.off.gz", several),
        read("d.off.gz", several + std::string(512, '\0')), read("e.obj.gz", testing::gzipped(obj))}) {
    EXPECT_EQ(packed.points, plain.points);
    EXPECT_EQ(packed.polygons, plain.polygons);
  }
}

TEST_F(MeshRead, GzipOfALargeRegularMeshIsNoBomb) {
  // A flat grid in rows of text: the same digits again and again.
  std::string obj;
  for (int i = 0; i < 300; ++i)
    for (int k = 0; k < 300; ++k) obj += "v " + std::to_string(k) + " " + std::to_string(i) + " 0\n";
  for (int i = 1; i < 90000 - 301; ++i)
    obj += "f " + std::to_string(i) + " " + std::to_string(i + 1) + " " + std::to_string(i + 301) + "\n";
  EXPECT_EQ(read("grid.obj.gz", testing::gzipped(obj)).points.size(), 90000u);
}

}  // namespace
}  // namespace raytube::shapes
