#include "utd/surface/noses.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "utd/surface/surface_ray.h"
#include "utd/wedge/rounding_guard.h"

namespace raytube {

namespace {

// The largest k rho over edge_radius of a bend that counts: narrowness() is 1 % there.
constexpr double most_radii = 3.0;
// The least curvature, over the largest one of its section, that is still part of the bend.
constexpr double flattest = 0.06;

dvec2 facet_middle() { return dvec2(1.0 / 3); }

// A point of a section: the angle of its normal in the section's plane, its curvature, and the angle since the last one.
struct Sample {
  dvec3 position;
  std::uint32_t triangle;
  double angle, curvature, turn;
};

// Fades bends out before they are so round that find_noses() leaves them out.
double bent_share(double wavenumber, double radius) {
  return std::clamp(most_radii - wavenumber * radius / edge_radius, 0.0, 1.0);
}

// The way from a facet along its section, as far as that bends.
struct SectionWalk {
  std::vector<Sample> samples;
  double angle = 0.0, least = std::numeric_limits<double>::infinity(), most = 0.0;
  bool round = false;  // like a cylinder
};

struct Principal {
  dvec3 direction;  // in which the curvature is `larger`
  double larger, smaller;
};

Principal principal_at(const SurfaceFrame& frame) {
  const dvec3 u = glm::normalize(glm::cross(frame.normal, std::abs(frame.normal.x) < 0.8 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
  const dvec3 v = glm::cross(frame.normal, u);
  const double uu = frame.curvature(u), vv = frame.curvature(v), uv = glm::dot(u, frame.turn(v));
  const double half = 0.5 * (uu - vv), radius = std::hypot(half, uv), angle = 0.5 * std::atan2(uv, half);
  return {std::cos(angle) * u + std::sin(angle) * v, 0.5 * (uu + vv) + radius, 0.5 * (uu + vv) - radius};
}

class NoseFinder {
 public:
  NoseFinder(const TriangleMesh& mesh, const SmoothSurfaces& surfaces, const CurvatureField& curvatures, double wavenumber)
      : mesh_(mesh), surfaces_(surfaces), curvatures_(curvatures), wavenumber_(wavenumber) {}

  Nose at(const FacetPoint& start) const {
    const SurfaceFrame frame = curvatures_.at(start.triangle, start.l);
    const Principal principal = principal_at(frame);
    if (most_radii * edge_radius * principal.larger < wavenumber_ || principal.smaller > 0.5 * principal.larger) return {};
    const Plane plane{frame.normal, principal.direction};
    const SectionWalk behind = walk(start, plane, -1.0);
    if (behind.samples.empty() || behind.round) return {};
    const SectionWalk ahead = walk(start, plane, 1.0);
    if (ahead.samples.empty() || ahead.round) return {};
    const std::vector<Sample> samples = joined(behind, ahead);
    Nose nose = fit(bent_part(samples), plane);
    if (nose.radius <= 0.0 || wavenumber_ * nose.radius >= edge_radius) return {};
    nose.evenness = evenness(start.triangle, nose, plane);
    if (!(nose.evenness > 0.0)) return {};  // nor of a facet too thin to have a gradient
    nose.triangle = start.triangle;
    nose.turn = turn_of(start.triangle, plane.across);
    nose.facet_radius = 1.0 / principal.larger;
    return nose;
  }

 private:
  // Angles are from its normal towards `across`.
  struct Plane {
    dvec3 normal, across;
    double angle(const dvec3& n) const { return std::atan2(glm::dot(n, across), glm::dot(n, normal)); }
  };

  // The walk is over 400 facets at most.
  SectionWalk walk(const FacetPoint& start, const Plane& plane, double way) const {
    Geodesic geodesic(curvatures_, start, way * plane.across);
    GeodesicPiece piece;
    SectionWalk walked;
    for (int i = 0; i < 400 && geodesic.next(piece); ++i)
      if (!add(walked, piece, plane)) return walked;
    return walked;
  }

  // False at the end of the bend, which is no longer than 100 degrees, and where it is found to be round. Over 60 degrees a
  // section of least_flattening loses at least e/4 of kappa^(2/3): one that loses less is round.
  bool add(SectionWalk& walked, const GeodesicPiece& piece, const Plane& plane) const {
    const dvec2 l = 0.5 * (piece.from.l + piece.to);
    const BentFacet facet = surfaces_.facet(piece.from.triangle);
    const SurfaceFrame frame = curvatures_.at(piece.from.triangle, l), end = curvatures_.at(piece.from.triangle, piece.to);
    const dvec3 along = glm::normalize(piece.direction - glm::dot(piece.direction, frame.normal) * frame.normal);
    const double turn = std::remainder(plane.angle(end.normal) - walked.angle, 2 * pi), curvature = frame.curvature(along);
    walked.least = std::min(walked.least, curvature), walked.most = std::max(walked.most, curvature);
    if (curvature <= flattest * walked.most || std::abs(walked.angle) > 100 * degree) return false;
    walked.samples.push_back({facet.point(l), piece.from.triangle, walked.angle + turn / 2, curvature, std::abs(turn)});
    walked.angle += turn;
    const double steadiest = std::pow(1.0 - least_flattening / 4, 1.5);
    walked.round = std::abs(walked.angle) > 60 * degree && walked.least > steadiest * walked.most;
    return !walked.round;
  }

  static std::vector<Sample> joined(const SectionWalk& behind, const SectionWalk& ahead) {
    std::vector<Sample> samples(behind.samples.rbegin(), behind.samples.rend());
    std::ranges::copy(ahead.samples, std::back_inserter(samples));
    return samples;
  }

  // The part of a section that bends, by the curvature alone, so that a nose is the same for all waves.
  static std::vector<Sample> bent_part(const std::vector<Sample>& samples) {
    const double least = flattest * std::ranges::max(samples, {}, &Sample::curvature).curvature;
    const auto bent = [&](const Sample& s) { return s.curvature > least; };
    const auto first = std::ranges::find_if(samples, bent), last = std::find_if(samples.rbegin(), samples.rend(), bent).base();
    return {first, last};
  }

  // kappa^(2/3) = rho^(-2/3) (1 - e sin^2(theta - theta_0)), least squares over theta of its three terms 1, cos and sin 2 theta.
  // The section goes on by 0.35 rad at least on either side of its nose.
  Nose fit(std::span<const Sample> samples, const Plane& plane) const {
    glm::dmat3 left(0.0);
    dvec3 right(0.0);
    for (const Sample& sample : samples) {
      const dvec3 terms(1.0, std::cos(2 * sample.angle), std::sin(2 * sample.angle));
      left += sample.turn * glm::outerProduct(terms, terms);
      right += sample.turn * std::cbrt(sample.curvature * sample.curvature) * terms;
    }
    if (!(std::abs(glm::determinant(left)) > 1e-9)) return {};
    const dvec3 c = glm::inverse(left) * right;
    const double swing = std::hypot(c.y, c.z), top = c.x + swing, centre = 0.5 * std::atan2(c.z, c.y);
    if (top <= 0.0 || centre - 0.35 < samples.front().angle || centre + 0.35 > samples.back().angle) return {};
    Nose nose;
    nose.radius = std::pow(top, -1.5);
    nose.flattening = 2 * swing / top;
    if (nose.flattening < least_flattening) return {};
    nose.angle = -centre;
    const auto after = std::ranges::find_if(samples, [&](const Sample& s) { return s.angle > centre; });
    const Sample &a = after[-1], &b = after[0];
    const double share = (centre - a.angle) / std::max(b.angle - a.angle, 1e-12);
    nose.position = glm::mix(a.position, b.position, share);
    nose.outwards = std::cos(centre) * plane.normal + std::sin(centre) * plane.across;
    nose.along = glm::cross(plane.normal, plane.across);
    const SurfaceFrame there = curvatures_.at(b.triangle, facet_middle());
    nose.bend = there.curvature(nose.along) * nose.radius;
    return nose;
  }

  /// 1 where the nose's radius grows by less than a tenth of the way along the edge, none from a quarter on, as on round cones,
  /// which have no edges. Sections of a body that tapers are alike, so that any facet's curvature tells.
  double evenness(std::uint32_t triangle, const Nose& nose, const Plane& plane) const {
    const Triangle& t = mesh_.triangles[triangle];
    const dvec3 origin = mesh_.vertices[t[0]], u = mesh_.vertices[t[1]] - origin, v = mesh_.vertices[t[2]] - origin;
    const auto curvature = [&](const dvec2& l) { return curvatures_.at(triangle, l).curvature(plane.across); };
    const double here = curvature({0, 0}), along_u = curvature({1, 0}) - here, along_v = curvature({0, 1}) - here;
    const dvec3 normal = glm::cross(u, v);
    const dvec3 gradient = (along_u * glm::cross(v, normal) + along_v * glm::cross(normal, u)) / glm::dot(normal, normal);
    const double mean = here + (along_u + along_v) / 3.0;
    const double growth = mean > 0.0 ? nose.radius * std::abs(glm::dot(gradient, nose.along)) / mean : 1.0;
    return std::clamp((0.25 - growth) / 0.15, 0.0, 1.0);
  }

  // INT across . (dn/dr) across dA from the normals at its corners.
  double turn_of(std::uint32_t triangle, const dvec3& across) const {
    const Triangle& t = mesh_.triangles[triangle];
    const dvec3 &a = mesh_.vertices[t[0]], &b = mesh_.vertices[t[1]], &c = mesh_.vertices[t[2]];
    const dvec3 twice = glm::cross(b - a, c - a);
    const double size = glm::length(twice);
    if (size <= 0.0) return 0.0;
    const dvec3 normal = twice / size;
    double sum = 0.0;
    const std::array<dvec3, 3> opposite{c - b, a - c, b - a};
    for (int i = 0; i < 3; ++i)
      sum += 0.5 * glm::dot(surfaces_.normal(triangle, i), across) * glm::dot(glm::cross(normal, opposite[i]), across);
    return sum;
  }

  const TriangleMesh& mesh_;
  const SmoothSurfaces& surfaces_;
  const CurvatureField& curvatures_;
  double wavenumber_;
};

/// A slice of a facet across a direction.
struct Slice {
  dvec2 middle;
  double ahead;  // how far its middle is ahead of the facet's [m]
  double area;   // over that of the facet
};

double weighted(const dvec3& at_corners, const dvec2& l) { return glm::dot(at_corners, dvec3(1.0 - l.x - l.y, l)); }

// Cuts a facet into slices of equal thickness.
std::vector<Slice> slices(const dvec3& along_at_corners, double thickest) {
  constexpr std::array<dvec2, 3> corners{dvec2(0, 0), dvec2(1, 0), dvec2(0, 1)};
  std::array<int, 3> order{0, 1, 2};
  std::ranges::sort(order, {}, [&](int corner) { return along_at_corners[corner]; });
  const double low = along_at_corners[order[0]], between = along_at_corners[order[1]], high = along_at_corners[order[2]];
  const int count = static_cast<int>(part_count((high - low) / thickest));
  const auto on = [&](int from, int to, double u) {
    const double a = along_at_corners[from], b = along_at_corners[to];
    return glm::mix(corners[from], corners[to], b > a ? (u - a) / (b - a) : 0.5);
  };
  std::vector<Slice> result;
  double sum = 0.0;
  for (int i = 0; i < count; ++i) {
    const double u = glm::mix(low, high, (i + 0.5) / count);
    const dvec2 one = on(order[0], order[2], u), other = u < between ? on(order[0], order[1], u) : on(order[1], order[2], u);
    result.push_back({0.5 * (one + other), u - weighted(along_at_corners, facet_middle()), glm::distance(one, other)});
    sum += result.back().area;
  }
  for (Slice& slice : result) slice.area /= sum;
  return result;
}

}  // namespace

double narrowness(double wavenumber, double radius) {
  const double x = wavenumber * radius / edge_radius;
  return 1.0 / (1.0 + x * x * x * x);
}

double Nose::radius_at(double theta) const {
  const double s = std::sin(theta), square = 1.0 - flattening * s * s;
  return square <= 0.0 ? std::numeric_limits<double>::infinity() : radius / std::pow(square, 1.5);
}

// The source's angle from the nose, across the edge, reaches pi/2 - flank in the plane of a flank; over 20 degrees before that
// waves go on into the dark, and the edge fades. It fades, too, as k rho rises from 3/4 of edge_radius to all of it. A body whose
// flanks would begin at sin^2(theta) = 1.3 counts half as one with flanks.
double Nose::edge_share(const dvec3& incident, double wavenumber) const {
  const double across = sine_to(incident), whole = wavenumber * radius / edge_radius, x = across * whole;
  if (x <= 0.0 || whole >= 1.0) return 0.0;
  const double sharp = evenness * straightness(incident) * std::min((1.0 - whole) / 0.25, 1.0);
  const double square = (1.0 - std::cbrt(x * x)) / flattening, eighth = std::pow(square / 1.3, 8);
  const double grazing = pi / 2 - std::asin(std::min(std::sqrt(square), std::sin(steepest_flank)));
  const double off = std::acos(std::clamp(-glm::dot(incident, outwards) / across, -1.0, 1.0));
  const double lit = std::clamp((grazing - off) / std::min(20 * degree, grazing), 0.0, 1.0);
  return sharp * lit / (1.0 + eighth);
}

double Nose::edge_share(const dvec3& incident, const dvec3& scattered, double wavenumber) const {
  const double in = edge_share(incident, wavenumber), out = edge_share(-scattered, wavenumber);
  return in > 0.0 && out > 0.0 ? 2.0 * in * out / (in + out) : 0.0;
}

double Nose::straightness(const dvec3& ray) const {
  const double across = sine_to(ray);
  return across > 0.0 ? 1.0 / (1.0 + std::pow(4.0 * bend / (across * across), 4)) : 0.0;
}

double Nose::facet_share(double wavenumber, double sine) const {
  return narrowness(wavenumber * sine, radius_at(angle)) * bent_share(wavenumber, facet_radius);
}

double Nose::shared_turn(double wavenumber) const {
  constexpr int points = 64;
  double sum = 0.0;
  for (int i = 0; i < points; ++i) {
    const double there = radius_at(pi / 2 * (i + 0.5) / points);
    sum += narrowness(wavenumber, there) * bent_share(wavenumber, there);
  }
  return sum * pi / points;
}

std::vector<Nose> find_noses(const TriangleMesh& mesh, const SmoothSurfaces& surfaces, const CurvatureField& curvatures,
                             double wavenumber) {
  if (!std::isfinite(wavenumber)) return {};
  const NoseFinder finder(mesh, surfaces, curvatures, wavenumber);
  std::vector<Nose> noses;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!surfaces.conducts(t) || !mesh.closed(t)) continue;
    const Nose nose = finder.at({t, facet_middle()});
    if (nose.radius > 0.0) noses.push_back(nose);
  }
  return noses;
}

std::vector<Nose> noses_in_parts(const TriangleMesh& mesh, const SmoothSurfaces& surfaces, const CurvatureField& curvatures,
                                 double wavenumber, std::span<const Nose> noses, double longest) {
  const NoseFinder finder(mesh, surfaces, curvatures, wavenumber);
  std::vector<Nose> parts;
  for (const Nose& whole : noses) {
    const std::uint32_t t = whole.triangle;
    dvec3 along;
    for (int c = 0; c < 3; ++c) along[c] = glm::dot(whole.along, mesh.vertices[mesh.triangles[t][c]]);
    const std::vector<Slice> cut = slices(along, longest);
    for (const Slice& slice : cut) {
      Nose part = cut.size() == 1 ? whole : finder.at({t, slice.middle});
      if (part.radius <= 0.0) {
        part = whole;
        part.position += slice.ahead * whole.along;
      }
      part.turn = slice.area * whole.turn;
      parts.push_back(part);
    }
  }
  return parts;
}

}  // namespace raytube
