#include "sbr/launch/launch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/decimal.h"
#include "core/error.h"
#include "scene/antenna.h"

namespace raytube {

namespace {

struct Interval {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void include(double x) {
    low = std::min(low, x);
    high = std::max(high, x);
  }
  double length() const { return high - low; }
};

void set_axes(LaunchGrid& grid, const SphericalBasis& basis, const std::optional<dvec3>& up) {
  grid.direction = -basis.radial;
  grid.u_hat = basis.phi_hat;
  grid.v_hat = -basis.theta_hat;
  if (!up) return;
  const dvec3 across = *up - glm::dot(*up, basis.radial) * basis.radial;
  if (glm::length(across) < 1e-9 * glm::length(*up)) return;
  grid.v_hat = glm::normalize(across);
  grid.u_hat = glm::cross(grid.v_hat, basis.radial);
}

// The look's axes, turned with its line of sight to that of an antenna.
SphericalBasis basis_towards(const dvec3& antenna, const Direction& transmit) {
  const SphericalBasis basis = spherical_basis(transmit);
  const dvec3 radial = glm::normalize(antenna);
  return {radial, carried(basis.theta_hat, basis.radial, radial), carried(basis.phi_hat, basis.radial, radial)};
}

constexpr double most_along_side = 1e6;  // cells
constexpr double rounding = 1e-6;        // of a cell: an extent of whole cells is not one more

struct Extent {
  Interval u, v, depth;
};

// Extent of the target in the perspective of the grid's axes.
Extent extent_of(const TriangleMesh& mesh, const LaunchGrid& grid) {
  Extent extent;
  for (const dvec3& vertex : mesh.vertices) {
    extent.depth.include(glm::dot(vertex, grid.direction));
    const double w = 1.0 + grid.curvature * glm::dot(vertex, grid.direction);
    extent.u.include(glm::dot(vertex, grid.u_hat) / w);
    extent.v.include(glm::dot(vertex, grid.v_hat) / w);
  }
  return extent;
}

// Without its cells.
LaunchGrid axes_of(const Direction& transmit, const std::optional<dvec3>& up, const std::optional<dvec3>& antenna) {
  LaunchGrid grid;
  set_axes(grid, antenna ? basis_towards(*antenna, transmit) : spherical_basis(transmit), up);
  grid.curvature = antenna ? 1.0 / glm::length(*antenna) : 0.0;
  return grid;
}

std::optional<dvec3> antenna_of(const TriangleMesh& mesh, const Look& look) {
  if (look.far()) return {};
  return look.transmitter().point() - mesh.center;
}

double densest(const Extent& extent, double wavelength) {
  return (most_along_side + rounding) * wavelength / std::max(extent.u.length(), extent.v.length());
}

std::uint32_t cells_along(double extent, double cells_per_metre) {
  const double cells = std::ceil(extent * cells_per_metre - rounding);
  return cells > 0.0 ? static_cast<std::uint32_t>(std::min(cells, most_along_side)) : 0;
}

}  // namespace

LaunchGrid launch_grid(const TriangleMesh& mesh, const Direction& transmit, double wavelength, double per_wavelength,
                       const std::optional<dvec3>& up, const std::optional<dvec3>& antenna) {
  LaunchGrid grid = axes_of(transmit, up, antenna);
  const Extent extent = extent_of(mesh, grid);
  grid.plane_origin = -1.001 * mesh.radius * grid.direction;
  if (antenna)  // halfway to it at most
    grid.plane_origin = grid.direction * std::max(-1.001 * mesh.radius, 0.5 * (extent.depth.low - glm::length(*antenna)));
  if (const double most = densest(extent, wavelength); !(per_wavelength <= most))
    throw InputError(too_dense(per_wavelength, most));
  grid.columns = cells_along(extent.u.length(), per_wavelength / wavelength);
  grid.rows = cells_along(extent.v.length(), per_wavelength / wavelength);
  if (grid.cells() == 0) grid.columns = grid.rows = 0;
  grid.u_begin = extent.u.low;
  grid.v_begin = extent.v.low;
  grid.du = grid.columns ? extent.u.length() / grid.columns : 0.0;
  grid.dv = grid.rows ? extent.v.length() / grid.rows : 0.0;
  return grid;
}

double densest_grid(const TriangleMesh& mesh, const Look& look, double wavelength, const std::optional<dvec3>& up) {
  return densest(extent_of(mesh, axes_of(look.transmit, up, antenna_of(mesh, look))), wavelength);
}

std::string too_dense(double per_wavelength, double most) {
  return fmt::format(
      "tubes.per_wavelength: {:.6g} tubes per wavelength are more than 10^6 along one side of the launch plane; {} would fit, or "
      "check "
      "target.unit and frequency.ghz",
      per_wavelength, rounded_down_text(most));
}

LaunchGrid grid_of_look(const TriangleMesh& mesh, const Look& look, double wavelength, double per_wavelength,
                        const std::optional<dvec3>& up) {
  return launch_grid(mesh, look.transmit, wavelength, per_wavelength, up, antenna_of(mesh, look));
}

bool stands_in_front(const TriangleMesh& mesh, const dvec3& antenna) {
  const double range = glm::length(antenna);
  if (!(range > 0.0)) return false;
  const dvec3 direction = antenna / -range;
  return std::ranges::all_of(mesh.vertices, [&](const dvec3& vertex) {
    const double along = glm::dot(vertex, direction);
    const double distance = range + along;
    return distance > 0.05 * range && glm::length(vertex - along * direction) <= distance;
  });
}

}  // namespace raytube
