#include "utd/surface/surface_waves.h"

#include <algorithm>
#include <cmath>

#include "core/work.h"
#include "utd/surface/fock.h"

namespace raytube {

namespace {

constexpr double widest_strip = 1.0 / 3.0, longest_step = 1.0 / 6.0;  // of the wavelength
constexpr double fock_step = 0.3;                                     // of xi
constexpr double far_xi = 4.0;                                        // on the lit side, where physical optics is right
constexpr double last_xi = 7.0;                                       // in the dark, where nothing is left
constexpr double sharpest = 1.5, gentle = 3.0;  // k times the radius of curvature, between which waves fade in
constexpr double across_wave = 1e-9;            // normals this close to across the wave are so but for rounding
constexpr double no_more = 1e-9;                // of a step or strip that would make another one
constexpr double widest = 30.0;                 // of a strip's width at its beginning
constexpr double least_curvature = 1e-6;        // times the target's radius

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
  SurfaceLook(const CurvedTarget& target, const LookVectors& look, std::span<const double> frequencies,
              std::vector<ImageEdge>* places)
      : target_(target), mesh_(target.tracer.mesh()), look_(look), places_(places) {
    for (const double f : frequencies) wavenumbers_.push_back(wavenumber(f));
    shortest_ = 2 * pi / std::ranges::max(wavenumbers_);
    lowest_ = std::ranges::min(wavenumbers_);
    highest_ = std::ranges::max(wavenumbers_);
    result_.scattering.resize(frequencies.size());
  }

  SurfaceWaveResult take() {
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
      if (target_.surfaces.region(t) != no_index && conducts(t)) find_boundary(t);
    return std::move(result_);
  }

 private:
  bool conducts(std::uint32_t t) const { return mesh_.patches[mesh_.triangle_patch[t]].material == no_index; }

  // Where the normal, linear over the facet, is across the wave.
  void find_boundary(std::uint32_t t) {
    double f[3];
    for (int c = 0; c < 3; ++c) {
      f[c] = glm::dot(target_.curvatures.normal(t, c), look_.incident);
      if (std::abs(f[c]) < across_wave) f[c] = 0.0;
    }
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
    if (q.curvature * mesh_.radius < least_curvature) return;
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

  // The width of a strip along a geodesic: w'' = -K w, exactly for the K of each step.
  struct Width {
    double width, slope = 0.0;
    bool past_caustic = false;
    void step(double gaussian, double h) {
      const double root = std::sqrt(std::abs(gaussian)), x = root * h;
      const double c = gaussian > 0.0 ? std::cos(x) : std::cosh(x);
      const double s = x < 1e-6 ? h : (gaussian > 0.0 ? std::sin(x) : std::sinh(x)) / root;
      const double before = width;
      width = c * width + s * slope;
      slope = c * slope - gaussian * s * before;
      if (width < 0.0) past_caustic = true;
    }
  };

  /// How far a bend is one along which a wave runs, by k rho: round sharper ones it leaves the surface as from an edge.
  static double openness(double k, double curvature) {
    return curvature <= 0.0 ? 1.0 : std::clamp((k / curvature - sharpest) / (gentle - sharpest), 0.0, 1.0);
  }

  int steps_of(double length, double curvature) const {
    const double scale = std::cbrt(0.5 * highest_ * curvature * curvature);
    const double h = std::min(longest_step * shortest_, scale > 0 ? fock_step / scale : length);
    return std::max(1, static_cast<int>(std::ceil(length / h - no_more)));
  }

  /// Calls visit(point, h) in the middles of steps along a geodesic until it returns false.
  template <class Visit>
  void walk(const FacetPoint& start, const dvec3& direction, double side, Visit visit) const {
    Geodesic geodesic(mesh_, target_.surfaces, target_.curvatures, target_.edges, start, direction);
    GeodesicPiece piece;
    while (geodesic.next(piece)) {
      const BentFacet facet = target_.surfaces.facet(piece.from.triangle);
      const dvec3 from = facet.point(piece.from.l), to = facet.point(piece.to);
      const double chord = glm::distance(from, to);
      if (chord <= 0.0) continue;
      const StripPoint middle = at(facet, {piece.from.triangle, 0.5 * (piece.from.l + piece.to)}, piece.direction, side);
      const double turn = middle.curvature * chord, length = chord * (1.0 + turn * turn / 24.0);
      const int steps = steps_of(length, middle.curvature);
      for (int i = 0; i < steps; ++i) {
        const dvec2 l = glm::mix(piece.from.l, piece.to, (i + 0.5) / steps);
        const StripPoint point = steps == 1 ? middle : at(facet, {piece.from.triangle, l}, piece.direction, side);
        if (!visit(point, length / steps)) return;
      }
    }
  }

  // Counts a step, and makes a place for what it radiates.
  double step_done(const StripPoint& point) {
    if (places_ != nullptr) places_->push_back({point.position, point.position, {}});
    return work::surface_step + work::surface_frequency * static_cast<double>(wavenumbers_.size());
  }

  void radiate(std::size_t f, const StripPoint& point, Complex along, Complex across, int transmit) {
    for (int p = 0; p < 2; ++p) {
      const Complex s = along * glm::dot(look_.receive[p], point.along) + across * glm::dot(look_.receive[p], point.binormal);
      result_.scattering[f].at(p, transmit) += s;
      if (places_ != nullptr) places_->back().s.at(p, transmit) += s;
    }
  }

  void follow_dark(const FacetPoint& start, const StripPoint& q, double across, double side) {
    double s = 0.0, distance = 0.0, sharp = q.curvature;  // distance: xi k^(-1/3)
    Width width{across};
    const double origin = glm::dot(look_.incident, q.position), lowest = std::cbrt(lowest_);
    walk(start, look_.incident, side, [&](const StripPoint& point, double h) {
      sharp = std::max(sharp, point.curvature);
      if (point.curvature < 0.0 || highest_ <= sharpest * sharp || std::abs(width.width) > widest * across) return false;
      const double rate = std::cbrt(0.5 * point.curvature * point.curvature);
      width.step(point.gaussian, 0.5 * h);
      const double x = distance + 0.5 * h * rate;
      if (lowest * x > last_xi) return false;
      const double area = std::sqrt(across * std::abs(width.width)) * h;
      result_.work += step_done(point);
      const double path = glm::dot(look_.scattered, point.position) - origin - s - 0.5 * h;
      const double bend = 0.5 * h * (glm::dot(look_.scattered, point.along) - 1.0);
      for (std::size_t f = 0; f < wavenumbers_.size(); ++f) {
        const double k = wavenumbers_[f];
        const FockCurrents fock = fock_in_the_dark(std::cbrt(k) * x);
        Complex factor = Complex(0, -k / (4 * pi)) * std::polar(openness(k, sharp) * area * sinc(k * bend), k * path);
        if (width.past_caustic) factor *= Complex(0, 1);
        const double m = std::cbrt(0.5 * k / std::max(point.curvature, least_curvature / mesh_.radius));
        for (int t = 0; t < 2; ++t)
          radiate(f, point, factor * fock.hard * glm::dot(look_.magnetic[t], q.binormal),
                  factor * fock.soft / m * glm::dot(look_.electric[t], q.binormal), t);
      }
      width.step(point.gaussian, 0.5 * h);
      distance += h * rate;
      s += h;
      return true;
    });
  }

  void follow_lit(const FacetPoint& start, const StripPoint& q, double across, double side) {
    Width width{across};
    double sharp = q.curvature;
    int turned_away = 0;
    const double lowest = std::cbrt(0.5 * lowest_);
    walk(start, -look_.incident, side, [&](const StripPoint& back, double h) {
      sharp = std::max(sharp, back.curvature);
      if (back.curvature <= 0.0 || highest_ <= sharpest * sharp || width.width > widest * across) return false;
      width.step(back.gaussian, 0.5 * h);
      const double grazing = -glm::dot(look_.incident, back.normal);
      const double per_root = grazing / std::cbrt(back.curvature);  // -xi (k / 2)^(-1/3)
      if (width.width <= 0.0 || lowest * per_root > far_xi + 1.0 || grazing > 0.999) return false;
      if (grazing <= 0.0) return ++turned_away < 3;  // right beside the boundary it is rounding
      StripPoint point = back;
      point.along = glm::normalize(look_.incident - glm::dot(look_.incident, back.normal) * back.normal);
      point.binormal = glm::cross(point.along, point.normal);
      const double area = width.width * h;
      result_.work += step_done(point);
      const double path = glm::dot(look_.scattered - look_.incident, point.position);
      const double bend = 0.5 * h * glm::dot(look_.scattered - look_.incident, back.along);
      for (std::size_t f = 0; f < wavenumbers_.size(); ++f) {
        const double k = wavenumbers_[f], xi = -std::cbrt(0.5 * k) * std::max(per_root, 1e-9);
        const double taper = std::clamp(far_xi + 1.0 + xi, 0.0, 1.0);
        if (taper == 0.0) continue;
        const FockCurrents fock = fock_factors(xi);
        const Complex factor =
            Complex(0, -k / (4 * pi)) * std::polar(openness(k, sharp) * taper * area * sinc(k * bend), k * path);
        for (int t = 0; t < 2; ++t)
          radiate(f, point, factor * (fock.hard - 1.0) * 2.0 * glm::dot(look_.magnetic[t], point.binormal),
                  factor * (fock.soft - 1.0) * -2.0 * glm::dot(look_.magnetic[t], point.along), t);
      }
      width.step(back.gaussian, 0.5 * h);
      return true;
    });
  }

  const CurvedTarget& target_;
  const TriangleMesh& mesh_;
  const LookVectors& look_;
  std::vector<double> wavenumbers_;
  double shortest_ = 0.0, lowest_ = 0.0, highest_ = 0.0;
  std::vector<ImageEdge>* places_;  // where the frequencies' currents are, for images; else null
  SurfaceWaveResult result_;
};

}  // namespace

CurvedTarget::CurvedTarget(const Tracer& a_tracer, const SmoothSurfaces& some_surfaces)
    : tracer(a_tracer),
      surfaces(some_surfaces),
      edges(tracer.mesh().triangles, tracer.mesh().vertices.size()),
      curvatures(tracer.mesh(), surfaces) {}

SurfaceWaveResult surface_wave_scattering(const CurvedTarget& target, const LookVectors& look,
                                          std::span<const double> frequencies) {
  return SurfaceLook(target, look, frequencies, nullptr).take();
}

std::vector<ImageEdge> surface_wave_pieces(const CurvedTarget& target, const LookVectors& look, double frequency) {
  std::vector<ImageEdge> places;
  SurfaceLook(target, look, std::span(&frequency, 1), &places).take();
  return places;
}

}  // namespace raytube
