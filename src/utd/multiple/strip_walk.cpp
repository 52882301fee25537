#include "utd/multiple/strip_walk.h"

#include <algorithm>
#include <cmath>

#include "utd/surface/geodesic_march.h"

namespace raytube {

namespace {

constexpr double root_step = 0.1;         // of the root of the wavelength, between points of a strip
constexpr double longest_step = 0.25;     // of the wavelength
constexpr double curvature_step = 0.125;  // of the wavelength, between points where the surface is asked for its curvature
constexpr double last_bend = 12.0;        // xi beyond which nothing is left
constexpr std::size_t usual_nodes = 64;
constexpr double same_end = 1e-9;  // of the wavelength

/// Points of the strip stand in steps of its own, not at the sides of facets, which may be many: steps of the root of the
/// distance, in which currents are smooth near the edge.
double next_distance(double distance, double wavelength) {
  const double root = std::sqrt(distance), step = root_step * std::sqrt(wavelength);
  return std::min((root + step) * (root + step), distance + longest_step * wavelength);
}

void put(const StripScene& scene, const GeodesicMarch& march, StripPath& path) {
  const dvec3 &direction = march.direction(), aside = glm::cross(direction, march.normal());
  const double sine = path.wave.incidence.sin_cone, cosine = path.wave.incidence.cos_cone;
  path.length = march.distance();
  path.end = march.position();
  StripNode node{path.end,
                 std::sqrt(path.length),
                 glm::dot(scene.look.scattered, path.end - path.start) - path.length,
                 march.way().bend(),
                 std::sqrt(std::abs(march.width().width)),
                 march.width().caustics,
                 {},
                 {}};
  const double scale = path.wave.sign / (2 * pi * sine), cotangent = cosine / sine;
  for (int p = 0; p < 2; ++p) {
    const double on = scale * glm::dot(scene.look.receive[p], direction), off = scale * glm::dot(scene.look.receive[p], aside);
    node.across[p] = sine * on - cosine * off;
    node.along[p] = cotangent * on + off;
  }
  path.nodes.push_back(node);
}

}  // namespace

StripArrival walk_strip(const StripScene& scene, StripPath& path) {
  const WedgeFace& face = scene.wedges[path.wave.wedge].faces[path.wave.face];
  const auto start = scene.curved->at(path.wave.wedge, path.wave.face, path.start);
  if (!start) return {};
  const double lowest = std::cbrt(2 * pi / scene.longest);
  GeodesicMarch march(scene.curved->target(), *start, path.wave.direction, face.back ? -1.0 : 1.0,
                      curvature_step * scene.shortest);
  const auto faded = [&] { return lowest * march.way().bend() >= last_bend; };
  path.nodes.reserve(usual_nodes);
  put(scene, march, path);
  while (march.march_to(next_distance(path.length, scene.shortest)) && !faded()) put(scene, march, path);
  if (march.lost() || faded()) return {};
  if (march.distance() > path.length + same_end * scene.shortest) put(scene, march, path);
  if (march.ended_at() < 0) return {};
  return {scene.curved->at(march.triangle(), march.ended_at(), face.back), march.direction()};
}

}  // namespace raytube
