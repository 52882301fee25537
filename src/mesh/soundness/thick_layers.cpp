#include "mesh/soundness/thick_layers.h"

#include <algorithm>
#include <map>

#include "mesh/model/geometry.h"

namespace raytube {

namespace {

// Patches of a component with less than this share of its area do not say in which direction it may be thin.
constexpr double least_side = 1.0 / 16.0;

struct LayeredBody {
  Box box;
  double area = 0.0;                        // [m^2]
  std::vector<std::uint32_t> triangles;     // indices
  std::map<std::uint32_t, double> patches;  // area of each [m^2]
  std::map<std::uint32_t, double> layered;  // of each material with layers [m^2]
};

// At any frequency it is the same.
double thickness_of(const Material& material) {
  double sum = 0.0;
  if (material.kind != MaterialKind::half_space && material.kind != MaterialKind::solid && !material.layers.empty())
    for (const Layer& layer : material.layers[0]) sum += layer.thickness;
  return sum;
}

std::vector<LayeredBody> bodies_of(const TriangleMesh& mesh, std::span<const Material> materials) {
  std::vector<LayeredBody> bodies(mesh.components.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    LayeredBody& body = bodies[mesh.triangle_component[t]];
    const std::uint32_t patch = mesh.triangle_patch[t], material = mesh.patches[patch].material;
    const double area = 0.5 * mesh.twice_area(t);
    for (const std::uint32_t v : mesh.triangles[t]) body.box.add(mesh.vertices[v]);
    body.triangles.push_back(t);
    body.area += area;
    body.patches[patch] += area;
    if (material < materials.size() && thickness_of(materials[material]) > 0.0) body.layered[material] += area;
  }
  return bodies;
}

double extent_along(const TriangleMesh& mesh, const LayeredBody& body, const dvec3& direction) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const std::uint32_t t : body.triangles)
    for (const dvec3& corner : mesh.corners(t)) {
      low = std::min(low, glm::dot(direction, corner));
      high = std::max(high, glm::dot(direction, corner));
    }
  return high - low;
}

// Of a body, the least across its large sides and along the axes; of a surface, its area over the longest side of its box.
double width_of(const TriangleMesh& mesh, const LayeredBody& body, bool closed) {
  const dvec3 sides = body.box.high - body.box.low;
  if (!closed) return body.area / std::max({sides.x, sides.y, sides.z});
  double width = std::min({sides.x, sides.y, sides.z});
  for (const auto& [patch, area] : body.patches)
    if (area > least_side * body.area) width = std::min(width, extent_along(mesh, body, mesh.patches[patch].normal));
  return width;
}

}  // namespace

std::vector<ThickLayers> find_thick_layers(const TriangleMesh& mesh, std::span<const Material> materials) {
  std::vector<ThickLayers> thick;
  if (std::ranges::none_of(materials, [](const Material& m) { return thickness_of(m) > 0.0; })) return thick;
  const std::vector<LayeredBody> bodies = bodies_of(mesh, materials);
  for (std::uint32_t c = 0; c < bodies.size(); ++c) {
    if (bodies[c].layered.empty()) continue;
    const bool closed = mesh.components[c].closed || mesh.components[c].penetrable;
    const double width = width_of(mesh, bodies[c], closed);
    for (const auto& [material, area] : bodies[c].layered) {
      const bool both_sides = closed && !materials[material].transmits() && area > 0.5 * bodies[c].area;
      const double thickness = thickness_of(materials[material]);
      if (thickness * (both_sides ? 2.0 : 1.0) > width)
        thick.push_back({material, c, thickness, width, closed, both_sides, bodies[c].box.middle() + mesh.center});
    }
  }
  return thick;
}

}  // namespace raytube
