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

constexpr int fewest_rounded_digits = 5;  // what has fewer was written by hand, and means what it says
constexpr int digits_of_single = 8;       // text that can tell neighbouring numbers of single precision apart
constexpr int bits_of_single = 23;        // behind the first one

constexpr double beyond_single = 1e38;  // such files are refused

double single_step(double x) { return std::ldexp(1.0, std::ilogb(x) - bits_of_single); }

void check_triangle_corners(const MeshFile& file, std::size_t points, const Triangles& triangles,
                            const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (const std::uint32_t corner : triangles[i])
      if (corner >= points)
        file.reject(fmt::format(
            "triangle {} of '{}' names vertex {} (counted from 0) but there are {}; the file is damaged, export it again", i + 1,
            quotable(names.empty() ? "" : names.back()), corner, points));
}

}  // namespace

double coordinate_step(std::span<const dvec3> points, int digits) {
  dvec3 largest(0.0);  // along each axis
  for (const dvec3& p : points)
    for (int axis = 0; axis < 3; ++axis)
      largest[axis] = std::isfinite(p[axis]) ? std::max(largest[axis], std::abs(p[axis])) : beyond_single;
  const double farthest = std::max({largest.x, largest.y, largest.z});
  if (farthest == 0.0 || farthest >= beyond_single) return 0.0;
  const double of_digits = digits < fewest_rounded_digits ? 0.0 : std::pow(10.0, std::floor(std::log10(farthest)) + 1 - digits);
  if (digits > 0 && digits < digits_of_single) return of_digits;
  // Round numbers are numbers of single precision, too, but leave its last bits at 0.
  double step = of_digits;
  for (const dvec3& p : points)
    for (int axis = 0; axis < 3; ++axis) {
      const double nearest = static_cast<float>(p[axis]);
      if (std::abs(p[axis] - nearest) > 0.5 * of_digits) return of_digits;
      const bool is_large = nearest != 0.0 && 2.0 * std::abs(nearest) > largest[axis];
      if (is_large && std::fmod(nearest, 16.0 * single_step(nearest)) != 0.0) step = std::max(step, single_step(largest[axis]));
    }
  return step;
}

void add_instance(const MeshFile& file, std::uintmax_t bytes, const std::vector<glm::dvec3>& points, const Triangles& triangles,
                  const glm::dmat4& place, const std::vector<std::string>& names, PolygonSoup& soup) {
  check_triangle_corners(file, points.size(), triangles, names);
  check_repetition(file, bytes, std::max(soup.polygons.size() + triangles.size(), soup.points.size() + points.size()));
  const glm::dmat3 turn(place);
  const double stretch = std::max({glm::length(turn[0]), glm::length(turn[1]), glm::length(turn[2])});
  soup.step = std::max(soup.step.value_or(0.0), stretch * coordinate_step(points, soup.digits));
  const auto first = static_cast<std::uint32_t>(soup.points.size());
  for (const glm::dvec3& p : points) soup.points.emplace_back(place * glm::dvec4(p, 1.0));
  const bool mirrored = glm::determinant(turn) < 0.0;
  const std::uint32_t list = soup.names.list(names);
  for (const auto& [a, b, c] : triangles) {
    soup.names.give(soup.polygons.size(), list);
    soup.polygons.push_back({first + a, first + (mirrored ? c : b), first + (mirrored ? b : c)});
  }
}

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
