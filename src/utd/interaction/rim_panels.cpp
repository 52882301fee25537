#include "utd/interaction/rim_panels.h"

#include <algorithm>
#include <cmath>

namespace raytube {

namespace {

// The first panel of a rim has this length in wavelengths, and each is so many times as long as the one before it (against finer
// panels: docs/theory/interaction_accuracy.md).
constexpr double first_panel = 0.8, panel_growth = 4.0;
// No panel is shorter than this, in wavelengths.
constexpr double narrowest_panel = 1e-4;

// The ends of panels in order, within the rim; those as good as one are one, and so are those at its ends [m].
std::vector<double> joined(std::vector<double>& ends, double length, double wavelength) {
  const double apart = narrowest_panel * wavelength;
  std::erase_if(ends, [&](double end) { return !(end > apart && end < length - apart); });
  std::ranges::sort(ends);
  std::vector<double> result{0.0};
  for (const double end : ends)
    if (end - result.back() > apart) result.push_back(end);
  result.push_back(length);
  return result;
}

// Where the boundaries of the wave of an edge cut a rim that they do not contain: it jumps there [m]. A place too many costs
// little, but none may come and go with rounding.
void add_boundaries(const StraightEdge& edge, double source_angle, const EdgeAxis& rim, std::vector<double>& ends) {
  const dvec3 offset = rim.origin - edge.origin;
  for (const double boundary : wave_boundaries(edge.n, source_angle)) {
    if (boundary < -rounding_of_files || boundary > edge.n * pi + rounding_of_files) continue;
    const double cosine = std::cos(boundary), sine = std::sin(boundary);
    const dvec3 normal = cosine * edge.normal - sine * edge.into_face, outwards = cosine * edge.into_face + sine * edge.normal;
    const double slope = glm::dot(normal, rim.tangent);
    if (std::abs(slope) < rounding_of_files) continue;
    const double place = -glm::dot(normal, offset) / slope;
    if (glm::dot(outwards, offset + place * rim.tangent) > -rounding_of_files * rim.length) ends.push_back(place);
  }
}

// Where the rays come from an end of the lit piece: on Keller's cone about that end, a square z^2 + 2 half z + constant = 0.
// Corner factors bend there. A cone opened to a plane is one root, counted twice, unless the rim lies in it.
void add_ends_of_light(const StraightEdge& edge, const RaySource& source, const EdgeAxis& rim, std::vector<double>& ends) {
  constexpr double none = 1e-12;  // below this share of its terms a coefficient of the equation is rounding
  const dvec3 tangent = edge.tangent();
  const double along = glm::dot(tangent, rim.tangent);
  for (const double end : {edge.begin, edge.end}) {
    const double cos_cone = glm::dot(arrival(source, edge.origin + end * tangent).direction, tangent),
                 cone2 = cos_cone * cos_cone, square = along * along - cone2;
    const dvec3 offset = rim.origin - edge.origin - end * tangent;
    const double start = glm::dot(offset, tangent), half = start * along - cone2 * glm::dot(offset, rim.tangent),
                 constant = start * start - cone2 * glm::dot(offset, offset), root2 = half * half - square * constant;
    const double scale2 = glm::dot(offset, offset) + rim.length * rim.length;
    if (root2 < -none * scale2 || std::max(square * square * scale2, half * half) < none * scale2 * none) continue;
    const double sum = -(half + std::copysign(std::sqrt(std::max(root2, 0.0)), half));
    for (const double place : {sum / square, constant / sum})
      if ((start + place * along) * cos_cone > -none * rim.length) ends.push_back(place);
  }
}

// Where panels end that grow towards the middle [m].
std::vector<double> growing_panels(double length, double first) {
  std::vector<double> ends{0.0};
  for (double end = first; end < 0.45 * length; end *= panel_growth) ends.push_back(end);
  const std::size_t half = ends.size();
  ends.push_back(length / 2);
  for (std::size_t i = half; i-- > 0;) ends.push_back(length - ends[i]);
  return ends;
}

}  // namespace

std::optional<double> boundary_at(double n, double source, double observation) {
  for (const double boundary : wave_boundaries(n, source))
    if (std::abs(observation - boundary) < rounding_of_files) return boundary;
  return std::nullopt;
}

std::vector<double> rim_panels(const StraightEdge& lit, const RaySource& source, double source_angle, const EdgeAxis& rim,
                               double wavelength) {
  std::vector<double> ends = growing_panels(rim.length, first_panel * wavelength);
  add_boundaries(lit, source_angle, rim, ends);
  add_ends_of_light(lit, source, rim, ends);
  return joined(ends, rim.length, wavelength);
}

}  // namespace raytube
