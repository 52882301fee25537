#include "case/directions/looks_csv.h"

#include <fmt/format.h>

#include <algorithm>

#include "case/directions/row_limit.h"
#include "case/text/users_words.h"
#include "case/text/values.h"
#include "core/csv_reader.h"
#include "core/error.h"
#include "core/text.h"

namespace raytube {

namespace {

const std::vector<std::string> look_columns = {"theta_deg", "phi_deg", "rx_theta_deg", "rx_phi_deg"};

void check_header(const CsvReader& reader) {
  const std::vector<std::string>& names = reader.columns();
  if ((names.size() != 2 && names.size() != 4) || !std::equal(names.begin(), names.end(), look_columns.begin()))
    throw InputError(
        fmt::format("{}: the header must be \"theta_deg,phi_deg\" or \"{}\"", reader.location(), joined(look_columns, ",")));
}

double angle(const CsvReader& reader, std::size_t column) {
  const double value = reader.finite_number(column, "write angles in degrees, separated by commas");
  if (const std::string sentence = unresolved_angle(look_columns[column], value); !sentence.empty())
    throw InputError(fmt::format("{}: {}", reader.location(), sentence));
  return value == 0.0 ? 0.0 : value;  // never -0
}

Direction direction(const CsvReader& reader, std::size_t column) {
  const double theta_deg = angle(reader, column), phi_deg = angle(reader, column + 1);
  if (theta_deg < 0.0 || theta_deg > 180.0)
    throw InputError(fmt::format("{}: {}", reader.location(), theta_outside("theta", theta_deg)));
  return {theta_deg * degree, phi_deg * degree};
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

}  // namespace raytube
