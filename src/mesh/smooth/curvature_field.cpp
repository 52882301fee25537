#include "mesh/smooth/curvature_field.h"

#include "mesh/model/geometry.h"

namespace raytube {

// The determinant of what the matrix does within the tangent plane: n . adj(M) n.
double SurfaceFrame::gaussian() const {
  const glm::dmat3& m = normal_turn;
  return glm::dot(normal,
                  normal.x * glm::cross(m[1], m[2]) + normal.y * glm::cross(m[2], m[0]) + normal.z * glm::cross(m[0], m[1]));
}

CurvatureField::CurvatureField(const TriangleMesh& mesh, const SmoothSurfaces& surfaces)
    : mesh_(mesh), surfaces_(surfaces), turns_(surfaces.normals(), glm::dmat3(0.0)) {
  std::vector<double> areas(turns_.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (surfaces.region(t) == no_index) continue;
    const double area = mesh.twice_area(t);
    const glm::dmat3 turn = of_facet(t);
    for (int c = 0; c < 3; ++c) {
      turns_[surfaces.normal_index(t, c)] += area * turn;
      areas[surfaces.normal_index(t, c)] += area;
    }
  }
  for (std::size_t i = 0; i < turns_.size(); ++i)
    if (areas[i] > 0.0) turns_[i] *= 1.0 / areas[i];
}

// Of the square of a facet's sides, added to what determines its curvature (Tikhonov 1963): where it is h wide over sides of
// length l, less is told by 1e-10 (l / h)^2 of itself, and a sliver without width tells nothing.
constexpr double ridge = 1e-10;

// Least squares over the three sides: the turn along each is the difference of the normals at its ends.
glm::dmat3 CurvatureField::of_facet(std::uint32_t triangle) const {
  const Triangle& corners = mesh_.triangles[triangle];
  const dvec3 plane = mesh_.patch_of(triangle).normal;
  const dvec3 u = glm::normalize(mesh_.vertices[corners[1]] - mesh_.vertices[corners[0]]), v = glm::cross(plane, u);
  glm::dmat3 left(0.0);
  dvec3 right(0.0);
  for (int c = 0; c < 3; ++c) {
    const int next = (c + 1) % 3;
    const dvec3 side = mesh_.vertices[corners[next]] - mesh_.vertices[corners[c]];
    const dvec3 turn = normal(triangle, next) - normal(triangle, c);
    const double x = glm::dot(side, u), y = glm::dot(side, v), p = glm::dot(turn, u), q = glm::dot(turn, v);
    left += glm::dmat3(x * x, x * y, 0, x * y, x * x + y * y, x * y, 0, x * y, y * y) + glm::dmat3(ridge * glm::dot(side, side));
    right += dvec3(x * p, y * p + x * q, y * q);
  }
  const dvec3 form = glm::inverse(left) * right;
  return form.x * glm::outerProduct(u, u) + form.y * (glm::outerProduct(u, v) + glm::outerProduct(v, u)) +
         form.z * glm::outerProduct(v, v);
}

SurfaceFrame CurvatureField::at(std::uint32_t triangle, const dvec2& l) const {
  const double weights[] = {1.0 - l.x - l.y, l.x, l.y};
  SurfaceFrame frame{dvec3(0.0), glm::dmat3(0.0)};
  for (int c = 0; c < 3; ++c) {
    frame.normal += weights[c] * normal(triangle, c);
    frame.normal_turn += weights[c] * turns_[surfaces_.normal_index(triangle, c)];
  }
  frame.normal = glm::normalize(frame.normal);
  return frame;
}

}  // namespace raytube
