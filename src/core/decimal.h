// Decimal numbers at the program's edges: what the user typed is what the files show.
#pragma once

#include <string>

namespace raytube {

/// x rounded to 15 significant decimal digits: undoes the last-bit rounding of a unit conversion.
double rounded_to_15_digits(double x);

/// x rounded to the 13th significant digit of a number of the size of `scale`: start + i * step without binary dust.
double rounded_at_scale(double x, double scale);

/// An angle held in radians, in degrees: the shortest number that gives the same radians, so that 27 comes back as 27 and
/// not as 27.000000000000004.
double decimal_degrees(double radians);

/// The shortest text that reads back as the same double; "0" for both zeros, "inf", "-inf" and "nan" otherwise.
std::string number_text(double x);

/// A limit as it is told: three significant digits, never above x; x > 0 and finite.
std::string rounded_down_text(double x);

}  // namespace raytube
