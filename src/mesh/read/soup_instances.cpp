#include "mesh/read/soup_instances.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/text.h"
#include "mesh/files/mesh_file.h"
#include "mesh/read/coordinate_step.h"

namespace raytube {

namespace {

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

}  // namespace raytube
