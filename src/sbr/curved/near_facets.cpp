#include "sbr/curved/near_facets.h"

#include <algorithm>
#include <cmath>

#include "sbr/beams/current_map.h"
#include "sbr/beams/spherical_look.h"
#include "sbr/visible/beam_visibility.h"

namespace raytube {

namespace {

// Of a facet that cells divide: one seen at a flatter angle is in one of them as a whole.
constexpr double least_facing = 1e-6;

Patch plane_of(const BentFacet& facet) {
  const auto& [a, b, c] = facet.corners();
  const dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
  return {normal, glm::dot(normal, a)};
}

// The curved facets of a look, one after the other.
class NearFacets {
 public:
  explicit NearFacets(const TubeLook& look) : look_(look), beam_(incident_beam(look.grid, look.transmit, dvec2(0.0))) {
    sums_.at(0, look.wavenumbers().size());
  }

  // All of a facet.
  void light(std::uint32_t triangle) {
    const BentFacet facet = look_.smooth->facet(triangle);
    add(triangle, outline_of(facet), [&] { return look_.spherical->add(sums_, facet, material(triangle)); });
  }

  // The part of a facet that the antenna sees.
  void light(std::uint32_t triangle, const ConvexPolygon& part) {
    const BentFacet facet = seen(triangle);
    const Patch plane = plane_of(facet);
    if (!(std::abs(facing(beam_, plane)) > least_facing)) return;
    add(triangle, part, [&] {
      look_.spherical->add(sums_, facet, material(triangle), points_on(plane, part));
      return true;
    });
  }

  // A facet turned away from the antenna part of whose surface is not, with nothing in between but that surface.
  bool is_lit_beyond_horizon(std::uint32_t triangle) const {
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

  ConvexPolygon outline_of(std::uint32_t triangle) const { return outline_of(look_.smooth->facet(triangle)); }

  TubeSums take() {
    sums_.tubes = sums_.hits[0];
    return std::move(sums_);
  }

 private:
  // Open surfaces from the side the antenna is on.
  BentFacet seen(std::uint32_t triangle) const {
    const BentFacet facet = look_.smooth->facet(triangle);
    return !look_.tracer.mesh().closed(triangle) && facing(beam_, plane_of(facet)) > 0.0 ? facet.turned() : facet;
  }

  std::uint32_t material(std::uint32_t triangle) const {
    const TriangleMesh& mesh = look_.tracer.mesh();
    return mesh.patches[mesh.triangle_patch[triangle]].material;
  }

  ConvexPolygon outline_of(const BentFacet& facet) const {
    std::array<dvec2, 3> corners;
    std::ranges::transform(facet.corners(), corners.begin(), [&](const dvec3& r) { return launch_coordinates(beam_, r); });
    ConvexPolygon outline;
    set_corners(outline, corners);
    return outline;
  }

  std::span<const dvec3> points_on(const Patch& plane, const ConvexPolygon& part) {
    const Affine depth = depth_of(beam_, plane);
    points_.clear();
    for (const Corner& corner : part) points_.push_back(point_at(beam_, corner.at, depth(corner.at)));
    return points_;
  }

  template <class Radiate>
  void add(std::uint32_t triangle, const ConvexPolygon& part, Radiate radiate) {
    const std::size_t f = look_.map ? look_.map->frequency_index() : 0;
    const ScatteringMatrix before = sums_.bounces[0][f];
    if (!radiate()) return;
    ++sums_.hits[0];
    if (look_.map) add_to_map(triangle, part, sums_.bounces[0][f] - before);
  }

  // Cut up where the antenna sees the facet's plane.
  void add_to_map(std::uint32_t triangle, const ConvexPolygon& outline, const ScatteringMatrix& whole) {
    const BentFacet facet = seen(triangle);
    CurrentInParts parts(*look_.map, whole, middle(outline), triangle);
    const Patch plane = plane_of(facet);
    if (!(std::abs(facing(beam_, plane)) > least_facing)) return parts.finish();
    const SphericalLook at_frequency = look_.spherical->at_frequency(look_.map->frequency_index());
    look_.map->cut_up(outline, [&](const ConvexPolygon& part) {
      TubeSums alone;
      at_frequency.add(alone, facet, material(triangle), points_on(plane, part));
      parts.add(middle(part), triangle, alone.bounces[0][0]);
    });
    parts.finish();
  }

  const TubeLook& look_;
  Beam beam_;
  TubeSums sums_;
  std::vector<dvec3> points_;
};

bool is_curved(const TubeLook& look, std::uint32_t triangle) { return look.smooth->region(triangle) != no_index; }

// What the antenna sees of some faces.
std::vector<VisiblePart> visible_parts(const TubeLook& look, std::uint32_t begin, std::uint32_t end, TubeSums& sums) {
  std::vector<std::uint32_t> faces;
  for (std::uint32_t face = begin; face < end; ++face)
    if (is_curved(look, look.faces.faces()[face].triangle)) faces.push_back(face);
  BeamVisibility visible(look.faces, look.tracer);
  std::vector<VisiblePart> parts;
  visible.of_faces(incident_beam(look.grid, look.transmit, dvec2(0.0)), faces, parts);
  sums.sliver_area = visible.sliver_area();
  return parts;
}

}  // namespace

TubeSums light_convex_facets(const TubeLook& look, std::uint32_t begin, std::uint32_t end) {
  NearFacets facets(look);
  for (std::uint32_t t = begin; t < end; ++t)
    if (is_curved(look, t)) facets.light(t);
  return facets.take();
}

TubeSums light_visible_facets(const TubeLook& look, std::uint32_t begin, std::uint32_t end) {
  NearFacets facets(look);
  TubeSums seen;
  for (std::uint32_t face = begin; face < end; ++face)
    for (const std::uint32_t triangle : look.faces.triangles(face))
      if (is_curved(look, triangle) && facets.is_lit_beyond_horizon(triangle)) facets.light(triangle);
  for (const VisiblePart& part : visible_parts(look, begin, end, seen))
    for (const std::uint32_t triangle : look.faces.triangles(part.face)) {
      const ConvexPolygon common = intersection(part.outline, facets.outline_of(triangle));
      if (!common.empty()) facets.light(triangle, common);
    }
  TubeSums sums = facets.take();
  sums.sliver_area = seen.sliver_area;
  return sums;
}

}  // namespace raytube
