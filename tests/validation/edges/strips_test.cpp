// The edge pass in two dimensions against spectrally accurate solutions of a flat strip (tests/data/strips_*.csv). The expected
// errors are those of an independent implementation (Python, complex erf), digit by digit: the kernels are the same functions.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "math/erfc_ray.h"
#include "run.h"
#include "strip_2d.h"
#include "unit/quadrature.h"

namespace raytube {
namespace {

using namespace raytube::testing;

/// Directions of one cut, from the plane [deg], and the exact P there.
struct Cut {
  std::vector<double> incidence, observation;
  std::vector<Complex> exact;
};

/// Monostatic without `incidence`, else all observers of that source.
Cut read_cut(bool hard, double w, std::optional<double> incidence = {}) {
  const Table table(std::string(RAYTUBE_SOURCE_DIR "/tests/data/strips_") + (hard ? "hard.csv" : "soft.csv"));
  Cut cut;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const double from = table.number(i, "incidence"), to = table.number(i, "observation");
    if (table.number(i, "w") != w || (incidence ? from != *incidence : from != to)) continue;
    cut.incidence.push_back(from);
    cut.observation.push_back(to);
    cut.exact.emplace_back(table.number(i, "re"), table.number(i, "im"));
  }
  return cut;
}

template <class Model>
std::vector<Complex> amplitudes(const Cut& cut, Model model) {
  std::vector<Complex> result;
  for (std::size_t i = 0; i < cut.exact.size(); ++i)
    result.push_back(model(cut.incidence[i] * degree, cut.observation[i] * degree));
  return result;
}

double relative_error(const Cut& cut, const std::vector<Complex>& found) {
  double error = 0.0, size = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    error += std::norm(found[i] - cut.exact[i]);
    size += std::norm(cut.exact[i]);
  }
  return std::sqrt(error / size);
}

/// Mean over nine looks of a cut in whole degrees, so that nulls do not rule the figure; looks beyond the cut count as zero.
std::vector<double> smoothed(const std::vector<double>& power) {
  std::vector<double> result(power.size());
  for (std::size_t i = 0; i < power.size(); ++i)
    for (std::size_t j = i < 4 ? 0 : i - 4; j < std::min(i + 5, power.size()); ++j) result[i] += power[j] / 9;
  return result;
}

std::vector<double> power_of(const std::vector<Complex>& amplitudes, bool smooth) {
  std::vector<double> power;
  for (const Complex& p : amplitudes) power.push_back(std::norm(p));
  return smooth ? smoothed(power) : power;
}

/// Rms difference [dB] over elevations from..to degrees, both included.
double rms_db(const Cut& cut, const std::vector<Complex>& found, double from, double to, bool smooth) {
  const std::vector<double> ours = power_of(found, smooth), exact = power_of(cut.exact, smooth);
  std::vector<double> differences;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (cut.observation[i] >= from && cut.observation[i] <= to) differences.push_back(10 * std::log10(ours[i] / exact[i]));
  return rms(differences);
}

struct Row {
  double w;
  int order;
  std::vector<std::string> db;  // rms over elevations 5-20, 20-60 and 60 to 85 or 89 degrees
  std::string relative;         // error of P
};

template <class Model>
void expect_figures(const Row& row, bool hard, double highest, bool smooth, Model model, const std::string& name) {
  const Cut cut = read_cut(hard, row.w);
  const std::vector<Complex> found = amplitudes(cut, model);
  const std::string what = fmt::format("strip {} wavelengths, {}, {}", row.w, hard ? "hard" : "soft", name);
  const double limits[] = {5, 20, 60, highest};
  for (std::size_t band = 0; band < row.db.size(); ++band)
    expect_printed(rms_db(cut, found, limits[band], limits[band + 1], smooth), row.db[band],
                   fmt::format("{}, {}-{} deg [dB]", what, limits[band], limits[band + 1]));
  if (!row.relative.empty()) expect_printed(relative_error(cut, found), row.relative, what + ", relative error");
}

void expect_row(const Row& row, bool hard, double highest, bool smooth) {
  const auto model = [&](double from, double to) { return strip_amplitude(row.w, from, to, row.order, hard); };
  expect_figures(row, hard, highest, smooth, model, fmt::format("order {}", row.order));
}

TEST(Strips, FirstOrderWithSmoothedPatterns) {
  // Two figures differ from what the independent implementation printed, 0.23 (of 5 wavelengths) and 1.0 dB (of 10): its
  // elevation of 60 degrees had become 59.99..., outside the third band. With this rule the same numbers come out here.
  const Row soft[] = {{5, physical_optics, {"18.6", "7.1", "1.1"}, ""}, {5, untruncated_strips, {"0.03", "0.02", "0.00"}, ""}};
  const Row hard[] = {{5, physical_optics, {"15.9", "8.6", "1.1"}, ""},
                      {5, untruncated_strips, {"5.3", "2.1", "0.24"}, ""},
                      {10, physical_optics, {"17.8", "7.2", "1.1"}, ""},
                      {10, untruncated_strips, {"3.4", "0.61", "0.12"}, ""}};
  for (const Row& row : soft) expect_row(row, false, 85, true);
  for (const Row& row : hard) expect_row(row, true, 85, true);
}

TEST(Strips, MonostaticOrdersHard) {
  const Row rows[] = {{1, 0, {"17.24", "3.52", "1.51"}, ".3433"}, {1, 1, {"7.84", "1.38", "0.51"}, ".1202"},
                      {1, 2, {"0.19", "0.06", "0.06"}, ".0094"},  {1, 3, {"0.30", "0.05", "0.01"}, ".0019"},
                      {1, 4, {"0.02", "0.02", "0.01"}, ".0013"},  {2, 0, {"12.07", "3.29", "1.30"}, ".2134"},
                      {2, 1, {"5.65", "1.22", "0.42"}, ".0788"},  {2, 2, {"0.09", "0.04", "0.03"}, ".0034"},
                      {2, 3, {"0.11", "0.01", "0.00"}, ".0006"},  {2, 4, {"0.02", "0.01", "0.00"}, ".0005"},
                      {5, 0, {"6.90", "2.81", "0.95"}, ".1155"},  {5, 1, {"3.28", "1.10", "0.29"}, ".0455"},
                      {5, 2, {"0.03", "0.02", "0.02"}, ".0009"},  {5, 3, {"0.03", "0.00", "0.00"}, ".0001"},
                      {5, 4, {"0.01", "0.00", "0.00"}, ".0001"},  {10, 0, {"4.65", "1.91", "0.66"}, ".0775"},
                      {10, 1, {"2.17", "0.73", "0.20"}, ".0318"}, {10, 2, {"0.01", "0.01", "0.01"}, ".0004"},
                      {10, 3, {"0.01", "0.00", "0.00"}, ".0000"}};
  for (const Row& row : rows) expect_row(row, true, 89, false);
}

TEST(Strips, MonostaticOrdersSoft) {
  const Row rows[] = {{1, 0, {"0.06", "0.15", "0.05"}, ".0094"},  {1, 1, {"0.47", "0.21", "0.02"}, ".0199"},
                      {2, 0, {"0.04", "0.07", "0.02"}, ".0031"},  {2, 1, {"0.28", "0.11", "0.01"}, ".0091"},
                      {5, 0, {"0.03", "0.02", "0.01"}, ".0007"},  {5, 1, {"0.14", "0.03", "0.00"}, ".0032"},
                      {10, 0, {"0.01", "0.01", "0.00"}, ".0002"}, {10, 1, {"0.08", "0.01", "0.00"}, ".0015"}};
  for (const Row& row : rows) expect_row(row, false, 89, false);
}

TEST(Strips, BistaticOrders) {
  struct BistaticRow {
    bool hard;
    double incidence;
    std::vector<std::string> relative;  // of order 0, 1, ...
  };
  const BistaticRow rows[] = {{true, 3, {"7.3129", ".7216", ".0513", ".0033", ".0005"}},
                              {true, 20, {".3098", ".0464", ".0033", ".0001", ".0001"}},
                              {true, 60, {".0765", ".0127", ".0009", ".0000", ".0000"}},
                              {false, 3, {".8114", ".0100"}},
                              {false, 20, {".0738", ".0020"}},
                              {false, 60, {".0059", ".0002"}}};
  for (const BistaticRow& row : rows) {
    const Cut cut = read_cut(row.hard, 5, row.incidence);
    for (int order = 0; order < std::ssize(row.relative); ++order) {
      const auto model = [&](double from, double to) { return strip_amplitude(5, from, to, order, row.hard); };
      expect_printed(
          relative_error(cut, amplitudes(cut, model)), row.relative[order],
          fmt::format("strip 5 wavelengths, {}, from {} deg, order {}", row.hard ? "hard" : "soft", row.incidence, order));
    }
  }
}

// --- second order in one quadrature: the current of each edge multiplied by the other edge's answer to a grazing wave ---

Complex erf_ray(double y) { return 1.0 - std::polar(1.0, -y * y) * scaled_erfc(y); }  // erf(e^{j pi/4} y)

/// h = 2 e^{jkx cos phi'} (1 - C1 E2 - C2 E1), E = erf(e^{j pi/4} sqrt(2 k distance)), C = 1 - erf of the same times cos or
/// sin(phi'/2).
Complex product_of_edges(double w, double source, double observer) {
  static const GaussLegendre rule(16);
  const double k = 2 * pi, spread = std::cos(source) + std::cos(observer);
  const int panels = static_cast<int>(8 * w) + 8;
  Complex sum = 0.0;
  for (int panel = 0; panel < panels; ++panel)
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double t = (panel + rule.nodes[i]) / panels;  // x = w (t - sin(2 pi t) / (2 pi)) takes up the roots at the edges
      const double x = w * (t - std::sin(2 * pi * t) / (2 * pi)), slope = w * (1 - std::cos(2 * pi * t));
      const double first = std::sqrt(2 * k * x), second = std::sqrt(2 * k * (w - x));
      const Complex current = 1.0 - (1.0 - erf_ray(first * std::cos(source / 2))) * erf_ray(second) -
                              (1.0 - erf_ray(second * std::sin(source / 2))) * erf_ray(first);
      sum += rule.weights[i] / panels * slope * current * std::polar(1.0, k * (x - w / 2) * spread);
    }
  return k / 2 * std::sin(observer) * sum;
}

TEST(Strips, ProductOfTheEdgesIsLessAccurateThanOrderTwo) {
  const Row rows[] = {{1, 0, {"1.64", "0.39", "0.23"}, ".0364"},
                      {2, 0, {"1.09", "0.50", "0.32"}, ".0273"},
                      {5, 0, {"0.66", "0.58", "0.24"}, ".0172"},
                      {10, 0, {"0.53", "0.54", "0.18"}, ".0124"}};
  for (const Row& row : rows) {
    const auto model = [&](double from, double to) { return product_of_edges(row.w, from, to); };
    expect_figures(row, true, 89, false, model, "product of the edges");
  }
  const std::pair<double, std::string> bistatic[] = {{3, ".0894"}, {20, ".0164"}, {60, ".0084"}};
  for (const auto& [incidence, printed] : bistatic) {
    const Cut cut = read_cut(true, 5, incidence);
    const auto model = [&](double from, double to) { return product_of_edges(5, from, to); };
    expect_printed(relative_error(cut, amplitudes(cut, model)), printed,
                   fmt::format("product of the edges, from {} deg", incidence));
  }
}

}  // namespace
}  // namespace raytube
