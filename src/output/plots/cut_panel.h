// A panel with one cut: joined where its rows resolve the lobes, otherwise points and what most of them hold.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "output/plots/curves.h"
#include "output/tables/sliding_sector.h"
#include "scene/sweep.h"

namespace raytube {

struct DrawnCut {
  Cut cut;
  bool joined;
  std::optional<SlidingSectors> sectors;  // only where points are not joined
};

/// Decides how a cut is drawn, for a target with these outermost points.
DrawnCut drawn_cut(Cut cut, const Sweep& sweep, std::span<const dvec3> outermost);

/// Whether a channel has anything above the floor of the scale.
bool is_shown(const Cut& cut, int channel, const Scale& scale);

/// A line of the key, in a plot command, for a channel that is not shown.
std::string channel_below(int channel, bool joined, const Scale& scale);

/// The same for the dots behind what sectors hold.
inline constexpr const char* each_row_entry = ", \\\n     keyentry with points lc rgb '#606060' pt 7 ps 0.4 title 'each row'";

/// "10°", how wide a sector is.
std::string width_text(const DrawnCut& drawn);

/// Data blocks $cut0, $sectors0 and so on.
std::string cut_data(std::size_t number, const DrawnCut& drawn, const Scale& scale);

/// The commands that draw these data in a panel of their own.
std::string cut_panel(std::size_t number, const DrawnCut& drawn, const Scale& scale);

}  // namespace raytube
