#include "output/compare/random_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/decimal.h"
#include "output/files/files.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

constexpr double counted_range_db = 20.0;  // of the highest level: in a null a difference in dB says nothing

constexpr const char* meanings =
    "# mean: of the runs. det: the deterministic solution of the same case. spread: standard deviation of one run,\n"
    "# root of sum |S - mean|^2 / (runs - 1) [m]. error: standard error of the mean, spread / root of runs [m]. bias: mean - det "
    "[m].\n"
    "# spread_db: standard deviation of the runs' levels. bias_db: mean of their levels - deterministic level. nan or inf: a "
    "zero.\n";

constexpr const char* value_columns =
    ",channel,re_mean,im_mean,re_det,im_det,spread_m,error_m,re_bias,im_bias,sigma_mean_dbsm,sigma_det_dbsm,spread_db,bias_db\n";

std::string values_text(const RandomResult& result, std::size_t row, int p, int q) {
  const Complex mean = result.mean.total[row].at(p, q), solution = result.deterministic.total[row].at(p, q),
                bias = mean - solution;
  const ChannelSpread& spread = result.spread[row][p][q];
  std::string text = std::string(",") + channel_names[2 * p + q];
  for (const double value :
       {mean.real(), mean.imag(), solution.real(), solution.imag(), spread.amplitude, result.mean.error[row][p][q], bias.real(),
        bias.imag(), sigma_dbsm(mean), sigma_dbsm(solution), spread.db, spread.bias_db})
    text += ',' + number_text(value);
  return text + '\n';
}

// The levels of channels in which something is there to be measured.
struct Levels {
  double square = 0.0, bias = 0.0, count = 0.0;
};

Levels strong_levels(const RandomResult& result) {
  double highest = 0.0;
  for (const ScatteringMatrix& s : result.deterministic.total) highest = std::max(highest, largest_amplitude(s));
  Levels levels;
  for (std::size_t row = 0; row < result.spread.size(); ++row)
    for (const int channel : {0, 1, 2, 3}) {
      const ChannelSpread& spread = result.spread[row][channel / 2][channel % 2];
      const double amplitude = std::abs(result.deterministic.total[row].at(channel / 2, channel % 2));
      if (!(amplitude > highest * std::pow(10.0, -counted_range_db / 20.0)) || !std::isfinite(spread.bias_db)) continue;
      levels.square += spread.db * spread.db, levels.bias += spread.bias_db, ++levels.count;
    }
  return levels;
}

}  // namespace

RandomSummary summarise(const RandomResult& result) {
  double signal = 0.0, spread = 0.0, bias = 0.0, error = 0.0;
  for (std::size_t row = 0; row < result.spread.size(); ++row) {
    signal += std::pow(frobenius_norm(result.deterministic.total[row]), 2);
    bias += std::pow(frobenius_norm(result.mean.total[row] - result.deterministic.total[row]), 2);
    for (const int channel : {0, 1, 2, 3}) {
      spread += std::pow(result.spread[row][channel / 2][channel % 2].amplitude, 2);
      error += std::pow(result.mean.error[row][channel / 2][channel % 2], 2);
    }
  }
  const Levels levels = strong_levels(result);
  if (signal == 0.0 || levels.count == 0) return {};
  return {std::sqrt(spread / signal), std::sqrt(bias / signal), std::sqrt(error / signal),
          std::sqrt(levels.square / levels.count), levels.bias / levels.count};
}

void write_random_csv(const std::filesystem::path& file, const Sweep& sweep, const RandomResult& result) {
  OutputFile out(file);
  out.write(conventions(result.mean) + random_note(result.options) + meanings + key_columns + value_columns);
  for (std::size_t i = 0; i < sweep.looks.size(); ++i)
    for (std::size_t f = 0; f < sweep.frequencies.size(); ++f)
      for (const int channel : {0, 1, 2, 3})
        out.write(key_text(number_text(sweep.frequencies[f]), sweep.looks[i]) +
                  values_text(result, sweep.row(i, f), channel / 2, channel % 2));
  out.commit();
}

std::string random_note(const RandomOptions& options) {
  return fmt::format(
      "# launch = random: S is the mean of {} runs of {} random tubes a look (Philox4x32-10, seed {}); err_pq_db stands for the "
      "standard error of the mean.\n",
      options.runs, options.samples, options.seed);
}

std::string random_text(const RandomResult& result) {
  const RandomSummary s = summarise(result);
  return fmt::format(
      "launch      random: {} runs of {} tubes a look, seed {}\n"
      "time        {:.2g} s a run; {:.2g} s for the deterministic solution\n"
      "spread      {:.3g} of S, {:.3g} dB rms within {:g} dB of the peak, in a single run\n"
      "bias        {:.3g} of S ({:.3g} by chance alone), {:+.3g} dB in the mean\n",
      result.options.runs, result.options.samples, result.options.seed, result.run_s, result.deterministic.statistics.solve_s,
      s.spread, s.spread_db, counted_range_db, s.bias, s.expected_bias, s.bias_db);
}

}  // namespace raytube
