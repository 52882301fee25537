#include "output/statistics/statistics_tables.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <utility>

#include "core/decimal.h"
#include "output/files/files.h"
#include "output/plots/curves.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

using Quantity = RowCoordinates::Quantity;

constexpr std::array<Quantity, 5> key_order = {RowCoordinates::frequency, RowCoordinates::theta, RowCoordinates::phi,
                                               RowCoordinates::rx_theta, RowCoordinates::rx_phi};

ChannelStatistics channel_statistics(const ChartResult& result, std::size_t channel, const std::vector<double>& percentiles) {
  const std::vector<double>& levels = result.sigma_dbsm[channel];
  return {channel, sigma_summary(levels, percentiles), fitted_laws(levels), histogram_of(levels)};
}

std::string cell_of(double value) { return std::isnan(value) ? "-" : fmt::format("{:.4g}", value); }

std::string text_line(const SigmaStatistics& s, const std::string& name,
                      const std::function<std::string(const ChannelStatistics&)>& cell) {
  std::string text = fmt::format("  {:<36}", name);
  for (const ChannelStatistics& channel : s.channels) text += fmt::format("{:>12}", cell(channel));
  return text + '\n';
}

std::string summary_lines(const SigmaStatistics& s) {
  std::string text = text_line(s, "rows", [](const auto& c) { return fmt::format("{}", c.all.rows); });
  text += text_line(s, "mean of sigma, m2", [](const auto& c) { return cell_of(c.all.mean_m2); });
  text += text_line(s, "mean of sigma, dBsm", [](const auto& c) { return fmt::format("{:.2f}", c.all.mean_dbsm()); });
  text += text_line(s, "median, dBsm", [](const auto& c) { return fmt::format("{:.2f}", c.all.median_dbsm); });
  for (std::size_t i = 0; i < s.percentiles.size(); ++i)
    text += text_line(s, fmt::format("{} % lie below, dBsm", number_text(s.percentiles[i])),
                      [i](const auto& c) { return fmt::format("{:.2f}", c.all.percentiles_dbsm[i]); });
  return text + text_line(s, "standard deviation, dB", [](const auto& c) { return cell_of(c.all.deviation_db); });
}

std::string law_lines(const SigmaStatistics& s) {
  std::string text = "largest difference of shares (Kolmogorov-Smirnov)\n";
  for (std::size_t i = 0; i < law_titles.size(); ++i)
    text += text_line(s, law_titles[i],
                      [i](const auto& c) { return c.laws.empty() ? "-" : fmt::format("{:.3f}", c.laws[i].distance); });
  text += text_line(s, "nearest", [](const auto& c) {
    return c.laws.empty() ? std::string("-") : law_titles[static_cast<std::size_t>(nearest_law(c.laws).law)];
  });
  return text + text_line(s, "degrees of freedom of chi-square", [](const auto& c) {
           return c.laws.empty() ? "-" : cell_of(2.0 * c.laws[static_cast<std::size_t>(Law::chi_square)].shape);
         });
}

std::string summary_cells(std::size_t channel, const SigmaSummary& summary) {
  std::string text = fmt::format("{},{},{},{},{}", channel_names[channel], summary.rows, number_text(summary.mean_m2),
                                 number_text(summary.mean_dbsm()), number_text(summary.median_dbsm));
  for (const double level : summary.percentiles_dbsm) text += ',' + number_text(level);
  return text + ',' + number_text(summary.deviation_db) + '\n';
}

// What is held fixed in a cut; what is swept, or not told, has an empty cell.
std::string fixed_cells(const ChartResult& result, std::size_t row) {
  std::string text;
  for (const Quantity quantity : key_order) {
    const double value = result.coordinates.rows[row][quantity];
    if (quantity != result.plan.quantity && result.coordinates.told[quantity])
      text += number_text(quantity == RowCoordinates::frequency ? rounded_to_15_digits(value * 1e9) : value);
    text += ',';
  }
  return text;
}

void write_windows(OutputFile& file, const SigmaStatistics& s) {
  for (const CutRows& cut : s.result.plan.cuts)
    for (const WindowRows& window : sliding_windows(cut, s.result.plan.quantity, *s.window_deg))
      for (const ChannelStatistics& c : s.channels) {
        const SigmaSummary summary = sigma_summary(levels_of_rows(s.result, c.channel, window.rows), s.percentiles);
        file.write(fixed_cells(s.result, cut.rows.front()) + number_text(window.from) + ',' + number_text(window.to) + ',' +
                   summary_cells(c.channel, summary));
      }
}

}  // namespace

SigmaStatistics sigma_statistics(const ResultTable& table, std::vector<double> percentiles, std::optional<double> window_deg) {
  std::vector<ChartResult> results = chart_results({table});
  if (window_deg) require_windows(results.front(), *window_deg);
  const std::vector<std::size_t> channels = chosen_channels(results, {});
  SigmaStatistics statistics{std::move(results.front()), std::move(percentiles), window_deg, {}};
  for (const std::size_t c : channels)
    statistics.channels.push_back(channel_statistics(statistics.result, c, statistics.percentiles));
  return statistics;
}

std::string statistics_text(const SigmaStatistics& s) {
  return fmt::format("{}\n", s.result.file.string()) +
         text_line(s, "", [](const auto& c) { return std::string(channel_titles[c.channel]); }) + summary_lines(s) + law_lines(s);
}

void write_statistics_csv(const std::filesystem::path& path, const SigmaStatistics& s) {
  OutputFile file(path);
  file.write("# sigma of the rows of " + s.result.file.filename().string() +
             ", each of which counts once; mean of sigma in m2, not of dB;\n");
  file.write("# percentiles by linear interpolation in dB; std_db of the decibels. The first rows are of the whole result.\n");
  file.write(std::string(key_columns) + ",from_deg,to_deg,channel,rows,mean_m2,mean_dbsm,median_dbsm");
  for (const double percent : s.percentiles) file.write(",p" + number_text(percent) + "_dbsm");
  file.write(",std_db\n");
  for (const ChannelStatistics& c : s.channels) file.write(",,,,,,," + summary_cells(c.channel, c.all));
  if (s.window_deg) write_windows(file, s);
  file.commit();
}

void write_fits_csv(const std::filesystem::path& path, const SigmaStatistics& s) {
  OutputFile file(path);
  file.write(
      "# Laws of sigma with their likeliest parameters; degrees of freedom are 2 k; ks_distance: the largest difference\n");
  file.write(
      "# between the shares of rows and of the law below any level (Kolmogorov-Smirnov). Rows with zero sigma are left out.\n");
  file.write("channel,law,mean_m2,degrees_of_freedom,mean_of_db,std_of_db,ks_distance\n");
  for (const ChannelStatistics& c : s.channels)
    for (const LawFit& law : c.laws)
      file.write(fmt::format("{},{},{},{},{},{},{}\n", channel_names[c.channel], law_names[static_cast<std::size_t>(law.law)],
                             number_text(law.mean_m2), number_text(2.0 * law.shape), number_text(law.middle_db),
                             number_text(law.spread_db), number_text(law.distance)));
  file.commit();
}

void write_histogram_csv(const std::filesystem::path& path, const SigmaStatistics& s) {
  OutputFile file(path);
  file.write("# Rows with sigma in from_dbsm ... to_dbsm; their share, and that which the laws of fits.csv expect\n");
  file.write("channel,from_dbsm,to_dbsm,rows,share");
  for (const char* law : law_names) file.write(fmt::format(",{}", law));
  file.write("\n");
  for (const ChannelStatistics& c : s.channels)
    for (const HistogramBin& bin : c.histogram.bins) {
      const double share = static_cast<double>(bin.rows) / static_cast<double>(c.histogram.rows);
      file.write(fmt::format("{},{},{},{},{}", channel_names[c.channel], number_text(bin.from_dbsm), number_text(bin.to_dbsm),
                             bin.rows, number_text(share)));
      for (std::size_t i = 0; i < law_names.size(); ++i)
        file.write(',' + (c.laws.empty() ? std::string("nan") : number_text(expected_share(c.laws[i], bin))));
      file.write("\n");
    }
  file.commit();
}

}  // namespace raytube
