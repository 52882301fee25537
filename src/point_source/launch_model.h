// Ray sources other than the tube grid of a look: six ways to spread rays over the directions from a point.
#pragma once

#include <span>

#include "mesh/model/geometry.h"
#include "mesh/trace/tracer.h"
#include "point_source/source_study.h"
#include "point_source/source_visibility.h"

namespace raytube {

/// A plane piece cut into equal cells, each with a ray through it, next to the middle (beside_u, beside_v): a rectangle of
/// columns x rows, or a triangle of columns^2 small ones.
struct LaunchFace {
  dvec3 corner, side_u, side_v;
  bool is_triangle = false;
  std::uint32_t columns = 1, rows = 1;
  std::uint32_t aimed = no_index;  // the triangle of the scene it is, if it is one

  std::uint64_t cells() const { return std::uint64_t{columns} * (is_triangle ? columns : rows); }
  double area() const { return (is_triangle ? 0.5 : 1.0) * glm::length(glm::cross(side_u, side_v)); }
  SpatialPolygon outline() const;
};

/// The surroundings of a launch, in recentred coordinates.
struct LaunchSite {
  const TriangleMesh* mesh;
  Box box;           // encloses mesh and source
  dvec3 source;      // inside the box
  int wall = 0;      // of the box, from which a plane wave starts: 0 to 5 for -x, +x, -y, +y, -z, +z
  double tolerance;  // [m] closer than this to a wall the source lies on it
};

/// One ray of a launch.
struct LaunchedRay {
  std::uint64_t index;
  Ray ray;
  dvec3 through;                   // a point of it: what is drawn as its launch point
  std::uint32_t face = 0;          // of the launch, if it has faces
  std::uint32_t aimed = no_index;  // the triangle that its weight belongs to; no_index: whatever it meets
};

/// All rays of one launch, made one by one from their index.
class Launch {
 public:
  /// About `asked` rays: as many as the model's pattern has nearest to that. Throws InputError if the source lies on the box or
  /// outside it, where the model needs it inside, or if the wall of a plane wave has no area.
  Launch(LaunchModel model, const LaunchSite& site, std::uint64_t asked, std::uint64_t seed);

  LaunchModel model() const { return model_; }
  const Eye& eye() const { return eye_; }
  std::uint64_t rays() const { return rays_; }
  std::span<const LaunchFace> faces() const { return faces_; }
  std::uint32_t elevation_steps() const { return elevation_steps_; }  // of LaunchModel::angles; twice as many of azimuth

  LaunchedRay ray(std::uint64_t index) const;

  /// The share of the full solid angle that a ray stands for; of parallel rays not_known.
  double weight(const LaunchedRay& launched) const;

 private:
  struct Cell {
    std::uint32_t face;
    std::array<dvec3, 4> corners;  // of a triangle the first three
    dvec3 through;                 // a point of the ray: beside the middle
  };

  void use(std::vector<LaunchFace> faces);
  Cell cell(std::uint64_t index) const;
  dvec3 random_point(std::uint64_t index, std::uint32_t& face) const;
  dvec3 through(std::uint64_t index, std::uint32_t& face) const;
  double random_weight(const LaunchedRay& launched) const;
  double area() const;

  LaunchModel model_;
  Eye eye_;
  std::uint64_t rays_ = 0, seed_;
  std::uint32_t elevation_steps_ = 0;
  std::vector<LaunchFace> faces_;
  std::vector<std::uint64_t> first_ray_;  // of each face
  std::vector<double> area_before_;       // of all faces before it
};

/// The six walls of a box as launch faces of one cell.
std::array<LaunchFace, 6> walls_of(const Box& box);

}  // namespace raytube
