#include "output/tables/parts_csv.h"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "core/csv_reader.h"
#include "core/error.h"

namespace raytube {

namespace {

constexpr const char* parts_remedy = "run the case again with --parts, or delete the file";
constexpr std::string_view first_column = "re_vv_";
constexpr std::size_t columns_of_a_part = 8;  // re and im of four channels side by side

struct PartColumns {
  std::string name;
  std::size_t first;
};

std::vector<PartColumns> part_columns(const CsvReader& reader) {
  std::vector<PartColumns> parts;
  const std::vector<std::string>& names = reader.columns();
  for (std::size_t i = 0; i + columns_of_a_part <= names.size(); ++i)
    if (names[i].starts_with(first_column)) parts.push_back({names[i].substr(first_column.size()), i});
  return parts;
}

ScatteringMatrix scattering_at(const CsvReader& reader, std::size_t first) {
  ScatteringMatrix matrix;
  for (std::size_t channel = 0; channel < 4; ++channel)
    matrix.s[channel / 2][channel % 2] = {reader.finite_number(first + 2 * channel, parts_remedy),
                                          reader.finite_number(first + 2 * channel + 1, parts_remedy)};
  return matrix;
}

// The keys of a row are those of the result's.
bool is_row(const CsvReader& reader, const StoredResult& result, std::size_t row) {
  if (row >= result.rows()) return false;
  const StoredLook& look = result.looks[row / result.frequency_hz.size()];
  const std::array keys{result.frequency_hz[row % result.frequency_hz.size()], look.theta_deg, look.phi_deg};
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (reader.finite_number(i, parts_remedy) != keys[i]) return false;
  return true;
}

}  // namespace

std::vector<StoredPart> read_parts_csv(const std::filesystem::path& file, const StoredResult& result) {
  CsvReader reader(file, "give a table that raytube has written");
  const std::vector<PartColumns> columns = part_columns(reader);
  std::vector<StoredPart> parts;
  for (const PartColumns& part : columns) parts.push_back({part.name, {}});
  std::size_t row = 0;
  for (; reader.next(); ++row) {
    if (!is_row(reader, result, row))
      throw InputError(fmt::format("{}: its rows are not those of the result beside it; {}", reader.location(), parts_remedy));
    for (std::size_t i = 0; i < parts.size(); ++i) parts[i].s.push_back(scattering_at(reader, columns[i].first));
  }
  if (row != result.rows())
    throw InputError(
        fmt::format("{}: has {} rows, the result beside it {}; {}", file.string(), row, result.rows(), parts_remedy));
  return parts;
}

}  // namespace raytube
