#include "solve/physical_bound.h"

#include <algorithm>

namespace raytube {

namespace {

double exposed_surface(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) sum += (mesh.closed(t) ? 0.5 : 1.0) * mesh.twice_area(t);
  return sum;
}

// From nearby the apparent amplitude of what is nearest to an antenna is this many times that from afar, at most.
double nearness(const TriangleMesh& mesh, double range) {
  const double reach = glm::length(mesh.center) + mesh.radius;
  return std::isinf(range) ? 1.0 : 1.0 / std::max(0.05, 1.0 - reach / range);
}

}  // namespace

PhysicalBounds::PhysicalBounds(const SolvePlan& plan, std::vector<double> edge_lengths)
    : plan_(plan), edge_lengths_(std::move(edge_lengths)), surface_(exposed_surface(plan.target.mesh)) {
  const Box box = bounding_box(plan.target.mesh.vertices);
  box_ = box.high - box.low;
}

// Of the bounding box.
double PhysicalBounds::projected_area(const dvec3& direction) const {
  return glm::dot(glm::abs(direction), dvec3(box_.y * box_.z, box_.z * box_.x, box_.x * box_.y));
}

PhysicalBound PhysicalBounds::of(const Look& look, std::size_t frequency_index) const {
  const TriangleMesh& mesh = plan_.target.mesh;
  const double near = nearness(mesh, look.transmit_range) * nearness(mesh, look.receive_range);
  const double per_area = near * wavenumber(plan_.sweep.frequencies[frequency_index]) / (2 * pi);
  const double all = per_area * surface_, length = near * edge_lengths_[frequency_index];
  const bool monostatic = look.far() && look.transmit == look.receive;
  const double projected = per_area * projected_area(spherical_basis(look.transmit).radial);
  const double edges = length + (monostatic ? 0.0 : all);
  return {monostatic ? std::min(all, projected) : all, all, {all, edges, plan_.edges.order}};
}

}  // namespace raytube
