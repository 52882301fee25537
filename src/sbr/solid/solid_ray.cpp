#include "sbr/solid/solid_ray.h"

#include <algorithm>
#include <cmath>

namespace raytube {

namespace {

constexpr double least_cosine = 1e-9;

// The ratios in the basis of the plane of incidence, on the wave that leaves along `leaving`.
ComplexVector times(const SurfaceResponse::Polarised& ratio, const dvec3& d, const dvec3& n, const dvec3& leaving,
                    const ComplexVector& e) {
  const dvec3 t = perpendicular_axis(d, n);
  return ratio.te * dot(e, t) * t + ratio.tm * dot(e, glm::cross(d, t)) * glm::cross(leaving, t);
}

double slowness_along(const SolidHit& hit) {
  return hit.arriving.index * glm::length(glm::cross(hit.arriving.ray.direction, hit.normal));
}

dvec3 refracted_direction(const SolidHit& hit, const Refraction& behind) {
  const dvec3& d = hit.arriving.ray.direction;
  const dvec3 along = d - glm::dot(d, hit.normal) * hit.normal;
  return glm::normalize(hit.arriving.index / behind.index * along - behind.cosine * hit.normal);
}

}  // namespace

double amplitude(const SolidRay& ray, double wavenumber) {
  return std::max(norm(ray.field[0]), norm(ray.field[1])) * std::exp(-wavenumber * ray.loss);
}

SolidRay SolidWaves::launched(const dvec2& at) const {
  const LaunchGrid& grid = look_.grid;
  SolidRay ray;
  ray.point = grid.plane_origin + at.x * grid.u_hat + at.y * grid.v_hat;
  ray.ray = {ray.point, grid.direction};
  ray.path = glm::dot(grid.direction, ray.point);
  ray.field = {ComplexVector{look_.transmit.theta_hat}, ComplexVector{look_.transmit.phi_hat}};
  return ray;
}

SolidHit SolidWaves::meet(const SolidRay& ray, const Hit& hit) const {
  const Patch& plane = patch(hit.triangle);
  const dvec3& d = ray.ray.direction;
  SolidHit met{ray, hit.triangle, ray.ray.origin + hit.distance * d,
               glm::dot(plane.normal, d) > 0.0 ? -plane.normal : plane.normal, 0.0};
  met.arriving.point = met.on_facet;
  if (look_.smooth && look_.smooth->region(hit.triangle) != no_index) {
    const LocalSurface surface = look_.smooth->at(ray.point, d, hit.triangle);
    met.arriving.point = surface.point, met.normal = surface.normal;
  }
  met.length = glm::dot(met.arriving.point - ray.point, d);
  met.arriving.path += ray.index * met.length;
  met.arriving.loss += ray.attenuation * met.length;
  return met;
}

bool SolidWaves::at_own_boundary(const SolidHit& hit) const {
  return hit.arriving.material != no_index && patch(hit.triangle).material == hit.arriving.material;
}

Medium SolidWaves::medium(std::uint32_t material) const {
  if (material == no_index) return {};
  return look_.surfaces.materials[material].layers[look_.surfaces.first_frequency_index + frequency_].front().medium;
}

// Inside of a solid there are conductors and absorbers only, which do the same in any medium.
SurfaceResponse::Polarised SolidWaves::reflection(const SolidHit& hit) const {
  if (at_own_boundary(hit)) return refraction(medium(hit.arriving.material), {}, slowness_along(hit)).ratio.reflected;
  const Patch& plane = patch(hit.triangle);
  const double cosine = std::max(-glm::dot(hit.arriving.ray.direction, hit.normal), least_cosine);
  const bool from_behind = glm::dot(hit.normal, plane.normal) < 0.0;
  return look_.surfaces.response(plane.material, frequency_, cosine, from_behind).reflected;
}

SolidRay SolidWaves::leaving(const SolidHit& hit, const dvec3& direction) const {
  SolidRay ray = hit.arriving;
  ray.ray = {hit.on_facet, direction, look_.tracer.mesh().triangle_patch[hit.triangle]};
  return ray;
}

std::optional<SolidRay> SolidWaves::reflected(const SolidHit& hit) const {
  const dvec3& d = hit.arriving.ray.direction;
  const SurfaceResponse::Polarised ratio = reflection(hit);
  if (ratio.te == 0.0 && ratio.tm == 0.0) return {};
  SolidRay ray = leaving(hit, reflected_direction(d, hit.normal));
  for (ComplexVector& e : ray.field) e = times(ratio, d, hit.normal, ray.ray.direction, e);
  return ray;
}

std::optional<SolidRay> SolidWaves::refracted(const SolidHit& hit) const {
  const std::uint32_t from = hit.arriving.material, met = patch(hit.triangle).material;
  const bool out = at_own_boundary(hit);
  if (!out && (from != no_index || !is_solid(look_.surfaces.materials, met))) return {};
  const std::uint32_t into = out ? no_index : met;
  const Refraction behind = refraction(medium(from), medium(into), slowness_along(hit));
  if (behind.cosine == 0.0) return {};
  SolidRay ray = leaving(hit, refracted_direction(hit, behind));
  for (ComplexVector& e : ray.field)
    e = times(behind.ratio.transmitted, hit.arriving.ray.direction, hit.normal, ray.ray.direction, e);
  ray.material = into, ray.index = behind.index, ray.attenuation = behind.attenuation, ray.entered = true;
  return ray;
}

std::uint64_t SolidWaves::surface(std::uint32_t triangle) const {
  if (look_.smooth && look_.smooth->region(triangle) != no_index) return std::uint64_t{1} << 32 | look_.smooth->region(triangle);
  return look_.tracer.mesh().triangle_patch[triangle];
}

}  // namespace raytube
