// Strips over curved faces: their currents, and what bends do to these.
#include <gtest/gtest.h>

#include "utd/fock/edge_factors.h"
#include "utd/multiple/strip_kernels.h"

namespace raytube {
namespace {

TEST(EdgeFactors, NothingChangesOnAFlatFace) {
  EXPECT_EQ(edge_factors(0.0).hard, 1.0);
  EXPECT_EQ(edge_factors(0.0).soft, 1.0);
}

TEST(EdgeFactors, SeriesAndResiduesMeet) {
  // The series ends at xi^{9/2} (Pathak 1979): 1e-6 and 1e-5 are left of v and u at the join. What both bend by over 1/128 of xi
  // is v'' / 2 = 0.43 and u'' / 2 = 0.86 times its square, 3e-5 and 5e-5.
  const EdgeFactors before = edge_factors(0.15 - 1.0 / 128), after = edge_factors(0.15 + 1.0 / 128), at = edge_factors(0.15);
  EXPECT_LE(std::abs(0.5 * (before.hard + after.hard) - at.hard), 5e-5);
  EXPECT_LE(std::abs(0.5 * (before.soft + after.soft) - at.soft), 1e-4);
}

TEST(EdgeFactors, FallAsTheFirstCreepingWave) {
  // sqrt(xi) and xi^{3/2} times e^{-tau sin(pi/3) xi}, tau the first zero of Ai' and Ai. The second one is down by e^{-9} there.
  const EdgeFactors near = edge_factors(5.0), far = edge_factors(7.0);
  const double rate = 2 * std::sin(pi / 3);
  EXPECT_NEAR(std::abs(far.hard / near.hard), std::sqrt(1.4) * std::exp(-rate * 1.01879297), 1e-4);
  EXPECT_NEAR(std::abs(far.soft / near.soft), std::pow(1.4, 1.5) * std::exp(-rate * 2.33810741), 1e-4);
}

// The currents along a strip, integrated, are its kernels but for what is added close to the edge.
TEST(StripCurrents, AddUpToTheKernels) {
  const double half_cosine = 0.4, n = 1.8;
  for (const double source : {0.4, 2.0, 4.2}) {
    FaceIncidence incidence;
    incidence.sin_cone = 1.0;
    incidence.source_angle = source;
    incidence.lit = source < pi;
    const Strip strip(n, incidence, half_cosine);
    for (const double length : {0.3, 5.0, 40.0}) {
      const double end = std::sqrt(2 * length), turn = 2 * half_cosine * half_cosine;
      Complex soft = 0.0, hard = 0.0, axial = 0.0;
      constexpr int points = 4000;
      for (int i = 0; i < points; ++i) {
        Reals root{};
        root[0] = end * (i + 0.5) / points;
        const Strip::Currents currents = strip.currents(root);
        const Complex phase = std::polar(end / points, -0.5 * turn * root[0] * root[0]);
        hard += phase * root[0] * currents.hard[0];
        axial += phase * currents.axial[0];
        soft += phase * currents.soft[0];
      }
      KernelBatch batch;
      strip.at(std::span(&length, 1), batch);
      const FringeKernels kernels = batch[0].current, local = strip.local_part();
      const double reached = -std::expm1(-length);
      // The midpoint rule: (40 / 4000)^2 / 24 of the second derivative, some tens where the phase turns fastest.
      EXPECT_LE(std::abs(hard + reached * local.hard - kernels.hard), 1e-4) << source << ' ' << length;
      EXPECT_LE(std::abs(axial + reached * local.axial - kernels.axial), 1e-4) << source << ' ' << length;
      EXPECT_LE(std::abs(soft + reached * local.soft - kernels.soft), 1e-4) << source << ' ' << length;
    }
  }
}

}  // namespace
}  // namespace raytube
