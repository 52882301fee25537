// Scenes of several parts in memory, and the six launch models on them.
#pragma once

#include <vector>

#include "point_source/launch_limit.h"
#include "point_source/ray_hits.h"

namespace raytube::testing {

inline const LaunchModel all_models[] = {LaunchModel::random,   LaunchModel::angles,     LaunchModel::octahedron,
                                         LaunchModel::box_grid, LaunchModel::plane_wave, LaunchModel::geometry};

/// Parts joined, in metres; points and boxes are given in the same coordinates as the soups.
struct SourceScene {
  explicit SourceScene(const std::vector<PolygonSoup>& soups, std::vector<RaySurface> kinds = {})
      : joined(join(soups)),
        surfaces(kinds.empty() ? std::vector(soups.size(), RaySurface::pec) : std::move(kinds)),
        tracer(joined.mesh) {}

  static JoinedMesh join(const std::vector<PolygonSoup>& soups) {
    std::vector<TriangleMesh> meshes;
    for (const PolygonSoup& soup : soups) meshes.push_back(build_mesh(soup, 1.0).mesh);
    return join_meshes(meshes);
  }

  LaunchSite site(const dvec3& source, const Box& box) const {
    return {&joined.mesh, {box.low - joined.mesh.center, box.high - joined.mesh.center}, source - joined.mesh.center, 0, 1e-9};
  }
  LaunchSite site(const dvec3& source) const {
    Box box = bounding_box(joined.mesh.vertices);
    return site(source, {box.low + joined.mesh.center, box.high + joined.mesh.center});
  }

  Launch launch(LaunchModel model, const LaunchSite& at, std::uint64_t rays, std::uint64_t seed = 1) const {
    return Launch(model, at, rays, seed);
  }

  /// Keeps the hits on the part `counted`.
  RayHits trace(const Launch& launch, int max_reflections = 10, std::size_t counted = 0, int threads = 2) const {
    return trace_rays(tracer, joined.triangle_part, surfaces, launch, {max_reflections, counted, true, threads, {}});
  }

  std::vector<LaunchLimit> limits(const Launch& launch) const {
    return launch_limits(launch, visible_pieces(joined.mesh, launch.eye()), joined.triangle_part, surfaces.size(),
                         cut_tolerance(joined.mesh, launch.eye()));
  }

  /// The share of the full solid angle in which each part is visible.
  std::vector<double> exact(const dvec3& source) const {
    const dvec3 from = source - joined.mesh.center;
    std::vector<double> shares(surfaces.size(), 0.0);
    for (const VisiblePiece& piece : visible_pieces(joined.mesh, {from, {}}))
      shares[joined.triangle_part[piece.triangle]] += solid_angle(piece.outline, from) / (4.0 * pi);
    return shares;
  }

  JoinedMesh joined;
  std::vector<RaySurface> surfaces;
  Tracer tracer;
};

/// A rectangle in the plane x = `x`, y and z from `low` to `high`.
inline PolygonSoup plate_across_x(double x, const dvec2& low, const dvec2& high) {
  return {{{x, low.x, low.y}, {x, high.x, low.y}, {x, high.x, high.y}, {x, low.x, high.y}}, {{0, 1, 2}, {0, 2, 3}}};
}

inline PolygonSoup moved(PolygonSoup soup, const dvec3& by) {
  for (dvec3& p : soup.points) p += by;
  return soup;
}

}  // namespace raytube::testing
