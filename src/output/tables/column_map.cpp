#include "output/tables/column_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>

#include "core/error.h"
#include "core/text.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

std::vector<std::string> known_columns() {
  std::vector<std::string> names{
      "freq_hz", "freq_ghz",    "theta_deg",   "phi_deg",       "rx_theta_deg", "rx_phi_deg", "theta_i_deg", "phi_i_deg",
      "tx_pol",  "v_magnitude", "v_phase_rad", "h_magnitude",   "h_phase_rad",  "row",        "col",         "x",
      "y",       "u_m",         "v_m",         "cross_range_m", "range_m",      "time_s"};
  for (const char* pq : channel_names)
    for (const char* form : {"re_{}", "im_{}", "sigma_{}_dbsm", "sigma_{}_m2", "magnitude_{}", "phase_{}_rad"})
      names.push_back(fmt::format(fmt::runtime(form), pq));
  return names;
}

// A number at `at`, which moves behind it.
std::optional<double> number_at(const std::string& text, std::size_t& at) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  at = static_cast<std::size_t>(end - text.data());
  return value;
}

// "theirs", "theirs*2", "theirs+90" or "theirs*-1+90"; theirs also in double quotes, with whatever signs it holds.
bool read_source(const std::string& text, ColumnChoice& choice) {
  const std::size_t quote = text.starts_with('"') ? 1 : 0;
  const std::size_t end = quote ? text.find('"', 1) : std::min(text.find_first_of("*+"), text.size());
  if (end == std::string::npos) return false;
  choice.theirs = lower_case(text.substr(quote, end - quote));
  std::size_t at = end + quote;
  for (const auto& [sign, value] : {std::pair{'*', &choice.factor}, std::pair{'+', &choice.offset}}) {
    if (at == text.size() || text[at] != sign) continue;
    const std::optional<double> number = number_at(text, ++at);
    if (!number) return false;
    *value = *number;
  }
  return at == text.size() && !choice.theirs.empty() && choice.factor != 0.0;
}

bool is_a_number(const std::string& ours) { return ours != "tx_pol" && !ours.ends_with("_dbsm"); }

ColumnChoice parsed_choice(const std::string& option, const std::string& text) {
  const std::size_t equals = std::min(text.find('='), text.size());
  ColumnChoice choice{lower_case(text.substr(0, equals)), {}};
  if (equals == text.size() || !read_source(text.substr(equals + 1), choice))
    throw InputError(fmt::format(
        "{} {}: write OURS=THEIRS, with *FACTOR and +OFFSET where units differ, for example freq_hz=f*1e9, or a preset: hfss, "
        "feko, matlab or azel",
        option, quotable(text)));
  if (const std::vector<std::string> known = known_columns(); std::ranges::find(known, choice.ours) == known.end())
    throw InputError(fmt::format("{} {}: {} is no column of a result; write one of {}", option, quotable(text),
                                 quotable(choice.ours), joined(known, ", ")));
  if (!is_a_number(choice.ours) && (choice.factor != 1.0 || choice.offset != 0.0))
    throw InputError(fmt::format("{} {}: {} takes no factor and no offset; leave them out", option, text, choice.ours));
  return choice;
}

constexpr const char* azimuth_and_elevation =
    "phi_deg=azimuth_deg,phi_deg=azimuth,phi_deg=az_deg,phi_deg=az,theta_deg=elevation_deg*-1+90,theta_deg=elevation*-1+90,"
    "theta_deg=el_deg*-1+90,theta_deg=el*-1+90";

// HFSS' amplitudes have sigma as their squared magnitude, which makes them sqrt(4 pi) S; a report with and without units names
// columns "X []" and "X". Waves come in with the E field along theta.
constexpr const char* hfss_angles_and_frequency =
    R"(freq_hz="Freq [GHz]",freq_hz="Freq [MHz]",freq_hz="Freq [Hz]",theta_deg="IWaveTheta [deg]",phi_deg="IWavePhi [deg]")";

std::string hfss_channels() {
  std::string text;
  for (const auto& [pq, angle] : {std::pair{"vv", "Theta"}, {"hv", "Phi"}})
    for (const char* units : {" []", ""}) {
      for (const char* part : {"re", "im"})
        text += fmt::format(",{}_{}=\"{}(ComplexMonostaticRCS{}){}\"*{:.17g}", part, pq, part, angle, units, 0.5 / std::sqrt(pi));
      text += fmt::format(",sigma_{}_dbsm=\"dB(MonostaticRCS{}){}\"", pq, angle, units);
    }
  return text;
}

// What a preset stands for; empty: there is none of that name.
std::string preset(std::string_view name) {
  if (name == "azel") return azimuth_and_elevation;
  if (name == "matlab")
    return azimuth_and_elevation + std::string(",freq_hz=frequency,freq_hz=freq,sigma_vv_dbsm=rcs,sigma_vv_dbsm=rcsval");
  if (name == "feko")
    return R"feko(freq_hz=Frequency,theta_deg=Theta,phi_deg=Phi,sigma_vv_m2="RCS(Theta)",sigma_hv_m2="RCS(Phi)")feko";
  if (name == "hfss") return hfss_angles_and_frequency + hfss_channels();
  return {};
}

// The next comma that is not between double quotes.
std::size_t end_of_choice(const std::string& text, std::size_t at) {
  for (bool quoted = false; at < text.size() && (quoted || text[at] != ','); ++at)
    if (text[at] == '"') quoted = !quoted;
  return at;
}

ColumnMap preset_columns(const std::string& option, const std::string& columns) {
  ColumnMap map;
  for (std::size_t at = 0, end = 0; at < columns.size(); at = end + 1) {
    end = end_of_choice(columns, at);
    map.push_back(parsed_choice(option, columns.substr(at, end - at)));
    map.back().if_there = true;
  }
  return map;
}

}  // namespace

ColumnMap parsed_column_map(const std::string& option, const std::string& text) {
  ColumnMap map, preset_map;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = end_of_choice(text, at);
    const std::string choice = text.substr(at, end - at);
    if (const std::string columns = preset(lower_case(choice)); columns.empty())
      map.push_back(parsed_choice(option, choice));
    else
      std::ranges::copy(preset_columns(option, columns), std::back_inserter(preset_map));
    at = end + 1;
  }
  for (std::size_t i = 0; i < map.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (map[i].ours == map[j].ours) throw InputError(fmt::format("{}: {} is given twice; leave one out", option, map[i].ours));
  std::ranges::copy(preset_map, std::back_inserter(map));
  return map;
}

}  // namespace raytube
