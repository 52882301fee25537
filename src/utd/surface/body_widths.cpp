#include "utd/surface/body_widths.h"

#include <algorithm>

#include "math/smooth_step.h"

namespace raytube {

namespace {

struct Body {
  dvec3 middle{0.0}, farthest{0.0};  // of its corners the mean, and the farthest of them from there [m]
  double widest = 0.0;               // their largest distance from the line through both [m]
};

}  // namespace

std::vector<double> body_widths(const TriangleMesh& mesh) {
  std::vector<Body> bodies(mesh.components.size());
  const auto for_each_corner = [&](auto look_at) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (const std::uint32_t v : mesh.triangles[t]) look_at(bodies[mesh.triangle_component[t]], mesh.vertices[v]);
  };
  const auto corners = [&](const Body& body) { return 3.0 * mesh.components[&body - bodies.data()].triangles; };
  for_each_corner([&](Body& body, const dvec3& p) { body.middle += p / corners(body); });
  for_each_corner([](Body& body, const dvec3& p) {
    if (glm::distance(p, body.middle) > glm::length(body.farthest)) body.farthest = p - body.middle;
  });
  for_each_corner([](Body& body, const dvec3& p) {
    if (body.farthest == dvec3(0.0)) return;
    body.widest = std::max(body.widest, glm::length(glm::cross(glm::normalize(body.farthest), p - body.middle)));
  });
  std::vector<double> widths;
  for (const Body& body : bodies) widths.push_back(2.0 * body.widest);
  return widths;
}

double share_of_width(double width) {
  constexpr double none = 4.0, all = 6.0;
  return smooth_step((width - none) / (all - none));
}

}  // namespace raytube
