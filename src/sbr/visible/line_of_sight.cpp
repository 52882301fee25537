#include "sbr/visible/line_of_sight.h"

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

// Of a part of the plane where such a wave begins: no nearer to the receiver than any of it.
double farthest(const Beam& line, const ConvexPolygon& region) {
  const dvec2 slope{glm::dot(line.direction, line.along_u), glm::dot(line.direction, line.along_v)};
  return glm::dot(line.direction, line.base) + range(region, {-glm::dot(slope, line.anchor), slope.x, slope.y}).low;
}

}  // namespace

LineOfSightSheets::LineOfSightSheets(const TriangleMesh& mesh, std::span<const Material> materials, const SphericalBasis& receive)
    : receive_(receive), nearest_(-std::numeric_limits<double>::infinity()) {
  const SpectralSurfaces surfaces{materials, {}};
  box_ = {dvec2(std::numeric_limits<double>::infinity()), dvec2(-std::numeric_limits<double>::infinity())};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!surfaces.transmits(mesh.patches[mesh.triangle_patch[t]].material)) continue;
    for (int c = 0; c < 3; ++c) {
      const dvec3& r = mesh.vertices[mesh.triangles[t][c]];
      box_ = {glm::min(box_.low, across(r)), glm::max(box_.high, across(r))};
      nearest_ = std::max(nearest_, glm::dot(receive.radial, r));
    }
  }
}

std::vector<ScreenedPart> PolygonLineOfSight::through_sheets(std::uint32_t node, const ConvexPolygon& outline) {
  screened_.clear();
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

void PolygonLineOfSight::follow(std::uint32_t node, std::uint32_t patch, const dvec3& base, const ConvexPolygon& region) {
  const Beam line = line_of_sight(sheets_, base, tracer_.mesh().patches[patch]);
  if (!sheets_.may_cover(bounds(region), farthest(line, region))) return;
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

// Of a footprint that the receiver has edge-on.
void PolygonLineOfSight::follow_from_middle(std::uint32_t node, const Beam& leaving, const ConvexPolygon& outline) {
  RayLineOfSight line(sheets_, tracer_);
  line.add(0, node, tube_ray(leaving, middle(outline), nullptr, no_index).origin, beams_.patch_index(node));
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
