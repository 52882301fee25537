#include "point_source/source_visibility.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace raytube {

namespace {

// A triangle as the eye sees it.
struct Blocker {
  std::uint32_t triangle, patch;
  Shadow cone;
  HalfSpace beyond;  // the far side of its plane
};

SpatialPolygon corners_of(const TriangleMesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return {mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
}

// Only what lies ahead of the plane that parallel rays start from.
SpatialPolygon ahead_of_start(const TriangleMesh& mesh, const Eye& eye, std::uint32_t triangle, double tolerance) {
  SpatialPolygon all = corners_of(mesh, triangle);
  if (!eye.direction) return all;
  SpatialPolygon ahead, behind;
  cut(all, {*eye.direction, glm::dot(*eye.direction, eye.position)}, tolerance, ahead, behind);
  return ahead;
}

HalfSpace beyond(const Patch& plane, const Eye& eye, const dvec3& on_plane) {
  const double sense = glm::dot(plane.normal, eye.ray_at(on_plane)) > 0.0 ? 1.0 : -1.0;
  return {sense * plane.normal, sense * plane.offset};
}

class SourceVisibility {
 public:
  SourceVisibility(const TriangleMesh& mesh, const Eye& eye) : mesh_(mesh), eye_(eye), tolerance_(cut_tolerance(mesh, eye)) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) add_blocker(t);
  }

  std::vector<SpatialPolygon> pieces_of(std::uint32_t triangle) const {
    std::vector<SpatialPolygon> pieces{ahead_of_start(mesh_, eye_, triangle, tolerance_)};
    if (pieces[0].empty() || !shadow(eye_, pieces[0], tolerance_)) return {};
    const SpatialPolygon whole = pieces[0];
    for (const Blocker& blocker : blockers_) {
      if (blocker.patch == mesh_.triangle_patch[triangle] || blocker.cone.misses(whole, tolerance_)) continue;
      const Relation relation = relation_of(blocker, triangle, whole);
      if (relation != Relation::in_front) subtract(blocker, relation == Relation::behind, pieces);
      if (pieces.empty()) break;
    }
    return pieces;
  }

 private:
  enum class Relation { in_front, partly_behind, behind };

  void add_blocker(std::uint32_t triangle) {
    const SpatialPolygon outline = ahead_of_start(mesh_, eye_, triangle, tolerance_);
    if (outline.empty()) return;
    const std::uint32_t patch = mesh_.triangle_patch[triangle];
    if (auto cone = shadow(eye_, outline, tolerance_))
      blockers_.push_back({triangle, patch, std::move(*cone), beyond(mesh_.patches[patch], eye_, middle(outline))});
  }

  Relation relation_of(const Blocker& blocker, std::uint32_t triangle, const SpatialPolygon& whole) const {
    bool any_behind = false, any_in_front = false;
    for (const dvec3& corner : whole) {
      const double depth = blocker.beyond(corner);
      any_behind |= depth > tolerance_;
      any_in_front |= depth < -tolerance_;
    }
    if (any_behind) return any_in_front ? Relation::partly_behind : Relation::behind;
    const bool coincident = !any_in_front;
    return coincident && blocker.triangle < triangle ? Relation::behind : Relation::in_front;
  }

  // Keeps what lies outside one of the blocker's sides, or in front of its plane.
  void subtract(const Blocker& blocker, bool all_behind, std::vector<SpatialPolygon>& pieces) const {
    std::vector<SpatialPolygon> left;
    for (SpatialPolygon& piece : pieces) {
      if (blocker.cone.misses(piece, tolerance_)) {
        left.push_back(std::move(piece));
        continue;
      }
      SpatialPolygon inside, outside;
      const auto keep_outside = [&](const HalfSpace& side) {
        cut(piece, side, tolerance_, inside, outside);
        if (!outside.empty()) left.push_back(outside);
        piece = inside;
      };
      if (!all_behind) keep_outside(blocker.beyond);
      for (auto side = blocker.cone.sides.begin(); side != blocker.cone.sides.end() && !piece.empty(); ++side)
        keep_outside(*side);
    }
    pieces = std::move(left);
  }

  const TriangleMesh& mesh_;
  const Eye& eye_;
  double tolerance_;
  std::vector<Blocker> blockers_;
};

}  // namespace

bool Shadow::misses(std::span<const dvec3> corners, double tolerance) const {
  return std::ranges::any_of(sides, [&](const HalfSpace& side) {
    return std::ranges::all_of(corners, [&](const dvec3& corner) { return side(corner) <= tolerance; });
  });
}

std::optional<Shadow> shadow(const Eye& eye, const SpatialPolygon& polygon, double tolerance) {
  Shadow found;
  const dvec3 inside = middle(polygon);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const dvec3 &a = polygon[i], &b = polygon[i + 1 < polygon.size() ? i + 1 : 0];
    const dvec3 across = glm::cross(eye.ray_at(a), b - a);
    const double length = glm::length(across);
    // An edge as short as rounding, or along the rays, says nothing about the plane it lies in.
    if (length <= 100.0 * tolerance * glm::length(eye.ray_at(a))) continue;
    HalfSpace side{across / length, glm::dot(across, a) / length};
    if (side(inside) < 0.0) side = {-side.normal, -side.offset};
    if (side(inside) <= tolerance) return std::nullopt;
    found.sides.push_back(side);
  }
  if (found.sides.size() < 3) return std::nullopt;
  return found;
}

SpatialPolygon clipped(SpatialPolygon polygon, const Shadow& shadow, double tolerance) {
  if (shadow.misses(polygon, tolerance)) return {};
  SpatialPolygon inside, outside;
  for (const HalfSpace& side : shadow.sides) {
    cut(polygon, side, tolerance, inside, outside);
    if (inside.empty()) return {};
    polygon = inside;
  }
  return polygon;
}

double cut_tolerance(const TriangleMesh& mesh, const Eye& eye) {
  return 1e-11 * std::max(mesh.radius, glm::length(eye.position));
}

std::vector<VisiblePiece> visible_pieces(const TriangleMesh& mesh, const Eye& eye) {
  const SourceVisibility seeing(mesh, eye);
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  std::vector<std::vector<SpatialPolygon>> pieces(count);
  tbb::parallel_for(0u, count, [&](std::uint32_t triangle) { pieces[triangle] = seeing.pieces_of(triangle); });
  std::vector<VisiblePiece> visible;
  for (std::uint32_t triangle = 0; triangle < count; ++triangle)
    for (SpatialPolygon& piece : pieces[triangle]) visible.push_back({triangle, std::move(piece), {}});
  find_borders(mesh, 100.0 * cut_tolerance(mesh, eye), visible);
  return visible;
}

}  // namespace raytube
