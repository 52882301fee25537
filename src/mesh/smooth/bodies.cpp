#include "mesh/smooth/bodies.h"

#include <algorithm>
#include <cmath>

#include "mesh/features/convexity.h"
#include "mesh/model/geometry.h"
#include "mesh/model/point_tree.h"
#include "mesh/model/triangle_pairs.h"

namespace raytube {

namespace {

// The part of the space about a component from which all others keep away, in its radii.
constexpr double clear_radii = 2.0;

// A component by itself, and the ball about its centroid that holds it.
struct Body {
  TriangleMesh mesh{};  // vertices, triangles and the component
  dvec3 middle{0.0};
  double radius = 0.0;  // [m]
};

std::vector<Body> components_of(const TriangleMesh& mesh) {
  std::vector<Body> bodies(mesh.components.size());
  std::vector<std::uint32_t> copies(mesh.vertices.size(), no_index);
  for (std::uint32_t c = 0; c < bodies.size(); ++c) bodies[c].mesh.components = {mesh.components[c]};
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    bodies[mesh.triangle_component[t]].mesh.triangles.push_back(mesh.triangles[t]);
  for (Body& body : bodies) {
    for (Triangle& triangle : body.mesh.triangles)
      for (std::uint32_t& v : triangle) {
        std::vector<dvec3>& own = body.mesh.vertices;
        if (copies[v] >= own.size() || own[copies[v]] != mesh.vertices[v]) {
          copies[v] = static_cast<std::uint32_t>(own.size());
          own.push_back(mesh.vertices[v]);
        }
        v = copies[v];
      }
  }
  return bodies;
}

// By area, so that neither the axes nor the tessellation move the middle.
void enclose(Body& body) {
  dvec3 sum(0.0);
  double areas = 0.0;
  for (const Triangle& t : body.mesh.triangles) {
    const double area = glm::length(area_vector(body.mesh.vertices, t));
    sum += area / 3.0 * (body.mesh.vertices[t[0]] + body.mesh.vertices[t[1]] + body.mesh.vertices[t[2]]);
    areas += area;
  }
  body.middle = areas > 0.0 ? sum / areas : body.mesh.vertices[0];
  for (const dvec3& v : body.mesh.vertices) body.radius = std::max(body.radius, glm::distance(v, body.middle));
}

double distance_to_triangle(const dvec3& p, const dvec3& a, const dvec3& b, const dvec3& c) {
  const dvec3 across = area_vector(a, b, c);
  const auto inside = [&](const dvec3& from, const dvec3& to) {
    return glm::dot(glm::cross(to - from, p - from), across) >= 0.0;
  };
  if (across != dvec3(0.0) && inside(a, b) && inside(b, c) && inside(c, a))
    return std::abs(glm::dot(glm::normalize(across), p - a));
  return std::min({distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
}

bool stands_apart(const Body& body, std::uint32_t component, const FaceTree& faces) {
  if (!body.mesh.components[0].closed) return false;
  const TriangleMesh& mesh = faces.mesh();
  const double clear = clear_radii * body.radius;
  const auto keeps_away = [&](std::uint32_t t) {
    const auto [a, b, c] = mesh.corners(t);
    return mesh.triangle_component[t] == component || distance_to_triangle(body.middle, a, b, c) > clear;
  };
  std::vector<std::uint32_t> near;
  collect_near(faces, {body.middle, body.middle, body.middle}, clear, near);
  return std::ranges::all_of(near, [&](std::uint32_t face) { return std::ranges::all_of(faces.triangles(face), keeps_away); });
}

}  // namespace

std::optional<SmoothSurfaces> bodies_apart(const FaceTree& faces, double max_crease) {
  const TriangleMesh& mesh = faces.mesh();
  std::vector<Body> bodies = components_of(mesh);
  for (Body& body : bodies) enclose(body);
  std::vector<bool> taken;
  for (std::uint32_t c = 0; c < bodies.size(); ++c) taken.push_back(stands_apart(bodies[c], c, faces));
  if (std::ranges::find(taken, true) == taken.end()) return {};
  SmoothSurfaces surfaces(mesh, max_crease);
  std::vector<double> rises(bodies.size(), 0.0);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if (surfaces.region(t) != no_index) {
      double& rise = rises[mesh.triangle_component[t]];
      rise = std::max(rise, surfaces.rise(t));
    }
  for (std::size_t c = 0; c < bodies.size(); ++c)
    taken[c] = taken[c] && rises[c] > 0.0 && convex_up_to(bodies[c].mesh, most_dent * rises[c]);
  surfaces.keep_components(taken);
  if (!surfaces.any()) return {};
  return surfaces;
}

}  // namespace raytube
