#include "uncertainty/look_features.h"

#include <algorithm>
#include <cmath>

namespace raytube {

namespace {

// Directions and wavenumber of a look at one frequency.
struct Phases {
  Phases(const Look& look, double frequency)
      : transmit(spherical_basis(look.transmit).radial),
        receive(spherical_basis(look.receive).radial),
        k(wavenumber(frequency)),
        difference(k * (transmit + receive)) {}

  bool monostatic() const { return transmit == receive; }

  dvec3 transmit, receive;  // unit vectors towards the antennas
  double k;                 // [rad/m]
  dvec3 difference;         // k (s - s'): the phase of a point r is its product with r
};

// 1 if it is turned to both antennas, 1/2 to one of them.
template <class Normals>
double lit_share(const Normals& normals, const Phases& phases) {
  const auto turned_to = [&](const dvec3& antenna) {
    return std::ranges::any_of(normals, [&](const dvec3& normal) { return glm::dot(normal, antenna) > 0.0; });
  };
  if (phases.monostatic()) return turned_to(phases.transmit) ? 1.0 : 0.0;
  return 0.5 * turned_to(phases.transmit) + 0.5 * turned_to(phases.receive);
}

double lit_corners(const EdgeFeatures& target, const Phases& phases) {
  const double wavelength = 2.0 * pi / phases.k;
  double squares = 0.0;
  for (const SharpCorner& corner : target.corners) {
    const std::span normals(target.corner_normals.data() + corner.first_normal, corner.last_normal - corner.first_normal);
    const double length = corner.weight * std::min(corner.reach, wavelength);
    squares += lit_share(normals, phases) * length * length;
  }
  return std::sqrt(squares);
}

double lit_edges(const EdgeFeatures& target, const Phases& phases) {
  double squares = 0.0;
  for (std::size_t first = 0; first < target.edges.size();) {
    Complex sum = 0.0;
    std::size_t i = first;
    for (; i < target.edges.size() && target.edges[i].run == target.edges[first].run; ++i) {
      const WeakEdge& edge = target.edges[i];
      const double length = 2.0 * glm::length(edge.half) * sinc(glm::dot(phases.difference, edge.half));
      sum += edge.strength * std::sqrt(lit_share(edge.normals, phases)) * length *
             std::polar(1.0, glm::dot(phases.difference, edge.middle));
    }
    squares += std::norm(sum);
    first = i;
  }
  return std::sqrt(squares) / (2.0 * pi);
}

// The field of a curved surface's shadow boundary beside that of a sharp edge there. PO ends at the boundary instead of going on
// smoothly over the width (2/k)^{1/3} R^{2/3} (Fock 1946): the soft current falls linearly to zero there, the hard one jumps.
// Each is worth k times its integral with the phase along the ray, which 1 - s.s' per wavelength turns.
class BoundaryShare {
 public:
  explicit BoundaryShare(const Phases& phases) {
    const double cosine = -glm::dot(phases.transmit, phases.receive);  // s . s'
    turns_ = 1.0 - cosine;
    across_ = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  }

  double operator()(double kr) const {
    const double third = std::cbrt(kr);
    const double soft = 1.0 / (turns_ * turns_ * kr + 1.0 / (1.0 + third));
    const double hard = across_ / (turns_ + 1.0 / (1.0 + third * third));
    return soft + 0.5 * hard;
  }

 private:
  double turns_, across_;
};

dvec3 center_of(const TriangleMesh& mesh, std::uint32_t triangle) {
  const auto& t = mesh.triangles[triangle];
  return (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0;
}

// Sum over the pieces of the line on which the surface turns away from the antenna.
Complex boundary_sum(const TargetFeatures& target, const Phases& phases, const dvec3& antenna) {
  const TriangleMesh& mesh = target.mesh;
  std::vector<double> facing(mesh.patches.size());
  std::ranges::transform(mesh.patches, facing.begin(), [&](const Patch& patch) { return glm::dot(patch.normal, antenna); });
  const BoundaryShare share(phases);
  Complex sum = 0.0;
  for (const SmoothCrease& crease : target.curved.creases) {
    const auto [first, second] = crease.triangles;
    const double a = facing[mesh.triangle_patch[first]], b = facing[mesh.triangle_patch[second]];
    if ((a > 0.0) == (b > 0.0)) continue;
    const dvec3 start = center_of(mesh, first), point = start + a / (a - b) * (center_of(mesh, second) - start);
    sum += crease.length * share(phases.k * crease.radius) * std::polar(1.0, glm::dot(phases.difference, point));
  }
  return sum;
}

double shadow_boundaries(const TargetFeatures& target, const Phases& phases) {
  if (target.curved.creases.empty()) return 0.0;
  const double transmit = std::norm(boundary_sum(target, phases, phases.transmit));
  const double receive = phases.monostatic() ? transmit : std::norm(boundary_sum(target, phases, phases.receive));
  return std::sqrt(0.5 * (transmit + receive)) / (2.0 * pi);
}

}  // namespace

LookFeatures find_look_features(const TargetFeatures& target, const Look& look, double frequency) {
  const Phases phases(look, frequency);
  return {lit_corners(target.edges, phases), lit_edges(target.edges, phases), shadow_boundaries(target, phases)};
}

}  // namespace raytube
