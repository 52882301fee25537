// Integrals over the azimuth about an edge: what they hold to, and whether they know their error.
#include "utd/fan/azimuth_integral.h"

#include <gtest/gtest.h>

#include <string>

namespace raytube {
namespace {

constexpr int frequencies = 3;

/// A scalar integrand with its integral from `from` on.
struct Example {
  const char* name;
  std::function<Complex(double x, int frequency)> value;
  std::function<Complex(double x, int frequency)> primitive;
  double turns;  // rate of its phase that the survey says [rad/rad]
};

/// A kink or a jump where no cut is.
constexpr double kink = 1.234567;

std::vector<Example> examples() {
  const auto rate = [](int f) { return 5.0 + 40.0 * f; };
  const auto wave = [=](double x, int f) { return std::polar(1.0, rate(f) * x); };
  const auto wave_sum = [=](double x, int f) { return std::polar(1.0, rate(f) * x) / Complex(0, rate(f)); };
  return {{"oscillating", wave, wave_sum, 85.0},
          {"oscillating, a bad guess", wave, wave_sum, 5.0},
          {"kinked", [=](double x, int f) { return std::abs(x - kink) * (1.0 + f); },
           [=](double x, int f) { return 0.5 * (x - kink) * std::abs(x - kink) * (1.0 + f); }, 1.0},
          {"root", [=](double x, int) { return std::sqrt(std::abs(x - kink)); },
           [=](double x, int) { return std::copysign(2.0 / 3.0 * std::pow(std::abs(x - kink), 1.5), x - kink); }, 1.0},
          {"jumping", [=](double x, int f) { return x < kink ? Complex(0.0) : wave(x, f); },
           [=](double x, int f) { return x < kink ? wave_sum(kink, f) : wave_sum(x, f); }, 85.0}};
}

/// The integrand in every channel, each with a factor of its own.
const std::array<std::array<Complex, 2>, 2> channels = {{{Complex(1, 0), Complex(0, 0.3)}, {Complex(-0.2, 0.1), Complex(0, 2)}}};

struct Found {
  std::vector<ScatteringMatrix> value;
  std::vector<ChannelErrors> error;
  int calls = 0;
};

Found integral(const std::function<Complex(double, int)>& scalar, const std::array<std::array<Complex, 2>, 2>& factors,
               const std::vector<double>& cuts, double turns, double tolerance) {
  Found found;
  const auto density = [&](double x, std::vector<ScatteringMatrix>& result) {
    ++found.calls;
    result.assign(frequencies, {});
    for (int f = 0; f < frequencies; ++f)
      for (int p = 0; p < 2; ++p)
        for (int q = 0; q < 2; ++q) result[f].at(p, q) = factors[p][q] * scalar(x, f);
  };
  const auto survey = [&](double x) { return PhaseRange{turns * x, turns * x}; };
  AzimuthIntegral sum = integrate_over_azimuth({density, survey}, frequencies, cuts, tolerance);
  found.value = std::move(sum.value);
  found.error = std::move(sum.error);
  return found;
}

double norm(const std::vector<ScatteringMatrix>& value, const std::array<std::array<Complex, 2>, 2>& factors, int f,
            Complex scalar) {
  ScatteringMatrix wanted{factors};
  return frobenius_norm(value[f] - (wanted *= scalar));
}

const std::vector<double> cuts = {0.0, 0.7, 2.0, 4.0};

TEST(AzimuthIntegral, KeepsToItsTolerance) {
  for (const Example& example : examples())
    for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
      const Found found = integral(example.value, channels, cuts, example.turns, tolerance);
      for (int f = 0; f < frequencies; ++f) {
        const Complex truth = example.primitive(4.0, f) - example.primitive(0.0, f);
        const double left = norm(found.value, channels, f, truth);
        double estimate = 0.0;
        for (const auto& row : found.error[f])
          for (const double error : row) estimate = std::hypot(estimate, error);
        // Panels of least width may leave more, but do not claim otherwise; where a kink happens to lie in its panel, twice as
        // much.
        EXPECT_LE(left, std::max(2 * tolerance, estimate)) << example.name << ", " << tolerance << ", frequency " << f;
      }
    }
}

TEST(AzimuthIntegral, EstimateCoversTheErrorOfRootsAndJumps) {
  for (const Example& example : examples()) {
    if (std::string(example.name) != "root" && std::string(example.name) != "jumping") continue;
    const Found found = integral(example.value, channels, cuts, example.turns, 1e-4);
    for (int f = 0; f < frequencies; ++f) {
      const Complex truth = example.primitive(4.0, f) - example.primitive(0.0, f);
      for (int p = 0; p < 2; ++p)
        for (int q = 0; q < 2; ++q)
          EXPECT_LE(std::abs(found.value[f].at(p, q) - channels[p][q] * truth), found.error[f][p][q]) << example.name;
    }
  }
}

TEST(AzimuthIntegral, BasesOfPolarisationDecideNothing) {
  const auto rotated = [](double receive, double transmit) {
    auto turned = channels;
    for (int p = 0; p < 2; ++p)
      for (int q = 0; q < 2; ++q) {
        turned[p][q] = 0.0;
        const double r[2][2] = {{std::cos(receive), -std::sin(receive)}, {std::sin(receive), std::cos(receive)}};
        const double t[2][2] = {{std::cos(transmit), -std::sin(transmit)}, {std::sin(transmit), std::cos(transmit)}};
        for (int i = 0; i < 2; ++i)
          for (int j = 0; j < 2; ++j) turned[p][q] += r[p][i] * channels[i][j] * t[q][j];
      }
    return turned;
  };
  for (const Example& example : examples()) {
    const Found plain = integral(example.value, channels, cuts, example.turns, 1e-4);
    for (const double angle : {0.4, 1.1, pi / 4}) {
      const auto turned = rotated(angle, 2.3 * angle);
      const Found again = integral(example.value, turned, cuts, example.turns, 1e-4);
      EXPECT_EQ(again.calls, plain.calls) << example.name;
      // Rounding of sums of some thousand terms of order 1.
      for (int f = 0; f < frequencies; ++f)
        EXPECT_LE(norm(again.value, turned, f, plain.value[f].vv() / channels[0][0]), 1e-12) << example.name;
    }
  }
}

TEST(AzimuthIntegral, WhatVanishesIsNotSampled) {
  int sampled = 0;
  const auto density = [&](double, std::vector<ScatteringMatrix>& result) {
    ++sampled;
    result.assign(1, {});
  };
  const auto survey = [](double) { return std::optional<PhaseRange>(); };
  const AzimuthIntegral sum = integrate_over_azimuth({density, survey}, 1, cuts, 1e-4);
  EXPECT_EQ(sampled, 0);
  EXPECT_EQ(frobenius_norm(sum.value.at(0)), 0.0);
}

// The phase 30 x^2 turns by 30 over the half of its panel where it is steepest, and by no more than 28 in all: it takes 48
// points, where 24 and 32 were tried before.
TEST(AzimuthIntegral, FirstRuleFollowsTheSteepestPhase) {
  int sampled = 0;
  const auto phase = [](double x) { return 30.0 * x * x; };
  const auto density = [&](double x, std::vector<ScatteringMatrix>& result) {
    ++sampled;
    result.assign(1, {});
    result[0].at(0, 0) = std::polar(1.0, phase(x));
  };
  const auto survey = [&](double x) { return PhaseRange{phase(x), phase(x)}; };
  const AzimuthIntegral sum = integrate_over_azimuth({density, survey}, 1, {0.0, 1.0}, 1e-6);
  EXPECT_EQ(sampled, 48);
  Complex expected = 0.0;
  constexpr int points = 20000;  // of the midpoint rule, which is off by less than 1e-7
  for (int i = 0; i < points; ++i) expected += std::polar(1.0 / points, phase((i + 0.5) / points));
  EXPECT_LT(std::abs(sum.value.at(0).vv() - expected), 1e-6);
}

}  // namespace
}  // namespace raytube
