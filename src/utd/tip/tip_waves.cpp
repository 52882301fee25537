#include "utd/tip/tip_waves.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "math/erfc_ray.h"
#include "utd/fock/fock.h"
#include "utd/surface/geodesic_march.h"
#include "utd/tip/tip_table.h"
#include "utd/wedge/work.h"

namespace raytube {

namespace {

// A side of a tip is straight up to where its normal has turned by this angle [rad].
constexpr double straight = 0.02;
// A side is followed over this length, in wavelengths, at least: tips of shorter ones have no wave.
constexpr double shortest_side = 1.0;

/// A side of a tip in the plane of its axis and the look, as far as the shadow boundary, or a wavelength, in the light until it
/// bends; to its rim if it is straight until there.
struct TipSide {
  dvec3 position, normal;  // at its end
  double length;           // from the tip [m]
  double bend;             // xi k^(-1/3) of the dark way [m^(1/3)]
  double curvature;        // mean of the side's [1/m]
  bool has_rim;
};

/// A tip as an antenna sees it from behind.
struct TipLook {
  const Tip& tip;
  dvec3 towards;  // to the antenna; unit
  dvec3 across;   // what of that direction is across the axis; unit
  double behind;  // angle of that direction to the axis [rad]

  double beyond() const { return behind - tip.half_angle; }
  /// Angle of the look above that side, < 0 in the dark [rad].
  double above(double sign) const { return sign * behind - tip.half_angle; }
  /// `sign` is 1 for the side that is turned to the antenna, -1 for the one that is turned away.
  bool in_the_dark(double sign) const { return sign < 0.0 || beyond() < 0.0; }
  dvec3 side(double sign) const { return sign * std::sin(tip.half_angle) * across - std::cos(tip.half_angle) * tip.outwards; }
  /// Across that direction, in the plane of the axis.
  dvec3 in_plane() const { return std::cos(behind) * across + std::sin(behind) * tip.outwards; }
};

std::optional<TipLook> seen_from_behind(const Tip& tip, const dvec3& towards) {
  const double c = -glm::dot(tip.outwards, towards);
  const dvec3 across = towards + c * tip.outwards;
  const double s = glm::length(across);
  if (c <= 0.0 || s < 1e-6) return std::nullopt;
  return TipLook{tip, towards, across / s, std::atan2(s, c)};
}

// The point where the side of a tip leaves the facets at it: normals at the tip itself are none of its surface.
FacetPoint start_of(const TriangleMesh& mesh, const TipLook& seen, double sign) {
  const auto along = [&](const TipFacet& f) {
    const Triangle& t = mesh.triangles[f.triangle];
    const dvec3 middle = 0.5 * (mesh.vertices[t[(f.corner + 1) % 3]] + mesh.vertices[t[(f.corner + 2) % 3]]);
    return glm::dot(glm::normalize(middle - seen.tip.position), seen.side(sign));
  };
  const TipFacet& facet = *std::ranges::max_element(seen.tip.facets, {}, along);
  const int a = (facet.corner + 1) % 3, b = (facet.corner + 2) % 3;
  const auto off = [&](int c) {
    return glm::dot(mesh.vertices[mesh.triangles[facet.triangle][c]] - seen.tip.position,
                    glm::cross(seen.tip.outwards, seen.across));
  };
  const double share = off(a) == off(b) ? 0.5 : std::clamp(off(a) / (off(a) - off(b)), 0.01, 0.99);
  constexpr double at_tip = 1e-3;
  double l[3];
  l[facet.corner] = at_tip, l[a] = (1.0 - at_tip) * (1.0 - share), l[b] = (1.0 - at_tip) * share;
  return {facet.triangle, {l[1], l[2]}};
}

/// The way from a tip down one of its sides, in steps of a sixteenth of the wavelength.
class WayDown {
 public:
  WayDown(const CurvedTarget& target, const TipLook& seen, double sign, const FacetPoint& start, double wavelength)
      : target_(target),
        axis_(seen.tip.outwards),
        first_(glm::distance(target.surfaces.facet(start.triangle).point(start.l), seen.tip.position)),
        step_(1.0 / 16.0 * wavelength),
        march_(target, start, seen.side(sign), 1.0, step_, {1.0}, true),
        begin_(slope()) {}

  /// False if the surface ends before.
  bool go_on() { return march_.march_to(asked_ += step_) && asked_ <= 4.0 * target_.tracer.mesh().radius; }

  double length() const { return first_ + asked_; }
  const dvec3& normal() const { return march_.normal(); }
  bool is_straight() const { return std::abs(begin_ - slope()) < straight; }

  /// At the end: whether the body bends away over the edge there.
  bool at_rim() const {
    if (march_.ended_at() < 0) return false;
    const TriangleMesh& mesh = target_.tracer.mesh();
    const EdgeTable& edges = target_.tracer.mesh().edges();
    const EdgeTable::Edge edge = edges[edges.edge_of(march_.triangle(), march_.ended_at())];
    return std::ranges::any_of(edge.sides, [&](const EdgeTable::Side& s) {
      return glm::dot(mesh.patch_of(s.triangle).normal, march_.direction()) > std::sin(straight);
    });
  }

  TipSide so_far(bool has_rim) const {
    const double h = march_.distance();
    const double curvature = h > 0.0 ? (begin_ - slope()) / h : 0.0;  // long facets are straight
    return {march_.position(), march_.normal(), first_ + h, march_.way().bend(), curvature, has_rim};
  }

 private:
  double slope() const { return std::asin(std::clamp(glm::dot(march_.normal(), axis_), -1.0, 1.0)); }

  const CurvedTarget& target_;
  dvec3 axis_;
  double first_, step_, asked_ = 0.0;
  GeodesicMarch march_;
  double begin_;
};

std::optional<TipSide> side_to_rim(const WayDown& way, double wavelength) {
  const TipSide side = way.so_far(true);
  if (!way.is_straight() || !way.at_rim() || side.length < shortest_side * wavelength) return std::nullopt;
  return side;
}

std::optional<TipSide> side_of(const CurvedTarget& target, const TipLook& seen, double sign, double wavelength) {
  WayDown way(target, seen, sign, start_of(target.tracer.mesh(), seen, sign), wavelength);
  const auto dark = [&] { return glm::dot(way.normal(), seen.towards) <= 0.0; };
  while (way.length() < shortest_side * wavelength || (seen.in_the_dark(sign) && dark()))
    if (!way.go_on()) return side_to_rim(way, wavelength);
  const TipSide bent = way.so_far(false);
  while (way.is_straight())
    if (!way.go_on()) return side_to_rim(way, wavelength).value_or(bent);
  return seen.in_the_dark(sign) ? bent : way.so_far(false);
}

// A of tip_table.h, bilinear.
Complex amplitude(double half_angle, double beyond) {
  const auto& columns = tip_table::beyond;
  const double row = std::clamp((half_angle / degree - tip_table::first_angle) / tip_table::angle_step, 0.0,
                                tip_table::amplitudes.size() - 1.001);
  const double x = std::clamp(beyond / degree, columns.front(), columns.back() * (1.0 - 1e-9));
  const std::size_t i = static_cast<std::size_t>(row);
  const std::size_t j = static_cast<std::size_t>(std::ranges::upper_bound(columns, x) - columns.begin()) - 1;
  const double u = row - static_cast<double>(i), v = (x - columns[j]) / (columns[j + 1] - columns[j]);
  const auto in_row = [&](std::size_t r) { return (1 - v) * tip_table::amplitudes[r][j] + v * tip_table::amplitudes[r][j + 1]; };
  return ((1 - u) * in_row(i) + u * in_row(i + 1)) / std::tan(0.5 * (half_angle + std::max(beyond, 0.0)));
}

// Tips fade out as the look turns from 75 to 90 degrees to the axis: from there on there is physical optics alone.
double fade(double behind) {
  const double x = std::clamp((behind - 75.0 * degree) / (90.0 * degree - 75.0 * degree), 0.0, 1.0);
  return std::pow(std::cos(0.5 * pi * x), 2);
}

/// What comes to a tip along one of its sides.
struct TipRay {
  TipSide side;
  double above;     // TipLook::above
  double path;      // one way, from the phase reference [m]
  double narrowed;  // amplitude that strips have gained by becoming narrower
  bool dark;
};

// Strips that come out of the dark have narrowed: about an axis a fan from the tip is rho / sin(half angle) wide (Clairaut), and
// what begins parallel at the boundary, where the body runs along the look, is at the tip by the slope of that as wide,
// sin(look) / sin(half angle).
template <class Phase>
std::optional<TipRay> ray_along(const CurvedTarget& target, const TipLook& seen, double sign, Phase phase, double wavelength) {
  const std::optional<TipSide> side = side_of(target, seen, sign, wavelength);
  if (!side) return std::nullopt;
  const bool is_far_rim = side->has_rim && sign < 0.0;  // a body behind it does not hide the axis, on which both cancel
  if (!is_far_rim && !target.is_lit(side->position, side->normal, -seen.towards)) return std::nullopt;
  if (!seen.in_the_dark(sign)) return TipRay{*side, seen.above(sign), phase(seen.tip.position), 1.0, false};
  const double narrowed = std::sqrt(std::sin(seen.tip.half_angle) / std::sin(seen.behind));
  return TipRay{*side, seen.above(sign), phase(side->position) - side->length, narrowed, true};
}

/// A way to a tip as a bend and a straight stretch behind it.
struct BentWay {
  double straight_length;  // [m]
  Complex on_bend;         // the hard current there, in units of that on a flat side
};

// An edge has what is between the light and the dark, an arc Fock's current. INT kappa^(2/3) ds cubed over (INT kappa ds)^2 is
// the length of an arc, and of any other way less than its own (Hoelder).
BentWay bent_way(const TipRay& ray, double k, double radius) {
  const TipSide& side = ray.side;
  if (side.has_rim) return {side.length, 0.5};
  const double turn = side.curvature * side.length, arc = 2.0 * std::pow(side.bend, 3) / std::pow(turn, 2);
  const bool is_arc = turn <= 0.0 || !(arc > 0.0) || arc >= side.length;
  const double behind = is_arc ? 0.0 : side.length - arc,
               curvature = is_arc ? std::max(side.curvature, flattest_curvature / radius) : turn / arc;
  if (ray.dark) return {behind, 0.5 * fock_in_the_dark(std::cbrt(k) * side.bend).hard};
  return {behind, fock_factors(-std::cbrt(0.5 * k / curvature) * std::sin(ray.above)).hard};
}

// The hard current at the tip, in units of that on a flat side. What the bend has goes on as a wave does behind the edge of a
// half plane (Sommerfeld 1896), erfc(-e^{j pi/4} x)/2 with x = sqrt(2 k L) sin(above/2): to none in the dark, over the phase
// e^{-jx^2} of the way over the bend, to all in the light. Valid when the straight stretch L is long, k L >> 1, or none.
Complex share_of(const TipRay& ray, double k, double radius) {
  const BentWay way = bent_way(ray, k, radius);
  const double x = std::sqrt(2.0 * k * way.straight_length) * std::abs(std::sin(0.5 * ray.above));
  const Complex left = scaled_erfc(x);
  return ray.dark ? ray.narrowed * way.on_bend * left : 1.0 - (1.0 - way.on_bend) * std::polar(1.0, -x * x) * left;
}

// Both rays, one way: e^{jx} and -j e^{-jx}, made uniform on the axis, where they meet, by the Hankel functions of order 1 whose
// far fields they are. On it nothing is left: E in the plane of the axis sends waves of opposite signs along both sides.
Complex both_shares(const TipRay& near, const std::optional<TipRay>& far, double k, double radius) {
  const Complex n = share_of(near, k, radius);
  if (!far) return n * std::polar(1.0, k * near.path);
  const Complex f = share_of(*far, k, radius);
  const double x = std::max(0.5 * k * (near.path - far->path), 1e-6), c = 0.5 * k * (near.path + far->path);
  const Complex odd = Complex(0, -1) * (n - f) * ::y1(x) * std::expm1(-x * x);
  return std::sqrt(0.5 * pi * x) * std::polar(1.0, c + 0.75 * pi) * ((n + f) * ::j1(x) + odd);
}

class TipSum {
 public:
  TipSum(const CurvedTarget& target, LocalLook& look, double wavenumber, StripPlaces* places)
      : target_(target), look_(look), k_(wavenumber), places_(places) {}

  // The wave goes to the tip and comes from it as the two antennas see it, each by itself: the same either way round. Between
  // them the cone's amplitude is the mean of what it is for either, and that of one antenna where they stand together.
  void add(const Tip& tip) {
    const LookVectors here = look_.at(tip.position);
    const std::optional<TipLook> in = seen_from_behind(tip, -here.incident), out = seen_from_behind(tip, here.scattered);
    if (!in || !out) return;
    const bool together = in->towards == out->towards;
    const Complex at_cone = std::sqrt(fade(in->behind) * fade(out->behind)) * 0.5 *
                            (amplitude(tip.half_angle, in->beyond()) + amplitude(tip.half_angle, out->beyond()));
    const std::optional<Complex> arriving = share(*in, [&](const dvec3& point) { return look_.arriving(point); });
    const std::optional<Complex> leaving =
        together ? arriving : share(*out, [&](const dvec3& point) { return look_.leaving(point); });
    if (arriving && leaving) put(here, *in, *out, at_cone * *arriving * *leaving / k_);
  }

  const CountedSum& sum() const { return sum_; }

 private:
  // The current at the tip, over that on a flat side.
  template <class Phase>
  std::optional<Complex> share(const TipLook& seen, Phase phase) {
    sum_.count(1, work::round_tip_side);
    const std::optional<TipRay> near = ray_along(target_, seen, 1.0, phase, 2 * pi / k_);
    if (!near) return std::nullopt;
    sum_.count(1, work::round_tip_side);
    const std::optional<TipRay> far = ray_along(target_, seen, -1.0, phase, 2 * pi / k_);
    if (near->side.has_rim && near->dark && !far) return std::nullopt;  // alone it has no bound on the axis
    return both_shares(*near, far, k_, target_.tracer.mesh().radius);
  }

  void put(const LookVectors& look, const TipLook& in, const TipLook& out, const Complex& value) {
    ScatteringMatrix s;
    for (int p = 0; p < 2; ++p)
      for (int t = 0; t < 2; ++t)
        s.at(p, t) = value * glm::dot(look.receive[p], out.in_plane()) * glm::dot(look.electric[t], in.in_plane());
    sum_.s += s;
    if (places_ != nullptr) places_->pieces.push_back({in.tip.position, in.tip.position, s});
  }

  const CurvedTarget& target_;
  LocalLook& look_;
  const double k_;
  StripPlaces* places_;
  CountedSum sum_;
};

}  // namespace

CountedSum tip_scattering(const CurvedTarget& target, std::span<const Tip> tips, LocalLook& look, double wavenumber,
                          StripPlaces* places) {
  TipSum sum(target, look, wavenumber, places);
  for (const Tip& tip : tips) sum.add(tip);
  return sum.sum();
}

}  // namespace raytube
