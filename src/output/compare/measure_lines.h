// Lines of a report: a measure and its values, one column a channel.
#pragma once

#include <array>
#include <functional>
#include <string>

#include "output/compare/error_measures.h"

namespace raytube {

/// Four digits, or "-" where there is no number.
std::string four_digits(double value);

/// A name and a value for every channel with signal.
std::string measure_line(const std::array<bool, 4>& signal, const std::string& name,
                         const std::function<std::string(int)>& value);

/// The errors in dB within so many of the peak, of what is `counted` ("rows"); `errors` of a channel.
std::string near_peak_lines(const std::array<bool, 4>& signal, double within_db, const std::string& counted,
                            const std::function<const ErrorMeasures&(int)>& errors);

}  // namespace raytube
