#include "sbr/beams/polygon_integral.h"

#include <algorithm>
#include <limits>

#include "math/lanes.h"

namespace raytube {

namespace {

// Mean of e^{jx} for x uniform between a and b.
Complex segment_mean(double a, double b) { return sinc(0.5 * (b - a)) * std::polar(1.0, 0.5 * (a + b)); }

// Power series about the mean phase: 2 sum_p j^p h_p / (p + 2)!, h_p the complete homogeneous polynomials of the three phases.
// With a spread below 1/2 the terms left out add up to less than 1e-16.
Complex series(double x1, double x2, double x3) {
  constexpr int terms = 12;
  const double mean = (x1 + x2 + x3) / 3.0;
  const double y1 = x1 - mean, y2 = x2 - mean, y3 = x3 - mean;
  const double e1 = y1 + y2 + y3, e2 = y1 * y2 + y2 * y3 + y3 * y1, e3 = y1 * y2 * y3;
  double h[3] = {0.0, 0.0, 1.0};  // h_{p-2}, h_{p-1}, h_p
  double factor = 1.0;            // 2 / (p + 2)!
  double parts[2] = {1.0, 0.0};
  for (int p = 1; p < terms; ++p) {
    const double next = e1 * h[2] - e2 * h[1] + e3 * h[0];
    h[0] = h[1], h[1] = h[2], h[2] = next;
    factor /= p + 2;
    parts[p % 2] += (p % 4 < 2 ? 1.0 : -1.0) * next * factor;
  }
  return std::polar(1.0, mean) * Complex(parts[0], parts[1]);
}

// Exponent / k at a launch point.
double path_at(const Footprint& f, const dvec2& at) {
  const dvec2 offset = at - f.outgoing.anchor;
  return f.phase + f.phase_u * offset.x + f.phase_v * offset.y;
}

// The sum over nodes at one wavenumber.
Complex interpolated(std::span<const double> weights, const std::vector<Complex>& values) {
  double re = 0.0, im = 0.0;
  for (std::size_t n = 0; n < values.size(); ++n) re += weights[n] * values[n].real(), im += weights[n] * values[n].imag();
  return {re, im};
}

}  // namespace

Complex triangle_phase_mean(double x1, double x2, double x3) {
  if (x1 > x2) std::swap(x1, x2);
  if (x2 > x3) std::swap(x2, x3);
  if (x1 > x2) std::swap(x1, x2);
  const double spread = x3 - x1;
  if (spread < 0.5) return series(x1, x2, x3);
  return Complex(0.0, -2.0 / spread) * (segment_mean(x2, x3) - segment_mean(x1, x2));
}

Complex phase_integral(const Footprint& f, double k, const ConvexPolygon& polygon) {
  // Phases count from the first corner, so that a small polygon far from the reference loses nothing.
  const dvec2 gradient = k * dvec2(f.phase_u, f.phase_v), origin = polygon[0].at;
  Complex sum = 0.0;
  dvec2 a = polygon[1].at - origin;
  double phase_a = glm::dot(gradient, a);
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const dvec2 b = polygon[i].at - origin;
    const double phase_b = glm::dot(gradient, b);
    sum += 0.5 * (a.x * b.y - a.y * b.x) * triangle_phase_mean(0.0, phase_a, phase_b);
    a = b;
    phase_a = phase_b;
  }
  return std::polar(f.area, k * path_at(f, origin)) * sum;
}

void phase_integrals(const Footprint& f, Band& band, const ConvexPolygon& polygon, std::vector<Complex>& integrals) {
  const std::span<const double> wavenumbers = band.wavenumbers();
  integrals.resize(wavenumbers.size());
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const Corner& corner : polygon)
    least = std::min(least, path_at(f, corner.at)), most = std::max(most, path_at(f, corner.at));
  const ChebyshevNodes* const nodes = band.nodes(0.5 * (most - least));
  if (!nodes) {
    for (std::size_t i = 0; i < wavenumbers.size(); ++i) integrals[i] = phase_integral(f, wavenumbers[i], polygon);
    return;
  }
  const double middle = 0.5 * (least + most);
  std::vector<Complex> values;
  for (const double k : nodes->at) values.push_back(phase_integral(f, k, polygon) * std::polar(1.0, -k * middle));
  const std::span<const double> weights = nodes->weights;
  for (std::size_t first = 0; first < wavenumbers.size(); first += lanes) {
    const std::size_t count = std::min(lanes, wavenumbers.size() - first);
    Reals phase{};
    for (std::size_t i = 0; i < count; ++i) phase[i] = wavenumbers[first + i] * middle;
    const Complexes turn = unit_phasors(phase);
    for (std::size_t i = 0; i < count; ++i)
      integrals[first + i] = turn[i] * interpolated(weights.subspan((first + i) * values.size(), values.size()), values);
  }
}

}  // namespace raytube
