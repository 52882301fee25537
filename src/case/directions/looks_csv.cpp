#include "case/directions/looks_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/directions/row_limit.h"
#include "case/text/users_words.h"
#include "case/text/values.h"
#include "core/csv_reader.h"
#include "core/error.h"
#include "core/text.h"

namespace raytube {

namespace {

using Columns = std::vector<std::string>;

const Columns look_columns = {"theta_deg", "phi_deg", "rx_theta_deg", "rx_phi_deg"};
const Columns azimuth_columns = {"azimuth_deg", "elevation_deg", "rx_azimuth_deg", "rx_elevation_deg"};

bool are_columns(const Columns& names, const Columns& known) {
  return (names.size() == 2 || names.size() == 4) && std::equal(names.begin(), names.end(), known.begin());
}

void check_header(const CsvReader& reader) {
  if (!are_columns(reader.columns(), look_columns) && !are_columns(reader.columns(), azimuth_columns))
    throw InputError(
        fmt::format("{}: the header must be \"theta_deg,phi_deg\" or \"azimuth_deg,elevation_deg\", with a receiver "
                    "\"{}\" or \"{}\"",
                    reader.location(), joined(look_columns, ","), joined(azimuth_columns, ",")));
}

void check_angle(double value, const std::string& name, const std::string& location) {
  if (const std::string sentence = unresolved_angle(name, value); !sentence.empty())
    throw InputError(fmt::format("{}: {}", location, sentence));
}

// The angles in two columns from this one.
Direction direction(double theta_deg, double phi_deg, std::size_t column, const std::string& location) {
  check_angle(theta_deg, look_columns[column], location);
  check_angle(phi_deg, look_columns[column + 1], location);
  if (theta_deg < 0.0 || theta_deg > 180.0) throw InputError(fmt::format("{}: {}", location, theta_outside("theta", theta_deg)));
  return {(theta_deg + 0.0) * degree, (phi_deg + 0.0) * degree};  // + 0.0: never -0
}

Direction direction(const CsvReader& reader, std::size_t column) {
  const auto angle = [&](std::size_t c) { return reader.finite_number(c, "write angles in degrees, separated by commas"); };
  const double first = angle(column), second = angle(column + 1);
  if (reader.columns().front() == look_columns.front()) return direction(first, second, column, reader.location());
  if (std::abs(second) > 90.0)
    throw InputError(fmt::format("{}: {}", reader.location(), elevation_outside(azimuth_columns[column + 1], second)));
  return direction(theta_of_elevation(second), first, column, reader.location());
}

}  // namespace

std::vector<Look> read_looks_csv(const std::filesystem::path& file, bool& bistatic) {
  CsvReader reader(file, "look.looks_csv must name a readable CSV file");
  std::vector<Look> looks;
  if (!reader.columns().empty()) check_header(reader);
  bistatic = reader.columns().size() == 4;
  while (reader.next()) {
    if (static_cast<double>(looks.size()) == most_rows)
      throw InputError(fmt::format("{}: more than {:.0f} looks; split the list", reader.location(), most_rows));
    const Direction transmit = direction(reader, 0);
    looks.push_back({transmit, bistatic ? direction(reader, 2) : transmit});
  }
  if (looks.empty())
    throw InputError(fmt::format("{}: no looks; write the header theta_deg,phi_deg and one line per direction", file.string()));
  return looks;
}

std::vector<Look> looks_of_numbers(const LookNumbers& numbers, const std::string& location) {
  std::vector<Look> looks;
  looks.reserve(numbers.rows.size());
  for (const auto& [theta, phi, rx_theta, rx_phi] : numbers.rows) {
    const std::string where = fmt::format("{}, look {}", location, looks.size());
    for (const double value : {theta, phi, rx_theta, rx_phi})
      if (!std::isfinite(value)) throw InputError(fmt::format("{}: {} is not an angle; give finite degrees", where, value));
    const Direction transmit = direction(theta, phi, 0, where);
    looks.push_back({transmit, numbers.bistatic ? direction(rx_theta, rx_phi, 2, where) : transmit});
  }
  if (looks.empty()) throw InputError(location + ": no looks; give at least one direction");
  return looks;
}

}  // namespace raytube
