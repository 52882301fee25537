// Many wavenumbers from a few: how exact, and where it is left alone.
#include "math/chebyshev.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace raytube {
namespace {

std::vector<double> evenly(double low, double high, std::size_t count) {
  std::vector<double> wavenumbers;
  for (std::size_t i = 0; i < count; ++i)
    wavenumbers.push_back(low + (high - low) * static_cast<double>(i) / static_cast<double>(count - 1));
  return wavenumbers;
}

// Waves at both ends of the span, in the middle and between, amplitudes adding up to 1.
Complex waves(double k, double half_span) {
  return 0.4 * std::polar(1.0, k * half_span) + 0.3 * std::polar(1.0, -k * half_span) +
         0.2 * std::polar(1.0, 0.37 * k * half_span) + 0.1;
}

double largest_error(Band& band, double half_span) {
  const ChebyshevNodes* nodes = band.nodes(half_span);
  if (!nodes) return -1.0;
  double worst = 0.0;
  for (std::size_t f = 0; f < band.wavenumbers().size(); ++f) {
    Complex value = 0.0;
    for (std::size_t n = 0; n < nodes->at.size(); ++n)
      value += nodes->weights[f * nodes->at.size() + n] * waves(nodes->at[n], half_span);
    worst = std::max(worst, std::abs(value - waves(band.wavenumbers()[f], half_span)));
  }
  return worst;
}

// Half-spans up to those that need half as many nodes as there are wavenumbers: the limit is what nodes() promises. At the upper
// end of the narrow band kx is 1000 rad, and its own rounding 1e-13.
TEST(Chebyshev, InterpolatesWavesOfTheSpanToItsPromise) {
  for (const double high : {105.0, 200.0}) {
    Band band(evenly(100.0, high, 201));
    for (double phase = 0.01; phase < 45.0; phase *= 1.3) {
      const double error = largest_error(band, phase / (0.5 * (high - 100.0)));
      EXPECT_GE(error, 0.0) << phase;
      EXPECT_LE(error, 1e-12) << phase;
    }
  }
}

// Waves outside the span are missed: the nodes are not simply many.
TEST(Chebyshev, NodesAreNoMoreThanNeeded) {
  Band band(evenly(2000.0, 2040.0, 201));
  const ChebyshevNodes* nodes = band.nodes(1.0);  // 20 rad to either side
  ASSERT_TRUE(nodes);
  EXPECT_LE(nodes->at.size(), 20u + 30u);
  double worst = 0.0;
  for (std::size_t f = 0; f < 201; ++f) {
    Complex value = 0.0;
    for (std::size_t n = 0; n < nodes->at.size(); ++n)
      value += nodes->weights[f * nodes->at.size() + n] * waves(nodes->at[n], 1.7);
    worst = std::max(worst, std::abs(value - waves(band.wavenumbers()[f], 1.7)));
  }
  EXPECT_GT(worst, 1e-9);
}

TEST(Chebyshev, AWavenumberOnANodeTakesItsValue) {
  Band all(evenly(100.0, 101.0, 101));
  const double node = all.nodes(0.1)->at[1];
  std::vector<double> wavenumbers = evenly(100.0, 101.0, 101);
  wavenumbers[50] = node;
  Band band(wavenumbers);
  const ChebyshevNodes* nodes = band.nodes(0.1);
  for (std::size_t n = 0; n < nodes->at.size(); ++n)
    EXPECT_EQ(nodes->weights[50 * nodes->at.size() + n], nodes->at[n] == node ? 1.0 : 0.0);
}

// Nodes of a band that is one rounding wide lie on one another: weights there are 1e16.
TEST(Chebyshev, WavenumbersThatDifferByRoundingAreLeftAlone) {
  std::vector<double> wavenumbers(101, 100.0);
  wavenumbers[50] = std::nextafter(100.0, 101.0);
  Band band(wavenumbers);
  EXPECT_FALSE(band.nodes(0.1));
  EXPECT_FALSE(band.nodes_of_fresnel(0.1, 1e-6));
  EXPECT_FALSE(band.slow_nodes(3.0, 1e-6).nodes);
}

TEST(Chebyshev, FewWavenumbersOrWideSpansAreLeftAlone) {
  EXPECT_FALSE(Band(evenly(100.0, 101.0, 7)).nodes(1e-9));
  EXPECT_FALSE(Band(evenly(100.0, 200.0, 101)).nodes(1.0));  // 50 rad to either side: more nodes than half of 101
  EXPECT_FALSE(Band(evenly(100.0, 200.0, 101)).nodes(1e9));
  EXPECT_TRUE(Band(evenly(100.0, 101.0, 101)).nodes(1.0));
}

}  // namespace
}  // namespace raytube
