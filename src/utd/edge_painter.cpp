#include "utd/edge_painter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "utd/erfc_ray.h"
#include "utd/filon.h"

namespace raytube {

namespace {

// How far past an end of the edge its waves are followed, as sqrt(k detour): they have faded to 0.002 there and are let fade to
// nothing, so that no path ends in a jump.
constexpr double faded = 4.0;

double fading(double detour) {
  const double u = detour / (faded * faded), rest = std::max(1.0 - u * u * u * u, 0.0);
  return rest * rest;
}
// Electrical distance from the edge below which the waves on a face no longer change.
constexpr double at_edge = 0.05;
// A rule takes in distances from the edge up to this ratio: waves change with their root.
constexpr double octaves = 8.0;

const FilonRule<8>& short_rule() {
  static const FilonRule<8> rule;
  return rule;
}

const FilonRule<16>& long_rule() {
  static const FilonRule<16> rule;
  return rule;
}

void add_terms(const std::array<EdgeWaveTerm, 2>& terms, int each, const Reals& root, Complexes& sum) {
  for (int i = 0; i < each; ++i) {
    Reals x;
    for (std::size_t lane = 0; lane < lanes; ++lane) x[lane] = terms[i].rate * root[lane];
    const Complexes wave = scaled_erfc(x);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      sum.re[lane] += terms[i].strength * wave.re[lane];
      sum.im[lane] += terms[i].strength * wave.im[lane];
    }
  }
}

// The same, each wave with its share of the corner's: see add_beside_corner().
void add_shares(const std::array<EdgeWaveTerm, 2>& terms, int each, const Reals& root, const Reals& detour, Complexes& sum) {
  for (int i = 0; i < each; ++i) {
    Reals x;
    for (std::size_t lane = 0; lane < lanes; ++lane) x[lane] = terms[i].rate * root[lane];
    const Complexes wave = scaled_erfc(x);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const double z2 = x[lane] * x[lane], all = z2 + detour[lane];
      const double share = terms[i].strength * fading(detour[lane]) * (all > 0.0 ? z2 / all : 1.0);
      sum.re[lane] += share * wave.re[lane];
      sum.im[lane] += share * wave.im[lane];
    }
  }
}

}  // namespace

EdgePainter::EdgePainter(const FaceTree& tree, const LookVectors& look, std::span<const double> wavenumbers,
                         const EdgeLight& light, int reflections)
    : tree_(tree), look_(look), wavenumbers_(wavenumbers), light_(light), reflections_(reflections), tracer_(tree) {
  const dvec3& d = light.wave->direction;
  const dvec3 hard = -glm::cross(light.edge->tangent, d) / light.incidence.sin_cone, soft = glm::cross(d, hard);
  for (int q = 0; q < 2; ++q) arriving_[q] = {glm::dot(soft, light.wave->electric[q]), glm::dot(hard, light.wave->electric[q])};
}

void EdgePainter::at(double azimuth, std::vector<ScatteringMatrix>& density) {
  density.assign(wavenumbers_.size(), {});
  const Wedge& wedge = *light_.edge->wedge;
  terms_ = edge_wave_terms(wedge.n, light_.incidence.source_angle, azimuth);
  const Rays rays = leaving(azimuth);
  find_corners(rays.sheet.direction);
  Rays widened = rays;
  const double margin = faded * std::sqrt(4 * (1 + reflections_) * tree_.mesh().radius / std::ranges::min(wavenumbers_)) /
                        light_.incidence.sin_cone;
  if (open_[0]) widened.sheet.from -= margin;
  if (open_[1]) widened.sheet.to += margin;
  follow(widened, {wedge.faces[0].patch, wedge.faces[1].patch, wedge.rim}, reflections_, density);
}

EdgePainter::Rays EdgePainter::leaving(double azimuth) const {
  const WedgeFace& face = light_.edge->wedge->faces[0];
  const dvec3& t = light_.edge->tangent;
  const dvec3 across = std::cos(azimuth) * face.into_face + std::sin(azimuth) * face.normal;
  const dvec3 direction = glm::normalize(light_.incidence.sin_cone * across + light_.incidence.cos_cone * t);
  const dvec3 hard = glm::cross(t, across), soft = glm::cross(direction, hard);
  return {{light_.edge->origin, t, direction, light_.from, light_.to}, 0.0, 0.0, {soft, hard}};
}

// A surface on which the edge ends goes on with its waves as their mirror. An open sheet has one on either side, or none.
bool EdgePainter::closed(int end, const dvec3& direction) const {
  const EdgeAxis& edge = *light_.edge;
  if (end == 0 ? light_.from > 0.0 : light_.to < edge.length) return false;
  return std::ranges::any_of(edge.stops[end], [&](int face) {
    return edge.wedge->n != 2.0 || glm::dot(direction, edge.wedge->faces[face].normal) > 0.0;
  });
}

void EdgePainter::find_corners(const dvec3& direction) {
  constexpr double none = std::numeric_limits<double>::infinity();
  for (int end = 0; end < 2; ++end) open_[end] = !closed(end, direction);
  corner_[0] = open_[0] ? light_.from : open_[1] ? 2 * light_.from - light_.to : -none;
  corner_[1] = open_[1] ? light_.to : open_[0] ? 2 * light_.to - light_.from : none;
}

void EdgePainter::follow(const Rays& rays, const IgnoredPatches& ignored, int reflections,
                         std::vector<ScatteringMatrix>& density) {
  std::vector<SheetHit>& hits = hits_[reflections];
  tracer_.trace(rays.sheet, ignored, hits);
  for (const SheetHit& hit : hits) {
    const std::uint32_t patch = tree_.faces()[hit.face].patch;
    const Patch& plane = tree_.mesh().patches[patch];
    paint(footprint(rays, hit, plane), density);
    if (reflections == 0) continue;
    Rays next{reflected(rays.sheet, hit, plane.normal), rays.path + hit.length, rays.path_rate + hit.growth, rays.field, patch};
    for (dvec3& field : next.field) field = 2 * glm::dot(plane.normal, field) * plane.normal - field;
    follow(next, {patch, no_index, no_index}, reflections - 1, density);
  }
}

// The tube between neighbouring places and azimuths is rho sin(beta0) wide, rho the distance from the edge's line; reflections by
// planes leave it so.
EdgePainter::Footprint EdgePainter::footprint(const Rays& rays, const SheetHit& hit, const Patch& plane) const {
  const FaceIncidence& in = light_.incidence;
  const Sheet& sheet = rays.sheet;
  const double path = rays.path + hit.length, path_rate = rays.path_rate + hit.growth;
  const double facing = glm::dot(plane.normal, sheet.direction);
  const dvec3 base = sheet.base + hit.length * sheet.direction, step = sheet.step + hit.growth * sheet.direction;
  const double start = glm::dot(light_.wave->direction, light_.edge->origin) + light_.wave->path;
  Footprint on{hit.from,
               hit.to,
               path,
               path_rate,
               glm::dot(look_.scattered, base) - start - path,
               glm::dot(look_.scattered, step) - in.cos_cone - path_rate,
               in.sin_cone * in.sin_cone / std::abs(facing),
               {}};
  const dvec3 normal = facing > 0.0 ? -plane.normal : plane.normal;
  for (int kind = 0; kind < 2; ++kind) {
    const dvec3 current = 2.0 * glm::cross(normal, glm::cross(sheet.direction, rays.field[kind]));
    for (int p = 0; p < 2; ++p) on.seen[p][kind] = glm::dot(look_.receive[p], current);
  }
  return on;
}

// S = -(jk / 4 pi) p_hat . eta J * integral (Stratton & Chu 1939); the diffracted E is minus the sum of the waves.
void EdgePainter::paint(const Footprint& on, std::vector<ScatteringMatrix>& density) {
  for (std::size_t f = 0; f < wavenumbers_.size(); ++f) {
    const double k = wavenumbers_[f];
    const Pair pair = integral(on, k);
    const Complex factor = Complex(0.0, light_.weight * k / (4 * pi));
    const Complex soft = factor * (pair.incident - pair.reflected), hard = factor * (pair.incident + pair.reflected);
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q)
        density[f].at(p, q) += on.seen[p][0] * arriving_[q][0] * soft + on.seen[p][1] * arriving_[q][1] * hard;
  }
}

EdgePainter::Pair EdgePainter::integral(const Footprint& on, double k) const {
  Pair sum;
  const double from = std::max(on.from, light_.from), to = std::min(on.to, light_.to);
  if (from < to) {
    const double unit = at_edge / k, near = on.path + on.path_rate * from, far = on.path + on.path_rate * to;
    const double ratio = std::max(near, unit) / std::max(far, unit);
    const int parts = 1 + static_cast<int>(std::abs(std::log(ratio)) / std::log(octaves));
    double begin = from;
    for (int i = 1; i <= parts; ++i) {
      const double path = std::max(near, unit) * std::pow(ratio, -static_cast<double>(i) / parts);
      const double end = i == parts ? to : std::clamp((path - on.path) / on.path_rate, begin, to);
      add_piece(on, k, begin, end, sum);
      begin = end;
    }
  }
  add_corner(on, k, corner_[0], 1.0, sum);
  add_corner(on, k, corner_[1], -1.0, sum);
  return sum;
}

void EdgePainter::add_piece(const Footprint& on, double k, double from, double to, Pair& sum) const {
  const FilonRule<8>& rule = short_rule();
  const double half = (to - from) / 2, middle = (from + to) / 2;
  Reals path, root;
  for (std::size_t i = 0; i < lanes; ++i) {
    path[i] = std::max(on.path + on.path_rate * (middle + half * rule.at[i]), 0.0);
    root[i] = light_.incidence.sin_cone * std::sqrt(k * path[i]);
  }
  Complexes incident{}, reflected{};
  add_terms(terms_.incident, terms_.each, root, incident);
  add_terms(terms_.reflected, terms_.each, root, reflected);
  const std::array<Complex, 8> weights = rule.weights(k * on.phase_rate * half);
  Pair here;
  for (std::size_t i = 0; i < lanes; ++i) {
    here.incident += path[i] * weights[i] * incident[i];
    here.reflected += path[i] * weights[i] * reflected[i];
  }
  const Complex factor = on.area * half * std::polar(1.0, k * (on.phase + on.phase_rate * middle));
  sum.incident += factor * here.incident;
  sum.reflected += factor * here.reflected;
}

void EdgePainter::add_corner(const Footprint& on, double k, double corner, double inwards, Pair& sum) const {
  const double longest = std::max(on.path + on.path_rate * on.from, on.path + on.path_rate * on.to);
  const double reach = faded * std::sqrt(2 * longest / k) / light_.incidence.sin_cone;
  const double low = std::max(on.from, corner - reach), high = std::min(on.to, corner + reach);
  add_beside_corner(on, k, corner, -inwards, low, std::min(high, corner), sum);
  add_beside_corner(on, k, corner, inwards, std::max(low, corner), high, sum);
}

// Where the rays' start passes a corner the wave of the edge neither stops nor goes on: Fresnel's step of the detour over the
// corner, 1 - D inside and D outside with D = e^{-jx^2} W(x) / 2, x^2 = k detour. It is divided between the two edges that meet
// there: z^2 / (z^2 + x^2) of it is this one's, z^2 the argument X of the wave's own transition. `side` is 1 inside.
void EdgePainter::add_beside_corner(const Footprint& on, double k, double corner, double side, double from, double to,
                                    Pair& sum) const {
  if (!(from < to)) return;
  const FilonRule<16>& rule = long_rule();
  const double half = (to - from) / 2, middle = (from + to) / 2, cosine = light_.incidence.cos_cone;
  const std::array<Complex, 16> weights = rule.weights(k * on.phase_rate * half);
  Pair here;
  for (std::size_t first = 0; first < 16; first += lanes) {
    Reals path, root, x, detour;
    for (std::size_t i = 0; i < lanes; ++i) {
      const double place = middle + half * rule.at[first + i], beyond = place - corner;
      path[i] = std::max(on.path + on.path_rate * place, 0.0);
      root[i] = light_.incidence.sin_cone * std::sqrt(k * path[i]);
      const double via = std::hypot(beyond + path[i] * cosine, path[i] * light_.incidence.sin_cone);
      const double all = via + path[i], longer = all > 0.0 ? beyond * (beyond + 2 * path[i] * cosine) / all : 0.0;
      detour[i] = all > 0.0 ? std::max(k * beyond * (beyond - cosine * longer) / all, 0.0) : 0.0;
      x[i] = std::sqrt(detour[i]);
    }
    Complexes incident{}, reflected{};
    add_shares(terms_.incident, terms_.each, root, detour, incident);
    add_shares(terms_.reflected, terms_.each, root, detour, reflected);
    const Complexes step = scaled_erfc(x), turn = unit_phasors(detour);
    for (std::size_t i = 0; i < lanes; ++i) {
      const Complex weight = path[i] * weights[first + i] * std::conj(turn[i]) * step[i];
      here.incident += weight * incident[i];
      here.reflected += weight * reflected[i];
    }
  }
  const Complex factor = -side / 2 * on.area * half * std::polar(1.0, k * (on.phase + on.phase_rate * middle));
  sum.incident += factor * here.incident;
  sum.reflected += factor * here.reflected;
}

}  // namespace raytube
