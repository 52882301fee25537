// Edges of other materials than perfect conductors.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "solve/look_solver.h"
#include "solve/physical_bound.h"
#include "validation/material_scene.h"

namespace raytube {

using namespace material_scene;

namespace {

const double side = 5.0 * lambda;
const std::vector<double> frequencies{0.5 * frequency, frequency};

std::vector<std::pair<std::string, Material>> opaque_materials() {
  Material rough{"rough", MaterialKind::conductor, 0.05 * lambda, {}};
  std::vector<std::pair<std::string, Material>> all{
      {"coat", layered(MaterialKind::coated, {{{{4.0, -0.2}}, 2e-3}})},
      {"magnetic coat", layered(MaterialKind::coated, {{{{9.0, 0.0}, {2.0, 0.0}}, 2e-3}})},
      {"dielectric", half_space({5.0, -0.3})},
      {"absorber", {"absorber", MaterialKind::absorber, 0.0, {}}},
      {"rough conductor", rough}};
  for (auto& [name, material] : all)
    if (!material.layers.empty()) material.layers.push_back(material.layers.front());
  return all;
}

// Every look to an edge, along an edge, along a face and a little off these; the others at random.
std::vector<Direction> directions(std::mt19937_64& random) {
  std::vector<Direction> all;
  for (const double theta : {0.0, 30.0, 45.0, 85.0, 89.0, 89.9, 90.0 - 1e-5, 90.0, 135.0, 180.0})
    for (const double phi : {0.0, 1e-6, 0.3, 45.0, 90.0}) all.push_back(deg(theta, phi));
  std::uniform_real_distribution<double> cosine(-1.0, 1.0), turn(0.0, 2.0 * pi);
  for (int i = 0; i < 30; ++i) all.push_back({std::acos(cosine(random)), turn(random)});
  return all;
}

std::vector<Look> looks(bool bistatic) {
  std::mt19937_64 random(1958);
  const std::vector<Direction> all = directions(random);
  std::vector<Look> result;
  for (const Direction& transmit : all) {
    if (!bistatic) result.push_back({transmit, transmit});
    for (std::size_t i = 0; bistatic && i < all.size(); i += 7) result.push_back({transmit, all[i]});
  }
  return result;
}

SolveOptions with_edges(int order) {
  SolveOptions options{{}, {}, 1, false, {}};
  options.edges.order = order;
  options.edges.materials = MaterialEdgeMethod::fringe;
  options.keep_parts = true;
  return options;
}

// The largest share that the edges have of their bound.
double share_of_bound(PolygonSoup soup, const Material& material, const SolveOptions& options, bool bistatic) {
  soup.materials.assign(soup.polygons.size(), 0);
  const LoadedMesh loaded = build_mesh(soup, 1.0, "test", std::span(&material, 1));
  const Target target(loaded.mesh);
  const Sweep sweep{frequencies, looks(bistatic), bistatic, {}, {material}};
  const SolvePlan plan(target, sweep, options);
  const PhysicalBounds bounds(plan, LookSolver(plan).edge_lengths());
  const SweepResult result = solve(plan);
  for (const BeyondBound& part : result.statistics.beyond_bound)
    ADD_FAILURE() << part.part << ": " << part.rows << " rows, row " << part.worst << " " << part.ratio << " times its bound";
  double share = 0.0;
  for (std::size_t look = 0; look < sweep.looks.size(); ++look)
    for (std::size_t f = 0; f < frequencies.size(); ++f)
      share = std::max(share, largest_amplitude(result.of("material_edges_order_1")[sweep.row(look, f)]) /
                                  bounds.of(sweep.looks[look], f).limits.edges);
  return share;
}

TEST(MaterialEdges, NoneIsBeyondItsBound) {
  const std::vector<std::pair<const char*, PolygonSoup>> bodies{{"plate", shapes::plate(side)},
                                                                {"slab", shapes::box({side, side, 0.02 * side})},
                                                                {"box", shapes::box({side, side, 0.6 * side})}};
  double largest = 0.0;
  for (const auto& [name, material] : opaque_materials())
    for (const auto& [body, soup] : bodies)
      for (const bool bistatic : {false, true}) {
        SCOPED_TRACE(fmt::format("{} of {}{}", body, name, bistatic ? ", bistatic" : ""));
        const double share = share_of_bound(soup, material, with_edges(bistatic ? 1 : 3), bistatic);
        largest = std::max(largest, share);
        EXPECT_GT(share, 1e-4);  // they add something
        EXPECT_LT(share, 0.15);  // of 0.09: a term that stands alone where two of a conductor cancel is some 1e4
      }
  fmt::print("edges of materials: at most {:.2g} of their bound\n", largest);
}

// A film of 200 ohm, a disc of 24 corners as one polygon or as triangles round its middle.
ScatteringMatrix film_disc(bool fan, const Look& look) {
  constexpr std::uint32_t corners = 24;
  PolygonSoup soup;
  for (std::uint32_t i = 0; i < corners; ++i) {
    const double turn = 2.0 * pi * i / corners;
    soup.points.push_back(2.5 * lambda * dvec3(std::cos(turn), std::sin(turn), 0.0));
  }
  std::vector<std::uint32_t> whole(corners);
  std::iota(whole.begin(), whole.end(), 0u);
  if (!fan) soup.polygons.push_back(whole);
  for (std::uint32_t i = 2; fan && i < corners; ++i) soup.polygons.push_back({0, i - 1, i});
  soup.materials.assign(soup.polygons.size(), 0);
  Material film{"film", MaterialKind::thin_sheet, 0.0, {}};
  film.resistance = 200.0;
  const LoadedMesh loaded = build_mesh(soup, 1.0, "test", std::span(&film, 1));
  return solve(Target(loaded.mesh), {{frequency}, {look}, false, {}, {film}}, with_edges(3)).total.front();
}

// Points of a rim are on its sheet: triangles that meet there are no screens before it.
TEST(MaterialEdges, OfAPlateDoNotKnowItsTriangles) {
  for (const double theta : {20.0, 61.0, 90.0}) {
    const Look look{deg(theta, 17.0), deg(theta, 17.0)};
    const ScatteringMatrix whole = film_disc(false, look);
    EXPECT_TRUE(std::isfinite(frobenius_norm(whole)));
    EXPECT_LT(frobenius_norm(film_disc(true, look) - whole), 1e-9 * lambda);
  }
}

// Strips that meet an edge at 5e-6 rad are next to none: a plate whose corner is off by so much is the plate.
TEST(MaterialEdges, OfAPlateKnowNoCornerThatIsOffByNothing) {
  const Material coat = layered(MaterialKind::coated, {{{{4.0, -0.2}}, 2e-3}});
  const auto edges = [&](double off) {
    PolygonSoup soup = shapes::plate(side);
    soup.points[2].x += off * side;
    soup.materials.assign(soup.polygons.size(), 0);
    const LoadedMesh loaded = build_mesh(soup, 1.0, "test", std::span(&coat, 1));
    const Look look{deg(50.0, 0.0), deg(50.0, 0.0)};
    Material one = coat;
    one.layers.resize(1);
    return solve(Target(loaded.mesh), {{frequency}, {look}, false, {}, {one}}, with_edges(3))
        .of("material_edges_order_2_on")
        .front();
  };
  EXPECT_GT(frobenius_norm(edges(0.0)), 1e-5 * lambda);
  EXPECT_LT(frobenius_norm(edges(5e-6) - edges(0.0)), 1e-3 * lambda);
}

// What strips over a coat add, a row of directions each.
std::vector<ScatteringMatrix> over_coat(PolygonSoup soup, const std::vector<Look>& looks, const std::vector<double>& sweep) {
  Material coat = layered(MaterialKind::coated, {{{{4.0, -0.01}}, 1e-3}});
  coat.layers.resize(sweep.size(), coat.layers.front());
  soup.materials.assign(soup.polygons.size(), 0);
  const LoadedMesh loaded = build_mesh(soup, 1.0, "test", std::span(&coat, 1));
  return solve(Target(loaded.mesh), {sweep, looks, true, {}, {coat}}, with_edges(2)).of("material_edges_order_2_on");
}

std::vector<Look> round_at(double theta, double step) {
  std::vector<Look> looks;
  for (double phi = 0.01; phi < 360.0; phi += step) looks.push_back({deg(theta, phi), deg(theta, phi)});
  return looks;
}

PolygonSoup rectangle() {
  PolygonSoup soup = shapes::plate(0.1);
  for (dvec3& point : soup.points) point.y *= 0.8;
  return soup;
}

PolygonSoup skew_plate() {
  PolygonSoup soup = shapes::plate(side);
  const std::array<dvec3, 4> off{dvec3(0.0, 0.1, 0.0), dvec3(0.05, -0.15, 0.0), dvec3(-0.1, 0.05, 0.0), dvec3(0.05, -0.1, 0.0)};
  for (std::size_t i = 0; i < off.size(); ++i) soup.points[i] += side * off[i];
  return soup;
}

// A coat that guides a wave: its pole is nowhere in step with an observer, of edges that strips meet at any angles. Each row is
// half-way between its neighbours, and reciprocal, as far as strips are.
TEST(MaterialEdges, OfCoatsHaveNoSpikes) {
  const std::vector<std::pair<const char*, PolygonSoup>> bodies{{"rectangle", rectangle()},
                                                                {"skew plate", skew_plate()},
                                                                {"slab", shapes::box({0.1, 0.08, 0.004})},
                                                                {"cube", shapes::box({0.09, 0.09, 0.09})}};
  for (const auto& [name, soup] : bodies)
    for (const double theta : {30.0, 60.0, 75.0}) {
      SCOPED_TRACE(fmt::format("{}, {} degrees", name, theta));
      const std::vector<ScatteringMatrix> s = over_coat(soup, round_at(theta, 1.0), {frequency});
      double largest = 0.0, spike = 0.0, one_way = 0.0;
      for (std::size_t i = 1; i + 1 < s.size(); ++i) {
        ScatteringMatrix mean = s[i - 1];
        mean += s[i + 1];
        largest = std::max(largest, frobenius_norm(s[i]));
        spike = std::max(spike, frobenius_norm(s[i] - (mean *= 0.5)));
        one_way = std::max(one_way, std::abs(s[i].at(0, 1) - s[i].at(1, 0)));
      }
      fmt::print("{} {}: {:.2g} m, {:.2g} beside its neighbours, {:.2g} one way\n", name, theta, largest, spike, one_way);
      EXPECT_LT(largest, 1.5 * lambda);
      EXPECT_LT(spike, 0.15 * largest);
      EXPECT_LT(one_way, 0.4 * largest);
    }
}

// A row of a sweep is what it is alone, wherever in the sweep. Steps of k l are powers of 2.
TEST(MaterialEdges, OfCoatsDoNotDependOnTheSweep) {
  const std::vector<Look> looks{{deg(30.0, 90.0), deg(30.0, 90.0)}, {deg(60.0, 20.0), deg(60.0, 20.0)}};
  const std::vector<double> sweep{9e9, 8e9, 4e9, 8.1e9};
  const std::vector<ScatteringMatrix> all = over_coat(shapes::plate(side), looks, sweep);
  for (std::size_t f = 0; f < sweep.size(); ++f) {
    const std::vector<ScatteringMatrix> alone = over_coat(shapes::plate(side), looks, {sweep[f]});
    for (std::size_t look = 0; look < looks.size(); ++look)
      EXPECT_LT(frobenius_norm(all[look * sweep.size() + f] - alone[look]), 1e-9 * frobenius_norm(alone[look]))
          << look << " " << sweep[f];
  }
}

}  // namespace
}  // namespace raytube
