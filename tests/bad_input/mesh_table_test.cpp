// The rows of the bad-input table that are about mesh files.
#include <cmath>
#include <limits>

#include "gzipped.h"
#include "table.h"

namespace raytube::testing {
namespace {

namespace fs = std::filesystem;
using namespace std::string_view_literals;

// A run of the case with the mesh in `file`.
std::string run_with(const std::string& file) { return "run case.toml --set 'target.mesh=\"" + file + "\"'"; }

BadRow mesh(const std::string& name, const std::string& ending, const std::string& bytes, const std::string& says) {
  return with_file(name, "bad." + ending, bytes, run_with("bad." + ending), says);
}

// A binary STL of these corners, three to a facet, that announces `count` facets.
std::string stl(const std::vector<float>& coordinates, std::uint32_t count, const std::string& header = "binary") {
  std::string bytes = header + std::string(80 - header.size(), '\0') + bytes_of(count);
  for (std::size_t i = 0; i + 9 <= coordinates.size(); i += 9) {
    bytes += bytes_of(0.0f, 0.0f, 0.0f);
    for (std::size_t k = 0; k < 9; ++k) bytes += bytes_of(coordinates[i + k]);
    bytes += std::string(2, '\0');
  }
  return bytes;
}

const std::vector<float> two_facets = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0};

constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();

std::string text_stl(const std::string& vertices) {
  return "solid a\nfacet normal 0 0 1\nouter loop\n" + vertices + "endloop\nendfacet\nendsolid a\n";
}

std::string ply(const std::string& format, const std::string& elements, const std::string& body) {
  return "ply\nformat " + format + " 1.0\n" + elements + "end_header\n" + body;
}

std::string vertices_and_faces(const std::string& vertices, const std::string& faces, const std::string& count = "uchar") {
  return "element vertex " + vertices + "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
         "\nproperty list " + count + " int vertex_indices\n";
}

const std::string corners = "0 0 0\n1 0 0\n0 1 0\n";

std::string in_utf16(const std::string& text) {
  std::string bytes = "\xFF\xFE";
  for (const char c : text) bytes += {c, '\0'};
  return bytes;
}

std::vector<BadRow> stl_rows() {
  const std::string good = stl(two_facets, 2);
  return {
      mesh("stl_of_no_bytes", "stl", "", "is empty; export the mesh again"),
      mesh("stl_shorter_than_its_header", "stl", good.substr(0, 50), "is too short for an STL file"),
      mesh("stl_cut_after_its_header", "stl", good.substr(0, 84), "holds 0 of the 2 facets it announces"),
      mesh("stl_cut_within_a_facet", "stl", good.substr(0, 150), "holds 1 of the 2 facets it announces"),
      mesh("stl_count_too_large", "stl", stl(two_facets, 3), "holds 2 of the 3 facets it announces"),
      mesh("stl_count_too_small", "stl", stl(two_facets, 1), "holds 2 facets but announces 1"),
      mesh("stl_count_zero", "stl", stl(two_facets, 0), "holds 2 facets but announces 0"),
      mesh("stl_largest_count", "stl", stl(two_facets, 0xFFFFFFFF), "holds 2 of the 4294967295 facets"),
      // 50 * 85899348 is 2^32 + 104: with 84 of the header a product of 32 bits would be 188 bytes.
      mesh("stl_count_wraps_32_bits", "stl", stl(two_facets, 85899348).substr(0, 188), "of the 85899348 facets it announces"),
      mesh("stl_binary_called_solid_and_cut", "stl", stl(two_facets, 3, "solid plate"), "holds 2 of the 3 facets it announces"),
      mesh("stl_binary_called_solid_with_blanks", "stl", "solid" + std::string(300, ' '), "cut short, export it again"),
      mesh("stl_text_without_solid", "stl", text_stl("").substr(8) + std::string(200, ' '),
           "of the 538976288 facets it announces"),
      mesh("stl_binary_nan", "stl", stl({0, 0, 0, 1, 0, 0, nan, 1, 0}, 1), "facet 1 has a coordinate that is not finite"),
      mesh("stl_binary_infinity", "stl", stl({0, 0, 0, 1, 0, 0, 0, -inf, 0}, 1), "facet 1 has a coordinate that is not finite"),
      mesh("stl_text_nan", "stl", text_stl("vertex 0 0 nan\nvertex 1 0 0\nvertex 0 1 0\n"),
           "line 4: the coordinate 'nan' is not finite"),
      mesh("stl_text_1e999", "stl", text_stl("vertex 0 0 1e999\n"), "line 4: the coordinate '1e999' is not finite"),
      mesh("stl_text_two_vertices", "stl", text_stl("vertex 0 0 0\nvertex 1 0 0\n"), "line 7: a facet needs three vertices"),
      mesh("stl_text_cut", "stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", "ends without 'endsolid'"),
      mesh("stl_text_cut_within_a_number", "stl", "solid a\nfacet\nvertex 0 1e", "line 3: '1e' is not a number"),
      mesh("stl_text_in_utf16", "stl", in_utf16(text_stl("vertex 0 0 0\n")), "is text in UTF-16; save it as UTF-8 or ASCII"),
      mesh("stl_of_one_point", "stl", stl({1, 1, 1, 1, 1, 1, 1, 1, 1}, 1), "no facet has an area; export the surface again"),
      mesh("stl_of_a_line", "stl", stl({0, 0, 0, 1, 1, 1, 2, 2, 2}, 1), "no facet has an area"),
      mesh("stl_of_zeros", "stl", std::string(4096, '\0'), "holds 80 facets but announces 0"),
  };
}

std::vector<BadRow> obj_rows() {
  const std::string v = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  return {
      mesh("obj_zero_index", "obj", v + "f 0 1 2\n", "line 4: the corner '0' names no vertex; they count from 1"),
      mesh("obj_relative_index_too_far", "obj", v + "f -1 -2 -4\n", "line 4: the corner '-4' names no vertex"),
      mesh("obj_index_out_of_range", "obj", v + "f 1 2 4\n", "line 4: vertex 4 does not exist, the file holds 3"),
      mesh("obj_index_beyond_64_bits", "obj", v + "f 1 2 99999999999999999999\n", "is not a vertex number; correct the line"),
      mesh("obj_index_least_of_64_bits", "obj", v + "f 1 2 -9223372036854775808\n", "names no vertex"),
      mesh("obj_index_of_1e9", "obj", v + "f 1 2 1000000000\n", "line 4: vertex 1000000000 does not exist"),
      mesh("obj_index_with_a_fraction", "obj", v + "f 1 2 3.5\n", "line 4: the corner '3.5' is not a vertex number"),
      mesh("obj_slash_first", "obj", v + "f /1 /2 /3\n", "line 4: the corner '/1' is not a vertex number"),
      mesh("obj_polygons_of_one_and_two", "obj", v + "f 1\nf 1 2\nf\nf 1 2 1\n", "no facet has an area"),
      mesh("obj_without_facets", "obj", v, "holds no facets"),
      mesh("obj_nul_in_a_number", "obj", std::string("v 0 0 0\nv 1\0 0 0\n", 17), "line 2: '1?' is not a number"),
      mesh("obj_in_utf16", "obj", in_utf16(v + "f 1 2 3\n"), "is text in UTF-16"),
      mesh("obj_two_coordinates", "obj", "v 0 0\n", "line 1: a number is missing"),
      mesh("obj_comma_for_a_point", "obj", "v 0,5 0 0\n", "line 1: '0,5' is not a number"),
      mesh("obj_coordinates_of_1e308", "obj", "v 1e308 0 0\nv -1e308 0 0\nv 0 1e308 0\nf 1 2 3\n", "coordinates are too large"),
      mesh("obj_coordinates_of_1e160", "obj", "v 1e160 0 0\nv -1e160 0 0\nv 0 1e160 0\nf 1 2 3\n", "coordinates are too large"),
      mesh("obj_coordinates_of_1e_320", "obj", "v 1e-320 0 0\nv 0 1e-320 0\nv 0 0 0\nf 1 2 3\n",
           " m across, less than 1e-09 m, and no surface"),
      mesh("obj_coordinates_of_1e_170", "obj", "v 1e-170 0 0\nv 0 1e-170 0\nv 0 0 0\nf 1 2 3\n",
           "the target is 1e-173 m across, less than 1e-09 m, and no surface is as small as that; check target.unit"),
      mesh("obj_coordinates_of_1e_40", "obj", "v 1e-40 0 0\nv 0 1e-40 0\nv 0 0 0\nf 1 2 3\n",
           "the target is 1e-43 m across, less"),
      mesh("obj_far_from_the_origin", "obj", "v 1e20 0 0\nv 1e20 1e19 0\nv 1e20 0 1e19\nf 1 2 3\n", "coordinates are too large"),
      mesh("obj_of_one_point", "obj", "v 1 2 3\nf 1 1 1\n", "no facet has an area"),
      mesh("obj_word_of_1e6_letters", "obj", "v " + std::string(1000000, 'x') + "\n", "line 1: 'xxx"),
      mesh("obj_of_noise", "obj",
           "\x7f"
           "ELF\x02\x01\x01" +
               std::string(5000, '\xE9'),
           "is a program; name the mesh file"),
      mesh("obj_backslash_at_the_end", "obj", v + "f 1 2 \\", "the corner '\\' is not a vertex number"),
  };
}

std::vector<BadRow> ply_rows() {
  return {
      mesh("ply_more_vertices_than_there_are", "ply", ply("ascii", vertices_and_faces("4", "1"), corners), "a number is missing"),
      mesh("ply_fewer_vertices_than_there_are", "ply", ply("ascii", vertices_and_faces("2", "1"), corners + "3 0 1 2\n"),
           "goes on after the last item its header announces"),
      mesh("ply_more_faces_than_announced", "ply", ply("ascii", vertices_and_faces("3", "1"), corners + "3 0 1 2\n3 0 2 1\n"),
           ": goes on after the last item its header announces; correct the counts"),
      mesh("ply_binary_more_faces_than_announced", "ply",
           ply("binary_little_endian", vertices_and_faces("1", "1"),
               bytes_of(0.0f, 0.0f, 0.0f, std::uint8_t{3}, 0, 0, 0, std::uint8_t{3}, 0, 0, 0)),
           ": goes on after the last item its header announces; correct the counts"),
      mesh("ply_negative_count", "ply", ply("ascii", vertices_and_faces("-3", "1"), corners),
           "line 3: a count was expected instead of '-3'"),
      mesh("ply_1e9_vertices_in_100_bytes", "ply", ply("binary_little_endian", vertices_and_faces("1000000000", "1"), "abc"),
           "ends before its last number"),
      mesh("ply_1e9_vertices_without_properties", "ply", ply("ascii", "element vertex 1000000000\n", ""),
           "its vertices lack x, y or z"),
      mesh("ply_count_beyond_64_bits", "ply", ply("ascii", vertices_and_faces("99999999999999999999", "1"), ""),
           "a count was expected"),
      mesh("ply_1e18_things_of_no_size", "ply",
           ply("ascii",
               "element dust 1000000000000000000\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\n", ""),
           "holds no facets"),
      mesh("ply_list_of_2_to_the_31", "ply", ply("ascii", vertices_and_faces("3", "1", "uint"), corners + "2147483648 0 1 2\n"),
           "a number is missing"),
      mesh("ply_binary_list_of_2_to_the_31", "ply",
           ply("binary_little_endian", vertices_and_faces("0", "1", "uint"), bytes_of(0x80000000u, 0, 1, 2)),
           "ends before its last number"),
      mesh("ply_negative_list", "ply", ply("ascii", vertices_and_faces("3", "1", "int"), corners + "-1 0 1 2\n"),
           "-1 is not the length of a list"),
      mesh("ply_index_out_of_range", "ply", ply("ascii", vertices_and_faces("3", "1"), corners + "3 0 1 3\n"),
           "facet 1 names vertex 3 (counted from 0) but there are 3"),
      mesh("ply_negative_index", "ply", ply("ascii", vertices_and_faces("3", "1"), corners + "3 0 1 -2\n"),
           "-2 is not a vertex number"),
      mesh("ply_unknown_type", "ply", ply("ascii", "element vertex 1\nproperty real x\n", ""),
           "line 4: 'real' is not a PLY number type"),
      mesh("ply_unknown_format", "ply", ply("binary_middle_endian", "", ""),
           "line 2: 'binary_middle_endian' is not a PLY format"),
      mesh("ply_without_format", "ply", "ply\nelement vertex 0\nend_header\n", "the header names no format"),
      mesh("ply_without_end_header", "ply", "ply\nformat ascii 1.0\nelement vertex 0\n", "the header has no 'end_header'"),
      mesh("ply_big_endian_cut", "ply", ply("binary_big_endian", vertices_and_faces("3", "1"), std::string(30, '\0')),
           "ends before its last number"),
      mesh("ply_little_called_big_endian", "ply",
           ply("binary_big_endian", vertices_and_faces("1", "1", "uint"), bytes_of(0.0f, 0.0f, 0.0f, 3u, 0, 0, 0)),
           "ends before its last number"),
      mesh("ply_binary_nan", "ply",
           ply("binary_little_endian", vertices_and_faces("1", "1"), bytes_of(nan, 0.0f, 0.0f, std::uint8_t{3}, 0, 0, 0)),
           "vertex 1 has a coordinate that is not finite"),
      mesh("ply_property_before_an_element", "ply", ply("ascii", "property float x\n", ""),
           "a property stands before the first element"),
      mesh("ply_faces_without_a_list", "ply", ply("ascii", "element face 1\nproperty int vertex_indices\n", "1\n"),
           "its faces lack the list vertex_indices"),
      mesh("ply_only_the_first_word", "ply", "ply", "the header has no 'end_header'"),
      mesh("ply_of_another_format", "ply", "OFF\n0 0 0\n", "looks like an OFF file; give its name the ending .off"),
  };
}

std::vector<BadRow> off_rows() {
  return {
      mesh("off_huge_counts", "off", "OFF\n1000000000 2000000000 0\n" + corners, "the file ends after 3 of 1000000000 vertices"),
      mesh("off_counts_beyond_64_bits", "off", "OFF\n99999999999999999999 1 0\n", "line 2: a count was expected"),
      mesh("off_facet_of_4e9_corners", "off", "OFF\n3 1 0\n" + corners + "4294967296 0 1 2\n",
           "line 6: a count was expected instead of ''"),
      mesh("off_negative_index", "off", "OFF\n3 1 0\n" + corners + "3 0 1 -2\n", "line 6: a count was expected instead of '-2'"),
      mesh("off_four_dimensions", "off", "4OFF\n1 1 0\n0 0 0 0\n", "line 1: '4OFF' is not the keyword"),
      mesh("off_binary", "off", "OFF BINARY\n", "binary OFF is not supported"),
      mesh("off_without_keyword", "off", "3 1 0\n" + corners + "3 0 1 2\n", "line 1: '3' is not the keyword"),
      mesh("off_cut_after_the_keyword", "off", "OFF\n", "a count was expected instead of ''"),
      mesh("off_more_facets_than_announced", "off", "OFF\n3 1 0\n" + corners + "3 0 1 2\n3 0 2 1\n",
           "line 7: more lines than the 3 vertices and 1 facets announced; correct the counts"),
      mesh("off_more_vertices_than_announced", "off", "OFF\n3 1 0\n" + corners + "0 1 1\n3 0 1 2\n",
           "line 7: more lines than the 3 vertices and 1 facets announced"),
      mesh("off_facets_missing", "off", "OFF\n3 2 0\n" + corners + "3 0 1 2\n", "the file ends after 1 of 2 facets"),
  };
}

void make_pipe(const Scratch& scratch) { ASSERT_EQ(mkfifo((scratch / "bad.stl").c_str(), 0600), 0); }

void make_link_to_itself(const Scratch& scratch) { fs::create_symlink("bad.stl", scratch / "bad.stl"); }

// Holds nothing on the disk.
void make_sparse(const Scratch& scratch) { fs::resize_file(scratch.write("bad.stl", ""), 1ull << 42); }

std::vector<BadRow> file_rows() {
  return {
      {"mesh_pipe", run_with("bad.stl"), "mesh file 'bad.stl': is a pipe or a device; copy", make_pipe},
      {"mesh_endless_device", "run case.toml --set 'target.mesh=\"/dev/zero\"'", "mesh file '/dev/zero': is a pipe or a device"},
      {"mesh_link_to_itself", run_with("bad.stl"), "mesh file 'bad.stl'", make_link_to_itself},
      {"mesh_larger_than_memory", run_with("bad.stl"), "mesh file 'bad.stl': is larger than this machine's memory", make_sparse},
      {"mesh_folder", run_with("bad.stl"), "mesh file 'bad.stl': is a folder; name the mesh file in it",
       [](const Scratch& scratch) { fs::create_directory(scratch / "bad.stl"); }},
      {"mesh_missing", run_with("none.stl"), "mesh file 'none.stl': not found; check the path"},
      {"mesh_missing_outside", run_with("../../none.stl"), "mesh file '../../none.stl': not found"},
      {"mesh_below_a_file", run_with("mesh.off/none.stl"), "mesh file 'mesh.off/none.stl': not found"},
      {"mesh_name_of_5000_letters", run_with(std::string(5000, 'm') + ".stl"), "not found; check the path"},
      {"mesh_without_ending", run_with("."), "mesh file '.': is a folder"},
      with_file("mesh_of_another_program", "bad.step", "ISO-10303-21;", run_with("bad.step"),
                "is a STEP model; export its surface as STL, OBJ or PLY, or mesh it with a size of your choice: gmsh in.step"),
      with_file("mesh_of_unknown_ending", "bad.dat", "1 2 3", run_with("bad.dat"),
                "the ending '.dat' is not a known mesh format; use .stl, .obj, .ply, .off, .msh, .gltf, .glb or .3mf, or one of "
                "these and .gz"),
      {"mesh_in_kilometres", "run case.toml --set target.unit=km", "target.unit \"km\" is unknown; write \"m\", \"cm\""},
  };
}

// Files that are something else than their names say.
std::vector<BadRow> contents_rows() {
  const std::string obj = "# a plate\no a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
                    triangle = "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n";
  const std::string_view png = "\x89PNG\r\n\x1A\n\0\0\0\rIHDR"sv, xz = "\xFD"
                                                                       "7zXZ\0\0"sv;
  return {
      mesh("gzip_named_stl", "stl", gzipped(text_stl(triangle)), "mesh file 'bad.stl': is gzip data; add .gz to its name"),
      mesh("gzip_twice", "stl.gz", gzipped(gzipped(text_stl(triangle))), "was compressed twice; unpack it once"),
      mesh("gzip_named_obj", "obj", gzipped(obj), "mesh file 'bad.obj': is gzip data; add .gz to its name"),
      mesh("zip_named_stl", "stl", "PK\x03\x04" + std::string(200, 'x'), "is a zip archive; unpack it first"),
      mesh("bzip2_named_ply", "ply", "BZh91AY&SY", "is bzip2 data; unpack it first"),
      mesh("xz_named_off", "off", std::string(xz), "is xz data; unpack it first"),
      mesh("png_named_stl", "stl", std::string(png), "is a PNG image; name the mesh file"),
      mesh("jpeg_named_obj", "obj", "\xFF\xD8\xFF\xE0 JFIF", "is a JPEG image; name the mesh file"),
      mesh("pdf_named_stl", "stl", "%PDF-1.7\n", "is a PDF document; name the mesh file"),
      mesh("hdf5_named_ply", "ply", "\x89HDF\r\n\x1A\n", "is HDF5 data; convert it to STL, OBJ, PLY or OFF"),
      mesh("page_named_stl", "stl", "\n<!DOCTYPE html>\n<html>", "is a page of HTML; download the file itself"),
      mesh("pointer_named_stl", "stl", "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12345\n",
           "is a pointer of Git LFS, not the file itself; fetch it with git lfs pull"),
      mesh("obj_named_stl", "stl", obj, "looks like OBJ text; give its name the ending .obj"),
      mesh("obj_named_off", "off", obj, "looks like OBJ text; give its name the ending .obj"),
      mesh("obj_named_txt", "txt", obj, "looks like OBJ text; give its name the ending .obj"),
      mesh("stl_named_obj", "obj", text_stl(triangle), "looks like an STL file; give its name the ending .stl"),
      mesh("binary_stl_named_ply", "ply", stl(two_facets, 2), "looks like an STL file; give its name the ending .stl"),
      mesh("binary_stl_named_off", "off", stl(two_facets, 2, "OFF"), "looks like an STL file; give its name the ending .stl"),
      mesh("ply_named_stl", "stl", ply("ascii", vertices_and_faces("3", "1"), corners + "3 0 1 2\n"),
           "looks like a PLY file; give its name the ending .ply"),
      mesh("off_named_obj", "obj", "OFF\n3 1 0\n" + corners + "3 0 1 2\n",
           "looks like an OFF file; give its name the ending .off"),
      mesh("off_in_gzip_named_stl", "stl.gz", gzipped("OFF\n3 1 0\n" + corners + "3 0 1 2\n"),
           "looks like an OFF file; give its name the ending .off.gz"),
  };
}

std::vector<BadRow> gzip_rows() {
  const std::string off = "OFF\n3 1 0\n" + corners + "3 0 1 2\n", packed = gzipped(off);
  std::string damaged = packed, wrong_sum = packed;
  damaged.replace(12, 4, "\xFF\xFF\xFF\xFF");
  wrong_sum[packed.size() - 8] = static_cast<char>(wrong_sum[packed.size() - 8] ^ 1);
  return {
      mesh("gzip_not_packed", "off.gz", off, "looks like an OFF file; give its name the ending .off\n"),
      mesh("gzip_of_noise", "off.gz", "nothing in particular", "is not gzip data, which the ending .gz stands for; rename it"),
      mesh("gzip_is_a_png", "stl.gz", "\x89PNG\r\n", "is a PNG image; name the mesh file"),
      mesh("gzip_of_no_ending", "gz", packed, "looks like an OFF file; give its name the ending .off.gz"),
      mesh("gzip_of_another_ending", "dat.gz", gzipped("1 2 3"), "the ending '.dat' is not a known mesh format; use .stl"),
      mesh("gzip_cut", "off.gz", packed.substr(0, packed.size() - 12), "its gzip data ends early; it is cut short"),
      mesh("gzip_cut_in_its_header", "off.gz", packed.substr(0, 5), "its gzip data ends early; it is cut short"),
      mesh("gzip_damaged", "off.gz", damaged, "its gzip data is damaged; copy or compress it again"),
      mesh("gzip_of_a_wrong_sum", "off.gz", wrong_sum, "its gzip data is damaged; copy or compress it again"),
      mesh("gzip_goes_on", "off.gz", packed + "hello", "goes on after its gzip data; compress the mesh again"),
      mesh("gzip_of_nothing", "stl.gz", gzipped(""), "is too short for an STL file"),
      mesh("gzip_of_zeros_without_end", "stl.gz", gzipped(std::string(1 << 20, '\0'), 1 << 2),
           "unpacks to more than 200 times its "),
  };
}

INSTANTIATE_TEST_SUITE_P(MeshContents, BadTable, ::testing::ValuesIn(contents_rows()), row_name);
INSTANTIATE_TEST_SUITE_P(Gzip, BadTable, ::testing::ValuesIn(gzip_rows()), row_name);
INSTANTIATE_TEST_SUITE_P(Stl, BadTable, ::testing::ValuesIn(stl_rows()), row_name);
INSTANTIATE_TEST_SUITE_P(Obj, BadTable, ::testing::ValuesIn(obj_rows()), row_name);
INSTANTIATE_TEST_SUITE_P(Ply, BadTable, ::testing::ValuesIn(ply_rows()), row_name);
INSTANTIATE_TEST_SUITE_P(Off, BadTable, ::testing::ValuesIn(off_rows()), row_name);
INSTANTIATE_TEST_SUITE_P(MeshFiles, BadTable, ::testing::ValuesIn(file_rows()), row_name);

}  // namespace
}  // namespace raytube::testing
