#include "scene/material.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/text.h"

namespace raytube {

namespace {

ComplexVector combined(const SurfaceResponse::Polarised& ratio, Complex te, Complex tm, const dvec3& along_te,
                       const dvec3& along_tm) {
  return ratio.te * te * along_te + ratio.tm * tm * along_tm;
}

}  // namespace

// Along d x n; any other direction at normal incidence, where both kinds of wave are the same. Close to it they differ by the
// square of the angle, so what rounding does to the direction there does not count.
dvec3 perpendicular_axis(const dvec3& d, const dvec3& n) {
  const dvec3 across = glm::cross(d, n);
  const double length = glm::length(across);
  if (length > 0.0) return across / length;
  return glm::normalize(glm::cross(d, std::abs(d.x) < 0.7 ? dvec3(1.0, 0.0, 0.0) : dvec3(0.0, 1.0, 0.0)));
}

double coat_depth(const Material& material, std::size_t frequency) {
  double depth = 0.0;
  if (material.kind == MaterialKind::coated)
    for (const Layer& layer : material.layers[frequency]) depth += layer.thickness;
  return depth;
}

bool is_solid(std::span<const Material> materials, std::uint32_t material) {
  return material < materials.size() && materials[material].kind == MaterialKind::solid;
}

bool any_solid(std::span<const Material> materials) {
  return std::ranges::any_of(materials, [](const Material& material) { return material.kind == MaterialKind::solid; });
}

std::string material_text(std::span<const Material> materials, std::uint32_t material) {
  return material < materials.size() ? fmt::format("material \"{}\"", quotable(materials[material].name)) : "a perfect conductor";
}

bool any_rough(std::span<const Material> materials) {
  return std::ranges::any_of(materials, [](const Material& material) { return material.roughness > 0.0; });
}

std::vector<Material> at_frequencies(std::vector<Material> materials, std::span<const std::size_t> frequencies) {
  for (Material& material : materials) {
    if (material.layers.empty()) continue;
    std::vector<std::vector<Layer>> layers;
    for (const std::size_t frequency : frequencies) layers.push_back(material.layers[frequency]);
    material.layers = std::move(layers);
  }
  return materials;
}

std::vector<Material> at_frequency(std::vector<Material> materials, std::size_t frequency) {
  return at_frequencies(std::move(materials), std::span(&frequency, 1));
}

SurfaceResponse smooth_response(const Material& material, std::size_t frequency, double wavenumber, double cosine,
                                bool from_behind) {
  switch (material.kind) {
    case MaterialKind::conductor:
      return perfect_conductor;
    case MaterialKind::absorber:
      return {};
    case MaterialKind::half_space:
    case MaterialKind::solid:  // of its surface alone
      return half_space_response(material.layers[frequency].front().medium, cosine);
    case MaterialKind::coated:
      return coated_response(material.layers[frequency], wavenumber, cosine);
    case MaterialKind::thin_sheet:
      return thin_sheet_response(material.resistance, material.conductance, cosine);
    case MaterialKind::sheet:
      break;
  }
  const std::vector<Layer>& layers = material.layers[frequency];
  if (!from_behind) return sheet_response(layers, wavenumber, cosine);
  return sheet_response(std::vector<Layer>(layers.rbegin(), layers.rend()), wavenumber, cosine);
}

double coherent_factor(const Material& material, double wavenumber, double cosine) {
  return std::exp(-2.0 * std::pow(wavenumber * material.roughness * cosine, 2));
}

SurfaceResponse response(const Material& material, std::size_t frequency, double wavenumber, double cosine, bool from_behind) {
  SurfaceResponse result = smooth_response(material, frequency, wavenumber, cosine, from_behind);
  const double coherent = coherent_factor(material, wavenumber, cosine);
  result.reflected.te *= coherent;
  result.reflected.tm *= coherent;
  return result;
}

SurfaceWaves waves_at_surface(const dvec3& d, const dvec3& n, const ComplexVector& e, const SurfaceResponse& response) {
  const dvec3 t = perpendicular_axis(d, n), leaving = reflected_direction(d, n);
  const Complex te = dot(e, t), tm = dot(e, glm::cross(d, t));
  SurfaceWaves waves;
  waves.reflected = combined(response.reflected, te, tm, t, glm::cross(leaving, t));
  waves.transmitted = combined(response.transmitted, te, tm, t, glm::cross(d, t));
  const ComplexVector passing = e - waves.transmitted;
  waves.electric_current = cross(n, cross(d, passing) + cross(leaving, waves.reflected));
  waves.magnetic_current = cross(-n, passing + waves.reflected);
  return waves;
}

ChannelWeights through_screen(const Material& material, std::size_t frequency, double wavenumber, const dvec3& normal,
                              const SphericalBasis& antenna) {
  const dvec3 d = -antenna.radial;
  const bool from_behind = glm::dot(d, normal) > 0.0;
  const dvec3 n = from_behind ? -normal : normal;
  const SurfaceResponse at = response(material, frequency, wavenumber, -glm::dot(d, n), from_behind);
  const auto behind = [&](const dvec3& e) -> std::array<Complex, 2> {
    const ComplexVector passing = waves_at_surface(d, n, ComplexVector{e}, at).transmitted;
    return {dot(passing, antenna.theta_hat), dot(passing, antenna.phi_hat)};
  };
  return {behind(antenna.theta_hat), behind(antenna.phi_hat)};
}

}  // namespace raytube
