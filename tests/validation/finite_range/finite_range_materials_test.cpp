// Antennas at a finite distance before other than perfect conductors: brute-force quadrature, limits and invariances.
#include <gtest/gtest.h>

#include <functional>

#include "validation/material_scene.h"
#include "validation/point_waves.h"
#include "run.h"
#include "solve/solve.h"

namespace raytube {

using namespace material_scene;
using namespace point_waves;

namespace {

const Material glass = half_space({4.0, -0.02}), coat = layered(MaterialKind::coated, {{{{3.0, -0.2}}, 3.1e-3}}),
               window = layered(MaterialKind::sheet, {{{{4.0, -0.1}}, 3e-3}}),
               vacuum = layered(MaterialKind::sheet, {{{{1.0, 0.0}}, 3e-3}});
constexpr double width = 0.15;

Material resistive() {
  Material sheet{"film", MaterialKind::thin_sheet, 0.0, {}};
  sheet.resistance = 100.0;
  return sheet;
}

ScatteringMatrix seen(const Scene& scene, const Look& look) {
  return scene.solved({look}, !(look.transmit == look.receive && look.transmit_range == look.receive_range)).front();
}

// E behind or after a plane z = const as that of a plane wave: t along d x n.
struct Leaving {
  ComplexVector reflected, transmitted;
};
Leaving at_plane(const Material& material, const dvec3& d, const dvec3& e) {
  const dvec3 n(0.0, 0.0, d.z < 0.0 ? 1.0 : -1.0), across = glm::cross(d, n);
  const dvec3 t = glm::length(across) > 0.0 ? glm::normalize(across) : dvec3(1.0, 0.0, 0.0), d_r(d.x, d.y, -d.z);
  const SurfaceResponse at = response(material, 0, k, std::abs(d.z), false);
  const double te = glm::dot(e, t), tm = glm::dot(e, glm::cross(d, t));
  return {at.reflected.te * te * t + at.reflected.tm * tm * glm::cross(d_r, t),
          at.transmitted.te * te * t + at.transmitted.tm * tm * glm::cross(d, t)};
}

Complex dot(const ComplexVector& a, const ComplexVector& b) {
  return {glm::dot(a.re, b.re) - glm::dot(a.im, b.im), glm::dot(a.re, b.im) + glm::dot(a.im, b.re)};
}

using Integrand = std::function<Complex(const PointWave& in, const PointWave& out, int p, int q)>;

// Over a plate in z = 0 by the midpoint rule, received by reaction.
ScatteringMatrix by_quadrature(const Look& look, int steps, const Integrand& reaction) {
  ScatteringMatrix sum;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const dvec3 r((i + 0.5) / steps * width - width / 2, (j + 0.5) / steps * width - width / 2, 0.0);
      const PointWave in = wave_at(look.transmit, look.transmit_range, r), out = wave_at(look.receive, look.receive_range, r);
      const Complex phasor = std::polar(width * width / (double(steps) * steps), -k * (in.path + out.path));
      for (int q = 0; q < 2; ++q)
        for (int p = 0; p < 2; ++p) sum.at(p, q) += Complex(0.0, -k / (4.0 * pi)) * reaction(in, out, p, q) * phasor;
    }
  return sum;
}

// E_p . eta J - eta H_p . M of what the tangential fields of both sides differ by.
Integrand currents_on(const Material& material) {
  return [&material](const PointWave& in, const PointWave& out, int p, int q) {
    const dvec3 n(0.0, 0.0, in.direction.z < 0.0 ? 1.0 : -1.0), d_r(in.direction.x, in.direction.y, -in.direction.z);
    const Leaving leaving = at_plane(material, in.direction, in.field[q]);
    const ComplexVector passing = ComplexVector{in.field[q]} - leaving.transmitted,
                        eta_j = cross(n, cross(in.direction, passing) + cross(d_r, leaving.reflected)),
                        m = cross(-n, passing + leaving.reflected);
    return raytube::dot(eta_j, out.field[p]) - raytube::dot(m, glm::cross(out.direction, out.field[p]));
  };
}

// A conductor behind a sheet: both antennas' waves are those behind it.
Complex conductor_behind(const Material& sheet, const PointWave& in, const PointWave& out, int p, int q) {
  const dvec3 n(0.0, 0.0, 1.0);
  const ComplexVector arriving = at_plane(sheet, in.direction, in.field[q]).transmitted,
                      received = at_plane(sheet, out.direction, out.field[p]).transmitted,
                      eta_j = Complex(2.0) * cross(n, cross(in.direction, arriving));
  return dot(received, eta_j);
}

// The largest difference of a co-polar level within 30 dB of the peak over ranges and angles [dB].
double largest_difference(const std::function<ScatteringMatrix(const Look&)>& solve, const Integrand& reaction, double last) {
  double largest = 0.0;
  for (const double range : {0.2, 0.5, 2.0, 50.0}) {
    const double peak = std::abs(by_quadrature(near_look({0, 0}, range), 400, reaction).vv());
    for (double theta = 0.0; theta < last; theta += 6.5) {
      const Look look = near_look({theta * degree, 0.3}, range);
      const ScatteringMatrix expected = by_quadrature(look, 400, reaction), s = solve(look);
      for (const int c : {0, 1})
        if (std::abs(expected.at(c, c)) > peak * std::pow(10.0, -30.0 / 20.0))
          largest = std::max(largest, level_difference(s.at(c, c), expected.at(c, c)));
    }
  }
  return largest;
}

// As FiniteRange.PlateIsBruteForcePhysicalOptics: the midpoint rule itself is off by 3e-4. From 0.2 m the plate spans 40 degrees,
// over which all coefficients change.
TEST(FiniteRangeMaterials, PlatesAreBruteForcePhysicalOptics) {
  for (const auto& [name, material] :
       {std::pair("half-space", glass), {"coat", coat}, {"sheet", window}, {"film", resistive()}}) {
    const Scene plate{shapes::plate(width), {material}};
    const double largest = largest_difference([&](const Look& look) { return seen(plate, look); }, currents_on(material), 45.0);
    testing::measured((std::string("finite range, ") + name + " plate against quadrature").c_str(), largest, "dB");
    EXPECT_LT(largest, 0.02) << name;
  }
}

// Brewster's angle of 63 degrees, where TM vanishes, and grazing lie on the plate, which is seen from 8 cm above its plane and
// 25 cm from its middle; and the receiver elsewhere, on either side.
TEST(FiniteRangeMaterials, AntennasMayStandApartAndLow) {
  for (const Material& material : {glass, coat, window}) {
    const Scene plate{shapes::plate(width), {material}};
    for (const Look& look : {near_look({25 * degree, 0.3}, {50 * degree, 2.0}, 0.4, 0.9), near_look({71 * degree, 0.1}, 0.25),
                             near_look({71 * degree, 0.1}, {60 * degree, 3.3}, 0.25, 0.3),
                             near_look({30 * degree, 0.3}, {140 * degree, 3.0}, 0.4, 0.5)}) {
      const ScatteringMatrix expected = by_quadrature(look, 400, currents_on(material));
      EXPECT_LT(frobenius_norm(seen(plate, look) - expected), 1e-3 * frobenius_norm(expected)) << material.name;
    }
  }
}

// Uniform tubes take coefficients where their rays meet the plate. What cells leave is what they leave of a conductor: their
// stairs.
TEST(FiniteRangeMaterials, UniformTubesAgree) {
  const Look look = near_look({20 * degree, 0.0}, 0.5);
  TubeOptions tubes;
  tubes.mode = TubeMode::uniform;
  tubes.per_wavelength = 20.0;
  for (const Material& material : {glass, coat, window}) {
    const ScatteringMatrix expected = by_quadrature(look, 400, currents_on(material));
    EXPECT_LT(difference(seen({shapes::plate(width), {material}, tubes}, look), expected), 0.01);
  }
}

// A rectangle at this height, from x on, of materials[0], above `body`.
PolygonSoup under(const PolygonSoup& body, double z, double side, double x_begin) {
  PolygonSoup both = body;
  both.materials.assign(body.polygons.size(), no_index);
  const auto first = static_cast<std::uint32_t>(both.points.size());
  both.points.insert(both.points.end(), {{x_begin, -side, z}, {side, -side, z}, {side, side, z}, {x_begin, side, z}});
  both.polygons.push_back({first, first + 1, first + 2, first + 3});
  both.materials.push_back(0);
  return both;
}

constexpr double height = 0.03, half_screen = 0.09;

// The plate and nothing of the sheet, no wave to and fro.
ScatteringMatrix behind(const Material& sheet, const Look& look, double x_begin = -half_screen, TubeOptions tubes = {}) {
  tubes.max_bounces = 2;
  const auto of = [&](const PolygonSoup& body) {
    return seen({under(body, height, half_screen, x_begin), {sheet}, tubes}, look);
  };
  return of(shapes::plate(width)) - of({});
}

TEST(FiniteRangeMaterials, APlateBehindASheetIsBruteForcePhysicalOptics) {
  const double largest = largest_difference(
      [&](const Look& look) { return behind(window, look); },
      [&](const PointWave& in, const PointWave& out, int p, int q) { return conductor_behind(window, in, out, p, q); }, 26.0);
  testing::measured("finite range, plate behind a sheet against quadrature", largest, "dB");
  EXPECT_LT(largest, 0.02);
}

// Rays from the antenna, at 1.5 m, near the peak, that pass beside the sheet from x = 0 on divide the plate along a line, which
// the midpoint rule misses by half a step of 400 at most; uniform tubes by half a cell of 100 along it and by their stairs.
TEST(FiniteRangeMaterials, TheEdgeOfASheetDividesAPlateAlongTheRays) {
  const Look look = near_look({3 * degree, 0.3}, 1.5);
  const dvec3 antenna = 1.5 * spherical_basis(look.transmit).radial;
  const auto reaction = [&](const PointWave& in, const PointWave& out, int p, int q) {
    // The point from which the ray comes, and where it is at the sheet's height.
    const dvec3 r = antenna + (in.path + 1.5) * in.direction, at_sheet = r + height / antenna.z * (antenna - r);
    const dvec3 n(0.0, 0.0, 1.0);
    if (at_sheet.x > 0.0) return conductor_behind(window, in, out, p, q);
    return Complex(2.0 * glm::dot(out.field[p], glm::cross(n, glm::cross(in.direction, in.field[q]))));
  };
  const ScatteringMatrix expected = by_quadrature(look, 400, reaction);
  EXPECT_LT(difference(behind(window, look, 0.0), expected), 3e-3);
  TubeOptions tubes;
  tubes.mode = TubeMode::uniform;
  tubes.per_wavelength = 20.0;
  EXPECT_LT(difference(behind(window, look, 0.0, tubes), expected), 0.03);
}

// Both antennas' ways through the sheet have their own angles. The incident wave's shadow is not seen through sheets: what the
// receiver's wave gains behind one acts on the currents that radiate the reflected wave.
TEST(FiniteRangeMaterials, EachAntennaHasItsOwnWayThroughASheet) {
  const Look look = near_look({10 * degree, 0.3}, {25 * degree, 2.0}, 0.3, 0.4);
  const ScatteringMatrix expected = by_quadrature(look, 400, [](const PointWave& in, const PointWave& out, int p, int q) {
    const dvec3 n(0.0, 0.0, 1.0), d_r(in.direction.x, in.direction.y, -in.direction.z);
    const ComplexVector e = at_plane(window, in.direction, in.field[q]).transmitted,
                        e_r = Complex(-1.0) * e + Complex(2.0) * raytube::dot(e, n) * n, eta_h_r = cross(d_r, e_r),
                        gained = at_plane(window, out.direction, out.field[p]).transmitted - ComplexVector{out.field[p]};
    return raytube::dot(Complex(2.0) * cross(n, cross(in.direction, e)), out.field[p]) + dot(gained, cross(n, eta_h_r)) -
           dot(cross(out.direction, gained), cross(-n, e_r));
  });
  EXPECT_LT(difference(behind(window, look), expected), 1e-3);
}

// Nothing of a sheet of vacuum is left, whatever stands behind it and in what part. Where its edge divides polygons their
// quadrature differs, by the order of 0.3 per cent of the tolerance, and uniform tubes have another grid.
TEST(FiniteRangeMaterials, ASheetOfVacuumIsNotThere) {
  TubeOptions tubes;
  tubes.max_bounces = 12;
  const PolygonSoup corner = shapes::dihedral(0.1, 0.1), plate = shapes::plate(width);
  for (const double begin : {-0.2, 0.02}) {
    for (const Look& look : {near_look({40 * degree, 30 * degree}, 1.5),
                             near_look({40 * degree, 30 * degree}, {30 * degree, 70 * degree}, 1.5, 2.0)})
      EXPECT_LT(difference(seen({under(corner, 0.15, 0.2, begin), {vacuum}, tubes}, look), seen({corner, {}, tubes}, look)),
                3e-4);
    TubeOptions uniform = tubes;
    uniform.mode = TubeMode::uniform;
    const Look look = near_look({3 * degree, 0.3}, 1.5);
    EXPECT_LT(difference(seen({under(plate, 0.15, 0.2, begin), {vacuum}, uniform}, look), seen({plate, {}, uniform}, look)),
              0.03);
  }
}

// The currents of a conductor described as a material, and of a coat without thickness.
TEST(FiniteRangeMaterials, AConductorIsTheLimit) {
  const Material conductor{"conductor", MaterialKind::conductor, 0.0, {}},
      bare = layered(MaterialKind::coated, {{{{3.0, -0.2}}, 0.0}});
  for (const auto& soup : {shapes::plate(width), shapes::dihedral(width, 0.1), shapes::cube(0.1)})
    for (const TubeMode mode : {TubeMode::adaptive, TubeMode::uniform})
      for (const Material& material : {conductor, bare}) {
        TubeOptions tubes;
        tubes.mode = mode;
        tubes.model_share = 0.0;  // the model uncertainty of materials is another one, and tubes stop at a share of it
        for (const Look& look : {near_look(deg(70.0, 33.0), 0.6), near_look(deg(70.0, 33.0), deg(40.0, 81.0), 0.6, 0.8)})
          EXPECT_LT(difference(seen({soup, {material}, tubes}, look), seen({soup, {}, tubes}, look)), 1e-9);
      }
}

// As FiniteRange.TendsToTheFarField: below 0.01 dB at 10^4 D^2 / lambda. Uniform tubes have another grid there, which shows in
// what is small: spheres of facets, and side lobes behind sheets. Spheres are facets bent one by one near an antenna, and
// quadrics far from it: their shadow boundaries differ by 0.03 dB.
TEST(FiniteRangeMaterials, CombinationsTendToTheFarField) {
  Material rough = glass;
  rough.roughness = 1e-3;
  const auto of = [](PolygonSoup soup, std::uint32_t first, std::uint32_t others) {
    soup.materials.assign(soup.polygons.size(), others);
    soup.materials[0] = soup.materials[1] = first;
    return soup;
  };
  const std::vector<Scene> scenes{{shapes::plate(width), {coat}},
                                  {shapes::plate(width), {glass}},
                                  {shapes::plate(width), {window}},
                                  {shapes::plate(width), {resistive()}},
                                  {shapes::plate(width), {rough}},
                                  {of(shapes::dihedral(width, 0.1), 0, 1), {glass, coat}},
                                  {of(shapes::dihedral(width, 0.1), no_index, 0), {glass}},
                                  {shapes::cube(0.1), {coat}},
                                  {shapes::icosphere(3, 0.15), {coat}},
                                  {under(shapes::plate(width), 0.1, 0.2, 0.01), {window}},
                                  {under(shapes::dihedral(width, 0.1), 0.2, 0.2, -0.2), {window}}};
  constexpr std::size_t sphere = 8;
  for (const TubeMode mode : {TubeMode::adaptive, TubeMode::uniform})
    for (std::size_t i = 0; i < (mode == TubeMode::adaptive ? scenes.size() : sphere); ++i)
      for (const Direction& receive : {deg(40.0, 33.0), deg(25.0, 70.0)}) {
        Scene scene = scenes[i];
        scene.tubes.mode = mode;
        const double diameter = 2.0 * build_mesh(scene.soup, 1.0).mesh.radius, range = 1e4 * diameter * diameter / lambda;
        const Direction transmit = deg(40.0, 33.0);
        const ScatteringMatrix limit = seen(scene, {transmit, receive}),
                               s = seen(scene, near_look(transmit, receive, range, range));
        EXPECT_LT(difference(s, limit), i == sphere ? 4e-3 : 1.15e-3) << i << ' ' << static_cast<int>(mode);
      }
}

// Monostatic currents are received as they were excited.
TEST(FiniteRangeMaterials, MonostaticIsReciprocal) {
  for (const Material& sheet : {window, resistive()}) {
    const ScatteringMatrix s = behind(sheet, near_look({20 * degree, 0.7}, 0.25));
    EXPECT_LT(std::abs(s.vh() - s.hv()), 1e-9 * frobenius_norm(s));
  }
}

// From its image a coated sphere spreads as a bare one does, times R at normal incidence: where the angle changes most, half of
// sqrt(lambda / R) off, R is the same to 1e-3. Physical optics of each differs by its shadow boundary, 0.04 dB.
TEST(FiniteRangeMaterials, ACoatedSphereSpreadsFromItsImage) {
  for (const double range : {3.0, 30.0}) {
    const Look look = near_look({1.1, 2.0}, range);
    const PolygonSoup sphere = shapes::icosphere(4, 0.5);
    const ScatteringMatrix bare = seen({sphere, {}}, look), coated = seen({sphere, {coat}}, look);
    const Complex normal = -response(coat, 0, k, 1.0, false).reflected.te;
    EXPECT_LT(level_difference(coated.vv(), normal * bare.vv()), 0.08) << range;
    EXPECT_LT(level_difference(coated.hh(), normal * bare.hh()), 0.08) << range;
  }
}

// Lambert's sum over the plate by the midpoint rule, in the apparent sigma of both antennas.
TEST(FiniteRangeMaterials, RoughnessScattersFromEveryPointOnItsOwn) {
  Material rough = glass;
  rough.roughness = 3e-3;
  const Look look = near_look({20 * degree, 0.3}, {40 * degree, 2.0}, 0.3, 0.4);
  double expected = 0.0;
  constexpr int steps = 200;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const dvec3 r((i + 0.5) / steps * width - width / 2, (j + 0.5) / steps * width - width / 2, 0.0);
      const PointWave in = wave_at(look.transmit, look.transmit_range, r), out = wave_at(look.receive, look.receive_range, r);
      const double coherent = coherent_factor(rough, k, -in.direction.z),
                   reflected = norm(at_plane(glass, in.direction, in.field[0]).reflected);
      expected += 4.0 * (1.0 - coherent * coherent) * reflected * reflected * in.direction.z * out.direction.z *
                  glm::dot(out.field[0], out.field[0]) * width * width / (steps * steps);
    }
  PolygonSoup soup = shapes::plate(width);
  soup.materials.assign(soup.polygons.size(), 0);
  for (const TubeMode mode : {TubeMode::adaptive, TubeMode::uniform}) {
    SolveOptions options;
    options.tubes.mode = mode;
    options.edges.method = EdgeMethod::none;
    const LoadedMesh loaded = build_mesh(soup, 1.0, "test", std::vector{rough});
    const SweepResult result = solve(Target(loaded.mesh), {{frequency}, {look}, true, {}, {rough}}, options);
    EXPECT_NEAR(result.incoherent[0][0] / expected, 1.0, mode == TubeMode::adaptive ? 1e-3 : 0.02);
  }
}

// More frequencies than are followed together between sheets.
TEST(FiniteRangeMaterials, ManyFrequenciesAreTheSameOneByOne) {
  std::vector<double> frequencies;
  for (int i = 0; i < 18; ++i) frequencies.push_back(9e9 + 0.1e9 * i);
  Material sheet = window;
  sheet.layers.assign(frequencies.size(), window.layers[0]);
  const LoadedMesh loaded = build_mesh(under(shapes::plate(width), height, half_screen, 0.0), 1.0, "test", std::vector{sheet});
  const Target target(loaded.mesh);
  SolveOptions options;
  options.edges.method = EdgeMethod::none;
  const Look look = near_look({10 * degree, 0.3}, 0.5);
  const std::vector<ScatteringMatrix> all = solve(target, {frequencies, {look}, false, {}, {sheet}}, options).total;
  for (const std::size_t f : {0, 15, 16, 17}) {
    const ScatteringMatrix one = solve(target, {{frequencies[f]}, {look}, false, {}, {window}}, options).total[0];
    EXPECT_LT(difference(all[f], one), 1e-4) << f;  // triangles are as small as the highest frequency wants
  }
}

}  // namespace
}  // namespace raytube
