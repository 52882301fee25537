#include "case/directions/row_limit.h"

#include <fmt/format.h>

#include <cmath>

namespace raytube {

void check_rows(const CaseValue& value, double looks, std::size_t frequencies) {
  const double rows = looks * static_cast<double>(frequencies), fit = std::floor(most_rows / static_cast<double>(frequencies));
  if (rows > most_rows)
    reject(value,
           fmt::format("{:.7g} looks at {} frequencies make {:.7g} rows, more than the {:.0f} allowed; split the sweep: {:.0f} "
                       "looks would fit",
                       looks, frequencies, rows, most_rows, fit));
}

}  // namespace raytube
