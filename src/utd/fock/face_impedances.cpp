#include "utd/fock/face_impedances.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace raytube {

namespace {

FaceImpedance at_grazing(const Material& material, std::size_t frequency, double wavenumber) {
  return impedance_of(smooth_response(material, frequency, wavenumber, grazing_cosine, false).reflected, grazing_cosine);
}

// Into less dense media waves go at angles of their own: no impedance stands for them.
bool is_dense(const Material& material) {
  constexpr double least_square_of_index = 2.0;
  return std::ranges::all_of(material.layers, [](const std::vector<Layer>& layers) {
    return std::abs(layers.front().medium.permittivity * layers.front().medium.permeability) >= least_square_of_index;
  });
}

}  // namespace

bool carries_waves(std::span<const Material> materials, std::uint32_t material) {
  if (material == no_index) return true;
  const MaterialKind kind = materials[material].kind;
  if (kind == MaterialKind::half_space) return is_dense(materials[material]);
  return kind == MaterialKind::coated || kind == MaterialKind::conductor;
}

FaceImpedances::FaceImpedances(std::span<const Material> materials, std::span<const double> frequencies)
    : at_faces_(materials.size()) {
  std::vector<std::size_t> order(frequencies.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t f) { return frequencies[f]; });
  for (const std::size_t f : order) wavenumbers_.push_back(wavenumber(frequencies[f]));
  for (std::uint32_t m = 0; m < materials.size(); ++m)
    if (carries_waves(materials, m))
      for (std::size_t i = 0; i < order.size(); ++i) at_faces_[m].push_back(at_grazing(materials[m], order[i], wavenumbers_[i]));
}

FaceImpedance FaceImpedances::at(std::uint32_t material, double wavenumber) const {
  const std::vector<FaceImpedance>& known = at_faces_[material];
  const auto above = std::ranges::lower_bound(wavenumbers_, wavenumber);
  const auto i = std::min(static_cast<std::size_t>(above - wavenumbers_.begin()), known.size() - 1);
  if (i == 0 || wavenumbers_[i] == wavenumber) return known[i];
  const double share = std::min((wavenumber - wavenumbers_[i - 1]) / (wavenumbers_[i] - wavenumbers_[i - 1]), 1.0);
  const auto between = [&](const Complex& a, const Complex& b) { return a + share * (b - a); };
  return {between(known[i - 1].soft, known[i].soft), between(known[i - 1].hard, known[i].hard)};
}

}  // namespace raytube
