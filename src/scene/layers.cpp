#include "scene/layers.h"

#include <cmath>

namespace raytube {

namespace {

/// Tangential E and eta H of a wave, up to a common factor: what a stack looks like to what lies above it.
struct Tangential {
  Complex e, h;
};

// The tangential impedance of the two kinds of wave is mu / q (TE) and q / eps (TM), q = k_z / k; vacuum has q = cosine.
enum class Wave { te, tm };

// sqrt(eps mu - sin^2) with the sign of a wave that dies away; where none does, of one that takes energy downwards: against its
// phase where eps and mu are both negative. Not 1 - cos^2 for sin^2: in vacuum q is the cosine, at grazing incidence as well.
Complex vertical(const Medium& medium, double cosine) {
  const Complex q = std::sqrt(medium.permittivity * medium.permeability - 1.0 + cosine * cosine);
  return q.imag() > 0.0 || (q.imag() == 0.0 && medium.permeability.real() < 0.0) ? -q : q;
}

Tangential behind(Wave wave, const Medium& medium, double cosine) {
  const Complex q = vertical(medium, cosine);
  return wave == Wave::te ? Tangential{medium.permeability, q} : Tangential{q, medium.permittivity};
}

// (1 - e^{-x}) / x, x with a real part not below zero.
Complex mean_decay(Complex x) {
  if (std::abs(x) > 0.5) return (1.0 - std::exp(-x)) / x;
  Complex term = 1.0, sum = 1.0;
  for (int i = 2; std::abs(term) > 1e-17; ++i) sum += term *= -x / static_cast<double>(i);
  return sum;
}

// From the lower to the upper face of a layer (Born & Wolf 1999, section 1.6.2), both sides times e^{-j q k d}: with q k d = phi
// the matrix elements are cos phi = (1 + e)/2 and j sin phi = (1 - e)/2, e = e^{-2 j phi}; none of them can grow. They are
// even in q: nothing is divided by it.
Tangential through(Wave wave, const Layer& layer, double wavenumber, double cosine, Tangential below) {
  const Complex q = vertical(layer.medium, cosine), thickness(0.0, wavenumber * layer.thickness), x = 2.0 * q * thickness;
  const Complex c = 0.5 * (1.0 + std::exp(-x)), s_over_q = thickness * mean_decay(x);
  const Complex& up = wave == Wave::te ? layer.medium.permeability : layer.medium.permittivity;
  const Complex first = up * s_over_q, second = q * q / up * s_over_q;
  if (wave == Wave::te) return {c * below.e + first * below.h, c * below.h + second * below.e};
  return {c * below.e + second * below.h, c * below.h + first * below.e};
}

// (impedance - that of vacuum) / (their sum), of tangential E.
Complex reflection(Wave wave, const Tangential& top, double cosine) {
  const Complex e = wave == Wave::te ? cosine * top.e : top.e, h = wave == Wave::te ? top.h : cosine * top.h;
  return (e - h) / (e + h);
}

SurfaceResponse::Polarised reflected(const Tangential& te, const Tangential& tm, double cosine) {
  // What is along t stays; (d_r x t) has the tangential part of (d x t) turned over.
  return {reflection(Wave::te, te, cosine), -reflection(Wave::tm, tm, cosine)};
}

Tangential stack(Wave wave, std::span<const Layer> layers, double wavenumber, double cosine, Tangential below) {
  for (std::size_t i = layers.size(); i-- > 0;) below = through(wave, layers[i], wavenumber, cosine, below);
  return below;
}

}  // namespace

SurfaceResponse half_space_response(const Medium& medium, double cosine) {
  return {reflected(behind(Wave::te, medium, cosine), behind(Wave::tm, medium, cosine), cosine), {}};
}

SurfaceResponse coated_response(std::span<const Layer> layers, double wavenumber, double cosine) {
  constexpr Tangential conductor{0.0, 1.0};
  return {reflected(stack(Wave::te, layers, wavenumber, cosine, conductor),
                    stack(Wave::tm, layers, wavenumber, cosine, conductor), cosine),
          {}};
}

SurfaceResponse sheet_response(std::span<const Layer> layers, double wavenumber, double cosine) {
  const Tangential te = stack(Wave::te, layers, wavenumber, cosine, {1.0, cosine}),
                   tm = stack(Wave::tm, layers, wavenumber, cosine, {cosine, 1.0});
  Complex lag = 0.0;  // q k d of all layers: the factor that through() left out
  double thickness = 0.0;
  for (const Layer& layer : layers) {
    lag += vertical(layer.medium, cosine) * wavenumber * layer.thickness;
    thickness += layer.thickness;
  }
  // From the upper face, on which the recursion ends, to the middle, and back or on from there.
  const double lead = wavenumber * thickness * cosine;
  const Complex moved = std::polar(1.0, lead), passed = 2.0 * cosine * std::exp(Complex(0.0, lead) - Complex(0.0, 1.0) * lag);
  SurfaceResponse::Polarised r = reflected(te, tm, cosine);
  return {{r.te * moved, r.tm * moved}, {passed / (cosine * te.e + te.h), passed / (tm.e + cosine * tm.h)}};
}

SurfaceResponse thin_sheet_response(double resistance, double conductance, double cosine) {
  constexpr double eta = 376.730313668;
  // Electric currents radiate alike to both sides, magnetic ones oppositely; so neither drives the other.
  const double electric_te = 1.0 / (1.0 + 2.0 * resistance / eta * cosine),
               electric_tm = 1.0 / (1.0 + 2.0 * resistance / eta / cosine),
               magnetic_te = 1.0 / (1.0 + 2.0 * conductance * eta / cosine),
               magnetic_tm = 1.0 / (1.0 + 2.0 * conductance * eta * cosine);
  return {{magnetic_te - electric_te, electric_tm - magnetic_tm},
          {1.0 - electric_te - magnetic_te, 1.0 - electric_tm - magnetic_tm}};
}

}  // namespace raytube
