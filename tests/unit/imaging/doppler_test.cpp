// Doppler of points whose S is known: S = sum of A e^{j k L(t)}, L what the path to the origin is longer than that to the point.
#include "imaging/doppler.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/error.h"
#include "output/netcdf/open_netcdf.h"
#include "output/products/doppler_csv.h"
#include "output/products/doppler_netcdf.h"
#include "scratch.h"

namespace raytube {
namespace {

using ::raytube::testing::Scratch;
using ::raytube::testing::text_of;
using ::testing::HasSubstr;

struct MovingPoint {
  double range;     // at time 0 [m]
  double velocity;  // towards the radar [m/s]
  double amplitude;
};

constexpr double interval = 50e-6;

// Pulses about time 0.
std::vector<double> pulse_times(std::size_t count) {
  std::vector<double> times;
  for (std::size_t n = 0; n < count; ++n)
    times.push_back(interval * (static_cast<double>(n) - 0.5 * static_cast<double>(count - 1)));
  return times;
}

SweepLook far_look() {
  constexpr double far = std::numeric_limits<double>::infinity();
  return {dvec3(1.0, 0.0, 0.0), dvec3(1.0, 0.0, 0.0), far, far};
}

// The radar lies in +x: a point at range R is at x = -R.
SweepSamples samples_of_points(const EvenAxis& frequency, const std::vector<double>& times,
                               const std::vector<MovingPoint>& points) {
  SweepSamples samples{.frequency = frequency};
  for (const double t : times)
    for (std::size_t f = 0; f < frequency.count; ++f) {
      ScatteringMatrix s;
      for (const auto& [range, velocity, amplitude] : points)
        s.at(0, 0) += std::polar(amplitude, -2.0 * samples.wavenumber_at(f) * (range - velocity * t));
      samples.s.push_back(s);
    }
  samples.looks.assign(times.size(), far_look());
  samples.times = times;
  return samples;
}

constexpr double middle_hz = 77e9;
const EvenAxis band{76.8e9, 12.5e6, 33};  // a cell of .36 m
const EvenAxis single{middle_hz, 0.0, 1};

std::string refusal(const auto& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::vector<Window> all_windows() {
  std::vector<Window> windows;
  for (const WindowKind kind :
       {WindowKind::rectangular, WindowKind::hann, WindowKind::hamming, WindowKind::taylor, WindowKind::kaiser})
    windows.push_back({kind});
  return windows;
}

// Ten cells of range are crossed while the pulses are sent: 12.8 ms at 281 m/s.
TEST(Doppler, APointIsAtItsRangeAndVelocityAndReadsItsSigma) {
  const SweepSamples samples = samples_of_points(band, pulse_times(256), {{1.234, 281.3, 0.7}});
  for (const Window& window : all_windows()) {
    DopplerOptions options;
    options.window = window, options.velocity = 280.0;
    const DopplerMap map = doppler_map(samples, options, "test");
    EXPECT_NEAR(map.peak.range, 1.234, map.range_limits->cell / 20.0) << name_of(window);
    EXPECT_NEAR(map.peak.velocity, 281.3, map.velocity_limits.cell / 20.0) << name_of(window);
    EXPECT_NEAR(20.0 * std::log10(map.peak.amplitude / 0.7), 0.0, 1e-3) << name_of(window);
    EXPECT_NEAR(map.doppler_of(map.peak.velocity), 2.0 * 281.3 * map.frequency / speed_of_light, 20.0);
  }
}

// The sum as it is written, at some cells of the grid.
TEST(Doppler, CellsHoldTheSum) {
  const SweepSamples samples = samples_of_points(band, pulse_times(20), {{1.0, -9.0, 1.0}, {-2.2, 4.0, 0.3}});
  const DopplerOptions options{.range = 0.5, .velocity = 2.0};
  const DopplerMap map = doppler_map(samples, options, "test");
  const std::vector<double> of_f = weights(options.window, 33), of_t = weights(options.window, 20);
  const double all = std::accumulate(of_f.begin(), of_f.end(), 0.0) * std::accumulate(of_t.begin(), of_t.end(), 0.0);
  ASSERT_EQ(map.s.size(), 66u * 40u);
  EXPECT_DOUBLE_EQ(map.range.at(33), 0.5);
  EXPECT_DOUBLE_EQ(map.velocity.at(20), 2.0);
  for (std::size_t cell = 0; cell < map.s.size(); cell += 71) {
    const double range = map.range.at(cell / 40), velocity = map.velocity.at(cell % 40);
    Complex sum = 0.0;
    for (std::size_t n = 0; n < 20; ++n)
      for (std::size_t f = 0; f < 33; ++f)
        sum += samples.s[samples.row(n, f)].vv() * of_t[n] * of_f[f] / all *
               std::polar(1.0, 2.0 * samples.wavenumber_at(f) * (range - velocity * samples.times[n]));
    EXPECT_NEAR(std::abs(map.s[cell].vv() - sum), 0.0, 2e-7);
  }
}

TEST(Doppler, ThreePointsAtThreeVelocities) {
  const std::vector<MovingPoint> points{{-3.0, -12.0, 1.0}, {0.4, 0.0, 0.5}, {2.5, 7.7, 0.8}};
  const DopplerOptions options{.padding = 16};
  const DopplerMap map = doppler_map(samples_of_points(band, pulse_times(128), points), options, "test");
  for (const auto& [range, velocity, amplitude] : points) {
    const auto r = static_cast<std::size_t>(std::lround((range - map.range.first) / map.range.step)),
               v = static_cast<std::size_t>(std::lround((velocity - map.velocity.first) / map.velocity.step));
    const double level = std::abs(map.s[r * map.velocity.count + v].vv());
    EXPECT_NEAR(20.0 * std::log10(level / amplitude), 0.0, 0.1);
  }
}

// Approaching is positive, and what is faster than half of the unambiguous velocity comes in from the other side.
TEST(Doppler, VelocitiesAliasByTheUnambiguousOne) {
  const double unambiguous = 0.5 * wavelength(middle_hz) / interval;
  for (const double velocity : {5.0, 5.0 + unambiguous, 5.0 - 2.0 * unambiguous}) {
    const DopplerMap map = doppler_map(samples_of_points(single, pulse_times(64), {{0.3, velocity, 2.0}}), {}, "test");
    EXPECT_FALSE(map.range_limits);
    EXPECT_EQ(map.range.count, 1u);
    EXPECT_DOUBLE_EQ(map.velocity_limits.unambiguous, unambiguous);
    EXPECT_DOUBLE_EQ(map.velocity_limits.cell, unambiguous / 64.0);
    EXPECT_NEAR(map.peak.velocity, 5.0, map.velocity_limits.cell / 100.0);
    EXPECT_NEAR(map.peak.amplitude, 2.0, 1e-4);
  }
}

// A radar that drives up to a point at rest, and one that stands while the point comes, see one Doppler.
TEST(Doppler, AMovingAntennaCountsLikeAMovingPoint) {
  const std::vector<double> times = pulse_times(65);
  SweepSamples moving = samples_of_points(band, times, {{0.0, 0.0, 1.0}});
  for (std::size_t n = 0; n < times.size(); ++n)
    moving.looks[n].transmit_range = moving.looks[n].receive_range = 30.0 - 11.0 * times[n];
  const DopplerMap map = doppler_map(moving, {}, "test");
  EXPECT_NEAR(map.peak.velocity, 11.0, map.velocity_limits.cell / 20.0);
  EXPECT_NEAR(map.peak.range, 0.0, map.range_limits->cell / 20.0);
  EXPECT_NEAR(map.peak.amplitude, 1.0, 1e-4);
}

TEST(Doppler, LooksOfAPulseAreMapsOfTheirOwn) {
  const std::vector<double> times = pulse_times(32);
  const SweepSamples a = samples_of_points(band, times, {{1.0, 5.0, 1.0}}),
                     b = samples_of_points(band, times, {{-1.0, -5.0, 2.0}});
  SweepSamples both{.frequency = band};
  for (std::size_t n = 0; n < times.size(); ++n)
    for (const SweepSamples* each : {&a, &b}) {
      both.s.insert(both.s.end(), each->s.begin() + static_cast<std::ptrdiff_t>(n * band.count),
                    each->s.begin() + static_cast<std::ptrdiff_t>((n + 1) * band.count));
      both.looks.push_back(far_look()), both.times.push_back(times[n]);
    }
  const DopplerMap map = doppler_map(both, {}, "test"), of_b = doppler_map(b, {}, "test"),
                   second = doppler_map(both, {.look = 1}, "test");
  EXPECT_EQ(map.peak.look, 1u);
  EXPECT_EQ(second.looks, std::vector<std::size_t>{1});
  for (std::size_t i = 0; i < of_b.s.size(); ++i) {
    EXPECT_EQ(map.s[of_b.s.size() + i].vv(), of_b.s[i].vv());
    EXPECT_EQ(second.s[i].vv(), of_b.s[i].vv());
  }
}

dvec3 place_of(const SweepLook& look) { return look.receive_range * look.receive; }

// Antennas on a line along y at x = 30 m, and a point that comes towards them.
SweepSamples samples_of_array(std::size_t antennas, const std::vector<double>& times, const dvec3& at, const dvec3& velocity) {
  SweepSamples samples{.frequency = band};
  const double spacing = 0.5 * wavelength(middle_hz);
  for (const double t : times)
    for (std::size_t i = 0; i < antennas; ++i) {
      const dvec3 transmitter(30.0, 0.1, 0.0), receiver(30.0, spacing * static_cast<double>(i), 0.0);
      samples.looks.push_back(
          {glm::normalize(transmitter), glm::normalize(receiver), glm::length(transmitter), glm::length(receiver)});
      samples.times.push_back(t);
      for (std::size_t f = 0; f < band.count; ++f) {
        ScatteringMatrix s;
        s.at(1, 1) = std::polar(0.5, samples.wavenumber_at(f) * samples.looks.back().phase_length(at + t * velocity));
        samples.s.push_back(s);
      }
    }
  return samples;
}

TEST(Doppler, AnArrayTellsTheAngle) {
  const dvec3 at(2.0, 9.0, 1.0), velocity(6.0, 1.0, 0.0);
  const SweepSamples samples = samples_of_array(16, pulse_times(32), at, velocity);
  const DopplerMap map = range_doppler_angle(samples, {}, "test");
  const dvec3 transmitter(30.0, 0.1, 0.0), middle = 0.5 * (place_of(samples.looks[0]) + place_of(samples.looks[15]));
  const dvec3 from_transmitter = at - transmitter, from_array = at - middle;
  const double path = glm::length(from_transmitter) + glm::length(from_array) - glm::length(transmitter) - glm::length(middle);
  EXPECT_NEAR(map.peak.cosine, from_array.y / glm::length(from_array), map.cosine_limits->cell / 20.0);
  EXPECT_NEAR(map.peak.range, 0.5 * path, map.range_limits->cell / 20.0);
  EXPECT_NEAR(map.peak.velocity, -0.5 * glm::dot(velocity, glm::normalize(from_transmitter) + glm::normalize(from_array)),
              map.velocity_limits.cell / 20.0);
  EXPECT_NEAR(20.0 * std::log10(map.peak.amplitude / 0.5), 0.0, 0.1);
  EXPECT_NEAR(map.cosine_limits->unambiguous, 2.0, 1e-6);
  EXPECT_NEAR(map.array.y, 1.0, 1e-12);
  EXPECT_EQ(map.s.size(), 66u * 64u * 32u);
}

TEST(Doppler, LooksThatAreNoArrayAreRefused) {
  SweepSamples samples = samples_of_array(4, pulse_times(2), {}, {});
  std::swap(samples.looks[1], samples.looks[2]);
  EXPECT_THAT(refusal([&] { range_doppler_angle(samples, {}, "test"); }), HasSubstr("straight line"));
  EXPECT_THAT(refusal([&] { range_doppler_angle(samples_of_points(band, pulse_times(4), {}), {}, "test"); }),
              HasSubstr("antennas at places"));
}

TEST(Doppler, PulsesThatGiveNoneAreRefused) {
  const auto refused = [](std::vector<double> times, const DopplerOptions& options = {}) {
    SweepSamples samples = samples_of_points(single, times, {{0.0, 0.0, 1.0}});
    return refusal([&] { doppler_map(samples, options, "test"); });
  };
  EXPECT_THAT(refused({}), HasSubstr("nothing moves"));
  EXPECT_THAT(refused({0.0, 0.0}), HasSubstr("one pulse"));
  EXPECT_THAT(refused({0.0, 0.0, 1.0}), HasSubstr("not as many looks"));
  EXPECT_THAT(refused({0.0, 1.0, 2.0, 3.5, 4.5}), HasSubstr("from 2 to 3.5 s it is 1.5, elsewhere 1"));
  EXPECT_THAT(refused({0.0, 1.0, 2.0}, {.look = 1}), HasSubstr("no look 1"));
  EXPECT_EQ(refused({0.0, 1.0, 2.0}), "");
}

// The highest level at a time, and its velocity.
std::array<double, 2> ridge(const Spectrogram& spectrogram, std::size_t time) {
  std::array<double, 2> highest{0.0, 0.0};
  for (std::size_t v = 0; v < spectrogram.velocity.count; ++v)
    if (const double sigma = spectrogram.sigma[time * spectrogram.velocity.count + v][0][0]; sigma > highest[0])
      highest = {sigma, spectrogram.velocity.at(v)};
  return highest;
}

// A point on a turning arm: r sin(w t), so that it approaches at -r w cos(w t).
TEST(Doppler, ASpectrogramFollowsATurningPoint) {
  const std::vector<double> times = pulse_times(1024);
  SweepSamples samples{.frequency = single};
  constexpr double arm = 0.05, turning = 2.0 * pi * 20.0;
  for (const double t : times) {
    ScatteringMatrix s;
    s.at(0, 0) = std::polar(0.5, -2.0 * samples.wavenumber_at(0) * arm * std::sin(turning * t));
    samples.s.push_back(s), samples.looks.push_back(far_look());
  }
  samples.times = times;
  SpectrogramOptions options;
  options.padding = 16, options.length = 24;
  const Spectrogram made = spectrogram(samples, options, "test");
  EXPECT_EQ(made.time.count, 1u + (1024u - 24u) / 6u);
  EXPECT_NEAR(made.time.first, times[0] + 11.5 * interval, 1e-12);
  for (std::size_t i = 0; i < made.time.count; ++i) {
    const auto [sigma, velocity] = ridge(made, i);
    EXPECT_NEAR(velocity, -arm * turning * std::cos(turning * made.time.at(i)), made.velocity_limits.cell / 8.0) << i;
    EXPECT_NEAR(10.0 * std::log10(sigma / (4.0 * pi * 0.25)), 0.0, 0.1) << i;
  }
}

// However wide the gate is, and for every window; outside of it there is nothing.
TEST(Doppler, AGateReadsThePointInItsMiddle) {
  const SweepSamples samples = samples_of_points(band, pulse_times(64), {{1.0, 3.0, 0.5}, {4.0, -6.0, 1.0}});
  for (const Window& window : all_windows())
    for (const std::optional<double> gate :
         {std::optional<double>{0.0}, std::optional<double>{0.3}, std::optional<double>{2.0}}) {
      SpectrogramOptions options;
      options.window = window, options.padding = 16, options.range = 1.0, options.gate = gate, options.length = 64;
      const auto [sigma, velocity] = ridge(spectrogram(samples, options, "test"), 0);
      EXPECT_NEAR(velocity, 3.0, wavelength(middle_hz) / (2.0 * 64.0 * interval) / 16.0);
      EXPECT_NEAR(10.0 * std::log10(sigma / (4.0 * pi * 0.25)), 0.0, 0.1) << name_of(window);
    }
  SpectrogramOptions all;
  all.padding = 16, all.length = 64;
  const auto [sigma, velocity] = ridge(spectrogram(samples, all, "test"), 0);
  EXPECT_NEAR(velocity, -6.0, 0.5);
  EXPECT_NEAR(10.0 * std::log10(sigma / (4.0 * pi)), 0.0, 0.1);
}

TEST(Doppler, WindowsOfMorePulsesThanThereAreAreRefused) {
  SpectrogramOptions options;
  options.length = 9;
  EXPECT_THAT(refusal([&] { spectrogram(samples_of_points(single, pulse_times(8), {}), options, "test"); }),
              HasSubstr("from 2 to 8"));
}

TEST(Doppler, AGateOfOneFrequencyIsRefused) {
  SpectrogramOptions options;
  options.gate = 1.0;
  EXPECT_THAT(refusal([&] { spectrogram(samples_of_points(single, pulse_times(8), {}), options, "test"); }),
              HasSubstr("one frequency does not tell apart"));
}

// Pulses of two antennas at a finite distance: places, and S with the frequency before the receiver.
TEST(Doppler, TheCubeHoldsPulsesAntennasAndTheirPlaces) {
  const Scratch scratch;
  StoredResult result;
  result.frequency_hz = {1e9, 2e9, 3e9};
  result.moving = true;
  for (const double time : {0.25, 0.5})
    for (const double range : {2.0, 4.0}) result.looks.push_back({90.0, 0.0, 90.0, 90.0, 10.0, range, time});
  for (std::size_t row = 0; row < result.rows(); ++row) {
    result.s.emplace_back();
    result.s.back().at(0, 1) = {static_cast<double>(row), -1.0};
  }
  write_raw_netcdf(scratch / "raw.nc", result, "test");
  const OpenNetcdf file(scratch / "raw.nc");
  EXPECT_EQ(file.numbers("time_s", {"pulse"}), (std::vector<double>{0.25, 0.5}));
  const std::vector<double> receivers = file.numbers("receiver_m", {"pulse", "receiver", "xyz"}),
                            real = file.numbers("S_re", {"pulse", "frequency", "receiver", "receive", "transmit"});
  EXPECT_NEAR(receivers[1], 2.0, 1e-15);
  EXPECT_NEAR(receivers[4], 4.0, 1e-15);
  EXPECT_NEAR(file.numbers("transmitter_m", {"pulse", "receiver", "xyz"})[9], 10.0, 1e-15);
  for (std::size_t pulse = 0; pulse < 2; ++pulse)
    for (std::size_t f = 0; f < 3; ++f)
      for (std::size_t receiver = 0; receiver < 2; ++receiver)
        EXPECT_EQ(real[4 * ((pulse * 3 + f) * 2 + receiver) + 1], static_cast<double>((pulse * 2 + receiver) * 3 + f));
}

TEST(Doppler, TablesHaveARowForEachCell) {
  const Scratch scratch;
  const SweepSamples samples = samples_of_points(band, pulse_times(8), {{1.0, 3.0, 0.5}});
  const DopplerMap map = doppler_map(samples, {}, "test");
  write_doppler_csv(scratch / "doppler.csv", map, {});
  const std::string text = text_of(scratch / "doppler.csv");
  EXPECT_THAT(text, HasSubstr("\nlook,range_m,velocity_m_per_s,doppler_hz,re_vv,im_vv,"));
  EXPECT_EQ(std::ranges::count(text, '\n'), 5 + 66 * 16 + 1);
  write_spectrogram_csv(scratch / "spectrogram.csv", spectrogram(samples, {}, "test"), {});
  EXPECT_THAT(text_of(scratch / "spectrogram.csv"), HasSubstr("\nlook,time_s,velocity_m_per_s,doppler_hz,sigma_vv_dbsm,"));
}

}  // namespace
}  // namespace raytube
