// Distributions of sigma: laws with known parameters are found again, windows hold the rows they should.
#include <gmock/gmock.h>

#include <cmath>
#include <numeric>

#include "core/error.h"
#include "output/statistics/statistics_plot.h"
#include "output/statistics/statistics_tables.h"
#include "scratch.h"

namespace raytube {
namespace {

using namespace raytube::testing;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr int draws = 2000;

// The levels below which 1/2, 3/2, ... of n draws lie: where the share below a level reaches them.
template <class Share>
std::vector<double> quantiles(const Share& below) {
  std::vector<double> levels;
  for (int i = 0; i < draws; ++i) {
    double low = -120.0, high = 60.0;
    for (int step = 0; step < 60; ++step) {
      const double middle = 0.5 * (low + high);
      (below(middle) < (i + 0.5) / draws ? low : high) = middle;
    }
    levels.push_back(low);
  }
  return levels;
}

double square_metres(double dbsm) { return std::pow(10.0, dbsm / 10.0); }

std::vector<double> gamma_quantiles(double k, double mean) {
  return quantiles([=](double level) { return gamma_below(k, k * square_metres(level) / mean); });
}

// psi(1) = -gamma, psi(1/2) = -gamma - 2 ln 2, psi(x + 1) = psi(x) + 1 / x.
TEST(Laws, Digamma) {
  constexpr double euler = 0.57721566490153286;
  EXPECT_NEAR(digamma(1.0), -euler, 1e-13);
  EXPECT_NEAR(digamma(0.5), -euler - 2.0 * std::log(2.0), 1e-13);
  EXPECT_NEAR(digamma(31.5) - digamma(30.5), 1.0 / 30.5, 1e-14);
}

// In closed form for whole and half k, on both sides of x = k + 1.
TEST(Laws, ShareOfAGammaLaw) {
  for (const double x : {1e-6, 0.3, 1.0, 1.9, 2.1, 5.0, 40.0}) {
    EXPECT_NEAR(gamma_below(1.0, x), 1.0 - std::exp(-x), 1e-14) << x;
    EXPECT_NEAR(gamma_below(2.0, x), 1.0 - std::exp(-x) * (1.0 + x), 1e-14) << x;
    EXPECT_NEAR(gamma_below(0.5, x), std::erf(std::sqrt(x)), 1e-14) << x;
  }
  EXPECT_EQ(gamma_below(2.0, 0.0), 0.0);
  EXPECT_NEAR(gamma_below(1e4, 1e4), 0.5, 2e-3);  // towards a normal law: 1/2 + 1 / (3 sqrt(2 pi k))
}

TEST(Laws, LikeliestShapeSolvesItsEquation) {
  for (const double k : {0.2, 1.0, 2.0, 7.3, 500.0}) EXPECT_NEAR(likeliest_shape(std::log(k) - digamma(k)), k, 1e-9 * k);
}

TEST(Laws, ExponentialDrawsAreSwerlingI) {
  const std::vector<LawFit> laws = fitted_laws(gamma_quantiles(1.0, 3.0));
  EXPECT_EQ(nearest_law(laws).law, Law::swerling_1);
  EXPECT_NEAR(laws[0].mean_m2, 3.0, 0.01);   // the tail above the last of the draws is missing
  EXPECT_LT(laws[0].distance, 2.0 / draws);  // half a step, and what the mean lacks
  EXPECT_NEAR(laws[2].shape, 1.0, 0.005);
  EXPECT_GT(laws[1].distance, 0.1);
  EXPECT_NEAR(laws[1].below(10.0 * std::log10(3.0)), 1.0 - 3.0 * std::exp(-2.0), 0.002);  // 4 degrees of freedom at the mean
}

TEST(Laws, FourDegreesOfFreedomAreSwerlingIII) {
  const std::vector<LawFit> laws = fitted_laws(gamma_quantiles(2.0, 0.01));
  EXPECT_EQ(nearest_law(laws).law, Law::swerling_3);
  EXPECT_NEAR(laws[2].shape, 2.0, 0.01);
  EXPECT_GT(laws[0].distance, 0.1);
}

TEST(Laws, OtherDegreesAreChiSquare) {
  const std::vector<LawFit> laws = fitted_laws(gamma_quantiles(0.4, 10.0));
  EXPECT_EQ(nearest_law(laws).law, Law::chi_square);
  EXPECT_NEAR(laws[2].shape, 0.4, 0.002);
}

TEST(Laws, NormalDecibelsAreLogNormal) {
  const auto laws = fitted_laws(quantiles([](double level) { return 0.5 * std::erfc((-7.0 - level) / (std::sqrt(2.0) * 6.0)); }));
  EXPECT_EQ(nearest_law(laws).law, Law::log_normal);
  EXPECT_NEAR(laws[3].middle_db, -7.0, 1e-6);
  EXPECT_NEAR(laws[3].spread_db, 6.0, 0.02);
  EXPECT_NEAR(10.0 * std::log10(laws[3].mean_m2), -7.0 + 36.0 * std::log(10.0) / 20.0, 0.03);
}

TEST(Laws, TooFewOrAllAlikeHaveNone) {
  EXPECT_TRUE(fitted_laws(std::vector<double>(9, 1.0)).empty());
  EXPECT_TRUE(fitted_laws(std::vector<double>(100, 3.0)).empty());
  std::vector<double> levels = gamma_quantiles(1.0, 1.0);
  const double distance = fitted_laws(levels)[0].distance;
  levels.push_back(-INFINITY);
  EXPECT_EQ(fitted_laws(levels)[0].distance, distance);  // a zero is left out
}

TEST(SigmaSummary, OfKnownLevels) {
  const SigmaSummary s = sigma_summary({10.0, 0.0, 20.0, -INFINITY}, std::vector{0.0, 50.0, 100.0});
  EXPECT_EQ(s.rows, 4u);
  EXPECT_DOUBLE_EQ(s.mean_m2, 111.0 / 4.0);
  EXPECT_DOUBLE_EQ(s.median_dbsm, 5.0);
  EXPECT_DOUBLE_EQ(s.deviation_db, 10.0);
  EXPECT_THAT(s.percentiles_dbsm, ElementsAre(-INFINITY, 5.0, 20.0));
}

// Of exponential draws of mean m: median m ln 2, deviation of the decibels 5.57 dB, mean of the decibels 2.51 dB below m.
TEST(SigmaSummary, OfAnExponentialLaw) {
  const SigmaSummary s = sigma_summary(gamma_quantiles(1.0, 1.0), std::vector{10.0});
  EXPECT_NEAR(s.median_dbsm, 10.0 * std::log10(std::log(2.0)), 1e-3);
  EXPECT_NEAR(s.percentiles_dbsm[0], 10.0 * std::log10(-std::log(0.9)), 0.01);
  EXPECT_NEAR(s.deviation_db, 10.0 / std::log(10.0) * pi / std::sqrt(6.0), 0.02);
}

CutRows rows_over(double from, double to, double step) {
  CutRows cut;
  for (double x = from; x <= to + 1e-9; x += step) cut.rows.push_back(cut.x.size()), cut.x.push_back(x);
  return cut;
}

TEST(Windows, LieWithinASweep) {
  const auto windows = sliding_windows(rows_over(0, 4, 1), RowCoordinates::theta, 2.0);
  ASSERT_EQ(windows.size(), 3u);
  EXPECT_THAT(windows[0].rows, ElementsAre(0, 1, 2));
  EXPECT_EQ(windows[2].to, 4.0);
}

TEST(Windows, RunOnOverTheEndsOfATurn) {
  for (const double last : {350.0, 360.0}) {  // the direction at 360 is that at 0, and counts once
    const auto windows = sliding_windows(rows_over(0, last, 10), RowCoordinates::phi, 20.0);
    EXPECT_THAT(windows.front().rows, ElementsAre(35, 0, 1));
    const auto whole = sliding_windows(rows_over(0, last, 10), RowCoordinates::phi, 360.0);
    EXPECT_EQ(whole.front().rows.size(), 36u);
  }
}

TEST(Histogram, HoldsEveryRowOnce) {
  std::vector<double> levels = gamma_quantiles(1.0, 1.0);
  levels.push_back(-INFINITY);
  const Histogram histogram = histogram_of(levels);
  EXPECT_EQ(histogram.bins.front().from_dbsm, -INFINITY);
  const auto laws = fitted_laws(levels);
  std::size_t rows = 0;
  double expected = 0.0;
  for (const HistogramBin& bin : histogram.bins) {
    rows += bin.rows, expected += expected_share(laws[0], bin);
    EXPECT_NEAR(static_cast<double>(bin.rows) / draws, expected_share(laws[0], bin), 2.0 / draws) << bin.from_dbsm;
  }
  EXPECT_EQ(rows, levels.size());
  EXPECT_NEAR(expected, 1.0, 1e-3);
  EXPECT_TRUE(histogram_of(std::vector<double>(20, -INFINITY)).bins.empty());
}

ResultTable azimuths(const Scratch& scratch) {
  std::string text = "freq_hz,theta_deg,phi_deg,sigma_vv_dbsm\n";
  const std::vector<double> levels = gamma_quantiles(1.0, 1.0);
  for (int i = 0; i < 360; ++i) text += "1e10,90," + std::to_string(i) + ',' + std::to_string(levels[i * 7 % draws]) + '\n';
  return read_result_table(scratch.write("a.csv", text));
}

TEST(Statistics, TablesAndPicture) {
  const Scratch scratch;
  const SigmaStatistics s = sigma_statistics(azimuths(scratch), {10.0, 90.0}, 20.0);
  write_statistics_csv(scratch / "statistics.csv", s);
  const std::string text = text_of(scratch / "statistics.csv");
  EXPECT_THAT(text,
              HasSubstr("\nfreq_hz,theta_deg,phi_deg,rx_theta_deg,rx_phi_deg,from_deg,to_deg,channel,rows,mean_m2,mean_dbsm,"
                        "median_dbsm,p10_dbsm,p90_dbsm,std_db\n,,,,,,,vv,360,"));
  EXPECT_THAT(text, HasSubstr("\n10000000000,90,,,,-10,10,vv,21,"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3 + 1 + 360);
  EXPECT_THAT(statistics_plot_script("svg", "x.svg", s), AllOf(HasSubstr("$bars0"), HasSubstr("Swerling III: ")));
  EXPECT_THAT([&] { sigma_statistics(azimuths(scratch), {50.0}, 400.0); },
              ThrowsMessage<InputError>(HasSubstr("sweeps over 360 degrees only; take a narrower one")));
}

}  // namespace
}  // namespace raytube
