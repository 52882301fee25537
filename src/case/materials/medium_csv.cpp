#include "case/materials/medium_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/csv_reader.h"
#include "core/decimal.h"
#include "core/error.h"
#include "core/text.h"

namespace raytube {

namespace {

const std::vector<std::string> medium_columns = {"freq_ghz", "eps_real", "eps_loss", "mu_real", "mu_loss"};

void check_medium_header(const CsvReader& reader, const std::filesystem::path& file) {
  const std::vector<std::string>& names = reader.columns();
  if ((names.size() != 3 && names.size() != 5) || !std::equal(names.begin(), names.end(), medium_columns.begin()))
    throw InputError(fmt::format("{}: the header must be \"freq_ghz,eps_real,eps_loss\" or \"{}\"", file.string(),
                                 joined(medium_columns, ",")));
}

double read_frequency(const CsvReader& reader, const MediumTable& table) {
  const double hertz = rounded_to_15_digits(reader.finite_number(0, "write the frequency in GHz") * 1e9);
  if (!(hertz > 0.0)) throw InputError(reader.location() + ": freq_ghz must be greater than 0; correct the line");
  if (!std::isfinite(hertz)) throw InputError(reader.location() + ": freq_ghz is too large; write the frequency in GHz");
  if (!table.frequencies.empty() && hertz <= table.frequencies.back())
    throw InputError(reader.location() + ": freq_ghz must ascend; sort the rows and drop repeated ones");
  return hertz;
}

Complex read_relative(const CsvReader& reader, std::size_t column) {
  const double real = reader.finite_number(column, "write the real part"),
               loss = reader.finite_number(column + 1, "write the loss, not below 0");
  if (loss < 0.0)
    throw InputError(fmt::format("{}: {} has a gain: in {} losses are not below 0; write {}", reader.location(),
                                 medium_columns[column + 1], loss_convention(medium_columns[column]), number_text(-loss)));
  if (real == 0.0) throw InputError(fmt::format("{}: {} must not be 0; vacuum has 1", reader.location(), medium_columns[column]));
  return {real, -loss};
}

}  // namespace

std::string loss_convention(std::string_view key) {
  const bool magnetic = key.substr(key.rfind('.') + 1).starts_with("mu_");
  return fmt::format("{0}_r = {0}' - j {0}'' (e^{{+jwt}})", magnetic ? "mu" : "eps");
}

Medium MediumTable::at(double frequency) const {
  const std::size_t above =
      std::clamp<std::size_t>(std::ranges::lower_bound(frequencies, frequency) - frequencies.begin(), 1, frequencies.size() - 1);
  const Medium &low = media[above - 1], &high = media[above];
  const double share = (frequency - frequencies[above - 1]) / (frequencies[above] - frequencies[above - 1]);
  return {(1.0 - share) * low.permittivity + share * high.permittivity,
          (1.0 - share) * low.permeability + share * high.permeability};
}

MediumTable read_medium_csv(const std::filesystem::path& file, const std::string& location) {
  if (std::error_code error; !std::filesystem::is_regular_file(file, error))
    throw InputError(fmt::format("{}: {} cannot be read; name a readable CSV file", location, file.string()));
  CsvReader reader(file, "table_csv must name a readable CSV file");
  check_medium_header(reader, file);
  MediumTable table;
  while (reader.next()) {
    table.frequencies.push_back(read_frequency(reader, table));
    table.media.push_back({read_relative(reader, 1), reader.columns().size() == 5 ? read_relative(reader, 3) : 1.0});
  }
  if (table.media.size() < 2)
    throw InputError(file.string() +
                     ": a table of a medium needs at least two rows; write eps_r for a medium without dispersion");
  return table;
}

}  // namespace raytube
