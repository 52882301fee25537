// Edges behind screens: with what these let through, along both lines of sight.
#include <gtest/gtest.h>

#include "solve/image.h"
#include "validation/material_scene.h"

namespace raytube {

using namespace material_scene;

namespace {

const Material laminate = layered(MaterialKind::sheet, {{{{4.0, -0.1}}, 3e-3}}),
               film = layered(MaterialKind::sheet, {{{{2.5, -0.4}}, 1e-3}}),
               nothing = layered(MaterialKind::sheet, {{{{1.0, 0.0}}, 3e-3}});

// A rectangle at z = 8 wavelengths behind which `body` stands; tubes end where they meet it.
PolygonSoup under_screen(const PolygonSoup& body, double x_begin) {
  const double far = 30.0 * lambda, z = 8.0 * lambda;
  PolygonSoup both = body;
  both.materials.assign(body.polygons.size(), no_index);
  const auto first = static_cast<std::uint32_t>(both.points.size());
  both.points.insert(both.points.end(), {{x_begin, -far, z}, {far, -far, z}, {far, far, z}, {x_begin, far, z}});
  both.polygons.push_back({first, first + 1, first + 2, first + 3});
  both.materials.push_back(0);
  return both;
}

// What edges add, without edge-face interaction, which scenes with materials have not.
ScatteringMatrix edges_of(const PolygonSoup& soup, const std::vector<Material>& materials, const Direction& from,
                          const Direction& to, int order = 3) {
  const auto solved = [&](EdgeMethod method) {
    SolveOptions options{{}, {}, 1, false, {}};
    options.edges.method = method;
    options.edges.order = order;
    options.edges.interaction = false;
    options.edges.materials = MaterialEdgeMethod::none;  // the screens' own rims are not looked for
    const LoadedMesh loaded = build_mesh(soup, 1.0, "test", materials);
    const bool bistatic = !(from == to);
    return solve(Target(loaded.mesh), {{frequency}, {{from, to}}, bistatic, {}, materials}, options).total.front();
  };
  return solved(EdgeMethod::fringe) - solved(EdgeMethod::none);
}

// Cut along the lines at which screens begin and end, currents of edges add up to those of whole edges.
TEST(ScreenedEdges, AScreenOfVacuumChangesNothing) {
  const Direction from = deg(20.0, 15.0), to = deg(35.0, 70.0);
  for (const PolygonSoup& body :
       {shapes::plate(5.0 * lambda), shapes::cube(3.0 * lambda), shapes::dihedral(4.0 * lambda, 3.0 * lambda)})
    for (const int order : {1, 3})
      for (const double begin : {-30.0 * lambda, 3.1 * lambda})
        for (const Direction& receive : {from, to}) {
          const ScatteringMatrix expected = edges_of(body, {}, from, receive, order);
          // The strips of parts of edges have other panels than those of whole ones: a few 1e-4 wavelengths of quadrature.
          const double tolerance = order == 3 && begin > 0.0 ? 1e-3 : 1e-9;
          EXPECT_LT(difference(edges_of(under_screen(body, begin), {nothing}, from, receive, order), expected), tolerance);
        }
}

// In the plane phi = 0 V is TM and H is TE. The screen lies before both antennas.
TEST(ScreenedEdges, WavesPassAScreenTwice) {
  const PolygonSoup plate = shapes::plate(5.0 * lambda);
  const double from = 20.0, to = 50.0;
  const SurfaceResponse in = response(laminate, 0, k, std::cos(from * degree), false),
                        out = response(laminate, 0, k, std::cos(to * degree), false);
  ScatteringMatrix expected = edges_of(plate, {}, deg(from, 0.0), deg(to, 180.0));
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q)
      expected.at(p, q) *= (p == 0 ? out.transmitted.tm : out.transmitted.te) * (q == 0 ? in.transmitted.tm : in.transmitted.te);
  EXPECT_LT(difference(edges_of(under_screen(plate, -30.0 * lambda), {laminate}, deg(from, 0.0), deg(to, 180.0)), expected),
            1e-9);
}

// A tetrahedron one edge of which lies between two dark faces: the wave along it comes through the screen, too.
TEST(ScreenedEdges, WavesAlongDarkEdgesPassItToo) {
  const double a = 1.5 * lambda;
  PolygonSoup tetrahedron;
  tetrahedron.points = {{a, a, a}, {a, -a, -a}, {-a, a, -a}, {-a, -a, a}};
  tetrahedron.polygons = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
  const double angle = 15.0;
  const SurfaceResponse there = response(laminate, 0, k, std::cos(angle * degree), false);
  const Direction look = deg(angle, 0.0);
  const ScatteringMatrix bare = edges_of(tetrahedron, {}, look, look),
                         behind = edges_of(under_screen(tetrahedron, -30.0 * lambda), {laminate}, look, look);
  const std::array<Complex, 2> through{there.transmitted.tm, there.transmitted.te};
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q) EXPECT_LT(std::abs(behind.at(p, q) - bare.at(p, q) * through[p] * through[q]), 1e-9);
}

// Of a plate half of which stands behind the screen, open + T^2 covered: the same two parts for any screen.
TEST(ScreenedEdges, OnlyWhatAScreenCoversIsChangedByIt) {
  const PolygonSoup plate = shapes::plate(5.0 * lambda);
  const double theta = 20.0;
  const Direction look = deg(theta, 0.0);
  const PolygonSoup half = under_screen(plate, 8.0 * lambda * std::tan(theta * degree));
  const ScatteringMatrix whole = edges_of(plate, {}, look, look);
  const auto covered = [&](const Material& material, int p) {
    const SurfaceResponse at = response(material, 0, k, std::cos(theta * degree), false);
    const Complex t = p == 0 ? at.transmitted.tm : at.transmitted.te;
    return (edges_of(half, {material}, look, look).at(p, p) - whole.at(p, p)) / (t * t - 1.0);
  };
  for (int p = 0; p < 2; ++p) {
    // The position of the cut is known to 1e-9 of an edge, and strips are cut into panels there.
    EXPECT_LT(std::abs(covered(laminate, p) - covered(film, p)), 1e-5 * std::abs(whole.at(p, p)));
    EXPECT_GT(std::abs(covered(film, p)), 0.05 * std::abs(whole.at(p, p)));
    EXPECT_GT(std::abs(covered(film, p) - whole.at(p, p)), 0.05 * std::abs(whole.at(p, p)));
  }
}

// A slab whose edges are those of a thin plate at one frequency and of a box at the other: two sets of edges.
TEST(ScreenedEdges, EveryFrequencyHasItsOwnEdges) {
  const PolygonSoup slab = shapes::box({5.0 * lambda, 5.0 * lambda, 0.05 * lambda});
  const Direction look = deg(25.0, 15.0);
  for (const int order : {1, 3}) {
    SolveOptions options{{}, {}, 1, false, {}};
    options.edges.order = order;
    options.edges.interaction = false;
    options.edges.materials = MaterialEdgeMethod::none;  // the screens' own rims are not looked for
    const auto solved = [&](const PolygonSoup& soup, const std::vector<Material>& materials) {
      std::vector<Material> at_both = materials;
      for (Material& material : at_both) material.layers.push_back(material.layers.front());
      const LoadedMesh loaded = build_mesh(soup, 1.0, "test", at_both);
      return solve(Target(loaded.mesh), {{frequency, 3.0 * frequency}, {{look, look}}, false, {}, at_both}, options).total;
    };
    const auto bare = solved(slab, {}), screened = solved(under_screen(slab, -30.0 * lambda), {nothing});
    for (const std::size_t f : {0, 1}) EXPECT_LT(difference(screened[f], bare[f]), 1e-9) << order << f;
  }
}

// Images divide what comes through screens, too, and leave nothing out: rounding of some thousand parts.
TEST(ScreenedEdges, ImagesAddUpBehindScreens) {
  const std::vector<Material> materials{laminate};
  const LoadedMesh loaded = build_mesh(under_screen(shapes::cube(3.0 * lambda), 0.5 * lambda), 1.0, "test", materials);
  const Direction look = deg(20.0, 15.0);
  const SolveOptions options{{}, {}, 1, false, {}};
  const Target target(loaded.mesh);
  const Sweep sweep{{frequency}, {{look, look}}, false, {}, materials};
  ScatteringMatrix sum;
  for (const ScatteringMatrix& cell : image_of_look(target, sweep, options, 0, 5.0).cells) sum += cell;
  EXPECT_LT(difference(sum, solve(target, sweep, options).total.front()), 1e-9);
}

}  // namespace
}  // namespace raytube
