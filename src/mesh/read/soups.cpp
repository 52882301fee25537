#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/text.h"
#include "mesh/read/formats.h"

namespace raytube {

namespace {

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

}  // namespace raytube
