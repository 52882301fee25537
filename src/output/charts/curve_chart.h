// Curves over one quantity, of one result or of several.
#pragma once

#include "output/charts/canvas.h"

namespace raytube {

/// Rows of one result that form a curve.
struct ChartCut {
  std::size_t result;
  CutRows rows;
};

/// A panel: cuts at the same values of all that is held fixed.
struct CutPanel {
  std::string title;
  std::vector<ChartCut> cuts;
  bool fixed_differs = false;  // one cut of each result, at values of its own: each is told in the key
};

/// The panels of these results over the quantity that they share, at most so many; with that through the first one's peak. Throws
/// InputError if they share none.
std::vector<CutPanel> cut_panels(const std::vector<ChartResult>& results, std::size_t most);

/// What the key calls a curve.
std::string curve_title(const CutPanel& panel, const ChartCut& cut, std::size_t channel, const std::vector<ChartResult>& results);

Chart curve_chart(const std::vector<ChartResult>& results, const std::vector<std::size_t>& channels, const ChartOptions& options);

}  // namespace raytube
