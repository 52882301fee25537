#include "output/compare/measure_lines.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace raytube {

std::string four_digits(double value) { return std::isnan(value) ? "-" : fmt::format("{:.4g}", value); }

std::string measure_line(const std::array<bool, 4>& signal, const std::string& name,
                         const std::function<std::string(int)>& value) {
  std::string text = fmt::format("  {:<48}", name);
  for (int channel = 0; channel < 4; ++channel)
    if (signal[channel]) text += fmt::format("{:>12}", value(channel));
  return text + '\n';
}

std::string near_peak_lines(const std::array<bool, 4>& signal, double within_db, const std::string& counted,
                            const std::function<const ErrorMeasures&(int)>& errors) {
  std::string text =
      fmt::format("dB error, result minus reference, where the reference is within {:g} dB of its peak\n", within_db);
  text += measure_line(signal, counted, [&](int channel) { return std::to_string(errors(channel).within); });
  constexpr std::array<std::pair<const char*, double ErrorMeasures::*>, 7> measures{
      {{"rms", &ErrorMeasures::rms_db},
       {"mean |error|", &ErrorMeasures::mean_abs_db},
       {"median |error|", &ErrorMeasures::median_abs_db},
       {"95th percentile of |error|", &ErrorMeasures::p95_abs_db},
       {"largest |error|", &ErrorMeasures::largest_abs_db},
       {"bias (mean error)", &ErrorMeasures::bias_db},
       {"error at the reference's peak", &ErrorMeasures::at_peak_db}}};
  for (const auto& [name, measure] : measures)
    text += measure_line(signal, name, [&, measure = measure](int channel) { return four_digits(errors(channel).*measure); });
  return text;
}

}  // namespace raytube
