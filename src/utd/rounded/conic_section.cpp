#include "utd/rounded/conic_section.h"

namespace raytube {

namespace {

double root(double flattening, double sine) { return std::sqrt(std::max(1.0 - flattening * sine * sine, 1e-12)); }

}  // namespace

double ConicSection::radius_at(double theta) const { return radius / std::pow(root(flattening, std::sin(theta)), 3); }

// dx = -rho(theta) sin(theta) dtheta, dy = rho(theta) cos(theta) dtheta.
dvec2 ConicSection::at(double theta) const {
  const double c = std::cos(theta), s = std::sin(theta), d = root(flattening, s);
  return radius / d * dvec2(-s * s / (c + d), s);
}

double ConicSection::apex() const {
  const dvec2 tangent = at(end);
  return tangent.x + tangent.y * std::tan(end);
}

Section section_of(const ConicSection& conic, double wavenumber) {
  const double half = conic.interior_angle() / 2;
  const dvec2 out(-std::cos(half), std::sin(half)), across(-out.y, out.x);
  return [=](double parameter) {
    const double theta = conic.end * (1 - 2 * parameter), rate = -2 * conic.end, s = std::sin(theta), c = std::cos(theta);
    const dvec2 place = conic.at(theta), along = -s * out + c * across, normal = c * out + s * across;
    const double radius = wavenumber * conic.radius_at(theta);
    const double growth = 3 * conic.flattening * s * c * radius / std::pow(root(conic.flattening, s), 2);
    return SectionPoint{wavenumber * ((place.x - conic.apex()) * out + place.y * across), radius * rate * along,
                        rate * rate * (growth * along - radius * normal)};
  };
}

}  // namespace raytube
