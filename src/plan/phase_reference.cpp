#include "plan/phase_reference.h"

#include <cmath>

namespace raytube {

namespace {

// Towards the direction, as spherical_basis has it. At 94 GHz and 1000 km from the origin 10^9 rad come of it, of which double
// keeps six decimals and the extended precision of x86 nine.
long double along(const Direction& direction, const dvec3& point) {
  const auto without_dust = [](long double x) { return std::abs(x) < 1e-15L ? 0.0L : x; };
  const long double theta = direction.theta, phi = direction.phi;
  const long double across = without_dust(std::cos(phi)) * point.x + without_dust(std::sin(phi)) * point.y;
  return without_dust(std::sin(theta)) * across + without_dust(std::cos(theta)) * point.z;
}

}  // namespace

void make_reciprocal(std::span<ScatteringMatrix> scattering) {
  for (ScatteringMatrix& s : scattering) s.at(0, 1) = s.at(1, 0) = 0.5 * (s.vh() + s.hv());
}

Complex from_plane_waves(const TriangleMesh& mesh, const Look& look, const Radar& radar, double frequency) {
  const AntennaPair antennas(look, radar, mesh.center);
  const AntennaRay arriving = antennas.transmit.ray_to(dvec3(0.0)), received = antennas.receive.ray_to(dvec3(0.0));
  return std::polar(glm::length(arriving.field[0]) * glm::length(received.field[0]),
                    -wavenumber(frequency) * (arriving.path + received.path));
}

Complex shifted_phase(const dvec3& shift, const Look& look, double frequency) {
  const long double path = along(look.receive, shift) + along(look.transmit, shift);
  const long double cycles = path * frequency / speed_of_light;
  return std::polar(1.0, 2.0 * pi * static_cast<double>(cycles - std::round(cycles)));
}

Complex to_mesh_origin(const TriangleMesh& mesh, const Look& look, double frequency) {
  return look.far() ? shifted_phase(mesh.center, look, frequency) : Complex(1.0);
}

}  // namespace raytube
