#include "sbr/beams/beam.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/material.h"

namespace raytube {

Beam incident_beam(const LaunchGrid& grid, const SphericalBasis& transmit, const dvec2& anchor) {
  Beam beam{grid.direction,
            0.0,
            {transmit.theta_hat, transmit.phi_hat},
            anchor,
            grid.plane_origin + anchor.x * grid.u_hat + anchor.y * grid.v_hat,
            grid.u_hat,
            grid.v_hat,
            grid.u_hat,
            grid.v_hat};
  if (grid.curvature == 0.0) return beam;
  beam.curvature = grid.curvature;
  beam.launch_depth = grid.launch_depth();
  beam.anchor = dvec2(0.0);
  beam.base = dvec3(0.0);
  return beam;
}

Beam anchored(Beam beam, const dvec2& anchor) {
  if (beam.spherical()) return beam;
  const dvec2 step = anchor - beam.anchor;
  beam.base += step.x * beam.along_u + step.y * beam.along_v;
  beam.anchor = anchor;
  return beam;
}

Beam reflected_spherical(const Beam& beam, const Patch& plane) {
  Beam image = beam;
  image.base -= 2.0 * (glm::dot(plane.normal, beam.base) - plane.offset) * plane.normal;
  image.direction = reflected_direction(beam.direction, plane.normal);
  image.u_hat = reflected_direction(beam.u_hat, plane.normal);
  image.v_hat = reflected_direction(beam.v_hat, plane.normal);
  return image;
}

double facing(const Beam& beam, const Patch& plane) {
  const double parallel = glm::dot(plane.normal, beam.direction);
  return beam.spherical() ? parallel + beam.curvature * (plane.offset - glm::dot(plane.normal, beam.base)) : parallel;
}

Affine depth_of(const Beam& beam, const Patch& plane) {
  const double scale = 1.0 / facing(beam, plane);
  const dvec2 slope = -scale * dvec2(glm::dot(plane.normal, beam.u_hat), glm::dot(plane.normal, beam.v_hat));
  return {(plane.offset - glm::dot(plane.normal, beam.base)) * scale - glm::dot(slope, beam.anchor), slope.x, slope.y};
}

Ray tube_ray(const Beam& beam, const dvec2& at, const Patch* source, std::uint32_t source_patch) {
  if (!beam.spherical()) {
    const dvec2 step = at - beam.anchor;
    return {beam.base + step.x * beam.along_u + step.y * beam.along_v, beam.direction, source_patch};
  }
  const double depth = source ? depth_of(beam, *source)(at) : beam.launch_depth;
  const dvec3 across = at.x * beam.u_hat + at.y * beam.v_hat;
  return {point_at(beam, at, depth), glm::normalize(beam.direction + beam.curvature * across), source_patch};
}

namespace {

// Above the plane that the beam starts from.
PrismSide ahead_of(const Beam& beam, const Patch& source) {
  const double side = facing(beam, source) > 0.0 ? 1.0 : -1.0;
  return {side * source.normal, side * source.offset};
}

// The points whose launch coordinates lie within an edge.
PrismSide within(const Beam& beam, const Affine& edge) {
  const dvec3 across = edge.u * beam.u_hat + edge.v * beam.v_hat;
  if (!beam.spherical()) return {across, glm::dot(across, beam.base) - edge(beam.anchor)};
  const dvec3 axis = across + edge.c * beam.curvature * beam.direction;
  const double scale = 1.0 / glm::length(axis);
  return {scale * axis, scale * (glm::dot(axis, beam.base) - edge.c)};
}

}  // namespace

Prism prism_of(const Beam& beam, const Patch* source, const Bounds& box, const ConvexPolygon* region, double farthest,
               double radius) {
  Prism prism{beam.base, beam.u_hat, beam.v_hat, beam.direction, box.low - beam.anchor, box.high - beam.anchor, farthest};
  if (source) prism.add(ahead_of(beam, *source));
  if (region)
    for (const Corner& corner : *region) prism.add(within(beam, corner.edge));
  if (!beam.spherical()) return prism;
  const double middle = -glm::dot(beam.direction, beam.base), widest = 1.0 + beam.curvature * (middle + radius),
               narrowest = std::max(0.0, 1.0 + beam.curvature * (middle - radius));
  prism.low = glm::min(box.low * widest, box.low * narrowest);
  prism.high = glm::max(box.high * widest, box.high * narrowest);
  const bool ends = std::isfinite(farthest) && beam.curvature * farthest < 1.0;
  prism.farthest = ends ? farthest * widening_at(beam, farthest) : std::numeric_limits<double>::infinity();
  return prism;
}

}  // namespace raytube
