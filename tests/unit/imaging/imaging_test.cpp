// Range profiles and images of points whose S is known: S = sum of A e^{jk (s + s') . r}.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "core/error.h"
#include "imaging/centres.h"
#include "imaging/isar.h"
#include "imaging/range_profile.h"

namespace raytube {
namespace {

using testing::HasSubstr;

struct Point {
  dvec3 at;
  double amplitude;
};

SweepLook look_from(double theta_deg, double phi_deg, double range = std::numeric_limits<double>::infinity()) {
  const dvec3 direction = spherical_basis({theta_deg * degree, phi_deg * degree}).radial;
  return {direction, direction, range, range};
}

SweepSamples samples_of_points(const EvenAxis& frequency, const std::vector<SweepLook>& looks, const std::vector<Point>& points) {
  SweepSamples samples{.frequency = frequency, .looks = looks};
  for (const SweepLook& look : looks)
    for (std::size_t f = 0; f < frequency.count; ++f) {
      ScatteringMatrix s;
      for (const Point& point : points)
        s.at(0, 0) += std::polar(point.amplitude, samples.wavenumber_at(f) * look.phase_length(point.at));
      samples.s.push_back(s);
    }
  samples.error.resize(samples.s.size()), samples.model.resize(samples.s.size());
  return samples;
}

AngleGrid grid_of(const EvenAxis& theta_deg, const EvenAxis& phi_deg) {
  AngleGrid grid{theta_deg, phi_deg, std::vector<std::size_t>(theta_deg.count * phi_deg.count)};
  std::iota(grid.looks.begin(), grid.looks.end(), std::size_t{0});
  return grid;
}

SweepSamples samples_of_grid(const EvenAxis& frequency, const AngleGrid& grid, const std::vector<Point>& points,
                             double range = std::numeric_limits<double>::infinity()) {
  std::vector<SweepLook> looks;
  for (std::size_t t = 0; t < grid.theta_deg.count; ++t)
    for (std::size_t p = 0; p < grid.phi_deg.count; ++p)
      looks.push_back(look_from(grid.theta_deg.at(t), grid.phi_deg.at(p), range));
  return samples_of_points(frequency, looks, points);
}

// The sum as it is written, at one place.
Complex exact_sum(const SweepSamples& samples, const AngleGrid& grid, const Window& window, const dvec3& at) {
  const std::vector<double> of_f = weights(window, samples.frequency.count), of_theta = weights(window, grid.theta_deg.count),
                            of_phi = weights(window, grid.phi_deg.count);
  Complex sum = 0.0;
  double all = 0.0;
  for (std::size_t i = 0; i < grid.looks.size(); ++i)
    for (std::size_t f = 0; f < samples.frequency.count; ++f) {
      const double k = samples.wavenumber_at(f),
                   w = of_f[f] * of_theta[i / grid.phi_deg.count] * of_phi[i % grid.phi_deg.count] * k;
      sum += w * samples.s[samples.row(i, f)].at(0, 0) * std::polar(1.0, -k * samples.looks[i].phase_length(at));
      all += w;
    }
  return sum / all;
}

double peak_near(const IsarImage& image, const dvec3& at, double within, dvec3& place) {
  double peak = 0.0;
  for (std::size_t i = 0; i < image.s.size(); ++i)
    if (glm::length(image.place(i) - at) < within && std::abs(image.s[i].at(0, 0)) > peak)
      peak = std::abs(image.s[i].at(0, 0)), place = image.place(i);
  return peak;
}

// Side lobes of the transform of the weights, beside the peak [dB].
double sidelobe_db(const Window& window, std::size_t count) {
  const std::vector<double> weight = weights(window, count);
  const auto response = [&](double u) {
    Complex sum = 0.0;
    for (std::size_t m = 0; m < count; ++m)
      sum += std::polar(weight[m], 2.0 * pi * u * static_cast<double>(m) / static_cast<double>(count));
    return std::abs(sum);
  };
  double u = 0.0;
  while (response(u + 0.01) < response(u)) u += 0.01;  // to the first null
  double largest = 0.0;
  for (; u < 0.5 * static_cast<double>(count); u += 0.01) largest = std::max(largest, response(u));
  return 20.0 * std::log10(largest / response(0.0));
}

// Harris (1978), table 1: -13, -32, -43 dB. Of Taylor's few equal lobes the first one is a little lower, the more so the fewer
// they are; Kaiser's formula is a fit.
TEST(ImagingWindow, HasTheSideLobesItShould) {
  EXPECT_NEAR(sidelobe_db({WindowKind::rectangular}, 200), -13.26, 0.1);
  EXPECT_NEAR(sidelobe_db({WindowKind::hann}, 200), -31.5, 0.2);
  EXPECT_NEAR(sidelobe_db({WindowKind::hamming}, 200), -42.7, 0.5);
  for (const double asked : {20.0, 35.0, 60.0}) {
    EXPECT_NEAR(sidelobe_db({WindowKind::taylor, asked}, 200), -asked, 0.7);
    EXPECT_NEAR(sidelobe_db({WindowKind::kaiser, asked}, 200), -asked, 1.0);
  }
}

TEST(ImagingWindow, WidthOfEvenWeightsIsThatOfASinc) {
  EXPECT_NEAR(peak_width(weights({WindowKind::rectangular}, 400)), 0.8859, 1e-3);
  EXPECT_NEAR(peak_width(weights({WindowKind::hann}, 400)), 1.4406, 2e-3);  // Harris (1978), table 1: 1.44
}

// Against the sum over all samples, in one, two and three axes: 1e-7 of the sum of magnitudes.
TEST(ImagingFourier, GriddingIsTheSum) {
  std::vector<dvec3> wave_vectors;
  std::vector<Complex> values;
  for (int j = 0; j < 50; ++j) {
    wave_vectors.emplace_back(200.0 * std::sin(1.3 * j), 150.0 * std::cos(2.1 * j), -90.0 + 3.0 * j);
    values.push_back(std::polar(1.0 + 0.1 * j, 0.7 * j));
  }
  double all = 0.0;
  for (const Complex& value : values) all += std::abs(value);
  for (const std::array<std::size_t, 3>& count : {std::array<std::size_t, 3>{30, 1, 1}, {12, 21, 1}, {5, 8, 9}}) {
    const EvenGrid grid{count, {0.02, 0.013, 0.04}};
    const std::vector<Complex> found = GriddedTransform(grid, wave_vectors)(values);
    std::size_t i = 0;
    for (std::size_t a = 0; a < count[0]; ++a)
      for (std::size_t b = 0; b < count[1]; ++b)
        for (std::size_t c = 0; c < count[2]; ++c, ++i) {
          dvec3 x(0.0);
          const std::array<std::size_t, 3> at{a, b, c};
          for (int axis = 0; axis < 3; ++axis)
            if (count[axis] > 1)
              x[axis] = (static_cast<double>(at[axis]) - static_cast<double>(count[axis] / 2)) * grid.step[axis];
          Complex sum = 0.0;
          for (std::size_t j = 0; j < values.size(); ++j) sum += values[j] * std::polar(1.0, -glm::dot(wave_vectors[j], x));
          ASSERT_LT(std::abs(found[i] - sum), 1e-7 * all);
        }
  }
}

TEST(ImagingFourier, FastSizesHaveSmallFactors) {
  EXPECT_EQ(fast_size(7), 8u);
  EXPECT_EQ(fast_size(97), 100u);
  EXPECT_EQ(fast_size(1), 2u);
}

// Level and place of two points a metre apart in a band of 2 GHz: a tenth of a cell (7.5 mm), 0.1 dB; rising and falling steps.
TEST(RangeProfile, PointsReadTheirLevelAtTheirPlace) {
  for (const double step : {50e6, -50e6}) {
    const EvenAxis frequency{step > 0.0 ? 9e9 : 11e9, step, 41};
    const SweepSamples samples =
        samples_of_points(frequency, {look_from(90.0, 0.0)}, {{{0.5, 0.1, 0.0}, 1.0}, {{-0.5, 0.0, 0.2}, 0.5}});
    const RangeProfiles profiles = range_profiles(samples, {{}, 16});
    EXPECT_NEAR(profiles.limits.unambiguous, 2.998, 1e-3);
    for (const auto& [range, amplitude] : {std::pair{-0.5, 1.0}, {0.5, 0.5}}) {
      double peak = 0.0, at = 0.0;
      for (std::size_t i = 0; i < profiles.range.count; ++i)
        if (const double level = std::abs(profiles.s[i].at(0, 0)); std::abs(profiles.range.at(i) - range) < 0.2 && level > peak)
          peak = level, at = profiles.range.at(i);
      EXPECT_NEAR(at, range, 0.1 * profiles.limits.cell);
      EXPECT_NEAR(20.0 * std::log10(peak / amplitude), 0.0, 0.1);
    }
  }
}

constexpr std::array every_window = {WindowKind::rectangular, WindowKind::hann, WindowKind::hamming, WindowKind::taylor,
                                     WindowKind::kaiser};

// A point of amplitude A has p(R) = A at its range whatever the weights, also midway between the samples of a coarse grid.
TEST(RangeProfile, APointReadsItsLevelForAnyWindowAndPadding) {
  const EvenAxis frequency{9e9, 50e6, 41};
  const double cell = range_limits(frequency, {}).cell;
  for (const WindowKind window : every_window)
    for (const int padding : {1, 2, 3, 4, 8})
      for (const double between : {0.0, 0.3, 0.5}) {
        const double range = (3.0 + between / padding) * cell;
        const SweepSamples samples =
            samples_of_points(frequency, {look_from(90.0, 0.0), look_from(90.0, 90.0)}, {{{0.2, -range, 0.0}, 0.7}});
        const RangePeak peak = range_profiles(samples, {{window}, padding}).peak;
        EXPECT_NEAR(20.0 * std::log10(peak.amplitude / 0.7), 0.0, 1e-3) << static_cast<int>(window) << ' ' << padding;
        EXPECT_NEAR(peak.range, peak.look == 0 ? -0.2 : range, 0.01 * cell);
      }
}

TEST(RangeProfile, NothingHasNoPeak) {
  const SweepSamples samples = samples_of_points({9e9, 50e6, 41}, {look_from(90.0, 0.0)}, {});
  EXPECT_EQ(range_profiles(samples, {}).peak.amplitude, 0.0);
}

TEST(RangeProfile, BistaticRangeIsHalfOfTheAdditionalPath) {
  const SweepLook look{
      {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  const SweepSamples samples = samples_of_points({9e9, 50e6, 41}, {look}, {{{-0.4, -0.2, 0.0}, 1.0}});
  const RangeProfiles profiles = range_profiles(samples, {{}, 16});
  const auto peak = std::ranges::max_element(profiles.s, {}, largest_amplitude);
  EXPECT_NEAR(profiles.range.at(static_cast<std::size_t>(peak - profiles.s.begin())), 0.3, 0.01);
}

// A width of 12 degrees about azimuth 30, theta 75: the ground plane. Places to a tenth of a cell, levels to 0.1 dB.
TEST(Isar, PointsReadTheirLevelAtTheirPlace) {
  const AngleGrid grid = grid_of({75.0, 0.0, 1}, {24.0, 0.3, 41});
  const std::vector<Point> points{{{0.4, 0.1, 0.0}, 1.0}, {{-0.3, -0.5, 0.0}, 0.3}};
  const SweepSamples samples = samples_of_grid({9e9, 50e6, 41}, grid, points);
  const IsarImage image = isar_image(samples, grid, {{}, {{2.0, 2.0, 0.0}}, 8.0}, "");
  for (const Point& point : points) {
    dvec3 place(0.0);
    EXPECT_NEAR(20.0 * std::log10(peak_near(image, point.at, 0.15, place) / point.amplitude), 0.0, 0.1);
    EXPECT_NEAR(glm::dot(place - point.at, image.axes[0].direction), 0.0, 0.1 * image.axes[0].cell);
    EXPECT_NEAR(glm::dot(place - point.at, image.axes[1].direction), 0.0, 0.1 * image.axes[1].cell);
  }
}

// The closed form: I = A where the point is. Far away, from three metres, and in space.
TEST(Isar, APointReadsItsLevelForAnyWindowAndPixels) {
  const AngleGrid plane = grid_of({90.0, 0.0, 1}, {-6.0, 0.8, 16}), space = grid_of({84.0, 1.0, 12}, {-6.0, 1.0, 12});
  const EvenAxis frequency{9e9, 150e6, 14};
  const auto expect = [](const IsarImage& image, const dvec3& at) {
    EXPECT_NEAR(20.0 * std::log10(image.peak.amplitude / 0.7), 0.0, 0.01);
    EXPECT_LT(glm::length(image.peak.place - at), 0.02 * image.axes[0].cell);
  };
  for (const WindowKind window : every_window)
    for (const double pixels : {1.0, 2.0, 3.0, 4.0, 8.0}) {
      SCOPED_TRACE(testing::Message() << static_cast<int>(window) << ' ' << pixels);
      for (const double range : {std::numeric_limits<double>::infinity(), 3.0}) {
        const dvec3 at(0.163, -0.111, 0.0);
        const SweepSamples samples = samples_of_grid(frequency, plane, {{at, 0.7}}, range);
        expect(isar_image(samples, plane, {{window}, {{0.6, 0.6, 0.0}}, pixels}, ""), at);
      }
      if (pixels > 2.0) continue;
      const dvec3 at(0.163, -0.111, 0.07);
      expect(isar_image(samples_of_grid(frequency, space, {{at, 0.7}}), space, {{window}, {{0.5, 0.5, 0.5}}, pixels}, ""), at);
    }
}

// 40 degrees: gridding against the sum at every 97th cell, and where the points are; far below 0.1 dB.
TEST(Isar, WideAnglesAreBackProjected) {
  const AngleGrid grid = grid_of({90.0, 0.0, 1}, {-20.0, 0.5, 81});
  const SweepSamples samples = samples_of_grid({9e9, 50e6, 41}, grid, {{{0.4, 0.1, 0.0}, 1.0}, {{-0.3, -0.3, 0.0}, 0.3}});
  const IsarImage image = isar_image(samples, grid, {{}, {{1.4, 0.8, 0.0}}, 3.0}, "");
  for (std::size_t i = 0; i < image.s.size(); i += 97)
    EXPECT_LT(std::abs(image.s[i].at(0, 0) - exact_sum(samples, grid, {}, image.place(i))), 1e-6);
}

// From three metres, where the waves are far from plane: in focus at its place.
TEST(Isar, AFiniteRangeIsFocused) {
  const AngleGrid grid = grid_of({90.0, 0.0, 1}, {-6.0, 0.3, 41});
  const SweepSamples samples = samples_of_grid({9e9, 50e6, 41}, grid, {{{0.5, 0.6, 0.0}, 1.0}}, 3.0);
  const IsarImage image = isar_image(samples, grid, {{}, {{1.6, 1.6, 0.0}}, 10.0}, "");
  dvec3 place(0.0);
  EXPECT_NEAR(20.0 * std::log10(peak_near(image, {0.5, 0.6, 0.0}, 0.2, place)), 0.0, 0.1);
  EXPECT_LT(glm::length(place - dvec3(0.5, 0.6, 0.0)), 0.02);
}

// A target far from its origin: the same about its middle.
TEST(Isar, AFrameLiesWhereTheTargetIs) {
  const AngleGrid grid = grid_of({90.0, 0.0, 1}, {-6.0, 0.3, 41});
  const SweepSamples samples = samples_of_grid({9e9, 50e6, 41}, grid, {{{-8.5, 4.2, 0.0}, 1.0}});
  const IsarImage image = isar_image(samples, grid, {{}, {{1.0, 1.0, 0.0}, {-8.4, 4.0, 0.0}}, 8.0}, "");
  dvec3 place(0.0);
  EXPECT_NEAR(20.0 * std::log10(peak_near(image, {-8.5, 4.2, 0.0}, 0.2, place)), 0.0, 0.1);
  EXPECT_LT(glm::length(place - dvec3(-8.5, 4.2, 0.0)), 0.02);
}

// Over a right angle wave vectors reach twice as far along range as the band does: cells follow, so that no peak is lost between.
TEST(Isar, CellsFollowWideAngles) {
  const AngleGrid grid = grid_of({90.0, 0.0, 1}, {-45.0, 0.5, 181});
  const SweepSamples samples = samples_of_grid({9e9, 50e6, 41}, grid, {{{0.21, 0.1, 0.0}, 1.0}});
  const IsarImage image = isar_image(samples, grid, {{}, {{0.8, 0.8, 0.0}}, 4.0}, "");
  EXPECT_LT(image.axes[0].cell, 0.05);
  dvec3 place(0.0);
  EXPECT_NEAR(20.0 * std::log10(peak_near(image, {0.21, 0.1, 0.0}, 0.2, place)), 0.0, 0.2);
}

TEST(Isar, AzimuthAndElevationShowSpace) {
  const AngleGrid grid = grid_of({80.0, 0.5, 21}, {-5.0, 0.5, 21});
  const SweepSamples samples = samples_of_grid({9e9, 100e6, 21}, grid, {{{0.3, 0.2, -0.3}, 1.0}});
  const IsarImage image = isar_image(samples, grid, {{}, {{1.2, 1.2, 1.2}}, 4.0}, "");
  dvec3 place(0.0);
  EXPECT_NEAR(20.0 * std::log10(peak_near(image, {0.3, 0.2, -0.3}, 0.3, place)), 0.0, 0.3);
  EXPECT_LT(glm::length(place - dvec3(0.3, 0.2, -0.3)), 0.03);
}

ScatteringPiece piece_at(const dvec3& place, double amplitude, std::size_t mechanism) {
  ScatteringMatrix s;
  s.at(0, 0) = s.at(1, 1) = amplitude;
  return {place, s, mechanism, 7};
}

// Three points of one piece each, two of them two sides apart: places to a hundredth of a side, amplitudes exactly, as the fit
// knows how they see one another. A point persists over all that is resolved.
TEST(ScatteringCentres, PointsAreFound) {
  const std::vector<ScatteringPiece> pieces{piece_at({0.3, 0.0, 0.1}, 1.0, 0), piece_at({0.3, 0.32, 0.1}, 0.5, 3),
                                            piece_at({-0.41, -0.3, -0.2}, 0.1, 2)};
  constexpr double side = 0.1, length = 0.03;
  const ScatteringCentres found =
      scattering_centres(pieces, {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}, {3, side, length, {"a", "b", "c", "d"}});
  ASSERT_EQ(found.centres.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT(glm::length(found.centres[i].place - pieces[i].place), 0.05 * side);
    EXPECT_NEAR(std::abs(found.centres[i].s.vv()) / std::abs(pieces[i].s.vv()), 1.0, 0.02);
    EXPECT_EQ(found.centres[i].mechanism(), pieces[i].mechanism);
    EXPECT_EQ(found.centres[i].triangle, 7u);
    EXPECT_NEAR(found.centres[i].band, 0.5 * length / side, 0.02 * length / side);
  }
  EXPECT_LT(largest_amplitude(found.rest), 0.02);
}

// A strip of a side's length, whose phase does not turn, seen from aside: it persists over less than a point does.
TEST(ScatteringCentres, WhatIsWideFlashes) {
  std::vector<ScatteringPiece> pieces;
  for (int i = -40; i <= 40; ++i) pieces.push_back(piece_at({0.0, 0.0025 * i, 0.0}, 0.01, 0));
  const ScatteringCentres found =
      scattering_centres(pieces, {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}, {5, 0.1, 0.03, {"a"}});
  EXPECT_LT(found.centres.front().azimuth, 0.8 * found.centres.front().elevation);
}

template <class Action>
std::string complaint(const Action& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(SweepGrid, UnevenStepsAreNamed) {
  EXPECT_THAT(complaint([] {
                even_axis({1e9, 2e9, 4e9}, "x: frequencies", "Hz");
              }),
              HasSubstr("x: frequencies are not in even steps: from 1e+09 to 2e+09 Hz"));
  EXPECT_EQ(even_axis({10.0, 8.0, 6.0}, "", "").step, -2.0);
  EXPECT_EQ(even_axis({10.0}, "", "").count, 1u);
}

TEST(SweepGrid, AzimuthsGoOnOverAFullTurn) {
  const AngleGrid grid = angle_grid({{90, 0}, {90, 2}, {90, 356}, {90, 358}}, "");
  EXPECT_EQ(grid.phi_deg.first, 356.0);
  EXPECT_EQ(grid.phi_deg.last(), 362.0);
  EXPECT_THAT(grid.looks, testing::ElementsAre(2u, 3u, 0u, 1u));
  EXPECT_EQ(angle_grid({{90, 0}, {90, 120}, {90, 240}}, "").phi_deg.first, 0.0);
}

TEST(SweepGrid, AGapIsNamed) {
  EXPECT_THAT(complaint([] {
                even_axis({1.0, 2.0, 3.0, 5.0, 6.0}, "x: looks", "degrees");
              }),
              HasSubstr("from 3 to 5 degrees it is 2, elsewhere 1; compute 1 to 6 degrees in even ones"));
  EXPECT_THAT(complaint([] {
                angle_grid({{90, 0}, {90, 180}, {90, 360}}, "x: look");
              }),
              HasSubstr("looks in phi go round to where they began, 360 degrees"));
}

TEST(SweepGrid, MissingAndDoubleLooksAreNamed) {
  EXPECT_THAT(complaint([] {
                angle_grid({{80, 0}, {80, 1}, {90, 0}}, "x: look");
              }),
              HasSubstr("x: look is missing: theta 90, phi 1 degrees"));
  EXPECT_THAT(complaint([] { angle_grid({{80, 0}, {80, 0}}, "x: look"); }), HasSubstr("is there twice"));
  EXPECT_THAT(angle_grid({{90, 1}, {80, 1}, {90, 0}, {80, 0}}, "").looks, testing::ElementsAre(3u, 1u, 2u, 0u));
}

}  // namespace
}  // namespace raytube
