// Tables of other programs: columns of other names and units, magnitude and phase, a row for each transmit polarisation.
#include <gmock/gmock.h>

#include "core/error.h"
#include "output/compare/comparison_report.h"
#include "output/tables/column_map.h"
#include "output/tables/csv.h"
#include "scratch.h"

namespace raytube {
namespace {

using namespace raytube::testing;
using ::testing::HasSubstr;

ResultTable table_of(const std::string& text, const std::string& columns = "") {
  return read_result_table(Scratch().write("table.csv", text), parsed_column_map("--result-columns", columns));
}

std::string complaint(const std::string& text, const std::string& columns = "") {
  try {
    table_of(text, columns);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

const double root = std::sqrt(4.0 * pi);  // sqrt(sigma) of S = 1 m

TEST(ColumnMap, NamesFactorsAndOffsets) {
  const ColumnMap map = parsed_column_map("--x", "freq_hz=F*1e+9,theta_deg=el*-1+90,phi_deg=az+1e1,tx_pol=pol");
  ASSERT_EQ(map.size(), 4u);
  EXPECT_EQ(map[0].theirs, "f");
  EXPECT_EQ(map[0].factor, 1e9);
  EXPECT_EQ(map[1].factor, -1.0);
  EXPECT_EQ(map[1].offset, 90.0);
  EXPECT_EQ(map[2].offset, 10.0);
  EXPECT_EQ(map[3].ours, "tx_pol");
  EXPECT_TRUE(parsed_column_map("--x", "").empty());
}

TEST(ColumnMap, AForeignTableReadsAsOurs) {
  const ResultTable table = table_of("f;el;az;co;arg\n94;10;0.5;2;-90\n",
                                     "freq_hz=f*1e9,theta_deg=el*-1+90,phi_deg=az*57.29577951308232,magnitude_vv=co,"
                                     "phase_vv_rad=arg*-0.017453292519943295");
  ASSERT_EQ(table.rows.size(), 1u);
  const ResultTable::Row& row = table.rows[0];
  EXPECT_DOUBLE_EQ(row.key[ResultTable::frequency], 94e9);
  EXPECT_DOUBLE_EQ(row.key[ResultTable::theta], 80.0);
  EXPECT_DOUBLE_EQ(row.key[ResultTable::rx_phi], 0.5 / degree);
  EXPECT_NEAR(std::abs(row.s[0] - Complex(0.0, 2.0 / root)), 0.0, 1e-15);  // a phase turned by factor -1: 90 degrees, rounded
  EXPECT_TRUE(table.has_phase[0]);
  EXPECT_FALSE(table.has_channel[3]);
}

// Columns that change places are no circle: what is chosen is read, not what has the name.
TEST(ColumnMap, AChosenColumnGoesBeforeOneOfThatName) {
  const ResultTable table = table_of("theta_deg,phi_deg,sigma_vv_dbsm\n1,2,3\n", "theta_deg=phi_deg,phi_deg=theta_deg");
  EXPECT_EQ(table.rows[0].key[ResultTable::theta], 2.0);
  EXPECT_EQ(table.rows[0].key[ResultTable::phi], 1.0);
}

TEST(ColumnMap, NamesInQuotesHoldAnySign) {
  const ColumnMap map = parsed_column_map("--x", "sigma_vv_m2=\"RCS, +VV [m*m]\",phi_deg=\"Phi [deg]\"*-1+90");
  ASSERT_EQ(map.size(), 2u);
  EXPECT_EQ(map[0].theirs, "rcs, +vv [m*m]");
  EXPECT_EQ(map[0].factor, 1.0);
  EXPECT_EQ(map[1].theirs, "phi [deg]");
  EXPECT_EQ(map[1].factor, -1.0);
  EXPECT_EQ(map[1].offset, 90.0);
}

TEST(ColumnMap, UnitsBehindUnderscoresCount) {
  const std::string map = "freq_hz=f_ghz,phi_deg=az_rad,magnitude_vv=mag_m,phase_vv_rad=ph_deg";
  const ResultTable::Row row = table_of("f_ghz,az_rad,mag_m,ph_deg\n10,0.5,1,90\n", map).rows[0];
  EXPECT_EQ(row.key[ResultTable::frequency], 10e9);
  EXPECT_DOUBLE_EQ(row.key[ResultTable::phi], 0.5 / degree);
  EXPECT_NEAR(std::abs(row.s[0] - Complex(0.0, 1.0 / root)), 0.0, 1e-15);
  const ResultTable::Row factor = table_of("f_ghz,mag_m\n10,1\n", "freq_hz=f_ghz*1e6,magnitude_vv=mag_m").rows[0];
  EXPECT_EQ(factor.key[ResultTable::frequency], 10e6);  // what is said goes before a name
}

TEST(ColumnMap, UnitsOfHeadersCount) {
  const std::string text = "\"Freq [GHz]\",\"Phi [rad]\",\"RCS [dBsm]\",\"Arg (deg)\"\n10,0.5,0,90\n";
  const std::string map = "freq_hz=\"Freq [GHz]\",phi_deg=\"Phi [rad]\",sigma_vv_dbsm=\"RCS [dBsm]\",phase_vv_rad=\"Arg (deg)\"";
  const ResultTable::Row row = table_of(text, map).rows[0];
  EXPECT_EQ(row.key[ResultTable::frequency], 10e9);
  EXPECT_DOUBLE_EQ(row.key[ResultTable::phi], 0.5 / degree);
  EXPECT_NEAR(std::abs(row.s[0] - Complex(0.0, 1.0 / root)), 0.0, 1e-15);  // of 90 degrees, rounded
  EXPECT_EQ(table_of(text, "freq_hz=\"Freq [GHz]\"*1e6,sigma_vv_dbsm=\"RCS [dBsm]\"").rows[0].key[ResultTable::frequency], 10e6);
}

TEST(ColumnMap, SigmaInSquareMetres) {
  const ResultTable table = table_of("phi_deg,sigma_vv_m2\n0,100\n1,0\n");
  EXPECT_NEAR(table.rows[0].sigma_dbsm[0], 20.0, 1e-13);  // rounding of a root and two logarithms
  EXPECT_TRUE(std::isinf(table.rows[1].sigma_dbsm[0]));
}

TEST(ColumnMap, ALevelWithAPhaseIsAnAmplitude) {
  const ResultTable table = table_of("phi_deg,sigma_hh_dbsm,phase_hh_rad\n0,10,0.5\n1,-inf,0\n");
  EXPECT_NEAR(std::abs(table.rows[0].s[3] - std::polar(std::sqrt(10.0) / root, 0.5)), 0.0, 1e-15);  // rounding
  EXPECT_EQ(table.rows[0].sigma_dbsm[3], 10.0);
  EXPECT_EQ(table.rows[1].s[3], 0.0);
  EXPECT_FALSE(table_of("phi_deg,magnitude_hh\n0,1\n").has_phase[3]);
}

// In any order of rows, repeated rows included: the n-th of one polarisation belongs to the n-th of the other.
TEST(TransmitRows, BothPolarisationsBecomeOneRow) {
  const ResultTable table = table_of(
      "phi_deg,tx_pol,v_magnitude,v_phase_rad,h_magnitude,h_phase_rad\n0,v,1,0,2,0\n1,V,3,0,4,0\n1,h,5,0,6,0\n0,H,7,0,8,0\n"
      "0,v,9,0,10,0\n0,h,11,0,12,0\n");
  ASSERT_EQ(table.rows.size(), 3u);
  const double expected[3][4] = {{1, 7, 2, 8}, {3, 5, 4, 6}, {9, 11, 10, 12}};  // vv, vh, hv, hh
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t c = 0; c < 4; ++c) EXPECT_DOUBLE_EQ(table.rows[row].s[c].real() * root, expected[row][c]) << row << ' ' << c;
}

TEST(TransmitRows, OnePolarisationAloneHasTwoChannels) {
  const ResultTable table = table_of("phi_deg,tx_pol,v_magnitude,h_magnitude\n0,h,1,2\n1,h,3,4\n");
  EXPECT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.has_channel, (std::array{false, true, false, true}));
}

// A table that is the other times a factor: the factor comes back, and nothing is left but rounding.
TEST(FreeScale, FindsTheFactorOfAnotherCalibration) {
  const ResultTable reference = table_of("phi_deg,re_vv,im_vv,re_hh,im_hh\n0,1,2,3,4\n1,0,-1,2,0\n");
  ResultTable result = reference;
  const Complex calibration = std::polar(0.02, 1.0);
  apply_scale(result, calibration);
  EXPECT_NEAR(result.rows[0].sigma_dbsm[0], reference.rows[0].sigma_dbsm[0] + 20.0 * std::log10(0.02), 1e-12);
  const Comparison c = compare_results(result, reference, 20.0, true);
  EXPECT_NEAR(std::abs(c.scale->factor * calibration - 1.0), 0.0, 1e-14);
  EXPECT_TRUE(c.scale->phase);
  EXPECT_LE(c.errors[0].relative_error, 1e-14);
  EXPECT_LE(c.errors[3].rms_db, 1e-12);
  EXPECT_THAT(comparison_text(c), HasSubstr("scaled      the result by +33.98 dB, -57.3 degrees, fitted"));
}

// Levels alone have no phase to fit: sum |a||b| / sum |a|^2 of amplitudes 1, 2 and 2, 2 is 6 / 5.
TEST(FreeScale, LevelsAreFittedByMagnitude) {
  const ResultTable result = table_of("phi_deg,magnitude_vv\n0,1\n1,2\n"),
                    reference = table_of("phi_deg,magnitude_vv\n0,2\n1,2\n");
  const Comparison c = compare_results(result, reference, 20.0, true);
  EXPECT_NEAR(c.scale->factor.real(), 1.2, 1e-14);
  EXPECT_FALSE(c.scale->phase);
  EXPECT_THROW(compare_results(table_of("phi_deg,magnitude_vv\n0,0\n1,0\n"), reference, 20.0, true), InputError);
}

TEST(ColumnMap, BadMapsAreRefused) {
  const std::string good = "f,phi_deg,sigma_vv_dbsm\n1,0,1\n";
  for (const char* bad : {"freq_hz", "freq_hz=", "freq_hz=f*", "freq_hz=f*x", "freq_hz=f*0", "freq_hz=f+1*2", "freq_hz=f*1e400"})
    EXPECT_THAT(complaint(good, bad), HasSubstr("write OURS=THEIRS, with *FACTOR and +OFFSET")) << bad;
  EXPECT_THAT(complaint(good, "freq=f"), HasSubstr("freq is no column of a result; write one of freq_hz, freq_ghz, theta_deg"));
  EXPECT_THAT(complaint(good, "freq_hz=g"), HasSubstr("line 1: no column is named g; choose among f, phi_deg, sigma_vv_dbsm"));
  EXPECT_THAT(complaint(good, "freq_hz=f,freq_hz=phi_deg"), HasSubstr("freq_hz is given twice"));
  EXPECT_THAT(complaint(good, "sigma_hh_dbsm=f*2"), HasSubstr("sigma_hh_dbsm takes no factor"));
  EXPECT_EQ(complaint(good, "freq_hz=f*1e9"), "");
}

TEST(TransmitRows, BadRowsAreRefused) {
  const std::string header = "phi_deg,tx_pol,v_magnitude,h_magnitude\n";
  EXPECT_THAT(complaint(header + "0,left,1,2\n"), HasSubstr("line 2: the transmit polarisation is \"left\"; write v or h"));
  EXPECT_THAT(complaint(header + "0,v,1,2\n1,h,1,2\n"), HasSubstr("do not come in pairs; add the missing ones"));
  EXPECT_THAT(complaint(header + "0,v,1,2\n0,h,1,2\n1,h,1,2\n"), HasSubstr("do not come in pairs"));
  EXPECT_THAT(complaint(header + "0,v,-1,2\n"), HasSubstr("line 2: a magnitude must be 0 or more"));
  EXPECT_THAT(complaint("phi_deg,tx_pol,re_vv,im_vv\n0,v,1,2\n"), HasSubstr("no channel beside tx_pol; name v_magnitude"));
}

TEST(ColumnMap, PresetOfAzimuthAndElevation) {
  const ResultTable table = table_of("Azimuth,El,level\n20,10,3\n", "azel,sigma_hh_dbsm=level");
  EXPECT_EQ(table.rows[0].key[ResultTable::theta], 80.0);
  EXPECT_EQ(table.rows[0].key[ResultTable::phi], 20.0);
  EXPECT_EQ(table.rows[0].sigma_dbsm[3], 3.0);
}

TEST(ColumnMap, PresetOfMatlab) {
  const ResultTable table = table_of("az,el,rcs,freq\n20,-10,3,1e9\n", "matlab");
  EXPECT_EQ(table.rows[0].key[ResultTable::theta], 100.0);
  EXPECT_EQ(table.rows[0].key[ResultTable::frequency], 1e9);
  EXPECT_EQ(table.rows[0].sigma_dbsm[0], 3.0);
}

TEST(ColumnMap, PresetOfFeko) {
  const std::string header = "\"Theta\",\"Phi\",\"Re(Etheta)\",\"RCS(Theta)\",\"RCS(Phi)\",\"RCS(Total)\"\n";
  const ResultTable table = table_of(header + "80,20,7,10,0.1,10.1\n", "Feko");
  EXPECT_EQ(table.rows[0].key[ResultTable::theta], 80.0);
  EXPECT_NEAR(table.rows[0].sigma_dbsm[0], 10.0, 1e-12);
  EXPECT_NEAR(table.rows[0].sigma_dbsm[2], -10.0, 1e-12);
  EXPECT_FALSE(table.has_phase[0]);
}

TEST(ColumnMap, PresetOfHfss) {
  const std::string header = "\"Freq [GHz]\",\"IWavePhi [deg]\",\"IWaveTheta [deg]\",";
  const ResultTable complex = table_of(header +
                                           "\"re(ComplexMonostaticRCSTheta) []\",\"im(ComplexMonostaticRCSTheta) []\"\n"
                                           "10,0,80,0,2\n",
                                       "hfss");
  EXPECT_EQ(complex.rows[0].key[ResultTable::frequency], 10e9);
  EXPECT_EQ(complex.rows[0].key[ResultTable::theta], 80.0);
  EXPECT_NEAR(std::abs(complex.rows[0].s[0] - Complex(0.0, 2.0 / root)), 0.0, 1e-15);
  EXPECT_EQ(table_of(header + "dB(MonostaticRCSPhi)\n10,0,80,-3\n", "hfss").rows[0].sigma_dbsm[2], -3.0);
}

TEST(ColumnMap, OnesOwnColumnsGoBeforeThoseOfAPreset) {
  EXPECT_EQ(table_of("az,el,rcs,other\n20,-10,3,4\n", "matlab,sigma_vv_dbsm=other").rows[0].sigma_dbsm[0], 4.0);
  EXPECT_THAT(complaint("a,b\n1,2\n", "cst"), HasSubstr("hfss, feko, matlab or azel"));
}

}  // namespace
}  // namespace raytube
