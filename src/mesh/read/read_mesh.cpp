#include "mesh/read/read_mesh.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string_view>

#include "core/error.h"
#include "core/text.h"
#include "mesh/read/file_contents.h"
#include "mesh/read/formats.h"
#include "mesh/read/gzip.h"

namespace raytube {

void MeshFile::reject(const std::string& sentence) const { throw InputError(fmt::format("mesh file '{}': {}", name, sentence)); }

namespace {

std::uintmax_t installed_memory() {
  return static_cast<std::uintmax_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uintmax_t>(sysconf(_SC_PAGE_SIZE));
}

MeshFile read_bytes(const std::filesystem::path& path) {
  MeshFile file{path.string(), {}};
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    file.reject(fmt::format("not found; check the path, which in a case file is relative to it{}", backslash_remedy(file.name)));
  if (std::filesystem::is_directory(path, error)) file.reject("is a folder; name the mesh file in it");
  if (!std::filesystem::is_regular_file(path, error)) file.reject("is a pipe or a device; copy the mesh into a file");
  if (std::filesystem::file_size(path, error) > installed_memory())
    file.reject("is larger than this machine's memory; take a larger machine, or divide the mesh");
  std::ifstream stream(path, std::ios::binary);
  file.bytes.assign(std::istreambuf_iterator<char>(stream), {});
  if (!stream) file.reject("cannot be read; check its permissions");
  if (file.bytes.empty()) file.reject("is empty; export the mesh again");
  return file;
}

std::string ending_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

MeshParser parser_of(std::string_view ending) {
  if (ending == ".stl") return parse_stl;
  if (ending == ".obj") return parse_obj;
  if (ending == ".ply") return parse_ply;
  if (ending == ".off") return parse_off;
  return nullptr;
}

std::string_view format_name(std::string_view ending) {
  return ending == ".stl" ? "an STL file" : ending == ".obj" ? "OBJ text" : ending == ".ply" ? "a PLY file" : "an OFF file";
}

/// Throws InputError if the file shows that it is something else than its ending says; `behind` follows each ending.
void reject_other_contents(const MeshFile& file, std::string_view ending, std::string_view behind) {
  if (is_gzip(file.bytes)) file.reject("is gzip data; add .gz to its name");
  if (const std::string other = other_contents(file.bytes); !other.empty()) file.reject(other);
  if (const std::string_view meant = mesh_ending_of(file.bytes); !meant.empty() && meant != ending)
    file.reject(fmt::format("looks like {}; give its name the ending {}{}", format_name(meant), meant, behind));
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
  const MeshParser parse = parser_of(ending);
  if (!parse) {
    reject_other_contents(file, ending, packed);
    file.reject(fmt::format("the ending '{}' is not a known mesh format; use .stl, .obj, .ply or .off, or one of these and .gz",
                            quotable(ending)));
  }
  try {
    return read_polygon_soup(file, parse);
  } catch (const InputError&) {
    reject_other_contents(file, ending, packed);  // says more than the first word that is not of the format
    throw;
  }
}

}  // namespace raytube
