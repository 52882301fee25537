// The rows of the bad-input table that are about meshes of Gmsh, glTF and 3MF.
#include "table.h"
#include "zipped.h"

namespace raytube::testing {
namespace {

BadRow mesh_row(const std::string& name, const std::string& file, const std::string& bytes, const std::string& says) {
  return with_file(name, file, bytes, "run case.toml --set 'target.mesh=\"" + file + "\"'", says);
}

std::string gmsh(const std::string& sections, const std::string& format = "2.2 0 8") {
  return "$MeshFormat\n" + format + "\n$EndMeshFormat\n" + sections;
}

const std::string nodes = "$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n";

std::string elements(const std::string& lines) { return nodes + "$Elements\n1\n" + lines + "\n$EndElements\n"; }

std::vector<BadRow> gmsh_rows() {
  const auto row = [](const std::string& name, const std::string& bytes, const std::string& says) {
    return mesh_row("gmsh_" + name, "bad.msh", bytes, says);
  };
  const std::string one = std::string("\1\0\0\0", 4);
  return {
      row("of_fluent", "(0 \"Fluent\")\n", "line 1: a Gmsh file starts with $MeshFormat; meshes of other programs"),
      row("version_1", "$NOD\n1\n", "starts with $MeshFormat"),
      row("version_4_0", gmsh("", "4 0 8"), "line 2: version '4' of the Gmsh format is not read; save it as 4.1"),
      row("kind_2", gmsh("", "2.2 2 8"), "line 2: '2' is neither 0 (text) nor 1 (binary)"),
      row("binary_of_four_bytes", gmsh("", "2.2 1 4"), "binary numbers of '4' bytes are not read; save the mesh as text"),
      row("binary_head_damaged", "$MeshFormat\n2.2 1 8\nabcd\n$EndMeshFormat\n", "the head of its binary numbers is damaged"),
      row("binary_cut", "$MeshFormat\n2.2 1 8\n" + one + "\n$EndMeshFormat\n$Nodes\n3\nabc", "ends before its last number"),
      row("no_section", gmsh("Nodes\n"), "line 4: a section such as $Nodes was expected instead of 'Nodes'"),
      row("section_without_end", gmsh("$Comments\nhello\n"), "the file ends without $EndComments; it is cut short"),
      row("more_nodes", gmsh("$Nodes\n1\n1 0 0 0\n2 0 0 0\n$EndNodes\n"), "line 7: $EndNodes was expected instead of '2'"),
      row("node_twice", gmsh("$Nodes\n2\n1 0 0 0\n1 0 0 0\n$EndNodes\n"), "line 7: node 1 is there twice"),
      row("node_nan", gmsh("$Nodes\n1\n1 0 0 nan\n$EndNodes\n"), "line 6: the coordinate 'nan' is not finite"),
      row("1e18_nodes", gmsh("$Nodes\n1000000000000000000\n1 0 0 0\n"), "a count was expected instead of ''"),
      row("node_missing", gmsh(elements("1 2 2 0 1 1 2 4")), "line 12: element 1 names node 4, which does not exist"),
      row("second_order", gmsh(elements("1 9 2 0 1 1 2 3 1 2 3")),
          "line 12: elements of type 9 have curved edges or are unknown"),
      row("fraction", gmsh(elements("1 2.5 2 0 1 1 2 3")), "line 12: a whole number was expected instead of '2.5'"),
      row("volumes_only", gmsh(elements("1 4 2 0 1 1 2 3 1")), "holds 1 volume elements and no surface; save its surface too"),
      row("lines_only", gmsh(elements("1 1 2 0 1 1 2")), "holds no facets"),
      row("partitions", gmsh("$PartitionedEntities\n", "4.1 0 8"), "line 4: the mesh is divided into partitions"),
      row("name_without_quotes", gmsh("$PhysicalNames\n1\n2 1 top\n"), "line 6: the name of physical group 1 lacks its quotes"),
      mesh_row("gmsh_named_stl", "bad.stl", gmsh(nodes), "looks like a Gmsh file; give its name the ending .msh"),
  };
}

std::string scene(const std::string& members, const std::string& version = "2.0") {
  return R"({"asset": {"version": ")" + version + "\"}" + (members.empty() ? "" : ", " + members) + "}";
}

/// One primitive whose POSITION is accessor 0, of 36 zero bytes.
std::string primitive(const std::string& more, const std::string& accessor, const std::string& node = "") {
  return scene(R"("scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0)" + node +
               R"(}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0})" + more +
               R"(}]}], "buffers": [{"byteLength": 36, "uri": "data:;base64,)" + std::string(48, 'A') +
               R"("}], "bufferViews": [{"buffer": 0, "byteLength": 36}], "accessors": [{"bufferView": 0, )" + accessor + "}]");
}

const std::string three_points = R"("componentType": 5126, "count": 3, "type": "VEC3")";

std::vector<BadRow> gltf_rows() {
  const auto row = [](const std::string& name, const std::string& text, const std::string& says) {
    return mesh_row("gltf_" + name, "bad.gltf", text, says);
  };
  const auto buffer = [](const std::string& uri) {
    return scene(R"("scenes": [{}], "buffers": [{"byteLength": 36, "uri": ")" + uri + "\"}]");
  };
  return {
      row("cut", R"({"asset": {"version": "2.0"}, "scenes": [)", "its JSON is damaged or cut short"),
      row("version_1", scene("", "1.0"), "its asset.version is '1.0', where glTF 2.0 is read"),
      row("draco", scene(R"("extensionsRequired": ["KHR_draco_mesh_compression"])"),
          "needs the extension KHR_draco_mesh_compression"),
      row("instancing", scene(R"("extensionsUsed": ["EXT_mesh_gpu_instancing"])"), "export it without instancing"),
      row("no_scene", scene(""), "holds no scene"),
      row("two_scenes", scene(R"("scenes": [{}, {}])"), "holds 2 scenes and says of none"),
      row("empty_scene", scene(R"("scenes": [{}])"), "holds no facets"),
      row("node_missing", scene(R"("scenes": [{"nodes": [3]}])"), "nodes[3] does not exist, there are 0"),
      row("nodes_in_a_circle", scene(R"("scenes": [{"nodes": [0]}], "nodes": [{"children": [0]}])"),
          "nodes[0] stands at two places of the scene"),
      row("buffer_missing", buffer("none.bin"), "its buffer 'none.bin' is not there; copy it"),
      row("buffer_outside", buffer("../secret.bin"), "its buffer '../secret.bin' is not a file in the folder of the mesh"),
      row("buffer_in_the_web", buffer("https://a.b/c.bin"), "is not a file in the folder of the mesh; export it as .glb"),
      row("buffer_damaged", buffer("data:;base64,****"), "the base64 data of buffers[0] is damaged"),
      row("buffer_cut", buffer("data:;base64,AAAA"), "buffers[0] holds 3 of the 36 bytes it announces"),
      row("accessor_too_long", primitive("", R"("componentType": 5126, "count": 4, "type": "VEC3")"),
          "an accessor reaches beyond bufferViews[0]"),
      row("accessor_of_2_to_the_60", primitive("", R"("componentType": 5126, "count": 1152921504606846976, "type": "VEC3")"),
          "an accessor counts more elements than the file has bytes"),
      row("accessor_of_two", primitive("", R"("componentType": 5126, "count": 3, "type": "VEC2")"),
          "accessors[0] is of type 'VEC2'"),
      row("component_unknown", primitive("", R"("componentType": 5130, "count": 3, "type": "VEC3")"),
          "componentType 5130 is not a component type"),
      row("four_corners", primitive(R"(, "indices": 0)", R"("componentType": 5126, "count": 4, "type": "SCALAR")"),
          "accessors[0] is of type 'SCALAR'"),
      row("mode_7", primitive(R"(, "mode": 7)", three_points), "mode 7 of a primitive is unknown"),
      row("skin", primitive("", three_points, R"(, "skin": 0)"), "nodes[0] is bent by a skeleton"),
      row("morphed", primitive("", three_points, R"(, "weights": [0.5])"), "meshes[0] is shaped by morph targets"),
      row("matrix_of_three", primitive("", three_points, R"(, "matrix": [1, 2, 3])"),
          "'matrix' of a node holds 3 numbers instead of 16"),
      row("rotation_of_zeros", primitive("", three_points, R"(, "rotation": [0, 0, 0, 0])"),
          "the rotation of a node is not a unit quaternion (its length is 0)"),
      mesh_row("glb_cut", "bad.glb", std::string("glTF\2\0\0\0\x40\0\0\0", 12), "holds 12 of the 64 bytes it announces"),
      mesh_row("glb_version_1", "bad.glb", std::string("glTF\1\0\0\0\x0C\0\0\0", 12), "version 1 of glTF is not read"),
      mesh_row("glb_named_gltf_cut", "bad.gltf", std::string("glTF\2\0\0\0\x40\0\0\0", 12), "looks like a binary glTF file"),
      mesh_row("gltf_named_obj", "bad.obj", scene(""), "looks like glTF text; give its name the ending .gltf"),
      with_file("gltf_in_millimetres", "bad.gltf", primitive("", three_points),
                "run case.toml --set 'target.mesh=\"bad.gltf\"' --set target.unit=mm",
                "says that its unit is \"m\" (1 m), but the unit given for it is 0.001 m; write unit = \"m\""),
  };
}

std::string model(const std::string& objects, const std::string& items, const std::string& attributes = "unit=\"meter\"") {
  return "<model " + attributes + " xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n<resources>" + objects +
         "</resources>\n<build>" + items + "</build></model>";
}

std::string object(const std::string& id, const std::string& triangle, const std::string& x = "1") {
  return "<object id=\"" + id + "\"><mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"" + x +
         "\" y=\"0\" z=\"0\"/><vertex x=\"0\" y=\"1\" z=\"0\"/></vertices><triangles>" + triangle +
         "</triangles></mesh></object>";
}

std::string holder(int id, int held, int times) {
  std::string components;
  for (int i = 0; i < times; ++i) components += "<component objectid=\"" + std::to_string(held) + "\"/>";
  return "<object id=\"" + std::to_string(id) + "\"><components>" + components + "</components></object>";
}

std::vector<BadRow> rows_3mf() {
  const auto row = [](const std::string& name, const std::string& bytes, const std::string& says) {
    return mesh_row("m3f_" + name, "bad.3mf", bytes, says);
  };
  const std::string good = "<triangle v1=\"0\" v2=\"1\" v3=\"2\"/>", item = "<item objectid=\"1\"/>";
  std::string damaged = packed_3mf(model(object("1", good), item)), nested;
  damaged[damaged.find("vertex x")] = 'V';
  for (int id = 2; id < 12; ++id) nested += holder(id, id - 1, 10);
  const auto packed = [](const std::string& text) { return packed_3mf(text); };
  return {
      row("of_noise", "nothing in particular", "is not a zip archive, as a 3MF file is one"),
      row("other_archive", zipped({{"a.txt", "hello"}}), "is a zip archive; unpack it first"),
      row("damaged", damaged, "'3D/3dmodel.model' in its archive is damaged"),
      row("without_model", zipped({{"_rels/.rels", "<a xmlns=\"b\"/>"}, {"3dmodel", ""}}), "names no model in _rels/.rels"),
      row("xml_cut", packed("<model unit=\"meter\">"),
          "3D/3dmodel.model, line 1: its XML is damaged or cut short (no element found)"),
      row("empty_build", packed(model(object("1", good), "")), "holds no facets"),
      row("unit_unknown", packed(model("", "", "unit=\"mile\"")), "line 1: the unit 'mile' is none of 3MF"),
      row("extension", packed(model("", "", "requiredextensions=\"b\" xmlns:b=\"http://x/beamlattice/2017/02\"")),
          "needs the extension 'http://x/beamlattice/2017/02', which is not read"),
      row("object_missing", packed(model("", item)), "object 1 of 3D/3dmodel.model does not exist"),
      row("object_twice", packed(model(object("1", good) + object("1", good), item)),
          "line 2: an object of this id is there already"),
      row("holds_itself", packed(model(holder(1, 1, 1), item)), "its objects hold one another without end"),
      row("1e10_instances", packed(model(object("1", good) + nested, "<item objectid=\"11\"/>")), "places its parts so often"),
      row("vertex_missing", packed(model(object("1", "<triangle v1=\"0\" v2=\"1\" v3=\"3\"/>"), item)),
          "triangle 1 of '' names vertex 3 (counted from 0) but there are 3"),
      row("vertex_negative", packed(model(object("1", "<triangle v1=\"0\" v2=\"1\" v3=\"-1\"/>"), item)),
          "line 2: '-1' is not a vertex number"),
      row("attribute_missing", packed(model(object("1", "<triangle v1=\"0\" v2=\"1\"/>"), item)),
          "line 2: the attribute 'v3' is missing"),
      row("coordinate_nan", packed(model(object("1", good, "nan"), item)), "line 2: 'nan' is not a finite number"),
      row("transform_of_eleven", packed(model(object("1", good), "<item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 0 0\"/>")),
          "line 3: a transform holds 11 numbers instead of 12"),
      row("in_inches", packed(model(object("1", good), item, "unit=\"inch\"")), "says that its unit is \"in\" (0.0254 m)"),
      mesh_row("m3f_named_stl", "bad.stl", packed(model("", "")), "looks like a 3MF file; give its name the ending .3mf"),
  };
}

INSTANTIATE_TEST_SUITE_P(Gmsh, BadTable, ::testing::ValuesIn(gmsh_rows()), row_name);
INSTANTIATE_TEST_SUITE_P(Gltf, BadTable, ::testing::ValuesIn(gltf_rows()), row_name);
INSTANTIATE_TEST_SUITE_P(Threemf, BadTable, ::testing::ValuesIn(rows_3mf()), row_name);

}  // namespace
}  // namespace raytube::testing
