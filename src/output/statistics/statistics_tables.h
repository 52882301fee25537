// Statistics of a result in words, as tables and as a picture.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "output/statistics/histogram.h"
#include "output/statistics/sigma_statistics.h"

namespace raytube {

struct ChannelStatistics {
  std::size_t channel;
  SigmaSummary all;
  std::vector<LawFit> laws;  // empty: too few rows, or all alike
  Histogram histogram;
};

struct SigmaStatistics {
  ChartResult result;
  std::vector<double> percentiles;
  std::optional<double> window_deg;
  std::vector<ChannelStatistics> channels;  // those with a signal
};

/// Throws InputError if windows are asked for that the sweep does not hold.
SigmaStatistics sigma_statistics(const ResultTable& table, std::vector<double> percentiles, std::optional<double> window_deg);

std::string statistics_text(const SigmaStatistics& statistics);

/// All rows of the result together, then each window, a line for each channel.
void write_statistics_csv(const std::filesystem::path& file, const SigmaStatistics& statistics);

/// Parameters and distances of the laws.
void write_fits_csv(const std::filesystem::path& file, const SigmaStatistics& statistics);

void write_histogram_csv(const std::filesystem::path& file, const SigmaStatistics& statistics);

}  // namespace raytube
