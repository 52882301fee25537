#include "output/tables/result_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "core/csv_reader.h"
#include "core/decimal.h"
#include "core/error.h"
#include "core/text.h"
#include "output/netcdf/netcdf_file.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

using Column = std::optional<std::size_t>;

// A column, and what makes its cells ours.
struct Source {
  Column column;
  double factor = 1.0, offset = 0.0;

  explicit operator bool() const { return column.has_value(); }
};

// Columns of one channel: real and imaginary part, or a level and perhaps a phase.
struct ChannelSource {
  Source re, im, magnitude, power, level, phase;

  bool any() const { return re || magnitude || power || level; }
  bool has_level() const { return level && !re && !magnitude && !power; }
  bool has_phase() const { return re || (any() && phase); }
};

// Which column holds what. With a column `transmit` a row holds the channels of one transmit polarisation.
struct Layout {
  std::array<Source, ResultTable::keys> keys;
  std::array<ChannelSource, 4> channels;
  Column transmit;
};

// Names as a sentence can list them.
std::string first_of(const std::vector<std::string>& names) {
  constexpr std::size_t most = 12;
  std::vector<std::string> listed;
  for (std::size_t i = 0; i < std::min(most, names.size()); ++i) listed.push_back(quotable(names[i]));
  if (names.size() > most) listed.push_back("...");
  return joined(listed, ", ");
}

// What stands in brackets at the end of a column's name: "deg" of "theta [deg]".
std::string_view unit_of(std::string_view name) {
  if (!name.ends_with(']') && !name.ends_with(')')) return {};
  const std::size_t open = name.find_last_of("[(");
  return open == std::string_view::npos ? std::string_view() : name.substr(open + 1, name.size() - open - 2);
}

bool is_square_metres(std::string_view unit) {
  constexpr std::array<std::string_view, 6> names = {"m2", "m^2", "m**2", "m*m", "m\xC2\xB2", "sqm"};
  return std::ranges::find(names, unit) != names.end();
}

// What makes numbers of this unit those of our column.
double unit_factor(std::string_view ours, std::string_view unit) {
  struct Known {
    std::string_view ending, unit;
    double factor;
  };
  constexpr std::array<Known, 8> all = {{{"freq_hz", "khz", 1e3},
                                         {"freq_hz", "mhz", 1e6},
                                         {"freq_hz", "ghz", 1e9},
                                         {"freq_ghz", "hz", 1e-9},
                                         {"freq_ghz", "khz", 1e-6},
                                         {"freq_ghz", "mhz", 1e-3},
                                         {"_deg", "rad", 180.0 / pi},
                                         {"_rad", "deg", pi / 180.0}}};
  for (const Known& known : all)
    if (ours.ends_with(known.ending) && unit == known.unit) return known.factor;
  return 1.0;
}

// Columns by name, in small or capital letters.
class Header {
 public:
  Header(const CsvReader& reader, const ColumnMap& map, const std::string& option)
      : location_(reader.location()), names_(reader.columns()), map_(map), option_(option) {
    for (std::string& name : names_)
      std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    for (const ColumnChoice& choice : map)
      if (!column(choice.theirs))
        reject(fmt::format("no column is named {}; choose among {} in {}", quotable(choice.theirs), first_of(names_), option_));
    for (const ColumnChoice& choice : map) check_unit_of_sigma(choice);
  }

  Source find(const std::string& name) const {
    const auto chosen = std::ranges::find(map_, name, &ColumnChoice::ours);
    if (chosen == map_.end()) return {column(name)};
    const bool in_theirs = chosen->factor == 1.0 && chosen->offset == 0.0;
    return {column(chosen->theirs), in_theirs ? unit_factor(name, unit_of(chosen->theirs)) : chosen->factor, chosen->offset};
  }

  /// What to do about a missing column that has another name.
  std::string remedy(const std::string& ours) const {
    return fmt::format("or say which of {} it is, as in {} {}=NAME", first_of(names_), option_, ours);
  }

  [[noreturn]] void reject(const std::string& sentence) const { throw InputError(location_ + ": " + sentence); }

 private:
  // Decibels and square metres have names of their own.
  void check_unit_of_sigma(const ColumnChoice& choice) const {
    const bool dbsm = choice.ours.ends_with("_dbsm"), m2 = choice.ours.ends_with("_m2");
    const std::string_view unit = unit_of(choice.theirs);
    if ((!dbsm || !is_square_metres(unit)) && (!m2 || !unit.starts_with("db"))) return;
    reject(fmt::format("{0} is in {1}, not in {2}; write {3} '{4}=\"{0}\"'", quotable(choice.theirs), quotable(unit),
                       dbsm ? "dBsm" : "m^2", option_, choice.ours.substr(0, choice.ours.rfind('_')) + (dbsm ? "_m2" : "_dbsm")));
  }

  Column column(const std::string& name) const {
    const auto found = std::ranges::find(names_, name);
    if (found == names_.end()) return std::nullopt;
    if (std::find(found + 1, names_.end(), name) != names_.end())
      throw InputError(fmt::format("{}: two columns are named {}; rename or remove one", location_, quotable(name)));
    return found - names_.begin();
  }

  std::string location_;
  std::vector<std::string> names_;
  const ColumnMap& map_;
  const std::string& option_;
};

Source frequency_source(const Header& header) {
  if (const Source hertz = header.find("freq_hz")) return hertz;
  Source source = header.find("freq_ghz");
  source.factor *= 1e9, source.offset *= 1e9;
  return source;
}

void find_keys(const Header& header, Layout& layout) {
  const Source theta = header.find("theta_deg"), phi = header.find("phi_deg");
  const Source theta_i = header.find("theta_i_deg"), phi_i = header.find("phi_i_deg");
  const bool receiver_first = theta_i || phi_i;
  const Source rx_theta = header.find("rx_theta_deg"), rx_phi = header.find("rx_phi_deg");
  layout.keys = {frequency_source(header), receiver_first ? theta_i : theta, receiver_first ? phi_i : phi,
                 rx_theta ? rx_theta : theta, rx_phi ? rx_phi : phi};
  if (std::ranges::none_of(layout.keys, [](const Source& source) { return source.column.has_value(); }))
    header.reject(
        "no column to match rows by; name at least one of freq_hz, freq_ghz, theta_deg, phi_deg, rx_theta_deg, rx_phi_deg, " +
        header.remedy("phi_deg"));
}

ChannelSource channel_source(const Header& header, const std::string& pq) {
  const ChannelSource source{header.find("re_" + pq),
                             header.find("im_" + pq),
                             header.find("magnitude_" + pq),
                             header.find("sigma_" + pq + "_m2"),
                             header.find("sigma_" + pq + "_dbsm"),
                             header.find("phase_" + pq + "_rad")};
  if (source.re.column.has_value() != source.im.column.has_value())
    header.reject(fmt::format("re_{0} and im_{0} go together; add the missing one or remove the other", pq));
  return source;
}

// As in channels.csv: a row for each transmit polarisation, received in V and H.
void find_received(const Header& header, Layout& layout) {
  for (std::size_t c = 0; c < 4; ++c) {
    const std::string receive = c < 2 ? "v" : "h";
    layout.channels[c].magnitude = header.find(receive + "_magnitude");
    layout.channels[c].phase = header.find(receive + "_phase_rad");
  }
}

void find_channels(const Header& header, Layout& layout) {
  layout.transmit = header.find("tx_pol").column;
  for (std::size_t c = 0; c < 4 && !layout.transmit; ++c) layout.channels[c] = channel_source(header, channel_names[c]);
  if (layout.transmit) find_received(header, layout);
  if (std::ranges::any_of(layout.channels, &ChannelSource::any)) return;
  header.reject(layout.transmit ? "no channel beside tx_pol; name v_magnitude or h_magnitude, and v_phase_rad or h_phase_rad"
                                : "no channel; name at least re_vv and im_vv, or sigma_vv_dbsm (vh, hv, hh alike), " +
                                      header.remedy("sigma_vv_dbsm"));
}

Layout layout_of(const CsvReader& reader, const ColumnMap& map, const std::string& option) {
  const bool numbers =
      std::ranges::all_of(reader.columns(), [](const std::string& cell) { return parsed_number(cell).has_value(); });
  if (numbers)
    Header(reader, {}, option)
        .reject("no header; put a line with the names of the columns first, for example freq_hz,theta_deg,phi_deg,sigma_vv_dbsm");
  const Header header(reader, map, option);
  Layout layout;
  find_keys(header, layout);
  find_channels(header, layout);
  return layout;
}

double value_of(const CsvReader& reader, const Source& source, const std::string& remedy) {
  return source.factor * reader.finite_number(*source.column, remedy) + source.offset;
}

constexpr double highest_level = 500.0;  // [dBsm]: about what a plate of the Sun's width returns in visible light

double sigma_cell(const CsvReader& reader, const Source& source) {
  constexpr double zero = -std::numeric_limits<double>::infinity();
  if (parsed_number(reader.cell(*source.column)) == zero) return zero;
  const double level = value_of(reader, source, "write decibels as a number, and -inf for zero");
  if (level > highest_level)
    throw InputError(
        fmt::format("{}: {:g} dBsm is no radar cross-section; write 10 log10 of square metres, or give those as sigma_vv_m2",
                    reader.location(), level));
  return level;
}

double power_cell(const CsvReader& reader, const Source& source) {
  const double power = value_of(reader, source, "write sigma in square metres");
  if (power < 0.0)
    throw InputError(fmt::format("{}: sigma in square metres must be 0 or more; if it is in dBsm give it as sigma_vv_dbsm",
                                 reader.location()));
  return power;
}

// |S|, of sqrt(sigma), of sigma or of a level.
double amplitude(const CsvReader& reader, const ChannelSource& source) {
  if (source.has_level()) return std::pow(10.0, sigma_cell(reader, source.level) / 20.0) / std::sqrt(4.0 * pi);
  if (!source.magnitude) return std::sqrt(power_cell(reader, source.power) / (4.0 * pi));
  const double magnitude = value_of(reader, source.magnitude, "write the root of sigma in metres");
  if (magnitude < 0.0) throw InputError(fmt::format("{}: a magnitude must be 0 or more", reader.location()));
  return magnitude / std::sqrt(4.0 * pi);
}

void read_channel(const CsvReader& reader, const ChannelSource& source, int channel, ResultTable::Row& row) {
  if (source.re)
    row.s[channel] = {value_of(reader, source.re, "write an amplitude in metres"),
                      value_of(reader, source.im, "write an amplitude in metres")};
  else if (source.any())
    row.s[channel] =
        std::polar(amplitude(reader, source), source.phase ? value_of(reader, source.phase, "write a phase in radians") : 0.0);
  else
    return;
  row.sigma_dbsm[channel] = source.has_level() ? sigma_cell(reader, source.level) : sigma_dbsm(row.s[channel]);
}

// 0 for V, 1 for H.
int transmit_of(const CsvReader& reader, std::size_t column) {
  const std::string& text = reader.cell(column);
  if (text == "v" || text == "V") return 0;
  if (text == "h" || text == "H") return 1;
  throw InputError(fmt::format("{}: the transmit polarisation is \"{}\"; write v or h", reader.location(), quotable(text)));
}

ResultTable::Keys read_keys(const CsvReader& reader, const Layout& layout) {
  ResultTable::Keys key{};
  for (int k = 0; k < ResultTable::keys; ++k)
    if (layout.keys[k]) key[k] = value_of(reader, layout.keys[k], "write an angle in degrees or a frequency");
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
    const int transmit = layout_.transmit ? transmit_of(reader, *layout_.transmit) : 0;
    ResultTable::Row& row = layout_.transmit ? shared_row(key, transmit) : rows_.emplace_back();
    row.key = key;
    for (int channel = 0; channel < 4; ++channel)
      if (!layout_.transmit || channel % 2 == transmit) read_channel(reader, layout_.channels[channel], channel, row);
  }

  bool transmitted(int polarisation) const { return !layout_.transmit || count_[polarisation] > 0; }

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
    rows[row].key = {hertz, look.theta_deg, look.phi_deg, look.rx_theta_deg, look.rx_phi_deg};
    rows[row].s = {stored.s[row].vv(), stored.s[row].vh(), stored.s[row].hv(), stored.s[row].hh()};
    for (std::size_t c = 0; c < 4; ++c) rows[row].sigma_dbsm[c] = sigma_dbsm(rows[row].s[c]);
  }
  return rows;
}

// Files of the Radar Explorer Toolkit are read where pandas is, which writes their tables.
void refuse_radar_explorer(const std::filesystem::path& file) {
  const std::string ending = lower_case(file.extension().string());
  if (ending == ".json" || ending == ".h5")
    throw InputError(
        fmt::format("{}: is no table; what the Radar Explorer Toolkit opens is compared in Python, with raytube.compare, or "
                    "made a table there: raytube.read_radar_explorer(\"NAME.json\").save(\"NAME.nc\")",
                    file.string()));
}

}  // namespace

ResultTable read_result_table(const std::filesystem::path& file, const ColumnMap& map, const std::string& option) {
  if (is_netcdf_name(file)) {
    if (!map.empty())
      throw InputError(fmt::format("{}: {} has variables, no columns; leave the option out", option, file.string()));
    return table_of(read_netcdf(file), file);
  }
  refuse_radar_explorer(file);
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
    table.has_channel[c] = layout.channels[c].any() && rows.transmitted(c % 2);
    table.has_level[c] = layout.channels[c].has_level() && rows.transmitted(c % 2);
    table.has_phase[c] = layout.channels[c].has_phase() && rows.transmitted(c % 2);
  }
  return table;
}

ResultTable table_of(const StoredResult& stored, const std::filesystem::path& name) {
  ResultTable table;
  table.file = name;
  table.has_key.fill(true);
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
