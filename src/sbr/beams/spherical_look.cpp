#include "sbr/beams/spherical_look.h"

#include <algorithm>
#include <cmath>

#include "math/node_waves.h"
#include "math/triangle_moments.h"
#include "sbr/beams/tolerances.h"
#include "scene/frequency_bands.h"
#include "scene/material.h"

namespace raytube {

namespace {

// k times the longest side of a triangle that is not halved any more: a twelfth of the wavelength.
constexpr double shortest = 0.5;

// Of the sum of the parts' amplitudes: by how much interpolation between wavenumbers may be off.
constexpr double least_share = 1e-12;

struct Components {
  double u, v, d;
};

Components components(const Beam& beam, const dvec3& vector) {
  return {glm::dot(beam.u_hat, vector), glm::dot(beam.v_hat, vector), glm::dot(beam.direction, vector)};
}

dvec3 vector_of(const Beam& beam, const Components& c) { return c.u * beam.u_hat + c.v * beam.v_hat + c.d * beam.direction; }

double area(const dvec3& a, const dvec3& b, const dvec3& c) { return 0.5 * glm::length(glm::cross(b - a, c - a)); }

}  // namespace

SphericalLook::SphericalLook(const AntennaPair& antennas, const Beam& incident, const SpectralSurfaces& surfaces,
                             double relative_tolerance)
    : antennas_(antennas),
      incident_(incident),
      surfaces_(surfaces),
      wavenumbers_(surfaces.wavenumbers),
      highest_(greatest_wavenumber(wavenumbers_)),
      most_bend_(bend_tolerance(relative_tolerance)) {}

SphericalLook SphericalLook::at_frequency(std::size_t index) const {
  SphericalLook one = *this;
  one.surfaces_.first_frequency_index += index;
  one.surfaces_.wavenumbers = one.wavenumbers_ = wavenumbers_.subspan(index, 1);
  one.highest_ = greatest_wavenumber(one.wavenumbers_);
  return one;
}

// Folded back the point is one in the transmitter's own wave; each perfect conductor turns the mirrored field over.
AntennaRay SphericalLook::wave(const Beam& beam, const dvec3& r) const {
  AntennaRay ray = antennas_.transmit.ray_to(vector_of(incident_, components(beam, r - beam.base)));
  const auto mirrored = [&](const dvec3& vector) { return vector_of(beam, components(incident_, vector)); };
  const bool odd = glm::dot(glm::cross(beam.u_hat, beam.v_hat), beam.direction) > 0.0;
  ray.direction = mirrored(ray.direction);
  for (dvec3& field : ray.field) field = (odd ? -1.0 : 1.0) * mirrored(field);
  return ray;
}

AntennaRay SphericalLook::wave_at_first(const Beam& beam, const dvec3& r) const {
  const Beam& first = beam.met->arriving;
  return wave(first, first.base + vector_of(first, components(beam, r - beam.base)));
}

SphericalLook::Current SphericalLook::current(const Beam& outgoing, const Patch& plane, const dvec3& r) const {
  const AntennaRay leaving = wave(outgoing, r), received = antennas_.receive.ray_to(r);
  const dvec3 n = glm::dot(plane.normal, leaving.direction) > 0.0 ? plane.normal : -plane.normal;
  Current c{r, leaving.path + received.path, -leaving.direction - received.direction, {}};
  for (int q = 0; q < 2; ++q) {
    // The tangential H of the wave that leaves is that of the one that comes.
    const dvec3 eta_j = surface_current_pec(leaving.direction, leaving.field[q], n);
    for (int p = 0; p < 2; ++p) c.weight[p][q] = glm::dot(received.field[p], eta_j);
  }
  return c;
}

// The transmitter's own wave; nothing where the surface turns away from it.
SphericalLook::Current SphericalLook::current(const BentFacet& facet, const dvec3& r) const {
  const SurfacePoint at = facet.over(r);
  const AntennaRay arriving = antennas_.transmit.ray_to(at.point), received = antennas_.receive.ray_to(at.point);
  Current c{r, arriving.path + received.path, -arriving.direction - received.direction, {}};
  if (glm::dot(at.normal, arriving.direction) >= 0.0) return c;
  for (int q = 0; q < 2; ++q) {
    const dvec3 eta_j = surface_current_pec(arriving.direction, arriving.field[q], at.normal);
    for (int p = 0; p < 2; ++p) c.weight[p][q] = at.stretch * glm::dot(received.field[p], eta_j);
  }
  return c;
}

SphericalLook::SpectralCurrent SphericalLook::spectral_current(const Beam& outgoing, const dvec3& r) const {
  AntennaRay ray = wave_at_first(outgoing, r);
  const AntennaRay received = antennas_.receive.ray_to(r);
  auto currents = std::make_shared<ReceivedCurrents>(received_currents(surfaces_, *outgoing.met, ray, received));
  return {r, ray.path + received.path, -ray.direction - received.direction, std::move(currents)};
}

// The transmitter's own wave; nothing where the surface turns away from it.
SphericalLook::SpectralCurrent SphericalLook::spectral_current(const BentFacet& facet, SurfacesMet met, const dvec3& r) const {
  const SurfacePoint at = facet.over(r);
  AntennaRay arriving = antennas_.transmit.ray_to(at.point);
  const AntennaRay received = antennas_.receive.ray_to(at.point);
  const SpectralCurrent dark{r, arriving.path + received.path, -arriving.direction - received.direction, nullptr};
  if (glm::dot(at.normal, arriving.direction) >= 0.0) return dark;
  met.surfaces.back().normal = at.normal;
  ReceivedCurrents currents = received_currents(surfaces_, met, arriving, received);
  for (ChannelWeights& weight : currents.weight)
    for (auto& row : weight)
      for (Complex& w : row) w *= at.stretch;
  for (auto& sigma : currents.incoherent)
    for (double& of : sigma) of *= at.stretch;
  return {r, dark.path, dark.change, std::make_shared<const ReceivedCurrents>(std::move(currents))};
}

namespace {

struct PlanePoint {
  Affine depth;  // of the plane
  dvec2 at;
  double t, w;  // depth and widening there
  dvec3 r;

  PlanePoint(const Beam& outgoing, const Patch& plane, const dvec2& a_at)
      : depth(depth_of(outgoing, plane)), at(a_at), t(depth(at)), w(widening_at(outgoing, t)), r(point_at(outgoing, at, t)) {}
};

// A plane in the launch coordinates of a beam: r - base = w (at, depth), and the widening w changes along it, too.
template <class Current>
Footprint linear_part(const Beam& outgoing, const PlanePoint& p, const Current& c) {
  const dvec3 run = outgoing.curvature * p.w * (p.r - outgoing.base);
  const dvec3 along_u = p.w * (outgoing.u_hat + p.depth.u * outgoing.direction) + p.depth.u * run,
              along_v = p.w * (outgoing.v_hat + p.depth.v * outgoing.direction) + p.depth.v * run;
  Footprint f{outgoing, {}, glm::length(glm::cross(along_u, along_v)), -c.path, 0.0, 0.0};
  f.outgoing.anchor = p.at;
  f.phase_u = glm::dot(c.change, along_u);
  f.phase_v = glm::dot(c.change, along_v);
  return f;
}

}  // namespace

Footprint SphericalLook::footprint(const Beam& outgoing, const Patch& plane, const dvec2& at, Spectrum& spectrum) const {
  const PlanePoint p(outgoing, plane, at);
  if (!outgoing.met) {
    const Current c = current(outgoing, plane, p.r);
    Footprint f = linear_part(outgoing, p, c);
    f.weight = c.weight;
    return f;
  }
  const SpectralCurrent c = spectral_current(outgoing, p.r);
  Footprint f = linear_part(outgoing, p, c);
  spectrum.clear();
  for (const ChannelWeights& weight : c.received->weight) spectrum.push_back({.field = {}, .weight = weight});
  f.outgoing.spectrum = &spectrum;
  return f;
}

void SphericalLook::add_incoherent(TubeSums& sums, const Beam& outgoing, const Patch& plane, const dvec2& at, double area) const {
  if (!outgoing.met || !surfaces_.any_rough()) return;
  const PlanePoint p(outgoing, plane, at);
  const SpectralCurrent c = spectral_current(outgoing, p.r);
  const double on_surface = area * linear_part(outgoing, p, c).area;
  sums.incoherent.resize(wavenumbers_.size());
  for (std::size_t f = 0; f < wavenumbers_.size(); ++f)
    for (std::size_t q = 0; q < 2; ++q) sums.incoherent[f][q] += on_surface * c.received->incoherent[f][q];
}

SphericalLook::BounceSums SphericalLook::sums_of(const Sums& to, int bounce) const {
  std::vector<ScatteringMatrix>& scattering = to.tubes.at(bounce, wavenumbers_.size());
  to.tubes.quadrature.resize(wavenumbers_.size());
  if (surfaces_.any_rough()) to.tubes.incoherent.resize(wavenumbers_.size());
  return {scattering, to.tubes.quadrature, to.tubes.incoherent, to.band};
}

template <class At>
void SphericalLook::add_polygon(const BounceSums& to, const Beam& outgoing, const Patch& plane, const ConvexPolygon& polygon,
                                At at) const {
  const Affine depth = depth_of(outgoing, plane);
  const auto corner = [&](std::size_t i) { return at(point_at(outgoing, polygon[i].at, depth(polygon[i].at))); };
  add_fan(to, polygon.size(), corner, at);
}

// A convex polygon, triangle by triangle.
template <class Corner, class At>
void SphericalLook::add_fan(const BounceSums& to, std::size_t corners, Corner corner, At at) const {
  const auto first = corner(0);
  auto before = corner(1);
  for (std::size_t i = 2; i < corners; ++i) {
    const auto next = corner(i);
    add(to, std::array{first, before, next}, at);
    before = next;
  }
}

void SphericalLook::add(const Sums& sums, int bounce, const Beam& outgoing, const Patch& plane,
                        const ConvexPolygon& polygon) const {
  const BounceSums to = sums_of(sums, bounce);
  if (outgoing.met)
    add_polygon(to, outgoing, plane, polygon, [&](const dvec3& r) { return spectral_current(outgoing, r); });
  else
    add_polygon(to, outgoing, plane, polygon, [&](const dvec3& r) { return current(outgoing, plane, r); });
}

// visit(at), at(r) being the current over a point of the facet.
template <class Visit>
auto SphericalLook::with_current(const BentFacet& facet, std::uint32_t material, Visit visit) const {
  if (material == no_index) return visit([&](const dvec3& r) { return current(facet, r); });
  return visit([&](const dvec3& r) { return spectral_current(facet, {incident_, {{dvec3(0.0), material}}}, r); });
}

bool SphericalLook::add(const Sums& sums, const BentFacet& facet, std::uint32_t material) const {
  return with_current(facet, material, [&](const auto& at) {
    const std::array corners{at(facet.corners()[0]), at(facet.corners()[1]), at(facet.corners()[2])};
    if (std::ranges::none_of(corners, [](const auto& c) { return c.lit(); })) return false;
    add(sums_of(sums, 0), corners, at);
    return true;
  });
}

void SphericalLook::add(const Sums& sums, const BentFacet& facet, std::uint32_t material, std::span<const dvec3> corners) const {
  with_current(facet, material, [&](const auto& at) {
    add_fan(
        sums_of(sums, 0), corners.size(), [&](std::size_t i) { return at(corners[i]); }, at);
  });
}

void SphericalLook::add(const Sums& sums, int bounce, const BentFacet& facet, const SurfacesMet& met,
                        std::span<const dvec3> corners) const {
  const auto at = [&](const dvec3& r) { return spectral_current(facet, met, r); };
  add_fan(
      sums_of(sums, bounce), corners.size(), [&](std::size_t i) { return at(corners[i]); }, at);
}

template <class C, class At>
void SphericalLook::add(const BounceSums& sums, const Corners<C>& triangle, At at) const {
  const auto& [a, b, c] = triangle;
  const auto middle = [&](const C& p, const C& q) { return at(0.5 * (p.point + q.point)); };
  add(sums, triangle, {middle(a, b), middle(b, c), middle(c, a)}, at);
}

// Halves the longest side until amplitudes, and phases off the linear one, are smooth, or short against the wavelength: a border
// of light is never smooth. The halves have one new side in common.
template <class C, class At>
void SphericalLook::add(const BounceSums& sums, const Corners<C>& triangle, const Corners<C>& middles, At at) const {
  const auto& [a, b, c] = triangle;
  const std::array<double, 3> sides{glm::distance(a.point, b.point), glm::distance(b.point, c.point),
                                    glm::distance(c.point, a.point)};
  const auto i = static_cast<std::size_t>(std::ranges::max_element(sides) - sides.begin());
  const double bend = bend_of(triangle, middles);
  if (bend <= most_bend_) return add_smooth(sums, triangle, middles, quadrature_error(most_bend_));
  if (highest_ * sides[i] < shortest) return add_smooth(sums, triangle, middles, std::min(bend, 1.0) / 3.0);
  const C &start = triangle[i], &end = triangle[(i + 1) % 3], &tip = triangle[(i + 2) % 3], &half = middles[i];
  const auto middle = [&](const C& p, const C& q) { return at(0.5 * (p.point + q.point)); };
  const C between = middle(half, tip);
  add(sums, Corners<C>{start, half, tip}, Corners<C>{middle(start, half), between, middles[(i + 2) % 3]}, at);
  add(sums, Corners<C>{half, end, tip}, Corners<C>{middle(half, end), middles[(i + 1) % 3], between}, at);
}

// The largest distance of a side's middle from the mean of its ends, over the largest amplitude at the corners, at the frequency
// where it is largest: coefficients of materials turn with the angle as phases do.
template <class C>
double SphericalLook::bend_of(const Corners<C>& corners, const Corners<C>& middles) const {
  double most = 0.0;
  for (std::size_t f = 0; f < C::weights_of(wavenumbers_.size()); ++f) {
    double largest = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const C &a = corners[i], &b = corners[(i + 1) % 3], &m = middles[i];
      const auto &at_a = a.weight_at(f), &at_b = b.weight_at(f), &at_m = m.weight_at(f);
      const Complex turn = std::polar(1.0, -highest_ * (m.path - 0.5 * (a.path + b.path)));
      double off = 0.0, square = 0.0;
      for (int p = 0; p < 2; ++p)
        for (int q = 0; q < 2; ++q) {
          off += std::norm(turn * at_m[p][q] - 0.5 * (at_a[p][q] + at_b[p][q]));
          square += std::norm(at_a[p][q]);
        }
      squares = std::max(squares, off), largest = std::max(largest, square);
    }
    if (squares > 0.0) most = std::max(most, largest > 0.0 ? std::sqrt(squares / largest) : 1.0);
  }
  return most;
}

// Mean of the current times its phase, over the area of the triangle: amplitude times the phase off the linear one is the
// parabola through its values at the corners and the middles of the sides.
template <class C>
ScatteringMatrix SphericalLook::radiated(const Corners<C>& corners, const Corners<C>& middles, std::size_t frequency, double k) {
  const double path = corners[0].path;
  const auto moments = triangle_moments({0.0, -k * (corners[1].path - path), -k * (corners[2].path - path)});
  ScatteringMatrix s;
  for (std::size_t i = 0; i < 3; ++i) {
    const C &a = corners[i], &b = corners[(i + 1) % 3], &m = middles[i];
    const auto &at_a = a.weight_at(frequency), &at_b = b.weight_at(frequency), &at_m = m.weight_at(frequency);
    const Complex bent = 4.0 * std::polar(1.0, -k * (m.path - 0.5 * (a.path + b.path)));
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q)
        s.at(p, q) += at_a[p][q] * moments[i] + (at_m[p][q] * bent - at_a[p][q] - at_b[p][q]) * moments[3 + i];
  }
  return s *= std::polar(1.0, -k * path);
}

// The share `left` that a parabola leaves is known but for its phase: parts are taken as independent.
template <class C>
void SphericalLook::add_smooth(const BounceSums& sums, const Corners<C>& corners, const Corners<C>& middles, double left) const {
  const double size = area(corners[0].point, corners[1].point, corners[2].point) / (4.0 * pi);
  const auto [nearest, farthest] = std::minmax({corners[0].path, corners[1].path, corners[2].path});
  double off = 0.0;  // of paths from linear ones
  for (std::size_t i = 0; i < 3; ++i)
    off = std::max(off, std::abs(middles[i].path - 0.5 * (corners[i].path + corners[(i + 1) % 3].path)));
  const bool same = C::weights_of(wavenumbers_.size()) == 1;  // at every wavenumber
  if (const ChebyshevNodes* nodes = same ? sums.band.nodes_of_fresnel(0.5 * (farthest - nearest) + off, least_share) : nullptr) {
    std::vector<ScatteringMatrix> values;
    for (const double k : nodes->at) values.push_back(radiated(corners, middles, 0, k) *= Complex(0.0, -k * size));
    add_interpolated(values, *nodes, wavenumbers_, -0.5 * (nearest + farthest), sums.scattering);
  } else
    for (std::size_t f = 0; f < wavenumbers_.size(); ++f)
      sums.scattering[f] += radiated(corners, middles, f, wavenumbers_[f]) *= Complex(0.0, -wavenumbers_[f] * size);
  for (std::size_t f = 0; f < wavenumbers_.size(); ++f) {
    const double square = std::pow(wavenumbers_[f] * size * left, 2) / 3.0;
    for (const C& m : middles) {
      const auto& at_m = m.weight_at(f);
      for (int p = 0; p < 2; ++p)
        for (int q = 0; q < 2; ++q) sums.errors[f].squares[p][q] += square * std::norm(at_m[p][q]);
    }
  }
  for (std::size_t f = 0; f < sums.incoherent.size(); ++f)
    for (const C& m : middles) {
      const auto incoherent = m.incoherent_at(f);
      for (std::size_t q = 0; q < 2; ++q) sums.incoherent[f][q] += 4.0 * pi * size / 3.0 * incoherent[q];
    }
}

}  // namespace raytube
