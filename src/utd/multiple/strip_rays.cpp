#include "utd/multiple/strip_rays.h"

#include <cmath>

#include "utd/fock/edge_factors.h"

namespace raytube {

namespace {

SurfaceRayPoint point_at(const StripNode& node, const StripPath& path, double k) {
  const double xi = std::cbrt(k) * node.bend, width = node.area * node.area;
  const double root = std::sqrt(2 * k) * path.wave.incidence.sin_cone * node.root;
  Reals roots{};
  roots[0] = root;
  const Strip::Currents currents = path.strip.currents(roots);
  const EdgeFactors factors = edge_factors(xi);
  // A strip is a thousandth as wide as at its edge at least: at a caustic it has no width.
  const double spread = 2.0 / std::sqrt(std::max(width, 1e-3));
  const double hard = spread * std::abs(factors.hard * currents.hard[0]);
  const double soft = root > 0.0 ? spread * std::abs(factors.soft * currents.soft[0]) / root : 0.0;
  return {node.position, node.root * node.root, xi, width, hard, soft};
}

}  // namespace

void add_rays(const StripPath& path, double wavenumber, int order, std::vector<SurfaceRay>& rays) {
  if (path.nodes.size() > 1) {
    SurfaceRay ray{SurfaceRayKind::from_an_edge, order};
    for (const StripNode& node : path.nodes) ray.points.push_back(point_at(node, path, wavenumber));
    ray.points[0].soft = ray.points[1].soft;
    rays.push_back(std::move(ray));
  }
  for (const StripPath& each : path.next) add_rays(each, wavenumber, order + 1, rays);
}

}  // namespace raytube
