#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>

#include "error.h"
#include "mesh/formats.h"

namespace raytube {

void MeshFile::reject(const std::string& sentence) const { throw InputError(fmt::format("mesh file '{}': {}", name, sentence)); }

namespace {

MeshFile read_bytes(const std::filesystem::path& path) {
  MeshFile file{path.string(), {}};
  std::error_code error;
  if (!std::filesystem::exists(path, error)) file.reject("not found; check the path, which is relative to the case file");
  if (std::filesystem::is_directory(path, error)) file.reject("is a folder; name the mesh file in it");
  std::ifstream stream(path, std::ios::binary);
  file.bytes.assign(std::istreambuf_iterator<char>(stream), {});
  if (!stream) file.reject("cannot be read; check its permissions");
  if (file.bytes.empty()) file.reject("is empty; export the mesh again");
  return file;
}

PolygonSoup parse(const MeshFile& file, std::string ending) {
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".stl") return parse_stl(file);
  if (ending == ".obj") return parse_obj(file);
  if (ending == ".ply") return parse_ply(file);
  if (ending == ".off") return parse_off(file);
  file.reject(fmt::format("the ending '{}' is not a known mesh format; use .stl, .obj, .ply or .off", ending));
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

PolygonSoup read_polygon_soup(const std::filesystem::path& path) {
  const MeshFile file = read_bytes(path);
  PolygonSoup soup = parse(file, path.extension().string());
  check(file, soup);
  return soup;
}

LoadedMesh load_mesh(const std::filesystem::path& file, double metres_per_unit) {
  return build_mesh(read_polygon_soup(file), metres_per_unit, file.string());
}

}  // namespace raytube
