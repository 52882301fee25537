#include "output/tables/result_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "core/csv_reader.h"
#include "core/decimal.h"
#include "core/error.h"
#include "core/text.h"
#include "output/netcdf/netcdf_file.h"
#include "output/tables/csv.h"
#include "output/tables/table_columns.h"

namespace raytube {

namespace {

// Which column holds what.
struct Layout {
  std::array<ColumnSource, ResultTable::keys> keys;
  ChannelColumns channels;
};

ColumnSource frequency_source(const TableHeader& header) {
  if (const ColumnSource hertz = header.find("freq_hz")) return hertz;
  ColumnSource source = header.find("freq_ghz");
  source.factor *= 1e9, source.offset *= 1e9;
  return source;
}

void find_keys(const TableHeader& header, Layout& layout) {
  const ColumnSource theta = header.find("theta_deg"), phi = header.find("phi_deg");
  const ColumnSource theta_i = header.find("theta_i_deg"), phi_i = header.find("phi_i_deg");
  const bool receiver_first = theta_i || phi_i;
  const ColumnSource rx_theta = header.find("rx_theta_deg"), rx_phi = header.find("rx_phi_deg");
  layout.keys = {frequency_source(header),     receiver_first ? theta_i : theta,
                 receiver_first ? phi_i : phi, rx_theta ? rx_theta : theta,
                 rx_phi ? rx_phi : phi,        header.find("time_s")};
  if (std::ranges::none_of(layout.keys, [](const ColumnSource& source) { return source.column.has_value(); }))
    header.reject(
        "no column to match rows by; name at least one of freq_hz, freq_ghz, theta_deg, phi_deg, rx_theta_deg, rx_phi_deg, "
        "time_s, " +
        header.remedy("phi_deg"));
}

Layout layout_of(const CsvReader& reader, const ColumnMap& map, const std::string& option) {
  const bool numbers =
      std::ranges::all_of(reader.columns(), [](const std::string& cell) { return parsed_number(cell).has_value(); });
  if (numbers)
    TableHeader(reader.location(), reader.columns(), {}, option)
        .reject("no header; put a line with the names of the columns first, for example freq_hz,theta_deg,phi_deg,sigma_vv_dbsm");
  const TableHeader header(reader.location(), reader.columns(), map, option);
  Layout layout;
  find_keys(header, layout);
  layout.channels = find_channels(header);
  return layout;
}

void read_channel(const CsvReader& reader, const ChannelSource& source, int channel, ResultTable::Row& row) {
  if (!source.any()) return;
  const ChannelValue value = channel_value(reader, source);
  row.s[channel] = value.s;
  row.sigma_dbsm[channel] = value.sigma_dbsm;
}

ResultTable::Keys read_keys(const CsvReader& reader, const Layout& layout) {
  ResultTable::Keys key{};
  for (int k = 0; k < ResultTable::keys; ++k)
    if (layout.keys[k]) key[k] = value_of(reader, layout.keys[k], "write an angle in degrees, a frequency or a time in seconds");
  if (layout.keys[ResultTable::frequency] && !(key[ResultTable::frequency] > 0.0))
    throw InputError(fmt::format("{}: the frequency must be greater than 0", reader.location()));
  return key;
}

// Rows of a table; those of both transmit polarisations become one.
class Rows {
 public:
  explicit Rows(const Layout& layout) : layout_(layout) {}

  void read(const CsvReader& reader) {
    const ResultTable::Keys key = read_keys(reader, layout_);
    const int transmit = layout_.channels.transmit ? transmit_of(reader, *layout_.channels.transmit) : 0;
    ResultTable::Row& row = layout_.channels.transmit ? shared_row(key, transmit) : rows_.emplace_back();
    row.key = key;
    for (int channel = 0; channel < 4; ++channel)
      if (!layout_.channels.transmit || channel % 2 == transmit)
        read_channel(reader, layout_.channels.channels[channel], channel, row);
  }

  bool transmitted(int polarisation) const { return !layout_.channels.transmit || count_[polarisation] > 0; }

  std::vector<ResultTable::Row> finish(const std::filesystem::path& file) {
    const std::size_t partners = std::min(count_[0], count_[1]);
    if (partners > 0 && (count_[0] != count_[1] || rows_.size() != partners))
      throw InputError(
          fmt::format("{}: rows with transmit polarisation v and h do not come in pairs; add the missing ones", file.string()));
    return std::move(rows_);
  }

 private:
  // The n-th row of one polarisation belongs to the n-th row of the other with the same keys.
  ResultTable::Row& shared_row(const ResultTable::Keys& key, int transmit) {
    SharedRows& shared = shared_[key];
    const std::size_t n = shared.count[transmit]++;
    ++count_[transmit];
    if (n == shared.rows.size()) {
      shared.rows.push_back(rows_.size());
      rows_.emplace_back();
    }
    return rows_[shared.rows[n]];
  }

  struct SharedRows {
    std::array<std::size_t, 2> count{};
    std::vector<std::size_t> rows;
  };

  const Layout& layout_;
  std::map<ResultTable::Keys, SharedRows> shared_;
  std::array<std::size_t, 2> count_{};
  std::vector<ResultTable::Row> rows_;
};

bool finite(Complex s) { return std::isfinite(s.real()) && std::isfinite(s.imag()); }

void require_numbers(const ResultTable& table) {
  for (const ResultTable::Row& row : table.rows)
    for (std::size_t c = 0; c < 4; ++c)
      if (table.has_channel[c] && !finite(row.s[c]))
        throw InputError(fmt::format("{}: S at {} Hz, theta {}, phi {} is not a finite number; leave that row out with --only",
                                     table.file.string(), number_text(row.key[ResultTable::frequency]),
                                     number_text(row.key[ResultTable::theta]), number_text(row.key[ResultTable::phi])));
}

std::vector<ResultTable::Row> rows_of(const StoredResult& stored) {
  std::vector<ResultTable::Row> rows(stored.rows());
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const StoredLook& look = stored.looks[row / stored.frequency_hz.size()];
    const double hertz = stored.frequency_hz[row % stored.frequency_hz.size()];
    rows[row].key = {hertz, look.theta_deg, look.phi_deg, look.rx_theta_deg, look.rx_phi_deg, look.time_s};
    rows[row].s = {stored.s[row].vv(), stored.s[row].vh(), stored.s[row].hv(), stored.s[row].hh()};
    for (std::size_t c = 0; c < 4; ++c) rows[row].sigma_dbsm[c] = sigma_dbsm(rows[row].s[c]);
  }
  return rows;
}

[[noreturn]] void refuse_radar_explorer(const std::filesystem::path& file) {
  throw InputError(
      fmt::format("{}: is no table; what the Radar Explorer Toolkit opens is compared in Python, with raytube.compare, or "
                  "made a table there: raytube.read_radar_explorer(\"NAME.json\").save(\"NAME.nc\")",
                  file.string()));
}

}  // namespace

bool is_radar_explorer_name(const std::filesystem::path& file) {
  const std::string ending = lower_case(file.extension().string());
  return ending == ".json" || ending == ".h5";
}

ResultTable read_result_table(const std::filesystem::path& file, const ColumnMap& map, const std::string& option) {
  if (is_netcdf_name(file)) {
    if (!map.empty())
      throw InputError(fmt::format("{}: {} has variables, no columns; leave the option out", option, file.string()));
    return table_of(read_netcdf(file), file);
  }
  if (is_radar_explorer_name(file)) refuse_radar_explorer(file);
  CsvReader reader(file, "give the path of a readable table, for example out/rcs.csv");
  if (reader.columns().empty())
    throw InputError(fmt::format("{}: holds no table; give a file with a header and rows", file.string()));
  const Layout layout = layout_of(reader, map, option);
  Rows rows(layout);
  while (reader.next()) rows.read(reader);
  ResultTable table;
  table.file = file;
  table.rows = rows.finish(file);
  if (table.rows.empty()) throw InputError(fmt::format("{}: no rows below the header; nothing can be compared", file.string()));
  for (int k = 0; k < ResultTable::keys; ++k) table.has_key[k] = layout.keys[k].column.has_value();
  for (int c = 0; c < 4; ++c) {
    table.has_channel[c] = layout.channels.channels[c].any() && rows.transmitted(c % 2);
    table.has_level[c] = layout.channels.channels[c].has_level() && rows.transmitted(c % 2);
    table.has_phase[c] = layout.channels.channels[c].has_phase() && rows.transmitted(c % 2);
  }
  return table;
}

ResultTable table_of(const StoredResult& stored, const std::filesystem::path& name) {
  ResultTable table;
  table.file = name;
  table.has_key.fill(true);
  table.has_key[ResultTable::time] = stored.moving;
  table.rows = rows_of(stored);
  for (std::size_t c = 0; c < 4; ++c)
    table.has_channel[c] = table.has_phase[c] =
        std::ranges::any_of(table.rows, [c](const auto& row) { return finite(row.s[c]); });
  require_numbers(table);
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
