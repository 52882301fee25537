#include "utd/surface/body_widths.h"

#include <algorithm>

#include "math/smooth_step.h"

namespace raytube {

namespace {

double width_of(const std::vector<dvec3>& points) {
  dvec3 middle(0.0), farthest(0.0);
  for (const dvec3& p : points) middle += p / static_cast<double>(points.size());
  for (const dvec3& p : points)
    if (glm::distance(p, middle) > glm::length(farthest)) farthest = p - middle;
  if (glm::length(farthest) <= 0.0) return 0.0;
  const dvec3 along = glm::normalize(farthest);
  double widest = 0.0;
  for (const dvec3& p : points) widest = std::max(widest, glm::length(glm::cross(along, p - middle)));
  return 2.0 * widest;
}

}  // namespace

std::vector<double> body_widths(const TriangleMesh& mesh) {
  std::vector<std::vector<dvec3>> points(mesh.components.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t]) points[mesh.triangle_component[t]].push_back(mesh.vertices[v]);
  std::vector<double> widths;
  for (const std::vector<dvec3>& each : points) widths.push_back(width_of(each));
  return widths;
}

double share_of_width(double width) {
  constexpr double none = 4.0, all = 6.0;
  return smooth_step((width - none) / (all - none));
}

}  // namespace raytube
