// The words at the end of a run.
#include <gmock/gmock.h>

#include "output/words/summary.h"

namespace raytube {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// Rows of these amplitudes, and errors that are shares of them.
SweepResult rows(const std::vector<std::array<double, 4>>& amplitudes, const std::vector<std::array<double, 4>>& shares) {
  SweepResult result;
  for (std::size_t i = 0; i < amplitudes.size(); ++i) {
    const auto& [vv, vh, hv, hh] = amplitudes[i];
    result.total.push_back({{{{Complex(vv), Complex(vh)}, {Complex(hv), Complex(hh)}}}});
    ChannelErrors error{};
    for (std::size_t c = 0; c < 4; ++c) error[c / 2][c % 2] = shares[i][c] * amplitudes[i][c];
    result.error.push_back(error);
  }
  return result;
}

RunFacts facts() { return {.folder = "out"}; }

// 20 log10(1 + x) of shares 0.01, 0.02, 0.5 and 0.001: 0.086, 0.17, 3.5 and 0.0087 dB.
TEST(Summary, LowChannelsAreToldApart) {
  const SweepResult result =
      rows({{1.0, 0.11, 0.11, 1.0}, {1.0, 0.09, 0.09, 0.05}}, {{0.01, 0.02, 0.01, 0.01}, {0.001, 0.1, 0.5, 0.1}});
  EXPECT_THAT(
      summary_text(result, facts()),
      HasSubstr("numerical error    at most VV, HH 0.086 dB; VH, HV 0.17 dB; 3.5 dB where 20 dB and more below the strongest "
                "channel\n"));
  EXPECT_THAT(summary_text(rows({{1.0, 0.0, 0.0, 1.0}}, {{0.001, 0.0, 0.0, 0.001}}), facts()),
              HasSubstr("numerical error    at most VV, HH 0.0087 dB; 0 dB where"));
  EXPECT_THAT(summary_text(rows({{0.0, 0.0, 0.0, 0.0}}, {{0.0, 0.0, 0.0, 0.0}}), facts()), HasSubstr("no return"));
}

TEST(Summary, RowsAboveTheToleranceComeWithTheRemedy) {
  const auto text = [](double share, const RunFacts& run) {
    SweepResult result = rows({{1.0, 0.0, 0.0, 1.0}, {1.0, 0.0, 0.0, 1.0}}, {{share, 0.0, 0.0, 0.0}, {}});
    result.statistics.truncated[Truncation::bounces] = {3, 0.1};
    return summary_text(result, run);
  };
  RunFacts run = facts();
  const double limit = std::pow(10.0, run.tubes.tolerance_db / 20.0) - 1.0;
  EXPECT_THAT(text(0.999 * limit, run), Not(HasSubstr("above tolerance")));
  EXPECT_THAT(text(1.001 * limit, run),
              HasSubstr("above tolerance    1 of 2 rows (accuracy.tolerance_db = 0.1): raise tubes.per_wavelength (40)\n"));
  run.materials = true;
  EXPECT_THAT(text(1.001 * limit, run), HasSubstr("raise tubes.per_wavelength (40) or tubes.max_bounces (8)\n"));
  run.tubes.mode = TubeMode::uniform;
  EXPECT_THAT(text(1.001 * limit, run), Not(HasSubstr("above tolerance")));
}

// 20 log10(1 + 0.2) = 1.6 dB: above the tolerance, and a fifth of the model uncertainty.
TEST(Summary, RowsThatTheModelUncertaintyPermitsAreToldByThemselves) {
  SweepResult result = rows({{1.0, 0.0, 0.0, 1.0}, {1.0, 0.0, 0.0, 1.0}}, {{0.2, 0.0, 0.0, 0.0}, {0.3, 0.0, 0.0, 0.0}});
  result.model = {{{{1.0, 0.0}, {0.0, 1.0}}}, {{{1.0, 0.0}, {0.0, 1.0}}}};
  EXPECT_THAT(summary_text(result, facts()),
              AllOf(HasSubstr("within model share 1 of 2 rows are above accuracy.tolerance_db = 0.1, but below 0.25 of the model "
                              "uncertainty (accuracy.model_share)\n"),
                    HasSubstr("above tolerance    1 of 2 rows")));
  RunFacts run = facts();
  run.tubes.model_share = 0.0;
  EXPECT_THAT(summary_text(result, run),
              AllOf(Not(HasSubstr("within model share")), HasSubstr("above tolerance    2 of 2 rows")));
}

TEST(Summary, TruncatedTubesByReason) {
  SweepResult result = rows({{1.0, 0.0, 0.0, 1.0}}, {{}});
  result.statistics.truncated[Truncation::bounces] = {12, 0.01};
  result.statistics.truncated[Truncation::width] = {3, 0.001};
  EXPECT_THAT(summary_text(result, facts()),
              AllOf(HasSubstr("truncated tubes    12 after tubes.max_bounces = 8: at most -20.0 dBsm left in a look, counted in "
                              "the model uncertainty; raise tubes.max_bounces\n"),
                    HasSubstr("truncated tubes    3 too wide off curved surfaces: at most -30.0 dBsm left in a look"),
                    Not(HasSubstr("too many"))));
}

// 20 log10(1 + 0.5) = 3.5 dB of the model beside 0.0087 dB of the numbers.
TEST(Summary, ModelUncertaintyIsNeverMixedWithTheNumericalError) {
  SweepResult result = rows({{1.0, 0.0, 0.0, 1.0}}, {{0.001, 0.0, 0.0, 0.001}});
  EXPECT_THAT(summary_text(result, facts()), Not(HasSubstr("model uncertainty")));
  result.model = {{{{0.5, 0.0}, {0.0, 0.5}}}};
  result.model_parts = {{"corners", "waves from corners", "none", 0.5, 0.62, 1},
                        {"edges", "waves from edges", "none", 0.1, 0.38, 0}};
  EXPECT_THAT(summary_text(result, facts()),
              AllOf(HasSubstr("numerical error    at most VV, HH 0.0087 dB;"),
                    HasSubstr("model uncertainty  within 40 dB of the peak: VV, HH median 3.5 dB, at most 3.5 dB\n"),
                    HasSubstr("\n                   mostly waves from corners (62 %)\n"),
                    Not(HasSubstr("edges (38"))));
}

// Of 20 dB below the peak, a level of 0.5 is 3.5 dB and one of 0.1 is 0.83 dB; one row is 46 dB below, and all of it uncertain.
TEST(Summary, MedianAndMaximumAreOfTheSameRows) {
  SweepResult result = rows({{1.0, 0.0, 0.0, 1.0}, {0.1, 0.02, 0.001, 0.005}}, {{}, {}});
  result.model = {{{{0.1, 0.0}, {0.0, 0.1}}}, {{{0.05, 0.01}, {1.0, 1.0}}}};
  EXPECT_THAT(summary_text(result, facts()), HasSubstr("within 40 dB of the peak: VV, HH median 0.83 dB, at most 3.5 dB; "
                                                       "VH, HV median 3.5 dB, at most 3.5 dB\n"));
  result.total = {{}, {}};
  EXPECT_THAT(summary_text(result, facts()), HasSubstr("model uncertainty  0 dB: no return\n"));
}

// A tenth of 0.1 dB of the weakest row within 40 dB of a peak of 1 m: 1.15e-5 m, -88 dBsm.
TEST(Summary, CutTubesThatDoNotMatterNeedNoRemedy) {
  const auto text = [](double dbsm) {
    SweepResult result = rows({{1.0, 0.0, 0.0, 1.0}}, {{}});
    result.statistics.truncated[Truncation::bounces] = {12, std::pow(10.0, dbsm / 10.0)};
    return summary_text(result, facts());
  };
  EXPECT_THAT(text(-87.0), HasSubstr("in the model uncertainty; raise tubes.max_bounces\n"));
  EXPECT_THAT(text(-89.0), HasSubstr("in the model uncertainty; too little to matter\n"));
}

TEST(Summary, OfManyLooksCountsAddUpAndTheLargestRemainsStays) {
  TruncatedSums all, first, second;
  first[Truncation::number] = {2, 0.5};
  second[Truncation::number] = {3, 0.25};
  add_look(all, first), add_look(all, second);
  EXPECT_EQ(all.tubes(), 5u);
  EXPECT_EQ(all.sigma(), 0.5);
}

TEST(Summary, LostRaysAreToldWithTheirPlace) {
  Statistics statistics;
  statistics.rays = 1000, statistics.lost_rays = 7, statistics.looks_with_lost_rays = 2;
  statistics.first_lost_rays = {{{0.5, -1.25, 2.0}, 12, 3, {0.5 * pi, 0.25 * pi}}};
  EXPECT_THAT(
      lost_rays_sentence(statistics, 1e-3, "mm"),
      HasSubstr("7 of 1000 rays met a closed body from inside or left a surface without a direction and ended there, in 2 looks, "
                "first at (500, -1250, 2000) mm "
                "on triangle 12 in look 3 (theta 90, phi 45): "));
}

TEST(Summary, PartsBeyondTheirBoundAreNamed) {
  EXPECT_THAT(beyond_bound_sentence({"later bounces", 2, 7, 10.0}),
              ::testing::HasSubstr("2 rows with more than the size of the target allows, row 7 by 20.0 dB"));
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THAT(beyond_bound_sentence({"later bounces", 1, 7, infinity}), ::testing::HasSubstr("1 row without a number"));
}

}  // namespace
}  // namespace raytube
