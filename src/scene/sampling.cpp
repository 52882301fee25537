#include "scene/sampling.h"

#include <algorithm>
#include <set>

namespace raytube {

namespace {

constexpr int directions = 40;  // over a half sphere: none is farther than 0.32 rad from one of them, 1 - cos 0.32 = 5 %

// Evenly spread by the golden angle.
dvec3 direction(int i) {
  const double z = (i + 0.5) / directions, across = std::sqrt(1.0 - z * z), azimuth = i * pi * (3.0 - std::sqrt(5.0));
  return {across * std::cos(azimuth), across * std::sin(azimuth), z};
}

}  // namespace

std::vector<dvec3> outermost_points(std::span<const dvec3> points) {
  std::set<std::size_t> chosen;
  for (int i = 0; i < directions && !points.empty(); ++i) {
    const dvec3 along = direction(i);
    std::size_t low = 0, high = 0;
    double lowest = glm::dot(points[0], along), highest = lowest;
    for (std::size_t k = 1; k < points.size(); ++k) {
      const double here = glm::dot(points[k], along);
      if (here < lowest) low = k, lowest = here;
      if (here > highest) high = k, highest = here;
    }
    chosen.insert({low, high});
  }
  std::vector<dvec3> outermost;
  for (const std::size_t i : chosen) outermost.push_back(points[i]);
  return outermost;
}

double largest_extent(std::span<const dvec3> outermost) {
  double largest = 0.0;
  for (const dvec3& a : outermost)
    for (const dvec3& b : outermost) largest = std::max(largest, glm::length(a - b));
  return largest;
}

dvec3 scattering_vector(const Look& look, double frequency) {
  return wavenumber(frequency) * (spherical_basis(look.transmit).radial + spherical_basis(look.receive).radial);
}

double phase_turn(std::span<const dvec3> outermost, const dvec3& from, const dvec3& to) {
  if (outermost.empty()) return 0.0;
  const dvec3 change = to - from;
  double low = glm::dot(outermost[0], change), high = low;
  for (const dvec3& point : outermost) {
    const double phase = glm::dot(point, change);
    low = std::min(low, phase);
    high = std::max(high, phase);
  }
  return high - low;
}

}  // namespace raytube
