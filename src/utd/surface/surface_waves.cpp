#include "utd/surface/surface_waves.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/work.h"
#include "utd/surface/fock.h"
#include "utd/surface/lit_currents.h"
#include "utd/surface/lit_frame.h"
#include "utd/surface/shadow_boundary.h"
#include "utd/surface/strip_width.h"
#include "utd/surface/surface_ray.h"

namespace raytube {

namespace {

constexpr double widest_strip = 1.0 / 3.0, widest_piece = 1.0 / 6, longest_step = 0.5;  // of the wavelength
constexpr double most_turn = 0.3;         // of the normal over a piece of the shadow boundary [rad]
constexpr double phase_bend = 0.2;        // k kappa h^2 over a step h [rad]
constexpr double fock_step = 0.3;         // of xi
constexpr double last_xi = 10.0;          // in the dark, where nothing is left
constexpr double no_more = 1e-9;          // of a step or strip that would make another one
constexpr double widest = 30.0;           // of a strip's width at its beginning
constexpr double at_caustic = 8.0;        // so much finer are steps there
constexpr double least_curvature = 1e-6;  // times the target's radius
constexpr double least_width = 1e-3;      // of a ray in pictures, of that at its start

/// The surface along a strip.
struct StripPoint {
  dvec3 position, normal, along, binormal;  // t, b = t x n
  double curvature, gaussian;
};

class SurfaceLook {
 public:
  SurfaceLook(const CurvedTarget& target, const LookVectors& look, std::span<const double> frequencies, StripPlaces* places,
              std::vector<SurfaceRay>* rays)
      : target_(target), mesh_(target.tracer.mesh()), look_(look), places_(places), rays_(rays) {
    for (const double f : frequencies) wavenumbers_.push_back(wavenumber(f));
    shortest_ = 2 * pi / std::ranges::max(wavenumbers_);
    lowest_ = std::ranges::min(wavenumbers_);
    highest_ = std::ranges::max(wavenumbers_);
    result_.scattering.resize(frequencies.size());
    amplitudes_.resize(frequencies.size());
    sum_.emplace(wavenumbers_, result_.scattering, places);
  }

  SurfaceWaveResult take() {
    for (const BoundaryPiece& piece : shadow_boundary(target_, look_, widest_piece * shortest_, most_turn)) {
      add_strip(piece, 1.0);
      if (!target_.closed(piece.middle.triangle)) add_strip(piece, -1.0);
    }
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      if (target_.runs_on(t)) find_far_sides(t);
    if (rays_ != nullptr) std::erase_if(*rays_, [](const SurfaceRay& ray) { return ray.points.size() < 2; });
    result_.work += add_lit_currents(target_, look_, wavenumbers_, result_.scattering, places_);
    return std::move(result_);
  }

 private:
  // Where the surface ends before its shadow boundary: its lit part near that boundary is there all the same.
  void find_far_sides(std::uint32_t t) {
    for (int c = 0; c < 3; ++c) {
      if (!target_.surfaces.on_boundary(t, c)) continue;
      const Triangle& corners = mesh_.triangles[t];
      const dvec3& from = mesh_.vertices[corners[c]];
      const dvec3 way = mesh_.vertices[corners[(c + 1) % 3]] - from;
      const dvec3 inwards = glm::cross(mesh_.patches[mesh_.triangle_patch[t]].normal, way);
      if (glm::dot(inwards, look_.incident) > -1e-9 * glm::length(inwards)) continue;
      add_far_sides(t, c, way, 1.0);
      if (!target_.closed(t)) add_far_sides(t, c, way, -1.0);
    }
  }

  // Along the lit part of a facet's side.
  void add_far_sides(std::uint32_t t, int c, const dvec3& way, double side) {
    const double a = side * target_.facing(t, c, look_.incident), b = side * target_.facing(t, (c + 1) % 3, look_.incident);
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

  void add_far_side(const FacetPoint& start, int corner, const dvec3& width, double side) {
    StripPoint q = at(target_.surfaces.facet(start.triangle), start, look_.incident, side);
    const double grazing = -glm::dot(look_.incident, q.normal);
    const LitFrame frame(target_.frame(start.triangle, start.l, side), look_.incident);
    if (grazing <= 0.0 || frame.distance(lowest_) <= -least_lit || !target_.is_lit(q.position, q.normal, look_.incident)) return;
    const double across = std::abs(glm::dot(width, q.binormal));
    ++result_.strips;
    const double way = glm::dot(look_.scattered - look_.incident, q.position);
    arrive(start.triangle, corner, side, q, q.binormal,
           [&](double k) { return lit_share(frame, k).hard * std::polar(across, k * way); });
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
    const SurfaceFrame frame = target_.frame(p.triangle, p.l, side);
    StripPoint point;
    point.position = facet.point(p.l);
    point.normal = frame.normal;
    point.along = glm::normalize(walking - glm::dot(walking, frame.normal) * frame.normal);
    point.binormal = glm::cross(point.along, point.normal);
    point.curvature = frame.curvature(point.along);
    point.gaussian = frame.gaussian();
    return point;
  }

  void add_strip(const BoundaryPiece& piece, double side) {
    const FacetPoint& start = piece.middle;
    const StripPoint q = at(target_.surfaces.facet(start.triangle), start, look_.incident, side);
    const double across = std::abs(glm::dot(piece.chord, q.binormal));
    if (q.curvature * mesh_.radius < least_curvature || across <= 0.0) return;
    if (!target_.is_lit(q.position, q.normal, look_.incident)) return;
    ++result_.strips;
    follow_dark(start, q, across, side);
  }

  // Over so much of a strip the current, and the rate of its phase, change by little [m].
  double step_limit(double curvature, bool fine) const {
    const double bend = std::sqrt(phase_bend / (highest_ * std::max(curvature, least_curvature / mesh_.radius)));
    const double fock = fock_step / std::max(std::cbrt(0.5 * highest_ * curvature * curvature), least_curvature / mesh_.radius);
    return std::min({longest_step * shortest_, bend, fock}) / (fine ? at_caustic : 1.0);
  }

  /// Calls visit(point, h, last) at points of a geodesic, h from the one before, until it returns false; `last`: the next one may
  /// be more than a step_limit after the last such point. Fine over pieces for which fine(length) holds. The side of facet
  /// `end` at which the surface ended it, -1 if it did not.
  template <class Fine, class Visit>
  int walk(const FacetPoint& start, double curvature, const dvec3& direction, double side, Fine fine, Visit visit,
           std::uint32_t& end) const {
    Geodesic geodesic(mesh_, target_.surfaces, target_.curvatures, target_.edges, start, direction);
    GeodesicPiece piece;
    double since = 0.0;
    while (geodesic.next(piece)) {
      const BentFacet facet = target_.surfaces.facet(piece.from.triangle);
      const double chord = glm::distance(facet.point(piece.from.l), facet.point(piece.to));
      if (chord <= 0.0) continue;
      const double turn = curvature * chord, length = chord * (1.0 + turn * turn / 24.0);
      const double limit = step_limit(curvature, fine(length));
      const int steps = std::max(1, static_cast<int>(std::ceil(length / limit - no_more)));
      for (int i = 1; i <= steps; ++i) {
        const dvec2 l = glm::mix(piece.from.l, piece.to, static_cast<double>(i) / steps);
        const StripPoint point = at(facet, {piece.from.triangle, l}, piece.direction, side);
        curvature = point.curvature;
        since += length / steps;
        const bool last = since + length / steps > limit;
        if (!visit(point, length / steps, last)) return -1;
        if (last) since = 0.0;
      }
      end = piece.from.triangle;
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

  // For pictures.
  void keep_dark(const StripPoint& point, double s, const DarkWay& way, double width) {
    const double k = wavenumbers_.front(), share = std::abs(width);
    const FockCurrents fock = way.currents(k);
    const double factor = 1.0 / std::sqrt(std::max(share, least_width));
    const double m = std::cbrt(0.5 * k / std::max(point.curvature, least_curvature / mesh_.radius));
    if (s == 0.0) rays_->push_back({SurfaceRayKind::into_the_dark, 1});
    rays_->back().points.push_back(
        {point.position, s, way.distance(k), share, factor * std::abs(fock.hard), factor * std::abs(fock.soft) / m});
  }

  // The current Q sends into the dark; `area` is the root of its width there and at Q, with its caustics.
  void set_dark_amplitudes(const StripPoint& point, const StripPoint& q, const DarkWay& way, Complex area) {
    for (std::size_t f = 0; f < wavenumbers_.size(); ++f) {
      const double k = wavenumbers_[f];
      const FockCurrents fock = way.currents(k);
      const Complex factor = Complex(0, -k / (4 * pi)) * area;
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
    double s = 0.0, since = 0.0, path = 0.0;
    DarkWay way;
    Complex area;
    StripPoint end = q;
    std::uint32_t facet = start.triangle;
    StripWidth width{across};
    const double origin = glm::dot(look_.incident, q.position);
    const auto put_end = [&](bool first) {
      area = std::polar(std::sqrt(across * std::abs(width.width)), 0.5 * pi * width.caustics);
      path = glm::dot(look_.scattered, end.position) - origin - s;
      set_dark_amplitudes(end, q, way, area);
      put(first, since, path, end);
      if (rays_ != nullptr) keep_dark(end, s, way, width.width / across);
      since = 0.0;
    };
    put_end(true);
    const auto visit = [&](const StripPoint& point, double h, bool last) {
      if (point.curvature < 0.0) return false;
      width.step(point.gaussian, h);
      if (std::abs(width.width) > widest * across) return false;
      way.step(point.curvature, point.gaussian, h);
      s += h, since += h;
      end = point;
      if (last) put_end(false);
      return way.distance(lowest_) < last_xi;
    };
    const int corner = walk(
        start, q.curvature, look_.incident, side, [&](double length) { return width.near_caustic(length); }, visit, facet);
    if (since > 0.0) put_end(false);
    if (corner < 0) return;
    arrive(facet, corner, side, end, q.binormal,
           [&](double k) { return 0.5 * area * way.currents(k).hard * std::polar(1.0, k * path); });
  }

  const CurvedTarget& target_;
  const TriangleMesh& mesh_;
  const LookVectors& look_;
  StripPlaces* places_;
  std::vector<SurfaceRay>* rays_;
  std::vector<double> wavenumbers_;
  double shortest_ = 0.0, lowest_ = 0.0, highest_ = 0.0;
  std::vector<ScatteringMatrix> amplitudes_;  // of the point at hand, by frequency
  std::optional<StripSum> sum_;
  SurfaceWaveResult result_;
};

}  // namespace

SurfaceWaveResult surface_wave_scattering(const CurvedTarget& target, const LookVectors& look,
                                          std::span<const double> frequencies, StripPlaces* places,
                                          std::vector<SurfaceRay>* rays) {
  return SurfaceLook(target, look, frequencies, places, rays).take();
}

}  // namespace raytube
