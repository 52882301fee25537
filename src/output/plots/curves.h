// What the pictures of sigma have in common: scales, styles, how a curve is drawn.
#pragma once

#include <array>
#include <span>
#include <string>

#include "output/tables/cuts.h"

namespace raytube {

inline constexpr std::array<const char*, 4> channel_titles = {"VV", "VH", "HV", "HH"};

/// Line styles 1 to 4 for the channels. Dashed over solid, so that two equal curves both show.
inline constexpr const char* channel_styles =
    "set style line 1 lc rgb '#1f5fbf' lw 3 pt 7 ps 0.7\n"
    "set style line 2 lc rgb '#2e8b3d' lw 2 pt 5 ps 0.6\n"
    "set style line 3 lc rgb '#c040c0' lw 2 dt (16,16) pt 4 ps 1.1\n"
    "set style line 4 lc rgb '#d9480f' lw 2 dt (10,6) pt 6 ps 1.1\n";

/// Colours of levels: perceptually even and read in grey, too ("viridis", Smith & van der Walt 2015).
inline constexpr const char* level_palette =
    "set palette defined (0 '#440154', 1 '#472d7b', 2 '#3b528b', 3 '#2c728e', 4 '#21918c', 5 '#28ae80', 6 '#5ec962', "
    "7 '#addc30', 8 '#fde725')\n";

struct Scale {
  double bottom, top;
  double floor;  // values below are not shown
};

/// Holds every value that is no more than 80 dB below the highest one.
Scale scale_of(std::span<const Cut> cuts);

/// A value under the floor (a null, or -inf) is moved just out of the picture, so that its line leaves through the bottom.
std::string shown_level(double sigma_dbsm, const Scale& scale);

/// "points", "linespoints" or "lines", as the number of points asks for; never lines where they may not be joined.
const char* curve_style(std::size_t points, bool joined = true);

/// The command that makes the horizontal axis as wide as the curve.
std::string xrange_of(const Cut& cut);

}  // namespace raytube
