// Rims of thin plates of finite size: rectangles and skew ones, scanned finely.
#include <gtest/gtest.h>

#include "edge_columns.h"
#include "validation/material_scene.h"

namespace raytube {

using namespace material_scene;

namespace {

Material film(double resistance) {
  Material material{"film", MaterialKind::thin_sheet, 0.0, {}};
  material.resistance = resistance;
  return material;
}

Material slab(Complex permittivity, Complex permeability, double thickness) {
  return layered(MaterialKind::sheet, {{{permittivity, permeability}, thickness}});
}

const Material dielectric = slab({4.0, -0.1}, 1.0, 1e-3), lossless = slab(10.0, 1.0, 0.5e-3),
               absorber = slab({16.9, -0.39}, {2.46, -1.95}, 1.5e-3);

PolygonSoup plate(std::vector<dvec3> corners) { return {std::move(corners), {{0, 1, 2, 3}}}; }

const PolygonSoup rectangle = plate({{-.05, -.04, 0}, {.05, -.04, 0}, {.05, .04, 0}, {-.05, .04, 0}}),
                  skew = plate({{-.05, -.04, 0}, {.055, -.03, 0}, {.04, .045, 0}, {-.045, .03, 0}});

SweepResult seen(PolygonSoup soup, const Material& material, const std::vector<Direction>& from, int order) {
  soup.materials.assign(soup.polygons.size(), 0);
  const LoadedMesh loaded = build_mesh(soup, 1.0, "test", std::span(&material, 1));
  SolveOptions options{{}, {}, 1, false, {}};
  options.edges.order = order;
  options.keep_parts = true;
  std::vector<Look> looks;
  for (const Direction& direction : from) looks.push_back({direction, direction});
  return solve(Target(loaded.mesh), {{frequency}, looks, false, {}, {material}}, options);
}

using test::of_edges;

std::vector<Direction> cut(double theta, double phi, const Direction& step, int count) {
  std::vector<Direction> all;
  for (int i = 0; i < count; ++i) all.push_back({theta * degree + i * step.theta, phi * degree + i * step.phi});
  return all;
}

// Strips of rims that are not parallel, seen from far off their cones: second differences over half a degree are 7e-4 m at most;
// where a pole was met in a direction without a wave, they were 3e-3 m to 550 m.
TEST(SheetRims, HaveNoSpikes) {
  for (const Material& material : {film(200.0), lossless, absorber})
    for (const PolygonSoup& soup : {rectangle, skew})
      for (const std::vector<Direction>& scan : {cut(90.0, 36.0, deg(0.0, 0.5), 28), cut(75.0, 44.9, deg(0.0, 0.01), 16),
                                                 cut(70.0, 0.0, deg(0.5, 0.0), 24), cut(36.0, 20.0, deg(0.5, 0.0), 24)}) {
        const std::vector<ScatteringMatrix> s = of_edges(seen(soup, material, scan, 3));
        double worst = 0.0;
        for (std::size_t i = 2; i < s.size(); ++i)
          worst = std::max(worst, frobenius_norm(s[i] - s[i - 1] - (s[i - 1] - s[i - 2])));
        EXPECT_LT(worst, 1e-3) << material.resistance << " " << scan.front().theta / degree << " " << scan.front().phi / degree;
      }
}

// Curl and divergence of a current are not apart there.
TEST(SheetRims, AreSteadyRoundNormalIncidence) {
  for (const Material& material : {film(200.0), dielectric, lossless, absorber})
    for (const double phi : {0.0, 30.0})
      for (int order = 1; order <= 3; ++order) {
        std::vector<Direction> towards;
        for (const double theta : {0.0, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1.0}) towards.push_back(deg(theta, phi));
        const SweepResult result = seen(rectangle, material, towards, order);
        const std::vector<ScatteringMatrix> s = of_edges(result);
        for (std::size_t i = 0; i < s.size(); ++i)
          EXPECT_LT(frobenius_norm(s[i] - s[0]), 0.01 * frobenius_norm(result.total[0]))
              << towards[i].theta / degree << " " << phi << " order " << order;
      }
}

const std::vector<Direction> around{deg(0.0, 0.0), deg(30.0, 20.0), deg(60.0, 0.0), deg(80.0, 10.0), deg(89.0, 90.0)};

std::vector<ScatteringMatrix> total(const Material& material, int order) {
  return seen(rectangle, material, around, order).total;
}

double apart(const std::vector<ScatteringMatrix>& a, const std::vector<ScatteringMatrix>& b) {
  double worst = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, difference(a[i], b[i]));
  return worst;
}

const Material conductor{"conductor", MaterialKind::conductor, 0.0, {}};

// 1e-9 of eta to its currents.
TEST(SheetRims, OfNoResistanceAreThoseOfAConductor) {
  EXPECT_LT(apart(total(film(0.0), 1), total(conductor, 1)), 1e-6);
  EXPECT_LT(apart(total(film(0.0), 3), total(film(1e-6), 3)), 1e-6);
  Material magnetic{"magnetic", MaterialKind::thin_sheet, 0.0, {}};
  magnetic.conductance = 0.0;
  for (const ScatteringMatrix& s : total(magnetic, 3)) EXPECT_TRUE(std::isfinite(frobenius_norm(s)));
}

// Ten micrometres of aluminium, k d |n| = 17: a conductor to 0.1 dB, and to 0.2 dB with strips at a degree from grazing.
TEST(SheetRims, OfFoilAreThoseOfAConductor) {
  const Material foil = slab({1.0, -3.8e7 / (2.0 * pi * frequency * 8.8541878128e-12)}, 1.0, 10e-6);
  EXPECT_LT(apart(total(foil, 1), total(conductor, 1)), 0.0115);
  EXPECT_LT(apart(total(foil, 3), total(film(0.0), 3)), 0.03);
}

}  // namespace
}  // namespace raytube
