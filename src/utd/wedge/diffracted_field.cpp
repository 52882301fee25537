#include "utd/wedge/diffracted_field.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "math/erfc_ray.h"
#include "utd/wedge/detour.h"
#include "utd/wedge/edge_wave.h"
#include "utd/wedge/rounding_guard.h"

namespace raytube {

namespace {

double angle_from_face(const StraightEdge& edge, double x, double y) {
  const double last = edge.n * pi, turned = std::atan2(y, x), angle = turned < 0.0 ? turned + 2 * pi : turned;
  if (angle <= last) return angle;
  if (angle - last < rounding_guard) return last;
  return 2 * pi - angle < rounding_guard ? 0.0 : -1.0;
}

AboutEdge cylindrical(const StraightEdge& edge, const dvec3& offset) {
  const double x = glm::dot(offset, edge.into_face), y = glm::dot(offset, edge.normal);
  const double distance = std::hypot(x, y);
  return {distance, glm::dot(offset, edge.tangent()), angle_from_face(edge, x, y),
          x / distance * edge.into_face + y / distance * edge.normal};
}

// Where the source is; for a plane wave, the direction towards it.
AboutEdge cylindrical(const StraightEdge& edge, const RaySource& source) {
  return cylindrical(edge, source.spreading == Spreading::plane ? -source.direction : source.position - edge.origin);
}

void require(const AboutEdge& point, const char* what) {
  if (!(point.distance > 0.0))
    throw InputError(std::string("diffracted field: the ") + what + " lies on the edge's line; move it off the edge");
  if (point.angle < 0.0)
    throw InputError(std::string("diffracted field: the ") + what + " lies inside the wedge; move it into the free space");
}

void require(const StraightEdge& edge, const RaySource& source) {
  if (!(edge.n > 0.0 && edge.n <= 2.0)) throw InputError("diffracted field: n must be greater than 0 and at most 2");
  if (!(edge.begin < edge.end)) throw InputError("diffracted field: the edge must end after its beginning");
  if (source.spreading == Spreading::line && glm::length(glm::cross(source.direction, edge.tangent())) > rounding_guard)
    throw InputError("diffracted field: a line source must be parallel to the edge");
}

// The edge point in the plane where the ray is straight, and what follows from there.
struct Unfolded {
  double arc_length;  // place of Q on the edge
  double cos_cone;    // cosine of the angle between the edge and either ray
  double sin_cone;
  double path;  // [m]
  double spread;
  double parameter;  // L
};

Unfolded unfold_point(const AboutEdge& source, const AboutEdge& observer) {
  const double across = source.distance + observer.distance, along = observer.along - source.along;
  const double path = std::hypot(across, along), arc_length = source.along + along * source.distance / across;
  return {arc_length, along / path, across / path, path, 1 / path, source.distance * observer.distance / path};
}

Unfolded unfold_line(const AboutEdge& source, const AboutEdge& observer) {
  const double across = source.distance + observer.distance;
  return {observer.along, 0.0, 1.0, across, 1 / std::sqrt(across), source.distance * observer.distance / across};
}

Unfolded unfold_plane(const StraightEdge& edge, const RaySource& wave, const AboutEdge& source, const AboutEdge& observer) {
  const double cosine = -source.along, sine = source.distance, length = observer.distance / sine;
  const double start = glm::dot(wave.direction, edge.origin - wave.position);
  return {observer.along - length * cosine, cosine, sine, start + observer.along * cosine + observer.distance * sine, 1.0,
          observer.distance * sine};
}

Unfolded unfold(const StraightEdge& edge, const RaySource& wave, const AboutEdge& source, const AboutEdge& observer) {
  if (wave.spreading == Spreading::point) return unfold_point(source, observer);
  if (wave.spreading == Spreading::line) return unfold_line(source, observer);
  return unfold_plane(edge, wave, source, observer);
}

double detour(const RaySource& wave, const AboutEdge& source, const AboutEdge& observer, double arc_length, double end) {
  const double step = end - arc_length;
  if (std::isinf(step)) return std::abs(step);
  const double after = excess(observer.distance, arc_length - observer.along, step);
  return wave.spreading == Spreading::point ? after + excess(source.distance, arc_length - source.along, step) : after;
}

// G / share of one end, and on which side of it the diffraction point lies.
struct EndWave {
  double squared;  // x^2
  bool inside;
  Complex wave;

  Complex step(double term_squared) const {
    const Complex part = std::isinf(squared) ? 0.0 : wave * (term_squared / (term_squared + squared));
    return inside ? 1.0 - part : part;
  }
};

// `value` is W of the root.
EndWave end_wave(double squared, bool inside, Complex value) {
  if (std::isinf(squared)) return {squared, inside, 0.0};
  return {squared, inside, 0.5 * std::polar(1.0, -squared) * value};
}

bool is_reached(const AboutEdge& point) { return point.distance > 0.0 && point.angle >= 0.0; }

EdgeRay edge_ray(const StraightEdge& edge, const RaySource& source, const AboutEdge& from, const AboutEdge& to) {
  const Unfolded u = unfold(edge, source, from, to);
  const dvec3 tangent = edge.tangent();
  EdgeRay ray;
  ray.arc_length = u.arc_length;
  ray.point = edge.origin + u.arc_length * tangent;
  ray.path = u.path;
  ray.spread = u.spread;
  ray.source_angle = from.angle;
  ray.observation_angle = to.angle;
  ray.sin_cone = u.sin_cone;
  ray.distance_parameter = u.parameter;
  ray.arriving = u.cos_cone * tangent - u.sin_cone * from.outwards;
  ray.leaving = u.cos_cone * tangent + u.sin_cone * to.outwards;
  ray.detours = {detour(source, from, to, u.arc_length, edge.begin), detour(source, from, to, u.arc_length, edge.end)};
  return ray;
}

}  // namespace

// The planes of faces folded flat on one another, and of the sides of thin plates, may cross: n is a little above 2 then. Points
// between them are in front of both, which no ray can be.
StraightEdge straight_edge(const Wedge& wedge) {
  const WedgeFace& face = wedge.faces[0];
  StraightEdge edge{wedge.start, face.into_face, face.normal, std::min(wedge.n, 2.0), 0.0, wedge.length()};
  if (glm::dot(edge.tangent(), wedge.end - wedge.start) < 0.0) edge.origin = wedge.end;
  return edge;
}

bool has_edge_ray(const StraightEdge& edge, const RaySource& source, const dvec3& observer) {
  return is_reached(cylindrical(edge, source)) && is_reached(cylindrical(edge, observer - edge.origin));
}

EdgeRay edge_ray(const StraightEdge& edge, const RaySource& source, const dvec3& observer) {
  const AboutEdge from = cylindrical(edge, source), to = cylindrical(edge, observer - edge.origin);
  require(edge, source);
  require(from, "source");
  require(to, "observer");
  return edge_ray(edge, source, from, to);
}

EdgeRays::EdgeRays(const StraightEdge& edge, const RaySource& source)
    : edge_(edge), source_(source), from_(cylindrical(edge, source)) {}

std::optional<EdgeRay> EdgeRays::to(const dvec3& observer) const {
  const AboutEdge to = cylindrical(edge_, observer - edge_.origin);
  if (!is_reached(from_) || !is_reached(to)) return std::nullopt;
  return edge_ray(edge_, source_, from_, to);
}

DiffractedWave diffracted_wave(const StraightEdge& edge, const EdgeRay& ray, double wavenumber) {
  const double distance = std::sqrt(wavenumber * ray.distance_parameter);
  const EdgeWaveTerms terms = edge_wave_terms(edge.n, ray.source_angle, ray.observation_angle);
  const std::array<double, 2> squared{wavenumber * ray.detours[0], wavenumber * ray.detours[1]};
  Reals arguments{};  // of the incident waves, the reflected ones, and both ends
  for (int i = 0; i < 2; ++i) {
    arguments[i] = terms.incident[i].rate * distance;
    arguments[2 + i] = terms.reflected[i].rate * distance;
    if (std::isfinite(squared[i])) arguments[4 + i] = std::sqrt(squared[i]);
  }
  const Complexes values = scaled_erfc(arguments);
  const EndWave first = end_wave(squared[0], ray.arc_length > edge.begin, values[4]);
  const EndWave last = end_wave(squared[1], ray.arc_length < edge.end, values[5]);
  const auto sum = [&](const std::array<EdgeWaveTerm, 2>& waves, std::size_t from) {
    Complex total = 0.0;
    for (std::size_t i = from; i < from + static_cast<std::size_t>(terms.each); ++i) {
      if (waves[i - from].strength == 0.0) continue;
      const double z2 = arguments[i] * arguments[i];
      total += waves[i - from].strength * values[i] * (first.step(z2) + last.step(z2) - 1.0);
    }
    return total;
  };
  const Complex incident = sum(terms.incident, 0), reflected = sum(terms.reflected, 2);
  const Complex phase = std::polar(ray.spread, -wavenumber * ray.path);
  return {phase * (incident - reflected), phase * (incident + reflected)};
}

ComplexVector diffracted_field(const StraightEdge& edge, const EdgeRay& ray, const ComplexVector& moment, double wavenumber) {
  const DiffractedWave wave = diffracted_wave(edge, ray, wavenumber);
  const dvec3 phi_source = -glm::cross(edge.tangent(), ray.arriving) / ray.sin_cone;
  const dvec3 phi = glm::cross(edge.tangent(), ray.leaving) / ray.sin_cone;
  const dvec3 cone_source = glm::cross(ray.arriving, phi_source), cone = glm::cross(ray.leaving, phi);
  return (-wave.soft * dot(moment, cone_source)) * cone + (-wave.hard * dot(moment, phi_source)) * phi;
}

ComplexVector diffracted_field(const StraightEdge& edge, const RaySource& source, const dvec3& observer, double wavenumber) {
  if (!(wavenumber > 0.0)) throw InputError("diffracted field: the wavenumber must be positive");
  return diffracted_field(edge, edge_ray(edge, source, observer), source.moment, wavenumber);
}

}  // namespace raytube
