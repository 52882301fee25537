// Studies over density: errors made to measure must be found again.
#include <gmock/gmock.h>

#include <cmath>

#include "output/compare/convergence.h"
#include "output/compare/convergence_report.h"
#include "output/compare/error_measures.h"
#include "run.h"
#include "scratch.h"

namespace raytube {
namespace {

using namespace raytube::testing;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::size_t rows = 8;

// S of every row is 1 + j in VV and half of it in HH; `error` is added to VV.
template <typename Error>
std::vector<DensityResult> results(const std::vector<double>& densities, Error error) {
  std::vector<DensityResult> all;
  for (std::size_t i = 0; i < densities.size(); ++i) {
    DensityResult& result = all.emplace_back(DensityResult{densities[i], 10, 20, 0.5, {}});
    for (std::size_t row = 0; row < rows; ++row) {
      const Complex exact(1.0, 1.0);
      result.total.push_back({{{{exact + error(i, row), 0.0}, {0.0, 0.5 * exact}}}});
    }
  }
  return all;
}

// One error vector that shrinks with order p.
auto parallel(const std::vector<double>& densities, double order) {
  return [densities, order](std::size_t i, std::size_t row) {
    return 0.1 * std::polar(1.0, 0.7 * static_cast<double>(row)) * std::pow(densities[i], -order);
  };
}

// Errors of size n^-p that have nothing to do with one another: each density errs in a row of its own.
auto independent(const std::vector<double>& densities, double order) {
  return [densities, order](std::size_t i, std::size_t row) { return Complex(row == i ? std::pow(densities[i], -order) : 0.0); };
}

double distance_from_exact(const std::vector<ScatteringMatrix>& total) {
  double sum = 0.0;
  for (const ScatteringMatrix& s : total) sum += std::norm(s.vv() - Complex(1.0, 1.0));
  return std::sqrt(sum);
}

TEST(Convergence, ParallelErrorsGiveOrderValueAndUncertainty) {
  const std::vector<std::vector<double>> choices = {{2, 4, 8, 16}, {2, 3, 7}, {5, 6, 7, 20}};
  for (const auto& densities : choices)
    for (const double order : {0.8, 1.5, 2.0}) {
      const auto all = results(densities, parallel(densities, order));
      const Convergence study = study_convergence(all);
      ASSERT_TRUE(study.extrapolation);
      EXPECT_NEAR(study.extrapolation->order, order, 1e-9);
      EXPECT_NEAR(study.extrapolation->mean_order, order, 1e-9);
      EXPECT_LE(distance_from_exact(study.extrapolation->total), 1e-12);
      const double size = std::sqrt(rows * (2.0 + 0.5)), finest = distance_from_exact(all.back().total) / size;
      EXPECT_NEAR(study.extrapolation->relative_uncertainty, finest, 1e-3 * finest);
      EXPECT_NEAR(study.densities.back().relative_error, finest, 1e-3 * finest);
      EXPECT_NEAR(study.densities.front().relative_error, distance_from_exact(all.front().total) / size, 1e-9);
    }
}

TEST(Convergence, IndependentErrorsKeepTheOrderButAreHardlyExtrapolated) {
  const std::vector<double> densities = {4, 8, 16};
  const auto all = results(densities, independent(densities, 1.5));
  const Convergence study = study_convergence(all);
  // sqrt((e2^2 + e3^2) / (e1^2 + e2^2)) = 8^-1/2 again.
  EXPECT_NEAR(study.extrapolation->order, 1.5, 1e-9);
  // By hand: rho = 0, w = -1/9, e2^2 = 8 e3^2.
  const double finest = distance_from_exact(all.back().total);
  EXPECT_NEAR(distance_from_exact(study.extrapolation->total) / finest, std::sqrt(64.0 + 8.0) / 9.0, 1e-9);
  EXPECT_NEAR(study.extrapolation->relative_uncertainty * std::sqrt(rows * 2.5) / finest, 1.0, 0.01);
}

// Every error is part common, part its own; the common part has the size sqrt(rho).
TEST(Convergence, PartlyParallelErrorsAreEstimatedToo) {
  for (const std::vector<double>& densities : {std::vector<double>{4, 8, 16}, {3, 9, 27}}) {
    const double rho = 0.6;
    const auto all = results(densities, [&](std::size_t i, std::size_t row) {
      const double own = row == i ? std::sqrt(1.0 - rho) : 0.0, common = row == 7 ? std::sqrt(rho) : 0.0;
      return Complex((own + common) * std::pow(densities[i], -1.5));
    });
    const Extrapolation e = study_convergence(all).extrapolation.value();
    const double finest = distance_from_exact(all.back().total);
    EXPECT_NEAR(e.relative_uncertainty * std::sqrt(rows * 2.5) / finest, 1.0, 0.01);
    EXPECT_LT(distance_from_exact(e.total), 0.98 * finest);
  }
}

TEST(Convergence, ErrorsThatAlternateAreTakenAsIndependent) {
  std::vector<DensityResult> all;
  for (const auto& [n, s] : {std::pair{2.0, 1.2}, {4.0, 0.9}, {8.0, 1.05}})
    all.push_back({n, 0, 0, 0.0, {{{{{s, 0.0}, {0.0, 0.0}}}}}});
  const Convergence study = study_convergence(all);
  EXPECT_NEAR(study.extrapolation->order, 1.0, 1e-9);
  EXPECT_NEAR(study.extrapolation->total[0].vv().real(), 1.05 - 0.15 / 5.0, 1e-9);
  EXPECT_NEAR(study.extrapolation->strongest_uncertainty, 0.15 / std::sqrt(5.0), 1e-9);
}

TEST(Convergence, ChangesAndNormsByHand) {
  const auto all =
      results({1, 2}, [](std::size_t i, std::size_t row) { return Complex(row == 0 ? (i == 0 ? 3.0 : -1.0) : 0.0); });
  const Convergence study = study_convergence(all);
  ASSERT_EQ(study.densities.size(), 2u);
  EXPECT_DOUBLE_EQ(study.densities[0].change, 4.0);
  EXPECT_DOUBLE_EQ(study.densities[0].norm, std::sqrt(17.0 + 7 * 2.0 + 8 * 0.5));
  EXPECT_DOUBLE_EQ(study.densities[1].norm, std::sqrt(1.0 + 7 * 2.0 + 8 * 0.5));
  EXPECT_DOUBLE_EQ(study.densities[0].relative_change, 4.0 / study.densities[1].norm);
  EXPECT_TRUE(std::isnan(study.densities[1].change));
  EXPECT_FALSE(study.extrapolation);
  EXPECT_FALSE(study.recommended);
  EXPECT_EQ(study.strongest_row, 1u);
  EXPECT_EQ(study.strongest_channel, 0);
}

// S = 1 + 1/n in one row and order 1: 20 log10(1 + 1/n) dB exactly.
TEST(Convergence, RecommendsTheCoarsestThatIsFineEnough) {
  const std::vector<double> densities = {25, 50, 100, 200};
  std::vector<DensityResult> all;
  for (const double n : densities) all.push_back({n, 0, 0, 0.0, {{{{{1.0 + 1.0 / n, 0.0}, {0.0, 0.0}}}}}});
  const Convergence study = study_convergence(all);
  ASSERT_TRUE(study.recommended);
  EXPECT_EQ(*study.recommended, 2u);  // 0.34, 0.17, 0.086, 0.043 dB
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(study.densities[i].rms_db, 20.0 * std::log10(1.0 + 1.0 / densities[i]), 3e-4);
}

TEST(Convergence, OtherwisePredictsTheDensity) {
  std::vector<DensityResult> all;
  for (const double n : {5.0, 10.0, 20.0}) all.push_back({n, 0, 0, 0.0, {{{{{1.0 + 1.0 / n, 0.0}, {0.0, 0.0}}}}}});
  const Convergence study = study_convergence(all);
  EXPECT_FALSE(study.recommended);
  EXPECT_NEAR(study.extrapolation->next_density, 86.4, 2.0);  // 1 / (10^(0.1 / 20) - 1), but for the curve of the logarithm
}

TEST(Convergence, ALuckyDensityBetweenWorseOnesIsNotRecommended) {
  std::vector<DensityResult> all;
  for (const auto& [n, error] : {std::pair{2.0, 0.0001}, {4.0, 0.04}, {8.0, 0.01}, {16.0, 0.0025}})
    all.push_back({n, 0, 0, 0.0, {{{{{1.0 + error, 0.0}, {0.0, 0.0}}}}}});
  EXPECT_EQ(study_convergence(all).recommended, 2u);
}

TEST(Convergence, AgreementToRoundingHasNoOrder) {
  const Convergence study = study_convergence(
      results({2, 4, 8}, [](std::size_t i, std::size_t row) { return Complex(1e-15 * static_cast<double>(i * 5 % 3 + row)); }));
  EXPECT_TRUE(std::isnan(study.extrapolation->order));
  EXPECT_LE(study.extrapolation->relative_uncertainty, 1e-13);
  EXPECT_EQ(study.recommended, 0u);
}

TEST(Convergence, NothingComingBackIsNoTrouble) {
  std::vector<DensityResult> all;
  for (const double n : {1.0, 2.0, 3.0}) all.push_back({n, 0, 0, 0.0, std::vector<ScatteringMatrix>(2)});
  const Convergence study = study_convergence(all);
  EXPECT_EQ(study.densities[0].relative_change, 0.0);
  EXPECT_EQ(study.densities[2].rms_db, 0.0);
  const Sweep sweep = monostatic({{0.1, 0.2}, {0.1, 0.3}}, 1e9);
  EXPECT_THAT(convergence_text({"t", sweep, all, study}), HasSubstr("extrapolated    zero: no return in any row"));
}

TEST(Convergence, ChangesThatGrowAreNotTrusted) {
  std::vector<DensityResult> all;
  for (const auto& [n, s] : {std::pair{2.0, 1.0}, {4.0, 1.1}, {8.0, 1.4}})
    all.push_back({n, 0, 0, 0.0, {{{{{s, 0.0}, {0.0, 0.0}}}}}});
  const Convergence study = study_convergence(all);
  EXPECT_NEAR(study.extrapolation->order, -std::log2(3.0), 1e-9);
  EXPECT_NEAR(study.extrapolation->relative_uncertainty, 0.3 / 1.4 / (std::sqrt(2.0) - 1.0), 1e-12);  // as of order 0.5
}

class Reported : public ::testing::Test {
 protected:
  Reported() {
    for (const double phi : {0, 1, 2, 3, 4, 5, 6, 7})
      sweep.looks.push_back({{90 * degree, phi * degree}, {90 * degree, phi * degree}});
    const std::vector<double> densities = {2, 4, 8};
    study.results = results(densities, parallel(densities, 2.0));
    study.convergence = study_convergence(study.results);
  }
  Sweep sweep{{1e10}, {}, false};
  ConvergenceStudy study{"t", sweep, {}, {}};
  Scratch scratch;
};

TEST_F(Reported, TextSaysWhatToDo) {
  const std::string text = convergence_text(study);
  EXPECT_THAT(text, HasSubstr("order           2.00, from 2, 4 and 8 tubes per wavelength; 2.00 on average over all\n"));
  EXPECT_THAT(text,
              HasSubstr("extrapolated    S_vv = 1 + 1j m +- 0.0016 m, 14.002399 dBsm +- 0.0096 dB at 10 GHz, θ = 90°, φ = "));
  EXPECT_THAT(text,
              HasSubstr("recommendation  tubes.per_wavelength = 4, the coarsest below 0.1 dB rms within 20 dB of the peak"));
}

TEST_F(Reported, CsvHasOneRowADensity) {
  write_converge_csv(scratch / "converge.csv", study);
  const Table csv((scratch / "converge.csv").string());
  ASSERT_EQ(csv.rows(), 3u);
  EXPECT_EQ(csv.text(1, "per_wavelength"), "4");
  EXPECT_EQ(csv.text(1, "tubes"), "10");
  EXPECT_EQ(csv.text(1, "rays"), "20");
  EXPECT_EQ(csv.text(1, "solve_s"), "0.5");
  EXPECT_EQ(csv.number(1, "re_m"), study.results[1].total[study.convergence.strongest_row].vv().real());
  EXPECT_EQ(csv.text(1, "observed_order"), "nan");
  EXPECT_NEAR(csv.number(2, "observed_order"), 2.0, 1e-9);
  EXPECT_EQ(csv.text(2, "change_to_next_m"), "nan");
  EXPECT_THAT(text_of(scratch / "converge.csv"), HasSubstr("# recommendation  tubes.per_wavelength = 4"));
}

}  // namespace
}  // namespace raytube
