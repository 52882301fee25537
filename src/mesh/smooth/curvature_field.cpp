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

CurvedFacet::Neighbour neighbour(const TriangleMesh& mesh, const SmoothSurfaces& surfaces, std::uint32_t triangle, int corner) {
  if (surfaces.on_boundary(triangle, corner)) return {no_index, 0};
  const EdgeTable::Side& other = mesh.edges()[mesh.edges().edge_of(triangle, corner)].beside(triangle);
  return {other.triangle, other.corner};
}

CurvedFacet facet_of(const TriangleMesh& mesh, const SmoothSurfaces& surfaces, std::uint32_t t) {
  const auto& [x, y, z] = mesh.corners(t);
  const dvec3 across = area_vector(x, y, z), scaled = across / glm::dot(across, across);
  const auto beyond = [&](int corner) { return neighbour(mesh, surfaces, t, corner); };
  const auto corner = [&](int c) { return surfaces.normal_index(t, c); };
  return {surfaces.facet(t),         mesh.patch_of(t).normal,           glm::cross(z - x, scaled),
          glm::cross(scaled, y - x), {corner(0), corner(1), corner(2)}, {beyond(0), beyond(1), beyond(2)}};
}

}  // namespace

CurvatureField::CurvatureField(const TriangleMesh& mesh, const SmoothSurfaces& surfaces)
    : surfaces_(surfaces), facet_of_(mesh.triangles.size(), no_index), frames_(surfaces.normals()) {
  facets_.reserve(surfaces.facets());
  std::vector<double> areas(frames_.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (surfaces.region(t) == no_index) continue;
    facet_of_[t] = static_cast<std::uint32_t>(facets_.size());
    facets_.push_back(facet_of(mesh, surfaces, t));
    const double area = mesh.twice_area(t);
    const SurfaceFrame turn = turn_of(mesh, surfaces, t);
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t i = surfaces.normal_index(t, c);
      frames_[i].normal = surfaces.normal(t, c);
      frames_[i].square_turn += area * turn.square_turn;
      frames_[i].product_turn += area * turn.product_turn;
      areas[i] += area;
    }
  }
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    if (!(areas[i] > 0.0)) continue;
    frames_[i].square_turn /= areas[i];
    frames_[i].product_turn /= areas[i];
  }
}

}  // namespace raytube
