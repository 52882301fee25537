// Colours, dashes and symbols of a picture, on the screen or in print.
#pragma once

#include <cstddef>
#include <string>

namespace raytube {

inline constexpr std::size_t most_results = 8;  // that can be told apart

/// What a curve stands for.
struct CurveOf {
  std::size_t result, results;  // of so many
  std::size_t channel;
  std::size_t points;
  bool print;
};

/// "with lines lc rgb '#1f5fbf' lw 2 dt solid": channels of one result by colour; of several the results by colour, the channels
/// by dashes. In print black and grey, and of several results each with symbols of its own.
std::string curve_look(const CurveOf& curve);

/// The palette of maps: of colours that are even to the eye and ascend in grey, too; in print of greys, dark for strong.
std::string map_palette(bool print);

}  // namespace raytube
