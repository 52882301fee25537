// Doppler of scenes that move: S over pulses in even steps, and over frequency, brought to velocities and ranges.
//
//   M(R, v) = sum over samples of w S e^{j 2 k (R - v t)} / sum of w
//
// t: time from the middle of the pulses [s]; R: range at that time [m], as in range profiles; v: velocity towards the radar, half
// the rate at which the path from transmitter to receiver shortens [m/s]. With the time factor e^{j omega t} a point that
// approaches at v returns S e^{j 2 k v t}, a frequency higher by the Doppler frequency 2 v / lambda: approaching is positive. The
// factor k of every frequency stands beside t, so that what crosses ranges while pulses are sent stays at one place: the keystone
// transform (Perry, DiPietro & Fante, IEEE Trans. Aerosp. Electron. Syst. 35 (1999), 188). A point of amplitude A has
// M = A at its place. Of one frequency M is the Doppler spectrum. (Richards, Fundamentals of Radar Signal Processing, 2014,
// ch. 5.) Antennas that move count as well: S has the phase of the path beyond that to the origin, and the change of the latter
// is added.
#pragma once

#include <optional>

#include "imaging/range_profile.h"

namespace raytube {

/// Looks of pulses: all looks of one pulse have its time, and every pulse has the same number of them.
struct PulseGrid {
  std::size_t looks = 1;      // of a pulse
  std::vector<double> times;  // of pulses [s]
};

/// Of the times of looks, pulse slowest. Throws InputError that begins with `what` for none, for pulses of different numbers of
/// looks, and for a single pulse.
PulseGrid pulse_grid(const std::vector<double>& times, const std::string& what);

struct DopplerOptions {
  std::optional<std::size_t> look{};  // of a pulse, from 0; none: every one
  Window window{};                    // over frequencies, and over pulses
  int padding = 2;                    // ranges and velocities to a resolution cell of even weights
  double range = 0.0;                 // in the middle of those that are shown [m]
  double velocity = 0.0;              // in the middle of those that are shown [m/s]
};

/// The highest place of a map, between its samples.
struct DopplerPeak {
  std::size_t look = 0;    // of a pulse, the first one of an array
  double range = 0.0;      // [m]
  double velocity = 0.0;   // [m/s]
  double cosine = 0.0;     // with an array
  double amplitude = 0.0;  // of the channel that is largest there [m]
};

/// M of each look of a pulse, or of all of them as an array.
struct DopplerMap {
  double frequency;                           // in the middle of the band: that of Doppler frequencies [Hz]
  EvenAxis time;                              // of pulses [s]; ranges are those at its middle
  std::vector<std::size_t> looks;             // of a pulse: those that are shown; of an array the first one
  std::optional<AxisLimits> range_limits{};   // none of one frequency
  AxisLimits velocity_limits{};               // lambda / (2 N T) for N pulses every T, and lambda / 2T [m/s]
  std::optional<AxisLimits> cosine_limits{};  // of an array; lambda / (N d) for N places every d, and lambda / d
  dvec3 array{0.0};                           // unit, along it
  EvenAxis range{};                           // [m]; one value of one frequency
  EvenAxis velocity{};                        // [m/s]
  EvenAxis cosine{};                          // between the direction from the array to a point, and that along the array
  std::vector<ScatteringMatrix> s{};          // [look][range][velocity][cosine] [m]
  DopplerPeak peak{};

  /// 2 v / lambda [Hz].
  double doppler_of(double velocity) const;
};

/// Throws InputError that begins with `what` for pulses that no Doppler comes of: as pulse_grid does, for uneven times, and for a
/// look that a pulse does not have.
void require_pulses(const SweepSamples& samples, const DopplerOptions& options, const std::string& what);

/// Throws InputError that begins with `what` as require_pulses does, and for maps of more than most_image_cells.
DopplerMap doppler_map(const SweepSamples& samples, const DopplerOptions& options, const std::string& what);

/// The same over the angle as well, from antennas in even steps on a straight line: the looks of a pulse, whose places are the
/// sums of those of transmitter and receiver. A point far from the array, against its length squared over the wavelength, whose
/// direction makes the cosine u with the array has the phase k u d at the place d, which the sum takes out (Richards, ch. 9).
/// Throws InputError also for looks that are no such array.
DopplerMap range_doppler_angle(const SweepSamples& samples, const DopplerOptions& options, const std::string& what);

struct SpectrogramOptions : DopplerOptions {
  std::size_t length = 0;        // pulses of a window; 0: the root of their number, for as many cells of time as of velocity
  double overlap = 0.75;         // share of a window that the next one has in common with it, below 1
  std::optional<double> gate{};  // width of the ranges that count, about the middle one [m]; none: all, 0: that range alone
};

/// |M|^2 of windows of pulses one after the other, the power of all ranges of the gate together.
struct Spectrogram {
  double frequency;                    // in the middle of the band: that of Doppler frequencies [Hz]
  EvenAxis time;                       // of the middles of windows [s]
  std::vector<std::size_t> looks;      // of a pulse: those that are shown
  std::size_t length;                  // pulses of a window
  AxisLimits velocity_limits{};        // [m/s]
  EvenAxis velocity{};                 // [m/s]
  std::vector<ChannelErrors> sigma{};  // [look][time][velocity] [m^2]

  double doppler_of(double velocity) const;
};

/// A point that moves evenly in the middle of the gate reads its sigma at its velocity, however wide the gate is. Throws
/// InputError as doppler_map does, for a window of more pulses than there are, and for a gate of one frequency.
Spectrogram spectrogram(const SweepSamples& samples, const SpectrogramOptions& options, const std::string& what);

}  // namespace raytube
