#include "utd/surface/surface_waves.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/work.h"
#include "utd/surface/fock.h"
#include "utd/surface/strip_width.h"
#include "utd/surface/surface_ray.h"

namespace raytube {

namespace {

constexpr double widest_strip = 1.0 / 3.0, longest_step = 0.5;  // of the wavelength
constexpr double phase_bend = 0.2;                              // k kappa h^2 over a step h [rad]
constexpr double fock_step = 0.3;                               // of xi
constexpr double far_xi = 4.0;                                  // on the lit side, where physical optics is right
constexpr double last_xi = 10.0;                                // in the dark, where nothing is left
constexpr double sharpest = 1.5, gentle = 3.0;                  // k times the radius of curvature, between which waves fade in
constexpr double across_wave = 1e-9;                            // normals this close to across the wave are so but for rounding
constexpr double no_more = 1e-9;                                // of a step or strip that would make another one
constexpr double widest = 30.0;                                 // of a strip's width at its beginning
constexpr double at_caustic = 8.0;                              // so much finer are steps there
constexpr double head_on = 1.0 - 1e-9;  // |n . d|, where no direction along the surface is that of the wave
constexpr double least_xi = 1e-9;
constexpr double least_curvature = 1e-6;  // times the target's radius

/// Where the shadow boundary crosses a facet.
struct BoundaryPiece {
  std::uint32_t triangle;
  dvec2 from, to;  // barycentric coordinates
  double side;     // of the facet that the wave sees: 1 its front, -1 its back
};

/// The surface along a strip.
struct StripPoint {
  dvec3 position, normal, along, binormal;  // t, b = t x n
  double curvature, gaussian;
};

class SurfaceLook {
 public:
  SurfaceLook(const CurvedTarget& target, const LookVectors& look, std::span<const double> frequencies, StripPlaces* places)
      : target_(target), mesh_(target.tracer.mesh()), look_(look) {
    for (const double f : frequencies) wavenumbers_.push_back(wavenumber(f));
    shortest_ = 2 * pi / std::ranges::max(wavenumbers_);
    lowest_ = std::ranges::min(wavenumbers_);
    highest_ = std::ranges::max(wavenumbers_);
    result_.scattering.resize(frequencies.size());
    amplitudes_.resize(frequencies.size());
    sum_.emplace(wavenumbers_, result_.scattering, places);
  }

  SurfaceWaveResult take() {
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      if (target_.surfaces.region(t) != no_index && conducts(t)) {
        find_boundary(t);
        find_far_sides(t);
      }
    return std::move(result_);
  }

 private:
  bool conducts(std::uint32_t t) const { return mesh_.patches[mesh_.triangle_patch[t]].material == no_index; }

  // Where the normal, linear over the facet, is across the wave.
  void find_boundary(std::uint32_t t) {
    double f[3];
    for (int c = 0; c < 3; ++c) f[c] = facing(t, c);
    const int dark = (f[0] > 0) + (f[1] > 0) + (f[2] > 0);
    if (dark == 0 || dark == 3) return;
    dvec2 ends[2];
    int found = 0;
    for (int c = 0; c < 3; ++c) {
      const int next = (c + 1) % 3;
      if ((f[c] > 0) == (f[next] > 0)) continue;
      const double x = f[c] / (f[c] - f[next]);
      double l[3] = {};
      l[c] = 1.0 - x, l[next] = x;
      ends[found++] = {l[1], l[2]};
    }
    const bool closed = mesh_.components[mesh_.triangle_component[t]].closed;
    add_boundary({t, ends[0], ends[1], 1.0});
    if (!closed) add_boundary({t, ends[0], ends[1], -1.0});
  }

  void add_boundary(const BoundaryPiece& piece) {
    const BentFacet facet = target_.surfaces.facet(piece.triangle);
    const double length = glm::distance(facet.point(piece.from), facet.point(piece.to));
    const int parts = std::max(1, static_cast<int>(std::ceil(length / (widest_strip * shortest_) - no_more)));
    for (int i = 0; i < parts; ++i) {
      const dvec2 a = glm::mix(piece.from, piece.to, double(i) / parts), b = glm::mix(piece.from, piece.to, (i + 1.0) / parts);
      add_strip(facet, {piece.triangle, 0.5 * (a + b)}, facet.point(b) - facet.point(a), piece.side);
    }
  }

  // Where the surface ends before its shadow boundary: its lit part near that boundary is there all the same.
  void find_far_sides(std::uint32_t t) {
    for (int c = 0; c < 3; ++c) {
      if (!target_.surfaces.on_boundary(t, c)) continue;
      const Triangle& corners = mesh_.triangles[t];
      const dvec3& from = mesh_.vertices[corners[c]];
      const dvec3 way = mesh_.vertices[corners[(c + 1) % 3]] - from;
      const dvec3 inwards = glm::cross(mesh_.patches[mesh_.triangle_patch[t]].normal, way);
      if (glm::dot(inwards, look_.incident) > -across_wave * glm::length(inwards)) continue;
      const bool closed = mesh_.components[mesh_.triangle_component[t]].closed;
      add_far_sides(t, c, way, 1.0);
      if (!closed) add_far_sides(t, c, way, -1.0);
    }
  }

  // Along the lit part of a facet's side.
  void add_far_sides(std::uint32_t t, int c, const dvec3& way, double side) {
    const double a = side * facing(t, c), b = side * facing(t, (c + 1) % 3);
    if (a >= 0.0 && b >= 0.0) return;
    const double from = a > 0.0 ? a / (a - b) : 0.0, to = b > 0.0 ? a / (a - b) : 1.0, share = to - from;
    const int parts = std::max(1, static_cast<int>(std::ceil(share * glm::length(way) / (widest_strip * shortest_) - no_more)));
    for (int i = 0; i < parts; ++i) {
      const double x = from + share * (i + 0.5) / parts;
      double l[3] = {};
      l[c] = 1.0 - x;
      l[(c + 1) % 3] = x;
      add_far_side({t, {l[1], l[2]}}, c, way * (share / parts), side);
    }
  }

  // n . d at a corner, where rounding is none.
  double facing(std::uint32_t t, int c) const {
    const double f = glm::dot(target_.curvatures.normal(t, c), look_.incident);
    return std::abs(f) < across_wave ? 0.0 : f;
  }

  void add_far_side(const FacetPoint& start, int corner, const dvec3& width, double side) {
    StripPoint q = at(target_.surfaces.facet(start.triangle), start, look_.incident, side);
    const double grazing = -glm::dot(look_.incident, q.normal);
    if (grazing <= 0.0 || q.curvature * mesh_.radius < least_curvature || highest_ <= sharpest * q.curvature) return;
    if (std::cbrt(0.5 * lowest_) * grazing > (far_xi + 1.0) * std::cbrt(q.curvature) || !is_lit(q)) return;
    const double across = std::abs(glm::dot(width, q.binormal));
    ++result_.strips;
    follow_lit(start, q, across, side);
    const double way = glm::dot(look_.scattered - look_.incident, q.position);
    arrive(start.triangle, corner, side, q, q.binormal,
           [&](double k) { return lit_share(k, q, grazing, q.curvature).hard * std::polar(across, k * way); });
  }

  // A hard current reaches the end of the surface: half(k) of it, times its width and phase, for unit H along `binormal`.
  template <class Half>
  void arrive(std::uint32_t triangle, int corner, double side, const StripPoint& end, const dvec3& binormal, Half half) {
    SurfaceArrival arrival{triangle, corner, side < 0.0, end.position, end.along, {}};
    for (const double k : wavenumbers_) {
      const Complex current = half(k);
      arrival.magnetic.push_back(
          {current * glm::dot(look_.magnetic[0], binormal), current * glm::dot(look_.magnetic[1], binormal)});
    }
    result_.arrivals.push_back(std::move(arrival));
  }

  StripPoint at(const BentFacet& facet, const FacetPoint& p, const dvec3& walking, double side) const {
    const SurfaceFrame frame = target_.curvatures.at(p.triangle, p.l);
    StripPoint point;
    point.position = facet.point(p.l);
    point.normal = side * frame.normal;
    point.along = glm::normalize(walking - glm::dot(walking, frame.normal) * frame.normal);
    point.binormal = glm::cross(point.along, point.normal);
    point.curvature = side * frame.curvature(point.along);
    point.gaussian = frame.gaussian();
    return point;
  }

  void add_strip(const BentFacet& facet, const FacetPoint& start, const dvec3& width, double side) {
    const StripPoint q = at(facet, start, look_.incident, side);
    if (q.curvature * mesh_.radius < least_curvature || highest_ <= sharpest * q.curvature) return;
    const double across = std::abs(glm::dot(width, q.binormal));
    if (across <= 0.0 || !is_lit(q)) return;
    ++result_.strips;
    follow_dark(start, q, across, side);
    follow_lit(start, q, across, side);
  }

  bool is_lit(const StripPoint& q) const {
    const double lift = 2.0 * target_.surfaces.rise() + 1e-6 * mesh_.radius;
    return target_.tracer.blocker(q.position + lift * q.normal, -look_.incident, nothing_ignored) == no_index;
  }

  /// How far a bend is one along which a wave runs, by k rho: round sharper ones it leaves the surface as from an edge.
  static double openness(double k, double curvature) {
    return curvature <= 0.0 ? 1.0 : std::clamp((k / curvature - sharpest) / (gentle - sharpest), 0.0, 1.0);
  }

  // Over which the current, and the rate of its phase, change by little.
  int steps_of(double length, double curvature, bool fine) const {
    const double bend = std::sqrt(phase_bend / (highest_ * std::max(curvature, least_curvature / mesh_.radius)));
    const double fock = fock_step / std::max(std::cbrt(0.5 * highest_ * curvature * curvature), least_curvature / mesh_.radius);
    const double h = std::min({longest_step * shortest_, bend, fock}) / (fine ? at_caustic : 1.0);
    return std::max(1, static_cast<int>(std::ceil(length / h - no_more)));
  }

  /// Calls visit(point, h) at points of a geodesic, h from the last one, until it returns false; in fine steps over pieces for
  /// which fine(length) holds. The side of facet `last` at which the surface ended it, -1 if it did not.
  template <class Fine, class Visit>
  int walk(const FacetPoint& start, double curvature, const dvec3& direction, double side, Fine fine, Visit visit,
           std::uint32_t& last) const {
    Geodesic geodesic(mesh_, target_.surfaces, target_.curvatures, target_.edges, start, direction);
    GeodesicPiece piece;
    while (geodesic.next(piece)) {
      const BentFacet facet = target_.surfaces.facet(piece.from.triangle);
      const double chord = glm::distance(facet.point(piece.from.l), facet.point(piece.to));
      if (chord <= 0.0) continue;
      const double turn = curvature * chord, length = chord * (1.0 + turn * turn / 24.0);
      const int steps = steps_of(length, curvature, fine(length));
      for (int i = 1; i <= steps; ++i) {
        const dvec2 l = glm::mix(piece.from.l, piece.to, static_cast<double>(i) / steps);
        const StripPoint point = at(facet, {piece.from.triangle, l}, piece.direction, side);
        curvature = point.curvature;
        if (!visit(point, length / steps)) return -1;
      }
      last = piece.from.triangle;
    }
    return geodesic.ended_at();
  }

  /// S of a current per unit of -jk / 4 pi, its parts along t and b for both transmitted polarisations.
  ScatteringMatrix radiated(const StripPoint& point, const std::array<Complex, 2>& along,
                            const std::array<Complex, 2>& across) const {
    ScatteringMatrix s;
    for (int p = 0; p < 2; ++p)
      for (int t = 0; t < 2; ++t)
        s.at(p, t) = along[t] * glm::dot(look_.receive[p], point.along) + across[t] * glm::dot(look_.receive[p], point.binormal);
    return s;
  }

  void put(bool first, double step, double path, const StripPoint& point) {
    result_.work += work::surface_step + work::surface_frequency * static_cast<double>(wavenumbers_.size());
    sum_->add(first, step, path, point.position, amplitudes_);
  }

  // The current Q sends into the dark; `distance` is xi k^(-1/3), `area` the root of its width there and at Q, with its caustics.
  void set_dark_amplitudes(const StripPoint& point, const StripPoint& q, double distance, double sharp, Complex area) {
    for (std::size_t f = 0; f < wavenumbers_.size(); ++f) {
      const double k = wavenumbers_[f];
      const FockCurrents fock = fock_in_the_dark(std::cbrt(k) * distance);
      const Complex factor = Complex(0, -k / (4 * pi)) * openness(k, sharp) * area;
      const double m = std::cbrt(0.5 * k / std::max(point.curvature, least_curvature / mesh_.radius));
      std::array<Complex, 2> along, across;
      for (int t = 0; t < 2; ++t) {
        along[t] = factor * fock.hard * glm::dot(look_.magnetic[t], q.binormal);
        across[t] = factor * fock.soft / m * glm::dot(look_.electric[t], q.binormal);
      }
      amplitudes_[f] = radiated(point, along, across);
    }
  }

  void follow_dark(const FacetPoint& start, const StripPoint& q, double across, double side) {
    double s = 0.0, distance = 0.0, sharp = q.curvature, path = 0.0;
    Complex area;
    StripPoint end = q;
    std::uint32_t last = start.triangle;
    StripWidth width{across};
    const double origin = glm::dot(look_.incident, q.position), lowest = std::cbrt(lowest_);
    const auto visit = [&](const StripPoint& point, double h) {
      width.step(point.gaussian, h);
      distance += h * std::cbrt(0.5 * point.curvature * point.curvature);
      s += h;
      sharp = std::max(sharp, point.curvature);
      if (point.curvature < 0.0 || highest_ <= sharpest * sharp || std::abs(width.width) > widest * across) return false;
      if (lowest * distance > last_xi) return false;
      area = std::polar(std::sqrt(across * std::abs(width.width)), 0.5 * pi * width.caustics);
      path = glm::dot(look_.scattered, point.position) - origin - s;
      set_dark_amplitudes(point, q, distance, sharp, area);
      put(h == 0.0, h, path, point);
      end = point;
      return true;
    };
    if (!visit(q, 0.0)) return;
    const int corner = walk(
        start, q.curvature, look_.incident, side, [&](double length) { return width.near_caustic(length); }, visit, last);
    if (corner < 0) return;
    arrive(last, corner, side, end, q.binormal, [&](double k) {
      return 0.5 * openness(k, sharp) * area * fock_in_the_dark(std::cbrt(k) * distance).hard * std::polar(1.0, k * path);
    });
  }

  // Of the current of physical optics, what the one on the lit side has beside it; `grazing` is |n . d|.
  static FockCurrents lit_share(double k, const StripPoint& point, double grazing, double sharp) {
    const double xi = -std::max(grazing * std::cbrt(0.5 * k / point.curvature), least_xi);
    const FockCurrents fock = fock_factors(xi);
    const double share = openness(k, sharp) * std::clamp(far_xi + 1.0 + xi, 0.0, 1.0);
    return {share * (fock.hard - 1.0), share * (fock.soft - 1.0)};
  }

  void set_lit_amplitudes(const StripPoint& point, double grazing, double sharp, double area) {
    for (std::size_t f = 0; f < wavenumbers_.size(); ++f) {
      const double k = wavenumbers_[f];
      const FockCurrents more = lit_share(k, point, grazing, sharp);
      const Complex factor = Complex(0, -k / (4 * pi)) * area;
      std::array<Complex, 2> along, across;
      for (int t = 0; t < 2; ++t) {
        along[t] = factor * more.hard * 2.0 * glm::dot(look_.magnetic[t], point.binormal);
        // physical optics with E along b: 2 |n . d| E . b
        across[t] = factor * more.soft * 2.0 * std::max(grazing, least_xi * std::cbrt(point.curvature / (0.5 * k))) *
                    glm::dot(look_.electric[t], point.binormal);
      }
      amplitudes_[f] = radiated(point, along, across);
    }
  }

  void follow_lit(const FacetPoint& start, const StripPoint& q, double across, double side) {
    StripWidth width{across};
    double sharp = q.curvature;
    std::uint32_t last = start.triangle;
    int turned_away = 0;
    const double lowest = std::cbrt(0.5 * lowest_);
    const auto visit = [&](const StripPoint& back, double h) {
      width.step(back.gaussian, h);
      sharp = std::max(sharp, back.curvature);
      if (back.curvature <= 0.0 || highest_ <= sharpest * sharp || width.width <= 0.0 || width.width > widest * across)
        return false;
      const double grazing = -glm::dot(look_.incident, back.normal);
      if (lowest * grazing > (far_xi + 1.0) * std::cbrt(back.curvature) || grazing > head_on) return false;
      if (h > 0.0 && grazing <= 0.0 && ++turned_away == 3) return false;  // right beside the boundary it is rounding
      StripPoint point = back;
      point.along = glm::normalize(look_.incident + grazing * back.normal);
      point.binormal = glm::cross(point.along, point.normal);
      set_lit_amplitudes(point, grazing, sharp, width.width);
      put(h == 0.0, h, glm::dot(look_.scattered - look_.incident, point.position), point);
      return true;
    };
    if (visit(q, 0.0))
      walk(
          start, q.curvature, -look_.incident, side, [](double) { return false; }, visit, last);
  }

  const CurvedTarget& target_;
  const TriangleMesh& mesh_;
  const LookVectors& look_;
  std::vector<double> wavenumbers_;
  double shortest_ = 0.0, lowest_ = 0.0, highest_ = 0.0;
  std::vector<ScatteringMatrix> amplitudes_;  // of the point at hand, by frequency
  std::optional<StripSum> sum_;
  SurfaceWaveResult result_;
};

}  // namespace

SurfaceWaveResult surface_wave_scattering(const CurvedTarget& target, const LookVectors& look,
                                          std::span<const double> frequencies, StripPlaces* places) {
  return SurfaceLook(target, look, frequencies, places).take();
}

}  // namespace raytube
