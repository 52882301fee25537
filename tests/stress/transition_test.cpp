// The transition function and the wedge's coefficients where they are hardest: no argument, grazing, boundaries of shadow and of
// reflection.
#include "utd/wedge/transition.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "run.h"
#include "stress/stability.h"
#include "utd/wedge/wedge_coefficients.h"

namespace raytube::testing {
namespace {

Table references() { return Table(RAYTUBE_SOURCE_DIR "/tests/data/transition_references.csv"); }

double distance(Complex found, Complex wanted, double size) {
  const double off = std::abs(found - wanted) / size;
  return std::isfinite(off) ? off : std::numeric_limits<double>::infinity();
}

TEST(TransitionLimits, FunctionForEveryArgument) {
  const Table table = references();
  double worst = 0.0;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    if (table.text(i, "kind") != "F") continue;
    const Complex wanted = table.complex(i, "first");
    worst = worse(worst, distance(transition(table.number(i, "kl")), wanted, std::abs(wanted)));
  }
  expect_stable({"X = 1e-300 ... 5e16, relative error", "transition function", worst, 1.5e-15,
                 "1e-15 of the fitted function, two roundings"});
}

TEST(TransitionLimits, CoefficientsBesideEveryBoundary) {
  // A distance to a boundary has three roundings, 4e-16 each, of angles up to 2 n pi. Waves of strength 1/2 sqrt(kL) change with
  // it as W(sqrt(kL/2) eps), by 0.8 sqrt(kL) per radian: 5e-16 kL, and there are four of them.
  const Table table = references();
  double worst = 0.0;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    if (table.text(i, "kind") != "D") continue;
    const double kl = table.number(i, "kl");
    const WedgeCoefficients found =
        wedge_coefficients({table.number(i, "n"), table.number(i, "source"), table.number(i, "observer"), 1.0, kl}, 1.0);
    const double size = std::sqrt(kl) * (1 + std::sqrt(kl) * 1e-2);
    worst = std::max(
        {worst, distance(found.soft, table.complex(i, "first"), size), distance(found.hard, table.complex(i, "second"), size)});
  }
  expect_stable({"1e-11 ... 0.1 rad beside boundaries, sources from grazing on, kL = 0.001 ... 1e6: error over sqrt(kL) + kL/100",
                 "diffraction coefficients, n = 0.75 ... 2", worst, 2e-13,
                 "three roundings of the angles, times four waves that change with them by 0.4 kL"});
}

/// Geometrical optics of a unit plane wave, phases as at distance s with k = 1, plus the diffracted ray.
struct Total {
  Complex soft, hard;
};

Total total(double n, double source, double observer, double s) {
  const WedgeCoefficients d = wedge_coefficients({n, source, observer, 1.0, s}, 1.0);
  const Complex ray = std::polar(1 / std::sqrt(s), -s);
  Total sum{d.soft * ray, d.hard * ray};
  for (const bool mirrored : {false, true})
    for (int turn = -3; turn <= 3; ++turn) {
      const double psi = observer + (mirrored ? source : -source) - 2 * pi * n * turn, beyond = std::abs(psi) - pi;
      const double weight = std::abs(beyond) < 1e-12 ? 0.5 : beyond < 0 ? 1.0 : 0.0;
      const Complex image = std::polar(weight, s * std::cos(psi));
      sum.soft += mirrored ? -image : image;
      sum.hard += image;
    }
  return sum;
}

TEST(TransitionLimits, FieldsAreContinuousOverBoundaries) {
  // Slope of the field: rays k s, W' at most 2 / sqrt(pi) rate' sqrt(kL), 1.2 sqrt(s), twice over for two waves.
  double worst = 0.0;
  for (const double n : {2.0, 1.9999999999, 1.9, 1.5, 1.2, 1.001})
    for (double source = 1e-9; source < n * pi - 1e-6; source += size_of_run(0.173, 0.0173))
      for (const double boundary : {pi + source, pi - source, (2 * n - 1) * pi - source, source - pi})
        for (const double s : {0.5, 20.0, 1e4}) {
          if (boundary < 1e-3 || boundary > n * pi - 1e-3) continue;
          const Total on = total(n, source, boundary, s);
          for (double step = 1e-15; step < 1e-3; step *= 10)
            for (const double side : {-1.0, 1.0}) {
              const Total beside = total(n, source, boundary + side * step, s);
              const double slope = 4 * (s + 3 * std::sqrt(s)) * (step + 1e-15);
              worst = std::max({worst, distance(beside.soft, on.soft, 1.0) - slope, distance(beside.hard, on.hard, 1.0) - slope});
            }
        }
  expect_stable({"1e-15 ... 1e-3 rad beside boundaries, ks = 0.5 ... 1e4: jump of the total field beyond slope times step",
                 "rays of a wedge, n = 1.001 ... 2", worst, 1e-10,
                 "the half that is dropped within 1e-12 rad leaves sqrt(ks) 1e-12"});
}

TEST(TransitionLimits, GrazingSources) {
  // Soft: a wave along the face has no E there, D vanishes with phi'. Hard: bounded, and the same from 0 and from beside it.
  double soft = 0.0, hard = 0.0;
  for (const double n : {2.0, 1.5, 1.1})
    for (double observer = 0.1; observer < n * pi; observer += 0.31)
      for (const double s : {0.5, 20.0, 1e4}) {
        const WedgeCoefficients at = wedge_coefficients({n, 0.0, observer, 1.0, s}, 1.0);
        soft = std::max(soft, distance(at.soft, 0.0, std::sqrt(s)));
        if (std::abs(observer - pi) < 0.02) continue;
        for (double step = 1e-300; step < 1e-3; step *= step < 1e-20 ? 1e40 : 10) {
          const WedgeCoefficients beside = wedge_coefficients({n, step, observer, 1.0, s}, 1.0);
          const double slope = 10 * (1 + s) * step;
          soft = std::max(soft, distance(beside.soft, 0.0, std::sqrt(s)) - slope);
          hard = std::max(hard, distance(beside.hard, at.hard, std::sqrt(s)) - slope);
        }
      }
  expect_stable({"source 0 ... 1e-3 rad above the face: change beyond slope times step, over sqrt(ks)",
                 "diffraction coefficients, soft (0 at grazing) and hard", std::max(soft, hard), 1e-13, "rounding"});
}

}  // namespace
}  // namespace raytube::testing
