#include "output/compare/comparison_report.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/decimal.h"
#include "output/compare/measure_lines.h"
#include "output/files/files.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

constexpr std::array<const char*, RowCoordinates::quantities> lag_units = {"phi_deg",      "theta_deg", "rx_phi_deg",
                                                                           "rx_theta_deg", "freq_ghz",  ""};

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
  text += fmt::format("{:<12}{} rows, equal in {} (to {:g} degree, {:g} of the frequency)\n", "compared", c.rows(),
                      names(c.match.by), angle_tolerance_deg, frequency_tolerance);
  text += fmt::format("{:<12}{} rows of the result, {} of the reference\n", "left out", c.result.rows.size() - c.rows(),
                      c.reference.rows.size() - c.rows());
  return text + (c.scale ? scale_text(*c.scale) : "");
}

std::string line(const Comparison& c, const std::string& name, double ErrorMeasures::*measure) {
  return measure_line(c.signal, name, [&](int channel) { return four_digits(c.errors[channel].*measure); });
}

std::string all_rows_text(const Comparison& c) {
  std::string text = fmt::format("over all {} rows\n", c.rows());
  text += line(c, "relative error of complex S", &ErrorMeasures::relative_error);
  text += line(c, fmt::format("Austin measure, dB, floor {:g} dB below the peak", dynamic_range_db), &ErrorMeasures::austin_db);
  text += line(c, "correlation of the dB curves, same floor", &ErrorMeasures::correlation);
  if (c.cuts.quantity != RowCoordinates::look_number)
    text += measure_line(c.signal, fmt::format("lag of the result, {}", lag_units[c.cuts.quantity]),
                         [&](int channel) { return four_digits(c.lag[channel]); });
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

std::string csv_header() {
  std::string header =
      "channel,result_peak_dbsm,reference_peak_dbsm,rows,rows_within,rms_db,mean_abs_db,median_abs_db,p95_abs_db,largest_abs_db,"
      "bias_db,at_peak_db,relative_error,austin_db,correlation,lag,lag_unit";
  for (const char* key : key_names) header += fmt::format(",largest_{}", key);
  return header + '\n';
}

std::string csv_row(const Comparison& c, int channel) {
  const ErrorMeasures& e = c.errors[channel];
  std::string text = channel_names[channel];
  for (const double value : {e.result_peak_dbsm, e.reference_peak_dbsm}) text += ',' + number_text(value);
  text += fmt::format(",{},{}", c.rows(), e.within);
  for (const double value : {e.rms_db, e.mean_abs_db, e.median_abs_db, e.p95_abs_db, e.largest_abs_db, e.bias_db, e.at_peak_db,
                             e.relative_error, e.austin_db, e.correlation, c.lag[channel]})
    text += ',' + number_text(value);
  text += std::string(",") + lag_units[c.cuts.quantity];
  for (int k = 0; k < ResultTable::keys; ++k)
    text += ',' + number_text(c.has_key[k] && c.signal[channel] ? c.keys[e.largest_row][k] : ErrorMeasures::undefined);
  return text + '\n';
}

}  // namespace

std::string comparison_text(const Comparison& c) {
  std::string text = rows_text(c) + '\n';
  text += measure_line(c.signal, "", [](int channel) { return std::string(channel_names[channel]); });
  text += line(c, "peak of the result, dBsm", &ErrorMeasures::result_peak_dbsm);
  text += line(c, "peak of the reference, dBsm", &ErrorMeasures::reference_peak_dbsm);
  text += near_peak_lines(c.signal, c.within_db, "rows", [&](int channel) -> const ErrorMeasures& { return c.errors[channel]; }) +
          all_rows_text(c) + '\n';
  for (int channel = 0; channel < 4; ++channel) text += c.signal[channel] ? largest_text(c, channel) : left_out_text(c, channel);
  return text;
}

std::string comparison_json(const Comparison& c) {
  const double relative = relative_error(c);
  nlohmann::ordered_json json = {{"result", c.result.file.string()},
                                 {"reference", c.reference.file.string()},
                                 {"rows", c.rows()},
                                 {"rows_of_result", c.result.rows.size()},
                                 {"rows_of_reference", c.reference.rows.size()},
                                 {"within_db", c.within_db},
                                 {"relative_error", std::isfinite(relative) ? nlohmann::ordered_json(relative) : nullptr}};
  for (std::size_t channel = 0; channel < 4; ++channel) {
    const ErrorMeasures& e = c.errors[channel];
    if (c.signal[channel])
      json["channels"][channel_names[channel]] = {{"result_peak_dbsm", e.result_peak_dbsm},
                                                  {"reference_peak_dbsm", e.reference_peak_dbsm},
                                                  {"rows_within", e.within},
                                                  {"rms_db", e.rms_db},
                                                  {"mean_abs_db", e.mean_abs_db},
                                                  {"median_abs_db", e.median_abs_db},
                                                  {"p95_abs_db", e.p95_abs_db},
                                                  {"largest_abs_db", e.largest_abs_db},
                                                  {"bias_db", e.bias_db},
                                                  {"at_peak_db", e.at_peak_db},
                                                  {"relative_error", e.relative_error},
                                                  {"austin_db", e.austin_db},
                                                  {"correlation", e.correlation}};
  }
  return json.dump(2);
}

void write_compare_csv(const std::filesystem::path& file, const Comparison& c, const std::array<std::string, 2>& columns) {
  OutputFile out(file);
  out.write(csv_comments(c));
  for (const auto& [option, text] : {std::pair{"--result-columns", columns[0]}, std::pair{"--reference-columns", columns[1]}})
    if (!text.empty()) out.write(fmt::format("# {} {}\n", option, text));
  out.write(csv_header());
  for (int channel = 0; channel < 4; ++channel)
    if (c.compared[channel]) out.write(csv_row(c, channel));
  out.commit();
}

std::string channels_above(const std::array<double, 4>& rms_db, const std::array<bool, 4>& unexpected, double tolerance_db) {
  std::string text;
  for (std::size_t channel = 0; channel < 4; ++channel) {
    const double rms = unexpected[channel] ? std::numeric_limits<double>::infinity() : rms_db[channel];
    if (rms > tolerance_db) text += fmt::format("{}{} {:.4g} dB", text.empty() ? "" : ", ", channel_names[channel], rms);
  }
  return text;
}

std::string above_tolerance(const Comparison& c, double tolerance_db) {
  std::array<double, 4> rms{};
  for (std::size_t channel = 0; channel < 4; ++channel) rms[channel] = c.errors[channel].rms_db;
  return channels_above(rms, c.unexpected, tolerance_db);
}

}  // namespace raytube
