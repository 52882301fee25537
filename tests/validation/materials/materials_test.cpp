// What targets of other materials than perfect conductors scatter, against what follows from the reflection and transmission of
// plane waves.
#include <gtest/gtest.h>

#include "closed_forms.h"
#include "coated_sphere.h"
#include "validation/material_scene.h"

namespace raytube {

using namespace material_scene;

namespace {

// In the plane phi = 0 of a plate z = 0, V is TM and H is TE. Reflected tangential fields are gamma times the conductor's.
void expect_specular(const Material& material, double theta) {
  const Scene conductor{shapes::plate(20.0 * lambda), {}}, plate{shapes::plate(20.0 * lambda), {material}};
  const Direction from = deg(theta, 0.0), to = deg(theta, 180.0);
  const ScatteringMatrix perfect = conductor.seen(from, to), s = plate.seen(from, to);
  const SurfaceResponse at = response(material, 0, k, std::cos(theta * degree), false);
  ScatteringMatrix expected;
  expected.at(0, 0) = perfect.vv() * at.reflected.tm;
  expected.at(1, 1) = perfect.hh() * -at.reflected.te;
  // Only rounding of phases k r of some hundred.
  EXPECT_LT(difference(s, expected), 1e-12) << theta;
}

TEST(Materials, PlatesReflectSpecularlyByTheirCoefficients) {
  for (const double theta : {0.0, 45.0, 80.0}) {
    expect_specular(half_space({4.0, -0.5}, {1.5, -0.1}), theta);
    expect_specular(layered(MaterialKind::coated, {{{{3.0, -0.2}}, 1.3e-3}, {{{8.0, -1.0}, {1.2, -0.3}}, 0.7e-3}}), theta);
  }
}

// The currents of a conductor described as a material radiate the same at all angles: J and M are consistent.
TEST(Materials, ARoughnessOfZeroIsASmoothConductor) {
  Material smooth{"conductor", MaterialKind::conductor, 0.0, {}};
  for (const auto& soup : {shapes::plate(3.0 * lambda), shapes::dihedral(3.0 * lambda, 2.0 * lambda), shapes::cube(3.0 * lambda)})
    for (const TubeMode mode : {TubeMode::adaptive, TubeMode::uniform}) {
      TubeOptions tubes;
      tubes.mode = mode;
      const Scene real{soup, {}, tubes}, complex{soup, {smooth}, tubes};
      // Rounding, in directions where bounces cancel.
      EXPECT_LT(difference(complex.seen(deg(70.0, 33.0)), real.seen(deg(70.0, 33.0))), 1e-11);
      EXPECT_LT(difference(complex.seen(deg(70.0, 33.0), deg(40.0, 81.0)), real.seen(deg(70.0, 33.0), deg(40.0, 81.0))), 1e-11);
    }
}

// Physical optics of a sheet: the jump of the tangential fields of the slab solution. Backward R, forward T - 1, both times what
// a conductor sends there; V of the forward direction is turned over (theta_hat of the opposite direction).
TEST(Materials, SheetsScatterWhatTheSlabSolutionHas) {
  const Layer slab{{{4.0, -0.3}, 1.0}, 2.1e-3};
  const Material sheet = layered(MaterialKind::sheet, {slab});
  const Scene conductor{shapes::plate(20.0 * lambda), {}}, plate{shapes::plate(20.0 * lambda), {sheet}};
  for (const double theta : {0.0, 30.0, 60.0}) {
    const SurfaceResponse at = response(sheet, 0, k, std::cos(theta * degree), false);
    const Direction from = deg(theta, 0.0), back = deg(theta, 180.0), on = deg(180.0 - theta, 180.0);
    const ScatteringMatrix mirror = conductor.seen(from, back), shadow = conductor.seen(from, on);
    const ScatteringMatrix backward = plate.seen(from, back), forward = plate.seen(from, on);
    EXPECT_LT(std::abs(backward.vv() - mirror.vv() * at.reflected.tm), 1e-12 * std::abs(mirror.vv()));
    EXPECT_LT(std::abs(backward.hh() + mirror.hh() * at.reflected.te), 1e-12 * std::abs(mirror.hh()));
    EXPECT_LT(std::abs(forward.vv() - shadow.vv() * (1.0 - at.transmitted.tm)), 1e-12 * std::abs(shadow.vv()));
    EXPECT_LT(std::abs(forward.hh() - shadow.hh() * (1.0 - at.transmitted.te)), 1e-12 * std::abs(shadow.hh()));
  }
}

TEST(Materials, ASheetOfNoThicknessIsNotThereAndAConductingOneIsAConductor) {
  const Scene conductor{shapes::plate(5.0 * lambda), {}};
  const Scene nothing{shapes::plate(5.0 * lambda), {layered(MaterialKind::sheet, {{{{4.0, -0.3}}, 1e-12}})}};
  const Scene metal{shapes::plate(5.0 * lambda), {layered(MaterialKind::sheet, {{{{1.0, -1e15}}, 1e-3}})}};
  const Direction from = deg(50.0, 20.0);
  // Its surface impedance is 1 / sqrt(1e15) = 3e-8; the mesh is the middle of its millimetre, its face lies half of it above.
  const Complex early = std::polar(1.0, 2.0 * k * 0.5e-3 * std::cos(50.0 * degree));
  for (const auto& [to, moved] : {std::pair(deg(50.0, 200.0), early), std::pair(deg(130.0, 200.0), Complex(1.0))}) {
    ScatteringMatrix perfect = conductor.seen(from, to);
    // k d (eps - 1) = 6e-10 is what such a sheet scatters.
    EXPECT_LT(frobenius_norm(nothing.seen(from, to)), 1e-8 * frobenius_norm(perfect));
    EXPECT_LT(difference(metal.seen(from, to), perfect *= moved), 1e-6);
  }
}

// What stands behind a sheet is lit through it and seen through it.
TEST(Materials, AConductorBehindASheetIsSeenThroughItTwice) {
  const Material sheet = layered(MaterialKind::sheet, {{{{2.5, -0.2}}, 1.7e-3}});
  PolygonSoup soup = shapes::plate(20.0 * lambda);
  for (const dvec3& p : shapes::plate(20.0 * lambda).points) soup.points.push_back(p - dvec3(0, 0, 3.3 * lambda));
  soup.polygons.insert(soup.polygons.end(), {{4, 5, 6}, {4, 6, 7}});
  soup.materials = {0, 0, no_index, no_index};
  const Direction look = deg(0.0, 0.0);
  TubeOptions tubes;
  tubes.max_bounces = 40;
  for (const TubeMode mode : {TubeMode::adaptive, TubeMode::uniform}) {
    tubes.mode = mode;
    const ScatteringMatrix s = Scene{soup, {sheet}, tubes}.seen(look);
    const ScatteringMatrix perfect = Scene{shapes::plate(20.0 * lambda), {}}.seen(look);
    const SurfaceResponse at = response(sheet, 0, k, 1.0, false);
    // Reflections between sheet and conductor in a row (Airy).
    const Complex way = std::polar(1.0, -2.0 * k * 3.3 * lambda);
    const Complex seen = -at.reflected.te + at.transmitted.te * at.transmitted.te * way / (1.0 + at.reflected.te * way);
    EXPECT_LT(std::abs(s.hh() / perfect.hh() - seen), 1e-9);  // |R|^20 = 1e-9 and less is cut
    EXPECT_LT(std::abs(s.vv() / perfect.vv() - seen), 1e-9);
  }
}

// The double bounce of a right dihedral: the product of both faces' coefficients, here at 30 and 60 degrees of incidence.
TEST(Materials, ADihedralMultipliesItsFresnelDyads) {
  const Material glass = half_space({5.0, -0.3}), plastic = half_space({2.6, -0.02});
  PolygonSoup soup = shapes::dihedral(30.0 * lambda, 10.0 * lambda);
  const Scene conductor{soup, {}};
  soup.materials = {0, 0, 1, 1};  // the face y = 0, and x = 0
  const Scene dihedral{soup, {glass, plastic}};
  const double azimuth = 60.0;
  const auto double_bounce = [&](const Scene& scene) {
    const LoadedMesh loaded = build_mesh(scene.soup, 1.0, "test", scene.materials);
    SolveOptions options{{}, {}, 1, false, {}};
    options.edges.method = EdgeMethod::none;
    options.keep_parts = true;
    const Direction look = deg(90.0, azimuth);
    return solve(Target(loaded.mesh), {{frequency}, {{look, look}}, false, {}, scene.materials}, options).bounces[1].front();
  };
  const ScatteringMatrix s = double_bounce(dihedral), perfect = double_bounce(conductor);
  // To y = 0 at 30 degrees from its normal, to x = 0 at 60. V lies along the fold: TE on both faces.
  const SurfaceResponse y = response(glass, 0, k, std::sin(azimuth * degree), false),
                        x = response(plastic, 0, k, std::cos(azimuth * degree), false);
  EXPECT_LT(std::abs(s.vv() / perfect.vv() - y.reflected.te * x.reflected.te), 1e-3);
  EXPECT_LT(std::abs(s.hh() / perfect.hh() - y.reflected.tm * x.reflected.tm), 1e-3);
}

// A cube with one face of glass: in the look at that face it is the glass plate, in the others the conducting one; turned with
// its looks nothing changes.
TEST(Materials, TheRightFaceOfACubeReflectsAndTurnsWithIt) {
  const double side = 10.0 * lambda;
  const Material glass = half_space({5.0, -0.3});
  PolygonSoup cube = shapes::cube(side);
  cube.materials.assign(12, no_index);
  for (std::size_t i = 0; i < 12; ++i) {  // the face x = +side / 2
    bool front = true;
    for (const std::uint32_t corner : cube.polygons[i]) front = front && cube.points[corner].x > 0.0;
    if (front) cube.materials[i] = 0;
  }
  const Scene scene{cube, {glass}};
  const Complex r = half_space_response(glass.layers[0][0].medium, 1.0).reflected.te;
  const double broadside = side * side / lambda;
  EXPECT_NEAR(std::abs(scene.seen(deg(90.0, 0.0)).vv()) / broadside, std::abs(r), 1e-12);
  EXPECT_NEAR(std::abs(scene.seen(deg(90.0, 90.0)).vv()) / broadside, 1.0, 1e-12);
  EXPECT_NEAR(std::abs(scene.seen(deg(90.0, 180.0)).vv()) / broadside, 1.0, 1e-12);
  // A quarter turn about z.
  Scene turned = scene;
  for (dvec3& p : turned.soup.points) p = {-p.y, p.x, p.z};
  for (const double phi : {0.0, 7.0, 40.0, 90.0, 200.0})
    EXPECT_LT(difference(turned.seen(deg(80.0, phi + 90.0)), scene.seen(deg(80.0, phi))), 1e-9) << phi;
}

TEST(Materials, AnAbsorberCastsAShadowAndNothingElse) {
  const Scene conductor{shapes::plate(10.0 * lambda), {}};
  const Scene plate{shapes::plate(10.0 * lambda), {Material{"absorber", MaterialKind::absorber, 0.0, {}}}};
  const Direction from = deg(25.0, 0.0);
  EXPECT_LT(frobenius_norm(plate.seen(from, deg(25.0, 180.0))), 1e-12 * frobenius_norm(conductor.seen(from, deg(25.0, 180.0))));
  EXPECT_LT(difference(plate.seen(from, deg(155.0, 180.0)), conductor.seen(from, deg(155.0, 180.0))), 1e-12);
}

Complex seen_sphere(double a, const Layer& coat) {
  const Material material = layered(MaterialKind::coated, {coat});
  const ScatteringMatrix s = Scene{shapes::icosphere(5, a), {material}}.seen(deg(37.0, 71.0));
  EXPECT_LT(std::abs(s.vh()), 1e-3 * std::abs(s.vv()));
  return s.vv();
}

// At a = 10 wavelengths. 0.3 dB is what currents of physical optics leave: curvature costs 1 / (k a), and a wave creeps round.
TEST(Materials, CoatedSpheresAgreeWithTheExactSeries) {
  const double a = 10.0 * lambda;
  for (const Medium& medium : {Medium{{2.0, -0.5}, {1.5, -0.4}}, Medium{{10.0, -2.0}, 1.0}})
    for (const double wavelengths : {0.02, 0.05, 0.1, 0.25}) {
      const Layer coat{medium, wavelengths * lambda};
      const Complex exact = coated_sphere(a - coat.thickness, coat, k);
      EXPECT_NEAR(20.0 * std::log10(std::abs(seen_sphere(a, coat) / exact)), 0.0, 0.3) << medium.permittivity << wavelengths;
    }
}

// A coat with little loss guides a wave round the sphere that is as strong as what the front reflects (4 dB at one of these
// thicknesses): no current of physical optics. Its phase turns with the radius otherwise than the reflection's, e^{2jka}, so that
// the mean over some wavelengths of radius has the reflection alone.
TEST(Materials, CoatedSpheresReflectAsTheSeriesDoesWithoutTheWaveAroundThem) {
  const double a = 10.0 * lambda;
  for (const double wavelengths : {0.02, 0.05, 0.1, 0.25}) {
    const Layer coat{{{4.0, 0.0}, 1.0}, wavelengths * lambda};
    Complex mean = 0.0;
    double weights = 0.0;
    for (double step = -1.0; step <= 1.0; step += 0.005) {
      const double radius = a + 2.0 * step * lambda, weight = std::pow(std::cos(0.5 * pi * step), 2);
      mean += weight / radius * coated_sphere(radius - coat.thickness, coat, k) * std::polar(1.0, -2.0 * k * (radius - a));
      weights += weight;
    }
    EXPECT_NEAR(20.0 * std::log10(std::abs(seen_sphere(a, coat) * weights / (mean * a))), 0.0, 0.3) << wavelengths;
  }
}

// Edges of a material that is a conductor are those of the first-order theory of conducting edges.
TEST(Materials, EdgesOfAConductorDescribedAsAMaterialAreThoseOfAConductor) {
  const Material smooth{"conductor", MaterialKind::conductor, 0.0, {}};
  for (PolygonSoup soup :
       {shapes::plate(3.0 * lambda), shapes::cube(3.0 * lambda), shapes::box({3.0 * lambda, 2.0 * lambda, 0.05 * lambda})})
    for (const Direction& receive : {deg(70.0, 33.0), deg(40.0, 81.0)}) {
      SolveOptions options{{}, {}, 1, false, {}};
      options.edges.order = 1;
      options.edges.interaction = false;
      options.edges.materials = MaterialEdgeMethod::fringe;
      const auto solved = [&](const std::vector<Material>& materials) {
        const LoadedMesh loaded = build_mesh(soup, 1.0, "test", materials);
        const Look look{deg(70.0, 33.0), receive};
        return solve(Target(loaded.mesh), {{frequency}, {look}, true, {}, materials}, options).total.front();
      };
      const ScatteringMatrix expected = solved({});
      soup.materials.assign(soup.polygons.size(), 0);
      EXPECT_LT(difference(solved({smooth}), expected), 1e-11);  // rounding
      soup.materials.clear();
    }
}

ScatteringMatrix with_edges(const Material& material, MaterialEdgeMethod method, const Direction& from, const Direction& to) {
  PolygonSoup soup = shapes::plate(3.0 * lambda);
  soup.materials.assign(soup.polygons.size(), 0);
  const LoadedMesh loaded = build_mesh(soup, 1.0, "test", std::span(&material, 1));
  SolveOptions options{{}, {}, 1, false, {}};
  options.edges.materials = method;
  return solve(Target(loaded.mesh), {{frequency}, {{from, to}}, true, {}, {material}}, options).total.front();
}

// A coat that is hardly there changes the edges by as little: by the square root of its impedance, 1e-6, where two faces are one
// plane.
TEST(Materials, TheEdgesOfAThinCoatAreThoseOfItsConductor) {
  const Material coat = layered(MaterialKind::coated, {{{{3.0, -0.1}, 1.0}, 1e-8}});
  const Material metal{"conductor", MaterialKind::conductor, 0.0, {}};
  const Direction from = deg(60.0, 20.0), to = deg(50.0, 170.0);
  EXPECT_LT(
      difference(with_edges(coat, MaterialEdgeMethod::fringe, from, to), with_edges(metal, MaterialEdgeMethod::fringe, from, to)),
      1e-2);
}

// A film that hardly conducts has edges as weak as itself.
TEST(Materials, TheEdgesOfAThinSheetVanishWithIt) {
  const Material sheet = layered(MaterialKind::sheet, {{{{3.0, -0.1}, 1.0}, 1e-8}});
  const Direction from = deg(60.0, 20.0), to = deg(50.0, 170.0);
  const Material metal{"conductor", MaterialKind::conductor, 0.0, {}};
  const auto edges = [&](const Material& of) {
    return frobenius_norm(with_edges(of, MaterialEdgeMethod::fringe, from, to) -
                          with_edges(of, MaterialEdgeMethod::none, from, to));
  };
  EXPECT_GT(edges(sheet), 0.0);
  EXPECT_LT(edges(sheet), 2e-5 * edges(metal));  // kd |eps - 1| is 4e-6
}

// Without them the amplitude is that of the currents alone.
TEST(Materials, EdgesOfMaterialsAddTheirsUnlessTheyAreSwitchedOff) {
  const Material glass = half_space({5.0, -0.3});
  const Direction look = deg(60.0, 0.0);
  const ScatteringMatrix whole = with_edges(glass, SolveOptions().edges.materials, look, look);
  EXPECT_EQ(difference(with_edges(glass, MaterialEdgeMethod::fringe, look, look), whole), 0.0);
  EXPECT_GT(difference(with_edges(glass, MaterialEdgeMethod::none, look, look), whole), 0.01);
}

// exp(-2 (k s cos theta)^2) of the smooth amplitude, and 4 (1 - rho^2) |R|^2 A cos^2 theta of power by Lambert's law.
TEST(Materials, RoughnessTurnsReflectedPowerIntoIncoherentPower) {
  Material rough = half_space({5.0, -0.3});
  const Material smooth = rough;
  rough.roughness = 0.1 * lambda;
  const double side = 10.0 * lambda, theta = 30.0 * degree;
  for (const TubeMode mode : {TubeMode::adaptive, TubeMode::uniform}) {
    Scene scene{shapes::plate(side), {rough}};
    scene.tubes.mode = mode;
    const LoadedMesh loaded = build_mesh(
        [&] {
          PolygonSoup soup = scene.soup;
          soup.materials.assign(soup.polygons.size(), 0);
          return soup;
        }(),
        1.0, "test", scene.materials);
    SolveOptions options{scene.tubes, {}, 1, false, {}};
    options.edges.method = EdgeMethod::none;
    const Look mirror{{theta, 0.0}, {theta, pi}};
    const SweepResult result = solve(Target(loaded.mesh), {{frequency}, {mirror}, true, {}, scene.materials}, options);
    const double coherent = std::exp(-2.0 * std::pow(k * rough.roughness * std::cos(theta), 2));
    const Scene reference{scene.soup, {smooth}, scene.tubes};
    EXPECT_NEAR(std::abs(result.total[0].vv() / reference.seen(mirror.transmit, mirror.receive).vv()), coherent, 1e-12);
    const SurfaceResponse at = response(smooth, 0, k, std::cos(theta), false);
    const double lost = 4.0 * (1.0 - coherent * coherent) * side * side * std::pow(std::cos(theta), 2);
    // The cells of a grid fill the plate to within one row of them.
    const double tolerance = mode == TubeMode::adaptive ? 1e-12 : 0.02;
    EXPECT_NEAR(result.incoherent[0][0] / (lost * std::norm(at.reflected.tm)), 1.0, tolerance);
    EXPECT_NEAR(result.incoherent[0][1] / (lost * std::norm(at.reflected.te)), 1.0, tolerance);
  }
}

// Frequencies of one sweep each have their own coefficients.
TEST(Materials, EveryFrequencyHasItsOwnCoefficients) {
  const std::vector<double> frequencies{9e9, 10e9, 11e9, 12e9};
  Material glass{"glass", MaterialKind::coated, 0.0, {}};
  for (std::size_t f = 0; f < frequencies.size(); ++f)
    glass.layers.push_back({{{{3.0 + 0.2 * static_cast<double>(f), -0.1}, 1.0}, 1e-3}});
  PolygonSoup soup = shapes::dihedral(5.0 * lambda, 4.0 * lambda);
  soup.materials.assign(soup.polygons.size(), 0);
  SolveOptions options{{}, {}, 1, false, {}};
  options.edges.method = EdgeMethod::none;
  const LoadedMesh loaded = build_mesh(soup, 1.0, "test", std::span(&glass, 1));
  const Target target(loaded.mesh);
  const Look look{deg(80.0, 37.0), deg(80.0, 37.0)};
  for (const TubeMode mode : {TubeMode::adaptive, TubeMode::uniform}) {
    options.tubes.mode = mode;
    options.tubes.per_wavelength = 10.0;
    const SweepResult all = solve(target, {frequencies, {look}, false, {}, {glass}}, options);
    for (std::size_t f = 0; f < frequencies.size(); ++f) {
      // The grid of uniform tubes is laid at the highest frequency.
      options.tubes.per_wavelength = 10.0 * frequencies.back() / frequencies[f];
      const SweepResult one = solve(target, {{frequencies[f]}, {look}, false, {}, at_frequency({glass}, f)}, options);
      EXPECT_LT(difference(all.total[f], one.total[0]), 1e-9) << f;
    }
  }
}

}  // namespace
}  // namespace raytube
