#include "utd/interaction/pair_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace raytube {

namespace {

constexpr double touching = 1e-5;         // [rad], and in sizes of the face: what files of few digits leave of contact
constexpr double mean_of_root = 8.0 / 3;  // mean of sqrt(far / rho) over a convex face from rho = 0 to far, at most
constexpr double with_slopes = 1.5;       // what the slopes of the waves add to their values, a wavelength away and less

/// A box about an edge: azimuths, and distances from its line [m].
struct AboutEdge {
  double from, to;
  double nearest, farthest;
};

// Corners of the convex hull of points in a plane (Andrew 1979).
std::vector<dvec3> convex_hull(std::vector<dvec3> points, const dvec3& normal) {
  if (points.size() <= 3) return points;
  const dvec3 u = glm::normalize(glm::cross(normal, std::abs(normal.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0))),
              v = glm::cross(normal, u);
  const auto key = [&](const dvec3& p) { return std::pair(glm::dot(p, u), glm::dot(p, v)); };
  std::ranges::sort(points, {}, key);
  std::vector<dvec3> hull;
  for (const bool back : {false, true}) {
    const std::size_t first = hull.size();
    for (const dvec3& p : points) {
      const auto turns_left = [&](const dvec3& a, const dvec3& b) { return glm::dot(normal, glm::cross(b - a, p - b)) > 0.0; };
      while (hull.size() >= first + 2 && !turns_left(hull[hull.size() - 2], hull.back())) hull.pop_back();
      hull.push_back(p);
    }
    if (!hull.empty()) hull.pop_back();
    if (!back) std::ranges::reverse(points);
  }
  return hull.empty() ? points : hull;
}

// Seen from the line a face covers less than half a turn, or the line runs through it. Its nearest point is no nearer than that
// of a straight side between two corners as near as the nearest one.
AboutEdge about_edge(const EdgeAxis& axis, const PatchExtent& box) {
  const WedgeFace& face = axis.wedge->faces[0];
  const auto across = [&](const dvec3& point) {
    return dvec2(glm::dot(point - axis.origin, face.into_face), glm::dot(point - axis.origin, face.normal));
  };
  const dvec2 middle = across(box.centroid);
  AboutEdge result{0.0, 0.0, std::numeric_limits<double>::infinity(), 0.0};
  for (const dvec3& corner : box.outline) {
    const dvec2 at = across(corner);
    const double turn = std::atan2(middle.x * at.y - middle.y * at.x, glm::dot(middle, at)), distance = glm::length(at);
    result.from = std::min(result.from, turn);
    result.to = std::max(result.to, turn);
    result.nearest = std::min(result.nearest, distance);
    result.farthest = std::max(result.farthest, distance);
  }
  if (result.to - result.from >= pi - touching) return {0.0, 2 * pi, 0.0, result.farthest};
  const double azimuth = std::atan2(middle.y, middle.x), size = std::sqrt(box.area);
  result.nearest = std::max(0.0, result.nearest * std::cos((result.to - result.from) / 2) - touching * size);
  result.from += azimuth - touching;
  result.to += azimuth + touching;
  return result;
}

// What of it lies in free space, 0 to n pi; azimuths are the same after a whole turn.
AzimuthRange in_free_space(const AboutEdge& box, double end) {
  AzimuthRange range{std::numeric_limits<double>::infinity(), 0.0};
  for (const double turn : {-2 * pi, 0.0, 2 * pi}) {
    const double from = std::max(box.from + turn, 0.0), to = std::min(box.to + turn, end);
    if (!(from < to)) continue;
    range = {std::min(range.from, from), std::max(range.to, to)};
  }
  return range;
}

bool meets_boundary(const LitEdgePiece& source, const AzimuthRange& range) {
  const double arriving = source.incidence.source_angle, n = source.edge->wedge->n;
  return std::ranges::any_of(std::array{arriving + pi, arriving - pi, pi - arriving, (2 * n - 1) * pi - arriving},
                             [&](double at) { return at > range.from - touching && at < range.to + touching; });
}

// Mean of the waves' sum over a convex face: |W(x)| <= 1 and <= 1 / (sqrt(pi) x) (Abramowitz and Stegun 1964, 7.1.23).
double wave_bound(const LitEdgePiece& source, const AboutEdge& box, const AzimuthRange& range, double k) {
  const double n = source.edge->wedge->n, sine = source.incidence.sin_cone;
  const auto at = [&](double azimuth) { return edge_wave_terms(n, source.incidence.source_angle, azimuth); };
  const EdgeWaveTerms begin = at(range.from), end = at(range.to);
  const bool jumps = meets_boundary(source, range);
  const double root = std::sqrt(pi * k * box.nearest * sine), far_root = std::sqrt(pi * k * box.farthest * sine);
  double sum = 0.0;
  const auto add = [&](const EdgeWaveTerm& a, const EdgeWaveTerm& b) {
    const double strength = std::max(std::abs(a.strength), std::abs(b.strength)), rate = std::min(a.rate, b.rate);
    sum += jumps ? std::max(strength, 0.5) : strength * std::min({1.0, 1.0 / (rate * root), mean_of_root / (rate * far_root)});
  };
  for (int i = 0; i < begin.each; ++i) {
    add(begin.incident[i], end.incident[i]);
    add(begin.reflected[i], end.reflected[i]);
  }
  return sum;
}

// Nothing of the edge's line near the piece stands in front of a face that is met from outside only.
bool only_behind(const LitEdgePiece& source, const Patch& plane, const PatchExtent& face, double beyond) {
  const double front = plane.offset + touching * std::sqrt(face.area);
  for (const double at : {source.from - beyond, source.to + beyond})
    if (glm::dot(plane.normal, source.edge->origin + at * source.edge->tangent) > front) return false;
  return true;
}

// Of the face, as large a part as is in phase: along the edge that over which the phase of neighbouring rays turns by one radian
// (at a fixed azimuth it turns evenly, with the rate of EdgeIllumination), across it a Fresnel zone.
double share_in_phase(const LitEdgePiece& source, const Patch& plane, const PatchExtent& face, const AboutEdge& box,
                      const PairView& view) {
  const dvec3& t = source.edge->tangent;
  const dvec3 middle = face.centroid - source.edge->origin;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const dvec3& corner : face.outline) low = std::min(low, glm::dot(t, corner)), high = std::max(high, glm::dot(t, corner));
  const double least = touching * std::sqrt(face.area);
  const double along = std::max(least, high - low), across = std::max(least, face.area / along);
  const dvec3 upright = middle - glm::dot(middle, t) * t;
  const double distance = glm::length(upright), sine = source.incidence.sin_cone, cosine = source.incidence.cos_cone;
  const dvec3 ray = cosine * t + (distance > 0.0 ? sine / distance : 0.0) * upright;
  const double facing = glm::dot(plane.normal, ray);
  const double growth = std::abs(facing) > touching ? -glm::dot(plane.normal, t) / facing : 0.0;
  const double rate = glm::dot(view.scattered, t + growth * ray) - cosine - growth;
  const double in_phase = 2.0 / (view.wavenumber * std::max(touching, std::abs(rate)));
  const double zone = std::sqrt(2 * pi * box.farthest / view.wavenumber);
  const double lit = std::min(along, source.to - source.from + zone);
  return std::min(lit, in_phase) / along * std::min(1.0, zone / across);
}

}  // namespace

std::vector<double> patch_areas(const TriangleMesh& mesh) {
  std::vector<double> areas(mesh.patches.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) areas[mesh.triangle_patch[t]] += mesh.twice_area(t) / 2;
  return areas;
}

std::vector<PatchExtent> patch_extents(const TriangleMesh& mesh) {
  std::vector<PatchExtent> extents(mesh.patches.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    PatchExtent& extent = extents[mesh.triangle_patch[t]];
    const double area = mesh.twice_area(t) / 2;
    extent.area += area;
    extent.closed = mesh.closed(t);
    for (int c = 0; c < 3; ++c) {
      const dvec3& vertex = mesh.vertices[mesh.triangles[t][c]];
      extent.outline.push_back(vertex);
      extent.centroid += area / 3.0 * vertex;
    }
  }
  for (std::size_t i = 0; i < extents.size(); ++i) {
    extents[i].centroid /= extents[i].area;
    extents[i].outline = convex_hull(std::move(extents[i].outline), mesh.patches[i].normal);
  }
  return extents;
}

// |S| <= (k / 4 pi) integral of |eta J| <= (k / 2 pi) integral of |eta H| over the face, as |2 n x H| <= 2 |H|; each mirror shows
// the same waves to one face more.
PairBound pair_bound(const LitEdgePiece& source, const Patch& plane, const PatchExtent& face, const PairView& view,
                     int reflections) {
  const double beyond = source.to - source.from, k = view.wavenumber;
  if (face.closed && only_behind(source, plane, face, beyond)) return {};
  const AboutEdge box = about_edge(*source.edge, face);
  const AzimuthRange range = in_free_space(box, source.edge->wedge->n * pi);
  if (!(range.from < range.to)) return {};
  const double one = k / (2 * pi) * source.weight * wave_bound(source, box, range, k) * face.area;
  return {with_slopes * (1 + reflections) * one, one * share_in_phase(source, plane, face, box, view), range};
}

// Of a half plane the current along the edge is (2 / jk) E at most, half of it fringe, and S is k / 4 pi times its length
// (Michaeli 1986): both together no more than the length over pi.
double fringe_bound(const LitEdgePiece& source) { return source.weight * (source.to - source.from) / pi; }

}  // namespace raytube
