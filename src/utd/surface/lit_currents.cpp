#include "utd/surface/lit_currents.h"

#include <algorithm>
#include <cmath>

#include "core/work.h"
#include "utd/surface/lit_frame.h"

namespace raytube {

namespace {

constexpr double longest_phase = 3.0;  // [rad] over a triangle of three points
constexpr double point_phase = 0.6;    // over one of a single point
constexpr double longest_turn = 0.5;   // of xi
constexpr double far_xi = 7.0;         // of a facet's middle, where nothing of it is nearer than least_lit
constexpr double rounding = 1e-9;      // of n . d, and of a part that would make another one
constexpr double six = 1.0 / 6.0;      // barycentric, of the three points exact for polynomials of degree 2

using Corners = std::array<dvec2, 3>;

// The part of a facet that is turned to the wave, in triangles of barycentric coordinates; `facing` is n . d at the corners.
class LitParts {
 public:
  explicit LitParts(const std::array<double, 3>& facing) {
    constexpr Corners corners{dvec2(0, 0), dvec2(1, 0), dvec2(0, 1)};
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t next = (c + 1) % 3;
      if (facing[c] < 0.0) put(corners[c]);
      if ((facing[c] < 0.0) != (facing[next] < 0.0))
        put(glm::mix(corners[c], corners[next], facing[c] / (facing[c] - facing[next])));
    }
  }

  // A quadrilateral in four about its middle, whichever of its corners comes first.
  std::size_t size() const { return count_ == 3 ? 1 : count_; }
  Corners operator[](std::size_t i) const {
    if (count_ == 3) return {border_[0], border_[1], border_[2]};
    return {border_[i], border_[(i + 1) % 4], 0.25 * (border_[0] + border_[1] + border_[2] + border_[3])};
  }

 private:
  void put(const dvec2& l) { border_[count_++] = l; }

  std::array<dvec2, 4> border_;
  std::size_t count_ = 0;
};

dvec2 middle(const Corners& c) { return (c[0] + c[1] + c[2]) / 3.0; }

class LitSide {
 public:
  LitSide(const CurvedTarget& target, const LookVectors& look, std::span<const double> wavenumbers,
          std::span<ScatteringMatrix> sum, StripPlaces* places)
      : target_(target), look_(look), wavenumbers_(wavenumbers), sum_(sum), places_(places) {
    lowest_ = std::ranges::min(wavenumbers);
    highest_ = std::ranges::max(wavenumbers);
  }

  double work() const { return work_; }

  void add(std::uint32_t triangle, double side) {
    std::array<double, 3> facing;
    for (int c = 0; c < 3; ++c) facing[c] = side * target_.facing(triangle, c, look_.incident);
    const LitParts parts(facing);
    const Facet facet{triangle, side, target_.surfaces.facet(triangle)};
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const dvec2 l = middle(parts[i]);
      const LitFrame frame = frame_at(facet, l);
      if (frame.distance(lowest_) > -far_xi && target_.is_lit(facet.surface.point(l), frame.normal, look_.incident))
        add_part(facet, frame, parts[i]);
    }
  }

 private:
  struct Facet {
    std::uint32_t triangle;
    double side;
    BentFacet surface;
  };

  LitFrame frame_at(const Facet& facet, const dvec2& l) const {
    return {target_.frame(facet.triangle, l, facet.side), look_.incident};
  }

  // The phase over the longest side of a triangle [rad].
  double phase_over(const std::array<dvec3, 3>& corners) const {
    double most = 0.0;
    for (int c = 0; c < 3; ++c)
      most = std::max(most, std::abs(glm::dot(look_.scattered - look_.incident, corners[(c + 1) % 3] - corners[c])));
    return highest_ * most;
  }

  // By how much xi changes over it, about.
  double turn_over(const Facet& facet, const LitFrame& frame, const std::array<dvec3, 3>& corners) const {
    const glm::dmat3 turn = target_.curvatures.at(facet.triangle, dvec2(1.0 / 3)).normal_turn;
    double most = 0.0;
    for (int c = 0; c < 3; ++c)
      most = std::max(most, std::abs(glm::dot(look_.incident, turn * (corners[(c + 1) % 3] - corners[c]))));
    const double grazing = std::max(-glm::dot(frame.normal, look_.incident), rounding);
    return most * std::min(-frame.distance(highest_), least_lit) / grazing;
  }

  void add_part(const Facet& facet, const LitFrame& frame, const Corners& corners) {
    std::array<dvec3, 3> points;
    for (std::size_t c = 0; c < 3; ++c) points[c] = facet.surface.point(corners[c]);
    const double phase = phase_over(points);
    const double cuts = std::max(phase / longest_phase, turn_over(facet, frame, points) / longest_turn);
    const int parts = std::max(1, static_cast<int>(std::ceil(cuts - rounding)));
    const dvec2 u = (corners[1] - corners[0]) / double(parts), v = (corners[2] - corners[0]) / double(parts);
    for (int i = 0; i < parts; ++i)
      for (int j = 0; i + j < parts; ++j) {
        const dvec2 from = corners[0] + double(i) * u + double(j) * v;
        add_triangle(facet, from, u, v, phase < point_phase);
        if (i + j + 1 < parts) add_triangle(facet, from + u + v, -u, -v, phase < point_phase);
      }
  }

  void add_triangle(const Facet& facet, const dvec2& from, const dvec2& u, const dvec2& v, bool single) {
    const double area = 0.5 * std::abs(u.x * v.y - u.y * v.x);
    if (single) return add_point(facet, from + (u + v) / 3.0, area);
    add_point(facet, from + six * (u + v), area / 3);
    add_point(facet, from + 4 * six * u + six * v, area / 3);
    add_point(facet, from + six * u + 4 * six * v, area / 3);
  }

  void add_point(const Facet& facet, const dvec2& l, double weight) {
    const LitFrame frame = frame_at(facet, l);
    const dvec3 position = facet.surface.point(l);
    const double area = weight * glm::length(glm::cross(facet.surface.along_1(l), facet.surface.along_2(l)));
    const double path = glm::dot(look_.scattered - look_.incident, position);
    for (std::size_t f = 0; f < wavenumbers_.size(); ++f) {
      const double k = wavenumbers_[f];
      ScatteringMatrix s = radiated(frame, lit_share(frame, k));
      s *= Complex(0, -k / (4 * pi)) * std::polar(area, k * path);
      sum_[f] += s;
      if (places_ != nullptr && places_->wavenumber == f) places_->pieces.push_back({position, position, s});
    }
    work_ += work::lit_point + work::lit_frequency * static_cast<double>(wavenumbers_.size());
  }

  // 2 n x H, each part of it times its share.
  ScatteringMatrix radiated(const LitFrame& frame, const FockCurrents& share) const {
    const dvec3 hard = glm::cross(frame.normal, frame.straight), soft = glm::cross(frame.normal, frame.bent);
    ScatteringMatrix s;
    for (int t = 0; t < 2; ++t) {
      const Complex h = 2.0 * share.hard * glm::dot(look_.magnetic[t], frame.straight);
      const Complex e = 2.0 * share.soft * glm::dot(look_.magnetic[t], frame.bent);
      for (int p = 0; p < 2; ++p) s.at(p, t) = h * glm::dot(look_.receive[p], hard) + e * glm::dot(look_.receive[p], soft);
    }
    return s;
  }

  const CurvedTarget& target_;
  const LookVectors& look_;
  std::span<const double> wavenumbers_;
  std::span<ScatteringMatrix> sum_;
  StripPlaces* places_;
  double lowest_, highest_, work_ = 0.0;
};

}  // namespace

double add_lit_currents(const CurvedTarget& target, const LookVectors& look, std::span<const double> wavenumbers,
                        std::span<ScatteringMatrix> sum, StripPlaces* places) {
  LitSide lit(target, look, wavenumbers, sum, places);
  for (std::uint32_t t = 0; t < target.tracer.mesh().triangles.size(); ++t) {
    if (!target.runs_on(t)) continue;
    lit.add(t, 1.0);
    if (!target.closed(t)) lit.add(t, -1.0);
  }
  return lit.work();
}

}  // namespace raytube
