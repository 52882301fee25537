// The same body in other units, and a body and its waves made larger or smaller together.
#include "stress/description.h"
#include "stress/stability.h"

namespace raytube::testing {
namespace {

TEST(Units, TheSameMeshInAnyUnit) {
  const std::vector<double> metres = size_of_run<std::vector<double>>({1e-3, 0.0254}, {1e-2, 1e-3, 1e-6, 0.0254, 0.3048});
  const auto in_unit = [&](Description d, int unit) {
    d.metres_per_unit = metres[static_cast<std::size_t>(unit)];
    for (dvec3& p : d.soup.points) p /= d.metres_per_unit;
    return Change{std::move(d)};
  };
  expect_unseen(size_of_run("mm and in for m", "cm, mm, um, in and ft for m"), static_cast<int>(metres.size()), in_unit,
                as_they_are);
}

TEST(Units, SimilarBodiesAndWaves) {
  // Powers of ten, between which sampled bands repeat (scene/frequency_bands.h); no powers of two, so nothing is exact.
  const std::vector<double> scales = size_of_run<std::vector<double>>({1e6, 1e-6}, {1e6, 1e-6, 1e3, 1e-3, 10.0, 0.1});
  const auto scaled = [&](Description d, int which) {
    const double scale = scales[static_cast<std::size_t>(which)];
    for (dvec3& p : d.soup.points) p *= scale;
    for (double& f : d.sweep.frequencies) f /= scale;
    return Change{std::move(d), [scale](ScatteringMatrix s, std::size_t) { return s *= 1.0 / scale; }};
  };
  expect_unseen("mesh and wavelength times 1e6 and 1e-6, S by the same", static_cast<int>(scales.size()), scaled, as_they_are);
}

}  // namespace
}  // namespace raytube::testing
