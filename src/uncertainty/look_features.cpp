#include "uncertainty/look_features.h"

#include <algorithm>
#include <cmath>

#include "uncertainty/constants.h"

namespace raytube {

using namespace uncertainty;

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

// n - 1 times the share of the edge's currents that is missing.
double strength(const WeakEdge& edge, double k) {
  const double narrow = is_narrow(edge.width, 2.0 * pi / k) ? 1.0 / (1.0 + k * edge.width) : 0.0;
  return edge.sharpness * std::max(edge.missing, narrow);
}

double lit_edges(const EdgeFeatures& target, const Phases& phases) {
  double squares = 0.0;
  for (std::size_t first = 0; first < target.edges.size();) {
    Complex sum = 0.0;
    std::size_t i = first;
    for (; i < target.edges.size() && target.edges[i].run == target.edges[first].run; ++i) {
      const WeakEdge& edge = target.edges[i];
      const double length = 2.0 * glm::length(edge.half) * sinc(glm::dot(phases.difference, edge.half));
      sum += strength(edge, phases.k) * std::sqrt(lit_share(edge.normals, phases)) * length *
             std::polar(1.0, glm::dot(phases.difference, edge.middle));
    }
    squares += std::norm(sum);
    first = i;
  }
  return std::sqrt(squares) / (2.0 * pi);
}

// The field of a curved surface's shadow boundary beside that of a sharp edge there, by kR, R the radius along the ray. PO ends
// at the boundary: the soft current falls linearly to zero there, the hard one jumps. Each is worth k times its integral with the
// phase along the ray, which turns by 1 - s.s' per unit of kr; the hard one, which runs along s', radiates only across s'. Exact
// currents go on smoothly over (2/k)^{1/3} R^{2/3} (Fock 1946), which bounds the integral where no phase turns.
class BoundaryShare {
 public:
  explicit BoundaryShare(const Phases& phases) {
    const double cosine = -glm::dot(phases.transmit, phases.receive);  // s . s'
    turns_ = 1.0 - cosine;
    across_ = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  }

  double soft(double kr) const { return 1.0 / (turns_ * turns_ * kr + 2.0); }
  double hard(double kr) const {
    const double width = std::cbrt(2.0 * kr * kr);  // times k
    return 0.5 * across_ / (turns_ + 1.0 / (1.0 + width));
  }

 private:
  double turns_, across_;
};

dvec3 center_of(const TriangleMesh& mesh, std::uint32_t triangle) {
  const auto& t = mesh.triangles[triangle];
  return (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0;
}

// What creases of curved surfaces add up to, seen from one antenna.
struct CreaseSums {
  Complex soft = 0.0, hard = 0.0;  // pieces of the line on which the surface turns away [m]
  Complex curved = 0.0;            // currents of PO times the share that curvature changes [m]
  Complex rims = 0.0;              // creases that turn so sharply that they are edges [m]
};

// The leading corrections to geometrical optics at a cylinder of radius R are 5/16 and 11/16 of 1/kR (Bowman, Senior & Uslenghi
// 1987, section 2.2), at a sphere 1/2 of it.
double curvature_share(double kr) { return 1.0 / (1.0 + 2.0 * kr); }

CreaseSums add_creases(const TargetFeatures& target, const Phases& phases, const dvec3& antenna) {
  const TriangleMesh& mesh = target.mesh;
  std::vector<double> facing(mesh.patches.size());
  std::ranges::transform(mesh.patches, facing.begin(), [&](const Patch& patch) { return glm::dot(patch.normal, antenna); });
  const BoundaryShare share(phases);
  CreaseSums sums;
  for (const SmoothCrease& crease : target.curved.creases) {
    const auto [first, second] = crease.triangles;
    const double a = facing[mesh.triangle_patch[first]], b = facing[mesh.triangle_patch[second]];
    const double kr = phases.k * crease.radius;
    if ((a > 0.0) != (b > 0.0)) {
      const dvec3 start = center_of(mesh, first), point = start + a / (a - b) * (center_of(mesh, second) - start);
      const Complex piece = static_cast<double>(crease.length) * std::polar(1.0, glm::dot(phases.difference, point));
      sums.soft += share.soft(kr) * piece;
      sums.hard += share.hard(kr) * piece;
    }
    const double facing_both = 0.5 * (a + b);
    if (kr > least_curvature || facing_both < darkest_rim) continue;
    const dvec3 point = 0.5 * (center_of(mesh, first) + center_of(mesh, second));
    const Complex phase = std::polar(1.0, glm::dot(phases.difference, point));
    if (facing_both > 0.0) sums.curved += phases.k * facing_both * crease.area * curvature_share(kr) * phase;
    sums.rims += crease.angle / pi * crease.length / (1.0 + kr) * phase;
  }
  return sums;
}

// How much of V and H of an antenna lies in the plane of both directions, as power; no less than a fifth, for surfaces that turn
// what meets them.
std::array<double, 2> shares_in_plane(const Direction& antenna, const dvec3& other) {
  const SphericalBasis basis = spherical_basis(antenna);
  const dvec3 across = glm::cross(basis.radial, other);
  const double square = glm::dot(across, across);
  if (square < 1e-12) return {1.0, 1.0};
  const auto share = [&](const dvec3& e) { return std::max(0.2, 1.0 - glm::dot(e, across) * glm::dot(e, across) / square); };
  return {share(basis.theta_hat), share(basis.phi_hat)};
}

// Means over both antennas.
void find_creases(const TargetFeatures& target, const Look& look, const Phases& phases, LookFeatures& features) {
  if (target.curved.creases.empty()) return;
  const CreaseSums transmit = add_creases(target, phases, phases.transmit);
  const CreaseSums receive = phases.monostatic() ? transmit : add_creases(target, phases, phases.receive);
  const auto mean = [](Complex a, Complex b) { return std::sqrt(0.5 * (std::norm(a) + std::norm(b))) / (2.0 * pi); };
  const double soft = mean(transmit.soft, receive.soft), hard = mean(transmit.hard, receive.hard);
  const std::array<double, 2> sent = shares_in_plane(look.transmit, phases.receive);
  const std::array<double, 2> received = shares_in_plane(look.receive, phases.transmit);
  for (std::size_t p = 0; p < 2; ++p)
    for (std::size_t q = 0; q < 2; ++q) features.shadow_boundaries[p][q] = soft + hard * std::sqrt(received[p] * sent[q]);
  features.tight_curves = mean(transmit.curved, receive.curved);
  features.rims = mean(transmit.rims, receive.rims);
}

}  // namespace

LookFeatures find_look_features(const TargetFeatures& target, const Look& look, double frequency) {
  const Phases phases(look, frequency);
  LookFeatures features{.corners = lit_corners(target.edges, phases), .edges = lit_edges(target.edges, phases)};
  find_creases(target, look, phases, features);
  return features;
}

}  // namespace raytube
