// Meshes in scenes, glTF and 3MF: parts that stand where nodes, components and items put them.
#include <gmock/gmock.h>

#include <cstring>

#include "core/error.h"
#include "scratch.h"
#include "unit/mesh_shapes.h"
#include "zipped.h"

namespace raytube::shapes {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::packed_3mf;
using testing::Scratch;

template <class... Numbers>
std::string packed(Numbers... numbers) {
  std::string bytes;
  (bytes.append(reinterpret_cast<const char*>(&numbers), sizeof numbers), ...);
  return bytes;
}

/// A unit square of four corners, the last of them raised in the sparse one.
std::string square_buffer() {
  using i16 = std::int16_t;
  std::string bytes;
  for (const auto& [x, y] : {std::pair{0.f, 0.f}, {1.f, 0.f}, {0.f, 1.f}, {1.f, 1.f}}) bytes += packed(x, y, 0.f);  // 0
  bytes += packed(std::uint16_t{0}, std::uint16_t{1}, std::uint16_t{2}, std::uint16_t{3});                          // 48
  bytes += packed(std::uint16_t{3}, std::uint16_t{0}, 1.f, 1.f, 0.5f);                                              // 56
  for (const auto& [x, y] : {std::pair<i16, i16>{0, 0}, {32767, 0}, {0, -32768}, {16384, 1}})
    bytes += packed(x, y, i16{0}, i16{7});  // 72
  return bytes;
}

std::string gltf(const std::string& nodes, const std::string& primitives, const std::string& uri = "") {
  const std::string buffer = uri.empty() ? "" : "\"uri\": \"" + uri + "\", ";
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [)" + nodes + R"(],
    "meshes": [{"name": "square", "primitives": [)" +
         primitives + R"(]}], "materials": [{"name": "paint"}],
    "buffers": [{)" +
         buffer + R"("byteLength": 104}],
    "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 8},
      {"buffer": 0, "byteOffset": 56, "byteLength": 2}, {"buffer": 0, "byteOffset": 60, "byteLength": 12},
      {"buffer": 0, "byteOffset": 72, "byteLength": 32, "byteStride": 8}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
      {"bufferView": 1, "componentType": 5123, "count": 4, "type": "SCALAR"},
      {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "sparse": {"count": 1,
        "indices": {"bufferView": 2, "componentType": 5123}, "values": {"bufferView": 3}}},
      {"bufferView": 4, "componentType": 5122, "normalized": true, "count": 4, "type": "VEC3"}]})";
}

std::string glb(std::string json) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::string buffer = square_buffer();
  const auto size = [](const std::string& text) { return static_cast<std::uint32_t>(text.size()); };
  return "glTF" + packed(2u, 28u + size(json) + size(buffer), size(json)) + "JSON" + json + packed(size(buffer)) +
         std::string("BIN\0", 4) + buffer;
}

std::string primitive(int accessor, const std::string& more) {
  return R"({"attributes": {"POSITION": )" + std::to_string(accessor) + "}" + more + "}";
}

std::vector<std::string> all_names_of(const PolygonSoup& soup, std::size_t polygon) {
  std::vector<std::string> names;
  for (const std::uint32_t name : soup.names.of(polygon)) names.push_back(soup.names.all()[name]);
  return names;
}

const std::string strip = R"(, "indices": 1, "mode": 5, "material": 0)", plain_node = R"({"name": "plate", "mesh": 0})";
const std::vector<Polygon> strip_facets = {{0, 1, 2}, {1, 3, 2}};

PolygonSoup read_glb(const std::string& json) {
  const Scratch scratch;
  return read_polygon_soup(scratch.write("a.glb", glb(json)));
}

TEST(MeshReadGltf, StripsFansAndTriangles) {
  const PolygonSoup soup = read_glb(gltf(plain_node, primitive(0, strip)));
  EXPECT_THAT(soup.points, ElementsAre(dvec3(0), dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(1, 1, 0)));
  EXPECT_EQ(soup.polygons, strip_facets);
  EXPECT_THAT(all_names_of(soup, 1), ElementsAre("plate", "square", "paint"));
  EXPECT_EQ(soup.stated_unit->name, "m");
  EXPECT_EQ(read_glb(gltf(plain_node, primitive(0, R"(, "mode": 6)"))).polygons, (std::vector<Polygon>{{1, 2, 0}, {2, 3, 0}}));
  EXPECT_EQ(read_glb(gltf(plain_node, primitive(0, R"(, "mode": 1)") + "," + primitive(0, strip))).polygons, strip_facets);
}

TEST(MeshReadGltf, SparseAndQuantizedNumbers) {
  EXPECT_THAT(read_glb(gltf(plain_node, primitive(2, strip))).points,
              ElementsAre(dvec3(0), dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(1, 1, 0.5)));
  EXPECT_THAT(read_glb(gltf(plain_node, primitive(3, strip))).points,
              ElementsAre(dvec3(0), dvec3(1, 0, 0), dvec3(0, -1, 0), dvec3(16384 / 32767.0, 1 / 32767.0, 0)));
}

/// A millimetre at a kilometre from the origin: in single precision it would be 2 % off. The second instance is a mirror image.
TEST(MeshReadGltf, NodesPlaceInstancesInDoublePrecision) {
  const std::string nodes = R"({"name": "car", "translation": [1000, 0, 0], "children": [1, 2]},
    {"name": "door", "mesh": 0, "scale": [0.001, 0.001, 0.001]},
    {"mesh": 0, "matrix": [0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1]})";
  const PolygonSoup soup = read_glb(gltf(nodes, primitive(0, strip)));
  ASSERT_EQ(soup.points.size(), 8u);
  EXPECT_EQ(soup.points[3], dvec3(1000.001, 0.001, 0));
  EXPECT_EQ(soup.points[5], dvec3(1005, 7, 7));
  EXPECT_EQ(soup.polygons, (std::vector<Polygon>{{0, 1, 2}, {1, 3, 2}, {4, 6, 5}, {5, 6, 7}}));
  EXPECT_THAT(all_names_of(soup, 0), ElementsAre("car", "door", "square", "paint"));
  EXPECT_THAT(all_names_of(soup, 3), ElementsAre("car", "square", "paint"));
}

/// A quarter turn about z takes x to y. Half of its angle, 45 degrees, is rounded once: 2e-16.
TEST(MeshReadGltf, RotationsAreQuaternions) {
  const PolygonSoup soup =
      read_glb(gltf(R"({"mesh": 0, "rotation": [0, 0, 0.7071067811865476, 0.7071067811865476]})", primitive(0, strip)));
  EXPECT_LT(glm::length(soup.points[1] - dvec3(0, 1, 0)), 1e-15);
}

TEST(MeshReadGltf, BuffersInTheTextAndInFilesBeside) {
  const Scratch scratch;
  scratch.write("my square.bin", square_buffer());
  const PolygonSoup beside = read_polygon_soup(scratch.write("a.gltf", gltf(plain_node, primitive(2, strip), "my%20square.bin")));
  EXPECT_EQ(beside.points[3], dvec3(1, 1, 0.5));
  EXPECT_THAT(beside.further_files, ElementsAre(scratch / "my square.bin"));
  const LoadedMesh loaded = load_mesh(scratch / "a.gltf", 1.0);
  EXPECT_THAT(loaded.report.further_files, ElementsAre(scratch / "my square.bin"));

  // Three corners of single precision: 0 0 0, 1 0 0, 0 1 0.
  const std::string base64 = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
  const std::string text =
      R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "meshes": [{"primitives":
    [{"attributes": {"POSITION": 0}}]}], "buffers": [{"byteLength": 36, "uri": "data:application/gltf-buffer;base64,)" +
      base64 + R"("}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}], "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}]})";
  EXPECT_THAT(read_polygon_soup(scratch.write("b.gltf", text)).points, ElementsAre(dvec3(0), dvec3(1, 0, 0), dvec3(0, 1, 0)));
}

TEST(MeshReadGltf, SaysWhatIsUpHiddenOrNotShown) {
  const std::string nodes =
      R"({"name": "car", "mesh": 0, "extensions": {"KHR_node_visibility": {"visible": false}}}, {"mesh": 0})";
  const PolygonSoup soup = read_glb(gltf(nodes, primitive(0, strip)));
  EXPECT_EQ(soup.polygons.size(), 2u);
  EXPECT_THAT(soup.remarks, ElementsAre(HasSubstr("+y of a glTF file is up"), HasSubstr("1 nodes are hidden"),
                                        HasSubstr("1 nodes with a mesh left out")));
}

/// A node far away moves its mesh without loss; a mesh whose own numbers are far away has lost them.
TEST(MeshReadGltf, CoordinatesAreAsFineAsBeforeTheyAreMoved) {
  const std::string far = R"({"mesh": 0, "translation": [1e6, 0.1, 0]})";
  EXPECT_EQ(read_glb(gltf(far, primitive(0, strip))).step.value(), 0.0);
}

std::string model_3mf(const std::string& objects, const std::string& items, const std::string& attributes = "") {
  return "<?xml version=\"1.0\"?>\n<model " + attributes +
         " xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" "
         "xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\"><resources>" +
         objects + "</resources><build>" + items + "</build></model>";
}

const std::string corner_object = R"(<object id="1" name="corner"><mesh><vertices><vertex x="0" y="0" z="0"/>
  <vertex x="1000.0000001" y="0" z="0"/><vertex x="0" y="1" z="0"/></vertices><triangles><triangle v1="0" v2="1" v3="2"/></triangles></mesh></object>)";

TEST(MeshRead3mf, ItemsAndComponentsPlaceObjects) {
  const Scratch scratch;
  const std::string pair = R"(<object id="2" name="pair"><components><component objectid="1"/>
    <component objectid="1" transform="1 0 0 0 1 0 0 0 1 0 0 5"/></components></object>)";
  const std::string items =
      R"(<item objectid="2" transform="0 1 0 -1 0 0 0 0 1 10 0 0"/><item objectid="1" transform="-1 0 0 0 1 0 0 0 1 0 0 0"/>)";
  const PolygonSoup soup =
      read_polygon_soup(scratch.write("a.3mf", packed_3mf(model_3mf(corner_object + pair, items, "unit=\"inch\""))));
  EXPECT_THAT(soup.points,
              ElementsAre(dvec3(10, 0, 0), dvec3(10, 1000.0000001, 0), dvec3(9, 0, 0), dvec3(10, 0, 5),
                          dvec3(10, 1000.0000001, 5), dvec3(9, 0, 5), dvec3(0), dvec3(-1000.0000001, 0, 0), dvec3(0, 1, 0)));
  EXPECT_EQ(soup.polygons, (std::vector<Polygon>{{0, 1, 2}, {3, 4, 5}, {6, 8, 7}}));
  EXPECT_THAT(all_names_of(soup, 1), ElementsAre("pair", "corner"));
  EXPECT_THAT(all_names_of(soup, 2), ElementsAre("corner"));
  EXPECT_EQ(soup.stated_unit->metres, 0.0254);
}

TEST(MeshRead3mf, ObjectsInOtherPartsOfTheFile) {
  const Scratch scratch;
  const std::string root = model_3mf("", R"(<item objectid="1" p:path="/3D/other.model"/>)", "requiredextensions=\"p\"");
  const PolygonSoup soup =
      read_polygon_soup(scratch.write("a.3mf", packed_3mf(root, {{"3D/other.model", model_3mf(corner_object, "")}})));
  EXPECT_EQ(soup.points[1], dvec3(1000.0000001, 0, 0));
  EXPECT_EQ(soup.stated_unit->name, "mm");  // what the specification says where nothing is said
}

TEST(MeshRead3mf, SaysWhatIsNotPrintedOrNotPlaced) {
  const Scratch scratch;
  const std::string second =
      R"(<object id="2"><mesh><vertices/><triangles><triangle v1="0" v2="1" v3="2"/></triangles></mesh></object>)";
  const std::string item = R"(<item objectid="1" printable="0"/>)";
  const PolygonSoup soup = read_polygon_soup(scratch.write("a.3mf", packed_3mf(model_3mf(corner_object + second, item))));
  EXPECT_EQ(soup.polygons.size(), 1u);
  EXPECT_THAT(soup.remarks, ElementsAre(HasSubstr("1 items are marked printable=\"0\""), HasSubstr("1 objects left out")));
}

std::string complaint_about_unit(const std::filesystem::path& file, double metres_per_unit) {
  try {
    load_mesh(file, metres_per_unit);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(MeshReadUnits, AFileThatStatesAnotherUnitIsRefused) {
  const Scratch scratch;
  const auto scene = scratch.write("a.glb", glb(gltf(plain_node, primitive(0, strip))));
  EXPECT_EQ(complaint_about_unit(scene, 1.0), "accepted");
  EXPECT_THAT(complaint_about_unit(scene, 1e-3),
              HasSubstr("says that its unit is \"m\" (1 m), but the unit given for it is 0.001 m"));
  const auto model = scratch.write("a.3mf", packed_3mf(model_3mf(corner_object, R"(<item objectid="1"/>)", "unit=\"foot\"")));
  EXPECT_EQ(complaint_about_unit(model, 0.3048), "accepted");
  EXPECT_THAT(complaint_about_unit(model, 0.0254), HasSubstr("write unit = \"ft\""));
}

}  // namespace
}  // namespace raytube::shapes
