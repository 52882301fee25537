#include "output/compare/comparison_report.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/decimal.h"
#include "core/ordered_json.h"
#include "output/files/files.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

constexpr std::array<const char*, RowCoordinates::quantities> lag_units = {
    "phi_deg", "theta_deg", "rx_phi_deg", "rx_theta_deg", "time_s", "freq_ghz", ""};

std::string names(const std::array<bool, ResultTable::keys>& chosen) {
  std::string text;
  for (int k = 0; k < ResultTable::keys; ++k)
    if (chosen[k]) text += (text.empty() ? "" : ", ") + std::string(key_names[k]);
  return text;
}

std::string file_line(const char* what, const ResultTable& table) {
  return fmt::format("{:<12}{}, {} rows\n", what, table.file.string(), table.rows.size());
}

std::string rows_text(const Comparison& c) {
  std::string text = file_line("result", c.result) + file_line("reference", c.reference);
  text += fmt::format("{:<12}{} rows, equal in {} (to {:g} degree, {:g} of the frequency{})\n", "compared", c.rows(),
                      names(c.match.by), angle_tolerance_deg, frequency_tolerance,
                      c.match.by[ResultTable::time] ? fmt::format(", {:g} s", time_tolerance_s) : "");
  text += fmt::format("{:<12}{} rows of the result, {} of the reference\n", "left out", c.result.rows.size() - c.rows(),
                      c.reference.rows.size() - c.rows());
  return text + (c.scale ? scale_text(*c.scale) : "");
}

// Four digits, or "-" where there is no number.
std::string four_digits(double value) { return std::isnan(value) ? "-" : fmt::format("{:.4g}", value); }

// A name and a value for every channel with signal.
template <class Value>
std::string line(const Comparison& c, const std::string& name, const Value& value) {
  std::string text = fmt::format("  {:<48}", name);
  for (std::size_t channel = 0; channel < 4; ++channel)
    if (c.signal[channel]) text += fmt::format("{:>12}", value(channel));
  return text + '\n';
}

template <std::size_t count>
std::string lines(const Comparison& c, const std::array<NamedMeasure, count>& measures) {
  std::string text;
  for (const NamedMeasure& measure : measures)
    text += line(c, measure.words, [&](std::size_t channel) { return four_digits(c.errors[channel].*measure.value); });
  return text;
}

std::string near_peak_text(const Comparison& c) {
  return fmt::format("dB error, result minus reference, where the reference is within {:g} dB of its peak\n", c.within_db) +
         line(c, "rows", [&](std::size_t channel) { return std::to_string(c.errors[channel].within); }) +
         lines(c, near_peak_measures);
}

std::string all_rows_text(const Comparison& c) {
  std::string text = fmt::format("over all {} rows\n", c.rows()) + lines(c, all_rows_measures);
  if (c.cuts.quantity != RowCoordinates::look_number)
    text += line(c, fmt::format("lag of the result, {}", lag_units[c.cuts.quantity]),
                 [&](std::size_t channel) { return four_digits(c.lag[channel]); });
  return text;
}

std::string largest_text(const Comparison& c, int channel) {
  const ErrorMeasures& errors = c.errors[channel];
  const std::size_t row = errors.largest_row;
  return fmt::format("largest in {}: {}, {:.4g} against {:.4g} dBsm\n", channel_names[channel],
                     coordinates_text(c.coordinates, row), c.pairs[channel].result_dbsm[row],
                     c.pairs[channel].reference_dbsm[row]);
}

// Nothing is left out in silence.
std::string left_out_text(const Comparison& c, int channel) {
  const bool in_result = c.result.has_channel[channel], in_reference = c.reference.has_channel[channel];
  if (c.compared[channel])
    return fmt::format(
        "{}: no signal in the reference (peak {:.4g} dBsm, more than {:g} dB below the highest); the result's peak is {:.4g} "
        "dBsm{}\n",
        channel_names[channel], c.errors[channel].reference_peak_dbsm, dynamic_range_db, c.errors[channel].result_peak_dbsm,
        c.unexpected[channel] ? ", above any tolerance" : "");
  if (!in_result && !in_reference) return "";
  return fmt::format("{}: in the {} alone\n", channel_names[channel], in_result ? "result" : "reference");
}

std::string csv_comments(const Comparison& c) {
  std::string text = fmt::format("# result: {}, {} rows; reference: {}, {} rows\n", c.result.file.string(), c.result.rows.size(),
                                 c.reference.file.string(), c.reference.rows.size());
  for (char& character : text)
    if (static_cast<unsigned char>(character) < ' ') character = ' ';
  text.back() = '\n';
  text += fmt::format("# {} rows compared, equal in {}\n", c.rows(), names(c.match.by));
  if (c.scale) text += "# " + scale_text(*c.scale);
  text += fmt::format(
      "# Columns rows_within to at_peak_db: result minus reference where the reference is within {:g} dB of its peak.\n",
      c.within_db);
  text +=
      fmt::format("# The others: all rows; austin_db and correlation with levels raised to {:g} dB below the reference's peak.\n",
                  dynamic_range_db);
  return text + "# A channel whose reference has no signal has nan throughout.\n";
}

// Times have a column where there are any.
bool in_table(const Comparison& c, int key) { return key != ResultTable::time || c.has_key[key]; }

std::string csv_header(const Comparison& c) {
  std::string header = "channel";
  for (const NamedMeasure& measure : peak_measures) header += fmt::format(",{}", measure.name);
  header += ",rows,rows_within";
  for (const NamedMeasure& measure : near_peak_measures) header += fmt::format(",{}", measure.name);
  for (const NamedMeasure& measure : all_rows_measures) header += fmt::format(",{}", measure.name);
  header += ",lag,lag_unit";
  for (int k = 0; k < ResultTable::keys; ++k)
    if (in_table(c, k)) header += fmt::format(",largest_{}", key_names[k]);
  return header + '\n';
}

std::string csv_row(const Comparison& c, std::size_t channel) {
  const ErrorMeasures& e = c.errors[channel];
  std::string text = channel_names[channel];
  for (const NamedMeasure& measure : peak_measures) text += ',' + number_text(e.*measure.value);
  text += fmt::format(",{},{}", c.rows(), e.within);
  for (const NamedMeasure& measure : near_peak_measures) text += ',' + number_text(e.*measure.value);
  for (const NamedMeasure& measure : all_rows_measures) text += ',' + number_text(e.*measure.value);
  text += fmt::format(",{},{}", number_text(c.lag[channel]), lag_units[c.cuts.quantity]);
  for (int k = 0; k < ResultTable::keys; ++k)
    if (in_table(c, k))
      text += ',' + number_text(c.has_key[k] && c.signal[channel] ? c.keys[e.largest_row][k] : ErrorMeasures::undefined);
  return text + '\n';
}

}  // namespace

std::string comparison_text(const Comparison& c) {
  std::string text = rows_text(c) + '\n';
  text += line(c, "", [](std::size_t channel) { return channel_names[channel]; });
  text += lines(c, peak_measures) + near_peak_text(c) + all_rows_text(c) + '\n';
  for (int channel = 0; channel < 4; ++channel) text += c.signal[channel] ? largest_text(c, channel) : left_out_text(c, channel);
  return text;
}

static Json measures_json(const ErrorMeasures& e) {
  Json json = {{"rows_within", e.within}};
  const auto add = [&](const auto& measures) {
    for (const NamedMeasure& measure : measures)
      json[measure.name] = std::isfinite(e.*measure.value) ? Json(e.*measure.value) : Json();
  };
  add(peak_measures), add(near_peak_measures), add(all_rows_measures);
  return json;
}

std::string comparison_json(const Comparison& c) {
  const double relative = relative_error(c);
  Json json = {{"result", c.result.file.string()},
               {"reference", c.reference.file.string()},
               {"rows", c.rows()},
               {"rows_of_result", c.result.rows.size()},
               {"rows_of_reference", c.reference.rows.size()},
               {"within_db", c.within_db},
               {"relative_error", std::isfinite(relative) ? Json(relative) : Json()}};
  for (std::size_t channel = 0; channel < 4; ++channel)
    if (c.signal[channel]) json["channels"][channel_names[channel]] = measures_json(c.errors[channel]);
  return text_of_json(json, 2);
}

void write_compare_csv(const std::filesystem::path& file, const Comparison& c, const std::array<std::string, 2>& columns) {
  OutputFile out(file);
  out.write(csv_comments(c));
  for (const auto& [option, text] : {std::pair{"--result-columns", columns[0]}, std::pair{"--reference-columns", columns[1]}})
    if (!text.empty()) out.write(fmt::format("# {} {}\n", option, text));
  out.write(csv_header(c));
  for (std::size_t channel = 0; channel < 4; ++channel)
    if (c.compared[channel]) out.write(csv_row(c, channel));
  out.commit();
}

std::string above_tolerance(const Comparison& c, double tolerance_db) {
  std::string text;
  for (std::size_t channel = 0; channel < 4; ++channel) {
    const double rms = c.unexpected[channel] ? std::numeric_limits<double>::infinity() : c.errors[channel].rms_db;
    if (rms > tolerance_db) text += fmt::format("{}{} {:.4g} dB", text.empty() ? "" : ", ", channel_names[channel], rms);
  }
  return text;
}

}  // namespace raytube
