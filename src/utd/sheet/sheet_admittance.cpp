#include "utd/sheet/sheet_admittance.h"

#include <algorithm>
#include <cmath>

namespace raytube {

namespace {

// The cosine at which a layer is taken as met along it: its admittance differs by 1e-6 of its slope.
constexpr double grazing = 1e-3;

// Even and odd part of what a layer adds, for the field across the plane of incidence: E = (r + t - 1) / 2, O = (r - t + 1) / 2.
struct EvenOdd {
  Complex even, odd;
};

// Keeps 1 + E, which a conductor has not, from being none: the rim of a film of 1e-9 eta is that of a conductor to 1e-8.
Complex not_none(Complex left) { return std::abs(left) < 1e-9 ? 1e-9 : left; }

// y of the electric sheet -2 s E / (1 + E), that of the magnetic one 2 O / (s (1 - O)).
Complex even_admittance(const EvenOdd& at, double s) { return -2.0 * s * at.even / not_none(1.0 + at.even); }
Complex odd_admittance(const EvenOdd& at, double s) { return 2.0 * at.odd / (s * not_none(1.0 - at.odd)); }

// The parts for both polarisations; for TM waves the ratios are those of H, and the two sheets change places.
struct LayerParts {
  EvenOdd te, tm;
};

LayerParts parts_of(const Material& material, std::size_t frequency, double wavenumber, double cosine) {
  const SurfaceResponse front = smooth_response(material, frequency, wavenumber, cosine, false),
                        behind = smooth_response(material, frequency, wavenumber, cosine, true);
  const auto parts = [](Complex r, Complex r_behind, Complex t) {
    const Complex mean = 0.5 * (r + r_behind);
    return EvenOdd{0.5 * (mean + t - 1.0), 0.5 * (mean - t + 1.0)};
  };
  return {parts(front.reflected.te, behind.reflected.te, front.transmitted.te),
          parts(front.reflected.tm, behind.reflected.tm, front.transmitted.tm)};
}

// With less of tangential currents than 1e-5 of the admittance of polarisation across the layer the conditions at an edge are
// one.
SheetAdmittance fit(std::function<std::array<Complex, 2>(double)> exact, Complex normal) {
  const std::array<Complex, 2> straight = exact(1.0), along = exact(grazing);
  const auto at_least = [least = 1e-5 * std::abs(normal)](Complex y) { return std::abs(y) < least ? least : y; };
  const Complex constant = at_least(straight[0]);
  return {constant, normal, along[0] - constant - normal, at_least(along[1]), 0.0, 0.0, std::move(exact)};
}

// A sheet without thickness.
SheetAdmittance same_for_all(std::function<std::array<Complex, 2>(double)> exact) {
  const Complex y = exact(1.0)[0];
  return {y, 0.0, 0.0, y, 0.0, 0.0, [y](double) { return std::array{y, y}; }};
}

// What the layers of a plate have together.
struct Stack {
  double thickness = 0.0, electrical = 0.0, slowest = 1.0;  // d [m], d |n| [m], |n|
  Complex permittivity = 0.0, permeability = 0.0;           // mean over the thickness
  Complex normal_electric = 0.0, normal_magnetic = 0.0;     // sum of d (1 - 1/mu) and of d (1 - 1/eps) [m]
};

Stack stack_of(std::span<const Layer> layers) {
  Stack stack;
  for (const Layer& layer : layers) {
    const auto& [permittivity, permeability] = layer.medium;
    const double index = std::sqrt(std::abs(permittivity * permeability));
    stack.thickness += layer.thickness;
    stack.electrical += layer.thickness * index;
    stack.slowest = std::max(stack.slowest, index);
    stack.permittivity += layer.thickness * permittivity;
    stack.permeability += layer.thickness * permeability;
    stack.normal_electric += layer.thickness * (1.0 - 1.0 / permeability);
    stack.normal_magnetic += layer.thickness * (1.0 - 1.0 / permittivity);
  }
  stack.permittivity /= stack.thickness;
  stack.permeability /= stack.thickness;
  return stack;
}

void add_end_face(SheetAdmittance& sheet, double kd, Complex ratio, Complex dual_ratio) {
  sheet.end_face = kd * end_face_shift(ratio);
  sheet.normal_end_face = kd * end_face_shift(1.0 / dual_ratio);
}

}  // namespace

// C = (1/pi) integral over t from 0 of ln{ [1 + (e-1) g(jt)] / [1 + (e-1) jt/2] } dt / t^2, g(x) = 1 - (1 - e^{-x}) / x, taken
// along t e^{-j pi/4}: there e^{-x} does not oscillate.
Complex end_face_shift(Complex ratio) {
  constexpr double from = -7.0, to = 9.0, step = 0.01;
  Complex sum = 0.0;
  double turns = 0.0, last = 0.0;
  for (double at = from; at < to + step / 2; at += step) {
    const Complex x = std::polar(std::exp(at), pi / 4);
    const Complex g = std::abs(x) < 1e-3 ? x / 2.0 - x * x / 6.0 + x * x * x / 24.0 : 1.0 - (1.0 - std::exp(-x)) / x;
    const Complex logarithm = std::log((1.0 + (ratio - 1.0) * g) / (1.0 + (ratio - 1.0) * x / 2.0));
    if (at > from) turns -= 2 * pi * std::round((logarithm.imag() - last) / (2 * pi));
    last = logarithm.imag();
    sum += (logarithm + Complex(0.0, turns)) / x;
  }
  return Complex(0.0, step / pi) * sum;
}

namespace {

// Edge currents of a plate count in full up to k d |n| = 2.5, and from 4 on not at all.
double thin_share(double electrical) { return std::clamp((4.0 - electrical) / (4.0 - 2.5), 0.0, 1.0); }

// How much the rim of a plate counts as that of an opaque one, one sheet with the reflection of its faces: from |T| = 1e-2 on,
// and from 1e-3 on in full.
double opaque_share(const Material& material, std::size_t frequency, double wavenumber) {
  const double passing = std::abs(smooth_response(material, frequency, wavenumber, 1.0, false).transmitted.te);
  const double share = std::log(1e-2 / std::max(passing, 1e-3)) / std::log(1e-2 / 1e-3);
  return std::max(share, 0.0) * thin_share(wavenumber * stack_of(material.layers[frequency]).thickness);
}

double layer_share(const Material& material, std::size_t frequency, double wavenumber) {
  return thin_share(wavenumber * stack_of(material.layers[frequency]).electrical);
}

// The two sheets with the reflection that the faces of an opaque plate have at normal incidence: y = 2 / Z and 2 Z.
void make_opaque(SheetPair& pair, const Material& material, double wavenumber, double thickness) {
  const EvenOdd middle = parts_of(material, 0, wavenumber, 1.0).te;
  const Complex r = (middle.even + middle.odd) * std::polar(1.0, -wavenumber * thickness);
  const EvenOdd face{0.5 * (r - 1.0), 0.5 * (r + 1.0)};
  const auto of = [](SheetAdmittance& sheet, Complex y) { sheet.constant = sheet.divergence = y; };
  of(pair.electric, even_admittance(face, 1.0));
  of(pair.magnetic, odd_admittance(face, 1.0));
}

}  // namespace

double sheet_share(const Material& material, std::size_t frequency, double wavenumber) {
  if (material.layers.empty()) return 1.0;
  return std::max(layer_share(material, frequency, wavenumber), opaque_share(material, frequency, wavenumber));
}

SheetPair sheet_pair(const Material& material, std::size_t frequency, double wavenumber) {
  Material here = material;
  if (!material.layers.empty()) here.layers = {material.layers[frequency]};
  const auto parts = [here, wavenumber](double cosine) { return parts_of(here, 0, wavenumber, cosine); };
  const auto exact = [parts](bool electric) {
    return [parts, electric](double cosine) {
      const double s = std::max(cosine, grazing);
      const LayerParts at = parts(s);
      const auto& [own, other] = electric ? std::pair(at.te, at.tm) : std::pair(at.tm, at.te);
      return std::array{even_admittance(own, s), odd_admittance(other, s)};
    };
  };
  SheetPair pair;
  pair.current_share = sheet_share(material, frequency, wavenumber);
  if (material.layers.empty()) {
    pair.electric = same_for_all(exact(true));
    pair.magnetic = same_for_all(exact(false));
    pair.slowest = std::numeric_limits<double>::infinity();
  } else if (pair.current_share > layer_share(material, frequency, wavenumber)) {
    pair.electric.exact = exact(true);
    pair.magnetic.exact = exact(false);
    make_opaque(pair, here, wavenumber, stack_of(material.layers[frequency]).thickness);
  } else {
    const Stack stack = stack_of(material.layers[frequency]);
    const double kd = wavenumber * stack.thickness;
    pair.electric = fit(exact(true), Complex(0.0, wavenumber) * stack.normal_electric);
    pair.magnetic = fit(exact(false), Complex(0.0, wavenumber) * stack.normal_magnetic);
    add_end_face(pair.electric, kd, stack.permittivity, stack.permeability);
    add_end_face(pair.magnetic, kd, stack.permeability, stack.permittivity);
    pair.slowest = stack.slowest;
  }
  return pair;
}

}  // namespace raytube
