#include "output/tables/column_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/text.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

std::string in_small_letters(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::vector<std::string> known_columns() {
  std::vector<std::string> names{"freq_hz",     "freq_ghz",    "theta_deg",  "phi_deg", "rx_theta_deg",
                                 "rx_phi_deg",  "theta_i_deg", "phi_i_deg",  "tx_pol",  "v_magnitude",
                                 "v_phase_rad", "h_magnitude", "h_phase_rad"};
  for (const char* pq : channel_names)
    for (const char* form : {"re_{}", "im_{}", "sigma_{}_dbsm", "magnitude_{}", "phase_{}_rad"})
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

// "theirs", "theirs*2", "theirs+90" or "theirs*-1+90".
bool read_source(const std::string& text, ColumnChoice& choice) {
  std::size_t at = std::min(text.find_first_of("*+"), text.size());
  choice.theirs = in_small_letters(text.substr(0, at));
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
  ColumnChoice choice{in_small_letters(text.substr(0, equals)), {}};
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

}  // namespace

ColumnMap parsed_column_map(const std::string& option, const std::string& text) {
  ColumnMap map;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    map.push_back(parsed_choice(option, text.substr(at, end - at)));
    at = end + 1;
  }
  for (std::size_t i = 0; i < map.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (map[i].ours == map[j].ours) throw InputError(fmt::format("{}: {} is given twice; leave one out", option, map[i].ours));
  return map;
}

}  // namespace raytube
