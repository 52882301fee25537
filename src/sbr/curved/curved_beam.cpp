#include "sbr/curved/curved_beam.h"

#include <algorithm>
#include <cmath>

#include "math/conic.h"
#include "math/gauss.h"
#include "scene/frequency_bands.h"
#include "scene/material.h"

namespace raytube {

CurvedBeam launched_beam(const LaunchGrid& grid, const SphericalBasis& transmit, const dvec2& at) {
  CurvedBeam beam;
  beam.base = grid.plane_origin + at.x * grid.u_hat + at.y * grid.v_hat;
  beam.direction = grid.direction;
  beam.along_u = grid.u_hat, beam.along_v = grid.v_hat;
  beam.bend_u = beam.bend_v = dvec3(0.0);
  beam.field = {transmit.theta_hat, transmit.phi_hat};
  return beam;
}

CurvedBeam launched_beam(const LaunchGrid& grid, const Antenna& transmit, const dvec2& at) {
  const dvec3 across = at.x * grid.u_hat + at.y * grid.v_hat, way = grid.direction + grid.curvature * across;
  const double length = glm::length(way), narrowing = grid.narrowing();
  CurvedBeam beam;
  beam.base = grid.plane_origin + narrowing * across;
  beam.direction = way / length;
  beam.along_u = narrowing * grid.u_hat, beam.along_v = narrowing * grid.v_hat;
  const auto turn = [&](const dvec3& axis) {
    return grid.curvature / length * (axis - glm::dot(axis, beam.direction) * beam.direction);
  };
  beam.bend_u = turn(grid.u_hat), beam.bend_v = turn(grid.v_hat);
  const AntennaRay ray = transmit.ray_to(beam.base);
  beam.path = ray.path - glm::dot(beam.direction, beam.base);
  const double root = std::sqrt(std::abs(glm::dot(glm::cross(beam.along_u, beam.along_v), beam.direction)));
  beam.field = {root * ray.field[0], root * ray.field[1]};
  return beam;
}

Reception reception_at(const Antenna& receive, const dvec3& point) {
  const AntennaRay ray = receive.ray_to(point);
  return {{-ray.direction, ray.field[0], ray.field[1]},
          glm::dot(ray.direction, point) - ray.path,
          1.0 / glm::distance(receive.position(), point)};
}

namespace {

double triple(const dvec3& a, const dvec3& b, const dvec3& c) { return glm::dot(glm::cross(a, b), c); }

// How often the tube's cross-section vanishes within this distance.
int caustics_within(const CurvedBeam& beam, double distance) {
  const dvec3& d = beam.direction;
  const std::array<double, 2> roots = quadratic_roots(triple(beam.bend_u, beam.bend_v, d),
                                                      triple(beam.along_u, beam.bend_v, d) + triple(beam.bend_u, beam.along_v, d),
                                                      triple(beam.along_u, beam.along_v, d));
  return static_cast<int>(std::ranges::count_if(roots, [&](double root) { return root > 0.0 && root < distance; }));
}

// The derivative of d - 2 (d.n) n, where the normal changes by `turn`: minus the surface's curvature times the step along it.
dvec3 reflected_bend(const dvec3& d, const dvec3& bend, const dvec3& n, const dvec3& turn) {
  return bend - 2.0 * (glm::dot(bend, n) + glm::dot(d, turn)) * n - 2.0 * glm::dot(d, n) * turn;
}

}  // namespace

CurvedFootprint curved_footprint(const CurvedBeam& beam, const LocalSurface& surface, const Reception& receive) {
  const dvec3 &d = beam.direction, &n = surface.normal;
  const double distance = glm::dot(surface.point - beam.base, d), facing = glm::dot(d, n);
  const dvec3 across_u = beam.along_u + distance * beam.bend_u, across_v = beam.along_v + distance * beam.bend_v;
  const dvec3 along_u = across_u - d * (glm::dot(across_u, n) / facing),
              along_v = across_v - d * (glm::dot(across_v, n) / facing);

  CurvedFootprint f;
  f.outgoing.caustics = beam.caustics + caustics_within(beam, distance);
  constexpr std::array<Complex, 4> quarter_turns{Complex(1, 0), Complex(0, 1), Complex(-1, 0), Complex(0, -1)};
  // Amplitude 1 / sqrt(cross-section), surface per launch area cross-section / |facing|.
  f.strength = quarter_turns[f.outgoing.caustics % 4] * (std::sqrt(std::abs(triple(across_u, across_v, d))) / -facing);
  const std::array<dvec3, 2> receive_axes{receive.basis.theta_hat, receive.basis.phi_hat};
  for (int q = 0; q < 2; ++q) {
    const dvec3 current = surface_current_pec(d, beam.field[q], n);
    for (int p = 0; p < 2; ++p) f.weight[p][q] = f.strength * glm::dot(receive_axes[p], current);
    f.outgoing.field[q] = reflected_field_pec(beam.field[q], n);
  }

  // Exponent / k = s.r - L, L the optical path: its gradient is direction.dr (theorem of Malus and Dupin), so the second
  // derivatives are (s - d).r_uv - d_v.r_u. Of r_uv only the part along the ray counts here: exact for a plane wave. A receiver
  // at a finite distance turns s by minus the step across it over that distance.
  const dvec3& s = receive.basis.radial;
  const dvec3 change = s - d;
  f.phase = glm::dot(change, surface.point) - beam.path + receive.beyond;
  f.slope = {glm::dot(change, along_u), glm::dot(change, along_v)};
  const double per_height = glm::dot(change, d) / facing;
  const auto second = [&](const dvec3& a, const dvec3& b, double bend) {
    const double turned = receive.curvature * (glm::dot(a, b) - glm::dot(s, a) * glm::dot(s, b));
    return per_height * glm::dot(a, surface.curvature * b) - bend - turned;
  };
  const double mixed = second(along_u, along_v, 0.5 * (glm::dot(beam.bend_u, along_v) + glm::dot(beam.bend_v, along_u)));
  f.curvature = {second(along_u, along_u, glm::dot(beam.bend_u, along_u)), mixed, mixed,
                 second(along_v, along_v, glm::dot(beam.bend_v, along_v))};

  f.outgoing.base = surface.point;
  f.outgoing.along_u = along_u, f.outgoing.along_v = along_v;
  f.outgoing.direction = reflected_direction(d, n);
  f.outgoing.reflected = true;
  f.outgoing.bend_u = reflected_bend(d, beam.bend_u, n, -(surface.curvature * along_u));
  f.outgoing.bend_v = reflected_bend(d, beam.bend_v, n, -(surface.curvature * along_v));
  f.outgoing.path = beam.path + glm::dot(d - f.outgoing.direction, surface.point);
  return f;
}

CurvedFootprint curved_footprint(const CurvedBeam& beam, const LocalSurface& surface, const Reception& receive,
                                 const SpectralSurfaces& surfaces, const Patch& patch) {
  CurvedFootprint f = curved_footprint(beam, surface, receive);
  if (patch.material == no_index && beam.spectrum.empty()) return f;
  const bool from_behind = glm::dot(patch.normal, beam.direction) > 0.0;
  const Spectrum arriving = beam.spectrum.empty() ? plain_spectrum(beam.field, surfaces.wavenumbers.size()) : beam.spectrum;
  const Incidence incidence{beam.direction, surface.normal, patch.material, from_behind, beam.reflected};
  LeavingWaves waves = leaving_waves(surfaces, incidence, arriving, receive.basis);
  f.outgoing.spectrum = std::move(waves.reflected);
  if (surfaces.transmits(patch.material)) f.transmitted = std::move(waves.transmitted);
  if (receive.curvature != 0.0)
    for (SpectralWave& wave : f.outgoing.spectrum)
      for (double& incoherent : wave.incoherent) incoherent *= glm::dot(receive.basis.theta_hat, receive.basis.theta_hat);
  return f;
}

namespace {

// A rule of most_gauss_points follows the phase over this range [rad].
constexpr double widest_quadrature_phase = 120.0;

// Leading term of the method of stationary phase (Born & Wolf 1999, appendix III.3): all of it if the stationary point lies in
// the rectangle, else nothing.
Complex stationary_value(const CurvedFootprint& f, double k, const dvec2& half) {
  const double determinant = glm::determinant(f.curvature);
  if (determinant == 0.0) return 0.0;
  const dvec2 point = -glm::inverse(f.curvature) * f.slope;
  if (std::abs(point.x) > half.x || std::abs(point.y) > half.y) return 0.0;
  const double sign = f.curvature[0][0] + f.curvature[1][1] > 0.0 ? 1.0 : -1.0;
  return std::polar(2.0 * pi / (k * std::sqrt(std::abs(determinant))),
                    0.5 * k * glm::dot(f.slope, point) + (determinant > 0.0 ? sign * 0.5 * pi : 0.0));
}

// Range of the exponent / k over the rectangle [m].
double path_range(const CurvedFootprint& f, const dvec2& size) {
  const dvec2 half = 0.5 * size;
  return std::abs(f.slope.x) * size.x + std::abs(f.slope.y) * size.y + std::abs(f.curvature[0][0]) * half.x * half.x +
         std::abs(f.curvature[1][1]) * half.y * half.y;
}

Complex phase_integral(const CurvedFootprint& f, double k, const dvec2& size) {
  const dvec2 half = 0.5 * size;
  const double range = k * path_range(f, size);
  if (range > widest_quadrature_phase) return stationary_value(f, k, half);
  const auto rule = gauss_rule(5 + static_cast<int>(0.3 * range));
  Complex mean = 0.0;
  for (const GaussPoint& x : rule)
    for (const GaussPoint& y : rule) {
      const dvec2 w = (2.0 * dvec2(x.node, y.node) - 1.0) * half;
      mean += std::polar(x.weight * y.weight, k * (glm::dot(f.slope, w) + 0.5 * glm::dot(w, f.curvature * w)));
    }
  return size.x * size.y * mean;
}

}  // namespace

void add_far_field(ScatteringMatrix& sum, const CurvedFootprint& f, std::size_t frequency_index, double k, const dvec2& size) {
  const Complex scaled = Complex(0.0, -k / (4.0 * pi)) * std::polar(1.0, k * f.phase) * phase_integral(f, k, size);
  const Spectrum& spectrum = f.outgoing.spectrum;
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q)
      sum.at(p, q) += spectrum.empty() ? f.weight[p][q] * scaled : spectrum[frequency_index].weight[p][q] * f.strength * scaled;
}

void add_far_fields(std::vector<ScatteringMatrix>& sums, const CurvedFootprint& f, Band& band, const dvec2& size) {
  const double range = path_range(f, size);
  const bool smooth = f.outgoing.spectrum.empty() && range * sampling_wavenumber(band.wavenumbers()) <= widest_quadrature_phase;
  const ChebyshevNodes* nodes = smooth ? band.nodes(range) : nullptr;
  std::vector<Complex> samples;
  if (nodes)
    for (const double k : nodes->at) samples.push_back(phase_integral(f, k, size));
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double k = band.wavenumbers()[i];
    if (!nodes) {
      add_far_field(sums[i], f, i, k, size);
      continue;
    }
    Complex integral = 0.0;
    for (std::size_t n = 0; n < samples.size(); ++n) integral += nodes->weights[i * samples.size() + n] * samples[n];
    const Complex scaled = Complex(0.0, -k / (4.0 * pi)) * std::polar(1.0, k * f.phase) * integral;
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q) sums[i].at(p, q) += f.weight[p][q] * scaled;
  }
}

}  // namespace raytube
