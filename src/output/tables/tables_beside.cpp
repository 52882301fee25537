#include "output/tables/tables_beside.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <string_view>

#include "core/csv_reader.h"
#include "core/error.h"

namespace raytube {

namespace {

constexpr const char* table_remedy = "give a table that raytube has written";
constexpr const char* parts_remedy = "run the case again with --parts, or delete the file";
constexpr const char* incoherent_remedy = "run the case again, or delete the file";
constexpr std::string_view first_column = "re_vv_";
constexpr std::size_t columns_of_a_part = 8;  // re and im of four channels side by side
constexpr std::size_t keys_of_a_row = 5;      // frequency, directions of transmitter and receiver

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
bool is_row(const CsvReader& reader, const StoredResult& result, std::size_t row, const char* remedy) {
  if (row >= result.rows()) return false;
  const StoredLook& look = result.looks[row / result.frequency_hz.size()];
  const std::array keys{result.frequency_hz[row % result.frequency_hz.size()], look.theta_deg, look.phi_deg};
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (reader.finite_number(i, remedy) != keys[i]) return false;
  return true;
}

// `take` gets each row's cells. Throws InputError if the table has other rows than the result.
void read_rows(CsvReader& reader, const std::filesystem::path& file, const StoredResult& result, const char* remedy,
               const std::function<void()>& take) {
  std::size_t row = 0;
  for (; reader.next(); ++row) {
    if (!is_row(reader, result, row, remedy))
      throw InputError(fmt::format("{}: its rows are not those of the result beside it; {}", reader.location(), remedy));
    take();
  }
  if (row != result.rows())
    throw InputError(fmt::format("{}: has {} rows, the result beside it {}; {}", file.string(), row, result.rows(), remedy));
}

// [dBsm] to square metres.
double square_metres(const CsvReader& reader, std::size_t column) {
  return reader.cell(column) == "-inf" ? 0.0 : std::pow(10.0, reader.finite_number(column, incoherent_remedy) / 10.0);
}

}  // namespace

std::vector<StoredPart> read_parts_csv(const std::filesystem::path& file, const StoredResult& result) {
  CsvReader reader(file, table_remedy);
  const std::vector<PartColumns> columns = part_columns(reader);
  std::vector<StoredPart> parts;
  for (const PartColumns& part : columns) parts.push_back({part.name, {}});
  read_rows(reader, file, result, parts_remedy, [&] {
    for (std::size_t i = 0; i < parts.size(); ++i) parts[i].s.push_back(scattering_at(reader, columns[i].first));
  });
  return parts;
}

std::vector<std::array<double, 2>> read_incoherent_csv(const std::filesystem::path& file, const StoredResult& result) {
  CsvReader reader(file, table_remedy);
  if (reader.columns().size() != keys_of_a_row + 2)
    throw InputError(fmt::format("{}: its columns are not those of incoherent.csv; {}", file.string(), incoherent_remedy));
  std::vector<std::array<double, 2>> sigma;
  read_rows(reader, file, result, incoherent_remedy,
            [&] { sigma.push_back({square_metres(reader, keys_of_a_row), square_metres(reader, keys_of_a_row + 1)}); });
  return sigma;
}

}  // namespace raytube
