#include "output/products/amplitude_columns.h"

#include <fmt/format.h>

#include "output/tables/csv.h"

namespace raytube {

std::string amplitude_columns() {
  std::string text;
  for (const char* channel : channel_names) text += fmt::format(",re_{0},im_{0}", channel);
  for (const char* channel : channel_names) text += fmt::format(",sigma_{}_dbsm", channel);
  return text;
}

std::string amplitudes_text(const ScatteringMatrix& s, int digits) {
  std::string text;
  for (const int channel : {0, 1, 2, 3}) {
    const Complex value = s.at(channel / 2, channel % 2);
    text += fmt::format(",{:.{}g},{:.{}g}", value.real(), digits, value.imag(), digits);
  }
  for (const int channel : {0, 1, 2, 3}) text += fmt::format(",{:.3f}", sigma_dbsm(s.at(channel / 2, channel % 2)));
  return text;
}

}  // namespace raytube
