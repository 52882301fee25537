// Targets over a plane ground: against the field of the plate written down twice, against a real floor, and in its limits.

#include <gmock/gmock.h>

#include "core/error.h"
#include "validation/ground_scene.h"

namespace raytube {
namespace {

using namespace raytube::testing;

dvec3 mirror(const dvec3& v) { return {v.x, v.y, -v.z}; }

/// Written down with fields alone: the plate is lit by the wave and by its reflection in the ground at z = h, and radiates
/// straight and by way of the ground, whose mirror image of a field E has the components (-Ex, -Ey, Ez).
ScatteringMatrix upright_over_ground(const Upright& plate, double h, double k, const Look& look) {
  const SphericalBasis in = spherical_basis(look.transmit), out = spherical_basis(look.receive);
  const std::array<dvec3, 2> lit{in.theta_hat, in.phi_hat}, seen{out.theta_hat, out.phi_hat};
  const Complex in_phase = std::polar(1.0, 2.0 * k * h * in.radial.z), out_phase = std::polar(1.0, 2.0 * k * h * out.radial.z);
  ScatteringMatrix s;
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q)
      for (const bool by_ground_in : {false, true})
        for (const bool by_ground_out : {false, true}) {
          const dvec3 i = by_ground_in ? mirror(in.radial) : in.radial, o = by_ground_out ? mirror(out.radial) : out.radial;
          const dvec3 e = by_ground_in ? -mirror(lit[q]) : lit[q], r = by_ground_out ? -mirror(seen[p]) : seen[p];
          s.at(p, q) += Complex(0.0, -k / (4.0 * pi)) * glm::dot(r, plate.field(i, e)) * plate.spread(k, i + o) *
                        (by_ground_in ? in_phase : 1.0) * (by_ground_out ? out_phase : 1.0);
        }
  return s;
}

Sweep bistatic_looks() {
  Sweep sweep{{gigahertz, 1.37 * gigahertz}, {}, true};
  for (const double theta : {15.0, 47.0, 80.0, 89.0})
    for (const double phi : {-33.0, 0.0, 21.0})
      sweep.looks.push_back({{theta * degree, phi * degree}, {(100.0 - theta) * degree * 0.8, (phi + 13.0) * degree}});
  return sweep;
}

TEST(Ground, AnUprightPlateHasTheFieldOfTheImageConstruction) {
  const Upright plate{0.02, 0.11, 0.05, 0.19};
  const Sweep sweep = bistatic_looks();
  for (const double h : {0.0, 0.03}) {
    const SweepResult result = solve_case(plate.soup(), case_over(sweep, {h, {}}));
    double worst = 0.0, largest = 0.0;
    for (std::size_t look = 0; look < sweep.looks.size(); ++look)
      for (std::size_t f = 0; f < 2; ++f) {
        const ScatteringMatrix exact = upright_over_ground(plate, h, wavenumber(sweep.frequencies[f]), sweep.looks[look]);
        worst = std::max(worst, largest_difference(result.total[sweep.row(look, f)], exact));
        largest = std::max(largest, largest_amplitude(exact));
      }
    measured("upright plate over ground: largest difference", worst / largest, "of the largest amplitude");
    EXPECT_LT(worst, 1e-9 * largest);
  }
}

// No light goes twice between them, so that four paths are all there are.
TEST(Ground, FourPathsOverAMediumThatConductsAreThoseOverAConductor) {
  const Upright plate{0.02, 0.11, 0.05, 0.19};
  const Sweep sweep = bistatic_looks();
  const SweepResult exact = solve_case(plate.soup(), case_over(sweep, {0.03, {}}));
  const SweepResult four = solve_case(plate.soup(), case_over(sweep, conductor_as_a_medium(0.03)));
  Ground medium{0.03, Material()};
  medium.material->kind = MaterialKind::half_space;
  medium.material->layers = {{{{Complex(1.0, -1e14), 1.0}, 0.0}}, {{{Complex(1.0, -1e14), 1.0}, 0.0}}};
  const SweepResult lossy = solve_case(plate.soup(), case_over(sweep, medium));
  double largest = 0.0, nearly = 0.0;
  for (const ScatteringMatrix& s : exact.total) largest = std::max(largest, largest_amplitude(s));
  for (std::size_t row = 0; row < sweep.rows(); ++row) {
    EXPECT_LT(largest_difference(exact.total[row], four.total[row]), 1e-9 * largest) << row;
    nearly = std::max(nearly, largest_difference(exact.total[row], lossy.total[row]));
  }
  measured("ground of 1e14 loss", nearly / largest, "of the largest amplitude beside a conductor");
  EXPECT_LT(nearly, 1e-5 * largest);  // R_V + 1 is about 2 / (sqrt(1e14) cos theta)
}

TEST(Ground, OverNothingThereIsTheTargetAlone) {
  Ground nothing{-0.1, Material()};  // which absorbs
  const Sweep sweep = bistatic_looks();
  const SweepResult over = solve_case(shapes::cube(0.1), case_over(sweep, nothing));
  const Case free = [&] {
    Case c = case_over(sweep, {});
    c.ground.reset();
    return c;
  }();
  const SweepResult alone = solve_case(shapes::cube(0.1), free);
  for (std::size_t row = 0; row < sweep.rows(); ++row)
    EXPECT_LT(largest_difference(over.total[row], alone.total[row]), 1e-12) << row;
}

// What a real floor of 60 by 100 wavelengths has without the target is taken off. What differs is that the target shades some of
// it.
void expect_as_on_a_floor(const PolygonSoup& target, const std::vector<Direction>& looks) {
  const Sweep sweep = monostatic(looks, gigahertz);
  const SweepResult over = solve_case(target, case_over(sweep, {0.0, {}}));
  Case free = case_over(sweep, {});
  free.ground.reset();
  const PolygonSoup floor{{{-1.0, -1.0, 0}, {2.0, -1.0, 0}, {2.0, 1.0, 0}, {-1.0, 1.0, 0}}, {{0, 1, 2, 3}}};
  PolygonSoup both = target;
  add_polygons(floor, both);
  const SweepResult real = solve_case(both, free), empty = solve_case(floor, free);
  for (std::size_t row = 0; row < sweep.rows(); ++row)
    for (int p = 0; p < 2; ++p) {
      const Complex ratio = over.total[row].at(p, p) / (real.total[row] - empty.total[row]).at(p, p);
      measured("target on ground against a real floor", 20.0 * std::log10(std::abs(ratio)), "dB");
      EXPECT_NEAR(20.0 * std::log10(std::abs(ratio)), 0.0, 0.3) << row << p;
      EXPECT_NEAR(std::arg(ratio), 0.0, 3.0 * degree) << row << p;
    }
}

TEST(Ground, APlateStandingOnItIsADihedral) {
  expect_as_on_a_floor(Upright{0.0, 0.15, 0.0, 0.15}.soup(),
                       {{40 * degree, 0.0}, {45 * degree, 0.0}, {55 * degree, 0.0}, {60 * degree, 2 * degree}});
}

TEST(Ground, ADihedralStandingOnItIsATrihedral) {
  expect_as_on_a_floor(moved(shapes::dihedral(0.15, 0.15), {0.0, 0.0, 0.075}),
                       {{54 * degree, 45 * degree}, {48 * degree, 40 * degree}, {65 * degree, 50 * degree}});
}

TEST(Ground, ABodyStandingOnItIsOneWithItsImage) {
  Case c = case_over(monostatic({{60 * degree, 30 * degree}}, gigahertz), {-0.05, {}});
  PolygonSoup soup = shapes::cube(0.1);
  for (dvec3& point : soup.points) point.z *= 1.0 + 1e-8;  // the rounding of a file
  add_mirror_image(soup, c);
  const TriangleMesh mesh = build_mesh(std::move(soup), 1.0).mesh;
  EXPECT_EQ(mesh.components.size(), 1u);
  EXPECT_TRUE(mesh.components[0].closed);
  EXPECT_EQ(mesh.patches.size(), 6u);
  EXPECT_NEAR(mesh.center.z, -0.05, 1e-12);
}

TEST(Ground, ATargetThatPiercesItIsRefused) {
  Case c = case_over(monostatic({{60 * degree, 0.0}}, gigahertz), {0.0, {}});
  c.file = "a.toml";
  PolygonSoup soup = shapes::cube(0.1);
  EXPECT_THAT([&] { add_mirror_image(soup, c); },
              ::testing::ThrowsMessage<InputError>(::testing::HasSubstr("reaches down to z = -0.05 m, below the ground at 0 m")));
}

// With every mechanism: parts add up to S, and what is uncertain of it is no less than along its paths.
TEST(Ground, PartsAndErrorsAreThoseOfItsPaths) {
  const Sweep sweep = monostatic({{50 * degree, 10 * degree}, {75 * degree, 30 * degree}}, gigahertz);
  for (const Ground& ground : {Ground{0.0, {}}, conductor_as_a_medium(0.0)}) {
    const Case c = case_over(sweep, ground, EdgeMethod::fringe);
    PolygonSoup soup = moved(shapes::box({0.1, 0.15, 0.08}), {0.0, 0.0, 0.06});
    const SweepResult result = solve_case(soup, c, true);
    for (std::size_t row = 0; row < sweep.rows(); ++row) {
      ScatteringMatrix sum;
      for (const auto& bounce : result.bounces) sum += bounce[row];
      for (const MechanismRows& mechanism : result.mechanisms) sum += mechanism.rows[row];
      EXPECT_LT(largest_difference(sum, result.total[row]), 1e-12);
      EXPECT_EQ(result.total[row].vh(), result.total[row].hv());
      double squares = 0.0;
      for (const ModelPart& part : result.model_parts) squares += part.rows[row][0][0] * part.rows[row][0][0];
      EXPECT_NEAR(result.model[row][0][0], std::sqrt(squares), 1e-12);
      EXPECT_GT(result.model[row][0][0], 0.0);
      EXPECT_LT(result.model[row][0][0], largest_amplitude(result.total[row]));
    }
    EXPECT_EQ(solve_case(soup, c).total[1].vv(), result.total[1].vv());
    EXPECT_TRUE(solve_case(soup, c).bounces.empty());
  }
}

// Far above the ground the body and its image do not see each other: four paths, with edges.
TEST(Ground, HighAboveItThereAreFourPaths) {
  const Sweep sweep = monostatic({{50 * degree, 0.0}, {65 * degree, 35 * degree}, {72 * degree, 12 * degree}}, gigahertz);
  const PolygonSoup high = moved(shapes::box({0.1, 0.15, 0.08}), {0.0, 0.0, 5.0});
  const SweepResult exact = solve_case(high, case_over(sweep, {0.0, {}}, EdgeMethod::fringe));
  const SweepResult four = solve_case(high, case_over(sweep, conductor_as_a_medium(0.0), EdgeMethod::fringe));
  for (std::size_t row = 0; row < sweep.rows(); ++row) {
    const double relative = largest_difference(exact.total[row], four.total[row]) / largest_amplitude(exact.total[row]);
    measured("four paths against the image", relative, "of the largest channel");
    EXPECT_LT(relative, 1e-9) << row;
  }
}

}  // namespace
}  // namespace raytube
