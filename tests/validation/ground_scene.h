// Targets over a plane ground, made in memory.
#pragma once

#include "case/target.h"
#include "run.h"
#include "shapes.h"

namespace raytube::testing {

constexpr double gigahertz = 10e9;

inline Case case_over(const Sweep& sweep, const Ground& ground, EdgeMethod edges = EdgeMethod::none) {
  Case c;
  c.sweep = sweep;
  c.ground = ground;
  c.edges.method = edges;
  c.tubes.curved = CurvedSurfaces::never;
  return c;
}

inline Target target_over_ground(PolygonSoup soup, const Case& c) {
  add_mirror_image(soup, c);
  return Target(build_mesh(std::move(soup), 1.0).mesh);
}

inline SolveOptions options_of(const Case& c, bool keep_parts = false) {
  SolveOptions options{c.tubes, c.edges, c.surfaces};
  options.keep_parts = keep_parts;
  return options;
}

inline SweepResult solve_case(PolygonSoup soup, const Case& c, bool keep_parts = false) {
  const Target target = target_over_ground(std::move(soup), c);
  return solve(SolvePlan(target, c.sweep, options_of(c, keep_parts), c.ground));
}

inline Ground conductor_as_a_medium(double height) {
  Ground ground{height, Material()};
  ground.material->kind = MaterialKind::conductor;
  return ground;
}

inline PolygonSoup moved(PolygonSoup soup, const dvec3& by) {
  for (dvec3& point : soup.points) point += by;
  return soup;
}

inline double largest_difference(const ScatteringMatrix& a, const ScatteringMatrix& b) { return largest_amplitude(a - b); }

/// Faces +x, from y = -w/2 to w/2 and z = low to high.
struct Upright {
  double x, w, low, high;

  PolygonSoup soup() const {
    const double h = w / 2;
    return {{{x, -h, low}, {x, h, low}, {x, h, high}, {x, -h, high}}, {{0, 1, 2, 3}}};
  }

  /// Radiated towards s by the currents 2 n x H of a wave of the field e that comes from i (phases at the origin).
  dvec3 field(const dvec3& i, const dvec3& e) const { return 2.0 * glm::cross(dvec3(1, 0, 0), glm::cross(-i, e)); }
  Complex spread(double k, const dvec3& sum) const {
    return w * (high - low) * sinc(0.5 * k * sum.y * w) * sinc(0.5 * k * sum.z * (high - low)) *
           std::polar(1.0, k * (sum.x * x + sum.z * 0.5 * (low + high)));
  }
};

}  // namespace raytube::testing
