// Corners and bodies whose edges illuminate other faces, and how they are solved.
#pragma once

#include "run.h"
#include "shapes.h"
#include "solve/look_solver.h"

namespace raytube::testing::interaction {

inline constexpr double frequency = 10e9;
inline const double lambda = wavelength(frequency);
inline constexpr int vv = 0, hh = 1;

inline SolveOptions adaptive(bool interaction, int order = 3) {
  SolveOptions o = options(EdgeMethod::fringe, 40.0);
  o.tubes.mode = TubeMode::adaptive;
  o.edges.interaction = interaction;
  o.edges.interaction_budget = unlimited_interaction_budget;  // what it gives is tested, not what it may cost
  o.edges.order = order;
  return o;
}

/// Three square plates of side `a` on the planes x = 0, y = 0, z = 0.
inline PolygonSoup square_trihedral(double a) {
  return {{{0, 0, 0}, {a, 0, 0}, {a, a, 0}, {0, a, 0}, {0, a, a}, {0, 0, a}, {a, 0, a}},
          {{0, 1, 2, 3}, {0, 3, 4, 5}, {0, 5, 6, 1}}};
}

/// A closed body: a cube on the middle of a square block.
inline PolygonSoup cube_on_block(double block, double thickness, double side) {
  PolygonSoup soup;
  const auto ring = [&](double half, double z) {
    for (const dvec2 corner : {dvec2(-1, -1), dvec2(1, -1), dvec2(1, 1), dvec2(-1, 1)})
      soup.points.emplace_back(half * corner.x, half * corner.y, z);
  };
  ring(block / 2, -thickness);
  ring(block / 2, 0.0);
  ring(side / 2, 0.0);
  ring(side / 2, side);
  for (std::uint32_t level = 0; level < 12; level += 4)
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t next = (i + 1) % 4;
      soup.polygons.push_back({level + i, level + next, level + 4 + next, level + 4 + i});
    }
  soup.polygons.push_back({3, 2, 1, 0});
  soup.polygons.push_back({12, 13, 14, 15});
  return soup;
}

/// Two cubes side by side, one higher than the other.
inline PolygonSoup two_boxes(double side, double gap) {
  PolygonSoup soup = shapes::box(dvec3(side)), other = soup;
  for (dvec3& p : soup.points) p.x -= (side + gap) / 2;
  for (dvec3 p : other.points) soup.points.push_back(p + dvec3((side + gap) / 2, 0, 0.3 * side));
  for (auto polygon : other.polygons) {
    for (std::uint32_t& corner : polygon) corner += 8;
    soup.polygons.push_back(polygon);
  }
  return soup;
}

}  // namespace raytube::testing::interaction
