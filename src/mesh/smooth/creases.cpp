#include "mesh/smooth/creases.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "mesh/features/patch_borders.h"

namespace raytube {

namespace {

// Flatter creases are the rounding of coordinates.
constexpr double least_crease = 1e-6;

bool is_one_plane(const Patch& a, const Patch& b) { return a.normal == b.normal && a.offset == b.offset; }

// For each patch a number in common with those that it would be one patch with if all were made of the same.
std::vector<std::uint32_t> uncut_patches(const TriangleMesh& mesh) {
  DisjointSets planes(mesh.patches.size());
  const auto is_first_material = [&](const Patch& patch) { return patch.material == mesh.patches[0].material; };
  if (std::ranges::all_of(mesh.patches, is_first_material)) return planes.numbers();
  const EdgeTable& edges = mesh.edges();
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (edges[e].sides.size() != 2) continue;
    const std::uint32_t a = mesh.triangle_patch[edges[e].sides[0].triangle], b = mesh.triangle_patch[edges[e].sides[1].triangle];
    if (mesh.patches[a].material == mesh.patches[b].material || !is_one_plane(mesh.patches[a], mesh.patches[b])) continue;
    planes.join(a, b);
  }
  return planes.numbers();
}

// The corners of the convex hull of points of one plane (Andrew 1979, Another efficient algorithm for convex hulls in two
// dimensions). The furthest of the points from any line is one of them; those of a straight side, but for rounding, are left out.
std::vector<std::uint32_t> hull_of(const std::vector<dvec3>& vertices, std::vector<std::uint32_t> points, const dvec3& normal) {
  constexpr double straight = 1e-9;  // of the product of two sides
  const dvec3 across = std::abs(normal.x) < 0.8 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
  const dvec3 u = glm::normalize(glm::cross(normal, across)), v = glm::cross(normal, u);
  const auto place = [&](std::uint32_t i) { return dvec2(glm::dot(u, vertices[i]), glm::dot(v, vertices[i])); };
  const auto key = [&](std::uint32_t i) { return std::tuple(place(i).x, place(i).y, i); };
  std::ranges::sort(points, {}, key);
  std::vector<std::uint32_t> hull;
  const auto add = [&](std::uint32_t point, std::size_t least) {
    const auto turns = [&] {
      const dvec2 a = place(hull[hull.size() - 2]), b = place(hull.back()) - a, c = place(point) - a;
      return b.x * c.y - b.y * c.x > straight * glm::length(b) * glm::length(c);
    };
    while (hull.size() >= least && !turns()) hull.pop_back();
    hull.push_back(point);
  };
  for (const std::uint32_t point : points) add(point, 2);
  const std::size_t lower = hull.size();
  for (auto point = points.rbegin() + 1; point != points.rend(); ++point) add(*point, lower + 1);
  hull.pop_back();
  return hull;
}

PlaneOutlines outlines_of(const TriangleMesh& mesh, const std::vector<std::uint32_t>& plane) {
  const PatchBorders borders(mesh);
  const std::size_t planes = plane.empty() ? 0 : *std::ranges::max_element(plane) + 1;
  const TriangleRows patches = triangle_rows(planes, plane);
  PlaneOutlines outlines{{0}, {}};
  outlines.first.reserve(planes + 1);
  std::vector<std::uint32_t> corners;
  for (std::uint32_t p = 0; p < planes; ++p) {
    corners.clear();
    for (const std::uint32_t patch : patches[p]) corners.insert(corners.end(), borders[patch].begin(), borders[patch].end());
    if (corners.size() >= 4) corners = hull_of(mesh.vertices, corners, mesh.patches[patches[p].back()].normal);
    outlines.vertices.insert(outlines.vertices.end(), corners.begin(), corners.end());
    outlines.first.push_back(static_cast<std::uint32_t>(outlines.vertices.size()));
  }
  return outlines;
}

}  // namespace

Creases::Creases(const TriangleMesh& mesh, double max_turn)
    : mesh_(mesh), plane_(uncut_patches(mesh)), outlines_(outlines_of(mesh, plane_)), crossable_(mesh.edges().size()) {
  find_crossable(std::cos(max_turn));
}

void Creases::find_crossable(double least_cosine) {
  for (std::size_t e = 0; e < edges().size(); ++e) {
    const EdgeTable::Edge edge = edges()[e];
    if (!mesh_.is_surface(edge)) continue;
    const double cosine = glm::dot(mesh_.patch_of(edge.sides[0].triangle).normal, mesh_.patch_of(edge.sides[1].triangle).normal);
    const bool bends = mesh_.is_bend(edge.low, edge.high);
    crossable_[e] = bends || cosine > least_cosine;
    if (bends) continue;
    if (crossable_[e])
      steepest_crossed_ = std::min(steepest_crossed_, cosine);
    else
      flattest_left_ = std::max(flattest_left_, cosine);
  }
}

bool Creases::is_crease(const EdgeTable::Edge& edge) const {
  const EdgeTable::Side &a = edge.sides[0], &b = edge.sides[1];
  return glm::length(mesh_.patch_of(a.triangle).normal - mesh_.patch_of(b.triangle).normal) > least_crease;
}

double Creases::width(const EdgeTable::Edge& edge, const EdgeTable::Side& side) const {
  const double length = glm::length(mesh_.vertices[edge.high] - mesh_.vertices[edge.low]);
  return mesh_.twice_area(side.triangle) / length;
}

bool Creases::reaches(std::uint32_t plane, const EdgeTable::Edge& edge, double width) const {
  const dvec3 start = mesh_.vertices[edge.low], along = glm::normalize(mesh_.vertices[edge.high] - start);
  const auto is_far = [&](std::uint32_t v) { return glm::length(glm::cross(mesh_.vertices[v] - start, along)) > width; };
  const auto outline = outlines_.vertices.begin();
  return std::any_of(outline + outlines_.first[plane], outline + outlines_.first[plane + 1], is_far);
}

}  // namespace raytube
