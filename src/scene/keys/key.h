// A scalar key of a case file: its name, its unit, and what its numbers may be.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <string_view>

namespace raytube {

/// The interval in which a number lies.
struct Limits {
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
  bool above = false, below = false;  // the least, the most itself is out of bounds

  bool hold(double number) const;
  /// "from 0 to 1", "greater than 0", "at least 0 and less than 180".
  std::string text() const;
};

/// Nothing of a case may lie farther from the origin [m].
inline constexpr double farthest = 1e12;

inline constexpr Limits at_least_zero{.least = 0.0};
inline constexpr Limits a_range{.least = 0.0, .most = farthest, .above = true};  // [m]
inline constexpr Limits above_zero{.least = 0.0, .above = true};
/// Limits of tubes or of cells of an image per wavelength: what is sampled more coarsely than in a thousand wavelengths is not
/// sampled.
inline constexpr Limits a_density{.least = 1e-3};

struct CaseKey {
  std::string_view name;             // dotted: "tubes.max_bounces"
  Limits limits = {};                // of a number, in the unit of the key
  std::string_view unit = {};        // for docs/reference/case_keys.md, as the default
  std::string_view by_default = {};  // where the member does not say it
  double factor = 1.0;               // makes the member of the number
  bool allowed = true;               // by the values of the keys `choices`
  std::string_view needs = {};       // else: what it needs, and the remedy
  std::array<std::string_view, 2> choices = {};
  bool shown = allowed;  // it counts: it is checked, and the resolved case has it
};

}  // namespace raytube
