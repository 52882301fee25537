#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <fstream>

#include "case/looks.h"
#include "error.h"

namespace raytube {

namespace {

const std::string short_header = "theta_deg,phi_deg";
const std::string long_header = "theta_deg,phi_deg,rx_theta_deg,rx_phi_deg";

// Spreadsheets add a byte order mark, spaces and carriage returns.
std::string without_blanks(const std::string& line) {
  std::string kept;
  for (const char c : line)
    if (c != ' ' && c != '\t' && c != '\r') kept += c;
  return kept.rfind("\xEF\xBB\xBF", 0) == 0 ? kept.substr(3) : kept;
}

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> parts(1);
  for (const char c : line) {
    if (c == ',')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

double angle(const std::string& field, const std::string& place) {
  const char* first = field.data() + (field.rfind('+', 0) == 0 ? 1 : 0);
  const char* last = field.data() + field.size();
  double value = 0.0;
  const auto [end, error] = std::from_chars(first, last, value);
  if (error != std::errc() || end != last || !std::isfinite(value))
    throw InputError(
        fmt::format("{}: \"{}\" is not a finite number; write angles in degrees, separated by commas", place, field));
  return value == 0.0 ? 0.0 : value;  // never -0
}

Direction direction(double theta_deg, double phi_deg, const std::string& place) {
  if (theta_deg < 0.0 || theta_deg > 180.0)
    throw InputError(fmt::format("{}: theta must lie in 0 to 180 degrees, from +z (found {})", place, theta_deg));
  return {theta_deg * degree, phi_deg * degree};
}

Look look(const std::string& line, std::size_t columns, const std::string& place) {
  const std::vector<std::string> parts = fields(line);
  if (parts.size() != columns)
    throw InputError(
        fmt::format("{}: {} values where the header names {} columns; correct the line", place, parts.size(), columns));
  std::vector<double> angles;
  for (const std::string& part : parts) angles.push_back(angle(part, place));
  const Direction transmit = direction(angles[0], angles[1], place);
  return {transmit, columns == 4 ? direction(angles[2], angles[3], place) : transmit};
}

}  // namespace

std::vector<Look> read_looks_csv(const std::filesystem::path& file, bool& bistatic) {
  std::error_code ignored;
  std::ifstream stream(file);
  if (!stream || std::filesystem::is_directory(file, ignored))
    throw InputError(fmt::format("{}: cannot be read; look.looks_csv must name a readable CSV file", file.string()));
  std::vector<Look> looks;
  std::size_t columns = 0, number = 0;
  for (std::string raw; std::getline(stream, raw);) {
    const std::string place = fmt::format("{}, line {}", file.string(), ++number), line = without_blanks(raw);
    if (line.empty() || line[0] == '#') continue;
    if (columns != 0) {
      looks.push_back(look(line, columns, place));
      continue;
    }
    if (line != short_header && line != long_header)
      throw InputError(fmt::format("{}: the header must be \"{}\" or \"{}\"", place, short_header, long_header));
    columns = line == short_header ? 2 : 4;
  }
  if (looks.empty())
    throw InputError(fmt::format("{}: no looks; write the header {} and one line per direction", file.string(), short_header));
  bistatic = columns == 4;
  return looks;
}

}  // namespace raytube
