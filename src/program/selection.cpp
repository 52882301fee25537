#include "program/selection.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/csv_reader.h"
#include "core/error.h"

namespace raytube {

Only parsed_only(const std::string& option) {
  const std::size_t equals = option.find('=');
  const std::string column = option.substr(0, equals), range = equals == std::string::npos ? "" : option.substr(equals + 1);
  const std::size_t colon = range.find(':');
  const auto low = parsed_number(range.substr(0, colon));
  const auto high = colon == std::string::npos ? low : parsed_number(range.substr(colon + 1));
  const auto key = std::ranges::find(key_names, column);
  if (key == key_names.end() || !low || !high || !(*low <= *high))
    throw InputError(
        fmt::format("--only {}: write COLUMN=VALUE or COLUMN=LOW:HIGH with freq_hz, theta_deg, phi_deg, rx_theta_deg or "
                    "rx_phi_deg, for example --only phi_deg=-45:45",
                    option));
  return {static_cast<ResultTable::Key>(key - key_names.begin()), *low, *high};
}

}  // namespace raytube
