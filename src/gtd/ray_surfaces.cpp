#include "gtd/ray_surfaces.h"

namespace raytube {

bool RaySurfaces::transmits(std::uint32_t index) const {
  const std::uint32_t material = patch(index).material;
  return material != no_index && materials_[material].transmits();
}

// The last place of `own` is that of the sheet that the ray leaves.
std::optional<SheetsPassed> RaySurfaces::along(dvec3 point, const dvec3& direction, IgnoredPatches own) const {
  SheetsPassed sheets;
  for (;;) {
    const std::uint32_t triangle = tracer_.blocker(point, direction, own);
    if (triangle == no_index) return sheets;
    const std::uint32_t met = mesh().triangle_patch[triangle];
    if (!transmits(met)) return std::nullopt;
    sheets.push_back(own.back() = met);
    const Patch& plane = patch(met);
    point += (plane.offset - glm::dot(plane.normal, point)) / glm::dot(plane.normal, direction) * direction;
  }
}

std::optional<SheetsPassed> RaySurfaces::outwards(const dvec3& point, const dvec3& outside, IgnoredPatches own) const {
  return along(point, glm::normalize(outside - point), own);
}

std::optional<SheetsPassed> RaySurfaces::past_target(const dvec3& from, const dvec3& to) const {
  const dvec3 direction = glm::normalize(to - from), nearest = from - glm::dot(from, direction) * direction;
  const double radius = mesh().radius;
  const bool between = glm::dot(from, direction) < 0.0 && glm::dot(to, direction) > 0.0;
  if (!between || glm::length(nearest) > radius) return SheetsPassed();
  return along(nearest - 2.0 * radius * direction, direction, nothing_ignored);
}

std::optional<SheetsPassed> RaySurfaces::to_patch(Ray ray, std::uint32_t patch) const {
  SheetsPassed sheets;
  for (Hit hit;;) {
    tracer_.closest_hits({&ray, 1}, {&hit, 1});
    if (!hit) return std::nullopt;
    const std::uint32_t met = mesh().triangle_patch[hit.triangle];
    if (met == patch) return sheets;
    if (!transmits(met)) return std::nullopt;
    sheets.push_back(met);
    ray = {ray.origin + hit.distance * ray.direction, ray.direction, met};
  }
}

template <class Keep>
void RaySurfaces::meet(std::uint32_t index, const RayFrequency& at, const dvec3& d, std::span<ComplexVector> fields,
                       Keep keep) const {
  const dvec3& normal = patch(index).normal;
  const bool from_behind = glm::dot(d, normal) > 0.0;
  const dvec3 n = from_behind ? -normal : normal;
  const Material& material = materials_[patch(index).material];
  const SurfaceResponse surface = response(material, at.index, at.wavenumber, -glm::dot(d, n), from_behind);
  for (ComplexVector& field : fields) field = keep(field, waves_at_surface(d, n, field, surface));
}

// A ray over the end of an edge has fields across another direction than that of the end: what is along `d` stays.
void RaySurfaces::pass(std::span<const std::uint32_t> sheets, const RayFrequency& at, const dvec3& d,
                       std::span<ComplexVector> fields) const {
  const auto behind = [&](const ComplexVector& field, const SurfaceWaves& waves) {
    return waves.transmitted + dot(field, d) * d;
  };
  for (const std::uint32_t sheet : sheets) meet(sheet, at, d, fields, behind);
}

void RaySurfaces::reflect(std::uint32_t index, const RayFrequency& at, const dvec3& d, std::span<ComplexVector> fields) const {
  if (patch(index).material != no_index)
    return meet(index, at, d, fields, [](const ComplexVector&, const SurfaceWaves& waves) { return waves.reflected; });
  const dvec3& normal = patch(index).normal;
  for (ComplexVector& field : fields) field = {reflected_field_pec(field.re, normal), reflected_field_pec(field.im, normal)};
}

}  // namespace raytube
