#include "utd/interaction/reflected_light.h"

#include <algorithm>
#include <cmath>

#include "utd/interaction/edge_axes.h"
#include "utd/wedge/incidence.h"

namespace raytube {

namespace {

// Light fades over this share of an edge's length to either side of the border of its beam (docs/theory/interaction.md).
constexpr double border_share = 0.04;
// Pieces of an edge, and gaps between them, that are shorter than this share of a wavelength do not count: they scatter nothing.
constexpr double shortest = 1e-3;

// The component along a plane's normal of light that arrives at it, with its sign; of unit light from afar.
double facing_of(const PlaneWave& wave, const Patch& plane) {
  if (!wave.antennas) return glm::dot(plane.normal, wave.direction);
  const dvec3 antenna = wave.antennas->transmit.position();
  return (plane.offset - glm::dot(plane.normal, antenna)) / glm::length(antenna);
}

bool reflects(const Patch& plane, bool closed, const PlaneWave& wave) {
  const double facing = facing_of(wave, plane);
  return std::abs(facing) > lit_threshold && !(closed && facing > 0.0);
}

dvec3 middle_of(const EdgeAxis& axis) { return axis.origin + 0.5 * axis.length * axis.tangent; }

RayFan beyond(const RayFan& fan, const FanHit& hit, const Patch& mirror) {
  if (fan.divergence == 0.0) return reflected(fan, hit, mirror.normal);
  return reflected_image(fan, hit, mirror.normal, mirror.offset);
}

}  // namespace

PlaneWave reflected(const PlaneWave& wave, const Patch& plane) {
  const double facing = glm::dot(wave.direction, plane.normal);
  PlaneWave result{glm::reflect(wave.direction, plane.normal), {}, wave.path + 2 * facing * plane.offset};
  for (int q = 0; q < 2; ++q) result.electric[q] = 2 * glm::dot(plane.normal, wave.electric[q]) * plane.normal - wave.electric[q];
  if (wave.antennas) result.antennas = {wave.antennas->transmit.reflected(plane.normal, plane.offset), wave.antennas->receive};
  return result;
}

ReflectedLight::ReflectedLight(const ReceivingFaces& faces, std::span<const EdgeAxis> axes, const PlaneWave& incident,
                               double wavelength, double shortest_axis, const PairPlan& plan)
    : tree_(faces.tree),
      large_(faces.large),
      axes_(axes),
      incident_(incident),
      wavelength_(wavelength),
      shortest_axis_(shortest_axis),
      plan_(plan),
      tracer_(faces.tree) {}

void ReflectedLight::find_mirrors() {
  const TriangleMesh& mesh = tree_.mesh();
  std::vector<bool> closed(mesh.patches.size()), planned(mesh.patches.size(), plan_.all());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) closed[mesh.triangle_patch[t]] = mesh.closed(t);
  for (std::size_t axis = 0; axis < axes_.size(); ++axis)
    for (const std::uint32_t patch : plan_.patches(axis)) planned[patch] = true;
  for (std::uint32_t patch = 0; patch < mesh.patches.size(); ++patch)
    if (large_[patch] && planned[patch]) mirrors_.push_back({patch, closed[patch]});
}

std::deque<ReflectedWave> ReflectedLight::waves(int most) {
  find_mirrors();
  const auto lit = [&](const EdgeAxis& axis) { return counts(axis); };
  const auto axes = static_cast<std::size_t>(std::ranges::count_if(axes_, lit));
  std::vector<ReflectedWave> last{{incident_, {}, {}}}, next;
  std::deque<ReflectedWave> all;
  for (int reflection = 0; reflection < most; ++reflection) {
    const std::size_t pairs = axes * last.size() * mirrors_.size();
    if (pairs > most_reflected_pairs) {
      pairs_left_out_ += pairs;
      break;
    }
    next.clear();
    for (const ReflectedWave& before : last)
      for (const Mirror& mirror : mirrors_) {
        const Patch& plane = tree_.mesh().patches[mirror.patch];
        const bool again = !before.patches.empty() && before.patches.back() == mirror.patch;
        if (again || !reflects(plane, mirror.closed, before.wave)) continue;
        ReflectedWave wave{reflected(before.wave, plane), before.patches, {}};
        wave.patches.push_back(mirror.patch);
        next.push_back(wave);
        all.push_back(std::move(wave));
        find_lit(all.back());
        if (all.back().lit.empty()) all.pop_back();
      }
    std::swap(last, next);
  }
  return all;
}

bool ReflectedLight::counts(const EdgeAxis& axis) const { return axis.length >= shortest_axis_ && plan_.has(index_of(axis)); }

void ReflectedLight::find_lit(ReflectedWave& wave) {
  for (const EdgeAxis& axis : axes_) {
    const Wedge& wedge = *axis.wedge;
    if (!counts(axis) || !plan_.has(index_of(axis), wave.patches.back())) continue;
    if (wedge.faces[0].patch == wave.patches.back() || wedge.faces[1].patch == wave.patches.back()) continue;
    const WedgeIncidence incidence = incidence_on(wedge, wave.wave.about(middle_of(axis)).direction);
    const double weight = incidence_weight(wedge, incidence);
    if (weight == 0.0) continue;
    const double aside = border_share * axis.length;
    find_pieces(wave, axis, aside);
    const std::vector<LitPiece> over = pieces_;
    find_pieces(wave, axis, -aside);
    const std::vector<LitPiece> under = pieces_;
    for (const LitPiece& piece : blended(wave, axis, over, under))
      wave.lit.push_back({&axis, &wave.wave, incidence.faces[0], piece.from, piece.to, weight * piece.weight, piece.weight});
  }
}

// What is lit on both sides is lit; what is lit on one counts by where the border lies between them.
std::vector<ReflectedLight::LitPiece> ReflectedLight::blended(const ReflectedWave& wave, const EdgeAxis& axis,
                                                              std::span<const LitPiece> over, std::span<const LitPiece> under) {
  std::vector<double> ends;
  for (const std::span<const LitPiece> side : {over, under})
    for (const LitPiece& piece : side) ends.insert(ends.end(), {piece.from, piece.to});
  std::ranges::sort(ends);
  std::vector<LitPiece> result;
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const double from = ends[i - 1], to = ends[i], middle = (from + to) / 2;
    if (to - from < shortest * wavelength_) continue;
    const auto covers = [&](const LitPiece& piece) { return piece.from <= middle && middle <= piece.to; };
    const bool lit_over = std::ranges::any_of(over, covers), lit_under = std::ranges::any_of(under, covers);
    if (!lit_over && !lit_under) continue;
    const double weight = lit_over && lit_under ? 1.0 : share_of_light(wave, axis, middle, lit_over ? 1.0 : -1.0);
    if (!result.empty() && result.back().weight == 1.0 && weight == 1.0 && from - result.back().to < shortest * wavelength_)
      result.back().to = to;
    else
      result.push_back({from, to, weight});
  }
  return result;
}

// How much of the light is there, from where the border of the beam lies beside this position, searched between the two sides;
// `lit` is the sign of the one that is lit.
double ReflectedLight::share_of_light(const ReflectedWave& wave, const EdgeAxis& axis, double position, double lit) {
  const double aside = border_share * axis.length;
  double bright = 1.0, dark = -1.0;
  for (int halving = 0; halving < 40; ++halving) {
    const double middle = (bright + dark) / 2;
    (reaches(wave, axis, position, lit * middle * aside) ? bright : dark) = middle;
  }
  const double share = (1.0 - bright) / 2;
  return share * share * (3 - 2 * share);
}

// Beams end at the corners of edges more often than close to them.
void ReflectedLight::snap_to_ends(const EdgeAxis& axis) {
  for (LitPiece& piece : pieces_) {
    if (piece.from < shortest * wavelength_) piece.from = 0.0;
    if (axis.length - piece.to < shortest * wavelength_) piece.to = axis.length;
  }
}

// Sideways is along the surface, the same for both faces of the wedge; across the light where that runs along the surface itself,
// so that the two sides of the edge are on different sides of a beam that ends there.
RayFan ReflectedLight::fan_beside(const ReflectedWave& wave, const EdgeAxis& axis, double sideways) const {
  const Wedge& wedge = *axis.wedge;
  const dvec3 over = wedge.faces[0].into_face - wedge.faces[1].into_face;
  const dvec3 across = glm::normalize(glm::cross(axis.tangent, wave.wave.about(middle_of(axis)).direction));
  dvec3 side = wedge.n == 2.0 ? wedge.faces[0].into_face : glm::normalize(over);
  if (std::abs(glm::dot(side, across)) < rounding_of_files) side = across;
  const dvec3 base = axis.origin + sideways * side;
  if (!wave.wave.antennas) return {base, axis.tangent, -wave.wave.direction, 0.0, axis.length};
  const dvec3 way = wave.wave.antennas->transmit.position() - base;
  const double distance = glm::length(way);
  return {base, axis.tangent, way / distance, 0.0, axis.length, -1.0 / distance};
}

void ReflectedLight::find_pieces(const ReflectedWave& wave, const EdgeAxis& axis, double sideways) {
  const Wedge& wedge = *axis.wedge;
  pieces_.clear();
  trace_back(fan_beside(wave, axis, sideways), {wedge.faces[0].patch, wedge.faces[1].patch, wedge.border_patch}, wave.patches);
  snap_to_ends(axis);
}

bool ReflectedLight::reaches(const ReflectedWave& wave, const EdgeAxis& axis, double position, double sideways) {
  const Wedge& wedge = *axis.wedge;
  RayFan narrow = fan_beside(wave, axis, sideways);
  narrow.from = position - shortest * wavelength_;
  narrow.to = position + shortest * wavelength_;
  pieces_.clear();
  trace_back(narrow, {wedge.faces[0].patch, wedge.faces[1].patch, wedge.border_patch}, wave.patches);
  return !pieces_.empty();
}

void ReflectedLight::trace_back(const RayFan& fan, const IgnoredPatches& ignored, std::span<const std::uint32_t> mirrors) {
  if (mirrors.empty()) return keep_clear(fan, ignored);
  const std::uint32_t mirror = mirrors.back();
  std::vector<FanHit> hits;
  tracer_.trace(fan, ignored, hits);
  for (const FanHit& hit : hits)
    if (tree_.faces()[hit.face].patch == mirror)
      trace_back(beyond(fan, hit, tree_.mesh().patches[mirror]), {mirror, no_index, no_index}, mirrors.first(mirrors.size() - 1));
}

// The pieces between what is met; neighbours are one.
void ReflectedLight::keep_clear(const RayFan& fan, const IgnoredPatches& ignored) {
  std::vector<FanHit> hits;
  tracer_.trace(fan, ignored, hits);
  double from = fan.from;
  const auto keep = [&](double to) {
    if (to - from < shortest * wavelength_) return;
    if (!pieces_.empty() && from - pieces_.back().to < shortest * wavelength_)
      pieces_.back().to = to;
    else
      pieces_.push_back({from, to});
  };
  for (const FanHit& hit : hits) {
    keep(hit.from);
    from = hit.to;
  }
  keep(fan.to);
}

}  // namespace raytube
