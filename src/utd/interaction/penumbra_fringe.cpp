#include "utd/interaction/penumbra_fringe.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/filon.h"
#include "scene/frequency_bands.h"
#include "utd/interaction/edge_axes.h"
#include "utd/interaction/rim_panels.h"
#include "utd/shadow/clear_between.h"
#include "utd/wedge/diffracted_field.h"
#include "utd/wedge/work.h"

namespace raytube {

namespace {

// A lit piece ends so much of its length early where rays leave it: its ends belong to other faces, too.
constexpr double end_inset = 1e-7;
// Rays that run along a face are tested for what blocks them at this distance beside it, a share of the target's radius: above
// the rounding of files, and below what parts faces.
constexpr double beside_face = 4e-6;

bool share_a_face(const Wedge& one, const Wedge& other) {
  return std::ranges::any_of(
      one.faces, [&](const WedgeFace& face) { return face.patch == other.faces[0].patch || face.patch == other.faces[1].patch; });
}

// Sum of the normals of the faces of a wedge that a ray to or from it runs along.
dvec3 grazed_side(const Wedge& wedge, const dvec3& direction) {
  dvec3 side(0.0);
  for (const WedgeFace& face : wedge.faces)
    if (std::abs(glm::dot(direction, face.normal)) < rounding_of_files) side += face.normal;
  return side;
}

StraightEdge lit_edge(const LitEdgePiece& piece) {
  StraightEdge edge = straight_edge(*piece.edge->wedge);
  edge.begin = piece.from;
  edge.end = piece.to;
  return edge;
}

RaySource source_of(const PlaneWave& wave) {
  if (wave.antennas) return {Spreading::point, wave.antennas->transmit.position(), {}, {}};
  return {Spreading::plane, {}, wave.direction, {}};
}

}  // namespace

// The diffracted wave at a point as a look at the rim there, E = -[b0_hat b0'_hat soft + phi_hat phi'_hat hard] . E_i
// (Kouyoumjian and Pathak 1974): in the place of V and H are b0_hat and phi_hat.
struct PenumbraFringe::ArrivingWave {
  LookVectors look;
  std::array<std::array<double, 2>, 2> incident;  // [transmit][soft, hard]: -b0'_hat . E_i, -phi'_hat . E_i

  ArrivingWave(const StraightEdge& edge, const EdgeRay& ray, const std::array<dvec3, 2>& electric, const LookVectors& of_target)
      : look(of_target) {
    const dvec3 phi_source = -glm::cross(edge.tangent(), ray.arriving) / ray.sin_cone;
    const dvec3 phi = glm::cross(edge.tangent(), ray.leaving) / ray.sin_cone;
    const dvec3 cone_source = glm::cross(ray.arriving, phi_source);
    look.incident = ray.leaving;
    look.electric = {glm::cross(ray.leaving, phi), phi};
    for (int c = 0; c < 2; ++c) look.magnetic[c] = glm::cross(ray.leaving, look.electric[c]);
    for (int q = 0; q < 2; ++q) incident[q] = {-glm::dot(cone_source, electric[q]), -glm::dot(phi_source, electric[q])};
  }

  void add(const DiffractedWave& wave, const ScatteringMatrix& amplitude, Complex phase, ScatteringMatrix& sum) const {
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q)
        sum.at(p, q) +=
            phase * (amplitude.at(p, 0) * wave.soft * incident[q][0] + amplitude.at(p, 1) * wave.hard * incident[q][1]);
  }
};

/// The whole way over a ray: the field where it meets the edge, spreading counted in, and what radiates from its end.
struct PenumbraFringe::Way {
  LookVectors look;
  std::array<dvec3, 2> electric;
  double phase;  // divided by k [m]
};

struct PenumbraFringe::RimPoint {
  EdgeRay ray;   // to it, its path counted in `phase`
  double phase;  // divided by k [m]
  double share;
  ArrivingWave wave;
  EdgeAmplitude amplitude;
  dvec3 place;

  void add(const StraightEdge& source, double wavenumber, Complex weight, ScatteringMatrix& sum) const;
};

// Points of Filon's rule, those that the wave reaches, with their phases over k and the rate of these over half the panel [m].
struct PenumbraFringe::Panel {
  std::array<std::optional<RimPoint>, lanes> points;
  std::array<double, lanes> phases{};
  double half, rate = 0.0;

  template <class Visit>
  void visit_points(double wavenumber, Visit visit) const;
  void add(const StraightEdge& source, double wavenumber, ScatteringMatrix& sum) const;
  void take_apart(const StraightEdge& source, double wavenumber, const PathPlace& place, std::vector<ImageEdge>& pieces) const;
  PathSpan paths() const;
};

struct PenumbraFringe::Source {
  const LitEdgePiece& piece;
  StraightEdge edge;
  RaySource wave;
  EdgeRays rays;
  explicit Source(const LitEdgePiece& lit) : piece(lit), edge(lit_edge(lit)), wave(source_of(*lit.wave)), rays(edge, wave) {}
};

/// An edge that the source may light.
struct PenumbraFringe::Rim {
  const EdgeAxis& axis;
  bool in_the_clear;  // nothing can stand between the two
};

PenumbraFringe::PenumbraFringe(const Tracer& tracer, const FaceTree& faces, std::span<const EdgeAxis> axes, double shortest_axis,
                               const LookVectors& look, std::span<const double> wavenumbers, const PairPlan& plan)
    : tracer_(tracer),
      faces_(faces),
      axes_(axes),
      shortest_axis_(shortest_axis),
      look_(look),
      wavenumbers_(wavenumbers),
      plan_(plan),
      band_(wavenumbers),
      shortest_wavelength_(2 * pi / sampling_wavenumber(wavenumbers)) {}

template <class Visit>
void PenumbraFringe::visit_rims(const Source& source, Visit visit) const {
  const EdgeAxis& edge = *source.piece.edge;
  const auto axis = static_cast<std::size_t>(&edge - axes_.data());
  const auto is_met = [&](const WedgeFace& face) { return plan_.has(axis, face.patch); };
  for (const EdgeAxis& rim : axes_)
    if (rim.length >= shortest_axis_ && !share_a_face(*edge.wedge, *rim.wedge) &&
        (plan_.all() || std::ranges::any_of(rim.wedge->faces, is_met)))
      visit(Rim{rim, is_clear_between(faces_, *edge.wedge, *rim.wedge)});
}

void PenumbraFringe::add(const LitEdgePiece& source, std::vector<ScatteringMatrix>& sums) {
  const Source from(source);
  visit_rims(from, [&](const Rim& rim) { add_rim(from, rim, sums); });
}

void PenumbraFringe::take_apart(const LitEdgePiece& source, const PathPlace& place, std::vector<ImageEdge>& pieces) const {
  const Source from(source);
  visit_rims(from, [&](const Rim& rim) {
    const std::vector<double> ends = panels_of(from, rim);
    for (std::size_t i = 1; i < ends.size(); ++i)
      if (const std::optional<Panel> panel = panel_on(from, rim, ends[i - 1], ends[i]))
        panel->take_apart(from.edge, wavenumbers_.front(), place, pieces);
  });
}

// Edges without strips, which this would complete, have none of it.
void PenumbraFringe::add_step(const LitEdgePiece& lit, double weight, std::vector<ScatteringMatrix>& sums) const {
  if (weight == 0.0) return;
  const Wedge& wedge = *lit.edge->wedge;
  for (const auto& [of_wedge, look, wave_path] : plain_parts(lit, look_, wavenumbers_, tracer_.mesh().radius)) {
    const WedgeIncidence incidence = incidence_on(wedge, look.incident);
    if (incidence.weight != 1.0) continue;
    const EdgeAmplitude amplitude = edge_amplitude(wedge, incidence, look);
    const dvec3 difference = look.scattered - look.incident, way = (of_wedge.end - of_wedge.begin) * (wedge.end - wedge.start);
    const dvec3 middle = glm::mix(wedge.start, wedge.end, (of_wedge.begin + of_wedge.end) / 2);
    const double half_span = glm::dot(difference, way) / 2, path = glm::dot(difference, middle) - wave_path;
    bool windowed = false;
    for (std::size_t f = 0; f < wavenumbers_.size(); ++f) {
      const double k = wavenumbers_[f];
      ScatteringMatrix sum = amplitude_at(amplitude, k, windowed);
      sums[f] += sum *= weight * glm::length(way) * sinc(k * half_span) * std::polar(1.0, k * path);
    }
  }
}

bool PenumbraFringe::ends_along(const LitEdgePiece& lit, const LitEdgePiece& source) const {
  const Source from(source);
  const dvec3 middle = lit.edge->origin + (lit.from + lit.to) / 2 * lit.edge->tangent;
  if (share_a_face(*source.edge->wedge, *lit.edge->wedge)) return false;
  const std::optional<EdgeRay> ray = from.rays.to(middle);
  return ray && boundary_at(from.edge.n, ray->source_angle, ray->observation_angle) &&
         glm::length(ray->leaving - lit.wave->about(middle).direction) < 2 * rounding_of_files;
}

double PenumbraFringe::work_of_panel(std::size_t frequencies) {
  return lanes * (work::blocker_ray + work::edge_amplitude * (1 + static_cast<double>(frequencies)));
}

const ChebyshevNodes* PenumbraFringe::nodes_of(double half_span) {
  return wavenumbers_.size() > 1 ? band_.nodes_of_fresnel(half_span, node_error) : nullptr;
}

std::vector<double> PenumbraFringe::panels_of(const Source& source, const Rim& rim) const {
  return rim_panels(source.edge, source.wave, source.piece.incidence.source_angle, rim.axis, shortest_wavelength_);
}

void PenumbraFringe::add_rim(const Source& source, const Rim& rim, std::vector<ScatteringMatrix>& sums) {
  const std::vector<double> ends = panels_of(source, rim);
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const std::optional<Panel> panel = panel_on(source, rim, ends[i - 1], ends[i]);
    work_ += work_of_panel(panel ? add_panel(source, *panel, sums) : 1);
  }
}

// At how many wavenumbers it was computed.
std::size_t PenumbraFringe::add_panel(const Source& source, const Panel& panel, std::vector<ScatteringMatrix>& sums) {
  const auto sum_at = [&](std::span<const double> wavenumbers, std::vector<ScatteringMatrix>& sum) {
    for (std::size_t f = 0; f < wavenumbers.size(); ++f) panel.add(source.edge, wavenumbers[f], sum[f]);
    return wavenumbers.size();
  };
  const PathSpan paths = panel.paths();
  const ChebyshevNodes* nodes = nodes_of(paths.half());
  if (!nodes) return sum_at(wavenumbers_, sums);
  std::vector<ScatteringMatrix> samples(nodes->at.size());
  sum_at(nodes->at, samples);
  add_interpolated(samples, *nodes, wavenumbers_, paths.middle(), sums);
  return samples.size();
}

// By Filon's rule: the phase of the rays' paths is close to linear, what remains changes slowly. Shadows end between points.
std::optional<PenumbraFringe::Panel> PenumbraFringe::panel_on(const Source& source, const Rim& rim, double from,
                                                              double to) const {
  const FilonRule& rule = FilonRule::get();
  Panel panel;
  panel.half = (to - from) / 2;
  for (std::size_t i = 0; i < lanes; ++i) {
    const dvec3 place = rim.axis.origin + ((from + to) / 2 + panel.half * rule.at[i]) * rim.axis.tangent;
    panel.points[i] = point_on(source, rim, place);
    if (panel.points[i]) panel.phases[i] = panel.points[i]->phase;
  }
  std::size_t first = 0, last = lanes;
  while (first < lanes && !panel.points[first]) ++first;
  if (first == lanes) return std::nullopt;
  while (!panel.points[last - 1]) --last;
  if (last - first > 1) panel.rate = (panel.phases[last - 1] - panel.phases[first]) / (rule.at[last - 1] - rule.at[first]);
  return panel;
}

// The wave is taken as plane about a point of the rim, and its fringe current there as that of endless faces.
std::optional<PenumbraFringe::RimPoint> PenumbraFringe::point_on(const Source& source, const Rim& rim, const dvec3& place) const {
  const std::optional<EdgeRay> reaching = source.rays.to(place);
  if (!reaching) return std::nullopt;
  const Wedge& wedge = *rim.axis.wedge;
  EdgeRay ray = *reaching;
  ray.observation_angle = boundary_at(source.edge.n, ray.source_angle, ray.observation_angle).value_or(ray.observation_angle);
  WedgeIncidence incidence = incidence_on(wedge, ray.leaving);
  incidence.weight = incidence_weight(wedge, incidence);
  if (incidence.weight == 0.0 || !is_clear(source, ray, rim, place)) return std::nullopt;
  const Way way = way_over(source, ray, place);
  ray.path = 0.0;
  const ArrivingWave wave(source.edge, ray, way.electric, way.look);
  return RimPoint{
      ray,  way.phase, source.piece.weight * source.piece.edge->wedge->share, wave, edge_amplitude(wedge, incidence, wave.look),
      place};
}

// The wave of a point source is over that of a unit source, which falls as 1 / (s' + s).
PenumbraFringe::Way PenumbraFringe::way_over(const Source& source, const EdgeRay& ray, const dvec3& place) const {
  const PlaneWave& wave = *source.piece.wave;
  if (!wave.antennas) return {look_, wave.electric, glm::dot(look_.scattered, place) - wave.path - ray.path};
  const AntennaRay in = wave.antennas->transmit.ray_to(ray.point), out = wave.antennas->receive->ray_to(place);
  Way way{look_, in.field, -(in.path + glm::distance(place, ray.point) + out.path)};
  way.look.scattered = -out.direction;
  way.look.receive = out.field;
  for (dvec3& field : way.electric) field *= glm::distance(ray.point, source.wave.position);
  return way;
}

void PenumbraFringe::RimPoint::add(const StraightEdge& source, double wavenumber, Complex weight, ScatteringMatrix& sum) const {
  bool windowed = false;
  wave.add(diffracted_wave(source, ray, wavenumber), amplitude_at(amplitude, wavenumber, windowed), share * weight, sum);
}

template <class Visit>
void PenumbraFringe::Panel::visit_points(double wavenumber, Visit visit) const {
  const FilonRule& rule = FilonRule::get();
  const Complexes weights = rule.weights(wavenumber * rate);
  for (std::size_t i = 0; i < lanes; ++i) {
    if (!points[i]) continue;
    const Complex weight(weights.re[i], weights.im[i]);
    visit(*points[i], half * weight * std::polar(1.0, wavenumber * (phases[i] - rate * rule.at[i])));
  }
}

void PenumbraFringe::Panel::add(const StraightEdge& source, double wavenumber, ScatteringMatrix& sum) const {
  visit_points(wavenumber, [&](const RimPoint& point, const Complex& weight) { point.add(source, wavenumber, weight, sum); });
}

void PenumbraFringe::Panel::take_apart(const StraightEdge& source, double wavenumber, const PathPlace& place,
                                       std::vector<ImageEdge>& pieces) const {
  visit_points(wavenumber, [&](const RimPoint& point, const Complex& weight) {
    const double from = std::clamp(point.ray.arc_length, source.begin, source.end);
    const dvec3 at = place.at(source.origin + from * source.tangent(), point.place, point.phase);
    pieces.push_back({at, at, {}});
    point.add(source, wavenumber, weight, pieces.back().s);
  });
}

// The span of the paths of the rays and of the waves over the ends of the lit piece.
PathSpan PenumbraFringe::Panel::paths() const {
  PathSpan span{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const std::optional<RimPoint>& point : points) {
    if (!point) continue;
    const auto& [first, last] = point->ray.detours;
    for (const double detour : {0.0, first, last})
      if (std::isfinite(detour)) span = {std::min(span.low, point->phase - detour), std::max(span.high, point->phase)};
  }
  return span;
}

// Whether nothing but the faces of both edges stands between the edge, at the point of its lit piece next to the ray's, and the
// rim. Rays that run along a face are tested beside it.
bool PenumbraFringe::is_clear(const Source& source, const EdgeRay& ray, const Rim& rim, const dvec3& place) const {
  if (rim.in_the_clear) return true;
  const Wedge &wedge = *source.piece.edge->wedge, &met = *rim.axis.wedge;
  const double inset = end_inset * (source.piece.to - source.piece.from);
  const double position = std::clamp(ray.arc_length, source.piece.from + inset, source.piece.to - inset);
  const dvec3 start = source.edge.origin + position * source.edge.tangent(), way = place - start;
  const double length = glm::length(way);
  const dvec3 aside = beside_face * tracer_.mesh().radius * (grazed_side(wedge, ray.leaving) + grazed_side(met, ray.leaving));
  const IgnoredPatches own{wedge.faces[0].patch, wedge.faces[1].patch, wedge.border_patch};
  const std::uint32_t blocker = tracer_.blocker(start + aside, way / length, own);
  if (blocker == no_index) return true;
  const std::uint32_t patch = tracer_.mesh().triangle_patch[blocker];
  if (patch == met.faces[0].patch || patch == met.faces[1].patch || patch == met.border_patch) return true;
  const Patch& plane = tracer_.mesh().patches[patch];
  return std::abs(plane.offset - glm::dot(plane.normal, start + aside)) > std::abs(glm::dot(plane.normal, way));
}

}  // namespace raytube
