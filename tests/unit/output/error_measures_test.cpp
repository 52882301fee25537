// Error measures: by hand on a few rows, by numpy on a curve, and where zeros turn up.
#include <gmock/gmock.h>

#include <cmath>

#include "output/compare/curve_lag.h"
#include "output/compare/error_measures.h"
#include "output/tables/csv.h"

namespace raytube {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

ChannelPair pair_of(std::vector<Complex> result, std::vector<Complex> reference) {
  ChannelPair pair{{}, {}, std::move(result), std::move(reference)};
  for (const Complex s : pair.result) pair.result_dbsm.push_back(sigma_dbsm(s));
  for (const Complex s : pair.reference) pair.reference_dbsm.push_back(sigma_dbsm(s));
  return pair;
}

ChannelPair levels(const std::vector<double>& result, const std::vector<double>& reference) {
  return {result, reference, {}, {}};
}

TEST(MeasuredErrors, ByHand) {
  // Differences 1, -2, 3, 0 dB within 20 dB of the peak of 0 dBsm, and 10 dB at -25 dBsm, which only the Austin measure counts.
  const ErrorMeasures e = measure_errors(levels({1, -12, -16, -20, -15}, {0, -10, -19, -20, -25}), 20.0);
  EXPECT_EQ(e.within, 4u);
  EXPECT_DOUBLE_EQ(e.rms_db, std::sqrt(14.0 / 4.0));
  EXPECT_DOUBLE_EQ(e.mean_abs_db, 6.0 / 4.0);
  EXPECT_DOUBLE_EQ(e.median_abs_db, 1.5);
  EXPECT_DOUBLE_EQ(e.p95_abs_db, 2.0 + 0.85);  // 0.95 * 3 = 2.85 places behind the smallest of 0, 1, 2, 3
  EXPECT_DOUBLE_EQ(e.largest_abs_db, 3.0);
  EXPECT_EQ(e.largest_row, 2u);
  EXPECT_DOUBLE_EQ(e.bias_db, 0.5);
  EXPECT_DOUBLE_EQ(e.at_peak_db, 1.0);
  EXPECT_DOUBLE_EQ(e.result_peak_dbsm, 1.0);
  EXPECT_DOUBLE_EQ(e.austin_db, 16.0 / 5.0);
  EXPECT_TRUE(std::isnan(e.relative_error));  // no phase
}

TEST(MeasuredErrors, RelativeErrorIsComplex) {
  const ErrorMeasures e = measure_errors(pair_of({{3, 0}, {0, 4}}, {{3, 4}, {0, 0}}), 20.0);
  EXPECT_DOUBLE_EQ(e.relative_error, std::sqrt(16.0 + 16.0) / 5.0);
}

TEST(MeasuredErrors, WithinCanBeWiderOrNarrower) {
  const ChannelPair pair = levels({0, 0, 0}, {0, -20, -40});
  EXPECT_EQ(measure_errors(pair, 0.0).within, 1u);
  EXPECT_EQ(measure_errors(pair, 20.0).within, 2u);
  EXPECT_EQ(measure_errors(pair, 40.0).within, 3u);
}

// tests/data/error_measures.py makes the same curves and printed these numbers (numpy 1.24).
TEST(MeasuredErrors, AgreeWithNumpy) {
  const auto lobes = [](double x) {
    return 0.3 * std::exp(-(x - 20) * (x - 20) / 144.0) * std::cos(0.7 * x) * std::polar(1.0, 0.9 * x);
  };
  std::vector<Complex> result, reference;
  std::vector<double> x;
  for (int i = 0; i <= 180; ++i) {
    x.push_back(0.25 * i);
    reference.push_back(i == 7 ? 0.0 : lobes(x[i]));
    result.push_back(1.03 * lobes(x[i] - 0.3) * std::polar(1.0, 0.05) + 0.002 * std::polar(1.0, 2.0 * x[i]));
  }
  const ChannelPair pair = pair_of(result, reference);
  const ErrorMeasures e = measure_errors(pair, 20.0);
  EXPECT_EQ(e.within, 119u);
  EXPECT_NEAR(e.rms_db, 5.94329681217487, 1e-9);
  EXPECT_NEAR(e.mean_abs_db, 2.97218562353271, 1e-10);
  EXPECT_NEAR(e.median_abs_db, 1.43517937054276, 1e-10);
  EXPECT_NEAR(e.p95_abs_db, 8.08212504315543, 1e-10);
  EXPECT_NEAR(e.largest_abs_db, 30.4776786109947, 1e-8);
  EXPECT_EQ(e.largest_row, 100u);
  EXPECT_NEAR(e.bias_db, -1.04142892587183, 1e-10);
  EXPECT_NEAR(e.at_peak_db, 0.0712744051156964, 1e-12);
  EXPECT_NEAR(e.relative_error, 0.309209710429363, 1e-12);
  EXPECT_NEAR(e.austin_db, 4.31993715185798, 1e-10);
  EXPECT_NEAR(e.correlation, 0.807408213686716, 1e-10);

  CurvePair curves{x, pair.result_dbsm, pair.reference_dbsm};
  for (std::vector<double>* level : {&curves.a, &curves.b})
    for (double& value : *level) value = std::max(value, e.reference_peak_dbsm - dynamic_range_db);
  EXPECT_NEAR(best_lag({curves}), 0.280669243971599, 1e-8);
}

TEST(MeasuredErrors, AZeroOnOneSideIsAnInfiniteErrorButTheFloorHoldsTheAustinMeasure) {
  const ErrorMeasures missing = measure_errors(levels({0, -inf, -30}, {0, -10, -30}), 20.0);
  EXPECT_EQ(missing.rms_db, inf);
  EXPECT_EQ(missing.largest_abs_db, inf);
  EXPECT_EQ(missing.bias_db, -inf);
  EXPECT_EQ(missing.median_abs_db, inf);  // between 0 and infinity
  EXPECT_DOUBLE_EQ(missing.austin_db, 70.0 / 3.0);
  EXPECT_TRUE(std::isfinite(missing.correlation));

  const ErrorMeasures extra = measure_errors(levels({0, -10, -inf}, {0, -inf, -inf}), 20.0);
  EXPECT_EQ(extra.within, 1u);
  EXPECT_EQ(extra.rms_db, 0.0);
  EXPECT_DOUBLE_EQ(extra.austin_db, 70.0 / 3.0);
}

TEST(MeasuredErrors, EqualCurvesHaveNoErrorAndCorrelateFully) {
  const ErrorMeasures e = measure_errors(levels({0, -3, -inf, -9}, {0, -3, -inf, -9}), 20.0);
  for (const double value : {e.rms_db, e.mean_abs_db, e.median_abs_db, e.p95_abs_db, e.largest_abs_db, e.bias_db, e.austin_db})
    EXPECT_EQ(value, 0.0);
  EXPECT_DOUBLE_EQ(e.correlation, 1.0);
}

TEST(MeasuredErrors, CurvesThatDoNotVaryDoNotCorrelate) {
  EXPECT_TRUE(std::isnan(measure_errors(levels({1, 2, 3}, {5, 5, 5}), 20.0).correlation));
  EXPECT_TRUE(std::isnan(measure_errors(levels({1}, {5}), 20.0).correlation));
  EXPECT_DOUBLE_EQ(correlation(std::vector{1.0, 2.0, 3.0}, std::vector{-2.0, -4.0, -6.0}), -1.0);
}

TEST(MeasuredErrors, QuantilesLieBetweenNeighbours) {
  EXPECT_EQ(quantile({3, 1, 2}, 0.5), 2.0);
  EXPECT_EQ(quantile({4, 1, 2, 3}, 0.5), 2.5);
  EXPECT_EQ(quantile({7}, 0.95), 7.0);
  EXPECT_EQ(quantile({inf, inf, 1}, 0.75), inf);
  EXPECT_EQ(quantile({inf, 1, 1}, 0.5), 1.0);
}

CurvePair bell(double shift, double step, int points) {
  CurvePair pair;
  for (int i = 0; i < points; ++i) {
    const double x = i * step, centre = 0.5 * (points - 1) * step;
    const auto value = [&](double at) { return std::exp(-(at - centre) * (at - centre) / 8.0); };
    pair.x.push_back(x), pair.a.push_back(value(x - shift)), pair.b.push_back(value(x));
  }
  return pair;
}

TEST(CurveLag, FindsWholeStepsAndFractionsByTheParabola) {
  EXPECT_NEAR(best_lag({bell(0.0, 0.5, 61)}), 0.0, 1e-12);
  EXPECT_NEAR(best_lag({bell(1.5, 0.5, 61)}), 1.5, 0.01);  // the ends that do not overlap pull a little
  EXPECT_NEAR(best_lag({bell(-2.2, 0.5, 61)}), -2.2, 0.01);
  EXPECT_NEAR(best_lag({bell(0.7, 0.5, 61), bell(0.7, 0.5, 41)}), 0.7, 0.01);
}

TEST(CurveLag, ThinsToNothing) {
  EXPECT_TRUE(std::isnan(best_lag({bell(0.0, 0.5, 4)})));                                             // too few points
  EXPECT_TRUE(std::isnan(best_lag({{{0, 1, 2, 3, 4, 5}, {1, 1, 1, 1, 1, 1}, {1, 2, 3, 4, 5, 6}}})));  // flat
  EXPECT_TRUE(std::isnan(best_lag({bell(7.0, 0.5, 41)})));                                   // beyond a quarter of the curve
  EXPECT_TRUE(std::isnan(best_lag({{{3, 3, 3, 3, 3}, {1, 2, 3, 4, 5}, {1, 2, 3, 4, 5}}})));  // one place
}

TEST(CurveLag, CurvesThatAreNotAlikeHaveNone) {
  CurvePair pair;
  for (int i = 0; i < 60; ++i) pair.x.push_back(i), pair.a.push_back(i * 37 % 11), pair.b.push_back(i * i % 13);
  EXPECT_TRUE(std::isnan(best_lag({pair})));
}

TEST(CurveLag, UnevenStepsAreTakenLinearly) {
  CurvePair pair;
  for (double x = 0.0; x < 30.0; x += x < 12.0 ? 0.1 : 0.25) {
    const auto value = [](double at) { return std::sin(0.6 * at) + 0.1 * at; };
    pair.x.push_back(x), pair.a.push_back(value(x - 0.4)), pair.b.push_back(value(x));
  }
  EXPECT_NEAR(best_lag({pair}), 0.4, 0.02);
}

}  // namespace
}  // namespace raytube
