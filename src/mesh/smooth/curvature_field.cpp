#include "mesh/smooth/curvature_field.h"

#include "mesh/model/geometry.h"

namespace raytube {

namespace {

// Of the square of a facet's sides, added to what determines its curvature (Tikhonov 1963): where it is h wide over sides of
// length l, less is told by 1e-10 (l / h)^2 of itself, and a sliver without width tells nothing.
constexpr double ridge = 1e-10;

// Least squares over the three sides: the turn along each is the difference of the normals at its ends.
SurfaceFrame turn_of(const TriangleMesh& mesh, const SmoothSurfaces& surfaces, std::uint32_t triangle) {
  const Triangle& corners = mesh.triangles[triangle];
  const dvec3 plane = mesh.patch_of(triangle).normal;
  const dvec3 u = glm::normalize(mesh.vertices[corners[1]] - mesh.vertices[corners[0]]), v = glm::cross(plane, u);
  glm::dmat3 left(0.0);
  dvec3 right(0.0);
  for (int c = 0; c < 3; ++c) {
    const int next = (c + 1) % 3;
    const dvec3 side = mesh.vertices[corners[next]] - mesh.vertices[corners[c]];
    const dvec3 turn = surfaces.normal(triangle, next) - surfaces.normal(triangle, c);
    const double x = glm::dot(side, u), y = glm::dot(side, v), p = glm::dot(turn, u), q = glm::dot(turn, v);
    left += glm::dmat3(x * x, x * y, 0, x * y, x * x + y * y, x * y, 0, x * y, y * y) + glm::dmat3(ridge * glm::dot(side, side));
    right += dvec3(x * p, y * p + x * q, y * q);
  }
  const dvec3 form = glm::inverse(left) * right;
  const auto products = [](const dvec3& a, const dvec3& b) { return dvec3(a.y * b.z, a.z * b.x, a.x * b.y); };
  return {dvec3(0.0), form.x * u * u + 2.0 * form.y * u * v + form.z * v * v,
          form.x * products(u, u) + form.y * (products(u, v) + products(v, u)) + form.z * products(v, v)};
}

}  // namespace

CurvatureField::CurvatureField(const TriangleMesh& mesh, const SmoothSurfaces& surfaces)
    : mesh_(mesh), surfaces_(surfaces), turns_(surfaces.normals()) {
  std::vector<double> areas(turns_.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (surfaces.region(t) == no_index) continue;
    const double area = mesh.twice_area(t);
    const SurfaceFrame turn = turn_of(mesh, surfaces, t);
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t i = surfaces.normal_index(t, c);
      turns_[i].squares += area * turn.square_turn;
      turns_[i].products += area * turn.product_turn;
      areas[i] += area;
    }
  }
  for (std::size_t i = 0; i < turns_.size(); ++i) {
    if (!(areas[i] > 0.0)) continue;
    turns_[i].squares /= areas[i];
    turns_[i].products /= areas[i];
  }
}

}  // namespace raytube
