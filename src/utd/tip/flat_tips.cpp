#include "utd/tip/flat_tips.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

#include "core/angle.h"
#include "utd/corner/corner_angles.h"
#include "utd/tip/rim_line.h"

namespace raytube {

namespace {

// Noses that are edges at a wavenumber, whatever the target has at lower ones.
std::vector<Nose> noses_at(std::span<const Nose> all, double wavenumber) {
  constexpr double least_edge = 0.01;
  std::vector<Nose> noses;
  std::ranges::copy_if(all, std::back_inserter(noses), [&](const Nose& nose) {
    return nose.radius > 0.0 && nose.facet_share(wavenumber) > 0.0 && nose.edge_share(-nose.outwards, wavenumber) >= least_edge;
  });
  return noses;
}

// [vertex]: 2 pi less the angles of its facets; 0 where others than conducting ones of closed curved surfaces are.
std::vector<double> angle_deficits(const CurvedTarget& target) {
  constexpr double too_much = 1e9;
  const TriangleMesh& mesh = target.tracer.mesh();
  std::vector<double> sums(mesh.vertices.size(), 0.0);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (int c = 0; c < 3; ++c) {
      const dvec3 at = target.corner(t, c), a = target.corner(t, (c + 1) % 3) - at, b = target.corner(t, (c + 2) % 3) - at;
      const bool counts = target.surfaces.region(t) != no_index && target.surfaces.conducts(t) && mesh.closed(t);
      sums[mesh.triangles[t][c]] += counts ? angle_between(a, b) : too_much;
    }
  for (double& sum : sums) sum = sum > 0.0 && sum < too_much ? 2 * pi - sum : 0.0;
  return sums;
}

double length_of(const Rim& rim) { return rim.places.back().distance; }

double first_curvature(const Rim& rim) {
  double turn = 0.0, length = 0.0;
  for (const RimPlace& place : rim.places)
    if (length == 0.0 || 4 * place.distance < length_of(rim)) turn += place.curvature * place.step, length += place.step;
  return turn / length;
}

// Whether a rim comes by a position in its first half; in its second one it may come back.
bool passes(const Rim& rim, const dvec3& position) {
  return std::ranges::any_of(rim.places, [&](const RimPlace& p) {
    return 2 * p.distance < length_of(rim) && glm::distance(p.position, position) < p.step;
  });
}

// The two longest of the rims that noses seem to point along.
std::vector<Rim> two_rims(const RimTracer& tracer, const dvec3& position) {
  std::vector<Rim> rims;
  for (const dvec3& direction : tracer.directions_from(position)) {
    Rim rim{tracer.trace(position, direction), 0.0, {}};
    if (rim.places.empty()) continue;
    rim.curvature = first_curvature(rim);
    const dvec3& far = rim.places[rim.places.size() / 4].position;
    if (std::ranges::none_of(rims, [&](const Rim& other) { return passes(other, far); })) rims.push_back(std::move(rim));
  }
  std::ranges::stable_sort(rims, std::greater(), length_of);
  if (rims.size() < 2 || (rims.size() > 2 && length_of(rims[2]) > 0.5 * length_of(rims[1]))) return {};
  rims.resize(2);
  return rims;
}

// The tip is solved as the corner of a sheet.
std::optional<FlatTip> tip_at(const RimTracer& tracer, const dvec3& position) {
  std::vector<Rim> rims = two_rims(tracer, position);
  if (rims.empty()) return std::nullopt;
  const dvec3 a = -rims[0].places.front().tangent, b = -rims[1].places.front().tangent;
  const double angle = angle_between(a, b);
  if (angle < least_corner || angle > greatest_corner) return std::nullopt;
  return FlatTip{
      position, glm::normalize(a + b), glm::normalize(glm::cross(b, a)), angle, {std::move(rims[0]), std::move(rims[1])}};
}

// The tip near which a rim ends, within 0.15 of the rim's length, and the rim along which it comes there.
std::optional<RimEnd> end_of(std::span<const FlatTip> tips, const Rim& rim) {
  const RimPlace& last = rim.places.back();
  for (std::uint32_t i = 0; i < tips.size(); ++i) {
    const dvec3 way = tips[i].position - last.position;
    const double gap = glm::length(way);
    if (gap > 0.15 * last.distance) continue;
    const std::uint32_t side = glm::dot(tips[i].across(0), -way) > 0.0 ? 0 : 1;
    return RimEnd{i, side, last.distance + gap};
  }
  return std::nullopt;
}

// A rim has one length, whichever tip it is followed from.
void join(std::vector<FlatTip>& tips) {
  for (FlatTip& tip : tips)
    for (Rim& rim : tip.rims) rim.end = end_of(tips, rim);
  for (std::uint32_t i = 0; i < tips.size(); ++i)
    for (std::uint32_t a = 0; a < 2; ++a) {
      std::optional<RimEnd>& there = tips[i].rims[a].end;
      if (!there) continue;
      std::optional<RimEnd>& back = tips[there->tip].rims[there->rim].end;
      if (back && back->tip == i && back->rim == a)
        there->length = back->length = 0.5 * (there->length + back->length);
      else
        there.reset();
    }
}

}  // namespace

// The facets round a tip's vertex leave 60 degrees of a full turn, at least.
std::vector<FlatTip> find_flat_tips(const CurvedTarget& target, double wavelength) {
  std::vector<FlatTip> tips;
  const std::vector<Nose> noses = noses_at(target.noses, 2 * pi / wavelength);
  if (noses.empty()) return tips;
  const RimTracer tracer(noses, wavelength);
  const std::vector<double> deficits = angle_deficits(target);
  for (std::size_t v = 0; v < deficits.size(); ++v)
    if (deficits[v] >= 60 * degree)
      if (std::optional<FlatTip> tip = tip_at(tracer, target.tracer.mesh().vertices[v])) tips.push_back(std::move(*tip));
  join(tips);
  return tips;
}

}  // namespace raytube
