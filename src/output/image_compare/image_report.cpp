#include "output/image_compare/image_report.h"

#include <fmt/format.h>

#include <cmath>

#include "core/decimal.h"
#include "output/compare/comparison_report.h"
#include "output/compare/measure_lines.h"
#include "output/files/files.h"
#include "output/tables/csv.h"

namespace raytube {

namespace {

std::string file_line(const char* what, const PixelImage& image) {
  return fmt::format("{:<12}{}, {} x {} pixels\n", what, image.file.string(), image.across.count, image.up.count);
}

std::string head(const ImageComparison& c) {
  std::string text = file_line("result", c.result) + file_line("reference", c.reference);
  text += fmt::format("{:<12}{} x {} pixels of the reference\n", "compared", c.map.across.count, c.map.up.count);
  text += c.registered ? fmt::format("{:<12}the result lies {:+.3f} pixels along columns, {:+.3f} along rows; taken back\n",
                                     "registered", c.shift.x + 0.0, c.shift.y + 0.0)
                       : fmt::format("{:<12}no (--no-register)\n", "registered");
  return text + (c.scale ? scale_text(*c.scale) : "");
}

std::string line(const ImageComparison& c, const std::string& name, double ErrorMeasures::*measure) {
  return measure_line(c.signal, name, [&](int channel) { return four_digits(c.measures[channel].errors.*measure); });
}

std::string line(const ImageComparison& c, const std::string& name, double ImageMeasures::*measure) {
  return measure_line(c.signal, name, [&](int channel) { return four_digits(c.measures[channel].*measure); });
}

std::string near_peak_text(const ImageComparison& c) {
  const auto errors = [&](int channel) -> const ErrorMeasures& { return c.measures[channel].errors; };
  return near_peak_lines(c.signal, c.within_db, "pixels", errors) +
         line(c, fmt::format("SSIM (Wang et al. 2004) of {:g} dB below that peak", c.within_db), &ImageMeasures::similarity);
}

std::string all_pixels_text(const ImageComparison& c) {
  return fmt::format("over all {} pixels\n", c.pixels()) + line(c, "correlation of magnitudes", &ImageMeasures::correlation) +
         line(c, "relative rms error of magnitudes", &ImageMeasures::magnitude_error) +
         line(c, "relative rms error of complex pixels", &ErrorMeasures::relative_error) +
         line(c, "power, result over reference, dB", &ImageMeasures::power_ratio_db);
}

// Nothing is left out in silence.
std::string left_out_text(const ImageComparison& c, int channel) {
  const bool in_result = c.result.has_channel[channel], in_reference = c.reference.has_channel[channel];
  const ErrorMeasures& peaks = c.measures[channel].errors;
  if (c.signal[channel] || (!in_result && !in_reference)) return "";
  if (!c.compared[channel])
    return fmt::format("{}: in the {} alone\n", channel_names[channel], in_result ? "result" : "reference");
  return fmt::format("{}: no signal in the reference (peak {:.4g} dBsm); the result's peak is {:.4g} dBsm{}\n",
                     channel_names[channel], peaks.reference_peak_dbsm, peaks.result_peak_dbsm,
                     c.unexpected[channel] ? ", above any tolerance" : "");
}

std::string csv_head(const ImageComparison& c) {
  std::string text = fmt::format("# result: {}; reference: {}", c.result.file.string(), c.reference.file.string());
  for (char& character : text)
    if (static_cast<unsigned char>(character) < ' ') character = ' ';
  text += '\n';
  if (c.scale) text += "# " + scale_text(*c.scale);
  text +=
      fmt::format("# Columns pixels_within to ssim: result minus reference where the reference is within {:g} dB of its peak.\n",
                  c.within_db);
  return text +
         "channel,result_peak_dbsm,reference_peak_dbsm,shift_columns,shift_rows,pixels,pixels_within,rms_db,mean_abs_db,"
         "median_abs_db,p95_abs_db,largest_abs_db,bias_db,at_peak_db,ssim,correlation,magnitude_error,relative_error,"
         "power_ratio_db,largest_column,largest_row\n";
}

// A pixel of the reference, counted from 0.
std::string place_text(const ImageComparison& c, int channel) {
  if (!c.signal[channel]) return "nan,nan";
  const std::size_t index = c.measures[channel].errors.largest_row;
  return fmt::format("{},{}", c.map.across.first + index % c.map.across.count, c.map.up.first + index / c.map.across.count);
}

std::string csv_row(const ImageComparison& c, int channel) {
  const ImageMeasures& m = c.measures[channel];
  const ErrorMeasures& e = m.errors;
  std::string text = channel_names[channel];
  for (const double value : {e.result_peak_dbsm, e.reference_peak_dbsm}) text += ',' + number_text(value);
  text += fmt::format(",{:.3f},{:.3f},{},{}", c.shift.x + 0.0, c.shift.y + 0.0, c.pixels(), e.within);
  for (const double value : {e.rms_db, e.mean_abs_db, e.median_abs_db, e.p95_abs_db, e.largest_abs_db, e.bias_db, e.at_peak_db,
                             m.similarity, m.correlation, m.magnitude_error, e.relative_error, m.power_ratio_db})
    text += ',' + number_text(value);
  return text + ',' + place_text(c, channel) + '\n';
}

}  // namespace

std::string comparison_text(const ImageComparison& c) {
  std::string text = head(c) + '\n' + measure_line(c.signal, "", [](int channel) { return std::string(channel_names[channel]); });
  text += line(c, "peak of the result, dBsm", &ErrorMeasures::result_peak_dbsm);
  text += line(c, "peak of the reference, dBsm", &ErrorMeasures::reference_peak_dbsm);
  text += near_peak_text(c) + all_pixels_text(c);
  for (int channel = 0; channel < 4; ++channel) text += left_out_text(c, channel);
  return text;
}

void write_compare_csv(const std::filesystem::path& file, const ImageComparison& c) {
  OutputFile out(file);
  out.write(csv_head(c));
  for (int channel = 0; channel < 4; ++channel)
    if (c.compared[channel]) out.write(csv_row(c, channel));
  out.commit();
}

std::string above_tolerance(const ImageComparison& c, double tolerance_db) {
  std::array<double, 4> rms{};
  for (int channel = 0; channel < 4; ++channel) rms[static_cast<std::size_t>(channel)] = c.measures[channel].errors.rms_db;
  return channels_above(rms, c.unexpected, tolerance_db);
}

}  // namespace raytube
