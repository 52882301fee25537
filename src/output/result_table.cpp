#include "output/result_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <optional>

#include "csv_reader.h"
#include "decimal.h"
#include "error.h"
#include "output/csv.h"

namespace raytube {

namespace {

using Column = std::optional<std::size_t>;

struct Source {
  Column column;
  double unit = 1.0;
};

// Which column holds what.
struct Layout {
  std::array<Source, ResultTable::keys> keys;
  std::array<Column, 4> re, im, sigma;
};

// Columns by name, in small or capital letters.
class Header {
 public:
  explicit Header(const CsvReader& reader) : place_(reader.place()), names_(reader.columns()) {
    for (std::string& name : names_)
      std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  }

  Column find(const std::string& name) const {
    const auto found = std::ranges::find(names_, name);
    if (found == names_.end()) return std::nullopt;
    if (std::find(found + 1, names_.end(), name) != names_.end())
      throw InputError(fmt::format("{}: two columns are named {}; rename or remove one", place_, name));
    return found - names_.begin();
  }

  [[noreturn]] void reject(const std::string& sentence) const { throw InputError(place_ + ": " + sentence); }

 private:
  std::string place_;
  std::vector<std::string> names_;
};

Source frequency_source(const Header& header) {
  if (const Column hertz = header.find("freq_hz")) return {hertz, 1.0};
  return {header.find("freq_ghz"), 1e9};
}

void find_keys(const Header& header, Layout& layout) {
  const Column theta = header.find("theta_deg"), phi = header.find("phi_deg");
  const Column theta_i = header.find("theta_i_deg"), phi_i = header.find("phi_i_deg");
  const bool receiver_first = theta_i || phi_i;
  const Column rx_theta = header.find("rx_theta_deg"), rx_phi = header.find("rx_phi_deg");
  layout.keys = {frequency_source(header), Source{receiver_first ? theta_i : theta}, Source{receiver_first ? phi_i : phi},
                 Source{rx_theta ? rx_theta : theta}, Source{rx_phi ? rx_phi : phi}};
  if (std::ranges::none_of(layout.keys, [](const Source& source) { return source.column.has_value(); }))
    header.reject(
        "no column to match rows by; name at least one of freq_hz, freq_ghz, theta_deg, phi_deg, rx_theta_deg, rx_phi_deg");
}

void find_channels(const Header& header, Layout& layout) {
  bool any = false;
  for (int c = 0; c < 4; ++c) {
    const std::string name = channel_names[c];
    layout.re[c] = header.find("re_" + name), layout.im[c] = header.find("im_" + name);
    layout.sigma[c] = header.find("sigma_" + name + "_dbsm");
    if (layout.re[c].has_value() != layout.im[c].has_value())
      header.reject(fmt::format("re_{0} and im_{0} go together; add the missing one or remove the other", name));
    any = any || layout.re[c] || layout.sigma[c];
  }
  if (!any) header.reject("no channel; name at least re_vv and im_vv, or sigma_vv_dbsm (vh, hv, hh alike)");
}

Layout layout_of(const CsvReader& reader) {
  const bool numbers =
      std::ranges::all_of(reader.columns(), [](const std::string& cell) { return parsed_number(cell).has_value(); });
  const Header header(reader);
  if (numbers)
    header.reject(
        "no header; put a line with the names of the columns first, for example freq_hz,theta_deg,phi_deg,sigma_vv_dbsm");
  Layout layout;
  find_keys(header, layout);
  find_channels(header, layout);
  return layout;
}

double sigma_cell(const CsvReader& reader, std::size_t column) {
  constexpr double zero = -std::numeric_limits<double>::infinity();
  if (parsed_number(reader.cell(column)) == zero) return zero;
  return reader.finite_number(column, "write decibels as a number, and -inf for zero");
}

void read_channel(const CsvReader& reader, const Layout& layout, int channel, ResultTable::Row& row) {
  if (!layout.re[channel]) {
    if (layout.sigma[channel]) row.sigma_dbsm[channel] = sigma_cell(reader, *layout.sigma[channel]);
    return;
  }
  const auto metres = [&](Column column) { return reader.finite_number(*column, "write an amplitude in metres"); };
  row.s[channel] = {metres(layout.re[channel]), metres(layout.im[channel])};
  row.sigma_dbsm[channel] = sigma_dbsm(row.s[channel]);
}

ResultTable::Row read_row(const CsvReader& reader, const Layout& layout) {
  ResultTable::Row row;
  for (int k = 0; k < ResultTable::keys; ++k)
    if (const auto& [column, unit] = layout.keys[k]; column)
      row.key[k] = unit * reader.finite_number(*column, "write an angle in degrees or a frequency");
  if (layout.keys[ResultTable::frequency].column && !(row.key[ResultTable::frequency] > 0.0))
    throw InputError(fmt::format("{}: the frequency must be greater than 0", reader.place()));
  for (int channel = 0; channel < 4; ++channel) read_channel(reader, layout, channel, row);
  return row;
}

}  // namespace

ResultTable read_result_table(const std::filesystem::path& file) {
  CsvReader reader(file, "give the path of a readable table, for example out/rcs.csv");
  if (reader.columns().empty())
    throw InputError(fmt::format("{}: holds no table; give a file with a header and rows", file.string()));
  const Layout layout = layout_of(reader);
  ResultTable table;
  table.file = file;
  for (int k = 0; k < ResultTable::keys; ++k) table.has_key[k] = layout.keys[k].column.has_value();
  for (int c = 0; c < 4; ++c) {
    table.has_phase[c] = layout.re[c].has_value();
    table.has_channel[c] = layout.re[c] || layout.sigma[c];
  }
  while (reader.next()) table.rows.push_back(read_row(reader, layout));
  if (table.rows.empty()) throw InputError(fmt::format("{}: no rows below the header; nothing can be compared", file.string()));
  return table;
}

void keep_rows(ResultTable& table, ResultTable::Key key, double low, double high) {
  if (!table.has_key[key]) return;
  const double slack = key == ResultTable::frequency ? 1e-12 * high : 1e-9;  // 0.1 + 0.2 is not 0.3
  const auto outside = [&](double value) { return value < low - slack || value > high + slack; };
  for (ResultTable::Row& row : table.rows)
    if (double& value = row.key[key]; is_azimuth(key) && outside(value))
      value -= 360.0 * std::floor((value - low + slack) / 360.0);
  std::erase_if(table.rows, [&](const ResultTable::Row& row) { return outside(row.key[key]); });
  if (table.rows.empty())
    throw InputError(fmt::format("{}: no row has {} from {} to {}; widen --only", table.file.string(), key_names[key],
                                 number_text(low), number_text(high)));
}

}  // namespace raytube
