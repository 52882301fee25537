// Cylinders of tests/data/coated_*.csv, as raytube's physical optics and edges have them in two dimensions. k = 2 pi, lengths in
// wavelengths, along z.
#pragma once

#include <vector>

#include "run.h"
#include "utd/impedance/coated_rim.h"
#include "utd/impedance/impedance_strip.h"

namespace raytube::testing {

inline constexpr double k = 2 * pi;
inline const dvec3 x_axis(1, 0, 0), y_axis(0, 1, 0), z_axis(0, 0, 1);

inline WedgeFace face_at(double angle, double turn) {
  return {0, std::cos(angle) * x_axis + std::sin(angle) * y_axis, turn * (-std::sin(angle) * x_axis + std::cos(angle) * y_axis),
          1e30};
}

/// Edge along z; face 0 at this angle from the x axis, free space counter-clockwise from it.
inline Wedge wedge_along_z(double n, double angle = 0.0) {
  return {-0.5 * z_axis, 0.5 * z_axis, n, {face_at(angle, 1.0), face_at(angle + n * pi, -1.0)}};
}

inline Material coat(Complex permittivity, Complex permeability, double thickness) {
  return {"coat", MaterialKind::coated, 0.0, {{{{permittivity, permeability}, thickness}}}};
}

struct Cylinder {
  struct Side {
    dvec3 from, to, normal;
    const Material* material;  // null: a conductor
  };
  struct Edge {
    dvec3 at;
    Wedge wedge;
    std::array<SurfaceImpedance, 2> faces;
    const Material* border = nullptr;  // of the rim of a thin plate; null: a conductor
  };
  /// From edge to edge, each with its face that lies between them.
  struct Way {
    std::array<std::size_t, 2> edges;
    std::array<int, 2> faces;
  };
  std::vector<Side> sides;
  std::vector<Edge> edges;
  std::vector<Way> ways;
};

inline LookVectors seen_across(double source, double observer) { return look_vectors({{pi / 2, source}, {pi / 2, observer}}); }

/// P of u along the cylinder: -j pi times S per length, for H along it with the other sign, as phi_hat turns with the antenna.
inline Complex of_scattering(const ScatteringMatrix& s, bool tm) { return Complex(0.0, pi) * (tm ? -s.vv() : s.hh()); }

inline SurfaceResponse response_of(const Material* material, double sine) {
  return material == nullptr ? perfect_conductor : smooth_response(*material, 0, k, sine, false);
}

/// S per length is -jk/4pi p . (eta J - s x M) times the integral of the phase.
inline Complex of_side(const Cylinder::Side& side, const LookVectors& look, bool tm) {
  const double sine = -glm::dot(look.incident, side.normal);
  if (sine <= 0.0) return 0.0;
  const int channel = tm ? 0 : 1;
  const SurfaceWaves waves =
      waves_at_surface(look.incident, side.normal, ComplexVector{look.electric[channel]}, response_of(side.material, sine));
  const dvec3 &p = look.receive[channel], turn = k * (look.scattered - look.incident), along = side.to - side.from;
  const Complex s = Complex(0.0, -k / (4 * pi)) *
                    (dot(waves.electric_current, p) - dot(waves.magnetic_current, glm::cross(p, look.scattered))) *
                    glm::length(along) * sinc(glm::dot(turn, along) / 2) *
                    std::polar(1.0, glm::dot(turn, side.from + side.to) / 2);
  return Complex(0.0, tm ? -pi : pi) * s;
}

inline Complex of_edge(const Cylinder::Edge& edge, const LookVectors& look, bool tm) {
  const WedgeIncidence incidence = incidence_on(edge.wedge, look.incident);
  if (incidence.weight == 0.0) return 0.0;
  bool windowed = false;
  const MaliuzhinetsFunction psi(edge.wedge.n);
  const ImpedanceEdge half_plane(edge.wedge, incidence, psi, look);
  ScatteringMatrix s = half_plane.amplitude(edge.faces, k, windowed);
  if (edge.wedge.thickness() > 0.0) {
    const double cosine = border_cosine(edge.wedge, look.incident);
    const SurfaceResponse border = cosine > 0.0 ? response_of(edge.border, cosine) : perfect_conductor;
    s += CoatedRim(edge.wedge, incidence, look, half_plane).amplitude({edge.faces, border, edge.border != nullptr}, k);
  }
  return of_scattering(s, tm) * std::polar(1.0, k * glm::dot(look.scattered - look.incident, edge.at));
}

inline double lag(const Cylinder::Edge& edge, const dvec3& direction) {
  return k * glm::dot(direction, edge.at + edge_below(edge.wedge, edge.faces));
}

/// Of H along the cylinder.
inline Complex of_way(const Cylinder::Edge& from, const Cylinder::Edge& to, const std::array<int, 2>& faces,
                      const LookVectors& look) {
  const WedgeIncidence arriving = incidence_on(from.wedge, look.incident);
  if (arriving.weight == 0.0) return 0.0;
  const MaliuzhinetsFunction psi(from.wedge.n, strip_digits), beyond(to.wedge.n, strip_digits);
  const double length = k * glm::distance(from.at, to.at);
  const auto met = [&](int face) {
    const WedgeFace& of = to.wedge.faces[face];
    return FaceIncidence{.tangent = glm::cross(of.into_face, of.normal), .sin_cone = 1.0};
  };
  const ImpedanceStrip way({from.wedge, faces[0], arriving.faces, psi}, {to.wedge, faces[1], {met(0), met(1)}, beyond}, look,
                           length);
  StripBundle strips{};
  strips.to = 1.0, strips.length = length / k;
  return Complex(0.0, pi) * way.echo(from.faces, to.faces).over(strips, k)[1] *
         glm::dot(look.magnetic[1], arriving.faces[faces[0]].tangent) *
         std::polar(1.0, lag(to, look.scattered) - lag(from, look.incident) - length);
}

/// Physical optics, edges, ways from edge to edge.
inline Complex amplitude(const Cylinder& cylinder, const LookVectors& look, bool tm, int order) {
  Complex sum = 0.0;
  for (const Cylinder::Side& side : cylinder.sides) sum += of_side(side, look, tm);
  if (order > 0)
    for (const Cylinder::Edge& edge : cylinder.edges) sum += of_edge(edge, look, tm);
  if (order > 1 && !tm)
    for (const Cylinder::Way& way : cylinder.ways)
      sum += of_way(cylinder.edges[way.edges[0]], cylinder.edges[way.edges[1]], way.faces, look);
  return sum;
}

struct Error {
  double square = 0.0, peak = 0.0;
  int rows = 0;
  void add(Complex found, Complex wanted) {
    square += std::norm(found - wanted);
    peak = std::max(peak, std::abs(wanted));
    ++rows;
  }
  double relative() const { return std::sqrt(square / rows) / peak; }
};

}  // namespace raytube::testing
