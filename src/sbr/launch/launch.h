// The launch plane of a look: a regular grid of tubes over the target's projected extent.
//
// The central header of this folder, which holds the plane that tubes set out from: the grid, its rays and blocks of cells
// (tile), convex polygons on it (convex_polygon), and the cells under a polygon (lattice). Positions on it are launch coordinates
// (u, v) [m]: along u_hat and v_hat, counted from the projection of the middle of the target.
#pragma once

#include <optional>
#include <string>

#include "mesh/model/triangle_mesh.h"
#include "mesh/trace/tracer.h"
#include "scene/sweep.h"

namespace raytube {

/// Rectangle across the line of sight, in recentred coordinates, cut into equal cells. Columns run along u, rows along v;
/// u x v points to the radar. It lies in front of the whole target. Rays from an antenna at a finite distance run through the
/// cells' points where these are drawn at the middle of the target, which is the origin.
struct LaunchGrid {
  dvec3 u_hat, v_hat;                   // unit, along columns and rows
  dvec3 direction;                      // of propagation: away from the radar
  dvec3 plane_origin;                   // point of the plane with u = v = 0
  double u_begin = 0.0, v_begin = 0.0;  // lower corner [m]
  double du = 0.0, dv = 0.0;            // cell sides [m]
  double curvature = 0.0;               // 1 / distance from the antenna to the origin [1/m]; 0: parallel rays
  std::uint32_t columns = 0, rows = 0;  // both 0 when the target has no projected area

  /// u of the middle of a column [m].
  double u_center(std::uint32_t column) const { return u_begin + (column + 0.5) * du; }
  /// v of the middle of a row [m].
  double v_center(std::uint32_t row) const { return v_begin + (row + 0.5) * dv; }
  /// Rays from an antenna: how much closer together they are where they begin.
  double narrowing() const { return 1.0 + curvature * glm::dot(direction, plane_origin); }
  /// The depth along a Beam where that is [m].
  double launch_depth() const { return glm::dot(direction, plane_origin) / narrowing(); }

  /// How many there are.
  std::uint64_t cells() const { return std::uint64_t{columns} * rows; }

  /// Launch coordinates of a cell's ray.
  dvec2 ray_coordinates(std::uint32_t column, std::uint32_t row) const {
    return {u_center(column) + beside_u * du, v_center(row) + beside_v * dv};
  }

  /// The ray of a cell leaves a little beside the centre, so that it never runs along mesh edges aligned with the grid.
  Ray ray(std::uint32_t column, std::uint32_t row) const {
    const dvec2 at = ray_coordinates(column, row);
    const dvec3 across = at.x * u_hat + at.y * v_hat;
    if (curvature == 0.0) return {plane_origin + at.x * u_hat + at.y * v_hat, direction};
    return {plane_origin + narrowing() * across, glm::normalize(direction + curvature * across)};
  }
};

/// Grid of `per_wavelength` cells per wavelength along each side, fitted to the exact extent: ceil(extent * per_wavelength /
/// wavelength - 1e-6) equal cells. Throws InputError where these are more than 10^6. Columns u = phi_hat, rows v = -theta_hat of
/// `transmit`, or v along `up` projected (the default again where `up` points along the line of sight). With an antenna, at a
/// point in recentred coordinates, in its perspective, these axes turned with the line of sight to the origin.
LaunchGrid launch_grid(const TriangleMesh& mesh, const Direction& transmit, double wavelength, double per_wavelength,
                       const std::optional<dvec3>& up, const std::optional<dvec3>& antenna = {});

/// The launch grid of a look, from afar or from a finite distance; errors as for launch_grid().
LaunchGrid grid_of_look(const TriangleMesh& mesh, const Look& look, double wavelength, double per_wavelength,
                        const std::optional<dvec3>& up);

/// The most cells per wavelength that the launch grid of a look takes: 10^6 of them along its longer side.
double densest_grid(const TriangleMesh& mesh, const Look& look, double wavelength, const std::optional<dvec3>& up);

/// The error message for a density above the most.
std::string too_dense(double per_wavelength, double most);

/// False if an antenna at this point, in recentred coordinates, has some of the mesh beside or behind it: farther off its line of
/// sight to the origin than it lies along it, or nearer than a twentieth of the way there.
bool stands_in_front(const TriangleMesh& mesh, const dvec3& antenna);

}  // namespace raytube
