// S over frequencies in even steps and looks in even steps of one or two angles: what profiles and images are made of.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/field.h"

namespace raytube {

/// An axis of even steps.
struct EvenAxis {
  double first = 0.0, step = 0.0;  // step 0: one value
  std::size_t count = 1;

  double at(std::size_t i) const { return first + step * static_cast<double>(i); }
  double last() const { return at(count - 1); }
  double middle() const { return 0.5 * (first + last()); }
};

/// Of values in steps that are even to within `tolerance` of a step, rising or falling. Throws InputError that begins with `what`
/// and says where the first uneven step is, and the step that would do.
EvenAxis even_axis(const std::vector<double>& values, const std::string& what, const std::string& unit);

/// Unit vector towards a direction given in degrees.
dvec3 direction_of(double theta_deg, double phi_deg);

/// Directions from the target to the transmitter and receiver, and how far these are [m].
struct SweepLook {
  dvec3 transmit, receive;  // unit
  double transmit_range, receive_range;

  /// S of a point at r has the phase k phase_length(r), that of the origin being zero [m]: (s + s') . r far away, else the path
  /// to the origin less that to r.
  double phase_length(const dvec3& r) const;
  bool far() const;
};

/// Rows of a sweep. Rows of `s` and of the errors: looks vary slowest, frequency fastest.
struct SweepSamples {
  EvenAxis frequency;  // [Hz]
  std::vector<SweepLook> looks{};
  std::vector<ScatteringMatrix> s{};            // [m]
  std::vector<ChannelErrors> error{}, model{};  // of |S| [m]
  std::vector<double> times{};                  // of looks [s], of scenes that move

  std::size_t row(std::size_t look, std::size_t f) const { return look * frequency.count + f; }
  double wavenumber_at(std::size_t f) const { return wavenumber(frequency.at(f)); }
};

/// Places of an antenna in even steps on a straight line, or in a plane along two of them at right angles.
struct AntennaScan {
  dvec3 middle;      // [m]
  dvec3 slow, fast;  // unit; of a line `fast` alone
};

/// Looks of a sweep as a grid of two angles, theta slowest, as they are listed.
struct AngleGrid {
  EvenAxis theta_deg, phi_deg;
  std::vector<std::size_t> looks;     // [theta][phi]: their numbers in the sweep
  std::optional<AntennaScan> scan{};  // instead of angles; theta_deg and phi_deg are then the places along slow and fast [m]
};

/// Of an antenna that is moved along a line, or line by line over a plane, as its places are listed; none for other places.
std::optional<AngleGrid> scan_grid(const std::vector<dvec3>& places);

/// Of looks given by their angles [degrees]. Throws InputError that begins with `what`: for a look that is missing or there
/// twice, and as even_axis does.
AngleGrid angle_grid(const std::vector<std::array<double, 2>>& theta_phi_deg, const std::string& what);

}  // namespace raytube
