#include "sbr/curved/near_facet.h"

#include <algorithm>
#include <cmath>

#include "sbr/beams/current_map.h"
#include "sbr/beams/spherical_look.h"

namespace raytube {

namespace {

// |facing| of a facet below which no cell divides it: a facet seen at a flatter angle is in one cell as a whole.
constexpr double least_facing = 1e-6;

Patch plane_of(const BentFacet& facet) {
  const auto& [a, b, c] = facet.corners();
  const dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
  return {normal, glm::dot(normal, a)};
}

}  // namespace

NearFacets::NearFacets(const TubeLook& look)
    : look_(look), beam_(incident_beam(look.grid, look.transmit, dvec2(0.0))), band_(look.wavenumbers()) {
  sums_.at(0, look.wavenumbers().size());
}

void NearFacets::light(std::uint32_t triangle) {
  const BentFacet facet = look_.smooth->facet(triangle);
  add(triangle, outline_of(facet), [&] { return look_.spherical->add({sums_, band_}, facet, material(triangle)); });
}

void NearFacets::light(std::uint32_t triangle, const ConvexPolygon& part) {
  const BentFacet facet = seen(triangle);
  const Patch plane = plane_of(facet);
  if (!(std::abs(facing(beam_, plane)) > least_facing)) return;
  add(triangle, part, [&] {
    look_.spherical->add({sums_, band_}, facet, material(triangle), points_on(plane, part));
    return true;
  });
}

bool NearFacets::is_lit_beyond_horizon(std::uint32_t triangle) const {
  const TriangleMesh& mesh = look_.tracer.mesh();
  const BentFacet facet = look_.smooth->facet(triangle);
  if (!mesh.closed(triangle) || facing(beam_, plane_of(facet)) < 0.0) return false;
  return std::ranges::any_of(facet.corners(), [&](const dvec3& corner) {
    const SurfacePoint at = facet.over(corner);
    const dvec3 way = look_.spherical->antennas().transmit.position() - at.point;
    if (glm::dot(at.normal, way) <= 0.0) return false;
    const std::uint32_t blocker =
        look_.tracer.blocker(at.point, glm::normalize(way), {mesh.triangle_patch[triangle], no_index, no_index});
    return blocker == no_index || look_.smooth->region(blocker) == look_.smooth->region(triangle);
  });
}

void NearFacets::light(TubeSums& to, int bounce, const SurfacesMet& met, std::uint32_t triangle, const ConvexPolygon& part) {
  const BentFacet facet = seen(triangle);
  const Patch plane = plane_of(facet);
  if (!(std::abs(facing(beam_, plane)) > least_facing)) return;
  look_.spherical->add({to, band_}, bounce, facet, met, points_on(plane, part));
  if (!look_.map) return;
  const SphericalLook at_frequency = look_.spherical->at_frequency(look_.map->frequency_index());
  Band one(at_frequency.wavenumbers());
  const auto radiated = [&](const ConvexPolygon& of) {
    TubeSums alone;
    at_frequency.add({alone, one}, 0, facet, met, points_on(plane, of));
    return alone.bounces[0][0];
  };
  look_.map->add(
      bounce, part, [&](const dvec2&) { return triangle; }, radiated(part), radiated);
}

ConvexPolygon NearFacets::outline_of(std::uint32_t triangle) const { return outline_of(look_.smooth->facet(triangle)); }

TubeSums NearFacets::take() {
  sums_.tubes = sums_.hits[0];
  return std::move(sums_);
}

// Open surfaces from the side the antenna is on.
BentFacet NearFacets::seen(std::uint32_t triangle) const {
  const BentFacet facet = look_.smooth->facet(triangle);
  return !look_.tracer.mesh().closed(triangle) && facing(beam_, plane_of(facet)) > 0.0 ? facet.turned() : facet;
}

std::uint32_t NearFacets::material(std::uint32_t triangle) const {
  const TriangleMesh& mesh = look_.tracer.mesh();
  return mesh.patch_of(triangle).material;
}

ConvexPolygon NearFacets::outline_of(const BentFacet& facet) const {
  std::array<dvec2, 3> corners;
  std::ranges::transform(facet.corners(), corners.begin(), [&](const dvec3& r) { return launch_coordinates(beam_, r); });
  ConvexPolygon outline;
  set_corners(outline, corners);
  return outline;
}

std::span<const dvec3> NearFacets::points_on(const Patch& plane, const ConvexPolygon& part) {
  const Affine depth = depth_of(beam_, plane);
  points_.clear();
  for (const Corner& corner : part) points_.push_back(point_at(beam_, corner.at, depth(corner.at)));
  return points_;
}

template <class Radiate>
void NearFacets::add(std::uint32_t triangle, const ConvexPolygon& part, Radiate radiate) {
  const std::size_t f = look_.map ? look_.map->frequency_index() : 0;
  const ScatteringMatrix before = sums_.bounces[0][f];
  if (!radiate()) return;
  ++sums_.hits[0];
  if (look_.map) add_to_map(triangle, part, sums_.bounces[0][f] - before);
}

// Cut up where the antenna sees the facet's plane.
void NearFacets::add_to_map(std::uint32_t triangle, const ConvexPolygon& outline, const ScatteringMatrix& whole) {
  const BentFacet facet = seen(triangle);
  const Patch plane = plane_of(facet);
  if (!(std::abs(facing(beam_, plane)) > least_facing)) return look_.map->add(0, middle(outline), triangle, whole);
  const SphericalLook at_frequency = look_.spherical->at_frequency(look_.map->frequency_index());
  Band one(at_frequency.wavenumbers());
  look_.map->add(
      0, outline, [&](const dvec2&) { return triangle; }, whole,
      [&](const ConvexPolygon& part) {
        TubeSums alone;
        at_frequency.add({alone, one}, facet, material(triangle), points_on(plane, part));
        return alone.bounces[0][0];
      });
}

}  // namespace raytube
