// Range profiles: the Fourier transform of S over frequency.
//
//   p(R) = sum of w_m S(f_m) e^{j 2 k_m R} / sum of w_m
//
// R: range [m] beyond the phase reference, along the line of sight; of a bistatic look along the bisector, times the cosine of
// half the bistatic angle: half of the additional path. A point at R of amplitude A has p(R) = A, so a point of sigma reads
// sigma.
#pragma once

#include "imaging/sweep_grid.h"
#include "imaging/window.h"

namespace raytube {

struct ProfileOptions {
  Window window{};
  int padding = 4;      // ranges to a resolution cell of even weights, at least
  double middle = 0.0;  // of the ranges that are shown, as wide as what is unambiguous [m]
};

/// What samples in even steps resolve along an axis, in its unit.
struct AxisLimits {
  double cell;         // of even weights, from the peak to the first null
  double resolution;   // width of a point's peak 3 dB below its top
  double unambiguous;  // what is farther apart than this lies upon one another
};

/// Of so many samples, from what is unambiguous.
AxisLimits axis_limits(double unambiguous, std::size_t count, const Window& window);

/// Of a sweep of frequencies: c / 2B, B the steps' sum and one more, and c / 2 df [m].
AxisLimits range_limits(const EvenAxis& frequency, const Window& window);

/// The highest place of a profile, between its samples.
struct RangePeak {
  std::size_t look;
  double range;      // [m]
  double amplitude;  // of the channel that is largest there [m]
};

/// Of many looks. Rows of `s`: looks vary slowest.
struct RangeProfiles {
  AxisLimits limits;
  EvenAxis range{};                             // [m], half of the unambiguous range to either side of the middle
  std::vector<ScatteringMatrix> s{};            // p [m]
  std::vector<ChannelErrors> error{}, model{};  // [look] of |p| [m] if all that may be wrong with S came from one range
  RangePeak peak{};
};

/// Throws InputError that begins with `what` for one frequency.
void require_band(const SweepSamples& samples, const std::string& what);

/// Of two frequencies or more.
RangeProfiles range_profiles(const SweepSamples& samples, const ProfileOptions& options);

/// The step in frequency that a target of this depth along the line of sight asks for [Hz].
double frequency_step_for(double depth);

}  // namespace raytube
