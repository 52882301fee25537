// Curved surfaces behind a tessellation: which facets stand for one, and what it looks like near a point.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "mesh/model/triangle_mesh.h"
#include "mesh/smooth/creases.h"

namespace raytube {

/// A surface to second order about `point`: normal . X = X . curvature X / 2, X = r - point. The entry of `curvature` along the
/// normal is free at this order; it is the stronger principal curvature, which makes spheres and round cylinders exact.
struct LocalSurface {
  dvec3 point;           // recentred coordinates [m]
  dvec3 normal;          // unit, against the ray that asked
  glm::dmat3 curvature;  // symmetric [1/m]; negative where the surface bends away from the normal
};

/// A point of a curved surface, by the facet's point it lies over.
struct SurfacePoint {
  dvec3 point, normal;  // normal on the side the facet's points to
  double stretch;       // area of the surface per area of the facet
};

/// A triangle whose sides bend: r = sum l_i x_i - l0 l1 b0 - l1 l2 b1 - l2 l0 b2, l0 = 1 - l1 - l2 (Nagata 2005, Simple local
/// interpolation of surfaces using normal vectors, eq. 20, with the sides' bends along their mean normals).
class BentFacet {
 public:
  /// Corners x_i and the bends b_i of the sides from x_i to the next corner [m].
  BentFacet(const std::array<dvec3, 3>& corners, const std::array<dvec3, 3>& bends) : x_(corners), b_(bends) {}

  /// The corners x_i.
  const std::array<dvec3, 3>& corners() const { return x_; }
  /// r at (l1, l2).
  dvec3 point(const dvec2& l) const {
    const double l0 = 1.0 - l.x - l.y;
    return l0 * x_[0] + l.x * x_[1] + l.y * x_[2] - l0 * l.x * b_[0] - l.x * l.y * b_[1] - l.y * l0 * b_[2];
  }
  /// dr/dl1.
  dvec3 along_1(const dvec2& l) const { return x_[1] - x_[0] - (1.0 - 2.0 * l.x - l.y) * b_[0] - l.y * (b_[1] - b_[2]); }
  /// dr/dl2.
  dvec3 along_2(const dvec2& l) const { return x_[2] - x_[0] - (1.0 - l.x - 2.0 * l.y) * b_[2] - l.x * (b_[1] - b_[0]); }
  /// b of a side [m].
  const dvec3& bend(int side) const { return b_[static_cast<std::size_t>(side)]; }

  /// The same seen from its other side.
  BentFacet turned() const { return {{x_[0], x_[2], x_[1]}, {b_[2], b_[1], b_[0]}}; }

  /// Over a point of the facet's plane.
  SurfacePoint over(const dvec3& r) const;

 private:
  std::array<dvec3, 3> x_, b_;
};

/// Facets joined by creases flatter than wedges are chords of one surface with averaged normals (CornerNormals), however deep
/// the dents between them: its vertices lie on it, so that it is truer than they are. Materials change nothing about the shape,
/// but surfaces end where they meet.
class SmoothSurfaces {
 public:
  /// Creases below `max_crease` [rad] are tessellation. Surfaces whose facets are no chords of it, as the normals at their
  /// corners differ more than creases do (slivers of rounding), stay facets, and those that rise above their facets by more than
  /// `max_rise` [m] in the mean, each as a whole.
  SmoothSurfaces(const TriangleMesh& mesh, double max_crease, double max_rise = std::numeric_limits<double>::infinity());
  /// The same for the mesh of `others`, which may have all components but need not: most of the work is done where no crease is
  /// steeper than one of the two limits and flatter than the other.
  SmoothSurfaces(const SmoothSurfaces& others, double max_crease, double max_rise = std::numeric_limits<double>::infinity());

  /// Those of other components, [component], become flat.
  void keep_components(const std::vector<bool>& kept);

  /// Those of these materials, [material], become flat.
  void flatten(const std::vector<bool>& materials);

  /// Whether a facet stands for a curved surface.
  bool any() const { return facets_ > 0; }
  /// How many of them do.
  std::size_t facets() const { return facets_; }

  /// How long the sides that bound curved surfaces are together [m].
  double boundary_length() const;

  /// The most by which a surface rises from its facets [m]: so far the outline of the facets lies within its shadow boundary.
  double rise() const { return rise_; }
  double rise(std::uint32_t triangle) const;  // from one that has a region

  /// The surface a triangle is part of; no_index: it is flat.
  std::uint32_t region(std::uint32_t triangle) const { return region_[triangle]; }

  /// Whether a triangle is part of a surface that is a perfect conductor.
  bool conducts(std::uint32_t triangle) const {
    return region_[triangle] != no_index && mesh_.patch_of(triangle).material == no_index;
  }

  /// Whether the side from `corner` of a triangle to the next one bounds its surface.
  bool on_boundary(std::uint32_t triangle, int corner) const { return chords_->boundary[3 * std::size_t{triangle} + corner]; }

  /// How far the surface bends off that side of a triangle with a region: the point at fraction x of the side lies at its chord
  /// minus x (1 - x) times this.
  dvec3 bend(std::uint32_t triangle, int corner) const {
    return (normal(triangle, corner) + normal(triangle, (corner + 1) % 3)) * sides_->bends[3 * std::size_t{triangle} + corner];
  }
  /// The point of the surface over that side, at this share of it.
  dvec3 on_side(std::uint32_t triangle, int corner, double share) const {
    const Triangle& t = mesh_.triangles[triangle];
    return (1.0 - share) * mesh_.vertices[t[corner]] +
           share * (mesh_.vertices[t[(corner + 1) % 3]] - (1.0 - share) * bend(triangle, corner));
  }

  /// The normal at a corner of a triangle, and its number among so many: corners of one surface share theirs at a vertex.
  const dvec3& normal(std::uint32_t triangle, int corner) const { return chords_->normals[normal_index(triangle, corner)]; }
  /// The number of that normal, below normals().
  std::uint32_t normal_index(std::uint32_t triangle, int corner) const {
    return chords_->corner_normal[3 * std::size_t{triangle} + corner];
  }
  /// How many there are.
  std::size_t normals() const { return chords_->normals.size(); }

  /// The surface over a triangle with a region.
  BentFacet facet(std::uint32_t triangle) const {
    return {mesh_.corners(triangle), {bend(triangle, 0), bend(triangle, 1), bend(triangle, 2)}};
  }

  /// The surface where the line of a ray (unit direction) meets it, over a triangle with a region. Flat with the facet's plane
  /// where the surface turns away from the ray although the facet does not.
  LocalSurface at(const dvec3& origin, const dvec3& direction, std::uint32_t triangle) const;

 private:
  /// What follows from which edges a surface may go on across.
  struct Chords {
    double steepest_crossed, flattest_left;    // cosines of the turns at these edges, and at others
    std::vector<std::uint32_t> region;         // [triangle] as region(), though none stays flat
    std::vector<bool> boundary;                // [side] of three a triangle
    std::vector<std::uint32_t> corner_normal;  // in `normals`, three a triangle
    std::vector<dvec3> normals;
    std::vector<bool> one_sided;  // [normal] but those of tips
  };

  static std::shared_ptr<const Chords> find_chords(const TriangleMesh& mesh, double max_crease);
  static void find_regions(const TriangleMesh& mesh, const Creases& creases, const std::vector<bool>& is_plane, Chords& chords);
  /// What follows from how steep a crease of tessellation may be, too.
  struct Sides {
    double max_crease;             // [rad]
    std::vector<double> steepest;  // [vertex] of the leans of sides that are chords, a sine
    std::vector<bool> one_sided;   // [normal]
    std::vector<double> bends;     // [side] of three a triangle, over the sum of the normals at its ends [m]; empty if none bends
  };

  static std::shared_ptr<const Sides> find_sides(const TriangleMesh& mesh, const Chords& chords, double max_crease);
  static void find_bends(const TriangleMesh& mesh, const Chords& chords, Sides& sides);
  SmoothSurfaces(const TriangleMesh& mesh, std::shared_ptr<const Chords> chords, std::shared_ptr<const Sides> sides,
                 double max_crease, double max_rise);
  bool has_chords_of(double max_crease) const;
  bool is_doubtful(std::uint32_t triangle) const;
  void keep_flat(double max_rise);
  void count_facets();

  const TriangleMesh& mesh_;
  std::shared_ptr<const Chords> chords_;
  std::shared_ptr<const Sides> sides_;
  std::vector<std::uint32_t> region_;
  std::size_t facets_ = 0;
  double rise_ = 0.0;
};

}  // namespace raytube
