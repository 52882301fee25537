// Edges at many frequencies, most of them found from a few, against each frequency computed for itself.
#include <gtest/gtest.h>

#include "mesh/features/thin_plates.h"
#include "run.h"
#include "shapes.h"
#include "utd/fringe/edges.h"

namespace raytube {
namespace {

using namespace raytube::testing;

std::vector<double> band(double low, double high) {
  std::vector<double> frequencies;
  for (int i = 0; i <= 100; ++i) frequencies.push_back(speed_of_light * (low + (high - low) * i / 100));
  return frequencies;
}

ScatteringMatrix edges_of(const EdgeLookResult& result, std::size_t index) {
  ScatteringMatrix s = result.scattering[index];
  return s += result.higher[index];
}

/// Largest difference over the peak of the band, both of the edges alone. The highest frequency, which chooses the points along
/// edges, and the lowest one, which says how far strips are followed over curved faces, go with each.
double worst_of_band(const EdgeScene& scene, const Look& look, double low, double high) {
  const std::vector<double> many = band(low, high);
  const EdgeLookResult together = fringe_scattering(scene, look, {many}, {3});
  double worst = 0.0, peak = 0.0;
  for (std::size_t i = 0; i < many.size(); i += 9) {
    const double few[] = {many[i], many.front(), many.back()};
    const ScatteringMatrix alone = edges_of(fringe_scattering(scene, look, {few}, {3}), 0);
    worst = std::max(worst, largest_amplitude(edges_of(together, i) - alone));
    peak = std::max(peak, largest_amplitude(alone));
  }
  return worst / peak;
}

const Look looks[] = {{{pi / 2, 0.1}, {pi / 2, 0.1}}, {{0.9, 0.4}, {1.3, 2.1}}, {{pi / 2, 0.0}, {2.0, -1.0}}};

// Limits: the promise of math/path_bins, 1e-6 of all amplitudes, is that of the sums they make, of lengths of some wavelengths,
// too.
void expect_the_same(const EdgeScene& scene, const char* what) {
  for (const auto& [low, high] : {std::pair{1.0, 1.1}, {1.0, 1.005}, {0.6, 1.4}}) {
    double worst = 0.0;
    for (const Look& look : looks) worst = std::max(worst, worst_of_band(scene, look, low, high));
    measured((std::string(what) + ", edges of many frequencies against each alone").c_str(), worst, "of the peak");
    EXPECT_LE(worst, 1e-6) << what << ' ' << low << " to " << high;
    EXPECT_GT(worst, 0.0) << "nothing is interpolated";
  }
}

TEST(StripBand, Block) {
  const Target target(build_mesh(shapes::box({7, 4.5, 2.7}), 1.0).mesh);
  expect_the_same({target.wedges, target.outlines, target.tracer}, "block");
}

TEST(StripBand, ThinPlate) {
  const Target target(build_mesh(shapes::box({7, 4.5, 0.04}), 1.0).mesh);
  const auto wedges = merge_thin_plate_edges(target.wedges, target.thin_plate_edges, thin_limit(1.4 * speed_of_light));
  ASSERT_LT(std::ranges::count_if(wedges, [](const Wedge& w) { return w.radiates(); }),
            std::ranges::count_if(target.wedges, [](const Wedge& w) { return w.radiates(); }));
  const Outlines outlines(target.mesh, wedges, 15 * degree);
  expect_the_same({wedges, outlines, target.tracer}, "thin plate");
}

// A round rod with flat ends: strips over a curved face, and from its edges over flat ones.
TEST(StripBand, CurvedFaces) {
  const Target target(build_mesh(shapes::cylinder(1.0, 2.5, 48), 1.0).mesh);
  const SmoothSurfaces smooth(target.mesh, 15 * degree, 0.1);
  const CurvedTarget surfaces(target.tracer, smooth, true);
  const CurvedFaces curved(surfaces, target.wedges);
  expect_the_same({target.wedges, target.outlines, target.tracer, nullptr, &curved}, "rod");
}

}  // namespace
}  // namespace raytube
