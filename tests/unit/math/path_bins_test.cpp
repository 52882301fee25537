// Sums of waves with slow amplitudes, in bins of paths.
#include "math/path_bins.h"

#include <gtest/gtest.h>

#include "math/erfc_ray.h"

namespace raytube {
namespace {

constexpr int paths = 400;

// Paths all over a stretch, amplitudes as of currents near an edge and far from it.
double path_of(int i) { return 0.37 * i - 60.0 + 3.0 * std::sin(17.0 * i); }
Complex amplitude_of(int i, double k) {
  const double x = 0.01 * (i % 50) * std::sqrt(k);
  return std::pow(k, -0.5 * (i % 3)) + scaled_erfc(x);
}

ScatteringMatrix sum_at(double k) {
  ScatteringMatrix s;
  for (int i = 0; i < paths; ++i) s.at(i % 2, i / 2 % 2) += amplitude_of(i, k) * std::polar(1.0, k * path_of(i));
  return s;
}

double worst_of(double low, double high, bool interpolate, std::size_t& nodes) {
  std::vector<double> wavenumbers;
  for (int f = 0; f <= 100; ++f) wavenumbers.push_back(low + (high - low) * f / 100);
  Band band(wavenumbers);
  PathBins bins(band, interpolate);
  nodes = bins.nodes().size();
  for (int i = 0; i < paths; ++i) {
    const std::size_t bin = bins.find(path_of(i));
    for (std::size_t n = 0; n < nodes; ++n) {
      const double k = bins.nodes()[n];
      bins.at(bin, n).at(i % 2, i / 2 % 2) += amplitude_of(i, k) * std::polar(1.0, k * path_of(i));
    }
  }
  std::vector<ScatteringMatrix> sums(wavenumbers.size());
  bins.move_to(sums);
  double worst = 0.0;
  for (std::size_t f = 0; f < sums.size(); ++f) worst = std::max(worst, largest_amplitude(sums[f] - sum_at(wavenumbers[f])));
  return worst;
}

// What is promised is 1e-6 of the sum of all amplitudes, each up to 2, a quarter of them in one channel.
TEST(PathBins, GiveTheSumToTheirPromise) {
  for (const auto& [low, high] : {std::pair{10.0, 10.01}, {10.0, 11.0}, {10.0, 20.0}, {10.0, 40.0}}) {
    std::size_t nodes = 0;
    EXPECT_LE(worst_of(low, high, true, nodes), 1e-6 * 2 * paths / 4) << low << ' ' << high;
    EXPECT_LE(nodes, 25u) << low << ' ' << high;
  }
}

// Wider bands need more nodes, not fewer paths in a bin.
TEST(PathBins, NodesFollowTheRelativeBand) {
  std::size_t narrow = 0, tenth = 0, octave = 0;
  worst_of(10.0, 10.01, true, narrow);
  worst_of(10.0, 11.0, true, tenth);
  worst_of(10.0, 20.0, true, octave);
  EXPECT_LE(tenth, 6u);
  EXPECT_LT(narrow, tenth);
  EXPECT_LT(tenth, octave);
}

TEST(PathBins, WithoutInterpolationEveryWavenumberIsANode) {
  std::size_t nodes = 0;
  EXPECT_LE(worst_of(10.0, 11.0, false, nodes), 1e-10);  // rounding of phases of 1e3 rad
  EXPECT_EQ(nodes, 101u);
  Band few(std::vector<double>{10.0, 10.5, 11.0});
  EXPECT_EQ(PathBins(few, true).nodes().size(), 3u);
}

// A wave that spans as much as it may, in either bin next to where its middle is.
TEST(PathBins, AWaveMaySpanItsSpread) {
  std::vector<double> wavenumbers;
  for (int f = 0; f <= 100; ++f) wavenumbers.push_back(10.0 + 0.01 * f);
  Band band(wavenumbers);
  PathBins bins(band, true);
  const auto wave = [&](double middle, double k) { return std::polar(1.0, k * middle) * 2.0 * std::cos(k * bins.spread()); };
  double worst = 0.0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.031 * i;
    for (std::size_t n = 0; n < bins.nodes().size(); ++n) bins.at(bins.find(middle), n).at(0, 0) = wave(middle, bins.nodes()[n]);
    std::vector<ScatteringMatrix> sums(wavenumbers.size());
    bins.move_to(sums);
    for (std::size_t f = 0; f < sums.size(); ++f) worst = std::max(worst, std::abs(sums[f].vv() - wave(middle, wavenumbers[f])));
  }
  EXPECT_LE(worst, 2e-6);  // of amplitudes that add up to 2
}

}  // namespace
}  // namespace raytube
