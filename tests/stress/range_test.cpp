// k R up to 1e9: radars 250 km away at 94 GHz, and meshes as far from their own origin.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "run.h"
#include "shapes.h"
#include "stress/fine_quadrature.h"
#include "stress/stability.h"

namespace raytube::testing {
namespace {

constexpr double frequency = 94e9;

std::vector<Direction> some_looks(int count) {
  std::vector<Direction> looks;
  for (int i = 0; i < count; ++i) looks.push_back({0.3 + 2.4 * i / count, 0.1 + 2.399963 * i});
  return looks;
}

double largest(const std::vector<ScatteringMatrix>& s) {
  double peak = 0.0;
  for (const ScatteringMatrix& each : s) peak = std::max(peak, largest_amplitude(each));
  return peak;
}

double worst_difference(const std::vector<ScatteringMatrix>& a, const std::vector<ScatteringMatrix>& b) {
  double worst = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double off = largest_amplitude(a[i] - b[i]);
    worst = worse(worst, std::isfinite(off) ? off : std::numeric_limits<double>::infinity());
  }
  return worst / largest(b);
}

/// A 20 mm cube turned a little, so that nothing is special; its vertices are multiples of 2^-40 m, which a coordinate of up to
/// 2^12 m holds exactly.
PolygonSoup cube() {
  const double c = std::cos(0.3), s = std::sin(0.3);
  PolygonSoup soup = shapes::transformed(shapes::cube(0.02), glm::dmat3(c, s, 0, -s, c, 0, 0, 0, 1));
  for (dvec3& p : soup.points)
    for (int axis = 0; axis < 3; ++axis) p[axis] = std::ldexp(std::nearbyint(std::ldexp(p[axis], 40)), -40);
  return soup;
}

SolveOptions setting(TubeMode mode, EdgeMethod edges) {
  SolveOptions o = options(edges, 4.0);
  o.tubes.mode = mode;
  return o;
}

TEST(Range, FarAwayMeshes) {
  // A mesh moved by d has the phase k (s - s') . d. The direction of a look is a double, 1e-16 of an angle, and so is the phase
  // itself: each component of s - s' is off by three roundings, 3.3e-16, and their sum by as much again, in all 1e-15 k d. Where
  // the vertices are not exact their rounding, 2^-53 d per coordinate and twice that in the phase, comes on top: as much.
  double worst = 0.0, farthest = 0.0;
  const std::vector<Direction> looks = some_looks(size_of_run(8, 100));
  const double k = wavenumber(frequency);
  for (const TubeMode mode : {TubeMode::adaptive, TubeMode::uniform})
    for (const EdgeMethod edges : {EdgeMethod::none, EdgeMethod::fringe})
      for (const double d : {1.0, 4096.0, 262144.0}) {
        const dvec3 shift(d, -d / 2, d / 4);
        PolygonSoup far = shapes::transformed(cube(), glm::dmat3(1.0), 1.0, shift);
        PolygonSoup near = far;
        for (dvec3& p : near.points) p -= shift;  // exact: what is left of the vertices after rounding
        const SolveOptions o = setting(mode, edges);
        const SweepResult moved = solve_soup(far, monostatic(looks, frequency), o);
        SweepResult here = solve_soup(near, monostatic(looks, frequency), o);
        for (std::size_t i = 0; i < looks.size(); ++i) {
          // In long double: 1e-19 of an angle.
          const Fine theta = looks[i].theta, phi = looks[i].phi;
          const Fine along =
              std::sin(theta) * (std::cos(phi) * Fine(shift.x) + std::sin(phi) * Fine(shift.y)) + std::cos(theta) * Fine(shift.z);
          const Fine angle = 4 * std::numbers::pi_v<Fine> * Fine(frequency) / Fine(speed_of_light) * along;
          here.total[i] *= Complex(static_cast<double>(std::cos(angle)), static_cast<double>(std::sin(angle)));
        }
        const double off = worst_difference(moved.total, here.total), allowed = 1e-9 + 1e-15 * 2 * k * glm::length(shift);
        worst = worse(worst, off / allowed);
        farthest = std::max(farthest, off);
      }
  expect_stable({"mesh 1 m ... 300 km from its origin at 94 GHz, phase included: change over (1e-9 + 1e-15 x 2kd)",
                 fmt::format("cube; adaptive, uniform, edges off and on (worst change {:.1e} at 2kd = 1.2e9)", farthest), worst,
                 1.0, "roundings of the directions' components times k d"});
}

TEST(Range, FarAwayRadars) {
  // At the range R the field differs from the far field by wave-front curvature, k a^2 / R of phase with a the half extent, and
  // by the spreading and turning of rays, a / R: c / R in all, so twice as much at R as at 2R, and (far + S(R)) / 2 = S(2R) but
  // for the square of it; not on a grid of rays, a few of which change sides of an edge with the perspective. What is left at 250
  // km is rounding: paths are kept as differences, 1e-16 of some centimetres times k.
  double limit = 0.0, halves = 0.0;
  const std::vector<Direction> looks = some_looks(size_of_run(4, 50));
  const double k = wavenumber(frequency);
  for (const TubeMode mode : {TubeMode::adaptive, TubeMode::uniform})
    for (const EdgeMethod edges : {EdgeMethod::none, EdgeMethod::fringe}) {
      const LoadedMesh loaded = build_mesh(cube(), 1.0);
      const double a = loaded.mesh.radius;
      const SolveOptions o = setting(mode, edges);
      const Target target(loaded.mesh);
      const auto at = [&](double range) {
        Sweep sweep = monostatic(looks, frequency);
        for (Look& look : sweep.looks) look.transmit_range = look.receive_range = range;
        return solve(target, sweep, o).total;
      };
      const std::vector<ScatteringMatrix> far = at(std::numeric_limits<double>::infinity());
      for (const double range : {1e3, 250e3}) {
        const std::vector<ScatteringMatrix> here = at(range);
        if (mode == TubeMode::uniform) continue;
        std::vector<ScatteringMatrix> mean = far;
        for (std::size_t i = 0; i < mean.size(); ++i) (mean[i] += here[i]) *= 0.5;
        const double first = 2 * (k * a * a + 2 * a) / range;
        limit = std::max(limit, worst_difference(here, far) / (first + 1e-9));
        halves = std::max(halves, worst_difference(at(2 * range), mean) / (first * first + 1e-10));
      }
    }
  expect_stable({"radar at 1 ... 250 km at 94 GHz against one at infinity: change over 2 (k a^2 + 2a) / R", "cube, as above",
                 limit, 1.0, "curvature of the wave fronts and spreading, both ways"});
  expect_stable({"the same, twice as far against the mean with infinity: change over the square of that + 1e-10",
                 "cube; adaptive", halves, 1.0, "1/R law; paths are kept as differences, so k R to 1e9 loses nothing"});
}

}  // namespace
}  // namespace raytube::testing
