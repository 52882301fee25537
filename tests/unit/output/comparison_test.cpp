// Tables from elsewhere: what is accepted, which rows and channels are compared, what is said about them.
#include "output/compare/comparison.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "core/error.h"
#include "output/compare/comparison_report.h"
#include "output/tables/csv.h"
#include "run.h"
#include "scratch.h"

namespace raytube {
namespace {

using namespace raytube::testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::Pair;

using Key = ResultTable;

class Compared : public ::testing::Test {
 protected:
  ResultTable table(const std::string& name, const std::string& text) const {
    return read_result_table(scratch.write(name, text));
  }

  Comparison compared(const std::string& result, const std::string& reference, double within_db = 20.0) const {
    return compare_results(table("a.csv", result), table("b.csv", reference), within_db);
  }

  std::string complaint(const std::string& result, const std::string& reference) const {
    try {
      compared(result, reference);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  Scratch scratch;
};

const std::string levels = "phi_deg,sigma_vv_dbsm\n0,10\n1,8\n2,-inf\n";

TEST_F(Compared, ReadsItsOwnTables) {
  const Sweep sweep{{1e9, 2e9}, {{{0.5, 0.1}, {0.5, 0.1}}, {{0.5, 0.2}, {0.5, 0.2}}}, false};
  SweepResult result;
  result.error.resize(4), result.model.resize(4);
  for (int i = 1; i <= 4; ++i) result.total.push_back({{{{Complex(i, -1.0), 0.0}, {0.0, Complex(0.1 * i)}}}});
  write_rcs_csv(scratch / "rcs.csv", sweep, result);
  const ResultTable read = read_result_table(scratch / "rcs.csv");
  ASSERT_EQ(read.rows.size(), 4u);
  EXPECT_THAT(read.has_key, ElementsAre(true, true, true, true, true, false));
  EXPECT_THAT(read.has_phase, ElementsAre(true, true, true, true));
  EXPECT_EQ(read.rows[3].key[Key::frequency], 2e9);
  EXPECT_NEAR(read.rows[3].key[Key::rx_phi], 0.2 / degree, 1e-12);
  EXPECT_EQ(read.rows[3].s[0], Complex(4.0, -1.0));
  EXPECT_EQ(read.rows[3].sigma_dbsm[1], sigma_dbsm(0.0));
}

TEST_F(Compared, ReadsForeignTables) {
  const ResultTable read = table("f.csv", "Theta_deg;FREQ_GHz;note;Sigma_HH_dBsm\n90;9.5;a b;-Inf\n91;9.5;;-3\n");
  EXPECT_THAT(read.has_key, ElementsAre(true, true, false, true, false, false));
  EXPECT_THAT(read.has_channel, ElementsAre(false, false, false, true));
  EXPECT_THAT(read.has_phase, ElementsAre(false, false, false, false));
  EXPECT_EQ(read.rows[0].key[Key::frequency], 9.5e9);
  EXPECT_EQ(read.rows[0].sigma_dbsm[3], sigma_dbsm(0.0));
  EXPECT_EQ(read.rows[1].key[Key::rx_theta], 91.0);  // monostatic
}

TEST_F(Compared, IncidenceColumnsMakeTheOthersTheReceiver) {
  const ResultTable read = table("f.csv", "theta_deg,phi_deg,theta_i_deg,phi_i_deg,re_vv,im_vv\n1,2,3,4,5,6\n");
  EXPECT_THAT(read.rows[0].key, ElementsAre(0, 3, 4, 1, 2, 0));
}

TEST_F(Compared, AmplitudesGoBeforeLevels) {
  const ResultTable read = table("f.csv", "phi_deg,sigma_vv_dbsm,re_vv,im_vv\n0,99,1,0\n");
  EXPECT_EQ(read.rows[0].sigma_dbsm[0], sigma_dbsm(1.0));
}

TEST_F(Compared, RowsAreMatchedByValueNotByPlace) {
  const Comparison c = compared("phi_deg,sigma_vv_dbsm\n2,3\n0,1\n5,9\n1,2\n", "phi_deg,sigma_vv_dbsm\n0,1\n1,2\n2,3\n3,4\n");
  EXPECT_THAT(c.match.common, ElementsAre(Pair(0, 2), Pair(1, 0), Pair(3, 1)));
  EXPECT_EQ(c.errors[0].rms_db, 0.0);
  EXPECT_THAT(comparison_text(c), HasSubstr("left out    1 rows of the result, 1 of the reference"));
}

TEST_F(Compared, AngleAndFrequencyTolerance) {
  const std::string reference = "freq_hz,phi_deg,sigma_vv_dbsm\n1e10,54.7356,0\n1e10,60,0\n";
  EXPECT_EQ(compared("freq_ghz,phi_deg,sigma_vv_dbsm\n10.000001,54.735610317,0\n10.000001,60.00009,0\n", reference).rows(), 2u);
  EXPECT_EQ(compared("freq_ghz,phi_deg,sigma_vv_dbsm\n10.0001,54.7356,0\n10.0000,60,0\n", reference).rows(), 1u);
  EXPECT_EQ(compared("freq_ghz,phi_deg,sigma_vv_dbsm\n10,54.7359,0\n10,60,0\n", reference).rows(), 1u);
}

TEST_F(Compared, StepsFinerThanTheToleranceAreKeptApart) {
  const Comparison c =
      compared("phi_deg,sigma_vv_dbsm\n0,1\n0.00004,2\n0.00008,3\n", "phi_deg,sigma_vv_dbsm\n0.00004,2\n0.00008,3\n");
  EXPECT_THAT(c.match.common, ElementsAre(Pair(1, 0), Pair(2, 1)));
}

TEST_F(Compared, FullTurnsDoNotMatter) {
  const Comparison c = compared("phi_deg,sigma_vv_dbsm\n-10,1\n-180,2\n0,3\n", "phi_deg,sigma_vv_dbsm\n350,1\n180,2\n720,3\n");
  EXPECT_EQ(c.rows(), 3u);
  EXPECT_EQ(c.errors[0].rms_db, 0.0);
  EXPECT_THAT(c.cuts.cuts[0].x, ElementsAre(-180, -10, 0));
}

TEST_F(Compared, RepeatedRowsPairInOrder) {
  const Comparison c = compared("phi_deg,sigma_vv_dbsm\n0,1\n0,2\n1,5\n", "phi_deg,sigma_vv_dbsm\n0,1\n1,5\n0,2\n0,3\n");
  EXPECT_THAT(c.match.common, ElementsAre(Pair(0, 0), Pair(1, 2), Pair(2, 1)));
}

TEST_F(Compared, AColumnOfOneFileAloneMustHoldOneValue) {
  const std::string swept = "freq_hz,phi_deg,sigma_vv_dbsm\n1e9,0,10\n1e9,1,8\n2e9,0,10\n";
  EXPECT_THAT(complaint(swept, levels), HasSubstr("a.csv: freq_hz runs from 1000000000 to 2000000000 but"));
  EXPECT_THAT(complaint(levels, swept), HasSubstr("a.csv has no such column"));
  ResultTable one = table("a.csv", swept);
  keep_rows(one, Key::frequency, 1e9, 1e9);
  const Comparison c = compare_results(one, table("b.csv", levels), 20.0);
  EXPECT_EQ(c.rows(), 2u);
  EXPECT_THAT(comparison_text(c), HasSubstr("largest in vv: 1 GHz, φ = 0°"));
}

TEST_F(Compared, OnlyKeepsEndsAndTablesWithoutTheColumn) {
  ResultTable read = table("a.csv", levels);
  keep_rows(read, Key::theta, 5, 6);
  EXPECT_EQ(read.rows.size(), 3u);
  keep_rows(read, Key::phi, 1, 2);
  EXPECT_EQ(read.rows.size(), 2u);
  EXPECT_THROW(keep_rows(read, Key::phi, 7, 8), InputError);
}

TEST_F(Compared, OnlyFindsAnAzimuthByFullTurnsAndTakesThemOff) {
  const std::string cut = "phi_deg,sigma_vv_dbsm\n0,3\n10,1\n100,4\n340,1\n350,2\n-370,5\n";
  ResultTable read = table("a.csv", cut);
  keep_rows(read, Key::phi, -45, 45);
  const Comparison c = compare_results(read, read, 20.0);
  EXPECT_THAT(c.cuts.cuts[0].x, ElementsAre(-20, -10, -10, 0, 10));  // one curve, and monostatic still
  EXPECT_EQ(c.coordinates.told[RowCoordinates::rx_phi], false);
  keep_rows(read, Key::phi, 350, 350);
  EXPECT_EQ(read.rows.size(), 2u);
}

TEST_F(Compared, ChannelsOfBothAreComparedTheOthersNamed) {
  const Comparison c = compared("phi_deg,sigma_vv_dbsm,sigma_vh_dbsm\n0,10,1\n", "phi_deg,sigma_vv_dbsm,sigma_hh_dbsm\n0,11,1\n");
  EXPECT_THAT(c.compared, ElementsAre(true, false, false, false));
  EXPECT_THAT(comparison_text(c), HasSubstr("vh: in the result alone\n"));
  EXPECT_THAT(comparison_text(c), HasSubstr("hh: in the reference alone\n"));
}

TEST_F(Compared, RoundingDustIsNoSignal) {
  const Comparison c = compared("phi_deg,sigma_vv_dbsm,sigma_vh_dbsm\n0,10,-60\n1,9,-60\n",
                                "phi_deg,sigma_vv_dbsm,sigma_vh_dbsm\n0,10,-71\n1,9,-300\n");
  EXPECT_THAT(c.signal, ElementsAre(true, false, false, false));
  EXPECT_EQ(above_tolerance(c, 0.0), "");
  EXPECT_THAT(comparison_text(c),
              HasSubstr("vh: no signal in the reference (peak -71 dBsm, more than 80 dB below the highest); the "
                        "result's peak is -60 dBsm"));
}

TEST_F(Compared, AStrongSignalInTheResultAloneIsAboveAnyTolerance) {
  const std::string two = "phi_deg,sigma_vv_dbsm,sigma_vh_dbsm\n";
  const Comparison c = compared(two + "0,10,-9\n", two + "0,10,-inf\n");
  EXPECT_EQ(above_tolerance(c, 1e6), "vh inf dB");
  EXPECT_THAT(comparison_text(c), HasSubstr("the result's peak is -9 dBsm, above any tolerance\n"));
  EXPECT_EQ(above_tolerance(compared(two + "0,10,-11\n", two + "0,10,-inf\n"), 0.0), "");  // not within 20 dB
}

TEST_F(Compared, ToleranceNamesTheChannelsAboveIt) {
  const std::string two = "phi_deg,sigma_vv_dbsm,sigma_hh_dbsm\n";
  const Comparison c = compared(two + "0,10.25,3\n", two + "0,10,4\n");
  EXPECT_EQ(above_tolerance(c, 0.1), "vv 0.25 dB, hh 1 dB");
  EXPECT_EQ(above_tolerance(c, 0.25), "hh 1 dB");
  EXPECT_EQ(above_tolerance(c, 1.0), "");
  EXPECT_EQ(above_tolerance(compared(two + "0,-inf,4\n", two + "0,10,4\n"), 1e6), "vv inf dB");
}

TEST_F(Compared, CsvHoldsWhatTheScreenShows) {
  const Comparison c =
      compared("theta_deg,phi_deg,re_vv,im_vv\n90,0,1,0\n90,1,0.5,0\n", "theta_deg,phi_deg,re_vv,im_vv\n90,0,1,0\n90,1,0.25,0\n");
  write_compare_csv(scratch / "compare.csv", c);
  const Table csv((scratch / "compare.csv").string());
  ASSERT_EQ(csv.rows(), 1u);
  EXPECT_EQ(csv.text(0, "channel"), "vv");
  EXPECT_EQ(csv.text(0, "rows"), "2");
  EXPECT_EQ(csv.text(0, "rows_within"), "2");
  EXPECT_DOUBLE_EQ(csv.number(0, "largest_abs_db"), c.errors[0].largest_abs_db);
  EXPECT_DOUBLE_EQ(csv.number(0, "relative_error"), 0.25 / std::sqrt(1.0625));
  EXPECT_EQ(csv.text(0, "largest_phi_deg"), "1");
  EXPECT_EQ(csv.text(0, "largest_freq_hz"), "nan");
  EXPECT_EQ(csv.text(0, "lag_unit"), "phi_deg");
}

TEST_F(Compared, BistaticRowsAreDrawnOverTheReceiver) {
  const std::string text = "theta_deg,phi_deg,rx_theta_deg,rx_phi_deg,sigma_vv_dbsm\n90,0,90,0,1\n90,0,90,1,2\n90,0,90,2,3\n";
  const Comparison c = compared(text, text);
  EXPECT_EQ(c.cuts.quantity, RowCoordinates::rx_phi);
  EXPECT_EQ(c.cuts.cuts[0].fixed, "θ = 90°, φ = 0°, receiver θ = 90°");
}

// Pulses come faster than any tolerance of other keys, and are drawn over their times.
TEST_F(Compared, RowsAreMatchedByTime) {
  const std::string head = "freq_hz,phi_deg,sigma_vv_dbsm,time_s\n";
  const Comparison c = compared(head + "1e9,0,1,0\n1e9,0,2,2e-5\n1e9,0,3,4e-5\n", head + "1e9,0,3,4e-5\n1e9,0,2,2.000001e-5\n");
  ASSERT_EQ(c.rows(), 2u);
  EXPECT_EQ(c.errors[0].largest_abs_db, 0.0);
  EXPECT_EQ(c.cuts.quantity, RowCoordinates::time);
  EXPECT_THAT(comparison_text(c), HasSubstr("1e-09 s"));
}

TEST_F(Compared, ListsInNoOrderHaveNoLag) {
  std::string text = "theta_deg,phi_deg,sigma_vv_dbsm\n";
  for (int i = 0; i < 9; ++i) text += fmt::format("{},{},{}\n", 10 + i * i, i * 37 % 90, i % 4);
  EXPECT_TRUE(std::isnan(compared(text, text).lag[0]));
  EXPECT_THAT(comparison_text(compared(text, text)), Not(HasSubstr("lag")));
}

TEST_F(Compared, BadTables) {
  const std::vector<std::pair<std::string, std::string>> bad = {
      {"", "a.csv: holds no table"},
      {"# only words\n", "a.csv: holds no table"},
      {"0,10\n1,8\n", "a.csv, line 1: no header"},
      {"phi_deg,sigma_vv_dbsm\n", "a.csv: no rows below the header"},
      {"# c\nangle,sigma_vv_dbsm\n0,1\n", "a.csv, line 2: no column to match rows by"},
      {"phi_deg,rcs\n0,1\n", "a.csv, line 1: no channel"},
      {"phi_deg,re_vv,sigma_vv_dbsm\n0,1,1\n", "re_vv and im_vv go together"},
      {"phi_deg,phi_deg,sigma_vv_dbsm\n0,0,1\n", "two columns are named phi_deg"},
      {"phi_deg,sigma_vv_dbsm\n0,1\n1,ten\n", "a.csv, line 3, column sigma_vv_dbsm: \"ten\" is not a finite number"},
      {"phi_deg,sigma_vv_dbsm\n0,inf\n", "\"inf\" is not a finite number"},
      {"phi_deg,sigma_vv_dbsm\n0,nan\n", "\"nan\" is not a finite number"},
      {"phi_deg,re_vv,im_vv\n0,-inf,0\n", "line 2, column re_vv"},
      {"phi_deg,sigma_vv_dbsm\n,1\n", "line 2, column phi_deg: \"\""},
      {"phi_deg,sigma_vv_dbsm\n0\n", "1 values where the header names 2 columns"},
      {"freq_hz,phi_deg,sigma_vv_dbsm\n0,0,1\n", "a.csv, line 2: the frequency must be greater than 0"},
      {"phi_deg,sigma_vv_dbsm\n7,1\n8,1\n", "have no row in common (phi_deg 7 to 8 against 0 to 2, "},
      {"theta_deg,sigma_vv_dbsm\n7,1\n", "b.csv: phi_deg runs from 0 to 2 but"},
      {"phi_deg,sigma_hh_dbsm\n0,1\n", "have no channel in common"},
  };
  for (const auto& [text, says] : bad) EXPECT_THAT(complaint(text, levels), HasSubstr(says)) << text;
  EXPECT_THAT(complaint("theta_deg,sigma_vv_dbsm\n7,1\n", "phi_deg,sigma_vv_dbsm\n0,1\n"), HasSubstr("no column in common"));
  EXPECT_THAT(complaint(levels, "phi_deg,sigma_vv_dbsm\n0,-inf\n"), HasSubstr("b.csv: zero in every row and channel compared"));
}

}  // namespace
}  // namespace raytube
