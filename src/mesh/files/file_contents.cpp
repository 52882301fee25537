#include "mesh/files/file_contents.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "core/text.h"
#include "mesh/files/numbers.h"

namespace raytube {

namespace {

using namespace std::string_view_literals;

struct Signature {
  std::string_view begins_with, is, remedy;
};

constexpr std::string_view unpack = "unpack it first", name_mesh = "name the mesh file, STL, OBJ, PLY or OFF",
                           convert = "convert it to STL, OBJ, PLY or OFF", download = "download the file itself",
                           mesh_it =
                               "export its surface as STL, OBJ or PLY, or mesh it with a size of your choice: gmsh in.step -2 "
                               "-clmax SIZE -format msh41 -o out.msh";
constexpr std::array<Signature, 21> signatures = {{
    {"PK\x03\x04", "is a zip archive", unpack},
    {"BZh", "is bzip2 data", unpack},
    {"\xFD"
     "7zXZ\0"sv,
     "is xz data", unpack},
    {"\x28\xB5\x2F\xFD", "is zstd data", unpack},
    {"7z\xBC\xAF\x27\x1C", "is a 7z archive", unpack},
    {"\x89PNG", "is a PNG image", name_mesh},
    {"\xFF\xD8\xFF", "is a JPEG image", name_mesh},
    {"GIF8", "is a GIF image", name_mesh},
    {"%PDF", "is a PDF document", name_mesh},
    {"\x7F"
     "ELF",
     "is a program", name_mesh},
    {"\x89HDF\r\n", "is HDF5 data", convert},
    {"Kaydara FBX", "is an FBX scene", convert},
    {"BLENDER", "is a Blender scene", convert},
    {"ISO-10303-21", "is a STEP model", mesh_it},
    {"DBRep_DrawableShape", "is a BREP model", mesh_it},
    {"CASCADE Topology", "is a BREP model", mesh_it},
    {"version https://git-lfs", "is a pointer of Git LFS, not the file itself", "fetch it with git lfs pull"},
    {"<!DOCTYPE html", "is a page of HTML", download},
    {"<!doctype html", "is a page of HTML", download},
    {"<html", "is a page of HTML", download},
    {"<?xml", "is XML", convert},
}};

constexpr std::string_view blanks = " \t\r\n\v\f";

std::string_view without_mark(std::string_view bytes) {
  return bytes.starts_with(byte_order_mark) ? bytes.substr(byte_order_mark.size()) : bytes;
}

// The first word of the first line that is neither empty nor a comment.
std::string_view first_word(std::string_view bytes) {
  for (bytes = without_mark(bytes);;) {
    const std::size_t begin = bytes.find_first_not_of(blanks);
    if (begin == std::string_view::npos) return {};
    bytes.remove_prefix(begin);
    if (bytes.front() != '#') return bytes.substr(0, bytes.find_first_of(blanks));
    bytes.remove_prefix(std::min(bytes.find('\n'), bytes.size()));
  }
}

// 84 bytes, of which the last four count facets of 50 bytes each.
bool is_binary_stl(std::string_view bytes) {
  if (bytes.size() < 84) return false;
  const auto facets = number_at<std::uint32_t>(bytes.data() + 80);
  return facets > 0 && bytes.size() == 84 + std::size_t{50} * facets;
}

bool has_text(std::string_view bytes, std::string_view text) { return bytes.find(text) != std::string_view::npos; }

bool is_obj(std::string_view bytes) {
  static constexpr std::array words = {"v"sv, "vn"sv, "vt"sv, "f"sv, "o"sv, "g"sv, "s"sv, "mtllib"sv, "usemtl"sv};
  const bool has_vertex = bytes.starts_with("v ") || has_text(bytes, "\nv ");
  return has_vertex && std::ranges::find(words, first_word(bytes)) != words.end();
}

// A line of 80 columns of which the 73rd holds the section, S to begin with, and the rest its number.
bool is_iges(std::string_view bytes) {
  return bytes.size() > 80 && bytes[72] == 'S' && bytes.substr(73, 7).find_first_not_of(" 01") == std::string_view::npos &&
         bytes[79] == '1';
}

}  // namespace

std::string_view mesh_ending_of(std::string_view bytes) {
  if (is_binary_stl(bytes)) return ".stl";
  if (bytes.starts_with("glTF")) return ".glb";
  if (bytes.starts_with("PK\x03\x04") && has_text(bytes, "3dmodel")) return ".3mf";
  const std::string_view word = first_word(bytes);
  if (word == "$MeshFormat") return ".msh";
  if (word.starts_with('{') && has_text(bytes, "\"asset\"")) return ".gltf";
  if (word == "ply") return ".ply";
  if (word.size() < 8 && word.ends_with("OFF")) return ".off";
  if (lower_case(word.substr(0, 8)) == "solid" && has_text(bytes, "vertex")) return ".stl";
  return is_obj(bytes) ? ".obj" : "";
}

std::string other_contents(std::string_view bytes) {
  const std::string_view text = without_mark(bytes),
                         from_first = text.substr(std::min(text.find_first_not_of(blanks), text.size()));
  const auto found = std::ranges::find_if(signatures, [&](const Signature& s) { return from_first.starts_with(s.begins_with); });
  if (found == signatures.end() && is_iges(bytes)) return fmt::format("is an IGES model; {}", mesh_it);
  return found == signatures.end() ? "" : fmt::format("{}; {}", found->is, found->remedy);
}

bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1F\x8B"); }

}  // namespace raytube
