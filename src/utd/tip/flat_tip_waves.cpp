#include "utd/tip/flat_tip_waves.h"

#include <algorithm>
#include <cmath>

#include "core/reversed.h"
#include "math/erfc_ray.h"
#include "math/smooth_step.h"
#include "math/special/elementary.h"
#include "utd/corner/along_edge.h"
#include "utd/fock/fock.h"
#include "utd/wedge/work.h"

namespace raytube {

namespace {

// Waves of both polarisations.
using Waves = std::array<Complex, 2>;

long tenths(double angle) { return std::lround(10.0 * angle / degree); }

// One ray's way to a place: towards its antenna, with unit fields.
struct RimRay {
  dvec3 towards;
  std::array<dvec3, 2> fields;
  double path;  // phase over k [m]
};

// Share of a ray that a rim takes, less and less from 50 to 100 degrees off its direction, which was set with the almond in view
// (docs/theory/surface_waves.md#flat-tips); a tip has the rest.
double rim_share(const dvec3& towards, const RimPlace& place) {
  const double off = std::acos(std::clamp(-glm::dot(towards, place.tangent), -1.0, 1.0));
  return smooth_step((100 * degree - off) / (100 * degree - 50 * degree));
}

// Share of a ray that the tip takes. One that comes along the rim passes by, within a part of Fock's angle (k radius)^(-1/3);
// what is behind the rim has none.
double tip_share(const dvec3& towards, const Rim& rim, const dvec3& normal, double wavenumber) {
  const RimPlace& first = rim.places.front();
  const double rest = 1.0 - rim_share(towards, first);
  if (glm::dot(towards, first.tangent) <= 0.0) return rest;
  const double out = glm::dot(towards, first.outwards), up = std::abs(glm::dot(towards, normal));
  const double clear = out > 0.0 ? std::hypot(out, up) : up + out;
  const double angle = std::cbrt(std::max(rim.curvature, 0.0) / wavenumber);
  return rest * smooth_step(angle > 0.0 ? clear / angle + 0.25 : clear > 0.0 ? 1.0 : 0.0);
}

// Fock's factor of a rim: u over the incident wave in the plane of the rims; `out` is the sine of the angle at which the ray
// comes, negative beyond the border of the light. In the light the factor is 1 from xi = -3 on.
Complex fock_factor(double curvature, double wavenumber, double out) {
  if (curvature <= 0.0) return 1.0;
  const double xi = -std::cbrt(wavenumber / (2.0 * curvature)) * out;
  if (xi > 0.0) return 0.5 * fock_in_the_dark(xi).hard;
  return xi < -3.0 ? 1.0 : fock_factors(xi).hard;
}

// What comes over the body to its edge has not yet cast its shadow below it: top less bottom are erf(e^{j pi/4} x), x^2 = k d
// up^2 / 2 a way d over the sheet (Sommerfeld 1896). The phase of that, over a circle of the rim's curvature.
Complex phase_over_body(const RimPlace& place, double out, double up, double wavenumber) {
  if (out >= 0.0 || place.curvature <= 0.0) return 1.0;
  const double x = std::abs(up) * std::sqrt(-wavenumber * out / place.curvature);
  const Complex error_function = 1.0 - std::polar(1.0, -x * x) * scaled_erfc(x);
  return x < 1e-6 ? std::polar(1.0, pi / 4) : error_function / std::abs(error_function);
}

// The edge's field for a ray at elevation e, seen along the edge: cos(e/2) outwards + sin(e/2) normal; in the plane, e = 0 or pi,
// `in_plane` takes the place of its part outwards. What crosses the body in the plane has no part upright on it.
Waves edge_fields(const RimPlace& place, const dvec3& normal, const RimRay& ray, const Waves& in_plane, double wavenumber) {
  const double out = glm::dot(ray.towards, place.outwards), up = glm::dot(ray.towards, normal);
  const double elevation = std::atan2(up, out), flat = std::abs(std::cos(elevation)), half = std::cos(elevation / 2);
  const Complex upright =
      std::sin(elevation / 2) * (out >= 0.0 ? 1.0 : std::abs(std::sin(elevation))) * phase_over_body(place, out, up, wavenumber);
  Waves waves;
  for (int p = 0; p < 2; ++p)
    waves[p] = (out >= 0.0 ? half : 1.0) * flat * in_plane[p] + half * (1.0 - flat) * glm::dot(ray.fields[p], place.outwards) +
               upright * glm::dot(ray.fields[p], normal);
  return waves;
}

// INT (s - s')^(-3/4) ds' over what a place stands for.
double kernel(const RimPlace& place) { return 4.0 * (std::pow(place.begin + place.step, 0.25) - std::pow(place.begin, 0.25)); }

}  // namespace

/// One antenna and the tips.
class FlatTipWaves::Visit {
 public:
  Visit(const FlatTipWaves& waves, const CurvedTarget& target, LocalLook& look, bool receives, double wavenumber)
      : waves_(waves), target_(target), look_(look), receives_(receives), wavenumber_(wavenumber) {}

  // A at the tip of the wave along one of its rims: from far places on, out of the light into the dark.
  Waves arriving(const FlatTip& tip, std::uint32_t rim) const {
    const Complex factor = std::polar(std::pow(wavenumber_ / 2, 0.25) / gamma_function(0.25), pi / 8);
    Waves sum{};
    const RimPlace* boundary = &tip.rims[rim].places.back();
    for (const RimPlace& place : reversed(tip.rims[rim].places)) {
      const RimRay ray = ray_to(place.position);
      if (glm::dot(ray.towards, place.outwards) >= 0.0) boundary = &place;
      const double weight = rim_share(ray.towards, place) * narrowness(wavenumber_, place.radius) * kernel(place);
      if (weight <= 0.0 || !sees(place.position, place.outwards, ray)) continue;
      const Waves in_plane = boundary == &place ? lit_wave(place, ray) : dark_wave(*boundary, place, ray);
      const Complex wave = factor * std::polar(weight, wavenumber_ * (ray.path - place.distance));
      const Waves fields = edge_fields(place, tip.normal, ray, in_plane, wavenumber_);
      for (int p = 0; p < 2; ++p) sum[p] += wave * fields[p];
    }
    return sum;
  }

  // Gamma of the wave that the tip sends along one of its rims.
  Waves starting(const FlatTip& tip, std::uint32_t rim) const {
    const RimRay ray = ray_to(tip.position);
    double weight = 1.0;
    for (const Rim& one : tip.rims) weight *= tip_share(ray.towards, one, tip.normal, wavenumber_);
    if (weight <= 0.0 || !sees(tip.position, -tip.bisector, ray)) return {};
    const dvec3 along = tip.across(rim), up = glm::cross(tip.bisector, along);
    const auto turned = [&](const dvec3& v) { return dvec3(glm::dot(v, tip.bisector), glm::dot(v, along), glm::dot(v, up)); };
    const SheetCorner::Start start = waves_.corner(tip).start(turned(ray.towards));
    Waves sum;
    for (int p = 0; p < 2; ++p)
      sum[p] = std::polar(weight, wavenumber_ * ray.path) *
               (dot(start.flat, turned(ray.fields[p])) + dot(start.upright, turned(ray.fields[p])));
    return sum;
  }

 private:
  RimRay ray_to(const dvec3& position) const {
    const LookVectors& here = look_.at(position);
    if (receives_) return {here.scattered, here.receive, look_.leaving(position)};
    return {-here.incident, here.electric, look_.arriving(position)};
  }
  // u along the rim's normal in the plane of the rims, over the wave's phase at a place: Fock's hard current over twice the
  // incident one in the light, a half of it in the dark, which has come along the rim from where that is grazed.
  Waves lit_wave(const RimPlace& place, const RimRay& ray) const {
    const Complex factor = fock_factor(place.curvature, wavenumber_, glm::dot(ray.towards, place.outwards));
    return {factor * glm::dot(ray.fields[0], place.outwards), factor * glm::dot(ray.fields[1], place.outwards)};
  }
  Waves dark_wave(const RimPlace& boundary, const RimPlace& place, const RimRay& ray) const {
    const RimRay grazing = ray_to(boundary.position);
    const double path = grazing.path - boundary.distance - ray.path + place.distance;
    const Complex factor =
        0.5 * fock_in_the_dark(std::cbrt(wavenumber_) * (boundary.bend - place.bend)).hard * std::polar(1.0, wavenumber_ * path);
    return {factor * glm::dot(grazing.fields[0], boundary.outwards), factor * glm::dot(grazing.fields[1], boundary.outwards)};
  }
  bool sees(const dvec3& position, const dvec3& normal, const RimRay& ray) const {
    return target_.is_lit(position, normal, -ray.towards);
  }

  const FlatTipWaves& waves_;
  const CurvedTarget& target_;
  LocalLook& look_;
  const bool receives_;
  const double wavenumber_;
};

FlatTipWaves::FlatTipWaves(std::vector<FlatTip> tips) : tips_(std::move(tips)) {
  for (const FlatTip& tip : tips_) {
    corners_.try_emplace(tenths(tip.angle), tip.angle);
    reflections_.push_back(reflection_of(tip.angle));
  }
}

const SheetCorner& FlatTipWaves::corner(const FlatTip& tip) const { return corners_.at(tenths(tip.angle)); }

// Gamma of rays in the plane at 10 degrees to the edge at +y and to the other one, times the root of that angle, which is clear
// of what SheetCorner smooths; fields point away from the sheet at either edge, as those of the rims do.
FlatTipWaves::Reflection FlatTipWaves::reflection_of(double angle) const {
  constexpr double to_edge = 10 * degree;
  const auto start = [&](double side) {
    const double azimuth = side * (angle / 2 + to_edge);
    const dvec3 towards(std::cos(azimuth), std::sin(azimuth), 0.0), outwards(-side * towards.y, side * towards.x, 0.0);
    return std::sqrt(to_edge) * dot(corners_.at(tenths(angle)).start(towards).flat, outwards);
  };
  return {start(1.0), start(-1.0)};
}

// Back along the rims of one tip, and from there along each of them to the next.
class FlatTipWaves::Sum {
 public:
  Sum(const FlatTipWaves& waves, const CurvedTarget& target, LocalLook& look, double wavenumber, StripPlaces* places)
      : waves_(waves),
        wavenumber_(wavenumber),
        transmitter_(waves, target, look, false, wavenumber),
        receiver_(waves, target, look, true, wavenumber),
        places_(places) {}

  void add_returns(std::uint32_t number) {
    const FlatTip& tip = waves_.tips_[number];
    const Reflection& r = waves_.reflections_[number];
    const Complex back(0.0, -wavelength());
    const std::array<Waves, 2> sent{transmitter_.arriving(tip, 0), transmitter_.arriving(tip, 1)};
    const std::array<Waves, 2> received{receiver_.arriving(tip, 0), receiver_.arriving(tip, 1)};
    for (const Rim& rim : tip.rims) sum_.count(2 * rim.places.size(), work::flat_tip_point);  // for either antenna
    for (int a = 0; a < 2; ++a) {
      put(tip.position, back * r.same, received[a], sent[a]);
      put(tip.position, back * r.other, received[1 - a], sent[a]);
    }
  }

  void add_way(const FlatTip& tip, std::uint32_t rim) {
    const std::optional<RimEnd>& end = tip.rims[rim].end;
    if (!end) return;
    const FlatTip& there = waves_.tips_[end->tip];
    put(place_of(tip.position, there.position, end->length), along_edge(2.0, end->length, wavenumber_), receiver_.starting(there, end->rim),
        transmitter_.starting(tip, rim));
  }

  const CountedSum& sum() const { return sum_; }

 private:
  double wavelength() const { return 2 * pi / wavenumber_; }

  dvec3 place_of(const dvec3& from, const dvec3& to, double length) const {
    if (places_ == nullptr || !places_->by_path) return 0.5 * (from + to);
    return places_->by_path->at(from, to, glm::dot(places_->by_path->towards, from + to) - length);
  }

  void put(const dvec3& place, Complex factor, const Waves& received, const Waves& sent) {
    ScatteringMatrix s;
    for (int p = 0; p < 2; ++p)
      for (int t = 0; t < 2; ++t) s.at(p, t) = factor * received[p] * sent[t];
    sum_.s += s;
    if (places_ != nullptr) places_->pieces.push_back({place, place, s});
  }

  const FlatTipWaves& waves_;
  const double wavenumber_;
  const Visit transmitter_, receiver_;
  StripPlaces* places_;
  CountedSum sum_;
};

CountedSum FlatTipWaves::scattering(const CurvedTarget& target, LocalLook& look, double wavenumber, StripPlaces* places) const {
  Sum sum(*this, target, look, wavenumber, places);
  for (std::uint32_t i = 0; i < tips_.size(); ++i) {
    sum.add_returns(i);
    for (std::uint32_t rim = 0; rim < 2; ++rim) sum.add_way(tips_[i], rim);
  }
  return sum.sum();
}

}  // namespace raytube
