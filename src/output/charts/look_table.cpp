#include "output/charts/look_table.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "output/plots/curves.h"
#include "output/tables/key_coordinates.h"

namespace raytube {

namespace {

std::string phase_text(const ResultTable& table, std::size_t c) {
  const Complex s = table.rows.front().s[c];
  return table.has_phase[c] && s != Complex(0.0) ? fmt::format("{:.2f}", std::arg(s) / degree) : "-";
}

std::string error_text(const ChannelErrors& errors, std::size_t c) { return fmt::format("{:.2g}", errors[c / 2][c % 2]); }

}  // namespace

std::string look_table(const ResultTable& table, const std::optional<StoredResult>& stored,
                       const std::vector<std::size_t>& asked) {
  const ResultTable::Row& row = table.rows.front();
  std::string text = coordinates_text(coordinates_of_keys({&row.key, 1}, table.has_key), 0) + '\n';
  text += fmt::format("  {:<9}{:>12}{:>14}", "channel", "sigma, dBsm", "phase of S, °");
  if (stored) text += fmt::format("{:>20}{:>24}", "numerical error, dB", "model uncertainty, dB");
  text += '\n';
  const std::vector<std::size_t> all = {0, 1, 2, 3};
  for (const std::size_t c : asked.empty() ? all : asked) {
    if (!table.has_channel[c]) continue;
    text += fmt::format("  {:<9}{:>12.2f}{:>14}", channel_titles[c], row.sigma_dbsm[c], phase_text(table, c));
    if (stored)
      text += fmt::format("{:>20}{:>24}", error_text(stored->err_db.front(), c), error_text(stored->model_db.front(), c));
    text += '\n';
  }
  return text;
}

}  // namespace raytube
