#include "utd/rounded/rounded_edge.h"

#include <algorithm>

#include "math/gauss.h"

namespace raytube {

namespace {

// phi of the observer and the sine of its angle to the edge; in the metal phi of the nearer face, and what is left there.
struct Observer {
  double angle, sine, share = 1.0;

  Observer(const Wedge& wedge, const dvec3& scattered) {
    const WedgeFace& face = wedge.faces[0];
    const double along = glm::dot(scattered, face.into_face), above = glm::dot(scattered, face.normal);
    const double turned = std::atan2(above, along);
    angle = turned < 0.0 ? turned + 2 * pi : turned;
    sine = std::hypot(along, above);
    const double end = wedge.n * pi;
    if (angle <= end) return;
    const double depth = std::min(angle - end, 2 * pi - angle) / (pi - end / 2);
    share = std::pow(std::cos(pi / 2 * depth), 2);
    angle = angle - end < 2 * pi - angle ? end : 0.0;
  }
};

// 2 n x eta H of both polarisations, as received.
ScatteringMatrix physical_optics_current(const dvec3& normal, const LookVectors& look) {
  ScatteringMatrix result;
  for (int transmit = 0; transmit < 2; ++transmit) {
    const dvec3 current = 2.0 * glm::cross(normal, look.magnetic[transmit]);
    for (int receive = 0; receive < 2; ++receive) result.at(receive, transmit) = glm::dot(look.receive[receive], current);
  }
  return result;
}

// (e^{jx} - 1) / jx.
Complex unit_integral(double x) { return sinc(x / 2) * std::polar(1.0, x / 2); }

void add_scaled(ScatteringMatrix& sum, Complex factor, const ScatteringMatrix& term) {
  for (int receive = 0; receive < 2; ++receive)
    for (int transmit = 0; transmit < 2; ++transmit) sum.at(receive, transmit) += factor * term.at(receive, transmit);
}

// Angles of normals from that at the nose.
struct LitPart {
  double begin, end;
};

// n . s' = a cos(theta) + b sin(theta) is negative for half a turn.
LitPart lit_part(double normal_slope, double along_slope, double end) {
  const double middle = std::atan2(-along_slope, -normal_slope);
  return {std::max(-end, middle - pi / 2), std::min(end, middle + pi / 2)};
}

// Phases up to 4 k t over the section: points enough for rounding errors alone.
int points_for(double phase) { return std::min(most_gauss_points, 16 + static_cast<int>(phase)); }

// S per unit length of the section's physical-optics currents times 4 pi / -jk.
ScatteringMatrix section_currents(const RoundedEdge& edge, const LookVectors& look, double wavenumber) {
  const std::array<WedgeFace, 2>& faces = edge.wedge.faces;
  const dvec3 out = -glm::normalize(faces[0].into_face + faces[1].into_face);
  const dvec3 across = glm::normalize(faces[1].into_face - faces[0].into_face), difference = look.scattered - look.incident;
  const LitPart lit = lit_part(glm::dot(look.incident, out), glm::dot(look.incident, across), edge.section.end);
  ScatteringMatrix sum;
  if (lit.end <= lit.begin) return sum;
  const double width = lit.end - lit.begin, apex = edge.section.apex();
  for (const GaussPoint& point : gauss_rule(points_for(2 * wavenumber * edge.section.tangent_distance()))) {
    const double theta = lit.begin + width * point.node;
    const dvec3 normal = std::cos(theta) * out + std::sin(theta) * across;
    const dvec2 place = edge.section.at(theta);
    const double path = glm::dot(difference, (place.x - apex) * out + place.y * across);
    add_scaled(sum, std::polar(point.weight * width * edge.section.radius_at(theta), wavenumber * path),
               physical_optics_current(normal, look));
  }
  return sum;
}

}  // namespace

double wavenumber_across(const WedgeIncidence& incidence, const LookVectors& look, double wavenumber) {
  const FaceIncidence& arriving = incidence.faces[0];
  return wavenumber * std::sqrt(arriving.sin_cone * glm::length(glm::cross(look.scattered, arriving.tangent)));
}

// On the cone E_z and eta H_z are those of the two-dimensional field; the line source that makes them radiates
// E = E_z (z - (z.s) s) / sin^2(beta) + eta H_z (z x s) / sin^2(beta).
ScatteringMatrix rounding_amplitude(const RoundedEdge& edge, const RoundedWedge& modes, const WedgeIncidence& incidence,
                                    const LookVectors& look) {
  ScatteringMatrix result;
  const FaceIncidence& arriving = incidence.faces[0];
  const Observer observer(edge.wedge, look.scattered);
  if (observer.sine <= sin_cone_floor || arriving.sin_cone <= sin_cone_floor || incidence.weight == 0.0) return result;
  const Complex soft = modes.soft(observer.angle, arriving.source_angle),
                hard = modes.hard(observer.angle, arriving.source_angle);
  const dvec3 turned = glm::cross(arriving.tangent, look.scattered);
  for (int receive = 0; receive < 2; ++receive)
    for (int transmit = 0; transmit < 2; ++transmit)
      result.at(receive, transmit) =
          (soft * (glm::dot(look.receive[receive], arriving.tangent) * glm::dot(look.electric[transmit], arriving.tangent)) +
           hard * (glm::dot(look.receive[receive], turned) * glm::dot(look.magnetic[transmit], arriving.tangent))) *
          (incidence.weight * observer.share / (observer.sine * arriving.sin_cone));
  return result;
}

// S = -(jk/4 pi) p . INT 2 n x eta H e^{jk(s - s').r}.
ScatteringMatrix missing_physical_optics(const RoundedEdge& edge, const WedgeIncidence& incidence, const LookVectors& look,
                                         double wavenumber) {
  ScatteringMatrix currents;
  if (incidence.weight == 0.0) return currents;
  const double distance = edge.section.tangent_distance();
  for (int side = 0; side < 2; ++side) {
    const WedgeFace& face = edge.wedge.faces[side];
    if (!incidence.faces[side].lit) continue;
    const double phase = wavenumber * distance * glm::dot(look.scattered - look.incident, face.into_face);
    add_scaled(currents, distance * unit_integral(phase), physical_optics_current(face.normal, look));
  }
  add_scaled(currents, -1.0, section_currents(edge, look, wavenumber));
  ScatteringMatrix result;
  add_scaled(result, Complex(0.0, -wavenumber * incidence.weight / (4 * pi)), currents);
  return result;
}

ScatteringMatrix rounded_edge_amplitude(const RoundedEdge& edge, const RoundedWedge& modes, const WedgeIncidence& incidence,
                                        const LookVectors& look, double wavenumber) {
  bool windowed = false;
  ScatteringMatrix result = amplitude_at(edge_amplitude(edge.wedge, incidence, look), wavenumber, windowed);
  result += missing_physical_optics(edge, incidence, look, wavenumber);
  result += rounding_amplitude(edge, modes, incidence, look);
  return result;
}

}  // namespace raytube
