#include "utd/surface/lit_currents.h"

#include <algorithm>
#include <cmath>

#include "math/triangle_moments.h"
#include "scene/frequency_bands.h"
#include "utd/surface/lit_frame.h"
#include "utd/wedge/rounding_guard.h"
#include "utd/wedge/work.h"

namespace raytube {

namespace {

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

double area(const Corners& c) {
  const dvec2 u = c[1] - c[0], v = c[2] - c[0];
  return 0.5 * std::abs(u.x * v.y - u.y * v.x);
}

class LitSide {
 public:
  LitSide(const CurvedTarget& target, LocalLook& look, std::span<const double> wavenumbers, BandSum& sum, StripPlaces* places)
      : target_(target), look_(look), sum_(sum), places_(places) {
    lowest_ = least_wavenumber(wavenumbers);
    highest_ = greatest_wavenumber(wavenumbers);
  }

  double work() const { return work_; }

  void add(std::uint32_t triangle, double side) {
    Facet facet{triangle, side, {}, target_.surfaces.facet(triangle)};
    for (int c = 0; c < 3; ++c) facet.facing[c] = side * target_.facing(triangle, c, look_.incident(target_.corner(triangle, c)));
    const LitParts parts(facet.facing);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const dvec2 l = middle(parts[i]);
      const dvec3 position = facet.surface.point(l), incident = look_.incident(position);
      const LitFrame frame(target_.frame(facet.triangle, l, facet.side), incident);
      // A facet whose middle is beyond xi = -7 has nothing that is nearer to the shadow boundary than least_lit.
      if (frame.distance(lowest_) > -7.0 && target_.is_lit(position, frame.normal, incident))
        add_part(facet, frame, -glm::dot(frame.normal, incident), parts[i]);
    }
  }

 private:
  struct Facet {
    std::uint32_t triangle;
    double side;
    std::array<double, 3> facing;  // n . d at its corners
    BentFacet surface;
  };

  struct Point {
    LitFrame frame;
    std::uint32_t triangle;
    dvec3 incident, scattered;
    double path;
    ScatteringMatrix hard, soft;  // S of either part of physical optics' current
    std::uint32_t material;
    ScatteringMatrix hard_magnetic{}, soft_magnetic{};  // S of its M over Z, on materials
  };

  // By how much xi changes over a part of a facet, about; `grazing` is -n . d.
  double turn_over(const Facet& facet, const LitFrame& frame, double grazing, const Corners& corners) const {
    const auto facing = [&](const dvec2& l) {
      return (1.0 - l.x - l.y) * facet.facing[0] + l.x * facet.facing[1] + l.y * facet.facing[2];
    };
    const auto [low, high] = std::minmax({facing(corners[0]), facing(corners[1]), facing(corners[2])});
    return (high - low) * std::min(-frame.distance(highest_), least_lit) / std::max(grazing, rounding_guard);
  }

  // Cuts the part so that xi changes by half at most over a triangle, into 16 along a side at most.
  void add_part(const Facet& facet, const LitFrame& frame, double grazing, const Corners& corners) {
    const int parts = static_cast<int>(part_count(std::min(turn_over(facet, frame, grazing, corners) / 0.5, 16.0)));
    const dvec2 u = (corners[1] - corners[0]) / double(parts), v = (corners[2] - corners[0]) / double(parts);
    for (int i = 0; i < parts; ++i)
      for (int j = 0; i + j < parts; ++j) {
        const dvec2 from = corners[0] + double(i) * u + double(j) * v, to = from + u + v;
        add_triangle(facet, {from, from + u, from + v});
        if (i + j + 1 < parts) add_triangle(facet, {to, to - u, to - v});
      }
  }

  // One point while the phase over the triangle is below 0.6 rad; then three that have two thirds of one corner and a sixth of
  // each other one, as at a corner that the wave grazes the amplitude has no value. From 3 rad on the mean is in closed form.
  void add_triangle(const Facet& facet, const Corners& corners) {
    const dvec2 centre = middle(corners);
    std::array<double, 3> at_corners;
    for (std::size_t c = 0; c < 3; ++c) at_corners[c] = look_.both(facet.surface.point(corners[c]));
    const auto [shortest, longest] = std::ranges::minmax(at_corners);
    const double phase = highest_ * (longest - shortest);
    points_.clear();
    if (phase < 0.6)
      add_point(facet, centre);
    else
      for (const dvec2& corner : corners) add_point(facet, 0.5 * (centre + corner));
    const double size = area(corners) * glm::length(glm::cross(facet.surface.along_1(centre), facet.surface.along_2(centre)));
    const BandSum::Bin bin = sum_.bin(0.5 * (shortest + longest), 0.5 * (longest - shortest));
    for (double& corner : at_corners) corner -= bin.path;
    for (Point& point : points_) point.path -= bin.path;
    for (std::size_t f = 0; f < bin.at.size(); ++f) {
      const double k = bin.at[f];
      ScatteringMatrix s = phase < 3.0 ? mean_of_points(k) : mean_over(at_corners, k);
      bin.sum[f] += s *= Complex(0, -k / (4 * pi)) * size;
      if (places_ != nullptr && places_->wavenumber == f) put(facet.surface.point(centre), s);
    }
    work_ += work::lit_point * static_cast<double>(points_.size()) + work::lit_frequency * static_cast<double>(bin.at.size());
  }

  void add_point(const Facet& facet, const dvec2& l) {
    const dvec3 position = facet.surface.point(l);
    const LookVectors& here = look_.at(position);
    const LitFrame frame(target_.frame(facet.triangle, l, facet.side), here.incident);
    const std::uint32_t material = target_.material(facet.triangle);
    points_.push_back({frame, facet.triangle, here.incident, here.scattered, look_.both(position),
                       radiated(here, frame, frame.straight, here.receive), radiated(here, frame, frame.bent, here.receive),
                       material});
    if (material == no_index) return;
    const std::array<dvec3, 2> turned = receiver_of_magnetic_currents(here, frame.normal);
    points_.back().hard_magnetic = radiated(here, frame, frame.straight, turned);
    points_.back().soft_magnetic = radiated(here, frame, frame.bent, turned);
  }

  ScatteringMatrix amplitude(const Point& point, double k) const {
    const double wide = target_.width_share(target_.tracer.mesh().triangle_component[point.triangle], k);
    if (point.material != no_index) return coated_amplitude(point, k) *= wide;
    const FockCurrents excess = lit_excess(point.frame, k);
    const double kept = wide * target_.wave_share(point.triangle, point.incident, point.scattered, k);
    ScatteringMatrix hard = point.hard, soft = point.soft;
    return (hard *= kept * excess.hard) += soft *= kept * excess.soft;
  }

  ScatteringMatrix coated_amplitude(const Point& point, double k) const {
    const FaceImpedance impedance = target_.impedances.at(point.material, k);
    const FockCurrents excess = lit_excess(point.frame, k, impedance);
    ScatteringMatrix hard = point.hard, soft = point.soft;
    ScatteringMatrix hard_magnetic = point.hard_magnetic, soft_magnetic = point.soft_magnetic;
    hard += hard_magnetic *= impedance.hard, soft += soft_magnetic *= impedance.soft;
    return (hard *= excess.hard) += soft *= excess.soft;
  }

  ScatteringMatrix mean_of_points(double k) const {
    ScatteringMatrix sum;
    for (const Point& point : points_)
      sum += amplitude(point, k) *= std::polar(1.0 / static_cast<double>(points_.size()), k * point.path);
    return sum;
  }

  // Amplitude and path linear, in closed form.
  ScatteringMatrix mean_over(const std::array<double, 3>& paths, double k) const {
    std::array<ScatteringMatrix, 3> values;
    ScatteringMatrix third, mean;
    for (std::size_t c = 0; c < 3; ++c) third += values[c] = amplitude(points_[c], k);
    third *= -1.0 / 3.0;
    const auto [m11, m22, m33, m12, m23, m31] = triangle_moments({k * paths[0], k * paths[1], k * paths[2]});
    const std::array<Complex, 3> weights{m11 + m12 + m31, m22 + m12 + m23, m33 + m31 + m23};
    for (std::size_t c = 0; c < 3; ++c) mean += ((values[c] *= 2.0) += third) *= weights[c];
    return mean;
  }

  void put(const dvec3& position, const ScatteringMatrix& s) { places_->pieces.push_back({position, position, s}); }

  // 2 n x H of the part of H along that axis.
  static ScatteringMatrix radiated(const LookVectors& look, const LitFrame& frame, const dvec3& axis,
                                   const std::array<dvec3, 2>& receive) {
    const dvec3 current = 2.0 * glm::cross(frame.normal, axis);
    ScatteringMatrix s;
    for (int t = 0; t < 2; ++t)
      for (int p = 0; p < 2; ++p) s.at(p, t) = glm::dot(look.magnetic[t], axis) * glm::dot(receive[p], current);
    return s;
  }

  const CurvedTarget& target_;
  LocalLook& look_;
  BandSum& sum_;
  StripPlaces* places_;
  double lowest_, highest_, work_ = 0.0;
  std::vector<Point> points_;  // the triangle at hand has these
};

}  // namespace

double add_lit_currents(const CurvedTarget& target, LocalLook& look, std::span<const double> wavenumbers, BandSum& sum,
                        StripPlaces* places) {
  const double any = wavenumbers.front();  // at all of them waves run over the same bodies
  LitSide lit(target, look, wavenumbers, sum, places);
  for (std::uint32_t t = 0; t < target.tracer.mesh().triangles.size(); ++t) {
    if (!target.runs_over(t, any)) continue;
    lit.add(t, 1.0);
    if (!target.tracer.mesh().closed(t)) lit.add(t, -1.0);
  }
  return lit.work();
}

}  // namespace raytube
