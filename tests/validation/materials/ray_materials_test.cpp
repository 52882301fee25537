// edges.method = "utd" where not all is a perfect conductor: rays with the coefficients of what they meet.
#include <gtest/gtest.h>

#include <random>

#include "run.h"
#include "validation/material_scene.h"

namespace raytube {

using namespace material_scene;

namespace {

const Material glass = half_space({4.0, -0.5}), coat = layered(MaterialKind::coated, {{{{3.0, -0.2}}, 3.1e-3}}),
               laminate = layered(MaterialKind::sheet, {{{{4.0, -0.1}}, 3e-3}, {{{2.0, -0.6}}, 1e-3}}),
               nothing = layered(MaterialKind::sheet, {{{{1.0, 0.0}}, 3e-3}});
constexpr double range = 2.0;

struct RayScene {
  PolygonSoup soup;
  std::vector<Material> materials{};

  SweepResult seen(const Look& look, double utd_range = range) const {
    SolveOptions options = testing::options(EdgeMethod::utd);
    options.edges.utd_range = look.far() ? utd_range : 0.0;
    const bool bistatic = !(look.transmit == look.receive && look.transmit_range == look.receive_range);
    return solve(Target(build_mesh(soup, 1.0, "test", materials).mesh), {{frequency}, {look}, bistatic, {}, materials}, options);
  }
};

PolygonSoup made_of(PolygonSoup soup, std::vector<std::uint32_t> of) {
  soup.materials = of.size() == 1 ? std::vector(soup.polygons.size(), of[0]) : std::move(of);
  return soup;
}

PolygonSoup both(const PolygonSoup& first, const PolygonSoup& second) {
  PolygonSoup all = shapes::joined(first, second);
  all.materials.insert(all.materials.end(), second.materials.begin(), second.materials.end());
  return all;
}

// Of a dihedral, of two triangles each.
std::vector<std::uint32_t> faces(std::uint32_t first, std::uint32_t second) { return {first, first, second, second}; }

// A conductor under a rectangle of material 0, which it overhangs up to x_begin, tilted so that its normal is like no other.
PolygonSoup under_sheet(const PolygonSoup& body, double x_begin, double tilt = 0.0) {
  PolygonSoup all = made_of(body, {no_index});
  const auto first = static_cast<std::uint32_t>(all.points.size());
  for (const dvec2& at : {dvec2(x_begin, -0.3), dvec2(0.3, -0.3), dvec2(0.3, 0.3), dvec2(x_begin, 0.3)})
    all.points.push_back({at.x, at.y, 0.25 + tilt * (at.x + 0.5 * at.y)});
  all.polygons.push_back({first, first + 1, first + 2, first + 3});
  all.materials.push_back(0);
  return all;
}

Complex bounce(const SweepResult& result, std::size_t reflections, int channel) {
  return result.bounces.at(reflections - 1).at(0).at(channel, channel);
}

// Two figures of the phases k range = 4e2 and of range^2 in them, relative to a mirror's range / 2.
constexpr double rounding = 1e-11;

TEST(RayMaterials, AMirrorHasTheReflectionOfItsMaterial) {
  Material rough = glass;
  rough.roughness = 2e-3;
  const PolygonSoup plate = shapes::plate(0.3);
  for (const Material& material : {glass, coat, laminate, rough})
    for (const double theta : {5.0, 30.0, 64.0, 150.0}) {
      const Look look{deg(theta, 0.0), deg(theta, 180.0)};
      const SweepResult metal = RayScene{plate}.seen(look), s = RayScene{made_of(plate, {0}), {material}}.seen(look);
      const SurfaceResponse::Polarised r =
          response(material, 0, k, std::abs(std::cos(theta * degree)), theta > 90.0).reflected;  // V is TM, and H is TE
      EXPECT_LT(std::abs(bounce(s, 1, 0) / bounce(metal, 1, 0) - r.tm), rounding) << material.name << theta;
      EXPECT_LT(std::abs(bounce(s, 1, 1) / bounce(metal, 1, 1) + r.te), rounding) << material.name << theta;
    }
}

// The way to the corner line and back: over one face at phi from its plane, over the other at 90 degrees less. The search for
// paths ends 1e-7 of the target beside the receiver.
TEST(RayMaterials, ADihedralHasTheProductOfBothFaces) {
  const PolygonSoup corner = shapes::dihedral(0.3, 0.3);
  for (const double phi : {20.0, 45.0, 73.0}) {
    const Look look{deg(90.0, phi), deg(90.0, phi)};
    const SweepResult metal = RayScene{corner}.seen(look), s = RayScene{made_of(corner, faces(0, 1)), {glass, coat}}.seen(look);
    const double cosine = std::sin(phi * degree), other = std::cos(phi * degree);  // the first face lies in y = 0
    const auto a = response(glass, 0, k, cosine, false).reflected, b = response(coat, 0, k, other, false).reflected;
    EXPECT_LT(std::abs(bounce(s, 2, 0) / bounce(metal, 2, 0) - a.te * b.te), 1e-6) << phi;
    EXPECT_LT(std::abs(bounce(s, 2, 1) / bounce(metal, 2, 1) - a.tm * b.tm), 1e-6) << phi;
  }
}

// Coefficients differ from a conductor's by 2 / sqrt(epsilon) / cosine.
TEST(RayMaterials, AConductorIsTheLimit) {
  const Material limit = half_space({-1e24, -1e24}), bare = layered(MaterialKind::coated, {{{{3.0, -0.2}}, 0.0}}),
                 conductor{"conductor", MaterialKind::conductor, 0.0, {}};
  const Look looks[] = {{deg(70.0, 33.0), deg(70.0, 33.0)},
                        {deg(70.0, 33.0), deg(60.0, 51.0)},
                        {deg(70.0, 33.0), deg(60.0, 51.0), 1.5, 1.2},
                        {deg(70.0, 33.0), deg(110.0, 213.0)}};
  for (const Material& material : {limit, bare, conductor})
    for (const PolygonSoup& soup : {shapes::plate(0.3), shapes::dihedral(0.3, 0.2), shapes::trihedral(0.3), shapes::cube(0.2)})
      for (const Look& look : looks) {
        const SweepResult metal = RayScene{soup}.seen(look), s = RayScene{made_of(soup, {0}), {material}}.seen(look);
        ASSERT_EQ(s.bounces.size(), metal.bounces.size());
        for (std::size_t i = 0; i < s.bounces.size(); ++i)
          EXPECT_LT(frobenius_norm(s.bounces[i][0] - metal.bounces[i][0]), 1e-9) << i;
        EXPECT_EQ(frobenius_norm(s.of("edges_order_1")[0]), 0.0);
      }
}

// The edges that the conductor's wedges make with one another stay as they are.
TEST(RayMaterials, OnlyWedgesOfConductorsDiffract) {
  const PolygonSoup alone = shapes::plate(0.2), beside = shapes::transformed(alone, glm::dmat3(1.0), 1.0, {0.5, 0.0, 0.0}),
                    two = both(made_of(alone, {no_index}), made_of(beside, {0}));
  const Look look{deg(40.0, 20.0), deg(30.0, 100.0)};
  const ScatteringMatrix expected = RayScene{alone}.seen(look).of("edges_order_1")[0];
  // Of 8 mm; what the other plate hides of the first one's edges is nothing from above.
  EXPECT_LT(frobenius_norm(RayScene{two, {glass}}.seen(look).of("edges_order_1")[0] - expected), 1e-10);
  EXPECT_GT(frobenius_norm(expected), 0.005);
}

TEST(RayMaterials, ASheetOfVacuumIsNotThere) {
  const PolygonSoup beside{{{0, -0.1, 0}, {0.2, -0.1, 0}, {0.2, 0.1, 0}, {0, 0.1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const Look looks[] = {{deg(40.0, 33.0), deg(40.0, 33.0)},
                        {deg(40.0, 33.0), deg(60.0, 51.0)},
                        {deg(40.0, 33.0), deg(50.0, 51.0), 1.5, 1.2},
                        {deg(30.0, 0.0), deg(30.0, 180.0)},    // reflection boundary of `beside`
                        {deg(30.0, 0.0), deg(150.0, 180.0)}};  // its shadow boundary
  for (const PolygonSoup& body : {shapes::plate(0.2), shapes::cube(0.1), shapes::dihedral(0.2, 0.2), beside})
    for (const double begin : {-0.3, 0.05})
      for (const double tilt : {0.0, 0.2})
        for (const Look& look : looks) {
          const ScatteringMatrix expected = RayScene{body}.seen(look).total[0];
          const ScatteringMatrix s = RayScene{under_sheet(body, begin, tilt), {nothing}}.seen(look).total[0];
          EXPECT_LT(frobenius_norm(s - expected), 1e-9) << begin << ' ' << tilt;
        }
}

// In the plane phi = 0 V is TM and H is TE. From 1e4 m all rays are parallel to 3e-5.
TEST(RayMaterials, WavesPassASheetTwice) {
  const double in = 20.0, out = 35.0, far = 1e4;
  const PolygonSoup plate = shapes::plate(0.2);
  const auto t = [&](double theta, int p) {
    const SurfaceResponse::Polarised through = response(laminate, 0, k, std::cos(theta * degree), false).transmitted;
    return p == 0 ? through.tm : through.te;
  };
  for (const Look& look : {Look{deg(in, 0.0), deg(out, 180.0)}, Look{deg(in, 0.0), deg(in, 180.0)}}) {
    const double to = look.receive.theta / degree;
    const SweepResult bare = RayScene{plate}.seen(look, far), sheet = RayScene{under_sheet({}, -0.3), {laminate}}.seen(look, far),
                      s = RayScene{under_sheet(plate, -0.3), {laminate}}.seen(look, far);
    for (const int p : {0, 1}) {
      const auto edges = [&](const SweepResult& of) { return of.of("edges_order_1")[0].at(p, p); };
      EXPECT_LT(std::abs(edges(s) / edges(bare) - t(in, p) * t(to, p)), 1e-3);
      if (to != in) continue;
      const Complex behind = bounce(s, 1, p) - bounce(sheet, 1, p);
      EXPECT_LT(std::abs(behind / bounce(bare, 1, p) - t(in, p) * t(in, p)), 1e-3);
    }
  }
}

// All that arrives behind a sheet is T of the direct ray; of the sheet's two sides the second is as the first one.
TEST(RayMaterials, TheDirectRayPassesASheet) {
  for (const double theta : {35.0, 145.0}) {
    const Look look{deg(theta, 0.0), deg(180.0 - theta, 180.0)};
    PolygonSoup plate = made_of(shapes::plate(0.3), {0});
    const SweepResult s = RayScene{plate, {laminate}}.seen(look), hidden = RayScene{shapes::plate(0.3)}.seen(look);
    const SurfaceResponse::Polarised t = response(laminate, 0, k, std::cos(35.0 * degree), theta > 90.0).transmitted;
    EXPECT_LT(std::abs(1.0 - bounce(s, 1, 0) / bounce(hidden, 1, 0) - t.tm), rounding);
    EXPECT_LT(std::abs(1.0 - bounce(s, 1, 1) / bounce(hidden, 1, 1) - t.te), rounding);
  }
}

TEST(RayMaterials, BistaticLooksAreReciprocal) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> theta(0.05, pi - 0.05), phi(-pi, pi);
  const PolygonSoup corner = shapes::transformed(shapes::dihedral(0.3, 0.3), glm::dmat3(1.0), 1.0, {-0.2, -0.2, -0.1}),
                    two = both(under_sheet(shapes::cube(0.1), -0.1, 0.3), made_of(corner, faces(1, 2)));
  const RayScene scene{two, {laminate, glass, coat}};
  for (int i = 0; i < 40; ++i) {
    const Direction a{theta(random), phi(random)}, b{theta(random), phi(random)};
    for (const auto& [there, back] : {std::pair(Look{a, b}, Look{b, a}), {Look{a, b, 1.5, 1.9}, Look{b, a, 1.9, 1.5}}}) {
      const ScatteringMatrix s = scene.seen(there).total[0], other = scene.seen(back).total[0];
      for (const int p : {0, 1})
        for (const int q : {0, 1}) EXPECT_LT(std::abs(s.at(p, q) - other.at(q, p)), 1e-9);
    }
  }
}

TEST(RayMaterials, EveryFrequencyHasItsOwnCoefficients) {
  Material sheet = laminate;
  sheet.layers.push_back({{{{2.0, -0.3}}, 3e-3}});
  const Look look{deg(30.0, 0.0), deg(30.0, 180.0)};
  SolveOptions options = testing::options(EdgeMethod::utd);
  options.edges.utd_range = range;
  const PolygonSoup soup = under_sheet(shapes::plate(0.2), -0.3);
  const Target target(build_mesh(soup, 1.0, "test", std::vector{sheet}).mesh);
  const std::vector<double> frequencies{frequency, 1.3 * frequency};
  const auto both = solve(target, {frequencies, {look}, true, {}, {sheet}}, options).total;
  for (const std::size_t f : {0, 1}) {
    const auto one =
        solve(target, {{frequencies[f]}, {look}, true, {}, at_frequencies({sheet}, std::span(&f, 1))}, options).total;
    EXPECT_LT(frobenius_norm(both[f] - one[0]), 1e-12);
  }
}

}  // namespace
}  // namespace raytube
