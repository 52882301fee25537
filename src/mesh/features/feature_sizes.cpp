#include "mesh/features/feature_sizes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace raytube {

namespace {

// Twice the area times the normal of every triangle.
std::vector<dvec3> area_vectors(const TriangleMesh& mesh) {
  std::vector<dvec3> vectors;
  vectors.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) vectors.push_back(area_vector(mesh.vertices, t));
  return vectors;
}

// Signed angle between the normals of an edge's two triangles [rad], above zero where the surface is convex.
double crease(const TriangleMesh& mesh, const std::vector<dvec3>& areas, const EdgeTable::Edge& edge) {
  const EdgeTable::Side &side = edge.sides[0], &other = edge.sides[1];
  if (mesh.triangle_patch[side.triangle] == mesh.triangle_patch[other.triangle]) return 0.0;
  const Triangle &t = mesh.triangles[side.triangle], &u = mesh.triangles[other.triangle];
  const dvec3 &a = areas[side.triangle], &b = areas[other.triangle];
  const double angle = std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, mesh.is_turned(side, other) ? -b : b));
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

// `bends` are the angles of the three sides' creases.
double curvature(const TriangleMesh& mesh, const dvec3& area, std::uint32_t triangle, const std::array<double, 3>& bends) {
  if (bends == std::array<double, 3>{}) return 0.0;
  const Triangle& t = mesh.triangles[triangle];
  const dvec3 x = glm::normalize(mesh.vertices[t[1]] - mesh.vertices[t[0]]), y = glm::cross(glm::normalize(area), x);
  CurvatureSum sum;
  for (int corner = 0; corner < 3; ++corner) {
    const dvec3 side = mesh.vertices[t[(corner + 1) % 3]] - mesh.vertices[t[corner]];
    const double length = glm::length(side);
    // Half of the edge's crease is the neighbour's.
    sum.add(dvec2(-glm::dot(side, y), glm::dot(side, x)) / length, 0.5 * length * bends[static_cast<std::size_t>(corner)]);
  }
  return sum.largest() / (0.5 * glm::length(area));
}

std::vector<SizedArea> sizes_of_groups(const TriangleMesh& mesh, const std::vector<dvec3>& areas,
                                       const std::vector<std::uint32_t>& groups) {
  std::vector<Box> boxes(groups.empty() ? 0 : *std::ranges::max_element(groups) + 1);
  std::vector<SizedArea> sizes(boxes.size());
  for (std::size_t i = 0; i < groups.size(); ++i) {
    for (const std::uint32_t vertex : mesh.triangles[i]) boxes[groups[i]].add(mesh.vertices[vertex]);
    sizes[groups[i]].area += 0.5 * glm::length(areas[i]);
  }
  for (std::size_t i = 0; i < boxes.size(); ++i) sizes[i].size = boxes[i].diagonal();
  return sizes;
}

}  // namespace

FeatureSizes feature_sizes(const TriangleMesh& mesh, double min_wedge_angle) {
  const std::vector<dvec3> areas = area_vectors(mesh);
  std::vector<std::array<double, 3>> bends(mesh.triangles.size());  // of each triangle's sides; zero at wedges, too
  // Visits every edge once, and notes its crease on the way.
  const auto is_smooth = [&](const EdgeTable::Edge& edge) {
    if (edge.sides.size() != 2) return false;
    const double angle = crease(mesh, areas, edge);
    if (std::abs(angle) >= min_wedge_angle && !mesh.is_bend(edge.low, edge.high)) return false;
    for (const EdgeTable::Side& side : edge.sides) bends[side.triangle][side.corner] = angle;
    return true;
  };
  FeatureSizes sizes;
  sizes.faces = sizes_of_groups(mesh, areas, connected_groups(mesh.edges(), mesh.triangles.size(), is_smooth));
  sizes.components = sizes_of_groups(mesh, areas, mesh.triangle_component);
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const double area = 0.5 * glm::length(areas[i]), bent = curvature(mesh, areas[i], i, bends[i]);
    sizes.area += area;
    if (bent > 0.0) sizes.radii.push_back({1.0 / bent, area});
  }
  return sizes;
}

}  // namespace raytube
