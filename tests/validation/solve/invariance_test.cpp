// What physics says must not change: reciprocity, rotation of everything together, scale of everything together.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "run.h"
#include "sbr/sbr.h"
#include "shapes.h"

namespace raytube {
namespace {

using namespace raytube::testing;

constexpr double frequency = 10e9;
const double lambda = wavelength(frequency);

glm::dmat3 rotation(double angle, const dvec3& axis) {
  return glm::dmat3(glm::rotate(glm::dmat4(1.0), angle, glm::normalize(axis)));
}

double largest(const ScatteringMatrix& m) {
  return std::max({std::abs(m.vv()), std::abs(m.vh()), std::abs(m.hv()), std::abs(m.hh())});
}

double difference(const ScatteringMatrix& a, const ScatteringMatrix& b) {
  ScatteringMatrix d;
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q) d.at(p, q) = a.at(p, q) - b.at(p, q);
  return largest(d);
}

// Components of a turned target's S in the bases of the target before turning: S_pq with p_hat, q_hat carried along.
ScatteringMatrix turned_back(const ScatteringMatrix& s, const Look& turned, const Look& original, const glm::dmat3& turn) {
  const auto overlap = [&](const Direction& now, const Direction& before) {
    const SphericalBasis a = spherical_basis(now), b = spherical_basis(before);
    const dvec3 axes[2] = {a.theta_hat, a.phi_hat}, carried[2] = {turn * b.theta_hat, turn * b.phi_hat};
    std::array<std::array<double, 2>, 2> t;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) t[i][j] = glm::dot(axes[i], carried[j]);
    return t;
  };
  const auto r = overlap(turned.receive, original.receive), t = overlap(turned.transmit, original.transmit);
  ScatteringMatrix back;
  for (int p = 0; p < 2; ++p)
    for (int q = 0; q < 2; ++q)
      for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) back.at(p, q) += r[i][p] * s.at(i, j) * t[j][q];
  return back;
}

struct Shape {
  std::string name;
  PolygonSoup soup;
};

std::vector<Shape> planar_targets() {
  return {{"plate", shapes::transformed(shapes::plate(5 * lambda, 0.3), rotation(0.4, {1, 2, 0}))},
          {"cube", shapes::cube(4 * lambda)},
          {"dihedral", shapes::dihedral(5 * lambda, 4 * lambda)},
          {"trihedral", shapes::trihedral(5 * lambda)},
          {"thin box", shapes::box(lambda * dvec3(4, 3, 0.05))}};
}

std::vector<Look> some_looks(bool bistatic) {
  std::vector<Look> looks;
  for (int i = 0; i < 12; ++i) {
    const Direction transmit{0.3 + 0.22 * i, 0.1 + 0.61 * i}, receive{2.7 - 0.2 * i, 1.3 + 0.47 * i};
    looks.push_back({transmit, bistatic ? receive : transmit});
  }
  looks.push_back({{90 * degree, 45 * degree}, {90 * degree, 45 * degree}});
  return looks;
}

// Worst change of S relative to its largest element over all looks, target, looks and tubes.up turned together.
double worst_change_under_rotation(const Shape& shape, bool bistatic, SolveOptions original, const glm::dmat3& turn) {
  Sweep sweep{{frequency}, some_looks(bistatic), bistatic}, turned_sweep = sweep;
  const auto turn_direction = [&](const Direction& d) { return direction_of(turn * spherical_basis(d).radial); };
  for (Look& look : turned_sweep.looks) {
    const bool monostatic = look.transmit == look.receive;
    look.transmit = turn_direction(look.transmit);
    look.receive = monostatic ? look.transmit : turn_direction(look.receive);
  }
  original.tubes.up = dvec3(0.2, 0.1, 1.0);
  SolveOptions turned = original;
  turned.tubes.up = turn * *original.tubes.up;
  const SweepResult a = solve_soup(shape.soup, sweep, original);
  const SweepResult b = solve_soup(shapes::transformed(shape.soup, turn), turned_sweep, turned);
  double worst = 0.0, peak = 0.0;
  for (std::size_t i = 0; i < a.total.size(); ++i) {
    worst = std::max(worst, difference(turned_back(b.total[i], turned_sweep.looks[i], sweep.looks[i], turn), a.total[i]));
    peak = std::max(peak, largest(a.total[i]));
  }
  return worst / peak;
}

TEST(Invariance, RotationOfTargetLooksAndGrid) {
  // Rounding of rotated coordinates is 2^-53 of 10 wavelengths, k r of 60 rad: 1e-14; a tube decided differently near an
  // edge would show as 1e-4. The requirement is 1e-9.
  const glm::dmat3 turns[] = {rotation(0.7, {1, 2, 3}), rotation(2.1, {-3, 1, 0.5}), rotation(pi / 2, {0, 1, 0})};
  for (const Shape& shape : planar_targets())
    for (const bool bistatic : {false, true})
      for (const int order : {1, 2, 3}) {
        SolveOptions o = options(EdgeMethod::fringe);
        o.edges.order = order;
        o.tubes.mode = order == 3 ? TubeMode::adaptive : TubeMode::uniform;
        double change = 0.0;
        for (const glm::dmat3& turn : turns) change = std::max(change, worst_change_under_rotation(shape, bistatic, o, turn));
        const std::string name = fmt::format("{}, {}, {} tubes, edges of order {}", shape.name,
                                             bistatic ? "bistatic" : "monostatic", order == 3 ? "adaptive" : "uniform", order);
        measured((name + ", change of S under rotation / peak").c_str(), change, "");
        EXPECT_LE(change, 1e-9) << name;
      }
}

void expect_scale_invariance(const SolveOptions& o) {
  for (const Shape& shape : planar_targets())
    for (const double scale : {1000.0, 0.001}) {
      const Sweep sweep{{frequency}, some_looks(false), false}, scaled_sweep{{frequency / scale}, some_looks(false), false};
      const SweepResult a = solve_soup(shape.soup, sweep, o);
      const SweepResult b = solve_soup(shapes::transformed(shape.soup, glm::dmat3(1.0), scale), scaled_sweep, o);
      double worst = 0.0, peak = 0.0;
      for (std::size_t i = 0; i < a.total.size(); ++i) {
        ScatteringMatrix smaller = b.total[i];
        for (auto& row : smaller.s)
          for (Complex& value : row) value /= scale;
        worst = std::max(worst, difference(smaller, a.total[i]));
        peak = std::max(peak, largest(a.total[i]));
      }
      measured((shape.name + ", change of S / wavelength under scale / peak").c_str(), worst / peak, "");
      EXPECT_LE(worst / peak, 1e-9) << shape.name << " scale " << scale;  // as for rotation
    }
}

TEST(Invariance, ScaleOfTargetAndWavelength) {
  SolveOptions o = options(EdgeMethod::fringe);
  expect_scale_invariance(o);
  o.tubes.mode = TubeMode::adaptive;
  expect_scale_invariance(o);
}

TEST(Invariance, FarOffsetOnlyTurnsThePhase) {
  // 1 km away at 10 GHz: k r of 4e5 rad, rounded to 2^-53 of it in coordinates and phase: 1e-10, times a few.
  const dvec3 shift(800.0, -500.0, 300.0);
  const Sweep sweep{{frequency}, some_looks(true), true};
  const PolygonSoup cube = shapes::cube(4 * lambda);
  const SweepResult a = solve_soup(cube, sweep, options(EdgeMethod::fringe));
  const SweepResult b = solve_soup(shapes::transformed(cube, glm::dmat3(1.0), 1.0, shift), sweep, options(EdgeMethod::fringe));
  for (std::size_t i = 0; i < a.total.size(); ++i) {
    const dvec3 change = spherical_basis(sweep.looks[i].transmit).radial + spherical_basis(sweep.looks[i].receive).radial;
    ScatteringMatrix expected = a.total[i];
    for (auto& row : expected.s)
      for (Complex& value : row) value *= std::polar(1.0, wavenumber(frequency) * glm::dot(change, shift));
    EXPECT_LE(difference(b.total[i], expected), 1e-8 * largest(a.total[i]));
  }
}

double worst_cross_asymmetry(const std::vector<ScatteringMatrix>& part, double scale) {
  double worst = 0.0;
  for (const ScatteringMatrix& s : part) worst = std::max(worst, std::abs(s.vh() - s.hv()));
  return worst / scale;
}

TEST(Reciprocity, MonostaticLooks) {
  // Guards the step in solve() that takes the symmetric part: a few thousand roundings are all that may be left.
  SolveOptions second = options(EdgeMethod::fringe);
  second.edges.order = 2;
  for (const Shape& shape : planar_targets()) {
    const SweepResult result = solve_soup(shape.soup, {{frequency}, some_looks(false), false}, second);
    double peak = 0.0;
    for (const ScatteringMatrix& s : result.total) peak = std::max(peak, largest(s));
    EXPECT_LE(worst_cross_asymmetry(result.total, peak), 1e-12) << shape.name;
    EXPECT_LE(worst_cross_asymmetry(result.of("edges_order_1"), peak), 1e-12) << shape.name;
    EXPECT_LE(worst_cross_asymmetry(result.of("edges_order_2_on"), peak), 1e-12) << shape.name;
  }
}

// S_vh - S_hv of one bounce before solve() makes monostatic looks reciprocal, relative to the look's largest amplitude.
double raw_asymmetry(const PolygonSoup& soup, const Direction& look, std::size_t bounce, double per_wavelength) {
  const LoadedMesh loaded = build_mesh(soup, 1.0);
  const double frequencies[] = {frequency};
  TubeOptions tubes;
  tubes.mode = TubeMode::uniform;
  tubes.per_wavelength = per_wavelength;
  Progress progress(nullptr);
  const TubeSums sums =
      sbr_scattering({Tracer(loaded.mesh), FaceTree(loaded.mesh)}, {look, look}, frequencies, tubes, {progress});
  const ScatteringMatrix& s = sums.bounces.at(bounce).at(0);
  return std::abs(s.vh() - s.hv()) / largest(s);
}

TEST(Reciprocity, FirstBounceOfTheTubesThemselves) {
  for (const Shape& shape : planar_targets())
    EXPECT_LE(raw_asymmetry(shape.soup, {1.0, 0.6}, 0, 10.0), 1e-12) << shape.name;  // symmetric term by term
}

TEST(Reciprocity, DoubleBounceOfTheTubesAcrossTheFold) {
  // A dihedral rolled by 22.5 degrees about its bisector has the strongest cross-polarisation there is. Looks across the fold
  // are specular, where physical optics is reciprocal tube by tube; out of that plane it is not, whatever the density, and
  // solve() takes the symmetric part.
  const glm::dmat3 roll = rotation(22.5 * degree, {1, 1, 0});
  const PolygonSoup rolled = shapes::transformed(shapes::dihedral(5 * lambda, 4 * lambda), roll);
  for (int i = 0; i < 8; ++i) {
    const double azimuth = (41.3 + i) * degree;
    const dvec3 towards = roll * dvec3(std::cos(azimuth), std::sin(azimuth), 0.0);
    EXPECT_LE(raw_asymmetry(rolled, direction_of(towards), 1, 10.0), 1e-12);
  }
}

}  // namespace
}  // namespace raytube
