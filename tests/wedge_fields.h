// Exact fields around a straight wedge, and its rays of geometrical optics.
#pragma once

#include <cmath>
#include <vector>

#include "math/gauss.h"
#include "utd/wedge/diffracted_field.h"

namespace raytube::wedge_fields {

/// J of the orders first, first + 1, ..., first = 0 or 1/2, by Miller's recurrence downwards: relative error of the largest some
/// 1e-14, where the library's functions at x = 300 have 1e-12. Norms: J_0 + 2 J_2 + 2 J_4 + ... = 1, J_{1/2}^2 + J_{-1/2}^2 =
/// 2/(pi x).
inline std::vector<double> bessel_orders(double first, std::size_t count, double x) {
  const auto start = std::max(count, static_cast<std::size_t>(x)) + 60 + static_cast<std::size_t>(8 * std::cbrt(x));
  std::vector<double> j(start + 2, 0.0);
  j[start] = 1e-280;
  for (std::size_t m = start; m > 0; --m) {
    j[m - 1] = 2 * (first + double(m)) / x * j[m] - j[m + 1];
    if (std::abs(j[m - 1]) > 1e200)
      for (std::size_t i = m - 1; i <= start; ++i) j[i] *= 1e-280;
  }
  double norm = j[0];
  if (first == 0.0)
    for (std::size_t m = 2; m <= start; m += 2) norm += 2 * j[m];
  else
    norm = std::copysign(std::hypot(j[0], j[0] / x - j[1]) / std::sqrt(2 / (pi * x)), j[0] * std::sin(x));
  j.resize(count);
  for (double& value : j) value /= norm;
  return j;
}

/// A scalar field in one angle psi = phi -+ phi' by its series (1/n) sum eps_m c_m cos(m psi/n). On the wedge the field of phi -
/// phi' less that of phi + phi' vanishes (soft), their sum has no slope (hard). Sources: Macdonald (1902); Bowman, Senior and
/// Uslenghi (1969), chapter 6.
class Series {
 public:
  /// Of a unit plane wave: c = j^{m/n} J_{m/n}(k rho).
  static Series plane(double n, double k_rho) {
    Series series(n);
    const int last = static_cast<int>(std::ceil(n * (k_rho + 12 * std::cbrt(k_rho) + 25)));
    const bool accurate = n == 2.0 || n == 0.5;  // fields without an asymptotic error are compared to rounding
    const std::vector<double> whole = bessel_orders(0.0, accurate ? 2 * last + 1 : 0, k_rho);
    const std::vector<double> half = bessel_orders(0.5, accurate ? 2 * last + 1 : 0, k_rho);
    for (int m = 0; m <= last; ++m) {
      const double order = m / n;
      const bool whole_order = order == std::floor(order);
      const double j = !accurate ? std::cyl_bessel_j(order, k_rho) : whole_order ? whole[int(order)] : half[int(order)];
      series.add(m, j * std::polar(1.0, pi * order / 2));
    }
    return series;
  }

  /// Of a line source, H_0^(2)(k r) in free space: c = J_{m/n}(k rho_<) H_{m/n}^(2)(k rho_>).
  static Series line(double n, double k_rho, double k_rho_source) {
    Series series(n);
    const auto [near, far] = std::minmax(k_rho, k_rho_source);
    const int last = static_cast<int>(std::ceil(n * (near + 12 * std::cbrt(near) + 40)));
    for (int m = 0; m <= last; ++m) {
      const double regular = std::cyl_bessel_j(m / n, near), growing = std::cyl_neumann(m / n, far);
      if (!std::isfinite(growing)) break;  // the product is below 1e-15 long before
      series.add(m, regular * Complex(std::cyl_bessel_j(m / n, far), -growing));
    }
    return series;
  }

  Complex operator()(double psi) const {
    // cos(m x) by its recurrence, turned afresh now and then so that rounding stays below 1e-13.
    const double x = psi / n_;
    Complex sum = 0.0;
    for (std::size_t start = 0; start < terms_.size(); start += 32) {
      Complex turn = std::polar(1.0, static_cast<double>(start) * x);
      const Complex step = std::polar(1.0, x);
      for (std::size_t m = start; m < std::min(start + 32, terms_.size()); ++m, turn *= step) sum += terms_[m] * turn.real();
    }
    return sum;
  }

 private:
  explicit Series(double n) : n_(n) {}
  void add(int m, Complex value) { terms_.push_back((m == 0 ? 1.0 : 2.0) / n_ * value); }

  double n_;
  std::vector<Complex> terms_;
};

/// What diffraction adds, in one angle psi, to the rays of a point source e^{-jkR}/R; z is the distance along the edge from
/// source to observer (Macdonald 1915; Carslaw 1919): -(1/2 pi n) int_0^inf sum sin a / (cosh(y/n) - cos a) e^{-jkR}/R dy, a =
/// (pi +- psi)/n, R^2 = R0^2 + 4 rho rho' sinh^2(y/2). Along R = R0 - j t^2 / k the phase stands still and the integrand falls as
/// e^{-t^2}.
class PointDiffraction {
 public:
  PointDiffraction(double n, double k, double rho, double rho_source, double z)
      : n_(n), k_(k), product_(rho * rho_source), shortest_(std::hypot(rho + rho_source, z)) {}

  /// Panels that halve towards t = 0 resolve the poles of rays close to their boundary; e^{-t^2} is below 1e-17 beyond the last.
  Complex operator()(double psi) const {
    Complex sum = 0.0;
    for (double end = 6.4; end > 1e-9; end /= 2)
      for (const GaussPoint& point : gauss_rule(24)) sum += end / 2 * point.weight * integrand(psi, end / 2 * (1 + point.node));
    return -std::polar(1.0, -k_ * shortest_) / (2 * pi * n_) * sum;
  }

 private:
  Complex integrand(double psi, double t) const {
    const Complex step(0.0, -t * t / k_), way = shortest_ + step;
    const Complex half = std::asinh(std::sqrt(step * (way + shortest_) / (4 * product_)));
    const Complex slope = Complex(0.0, -2 * t / k_) / (product_ * std::sinh(2.0 * half));
    const Complex s = std::sinh(half / n_);
    Complex kernel = 0.0;
    for (const double a : {(pi + psi) / n_, (pi - psi) / n_})
      kernel += std::sin(a) / (2.0 * (s * s + std::sin(a / 2) * std::sin(a / 2)));
    return kernel * slope * std::exp(-t * t);
  }

  double n_, k_, product_, shortest_;
};

/// One image of a source that the observer sees in the faces of an infinite wedge, the source itself among them.
struct Image {
  RaySource source;
  double weight;  // 1/2 on the boundary of its light
  double sign;    // of a soft wave
};

inline dvec3 turned(const dvec3& v, const dvec3& axis, double angle) {
  return std::cos(angle) * v + std::sin(angle) * glm::cross(axis, v) + (1 - std::cos(angle)) * glm::dot(axis, v) * axis;
}

/// `source` mirrored in face 0 if asked, then turned about the edge.
inline RaySource image_of(const StraightEdge& edge, RaySource source, bool mirrored, double angle) {
  const auto moved = [&](dvec3 v) {
    if (mirrored) v -= 2.0 * glm::dot(v, edge.normal) * edge.normal;
    return turned(v, edge.tangent(), angle);
  };
  source.position = edge.origin + moved(source.position - edge.origin);
  source.direction = moved(source.direction);
  const double sign = mirrored ? -1.0 : 1.0;  // E_t changes sign at a perfect conductor
  source.moment = {sign * moved(source.moment.re), sign * moved(source.moment.im)};
  return source;
}

/// Every image with |psi - 2 pi n N| < pi, psi = phi - phi' for an even number of reflections and phi + phi' for an odd one.
inline std::vector<Image> images(const StraightEdge& edge, const RaySource& source, double source_angle, double angle) {
  std::vector<Image> seen;
  const int most = static_cast<int>(std::ceil(1 / edge.n)) + 2;
  for (const bool mirrored : {false, true})
    for (int turn = -most; turn <= most; ++turn) {
      const double psi = angle + (mirrored ? source_angle : -source_angle) - 2 * pi * edge.n * turn, beyond = std::abs(psi) - pi;
      const double weight = std::abs(beyond) < 1e-12 ? 0.5 : beyond < 0 ? 1.0 : 0.0;
      if (weight > 0) seen.push_back({image_of(edge, source, mirrored, 2 * pi * edge.n * turn), weight, mirrored ? -1.0 : 1.0});
    }
  return seen;
}

/// Geometrical optics of an infinite wedge; angles as those of the ray over its edge.
inline DiffractedWave optics(const StraightEdge& edge, const RaySource& source, const EdgeRay& ray, const dvec3& point,
                             double k) {
  DiffractedWave sum{};
  for (const Image& image : images(edge, source, ray.source_angle, ray.observation_angle)) {
    const Arrival direct = arrival(image.source, point);
    const Complex field = std::polar(image.weight * direct.spread, -k * direct.path);
    sum.soft += image.sign * field;
    sum.hard += field;
  }
  return sum;
}

inline ComplexVector optics_field(const StraightEdge& edge, const RaySource& source, const EdgeRay& ray, const dvec3& point,
                                  double k) {
  ComplexVector sum;
  for (const Image& image : images(edge, source, ray.source_angle, ray.observation_angle))
    sum += Complex(image.weight) * free_field(image.source, point, k);
  return sum;
}

}  // namespace raytube::wedge_fields
