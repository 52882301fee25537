#include "utd/surface/lit_frame.h"

#include <algorithm>
#include <cmath>

#include "utd/fock/impedance_fock.h"
#include "utd/wedge/rounding_guard.h"

namespace raytube {

namespace {

dvec3 across(const dvec3& incident, const dvec3& normal) {
  const dvec3 side = glm::cross(incident, normal);
  if (glm::dot(side, side) > 1e-24) return glm::normalize(side);
  return glm::normalize(glm::cross(incident, std::abs(incident.x) < 0.8 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
}

// What physical optics lacks fades out over xi from -4 to -5, to 1e-6 of its current, smoothly, so that amplitudes are smooth in
// k.
double fading(double xi) {
  if (xi <= -least_lit) return 0.0;
  const double cube = xi * xi * xi / (least_lit * least_lit * least_lit);
  return std::exp(-8.0 * std::pow(cube, 8));
}

}  // namespace

LitFrame::LitFrame(const SurfaceFrame& frame, const dvec3& incident_direction) : normal(frame.normal) {
  cosine = std::max(-glm::dot(normal, incident_direction), rounding_guard);
  const dvec3 v = across(incident_direction, normal), u = glm::cross(v, incident_direction);
  const auto tangent = [&](const dvec3& w) { return w - (glm::dot(normal, w) / -cosine) * incident_direction; };
  const dvec3 a = tangent(u), b = tangent(v);
  const double uu = frame.curvature(a), uv = glm::dot(a, frame.turn(b)), vv = frame.curvature(b);
  const double mean = 0.5 * (uu + vv), half = 0.5 * (uu - vv), radius = std::sqrt(half * half + uv * uv);
  // (half, uv) / radius are cosine and sine of twice the angle from u to the axis
  const double share = radius > 0.0 ? 0.5 * (1.0 + std::abs(half) / radius) : 1.0;
  const double larger = std::sqrt(share), smaller = radius > 0.0 ? 0.5 * uv / (radius * larger) : 0.0;
  bent = half >= 0.0 ? larger * u + smaller * v : std::abs(smaller) * u + std::copysign(larger, uv) * v;
  straight = glm::cross(incident_direction, bent);
  const double hollow = std::min(mean - radius, 0.0);
  // A flat surface has the least bend [1/m] that leaves the cube of xi a number.
  bend = std::max((mean + radius - std::max(mean - radius, 0.0) + hollow) / cosine, 1e-100);
}

FockCurrents lit_excess(const LitFrame& frame, double wavenumber) {
  const double xi = std::min(frame.distance(wavenumber), -rounding_guard), left = fading(xi);
  if (left == 0.0) return {0.0, 0.0};
  const FockCurrents fock = fock_factors(xi);
  return {left * (fock.hard - 1.0), left * (fock.soft - 1.0)};
}

FockCurrents lit_excess(const LitFrame& frame, double wavenumber, const FaceImpedance& impedance) {
  const double xi = std::min(frame.distance(wavenumber), -rounding_guard), left = fading(xi);
  if (left == 0.0) return {0.0, 0.0};
  const double c = frame.cosine, m = -xi / c;
  const FockCurrents fock = impedance_fock(xi, m, impedance);
  const Complex back = left * std::polar(1.0, -xi * xi * xi / 3);
  return {0.5 * back * fock.hard - left * c / (c + impedance.hard),
          0.5 * back * fock.soft / (m * c) - left / (1.0 + impedance.soft * c)};
}

}  // namespace raytube
