#include "mesh/read/read_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>

#include "core/error.h"
#include "core/text.h"
#include "mesh/files/file_contents.h"
#include "mesh/files/mesh_file.h"
#include "mesh/files/packed.h"
#include "mesh/read/formats.h"

namespace raytube {

namespace {

std::string ending_of(const std::filesystem::path& path) { return lower_case(path.extension().string()); }

struct Format {
  std::string_view ending, name;
  MeshParser parse;
};

/// Nothing for other endings.
const Format* format_of(std::string_view ending) {
  static constexpr Format formats[] = {{".stl", "an STL file", parse_stl},         {".obj", "OBJ text", parse_obj},
                                       {".ply", "a PLY file", parse_ply},          {".off", "an OFF file", parse_off},
                                       {".msh", "a Gmsh file", parse_gmsh},        {".gltf", "glTF text", parse_gltf},
                                       {".glb", "a binary glTF file", parse_gltf}, {".3mf", "a 3MF file", parse_3mf}};
  const auto* found = std::ranges::find(formats, ending, &Format::ending);
  return found == std::end(formats) ? nullptr : found;
}

/// Throws InputError if the file shows that it is something else than its ending says; `behind` follows each ending.
void reject_other_contents(const MeshFile& file, std::string_view ending, std::string_view behind) {
  if (is_gzip(file.bytes)) file.reject("is gzip data; add .gz to its name");
  const std::string_view meant = mesh_ending_of(file.bytes);
  if (meant == ending) return;
  if (!meant.empty())
    file.reject(fmt::format("looks like {}; give its name the ending {}{}", format_of(meant)->name, meant, behind));
  if (const std::string other = other_contents(file.bytes); !other.empty()) file.reject(other);
}

bool is_finite(const dvec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// What every format must satisfy, said with numbers that count from 1.
void check(const MeshFile& file, const PolygonSoup& soup) {
  if (soup.polygons.empty()) file.reject("holds no facets; export the surface as triangles or polygons");
  for (std::size_t i = 0; i < soup.points.size(); ++i)
    if (!is_finite(soup.points[i]))
      file.reject(fmt::format("vertex {} has a coordinate that is not finite; correct it or export the mesh again", i + 1));
  for (std::size_t i = 0; i < soup.polygons.size(); ++i)
    for (const std::uint32_t corner : soup.polygons[i])
      if (corner >= soup.points.size())
        file.reject(
            fmt::format("facet {} names vertex {} (counted from 0) but there are {}; the file is damaged, export it again", i + 1,
                        corner, soup.points.size()));
}

}  // namespace

PolygonSoup read_polygon_soup(const MeshFile& file, MeshParser parse) {
  PolygonSoup soup = parse(file);
  check(file, soup);
  if (!soup.step) soup.step = coordinate_step(soup.points, soup.digits);
  return soup;
}

PolygonSoup read_polygon_soup(const std::filesystem::path& path) {
  MeshFile file = read_bytes(path);
  std::string ending = ending_of(path);
  const std::string packed = ending == ".gz" ? ending : "";
  if (!packed.empty()) {
    if (!is_gzip(file.bytes)) reject_other_contents(file, ending, "");
    file = unpacked(file, installed_memory());
    if (is_gzip(file.bytes)) file.reject("was compressed twice; unpack it once");
    ending = ending_of(path.stem());
  }
  const Format* format = format_of(ending);
  if (!format) {
    reject_other_contents(file, ending, packed);
    file.reject(
        fmt::format("the ending '{}' is not a known mesh format; use .stl, .obj, .ply, .off, .msh, .gltf, .glb or .3mf, or "
                    "one of these and .gz",
                    quotable(ending)));
  }
  try {
    return read_polygon_soup(file, format->parse);
  } catch (const InputError&) {
    reject_other_contents(file, ending, packed);  // says more than the first word that is not of the format
    throw;
  }
}

PolygonSoup read_polygon_soup(const std::filesystem::path& path, double metres_per_unit) {
  PolygonSoup soup = read_polygon_soup(path);
  const std::optional<StatedUnit>& stated = soup.stated_unit;
  if (stated && std::abs(metres_per_unit / stated->metres - 1.0) > 1e-9)
    throw InputError(fmt::format(
        "mesh file '{}': says that its unit is \"{}\" ({} m), but the unit given for it is {} m; write unit = \"{}\", or "
        "export it as STL, OBJ or PLY if its numbers are in another one",
        path.string(), stated->name, stated->metres, metres_per_unit, stated->name));
  return soup;
}

}  // namespace raytube
