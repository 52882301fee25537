#include "output/tables/table_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/text.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

// Names as a sentence can list them.
std::string first_of(const std::vector<std::string>& names) {
  constexpr std::size_t most = 12;
  std::vector<std::string> listed;
  for (std::size_t i = 0; i < std::min(most, names.size()); ++i) listed.push_back(quotable(names[i]));
  if (names.size() > most) listed.push_back("...");
  return joined(listed, ", ");
}

// What stands in brackets at the end of a column's name, or behind its last underscore: "deg" of "theta [deg]" and "theta_deg".
std::string_view unit_of(std::string_view name) {
  const bool brackets = name.ends_with(']') || name.ends_with(')');
  const std::size_t begin = name.find_last_of(brackets ? "[(" : "_");
  return begin == std::string_view::npos ? std::string_view() : name.substr(begin + 1, name.size() - begin - 1 - brackets);
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

ChannelSource channel_source(const TableHeader& header, const std::string& pq) {
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
ChannelSource received_source(const TableHeader& header, const std::string& receive) {
  ChannelSource source;
  source.magnitude = header.find(receive + "_magnitude");
  source.phase = header.find(receive + "_phase_rad");
  return source;
}

constexpr double highest_level = 500.0;  // [dBsm]: about what a plate of the Sun's width returns in visible light

double sigma_cell(const CsvReader& row, const ColumnSource& source) {
  if (parsed_number(row.cell(*source.column)) == -std::numeric_limits<double>::infinity())
    return -std::numeric_limits<double>::infinity();
  const double level = value_of(row, source, "write decibels as a number, and -inf for zero");
  if (level > highest_level)
    throw InputError(
        fmt::format("{}: {:g} dBsm is no radar cross-section; write 10 log10 of square metres, or give those as sigma_vv_m2",
                    row.location(), level));
  return level;
}

double power_cell(const CsvReader& row, const ColumnSource& source) {
  const double power = value_of(row, source, "write sigma in square metres");
  if (power < 0.0)
    throw InputError(
        fmt::format("{}: sigma in square metres must be 0 or more; if it is in dBsm give it as sigma_vv_dbsm", row.location()));
  return power;
}

// |S|, of sqrt(sigma), of sigma or of a level.
double amplitude(const CsvReader& row, const ChannelSource& source) {
  if (source.has_level()) return std::pow(10.0, sigma_cell(row, source.level) / 20.0) / std::sqrt(4.0 * pi);
  if (!source.magnitude) return std::sqrt(power_cell(row, source.power) / (4.0 * pi));
  const double magnitude = value_of(row, source.magnitude, "write the root of sigma in metres");
  if (magnitude < 0.0) throw InputError(fmt::format("{}: a magnitude must be 0 or more", row.location()));
  return magnitude / std::sqrt(4.0 * pi);
}

Complex amplitude_with_phase(const CsvReader& row, const ChannelSource& source) {
  if (!source.re)
    return std::polar(amplitude(row, source), source.phase ? value_of(row, source.phase, "write a phase in radians") : 0.0);
  const double real = value_of(row, source.re, "write an amplitude in metres");
  return {real, value_of(row, source.im, "write an amplitude in metres")};
}

}  // namespace

TableHeader::TableHeader(std::string location, std::vector<std::string> names, ColumnMap map, std::string option)
    : location_(std::move(location)), names_(std::move(names)), map_(std::move(map)), option_(std::move(option)) {
  for (std::string& name : names_)
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::erase_if(map_, [&](const ColumnChoice& choice) { return choice.if_there && !column(choice.theirs); });
  for (const ColumnChoice& choice : map_)
    if (!column(choice.theirs))
      reject(fmt::format("no column is named {}; choose among {} in {}", quotable(choice.theirs), first_of(names_), option_));
  for (const ColumnChoice& choice : map_) check_unit_of_sigma(choice);
}

ColumnSource TableHeader::find(const std::string& ours) const {
  const auto chosen = std::ranges::find(map_, ours, &ColumnChoice::ours);
  if (chosen == map_.end()) return {column(ours)};
  const bool in_theirs = chosen->factor == 1.0 && chosen->offset == 0.0;
  return {column(chosen->theirs), in_theirs ? unit_factor(ours, unit_of(chosen->theirs)) : chosen->factor, chosen->offset};
}

std::string TableHeader::remedy(const std::string& ours) const {
  return fmt::format("or say which of {} it is, as in {} {}=NAME", first_of(names_), option_, ours);
}

void TableHeader::reject(const std::string& sentence) const { throw InputError(location_ + ": " + sentence); }

// Decibels and square metres have names of their own.
void TableHeader::check_unit_of_sigma(const ColumnChoice& choice) const {
  const bool dbsm = choice.ours.ends_with("_dbsm"), m2 = choice.ours.ends_with("_m2");
  const std::string_view unit = unit_of(choice.theirs);
  if ((!dbsm || !is_square_metres(unit)) && (!m2 || !unit.starts_with("db"))) return;
  reject(fmt::format("{0} is in {1}, not in {2}; write {3} '{4}=\"{0}\"'", quotable(choice.theirs), quotable(unit),
                     dbsm ? "dBsm" : "m^2", option_, choice.ours.substr(0, choice.ours.rfind('_')) + (dbsm ? "_m2" : "_dbsm")));
}

std::optional<std::size_t> TableHeader::column(const std::string& name) const {
  const auto found = std::ranges::find(names_, name);
  if (found == names_.end()) return std::nullopt;
  if (std::find(found + 1, names_.end(), name) != names_.end())
    throw InputError(fmt::format("{}: two columns are named {}; rename or remove one", location_, quotable(name)));
  return found - names_.begin();
}

ChannelColumns find_channels(const TableHeader& header) {
  ChannelColumns found;
  found.transmit = header.find("tx_pol").column;
  for (std::size_t c = 0; c < 4; ++c)
    found.channels[c] = found.transmit ? received_source(header, c < 2 ? "v" : "h") : channel_source(header, channel_names[c]);
  if (std::ranges::any_of(found.channels, &ChannelSource::any)) return found;
  header.reject(found.transmit ? "no channel beside tx_pol; name v_magnitude or h_magnitude, and v_phase_rad or h_phase_rad"
                               : "no channel; name at least re_vv and im_vv, or sigma_vv_dbsm (vh, hv, hh alike), " +
                                     header.remedy("sigma_vv_dbsm"));
}

double value_of(const CsvReader& row, const ColumnSource& source, const std::string& remedy) {
  return source.factor * row.finite_number(*source.column, remedy) + source.offset;
}

ChannelValue channel_value(const CsvReader& row, const ChannelSource& source) {
  const Complex s = amplitude_with_phase(row, source);
  return {s, source.has_level() ? sigma_cell(row, source.level) : sigma_dbsm(s)};
}

int transmit_of(const CsvReader& reader, std::size_t column) {
  const std::string& text = reader.cell(column);
  if (text == "v" || text == "V") return 0;
  if (text == "h" || text == "H") return 1;
  throw InputError(fmt::format("{}: the transmit polarisation is \"{}\"; write v or h", reader.location(), quotable(text)));
}

}  // namespace raytube
