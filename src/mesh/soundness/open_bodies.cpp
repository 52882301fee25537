#include "mesh/soundness/open_bodies.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace raytube {

namespace {

using Segment = std::array<std::uint32_t, 2>;
using Border = std::vector<Segment>;

struct OpenComponent {
  bool body = true;   // may be one
  double area = 0.0;  // [m^2]
  std::vector<Border> borders;
};

// Free edges of one component that hang together are one border.
void add_borders(const TriangleMesh& mesh, std::vector<OpenComponent>& components) {
  const EdgeTable& edges = mesh.edges();
  std::vector<std::pair<std::uint32_t, Segment>> free;  // with their components
  DisjointSets joined(mesh.vertices.size());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto [low, high, sides] = edges[e];
    if (sides.size() != 1) continue;
    free.push_back({mesh.triangle_component[sides[0].triangle], {low, high}});
    joined.join(high, low);
  }
  std::map<std::array<std::uint32_t, 2>, Border> borders;
  for (const auto& [component, edge] : free) borders[{component, joined.root(edge[0])}].push_back(edge);
  for (auto& [key, border] : borders) components[key[0]].borders.push_back(std::move(border));
}

std::vector<OpenComponent> components_of(const TriangleMesh& mesh, const std::vector<bool>& enclosed,
                                         std::span<const Material> materials) {
  std::vector<OpenComponent> components(mesh.components.size());
  for (std::size_t c = 0; c < components.size(); ++c) components[c].body = !mesh.components[c].closed && !enclosed[c];
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    OpenComponent& component = components[mesh.triangle_component[t]];
    component.area += 0.5 * mesh.twice_area(t);
    const std::uint32_t material = mesh.patch_of(t).material;
    if (material < materials.size() && materials[material].transmits()) component.body = false;
  }
  return components;
}

// The fan of a border from its middle closes the hole; so would a surface of no more than the area of a disc as long around.
Hole hole_of(const TriangleMesh& mesh, const Border& border) {
  Hole hole;
  for (const auto& [low, high] : border) {
    const dvec3 &a = mesh.vertices[low], &b = mesh.vertices[high];
    hole.border += glm::distance(a, b);
    hole.middle += 0.5 * glm::distance(a, b) * (a + b);
  }
  hole.middle /= hole.border;
  for (const auto& [low, high] : border)
    hole.area += 0.5 * glm::length(area_vector(hole.middle, mesh.vertices[low], mesh.vertices[high]));
  hole.area = std::min(hole.area, hole.border * hole.border / (4.0 * pi));
  hole.middle += mesh.center;
  return hole;
}

void add_body(const std::vector<Hole>& holes, double area, std::uint32_t component, OpenBodies& bodies) {
  ++bodies.count;
  bodies.holes += holes.size();
  bodies.share += area;
  const Hole& largest = *std::ranges::max_element(holes, {}, &Hole::area);
  if (bodies.count > 1 && largest.area <= bodies.largest.area) return;
  bodies.component = component;
  bodies.area = area;
  bodies.largest = largest;
}

}  // namespace

OpenBodies find_open_bodies(const TriangleMesh& mesh, const std::vector<bool>& enclosed, std::span<const Material> materials) {
  std::vector<OpenComponent> components = components_of(mesh, enclosed, materials);
  OpenBodies bodies;
  if (std::ranges::none_of(components, &OpenComponent::body)) return bodies;
  add_borders(mesh, components);
  double whole = 0.0;
  for (std::uint32_t c = 0; c < components.size(); ++c) {
    const auto& [body, area, borders] = components[c];
    whole += area;
    if (!body || borders.empty()) continue;
    std::vector<Hole> holes;
    for (const Border& border : borders) holes.push_back(hole_of(mesh, border));
    const double open = std::accumulate(holes.begin(), holes.end(), 0.0, [](double sum, const Hole& h) { return sum + h.area; });
    if (open < most_hole_share * area) add_body(holes, area, c, bodies);
  }
  bodies.share /= whole;
  return bodies;
}

}  // namespace raytube
