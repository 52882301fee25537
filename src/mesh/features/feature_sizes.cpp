#include "mesh/features/feature_sizes.h"

#include <algorithm>
#include <cmath>

#include "mesh/model/edge_table.h"

namespace raytube {

namespace {

double area_of(const TriangleMesh& mesh, std::size_t triangle) {
  return 0.5 * glm::length(area_vector(mesh.vertices, mesh.triangles[triangle]));
}

// Signed angle between the normals of an edge's two triangles [rad], above zero where the surface is convex.
double crease(const TriangleMesh& mesh, const EdgeTable::Edge& edge) {
  const auto& [side, other] = std::pair{edge.sides[0], edge.sides[1]};
  const Triangle &t = mesh.triangles[side.triangle], &u = mesh.triangles[other.triangle];
  const dvec3 a = area_vector(mesh.vertices, t), b = area_vector(mesh.vertices, u);
  const bool same_sense = t[side.corner] == u[(other.corner + 1) % 3];
  const double angle = std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, same_sense ? b : -b));
  const dvec3 beyond = mesh.vertices[u[(other.corner + 2) % 3]] - mesh.vertices[t[side.corner]];
  return glm::dot(a, beyond) <= 0.0 ? angle : -angle;
}

// Sums of the creases' angles times lengths across them, in a triangle's plane.
struct CurvatureSum {
  double xx = 0.0, xy = 0.0, yy = 0.0;

  void add(const dvec2& across, double weight) {
    xx += weight * across.x * across.x;
    xy += weight * across.x * across.y;
    yy += weight * across.y * across.y;
  }
  double largest() const { return std::abs(0.5 * (xx + yy)) + std::hypot(0.5 * (xx - yy), xy); }
};

double curvature(const TriangleMesh& mesh, const EdgeTable& edges, const std::vector<double>& bends, std::uint32_t triangle) {
  const Triangle& t = mesh.triangles[triangle];
  const dvec3 x = glm::normalize(mesh.vertices[t[1]] - mesh.vertices[t[0]]),
              y = glm::cross(glm::normalize(area_vector(mesh.vertices, t)), x);
  CurvatureSum sum;
  for (int corner = 0; corner < 3; ++corner) {
    const dvec3 side = mesh.vertices[t[(corner + 1) % 3]] - mesh.vertices[t[corner]];
    const double length = glm::length(side);
    // Half of the edge's crease is the neighbour's.
    sum.add(dvec2(-glm::dot(side, y), glm::dot(side, x)) / length, 0.5 * length * bends[edges.edge_of(triangle, corner)]);
  }
  return sum.largest() / area_of(mesh, triangle);
}

std::vector<SizedArea> sizes_of_groups(const TriangleMesh& mesh, const std::vector<std::uint32_t>& groups) {
  std::vector<Box> boxes(groups.empty() ? 0 : *std::ranges::max_element(groups) + 1);
  std::vector<SizedArea> sizes(boxes.size());
  for (std::size_t i = 0; i < groups.size(); ++i) {
    for (const std::uint32_t vertex : mesh.triangles[i]) boxes[groups[i]].add(mesh.vertices[vertex]);
    sizes[groups[i]].area += area_of(mesh, i);
  }
  for (std::size_t i = 0; i < boxes.size(); ++i) sizes[i].size = boxes[i].diagonal();
  return sizes;
}

}  // namespace

FeatureSizes feature_sizes(const TriangleMesh& mesh, double min_wedge_angle) {
  const EdgeTable edges(mesh.triangles, mesh.vertices.size());
  std::vector<double> bends(edges.size());  // zero at edges, too
  std::vector<bool> smooth(edges.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (edges[e].sides.size() != 2) continue;
    const double angle = crease(mesh, edges[e]);
    smooth[e] = std::abs(angle) < min_wedge_angle;
    if (smooth[e]) bends[e] = angle;
  }
  FeatureSizes sizes;
  const auto is_smooth = [&](const EdgeTable::Edge& edge) {
    return smooth[edges.edge_of(edge.sides[0].triangle, static_cast<int>(edge.sides[0].corner))];
  };
  sizes.components = sizes_of_groups(mesh, mesh.triangle_component);
  sizes.faces = sizes_of_groups(mesh, connected_groups(edges, mesh.triangles.size(), is_smooth));
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const double area = area_of(mesh, i), bent = curvature(mesh, edges, bends, i);
    sizes.area += area;
    if (bent > 0.0) sizes.radii.push_back({1.0 / bent, area});
  }
  return sizes;
}

}  // namespace raytube
