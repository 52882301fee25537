#include "utd/visibility.h"

#include <algorithm>
#include <cmath>

namespace raytube {

namespace {

constexpr int min_points = 8;
constexpr int max_points = 128;
constexpr double clip_tolerance = 1e-9;  // fraction of the wedge's length
// The outermost test points stand this far inside the ends, as a fraction of the length: at a corner the third face is touched.
constexpr double end_margin = 1e-6;
// A ray in the plane of a face runs along the mesh; it starts this far above it, in radii of the target: the lit limit.
constexpr double lift = 1e-6;

/// Asks for single points of one wedge.
struct EdgeProbe {
  const Wedge& wedge;
  const Tracer& tracer;
  dvec3 direction;
  dvec3 offset;

  bool lit(double fraction) const {
    const dvec3 point = glm::mix(wedge.start, wedge.end, fraction) + offset;
    return !tracer.occluded(point, direction, wedge.faces[0].patch, wedge.faces[1].patch);
  }

  double transition(double low, double high, bool lit_at_low) const {
    while (high - low > clip_tolerance) {
      const double middle = (low + high) / 2;
      (lit(middle) == lit_at_low ? low : high) = middle;
    }
    return (low + high) / 2;
  }
};

int point_count(double length, double wavelength) {
  const double wanted = std::ceil(2 * length / wavelength) + 1;
  return static_cast<int>(std::clamp(wanted, double{min_points}, double{max_points}));
}

/// Walks along the wedge and notes where light changes to shadow and back.
void scan(const EdgeProbe& probe, int points, std::vector<LitInterval>& lit) {
  double previous = end_margin, begin = 0.0;
  bool was_lit = probe.lit(previous);
  for (int point = 1; point < points; ++point) {
    const double here = end_margin + (1 - 2 * end_margin) * point / (points - 1);
    if (probe.lit(here) != was_lit) {
      const double change = probe.transition(previous, here, was_lit);
      if (was_lit) lit.push_back({begin, change});
      begin = change;
      was_lit = !was_lit;
    }
    previous = here;
  }
  if (was_lit) lit.push_back({begin, 1.0});
}

}  // namespace

void find_lit_intervals(const Wedge& wedge, const WedgeIncidence& incidence, const dvec3& towards_transmitter, double wavelength,
                        const Tracer& tracer, std::vector<LitInterval>& lit) {
  lit.clear();
  if (incidence.weight == 0.0) return;
  const EdgeProbe probe{wedge, tracer, towards_transmitter, incidence.free_side * (lift * tracer.mesh().radius)};
  scan(probe, point_count(wedge.length(), wavelength), lit);
}

}  // namespace raytube
