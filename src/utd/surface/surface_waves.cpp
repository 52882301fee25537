#include "utd/surface/surface_waves.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>

#include "scene/frequency_bands.h"
#include "utd/fock/fock.h"
#include "utd/fock/impedance_fock.h"
#include "utd/surface/far_sides.h"
#include "utd/surface/geodesic_march.h"
#include "utd/surface/lit_currents.h"
#include "utd/surface/shadow_boundary.h"
#include "utd/surface/strip_arrivals.h"
#include "utd/surface/strip_point.h"
#include "utd/wedge/rounding_guard.h"
#include "utd/wedge/work.h"

namespace raytube {

namespace {

// The longest step along a strip and the widest piece of the shadow boundary, in wavelengths: phases are linear across strips.
constexpr double longest_step = 0.5, widest_piece = 0.25;

/// A strip into the dark from a point of the shadow boundary, as far as it has come.
struct DarkStrip {
  StripPoint q;  // where it leaves the boundary
  std::uint32_t component;
  std::uint32_t material;                    // no_index: a perfect conductor
  dvec3 chord;                               // from end to end of its piece of the boundary [m]
  double across;                             // its width there [m]
  std::array<double, 2> magnetic, electric;  // H and E of the wave there along the binormal, transmit V and H
  bool radiates;
  GeodesicMarch march;
  double clearance = std::numeric_limits<double>::infinity();  // the least radius of the cone of a tip on the way [m]
  double last = 0.0;                                           // from q to where the current was put last [m]
  Complex area = 0.0;  // root of its widths at q and at its end, turned by the caustics between them
  double path = 0.0;   // phase of its end over k [m]

  dvec3 binormal() const { return glm::cross(march.direction(), march.normal()); }
};

std::vector<double> wavenumbers_of(std::span<const double> frequencies) {
  std::vector<double> wavenumbers;
  for (const double f : frequencies) wavenumbers.push_back(wavenumber(f));
  return wavenumbers;
}

class SurfaceLook {
 public:
  SurfaceLook(const CurvedTarget& target, const LocalLook& look, std::span<const double> frequencies, StripPlaces* places,
              std::vector<SurfaceRay>* rays, std::span<const ConicalTip> tips)
      : target_(target),
        mesh_(target.tracer.mesh()),
        look_(look),
        places_(places),
        rays_(rays),
        tips_(tips),
        wavenumbers_(wavenumbers_of(frequencies)),
        band_(wavenumbers_, places != nullptr || !target.is_analytic()) {
    highest_ = greatest_wavenumber(wavenumbers_);
    lowest_ = least_wavenumber(wavenumbers_);
    shortest_ = 2 * pi / highest_;
    result_.scattering.resize(frequencies.size());
    sum_.emplace(band_, (longest_step + widest_piece) * shortest_, places);
    amplitudes_.resize(sum_->wavenumbers().size());
  }

  SurfaceWaveResult take() {
    // The normal turns by 0.3 rad at most over a piece of the boundary.
    for (const BoundaryLine& line : shadow_boundary(target_, look_, widest_piece * shortest_, 0.3)) {
      for (const double side : {1.0, -1.0})
        keep(arrivals_along(line, wavenumbers_, shortest_,
                            [&](const BoundaryPiece& piece, bool radiates) { return strip_of(piece, side, radiates); }));
    }
    std::vector<SurfaceArrival> far_sides = far_side_arrivals(target_, look_, wavenumbers_, band_);
    result_.strips += far_sides.size();
    keep(std::move(far_sides));
    if (rays_ != nullptr) std::erase_if(*rays_, [](const SurfaceRay& ray) { return ray.points.size() < 2; });
    result_.work += add_lit_currents(target_, look_, wavenumbers_, band_, places_);
    band_.add_to(result_.scattering);
    return std::move(result_);
  }

 private:
  void keep(std::vector<SurfaceArrival> arrivals) { std::ranges::move(arrivals, std::back_inserter(result_.arrivals)); }

  // The strip of a piece of the boundary, and what of it arrives at a wedge; its own current counts only if it `radiates`.
  std::optional<ArrivingStrip> strip_of(const BoundaryPiece& piece, double side, bool radiates) {
    const FacetPoint& start = piece.middle;
    if (!target_.runs_over(start.triangle, wavenumbers_.front()) || (side < 0.0 && mesh_.closed(start.triangle))) return {};
    const dvec3 incident = look_.incident(target_.surfaces.facet(start.triangle).point(start.l));
    const StripPoint q = strip_point(target_, start, incident, side);
    const double across = std::abs(glm::dot(piece.chord, q.binormal));
    if (q.curvature * mesh_.radius < flattest_curvature || across <= 0.0) return {};
    if (!target_.is_lit(q.position, q.normal, incident)) return {};
    ++result_.strips;
    // Rays of one antenna along the surface part as they come: the derivative of d over the boundary is its chord across d / R.
    const StripWidth width{across, across * look_.spreading(q.position)};
    const LookVectors& here = look_.at(q.position);
    std::optional<ArrivingStrip> arrival =
        follow_dark(DarkStrip{q, mesh_.triangle_component[start.triangle], target_.material(start.triangle), piece.chord, across,
                              q.across(here.magnetic), q.across(here.electric), radiates,
                              GeodesicMarch(target_, start, incident, side, 0.0, width)},
                    side);
    if (!arrival) return {};
    arrival->at = piece.arc_length;
    for (Complex& current : arrival->current) current /= glm::length(piece.chord);
    return arrival;
  }

  // The next step along a strip [m]: its phase bends by k kappa h^2 = 0.1 rad at most over a step h, and xi grows by 0.15. Close
  // to a caustic, and within half a wavelength of the axis of a tip's cone, steps are up to 8 times as fine.
  double step_limit(const DarkStrip& strip) const {
    const double curvature = std::max(strip.march.curvature(), flattest_curvature / mesh_.radius);
    const double bend = std::sqrt(0.1 / (highest_ * curvature));
    const double fock = 0.15 / std::cbrt(0.5 * highest_ * curvature * curvature);
    const double limit = std::min({longest_step * shortest_, bend, fock}), finest = limit / 8.0;
    if (tip_radius(strip.march.position()) < 0.5 * shortest_) return finest;
    return std::clamp(strip.march.width().to_focus(), finest, limit);
  }

  /// S of a current along `current` per unit of -jk / 4 pi, for each transmitted `field`.
  static ScatteringMatrix radiated(const std::array<dvec3, 2>& receive, const std::array<double, 2>& field,
                                   const dvec3& current) {
    ScatteringMatrix s;
    for (int p = 0; p < 2; ++p)
      for (int t = 0; t < 2; ++t) s.at(p, t) = field[t] * glm::dot(receive[p], current);
    return s;
  }

  // By how much paths differ from one side of the strip to the other [m]: its geodesics begin along the piece of the boundary,
  // and what neighbours are apart along themselves stays as it is (Gauss's lemma).
  static double path_across(const DarkStrip& strip, const dvec3& scattered) {
    const double along = glm::dot(strip.chord, strip.q.along);
    const double width = strip.march.width().width, across = glm::dot(strip.chord, strip.q.binormal) > 0.0 ? width : -width;
    return glm::dot(scattered, across * strip.binormal() + along * strip.march.direction()) - along;
  }

  // m = (k / 2 kappa)^(1/3)
  double fock_scale(double curvature, double k) const {
    return std::cbrt(0.5 * k / std::max(curvature, flattest_curvature / mesh_.radius));
  }

  // m eta J for the soft one.
  FockCurrents fock_currents(const DarkStrip& strip, double k) const {
    const DarkWay& way = strip.march.way();
    if (strip.material == no_index) return way.currents(k);
    const double m = way.distance(k) > 0.0 ? way.scale(k) : fock_scale(strip.q.curvature, k);
    const FaceImpedance impedance = target_.impedances.at(strip.material, k);
    return way.with_second_order(impedance_fock(way.distance(k), m, impedance), k);
  }

  // What strips from all round bring to a tip is of order 1 about its axis: closer to that than k rho = 1 there is none, as on
  // the cone laid flat, where it is J of order 1 / sin(half angle), of k rho over that sine. What goes out again is the tip's.
  FockCurrents currents(const DarkStrip& strip, double k) const {
    double share = target_.width_share(strip.component, k);
    if (!tips_.empty()) share *= -std::expm1(-std::pow(k * strip.clearance, 2));
    FockCurrents fock = fock_currents(strip, k);
    fock.hard *= share, fock.soft *= share;
    return fock;
  }

  // Keeps the end for pictures, where no strip is narrower than a thousandth of its start: at a caustic it has no width.
  void keep_end(const DarkStrip& strip) {
    const GeodesicMarch& end = strip.march;
    const double k = wavenumbers_.front(), share = std::abs(end.width().width) / strip.across;
    const FockCurrents fock = currents(strip, k);
    const double factor = 1.0 / std::sqrt(std::max(share, 1e-3));
    if (end.distance() == 0.0) rays_->push_back({SurfaceRayKind::into_the_dark, 1});
    rays_->back().points.push_back({end.position(), end.distance(), end.way().distance(k), share, factor * std::abs(fock.hard),
                                    factor * std::abs(fock.soft) / fock_scale(end.curvature(), k)});
  }

  void set_amplitudes(const DarkStrip& strip) {
    const GeodesicMarch& end = strip.march;
    const LookVectors& here = look_.at(end.position());
    const ScatteringMatrix hard = radiated(here.receive, strip.magnetic, end.direction());
    const ScatteringMatrix soft = radiated(here.receive, strip.electric, strip.binormal());
    const std::array<dvec3, 2> turned = receiver_of_magnetic_currents(here, end.normal());
    const double half_across = 0.5 * path_across(strip, here.scattered);
    for (std::size_t n = 0; n < amplitudes_.size(); ++n) {
      const double k = sum_->wavenumbers()[n];
      const FockCurrents fock = currents(strip, k);
      const Complex factor = Complex(0, -k / (4 * pi)) * strip.area * sinc(k * half_across);
      ScatteringMatrix along = hard, across = soft;
      if (strip.material != no_index) {
        const FaceImpedance impedance = target_.impedances.at(strip.material, k);
        along += radiated(turned, strip.magnetic, end.direction()) *= impedance.hard;
        across += radiated(turned, strip.electric, strip.binormal()) *= impedance.soft;
      }
      amplitudes_[n] = (along *= factor * fock.hard) += across *= factor * fock.soft / fock_scale(end.curvature(), k);
    }
  }

  // Strips that have spread over many wavelengths are known along their middles alone: they fade, by a half at 8 times
  // their first width, so that no sum over strips hangs on whether one of them is given up.
  static double spread_share(double spread) { return 1.0 / (1.0 + std::pow(spread / 8.0, 4)); }

  void radiate_to_end(const DarkStrip& strip) {
    set_amplitudes(strip);
    result_.work += work::surface_frequency * static_cast<double>(amplitudes_.size());
    const GeodesicMarch& end = strip.march;
    sum_->add(end.distance() == 0.0, end.distance() - strip.last, strip.path, end.position(), end.width().width, amplitudes_);
    if (rays_ != nullptr) keep_end(strip);
  }

  // The current at the strip's end, and what lies between it and the last one.
  void put_end(DarkStrip& strip) {
    const GeodesicMarch& end = strip.march;
    const double width = std::abs(end.width().width);
    strip.area =
        std::polar(spread_share(width / strip.across) * std::sqrt(strip.across * width), 0.5 * pi * end.width().caustics);
    strip.path = look_.leaving(end.position()) + look_.arriving(strip.q.position) - end.distance();
    strip.clearance = std::min(strip.clearance, tip_radius(end.position()));
    result_.work += work::surface_step;
    if (strip.radiates) radiate_to_end(strip);
    strip.last = end.distance();
  }

  // The radius of the cone of the next tip at a point of it [m].
  double tip_radius(const dvec3& position) const {
    double radius = std::numeric_limits<double>::infinity();
    for (const ConicalTip& tip : tips_) radius = std::min(radius, tip.radius_at(position));
    return radius;
  }

  std::optional<ArrivingStrip> follow_dark(DarkStrip strip, double side) {
    put_end(strip);
    GeodesicMarch& end = strip.march;
    while (end.march_to(strip.last + step_limit(strip)) && end.curvature() >= 0.0) {
      put_end(strip);
      if (end.way().distance(lowest_) >= 10.0) return {};  // the hard current, e^{-0.88 xi}, has fallen to 1.5e-4
    }
    if (end.lost() || end.curvature() < 0.0) return {};
    if (end.distance() > strip.last) put_end(strip);
    if (end.ended_at() < 0 || strip.material != no_index) return {};
    ArrivingStrip result{
        0.0,
        {end.triangle(), end.ended_at(), side < 0.0, end.position(), end.direction(), strip.q.position, strip.path, {}},
        strip.magnetic,
        band_.everywhere([&](double k) { return 0.5 * strip.area * currents(strip, k).hard; }),
        {}};
    result.weight.resize(wavenumbers_.size());
    return result;
  }

  const CurvedTarget& target_;
  const TriangleMesh& mesh_;
  LocalLook look_;
  StripPlaces* places_;
  std::vector<SurfaceRay>* rays_;
  std::span<const ConicalTip> tips_;
  const std::vector<double> wavenumbers_;
  BandSum band_;
  double shortest_ = 0.0, lowest_ = 0.0, highest_ = 0.0;
  std::vector<ScatteringMatrix> amplitudes_;  // at the end of the strip at hand
  std::optional<StripSum> sum_;
  SurfaceWaveResult result_;
};

// Takes what a look at some of the frequencies, `indices`, has found.
void put(SurfaceWaveResult&& part, std::span<const std::size_t> indices, SurfaceWaveResult& all) {
  for (std::size_t i = 0; i < indices.size(); ++i) all.scattering[indices[i]] = part.scattering[i];
  for (SurfaceArrival& arrival : part.arrivals) {
    std::vector<std::array<Complex, 2>> magnetic(all.scattering.size());
    for (std::size_t i = 0; i < indices.size(); ++i) magnetic[indices[i]] = arrival.magnetic[i];
    arrival.magnetic = std::move(magnetic);
    all.arrivals.push_back(std::move(arrival));
  }
  all.strips += part.strips;
  all.work += part.work;
}

}  // namespace

SurfaceWaveResult surface_wave_scattering(const CurvedTarget& target, const LocalLook& look, std::span<const double> frequencies,
                                          StripPlaces* places, std::vector<SurfaceRay>* rays, std::span<const ConicalTip> tips) {
  // Frequencies at which waves run over the same bodies go together, those between none and all of the waves by themselves:
  // shares are polynomials of k from one bound to the other.
  std::map<std::size_t, std::vector<std::size_t>> groups;
  for (std::size_t f = 0; f < frequencies.size(); ++f) {
    std::size_t reached = 0;
    for (std::uint32_t c = 0; c < target.widths.size(); ++c) {
      const double share = target.width_share(c, wavenumber(frequencies[f]));
      reached += share >= 1.0 ? 2 : share > 0.0 ? 1 : 0;
    }
    if (reached > 0) groups[reached].push_back(f);
  }
  SurfaceWaveResult all;
  all.scattering.resize(frequencies.size());
  for (const auto& [reached, indices] : groups) {
    std::vector<double> some;
    for (const std::size_t f : indices) some.push_back(frequencies[f]);
    const auto asked = places == nullptr ? indices.end() : std::ranges::find(indices, places->wavenumber);
    StripPlaces here{static_cast<std::size_t>(asked - indices.begin()), places ? places->by_path : std::nullopt};
    const bool pictured = asked != indices.end();
    put(SurfaceLook(target, look, some, pictured ? &here : nullptr, indices.front() == 0 ? rays : nullptr, tips).take(), indices,
        all);
    if (pictured) std::ranges::copy(here.pieces, std::back_inserter(places->pieces));
  }
  return all;
}

}  // namespace raytube
