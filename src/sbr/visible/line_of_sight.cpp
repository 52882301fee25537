#include "sbr/visible/line_of_sight.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raytube {

namespace {

// From launch coordinates to those of the line of sight.
AffineMap to_line_of_sight(const LineOfSightSheets& sheets, const Beam& beam) {
  const dvec2 along_u = sheets.across(beam.along_u), along_v = sheets.across(beam.along_v);
  return {sheets.across(beam.base) - beam.anchor.x * along_u - beam.anchor.y * along_v, along_u, along_v};
}

// The wave that the receiver would have from a plane. Its launch coordinates are LineOfSightSheets::across.
Beam line_of_sight(const LineOfSightSheets& sheets, const dvec3& base, const Patch& plane) {
  if (sheets.is_near()) return sheets.converging();
  const auto& [radial, theta_hat, phi_hat] = sheets.receive();
  Beam beam;
  beam.direction = radial, beam.u_hat = theta_hat, beam.v_hat = phi_hat;
  const double per_height = 1.0 / glm::dot(radial, plane.normal);
  beam.base = base + radial * ((plane.offset - glm::dot(base, plane.normal)) * per_height);
  beam.anchor = sheets.across(base);
  beam.along_u = theta_hat - radial * (glm::dot(theta_hat, plane.normal) * per_height);
  beam.along_v = phi_hat - radial * (glm::dot(phi_hat, plane.normal) * per_height);
  return beam;
}

// Depth that no point of a part of the plane where such a wave begins exceeds: no nearer to the receiver than any of it.
double farthest(const Beam& line, const Patch& plane, const ConvexPolygon& region) {
  if (line.spherical()) return range(region, depth_of(line, plane)).low;
  const dvec2 slope{glm::dot(line.direction, line.along_u), glm::dot(line.direction, line.along_v)};
  return glm::dot(line.direction, line.base) + range(region, {-glm::dot(slope, line.anchor), slope.x, slope.y}).low;
}

// All that lies before an antenna, about the middle of the mesh.
Beam converging_wave(const Antenna& antenna, const SphericalBasis& receive) {
  const double range = glm::length(antenna.position());
  Beam beam;
  beam.direction = antenna.position() / range;
  beam.u_hat = carried(receive.theta_hat, receive.radial, beam.direction);
  beam.v_hat = carried(receive.phi_hat, receive.radial, beam.direction);
  beam.curvature = -1.0 / range;
  return beam;
}

Affine sum(double a, const Affine& f, double b, const Affine& g) {
  return {a * f.c + b * g.c, a * f.u + b * g.u, a * f.v + b * g.v};
}

// From the launch coordinates in which `beam` has the points of a plane to those of another wave: each of them, and the widening,
// is affine but for a common factor, so that lines go over into lines.
class PlaneView {
 public:
  PlaneView(const Beam& other, const Beam& beam, const Patch& plane) {
    const Affine depth = depth_of(beam, plane),
                 narrowing{1.0 - beam.curvature * depth.c, -beam.curvature * depth.u, -beam.curvature * depth.v};
    const dvec3 step = beam.base - other.base;
    const auto along = [&](const dvec3& axis) {
      const double d = glm::dot(axis, beam.direction);
      return sum(glm::dot(axis, step), narrowing, 1.0,
                 {d * depth.c, d * depth.u + glm::dot(axis, beam.u_hat), d * depth.v + glm::dot(axis, beam.v_hat)});
    };
    u_ = along(other.u_hat), v_ = along(other.v_hat), w_ = sum(1.0, narrowing, other.curvature, along(other.direction));
  }

  dvec2 operator()(const dvec2& at) const { return dvec2(u_(at), v_(at)) / w_(at); }
  /// Zero where the other wave's f is, as the distance to it.
  Affine line(const Affine& f) const { return normalized(sum(1.0, sum(f.c, w_, f.u, u_), f.v, v_)); }

 private:
  Affine u_, v_, w_;
};

// A polygon of points of a plane in the launch coordinates of another wave.
ConvexPolygon seen_by(const Beam& other, const Beam& beam, const Patch& plane, const ConvexPolygon& polygon) {
  const PlaneView there(other, beam, plane), back(beam, other, plane);
  ConvexPolygon result;
  for (const Corner& corner : polygon) result.push_back({there(corner.at), back.line(corner.edge)});
  if (area(result) > 0.0) return result;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    result[i].edge = back.line(polygon[(i + polygon.size() - 1) % polygon.size()].edge);
  std::ranges::reverse(result);
  return result;
}

}  // namespace

LineOfSightSheets::LineOfSightSheets(const TriangleMesh& mesh, std::span<const Material> materials, const SphericalBasis& receive,
                                     const Antenna* antenna)
    : receive_(receive),
      converging_(antenna ? converging_wave(*antenna, receive) : Beam{}),
      nearest_(-std::numeric_limits<double>::infinity()) {
  const SpectralSurfaces surfaces{materials, {}};
  box_ = {dvec2(std::numeric_limits<double>::infinity()), dvec2(-std::numeric_limits<double>::infinity())};
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!surfaces.transmits(mesh.patch_of(t).material)) continue;
    for (int c = 0; c < 3; ++c) {
      const dvec3& r = mesh.vertices[mesh.triangles[t][c]];
      box_ = {glm::min(box_.low, across(r)), glm::max(box_.high, across(r))};
      nearest_ = std::max(nearest_, depth(r));
    }
  }
}

double LineOfSightSheets::depth(const dvec3& r) const {
  if (!is_near()) return glm::dot(receive_.radial, r);
  return glm::dot(converging_.direction, r) / widening(converging_, r);
}

bool LineOfSightSheets::may_cover_any(std::span<const dvec3> points) const {
  Bounds box{dvec2(std::numeric_limits<double>::infinity()), dvec2(-std::numeric_limits<double>::infinity())};
  double farthest = std::numeric_limits<double>::infinity();
  for (const dvec3& r : points) {
    box = {glm::min(box.low, across(r)), glm::max(box.high, across(r))};
    farthest = std::min(farthest, depth(r));
  }
  return may_cover(box, farthest);
}

dvec3 LineOfSightSheets::towards_receiver(const dvec3& r) const {
  return is_near() ? glm::normalize(-converging_.direction / converging_.curvature - r) : receive_.radial;
}

std::vector<ScreenedPart> PolygonLineOfSight::through_sheets(std::uint32_t node, const ConvexPolygon& outline) {
  screened_.clear();
  if (sheets_.is_near()) {
    follow_to_receiver(node, outline);
    return std::move(screened_);
  }
  const Beam leaving = beams_.beam(node);
  const AffineMap there = to_line_of_sight(sheets_, leaving);
  if (std::abs(stretch(there)) <= edge_on * beams_.footprint(node).area) {
    follow_from_middle(node, leaving, outline);
  } else {
    const AffineMap back = inverse(there);
    follow(node, beams_.patch_index(node), leaving.base, image(outline, there, back));
    for (ScreenedPart& part : screened_) part.outline = image(part.outline, back, there);
  }
  return std::move(screened_);
}

// A footprint that is nearly edge-on has all its lines of sight nearly within its plane.
void PolygonLineOfSight::follow_to_receiver(std::uint32_t node, const ConvexPolygon& outline) {
  const Beam leaving = beams_.beam(node);
  const std::uint32_t index = beams_.patch_index(node);
  const Patch& plane = tracer_.mesh().patches[index];
  if (std::abs(facing(sheets_.converging(), plane)) <= edge_on) return follow_from_middle(node, leaving, outline);
  follow(node, index, leaving.base, seen_by(sheets_.converging(), leaving, plane, outline));
  for (ScreenedPart& part : screened_) part.outline = seen_by(leaving, sheets_.converging(), plane, part.outline);
}

void PolygonLineOfSight::follow(std::uint32_t node, std::uint32_t patch, const dvec3& base, const ConvexPolygon& region) {
  const Beam line = line_of_sight(sheets_, base, tracer_.mesh().patches[patch]);
  if (!sheets_.may_cover(bounds(region), farthest(line, tracer_.mesh().patches[patch], region))) return;
  const Ray ray = visible_.middle_ray(line, patch, region);
  Hit in_middle;
  tracer_.closest_hits({&ray, 1}, {&in_middle, 1});
  std::vector<VisiblePart> parts;
  visible_.from_surface(line, patch, region, in_middle, parts);
  for (const VisiblePart& part : parts) {
    const std::uint32_t next = tree_.faces()[part.face].patch;
    const bool sheet = beams_.is_sheet(next);
    const std::uint32_t screened = sheet ? beams_.through_screen(node, next) : node;
    if (sheet) screened_.push_back({screened, part.outline});
    follow(screened, next, line.base, part.outline);
  }
}

// Follows the line of sight from the middle of a footprint that the receiver has edge-on.
void PolygonLineOfSight::follow_from_middle(std::uint32_t node, const Beam& leaving, const ConvexPolygon& outline) {
  RayLineOfSight line(sheets_, tracer_);
  line.add(0, node, tube_ray(leaving, middle(outline), &beams_.patch(node), no_index).origin, beams_.patch_index(node));
  line.through_sheets(beams_, [&](std::uint32_t, std::uint32_t screened) { screened_.push_back({screened, outline}); });
}

void RayLineOfSight::trace() {
  std::vector<Ray> rays;
  for (const Line& line : lines_) rays.push_back(line.ray);
  std::vector<Hit> hits(rays.size());
  tracer_.closest_hits(rays, hits);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    if (!hits[i]) continue;
    const Ray& ray = lines_[i].ray;
    lines_[kept++] = {
        lines_[i].tube,
        lines_[i].node,
        {ray.origin + hits[i].distance * ray.direction, ray.direction, tracer_.mesh().triangle_patch[hits[i].triangle]}};
  }
  lines_.resize(kept);
}

}  // namespace raytube
