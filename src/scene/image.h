// Where on a target the return of one look comes from: plain data.
#pragma once

#include <cstdint>
#include <vector>

#include "core/field.h"

namespace raytube {

/// The launch rectangle of a look in equal cells, as the radar sees it: columns along u, rows along v. From a finite distance in
/// perspective: drawn to scale at the middle of the target, counted from where the origin of the coordinates is seen.
struct ImageLattice {
  dvec3 u_hat, v_hat;                   // unit, along columns and rows
  dvec2 corner{0.0}, cell{0.0};         // lower corner and sides of a cell [m]
  std::uint32_t columns = 0, rows = 0;  // cells along u and along v
  double curvature = 0.0;               // 1 / distance from the antenna to the middle of the target [1/m]; 0: parallel rays
  dvec3 middle_of_target{0.0};          // [m]; of perspectives

  /// How many there are.
  std::size_t cells() const { return std::size_t{columns} * rows; }
  /// The number of a cell, given as column and row: row by row.
  std::size_t index(const glm::uvec2& at) const { return std::size_t{at.y} * columns + at.x; }
  /// Coordinates of a point along u and v [m].
  dvec2 project(const dvec3& r) const {
    return curvature == 0.0 ? along(r) : seen(r - middle_of_target) - seen(-middle_of_target);
  }
  /// How far u and v at the middle of the target are from what they would be without perspective [m].
  dvec2 shift_of_perspective() const {
    return curvature == 0.0 ? dvec2(0.0) : along(middle_of_target) - project(middle_of_target);
  }
  /// The middle of a cell along u and v [m].
  dvec2 middle(const glm::uvec2& at) const { return corner + (dvec2(at) + 0.5) * cell; }

  /// Column and row of a point, given along u and v. What rounding puts beside the rectangle belongs to the cell next to it.
  glm::uvec2 at(const dvec2& point) const;

  /// The shares of the way from `begin` to `end` at which it goes from one cell into another, from 0 to 1, both included.
  std::vector<double> crossings(const dvec3& begin, const dvec3& end) const;

 private:
  dvec2 along(const dvec3& r) const { return {glm::dot(r, u_hat), glm::dot(r, v_hat)}; }
  // Distance from the antenna over that of the middle, of a point counted from there.
  double widening(const dvec3& r) const { return 1.0 - curvature * glm::dot(glm::cross(u_hat, v_hat), r); }
  dvec2 seen(const dvec3& r) const { return along(r) / widening(r); }
};

/// What comes back from a straight piece of an edge.
struct ImageEdge {
  dvec3 begin, end;    // of the piece [m]
  ScatteringMatrix s;  // its share of S [m]
};

/// S of a look at one frequency, cell by cell of its launch rectangle, phase reference at the origin of the mesh's coordinates
/// as everywhere; the cells add up to S, and so do triangles and edges together.
struct LookImage {
  std::size_t look = 0;                     // counted from 0
  double frequency = 0.0;                   // [Hz]
  ImageLattice lattice;                     // in the mesh's own coordinates
  std::vector<ScatteringMatrix> cells;      // row by row: of tubes launched there at all bounces, and of edges seen there
  std::vector<ScatteringMatrix> triangles;  // of the mesh, of the currents of every bounce
  std::vector<ImageEdge> edges;             // each within one cell, in the mesh's own coordinates
};

}  // namespace raytube
