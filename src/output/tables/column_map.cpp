#include "output/tables/column_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/text.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

std::vector<std::string> known_columns() {
  std::vector<std::string> names{
      "freq_hz",   "freq_ghz", "theta_deg",   "phi_deg",     "rx_theta_deg", "rx_phi_deg",    "theta_i_deg",
      "phi_i_deg", "tx_pol",   "v_magnitude", "v_phase_rad", "h_magnitude",  "h_phase_rad",   "row",
      "col",       "x",        "y",           "u_m",         "v_m",          "cross_range_m", "range_m"};
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
    throw InputError(
        fmt::format("{} {}: write OURS=THEIRS, with *FACTOR and +OFFSET where units differ, for example freq_hz=f*1e9", option,
                    quotable(text)));
  if (const std::vector<std::string> known = known_columns(); std::ranges::find(known, choice.ours) == known.end())
    throw InputError(fmt::format("{} {}: {} is no column of a result; write one of {}", option, quotable(text),
                                 quotable(choice.ours), joined(known, ", ")));
  if (!is_a_number(choice.ours) && (choice.factor != 1.0 || choice.offset != 0.0))
    throw InputError(fmt::format("{} {}: {} takes no factor and no offset; leave them out", option, text, choice.ours));
  return choice;
}

// The next comma that is not between double quotes.
std::size_t end_of_choice(const std::string& text, std::size_t at) {
  for (bool quoted = false; at < text.size() && (quoted || text[at] != ','); ++at)
    if (text[at] == '"') quoted = !quoted;
  return at;
}

}  // namespace

ColumnMap parsed_column_map(const std::string& option, const std::string& text) {
  ColumnMap map;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = end_of_choice(text, at);
    map.push_back(parsed_choice(option, text.substr(at, end - at)));
    at = end + 1;
  }
  for (std::size_t i = 0; i < map.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (map[i].ours == map[j].ours) throw InputError(fmt::format("{}: {} is given twice; leave one out", option, map[i].ours));
  return map;
}

}  // namespace raytube
