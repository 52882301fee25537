#include "utd/surface/far_sides.h"

#include <algorithm>
#include <cmath>

#include "scene/frequency_bands.h"
#include "utd/surface/lit_frame.h"
#include "utd/surface/strip_point.h"
#include "utd/wedge/rounding_guard.h"

namespace raytube {

namespace {

class FarSides {
 public:
  FarSides(const CurvedTarget& target, LocalLook& look, std::span<const double> wavenumbers, BandSum& band)
      : target_(target),
        mesh_(target.tracer.mesh()),
        look_(look),
        wavenumbers_(wavenumbers),
        band_(band),
        lowest_(least_wavenumber(wavenumbers)),
        shortest_(2 * pi / greatest_wavenumber(wavenumbers)) {}

  void find(std::uint32_t t) {
    for (int c = 0; c < 3; ++c) {
      if (!target_.surfaces.on_boundary(t, c)) continue;
      const Triangle& corners = mesh_.triangles[t];
      const dvec3& from = mesh_.vertices[corners[c]];
      const dvec3 way = mesh_.vertices[corners[(c + 1) % 3]] - from;
      const dvec3 inwards = glm::cross(mesh_.patch_of(t).normal, way);
      if (glm::dot(inwards, look_.incident(from + 0.5 * way)) > -1e-9 * glm::length(inwards)) continue;
      add_far_sides(t, c, way, 1.0);
      if (!mesh_.closed(t)) add_far_sides(t, c, way, -1.0);
    }
  }

  std::vector<SurfaceArrival> take() { return std::move(arrivals_); }

 private:
  double facing(std::uint32_t t, int corner) const {
    return target_.facing(t, corner, look_.incident(target_.corner(t, corner)));
  }

  // Adds strips along the lit part of a facet's side, each a third of a wavelength wide at most.
  void add_far_sides(std::uint32_t t, int c, const dvec3& way, double side) {
    const double a = side * facing(t, c), b = side * facing(t, (c + 1) % 3);
    if (a >= 0.0 && b >= 0.0) return;
    const double from = a > 0.0 ? a / (a - b) : 0.0, to = b > 0.0 ? a / (a - b) : 1.0, share = to - from;
    const int parts = static_cast<int>(part_count(share * glm::length(way) / (1.0 / 3.0 * shortest_)));
    for (int i = 0; i < parts; ++i) {
      const double x = from + share * (i + 0.5) / parts;
      double l[3] = {};
      l[c] = 1.0 - x;
      l[(c + 1) % 3] = x;
      add_far_side({t, {l[1], l[2]}}, c, way * (share / parts), side);
    }
  }

  // The wave comes and goes over the part's whole width.
  void add_far_side(const FacetPoint& start, int corner, const dvec3& width, double side) {
    const dvec3 incident = look_.incident(target_.surfaces.facet(start.triangle).point(start.l));
    const StripPoint q = strip_point(target_, start, incident, side);
    const double grazing = -glm::dot(incident, q.normal);
    const LitFrame frame(target_.frame(start.triangle, start.l, side), incident);
    if (grazing <= 0.0 || frame.distance(lowest_) <= -least_lit || !target_.is_lit(q.position, q.normal, incident)) return;
    const double across = std::abs(glm::dot(width, q.binormal)),
                 half_path = 0.5 * glm::dot(width, incident - look_.at(q.position).scattered);
    const LookVectors& here = look_.at(q.position);
    const std::array<double, 2> magnetic = q.across(here.magnetic);
    SurfaceArrival arrival{start.triangle, corner, side < 0.0, q.position, q.along, q.position, look_.both(q.position), {}};
    const std::vector<Complex> currents = band_.everywhere([&](double k) {
      return across * target_.width_share(mesh_.triangle_component[start.triangle], k) * lit_excess(frame, k).hard *
             sinc(k * half_path);
    });
    for (std::size_t f = 0; f < wavenumbers_.size(); ++f) {
      const Complex current = currents[f] * std::polar(1.0, wavenumbers_[f] * arrival.path);
      arrival.magnetic.push_back({current * magnetic[0], current * magnetic[1]});
    }
    arrivals_.push_back(std::move(arrival));
  }

  const CurvedTarget& target_;
  const TriangleMesh& mesh_;
  LocalLook& look_;
  std::span<const double> wavenumbers_;
  BandSum& band_;
  double lowest_, shortest_;  // wavenumber, wavelength
  std::vector<SurfaceArrival> arrivals_;
};

}  // namespace

std::vector<SurfaceArrival> far_side_arrivals(const CurvedTarget& target, LocalLook& look, std::span<const double> wavenumbers,
                                              BandSum& band) {
  FarSides sides(target, look, wavenumbers, band);
  for (std::uint32_t t = 0; t < target.tracer.mesh().triangles.size(); ++t)
    if (target.runs_over(t, wavenumbers.front()) && target.surfaces.conducts(t)) sides.find(t);
  return sides.take();
}

}  // namespace raytube
