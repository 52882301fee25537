#include "sbr/launch.h"

#include <cmath>
#include <limits>

#include "error.h"

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

std::uint32_t cells_along(double extent, double cells_per_metre) {
  const double cells = std::ceil(extent * cells_per_metre - 1e-6);
  if (cells > 1e6)
    throw InputError(
        "tubes.per_wavelength asks for more than 10^6 tubes along one side of the launch plane; lower it, or check "
        "target.unit and frequency.ghz");
  return cells > 0.0 ? static_cast<std::uint32_t>(cells) : 0;
}

}  // namespace

LaunchGrid launch_grid(const TriangleMesh& mesh, const Direction& transmit, double wavelength, double per_wavelength,
                       const std::optional<dvec3>& up) {
  LaunchGrid grid;
  set_axes(grid, spherical_basis(transmit), up);
  Interval u, v;
  for (const dvec3& vertex : mesh.vertices) {
    u.include(glm::dot(vertex, grid.u_hat));
    v.include(glm::dot(vertex, grid.v_hat));
  }
  grid.plane_origin = -1.001 * mesh.radius * grid.direction;
  grid.columns = cells_along(u.length(), per_wavelength / wavelength);
  grid.rows = cells_along(v.length(), per_wavelength / wavelength);
  if (grid.cells() == 0) grid.columns = grid.rows = 0;
  grid.u_begin = u.low;
  grid.v_begin = v.low;
  grid.du = grid.columns ? u.length() / grid.columns : 0.0;
  grid.dv = grid.rows ? v.length() / grid.rows : 0.0;
  return grid;
}

}  // namespace raytube
