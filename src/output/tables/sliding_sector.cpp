#include "output/tables/sliding_sector.h"

#include <algorithm>
#include <cmath>

#include "output/tables/sampled_rows.h"

namespace raytube {

namespace {

constexpr double widest_gap = 10.0;  // [degrees]: a circle drawn with less than 36 points looks like a polygon
constexpr std::size_t sectors_of_a_curve = 36;
constexpr std::size_t tenths = 10;  // a multiple of so many steps: each of the three levels is that of a row

// Rows after which even azimuths come back to the first one; 0 if they do not.
std::size_t rows_of_a_turn(const Cut& cut) {
  if (cut.quantity != RowCoordinates::phi && cut.quantity != RowCoordinates::rx_phi) return 0;
  const double step = (cut.x.back() - cut.x.front()) / static_cast<double>(cut.x.size() - 1);
  const double rows = 360.0 / step, whole = std::round(rows);
  const auto turn = static_cast<std::size_t>(whole);
  if (std::abs(rows - whole) > 1e-6 * rows) return 0;
  return turn == cut.x.size() || turn + 1 == cut.x.size() ? turn : 0;
}

SectorLevels levels_of(std::vector<double> values) {
  const auto nth = [&](std::size_t rank) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
    std::ranges::nth_element(values, at);
    return *at;
  };
  const std::size_t steps = values.size() - 1;
  return {nth(steps / tenths), nth(steps / 2), nth(steps - steps / tenths)};
}

std::vector<double> sector_about(std::size_t middle, std::size_t steps, std::size_t turn, const std::vector<double>& values) {
  std::vector<double> inside;
  for (std::size_t i = 0; i <= steps; ++i) {
    const std::size_t at = middle + i + turn - steps / 2;
    inside.push_back(values[turn > 0 ? at % turn : at]);
  }
  return inside;
}

}  // namespace

bool goes_round(std::span<const double> degrees) {
  if (degrees.size() < 2 || degrees.front() + 360.0 - degrees.back() > widest_gap) return false;
  return std::ranges::adjacent_find(degrees, [](double a, double b) { return b - a > widest_gap; }) == degrees.end();
}

std::optional<SlidingSectors> sliding_sectors(const Cut& cut) {
  const std::size_t rows = cut.x.size();
  const std::size_t steps = tenths * std::max<std::size_t>(1, (rows + 5 * sectors_of_a_curve) / (tenths * sectors_of_a_curve));
  if (cut.quantity == RowCoordinates::look_number || rows <= 2 * steps || !in_even_steps(cut.x)) return {};
  const std::size_t turn = rows_of_a_turn(cut), margin = turn > 0 ? 0 : steps / 2;
  SlidingSectors sectors{static_cast<double>(steps) * (cut.x.back() - cut.x.front()) / static_cast<double>(rows - 1), {}, {}};
  for (std::size_t middle = margin; middle + margin < rows; ++middle) {
    sectors.x.push_back(cut.x[middle]);
    for (std::size_t channel = 0; channel < 4; ++channel)
      sectors.levels[channel].push_back(levels_of(sector_about(middle, steps, turn, cut.sigma_dbsm[channel])));
  }
  return sectors;
}

}  // namespace raytube
