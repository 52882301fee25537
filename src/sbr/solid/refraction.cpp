#include "sbr/solid/refraction.h"

#include <algorithm>
#include <cmath>

namespace raytube {

namespace {

// The root that belongs to a wave which dies away, or goes away, from the boundary.
Complex normal_slowness(const Medium& medium, double tangential) {
  const Complex q = std::sqrt(medium.permittivity * medium.permeability - tangential * tangential);
  return q.imag() > 0.0 || (q.imag() == 0.0 && medium.permeability.real() < 0.0) ? -q : q;
}

Complex impedance(const Medium& medium) { return std::sqrt(medium.permeability / medium.permittivity); }

// Behind total reflection no power goes on, and none comes back that did not come: with losses before the boundary Fresnel's
// ratio exceeds 1 by as much as their tangent, which both waves have by their interference and a tube, apart from the next
// one, has not.
Complex passive(const Complex& ratio) { return ratio / std::max(1.0, std::abs(ratio)); }

}  // namespace

// Tangential E and H go through: Balanis 2012, section 5.3, with H for E in the plane of incidence.
Refraction refraction(const Medium& from, const Medium& into, double slowness) {
  constexpr double least_cosine = 1e-6;
  const Complex q1 = normal_slowness(from, slowness), q2 = normal_slowness(into, slowness);
  const Complex y1 = q1 / from.permeability, y2 = q2 / into.permeability;
  const Complex z1 = q1 / from.permittivity, z2 = q2 / into.permittivity;
  const Complex te = (y1 - y2) / (y1 + y2), tm = (z1 - z2) / (z1 + z2);
  Refraction result{{{passive(te), passive(tm)}, {1.0 + te, (1.0 + tm) * impedance(into) / impedance(from)}}};
  result.index = std::hypot(slowness, q2.real());
  if (!(q2.real() > least_cosine * result.index)) return result;
  result.cosine = q2.real() / result.index;
  result.attenuation = -q2.imag() * result.cosine;
  return result;
}

}  // namespace raytube
