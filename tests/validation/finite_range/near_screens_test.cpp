// Edges behind screens, from antennas at a finite distance.
#include <gtest/gtest.h>

#include "edge_columns.h"
#include "run.h"
#include "solve/image.h"
#include "utd/wedge/edge_currents.h"
#include "validation/material_scene.h"
#include "validation/point_waves.h"

namespace raytube {

using namespace material_scene;
using namespace point_waves;

namespace {

const Material laminate = layered(MaterialKind::sheet, {{{{4.0, -0.1}}, 3e-3}}),
               nothing = layered(MaterialKind::sheet, {{{{1.0, 0.0}}, 3e-3}});
constexpr double height = 0.24;

// A rectangle above `body`.
PolygonSoup under_screen(const PolygonSoup& body, double x_begin) {
  const double far = 0.3;
  PolygonSoup both = body;
  both.materials.assign(body.polygons.size(), no_index);
  const auto first = static_cast<std::uint32_t>(both.points.size());
  both.points.insert(both.points.end(),
                     {{x_begin, -far, height}, {far, -far, height}, {far, far, height}, {x_begin, far, height}});
  both.polygons.push_back({first, first + 1, first + 2, first + 3});
  both.materials.push_back(0);
  return both;
}

// What edges add, without edge-face interaction, which scenes with materials have not.
ScatteringMatrix edges_of(const PolygonSoup& soup, const std::vector<Material>& materials, const Look& look, int order = 3) {
  SolveOptions options = testing::options(EdgeMethod::fringe, 2.0);
  options.tubes.max_bounces = 1;
  options.edges.order = order;
  options.edges.interaction = false;
  options.edges.materials = MaterialEdgeMethod::none;  // the screens' own rims are not looked for
  const bool bistatic = !(look.transmit == look.receive && look.transmit_range == look.receive_range);
  const LoadedMesh loaded = build_mesh(soup, 1.0, "test", materials);
  const SweepResult result = solve(Target(loaded.mesh), {{frequency}, {look}, bistatic, {}, materials}, options);
  return test::of_edges(result)[0];
}

// As ScreenedEdges.AScreenOfVacuumChangesNothing: the strips of parts of edges have other panels than those of whole ones.
TEST(NearScreens, AScreenOfVacuumChangesNothing) {
  for (const PolygonSoup& body :
       {shapes::plate(5.0 * lambda), shapes::cube(3.0 * lambda), shapes::dihedral(4.0 * lambda, 3.0 * lambda)})
    for (const int order : {1, 3})
      for (const double begin : {-0.3, 3.1 * lambda})
        for (const Look& look : {near_look(deg(20.0, 15.0), 1.2), near_look(deg(20.0, 15.0), deg(35.0, 70.0), 1.2, 1.0)}) {
          const double tolerance = order == 3 && begin > 0.0 ? 1e-3 : 1e-9;
          EXPECT_LT(difference(edges_of(under_screen(body, begin), {nothing}, look, order), edges_of(body, {}, look, order)),
                    tolerance);
        }
}

// As FiniteRange.TendsToTheFarField: below 0.01 dB at 10^4 D^2 / lambda, D that of the bodies.
TEST(NearScreens, LongRangesAreTheFarField) {
  for (const PolygonSoup& body : {shapes::plate(5.0 * lambda), shapes::cube(3.0 * lambda)})
    for (const double begin : {-0.3, 3.1 * lambda})
      for (const Direction& receive : {deg(20.0, 15.0), deg(35.0, 70.0)}) {
        const double diameter = 5.0 * std::numbers::sqrt2 * lambda, range = 1e4 * diameter * diameter / lambda;
        const PolygonSoup soup = under_screen(body, begin);
        const ScatteringMatrix limit = edges_of(soup, {laminate}, {deg(20.0, 15.0), receive}),
                               s = edges_of(soup, {laminate}, near_look(deg(20.0, 15.0), receive, range, range));
        EXPECT_LT(difference(s, limit), 1.15e-3);
      }
}

// What V and H of a wave are behind a plane z = const, in units of themselves.
ChannelWeights behind_plane(const PointWave& wave) {
  const dvec3 t = glm::normalize(glm::cross(wave.direction, dvec3(0, 0, 1))), other = glm::cross(wave.direction, t);
  const SurfaceResponse::Polarised through = response(laminate, 0, k, -wave.direction.z, false).transmitted;
  ChannelWeights weights;
  for (const int q : {0, 1})
    for (const int p : {0, 1}) {
      const dvec3 &e = wave.field[q], &unit = wave.field[p];
      weights[q][p] =
          (through.te * glm::dot(e, t) * glm::dot(unit, t) + through.tm * glm::dot(e, other) * glm::dot(unit, other)) /
          glm::dot(unit, unit);
    }
  return weights;
}

// First order: the amplitude of each bit of an edge, of a 400th of a wavelength, in the waves that reach it.
ScatteringMatrix by_quadrature(const PolygonSoup& soup, const Look& look, double x_begin) {
  ScatteringMatrix sum;
  const TriangleMesh mesh = build_mesh(soup, 1.0).mesh;
  const Target target(mesh);
  const dvec3 antennas[] = {look.transmit_range * spherical_basis(look.transmit).radial,
                            look.receive_range * spherical_basis(look.receive).radial};
  const auto weights = [&](const PointWave& wave, const dvec3& r, const dvec3& antenna) {
    const bool covered = glm::mix(r, antenna, (height - r.z) / (antenna.z - r.z)).x > x_begin;
    return covered ? behind_plane(wave) : ChannelWeights{{{1.0, 0.0}, {0.0, 1.0}}};
  };
  for (const Wedge& wedge : target.wedges) {
    const int steps = static_cast<int>(std::ceil(400.0 * wedge.length() / lambda));
    for (int i = 0; i < steps; ++i) {
      const dvec3 r = glm::mix(wedge.start, wedge.end, (i + 0.5) / steps);
      const PointWave in = wave_at(look.transmit, look.transmit_range, r), out = wave_at(look.receive, look.receive_range, r);
      LookVectors local{in.direction, -out.direction, in.field, {}, out.field};
      for (const int q : {0, 1}) local.magnetic[q] = glm::cross(in.direction, in.field[q]);
      bool windowed = false;
      const ScatteringMatrix bare = amplitude_at(edge_amplitude(wedge, incidence_on(wedge, in.direction), local), k, windowed);
      const ChannelWeights there = weights(in, r, antennas[0]), back = weights(out, r, antennas[1]);
      const Complex phasor = std::polar(wedge.length() / steps, -k * (in.path + out.path));
      for (const int p : {0, 1})
        for (const int q : {0, 1})
          for (const int a : {0, 1})
            for (const int b : {0, 1}) sum.at(p, q) += phasor * back[p][a] * bare.at(a, b) * there[q][b];
    }
  }
  return sum;
}

// What pieces that are plane to 0.1 rad leave of a plate alone, 0.6 and 4.6 per cent of S, is what they leave behind screens.
TEST(NearScreens, FirstOrderIsTheQuadratureOfItsEdges) {
  const PolygonSoup plate = shapes::plate(5.0 * lambda);
  for (const double begin : {-0.3, 1.3 * lambda})
    for (const Look& look : {near_look(deg(20.0, 15.0), 0.8), near_look(deg(20.0, 15.0), deg(35.0, 70.0), 0.8, 1.0)}) {
      const ScatteringMatrix expected = by_quadrature(plate, look, begin), bare = edges_of(plate, {}, look, 1);
      const double found = difference(edges_of(under_screen(plate, begin), {laminate}, look, 1), expected),
                   of_plate = difference(bare, by_quadrature(plate, look, 1.0));
      testing::measured("edges behind a sheet, finite range, against quadrature", found, "");
      EXPECT_LT(found, 1.2 * of_plate);
      EXPECT_LT(of_plate, 0.05);
      EXPECT_GT(difference(bare, expected), 0.1);
    }
}

// Images divide what comes through screens, too, and leave nothing out: rounding of some thousand parts.
TEST(NearScreens, ImagesAddUp) {
  const std::vector<Material> materials{laminate};
  const LoadedMesh loaded = build_mesh(under_screen(shapes::cube(3.0 * lambda), 0.5 * lambda), 1.0, "test", materials);
  const SolveOptions options{{}, {}, 1, false, {}};
  const Target target(loaded.mesh);
  const Sweep sweep{{frequency}, {near_look(deg(20.0, 15.0), 1.2)}, false, {}, materials};
  ScatteringMatrix sum;
  for (const ScatteringMatrix& cell : image_of_look(target, sweep, options, 0, 5.0).cells) sum += cell;
  EXPECT_LT(difference(sum, solve(target, sweep, options).total.front()), 1e-9);
}

}  // namespace
}  // namespace raytube
