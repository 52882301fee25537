// The parts of SphericalLook that know other than perfect conductors.
#include <algorithm>
#include <cmath>

#include "math/triangle_moments.h"
#include "sbr/beams/spherical_look.h"

namespace raytube {

SphericalLook::SpectralCurrent SphericalLook::spectral_current(const Beam& outgoing, const dvec3& r) const {
  AntennaRay ray = wave_at_first(outgoing, r);
  const AntennaRay received = antennas_.receive.ray_to(r);
  auto currents = std::make_shared<ReceivedCurrents>(received_currents(surfaces_, *outgoing.met, ray, received));
  return {r, ray.path + received.path, -ray.direction - received.direction, std::move(currents)};
}

// The transmitter's own wave; nothing where the surface turns away from it.
SphericalLook::SpectralCurrent SphericalLook::spectral_current(const BentFacet& facet, SurfacesMet met, const dvec3& r) const {
  const SurfacePoint at = facet.over(r);
  AntennaRay arriving = antennas_.transmit.ray_to(at.point);
  const AntennaRay received = antennas_.receive.ray_to(at.point);
  const SpectralCurrent dark{r, arriving.path + received.path, -arriving.direction - received.direction, nullptr};
  if (glm::dot(at.normal, arriving.direction) >= 0.0) return dark;
  met.surfaces.back().normal = at.normal;
  ReceivedCurrents currents = received_currents(surfaces_, met, arriving, received);
  for (ChannelWeights& weight : currents.weight)
    for (auto& row : weight)
      for (Complex& w : row) w *= at.stretch;
  for (auto& sigma : currents.incoherent)
    for (double& of : sigma) of *= at.stretch;
  return {r, dark.path, dark.change, std::make_shared<const ReceivedCurrents>(std::move(currents))};
}

namespace {

const ChannelWeights dark_weight{};

double square(const ChannelWeights& w) {
  return std::norm(w[0][0]) + std::norm(w[0][1]) + std::norm(w[1][0]) + std::norm(w[1][1]);
}

template <class C>
const ChannelWeights& weight_of(const C& c, std::size_t f) {
  return c.received ? c.received->weight[f] : dark_weight;
}

}  // namespace

// As of perfect conductors, with the coefficients of the frequency where it is largest: these turn with the angle as phases do.
double SphericalLook::bend_of(const SpectralTriangle& corners, const SpectralTriangle& middles) const {
  double most = 0.0;
  for (std::size_t f = 0; f < wavenumbers_.size(); ++f) {
    double largest = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const SpectralCurrent &a = corners[i], &b = corners[(i + 1) % 3], &m = middles[i];
      const Complex turn = std::polar(1.0, -highest_ * (m.path - 0.5 * (a.path + b.path)));
      ChannelWeights off = weight_of(m, f);
      for (int p = 0; p < 2; ++p)
        for (int q = 0; q < 2; ++q) off[p][q] = turn * off[p][q] - 0.5 * (weight_of(a, f)[p][q] + weight_of(b, f)[p][q]);
      squares = std::max(squares, square(off));
      largest = std::max(largest, square(weight_of(a, f)));
    }
    if (squares > 0.0) most = std::max(most, largest > 0.0 ? std::sqrt(squares / largest) : 1.0);
  }
  return most;
}

void SphericalLook::add_smooth(const Sums& sums, const SpectralTriangle& corners, const SpectralTriangle& middles,
                               double left) const {
  const double path = corners[0].path,
               size = 0.5 * glm::length(glm::cross(corners[1].point - corners[0].point, corners[2].point - corners[0].point));
  for (std::size_t f = 0; f < wavenumbers_.size(); ++f) {
    const double k = wavenumbers_[f], scale = k / (4.0 * pi) * size;
    const auto moments = triangle_moments({0.0, -k * (corners[1].path - path), -k * (corners[2].path - path)});
    const Complex factor = Complex(0.0, -scale) * std::polar(1.0, -k * path);
    for (std::size_t i = 0; i < 3; ++i) {
      const SpectralCurrent &a = corners[i], &b = corners[(i + 1) % 3], &m = middles[i];
      const ChannelWeights &at_a = weight_of(a, f), &at_b = weight_of(b, f), &at_m = weight_of(m, f);
      const Complex bent = 4.0 * std::polar(1.0, -k * (m.path - 0.5 * (a.path + b.path)));
      for (int p = 0; p < 2; ++p)
        for (int q = 0; q < 2; ++q) {
          sums.scattering[f].at(p, q) +=
              factor * (at_a[p][q] * moments[i] + (at_m[p][q] * bent - at_a[p][q] - at_b[p][q]) * moments[3 + i]);
          sums.errors[f].squares[p][q] += std::pow(scale * left, 2) * std::norm(at_m[p][q]) / 3.0;
        }
      if (!m.received || m.received->incoherent.empty()) continue;
      for (std::size_t q = 0; q < 2; ++q) sums.incoherent[f][q] += size / 3.0 * m.received->incoherent[f][q];
    }
  }
}

}  // namespace raytube
